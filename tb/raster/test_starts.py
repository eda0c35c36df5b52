# SPDX-License-Identifier: Apache-2.0
"""shade_starts: normal and depth at every run, for triangles of all kinds, with gaps, stalls and empty lines."""

from __future__ import annotations

from dataclasses import replace

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import raster as golden
from polyshade.golden.types import BEGUN, whole

from tb.bench import PRESSURE, Bench, Sink, Source, checked
from tb.raster.streams import fields, word
from tb.raster.vectors import mixture
from tb.runner import FULL, points, simulate

AXES = ("normal.x", "normal.y", "normal.z", "depth")


@points({})
def test_cocotb(point):
    simulate("shade_starts", point)


def surfaces(s: golden.Scanned) -> list[tuple[int]]:
    """Words of ``surface_t``."""
    parts = {"value": s.plane, "dcolumn": s.dcolumn, "dline": s.dline}
    found = []
    for i in range(len(s.index)):
        values = {f"{name}.{axis}": v[i, c] for name, v in parts.items() for c, axis in enumerate(AXES)}
        column, line, columns, lines, left = s.box[i]
        values |= {
            "site.column": column,
            "site.line": line,
            "columns": columns,
            "lines": lines,
            "left": left,
            "tag": s.tag[i],
            "flat": s.flat[i],
            "steep": s.steep[i],
        }
        found.append((word("surface_t", **values),))
    return found


def runs(s: golden.Scanned) -> list[tuple[int]]:
    """Words of ``walked_t``."""
    last = np.r_[s.triangle[1:] != s.triangle[:-1], True]
    return [
        (word("walked_t", column=s.column[i], line=s.line[i], count=s.count[i], last=last[i]),)
        for i in range(len(s.count))
    ]


def begun(s: golden.Scanned) -> list[tuple[int]]:
    """Words of ``begun_t``."""
    start, of = golden.starts(s), s.triangle
    values = {f"value.{axis}": start[:, c] for c, axis in enumerate(AXES)}
    for name, v in (("value", s.plane), ("dcolumn", s.dcolumn), ("dline", s.dline)):
        values |= {f"surface.{name}.{axis}": v[of, c] for c, axis in enumerate(AXES)}
    box = zip(("site.column", "site.line", "columns", "lines", "left"), s.box[of].T, strict=True)
    values |= {f"surface.{name}": v for name, v in box}
    values |= {f"surface.{name}": getattr(s, name)[of] for name in ("tag", "flat", "steep")}
    last = np.r_[of[1:] != of[:-1], True]
    values |= {"run.column": s.column, "run.line": s.line, "run.count": s.count, "run.last": last, "run.none": 0 * last}
    return [(bits,) for bits in whole(BEGUN, values | {"first": np.r_[True, of[1:] != of[:-1]]})]


def cut(rng: np.random.Generator, s: golden.Scanned) -> golden.Scanned:
    """The runs in pieces, some of them left out: several on a line, lines without one."""
    run, step = golden.walk(s.count)
    kept = rng.random(len(run)) < 0.8
    kept &= rng.random(len(s.count))[run] < 0.8
    opened = kept & ~np.r_[False, kept[:-1] & (run[1:] == run[:-1])]
    at, count = run[opened], np.bincount((np.cumsum(opened) - 1)[kept])
    some, of = np.unique(s.triangle[at], return_inverse=True)
    parts = {
        name: getattr(s, name)[some]
        for name in ("plane", "dcolumn", "dline", "box", "steep", "narrow", "tag", "flat", "index")
    }
    return replace(s, **parts, triangle=of, column=s.column[at] + step[opened], line=s.line[at], count=count)


@checked(**PRESSURE, pieces=[0, 1])
async def values(bench: Bench, gap: float, stall: float, pieces: int) -> None:
    """Place, start and triangle of every run, whole or in pieces; those that are none pass."""
    s = golden.scan(mixture(bench.rng, 25 if FULL else 15, 50), golden.View(50, 50, k.CULL_NONE))
    if pieces:
        s = cut(bench.rng, s)
    triangles = Source(bench, "surface_valid_i", "surface_ready_o", ["surface_i"])
    places = Source(bench, "run_valid_i", "run_ready_o", ["run_i"])
    sink = Sink(bench, "valid_o", "ready_i", ["begun_o"], stall)
    cocotb.start_soon(triangles.send(surfaces(s), gap / 2))
    await places.send(runs(s), gap)
    await bench.until(lambda: len(sink.words) >= len(s.count), 20_000, "all runs")
    await bench.tick(30)
    bench.equal(len(sink.words), len(s.count), "runs")
    for i, ((bits,), (wanted,)) in enumerate(zip(sink.words, begun(s), strict=True)):
        found, right = fields("begun_t", bits), fields("begun_t", wanted)
        wrong = [name for name in right if found[name] != right[name]]
        bench.equal(wrong, [], f"run {i}: fields that differ")
    if not (gap or stall or pieces):
        clocks = sink.clocks[-1] - sink.clocks[0] + 1
        bench.equal(clocks <= ways(s), True, f"{clocks} clocks for {len(s.count)} runs")


def ways(s: golden.Scanned) -> int:
    """Clocks that all runs may take: one each, one a column aside and a line without one, two a triangle."""
    same = s.triangle[1:] == s.triangle[:-1]
    aside, down = (np.abs(np.diff(place))[same] for place in (s.column, s.line))
    return int(len(s.count) + aside.sum() + (down - 1).sum() + 2 * len(s.index))
