"""shade_halfway: the direction between light and viewer, to the bit of golden.light.halfway, on every clock."""

from polyshade.golden import contract as k
from polyshade.golden.light import halfway

from tb.bench import TRAFFIC, Bench, checked
from tb.normal.vectors import pairs
from tb.runner import simulate


def test_cocotb():
    simulate("shade_halfway", {})


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Light from the viewer, from opposite (which is told), from beside; any vectors."""
    vectors = pairs(bench, 1000)
    outputs = dict(zip(("hx_o", "hy_o", "hz_o", "vh_o", "zero_o"), halfway(*vectors.values()), strict=True))
    inputs = dict(zip((f"{v}{c}_i" for v in "lv" for c in "xyz"), vectors.values(), strict=True))
    await bench.pipeline(inputs, outputs, k.LATENCY_HALFWAY, gap=gap, reset=reset)
