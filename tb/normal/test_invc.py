"""shade_invc: 1/sqrt(2 (1 + c)) and the cosine of the half angle, to the bit of golden.normal.invc."""

from polyshade.golden import contract as k
from polyshade.golden.normal import invc

from tb.bench import TRAFFIC, Bench, checked
from tb.normal.vectors import cosines
from tb.runner import points, simulate


@points({}, {"FORM": k.FORM_PAPER}, {"FORM": k.FORM_PAPER, "DEGREE": 1})
def test_cocotb(point):
    simulate("shade_invc", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Cosines in [0, 1], and outside, which are clamped and told."""
    c = cosines(bench, 1000)
    values = invc(c, bench.parameter("FORM"), bench.parameter("DEGREE"))
    outputs = dict(zip(("invc_o", "half_o", "clamped_o"), values, strict=True))
    await bench.pipeline({"c_i": c}, outputs, k.LATENCY_INVC, gap=gap, reset=reset)
