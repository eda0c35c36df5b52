"""shade_mul: the exact product, with operands of up to 18 bits and longer ones, with registers and without."""

import numpy as np
from polyshade.golden import fixed

from tb.bench import Bench, checked
from tb.runner import points, simulate


@points({}, {"A_W": 18, "STAGES": 0}, {"A_W": 35, "STAGES": 0}, {"A_W": 18}, {"STAGES": 3}, {"A_W": 19, "B_W": 2})
def test_cocotb(point):
    simulate("shade_mul", point)


@checked()
async def stream(bench: Bench) -> None:
    """Corners against corners, and random ones; the limits of the cut of a among them."""
    a_w, b_w = bench.parameter("A_W"), bench.parameter("B_W")
    b = bench.signed(b_w, 1000)
    cuts = np.add.outer(1 << np.arange(a_w - 1), [-1, 0]).ravel()  # 2^17 - 1 and 2^17, among others
    a = np.where(bench.rng.random(1000) < 0.25, bench.rng.choice([*cuts, *-cuts], 1000), bench.signed(a_w, 1000))
    await bench.pipeline({"a_i": a, "b_i": b}, {"p_o": fixed.mul(a, b)}, bench.parameter("STAGES"))
