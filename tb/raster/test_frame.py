# SPDX-License-Identifier: Apache-2.0
"""shade_frame: depths in and out, pictures in scan order, cleared behind them; stalls, a reset, two buffers."""

from __future__ import annotations

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import raster as golden

from tb.bench import Bench, Sink, checked
from tb.raster.streams import word
from tb.runner import points, simulate

COLUMNS, LINES = 13, 7
POINT = {"COLUMNS_LOG2": 4, "LINES_LOG2": 3}
FAR = golden.FARTHEST + 1


@points(POINT, POINT | {"DOUBLE": 1})
def test_cocotb(point):
    simulate("shade_frame", point)


def site(column: int, line: int) -> int:
    """A pixel's place as bits."""
    return word("site_t", column=column, line=line)


@checked(stall=[0.0, 0.6])
async def pictures(bench: Bench, stall: float) -> None:
    """Three pictures, a reset in the middle of the first one; every depth is asked for before it is written."""
    dut, rng = bench.dut, bench.rng
    view, background = golden.View(COLUMNS, LINES), 0x123456
    dut.view_i.value = word("view_t", columns=COLUMNS, lines=LINES)
    dut.background_i.value = background
    dut.write_valid_i.value = dut.pixel_valid_i.value = dut.show_i.value = dut.request_valid_i.value = 0
    sink = Sink(
        bench,
        "m_axis_frame_tvalid",
        "m_axis_frame_tready",
        [f"m_axis_frame_t{n}" for n in ("data", "user", "last")],
        stall,
    )
    both = bench.parameter("DOUBLE")
    shown, asked, answers = [], [], []

    async def watch() -> None:
        while True:
            await bench.tick()
            if int(dut.answer_valid_o.value):
                answers.append(int(dut.answer_o.value))

    cocotb.start_soon(watch())
    for number in range(4):
        while not int(dut.ready_o.value):
            await bench.tick()
        depths = np.full((LINES, COLUMNS), FAR)
        drawn = [(int(rng.integers(COLUMNS)), int(rng.integers(LINES)), int(rng.integers(1 << 24))) for _ in range(60)]
        for column, line, colour in drawn:
            dut.request_valid_i.value, dut.request_i.value = 1, site(column, line)
            asked.append(int(depths[line, column]))
            await bench.tick()
            dut.request_valid_i.value = 0
            depths[line, column] = rng.integers(FAR)
            dut.write_valid_i.value = dut.pixel_valid_i.value = 1
            dut.write_i.value = word("deep_t", **{"site.column": column, "site.line": line}, depth=depths[line, column])
            dut.site_i.value, dut.pixel_i.value = site(column, line), colour
            await bench.tick()
            dut.write_valid_i.value = dut.pixel_valid_i.value = 0
        await bench.tick(4)
        dut.show_i.value = 1
        await bench.tick()
        await bench.until(lambda: int(dut.show_ready_o.value), 2000, "the picture before is taken")
        dut.show_i.value = 0
        if number == 0:
            await bench.tick(20)
            await bench.reset(1)
            await bench.tick()
            sink.forget()
            continue
        column, line, colour = (np.array(part) for part in zip(*drawn, strict=True))
        shown.append(golden.frame(view, background, column, line, colour))
        began = bench.clock
        await bench.tick()
        await bench.until(lambda: int(dut.ready_o.value), 4000, "all is cleared")
        if not stall or both:
            bench.equal(bench.clock - began <= COLUMNS * LINES + 8, True, f"{bench.clock - began} clocks to clear")
    await bench.until(lambda: len(sink.words) >= 3 * COLUMNS * LINES, 4000, "three pictures")
    bench.equal(answers[-len(asked) + 60 :], asked[60:], "depths")
    for i, (data, first, last) in enumerate(sink.words):
        number, place = divmod(i, COLUMNS * LINES)
        bench.equal(data, int(shown[number].ravel()[place]), f"pixel {place} of picture {number}", 24)
        bench.equal((first, last) == (place == 0, place % COLUMNS == COLUMNS - 1), True, f"marks of pixel {place}")
    bench.equal(k.PLACE_W, len(dut.site_i) // 2, "a place's width")
