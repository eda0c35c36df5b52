# SPDX-License-Identifier: Apache-2.0
"""shade_dot_scaled: its three products, in front of the sum; the dot product has a case in ``sim/units``."""

import numpy as np
from polyshade import sim
from polyshade.golden import contract as k

from tb.runner import SEED


def test_products() -> None:
    """Exact, LATENCY_MUL clocks behind their factors."""
    rng = np.random.default_rng([SEED, 7])
    low, high = -(1 << k.INTENSITY_W - 1), (1 << k.INTENSITY_W - 1) - 1
    a, b = rng.integers(low, high, (2, 5000, 3), endpoint=True)
    a[:8], b[:4], b[4:8] = low, low, high
    vectors = {f"{name}.{axis}": v[:, i] for name, v in (("a_i", a), ("b_i", b)) for i, axis in enumerate("xyz")}
    run = sim.load("shade_dot_scaled").run(**vectors, shift_i=0, latency=k.LATENCY_MUL, seed=SEED)
    for i, axis in enumerate("xyz"):
        assert np.array_equal(run.outputs[f"product_{axis}_o"], a[:, i] * b[:, i]), axis
