# SPDX-License-Identifier: Apache-2.0
"""Patches on whole frames: triangles and their runs through ``shade_patch``, each pixel compared with the golden model.

The order of the pixels depends on which lane was free; each tells its place, so that both sides are sorted.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import direct
from polyshade.golden import patch as golden
from polyshade.golden.material import Material
from polyshade.sim.scene.triangles import Triangles

Ints = NDArray[np.int64]
FLAGS = ("light_range", "light_short")


@dataclass(frozen=True)
class Compared:
    """What ``shade_patch`` made of triangles. ``pixels`` (P, 2) U0.16: in the order of the runs, 0 where none came."""

    pixels: Ints
    golden: golden.Drawn
    clocks: int  # from the first beat of the first triangle to the last pixel
    seconds: float  # of simulation
    counters: dict[str, int]
    status: list[str]  # names of the bits that are set
    mismatches: int  # pixels
    first_mismatch: dict = field(default_factory=dict)
    counter_mismatches: dict[str, str] = field(default_factory=dict)  # by name: "expected 1 actual 2"

    @property
    def evaluations(self) -> int:
        """Lights."""
        return self.golden.evaluations


def settings(words: golden.Settings) -> dict[str, object]:
    """The settings' ports, without the table."""
    return {
        **{f"{name}_i": _joined(getattr(words, name).ravel(), k.INTENSITY_W) for name in "lh"},
        "excess_i": _joined(words.excess, k.EXCESS_W),
        "radius_i": words.radius,
        "reach_i": words.reach,
    }


def _joined(parts: NDArray, width: int) -> object:
    """Numbers side by side, the first in the lowest bits: one, or words of 32 bits for ports of more than 64."""
    whole = sum((int(part) & (1 << width) - 1) << width * i for i, part in enumerate(parts))
    bits = width * len(parts)
    return whole if bits <= 64 else np.array([[whole >> 32 * i & 0xFFFFFFFF for i in range(-(-bits // 32))]], np.uint32)


def beats(triangles: Triangles, lobe: direct.Lobe) -> dict[str, NDArray]:
    """``s_axis_surface``: the packet of the lobe, then those of the triangles."""
    before, packets = direct.lobe_packet(lobe), triangles.stream()
    return {name: np.r_[before[name], packets[name]] for name in packets}


LOBE_BEATS = 1 + (1 << k.CHORD_INDEX_W)


def streams(outputs: dict[str, NDArray], lanes: int) -> Ints:
    """(P, 3): tuser, tdata and tlast of every pixel of all lanes."""
    valid, last = outputs.get("m_axis_pixel_tvalid"), outputs["m_axis_pixel_tlast"]
    found = []
    for i in range(lanes):
        here = slice(None) if lanes == 1 else valid >> i & 1 == 1
        user, data = (
            _bits(outputs[f"m_axis_pixel_{name}"][here], width, i)
            for name, width in (("tuser", k.PATCH_USER_W), ("tdata", k.PIXEL_DATA_W))
        )
        found.append(np.stack([user, data, last[here] >> i & 1], axis=-1))
    return np.concatenate(found)


def _bits(values: NDArray, width: int, lane: int) -> Ints:
    """A lane's part of a port that is read as a number, or as words of 32 bits."""
    if values.ndim == 1:
        values = np.stack([values & 0xFFFFFFFF, values >> 32 & 0xFFFFFFFF], axis=-1)
    word, shift = divmod(width * lane, 32)
    pair = np.pad(values.astype(np.uint64), ((0, 0), (0, 2)))[:, word : word + 2]
    joined = pair[:, 0] | pair[:, 1] << np.uint64(32)
    return (joined >> np.uint64(shift) & np.uint64((1 << width) - 1)).astype(np.int64)


def draw(
    triangles: Triangles, material: Material, light, stage: Callable[[str], None] = lambda name: None, lanes: int = 1,
    **options: float,
) -> Compared:  # fmt: skip
    """Draw triangles by ``shade_patch``; compare. ``options``: of :meth:`sim.Model.run`."""
    words, lobe = golden.registers(material, light)
    model = sim.load("shade_patch", LANES=lanes, LIGHTS=len(words.l))
    stage("simulate")
    began = time.perf_counter()
    run = model.run(**beats(triangles, lobe), **settings(words), **options)
    seconds = time.perf_counter() - began
    stage("compare")
    wanted = golden.draw(
        golden.Triangles(*(getattr(triangles, name) for name in golden.Triangles._fields)), words, lobe
    )
    user = (wanted.line << k.PLACE_W | wanted.column) << k.TAG_W | wanted.tag
    expected = np.stack([user, wanted.pixels[:, 0] | wanted.pixels[:, 1] << k.PIXEL_W, wanted.last], axis=-1)
    actual = streams(run.outputs, lanes)
    pixels, wrong, first = np.zeros((len(expected), 2), np.int64), abs(len(actual) - len(expected)), {}
    if wrong:
        first = {"expected": f"{len(expected)} pixels", "actual": f"{len(actual)} pixels"}
    else:
        order, came = (np.lexsort(rows.T[::-1]) for rows in (expected, actual))
        differ = np.flatnonzero((expected[order] != actual[came]).any(axis=1))
        data = actual[came, 1]
        pixels[wanted.order[order]] = np.stack([data & (1 << k.PIXEL_W) - 1, data >> k.PIXEL_W], axis=-1)
        wrong = len(differ)
        if wrong:
            pair = zip(("expected", "actual"), (expected[order][differ[0]], actual[came][differ[0]]), strict=True)
            first = {name: ", ".join(f"{value:#x}" for value in row) for name, row in pair}
    bits = {name: run.status["flags_o"] >> i & 1 for i, name in enumerate(FLAGS)}
    counters = {"pixels": len(actual), "errors": run.status["error_count_o"]}
    differences = {
        name: f"expected {wanted.flags >> i & 1} actual {bits[name]}"
        for i, name in enumerate(FLAGS)
        if bits[name] != wanted.flags >> i & 1
    }
    if counters["errors"]:
        differences["errors"] = f"expected 0 actual {counters['errors']}"
    clocks = int(run.given[-1] - run.taken[LOBE_BEATS] + 1) if len(run.given) else 0
    status = [name for name, bit in bits.items() if bit]
    return Compared(pixels, wanted, clocks, seconds, counters, status, wrong, first, differences)
