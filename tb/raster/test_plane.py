# SPDX-License-Identifier: Apache-2.0
"""shade_plane: value at the first pixel, from pairs, vertex 0 and first run; triangles without a run are dropped."""

from __future__ import annotations

import random

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import raster as golden

from tb.bench import PRESSURE, Bench, Sink, Source, checked
from tb.raster.streams import fields, word
from tb.raster.test_setup import corner
from tb.raster.test_starts import AXES, runs
from tb.raster.vectors import mixture
from tb.runner import points, simulate

SIZE = 50


@points({})
def test_cocotb(point):
    simulate("shade_plane", point)


async def pulses(bench: Bench, valid: str, port: str, words: list[int], room: int, out: list, per: int) -> None:
    """Write words into one of the unit's FIFOs, never more than fit behind those that are known to have left."""
    for i, bits in enumerate(words):
        while i // per >= len(out) + room or random.random() < 0.3:
            await bench.tick()
        getattr(bench.dut, port).value = bits
        getattr(bench.dut, valid).value = 1
        await bench.tick()
        getattr(bench.dut, valid).value = 0


@checked(**PRESSURE)
async def triangles(bench: Bench, gap: float, stall: float) -> None:
    """All kinds; every run passes, in order, behind or before its surface."""
    view = golden.View(SIZE, SIZE, k.CULL_NONE)
    v = mixture(bench.rng, 12, SIZE)
    v = golden.take(v, np.flatnonzero((golden.twice_area(v) != 0) & ((v.y.max(axis=1) - v.y.min(axis=1)) < 9000)))
    hit = np.unique(golden.raster(v, view)[0])
    v = golden.take(v, hit)
    s = golden.scan(v, view)
    bench.dut.pair_valid_i.value = bench.dut.run_valid_i.value = 0
    surfaces = Sink(bench, "surface_valid_o", "surface_ready_i", ["surface_o"], stall)
    places = Sink(bench, "run_valid_o", "run_ready_i", ["run_o"], stall)
    heads = Source(bench, "head_valid_i", "head_ready_o", ["head_i"])
    span = {"wide": np.abs(np.stack([v.x - v.x[:, :1], v.y - v.y[:, :1]])).max(axis=(0, 2)) >= 1 << 16}
    sized = [
        word(
            "sized_t", left=max(0, golden.line_of(v.x[i].min())), right=min(SIZE, golden.line_of(v.x[i].max())),
            bottom=min(SIZE, golden.line_of(v.y[i].max())), wide=span["wide"][i],
            **{f"corner.{name}": value for name, value in corner(v, i).items()},
        )
        for i in range(len(v))
    ]  # fmt: skip
    column, line, steep = golden.setup(v)
    pairs = [
        word("pair_t", column=column[i, c], line=line[i, c], steep=steep[i, c]) for i in range(len(v)) for c in range(4)
    ]
    walked = [bits for (bits,) in runs(s)]
    cocotb.start_soon(heads.send([(bits,) for bits in sized], gap))
    cocotb.start_soon(pulses(bench, "pair_valid_i", "pair_i", pairs, 3, surfaces.words, 4))
    cocotb.start_soon(pulses(bench, "run_valid_i", "run_i", walked, 16, places.words, 1))
    await bench.until(lambda: len(places.words) == len(walked), 40_000, "all runs")
    await bench.until(lambda: len(surfaces.words) == len(v), 2_000, "all surfaces")
    bench.equal([bits for (bits,) in places.words] == walked, True, "runs")
    for i, (bits,) in enumerate(surfaces.words):
        found = fields("surface_t", bits)
        for name, wanted in (("value", s.plane), ("dcolumn", s.dcolumn), ("dline", s.dline)):
            for c, axis in enumerate(AXES):
                bench.equal(found[f"{name}.{axis}"], int(wanted[i, c]), f"{name}.{axis} of {i}", k.STEP_W)
        box = (found["columns"], found["lines"], found["left"], found["tag"], found["steep"])
        bench.equal(box == (*s.box[i, 2:], s.tag[i], s.steep[i]), True, f"box of {i}")
