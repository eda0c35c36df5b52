# SPDX-License-Identifier: Apache-2.0
"""shade_packets: triangles and runs to packets, with gaps and stalls: slivers, pieces of runs, empty ends."""

from __future__ import annotations

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import raster as golden

from tb.bench import PRESSURE, Bench, Sink, Source, checked
from tb.raster.streams import word
from tb.raster.test_starts import begun, cut
from tb.raster.vectors import mixture
from tb.runner import points, simulate


@points({})
def test_cocotb(point):
    simulate("shade_packets", point)


@checked(**PRESSURE, pieces=[0, 1])
async def beats(bench: Bench, gap: float, stall: float, pieces: int) -> None:
    """Every beat; of a triangle whose end was hidden, an empty run."""
    s = golden.scan(mixture(bench.rng, 16, 50), golden.View(50, 50, k.CULL_NONE))
    if pieces:
        s = cut(bench.rng, s)
        s = golden.replace(s, ended=bench.rng.integers(0, 2, len(s.index)))
    source = Source(bench, "valid_i", "ready_o", ["begun_i"])
    ports = ["m_axis_surface_tdata", "m_axis_surface_tlast", "run_o"]
    sink = Sink(bench, "m_axis_surface_tvalid", "m_axis_surface_tready", ports, stall)
    sent, last = [], np.r_[s.triangle[1:] != s.triangle[:-1], True]
    for (bits,), end, triangle in zip(begun(s), last, s.triangle, strict=True):
        follows = end and s.ended is not None and s.ended[triangle]
        sent.append((bits & ~word("begun_t", **{"run.last": 1}) if follows else bits,))
        if follows:
            sent.append((bits & ~word("begun_t", first=1) | word("begun_t", **{"run.last": 1, "run.none": 1}),))
    cocotb.start_soon(source.send(sent, gap))
    wanted = golden.packets(s)
    data, ends = (wanted[f"s_axis_surface_{name}"].tolist() for name in ("tdata", "tlast"))
    await bench.until(lambda: len(sink.words) >= len(data), 60_000, "all beats")
    await bench.tick(30)
    bench.equal(len(sink.words), len(data), "beats")
    for i, (word_, last_, _) in enumerate(sink.words):
        bench.equal(word_, data[i], f"beat {i}", 64)
        bench.equal(last_, ends[i], f"tlast of beat {i}")
    bench.equal(sum(run for *_, run in sink.words), len(s.count), "runs with pixels")
