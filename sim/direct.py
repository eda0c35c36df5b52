# SPDX-License-Identifier: Apache-2.0
"""The direct form on whole frames: triangles and their runs through ``shade_direct``, each pixel compared."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import direct as golden
from polyshade.golden.material import Material, chords, light_registers
from polyshade.sim.scene.triangles import Triangles

FAULTS = ("error_empty", "error_long", "error_packet", "error_order", "normal_short", "normal_long")


@dataclass(frozen=True)
class Compared:
    """What ``shade_direct`` made of triangles. ``pixels`` (P, 2) U0.16: in the order of the runs."""

    pixels: NDArray[np.int64]
    clocks: int  # from the first beat of the first triangle to the last pixel
    seconds: float  # of simulation
    counters: dict[str, int]
    status: list[str]  # names of the bits that are set
    mismatches: int  # pixels
    first_mismatch: dict = field(default_factory=dict)
    counter_mismatches: dict[str, str] = field(default_factory=dict)  # by name: "expected 1 actual 2"

    @property
    def evaluations(self) -> int:
        """Lights: one a pixel."""
        return len(self.pixels)


def draw(
    triangles: Triangles, material: Material, light, stage: Callable[[str], None] = lambda name: None, **options: float
) -> Compared:
    """Draw triangles by ``shade_direct``; compare. ``options``: of :meth:`sim.Model.run`."""
    table, words, packets = chords(material, light), light_registers(light), triangles.stream()
    vectors = {name: [words[f"{name}{axis}"] for axis in "xyz"] for name in "lh"}
    before = golden.lobe_packet(table)
    beats = {name: np.r_[before[name], packets[name]] for name in packets}
    ports = {f"{n}_i.{axis}": v for n, parts in vectors.items() for axis, v in zip("xyz", parts, strict=True)}
    model = sim.load("shade_direct")
    stage("simulate")
    began = time.perf_counter()
    run = model.run(**beats, **ports, **options)
    seconds = time.perf_counter() - began
    stage("compare")
    wanted = golden.direct(*packets.values(), vectors["l"], vectors["h"], table)
    names = ("tdata", "tuser", "tlast")
    expected = np.stack([wanted.pixels[:, 0] | wanted.pixels[:, 1] << k.PIXEL_W, wanted.tag, wanted.last], axis=-1)
    actual = np.stack([run.outputs[f"m_axis_pixel_{name}"] for name in names], axis=-1)
    both = min(len(expected), len(actual))
    differ = np.flatnonzero((expected[:both] != actual[:both]).any(axis=1))
    first = {}
    if len(differ):
        pair = {"expected": expected[differ[0]], "actual": actual[differ[0]]}
        first = {"pixel": int(differ[0])} | {name: ", ".join(f"{v:#x}" for v in row) for name, row in pair.items()}
    elif len(expected) != len(actual):
        first = {"expected": f"{len(expected)} pixels", "actual": f"{len(actual)} pixels"}
    pixels = np.zeros((len(expected), 2), np.int64)
    data = actual[:both, 0]
    pixels[:both] = np.stack([data & (1 << k.PIXEL_W) - 1, data >> k.PIXEL_W], axis=-1)
    told = {"error_o": wanted.errors, "error_count_o": wanted.dropped}
    unlike = {
        name: f"expected {told[name]} actual {run.status[name]}" for name in told if run.status[name] != told[name]
    }
    bits = [name for i, name in enumerate(FAULTS) if run.status["error_o"] >> i & 1]
    clocks = int(run.given[-1] - run.taken[len(before["s_axis_surface_tdata"])] + 1) if len(actual) else 0
    counters = {"pixels": len(actual), "errors": run.status["error_count_o"]}
    return Compared(
        pixels, clocks, seconds, counters, bits, len(differ) + abs(len(expected) - len(actual)), first, unlike
    )
