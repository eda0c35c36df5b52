"""What scan conversion found as packets TRIANGLE and RUN of ``golden.packets``."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from polyshade.golden import contract as k
from polyshade.golden.packets import RUN, TRIANGLE, pack
from polyshade.sim.scene.raster import Spans

Ints = NDArray[np.int64]


@dataclass(frozen=True)
class Triangles:
    """Triangles (T, ...) and their runs (S,), in order. Normals and increments S2.29.

    A sliver whose normal at the corner of its box or whose increments do not fit is one triangle for each run.
    """

    normal: Ints  # (T, 3) at the left upper corner of the box
    dcolumn: Ints  # (T, 3)
    dline: Ints  # (T, 3)
    box: Ints  # (T, 4) column, line, columns, lines
    tag: Ints  # (T,)
    flat: Ints  # (T,)
    triangle: Ints  # (S,) index of a run's triangle
    column: Ints  # (S,)
    line: Ints  # (S,)
    count: Ints  # (S,)

    @classmethod
    def of(cls, spans: Spans, flat: NDArray | None = None) -> Triangles:
        """Quantized, to nearest; ``flat`` (F,) of every face of the mesh."""
        face, x, y, count = (part.astype(np.int64) for part in (spans.triangle, spans.x, spans.y, spans.count))
        first = np.r_[True, face[1:] != face[:-1]][: len(face)]  # runs with which a triangle begins
        owner = np.cumsum(first) - 1
        corner, box = _corners(spans, x, y, count, np.flatnonzero(first))
        at = np.flatnonzero(first)
        small = np.all([_fits(v) for v in (corner, spans.gradient[at], spans.line_gradient[at])], axis=0)
        first |= ~small[owner]
        alone, at = ~small[owner][first], np.flatnonzero(first)
        owner = np.cumsum(first) - 1
        corner, box = _corners(spans, x, y, count, at)
        single = (alone & (count[at] == 1))[:, None]
        return cls(
            normal=_quantize(np.where(alone[:, None], spans.normal[at], corner)),
            dcolumn=_quantize(np.where(single, 0, spans.gradient[at])),
            dline=_quantize(np.where(alone[:, None], 0, spans.line_gradient[at])),
            box=box,
            tag=face[at] % (1 << k.TAG_W),
            flat=np.zeros(len(at), np.int64) if flat is None else np.asarray(flat, np.int64)[face[at]],
            triangle=owner,
            column=x,
            line=y,
            count=count,
        )

    @property
    def last(self) -> Ints:
        """(S,): 1 for the last run of its triangle."""
        return np.r_[self.triangle[1:] != self.triangle[:-1], True][: len(self.triangle)].astype(np.int64)

    def stream(self) -> dict[str, NDArray]:
        """Packets, beat by beat: ``s_axis_surface_tdata`` and ``_tlast``."""
        vectors = {
            f"{name}_{axis}": getattr(self, name)[:, i]
            for name in ("normal", "dcolumn", "dline")
            for i, axis in enumerate("xyz")
        }
        box = dict(zip(("column", "line", "columns", "lines"), self.box.T, strict=True))
        heads = pack(TRIANGLE, **vectors, **box, tag=self.tag, flat=self.flat).view(np.uint64)
        runs = pack(RUN, column=self.column, line=self.line, count=self.count).view(np.uint64)
        at = np.arange(len(runs)) + k.TRIANGLE_BEATS * (self.triangle + 1)  # where the runs are among all beats
        beats = np.zeros(len(runs) + heads.size, np.uint64)
        place = np.ones(len(beats), bool)
        place[at] = False
        beats[at], beats[place] = runs[:, 0], heads.ravel()
        last = np.zeros(len(beats), np.int64)
        last[at] = self.last
        return {"s_axis_surface_tdata": beats, "s_axis_surface_tlast": last}


def _corners(spans: Spans, x: Ints, y: Ints, count: Ints, at: Ints) -> tuple[NDArray, Ints]:
    """Normals at the corners of the boxes, and the boxes, of triangles that begin at the runs ``at``."""
    if not len(at):
        return np.zeros((0, 3)), np.zeros((0, 4), np.int64)
    column, line = np.minimum.reduceat(x, at), y[at]
    columns = np.maximum.reduceat(x + count, at) - column
    lines = np.maximum.reduceat(y, at) + 1 - line
    corner = spans.normal[at] - (x[at] - column)[:, None] * spans.gradient[at]
    return corner, np.stack([column, line, columns, lines], axis=-1)


def _fits(vector: NDArray) -> NDArray[np.bool_]:
    """Does it fit S2.29 with room for rounding."""
    return np.abs(vector).max(axis=1, initial=0) < (1 << k.STEP_W - 1 - k.STEP_F) - 1e-6


def _quantize(vector: NDArray) -> Ints:
    return np.rint(vector * (1 << k.STEP_F)).astype(np.int64)
