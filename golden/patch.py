# SPDX-License-Identifier: Apache-2.0
"""Patches: one polynomial of two variables for a box of a triangle's pixels (``rtl/surface/shade_patch``).

A triangle's interpolated normal is linear, N(x, y) = N0 + x Gx + y Gy (P4's constant increment), so light is a smooth
function of both coordinates, and P1's idea, light at few points and a polynomial between them, holds for a whole piece
of it. A triangle is cut into boxes of 2^kx by 2^ky pixels, kx, ky 2 .. 4, from the corner of its bounding box on. With
X, Y in [-1, 1) across a box, six nodes give the light

    I(X, Y) = C + s X + t Y + p X^2 + q X Y + r Y^2

exactly where it is a parabola: C in the middle, E at (1/2, 0), A, B, F, G at (1/2, 1/2), (1/2, -1/2), (-1/2, 1/2),
(-1/2, -1/2). All coefficients are sums of nodes times powers of two.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import isqrt, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import contract as k
from .fixed import Int, integers, limit, round, rsqrt, saturate, wrap
from .material import Material, light_registers
from .normal import dot3
from .reference.light import sharpness
from .stream import walk

Words = Mapping[str, int]


def norm(x: ArrayLike, y: ArrayLike, z: ArrayLike) -> Int:
    """(largest + sum) / 2 of the absolute values, floor: the length of a vector, or up to 22 % more.

    >>> int(norm(0, -100, 0)), int(norm(100, 100, 100))
    (100, 200)
    """
    x, y, z = (np.abs(part) for part in integers(x, y, z))
    return x + y + z + np.maximum(np.maximum(x, y), z) >> 1


class Triangles(NamedTuple):
    """Triangles (T, ...) and their runs (S,): fields of ``golden.types.TRIANGLE`` and ``RUN``.

    ``box``: columns, lines, left. ``triangle``: index of a run's triangle.
    """

    normal: Int
    dcolumn: Int
    dcolumn_exp: Int
    dline: Int
    dline_exp: Int
    box: Int
    tag: Int
    triangle: Int
    column: Int
    line: Int
    count: Int


def times(count: Int, mantissa: Int, exp: Int) -> Int:
    """count mantissa 2^-exp, 18 fraction bits, floor; of count the lower exp + 2 bits: no box has more."""
    return ((count & (4 << exp) - 1) * (mantissa << k.PATCH_PLAN_F - k.INTENSITY_F)) >> exp


def corners(t: Triangles) -> Int:
    """(T, 3): the normal in the upper left pixel of a triangle's box, S3.18, and half an ulp of S1.16."""
    left = times(t.box[:, 2:], t.dcolumn, t.dcolumn_exp[:, None])
    up = k.PATCH_PLAN_F - k.INTENSITY_F
    return (t.normal << up) + (1 << up - 1) - left


def plan(t: Triangles, words: Words) -> tuple[Int, Int, Int]:
    """(kx, ky, direct) of triangles (T,): boxes of 2^kx by 2^ky pixels; direct: light at every pixel.

    A box is as large as the length of the way of the normal from its middle to a corner allows: at most ``radius``,
    sqrt(2 T / n). Where the highlight is far from the whole triangle, by ``reach``, 3/2 and 7/4 of it, the radius is 2,
    4 and 8 times as large, but never larger than PATCH_RADIUS: kappa weighed by the light. (``shade_patch_way``,
    ``shade_patch_plan``)
    """
    up = k.PATCH_PLAN_F - k.INTENSITY_F
    columns, lines = t.box[:, 0], t.box[:, 1]
    across = times(columns[:, None], t.dcolumn, t.dcolumn_exp[:, None])
    down = times(lines[:, None], t.dline, t.dline_exp[:, None])
    h = np.array([words[f"h{c}"] for c in "xyz"]) << up
    a, b = norm(*t.dcolumn.T), norm(*t.dline.T)
    half = times(columns, a, t.dcolumn_exp) + times(lines, b, t.dline_exp) >> 1
    away = norm(*(corners(t) + (across + down >> 1) - h).T) - half
    reach = words["reach"] << up
    limits = reach, reach + (reach >> 1), 2 * reach - (reach >> 2)
    radius = words["radius"] << sum((away >= limit).astype(np.int64) for limit in limits)
    radius = np.minimum(radius, k.PATCH_RADIUS) << up
    a, b = (a << up >> t.dcolumn_exp) << 1, (b << up >> t.dline_exp) << 1
    kx = ky = np.full(len(a), k.PATCH_LOG2_MIN)
    direct = way(a, b) > radius
    for _ in range(2 * (k.PATCH_LOG2_MAX - k.PATCH_LOG2_MIN)):
        x_fits = (kx < k.PATCH_LOG2_MAX) & (columns > 1 << kx) & (way(2 * a, b) <= radius)
        y_fits = (ky < k.PATCH_LOG2_MAX) & (lines > 1 << ky) & (way(a, 2 * b) <= radius)
        grow_x = x_fits & ((a <= b) | ~y_fits)
        grow_y = y_fits & ~grow_x
        kx, ky, a, b = kx + grow_x, ky + grow_y, a << grow_x, b << grow_y
    return kx, ky, direct.astype(np.int64)


def way(a: Int, b: Int) -> Int:
    """About the length of the sum of two vectors of the lengths a and b, however they stand to each other."""
    return np.maximum(a, b) + (np.minimum(a, b) >> 1)


def light(a: ArrayLike, h: ArrayLike, p: ArrayLike, words: Words, table: Int) -> tuple[Int, Int, Int]:
    """(diffuse, specular, flags) from N.L, N.H and N.N, S4.24, of an interpolated normal N (``shade_patch_light``).

    1 + rho = 1/sqrt(N.N). diffuse = N.L (1 + rho), S1.16; x = 1 - cos = |H| - N.H - N.H rho, where nothing cancels;
    specular: chords over x 2^shift of the table.
    """
    a, h, p = integers(a, h, p)
    f, one = k.PATCH_DOT_F, 1 << k.RSQRT_F
    short, long = p < 1 << f - 2, p >= 4 << f
    y, e = rsqrt(np.clip(p, 1, (16 << f) - 1) << k.RSQRT_W - 4 - f)
    rho = np.where(short, one - 1, np.minimum(np.where(e == 15, 2 * y, np.where(e == 16, y, y >> 1)) - one, one - 1))
    a, h16 = limit(round(a, f - k.INTENSITY_F)), limit(round(h, f - k.INTENSITY_F))
    less = k.RSQRT_F - k.PATCH_RHO_F
    diffuse = limit(
        round((a << k.PATCH_RHO_F) + a * np.minimum(round(rho, less), (1 << k.PATCH_RHO_F) - 1), k.PATCH_RHO_F)
    )
    x = words["h_length"] - h - round(h16 * rho, k.INTENSITY_F + k.RSQRT_F - f)
    flags = (short.astype(np.int64) << k.PATCH_LIGHT_SHORT) | (long.astype(np.int64) << k.PATCH_LIGHT_LONG)
    return diffuse, chord(x, words["shift"], table), flags


def chord(x: Int, shift: int, table: Int) -> Int:
    """The lobe over x = 1 - cos, S4.24: table (2, 512) of values U1.15 and slopes S-3.18, beyond its end 0."""
    f, rest = k.PATCH_DOT_F, k.PATCH_DOT_F - k.PATCH_TABLE_LOG2
    scaled = np.clip(x, 0, (1 << f + 1) - 1) << shift
    inside = scaled < 1 << f
    at = np.where(inside, scaled >> rest, 0)
    part = scaled & (1 << rest) - 1
    value = (table[0][at] << rest + 3) + table[1][at] * part
    return np.where(inside, limit(round(value, rest + 2)), 0)


def coefficients(c: Int, e: Int, a: Int, b: Int, f: Int, g: Int) -> tuple[Int, ...]:
    """(C, 2 s, 2 t, p, q, r) of I = C + s X + t Y + p X^2 + q X Y + r Y^2 from the light at the six nodes."""
    c, e, a, b, f, g = integers(c, e, a, b, f, g)
    right, left = a + b, f + g
    return c, right - left, a + f - b - g, 4 * (e - c) - right + left, a - b - f + g, 2 * right - 4 * e


def value(coefficients: tuple[Int, ...], x: Int, y: Int) -> Int:
    """I at x, y, eighths of half a box, -8 .. 7, to a pixel's U0.16: exact, rounded once, clamped."""
    c, s2, t2, p, q, r = coefficients
    exact = (c << k.PATCH_VALUE_F) + 4 * (s2 * x + t2 * y) + p * x * x + q * x * y + r * y * y
    return pixel(wrap(exact + (1 << k.PATCH_VALUE_F - 1), k.PATCH_VALUE_W))


def pixel(state: Int) -> Int:
    """What a lane gives for its state, in which half an ulp is."""
    return saturate(state >> k.PATCH_VALUE_F, k.PIXEL_W)


@dataclass(frozen=True)
class Drawn:
    """Pixels (P,) box by box, in a box line by line: values (P, 2), column, line, tag, last of its line in a box.

    ``order``: which pixel it is, run by run. ``flags``: bits PATCH_LIGHT_*. ``direct``: boxes lit pixel by pixel.
    """

    pixels: Int
    column: Int
    line: Int
    tag: Int
    last: Int
    order: Int
    evaluations: int
    flags: int
    boxes: int
    direct: int


NODES = ((0, 0), (1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1))  # C, E, A, B, F, G, in quarters of a box


def draw(t: Triangles, words: Words, table: Int) -> Drawn:
    """Triangles and their runs through ``shade_patch``."""
    kx, ky, curved = plan(t, words)
    first = np.flatnonzero(np.diff(t.triangle, prepend=-1))  # the first run of each
    edge, top = t.column[first] - t.box[:, 2], t.line[first]

    run, step = walk(t.count)
    of = t.triangle[run]
    x, y = t.column[run] + step - edge[of], t.line[run] - top[of]
    key = (of << 24) | (y >> ky[of]) << 12 | x >> kx[of]
    key, inside, pixels = np.unique(key, return_inverse=True, return_counts=True)
    bt, by, bx = key >> 24, key >> 12 & 4095, key & 4095
    kx, ky = kx[bt], ky[bt]
    direct = (curved[bt] == 1) | ((kx == k.PATCH_LOG2_MIN) & (ky == k.PATCH_LOG2_MIN) & (pixels <= k.PATCH_SMALL))

    # normals, S1.16: in the middles of the boxes and a quarter of a box along each side
    most = k.PATCH_LOG2_MAX
    qx, qy = (
        (mantissa << k.PATCH_STEP_F - k.INTENSITY_F + most - 2) >> (exp + most)[:, None] - size[:, None]
        for mantissa, exp, size in ((t.dcolumn[bt], t.dcolumn_exp[bt], kx), (t.dline[bt], t.dline_exp[bt], ky))
    )
    corner = corners(t)[bt] << k.PATCH_STEP_F - k.PATCH_PLAN_F
    middle = wrap(corner + qx * (4 * bx + 2)[:, None] + qy * (4 * by + 2)[:, None], k.PATCH_STEP_W)
    less = k.PATCH_STEP_F - k.INTENSITY_F
    near = middle >> less  # half an ulp is in the corner
    n, dx, dy = limit(near), limit(qx >> less), limit(qy >> less)
    outside = bool((n != near).any())
    l, h = (tuple(words[f"{v}{c}"] for c in "xyz") for v in "lh")  # noqa: E741

    def dot(a: Int, b) -> Int:
        return dot3(
            *(a.T if isinstance(a, np.ndarray) else a), *(b.T if isinstance(b, np.ndarray) else b), k.PATCH_DOT_F
        )

    flags = outside << k.PATCH_LIGHT_RANGE

    def lit(at: Int, i: Int, j: Int) -> tuple[Int, Int]:
        """Light at i, j quarters from the middles of the boxes ``at``."""
        nonlocal flags
        nl, nh, p = (dot(n, l), dot(n, h), dot(n, n))
        a, b = (nl + 0)[at] + i * dot(dx, l)[at] + j * dot(dy, l)[at], nh[at] + i * dot(dx, h)[at] + j * dot(dy, h)[at]
        p = p[at] + 2 * i * dot(n, dx)[at] + 2 * j * dot(n, dy)[at]
        p = p + i * i * dot(dx, dx)[at] + 2 * i * j * dot(dx, dy)[at] + j * j * dot(dy, dy)[at]
        *both, told = light(*(wrap(v, k.PATCH_DOT_W) for v in (a, b, p)), words, table)
        flags |= int(np.bitwise_or.reduce(told, initial=0))
        return tuple(both)

    smooth = np.flatnonzero(~direct)
    nodes = [lit(smooth, np.full(len(smooth), i), np.full(len(smooth), j)) for i, j in NODES]
    place = np.zeros(len(key), np.int64)
    place[smooth] = np.arange(len(smooth))
    u, v = x - (bx << kx)[inside], y - (by << ky)[inside]
    values = np.zeros((len(x), 2), np.int64)
    single = direct[inside]
    one = lit(inside[single], u[single] - 2, v[single] - 2)
    at = inside[~single]
    u8, v8 = (u[~single] << 4 - kx[at]) - 8, (v[~single] << 4 - ky[at]) - 8
    for c in range(2):
        parts = coefficients(*(node[c] for node in nodes))
        values[single, c] = saturate(one[c], k.PIXEL_W)
        values[~single, c] = value(tuple(part[place[at]] for part in parts), u8, v8)
    order = np.lexsort((u, v, inside))
    same = (np.diff(inside[order]) == 0) & (np.diff(v[order]) == 0) & ~single[order][:-1]
    return Drawn(
        values[order], (x + edge[of])[order], (y + top[of])[order], t.tag[of][order],
        np.append(~same, True)[: len(x)].astype(np.int64), order, 6 * len(smooth) + int(single.sum()), flags, len(key),
        int(direct.sum()),
    )  # fmt: skip


TOLERANCE = 0.125  # T of n (1 - cos) <= T between the middle of a box and a corner, where the highlight is brightest
WEIGHT = 0.72  # the highlight's curvature is halved where n (1 - cos) is 1 / WEIGHT larger
TABLE_SHIFT_MAX = 7


def registers(material: Material, light: ArrayLike, weighted: bool = True) -> tuple[dict[str, int], Int]:
    """Settings of ``shade_patch`` by name, and its table (2, 512): values U1.15, slopes S-3.18 a chord.

    For models whose highlight depends on N.H alone. ``weighted`` = False: boxes are everywhere as small as in it.
    """
    if material.model not in ("lambert", "blinn"):
        raise ValueError(f"model: {material.model} is none of lambert, blinn, which patches have")
    words = light_registers(light)
    h = [words[f"h{c}"] for c in "xyz"]
    words["h_length"] = isqrt(sum(c * c for c in h) << 2 * (k.PATCH_DOT_F - k.INTENSITY_F))
    n = sharpness(material.model, material.shininess)
    scale = material.scale(light) if material.model == "blinn" else 0.0

    def lobe(x: ArrayLike) -> np.ndarray:
        return scale * np.maximum(1 - np.asarray(x, float), 0) ** material.shininess

    ends = (s for s in range(TABLE_SHIFT_MAX, 0, -1) if lobe(2.0**-s) < 2.0**-18)
    shift = next(ends, 0)
    chords = lobe(np.arange((1 << k.PATCH_TABLE_LOG2) + 1) / (1 << k.PATCH_TABLE_LOG2 + shift))
    chords = np.minimum(chords, 2 - 2.0**-15)
    values, slopes = np.rint(chords[:-1] * 2**15), np.rint(np.diff(chords) * 2**18)
    one = 1 << k.INTENSITY_F
    words |= {
        "shift": shift,
        "radius": min(int(sqrt(2 * TOLERANCE / n) * one), k.PATCH_RADIUS),
        "reach": min(int(sqrt(4 / (WEIGHT * n)) * one), (1 << k.PATCH_REACH_W) - 1)
        if weighted
        else (1 << k.PATCH_REACH_W) - 1,
    }
    return words, np.stack([values, slopes]).astype(np.int64)
