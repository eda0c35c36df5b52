# SPDX-License-Identifier: Apache-2.0
"""shade_hold: a register's value of DEPTH clocks ago, a place for every FOLD clocks."""

from tb.bench import Bench, checked
from tb.runner import points, simulate


@points({}, {"DEPTH": 2}, {"FOLD": 1}, {"WIDTH": 18, "DEPTH": 41}, {"FOLD": 2, "DEPTH": 16}, {"DEPTH": 0})
def test_cocotb(point):
    simulate("shade_hold", point)


@checked()
async def stream(bench: Bench) -> None:
    """Random values: each is there DEPTH clocks after it came, in that clock."""
    dut, fold, depth = bench.dut, bench.parameter("FOLD"), bench.parameter("DEPTH")
    values = bench.rng.integers(0, 1 << bench.parameter("WIDTH"), 200).tolist()
    for clock in range(len(values) * fold):
        dut.d_i.value = values[clock // fold]
        dut.load_i.value = clock % fold == fold - 1
        await bench.tick()
        row, phase = divmod(clock - depth, fold)
        if row >= 0 and phase == 0:
            bench.equal(int(dut.q_o.value), values[row], f"value {row}", bench.bits("q_o"))
