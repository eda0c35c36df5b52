"""Inputs that several benches of rtl/normal share, by port."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.normal import dot3

from tb.bench import Bench

ENDS = [f"{v}{c}_i" for v in "ab" for c in "xyz"]


def cosines(bench: Bench, rows: int) -> np.ndarray:
    """c (rows,), S1.16: 0, 1 and cos(pi/4) with their neighbours, extremes, random ones, most of them in [0, 1]."""
    near = np.add.outer([0, k.D2_LIMIT, 1 << k.INTENSITY_F], np.arange(-2, 3)).ravel()
    inside = bench.rng.integers(0, 1 << k.INTENSITY_F, rows, endpoint=True)
    c = np.where(bench.rng.random(rows) < 0.75, inside, bench.signed(k.INTENSITY_W, rows))
    c[: len(near)] = near
    return c


def pairs(bench: Bench, rows: int) -> dict[str, np.ndarray]:
    """Two vectors, S1.16: in turn equal unit vectors, opposite ones, neighbours, and any components at all."""
    free = bench.rng.standard_normal((2, 3, rows))
    a = np.rint(free[0] / np.linalg.norm(free[0], axis=0) * (1 << k.INTENSITY_F)).astype(int)
    a[:, :6] = np.c_[np.eye(3, dtype=int), -np.eye(3, dtype=int)] << k.INTENSITY_F
    near = a + np.rint(free[1] * 4096).astype(int)
    any_a, any_b = (np.stack([bench.signed(k.INTENSITY_W, rows) for _ in "xyz"]) for _ in "ab")
    kind = np.arange(rows) // 6 % 4
    a = np.where(kind == 3, any_a, a)
    b = np.choose(kind, [a, -a, near, any_b])
    return dict(zip(ENDS, (*a, *b), strict=True))


def arcs(bench: Bench, rows: int) -> dict[str, np.ndarray]:
    """Two vectors and the cosine of their angle; in a quarter of the rows any number instead."""
    ends = pairs(bench, rows)
    low, high = -(1 << k.INTENSITY_W - 1), (1 << k.INTENSITY_W - 1) - 1
    true = dot3(*ends.values()).clip(low, high)
    return {**ends, "c_i": np.where(bench.rng.random(rows) < 0.25, cosines(bench, rows), true)}
