# SPDX-License-Identifier: Apache-2.0
"""shade_paint: pixels of light in, coloured pixels out, to the bit of golden.core.paint, with pauses."""

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.core import paint

from tb.bench import PRESSURE, Bench, Sink, Source, checked, no_path
from tb.core.vectors import set_draw, settings
from tb.runner import points, simulate

IN_W = k.PIXEL_DATA_W


@points({}, {"FIFO_LOG2": 4})
def test_cocotb(point):
    simulate("shade_paint", point)


def setup(bench: Bench, stall: float = 0.0) -> tuple[Source, Sink]:
    """Something that sends pixels, and something that takes them."""
    return Source(bench, "valid_i", "ready_o", ["drawn_i"]), Sink(bench, "valid_o", "ready_i", ["painted_o"], stall)


def pixels(bench: Bench, rows: int) -> list[tuple[int]]:
    """Pixels of any light, dark and full ones among them, as words {last, tag, specular, diffuse}."""
    rng, most = bench.rng, (1 << k.PIXEL_W) - 1
    light = np.where(rng.random((2, rows)) < 0.25, rng.choice([0, most], (2, rows)), rng.integers(0, most, (2, rows)))
    tags, last = rng.integers(0, 1 << k.TAG_W, rows), rng.integers(0, 2, rows)
    return [(word,) for word in (light[0] | light[1] << k.PIXEL_W | (tags | last << k.TAG_W) << IN_W).tolist()]


async def compare(bench: Bench, draw: dict[str, int], sent: list[tuple[int]], sink: Sink) -> None:
    """Wait for all pixels and compare them; no more may come."""
    await bench.until(lambda: len(sink.words) >= len(sent), 4 * len(sent) + 100, f"{len(sent)} pixels")
    await bench.tick(4 * k.LATENCY_PAINT)
    bench.equal(len(sink.words), len(sent), "number of pixels")
    data = np.array(sent)
    light = data >> np.array([0, k.PIXEL_W]) & (1 << k.PIXEL_W) - 1
    colours = (paint(light, draw) << np.arange(3) * k.PIXEL_W).sum(axis=1)
    for index, (colour, (word,)) in enumerate(zip(colours.tolist(), sent, strict=True)):
        wanted = colour | word >> IN_W << k.COLOUR_DATA_W
        bench.equal(sink.words[index][0], wanted, f"pixel {index}: painted_o", bench.bits("painted_o"))


@checked(**PRESSURE)
async def traffic(bench: Bench, gap: float, stall: float) -> None:
    """Coloured and plain pixels; without stalls each LATENCY_PAINT clocks behind its own, one a clock."""
    source, sink = setup(bench, stall)
    for colour in (0, 1, 1, 1):
        source.clocks.clear()
        sink.forget()
        draw, sent = settings(bench, k.MODEL_BLINN) | {"colour": colour}, pixels(bench, 100)
        set_draw(bench, draw)
        await source.send(sent, gap)
        await compare(bench, draw, sent, sink)
        if not stall:
            for index, clock in enumerate(sink.clocks):
                bench.equal(clock - source.clocks[index], k.LATENCY_PAINT, f"latency of pixel {index}")
        if not stall and not gap:
            bench.equal(sink.clocks[-1] - sink.clocks[0] + 1, len(sent), "clocks of all pixels")


@checked()
async def blocked(bench: Bench) -> None:
    """A sink that takes nothing: as many pixels are taken as there is place for, and come when it is ready."""
    draw, sent = {"colour": 1}, pixels(bench, 100)
    set_draw(bench, draw)
    source, sink = setup(bench, stall=1.0)
    sending = cocotb.start_soon(source.send(sent))
    await bench.tick(200)
    bench.equal(len(source.clocks), 1 << bench.parameter("FIFO_LOG2"), "pixels taken while the sink is not ready")
    sink.stall = 0.0
    await sending
    await compare(bench, draw, sent, sink)
    bench.equal(sink.clocks[-1] - sink.clocks[0] + 1, len(sent), "clocks of all pixels")


@checked()
async def reset(bench: Bench) -> None:
    """Reset while pixels are inside: nothing of them remains, the credits are back."""
    draw = {"colour": 1}
    set_draw(bench, draw)
    source, sink = setup(bench, stall=1.0)
    sending = cocotb.start_soon(source.send(pixels(bench, 100)))
    await bench.tick(40)
    sending.cancel()
    source.withdraw()
    await bench.reset()
    sink.forget()
    sink.stall = 0.0
    await bench.tick(20)
    bench.equal(len(sink.words), 0, "pixels after reset")
    sent = pixels(bench, 100)
    await source.send(sent)
    await compare(bench, draw, sent, sink)


@checked()
async def paths(bench: Bench) -> None:
    """No output follows an input within a clock."""
    draw, sent = {"colour": 1}, pixels(bench, 60)
    set_draw(bench, draw)
    source, sink = setup(bench, stall=0.3)
    cocotb.start_soon(no_path(bench, ["valid_i", "drawn_i", "ready_i"], ["ready_o", "valid_o", "painted_o"]))
    await source.send(sent, 0.3)
    await compare(bench, draw, sent, sink)
