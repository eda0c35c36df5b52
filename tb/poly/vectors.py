# SPDX-License-Identifier: Apache-2.0
"""Inputs that several benches of rtl/poly share, by port."""

import random
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from polyshade.golden import contract as k
from polyshade.golden.poly import pack_records
from polyshade.golden.types import RECORD

from tb.bench import Bench


def parameters_t(bench: Bench, t_f: int, rows: int) -> np.ndarray:
    """Values of t (rows,), U1.t_f: one in ten is 0 or 1, the others are random in [0, 1]."""
    t = bench.rng.integers(0, 1 << t_f, rows, endpoint=True)
    return np.where(bench.rng.random(rows) < 0.1, bench.rng.choice([0, 1 << t_f], rows), t)


def polynomials(bench: Bench, rows: int) -> dict[str, np.ndarray]:
    """A, B, C, D in the formats of an evaluator, any bits: corners and random ones."""
    coefficients = {f"{name}_i": bench.signed(bench.parameter("COEF_W"), rows) for name in "abc"}
    return {**coefficients, "d_i": bench.signed(bench.parameter("D_W"), rows)}


@dataclass(frozen=True)
class Spans:
    """Spans for shade_span_walk and shade_poly_span: nodes (S, 2, 4), degree, count, tag, more (S,)."""

    nodes: np.ndarray
    degree: np.ndarray
    count: np.ndarray
    tag: np.ndarray
    more: np.ndarray

    def beats(self) -> list[tuple[int]]:
        """What stands at s_axis_span_tdata, a beat a span; bits without a meaning are random."""
        packed = _beats(pack_records(self.nodes, self.degree, self.count, self.tag, self.more))
        return [(beat | random.getrandbits(k.RECORD_DATA_W) & ~USED,) for beat in packed]

    def texts(self) -> list[str]:
        """Every span in words, for messages: number, degree, pixels, nodes of either channel in hex."""
        mask = (1 << k.INTENSITY_W) - 1
        nodes = [" ".join(f"{node & mask:05x}" for node in span.ravel().tolist()) for span in self.nodes]
        shape = zip(self.degree, self.count, nodes, strict=True)
        return [f"span {i} (degree {d}, {n} pixels, nodes {text})" for i, (d, n, text) in enumerate(shape)]


def _beats(words: np.ndarray) -> list[int]:
    return [int.from_bytes(row.astype("<u4").tobytes(), "little") for row in words]


USED = sum((1 << field.width) - 1 << field.lsb for field in RECORD.leaves())
"""The bits of a beat that have a meaning."""


def spans(bench: Bench, degree: ArrayLike, count: ArrayLike) -> Spans:
    """Spans with random tags and nodes: one half with intensities in [0, 1], the other with corners and any bits.

    A third of them goes on in the next one.
    """
    degree, count = np.broadcast_arrays(degree, count)
    shape = (count.size, k.CHANNELS, k.NODE_COUNT)
    seen = bench.rng.integers(0, 1 << k.INTENSITY_F, shape, endpoint=True)
    free = bench.signed(k.INTENSITY_W, seen.size).reshape(shape)
    chosen = np.where(bench.rng.random((count.size, 1, 1)) < 0.5, seen, free)
    more = bench.rng.random(count.size) < 1 / 3
    return Spans(chosen, degree, count, bench.rng.integers(0, 1 << k.TAG_W, count.size), more)


def mixed_spans(bench: Bench, rows: int) -> Spans:
    """Spans of all degrees and of 1 to 20 pixels, half of them of 1 to 4."""
    rng = bench.rng
    degree = rng.integers(0, 4, rows)
    short = (rng.random(rows) < 0.5) | (degree == k.DEGREE_DIRECT)
    return spans(bench, degree, np.where(short, rng.integers(1, k.DIRECT_MAX + 1, rows), rng.integers(1, 21, rows)))
