# SPDX-License-Identifier: Apache-2.0
"""shade_ring: every word again, DEPTH clocks later, whatever reset does in between."""

from tb.bench import Bench, checked
from tb.runner import points, simulate


@points({}, {"WIDTH": 33, "DEPTH": 5}, {"WIDTH": 2, "DEPTH": 51}, *({"DEPTH": clocks} for clocks in (8, 17, 32, 47)))
def test_cocotb(point):
    simulate("shade_ring", point)


@checked(reset=[0.0, 0.02])
async def stream(bench: Bench, reset: float) -> None:
    """A word on every clock; a clock of reset loses what is inside, nothing else."""
    words = bench.rng.integers(0, 1 << bench.bits("d_i"), 1000)
    await bench.pipeline({"d_i": words}, {"q_o": words}, bench.parameter("DEPTH"), reset=reset)
