# SPDX-License-Identifier: Apache-2.0
"""Scan conversion in the RTL: projected vertices in, spans or packets out, everything compared.

What the Verilated ``shade_spans`` or ``shade_surfaces`` gives is compared with ``golden.raster`` bit for bit; which
pixels it covers, and which of them are seen, with the exact scan converter and the z-buffer of ``sim.scene.raster``,
which work in float64.
"""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import raster as golden
from polyshade.golden.types import SPAN, pack
from polyshade.sim.core import Lines
from polyshade.sim.errors import UserError
from polyshade.sim.scene.camera import Screen
from polyshade.sim.scene.raster import Spans, resolve, snap
from polyshade.sim.scene.triangles import Triangles

Ints = NDArray[np.int64]
PLACES = 1 << k.COORDINATE_W - 1  # a vertex lies in [-PLACES, PLACES), in 1/256 pixel


@dataclass(frozen=True)
class Scanned:
    """What came back.

    ``coverage_mismatches``: runs that the reference has otherwise; ``depth_mismatches``: pixels of another triangle.
    """

    golden: golden.Scanned  # equal to what came
    given: Ints  # the clock at which each beat came
    visible: Ints  # (size * size,) index of the pixel in stream order, -1: background
    mismatches: int
    coverage_mismatches: int
    depth_mismatches: int
    clocks: int
    seconds: float

    @property
    def lines(self) -> Lines:
        """The spans, each with a number of its own as tag, by which those of several lanes are told apart."""
        v = golden.lines(self.golden)
        normal, increment = (np.stack([v[f"{name}.{axis}"] for axis in "xyz"], -1) for name in ("normal", "increment"))
        number = np.arange(len(v["count"])) % (1 << k.TAG_W)
        return Lines(normal, increment, v["count"], v["cosine"], number, v["flat"])

    @property
    def report(self) -> dict[str, int]:
        """For a frame's report."""
        return {"coverage_mismatches": self.coverage_mismatches, "depth_mismatches": self.depth_mismatches}


def fits(screen: Screen, faces: NDArray[np.int32]) -> bool:
    """Do all vertices lie within the range of the RTL?"""
    return not len(faces) or bool(np.all(np.abs(screen.xy[faces] * (1 << k.SUBPIXEL_F)) < PLACES - 1))


def vertices(screen: Screen, faces: NDArray[np.int32], flat: ArrayLike = 0) -> golden.Vertices:
    """Projected triangles as they are sent; the depths of all of them are spread over [0, 1)."""
    depth = screen.depth
    low, high = (depth.min(), depth.max()) if len(depth) else (0.0, 0.0)
    unit = np.rint((depth - low) / ((high - low) or 1.0) * golden.FARTHEST).astype(np.int64)
    bound = 1 << k.VERTEX_F
    normal = np.clip(np.rint(screen.normals * bound), -bound, bound - 1).astype(np.int64)
    places, index = snap(screen.xy)[faces], np.arange(len(faces))
    marks = np.broadcast_to(np.asarray(flat, np.int64), index.shape)
    return golden.Vertices(places[..., 0], places[..., 1], unit[faces], normal[faces], index % (1 << k.TAG_W), marks)


def scan(
    screen: Screen, faces: NDArray[np.int32], size: int, spans: Spans, flat: ArrayLike = 0, module: str = "shade_spans"
) -> Scanned:
    """Front faces through ``module``, shade_spans or shade_surfaces; ``spans`` is what the reference found."""
    if not fits(screen, faces):
        raise UserError(f"--scan: a vertex lies {PLACES >> k.SUBPIXEL_F} pixels away or more, allowed with --scan host")
    sent, view = vertices(screen, faces, flat), golden.View(size, size)
    wanted = golden.scan(sent, view)
    model = sim.load(module)
    began = time.perf_counter()
    run = model.run(**golden.beats(sent), **view.ports, drain=_reach(sent), patience=_reach(sent))
    seconds = time.perf_counter() - began

    if module == "shade_spans":
        expected = golden.lines(wanted)
        spots = {name: expected.pop(name) for name in ("column", "line", "depth", "increase")}
        told = {f"m_axis_span_tuser.{name}": value for name, value in spots.items()}
        told |= {"m_axis_span_tdata": pack(SPAN, expected)}
    else:
        told = {name.replace("s_", "m_", 1): value for name, value in golden.packets(wanted).items()}
    mismatches = _differences(told, run.outputs)
    rows = np.stack([wanted.tag[wanted.triangle], wanted.line, wanted.column, wanted.count], axis=-1)
    exact = np.stack([spans.triangle % (1 << k.TAG_W), spans.y, spans.x, spans.count], axis=-1)
    coverage = _differences({"runs": exact}, {"runs": rows})
    if mismatches or coverage:
        raise sim.SimulationError(
            f"{model!r}: {mismatches} beats differ from the golden model, {coverage} runs from the reference"
        )
    run_of, column, line, depth = golden.depths(wanted)
    visible = nearest(line * size + column, depth, size)
    owner = np.r_[spans.triangle[run_of], -1]  # -1 is the last: the background's
    winner, before = (owner[v] for v in (visible, resolve(spans, size)))
    clocks = int(run.given[-1] - run.taken[0] + 1) if len(run.given) else 0
    differ = int((winner != before).sum())
    return Scanned(wanted, run.given, visible, mismatches, coverage, differ, clocks, seconds)


def _differences(wanted: dict[str, NDArray], came: dict[str, NDArray]) -> int:
    """Rows that differ in any of the arrays, and those that one side has more."""
    (count,), (other,) = ({len(values[name]) for name in wanted} for values in (wanted, came))
    both = min(count, other)
    wrong = np.zeros(both, bool)
    for name, values in wanted.items():
        differ = values[:both] != came[name][:both]
        wrong |= differ.any(axis=1) if differ.ndim > 1 else differ
    return int(wrong.sum()) + abs(count - other)


def triangles(s: golden.Scanned) -> Triangles:
    """As ``shade_surfaces`` sends them."""
    values, opened = golden.heads(s)
    vectors = {
        name: np.stack([values[f"{part}.{axis}"] for axis in "xyz"], axis=-1)
        for name, part in (("normal", "normal"), ("dcolumn", "dcolumn.mantissa"), ("dline", "dline.mantissa"))
    }
    return Triangles(
        **vectors,
        dcolumn_exp=values["dcolumn.exp"],
        dline_exp=values["dline.exp"],
        box=np.stack([values[name] for name in ("columns", "lines", "left")], axis=-1),
        tag=values["tag"],
        flat=values["flat"],
        triangle=np.cumsum(opened) - 1,
        column=s.column,
        line=s.line,
        count=s.count,
    )


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
