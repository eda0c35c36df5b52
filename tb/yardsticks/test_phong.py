# SPDX-License-Identifier: Apache-2.0
"""shade_phong: spans in, pixels lit one by one out, to the bit of golden.core.phong, with pauses."""

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.core import phong

from tb.bench import PRESSURE, Bench, Sink, Source, checked, no_path
from tb.core.vectors import CODES, Spans, set_draw, settings, spans
from tb.runner import points, simulate

SPAN, PIXEL = "s_axis_span_", "m_axis_pixel_"
PAYLOAD = [PIXEL + name for name in ("tdata", "tuser", "tlast")]


@points({}, {"REFLECT": 0, "DIVIDE": 0}, {"FORM": k.FORM_PAPER})
def test_cocotb(point):
    simulate("shade_phong", point)


def setup(bench: Bench, draw: dict[str, int] | None = None, stall: float = 0.0) -> tuple[Source, Sink]:
    """Settings, something that sends spans, and something that takes pixels."""
    set_draw(bench, draw or {})
    source = Source(bench, SPAN + "tvalid", SPAN + "tready", [SPAN + "tdata"])
    return source, Sink(bench, PIXEL + "tvalid", PIXEL + "tready", PAYLOAD, stall)


def latency(bench: Bench) -> int:
    """Clocks from a span to its first pixel."""
    return k.LATENCY_PHONG - (not bench.parameter("REFLECT")) * k.LATENCY_REFLECT


async def compare(bench: Bench, draw: dict[str, int], sent: Spans, sink: Sink) -> np.ndarray:
    """Wait for all pixels of the spans and compare them; no more may come. Returns their spans."""
    form, reflect, divide = (bench.parameter(name) for name in ("FORM", "REFLECT", "DIVIDE"))
    pixels, of = phong(sent.normal, sent.step, sent.count, draw, form=form, reflect=reflect, divide=divide)
    await bench.until(lambda: len(sink.words) >= of.size, 4 * of.size + 300, f"{of.size} pixels")
    await bench.tick(2 * k.LATENCY_PHONG)
    bench.equal(len(sink.words), of.size, "number of pixels")
    tdata = pixels[:, 0] | pixels[:, 1] << k.PIXEL_W
    last = np.append(np.diff(of), 1) != 0
    for index, word in enumerate(sink.words):
        what = f"pixel {index} (span {of[index]})"
        wanted = (int(tdata[index]), int(sent.tag[of[index]]), int(last[index]))
        for name, actual, value in zip(PAYLOAD, word, wanted, strict=True):
            bench.equal(actual, value, f"{what}: {name}", bench.bits(name))
    return of


@checked(**PRESSURE)
async def traffic(bench: Bench, gap: float, stall: float) -> None:
    """Short spans, under light of every model, source and sink with pauses or without."""
    source, sink = setup(bench, stall=stall)
    for code in CODES:
        await bench.reset()
        source.clocks.clear()
        sink.forget()
        draw, sent = settings(bench, code), spans(bench, bench.rng.integers(1, 14, 40))
        set_draw(bench, draw)
        await source.send(sent.words(), gap)
        of = await compare(bench, draw, sent, sink)
        if not stall:  # every pixel has its clock: latency after its span, and one a clock
            start = np.searchsorted(of, of)
            for index, clock in enumerate(sink.clocks):
                wanted = latency(bench) + index - int(start[index])
                bench.equal(clock - source.clocks[of[index]], wanted, f"latency of pixel {index}")


@checked(count=[1, 2, 3, 7])
async def throughput(bench: Bench, count: int) -> None:
    """N pixels in N clocks: no bubble between spans, however short."""
    draw, sent = settings(bench, k.MODEL_BLINN), spans(bench, [count] * 60)
    source, sink = setup(bench, draw)
    await source.send(sent.words())
    await compare(bench, draw, sent, sink)
    bench.equal(sink.clocks[-1] - sink.clocks[0] + 1, 60 * count, "clocks of all pixels")


@checked(stall=[0.0, 0.3])
async def longest(bench: Bench, stall: float) -> None:
    """A span of 4096 pixels; nothing is lost while the sink pauses."""
    draw, sent = settings(bench, k.MODEL_BLINN), spans(bench, [k.PIXELS_MAX, 2])
    source, sink = setup(bench, draw, stall)
    await source.send(sent.words())
    await compare(bench, draw, sent, sink)


@checked()
async def blocked(bench: Bench) -> None:
    """A sink that takes nothing: pixels wait in the FIFO, all of them come when it is ready, one a clock."""
    draw, sent = settings(bench, k.MODEL_BLINN), spans(bench, [9] * 30)
    source, sink = setup(bench, draw, stall=1.0)
    sending = cocotb.start_soon(source.send(sent.words()))
    await bench.tick(4 << k.PHONG_FIFO_LOG2)
    bench.equal(len(source.clocks), (1 << k.PHONG_FIFO_LOG2) // 9 + 1, "spans taken while the sink is not ready")
    sink.stall = 0.0
    await sending
    await compare(bench, draw, sent, sink)
    bench.equal(sink.clocks[-1] - sink.clocks[0] + 1, 270, "clocks of all pixels")


@checked()
async def reset(bench: Bench) -> None:
    """Reset in the middle of a span: nothing of it remains, the next spans are whole."""
    draw, sent = settings(bench, k.MODEL_BLINN), spans(bench, [300, 300])
    source, sink = setup(bench, draw)
    sending = cocotb.start_soon(source.send(sent.words()))
    await bench.tick(2 * k.LATENCY_PHONG)
    sending.cancel()
    source.withdraw()
    await bench.reset()
    sink.forget()
    sent = spans(bench, bench.rng.integers(1, 9, 30))
    await source.send(sent.words())
    await compare(bench, draw, sent, sink)


@checked()
async def paths(bench: Bench) -> None:
    """No output follows an input within a clock."""
    draw, sent = settings(bench, k.MODEL_BLINN), spans(bench, bench.rng.integers(1, 9, 30))
    source, sink = setup(bench, draw, stall=0.3)
    inputs = [SPAN + "tvalid", SPAN + "tdata", PIXEL + "tready"]
    outputs = [SPAN + "tready", PIXEL + "tvalid", *PAYLOAD]
    cocotb.start_soon(no_path(bench, inputs, outputs))
    await source.send(sent.words(), 0.3)
    await compare(bench, draw, sent, sink)
