"""shade_saturate: clamped to what the output can hold, to the bit of golden.fixed.saturate."""

import numpy as np
from polyshade.golden import fixed

from tb.bench import Bench, checked
from tb.runner import points, simulate


@points({}, {"WIDTH": 9, "OUT_W": 4}, {"WIDTH": 3, "OUT_W": 1})
def test_cocotb(point):
    simulate("shade_saturate", point)


@checked()
async def values(bench: Bench) -> None:
    """Every x of up to 10 bits; else the limits, their neighbours, single bits and random ones."""
    bits, out = bench.bits("x_i"), bench.bits("y_o")
    if bits <= 10:
        x = np.arange(-(1 << bits - 1), 1 << bits - 1)
    else:
        edges = np.add.outer([0, 1 << out, -(1 << out)], np.arange(-3, 4)).ravel()
        near = bench.rng.integers(-1 << out, 2 << out, 500)
        x = np.concatenate([edges, near, 1 << np.arange(bits - 1), bench.signed(bits, 500)])
    await bench.pipeline({"x_i": x}, {"y_o": fixed.saturate(x, out)}, 0)
