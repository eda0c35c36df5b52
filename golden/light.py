# SPDX-License-Identifier: Apache-2.0
"""Light at a node: angles, lobes, reflectance, colours (papers P1 and P3). Mirrors ``rtl/light``.

Vectors as three arrays of components, S1.16 (18 bits); a unit vector has the length 65536. Every function takes
arrays of any shape, with broadcasting.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from . import contract as k
from .fixed import ONE, Int, clamp, integers, limit, round, rsqrt, saturate
from .normal import dot3, normalize


def versine(
    ax: ArrayLike, ay, az, bx, by, bz, shift: ArrayLike = k.LOBE_FINE, form: int = k.FORM_REFINED
) -> tuple[Int, Int]:
    """(x, range): 1 - cos of the angle between two unit vectors, U2.26, and 1 where it was clamped (``shade_versine``).

    Refined: |a - b|^2 / 2, differences saturated to S1.16. Paper: 1 - a . b. Exact sum, rounded once, to nearest, ties
    up, to 20 + ``shift`` fraction bits, which a lobe of that shift takes (LOBE_FINE: 20); what is outside [0, 2], cut
    to 20 fraction bits, is clamped.

    >>> [int(v) for v in versine(0, 0, 65536, 39322, 0, 52429)]  # 0.2, cosine 0.8: 209718 / 2^20
    [13421952, 0]
    """
    *v, shift = integers(ax, ay, az, bx, by, bz, shift)
    a, b = v[:3], v[3:]
    if form == k.FORM_REFINED:
        total = sum(limit(p - q) ** 2 for p, q in zip(a, b, strict=True))
    else:
        total = ONE * ONE - sum(p * q for p, q in zip(a, b, strict=True))
    unused = k.VERSINE_CUT - np.where(shift == k.LOBE_FINE, 0, shift)
    drop = 2 * k.INTENSITY_F + (form == k.FORM_REFINED) - k.VERSINE_F + unused
    x = (total + (1 << drop - 1) >> drop) << unused
    clamped, outside = clamp(x >> k.VERSINE_CUT, k.VERSINE_F - k.VERSINE_CUT + 1)
    two = clamped >> k.VERSINE_F - k.VERSINE_CUT + 1  # it has no more bits
    return np.where(outside | two, clamped << k.VERSINE_CUT, x), outside


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
    """(x, y, z, vh): H = (L + V) / |L + V|, S1.16, and V.H, U1.16, clamped (``shade_halfway``).

    L + V saturates to S1.16, of unit vectors at (2, 0, 0) and its like alone. ``normalize``, then ``dot3``: H within
    5/8 ulp, V.H within 1.6 ulp for unit vectors. L = -V gives 0.

    >>> [int(v) for v in halfway(65536, 0, 0, 0, 0, 65536)]  # 0.7071, 0, 0.7071, cosine 0.7071
    [46341, 0, 46341, 46341]
    """
    v = integers(lx, ly, lz, vx, vy, vz)
    s = [limit(p + q) for p, q in zip(v[:3], v[3:], strict=True)]
    h = normalize(*s)
    return *h, clamp(dot3(*v[3:], *h))[0]


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


def geometry(
    model: ArrayLike, x: ArrayLike, nl, nv, vh=ONE, cosine=0, inv_n=ONE, inv_n_exp=0
) -> tuple[Int, Int, Int, Int]:
    """g = num (1 + w) 2^e, by which a model multiplies its lobe, and 1 for a zero denominator (``shade_geometry``).

    x U2.26 is the versine of the lobe; nh = 1 - x of x cut to U2.20, not below 0; nl, nv, vh U1.16:

        Phong, Blinn    1, with ``cosine`` nl
        Schlick         r / (x 2^inv_n_exp + r), r = nh inv_n: the rational lobe itself, 1/n = inv_n 2^-inv_n_exp
        Cook-Torrance   min(1, 2 nh nl / vh, 2 nh nv / vh) / (nl nv)
        Ward            1 / sqrt(nl nv)

    and 0 for all others and for zero denominators. num U1.16 in [0, 1], w S0.18 in [-1/2, 0]. r is rounded,
    x 2^inv_n_exp cut to 20 fraction bits, the denominator exact, its inverse within 2^-16 (relative).

    >>> num, w, e, zero = geometry(k.MODEL_WARD, 0, 16384, 65536)  # 1 / sqrt(1/4)
    >>> int(num) / 65536 * (1 + int(w) / 2**18) * 2.0 ** int(e)
    2.0
    """
    model, x, nl, nv, vh, cosine, inv_n, inv_n_exp = integers(model, x, nl, nv, vh, cosine, inv_n, inv_n_exp)
    schlick, cook, ward = (model == code for code in (k.MODEL_SCHLICK, k.MODEL_COOK_TORRANCE, k.MODEL_WARD))
    x_f = k.VERSINE_F - k.VERSINE_CUT
    nh = np.maximum(round((1 << x_f) - (x >> k.VERSINE_CUT), x_f - k.INTENSITY_F), 0)
    large, small = np.maximum(nl, nv), np.minimum(nl, nv)
    product = nh * np.where(schlick, inv_n, small)
    r = round(product, k.INTENSITY_F)
    masked = cook & (small > 0) & (2 * product < vh << k.INTENSITY_F)  # facets hide each other's light

    x = np.minimum(x, (2 << k.VERSINE_F) - 1)
    rational = (x << inv_n_exp >> k.VERSINE_CUT) + (r << x_f - k.INTENSITY_F)
    den = np.where(schlick, rational, large * np.where(masked, vh, small))
    zero = (schlick | cook | ward) & (den == 0)

    # 1/sqrt(den) = (1 + d) 2^-e, 1/den its square, twice that where it is below 1/2
    y, e = rsqrt(den)
    one = 1 << k.FACTOR_F
    d = np.where(zero, 0, round(y - (1 << k.RSQRT_F), k.RSQRT_F - k.FACTOR_F))
    square = 2 * d * one + d * d
    twice = square < -one * one // 2
    inverse = round(np.where(twice, 2 * square + one * one, square), k.FACTOR_F)

    den_f = np.where(schlick, x_f, 2 * k.INTENSITY_F)
    w = np.select([ward, schlick | cook], [d, inverse], 0)
    exponent = np.select([ward, schlick | cook], [den_f // 2 - e, den_f - 2 * e - twice + masked], 0)
    plain = (model == k.MODEL_PHONG) | (model == k.MODEL_BLINN)
    num = np.select([zero, schlick, masked, cook | ward, plain & (cosine == 1), plain], [0, r, nh, ONE, nl, ONE], 0)
    return num, w, exponent, zero.astype(np.int64)


def gain(lobe: ArrayLike, num, w, e, fresnel, gain, gain_exp) -> tuple[Int, Int]:
    """(lobe fresnel num (1 + w) gain 2^(e + gain_exp), saturated), S1.16 in [0, 2) (``shade_gain``).

    lobe, num, fresnel U1.16 in [0, 1], w S0.18, gain U1.16. gain (1 + w) is rounded to 16 fraction bits, the product of
    the first three cut to 32, the result rounded, to nearest, ties up. Sums of exponents beyond 31 count as 31.

    >>> [int(v) for v in gain(65536, 32768, 0, 0, 65536, 65536, 1)]  # 1 * 1/2 * 2
    [65536, 0]
    """
    lobe, num, w, e, fresnel, gain, gain_exp = integers(lobe, num, w, e, fresnel, gain, gain_exp)
    factor = gain + round(gain * w, k.FACTOR_F)
    product = (lobe * num * fresnel >> k.INTENSITY_F) * factor  # U2.48
    value = round(product >> np.clip(31 - e - gain_exp, 0, 63), 1)
    largest = (1 << k.INTENSITY_W - 1) - 1
    return np.minimum(value, largest), (value > largest).astype(np.int64)


def lobe(
    x: ArrayLike, k1: ArrayLike, k2: ArrayLike, shift: ArrayLike, xmax: ArrayLike, power: ArrayLike, stages: int = 4
) -> Int:
    """max(0, 1 - k1 x + k2 x^2)^(2^power), U1.16, of a versine x, U2.26; 0 for x > 1 (``shade_lobe``).

    X = min(x 2^shift, xmax), cut to U1.20, is what k1, U1.20, and k2, S0.17, belong to: those of x, divided by 2^shift
    and 4^shift. shift = LOBE_FINE: X = x, k1 and k2 are those of x times 4 (below 1/2 and 1/4). ``stages`` are built
    for the squarings (POWER): more than these count as these.

    y = s X with s = k1 - k2 X, U1.18, is 1 - base, U1.22, which is squared as y <- 2 y - y^2, from 1/2 on as
    y <- 1 - (1 - y)^2: always a number z < 1/2, of which 17 fraction bits and the middle of the rest are kept. Of X the
    first 17 fraction bits and the middle of the rest stand in s; of s X the products of last bits are cut to a few
    leading ones. Roundings to nearest, ties up. Within 1.5 ulp of the formula of these arguments, 1.2 for k2 >= 0, for
    registers as ``golden.material.lobe_registers`` gives them: xmax not beyond the vertex, the least shift.

    >>> int(lobe(1 << 23, 1 << 20, 1 << 15, 1, 131071, 4))  # k1 = 2, k2 = 1: (1 - 1/8)^32 = 0.0139, 914
    914
    """
    x, shift, xmax = integers(x, shift, xmax)
    fine = shift == k.LOBE_FINE
    scaled = x << np.where(fine, 0, shift) >> k.VERSINE_CUT
    scaled = np.minimum(scaled, xmax << k.LOBE_SCALED_F - k.LOBE_X_F)
    return lobe_scaled(scaled, x >> k.VERSINE_CUT > 1 << k.LOBE_SCALED_F, k1, k2, fine, power, stages)


def lobe_scaled(
    scaled: ArrayLike, dark: ArrayLike, k1: ArrayLike, k2: ArrayLike, fine: ArrayLike, power: ArrayLike, stages: int = 4
) -> Int:
    """:func:`lobe` behind its X, U1.20 (``shade_lobe_folded``); 0 where it is dark.

    >>> int(lobe_scaled(1 << 18, 0, 1 << 20, 1 << 15, 0, 4))
    914
    """
    scaled, dark, k1, k2, fine, power = integers(scaled, dark, k1, k2, fine, power)

    # k1 and the middle of what k2 is not multiplied by, 21 fraction bits
    middle = 2 * k1 - (k2 >> k.LOBE_K2_F + k.LOBE_SLOPE_F - k.LOBE_K1_F)
    product = k2 * (scaled >> k.LOBE_SCALED_F - k.LOBE_SLOPE_F)
    product_f = k.LOBE_K2_F + k.LOBE_SLOPE_F
    s = round((middle << product_f - k.LOBE_K1_F - 1) - product, product_f - k.LOBE_S_F)
    s = saturate(s, k.LOBE_S_F + 1)

    # s X of s = s' + the last bit and X = X' + the last four bits: s' X', and of the others what counts
    first, last = scaled >> k.LOBE_SCALED_F - k.LOBE_X_F, scaled & (1 << k.LOBE_SCALED_F - k.LOBE_X_F) - 1
    rows = (s >> k.LOBE_S_F - k.LOBE_ROW_F) * last  # LOBE_SCALED_F + LOBE_ROW_F = 27 fraction bits
    bit = (s & 1) * (first >> k.LOBE_X_F - k.LOBE_BIT_F)  # LOBE_S_F + LOBE_BIT_F = 22
    total_f = k.LOBE_S_F - 1 + k.LOBE_X_F
    total = (s >> 1) * first + (rows << total_f - k.LOBE_SCALED_F - k.LOBE_ROW_F)
    y = round(total + (bit << total_f - k.LOBE_S_F - k.LOBE_BIT_F), total_f - k.LOBE_F)

    one = 1 << k.LOBE_F
    y = np.where(dark, one, np.minimum(y >> np.where(fine, k.LOBE_FINE_F, 0), one))
    for stage in range(stages):
        high = y >= one >> 1
        z = np.where(high, np.maximum(one - 1 - y, 0), y) >> k.LOBE_F - k.LOBE_Z_F | 1
        drop = 2 * k.LOBE_Z_F - k.LOBE_F
        y = np.where(power > stage, round((np.where(high, one, 2 * y) << drop) - z * z, drop), y)
    return round(one - y, k.LOBE_F - k.INTENSITY_F)


Vector = Sequence[ArrayLike]
Registers = Mapping[str, ArrayLike]
LOBE = ("k1", "k2", "shift", "xmax", "power")
MATERIAL = ("model", "cosine", *LOBE, "inv_n", "inv_n_exp", "gain", "gain_exp")


def angles(
    mirror: ArrayLike, n: Vector, l: Vector, v: Vector, h: Vector, shift: ArrayLike = k.LOBE_FINE,  # noqa: E741
    form: int = k.FORM_REFINED,
) -> tuple[Int, ...]:  # fmt: skip
    """(diffuse, nl, nv, x, saturated, nl_range, nv_range, x_range) of unit vectors (``shade_angles``).

    diffuse = n.l, S1.16, saturated; nl, nv, U1.16: n.l, n.v clamped to [0, 1]; x, U2.26: 1 - r.v where ``mirror`` is
    set, else 1 - n.h (:func:`versine`); ``_range``: 1 for a cosine beyond [-1, 1].

    >>> z = (0, 0, 65536)
    >>> [int(i) for i in angles(0, z, z, z, z)]
    [65536, 65536, 65536, 0, 0, 0, 0, 0]
    """
    n, l, v, h = (integers(*vector) for vector in (n, l, v, h))  # noqa: E741
    nl, nv = dot3(*n, *l), dot3(*n, *v)
    a = (np.where(mirror, *pair) for pair in zip(reflect(*n, *l), n, strict=True))
    b = (np.where(mirror, *pair) for pair in zip(v, h, strict=True))
    x, x_range = versine(*a, *b, shift, form)
    diffuse = limit(nl)
    flags = (diffuse != nl, np.abs(nl) > ONE, np.abs(nv) > ONE, x_range)
    return diffuse, clamp(nl)[0], clamp(nv)[0], x, *(flag.astype(np.int64) for flag in flags)


def reflectance(
    n: Vector, l: Vector, v: Vector, h: Vector, vh: ArrayLike, f: ArrayLike, material: Registers,  # noqa: E741
    form: int = k.FORM_REFINED, phong: int = 1, divide: int = 1,
) -> tuple[Int, Int, Int]:  # fmt: skip
    """(diffuse, specular, flags) at normals n for light from l and a viewer at v (``shade_reflectance``).

    diffuse = n.l, S1.16, not clamped at 0; specular = gain f lobe(x) g, S1.16 in [0, 2), with the versine x of r, v
    (Phong) or of n, h, and g of :func:`geometry`. vh = v.h and Fresnel's factor f are U1.16, ``material`` the registers
    by name. ``phong`` = 0 leaves Phong out, ``divide`` = 0 Schlick, Cook-Torrance and Ward: these and reserved models
    give diffuse light alone; so do all but Phong where h = 0, as for l = -v (LIGHT_ZERO). Flags: bits LIGHT_*.

    >>> plain = dict.fromkeys(MATERIAL, 0) | {"model": k.MODEL_BLINN, "xmax": 65536, "gain": 65536}
    >>> z = (0, 0, 65536)
    >>> [int(i) for i in reflectance(z, z, z, z, 65536, 65536, plain)]
    [65536, 65536, 0]
    """
    code, cosine, *of_lobe, inv_n, inv_n_exp, mantissa, exponent = integers(*(material[i] for i in MATERIAL))
    left_out = [k.MODEL_PHONG] * (not phong) + [k.MODEL_SCHLICK, k.MODEL_COOK_TORRANCE, k.MODEL_WARD] * (not divide)
    refused = (code > k.MODEL_WARD) | np.isin(code, left_out)
    code = np.where(refused, k.MODEL_LAMBERT, code)

    shift = np.where(code == k.MODEL_SCHLICK, np.minimum(inv_n_exp, k.VERSINE_CUT), of_lobe[2])
    diffuse, nl, nv, x, saturated, nl_range, nv_range, x_range = angles(code == k.MODEL_PHONG, n, l, v, h, shift, form)
    hx, hy, hz = integers(*h)
    lost = (code > k.MODEL_PHONG) & ((hx | hy | hz) == 0)
    shape = np.select([lost, code == k.MODEL_SCHLICK], [0, ONE], lobe(x, *of_lobe))
    num, w, e, zero = geometry(code, x, nl, nv, vh, cosine, inv_n, inv_n_exp)
    specular, too_bright = gain(shape, num, w, e, f, mantissa, exponent)
    flags = {
        k.LIGHT_MODEL: refused,
        k.LIGHT_RANGE: nl_range | (x_range & (code != k.MODEL_LAMBERT)) | (nv_range & (code >= k.MODEL_SCHLICK)),
        k.LIGHT_ZERO: zero | lost,
        k.LIGHT_SATURATED: saturated | too_bright,
    }
    return diffuse, specular, sum(flag.astype(np.int64) << bit for bit, flag in flags.items())


def light(
    nx: ArrayLike, ny, nz, registers: Registers, form: int = k.FORM_REFINED, phong: int = 1, divide: int = 1
) -> tuple[Int, Int, Int]:
    """:func:`reflectance` with directional light and the viewer at infinity on the z axis (``shade_light``).

    ``registers`` of the material (``MATERIAL``) and of the light: l, h = (l + v)/|l + v| and vh = v.h, v = (0, 0, 1).
    Fresnel's factor belongs into the gain.
    """
    l, h = ([registers[v + c] for c in "xyz"] for v in "lh")  # noqa: E741
    return reflectance((nx, ny, nz), l, (0, 0, ONE), h, registers["vh"], ONE, registers, form, phong, divide)


def light_local(
    nx: ArrayLike, ny, nz, lx, ly, lz, vx, vy, vz, registers: Registers,
    form: int = k.FORM_REFINED, phong: int = 1, divide: int = 1,
) -> tuple[Int, Int, Int]:  # fmt: skip
    """:func:`reflectance` with light and viewer, unit vectors, of every node (``shade_light_local``).

    Beside ``MATERIAL`` the register f0 of Fresnel's factor.
    """
    l, v = (lx, ly, lz), (vx, vy, vz)  # noqa: E741
    *h, vh = halfway(*l, *v)
    f = fresnel(vh, registers["f0"])
    return reflectance((nx, ny, nz), l, v, h, vh, f, registers, form, phong, divide)
