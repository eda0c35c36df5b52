# SPDX-License-Identifier: Apache-2.0
"""The yardstick on whole frames: a unit normal and light at each pixel by ``shade_phong``, each pixel compared."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping

import numpy as np
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import core as golden
from polyshade.golden import registers
from polyshade.sim.core import Lines
from polyshade.sim.direct import Compared

SMALL = {"REFLECT": 0, "DIVIDE": 0}  # of models without a reflected ray and without a quotient


def draw(
    lines: Lines, words: Mapping[str, int], stage: Callable[[str], None] = lambda name: None, **built: int
) -> Compared:
    """Draw spans by ``shade_phong`` with parameters ``built``; compare."""
    model = sim.load("shade_phong", **built)
    stage("simulate")
    began = time.perf_counter()
    run = model.run(s_axis_span_tdata=lines.beats, draw_i=registers.draw(words))
    seconds = time.perf_counter() - began
    stage("compare")
    parts = {name.lower(): value for name, value in built.items() if name in SMALL}
    wanted, _ = golden.phong(lines.n, lines.g, lines.count, words, **parts)
    mask = (1 << k.PIXEL_W) - 1
    data = run.outputs["m_axis_pixel_tdata"]
    pixels = np.stack([data & mask, data >> k.PIXEL_W], axis=-1)
    both = min(len(wanted), len(pixels))
    differ = np.flatnonzero((wanted[:both] != pixels[:both]).any(axis=1))
    first = {}
    if len(differ):
        pair = {"expected": wanted[differ[0]], "actual": pixels[differ[0]]}
        first = {"pixel": int(differ[0])} | {name: ", ".join(f"{v:#x}" for v in row) for name, row in pair.items()}
    elif len(wanted) != len(pixels):
        first = {"expected": f"{len(wanted)} pixels", "actual": f"{len(pixels)} pixels"}
    shown = np.zeros_like(wanted)
    shown[:both] = pixels[:both]
    clocks = int(run.given[-1] - run.taken[0] + 1) if len(pixels) else 0
    wrong = len(differ) + abs(len(wanted) - len(pixels))
    return Compared(shown, clocks, seconds, {"pixels": len(pixels), "errors": 0}, [], wrong, first)
