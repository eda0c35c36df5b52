"""shade_fresnel: Fresnel's factor, to the bit of golden.light.fresnel, on every clock."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.fixed import ONE
from polyshade.golden.light import fresnel

from tb.bench import TRAFFIC, Bench, checked
from tb.runner import simulate


def test_cocotb():
    simulate("shade_fresnel", {})


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Every pair of 0, 1 and their neighbours, numbers above 1, random ones."""
    edges = np.array([0, 1, 2, ONE // 2, ONE - 2, ONE - 1, ONE, ONE + 1, 2 * ONE - 1])
    c, f0 = bench.rng.integers(0, ONE, (2, 1000), endpoint=True)
    c[:81], f0[:81] = np.stack(np.meshgrid(edges, edges)).reshape(2, -1)
    inputs = {"c_i": c, "f0_i": f0}
    await bench.pipeline(inputs, {"f_o": fresnel(c, f0)}, k.LATENCY_FRESNEL, gap=gap, reset=reset)
