"""shade_criterion: eta of a triangle and the decision, to the bit of golden.plan.criterion, on every clock."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.plan import criterion

from tb.bench import TRAFFIC, Bench, checked
from tb.normal.vectors import cosines
from tb.runner import points, simulate

OUTPUTS = ("eta_o", "normalize_o", "clamped_o", "threshold_error_o")


@points({}, {"FORM": k.FORM_PAPER}, {"FORM": k.FORM_PAPER, "DEGREE": 1})
def test_cocotb(point):
    simulate("shade_criterion", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Flat and bent triangles; thresholds equal to eta, one beside it, and any other."""
    rows, form = 1000, (bench.parameter("FORM"), bench.parameter("DEGREE"))
    edges = [cosines(bench, rows) for _ in range(3)]
    for edge in edges:
        edge[rows // 2 :] = (1 << k.INTENSITY_F) - (bench.rng.random(rows - rows // 2) ** 4 * 4096).astype(int)
    beside = criterion(*edges, 0, *form)[0] + bench.rng.integers(-1, 2, rows)
    threshold = np.where(bench.rng.random(rows) < 0.5, beside, bench.signed(k.ETA_W, rows))
    inputs = dict(zip(("ab_i", "bc_i", "ca_i", "threshold_i"), (*edges, threshold), strict=True))
    outputs = dict(zip(OUTPUTS, criterion(*inputs.values(), *form), strict=True))
    await bench.pipeline(inputs, outputs, k.LATENCY_CRITERION, gap=gap, reset=reset)
