"""shade_midpoint: the normal in the middle of two, to the bit of golden.normal.midpoint, on every clock."""

from polyshade.golden import contract as k
from polyshade.golden.normal import midpoint

from tb.bench import TRAFFIC, Bench, checked
from tb.normal.vectors import arcs
from tb.runner import points, simulate


@points({}, {"FORM": k.FORM_PAPER}, {"FORM": k.FORM_PAPER, "DEGREE": 1})
def test_cocotb(point):
    simulate("shade_midpoint", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Equal and opposite normals, neighbours, any vectors; c that fits them, and any other."""
    inputs = arcs(bench, 1000)
    values = midpoint(*inputs.values(), bench.parameter("FORM"), bench.parameter("DEGREE"))
    outputs = dict(zip(("x_o", "y_o", "z_o", "half_o", "clamped_o"), values, strict=True))
    await bench.pipeline(inputs, outputs, k.LATENCY_MIDPOINT, gap=gap, reset=reset)
