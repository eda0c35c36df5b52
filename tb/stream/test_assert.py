# SPDX-License-Identifier: Apache-2.0
"""Assertions in the RTL: each stops the simulation when its rule is broken, and its name is told."""

from __future__ import annotations

import numpy as np
import pytest
from polyshade import sim
from polyshade.golden.types import PLAN, RECORD
from polyshade.sim.model import SimulationError

from tb.bench import Bench, checked
from tb.runner import simulate

PLANNED = [leaf.name for leaf in PLAN.leaves()]
EMPTY = dict.fromkeys((leaf.name for leaf in RECORD.leaves()), 0)


def test_cocotb():
    simulate("shade_assert", {})


@checked()
async def holds(bench: Bench) -> None:
    """Nothing happens as long as it holds, or in a reset."""
    for rst, ok in [(0, 1), (1, 0), (1, 1), (0, 1)] * 10:
        bench.dut.rst_i.value, bench.dut.holds_i.value = rst, ok
        await bench.tick()
        bench.checks += 1


def fires(capfd: pytest.CaptureFixture[str], name: str, module: str, point: dict[str, int], **run: object) -> None:
    """A run ends with the assertion of that name."""
    with pytest.raises(SimulationError, match="an assertion failed"):
        sim.load(module, **point).run(**run)
    assert f"{name}: Assertion failed" in capfd.readouterr().out.replace("Assertion failed in top.", "").replace(
        ": 'assert' failed", ": Assertion failed"
    )


RECORD_OF = {name: EMPTY | {"head.count": n, "head.degree": d} for name, n, d in (("none", 0, 3), ("long", 5, 0))}
CASES = {
    "assert": ("shade_assert", "shade_assert", {}, {"holds_i": [1, 1, 0]}),
    "credit: taken without one": ("u_underflow", "shade_credit", {"LOG2": 1}, {"take_i": [1] * 3, "give_i": 0}),
    "credit: given too many": ("u_overflow", "shade_credit", {"LOG2": 1}, {"take_i": [1, 0, 0], "give_i": [0, 1, 1]}),
    "fifo: written when full": (
        "u_overflow", "shade_fifo", {"LOG2": 1}, {"data_i": np.arange(9), "out_stall": 1.0, "patience": 50},
    ),
    "fifo in blocks: written when full": (
        "u_overflow", "shade_fifo", {"LOG2": 2, "BLOCK": 1}, {"data_i": np.arange(9), "out_stall": 1.0, "patience": 50},
    ),
    "stable: a waiting word changes": (
        "u_stable", "shade_stable", {}, {"data_i": np.arange(40), "out_stall": 0.5, "patience": 50},
    ),
    "walk: an item of no steps": ("u_empty", "shade_walk", {}, {"count_i": [1, 0], "credit_i": 0}),
    "walk: credits that were not spent": ("u_credit.u_overflow", "shade_walk", {}, {"count_i": 1, "credit_i": 1}),
    "record of no pixels": ("u_walk.u_empty", "shade_span_walk", {}, {"record_i": RECORD_OF["none"], "credit_i": 0}),
    "direct record of five": ("u_long", "shade_span_walk", {}, {"record_i": RECORD_OF["long"], "credit_i": 0}),
    "node walk: phases that are not those of the units behind": (
        "u_phase", "shade_node_walk", {"FOLD": 6},
        {"pace": 5, "job_i": 0, "plan_i": dict.fromkeys(PLANNED, 0) | {"last_count": 1}, "credit_i": 0},
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_it_fires(capfd: pytest.CaptureFixture[str], case: str) -> None:
    name, module, point, run = CASES[case]
    fires(capfd, name, module, point, **run)
