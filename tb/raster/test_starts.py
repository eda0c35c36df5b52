# SPDX-License-Identifier: Apache-2.0
"""shade_starts: normal and depth at every run, for triangles of all kinds, with gaps, late credits and empty lines."""

from __future__ import annotations

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import raster as golden

from tb.bench import Bench, Source, Watch, checked
from tb.raster.streams import fields, word
from tb.raster.vectors import mixture
from tb.runner import points, simulate

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
        columns, lines, left = s.box[i, 2:]
        values |= {"columns": columns, "lines": lines, "left": left, "tag": s.tag[i], "flat": s.flat[i]}
        found.append((word("surface_t", narrow=s.narrow[i], **values),))
    return found


def runs(s: golden.Scanned) -> list[tuple[int]]:
    """Words of ``walked_t``."""
    last = np.r_[s.triangle[1:] != s.triangle[:-1], True]
    return [
        (word("walked_t", column=s.column[i], line=s.line[i], count=s.count[i], last=last[i]),)
        for i in range(len(s.count))
    ]


@checked(gap=[0.0, 0.6], thrift=[0.0, 0.8])
async def values(bench: Bench, gap: float, thrift: float) -> None:
    """Start, place and triangle of every run."""
    s = golden.scan(mixture(bench.rng, 25, 50), golden.View(50, 50, k.CULL_NONE))
    triangles = Source(bench, "surface_valid_i", "surface_ready_o", ["surface_i"])
    places = Source(bench, "run_valid_i", "run_ready_o", ["run_i"])
    watch = Watch(bench, "valid_o", ["run_o", "start_o", "surface_o", "first_o"], "credit_i", thrift)
    cocotb.start_soon(triangles.send(surfaces(s), gap / 2))
    await places.send(runs(s), gap)
    await bench.until(lambda: len(watch.words) >= len(s.count), 20_000, "all runs")
    await bench.tick(30)
    bench.equal(len(watch.words), len(s.count), "runs")
    wanted = golden.starts(s)
    for i, (run, start, surface, first) in enumerate(watch.words):
        place, value = fields("walked_t", run), fields("plane_t", start)
        bench.equal((place["column"], place["line"]) == (s.column[i], s.line[i]), True, f"place of run {i}")
        for c, axis in enumerate(AXES):
            bench.equal(value[axis], int(wanted[i, c]), f"run {i}: {axis}", k.STEP_W)
        bench.equal(fields("surface_t", surface)["tag"], int(s.tag[s.triangle[i]]), f"tag of run {i}")
        bench.equal(first, int(i == 0 or s.triangle[i] != s.triangle[i - 1]), f"first of run {i}")
