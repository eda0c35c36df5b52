# SPDX-License-Identifier: Apache-2.0
"""shade_valid: valid_i again, DEPTH clocks later; a reset empties the pipeline."""

from tb.bench import TRAFFIC, Bench, checked
from tb.runner import points, simulate


@points({}, {"DEPTH": 4})
def test_cocotb(point):
    simulate("shade_valid", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Valid on every clock or with gaps, resets or none: valid_o is checked on every clock."""
    await bench.pipeline({"valid_i": [1] * 500}, {}, bench.parameter("DEPTH"), gap=gap, reset=reset)
