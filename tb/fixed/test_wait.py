# SPDX-License-Identifier: Apache-2.0
"""shade_wait: a value of DEPTH clocks ago, of one in FOLD clocks."""

from tb.bench import Bench, checked
from tb.runner import points, simulate


@points({}, {"FOLD": 2, "DEPTH": 33, "WIDTH": 20}, {"FOLD": 1}, {"DEPTH": 1}, {"FOLD": 8, "DEPTH": 40})
def test_cocotb(point):
    simulate("shade_wait", point)


@checked()
async def stream(bench: Bench) -> None:
    """Random values in the clocks of load_i, anything in the others: each is there DEPTH clocks later."""
    dut, fold, depth, width = bench.dut, *(bench.parameter(name) for name in ("FOLD", "DEPTH", "WIDTH"))
    values = bench.rng.integers(0, 1 << width, 300).tolist()
    for clock in range(len(values) * fold):
        row, phase = divmod(clock, fold)
        dut.d_i.value = int(bench.rng.integers(0, 1 << width)) if phase else values[row]
        dut.load_i.value = not phase
        await bench.tick()
        row, phase = divmod(clock - depth, fold)
        if row >= 0 and phase == 0:
            bench.equal(int(dut.q_o.value), values[row], f"value {row}", bench.bits("q_o"))
