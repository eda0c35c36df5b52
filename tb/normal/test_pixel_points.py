# SPDX-License-Identifier: Apache-2.0
"""shade_pixel_points: spans in, the normal and the place of every pixel out; a credit each."""

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.normal import pixel_normals
from polyshade.golden.types import PLACE, whole

from tb.bench import Bench, Source, checked
from tb.core.vectors import set_draw, spans
from tb.runner import simulate


def test_cocotb():
    simulate("shade_pixel_points", {})


class Points:
    """Reads places and normals; ``spend``: credits that are not given back at once."""

    def __init__(self, bench: Bench):
        self.bench, self.keep, self.owed = bench, False, 0
        self.given: list[tuple[int, int]] = []
        self.clocks: list[int] = []
        cocotb.start_soon(self._run())

    async def _run(self) -> None:
        dut = self.bench.dut
        while True:
            credit = self.owed > 0 and not self.keep
            dut.credit_i.value = credit
            await self.bench.tick()
            self.owed -= credit
            if int(dut.valid_o.value):
                self.given.append((int(dut.place_o.value), int(dut.normal_o.value)))
                self.clocks.append(self.bench.clock)
                self.owed += 1


@checked(gap=[0.0, 0.5])
async def traffic(bench: Bench, gap: float) -> None:
    """Spans of every variant; without credits it stops after as many points as there were, then goes on."""
    source, points = Source(bench, "valid_i", "ready_o", ["span_i"]), Points(bench)
    for variant in range(8):
        draw = {"variant": variant, "threshold": k.METRIC_THRESHOLD}
        set_draw(bench, draw)
        points.given.clear()
        sent = spans(bench, bench.rng.integers(1, 14, 60))
        points.keep = bool(variant % 2)
        sending = cocotb.start_soon(source.send(sent.words(), gap))
        if points.keep:
            await bench.tick(1000)
            bench.equal(len(points.given), 1 << k.RECORD_FIFO_LOG2, "points without a credit given back")
            points.keep = False
        await sending
        normals, of = pixel_normals(sent.normal, sent.step, sent.count, sent.cosine, variant, k.METRIC_THRESHOLD)
        total = len(of)
        await bench.until(lambda total=total: len(points.given) >= total, 1000, f"{total} points")
        await bench.tick(100)
        more = np.append(np.diff(of) == 0, 0)
        zero = dict.fromkeys((leaf.name for leaf in PLACE.leaves()), 0)
        places = whole(PLACE, zero | {"last": 1, "head.count": 1, "head.more": more, "head.tag": sent.tag[of]})
        mask = (1 << k.INTENSITY_W) - 1
        packed = sum((normals[:, i] & mask) << k.INTENSITY_W * i for i in range(3)).tolist()
        bench.equal(len(points.given), len(of), "number of points")
        for index, wanted in enumerate(zip(places, packed, strict=True)):
            bench.equal(points.given[index], wanted, f"point {index}")
    if not gap:
        bench.equal(points.clocks[0] - source.clocks[0], k.LATENCY_PIXEL_NORMALS, "latency")
