"""shade_coef_b: coefficient B of every degree, to the bit of golden.poly.coef_b."""

from polyshade.golden import contract as k
from polyshade.golden.poly import coef_b

from tb.bench import TRAFFIC, Bench, checked
from tb.poly.vectors import nodes
from tb.runner import points, simulate


@points({}, {"NODES": k.NODES_RIGHT, "WIDTH": 20})
def test_cocotb(point):
    simulate("shade_coef_b", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """All degrees, mixed."""
    inputs = nodes(bench, 800)
    b = coef_b(*inputs.values(), nodes=bench.parameter("NODES"))
    await bench.pipeline(inputs, {"b_o": b}, k.LATENCY_COEF, gap=gap, reset=reset)
