# SPDX-License-Identifier: Apache-2.0
"""Set-up and scan conversion of integers against exact rationals, and the perspective that interpolation leaves out."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from polyshade.golden import contract as k
from polyshade.golden import raster as golden
from polyshade.golden.reference.raster import interpolate

from tb.raster.vectors import KINDS, fan, triangles
from tb.runner import SEED

STRETCH = Fraction(1, 1 << 17) + Fraction(1, 1 << 19)  # of the way from vertex 0, by the reciprocal


def exact(v: golden.Vertices, row: int, column: int, line: int) -> list[Fraction]:
    """Normal and depth at a pixel's centre, in ulp of a plane: a rational number."""
    x, y = ([int(c) for c in axis[row]] for axis in (v.x, v.y))
    px, py = 256 * column + 128, 256 * line + 128
    area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
    one = Fraction((px - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (py - y[0]), area)
    two = Fraction((x[1] - x[0]) * (py - y[0]) - (px - x[0]) * (y[1] - y[0]), area)
    found = []
    for c in range(golden.COMPONENTS):
        value = [int(n) for n in (v.depth[row] if c == 3 else v.normal[row, :, c])]
        up = k.PLANE_F - k.DEPTH_F if c == 3 else k.STEP_F - k.VERTEX_F
        found.append((value[0] + one * (value[1] - value[0]) + two * (value[2] - value[0])) * (1 << up))
    return found


@pytest.mark.parametrize("kind", KINDS)
def test_error_of_every_pixel(kind: str) -> None:
    """At the first pixel of every run: 3/4 ulp a pixel of the way, 1/2 ulp, and the stretch by the reciprocal."""
    v = triangles(np.random.default_rng(SEED), kind, 20 if kind == "huge" else 400, 128)
    s = golden.scan(v, golden.View(128, 128, k.CULL_NONE))
    starts = golden.starts(s)
    chosen = np.random.default_rng(SEED).permutation(len(s.count))[:1500]
    checks = 0
    for i in chosen:
        t, row = s.triangle[i], s.index[s.triangle[i]]
        first = [int(p) for p in s.box[t, :2]]
        way = [abs(Fraction(256 * first[a] + 128 - int(axis[row, 0]), 256)) for a, axis in enumerate((v.x, v.y))]
        way += [abs(int(s.column[i]) - first[0]), abs(int(s.line[i]) - first[1])]
        wanted = exact(v, row, int(s.column[i]), int(s.line[i]))
        base = [int(n) << k.STEP_F - k.VERTEX_F for n in v.normal[row, 0]]
        base.append(int(v.depth[row, 0]) << k.PLANE_F - k.DEPTH_F)
        for c in range(golden.COMPONENTS):
            bound = Fraction(3, 4) * sum(way) + Fraction(1, 2) + STRETCH * abs(wanted[c] - base[c])
            assert abs(int(starts[i, c]) - wanted[c]) <= bound
            checks += 1
    assert checks > 10


def test_each_pixel_of_common_edges_once() -> None:
    """A closed fan: no pixel twice."""
    s = golden.scan(fan(np.random.default_rng(SEED), 60, 90), golden.View(90, 90, k.CULL_NONE))
    _, column, line, _ = golden.depths(s)
    assert len(np.unique(line * 90 + column)) == len(column) > 3000


def test_coverage_by_definition() -> None:
    """Pixel by pixel: E > 0 of three edges, or E = 0 on a top or a left one."""
    v = triangles(np.random.default_rng(SEED), "small", 300, 12)
    v = golden.take(v, np.flatnonzero(golden.twice_area(v) != 0))
    t, line, column, count = golden.raster(v, golden.View(12, 12))
    hits = np.zeros((len(v), 12, 12), bool)
    for i in range(len(t)):
        hits[t[i], line[i], column[i] : column[i] + count[i]] = True
    py, px = np.mgrid[0:12, 0:12] * 256 + 128
    turned = golden.twice_area(v) < 0
    for row in range(len(v)):
        order = (0, 2, 1) if turned[row] else (0, 1, 2)
        inside = np.ones((12, 12), bool)
        for a, b in zip(order, (*order[1:], order[0]), strict=True):
            dx, dy = v.x[row, b] - v.x[row, a], v.y[row, b] - v.y[row, a]
            e = dx * (py - v.y[row, a]) - dy * (px - v.x[row, a])
            inside &= (e > 0) | ((e == 0) & ((dy < 0) | ((dy == 0) & (dx > 0))))
        assert np.array_equal(inside, hits[row])


def test_reference() -> None:
    """Float64 agrees with the integers as far as these can."""
    v = triangles(np.random.default_rng(SEED), "middle", 500, 128)
    s = golden.scan(v, golden.View(128, 128, k.CULL_NONE))
    rows = golden.take(v, s.index)
    places = np.stack([rows.x, rows.y], axis=-1)
    found = interpolate(places, rows.normal, s.box[:, :2] * 256 + 128) * 2.0 ** (k.STEP_F - k.VERTEX_F)
    assert np.median(np.abs(found - s.plane[:, :3])) < 2.0 ** (k.STEP_F - 18)
