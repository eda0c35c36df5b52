"""shade_node_chain: five normals of an arc, to the bit of golden.normal.node_chain, on every clock."""

from polyshade.golden import contract as k
from polyshade.golden.normal import node_chain

from tb.bench import TRAFFIC, Bench, checked
from tb.normal.vectors import arcs
from tb.runner import points, simulate

OUTPUTS = (*(f"n{n}{c}_o" for n in range(5) for c in "xyz"), "clamped_o")


@points({}, {"FORM": k.FORM_PAPER}, {"FORM": k.FORM_PAPER, "DEGREE": 1})
def test_cocotb(point):
    simulate("shade_node_chain", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Equal and opposite normals, neighbours, any vectors; c that fits them, and any other."""
    inputs = arcs(bench, 600)
    values = node_chain(*inputs.values(), bench.parameter("FORM"), bench.parameter("DEGREE"))
    outputs = dict(zip(OUTPUTS, values, strict=True))
    await bench.pipeline(inputs, outputs, k.LATENCY_NODE_CHAIN, gap=gap, reset=reset)
