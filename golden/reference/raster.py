# SPDX-License-Identifier: Apache-2.0
"""What a triangle has at a pixel, in float64: barycentric interpolation of its vertices at the pixel's centre."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


def interpolate(places: ArrayLike, values: ArrayLike, at: ArrayLike) -> Floats:
    """Linear interpolation of values (T, 3, C) at vertices (T, 3, 2) to points (T, 2).

    >>> interpolate([[[0, 0], [4, 0], [0, 4]]], [[[0], [1], [2]]], [[1, 1]]).tolist()
    [[0.75]]
    """
    places, values, at = (np.asarray(part, np.float64) for part in (places, values, at))
    weights = np.stack(
        [_twice_area(places[:, i - 2], places[:, i - 1], at) for i in range(3)], axis=1
    ) / _twice_area(*np.moveaxis(places, 1, 0))[:, None]  # fmt: skip
    return np.einsum("tk,tkc->tc", weights, values)


def _twice_area(a: Floats, b: Floats, c: Floats) -> Floats:
    u, v = b - a, c - a
    return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
