"""shade_bisect: the scaled sum of two vectors, to the bit of golden.normal.bisect; the scale comes WAIT clocks late."""

from polyshade.golden import contract as k
from polyshade.golden.normal import bisect

from tb.bench import TRAFFIC, Bench, checked
from tb.normal.vectors import pairs
from tb.runner import points, simulate


@points({}, {"WAIT": 4})
def test_cocotb(point):
    simulate("shade_bisect", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Equal and opposite vectors, neighbours, and any others, whose sums saturate."""
    wait = bench.parameter("WAIT")
    invc = bench.rng.integers(0, 1 << k.INVC_F, 1000)
    invc[::2] = 1 << k.INVC_F - 1
    inputs = {**pairs(bench, 1000), "invc_i": invc}
    outputs = dict(zip(("x_o", "y_o", "z_o"), bisect(*inputs.values()), strict=True))
    latency = wait + k.LATENCY_SCALE3
    await bench.pipeline(inputs, outputs, latency, gap=gap, reset=reset, late={"invc_i": wait})
