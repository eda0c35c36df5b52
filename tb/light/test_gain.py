"""shade_gain: lobe times factors and gain, saturated, to the bit of golden.light.gain, on every clock."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.light import gain
from polyshade.sim.units.reflectance import to_the_brim

from tb.bench import TRAFFIC, Bench, checked
from tb.light.vectors import setting, unit_numbers
from tb.runner import simulate


def test_cocotb():
    simulate("shade_gain", {})


@checked()
async def brim(bench: Bench) -> None:
    """Light that rounds up to 2, where it saturates, and that just does not; the ends of every exponent."""
    lowest = -(1 << k.GAIN_EXP_W - 1)
    for exponent, mantissa in ((0, 97775), (lowest, 65536), (-lowest - 1, 131071), (3, 65537), (-3, 92682)):
        setting(bench, gain=mantissa, gain_exp=exponent)
        inputs = {name: np.array(v) for name, v in to_the_brim(bench.rng, 150, mantissa, exponent).items()}
        for row, values in enumerate([(10572, 17019, 65536, 0, 5), (65536, 65536, 65536, 0, 0), (65536,) * 3 + (0, 1)]):
            for name, value in zip(inputs, values, strict=True):
                inputs[name][row] = value
        values = gain(*(inputs[f"{name}_i"] for name in ("lobe", "num", "w", "e", "fresnel")), mantissa, exponent)
        await bench.pipeline(inputs, dict(zip(("s_o", "saturated_o"), values, strict=True)), k.LATENCY_GAIN)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Exponents from far too small to far too large, most of them such that the result is in range."""
    rows, lowest = 100, -(1 << k.GAIN_EXP_W - 1)
    for exponent in (lowest, lowest + 1, -9, -1, 0, 1, 5, -lowest - 1):
        mantissa = int(bench.rng.integers(1 << k.GAIN_F, 2 << k.GAIN_F))
        setting(bench, gain=mantissa, gain_exp=exponent)
        near = bench.rng.integers(-6, 18, rows) - exponent
        any_e = bench.signed(k.FACTOR_EXP_W, rows)
        low, high = -(1 << k.FACTOR_EXP_W - 1), (1 << k.FACTOR_EXP_W - 1) - 1
        e = [
            a if kind else b
            for a, b, kind in zip(any_e, near.clip(low, high), bench.rng.random(rows) < 0.3, strict=True)
        ]
        inputs = {f"{name}_i": unit_numbers(bench, rows) for name in ("lobe", "num")}
        inputs |= {"w_i": -(unit_numbers(bench, rows) << 1), "e_i": e, "fresnel_i": unit_numbers(bench, rows)}
        s, saturated = gain(*inputs.values(), mantissa, exponent)
        await bench.pipeline(inputs, {"s_o": s, "saturated_o": saturated}, k.LATENCY_GAIN, gap=gap, reset=reset)
