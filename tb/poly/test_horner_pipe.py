"""shade_horner_pipe: a polynomial of degree 3, to the bit of golden.poly.horner, a new one on every clock."""

from polyshade.golden import contract as k
from polyshade.golden.poly import horner

from tb.bench import TRAFFIC, Bench, checked
from tb.poly.vectors import parameters_t, polynomials
from tb.runner import points, simulate


@points({}, {"COEF_W": 10, "D_W": 6, "T_F": 4})
def test_cocotb(point):
    simulate("shade_horner_pipe", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Coefficients at their limits and random; t = 0, 1 and between."""
    t_f = bench.parameter("T_F")
    inputs = {**polynomials(bench, 1000), "t_i": parameters_t(bench, t_f, 1000)}
    y = horner(*inputs.values(), t_f=t_f)
    await bench.pipeline(inputs, {"y_o": y}, k.LATENCY_HORNER_PIPE, gap=gap, reset=reset)
