# SPDX-License-Identifier: Apache-2.0
"""shade_poly_span: spans in, pixels out, to the bit of golden.poly.poly_span, on AXI4-Stream ports that may pause."""

import logging
import random
from itertools import pairwise

import cocotb
import numpy as np
from cocotbext.axi import AxiStreamBus, AxiStreamFrame, AxiStreamSink, AxiStreamSource
from polyshade.golden import contract as k
from polyshade.golden.poly import poly_span

from tb.bench import PRESSURE, Bench, Sink, Source, checked, no_path
from tb.poly.vectors import Spans, mixed_spans, spans
from tb.runner import points, simulate

SPAN, PIXEL = "s_axis_span_", "m_axis_pixel_"
PAYLOAD = [PIXEL + name for name in ("tdata", "tuser", "tlast")]


@points(
    {},
    {"EVALUATOR": k.EVALUATOR_FDIFF},
    {"FORM": k.FORM_PAPER, "NODES": k.NODES_RIGHT},
    {"EVALUATOR": k.EVALUATOR_FDIFF, "FORM": k.FORM_PAPER, "NODES": k.NODES_RIGHT, "LOG2_MAX": 6},
)
def test_cocotb(point):
    simulate("shade_poly_span", point)


def setup(bench: Bench, stall: float = 0.0) -> tuple[Source, Sink]:
    """Something that sends spans, and something that takes pixels."""
    source = Source(bench, SPAN + "tvalid", SPAN + "tready", [SPAN + "tdata"])
    return source, Sink(bench, PIXEL + "tvalid", PIXEL + "tready", PAYLOAD, stall)


def latency(bench: Bench) -> int:
    """Clocks from a span to its first pixel."""
    horner = bench.parameter("EVALUATOR") == k.EVALUATOR_HORNER
    return k.LATENCY_POLY_SPAN_HORNER if horner else k.LATENCY_POLY_SPAN_FDIFF


def golden(bench: Bench, sent: Spans) -> tuple[list[tuple[int, int, int]], np.ndarray, np.ndarray]:
    """The pixels of spans as (tdata, tuser, tlast); of every pixel the span (P,) and its number in it (P,)."""
    options = {"node_set": bench.parameter("NODES"), "form": bench.parameter("FORM")}
    options |= {"evaluator": bench.parameter("EVALUATOR")}
    pixels, of = poly_span(sent.nodes, sent.degree, sent.count, **options)
    j = np.arange(of.size) - np.searchsorted(of, of)
    tdata = pixels[:, 0] | pixels[:, 1] << k.PIXEL_W
    last = ((j == sent.count[of] - 1) & ~sent.more[of]).astype(int)
    return list(zip(tdata.tolist(), sent.tag[of].tolist(), last.tolist(), strict=True)), of, j


async def compare(bench: Bench, sent: Spans, sink: Sink) -> None:
    """Wait for all pixels of the spans and compare them; no more may come."""
    expected, of, j = golden(bench, sent)
    await bench.until(lambda: len(sink.words) >= of.size, 4 * of.size + 200, f"{of.size} pixels")
    await bench.tick(60)
    bench.equal(len(sink.words), of.size, "number of pixels")
    texts = sent.texts()
    for index, (word, wanted) in enumerate(zip(sink.words, expected, strict=True)):
        what = f"pixel {j[index]} of {texts[of[index]]}"
        for name, actual, value in zip(PAYLOAD, word, wanted, strict=True):
            bench.equal(actual, value, f"{what}: {name}", bench.bits(name))


def compare_clocks(bench: Bench, sent: Spans, source: Source, sink: Sink) -> None:
    """With a sink that is always ready, every pixel has its clock: latency after its span, and one a clock."""
    _, of, j = golden(bench, sent)
    for index, clock in enumerate(sink.clocks):
        bench.equal(clock - source.clocks[of[index]], latency(bench) + int(j[index]), f"latency of pixel {index}")


@checked(**PRESSURE)
async def traffic(bench: Bench, gap: float, stall: float) -> None:
    """Spans of all degrees, source and sink with pauses or without."""
    sent = mixed_spans(bench, 150)
    source, sink = setup(bench, stall)
    await source.send(sent.beats(), gap)
    await compare(bench, sent, sink)
    if not stall:
        compare_clocks(bench, sent, source, sink)
    if not stall and not gap:
        clocks = int(sent.count[:-1].sum())
        bench.equal(source.clocks[-1] - source.clocks[0], clocks, "clocks from the first span to the last")


@checked(count=[1, 2, 3, 4, 5])
async def throughput(bench: Bench, count: int) -> None:
    """N pixels in N clocks: no bubble between spans, however short."""
    sent = spans(bench, bench.rng.integers(int(count > k.DIRECT_MAX), 4, 100), count)
    source, sink = setup(bench)
    await source.send(sent.beats())
    await compare(bench, sent, sink)
    bench.equal(sink.clocks[-1] - sink.clocks[0] + 1, 100 * count, "clocks of all pixels")


@checked(degree=[k.DEGREE_LINEAR, k.DEGREE_QUADRATIC, k.DEGREE_CUBIC], stall=[0.0, 0.1])
async def longest(bench: Bench, degree: int, stall: float) -> None:
    """Spans of 2^LOG2_MAX pixels, one less and just over its half; nothing is lost while the sink pauses."""
    limit = 1 << bench.parameter("LOG2_MAX")
    sent = spans(bench, degree, [limit, limit - 1, limit // 2 + 2] if not stall else [limit])
    source, sink = setup(bench, stall)
    await source.send(sent.beats())
    await compare(bench, sent, sink)
    if not stall:
        compare_clocks(bench, sent, source, sink)


@checked()
async def blocked(bench: Bench) -> None:
    """A sink that takes nothing holds 2^FIFO_LOG2 pixels; they and the rest come, one a clock, when it is ready."""
    held = 1 << k.FIFO_LOG2
    sent = spans(bench, k.DEGREE_CUBIC, [9] * 20)
    source, sink = setup(bench, stall=1.0)
    sending = cocotb.start_soon(source.send(sent.beats()))
    await bench.tick(4 * held)
    bench.equal(len(source.clocks), held // 9 + 1, "spans taken while the sink is not ready")
    sink.stall = 0.0
    await sending
    await compare(bench, sent, sink)
    bench.equal(sink.clocks[-1] - sink.clocks[0] + 1, 180, "clocks of all pixels")


@checked(stall=[0.0, 0.5, 1.0])
async def reset(bench: Bench, stall: float) -> None:
    """A reset in the middle: what is under way is gone, and the next spans are shaded as if nothing had been."""
    source, sink = setup(bench)
    for _ in range(15):
        sink.stall = stall
        sending = cocotb.start_soon(source.send(mixed_spans(bench, 60).beats(), 0.2))
        await bench.tick(random.randrange(2, 120))
        sending.cancel()
        source.withdraw()
        await bench.reset(clocks=1)
        await bench.tick()
        bench.equal(int(bench.dut.m_axis_pixel_tvalid.value), 0, "m_axis_pixel_tvalid behind a reset")
        sink.forget()
        sink.stall = 0.0
        source.clocks.clear()
        sent = mixed_spans(bench, 10)
        await source.send(sent.beats())
        await compare(bench, sent, sink)
        compare_clocks(bench, sent, source, sink)


@checked()
async def registered(bench: Bench) -> None:
    """No input reaches an output in the same clock."""
    inputs = [SPAN + "tvalid", SPAN + "tdata", PIXEL + "tready"]
    outputs = [SPAN + "tready", PIXEL + "tvalid", *PAYLOAD]
    cocotb.start_soon(no_path(bench, inputs, outputs))
    sent = mixed_spans(bench, 50)
    source, sink = setup(bench, stall=0.5)
    await source.send(sent.beats(), 0.3)
    await compare(bench, sent, sink)


@checked(**PRESSURE)
async def foreign(bench: Bench, gap: float, stall: float) -> None:
    """The ports work with the AXI4-Stream source and sink of a library: a frame a span, of one beat or more."""
    dut = bench.dut
    logging.getLogger(f"cocotb.{dut._name}").setLevel(logging.WARNING)
    source = AxiStreamSource(AxiStreamBus.from_prefix(dut, "s_axis_span"), dut.clk_i, dut.rst_i, byte_lanes=1)
    sink = AxiStreamSink(AxiStreamBus.from_prefix(dut, "m_axis_pixel"), dut.clk_i, dut.rst_i, byte_lanes=1)
    source.set_pause_generator(random.random() < gap for _ in iter(int, 1))
    sink.set_pause_generator(random.random() < stall for _ in iter(int, 1))
    sent = mixed_spans(bench, 60)
    sent.more[-1] = False
    for (beat,) in sent.beats():
        source.send_nowait(AxiStreamFrame([beat]))
    expected = golden(bench, sent)[0]
    ends = np.flatnonzero([tlast for _, _, tlast in expected]) + 1
    for span, (start, end) in enumerate(pairwise([0, *ends.tolist()])):
        frame = await sink.recv(compact=False)
        wanted = expected[start:end]
        bench.equal(len(frame.tdata), len(wanted), f"pixels of span {span}")
        for tdata, tuser, pixel in zip(frame.tdata, frame.tuser, wanted, strict=True):
            bench.equal(tdata, pixel[0], f"span {span}: tdata", k.PIXEL_DATA_W)
            bench.equal(tuser, pixel[1], f"span {span}: tuser", k.TAG_W)
    await bench.tick(60)
    bench.equal(sink.empty() and not sink.active, True, "nothing more came")
