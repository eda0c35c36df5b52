# SPDX-License-Identifier: Apache-2.0
"""shade_horner_seq: the evaluator of P1, Fig. 9: values of golden.poly.horner, and every step that leads to them."""

import random
from collections.abc import Iterator

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.fixed import round
from polyshade.golden.poly import horner

from tb.bench import TRAFFIC, Bench, checked, patterns
from tb.runner import points, simulate


@points({}, {"COEF_W": 10, "D_W": 6, "T_F": 4})
def test_cocotb(point):
    simulate("shade_horner_seq", point, public=("*",))


def steps(a, b, c, d, t, t_f: int) -> Iterator[dict[str, np.ndarray]]:
    """The table of the header, row by row: what stands at RG, MX1, BK and MX2 in steps 1 to 5, and RG at the end.

    RG has HORNER_GUARD fraction bits below those of the coefficients, the adder T_F more. D brings the half ulp of the
    last rounding along.
    """
    a, b, c = (value << k.HORNER_GUARD for value in (a, b, c))
    d = (d << k.HORNER_GUARD) + (1 << k.HORNER_GUARD - 1)
    rg = b
    yield {"rg_q": rg, "mx1": a, "bk": rg, "mx2": a * t}
    rg = b + round(a * t, t_f)
    yield {"rg_q": rg, "mx1": rg, "bk": 0 * rg, "mx2": rg * t}
    rg = round(rg * t, t_f)
    yield {"rg_q": rg, "bk": rg, "mx2": c << t_f}
    rg = rg + c
    yield {"rg_q": rg, "mx1": rg, "bk": 0 * rg, "mx2": rg * t}
    rg = round(rg * t, t_f)
    yield {"rg_q": rg, "bk": rg, "mx2": d << t_f}
    yield {"rg_q": rg + d}


@checked(**TRAFFIC)
async def values(bench: Bench, gap: float, reset: float) -> None:
    """Every signal of the table on every clock; 6 clocks a value, not one more; what comes meanwhile is ignored."""
    dut, rows, t_f = bench.dut, 250, bench.parameter("T_F")
    widths = dict.fromkeys(("a_i", "b_i", "c_i"), bench.parameter("COEF_W")) | {"d_i": bench.parameter("D_W")}
    inputs = {name: bench.signed(width, rows) for name, width in widths.items()}
    inputs["t_i"] = bench.rng.integers(-8, (1 << t_f) + 8, rows).clip(0, 1 << t_f)
    bits = {name: patterns(getattr(dut, name), column) for name, column in inputs.items()}
    y = patterns(dut.y_o, horner(*inputs.values(), t_f=t_f))
    table = [
        {name: patterns(getattr(dut, name), column) for name, column in step.items()}
        for step in steps(*inputs.values(), t_f)
    ]

    row, work, clocks = 0, None, 0  # the next row; the row in work
    step = len(table)  # 0 .. 4: of the table; 5: just finished; 6: idle
    while row < rows or step < len(table):
        offer = row < rows and random.random() >= gap
        in_reset = row < rows and random.random() < reset
        for name, column in bits.items():
            port = getattr(dut, name)
            port.value = column[row] if offer else random.getrandbits(len(port))
        dut.valid_i.value = offer
        dut.rst_i.value = in_reset
        await bench.tick()
        clocks += 1

        idle = step >= len(table) - 1
        bench.equal(int(dut.ready_o.value), idle, f"row {work}: ready_o")
        bench.equal(int(dut.valid_o.value), step == len(table) - 1, f"row {work}: valid_o")
        if work is not None:
            given = ", ".join(f"{name} = {column[work]:#x}" for name, column in bits.items())
            for name, column in table[min(step, len(table) - 1)].items():
                port = getattr(dut, name)
                bench.equal(int(port.value), column[work], f"row {work} ({given}), step {step + 1}: {name}", len(port))
            if idle:
                bench.equal(int(dut.y_o.value), y[work], f"row {work} ({given}): y_o", len(dut.y_o))

        if in_reset:
            work, step = None, len(table)
        elif offer and idle:
            work, step, row = row, 0, row + 1
        elif step < len(table):
            step += 1
    if not gap and not reset:
        bench.equal(clocks, rows * k.LATENCY_HORNER_SEQ + 1, "clocks for all rows")
