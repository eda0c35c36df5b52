"""shade_rsqrt: mantissa and exponent of a reciprocal square root, to the bit of golden.fixed.rsqrt, on every clock."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.fixed import rsqrt

from tb.bench import TRAFFIC, Bench, checked
from tb.runner import simulate


def test_cocotb():
    simulate("shade_rsqrt", {})


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Powers of two and their neighbours, 0, and random numbers of every length."""
    powers = 1 << np.arange(k.RSQRT_W)
    random = bench.rng.integers(0, 1 << k.RSQRT_W, 1000) >> bench.rng.integers(0, k.RSQRT_W, 1000)
    z = np.concatenate([powers - 1, powers, powers[1:] + 1, [(1 << k.RSQRT_W) - 1], random])
    y, e = rsqrt(z)
    outputs = {"y_o": y, "e_o": e, "zero_o": z == 0}
    await bench.pipeline({"z_i": z}, outputs, k.LATENCY_RSQRT, gap=gap, reset=reset)
