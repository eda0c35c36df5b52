"""Polynomial shading in float64, as paper P1 prints it (section IV)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from golden import contract as k

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


def third_exact(x: ArrayLike) -> Floats:
    """x/3."""
    return np.asarray(x, float) / 3


def coef(degree: int, intensity, *, nodes: int = k.NODES_LEFT, third=third_exact) -> tuple[Floats, ...]:
    """(A, B, C, D) from intensities (..., degree + 1) at the nodes; ``third`` divides by three where P1 does.

    >>> [float(v) for v in coef(3, np.ones(4), third=third_paper)]  # a constant does not stay constant: I(1) = 1.27
    [0.1875, 0.0, 0.0859375, 1.0]
    """
    i = np.moveaxis(np.asarray(intensity, float), -1, 0)
    zero = np.zeros_like(i[0])
    if degree == 1:
        return zero, zero, i[1] - i[0], i[0]
    if degree == 2:
        return zero, 2 * (i[0] - 2 * i[1] + i[2]), 4 * i[1] - 3 * i[0] - i[2], i[0]
    i1, i2, i3, i4 = i
    if nodes == k.NODES_LEFT:
        a = third(8 * (8 * i2 + i4)) - 8 * (i1 + 2 * i3)
        b = 2 * (7 * i1 - 16 * i2 + 10 * i3 - i4)
        c = third(32 * i2 + i4) - 7 * i1 - 4 * i3
    else:
        a = 8 * (2 * i2 + i4) - third(8 * (i1 + 8 * i3))
        b = 2 * (3 * i1 - 14 * i2 + 16 * i3 - 5 * i4)
        c = 3 * (4 * i2 + i4) - third(13 * i1 + 32 * i3)
    return a, b, c, i1


def horner(coefficients: tuple[ArrayLike, ...], t: ArrayLike) -> Floats:
    """t (t (A t + B) + C) + D.

    >>> float(horner((1, 1, 1, 1), 0.5))
    1.875
    """
    a, b, c, d = coefficients
    t = np.asarray(t, float)
    return t * (t * (a * t + b) + c) + d
