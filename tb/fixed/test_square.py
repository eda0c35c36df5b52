"""shade_square: the exact square."""

from polyshade.golden import contract as k
from polyshade.golden import fixed

from tb.bench import Bench, checked
from tb.runner import points, simulate


@points({}, {"WIDTH": 2}, {"WIDTH": 11})
def test_cocotb(point):
    simulate("shade_square", point)


@checked()
async def stream(bench: Bench) -> None:
    """Corners and random ones; the smallest number has the largest square."""
    x = bench.signed(bench.parameter("WIDTH"), 1000)
    await bench.pipeline({"x_i": x}, {"y_o": fixed.square(x)}, k.LATENCY_MUL)
