"""Light at a node: angles, lobes, reflectance, colours (papers P1 and P3). Mirrors ``rtl/light``.

Vectors as three arrays of components, S1.16 (18 bits); a unit vector has the length 65536. Every function takes
arrays of any shape, with broadcasting.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from golden import contract as k
from golden.fixed import ONE, Int, clamp, integers, limit, round, saturate
from golden.normal import dot3, normalize


def versine(ax: ArrayLike, ay, az, bx, by, bz, form: int = k.FORM_REFINED) -> tuple[Int, Int]:
    """(x, range): 1 - cos of the angle between two unit vectors, U2.20, and 1 where it was clamped (``shade_versine``).

    Refined: |a - b|^2 / 2, differences saturated to S1.16. Paper: 1 - a . b. Exact sum, rounded once, to nearest, ties
    up, then clamped to [0, 2].

    >>> [int(v) for v in versine(0, 0, 65536, 39322, 0, 52429)]  # 0.2, cosine 0.8
    [209718, 0]
    """
    v = integers(ax, ay, az, bx, by, bz)
    a, b = v[:3], v[3:]
    if form == k.FORM_REFINED:
        chord = sum(limit(p - q) ** 2 for p, q in zip(a, b, strict=True))
        x = round(chord, 2 * k.INTENSITY_F + 1 - k.VERSINE_F)
    else:
        dot = sum(p * q for p, q in zip(a, b, strict=True))
        x = round(ONE * ONE - dot, 2 * k.INTENSITY_F - k.VERSINE_F)
    return clamp(x, k.VERSINE_F + 1)


def reflect(nx: ArrayLike, ny, nz, lx, ly, lz) -> tuple[Int, Int, Int]:
    """R = 2 (N.L) N - L, S1.16, saturated (``shade_reflect``).

    2 N.L is rounded to 16 fraction bits and limited to (-2, 2]; one more rounding, both to nearest. Within 1 ulp for
    unit vectors; R = N where L = N.

    >>> [int(v) for v in reflect(0, 0, 65536, 39322, 0, 52429)]  # -0.6, 0, 0.8
    [-39322, 0, 52429]
    """
    v = integers(nx, ny, nz, lx, ly, lz)
    n, l = v[:3], v[3:]  # noqa: E741
    m = limit(-dot3(*n, *l, f=k.INTENSITY_F + 1))
    return tuple(limit(round(-m * p - (q << k.INTENSITY_F), k.INTENSITY_F)) for p, q in zip(n, l, strict=True))


def halfway(lx: ArrayLike, ly, lz, vx, vy, vz) -> tuple[Int, ...]:
    """(x, y, z, vh, zero): H = (L + V) / |L + V|, S1.16, V.H, U1.16, clamped, 1 where L = -V (``shade_halfway``).

    L + V saturates to S1.16, of unit vectors at (2, 0, 0) and its like alone. ``normalize``, then ``dot3``: H within
    5/8 ulp, V.H within 1.6 ulp for unit vectors. L = -V gives 0.

    >>> [int(v) for v in halfway(65536, 0, 0, 0, 0, 65536)]  # 0.7071, 0, 0.7071, cosine 0.7071
    [46341, 0, 46341, 46341, 0]
    """
    v = integers(lx, ly, lz, vx, vy, vz)
    s = [limit(p + q) for p, q in zip(v[:3], v[3:], strict=True)]
    h = normalize(*s)
    zero = (s[0] | s[1] | s[2]) == 0
    return *h, clamp(dot3(*v[3:], *h))[0], zero.astype(np.int64)


def fresnel(c: ArrayLike, f0: ArrayLike) -> Int:
    """F0 + (1 - F0)(1 - c)^5, Schlick's form of Fresnel's factor, U1.16 (``shade_fresnel``).

    c = V.H and F0, the reflectance at c = 1, are U1.16; what is above 1 counts as 1. u = 1 - c; u^2, u^4, u^5 are
    rounded to 18 fraction bits, u^2 to at most 1 - 2^-18, the result once more: within 1 ulp, exact for c = 0 and 1.

    >>> [int(v) for v in fresnel([65536, 32768, 0], 2621)]  # 0.04, 0.07, 1
    [2621, 4587, 65536]
    """
    c, f0 = (np.minimum(v, ONE) for v in integers(c, f0))
    u = ONE - c
    squared = np.minimum(round(u * u, 2 * k.INTENSITY_F - k.FRESNEL_F), (1 << k.FRESNEL_F) - 1)
    fourth = round(squared * squared, k.FRESNEL_F)
    fifth = round(u * fourth, k.INTENSITY_F)
    return round((f0 << k.FRESNEL_F) + (ONE - f0) * fifth, k.FRESNEL_F)


def colour(diffuse: ArrayLike, specular: ArrayLike, ambient: ArrayLike, kd: ArrayLike, ks: ArrayLike) -> Int:
    """ambient + kd max(0, diffuse) + ks max(0, specular), U0.16: a colour channel of a pixel (``shade_colour``).

    Light S1.16, weights U1.16. Exact sum, rounded once, to nearest, ties up, saturated to [0, 1 - 2^-16].

    >>> colour(32768, 16384, [6554, 6554, 0], [65536, 32768, 0], 65536).tolist()  # 0.1 + 1/2 + 1/4, 0.1 + 1/2, 1/4
    [55706, 39322, 16384]
    """
    diffuse, specular, ambient, kd, ks = integers(diffuse, specular, ambient, kd, ks)
    total = (ambient << k.INTENSITY_F) + kd * np.maximum(diffuse, 0) + ks * np.maximum(specular, 0)
    return saturate(round(total, k.INTENSITY_F), k.PIXEL_W)
