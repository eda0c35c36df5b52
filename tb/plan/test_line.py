# SPDX-License-Identifier: Apache-2.0
"""shade_line: spans in, unit normals at the nodes of their records out, as golden.plan.line has them; credits."""

import random

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.plan import line
from polyshade.golden.registers import after_reset
from polyshade.golden.types import PLACE, UNIT, whole

from tb.bench import Bench, Mismatch, Source, checked
from tb.core.vectors import set_draw, settings, spans
from tb.plan.test_node_walk import phases
from tb.runner import points, simulate


@points({}, {"FOLD": 6}, *({"FOLD": fold} for fold in (2, 3, 4, 5, 7, 8)))
def test_cocotb(point):
    simulate("shade_line", point)


class Points:
    """Reads places and normals, and gives a record's credit back, but not in a clock of the probability ``thrift``."""

    def __init__(self, bench: Bench, thrift: float = 0.0):
        self.bench, self.thrift = bench, thrift
        self.places: list[dict[str, int]] = []
        self.normals: list[int] = []
        self.clocks: list[int] = []
        cocotb.start_soon(self._run())

    async def _run(self) -> None:
        dut, spent, first = self.bench.dut, 0, 1
        while True:
            credit = spent > 0 and random.random() >= self.thrift
            dut.credit_i.value = credit
            await self.bench.tick()
            spent -= credit
            if int(dut.place_valid_o.value):
                place = int(dut.place_o.value)
                self.places.append({f.name: place >> f.lsb & (1 << f.width) - 1 for f in PLACE.leaves()})
                spent, first = spent + first, self.places[-1]["last"]
            if int(dut.valid_o.value):
                self.normals.append(int(dut.unit_o.value))
                self.clocks.append(self.bench.clock)
            if int(dut.rst_i.value):
                spent, first = 0, 1
            if spent > 1 << k.RECORD_FIFO_LOG2:
                raise Mismatch(f"a record without a credit (clock {self.bench.clock})")


def setup(bench: Bench, thrift: float = 0.0) -> tuple[Source, Points]:
    """Something that sends spans, and something that reads points."""
    if bench.parameter("FOLD") > 1:
        cocotb.start_soon(phases(bench))
    return Source(bench, "valid_i", "ready_o", ["span_i"]), Points(bench, thrift)


async def compare(bench: Bench, draw: dict[str, int], sent, points: Points) -> None:
    """Wait for all points of the spans and compare them; no more may come."""
    nodes, normal, zero, short = line(sent.normal, sent.step, sent.count, draw, sent.flat)
    total, record = len(normal), nodes.record
    patience = 20 * bench.parameter("FOLD") * total + 500
    await bench.until(lambda: len(points.normals) >= total, patience, f"{total} normals")
    await bench.tick(k.LATENCY_LINE_FOLDED)
    bench.equal((len(points.places), len(points.normals)), (total, total), "places and normals")
    normals = dict(zip(("normal.x", "normal.y", "normal.z"), normal.T, strict=True))
    units = whole(UNIT, normals | {"zero": zero, "too_short": short})
    wanted = {"slot": nodes.slot, "shared": nodes.shared, "last": np.append(np.diff(record), 1) != 0}
    wanted |= {f"head.{name}": getattr(nodes, name)[record] for name in ("count", "more", "degree", "log2")}
    wanted["head.tag"] = sent.tag[nodes.span[record]]
    for index, (place, given) in enumerate(zip(points.places, points.normals, strict=True)):
        what = f"point {index} (span {nodes.span[record[index]]}, record {record[index]})"
        for name, values in wanted.items():
            bench.equal(place[name], int(values[index]), f"{what}: {name}")
        bench.equal(given, units[index], f"{what}: unit_o", UNIT.width)


@checked(gap=[0.0, 0.5], thrift=[0.0, 0.8])
async def traffic(bench: Bench, gap: float, thrift: float) -> None:
    """Spans of all kinds, adaptive and of fixed degree; credits that come back at once or late."""
    source, points = setup(bench, thrift)
    for code, degree in ((k.MODEL_LAMBERT, 0), (k.MODEL_BLINN, 0), (k.MODEL_BLINN, 3)):
        await bench.tick(k.LATENCY_LINE_FOLDED)
        draw = after_reset() | settings(bench, code) | {"fixed_degree": degree}
        set_draw(bench, draw)
        points.places.clear()
        points.normals.clear()
        sent = spans(bench, bench.rng.choice([1, 2, 3, 4, 5, 9, 33, 100], 40))
        await source.send(sent.words(), gap)
        await compare(bench, draw, sent, points)


@checked()
async def latency(bench: Bench) -> None:
    """From a span to its first normal, and a node a clock, or in FOLD, from there."""
    source, points = setup(bench)
    draw, fold = (
        after_reset() | settings(bench, k.MODEL_BLINN) | {"fixed_degree": k.DEGREE_CUBIC},
        bench.parameter("FOLD"),
    )
    set_draw(bench, draw)
    await bench.tick(10)
    sent = spans(bench, [9] * 20)
    await source.send(sent.words())
    await compare(bench, draw, sent, points)
    bench.equal(points.clocks[0] - source.clocks[0], k.line_latency(fold), "latency")
    bench.equal(points.clocks[-1] - points.clocks[0], fold * (len(points.clocks) - 1), "clocks of all nodes")


@checked()
async def reset(bench: Bench) -> None:
    """A reset of one clock in the middle: nothing of it remains, the credits are back."""
    source, points = setup(bench, thrift=0.5)
    draw = after_reset() | settings(bench, k.MODEL_BLINN)
    set_draw(bench, draw)
    for clocks in (30, 70, 100):
        sending = cocotb.start_soon(source.send(spans(bench, [40] * 40).words()))
        await bench.tick(clocks)
        sending.cancel()
        source.withdraw()
        await bench.reset(clocks=1)
        await bench.tick()
        points.places.clear()
        points.normals.clear()
        await bench.tick(k.LATENCY_LINE_FOLDED)
        bench.equal(len(points.places) + len(points.normals), 0, "points behind a reset")
        sent = spans(bench, [7, 2, 30])
        await source.send(sent.words())
        await compare(bench, draw, sent, points)
