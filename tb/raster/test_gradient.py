# SPDX-License-Identifier: Apache-2.0
"""shade_gradient: increments of millions of sums, to the bit and in time, and their error against exact quotients."""

import numpy as np
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden.raster import gradient, reciprocal

from tb.runner import SEED

PAIRS = 500_000


def vectors(rng: np.random.Generator) -> dict[str, np.ndarray]:
    """Areas and sums of every length; a third of the increments are steep, by any amount."""
    area = rng.integers(0, 1 << 62, PAIRS) >> rng.integers(62 - k.AREA_W, 62, PAIRS)
    area = np.repeat(np.maximum(area, 1), 2)
    depth = np.repeat(rng.integers(0, 2, PAIRS), 2)
    length = np.clip(np.log2(area) + 24 - 7 * (1 - depth) + rng.integers(-24, 3, 2 * PAIRS), 0, k.AREA_W)
    length = np.where(rng.random(2 * PAIRS) < 0.2, rng.integers(0, k.AREA_W, 2 * PAIRS), length)
    sums = np.rint(np.exp2(length - rng.random(2 * PAIRS))).astype(np.int64) * rng.choice([-1, 1], 2 * PAIRS)
    return {"area": area, "depth": depth, "sum": np.clip(sums, -(1 << k.AREA_W), (1 << k.AREA_W) - 1)}


def test_every_bit() -> None:
    """A sum every two clocks, its shift with it, r for two clocks four later; nothing else counts."""
    rng = np.random.default_rng(SEED)
    v = vectors(rng)
    r, e = reciprocal(v["area"])
    value, steep = gradient(v["sum"], r, e, v["depth"])
    value, steep = value.reshape(-1, 2), steep.reshape(-1, 2).max(axis=1)
    scrap = {"sum_i": (-(1 << k.AREA_W), 1 << k.AREA_W), "down_i": (0, 64)}
    inputs = {"sum_i": v["sum"], "down_i": e + k.DEPTH_DOWN * v["depth"]}
    inputs = {
        name: np.stack([part, rng.integers(*scrap[name], 2 * PAIRS)], axis=1).ravel() for name, part in inputs.items()
    }
    inputs |= {"take_i": np.arange(4 * PAIRS) % 2 == 0, "line_i": np.arange(4 * PAIRS) // 2 % 2}
    inputs = {name: np.r_[part[:4], part, part[-4:]] for name, part in inputs.items()}  # the first two warm up
    inputs["r_i"] = np.r_[r[:8], np.repeat(r, 2)]
    run = sim.load("shade_gradient").run(**inputs, latency=k.LATENCY_GRADIENT, seed=SEED)
    second = np.arange(PAIRS) * 4 + 6
    for name, wanted in (("column", value[:, 0]), ("line", value[:, 1]), ("steep", steep)):
        assert np.array_equal(run.outputs[f"pair_o.{name}"][second], wanted), name
    assert 0.1 < steep.mean() < 0.9


def test_error() -> None:
    """Within 3/4 ulp of the exact quotient, and what r lacks of 1/A: between -2^-17 and 2^-17 + 2^-19 of it.

    Modulo 2^40, of small increments and of great ones; those that are not within 2^31 are told.
    """
    v = vectors(np.random.default_rng(SEED + 1))
    r, e = reciprocal(v["area"])
    value, steep = gradient(v["sum"], r, e, v["depth"])
    up = np.where(v["depth"] == 1, k.PLANE_F - k.DEPTH_F, k.STEP_F - k.VERTEX_F) + k.SUBPIXEL_F
    exact = v["sum"].astype(np.longdouble) * np.exp2(up.astype(np.longdouble)) / v["area"]
    assert np.all(steep[np.abs(exact) > 1.001 * 2**31] == 1)
    assert np.all(steep[np.abs(exact) < 0.999 * 2**31] == 0)
    near = np.abs(exact) < 2**39
    error = np.abs(value - exact) - np.abs(exact) * (2.0**-17 + 2.0**-19)
    assert error[near].max() <= 3 / 4
    period = np.longdouble(1 << k.GROWTH_W)
    made = v["sum"].astype(np.longdouble) * r * np.exp2((up - k.RECIPROCAL_F - e).astype(np.longdouble))  # with this r
    lost = (value - made + period / 2) % period - period / 2
    assert np.abs(lost[np.abs(made) < 2.0**60]).max() <= 3 / 4
    assert (np.abs(exact) > 2.0**40).mean() > 0.02
