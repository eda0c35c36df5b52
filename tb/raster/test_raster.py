# SPDX-License-Identifier: Apache-2.0
"""shade_raster: edges to runs, for all kinds of triangles, with late edges and late credits; a reset in the middle."""

from __future__ import annotations

import cocotb
import numpy as np
from polyshade.golden import raster as golden

from tb.bench import Bench, Source, Watch, checked
from tb.raster.streams import fields, word
from tb.raster.vectors import edges, mixture
from tb.runner import points, simulate

SIZE = 40


@points({})
def test_cocotb(point):
    simulate("shade_raster", point)


def walked(v: golden.Vertices) -> list[tuple[int, ...]]:
    """column, line, count, last, none of all runs."""
    t, line, column, count = golden.raster(v, golden.View(SIZE, SIZE - 3))
    found = []
    for row in range(len(v)):
        runs = np.flatnonzero(t == row)
        found += [(column[i], line[i], count[i], int(i == runs[-1]), 0) for i in runs]
        found += [(None, None, None, 1, 1)] * (len(runs) == 0)
    return found


@checked(gap=[0.0, 0.6], thrift=[0.0, 0.8])
async def runs(bench: Bench, gap: float, thrift: float) -> None:
    """Every run of every triangle."""
    dut = bench.dut
    dut.columns_i.value, dut.lines_i.value = SIZE, SIZE - 3
    source = Source(bench, "edge_valid_i", "edge_ready_o", ["edge_i"])
    watch = Watch(bench, "valid_o", ["run_o"], "credit_i", thrift)
    v = mixture(bench.rng, 12, SIZE)
    v = golden.take(v, np.flatnonzero(golden.twice_area(v) != 0))
    if thrift == 0.0:
        cocotb.start_soon(source.send([(word("edge_t", **edge),) for edge in edges(v, 0)[:2]]))
        await bench.tick(30)
        source.withdraw()
        await bench.reset()
        watch.words.clear()
    await source.send([(word("edge_t", **edge),) for row in range(len(v)) for edge in edges(v, row)], gap)
    wanted = walked(v)
    await bench.until(lambda: len(watch.words) >= len(wanted), 40_000, "all runs")
    await bench.tick(40)
    bench.equal(len(watch.words), len(wanted), "runs")
    for (bits,), (column, line, count, last, none) in zip(watch.words, wanted, strict=True):
        run = fields("walked_t", bits)
        bench.equal((run["last"], run["none"]) == (last, none), True, f"ends of {run}")
        if not none:
            place = (run["column"], run["line"], run["count"])
            bench.equal(place == (column, line, count), True, f"{place} is {(column, line, count)}")
