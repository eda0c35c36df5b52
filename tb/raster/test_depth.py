# SPDX-License-Identifier: Apache-2.0
"""shade_depth: what is nearer goes on, for triangles of all kinds, with gaps, stalls, any latency, resets."""

from __future__ import annotations

import random
from collections import deque

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import raster as golden

from tb.bench import Bench, Sink, Source, checked
from tb.raster.streams import fields, word
from tb.raster.test_starts import runs, surfaces
from tb.raster.vectors import mixture
from tb.runner import FULL, points, simulate

SIZE = 40
FAR = golden.FARTHEST + 1


@points({}, {"LOG2": 2})
def test_cocotb(point):
    simulate("shade_depth", point)


class Memory:
    """Answers in order, each ``latency`` clocks later or up to twice as late; takes writes at once."""

    def __init__(self, bench: Bench, latency: int, stall: float):
        self.bench, self.latency, self.stall = bench, latency, stall
        self.depths = np.full((1 << k.PLACE_W, 1 << k.PLACE_W), FAR)
        self.asked: deque[tuple[int, int, int]] = deque()
        self.questions = 0
        cocotb.start_soon(self._run())

    async def _run(self) -> None:
        dut, clock = self.bench.dut, 0
        dut.answer_valid_i.value = 0
        while True:
            ready = random.random() >= self.stall
            dut.request_ready_i.value = ready
            await self.bench.tick()
            clock += 1
            if int(dut.rst_i.value):
                self.asked.clear()
            elif int(dut.request_valid_o.value) and ready:
                site = fields("site_t", int(dut.request_o.value))
                self.questions += 1
                wait = self.latency - 1 + random.randrange(self.latency)
                self.asked.append((clock + wait, self.depths[site["line"], site["column"]], 0))
            if int(dut.write_valid_o.value) and not int(dut.rst_i.value):
                deep = fields("deep_t", int(dut.write_o.value))
                self.depths[deep["site.line"], deep["site.column"]] = deep["depth"]
            due = bool(self.asked) and self.asked[0][0] <= clock
            dut.answer_valid_i.value = due
            if due:
                dut.answer_i.value = int(self.asked.popleft()[1])


@checked(gap=[0.0, 0.5], stall=[0.0, 0.5], latency=[1, 2, 9] if FULL else [1, 9])
async def triangles(bench: Bench, gap: float, stall: float, latency: int) -> None:
    """Every run that is left, every surface, the memory behind it; before that a reset at any moment."""
    memory = Memory(bench, latency, stall / 2)
    s = golden.scan(mixture(bench.rng, 12 if FULL else 8, SIZE), golden.View(SIZE, SIZE, k.CULL_NONE))
    triangles = Source(bench, "surface_valid_i", "surface_ready_o", ["surface_i"])
    places = Source(bench, "run_valid_i", "run_ready_o", ["run_i"])
    planes = Sink(bench, "surface_valid_o", "surface_ready_i", ["surface_o"], stall)
    seen = Sink(bench, "run_valid_o", "run_ready_i", ["run_o"], stall / 2)
    tasks = [cocotb.start_soon(triangles.send(surfaces(s), gap)), cocotb.start_soon(places.send(runs(s), gap))]
    await bench.tick(int(bench.rng.integers(20, 200)))
    for task in tasks:
        task.cancel()
    await bench.reset(1)
    triangles.withdraw()
    places.withdraw()
    await bench.tick()
    planes.forget()
    seen.forget()
    memory.asked.clear()
    memory.depths[:] = FAR
    memory.questions = 0

    ends = 0
    wanted, after = golden.depth(s, memory.depths)
    began = bench.clock
    cocotb.start_soon(triangles.send(surfaces(s), gap))
    cocotb.start_soon(places.send(runs(s), gap))
    while ends < len(s.index):
        await bench.tick()
        ends += int(bench.dut.end_o.value)
        bench.equal(
            bench.clock - began < 100_000,
            True,
            f"{ends} of {len(s.index)} triangles within 100,000 clocks",
        )
    clocks = bench.clock - began
    await bench.tick(200)
    words = [(fields("walked_t", bits), bits) for (bits,) in seen.words]
    expected = []
    for i, (bits,) in enumerate(runs(wanted)):
        triangle = wanted.triangle[i]
        end = i + 1 == len(wanted.count) or wanted.triangle[i + 1] != triangle
        ended = end and wanted.ended[triangle] == 1
        expected.append(bits & ~word("walked_t", last=1) if ended else bits)
        expected += [None] * int(ended)
    bench.equal(len(words), len(expected), "runs")
    for i, ((run, bits), right) in enumerate(zip(words, expected, strict=True)):
        if right is None:
            bench.equal(
                (run["none"], run["last"], run["count"]) == (1, 1, 0), True, f"run {i} ends its triangle: {run}"
            )
        else:
            bench.equal(bits, right, f"run {i}: {run}", len(bench.dut.run_o))
    bench.equal(planes.words == surfaces(wanted), True, "surfaces")
    bench.equal(np.array_equal(memory.depths, after), True, "the memory")
    bench.equal(memory.questions, int(s.count.sum()), "questions")
    if not gap and not stall and latency == 1 and bench.parameter("LOG2") > 2:
        limit = int(s.count.sum()) + 12 * len(s.index) + 3 * len(s.count) + 4 * SIZE
        bench.equal(clocks <= limit, True, f"{clocks} clocks, at most {limit}")
