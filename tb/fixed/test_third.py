"""shade_third: a third, to the bit of golden.fixed.third, on every clock."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.fixed import third

from tb.bench import TRAFFIC, Bench, checked
from tb.runner import points, simulate


@points({}, {"FORM": k.FORM_PAPER}, {"WIDTH": 9}, {"WIDTH": 4, "FORM": k.FORM_PAPER})
def test_cocotb(point):
    simulate("shade_third", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Every x of up to ten bits, else corners and random ones."""
    bits = bench.bits("x_i")
    x = np.arange(-(1 << bits - 1), 1 << bits - 1) if bits <= 10 else bench.signed(bits, 1000)
    y = third(x, bench.parameter("FORM"))
    await bench.pipeline({"x_i": x}, {"y_o": y}, k.LATENCY_THIRD, gap=gap, reset=reset)
