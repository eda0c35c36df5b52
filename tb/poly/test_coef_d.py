"""shade_coef_d: coefficient D, the first intensity, when A, B and C are ready."""

from polyshade.golden import contract as k
from polyshade.golden.poly import coef_d

from tb.bench import TRAFFIC, Bench, checked
from tb.runner import points, simulate


@points({})
def test_cocotb(point):
    simulate("shade_coef_d", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Corners and random ones."""
    i1 = bench.signed(bench.parameter("WIDTH"), 500)
    await bench.pipeline({"i1_i": i1}, {"d_o": coef_d(i1)}, k.LATENCY_COEF, gap=gap, reset=reset)
