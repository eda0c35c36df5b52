# SPDX-License-Identifier: Apache-2.0
"""shade_factor: the factor of a middle normal by every variant, to the bit of golden.normal.factor, on every clock."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.normal import factor
from polyshade.golden.types import VEC, whole

from tb.bench import Bench, checked
from tb.runner import simulate


def test_cocotb():
    simulate("shade_factor", {})


@checked(gap=[0.0, 0.5])
async def stream(bench: Bench, gap: float) -> None:
    """Unit normals at any angle, equal ones among them; thresholds around the estimates, and outside [0, 1]."""
    rng, rows, one = bench.rng, 600, 1 << k.INTENSITY_F
    a, other = rng.standard_normal((2, 3, rows))
    b = a + other * rng.choice([0, 0.01, 0.3, 2], rows)
    a, b = (np.rint(v / np.linalg.norm(v, axis=0) * one).astype(int) for v in (a, b))
    threshold = np.where(rng.random(rows) < 0.2, rng.choice([-1, one, one + 1], rows), rng.integers(0, one, rows))
    middle, needs_d1, variant = rng.integers(0, 2, (2, rows))[0], rng.integers(0, 2, rows), rng.integers(0, 8, rows)
    inputs = {name: whole(VEC, dict(zip("xyz", v, strict=True))) for name, v in (("a_i", a), ("b_i", b))}
    choice = {"middle": middle, "variant": variant, "needs_d1": needs_d1, "threshold": threshold}
    inputs |= {f"choice_i.{name}": value for name, value in choice.items()}
    wanted = factor(a, b, middle, variant, needs_d1, threshold)
    await bench.pipeline(inputs, {"factor_o": wanted}, k.LATENCY_FACTOR_S, gap=gap)
