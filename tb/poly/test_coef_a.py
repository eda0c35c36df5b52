"""shade_coef_a: coefficient A of every degree, to the bit of golden.poly.coef_a."""

from polyshade.golden import contract as k
from polyshade.golden.poly import coef_a
from polyshade.scripts.flow.points import grid

from tb.bench import TRAFFIC, Bench, checked
from tb.poly.vectors import nodes
from tb.runner import points, simulate


@points(*grid(NODES=[k.NODES_LEFT, k.NODES_RIGHT], FORM=[k.FORM_PAPER, k.FORM_REFINED]))
def test_cocotb(point):
    simulate("shade_coef_a", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """All degrees, mixed."""
    inputs = nodes(bench, 800)
    a = coef_a(*inputs.values(), nodes=bench.parameter("NODES"), form=bench.parameter("FORM"))
    await bench.pipeline(inputs, {"a_o": a}, k.LATENCY_COEF, gap=gap, reset=reset)
