# SPDX-License-Identifier: Apache-2.0
"""What scan conversion found as packets TRIANGLE and RUN, see ``golden.types``."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from polyshade.golden import contract as k
from polyshade.golden.types import RUN, TRIANGLE, pack
from polyshade.sim.scene.raster import Spans

Ints = NDArray[np.int64]


@dataclass(frozen=True)
class Triangles:
    """Triangles (T, ...) and their runs (S,), in order, see ``golden.types.TRIANGLE``.

    A sliver whose increments do not fit is one triangle for each run.
    """

    normal: Ints  # (T, 3) at the reference pixel, the first of the first run, S1.16
    dcolumn: Ints  # (T, 3) increment per column, S1.16 times 2^-dcolumn_exp
    dcolumn_exp: Ints  # (T,)
    dline: Ints  # (T, 3) increment per line
    dline_exp: Ints  # (T,)
    box: Ints  # (T, 3) columns, lines, columns left of the reference pixel
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
        whole = _parts(spans, x, y, count, np.flatnonzero(first))
        small = np.all([_fits(part, box) for part, box in zip(whole[:2], whole[2].T[:2], strict=True)], axis=0)
        first |= ~small[np.cumsum(first) - 1]
        at = np.flatnonzero(first)
        dcolumn, dline, box = _parts(spans, x, y, count, at)
        dcolumn, dcolumn_exp = _scaled(dcolumn)
        dline, dline_exp = _scaled(dline)
        return cls(
            normal=_quantized(spans.normal[at]),
            dcolumn=dcolumn,
            dcolumn_exp=dcolumn_exp,
            dline=dline,
            dline_exp=dline_exp,
            box=box,
            tag=face[at] % (1 << k.TAG_W),
            flat=np.zeros(len(at), np.int64) if flat is None else np.asarray(flat, np.int64)[face[at]],
            triangle=np.cumsum(first) - 1,
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
        vectors = {"normal": self.normal, "dcolumn.mantissa": self.dcolumn, "dline.mantissa": self.dline}
        values = {f"{name}.{axis}": part for name, v in vectors.items() for axis, part in zip("xyz", v.T, strict=True)}
        values |= {
            "dcolumn.exp": self.dcolumn_exp,
            "dline.exp": self.dline_exp,
            "tag": self.tag,
            "flat": self.flat,
        }
        values |= dict(zip(("columns", "lines", "left"), self.box.T, strict=True))
        heads = pack(TRIANGLE, values).view(np.uint64)
        runs = pack(RUN, {"column": self.column, "line": self.line, "count": self.count}).view(np.uint64)
        at = np.arange(len(runs)) + k.TRIANGLE_BEATS * (self.triangle + 1)  # where the runs are among all beats
        beats = np.zeros(len(runs) + heads.size, np.uint64)
        place = np.ones(len(beats), bool)
        place[at] = False
        beats[at], beats[place] = runs[:, 0], heads.ravel()
        last = np.zeros(len(beats), np.int64)
        last[at] = self.last
        return {"s_axis_surface_tdata": beats, "s_axis_surface_tlast": last}


def _parts(spans: Spans, x: Ints, y: Ints, count: Ints, at: Ints) -> tuple[NDArray, NDArray, Ints]:
    """Increments per column and line, and boxes, of triangles that begin at the runs ``at``."""
    if not len(at):
        return np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 3), np.int64)
    left, right = np.minimum.reduceat(x, at), np.maximum.reduceat(x + count, at)
    columns, lines = right - left, np.maximum.reduceat(y, at) + 1 - y[at]
    dcolumn = np.where((columns > 1)[:, None], spans.gradient[at], 0)
    dline = np.where((lines > 1)[:, None], spans.line_gradient[at], 0)
    return dcolumn, dline, np.stack([columns, lines, x[at] - left], axis=-1)


def _fits(increment: NDArray, size: Ints) -> NDArray[np.bool_]:
    """Is the increment, times the largest power of two below the box's size, within [-2, 2), with room for rounding."""
    power = np.exp2(np.floor(np.log2(np.maximum(size - 1, 1))))
    return np.abs(increment).max(axis=1, initial=0) * power < 2 - 1e-4


def _quantized(vector: NDArray) -> Ints:
    """S1.16, to nearest, saturating."""
    limit = 1 << k.INTENSITY_W - 1
    return np.clip(np.rint(vector * (1 << k.INTENSITY_F)), -limit, limit - 1).astype(np.int64)


def _scaled(vector: NDArray) -> tuple[Ints, Ints]:
    """Mantissas S1.16 and the largest exponent with which all of them fit."""
    largest = np.abs(vector).max(axis=1, initial=2.0**-40)
    exponent = np.clip(np.floor(np.log2(2 / (largest + 2.0**-40)) - 2.0**-17), 0, (1 << k.TRIANGLE_EXP_W) - 1)
    return _quantized(vector * np.exp2(exponent)[:, None]), exponent.astype(np.int64)
