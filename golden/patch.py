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

from dataclasses import dataclass
from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import contract as k
from . import direct
from .direct import Lobe
from .fixed import Int, integers, limit, saturate, wrap
from .material import Material, chords, light_registers
from .reference.light import sharpness
from .stream import walk


def norm(x: ArrayLike, y: ArrayLike, z: ArrayLike) -> Int:
    """(largest + sum) / 2 of the absolute values, floor: the length of a vector, or up to 22 % more.

    >>> int(norm(0, -100, 0)), int(norm(100, 100, 100))
    (100, 200)
    """
    x, y, z = (np.abs(part) for part in integers(x, y, z))
    return x + y + z + np.maximum(np.maximum(x, y), z) >> 1


class Settings(NamedTuple):
    """Of a draw call. ``l``, ``h`` (L, 3) of L lights, S1.16; ``excess`` (L,): |H| - 1 of the quantized H, S-15.24.

    ``radius`` U0.16, ``reach`` U3.16: see :func:`plan`.
    """

    l: Int  # noqa: E741
    h: Int
    excess: Int
    radius: int
    reach: int


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


def part(halves: Int, exp: Int) -> Int:
    """So many half pixels times 2^-exp, S2.15, floor: what increments are multiplied by."""
    return wrap(halves << k.PATCH_PART_F - 1 >> exp, k.INTENSITY_W)


def plan(t: Triangles, words: Settings) -> tuple[Int, Int, Int]:
    """(kx, ky, direct) of triangles (T,): boxes of 2^kx by 2^ky pixels; direct: light at every pixel.

    A box is as large as the length of the way of the normal from its middle to a corner allows: at most ``radius``,
    sqrt(2 T / n). Where the highlight is far from the whole triangle, by ``reach``, 3/2 and 7/4 of it, the radius is 2,
    4 and 8 times as large, but never larger than PATCH_RADIUS: kappa weighed by the light; of several lights the
    nearest highlight counts. (``shade_patch_far``, ``shade_patch_plan``)
    """
    f, cut = k.PATCH_PART_F, k.INTENSITY_F - k.PATCH_PLAN_F
    columns, lines, left = t.box.T
    ec, el = t.dcolumn_exp, t.dline_exp
    middle = t.normal + (t.dcolumn * part(columns - 2 * left, ec)[:, None] >> f)
    middle = middle + (t.dline * part(lines, el)[:, None] >> f)
    away = np.min([norm(*(middle - h).T) for h in words.h], axis=0)
    a, b = norm(*t.dcolumn.T) >> cut, norm(*t.dline.T) >> cut
    far = away - (a * part(columns, ec) >> f - cut) - (b * part(lines, el) >> f - cut)
    limits = np.cumsum([words.reach, words.reach >> 1, words.reach >> 2])
    radius = words.radius << sum((far >= most).astype(np.int64) for most in limits)
    radius = np.minimum(radius, k.PATCH_RADIUS) >> cut
    most = (1 << k.PATCH_PLAN_F) - 1
    a, b = (np.minimum(v * part(np.int64(4), e) >> f, most) for v, e in ((a, ec), (b, el)))
    kx = ky = np.full(len(a), k.PATCH_LOG2_MIN)
    curved = way(a, b) > radius
    for _ in range(2 * (k.PATCH_LOG2_MAX - k.PATCH_LOG2_MIN)):
        x_fits = (kx < k.PATCH_LOG2_MAX) & (columns > 1 << kx) & (kx < ec + 2) & (way(2 * a, b) <= radius)
        y_fits = (ky < k.PATCH_LOG2_MAX) & (lines > 1 << ky) & (ky < el + 2) & (way(a, 2 * b) <= radius)
        grow_x = x_fits & ((a <= b) | ~y_fits)
        grow_y = y_fits & ~grow_x
        kx, ky, a, b = kx + grow_x, ky + grow_y, a << grow_x, b << grow_y
    return kx, ky, curved.astype(np.int64)


def way(a: Int, b: Int) -> Int:
    """About the length of the sum of two vectors of the lengths a and b, however they stand to each other."""
    return np.maximum(a, b) + (np.minimum(a, b) >> 1)


def middles(t: Triangles, kx: Int, ky: Int) -> tuple[Int, Int]:
    """The normals (T, 3), S1.16, in the middle of the box of the reference pixel, and which do not fit: saturated."""
    f, left = k.PATCH_PART_F, t.box[:, 2] & (1 << kx) - 1
    right = t.dcolumn * part((1 << kx) - 2 * left, t.dcolumn_exp)[:, None] >> f
    down = t.dline * part(1 << ky, t.dline_exp)[:, None] >> f
    exact = t.normal + right + down + 1
    found = limit(exact)
    return found, (found != exact).any(axis=1)


class Scalars(NamedTuple):
    """N.L (L, B), N.H (L, B) and N.N (B,) in the middles of boxes and what they grow by a quarter of a box.

    As they are cut for nodes: 17, 24, 25 fraction bits. ``*_columns`` ...: half of the second difference.
    """

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


def scalars(t: Triangles, kx: Int, ky: Int, words: Settings, of: Int, bx: Int, by: Int) -> tuple[Scalars, Int]:
    """Those of boxes (B,) of the triangles ``of``; and which triangles' normals were saturated.

    Coefficients as ``direct.setup`` makes them, in quarters of a box; boxes are reached by exact additions.
    (``shade_patch_setup``, ``shade_patch_walk``)
    """
    middle, wide = middles(t, kx, ky)
    ec, el = t.dcolumn_exp - kx + k.PATCH_LOG2_MIN, t.dline_exp - ky + k.PATCH_LOG2_MIN
    x, y = 4 * (bx - (t.box[:, 2] >> kx)[of]), 4 * by
    low = {"a": k.DIRECT_A_F - k.DIRECT_DIFFUSE_F, "h": k.DIRECT_H_F - k.DIRECT_X_F}
    low |= {"p": k.DIRECT_P_F - k.DIRECT_P_OUT_F}
    mask = (1 << k.DIRECT_P_W) - 1
    found: dict[str, list[Int]] = {}
    for l, h in zip(words.l, words.h, strict=True):  # noqa: E741
        c = direct.Coefficients(*(v[of] for v in direct.setup(middle, t.dcolumn, ec, t.dline, el, l, h)))
        a, h_at, p = direct.step(c, x, y)
        c = c._replace(
            a=a, h=h_at, p=p,
            p_column=c.p_column + 2 * x * c.p_columns + y * c.p_both & mask,
            p_line=c.p_line + 2 * y * c.p_lines + x * c.p_both & mask,
        )  # fmt: skip
        for name, value in c._asdict().items():
            found.setdefault(name, []).append(value >> low[name[0]])
    shared = {name: values[0] if name[0] == "p" else np.stack(values) for name, values in found.items()}
    return Scalars(**shared), wide


def light(at: Scalars, i: Int, j: Int, lobe: Lobe, excess: Int) -> tuple[Int, Int, Int]:
    """(diffuse, specular, short), S1.16, at i, j quarters of a box from its middle (``_nodes``, ``_light``).

    ``direct.scalar_light`` of the scalars there, modulo their widths. Of several lights the sum, each one's diffuse
    light not below 0.
    """
    p = at.p + i * at.p_column + j * at.p_line + i * i * at.p_columns + i * j * at.p_both + j * j * at.p_lines
    p = p & (1 << k.DIRECT_P_OUT_F + 1) - 1
    a = wrap(at.a + i * at.a_column + j * at.a_line, k.DIRECT_DIFFUSE_F + 2)
    h = wrap(at.h + i * at.h_column + j * at.h_line, k.DIRECT_X_F + 2)
    every = [
        direct.scalar_light(*parts, p, lobe._replace(excess=int(e))) for *parts, e in zip(a, h, excess, strict=True)
    ]
    diffuse, specular = (np.stack(part) for part in zip(*(one[:2] for one in every), strict=True))
    if len(every) > 1:
        diffuse = np.maximum(diffuse, 0)
    return limit(diffuse.sum(axis=0)), limit(specular.sum(axis=0)), every[0][2]


def coefficients(b: Int, a: Int, g: Int, f: Int, c: Int, e: Int) -> tuple[Int, ...]:
    """(C, s, t, p, q, r) of I = C + s X + t Y + p X^2 + q X Y + r Y^2 from the light at the six nodes, in this order.

    In units of :func:`value`, for X, Y in eighths of half a box; what does not fit is cut. (``shade_patch_coef``)
    """
    b, a, g, f, c, e = integers(b, a, g, f, c, e)
    s, t, q = a + b - f - g, a + f - b - g, a - b - f + g
    up = k.PATCH_VALUE_F
    p, r = 4 * (e - c) - s, 2 * (a + b) - 4 * e
    return c << up, s << up >> 4, t << up >> 4, p << up >> 6, q << up >> 6, r << up >> 6


def value(coefficients: tuple[Int, ...], x: Int, y: Int) -> Int:
    """I at x, y, eighths of half a box, -8 .. 7, to a pixel's U0.16: rounded once, clamped.

    The sum, S1.18, is exact, modulo 4. (``shade_patch_lines``)
    """
    c, s, t, p, q, r = coefficients
    exact = c + s * x + t * y + p * x * x + q * x * y + r * y * y
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


NODES = ((1, -1), (1, 1), (-1, -1), (-1, 1), (0, 0), (1, 0))  # B, A, G, F, C, E, in quarters of a box


def draw(t: Triangles, words: Settings, lobe: Lobe) -> Drawn:
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
    at, wide = scalars(t, kx, ky, words, bt, bx, by)
    kx, ky = kx[bt], ky[bt]
    single = (curved[bt] == 1) | ((kx == k.PATCH_LOG2_MIN) & (ky == k.PATCH_LOG2_MIN) & (pixels <= k.PATCH_SMALL))
    flags = int(wide.any()) << k.PATCH_LIGHT_RANGE

    def lit(boxes: Int, i: Int, j: Int) -> tuple[Int, Int]:
        """Light at i, j quarters from the middles of ``boxes``."""
        nonlocal flags
        here = Scalars(*(part[..., boxes] for part in at))
        *both, short = light(here, i, j, lobe, words.excess)
        flags |= int(short.any()) << k.PATCH_LIGHT_SHORT
        return tuple(both)

    smooth = np.flatnonzero(~single)
    nodes = [lit(smooth, np.int64(i), np.int64(j)) for i, j in NODES]
    place = np.zeros(len(key), np.int64)
    place[smooth] = np.arange(len(smooth))
    u, v = x - (bx << kx)[inside], y - (by << ky)[inside]
    values = np.zeros((len(x), 2), np.int64)
    alone = single[inside]
    one = lit(inside[alone], u[alone] - 2, v[alone] - 2)
    box = inside[~alone]
    u8, v8 = (u[~alone] << 4 - kx[box]) - 8, (v[~alone] << 4 - ky[box]) - 8
    for c in range(2):
        parts = coefficients(*(node[c] for node in nodes))
        values[alone, c] = saturate(one[c], k.PIXEL_W)
        values[~alone, c] = value(tuple(part[place[box]] for part in parts), u8, v8)
    order = np.lexsort((u, v, inside))
    same = (np.diff(inside[order]) == 0) & (np.diff(v[order]) == 0) & ~alone[order][:-1]
    return Drawn(
        values[order], (x + edge[of])[order], (y + top[of])[order], t.tag[of][order],
        np.append(~same, True)[: len(x)].astype(np.int64), order, 6 * len(smooth) + int(alone.sum()), flags, len(key),
        int(single.sum()),
    )  # fmt: skip


TOLERANCE = 0.125  # T of n (1 - cos) <= T between the middle of a box and a corner, where the highlight is brightest
WEIGHT = 0.72  # the highlight's curvature is halved where n (1 - cos) is 1 / WEIGHT larger


def registers(material: Material, light: ArrayLike, weighted: bool = True) -> tuple[Settings, Lobe]:
    """Settings of ``shade_patch`` and the lobe of its table, for a light (3,) or several (L, 3).

    For models whose highlight depends on N.H alone. ``weighted`` = False: boxes are everywhere as small as in it.
    """
    if material.model not in ("lambert", "blinn"):
        raise ValueError(f"model: {material.model} is none of lambert, blinn, which patches have")
    lights = np.asarray(light, float).reshape(-1, 3)
    words = [light_registers(one) for one in lights]
    lobes = [chords(material, one) for one in lights]
    n, one = sharpness(material.model, material.shininess), 1 << k.INTENSITY_F
    far = (1 << k.PATCH_REACH_W) - 1
    settings = Settings(
        *(np.array([[word[f"{v}{axis}"] for axis in "xyz"] for word in words]) for v in "lh"),
        excess=np.array([lobe.excess for lobe in lobes]),
        radius=min(int(sqrt(2 * TOLERANCE / n) * one), k.PATCH_RADIUS),
        reach=min(int(sqrt(4 / (WEIGHT * n)) * one), far) if weighted else far,
    )
    return settings, lobes[0]
