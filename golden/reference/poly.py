# SPDX-License-Identifier: Apache-2.0
"""Polynomial shading in float64: paper P1, section IV, as printed and with its division by three repaired."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import contract as k

Floats = NDArray[np.float64]

NODES = {
    k.NODES_LEFT: {1: (0, 1), 2: (0, 1 / 2, 1), 3: (0, 1 / 4, 1 / 2, 1)},
    k.NODES_RIGHT: {1: (0, 1), 2: (0, 1 / 2, 1), 3: (0, 1 / 2, 3 / 4, 1)},
}
"""t at the nodes, by node set and degree."""


def third_paper(x: ArrayLike) -> Floats:
    """x/2 - x/8 - x/32 - x/128 = 43 x / 128, 0.78 % more than x/3 (P1, Fig. 7)."""
    x = np.asarray(x, float)
    return x / 2 - x / 8 - x / 32 - x / 128


def third_log(x: ArrayLike, adders: int = 4) -> Floats:
    """x/4 (1 + 1/4)(1 + 1/16)(1 + 1/256)...: every adder doubles the number of correct bits.

    >>> float(third_log(3 << 32, 4)) / (1 << 32)  # 2^-32 too small
    0.9999999997671694
    """
    x = np.asarray(x, float) / 4
    for adder in range(adders):
        x = x + x / (1 << (2 << adder))
    return x


def third_exact(x: ArrayLike) -> Floats:
    """x/3."""
    return np.asarray(x, float) / 3


def coef(
    degree: int,
    intensity: ArrayLike,
    *,
    nodes: int = k.NODES_LEFT,
    form: int = k.FORM_PAPER,
    third: Callable[[ArrayLike], Floats] = third_exact,
) -> tuple[Floats, ...]:
    """(A, B, C, D) from intensities (..., degree + 1) at the nodes; ``third`` divides by three.

    Paper: it divides what P1 divides, one of the two parts of A and of C, which nearly cancel. Refined: it divides the
    sum of both, which is one of intensity differences.

    >>> [float(v) for v in coef(3, np.ones(4), third=third_paper)]  # a constant does not stay constant: I(1) = 1.27
    [0.1875, 0.0, 0.0859375, 1.0]
    >>> [float(v) for v in coef(3, np.ones(4), form=k.FORM_REFINED, third=third_paper)]
    [0.0, 0.0, 0.0, 1.0]
    """
    i = np.moveaxis(np.asarray(intensity, float), -1, 0)
    zero = np.zeros_like(i[0])
    if degree == 1:
        return zero, zero, i[1] - i[0], i[0]
    if degree == 2:
        return zero, 2 * (i[0] - 2 * i[1] + i[2]), 4 * i[1] - 3 * i[0] - i[2], i[0]
    i1, i2, i3, i4 = i
    if nodes == k.NODES_LEFT:
        a = (8 * (8 * i2 + i4), -8 * (i1 + 2 * i3))  # A = divided / 3 + whole
        b = 2 * (7 * i1 - 16 * i2 + 10 * i3 - i4)
        c = (32 * i2 + i4, -7 * i1 - 4 * i3)
    else:
        a = (-8 * (i1 + 8 * i3), 8 * (2 * i2 + i4))
        b = 2 * (3 * i1 - 14 * i2 + 16 * i3 - 5 * i4)
        c = (-13 * i1 - 32 * i3, 3 * (4 * i2 + i4))
    if form == k.FORM_PAPER:
        a, c = (third(divided) + whole for divided, whole in (a, c))
    else:
        a, c = (third(divided + 3 * whole) for divided, whole in (a, c))
    return a, b, c, i1


def horner(coefficients: tuple[ArrayLike, ...], t: ArrayLike) -> Floats:
    """t (t (A t + B) + C) + D.

    >>> float(horner((1, 1, 1, 1), 0.5))
    1.875
    """
    a, b, c, d = coefficients
    t = np.asarray(t, float)
    return t * (t * (a * t + b) + c) + d
