"""shade_colour: a pixel's red, green and blue, to the bit of golden.light.colour, on every clock."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.light import colour

from tb.bench import TRAFFIC, Bench, checked
from tb.runner import simulate


def test_cocotb():
    simulate("shade_colour", {})


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Light that is negative, extreme, random; weights of 0, 1, the largest; sums that saturate and that do not."""
    rows, most = 1000, (2 << k.INTENSITY_F) - 1
    light = {f"{name}_i": bench.signed(k.INTENSITY_W, rows) for name in ("diffuse", "specular")}
    corner = bench.rng.choice([0, 1, 1 << k.INTENSITY_F, most], (3, 3, rows))
    small = bench.rng.integers(0, 1 << bench.rng.integers(1, k.INTENSITY_W, rows), (3, 3, rows))
    weights = np.where(bench.rng.random((3, 3, rows)) < 0.25, corner, small)
    rgb = colour(*light.values(), *weights)
    ports = (f"{name}_{c}_i" for name in ("ambient", "kd", "ks") for c in "rgb")
    inputs = light | dict(zip(ports, weights.reshape(9, rows), strict=True))
    outputs = dict(zip(("r_o", "g_o", "b_o"), rgb, strict=True))
    await bench.pipeline(inputs, outputs, k.LATENCY_COLOUR, gap=gap, reset=reset)
