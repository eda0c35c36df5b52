# SPDX-License-Identifier: Apache-2.0
"""Light at a point in float64: the original models, and the lobe that P1 and P3 put in their place.

Camera space: x right, y up, z towards the viewer. Normals (..., 3) of any length; lights and viewers are directions,
one for all normals or one for each (..., 3). n: shininess, m: roughness, x = 1 - c: what a cosine lacks to 1.
"""

from __future__ import annotations

from collections.abc import Callable
from math import pi, sqrt
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Shape = Callable[[Floats], Floats]
VIEW = np.array([0.0, 0.0, 1.0])


# ---- vectors -----------------------------------------------------------------------------------------------------


def unit(vectors: ArrayLike) -> Floats:
    """Vectors (..., 3) divided by their length; a zero vector stays zero."""
    vectors = np.asarray(vectors, float)
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(length == 0, 1, length)


def dot(a: ArrayLike, b: ArrayLike) -> Floats:
    """a . b of vectors (..., 3)."""
    return np.einsum("...i,...i->...", np.asarray(a, float), np.asarray(b, float))


def halfway(light: ArrayLike, view: ArrayLike = VIEW) -> Floats:
    """H = (L + V)/|L + V|; 0 where L = -V."""
    return unit(unit(light) + unit(view))


# ---- functions of one cosine -------------------------------------------------------------------------------------


def cosine_power(c: ArrayLike, n: ArrayLike) -> Floats:
    """max(0, c)^n."""
    return np.maximum(c, 0) ** n


def schlick_lobe(c: ArrayLike, n: float) -> Floats:
    """c / (n - n c + c), 0 for c < 0: Schlick's rational stand-in for c^n (P3).

    >>> float(schlick_lobe(0.5, 3))  # 0.5 / (3 - 1.5 + 0.5)
    0.25
    """
    c = np.maximum(c, 0)
    return c / (n - n * c + c)


def ward_lobe(c: ArrayLike, m: float) -> Floats:
    """exp(-tan^2 g / m^2) of c = cos g; 0 for c <= 0."""
    c = np.asarray(c, float)
    square = np.where(c > 0, c, 1) ** 2
    return np.where(c > 0, np.exp((1 - 1 / square) / m**2), 0)


def beckmann(c: ArrayLike, m: float) -> Floats:
    """D = exp(-tan^2 g / m^2) / (4 m^2 cos^4 g) of c = cos g, as P1 prints it; 0 for c <= 0."""
    c = np.asarray(c, float)
    return ward_lobe(c, m) / (4 * m**2 * np.where(c > 0, c, 1) ** 4)


def fresnel(c: ArrayLike, f0: float) -> Floats:
    """F = F0 + (1 - F0)(1 - c)^5, c = V.H clamped to [0, 1]: Schlick's form.

    >>> float(fresnel(1, 0.04)), float(fresnel(0, 0.04))
    (0.04, 1.0)
    """
    return f0 + (1 - f0) * (1 - np.clip(c, 0, 1)) ** 5


def lobe(c: ArrayLike, k1: float, k2: float = 0, xmax: float = 1, power: int = 4) -> Floats:
    """max(0, 1 - k1 x + k2 x^2)^(2^power) with x = min(1 - c, xmax); 0 for c < 0.

    k2 = 0: what the papers print (P1's D4, D8, D16 with power 2, 3, 4; P3's equation 1). ``golden.material.fit`` gives
    k1, k2 and xmax.

    >>> float(lobe(0.5, 1)), 0.5**16  # n = 16: exactly c^16
    (1.52587890625e-05, 1.52587890625e-05)
    """
    c = np.asarray(c, float)
    x = np.minimum(1 - c, xmax)
    return np.where(c < 0, 0, np.maximum(1 - k1 * x + k2 * x**2, 0) ** (1 << power))


# ---- models ------------------------------------------------------------------------------------------------------


def diffuse(normal: ArrayLike, light: ArrayLike, *, as_given: bool = False) -> Floats:
    """Lambert's N.L, *not* clamped: clamping after the interpolation puts no kink into a polynomial.

    ``as_given``, here and below: the normal is not normalized, so that the error of its length shows.
    """
    return dot(_direction(normal, as_given), unit(light))


def lambert(normal: ArrayLike, light: ArrayLike, **_) -> Floats:
    """No specular light: 0."""
    return np.zeros(np.broadcast_shapes(np.shape(normal), np.shape(light))[:-1])


def blinn(
    normal: ArrayLike,
    light: ArrayLike,
    shininess: float,
    *,
    shape: Shape | None = None,
    view: ArrayLike = VIEW,
    as_given: bool = False,
    **_,
) -> Floats:
    """max(0, N.H)^n, H = (L + V)/|L + V|.

    ``shape``, here and below: a function of the cosine that stands for the highlight, relative to its peak.
    """
    c = dot(_direction(normal, as_given), halfway(light, view))
    return shape(c) if shape else cosine_power(c, shininess)


def phong(
    normal: ArrayLike,
    light: ArrayLike,
    shininess: float,
    *,
    shape: Shape | None = None,
    view: ArrayLike = VIEW,
    as_given: bool = False,
    **_,
) -> Floats:
    """max(0, R.V)^n, R = 2 N (N.L) - L."""
    normal, light, view = _direction(normal, as_given), unit(light), unit(view)
    c = 2 * dot(normal, light) * dot(normal, view) - dot(light, view)
    return shape(c) if shape else cosine_power(c, shininess)


def schlick(
    normal: ArrayLike, light: ArrayLike, shininess: float, *, view: ArrayLike = VIEW, as_given: bool = False, **_
) -> Floats:
    """c / (n - n c + c), c = max(0, N.H)."""
    return schlick_lobe(dot(_direction(normal, as_given), halfway(light, view)), shininess)


def cook_torrance(
    normal: ArrayLike,
    light: ArrayLike,
    *,
    roughness: float,
    f0: float = 1,
    shape: Shape | None = None,
    view: ArrayLike = VIEW,
    as_given: bool = False,
    **_,
) -> Floats:
    """F D G / (pi (N.L)(N.V)), G = min(1, 2 (N.H)(N.V)/(V.H), 2 (N.H)(N.L)/(V.H)); 0 where N.L or N.V <= 0."""
    normal, light, view, half = _direction(normal, as_given), unit(light), unit(view), halfway(light, view)
    nl, nv, nh, vh = dot(normal, light), dot(normal, view), dot(normal, half), dot(view, half)
    lit = (nl > 0) & (nv > 0)
    masked = 2 * nh * np.minimum(nl, nv) / np.where(vh > 0, vh, 1)
    slopes = shape(nh) / (4 * roughness**2) if shape else beckmann(nh, roughness)
    return np.where(lit, fresnel(vh, f0) * slopes * np.minimum(1, masked) / (pi * np.where(lit, nl * nv, 1)), 0)


def ward(
    normal: ArrayLike,
    light: ArrayLike,
    *,
    roughness: float,
    shape: Shape | None = None,
    view: ArrayLike = VIEW,
    as_given: bool = False,
    **_,
) -> Floats:
    """exp(-tan^2 g / m^2) / (4 pi m^2 sqrt((N.L)(N.V))), cos g = N.H; 0 where N.L or N.V <= 0."""
    normal, light, view = _direction(normal, as_given), unit(light), unit(view)
    nl, nv = dot(normal, light), dot(normal, view)
    lit = (nl > 0) & (nv > 0)
    nh = dot(normal, halfway(light, view))
    slopes = shape(nh) if shape else ward_lobe(nh, roughness)
    return np.where(lit, slopes / (4 * pi * roughness**2 * np.sqrt(np.where(lit, nl * nv, 1))), 0)


def _direction(normal: ArrayLike, as_given: bool) -> Floats:
    return np.asarray(normal, float) if as_given else unit(normal)


MODELS = {
    "blinn": blinn,
    "phong": phong,
    "lambert": lambert,
    "schlick": schlick,
    "cook-torrance": cook_torrance,
    "ward": ward,
}
"""Specular light by the name of its model; diffuse light is Lambert's in all of them."""


def light_channels(
    model: str,
    normal: ArrayLike,
    light: ArrayLike,
    shininess: float = 1,
    *,
    roughness: float = 0.3,
    f0: float = 1,
    scale: float = 1,
    cosine: bool = False,
    shape: Shape | None = None,
    view: ArrayLike = VIEW,
    as_given: bool = False,
) -> Floats:
    """(..., 2): diffuse (unclamped) and specular intensity at a normal.

    Specular light is multiplied by ``scale`` and, with ``cosine``, by max(0, N.L) (the modified rows of P3's table).
    ``golden.material.Material.channels`` fills these in.
    """
    facing = diffuse(normal, light, as_given=as_given)
    parameters = {"shininess": shininess, "roughness": roughness, "f0": f0, "shape": shape}
    specular = scale * MODELS[model](normal, light, **parameters, view=view, as_given=as_given)
    return np.stack([facing, specular * np.maximum(facing, 0) if cosine else specular], axis=-1)


# ---- energy ------------------------------------------------------------------------------------------------------

# integrand over the angle t of L from the normal: does the lobe see t/2, is it weighted with cos t
ROWS = {
    "phong": (False, False),
    "phong-modified": (False, True),
    "blinn": (True, False),
    "blinn-modified": (True, True),
    "blinn-ndf": (False, False),
    "blinn-height": (False, True),
}
"""The rows of P3's Table 1."""


def energy_scale(row: str, n: float, table: Literal["classic", "paper", "refit"] = "classic") -> float:
    """coef(n) of a row of P3's Table 1: coef times the lobe's integral over the hemisphere is 1.

    ``classic``: exactly, for cos^n. With u = cos(t/2), sin t dt = -4 u du; blinn: 4 (1 - 2^(-n/2-1)) / (n + 2);
    blinn-modified, cos t = 2 u^2 - 1: 4 (n + 2^(-n/2)) / ((n + 2)(n + 4)). ``paper``: what P3 fitted to its lobe for
    n in 16 .. 1024. ``refit``: the same with the two Blinn rows fitted over the whole hemisphere.

    >>> round(energy_scale("phong", 16) * 2 * pi, 12), round(energy_scale("phong", 16, "paper") * 2 * pi, 12)
    (17.0, 17.008)
    """
    half, weighted = ROWS[row]
    if table == "classic":
        if half and weighted:
            return (n + 2) * (n + 4) / (8 * pi * (n + 2 ** (-n / 2)))
        return (n + 2) / (8 * pi * (1 - 2 ** (-n / 2 - 1))) if half else (n + 1 + weighted) / (2 * pi)
    if not half:
        return (1.063 * n + weighted) / (2 * pi)
    slope, offset = {
        ("paper", False): (1.068, 0.96),
        ("paper", True): (1.027, 4.8),
        ("refit", False): (1.0621, 1.003),
        ("refit", True): (1.0593, 5.330),
    }[table, weighted]
    return (slope * n + offset) / (8 * pi)


def hemisphere(row: str, cosines: ArrayLike, values: ArrayLike) -> float:
    """2 pi times the integral of a row over t = 0 .. pi/2, of a lobe given by its values at ascending cosines.

    Simpson's rule between neighbouring cosines would ask for their middles: the lobe is taken as linear between them,
    its weight integrated exactly (blinn: weight 4 u du, else u du; times cos t with a weighted row).
    """
    half, weighted = ROWS[row]
    u, f = np.asarray(cosines, float), np.asarray(values, float)
    if half:
        keep = u >= sqrt(0.5)
        u, f = np.append(sqrt(0.5), u[keep]), np.append(np.interp(sqrt(0.5), u, f), f[keep])
    weight = np.polynomial.Polynomial([0, 4]) if half else np.polynomial.Polynomial([1])
    if weighted:
        weight *= np.polynomial.Polynomial([-1, 0, 2] if half else [0, 1])
    zeroth, first = weight.integ(), (weight * np.polynomial.Polynomial([0, 1])).integ()
    area, moment = np.diff(zeroth(u)), np.diff(first(u))
    slope = np.diff(f) / np.diff(u)
    return 2 * pi * float(np.sum((f[:-1] - slope * u[:-1]) * area + slope * moment))


# ---- planner -----------------------------------------------------------------------------------------------------


def sharpness(model: str, shininess: float = 1, roughness: float = 0.3) -> float:
    """The exponent of the cos^n that turns as fast as a model's highlight: what the planner multiplies 1 - c by.

    Phong's R.V turns twice as fast as the normal: 4 n. Cook-Torrance, Ward: exp(-tan^2 g / m^2) ~ cos^(2/m^2) g.
    Schlick: with s^2 = n g^2 / 2 it is 1/(1 + s^2) where cos^n g is exp(-s^2): the same curvature at the peak, but a
    fourth derivative of 24 instead of 12, which a cubic's error follows, and half the length takes it to a sixteenth:
    sqrt(2) n. Diffuse light counts as 2, and nothing counts less.
    """
    exponent = {
        "lambert": 2,
        "phong": 4 * shininess,
        "blinn": shininess,
        "schlick": sqrt(2) * shininess,
        "cook-torrance": 2 / roughness**2,
        "ward": 2 / roughness**2,
    }[model]
    return max(exponent, 2)


def kappa(model: str, first: ArrayLike, last: ArrayLike, shininess: float = 1, roughness: float = 0.3) -> Floats:
    """n (1 - c) of an arc between two normals, c the cosine of its angle, n the model's ``sharpness``."""
    return sharpness(model, shininess, roughness) * (1 - dot(unit(first), unit(last)))
