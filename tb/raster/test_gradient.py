# SPDX-License-Identifier: Apache-2.0
"""shade_gradient: increments of millions of sums, to the bit and in time, and their error against exact quotients."""

import numpy as np
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden.raster import gradient, reciprocal

from tb.runner import SEED

PAIRS = 500_000


def vectors(rng: np.random.Generator) -> dict[str, np.ndarray]:
    """Areas and sums of every length; a third of the increments do not fit."""
    area = rng.integers(0, 1 << 62, PAIRS) >> rng.integers(62 - k.AREA_W, 62, PAIRS)
    area = np.repeat(np.maximum(area, 1), 2)
    depth = np.repeat(rng.integers(0, 2, PAIRS), 2)
    length = np.clip(np.log2(area) + 24 - 7 * (1 - depth) + rng.integers(-24, 3, 2 * PAIRS), 0, k.AREA_W)
    sums = np.rint(np.exp2(length - rng.random(2 * PAIRS))).astype(np.int64) * rng.choice([-1, 1], 2 * PAIRS)
    return {"area": area, "depth": depth, "sum": np.clip(sums, -(1 << k.AREA_W), (1 << k.AREA_W) - 1)}


def test_every_bit() -> None:
    """One sum a clock, its shift with it, r three clocks later."""
    v = vectors(np.random.default_rng(SEED))
    r, e = reciprocal(v["area"])
    value, wide = gradient(v["sum"], r, e, v["depth"])
    wide = np.repeat(wide.reshape(-1, 2).max(axis=1), 2)
    value = np.where(wide, 0, value).reshape(-1, 2)
    line = np.arange(2 * PAIRS) % 2
    inputs = {"sum_i": v["sum"], "line_i": line, "down_i": e + k.DEPTH_DOWN * v["depth"]}
    inputs = {name: np.r_[part, part[-3:]] for name, part in inputs.items()}
    inputs["r_i"] = np.r_[r[:3], r]  # it is taken three clocks behind its sum
    run = sim.load("shade_gradient").run(**inputs, seed=SEED)
    assert np.array_equal(run.outputs["pair_o.column"][:PAIRS], value[:, 0])
    assert np.array_equal(run.outputs["pair_o.line"][:PAIRS], value[:, 1])
    assert np.all((run.given[:PAIRS] - run.taken[1::2][:PAIRS]) == k.LATENCY_GRADIENT)
    assert 0.1 < wide.mean() < 0.9


def test_error() -> None:
    """Within 3/4 ulp of the exact quotient, and what r lacks of 1/A: between -2^-17 and 2^-17 + 2^-19 of it."""
    v = vectors(np.random.default_rng(SEED + 1))
    value, wide = gradient(v["sum"], *reciprocal(v["area"]), v["depth"])
    up = np.where(v["depth"] == 1, k.PLANE_F - k.DEPTH_F, k.STEP_F - k.VERTEX_F) + k.SUBPIXEL_F
    exact = v["sum"].astype(np.longdouble) * np.exp2(up.astype(np.longdouble)) / v["area"]
    error = np.abs(value - exact) - np.abs(exact) * (2.0**-17 + 2.0**-19)
    assert error[wide == 0].max() <= 3 / 4
