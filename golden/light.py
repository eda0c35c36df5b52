"""Light at a node: angles, lobes, reflectance, colours (papers P1 and P3). Mirrors ``rtl/light``.

Vectors as three arrays of components, S1.16 (18 bits); a unit vector has the length 65536. Every function takes
arrays of any shape, with broadcasting.
"""

from __future__ import annotations

from numpy.typing import ArrayLike

from golden import contract as k
from golden.fixed import ONE, Int, clamp, integers, limit, round
from golden.normal import dot3


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
