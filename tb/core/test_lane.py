# SPDX-License-Identifier: Apache-2.0
"""shade_lane: spans in, pixels out, to the bit of golden.core.lane, by either path, with pauses."""

import random

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.core import Drawn, lane
from polyshade.golden.types import DRAWN, whole

from tb.bench import PRESSURE, Bench, Sink, Source, checked, no_path
from tb.core.vectors import CODES, Spans, set_draw, settings, spans
from tb.plan.test_node_walk import phases
from tb.runner import points, simulate

PATHS = [k.PATH_POLY, k.PATH_NORMALS]


SMALL = {"REFLECT": 0, "DIVIDE": 0, "PATH_NORMALS": 0}


@points({}, {"EVALUATOR": k.EVALUATOR_HORNER, "FORM": k.FORM_PAPER, **SMALL}, {"FOLD": 6, **SMALL})
def test_cocotb(point):
    simulate("shade_lane", point)


class Lights:
    """Where light was computed: ``flags`` of every node or pixel from now on."""

    def __init__(self, bench: Bench):
        self.flags: list[int] = []
        cocotb.start_soon(self._run(bench))

    async def _run(self, bench: Bench) -> None:
        while True:
            await bench.tick()
            if int(bench.dut.lit_o.value):
                self.flags.append(int(bench.dut.flags_o.value))


class Lane:
    """A lane with something that sends spans, something that takes pixels, something that looks at the lights."""

    def __init__(self, bench: Bench, stall: float = 0.0):
        self.bench, self.fold = bench, bench.parameter("FOLD")
        self.source = Source(bench, "valid_i", "ready_o", ["span_i"])
        self.sink = Sink(bench, "valid_o", "ready_i", ["drawn_o"], stall)
        self.lights = Lights(bench)
        if self.fold > 1:
            cocotb.start_soon(phases(bench))

    async def begin(self, draw: dict[str, int]) -> None:
        """The next draw call, behind a reset."""
        await self.bench.reset()
        set_draw(self.bench, draw)
        self.source.clocks.clear()
        self.sink.forget()
        self.lights.flags.clear()

    def golden(self, draw: dict[str, int], sent: Spans) -> Drawn:
        """What is to come of the spans."""
        names = ("evaluator", "form", "reflect", "divide", "path_normals")
        options = {name: self.bench.parameter(name.upper()) for name in names}
        return lane(sent.normal, sent.step, sent.count, draw, flat=sent.flat, cosine=sent.cosine, **options)

    async def compare(self, draw: dict[str, int], sent: Spans) -> None:
        """Wait for all pixels of the spans and compare them, and the flags of all lights; no more may come."""
        bench, drawn = self.bench, self.golden(draw, sent)
        words = pixel_words(drawn, sent.tag)
        patience = 4 * self.fold * len(words) + 3 * k.LATENCY_LANE
        await bench.until(lambda: len(self.sink.words) >= len(words), patience, f"{len(words)} pixels")
        await bench.tick(k.LATENCY_LANE + 20)
        bench.equal(len(self.sink.words), len(words), "number of pixels")
        for index, (word, wanted) in enumerate(zip(self.sink.words, words, strict=True)):
            bench.equal(word[0], wanted, f"pixel {index} (span {drawn.span[index]}): drawn_o", bench.bits("drawn_o"))
        bench.equal(len(self.lights.flags), len(drawn.flags), "number of lights")
        for index, (actual, wanted) in enumerate(zip(self.lights.flags, drawn.flags.tolist(), strict=True)):
            bench.equal(actual, wanted, f"light {index}: flags_o", bench.bits("flags_o"))


def pixel_words(drawn: Drawn, tag: np.ndarray) -> list[int]:
    """All pixels as they leave: light, tag, end of the span."""
    light = {f"pixel.{name}": drawn.pixels[:, i] for i, name in enumerate(("diffuse", "specular"))}
    return whole(DRAWN, light | {"tag": tag[drawn.span], "last": np.append(np.diff(drawn.span), 1) != 0})


@checked(path=PATHS, **PRESSURE)
async def traffic(bench: Bench, path: int, gap: float, stall: float) -> None:
    """Spans of all kinds under light of every model, adaptive and of fixed degree, with pauses or without."""
    lane = Lane(bench, stall)
    for code in CODES:
        draw = settings(bench, code) | {"path": path, "variant": code, "fixed_degree": random.choice([0, 0, 1, 2, 3])}
        sent = spans(bench, bench.rng.choice([1, 2, 3, 4, 5, 6, 9, 17, 40], 15))
        await lane.begin(draw)
        await lane.source.send(sent.words(), gap)
        await lane.compare(draw, sent)


def by_normals(bench: Bench, path: int) -> bool:
    """Is it the path of normals? Not where that is left out."""
    return path == k.PATH_NORMALS and bench.parameter("PATH_NORMALS") == 1


def first_pixel(bench: Bench, path: int) -> int:
    """Clocks from a span of one node to its first pixel."""
    if bench.parameter("FOLD") == 6:
        return k.LATENCY_LANE_FOLDED
    clocks = k.LATENCY_LANE_NORMALS if by_normals(bench, path) else k.LATENCY_LANE
    if bench.parameter("EVALUATOR") == k.EVALUATOR_HORNER:
        clocks += k.LATENCY_POLY_SPAN_HORNER - k.LATENCY_POLY_SPAN_FDIFF
    return clocks - (not bench.parameter("REFLECT")) * k.LATENCY_REFLECT


@checked(path=PATHS, degree=[1, 2, 3])
async def latency(bench: Bench, path: int, degree: int) -> None:
    """From a span to its first pixel, in an empty lane: a clock more, or FOLD, for every node of its record but one."""
    lane = Lane(bench)
    draw = settings(bench, k.MODEL_BLINN) | {"path": path, "fixed_degree": degree}
    for count in (1, 2, 3, 4, 5, 30):
        sent = spans(bench, [count])
        sent.flat[:] = 0
        await lane.begin(draw)
        await lane.source.send(sent.words())
        await lane.compare(draw, sent)
        nodes = 1 if by_normals(bench, path) else count if count <= k.DIRECT_MAX else degree + 1
        wanted = first_pixel(bench, path) + (nodes - 1) * lane.fold
        bench.equal(lane.sink.clocks[0] - lane.source.clocks[0], wanted, f"latency of {count} pixels")


@checked(path=PATHS, count=[1, 2, 3, 4, 5, 33])
async def throughput(bench: Bench, path: int, count: int) -> None:
    """N pixels in N clocks: no bubble between spans, however short; folded, a node in FOLD clocks."""
    lane = Lane(bench)
    draw = settings(bench, k.MODEL_BLINN) | {"path": path, "fixed_degree": k.DEGREE_CUBIC}
    rows = max(200 // count, 8)
    sent = spans(bench, [count] * rows)
    await lane.begin(draw)
    await lane.source.send(sent.words())
    await lane.compare(draw, sent)
    wanted = (rows - 1) * max(count, lane.fold * min(count, k.NODE_COUNT)) + count
    bench.equal(lane.sink.clocks[-1] - lane.sink.clocks[0] + 1, wanted, "clocks of all pixels")


@checked(path=PATHS)
async def longest(bench: Bench, path: int) -> None:
    """A span of 4096 pixels between two short ones; its pixels follow each other."""
    lane = Lane(bench)
    draw = settings(bench, k.MODEL_BLINN) | {"path": path}
    sent = spans(bench, [2, k.PIXELS_MAX, 3])
    await lane.begin(draw)
    await lane.source.send(sent.words())
    await lane.compare(draw, sent)
    bench.equal(lane.sink.clocks[-4] - lane.sink.clocks[2] + 1, k.PIXELS_MAX, "clocks of the longest")


@checked(path=PATHS)
async def blocked(bench: Bench, path: int) -> None:
    """A sink that takes nothing for long: every place fills, nothing more is taken; all of it comes, one a clock."""
    lane = Lane(bench, stall=1.0)
    draw = settings(bench, k.MODEL_BLINN) | {"path": path, "fixed_degree": k.DEGREE_CUBIC}
    count = max(9, k.NODE_COUNT * lane.fold)  # light can keep up
    sent = spans(bench, [count] * 220)
    await lane.begin(draw)
    sending = cocotb.start_soon(lane.source.send(sent.words()))
    await bench.tick(1200 * lane.fold)
    pixels = 1 << k.FIFO_LOG2
    if by_normals(bench, path):
        held = (pixels + 1 + (1 << k.RECORD_FIFO_LOG2) + (1 << k.NORMAL_FIFO_LOG2)) // count + 1
    else:  # records begun, with a credit; three spans in the walk
        held = pixels // count + 1 + (1 << k.RECORD_FIFO_LOG2) + 3 + (1 << k.SPAN_FIFO_LOG2)
    bench.equal(len(lane.source.clocks), held, "spans taken while the sink is not ready")
    lane.sink.stall = 0.0
    await sending
    await lane.compare(draw, sent)
    bench.equal(lane.sink.clocks[-1] - lane.sink.clocks[0] + 1, sent.count.sum(), "clocks of all pixels")


@checked(first=PATHS, second=PATHS)
async def one_behind_the_other(bench: Bench, first: int, second: int) -> None:
    """Any path behind any other without a reset: filled to the brim each time, nothing is lost, no credit either."""
    lane = Lane(bench)
    for path in (first, second, first):
        draw = settings(bench, k.MODEL_BLINN) | {"path": path, "fixed_degree": k.DEGREE_CUBIC}
        set_draw(bench, draw)
        sent = spans(bench, [max(9, k.NODE_COUNT * lane.fold)] * 220)
        lane.sink.forget()
        lane.lights.flags.clear()
        lane.sink.stall = 1.0
        sending = cocotb.start_soon(lane.source.send(sent.words()))
        await bench.tick(1200 * lane.fold)
        lane.sink.stall = 0.0
        await sending
        await lane.compare(draw, sent)


@checked(path=PATHS, stall=[0.0, 0.5, 1.0])
async def reset(bench: Bench, path: int, stall: float) -> None:
    """Reset in the middle of a span: nothing of it remains, the next spans are whole, the credits are back."""
    lane = Lane(bench)
    for code in (k.MODEL_PHONG, k.MODEL_WARD, k.MODEL_LAMBERT):
        draw = settings(bench, code) | {"path": path}
        set_draw(bench, draw)
        lane.sink.stall = stall
        sending = cocotb.start_soon(lane.source.send(spans(bench, bench.rng.integers(1, 60, 100)).words(), 0.2))
        await bench.tick(random.randrange(20, 2 * k.LATENCY_LANE))
        sending.cancel()
        lane.source.withdraw()
        await lane.begin(draw)
        lane.sink.stall = 0.0
        await bench.tick(k.LATENCY_LANE + 20)
        bench.equal(len(lane.sink.words) + len(lane.lights.flags), 0, "pixels and lights behind a reset")
        sent = spans(bench, [7, 2, 30])
        await lane.source.send(sent.words())
        await lane.compare(draw, sent)


@checked(path=PATHS)
async def paths(bench: Bench, path: int) -> None:
    """No output follows an input within a clock."""
    lane = Lane(bench, stall=0.3)
    draw, sent = settings(bench, k.MODEL_BLINN) | {"path": path}, spans(bench, bench.rng.integers(1, 9, 25))
    await lane.begin(draw)
    outputs = ["ready_o", "valid_o", "drawn_o", "lit_o", "flags_o"]
    cocotb.start_soon(no_path(bench, ["valid_i", "span_i", "ready_i"], outputs))
    await lane.source.send(sent.words(), 0.3)
    await lane.compare(draw, sent)
