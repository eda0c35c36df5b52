"""shade_metric: P4's two lengths, the decisions and what was out of range, to the bit of golden.normal.metric."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.normal import metric

from tb.bench import TRAFFIC, Bench, checked
from tb.normal.vectors import cosines
from tb.runner import simulate

OUTPUTS = ("d1a_o", "d2_o", "needs_d1_o", "needs_d2_o", "clamped_o", "m_error_o", "threshold_error_o")


def test_cocotb():
    simulate("shade_metric", {})


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """m around 3 and 12 and any other; thresholds equal to a metric, one beside it, and any other."""
    rows = 1000
    c, m = cosines(bench, rows), bench.rng.integers(0, 16, rows)
    m[::7] = bench.rng.integers(0, 1 << k.COUNT_W, len(m[::7]))
    d1a, d2, *_ = metric(c, m)
    beside = np.where(np.arange(rows) % 2, d1a, d2) + bench.rng.integers(-1, 2, rows)
    threshold = np.where(bench.rng.random(rows) < 0.5, beside, bench.signed(k.INTENSITY_W, rows))
    inputs = {"c_i": c, "m_i": m, "threshold_i": threshold}
    outputs = dict(zip(OUTPUTS, metric(*inputs.values()), strict=True))
    await bench.pipeline(inputs, outputs, k.LATENCY_METRIC, gap=gap, reset=reset)
