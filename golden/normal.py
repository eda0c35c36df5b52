# SPDX-License-Identifier: Apache-2.0
"""Normals: unit vectors, and what saves computing them (papers P2 and P4). Mirrors ``rtl/normal``.

Vectors as three arrays of components, S1.16 (18 bits); a unit vector has the length 65536. Every function takes
arrays of any shape, with broadcasting.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from . import contract as k
from .fixed import ONE, Int, clamp, integers, limit, round, rsqrt, weigh, wrap
from .stream import walk
from .types import SPAN, pack


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


def dot3(ax: ArrayLike, ay, az, bx, by, bz, f: int = k.INTENSITY_F) -> Int:
    """a . b, S4.f, the exact sum of three products rounded once, to nearest, ties up (``shade_dot3``).

    >>> int(dot3(39322, 0, 52429, 0, 0, 65536)) / 65536  # (0.6, 0, 0.8) . (0, 0, 1)
    0.8000030517578125
    """
    ax, ay, az, bx, by, bz = integers(ax, ay, az, bx, by, bz)
    return round(ax * bx + ay * by + az * bz, 2 * k.INTENSITY_F - f)


def half(c: ArrayLike, form: int = k.FORM_REFINED) -> Int:
    """cos(psi/2), S1.16, from c = cos psi in [0, 1] (``shade_half``).

    Refined: 1 - u/4 - 17 u^2/512 - 5 u^4/512 with u = 1 - c. Paper: P4's d2, 0.25 c + 0.75 where c > cos(pi/4), else
    0.305 c + 0.712. Both rounded once, to nearest, ties up; powers are cut to 18 fraction bits before (u^2 to 16 before
    it is squared).

    >>> int(half(65536)), int(half(32768)), int(half(32768, k.FORM_PAPER))  # cos 30 degrees: 56756
    (65536, 56760, 56656)
    """
    (c,) = integers(c)
    if form == k.FORM_REFINED:
        return _anchored(k.D2_NEAR_0, k.D2_NEAR_C, k.HALF_UU, k.HALF_UUUU, c, k.INTENSITY_F)
    near, far = _weigh(k.D2_NEAR_0, k.D2_NEAR_C, c), _weigh(k.D2_FAR_0, k.D2_FAR_C, c)
    return np.where(c > k.D2_LIMIT, near, far)


def invc(c: ArrayLike, form: int = k.FORM_REFINED, degree: int = 2) -> tuple[Int, Int, Int]:
    """(InvC, cos(psi/2), 1 where c was clamped to [0, 1]) of c = cos psi, S1.16 (``shade_invc``).

    InvC = 1/sqrt(2 (1 + c)), U0.18. Refined: 1/2 + u/8 + 3390 u^2/2^16 + 1988 u^4/2^16 with u = 1 - c, within 1.6e-4
    (relative). Paper: 0.683 - 0.191 c or 0.703 - 0.3 c + 0.098 c^2. Cosine of the half angle, S1.16: ``half``. Powers
    are cut to 18 fraction bits (u^2 to 16 before it is squared), the results rounded once, to nearest, ties up.

    >>> [int(v) for v in invc(65536)], [int(v) for v in invc(65536, k.FORM_PAPER)]  # 1/2 exactly, 0.501
    ([131072, 65536, 0], [131336, 65536, 0])
    """
    c, clamped = clamp(c)
    if form == k.FORM_REFINED:
        value = _anchored(k.INVC_0, k.INVC_C, k.INVC_UU, k.INVC_UUUU, c, k.INVC_F)
    elif degree == 2:
        value = _weigh(k.INVC2_0, k.INVC2_C, c, k.INVC2_CC, c**2, out_f=k.INVC_F)
    else:
        value = _weigh(k.INVC1_0, k.INVC1_C, c, out_f=k.INVC_F)
    return value, half(c, form), clamped


def _anchored(k0: int, k1: int, k2: int, k4: int, c: Int, out_f: int) -> Int:
    """K0 + K1 c + K2 u^2 + K4 u^4 with u = 1 - c."""
    square = (ONE - c) ** 2
    return _weigh(k0, k1, c, k2, square, k4, (square >> k.INTENSITY_F) ** 2, out_f)


def _weigh(
    k0: int, k1: int, c: Int, k2: int = 0, square: ArrayLike = 0, k4: int = 0, fourth: ArrayLike = 0,
    out_f: int = k.INTENSITY_F,
) -> Int:  # fmt: skip
    """K0 + K1 c + K2 square + K4 fourth: c with 16 fraction bits, the powers with 32, of which 18 are kept."""
    c, square, fourth = integers(c, square, fourth)
    align, cut = k.SQUARE_F - k.INTENSITY_F, 2 * k.INTENSITY_F - k.SQUARE_F
    return weigh(k0, k1, c << align, k2, square >> cut, k4, fourth >> cut, f=k.SQUARE_F, out_f=out_f)


def scale3(x: ArrayLike, y, z, s, gain: int = 0) -> tuple[Int, Int, Int]:
    """v s 2^gain, S1.16, for s U0.18 in [0, 1), each component rounded to nearest, ties up (``shade_scale3``).

    >>> [int(v) for v in scale3(65536, -65536, 32768, 131072)]  # s = 1/2
    [32768, -32768, 16384]
    """
    x, y, z, s = integers(x, y, z, s)
    return tuple(round(v * s, k.INVC_F - gain) for v in (x, y, z))


def unit(x: ArrayLike, y, z, bypass: ArrayLike = 0) -> tuple[Int, ...]:
    """(nx, ny, nz, zero, short): v / |v|, S1.16, of a vector S2.15 with |v| >= 1/8; or v as it is (``shade_unit``).

    1/|v| = r 2^(15-e) of ``rsqrt``; v is shifted by 15 - e, at most to 8 v (rounded to 18 bits where it is halved), r
    is rounded to U0.18, the product to S1.16. Shorter vectors, ``short``, stay too short; 0, ``zero``, stays 0.
    ``bypass``: no normalization (P2), v saturated to S1.16.

    >>> [int(v) for v in unit(9830, 0, 13107)]  # (0.3, 0, 0.4)
    [39321, 0, 52429, 0, 0]
    """
    x, y, z, bypass = integers(x, y, z, bypass)
    r, e = rsqrt(x * x + y * y + z * z)
    shift = np.where(bypass, 1, np.clip(k.NODE_F - e, -2, 3))
    s = np.where(bypass, 1 << k.INVC_F - 1, np.minimum(round(r, k.RSQRT_F - k.INVC_F), (1 << k.INVC_F) - 1))
    shifted = (limit(round(c << shift + 2, 2)) for c in (x, y, z))
    zero, short = (x | y | z) == 0, e < k.NODE_F - 3
    return *scale3(*shifted, s, gain=1), zero.astype(np.int64), short.astype(np.int64)


def bisect(ax: ArrayLike, ay, az, bx, by, bz, s) -> tuple[Int, Int, Int]:
    """(a + b) s for s = InvC, U0.18; a + b saturates to S1.16 (``shade_bisect``).

    +2, which alone of the sums of unit normals is too large, becomes 2 - 2^-16; its half is 1 again.

    >>> [int(v) for v in bisect(65536, 0, 0, 65536, 0, 0, 131072)]
    [65536, 0, 0]
    """
    ax, ay, az, bx, by, bz, s = integers(ax, ay, az, bx, by, bz, s)
    limit = 1 << k.INTENSITY_W - 1
    return scale3(*(np.clip(a + b, -limit, limit - 1) for a, b in ((ax, bx), (ay, by), (az, bz))), s)


def midpoint(ax: ArrayLike, ay, az, bx, by, bz, c, form: int = k.FORM_REFINED, degree: int = 2) -> tuple[Int, ...]:
    """(x, y, z, cos(psi/2), clamped): the unit normal in the middle of two whose cosine is c (``shade_midpoint``).

    n = (a + b) InvC(c). Refined: its length is 1 within 2 ulp for equal unit normals, within 1.7e-4 for others.

    >>> [int(v) for v in midpoint(0, 32768, 56756, 0, -32768, 56756, 32768)]  # 60 degrees, the true one (0, 0, 65536)
    [0, 0, 65534, 56760, 0]
    """
    s, h, clamped = invc(c, form, degree)
    return *bisect(ax, ay, az, bx, by, bz, s), h, clamped


def node_chain(ax: ArrayLike, ay, az, bx, by, bz, c, form: int = k.FORM_REFINED, degree: int = 2) -> tuple[Int, ...]:
    """The normals at 0, 1/4, 1/2, 3/4, 1 of an arc, 15 components, and 1 where c was clamped (``shade_node_chain``).

    Two midpoint steps in a row: the cosine of the half angle is the c of the second. Refined: within 2.5e-4 of the
    exact points of the arc for c >= 1/2.

    >>> [int(v) for v in node_chain(65536, 0, 0, 32768, 0, 56756, 32768)[3:9]]  # 60 degrees: at 15 and at 30
    [63307, 0, 16963, 56754, 0, 32767]
    """
    *a, c = integers(ax, ay, az, bx, by, bz, c)
    a, b = a[:3], a[3:]
    *middle, h, clamped = midpoint(*a, *b, c, form, degree)
    s = invc(h, form, degree)[0]
    return *a, *bisect(*a, *middle, s), *middle, *bisect(*middle, *b, s), *b, clamped


def metric(c: ArrayLike, m: ArrayLike, threshold: ArrayLike = k.METRIC_THRESHOLD) -> tuple[Int, ...]:
    """(d1a, d2, d1a < threshold, d2 < threshold, c clamped, m outside 3 .. 12, threshold clamped) (``shade_metric``).

    d1a = 0.06 c + 0.007 m + 0.894 estimates cos(x/m), d2 (``half``, the paper's form) cos(x/2), c = cos x. S1.16,
    rounded once to nearest, ties up. m is an integer, clamped to 3 .. 12; c and the threshold, S1.16, to [0, 1].

    >>> [int(v) for v in metric(32768, 4)]  # 0.952, 0.8645
    [62391, 56656, 0, 1, 0, 0, 0]
    """
    c, m, threshold = integers(c, m, threshold)
    (c, clamped), (threshold, threshold_error) = clamp(c), clamp(threshold)
    valid = np.clip(m, k.METRIC_M_MIN, k.METRIC_M_MAX)
    d1a = weigh(k.D1_0, k.D1_C, c, k.D1_M, valid << k.INTENSITY_F, f=k.INTENSITY_F, out_f=k.INTENSITY_F)
    d2 = half(c, k.FORM_PAPER)
    flags = (d1a < threshold, d2 < threshold, clamped, m != valid, threshold_error)
    return d1a, d2, *(flag.astype(np.int64) for flag in flags)


def increment(first: ArrayLike, line: ArrayLike, n: ArrayLike, g: ArrayLike, l: ArrayLike) -> Int:  # noqa: E741
    """One component of interpolated normals, S1.16, step by step (``shade_increment``).

    Arrays (rows,): where ``first`` is set, P = L = n; else where ``line`` is, P = L = L + l; else P = P + g. n, g, l
    and the sums are S2.29 and wrap; P is rounded to nearest, ties up. The first row must be a first one.

    >>> one, eighth = 1 << 29, 1 << 26
    >>> increment([1, 0, 0], [0, 0, 0], one, eighth, 0).tolist()
    [65536, 73728, 81920]
    """
    return round(increment_sum(first, line, n, g, l), k.STEP_F - k.INTENSITY_F)


def increment_sum(first: ArrayLike, line: ArrayLike, n: ArrayLike, g: ArrayLike, l: ArrayLike) -> Int:  # noqa: E741
    """P of ``increment`` before it is rounded, S2.29."""
    first, line, n, g, l = integers(first, line, n, g, l)  # noqa: E741
    first, line = first.astype(bool), line.astype(bool)
    row = np.arange(len(first))
    triangle = np.maximum.accumulate(np.where(first, row, 0))  # row in which the triangle of each row began
    start = np.maximum.accumulate(np.where(first | line, row, 0))  # and its line
    lines = np.cumsum(np.where(line & ~first, l, 0))
    pixels = np.cumsum(np.where(first | line, 0, g))
    position = n[triangle] + (lines - lines[triangle]) + (pixels - pixels[start])
    return wrap(position, k.STEP_W)


def factor(a: ArrayLike, b: ArrayLike, middle: ArrayLike, variant, needs_d1, threshold) -> Int:
    """What a + b is multiplied by to get the normal in the middle of a and b, U0.18 (``shade_factor``).

    ``a``, ``b`` (3, ...): unit normals. ``middle`` 0, variants V3, V6, and V1 to V5 where no estimate is below the
    threshold: 1/2.

    >>> int(factor((0, 0, 65536), (0, 0, 65536), 1, k.VARIANT_REFINED, 0, 0))
    131072
    """
    middle, variant, needs_d1, threshold = integers(middle, variant, needs_d1, threshold)
    c = dot3(*a, *b)
    needs_d2 = metric(c, k.METRIC_M_MIN, threshold)[3].astype(bool)
    first_degree, second_degree = (invc(c, k.FORM_PAPER, degree)[0] for degree in (1, 2))
    factors = {
        k.VARIANT_REFINED: (True, invc(c)[0]),
        k.VARIANT_V1: (needs_d1 > 0, first_degree),
        k.VARIANT_V2: (needs_d1 > 0, second_degree),
        k.VARIANT_V4: (needs_d2, first_degree),
        k.VARIANT_V5: (needs_d2, second_degree),
    }
    cases = [(middle > 0) & (variant == code) & needed for code, (needed, _) in factors.items()]
    return np.select(cases, [value for _, value in factors.values()], 1 << k.INVC_F - 1)  # 1/2: (E + E) / 2 = E


def pixel_normals(
    n: ArrayLike, g: ArrayLike, count: ArrayLike, cosine: ArrayLike, variant: ArrayLike, threshold: ArrayLike
) -> tuple[Int, Int]:
    """Unit normals of a sequence of lines: ((P, 3) S1.16, index of their line (P,)) (``shade_pixel_normals``).

    ``n``, ``g`` (S, 3), S2.29: normal of the first pixel and increment; ``count`` (S,) pixels; ``cosine`` (S,) of the
    line's ends, S1.16; ``variant``, ``threshold`` (S,) or one for all. Pixels 0, 2, 4, ... and the last one are
    normalized, the others are the middle of their neighbours times the variant's factor.

    >>> pixel_normals([[0, 0, 1 << 29]], [[0, 0, 0]], [2], [65536], k.VARIANT_V3, 0)[0].tolist()
    [[0, 0, 65536], [0, 0, 65536]]
    """
    n, g = integers(n, g)
    count, cosine, variant, threshold = integers(count, cosine, variant, threshold)
    line, j = walk(count)
    variant, limit = variant[line], threshold[line]

    def exact(i: Int) -> tuple[Int, Int, Int]:
        vector = wrap(n[line] + i[:, None] * g[line], k.STEP_W)
        return normalize(*np.moveaxis(wrap(round(vector, k.STEP_F - k.INTENSITY_F), k.INTENSITY_W), -1, 0))

    middle = (j % 2 == 1) & (j < count[line] - 1) & (variant != k.VARIANT_EXACT)
    a, b = exact(j - middle), exact(j + middle)
    needs_d1 = metric(cosine, count - 1, threshold)[2][line]
    s = factor(a, b, middle, variant, needs_d1, limit)
    return np.stack(bisect(*a, *b, s), axis=-1), line


def line_errors(count: ArrayLike, variant: ArrayLike, threshold: ArrayLike) -> tuple[Int, Int]:
    """(d1a asked for with fewer than 3 sectors or more than 12, threshold outside [0, 1]): both are clamped."""
    count, variant, threshold = integers(count, variant, threshold)
    *_, m_error, threshold_error = metric(0, count - 1, threshold)
    return m_error & ((variant == k.VARIANT_V1) | (variant == k.VARIANT_V2)), threshold_error


def pack_spans(
    n: ArrayLike, g: ArrayLike, count: ArrayLike, cosine: ArrayLike, tag: ArrayLike = 0, flat: ArrayLike = 0
) -> np.ndarray:
    """Spans as beats of ``s_axis_line_tdata``, or ``s_axis_span_tdata``: (S, 8) uint32. Layout: golden.types."""
    parts = {
        f"{name}.{axis}": v
        for name, rows in (("normal", n), ("increment", g))
        for axis, v in zip("xyz", integers(rows)[0].T, strict=True)
    }
    return pack(SPAN, parts | {"count": count, "tag": tag, "cosine": cosine, "flat": flat})
