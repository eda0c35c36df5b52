# SPDX-License-Identifier: Apache-2.0
"""The one bench of all units that are pipelines: their cases of ``sim/units`` through cocotb, with gaps and resets."""

import os

import cocotb
from polyshade.sim.sources import label
from polyshade.sim.units import cases

from tb.bench import TRAFFIC, Bench, checked
from tb.runner import FULL

ROWS = 400
CASES = [case for case in cases() if label(case.module, case.parameters) == os.environ["POINT"] and not case.own_bench]
ORDERED = any(case.ordered for case in CASES)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Every case of the module at its parameter point."""
    ways = [hasattr(bench.dut, "clk_i"), hasattr(bench.dut, "rst_i")]
    if (
        (gap and not ways[0])
        or (reset and not ways[1])
        or (not FULL and all(ways) and bool(gap) != bool(reset) and not ORDERED)
    ):
        bench.checks += 1  # no other than the rest
        return
    for number, case in enumerate(CASES):
        if case.ordered and reset:  # a vector in reset would be missed by those behind it
            bench.checks += 1
            continue
        for inputs in case.sample(ROWS // len(CASES), cocotb.RANDOM_SEED + number):
            await bench.pipeline(
                inputs, case.golden(inputs), case.latency, gap=gap, reset=reset, late=case.late,
                pace=case.clocks_per_vector,
            )  # fmt: skip
