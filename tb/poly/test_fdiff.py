# SPDX-License-Identifier: Apache-2.0
"""shade_fdiff: a polynomial by forward differences, to the bit of golden.poly.fdiff, a pixel on every clock."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.poly import fdiff

from tb.bench import TRAFFIC, Bench, checked
from tb.poly.vectors import polynomials
from tb.runner import points, simulate


@points({}, {"LOG2_MAX": 6}, {"COEF_W": 12, "D_W": 8, "LOG2_MAX": 3})
def test_cocotb(point):
    simulate("shade_fdiff", point)


def segments(bench: Bench, log2: np.ndarray, count: np.ndarray) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Inputs and outputs, a row a pixel, of consecutive segments of ``count`` pixels at steps of 2^-log2.

    Behind the first pixel of a segment the coefficients are random: they must not matter.
    """
    segment = np.repeat(np.arange(count.size), count)
    j = np.arange(segment.size) - np.repeat(np.cumsum(count) - count, count)
    first = j == 0
    polynomial = polynomials(bench, count.size)
    y = fdiff(*(values[segment] for values in polynomial.values()), log2[segment], j)
    noise = {**polynomials(bench, segment.size), "log2_i": bench.rng.integers(0, 16, segment.size)}
    chosen = {**polynomial, "log2_i": log2}
    inputs = {name: np.where(first, chosen[name][segment], noise[name]) for name in noise}
    return {**inputs, "first_i": first.astype(int)}, {"y_o": y}


@checked(gap=[0.0, 0.5])
async def short_segments(bench: Bench, gap: float) -> None:
    """Segments of every step, of one pixel and more, one right behind the other."""
    log2 = bench.rng.integers(0, bench.parameter("LOG2_MAX"), 200, endpoint=True)
    count = np.minimum(bench.rng.integers(1, 12, 200), (1 << log2) + 1)
    await bench.pipeline(*segments(bench, log2, count), k.LATENCY_FDIFF, gap=gap)


@checked()
async def whole_segments(bench: Bench) -> None:
    """Segments from t = 0 to t = 1, the longest one among them."""
    log2 = np.arange(bench.parameter("LOG2_MAX") + 1)
    await bench.pipeline(*segments(bench, log2, (1 << log2) + 1), k.LATENCY_FDIFF)


@checked(**TRAFFIC)
async def single_pixels(bench: Bench, gap: float, reset: float) -> None:
    """A new segment on every pixel; resets in the middle."""
    log2 = bench.rng.integers(0, bench.parameter("LOG2_MAX"), 300, endpoint=True)
    await bench.pipeline(*segments(bench, log2, np.ones(300, int)), k.LATENCY_FDIFF, gap=gap, reset=reset)
