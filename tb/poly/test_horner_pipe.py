"""shade_horner_pipe: a polynomial of degree 3, to the bit of golden.poly.horner, a new one on every clock."""

import numpy as np

from golden import contract as k
from golden.poly import horner
from tb.bench import TRAFFIC, Bench, checked
from tb.runner import points, simulate


@points({}, {"COEF_W": 10, "D_W": 6, "T_F": 4})
def test_cocotb(point):
    simulate("shade_horner_pipe", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Coefficients at their limits and random; t = 0, 1 and between."""
    rows = 1000
    a, b, c = (bench.signed(bench.parameter("COEF_W"), rows) for _ in range(3))
    d = bench.signed(bench.parameter("D_W"), rows)
    t_f = bench.parameter("T_F")
    t = bench.rng.integers(0, 1 << t_f, rows, endpoint=True)
    t[:: rows // 50] = np.resize([0, 1 << t_f], 50)
    y = horner(a, b, c, d, t, t_f=t_f)
    inputs = {"a_i": a, "b_i": b, "c_i": c, "d_i": d, "t_i": t}
    await bench.pipeline(inputs, {"y_o": y}, k.LATENCY_HORNER_PIPE, gap=gap, reset=reset)
