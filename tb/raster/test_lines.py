# SPDX-License-Identifier: Apache-2.0
"""shade_lines: runs to packets SPAN."""

from __future__ import annotations

from polyshade.golden import contract as k
from polyshade.golden import raster as golden
from polyshade.golden.types import SPAN, SPOT, whole

from tb.bench import Bench, checked
from tb.raster.streams import word
from tb.raster.test_starts import begun
from tb.raster.vectors import mixture
from tb.runner import points, simulate


@points({})
def test_cocotb(point):
    simulate("shade_lines", point)


@checked(ready=[0, 1])
async def packets(bench: Bench, ready: int) -> None:
    """Every packet and its place; what is none is taken and gives nothing."""
    dut = bench.dut
    s = golden.scan(mixture(bench.rng, 25, 50), golden.View(50, 50, k.CULL_NONE))
    wanted = golden.lines(s)
    spots = {name: wanted.pop(name) for name in ("column", "line", "depth", "increase")}
    expected, places = whole(SPAN, wanted), whole(SPOT, spots)
    dut.m_axis_span_tready.value = ready
    for i, (bits,) in enumerate(begun(s)):
        none, valid = (int(bit) for bit in bench.rng.integers(0, 2, 2))
        dut.valid_i.value = valid
        dut.begun_i.value = bits | word("begun_t", run__none=none)
        await bench.tick()
        bench.equal(int(dut.m_axis_span_tvalid.value), int(valid and not none), f"tvalid of run {i}")
        bench.equal(int(dut.ready_o.value), int(ready or none), f"ready_o of run {i}")
        bench.equal(int(dut.m_axis_span_tdata.value), expected[i], f"span {i}", k.SPAN_DATA_W)
        bench.equal(int(dut.m_axis_span_tuser.value), places[i], f"place of span {i}", 88)
