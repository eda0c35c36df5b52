"""shade_square_fabric: the exact square without a multiplier, to the bit of golden.fixed.square."""

from polyshade.golden import fixed

from tb.bench import Bench, checked
from tb.runner import points, simulate


@points({}, {"WIDTH": 3}, {"WIDTH": 10}, {"WIDTH": 18})
def test_cocotb(point):
    simulate("shade_square_fabric", point)


@checked()
async def stream(bench: Bench) -> None:
    """0, the largest number, its neighbours and random ones."""
    width = bench.parameter("WIDTH")
    x = bench.signed(width, 1000) & (1 << width) - 1
    await bench.pipeline({"x_i": x}, {"y_o": fixed.square(x)}, (width - 2).bit_length())
