# SPDX-License-Identifier: Apache-2.0
"""shade_scan: vertices to surfaces and runs with gaps, stalls on either side, and a reset in the middle."""

from __future__ import annotations

import cocotb
from polyshade.golden import contract as k
from polyshade.golden import raster as golden
from polyshade.golden.types import VERTEX, whole

from tb.bench import PRESSURE, Bench, Sink, Source, checked
from tb.raster.streams import word
from tb.raster.test_starts import runs, surfaces
from tb.raster.vectors import mixture
from tb.runner import points, simulate

SIZE = 50


@points({})
def test_cocotb(point):
    simulate("shade_scan", point)


def beats(v: golden.Vertices) -> list[tuple[int, int]]:
    """Words of the input stream, and their end marks."""
    values = {"x": v.x, "y": v.y, "depth": v.depth, "tag": v.tag[:, None], "flat": v.flat[:, None]}
    values |= {f"normal.{axis}": v.normal[..., i] for i, axis in enumerate("xyz")}
    flat = {name: (value + 0 * v.x).ravel() for name, value in values.items()}
    return [(bits, int(i % 3 == 2)) for i, bits in enumerate(whole(VERTEX, flat))]


@checked(**PRESSURE)
async def triangles(bench: Bench, gap: float, stall: float) -> None:
    """Every surface and run, also when the streams stall at different times; before that, a reset at any moment."""
    dut = bench.dut
    dut.view_i.value = word("view_t", columns=SIZE, lines=SIZE, cull=k.CULL_NONE)
    ports = [f"s_axis_vertex_t{name}" for name in ("data", "last")]
    source = Source(bench, "s_axis_vertex_tvalid", "s_axis_vertex_tready", ports)
    planes = Sink(bench, "surface_valid_o", "surface_ready_i", ["surface_o"], stall)
    places = Sink(bench, "run_valid_o", "run_ready_i", ["run_o"], stall / 2)
    v = mixture(bench.rng, 10, SIZE)
    for _ in range(5):
        task = cocotb.start_soon(source.send(beats(v), gap))
        await bench.tick(int(bench.rng.integers(1, 120)))
        task.cancel()
        source.withdraw()
        await bench.reset(1)
        await bench.tick()
        planes.forget()
        places.forget()
    s = golden.scan(v, golden.View(SIZE, SIZE, k.CULL_NONE))
    await source.send(beats(v), gap)
    await bench.until(lambda: len(places.words) >= len(s.count), 60_000, "all runs")
    await bench.tick(2000)
    bench.equal(places.words == runs(s), True, "runs")
    bench.equal(planes.words == surfaces(s), True, "surfaces")
