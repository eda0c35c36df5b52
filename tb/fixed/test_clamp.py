"""shade_clamp: into [0, 1], and told, to the bit of golden.fixed.clamp."""

import numpy as np
from polyshade.golden import fixed

from tb.bench import Bench, checked
from tb.runner import points, simulate


@points({}, {"WIDTH": 20, "F": 18}, {"WIDTH": 6, "F": 2})
def test_cocotb(point):
    simulate("shade_clamp", point)


@checked()
async def values(bench: Bench) -> None:
    """Corners, 1 and its neighbours, random ones."""
    f = bench.parameter("F")
    one = (1 << f) + np.arange(-2, 3)
    x = np.concatenate([one, -one, bench.signed(bench.parameter("WIDTH"), 1000)])
    y, clamped = fixed.clamp(x, f)
    await bench.pipeline({"x_i": x}, {"y_o": y, "clamped_o": clamped}, 0)
