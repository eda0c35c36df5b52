# SPDX-License-Identifier: Apache-2.0
"""Fixed-point steps against exact fractions."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from polyshade.golden import fixed

from tb.runner import SEED

RNG = np.random.default_rng(SEED)


@pytest.mark.parametrize(
    ("x", "drop", "expected"),
    [(0, 1, 0), (1, 1, 1), (-1, 1, 0), (-2, 1, -1), (-3, 1, -1), (3, 1, 2), (7, 3, 1), (4, 3, 1), (3, 3, 0),
     (-4, 3, 0), (-5, 3, -1), (-12, 3, -1), (-13, 3, -2), (9, 0, 9), (-9, 0, -9), (1 << 62, 61, 2)],
)  # fmt: skip
def test_round(x: int, drop: int, expected: int) -> None:
    """To nearest, ties towards plus infinity."""
    assert fixed.round(x, drop) == expected


@pytest.mark.parametrize("out_w", [1, 4, 16])
def test_saturate(out_w: int) -> None:
    most = (1 << out_w) - 1
    x = [-(1 << 40), -1, 0, 1, most - 1, most, most + 1, 1 << 40]
    assert fixed.saturate(x, out_w).tolist() == [min(max(value, 0), most) for value in x]


def test_mul() -> None:
    """Exact up to the whole width of its operands, 35 x 18 bits."""
    a = [-(1 << 34), (1 << 34) - 1, -1, 0, 12345]
    b = [-(1 << 17), (1 << 17) - 1, -1, 0, -678]
    assert fixed.mul(np.array(a)[:, None], b).tolist() == [[x * y for y in b] for x in a]


def test_third_of_more_bits() -> None:
    x = [(1 << 57) - 1, -(1 << 57), 3 << 55, *RNG.integers(-(1 << 40), 1 << 40, 1000).tolist()]
    for value, result in zip(x, fixed.third(x).tolist(), strict=True):
        assert abs(Fraction(value, 3) - result) <= Fraction(1, 3)


STEPS = (lambda x: fixed.round(x, 2), lambda x: fixed.saturate(x, 8), fixed.third, lambda x: fixed.mul(x, 3))


def test_shapes() -> None:
    """Any shape, with broadcasting; Python integers and small types are taken as int64."""
    for function in STEPS:
        for shape in ((), (0,), (3,), (2, 1, 4)):
            result = function(np.full(shape, 100, np.int8))
            assert result.shape == shape
            assert result.dtype == np.int64
    assert fixed.mul(np.ones((2, 1), int), np.ones(3, int)).shape == (2, 3)
    assert fixed.mul(np.int8(100), np.int8(100)) == 10000
    assert fixed.third(True) == 0


@pytest.mark.parametrize("value", [1.0, [0.5], "1", None, 1j, 1 << 64])
def test_only_integers(value: object) -> None:
    for function in STEPS:
        with pytest.raises(TypeError, match="integers expected"):
            function(value)


def test_arguments_are_left_alone() -> None:
    x = np.arange(-5, 5)
    kept = x.copy()
    fixed.round(x, 1), fixed.saturate(x, 2), fixed.third(x), fixed.mul(x, x)
    assert np.array_equal(x, kept)
