# SPDX-License-Identifier: Apache-2.0
"""The yardstick over the head: every pixel the golden model's to the bit, and close to the original model's light."""

import numpy as np
import pytest
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import core as golden
from polyshade.golden.material import Material, registers
from polyshade.golden.registers import draw
from polyshade.sim.core import Lines, compare
from polyshade.sim.scene.camera import Camera
from polyshade.sim.scene.mesh import load_mesh
from polyshade.sim.scene.raster import Spans, expand, scan_convert

from tb.runner import SEED

LIGHT = (0.3, 0.6, 0.8)


@pytest.fixture(scope="module")
def head() -> Spans:
    """The head at 512 x 512."""
    mesh = load_mesh("head")
    return scan_convert(Camera(size=512).project(mesh), mesh.faces, 512)


@pytest.mark.parametrize(
    ("material", "parameters"),
    [
        (Material("lambert"), {"REFLECT": 0, "DIVIDE": 0}),
        (Material("blinn", 32.0), {"REFLECT": 0, "DIVIDE": 0}),
        (Material("blinn", 512.0), {}),
        (Material("phong", 32.0), {}),
        (Material("cook-torrance"), {}),
    ],
    ids=["lambert", "blinn", "blinn-512", "phong", "cook-torrance"],
)
@pytest.mark.parametrize(("in_gap", "out_stall"), [(0, 0), (0.3, 0.3)])
def test_head(head: Spans, material: Material, parameters: dict[str, int], in_gap: float, out_stall: float) -> None:
    """Every pixel, tag and end of span; one pixel a clock; NMSE against float64 at most 1e-6."""
    lines, words = Lines.of(head), registers(material, LIGHT)
    run = sim.load("shade_phong", **parameters).run(
        s_axis_span_tdata=lines.beats, draw_i=draw(words), in_gap=in_gap, out_stall=out_stall, seed=SEED
    )
    built = {name.lower(): value for name, value in parameters.items()}
    wanted = golden.Drawn(*golden.phong(lines.n, lines.g, lines.count, words, **built), np.zeros(0, int), 0)
    pixels, mismatches, first = compare(run.outputs, lines, lines.beats, wanted)
    assert mismatches == 0, first
    assert run.status == {}
    if not in_gap:
        latency = k.LATENCY_PHONG - k.LATENCY_REFLECT * (1 - parameters.get("REFLECT", 1))
        assert run.given[0] - run.taken[0] == latency
        assert run.given[-1] - run.given[0] == len(pixels) - 1

    every = expand(head, 512)
    normal = head.normal[every.span] + every.step[:, None] * head.gradient[every.span]
    exact = material.channels(normal, LIGHT).clip(0, 1)
    error = pixels / (1 << k.INTENSITY_F) - exact
    assert np.all((error**2).sum(axis=0) <= 1e-6 * (exact**2).sum(axis=0))
