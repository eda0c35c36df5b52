"""shade_kappa: kappa of an arc from its increment, to the bit of golden.plan.kappa, on every clock."""

from polyshade.golden import contract as k
from polyshade.golden.plan import kappa

from tb.bench import TRAFFIC, Bench, checked
from tb.plan.vectors import increments, sharpness
from tb.runner import simulate


def test_cocotb():
    simulate("shade_kappa", {})


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Increments of every length, the zero vector, arcs of 1 to 2^13 pixels, for one sharpness after the other."""
    for _ in range(5):
        static = await sharpness(bench)
        inputs = increments(bench, 300) | {"log2_i": bench.rng.integers(0, 14, 300)}
        await bench.pipeline(
            inputs, {"kappa_o": kappa(*inputs.values(), *static)}, k.LATENCY_KAPPA, gap=gap, reset=reset,
            late={"log2_i": 2},
        )  # fmt: skip
