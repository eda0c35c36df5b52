"""shade_geometry: masking and quotients of every model, to the bit of golden.light.geometry, on every clock."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.light import geometry

from tb.bench import TRAFFIC, Bench, checked
from tb.light.vectors import CODES, registers, setting, unit_numbers
from tb.runner import simulate


def test_cocotb():
    simulate("shade_geometry", {})


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Every model and reserved code; cosines of 0, of 1, of a few ulp; versines from 0 to 2."""
    for code in CODES:
        words = registers(bench, code)
        words = {name: words[name] for name in ("model", "cosine", "inv_n", "inv_n_exp")}
        setting(bench, **words)
        x = bench.rng.integers(0, 2 << k.VERSINE_F, 200, endpoint=True) >> bench.rng.integers(0, k.VERSINE_W, 200)
        x[:2] = 0, 2 << k.VERSINE_F
        inputs = {"x_i": x} | {f"{name}_i": unit_numbers(bench, 200) for name in ("nl", "nv", "vh")}
        model, *more = words.values()
        values = np.broadcast_arrays(*geometry(model, *inputs.values(), *more))
        outputs = dict(zip(("num_o", "w_o", "e_o", "zero_o"), values, strict=True))
        await bench.pipeline(inputs, outputs, k.LATENCY_GEOMETRY, gap=gap, reset=reset)
