# SPDX-License-Identifier: Apache-2.0
"""shade_stable: a stream that keeps to the rule goes on for ever; tb/stream/test_assert.py breaks it."""

import random

from tb.bench import Bench, checked
from tb.runner import points, simulate


@points({}, {"WIDTH": 1})
def test_cocotb(point):
    simulate("shade_stable", point)


@checked()
async def lawful(bench: Bench) -> None:
    """A word is offered until it is taken, with pauses; behind a reset it may be another one, or none."""
    dut, waits = bench.dut, False
    for _ in range(2000):
        if not waits:
            dut.valid_i.value = random.getrandbits(1)
            dut.data_i.value = random.getrandbits(bench.bits("data_i"))
        dut.ready_i.value = random.getrandbits(1)
        dut.rst_i.value = random.random() < 0.02
        await bench.tick()
        waits = int(dut.valid_i.value) and not int(dut.ready_i.value) and not int(dut.rst_i.value)
        bench.checks += 1
