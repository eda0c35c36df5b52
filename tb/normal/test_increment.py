# SPDX-License-Identifier: Apache-2.0
"""shade_increment: normals from pixel to pixel and from line to line, to the bit of golden.normal.increment."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.normal import increment

from tb.bench import Bench, checked
from tb.runner import simulate


def test_cocotb():
    simulate("shade_increment", {})


@checked(gap=[0.0, 0.5])
async def triangles(bench: Bench, gap: float) -> None:
    """Starts, pixels and lines in any order; a clock without a row changes nothing."""
    rows = 1000
    first = (bench.rng.random(rows) < 0.05).astype(int)
    first[0] = 1
    line = (bench.rng.random(rows) < 0.2).astype(int)
    unit = 1 << k.STEP_F
    inputs = {"first_i": first, "line_i": line}
    for kind, reach in (("n", unit), ("g", unit >> 9), ("l", unit >> 9)):
        inputs |= {f"{kind}_i.{c}": bench.rng.integers(-reach, reach, rows, endpoint=True) for c in "xyz"}
    outputs = {f"n_o.{c}": increment(first, line, *(inputs[f"{kind}_i.{c}"] for kind in "ngl")) for c in "xyz"}
    await bench.pipeline(inputs, outputs, k.LATENCY_INCREMENT, gap=gap)


@checked()
async def triangle(bench: Bench) -> None:
    """All lines of a triangle share its increment: 60 lines of 25 pixels stay within 1 ulp of the plane."""
    height, width = 60, 25
    corner = bench.rng.uniform(-0.5, 0.5, 3)
    across, down = bench.rng.uniform(-0.5, 0.5, (2, 3)) / np.array([[width], [height]])
    y, x = (part.ravel() for part in np.mgrid[:height, :width])
    scale = 1 << k.STEP_F
    inputs = {"first_i": (x + y == 0).astype(int), "line_i": ((x == 0) & (y > 0)).astype(int)}
    for c, parts in zip("xyz", zip(corner, across, down, strict=True), strict=True):
        inputs |= {
            f"{kind}_i.{c}": np.full(x.size, round(part * scale)) for kind, part in zip("ngl", parts, strict=True)
        }
    outputs = {}
    for c, begin, right, below in zip("xyz", corner, across, down, strict=True):
        steps = (inputs[f"{kind}_i.{c}"] for kind in "ngl")
        outputs[f"n_o.{c}"] = increment(inputs["first_i"], inputs["line_i"], *steps)
        plane = (begin + x * right + y * below) * (1 << k.INTENSITY_F)
        bench.equal(np.abs(outputs[f"n_o.{c}"] - plane).max() < 1, True, f"{c} on the plane within 1 ulp")
    await bench.pipeline(inputs, outputs, k.LATENCY_INCREMENT)


@checked()
async def longest(bench: Bench) -> None:
    """After 4096 increments, each rounded to S2.29, the normal is right to 1 ulp of S1.16."""
    rows = k.PIXELS_MAX
    begin, end = bench.rng.uniform(-1, 1, (2, 3))
    step = (end - begin) / (rows - 1)
    first = np.zeros(rows, int)
    first[0] = 1
    scale = 1 << k.STEP_F
    inputs = {"first_i": first, "line_i": np.zeros(rows, int)}
    for c, low, slope in zip("xyz", begin, step, strict=True):
        values = {"n": round(low * scale), "g": round(slope * scale), "l": 0}
        inputs |= {f"{kind}_i.{c}": np.full(rows, value) for kind, value in values.items()}
    outputs = {f"n_o.{c}": increment(first, 0 * first, *(inputs[f"{kind}_i.{c}"] for kind in "ngl")) for c in "xyz"}
    for c, value in zip("xyz", end, strict=True):
        bench.equal(
            abs(outputs[f"n_o.{c}"][-1] - value * (1 << k.INTENSITY_F)) < 1, True, f"{c} at the end of the line"
        )
    await bench.pipeline(inputs, outputs, k.LATENCY_INCREMENT)
