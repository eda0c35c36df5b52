"""shade_planner: spans cut into records, to the bit of golden.plan.planner, on every clock."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.plan import THRESHOLDS, planner

from tb.bench import TRAFFIC, Bench, checked
from tb.plan.vectors import increments, sharpness
from tb.runner import simulate


def test_cocotb():
    simulate("shade_planner", {})


@checked(**TRAFFIC, fixed=[0, 1, 2, 3])
async def stream(bench: Bench, gap: float, reset: float, fixed: int) -> None:
    """Spans of every length, counts that are none, flat spans; the usual thresholds, other ones, adaptive and fixed."""
    rng, rows = bench.rng, 300
    for thresholds in (THRESHOLDS, tuple(np.sort(rng.integers(0, 1 << k.KAPPA_W, 3)).tolist()), (0, 0, 0)):
        static = await sharpness(bench)
        for name, value in zip(("t1_i", "t2_i", "t3_i"), thresholds, strict=True):
            getattr(bench.dut, name).value = value
        bench.dut.fixed_degree_i.value = fixed
        near = (1 << rng.integers(0, k.COUNT_W, rows)) + rng.integers(-2, 3, rows)
        count = np.where(rng.random(rows) < 0.5, near, rng.integers(0, 1 << k.COUNT_W, rows))
        inputs = increments(bench, rows) | {"count_i": count.clip(0, (1 << k.COUNT_W) - 1)}
        flat = rng.random(rows) < 0.2
        planned = planner(*inputs.values(), *static, thresholds, fixed, flat)
        outputs = {f"{name}_o": value for name, value in planned._asdict().items()}
        await bench.pipeline(inputs | {"flat_i": flat}, outputs, k.LATENCY_PLANNER, gap=gap, reset=reset)
