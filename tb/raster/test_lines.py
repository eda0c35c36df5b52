# SPDX-License-Identifier: Apache-2.0
"""shade_lines: surfaces and runs to packets SPAN, with gaps and stalls; a waiting packet stays as it is."""

from __future__ import annotations

import cocotb
from polyshade.golden import contract as k
from polyshade.golden import raster as golden
from polyshade.golden.types import SPAN, whole

from tb.bench import PRESSURE, Bench, Sink, Source, checked
from tb.raster.streams import fields
from tb.raster.test_starts import runs, surfaces
from tb.raster.vectors import mixture
from tb.runner import points, simulate


@points({})
def test_cocotb(point):
    simulate("shade_lines", point)


@checked(**PRESSURE)
async def packets(bench: Bench, gap: float, stall: float) -> None:
    """Every packet and its place."""
    s = golden.scan(mixture(bench.rng, 25, 50), golden.View(50, 50, k.CULL_NONE))
    triangles = Source(bench, "surface_valid_i", "surface_ready_o", ["surface_i"])
    places = Source(bench, "run_valid_i", "run_ready_o", ["run_i"])
    ports = ["m_axis_span_tdata", "m_axis_span_tuser"]
    sink = Sink(bench, "m_axis_span_tvalid", "m_axis_span_tready", ports, stall)
    cocotb.start_soon(triangles.send(surfaces(s), gap / 2))
    await places.send(runs(s), gap)
    await bench.until(lambda: len(sink.words) >= len(s.count), 20_000, "all spans")
    await bench.tick(30)
    wanted = golden.lines(s)
    spots = {name: wanted.pop(name) for name in ("column", "line", "depth", "increase")}
    expected = whole(SPAN, wanted)
    bench.equal(len(sink.words), len(expected), "spans")
    for i, (data, user) in enumerate(sink.words):
        bench.equal(data, expected[i], f"span {i}", k.SPAN_DATA_W)
        spot = fields("spot_t", user)
        bench.equal(all(spot[name] == value[i] for name, value in spots.items()), True, f"place of span {i}")
