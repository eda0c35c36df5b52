"""shade_scale3: a vector times a number, to the bit of golden.normal.scale3; with one multiplier in 3 clocks."""

import random

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.normal import scale3

from tb.bench import TRAFFIC, Bench, checked, patterns
from tb.runner import points, simulate


@points({}, {"FOLD": 3})
def test_cocotb(point):
    simulate("shade_scale3", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Corners against the smallest, the middle and the largest factor, and random ones; untaken ones are ignored."""
    dut, rows, fold = bench.dut, 600, bench.parameter("FOLD")
    latency = k.LATENCY_SCALE3 if fold == 1 else k.LATENCY_SCALE3_FOLDED
    v = [bench.signed(k.INTENSITY_W, rows) for _ in "xyz"]
    s = bench.rng.integers(0, 1 << k.INVC_F, rows)
    s[::5] = bench.rng.choice([0, 1, 1 << k.INVC_F - 1, (1 << k.INVC_F) - 1], len(s[::5]))
    inputs = dict(zip(("x_i", "y_i", "z_i", "s_i"), (*v, s), strict=True))
    given = {name: patterns(getattr(dut, name), column) for name, column in inputs.items()}
    expected = dict(zip(("x_o", "y_o", "z_o"), map(np.asarray, scale3(*inputs.values())), strict=True))
    wanted = {name: patterns(getattr(dut, name), column) for name, column in expected.items()}

    row, busy, clocks = 0, 0, 0  # the next row; clocks until the unit takes one again
    taken: list[int | None] = [None] * (latency + 1)  # the row of every clock so far
    while row < rows or any(done is not None for done in taken[-latency - 1 :]):
        offer = row < rows and random.random() >= gap
        in_reset = row < rows and random.random() < reset
        for name, column in given.items():
            getattr(dut, name).value = column[row] if offer else random.getrandbits(len(getattr(dut, name)))
        dut.valid_i.value = offer
        dut.rst_i.value = in_reset
        await bench.tick()
        clocks += 1

        bench.equal(int(dut.ready_o.value), not busy, f"row {row}: ready_o", 1)
        take = offer and not busy
        taken.append(row if take else None)
        done = taken[-1 - latency]
        bench.equal(int(dut.valid_o.value), done is not None, f"row {done}: valid_o", 1)
        if done is not None:
            for name, column in wanted.items():
                bench.equal(int(getattr(dut, name).value), column[done], f"row {done}: {name}", k.INTENSITY_W)
        busy = fold - 1 if take else max(busy - 1, 0)
        row += take
        if in_reset:
            taken, busy = [None] * len(taken), 0
    if not gap and not reset:
        bench.equal(clocks, fold * (rows - 1) + latency + 2, "clocks for all rows")
