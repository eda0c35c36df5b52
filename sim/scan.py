# SPDX-License-Identifier: Apache-2.0
"""Scan conversion in the RTL: projected vertices in, spans out, everything compared.

What the Verilated ``shade_spans`` gives is compared with ``golden.raster`` bit for bit; which pixels it covers, and
which of them are seen, with the exact scan converter and the z-buffer of ``sim.scene.raster``, which work in float64.
"""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import raster as golden
from polyshade.golden.types import SPAN, pack, unpack
from polyshade.sim.core import Lines
from polyshade.sim.errors import UserError
from polyshade.sim.scene.camera import Screen
from polyshade.sim.scene.raster import Spans, resolve, snap

Ints = NDArray[np.int64]
PLACES = 1 << k.COORDINATE_W - 1  # a vertex lies in [-PLACES, PLACES), in 1/256 pixel


@dataclass(frozen=True)
class Scanned:
    """What came back.

    ``coverage_mismatches``: spans that the reference has otherwise; ``depth_mismatches``: pixels of another triangle.
    """

    lines: Lines
    given: Ints  # (S,) the clock at which each span came
    visible: Ints  # (size * size,) index of the pixel in stream order, -1: background
    mismatches: int
    coverage_mismatches: int
    depth_mismatches: int
    clocks: int
    seconds: float

    @property
    def report(self) -> dict[str, int]:
        """For a frame's report."""
        return {
            "coverage_mismatches": self.coverage_mismatches,
            "depth_mismatches": self.depth_mismatches,
            "scan_cycles": self.clocks,
        }


def fits(screen: Screen, faces: NDArray[np.int32]) -> bool:
    """Do all vertices lie within the range of the RTL?"""
    return not len(faces) or bool(np.all(np.abs(screen.xy[faces] * (1 << k.SUBPIXEL_F)) < PLACES - 1))


def vertices(screen: Screen, faces: NDArray[np.int32], flat: ArrayLike = 0) -> golden.Vertices:
    """Projected triangles as they are sent; the depths of all of them are spread over [0, 1)."""
    depth = screen.depth
    low, high = (depth.min(), depth.max()) if len(depth) else (0.0, 0.0)
    unit = np.rint((depth - low) / ((high - low) or 1.0) * ((1 << k.DEPTH_F) - 1)).astype(np.int64)
    bound = 1 << k.VERTEX_F
    normal = np.clip(np.rint(screen.normals * bound), -bound, bound - 1).astype(np.int64)
    places, index = snap(screen.xy)[faces], np.arange(len(faces))
    marks = np.broadcast_to(np.asarray(flat, np.int64), index.shape)
    return golden.Vertices(places[..., 0], places[..., 1], unit[faces], normal[faces], index % (1 << k.TAG_W), marks)


def scan(screen: Screen, faces: NDArray[np.int32], size: int, spans: Spans, flat: ArrayLike = 0) -> Scanned:
    """Front faces through ``shade_spans``; ``spans`` is what the reference found."""
    if not fits(screen, faces):
        raise UserError(f"--scan: a vertex lies {PLACES >> k.SUBPIXEL_F} pixels away or more, allowed with --scan host")
    sent, view = vertices(screen, faces, flat), golden.View(size, size)
    wanted = golden.scan(sent, view)
    model = sim.load("shade_spans")
    began = time.perf_counter()
    settings = {"cull_i": view.cull, "flat_i": view.flat, "columns_i": size, "lines_i": size}
    run = model.run(**golden.beats(sent), **settings, drain=_reach(sent), patience=_reach(sent))
    seconds = time.perf_counter() - began

    expected = golden.lines(wanted)
    spots = {name: expected.pop(name) for name in ("column", "line", "depth", "increase")}
    came = {name: run.outputs[f"m_axis_span_tuser.{name}"] for name in spots}
    beats, packets = run.outputs["m_axis_span_tdata"], pack(SPAN, expected)
    common = min(len(beats), len(packets))
    wrong = np.any(beats[:common] != packets[:common], axis=1)
    for name, value in spots.items():
        wrong |= came[name][:common] != value[:common]
    mismatches = int(wrong.sum()) + abs(len(beats) - len(packets))

    parts = unpack(SPAN, beats)
    normal, increment = (np.stack([parts[f"{v}.{axis}"] for axis in "xyz"], -1) for v in ("normal", "increment"))
    lines = Lines(normal, increment, parts["count"], parts["cosine"], parts["tag"], parts["flat"])
    rows = np.stack([parts["tag"], came["line"], came["column"], parts["count"]], axis=-1)
    exact = np.stack([spans.triangle % (1 << k.TAG_W), spans.y, spans.x, spans.count], axis=-1)
    both = min(len(rows), len(exact))
    coverage = int(np.any(rows[:both] != exact[:both], axis=1).sum()) + abs(len(rows) - len(exact))
    if mismatches or coverage:
        raise sim.SimulationError(
            f"{model!r}: {mismatches} spans differ from the golden model, {coverage} from the reference"
        )
    run_of, column, line, depth = golden.depths(wanted)
    visible = nearest(line * size + column, depth, size)
    winner, before = (np.where(v >= 0, spans.triangle[run_of[v]], -1) for v in (visible, resolve(spans, size)))
    clocks = int(run.given[-1] - run.taken[0] + 1) if len(run.given) else 0
    return Scanned(lines, run.given, visible, mismatches, coverage, int((winner != before).sum()), clocks, seconds)


def _reach(sent: golden.Vertices) -> int:
    """Clocks in which any of the triangles is through: a line each, and every column that an edge moves aside."""
    pixels = (int(np.ptp(axis)) if axis.size else 0 for axis in (sent.x, sent.y))
    return 4096 + (4 * sum(pixels) >> k.SUBPIXEL_F)


def nearest(place: Ints, depth: Ints, size: int) -> Ints:
    """The z-buffer of integers: of each place the first pixel with the least depth, or -1."""
    order = np.lexsort((np.arange(len(place)), depth, place))
    first = order[np.r_[True, np.diff(place[order]) != 0][: len(order)]]
    seen = np.full(size * size, -1, np.int64)
    seen[place[first]] = first
    return seen
