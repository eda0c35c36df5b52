"""shade_round: to nearest, ties up, to the bit of golden.fixed.round."""

import numpy as np
from polyshade.golden import fixed

from tb.bench import Bench, checked
from tb.runner import points, simulate


@points({}, {"WIDTH": 40, "DROP": 16}, {"WIDTH": 9, "DROP": 8}, {"WIDTH": 20, "DROP": 3, "OUT_W": 17})
def test_cocotb(point):
    simulate("shade_round", point)


@checked()
async def values(bench: Bench) -> None:
    """Every x of up to 12 bits; else corners, ties and their neighbours, random ones. All that y can hold."""
    bits, drop, out = bench.bits("x_i"), bench.parameter("DROP"), bench.bits("y_o")
    if bits <= 12:
        x = np.arange(-(1 << bits - 1), 1 << bits - 1)
    else:
        ties = (bench.signed(bits - drop, 500) << drop) + (1 << drop - 1) + bench.rng.integers(-1, 2, 500)
        x = np.concatenate([ties, bench.signed(bits, 1000)])
    y = fixed.round(x, drop)
    fits = y < 1 << out - 1  # a caller that asks for fewer bits promises this
    await bench.pipeline({"x_i": x[fits]}, {"y_o": y[fits]}, 0)
