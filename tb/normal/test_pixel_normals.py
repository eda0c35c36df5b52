# SPDX-License-Identifier: Apache-2.0
"""shade_pixel_normals: lines in, unit normals out, to the bit of golden.normal.pixel_normals, with pauses."""

from dataclasses import dataclass

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.normal import pack_spans, pixel_normals

from tb.bench import PRESSURE, Bench, Sink, Source, checked, no_path
from tb.runner import simulate

LINE, NORMAL = "s_axis_line_", "m_axis_normal_"
PAYLOAD = [NORMAL + name for name in ("tdata", "tuser", "tlast")]


def test_cocotb():
    simulate("shade_pixel_normals", {})


@dataclass
class Lines:
    """Lines of normals: arrays (S, 3) and (S,)."""

    normal: np.ndarray
    step: np.ndarray
    count: np.ndarray
    cosine: np.ndarray
    tag: np.ndarray
    variant: np.ndarray
    threshold: np.ndarray

    def words(self) -> list[tuple[int, int, int]]:
        """What a source sends: beat, variant, threshold."""
        beats = pack_spans(self.normal, self.step, self.count, self.cosine, self.tag)
        whole = [sum(int(word) << 32 * i for i, word in enumerate(beat)) for beat in beats]
        threshold = self.threshold & ((1 << k.INTENSITY_W) - 1)
        return list(zip(whole, self.variant.tolist(), threshold.tolist(), strict=True))


def lines(bench: Bench, count, variant=None, threshold=k.METRIC_THRESHOLD) -> Lines:
    """Lines between random unit normals, most of them close; every variant unless one is given."""
    count = np.asarray(count)
    rows = count.size
    first, other = (bench.rng.standard_normal((rows, 3)) for _ in range(2))
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    last = first + other * bench.rng.choice([0.02, 0.2, 1.0], (rows, 1))
    last /= np.linalg.norm(last, axis=1, keepdims=True)
    scale = 1 << k.STEP_F
    step = (last - first) / np.maximum(count - 1, 1)[:, None]
    return Lines(
        np.rint(first * scale).astype(int),
        np.rint(step * scale).astype(int),
        count,
        np.rint((first * last).sum(axis=1) * (1 << k.INTENSITY_F)).astype(int),
        bench.rng.integers(0, 1 << k.TAG_W, rows),
        bench.rng.integers(0, 8, rows) if variant is None else np.full(rows, variant),
        np.broadcast_to(threshold, rows),
    )


def setup(bench: Bench, stall: float = 0.0) -> tuple[Source, Sink]:
    """Something that sends lines with their settings, and something that takes normals."""
    payload = [LINE + "tdata", "variant_i", "threshold_i"]
    source = Source(bench, LINE + "tvalid", LINE + "tready", payload)
    return source, Sink(bench, NORMAL + "tvalid", NORMAL + "tready", PAYLOAD, stall)


async def compare(bench: Bench, sent: Lines, sink: Sink) -> np.ndarray:
    """Wait for all normals of the lines and compare them; no more may come. Returns their lines."""
    normals, of = pixel_normals(sent.normal, sent.step, sent.count, sent.cosine, sent.variant, sent.threshold)
    await bench.until(lambda: len(sink.words) >= of.size, 4 * of.size + 300, f"{of.size} normals")
    await bench.tick(80)
    bench.equal(len(sink.words), of.size, "number of normals")
    mask = (1 << k.INTENSITY_W) - 1
    tdata = sum((normals[:, i] & mask) << k.INTENSITY_W * i for i in range(3))
    last = np.r_[of[1:] != of[:-1], True]
    for index, word in enumerate(sink.words):
        what = f"normal {index} of line {of[index]} (variant {sent.variant[of[index]]}, {sent.count[of[index]]} pixels)"
        wanted = (int(tdata[index]), int(sent.tag[of[index]]), int(last[index]))
        for name, actual, value in zip(PAYLOAD, word, wanted, strict=True):
            bench.equal(actual, value, f"{what}: {name}", bench.bits(name))
    return of


@checked(**PRESSURE)
async def traffic(bench: Bench, gap: float, stall: float) -> None:
    """Lines of all variants and short lengths, source and sink with pauses or without."""
    sent = lines(bench, bench.rng.integers(1, 14, 120))
    source, sink = setup(bench, stall)
    await source.send(sent.words(), gap)
    of = await compare(bench, sent, sink)
    if not stall:  # every normal has its clock: latency after its line, and one a clock
        start = np.searchsorted(of, of)
        for index, clock in enumerate(sink.clocks):
            wanted = k.LATENCY_PIXEL_NORMALS + index - int(start[index])
            bench.equal(clock - source.clocks[of[index]], wanted, f"latency of normal {index}")


@checked(count=[1, 2, 3, 4, 5, 12])
async def throughput(bench: Bench, count: int) -> None:
    """N normals in N clocks: no bubble between lines, however short."""
    sent = lines(bench, [count] * 60)
    source, sink = setup(bench)
    await source.send(sent.words())
    await compare(bench, sent, sink)
    bench.equal(sink.clocks[-1] - sink.clocks[0] + 1, 60 * count, "clocks of all normals")


@checked(stall=[0.0, 0.3])
async def longest(bench: Bench, stall: float) -> None:
    """A line of 4096 pixels, refined; nothing is lost while the sink pauses."""
    sent = lines(bench, [k.PIXELS_MAX, 2], k.VARIANT_REFINED)
    source, sink = setup(bench, stall)
    await source.send(sent.words())
    await compare(bench, sent, sink)


@checked()
async def blocked(bench: Bench) -> None:
    """A sink that takes nothing: normals wait in the FIFO, all of them come when it is ready, one a clock."""
    sent = lines(bench, [9] * 20)
    source, sink = setup(bench, stall=1.0)
    sending = cocotb.start_soon(source.send(sent.words()))
    await bench.tick(4 << k.NORMAL_FIFO_LOG2)
    bench.equal(len(source.clocks), (1 << k.NORMAL_FIFO_LOG2) // 9 + 1, "lines taken while the sink is not ready")
    sink.stall = 0.0
    await sending
    await compare(bench, sent, sink)
    bench.equal(sink.clocks[-1] - sink.clocks[0] + 1, 180, "clocks of all normals")


@checked()
async def limits(bench: Bench) -> None:
    """Lines shorter and longer than d1a is meant for, and thresholds outside [0, 1], are clamped."""
    source, sink = setup(bench)
    cases = [(2, 1, k.METRIC_THRESHOLD), (40, 2, k.METRIC_THRESHOLD), (40, 2, 1 << k.INTENSITY_F)]
    cases += [(5, 4, -1), (5, 5, (1 << k.INTENSITY_F) + 1), (5, 3, 1 << k.INTENSITY_F)]
    for count, variant, threshold in cases:
        sent = lines(bench, [6, count, count, 7], variant, threshold)
        sink.forget()
        await source.send(sent.words())
        await compare(bench, sent, sink)


@checked()
async def reset(bench: Bench) -> None:
    """Reset in the middle of a line: nothing of it remains, the next lines are whole."""
    source, sink = setup(bench)
    sending = cocotb.start_soon(source.send(lines(bench, [300, 300]).words()))
    await bench.tick(150)
    sending.cancel()
    source.withdraw()
    await bench.reset()
    sink.forget()
    sent = lines(bench, bench.rng.integers(1, 9, 30))
    await source.send(sent.words())
    await compare(bench, sent, sink)


@checked()
async def paths(bench: Bench) -> None:
    """No output follows an input within a clock."""
    source, sink = setup(bench, stall=0.3)
    inputs = [LINE + "tvalid", LINE + "tdata", NORMAL + "tready", "variant_i", "threshold_i"]
    outputs = [LINE + "tready", NORMAL + "tvalid", *PAYLOAD]
    cocotb.start_soon(no_path(bench, inputs, outputs))
    sent = lines(bench, bench.rng.integers(1, 9, 30))
    await source.send(sent.words(), 0.3)
    await compare(bench, sent, sink)
