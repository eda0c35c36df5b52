"""Inputs that several benches of rtl/poly share, by port."""

import numpy as np

from golden import contract as k
from tb.bench import Bench


def parameters_t(bench: Bench, t_f: int, rows: int) -> np.ndarray:
    """Values of t (rows,), U1.t_f: one in ten is 0 or 1, the others are random in [0, 1]."""
    t = bench.rng.integers(0, 1 << t_f, rows, endpoint=True)
    return np.where(bench.rng.random(rows) < 0.1, bench.rng.choice([0, 1 << t_f], rows), t)


def polynomials(bench: Bench, rows: int) -> dict[str, np.ndarray]:
    """A, B, C, D in the formats of an evaluator, any bits: corners and random ones."""
    coefficients = {f"{name}_i": bench.signed(bench.parameter("COEF_W"), rows) for name in "abc"}
    return {**coefficients, "d_i": bench.signed(bench.parameter("D_W"), rows)}


def nodes(bench: Bench, rows: int) -> dict[str, np.ndarray]:
    """Degree and four intensities: half of them corners and random ones, half those of a nearly constant span.

    In the second half large terms cancel and A, B and C are small.
    """
    bits = bench.parameter("WIDTH")
    free = bench.signed(bits, rows * k.NODE_COUNT).reshape(rows, -1)
    flat = np.clip(free[:, :1] + bench.rng.integers(-2, 3, free.shape), -(1 << bits - 1), (1 << bits - 1) - 1)
    chosen = np.where(np.arange(rows)[:, None] % 2, free, flat)
    return {"degree_i": bench.rng.integers(0, 4, rows), **{f"i{i + 1}_i": chosen[:, i] for i in range(k.NODE_COUNT)}}
