"""Inputs that several benches of rtl/plan share, by port."""

import numpy as np
from polyshade.golden import contract as k

from tb.bench import Bench


def increments(bench: Bench, rows: int) -> dict[str, np.ndarray]:
    """Increments of normals, S2.29: corners, 0, vectors of a few units, random ones of every length."""
    g = np.stack([bench.signed(k.STEP_W, rows) for _ in "xyz"]) >> bench.rng.integers(0, k.STEP_W, rows)
    g[:, :27] = np.stack(np.meshgrid(*[[-1, 0, 1]] * 3)).reshape(3, -1)
    return {f"g{c}_i": g[i] for i, c in enumerate("xyz")}


async def sharpness(bench: Bench) -> tuple[int, int]:
    """Give the module a sharpness, at rest: mantissa and exponent."""
    mantissa = int(bench.rng.integers(1 << k.SHARPNESS_F, 2 << k.SHARPNESS_F))
    exponent = int(bench.rng.integers(0, 13))
    await bench.tick(k.LATENCY_PLANNER)
    bench.dut.mantissa_i.value, bench.dut.exponent_i.value = mantissa, exponent
    return mantissa, exponent
