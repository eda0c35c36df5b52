"""Normals: unit vectors, and what saves computing them (papers P2 and P4). Mirrors ``rtl/normal``.

Vectors as three arrays of components, S1.16 (18 bits); a unit vector has the length 65536. Every function takes
arrays of any shape, with broadcasting.
"""

from __future__ import annotations

from numpy.typing import ArrayLike

from golden import contract as k
from golden.fixed import Int, integers, round, rsqrt


def normalize(x: ArrayLike, y: ArrayLike, z: ArrayLike) -> tuple[Int, Int, Int]:
    """v / |v|, S1.16, of a vector of any length; 0 for 0 (``shade_normalize``).

    1/|v| comes from ``rsqrt`` of the exact sum of squares: a mantissa r, U1.20 within 1 ulp, and the exponent e of |v|.
    v is scaled to 2^(17-e) v < 2^18, so that short vectors lose nothing; one rounding, to nearest, ties up. Each
    component is within 5/8 ulp of the exact one.

    >>> [int(c) for c in normalize(3, 0, 4)]  # 0.6, 0, 0.8
    [39322, 0, 52429]
    """
    x, y, z = integers(x, y, z)
    r, e = rsqrt(x * x + y * y + z * z)
    return tuple(round((c << 17 - e) * r, k.RSQRT_F + 1) for c in (x, y, z))
