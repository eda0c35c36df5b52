# SPDX-License-Identifier: Apache-2.0
"""shade_credit: as many takes as credits, one more for each that is given back; some_o and soon_o in time."""

import random

from tb.bench import Bench, checked
from tb.runner import points, simulate


@points({}, {"LOG2": 1})
def test_cocotb(point):
    simulate("shade_credit", point)


@checked(eager=[0.2, 0.5, 0.8])
async def traffic(bench: Bench, eager: float) -> None:
    """Takes and gives at random, from empty to full; resets of one clock."""
    dut, most = bench.dut, 1 << bench.parameter("LOG2")
    credit = most
    for _ in range(3000):
        take = credit > 0 and random.random() < eager
        give = (credit < most or take) and random.random() < 0.5
        in_reset = random.random() < 0.005
        dut.take_i.value, dut.give_i.value, dut.rst_i.value = take, give, in_reset
        await bench.tick()
        bench.equal(int(dut.some_o.value), credit > 0, "some_o")
        credit += give - take
        bench.equal(int(dut.soon_o.value), credit > 0, "soon_o")
        credit = most if in_reset else credit
