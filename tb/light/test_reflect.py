"""shade_reflect: the mirrored direction, to the bit of golden.light.reflect, on every clock."""

from polyshade.golden import contract as k
from polyshade.golden.light import reflect

from tb.bench import TRAFFIC, Bench, checked
from tb.normal.vectors import pairs
from tb.runner import simulate


def test_cocotb():
    simulate("shade_reflect", {})


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Light along the normal, from behind, close to it; vectors so long that R saturates."""
    vectors = pairs(bench, 1000)
    r = dict(zip(("x_o", "y_o", "z_o"), reflect(*vectors.values()), strict=True))
    inputs = {f"{v}{c}_i": vectors[f"{old}{c}_i"] for v, old in zip("nl", "ab", strict=True) for c in "xyz"}
    await bench.pipeline(inputs, r, k.LATENCY_REFLECT, gap=gap, reset=reset)
