"""shade_coef: A, B, C and D of every degree side by side, to the bit of golden.poly.coef."""

from polyshade.golden import contract as k
from polyshade.golden.poly import coef

from tb.bench import TRAFFIC, Bench, checked
from tb.poly.vectors import nodes
from tb.runner import points, simulate


@points({}, {"NODES": k.NODES_RIGHT, "FORM": k.FORM_PAPER, "WIDTH": 3})
def test_cocotb(point):
    simulate("shade_coef", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """All degrees, mixed."""
    inputs = nodes(bench, 800)
    abcd = coef(*inputs.values(), nodes=bench.parameter("NODES"), form=bench.parameter("FORM"))
    outputs = dict(zip(("a_o", "b_o", "c_o", "d_o"), abcd, strict=True))
    await bench.pipeline(inputs, outputs, k.LATENCY_COEF, gap=gap, reset=reset)
