# SPDX-License-Identifier: Apache-2.0
"""The direct form: light at every pixel from scalars that additions step, without a normal (``rtl/surface``).

A directional light and viewer ask for N.L, N.H and N.N alone. Along a triangle N is linear, so that the first two are
linear and the last is quadratic in column i and line j (P4's constant increment): with N = n + i c + j l,

    a = N.L,  h = N.H,  P = N.N = p + i p_c + j p_l + i^2 p_cc + j^2 p_ll + i j p_cl

:func:`setup` makes the coefficients, cut to fixed formats; from there on additions are exact. Then, at the pixel,

    rho = 1/sqrt(P) - 1,  diffuse = a + a rho,  y = 1 - h,  x = 1 - cos = y - rho + y rho,  specular = lobe(x)

without cancellation where the highlight is: y and rho are small there. The lobe is a table of chords, of any shape.
(Duff 1979 and Bishop and Weimer 1986 stepped such scalars in floating point.)
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from math import isqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import contract as k
from . import types
from .fixed import Int, integers, limit, saturate, wrap
from .stream import walk

VECTOR_F = 2 * k.INTENSITY_F  # fraction bits of a product of two components


class Coefficients(NamedTuple):
    """Of a, h and P, (...,): value at the reference pixel and growth per column and line; see :func:`setup`."""

    a: Int
    a_column: Int
    a_line: Int
    h: Int
    h_column: Int
    h_line: Int
    p: Int
    p_column: Int
    p_line: Int
    p_columns: Int
    p_lines: Int
    p_both: Int


def dot_scaled(v: ArrayLike, w: ArrayLike, shift: ArrayLike) -> Int:
    """2 (v . w) / 2^shift of vectors (..., 3) S1.16, S1.36, modulo 4, the rest cut (``shade_dot_scaled``).

    >>> int(dot_scaled([0, 0, 65536], [0, 0, 65536], 1)) / 2**36
    1.0
    """
    (v, w), (shift,) = integers(v, w), integers(shift)
    return wrap((v * w).sum(axis=-1) << k.DIRECT_P_F + 1 - VECTOR_F >> shift, k.PATCH_SCALAR_W)


def setup(normal: ArrayLike, dcolumn, dcolumn_exp, dline, dline_exp, light, half) -> Coefficients:
    """Coefficients from vectors (..., 3) S1.16; increments are divided by 2^exp (``shade_direct_setup``).

    a S1.24, h S1.28, P U1.36, sums of exact products, shifted, what is shifted out is cut; all modulo their widths. As
    p_column stands 2 n.c, as p_columns c.c, as p_both 2 c.l; the same for lines.

    >>> z, still = [0, 0, 65536], [0, 0, 0]
    >>> found = setup(z, still, 15, still, 15, z, z)
    >>> found.a / 2**24, found.h / 2**28, found.p / 2**36
    (np.float64(1.0), np.float64(1.0), np.float64(1.0))
    """
    n, c, l, light, half = (np.asarray(v, np.int64) for v in (normal, dcolumn, dline, light, half))  # noqa: E741
    ec, el = integers(dcolumn_exp, dline_exp)

    def a(v: Int, e: Int) -> Int:
        return wrap(dot_scaled(v, light, e + 1) >> k.DIRECT_P_F - k.DIRECT_A_F, k.DIRECT_A_W)

    def h(v: Int, e: Int) -> Int:
        return wrap(dot_scaled(v, half, e + 1) >> k.DIRECT_P_F - k.DIRECT_H_F, k.DIRECT_H_W)

    def p(v: Int, w: Int, twice: int, e: Int) -> Int:
        return dot_scaled(v, w, e + 1 - twice) & (1 << k.DIRECT_P_W) - 1

    zero = np.int64(0)
    return Coefficients(
        a(n, zero), a(c, ec), a(l, el), h(n, zero), h(c, ec), h(l, el),
        p(n, n, 0, zero), p(n, c, 1, ec), p(n, l, 1, el), p(c, c, 0, 2 * ec), p(l, l, 0, 2 * el), p(c, l, 1, ec + el),
    )  # fmt: skip


def step(found: Coefficients, i: ArrayLike, j: ArrayLike) -> tuple[Int, Int, Int]:
    """(a, h, P) i columns and j lines from the reference pixel, modulo their widths (``shade_direct_line``, ``_run``).

    >>> one = Coefficients(*np.arange(12))
    >>> [int(v) for v in step(one, 2, 1)]  # 6 + 2 * 7 + 8 + 4 * 9 + 10 + 2 * 11
    [4, 16, 96]
    """
    i, j = integers(i, j)
    a = found.a + i * found.a_column + j * found.a_line
    h = found.h + i * found.h_column + j * found.h_line
    p = found.p + i * found.p_column + j * found.p_line
    p = p + i * i * found.p_columns + j * j * found.p_lines + i * j * found.p_both  # modulo 2^64, so modulo 2^41
    return wrap(a, k.DIRECT_A_W), wrap(h, k.DIRECT_H_W), p & (1 << k.DIRECT_P_W) - 1


@cache
def rho_table() -> Int:
    """(256, 3): c0, c1, c2: 1/sqrt(P) - 1 = c0 + c1 d + c2 d^2 for P in [i/128, (i + 1)/128), d = P - middle.

    Through the three Chebyshev nodes of each segment. Rows 0 to 31, of normals shorter than 1/2, hold the largest
    number below 1, which no other row exceeds.
    """
    bits = 60
    node = Fraction(1, 256) * Fraction(866025403784438647, 10**18)  # cos 30 degrees

    def rho(p: Fraction) -> Fraction:
        return Fraction(isqrt((p.denominator << 2 * bits) // p.numerator), 1 << bits) - 1

    largest = (1 << k.RHO_F) - (1 << k.RHO_F - k.DIRECT_RHO_F)
    table = np.zeros((1 << k.RHO_INDEX_W, 3), np.int64)
    for i in range(1 << k.RHO_INDEX_W):
        middle = Fraction(2 * i + 1, 256)
        low, centre, high = (rho(middle + d) for d in (-node, Fraction(0), node))
        c1, c2 = (high - low) / (2 * node), (high - 2 * centre + low) / (2 * node * node)
        fractions = zip((centre, c1, c2), (k.RHO_F, k.RHO_C1_F, k.RHO_C2_F), strict=True)
        table[i] = [int((c * (1 << f) + Fraction(1, 2)).__floor__()) for c, f in fractions]
    table[:32] = largest, 0, 0
    table[32, 0] -= 1 << k.RHO_F - k.DIRECT_RHO_F  # P = 1/4 would be 1
    return table


def rho_rom(i: ArrayLike) -> Int:
    """Row i of the table in 56 bits: c0 with the half ulp of the result, c1, c2 (``shade_rho_rom``)."""
    (i,) = integers(i)
    c0, c1, c2 = np.moveaxis(rho_table()[i], -1, 0)
    c0, c1 = c0 & (1 << k.RHO_C0_W) - 1, c1 & (1 << k.INTENSITY_W) - 1
    return (c0 << k.INTENSITY_W | c1) << k.RHO_C2_W | c2


def rho(p: ArrayLike) -> tuple[Int, Int, Int]:
    """(rho, short, long): 1/sqrt(P) - 1, S0.25, of P U1.25 (``shade_rho``).

    short: P < 1/4, rho is then almost 1; long: P >= 129/128. Error below 3 ulp
    for P >= 1/2, below 20 for P >= 33/128, next to P = 1/4 2^-17.

    >>> [int(v) for v in rho(1 << 24)]  # P = 1/2
    [13898696, 0, 0]
    """
    (p,) = integers(p)
    low = k.DIRECT_P_OUT_F + 1 - k.RHO_INDEX_W
    c0, c1, c2 = np.moveaxis(rho_table()[p >> low & (1 << k.RHO_INDEX_W) - 1], -1, 0)
    d = (p & (1 << low) - 1) - (1 << low - 1)
    s = c1 + (c2 * d + (1 << k.RHO_S_DROP - 1) >> k.RHO_S_DROP)
    value = c0 + (s * d + (1 << k.DIRECT_P_OUT_F + k.RHO_C1_F - k.RHO_F - 1) >> k.DIRECT_P_OUT_F + k.RHO_C1_F - k.RHO_F)
    one = 1 << k.DIRECT_P_OUT_F
    return value, (p < one // 4).astype(np.int64), (p >= one + (1 << low)).astype(np.int64)


class Lobe(NamedTuple):
    """A table of chords over x 2^shift in [0, 1): at i/1024 value, U1.16, and what is added up to the next, S-6.20.

    ``excess``: |H| - 1 of the quantized H, S-15.24.
    """

    value: Int
    slope: Int
    shift: int
    excess: int


def light(a: ArrayLike, h: ArrayLike, p: ArrayLike, lobe: Lobe) -> tuple[Int, Int, Int, Int]:
    """(diffuse, specular, short, long) of a pixel: U0.16, saturated, the others of ``rho`` (``shade_direct_light``).

    Of a 17, of y = 1 - h, less an ulp of h, 24 and of P 25 fraction bits are taken. Products take rho and y with 17, a
    with 16, all cut.
    """
    a, h, p = integers(a, h, p)
    p = p >> k.DIRECT_P_F - k.DIRECT_P_OUT_F
    near = a >> k.DIRECT_A_F - k.DIRECT_DIFFUSE_F
    diffuse, specular, short = scalar_light(near, h >> k.DIRECT_H_F - k.DIRECT_X_F, p, lobe)
    return saturate(diffuse, k.PIXEL_W), specular, short, rho(p)[2]


def scalar_light(a: Int, h: Int, p: Int, lobe: Lobe) -> tuple[Int, Int, Int]:
    """(diffuse S1.16, specular U0.16, short) from N.L S1.17, N.H S1.24, N.N U1.25 (``shade_scalar_light``)."""
    r, short, _ = rho(p)
    factor = r >> k.RHO_F - k.DIRECT_RHO_F
    grown = (a >> k.DIRECT_DIFFUSE_F - k.INTENSITY_F) * factor
    total = a + (grown >> k.INTENSITY_F + k.DIRECT_RHO_F - k.DIRECT_DIFFUSE_F)
    drop = k.DIRECT_DIFFUSE_F - k.PIXEL_W
    diffuse = limit(total + (1 << drop - 1) >> drop)
    y = wrap((1 << k.DIRECT_X_F) - 1 - h, k.DIRECT_X_F + 1)
    bent = wrap(y >> k.DIRECT_X_F - k.DIRECT_RHO_F, k.DIRECT_RHO_F + 1) * factor
    x = y - (r >> k.RHO_F - k.DIRECT_X_F) + (bent >> 2 * k.DIRECT_RHO_F - k.DIRECT_X_F) + lobe.excess
    return diffuse, chord(np.where(h < 0, 1 << k.DIRECT_X_F, x), lobe), short


def chord(x: ArrayLike, lobe: Lobe) -> Int:
    """lobe(x), U0.16, of x S1.24 by chords; x < 0 counts as 0; 0 from 2^-shift on (``shade_chord``)."""
    (x,) = integers(x)
    scaled = np.maximum(x, 0) << lobe.shift
    far = scaled >> k.DIRECT_X_F != 0
    rest_w = k.DIRECT_X_F - k.CHORD_INDEX_W
    i = np.where(far, 0, scaled >> rest_w)
    fraction = scaled >> rest_w - k.CHORD_FRACTION_W & (1 << k.CHORD_FRACTION_W) - 1
    drop = k.CHORD_SLOPE_F - k.INTENSITY_F
    value = (lobe.value[i] << drop) + (lobe.slope[i] * fraction >> k.CHORD_FRACTION_W)
    return np.where(far, 0, saturate(value + (1 << drop - 1) >> drop, k.PIXEL_W))


class Drawn(NamedTuple):
    """What ``shade_direct`` makes of packets: pixels (P, 2) U0.16, diffuse and specular; ``beat`` (P,): of their run.

    ``last`` (P,): a run's last pixel. ``errors``: bits DIRECT_*; ``dropped``: packets and runs; ``triangles``.
    """

    pixels: Int
    tag: Int
    last: Int
    beat: Int
    errors: int
    dropped: int
    triangles: int


def lobe_packet(lobe: Lobe) -> dict[str, Int]:
    """The packet that fills the table: ``s_axis_surface_tdata`` and ``_tlast``."""
    head = types.pack(types.LOBE, {"shift": lobe.shift, "excess": lobe.excess, "lobe": 1})
    entries = types.pack(types.CHORD, {"value": lobe.value, "slope": lobe.slope})
    data = np.r_[head.view(np.uint64), entries[:, 0].astype(np.uint64)]
    return {"s_axis_surface_tdata": data, "s_axis_surface_tlast": (np.arange(len(data)) == len(data) - 1).astype(int)}


def direct(tdata: ArrayLike, tlast: ArrayLike, l: ArrayLike, h: ArrayLike, lobe: Lobe) -> Drawn:  # noqa: E741
    """Packets of triangles with their runs, beat by beat (``shade_direct``). ``lobe``: as it is in the table.

    Packets of the lobe are not among them. A packet without runs is dropped; so is a run of no pixels (of a
    triangle's first and last one nothing is told), of more than 4096, or not below the last good one.
    """
    tdata, tlast = np.asarray(tdata, np.uint64), np.asarray(tlast, np.int64)
    first = np.r_[0, np.flatnonzero(tlast) + 1][:-1] if tlast.size else np.zeros(0, np.int64)
    length = np.diff(np.r_[first, len(tdata)])
    whole = length > k.TRIANGLE_BEATS
    cut = int(np.count_nonzero(~whole))
    heads, runs_of = first[whole], length[whole] - k.TRIANGLE_BEATS
    words = tdata[heads[:, None] + np.arange(k.TRIANGLE_BEATS)].view("<u4").reshape(-1, k.TRIANGLE_DATA_W // 32)
    t = types.unpack(types.TRIANGLE, words)

    def vector(name: str, used: ArrayLike = True) -> Int:
        return np.stack([t[f"{name}.{axis}"] for axis in "xyz"], axis=-1) * np.asarray(used, np.int64).reshape(-1, 1)

    owner, number = walk(runs_of)
    beat = heads[owner] + k.TRIANGLE_BEATS + number
    run = types.unpack(types.RUN, tdata[beat, None].view("<u4").reshape(-1, 2))
    last_run = number == runs_of[owner] - 1
    good, order = _in_order(run["line"], run["count"], number == 0)
    empty, long = run["count"] == 0, run["count"] > k.PIXELS_MAX
    bits = {k.DIRECT_EMPTY: empty & ~last_run & (number != 0), k.DIRECT_LONG: long, k.DIRECT_ORDER: order}
    bad = np.any(list(bits.values()), axis=0)

    found = setup(
        vector("normal"), vector("dcolumn.mantissa", t["columns"] != 1), t["dcolumn.exp"],
        vector("dline.mantissa", t["lines"] != 1), t["dline.exp"], l, h,
    )  # fmt: skip
    start = np.flatnonzero(number == 0)[owner]
    drawn, step_of = walk(np.where(good, run["count"], 0))
    place = (run[name][drawn] - run[name][start[drawn]] for name in ("column", "line"))
    column, line = place
    a, h_at, p = step(Coefficients(*(part[owner[drawn]] for part in found)), column + step_of, line)
    diffuse, specular, short, large = light(a, h_at, p, lobe)
    bits |= {k.DIRECT_PACKET: np.array([cut]), k.DIRECT_SHORT: short, k.DIRECT_LARGE: large}
    errors = sum(int(np.any(value)) << bit for bit, value in bits.items())
    last = (step_of == run["count"][drawn] - 1).astype(np.int64)
    pixels = np.stack([diffuse, specular], axis=-1)
    return Drawn(
        pixels, t["tag"][owner[drawn]], last, beat[drawn], errors, cut + int(np.count_nonzero(bad)), len(heads)
    )


def _in_order(line: Int, count: Int, first: Int) -> tuple[Int, Int]:
    """Which runs are drawn, and which are not below the last good one (``shade_direct_moves``)."""
    fits = (count > 0) & (count <= k.PIXELS_MAX)
    order = np.zeros(len(line), bool)
    least = 0
    for i in range(len(line)):  # as a run is judged by the one before, without a formula
        order[i] = fits[i] and not first[i] and line[i] < least
        good = fits[i] and not order[i]
        if good or first[i]:
            least = line[i] + good
    return fits & ~order, order
