"""shade_versine: 1 - cos of an angle by chord or dot product, to the bit of golden.light.versine, on every clock."""

from polyshade.golden import contract as k
from polyshade.golden.light import versine

from tb.bench import TRAFFIC, Bench, checked
from tb.normal.vectors import pairs
from tb.runner import points, simulate


@points({}, {"FORM": k.FORM_PAPER})
def test_cocotb(point):
    simulate("shade_versine", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Equal, opposite and close unit vectors; any others, which are clamped and told."""
    inputs = pairs(bench, 1000)
    x, outside = versine(*inputs.values(), form=bench.parameter("FORM"))
    await bench.pipeline(inputs, {"x_o": x, "range_o": outside}, k.LATENCY_VERSINE, gap=gap, reset=reset)
