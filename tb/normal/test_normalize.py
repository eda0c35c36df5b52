"""shade_normalize: unit vectors of vectors of every length, to the bit of golden.normal.normalize, on every clock."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.normal import normalize

from tb.bench import TRAFFIC, Bench, checked
from tb.runner import simulate


def test_cocotb():
    simulate("shade_normalize", {})


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Axes, extremes, vectors of a few ulp, the zero vector, random ones of every length."""
    rows = 1000
    v = np.stack([bench.signed(k.INTENSITY_W, rows) for _ in "xyz"]) >> bench.rng.integers(0, k.INTENSITY_W, rows)
    v[:, :27] = np.stack(np.meshgrid(*[[-1, 0, 1]] * 3)).reshape(3, -1)
    v[:, 27:54] = v[:, :27] << 16
    n = normalize(*v)
    outputs = {f"{c}_o": n[i] for i, c in enumerate("xyz")} | {"zero_o": ~v.any(axis=0)}
    inputs = {f"{c}_i": v[i] for i, c in enumerate("xyz")}
    await bench.pipeline(inputs, outputs, k.LATENCY_NORMALIZE, gap=gap, reset=reset)
