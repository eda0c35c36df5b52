"""shade_dot3: the dot product, rounded once, to the bit of golden.normal.dot3, on every clock."""

from polyshade.golden import contract as k
from polyshade.golden.normal import dot3

from tb.bench import TRAFFIC, Bench, checked
from tb.normal.vectors import pairs
from tb.runner import simulate


def test_cocotb():
    simulate("shade_dot3", {})


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Unit vectors and any others; the largest sum among them."""
    inputs = pairs(bench, 1000)
    for column in inputs.values():
        column[-1] = -(1 << k.INTENSITY_W - 1)
    d = dot3(*inputs.values())
    await bench.pipeline(inputs, {"d_o": d}, k.LATENCY_DOT3, gap=gap, reset=reset)
