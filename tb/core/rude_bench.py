# SPDX-License-Identifier: Apache-2.0
"""A packet is offered to ``shade_door`` and withdrawn before it was taken: an assertion must end the simulation."""

from tb.bench import Bench, checked


@checked()
async def withdraws(bench: Bench) -> None:
    """No lane is ready."""
    bench.dut.room_i.value = bench.dut.ready_i.value = bench.dut.given_i.value = 0
    bench.dut.hold_i.value = 1
    for valid in (1, 1, 0, 0):
        bench.dut.s_axis_span_tvalid.value = valid
        await bench.tick()
    bench.equal(True, False, "the simulation goes on")
