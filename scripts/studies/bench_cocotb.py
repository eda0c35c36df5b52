# SPDX-License-Identifier: Apache-2.0
"""The cocotb side of ``scripts/studies/bench.py``: spans into shade_poly_span, pixels out, as plainly as cocotb can."""

import json
import os
import time

import cocotb
import numpy as np
from cocotb.clock import Clock
from cocotb.handle import HierarchyObject
from cocotb.triggers import RisingEdge


@cocotb.test()
async def spans_to_pixels(dut: HierarchyObject) -> None:
    """Offer a span whenever one is taken, collect a pixel whenever one is there, until all are."""
    beats = [sum(int(word) << 32 * i for i, word in enumerate(beat)) for beat in np.load("spans.npy")]
    pixels = int(os.environ["BENCH_PIXELS"])
    cocotb.start_soon(Clock(dut.clk_i, 10, unit="ns").start())
    edge = RisingEdge(dut.clk_i)
    dut.rst_i.value = 1
    dut.s_axis_span_tvalid.value = 0
    dut.m_axis_pixel_tready.value = 1
    await edge
    await edge
    dut.rst_i.value = 0
    await edge
    began = time.perf_counter()
    got, sent = [], 0
    dut.s_axis_span_tdata.value = beats[0]
    dut.s_axis_span_tvalid.value = 1
    while len(got) < pixels:
        await edge
        if sent < len(beats) and dut.s_axis_span_tready.value:
            sent += 1
            if sent < len(beats):
                dut.s_axis_span_tdata.value = beats[sent]
            else:
                dut.s_axis_span_tvalid.value = 0
        if dut.m_axis_pixel_tvalid.value:
            got.append(int(dut.m_axis_pixel_tdata.value))
    seconds = time.perf_counter() - began
    with open("cocotb.json", "w") as file:
        json.dump({"seconds": seconds, "pixels": len(got), "last": got[-1]}, file)
