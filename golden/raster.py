# SPDX-License-Identifier: Apache-2.0
"""Triangles: set-up, scan conversion, depth. Mirrors ``rtl/raster``; exact integers wherever coverage is decided.

A triangle has three vertices of x, y (S15.8, y down), a depth (U0.24) and a normal (S0.16). Twice its area is

    A = dx1 dy2 - dx2 dy1        dx1 = x1 - x0, ...; negative where 0, 1, 2 turn counter-clockwise on the screen

A pixel is covered when its centre is inside; of a centre on an edge, the triangle for which the edge is a top or a left
one. So a line's run goes from the first centre that is not left of the left edge to the last that is left of the right
one, and both ends are the same function of an edge and a line: the first column whose centre is not left of the edge.

Normal and depth are linear functions of column and line. With v1, v2 the differences of a component to vertex 0,

    v per column = 256 (v1 dy2 - v2 dy1) / A        v per line = 256 (v2 dx1 - v1 dx2) / A

The sums are exact; 1/A has the mantissa of :func:`reciprocal`, the same for all of a triangle's increments. An error of
1/A hence stretches the way from vertex 0 to a pixel by at most 2^-17 of it and never throws a sliver's pixels out.
Increments may be of any size, so they are kept modulo 2^40 of their ulp, values modulo 2^32: a way has 8 fraction bits,
so that a multiple of 2^40 is one of 2^32 at a pixel, and there the value lies between those of the vertices.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import contract as k
from .fixed import Int, integers, limit, round, wrap
from .stream import walk
from .types import RUN, TRIANGLE, VERTEX, pack

ONE = 1 << k.SUBPIXEL_F
HALF = ONE // 2
COMPONENTS = 4  # normal x, y, z, depth
ALIGN = 2 * k.RECIPROCAL_F + 1 - 16  # 19: what a product with the mantissa is shifted by
FAULTS = ("packet", "range", "normal", "area")
"""Why a triangle is skipped: a packet of other than three vertices, a number out of its range, a normal of length 0, no
area."""


@dataclass(frozen=True)
class Vertices:
    """Triangles as they are sent: x, y S15.8, depth U0.24 (T, 3), normals S0.16 (T, 3, 3), tag, flat (T,)."""

    x: Int
    y: Int
    depth: Int
    normal: Int
    tag: Int
    flat: Int

    def __len__(self) -> int:
        return len(self.x)


@dataclass(frozen=True)
class View:
    """The frame's columns and lines, 1 to 4096; what is culled, ``CULL_*``.

    ``flat``: all of a triangle has the normal of vertex 0.
    """

    columns: int
    lines: int
    cull: int = k.CULL_BACK
    flat: int = 0

    @property
    def ports(self) -> dict[str, int]:
        """As the leaves of ``view_i``."""
        parts = {"columns": self.columns, "lines": self.lines, "cull": self.cull, "flat": self.flat}
        return {f"view_i.{name}": value for name, value in parts.items()}


@dataclass(frozen=True)
class Scanned:
    """What a list of triangles covers, in order; a triangle without a pixel is left out.

    ``plane``, ``dcolumn``, ``dline`` (T, 4): normal S2.29 and depth S1.30, modulo 4, at the first pixel of the first
    run, and their increments. ``box`` (T, 5): column and line of that pixel, columns and lines of a box that holds all
    pixels, its columns on the left of that pixel. ``steep`` (T,): an increment of the normal is not in S2.29 and
    stands modulo 8; ``narrow`` (T,): none is, and all fit, see ``golden.types.TRIANGLE``.
    """

    index: Int  # (T,) of the triangle among those given
    plane: Int
    dcolumn: Int
    dline: Int
    box: Int
    steep: Int
    narrow: Int
    tag: Int
    flat: Int
    triangle: Int  # (S,) of a run, index into those above
    column: Int
    line: Int
    count: Int
    faults: dict[str, int]
    culled: int
    empty: int
    ended: Int | None = None  # (T,) 1: an empty run stands behind those of the triangle; None: behind none


def reciprocal(a: ArrayLike) -> tuple[Int, Int]:
    """(r, e) with 1/a = r 2^-17 2^-e for an integer a, 1 <= a < 2^51 (``shade_reciprocal``).

    e is the place of the highest bit of a, m = a 2^-e is cut to U1.19, r = 1/m rounded to U0.17, ties up, at most
    1 - 2^-17. The relative error is between -2^-17 and 2^-17 + 2^-19.

    >>> [[int(v) for v in reciprocal(a)] for a in (1, 3, 1000)]
    [[131071, 0], [87381, 1], [67109, 9]]
    """
    (a,) = integers(a)
    e = np.frexp(a.astype(np.float64))[1].astype(np.int64) - 1  # a < 2^51 is exact
    top = k.RECIPROCAL_M_W - 1
    m = np.where(e > top, a >> np.maximum(e - top, 0), a << np.maximum(top - e, 0))
    m = np.maximum(m, 1 << top)
    r = ((1 << k.RECIPROCAL_F + top + 1) // m + 1) >> 1
    return np.minimum(r, (1 << k.RECIPROCAL_F) - 1), np.maximum(e, 0)


def gradient(cross: ArrayLike, r: ArrayLike, e: ArrayLike, depth: bool = False) -> tuple[Int, Int]:
    """(256 cross / A modulo 2^40 of its ulp, 1 where it is not within 2^31 of them) (``shade_gradient``).

    ``cross``: v1 dy2 - v2 dy1, with the sign of A taken out; ``r``, ``e``: of ``reciprocal(A)``. The sum is shifted so
    that 19 bits remain below the result's last one, cut, multiplied by r, rounded to nearest, ties up: S10.29 of a
    normal, S9.30 of a depth. Error at most 3/4 ulp and that of r.

    >>> [int(v) for v in gradient(1 << 20, *reciprocal(1 << 24))]  # 256 2^20 2^-16 / 2^24 = 2^-12
    [131071, 0]
    """
    cross, r, e = integers(cross, r, e)
    left = 4 + ALIGN - e - k.DEPTH_DOWN * depth
    up, down = np.maximum(left, 0), np.maximum(-left, 0)
    aligned = cross << up >> down  # modulo 2^64
    g = wrap(round(aligned * r, ALIGN), k.GROWTH_W)
    bits = k.STEP_W + 3  # with fewer g is below 2^32
    steep = (up > 0) & ((cross >> np.maximum(bits - 1 - up, 0)) + 1 >> 1 != 0)
    steep |= (aligned >> bits - 1) + 1 >> 1 != 0
    steep |= (g >> k.STEP_W - 1) + 1 >> 1 != 0
    return g, steep.astype(np.int64)


def edges(x: ArrayLike, y, dx, dy, line) -> Int:
    """The first column whose centre on a line is not left of the edge from (x, y) down by dy > 0 and across by dx.

    ceil((x + dx (256 line + 128 - y) / dy - 128) / 256), exact.

    >>> int(edges(128, 0, 0, 2560, 3)), int(edges(129, 0, 0, 2560, 3))
    (0, 1)
    """
    x, y, dx, dy, line = integers(x, y, dx, dy, line)
    return -((-(x - HALF) * dy - dx * (line * ONE + HALF - y)) // (ONE * dy))


def cross(p: ArrayLike, q: ArrayLike, s: ArrayLike, t: ArrayLike, minus: ArrayLike = 0) -> Int:
    """p q - s t, or with ``minus`` s t - p q, exact (``shade_cross``).

    >>> int(cross(3, 5, 2, 4))
    7
    """
    p, q, s, t, minus = integers(p, q, s, t, minus)
    return np.where(minus == 1, s * t - p * q, p * q - s * t)


def line_of(y: ArrayLike) -> Int:
    """The first line whose centre is not above y: ceil((y - 128) / 256); the same of a column and x."""
    (y,) = integers(y)
    return (y + HALF - 1) >> k.SUBPIXEL_F


def vertices(v: Vertices) -> dict[str, NDArray[np.bool_]]:
    """Which triangles have numbers out of range, a normal of length 0, no area; the first that holds counts
    (``shade_vertices``, and the area ``shade_setup``).
    """
    place = 1 << k.COORDINATE_W - 1
    bound = 1 << k.VERTEX_F
    bad = np.any([np.any((c < -place) | (c >= place), axis=1) for c in (v.x, v.y)], axis=0)
    bad |= np.any((v.depth < 0) | (v.depth >= 1 << k.DEPTH_F), axis=1)
    bad |= np.any((v.normal < -bound) | (v.normal >= bound), axis=(1, 2))
    zero = ~bad & np.any(np.all(v.normal == 0, axis=2), axis=1)
    area = np.where(bad, 1, twice_area(v))
    return {"range": bad, "normal": zero, "area": ~bad & ~zero & (area == 0)}


def twice_area(v: Vertices) -> Int:
    """dx1 dy2 - dx2 dy1 (T,), exact."""
    dx, dy = v.x[:, 1:] - v.x[:, :1], v.y[:, 1:] - v.y[:, :1]
    return cross(dx[:, 0], dy[:, 1], dx[:, 1], dy[:, 0])


def setup(v: Vertices, flat: int = 0) -> tuple[Int, Int, Int]:
    """Increments of normal and depth per column and line (T, 4), modulo 2^40, and which are steep (``shade_setup``)."""
    area = twice_area(v)
    sign = np.sign(area)
    r, e = reciprocal(np.abs(area))
    dx, dy = v.x[:, 1:] - v.x[:, :1], v.y[:, 1:] - v.y[:, :1]
    found, steep = np.zeros((2, len(v), COMPONENTS), np.int64), np.zeros((len(v), COMPONENTS), np.int64)
    for c in range(COMPONENTS):
        depth = c == COMPONENTS - 1
        value = v.depth if depth else v.normal[:, :, c]
        value = value[:, 1:] - value[:, :1] if depth or not flat else np.zeros_like(value[:, 1:])
        crossed = [cross(value[:, 0], way[:, 1], value[:, 1], way[:, 0]) for way in (dy, dx)]
        found[0, :, c], far_column = gradient(sign * crossed[0], r, e, depth)
        found[1, :, c], far_line = gradient(-sign * crossed[1], r, e, depth)
        steep[:, c] = far_column | far_line
    return found[0], found[1], steep


def plane(v: Vertices, dcolumn: Int, dline: Int, column: ArrayLike, line: ArrayLike) -> Int:
    """Normal and depth (T, 4) at a pixel's centre: vertex 0 and the way from there, rounded once (``shade_plane``)."""
    away_x, away_y = column * ONE + HALF - v.x[:, 0], line * ONE + HALF - v.y[:, 0]
    way = round(dcolumn * away_x[:, None] + dline * away_y[:, None], k.SUBPIXEL_F)  # modulo 2^56
    normal = v.normal[:, 0] << k.STEP_F - k.VERTEX_F
    depth = v.depth[:, :1] << k.PLANE_F - k.DEPTH_F
    return wrap(np.concatenate([normal, depth], axis=1) + way, k.STEP_W)


def raster(v: Vertices, view: View) -> tuple[Int, Int, Int, Int]:
    """(triangle, line, column, count) of all runs, by triangle, then downwards (``shade_raster``)."""
    lines = np.stack([line_of(v.y.min(axis=1)), line_of(v.y.max(axis=1))], axis=1).clip(0, view.lines)
    t, step = walk(lines[:, 1] - lines[:, 0])
    line = lines[t, 0] + step
    left, right = np.full(len(t), -(1 << 40)), np.full(len(t), 1 << 40)
    for a, b in ((0, 1), (1, 2), (2, 0)):
        turned = v.y[:, a] > v.y[:, b]  # the upper one first
        upper, lower = np.where(turned, b, a), np.where(turned, a, b)
        row = np.arange(len(v))
        x, y = v.x[row, upper], v.y[row, upper]
        dx, dy = v.x[row, lower] - x, v.y[row, lower] - y
        crossed = (line >= line_of(y)[t]) & (line < line_of(y + dy)[t])
        at = edges(x[t], y[t], dx[t], np.maximum(dy[t], 1), line)
        on_right = (twice_area(v) > 0) ^ turned  # an edge that goes down around the inside on its right hand
        left = np.where(crossed & ~on_right[t], at, left)
        right = np.where(crossed & on_right[t], at, right)
    left, right = np.maximum(left, 0), np.minimum(right, view.columns)
    kept = left < right
    return t[kept], line[kept], left[kept], (right - left)[kept]


def narrow(increments: Int, size: Int) -> NDArray[np.bool_]:
    """Is the increment of every component of a normal, times the largest power of two below ``size``, in [-2, 2)?"""
    power = np.frexp(np.maximum(size - 1, 1).astype(np.float64))[1].astype(np.int64) - 1
    return np.all((increments[:, :3] >> k.STEP_F + 1 - power[:, None]) + 1 >> 1 == 0, axis=1)


def scan(v: Vertices, view: View) -> Scanned:
    """Triangles to planes and runs (``shade_scan``)."""
    bad = vertices(v)
    wrong = np.any(list(bad.values()), axis=0)
    area = np.where(wrong, 1, twice_area(v))
    culled = ~wrong & np.select([view.cull == k.CULL_BACK, view.cull == k.CULL_FRONT], [area > 0, area < 0], False)
    index = np.flatnonzero(~wrong & ~culled)
    kept = take(v, index)
    triangle, line, column, count = raster(kept, view)
    hit, at = np.unique(triangle, return_index=True)
    shown = take(kept, hit)
    dcolumn, dline, far = setup(shown, view.flat)
    first, steep = plane(shown, dcolumn, dline, column[at], line[at]), far[:, :3].any(axis=1)
    dcolumn, dline = wrap(dcolumn, k.STEP_W), wrap(dline, k.STEP_W)
    low = np.maximum(line_of(shown.x.min(axis=1)), 0)
    columns = np.minimum(line_of(shown.x.max(axis=1)), view.columns) - low
    lines = np.minimum(line_of(shown.y.max(axis=1)), view.lines) - line[at]
    box = np.stack([column[at], line[at], columns, lines, column[at] - low], axis=-1)
    return Scanned(
        index=index[hit],
        plane=first,
        dcolumn=dcolumn,
        dline=dline,
        box=box,
        steep=steep.astype(np.int64),
        narrow=(~steep & narrow(dcolumn, columns) & narrow(dline, lines)).astype(np.int64),
        tag=shown.tag,
        flat=shown.flat,
        triangle=np.searchsorted(hit, triangle),
        column=column,
        line=line,
        count=count,
        faults={"packet": 0} | {name: int(rows.sum()) for name, rows in bad.items()},
        culled=int(culled.sum()),
        empty=len(index) - len(hit),
    )


def take(v: Vertices, rows: ArrayLike) -> Vertices:
    """Some of the triangles."""
    return Vertices(*(getattr(v, name)[rows] for name in ("x", "y", "depth", "normal", "tag", "flat")))


def starts(s: Scanned) -> Int:
    """Normal and depth (S, 4) at the first pixel of every run (``shade_starts``)."""
    across, down = s.column - s.box[s.triangle, 0], s.line - s.box[s.triangle, 1]
    way = s.dcolumn[s.triangle] * across[:, None] + s.dline[s.triangle] * down[:, None]
    return wrap(s.plane[s.triangle] + way, k.STEP_W)


def depths(s: Scanned) -> tuple[Int, Int, Int, Int]:
    """(run, column, line, depth U0.24) of every pixel: the plane's depth, cut, from 0 to FARTHEST."""
    run, step = walk(s.count)
    value = wrap(starts(s)[run, 3] + s.dcolumn[s.triangle[run], 3] * step, k.STEP_W)
    return run, s.column[run] + step, s.line[run], np.clip(value >> k.PLANE_F - k.DEPTH_F, 0, FARTHEST)


FARTHEST = (1 << k.DEPTH_F) - 2
"""Depth of a pixel that is farther away than all; one more is that of a place without a triangle."""


def depth(s: Scanned, memory: Int) -> tuple[Scanned, Int]:
    """What of the runs is seen: nearer than the memory (4096, 4096) and all pixels before; and the memory behind it
    (``shade_depth``).
    """
    run, column, line, deep = depths(s)
    place = line << k.PLACE_W | column
    nearest = memory[line, column].copy()
    order = np.argsort(place, kind="stable")
    group = np.cumsum(np.diff(place[order], prepend=-1) != 0)  # the pixels of a place, in the order of drawing
    drop = (group[-1:] - group) << k.DEPTH_F + 1  # more than what any pixel of a group has to one before it
    least = np.minimum.accumulate(deep[order] + drop) - drop
    before = np.r_[0, least][:-1]
    nearest[order] = np.where(np.diff(group, prepend=0) != 0, nearest[order], np.minimum(nearest[order], before))
    seen = deep < nearest
    after = memory.copy()
    np.minimum.at(after, (line, column), deep)

    goes_on = np.r_[False, seen[:-1] & (run[1:] == run[:-1])][: len(run)]
    opened = seen & ~goes_on  # a stretch of pixels begins
    stretch = (np.cumsum(opened) - 1)[seen]
    at, count = np.flatnonzero(opened), np.bincount(stretch, minlength=opened.sum())
    triangle = s.triangle[run[at]]
    kept, of = np.unique(triangle, return_inverse=True)
    last = np.r_[np.flatnonzero(np.diff(s.triangle[run])), len(run) - 1][: len(run)]  # the last pixel of each triangle
    ended = np.zeros(len(s.index), np.int64)
    ended[s.triangle[run[last]]] = ~seen[last] & ~goes_on[last]
    some = {
        name: getattr(s, name)[kept]
        for name in ("index", "plane", "dcolumn", "dline", "box", "steep", "narrow", "tag", "flat")
    }
    runs = {"triangle": of, "column": column[at], "line": line[at], "count": count}
    return replace(s, **some, **runs, ended=ended[kept]), after


def heads(s: Scanned) -> tuple[dict[str, Int], NDArray[np.bool_]]:
    """The leaves of the packets TRIANGLE (N,) by name, and the runs (S,) with which they begin.

    One begins with a triangle's first run, with every run of one whose increments do not fit, and with one that is on
    the line of the run before.
    """
    first = np.diff(s.triangle, prepend=-1) != 0
    opened = first | _again(s) | (s.narrow[s.triangle] == 0)
    t, at = s.triangle[opened], np.flatnonzero(opened)
    fits = (s.narrow[t] == 1)[:, None]
    columns, lines, left = np.where(fits, s.box[t, 2:], np.stack([s.count[at], 1 + 0 * at, 0 * at], axis=-1)).T
    values = {"columns": columns, "lines": lines, "left": left, "tag": s.tag[t], "flat": s.flat[t]}
    normal, _ = growth(np.where(fits, s.plane[t, :3], starts(s)[at, :3]), 0)
    dcolumn, values["dcolumn.exp"] = growth(np.where((columns == 1)[:, None], 0, s.dcolumn[t, :3]), 15)
    dline, values["dline.exp"] = growth(np.where((lines == 1)[:, None], 0, s.dline[t, :3]), 15)
    for name, vector in (("normal", normal), ("dcolumn.mantissa", dcolumn), ("dline.mantissa", dline)):
        values |= {f"{name}.{axis}": vector[:, i] for i, axis in enumerate("xyz")}
    return values, opened


def _again(s: Scanned) -> NDArray[np.bool_]:
    """Runs on the line of the one before, of a triangle whose increments fit: an empty run ends the packet before."""
    same = (np.diff(s.triangle, prepend=-1) == 0) & (np.diff(s.line, prepend=-1) == 0)
    return same & (s.narrow[s.triangle] == 1)


def packets(s: Scanned) -> dict[str, NDArray]:
    """The runs as packets TRIANGLE and RUN: ``s_axis_surface_tdata`` and ``_tlast`` (``shade_packets``)."""
    values, opened = heads(s)
    narrow, again = s.narrow[s.triangle] == 1, _again(s)
    site = s.box[s.triangle, :2]
    moved = opened & narrow & np.any(site != np.stack([s.column, s.line], axis=-1), axis=1)
    closing = np.diff(s.triangle, append=-1) != 0  # the last run of its triangle
    ended = (s.ended[s.triangle] if s.ended is not None else 0 * s.triangle) == 1
    follows = closing & ended & narrow

    def run(column: Int, line: Int, count: ArrayLike) -> NDArray[np.uint64]:
        return pack(RUN, {"column": column, "line": line, "count": count}).view(np.uint64)[:, 0]

    # of each run: an empty one that ends a packet, a head, an empty one at its pixel, itself, an empty one
    beats = np.zeros((len(s.count), 4 + k.TRIANGLE_BEATS), np.uint64)
    beats[opened, 1:-3] = pack(TRIANGLE, values).view(np.uint64)
    beats[:, -3], beats[:, -2] = run(*site.T, 0), run(s.column, s.line, s.count)
    head = [opened] * k.TRIANGLE_BEATS
    used = np.stack([again, *head, moved, again | True, follows], axis=1)
    ends = (closing & ~ended) | ~narrow
    last = np.stack([again, *(0 * part for part in head), 0 * moved, ends, follows], axis=1)
    return {"s_axis_surface_tdata": beats[used], "s_axis_surface_tlast": last[used].astype(np.int64)}


surfaces = packets
"""Vertices to packets (``shade_surfaces``): the same, of what :func:`scan` found."""


def growth(vector: Int, most: int) -> tuple[Int, Int]:
    """Increments S2.29 as mantissas S1.16 and the largest exponent, up to ``most``, with which all of them fit.

    >>> [v.tolist() for v in growth(np.array([[1 << 25, 0, -5]]), 15)]
    [[[65536, 0, 0]], [4]]
    """
    exp = np.zeros(len(vector), np.int64)
    for step in (8, 4, 2, 1):
        fits = np.all((vector << (exp + step)[:, None] >> k.STEP_F + 1) + 1 >> 1 == 0, axis=1) & (exp + step <= most)
        exp += step * fits
    return limit(round(vector << exp[:, None], k.STEP_F - k.INTENSITY_F)), exp


def lines(s: Scanned) -> dict[str, Int]:
    """The runs as packets SPAN, and where they begin, by the names of the leaves (``shade_lines``)."""
    start, single = starts(s), s.count == 1
    vectors = {"normal": start, "increment": np.where(single[:, None], 0, s.dcolumn[s.triangle])}
    found = {f"{name}.{axis}": v[:, i] for name, v in vectors.items() for i, axis in enumerate("xyz")}
    one = np.full(len(s.count), 1 << k.INTENSITY_F)
    found |= {"column": s.column, "line": s.line, "depth": start[:, 3], "increase": s.dcolumn[s.triangle, 3]}
    return found | {"count": s.count, "tag": s.tag[s.triangle], "cosine": one, "flat": s.flat[s.triangle]}


spans = lines
"""Vertices to spans (``shade_spans``): the same, of what :func:`scan` found."""


def frame(view: View, background: ArrayLike, column: Int, line: Int, pixels: Int) -> Int:
    """A picture (lines, columns, ...): the background, and what was drawn upon it, the last one at each place
    (``shade_frame``).
    """
    (background,) = integers(background)
    picture = np.broadcast_to(background, (view.lines, view.columns, *background.shape)).copy()
    place = line * view.columns + column
    _, back = np.unique(place[::-1], return_index=True)
    last = len(place) - 1 - back
    picture[line[last], column[last]] = pixels[last]
    return picture


def skipped(s: Scanned) -> dict[str, int]:
    """What was left out (``shade_skipped``)."""
    limit, told = (1 << 16) - 1, s.faults | {"culled": s.culled, "empty": s.empty}
    return {name: min(count, limit) for name, count in told.items()}


def beats(v: Vertices) -> dict[str, NDArray]:
    """The packets: ``s_axis_vertex_tdata`` and ``_tlast``."""
    values = {"x": v.x, "y": v.y, "depth": v.depth, "tag": v.tag[:, None], "flat": v.flat[:, None]}
    values |= {f"normal.{axis}": v.normal[..., i] for i, axis in enumerate("xyz")}
    data = pack(VERTEX, values).reshape(-1, k.VERTEX_DATA_W // 32)
    return {"s_axis_vertex_tdata": data, "s_axis_vertex_tlast": np.arange(len(data)) % 3 // 2}
