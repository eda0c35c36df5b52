# SPDX-License-Identifier: Apache-2.0
"""Fixed-point steps that every unit shares: round, saturate, multiply, a third.

Mirrors ``rtl/fixed``. All arguments and results are ``int64`` arrays of any shape (or Python integers); x with f
fraction bits stands for x / 2^f.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from math import isqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import contract as k
from .contract import FORM_PAPER, FORM_REFINED

Int = NDArray[np.int64]
ONE = 1 << k.INTENSITY_F  # 1.0 in S1.16


def integers(*values: ArrayLike) -> tuple[Int, ...]:
    """The arguments as int64 arrays of one shape. TypeError for anything that is not an integer."""
    arrays = [np.asarray(value) for value in values]
    for array in arrays:
        if array.dtype.kind not in "iub":
            raise TypeError(f"integers expected, not {array.dtype}")
    return tuple(np.broadcast_arrays(*(array.astype(np.int64) for array in arrays)))


def round(x: ArrayLike, drop: int) -> Int:
    """floor(x / 2^drop + 1/2): drop fraction bits, to nearest, ties towards plus infinity (``shade_round``).

    >>> [int(round(x, 2)) for x in (5, 6, -6, -7)]
    [1, 2, -1, -2]
    """
    (x,) = integers(x)
    return (x + (1 << drop >> 1)) >> drop


def saturate(x: ArrayLike, out_w: int) -> Int:
    """min(max(x, 0), 2^out_w - 1) (``shade_saturate``).

    >>> [int(saturate(x, 4)) for x in (-1, 7, 15, 16)]
    [0, 7, 15, 15]
    """
    (x,) = integers(x)
    return np.clip(x, 0, (1 << out_w) - 1)


def limit(x: ArrayLike, out_w: int = k.INTENSITY_W) -> Int:
    """min(max(x, -2^(out_w - 1)), 2^(out_w - 1) - 1): into a signed number of out_w bits (``shade_limit``).

    >>> [int(limit(x, 4)) for x in (-9, -8, 7, 8)]
    [-8, -8, 7, 7]
    """
    (x,) = integers(x)
    return np.clip(x, -1 << out_w - 1, (1 << out_w - 1) - 1)


def wrap(value: Int, width: int) -> Int:
    """What a signed register of so many bits makes of a number."""
    half = 1 << width - 1
    return ((value + half) & ((1 << width) - 1)) - half


def mul(a: ArrayLike, b: ArrayLike) -> Int:
    """a b, exact (``shade_mul``).

    >>> int(mul(-3, 5))
    -15
    """
    a, b = integers(a, b)
    return a * b


def third(x: ArrayLike, form: int = FORM_REFINED) -> Int:
    """x / 3 in the format of x (``shade_third``).

    Refined: the integer nearest to x / 3; there are no ties. Paper: x/2 - x/8 - x/32 - x/128 = 43 x / 128 (P1,
    Fig. 7), rounded once to nearest, ties up.

    >>> int(third(100)), int(third(-100)), int(third(100, FORM_PAPER)), int(third(-100, FORM_PAPER))
    (33, -33, 34, -34)
    """
    (x,) = integers(x)
    if form == FORM_PAPER:
        return round(64 * x - 16 * x - 4 * x - x, 7)
    return (2 * x + 3) // 6


def clamp(x: ArrayLike, f: int = k.INTENSITY_F) -> tuple[Int, Int]:
    """(min(max(x, 0), 1), 1 where that changed x), x with f fraction bits (``shade_clamp``).

    >>> [[int(v) for v in clamp(x)] for x in (-1, 65536, 65537)]
    [[0, 1], [65536, 0], [65536, 1]]
    """
    (x,) = integers(x)
    y = np.clip(x, 0, 1 << f)
    return y, (y != x).astype(np.int64)


def square(x: ArrayLike) -> Int:
    """x^2, exact (``shade_square``).

    >>> int(square(-3))
    9
    """
    (x,) = integers(x)
    return x * x


def weigh(
    k0: int, kx: int, x: ArrayLike, ky: int = 0, y: ArrayLike = 0, kz: int = 0, z: ArrayLike = 0, *, f: int, out_f: int
) -> Int:
    """K0 + KX x + KY y + KZ z, constants of 16 fraction bits, rounded once to nearest, ties up (``shade_weigh``).

    x, y, z have f fraction bits, the result out_f.

    >>> int(weigh(49152, 16384, 1 << 17, f=18, out_f=16)) / 65536  # 3/4 + 1/4 * 1/2
    0.875
    """
    x, y, z = integers(x, y, z)
    return round((k0 << f) + kx * x + ky * y + kz * z, f + k.CONSTANT_F - out_f)


@cache
def rsqrt_table() -> Int:
    """(128, 3): c0, c1, c2 of the parabola c0 + c1 d + c2 d^2 for 1/sqrt(m) on [i/32, (i + 1)/32), d = m - middle.

    Through the three Chebyshev nodes of each segment, in exact fractions (60 bits of each root). Rows below 32 (m < 1)
    are 0: they are met by the argument 0 only.
    """
    bits = 60
    half = Fraction(1, 64)
    node = half * Fraction(866025403784438647, 10**18)  # cos 30 degrees

    def root(m: Fraction) -> Fraction:
        return Fraction(isqrt((m.denominator << 2 * bits) // m.numerator), 1 << bits)

    table = np.zeros((1 << k.RSQRT_INDEX_W, 3), np.int64)
    for i in range(32, 128):
        middle = Fraction(2 * i + 1, 64)
        low, centre, high = (root(middle + d) for d in (-node, Fraction(0), node))
        c1, c2 = (high - low) / (2 * node), (high - 2 * centre + low) / (2 * node * node)
        fractions = zip((centre, c1, c2), (k.RSQRT_C0_F, k.RSQRT_C1_F, k.RSQRT_C2_F), strict=True)
        table[i] = [int((c * (1 << f) + Fraction(1, 2)).__floor__()) for c, f in fractions]
    return table


def rsqrt_rom(i: ArrayLike) -> Int:
    """Row i of the table in 51 bits: c0 with the half ulp of the result, c1, c2 (``shade_rsqrt_rom``).

    >>> [hex(row) for row in rsqrt_rom([31, 32])]
    ['0x0', '0x7f02fb05dbdc6']
    """
    (i,) = integers(i)
    c0, c1, c2 = np.moveaxis(rsqrt_table()[i], -1, 0)
    upper = c0 + (1 << k.RSQRT_C0_F - k.RSQRT_F - 1) << k.RSQRT_C1_F | c1 & (1 << k.RSQRT_C1_F) - 1
    return np.where(c0 > 0, upper << k.RSQRT_C2_W | c2, 0)


def rsqrt(z: ArrayLike) -> tuple[Int, Int]:
    """(y, e) with 1/sqrt(z) = y 2^-20 2^-e for an integer z, 1 <= z < 2^36; (0, 0) for 0 (``shade_rsqrt``).

    z = m 2^(2 e) with m in [1, 4); y is U1.20 in (1/2, 1], by a table of parabolas. Error below 1 ulp of y.

    >>> [int(v) for v in rsqrt(1 << 32)]  # 2^-16
    [1048576, 16]
    """
    (z,) = integers(z)
    pairs = sum((z >> 2 * i > 0).astype(np.int64) for i in range(k.RSQRT_W // 2))
    e = np.maximum(pairs - 1, 0)
    m = z << (k.RSQRT_W - 2 - 2 * e)  # U2.34
    rest = k.RSQRT_W - k.RSQRT_INDEX_W
    c0, c1, c2 = np.moveaxis(rsqrt_table()[m >> rest], -1, 0)
    d = (m >> (k.RSQRT_W - 2 - k.RSQRT_D_F) & ((1 << 18) - 1)) - (1 << 17)
    s = c1 + round(c2 * d, k.RSQRT_C2_F + k.RSQRT_D_F - k.RSQRT_C1_F)
    inner = k.RSQRT_C1_F + k.RSQRT_D_F
    y = round((c0 << inner - k.RSQRT_C0_F) + s * d, inner - k.RSQRT_F)
    return y, e
