"""Light at a point in float64: Lambert, Phong and Blinn-Phong (paper P1, section II).

Directional light, viewer at infinity, camera space: x right, y up, z towards the viewer. Normals (..., 3) of any
length.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
VIEW = np.array([0.0, 0.0, 1.0])


def unit(vectors: ArrayLike) -> Floats:
    """Vectors (..., 3) divided by their length; a zero vector stays zero."""
    vectors = np.asarray(vectors, float)
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(length == 0, 1, length)


def diffuse(normal: ArrayLike, light: ArrayLike, *, as_given: bool = False) -> Floats:
    """Lambert's N.L, *not* clamped: clamping after the interpolation puts no kink into a polynomial.

    ``as_given``, here and below: the normal is not normalized, so that the error of its length shows.
    """
    return _direction(normal, as_given) @ unit(light)


def blinn(normal: ArrayLike, light: ArrayLike, shininess: float, *, as_given: bool = False) -> Floats:
    """max(0, N.H)^n, H = (L + V)/|L + V|."""
    return np.maximum(_direction(normal, as_given) @ unit(unit(light) + VIEW), 0) ** shininess


def phong(normal: ArrayLike, light: ArrayLike, shininess: float, *, as_given: bool = False) -> Floats:
    """max(0, R.V)^n, R = 2 N (N.L) - L."""
    normal, light = _direction(normal, as_given), unit(light)
    return np.maximum(2 * (normal @ light) * (normal @ VIEW) - light @ VIEW, 0) ** shininess


def lambert(normal: ArrayLike, light: ArrayLike, shininess: float, *, as_given: bool = False) -> Floats:
    """No specular light: 0."""
    return np.zeros(np.shape(normal)[:-1])


def _direction(normal: ArrayLike, as_given: bool) -> Floats:
    return np.asarray(normal, float) if as_given else unit(normal)


MODELS: dict[str, Callable[..., Floats]] = {
    "blinn": blinn,
    "phong": phong,
    "lambert": lambert,
}
"""Specular light by the name of its model; diffuse light is Lambert's in all of them."""


def light_channels(
    model: str, normal: ArrayLike, light: ArrayLike, shininess: float, *, as_given: bool = False
) -> Floats:
    """(..., 2): diffuse (unclamped) and specular intensity at a normal."""
    specular = MODELS[model](normal, light, shininess, as_given=as_given)
    return np.stack([diffuse(normal, light, as_given=as_given), specular], axis=-1)


def kappa(model: str, first: ArrayLike, last: ArrayLike, shininess: float) -> Floats:
    """n (1 - c) of an arc between two normals, c the cosine of its angle: what the planner goes by.

    Phong's R.V turns twice as fast as the normal: 4 n. Diffuse light alone counts as n = 1.
    """
    factor = {"blinn": max(shininess, 1), "phong": max(4 * shininess, 1), "lambert": 1}[model]
    return factor * (1 - np.sum(unit(first) * unit(last), axis=-1))
