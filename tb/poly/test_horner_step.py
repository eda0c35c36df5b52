"""shade_horner_step: a rounded product and a sum, to the bit of golden.poly.horner_step; c comes late."""

from polyshade.golden import contract as k
from polyshade.golden.poly import horner_step

from tb.bench import Bench, checked
from tb.poly.vectors import parameters_t
from tb.runner import points, simulate


@points({}, {"WIDTH": 12, "T_F": 4})
def test_cocotb(point):
    simulate("shade_horner_step", point)


@checked()
async def stream(bench: Bench) -> None:
    """A step on every clock. |s| + |c| is what WIDTH holds, as the header asks."""
    bits, t_f = bench.parameter("WIDTH"), bench.parameter("T_F")
    s, c = bench.signed(bits - 1, 1000), bench.signed(bits - 1, 1000)
    t = parameters_t(bench, t_f, 1000)
    outputs = {"y_o": horner_step(s, t, c, t_f=t_f)}
    late = {"c_i": k.LATENCY_MUL}
    await bench.pipeline({"s_i": s, "t_i": t, "c_i": c}, outputs, k.LATENCY_HORNER_STEP, late=late)
