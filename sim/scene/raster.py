# SPDX-License-Identifier: Apache-2.0
"""Scan conversion in exact integers, and the z-buffer.

Vertices are snapped to 1/256 pixel; from there on every question of coverage is answered in int64, so that
two triangles with a common edge own each pixel centre of that edge exactly once (the top-left rule).

A triangle is turned so that its edge functions are positive inside (y points down):

    E(p) = (bx - ax)(py - ay) - (by - ay)(px - ax)          edge a -> b, point p, units of 1/256 pixel squared

A pixel belongs to the triangle when its centre has E > 0 for all three edges, or E = 0 on an edge that is a
top edge (horizontal, inside below) or a left edge (inside to the right). Along a raster line E is linear in the
pixel's column, so each edge bounds the line's pixels from one side and the span is their intersection: two
integer divisions, no pixel is ever tested.

The same three values, divided by twice the area, are the barycentric weights: normals and depth are interpolated
with them, and their increment per pixel is one constant per triangle (Romanyuk et al., combined normalization,
Proc. SPIE 13400).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from polyshade.golden.stream import walk
from polyshade.sim.scene.camera import Screen

SUBPIXELS = 256
"""Positions a vertex can take along one pixel."""

REACH = 1 << 21
"""Largest distance of a vertex from the frame's origin, in pixels: products of edges then fit int64 (2**61)."""

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Spans:
    """Runs of pixels, one per triangle and raster line, ordered by triangle, then by line.

    With j = 0 .. count - 1 the pixel (x + j, y) has the un-normalized normal ``normal + j * gradient`` and the
    depth ``depth + j * depth_gradient``, both linear interpolations of the triangle's vertices at the pixel's centre.
    """

    triangle: NDArray[np.int32]  # (S,) index of the face
    y: NDArray[np.int32]  # (S,) raster line, 0 at the top
    x: NDArray[np.int32]  # (S,) first pixel
    count: NDArray[np.int32]  # (S,) pixels, at least 1
    normal: Floats  # (S, 3) at the first pixel
    gradient: Floats  # (S, 3) increment per pixel, the same for all spans of a triangle
    line_gradient: Floats  # (S, 3) increment per raster line, as well
    depth: Floats  # (S,) at the first pixel, smaller is nearer
    depth_gradient: Floats  # (S,) increment per pixel

    def __len__(self) -> int:
        return len(self.count)

    def __getitem__(self, part: slice) -> Spans:
        """Some of the spans."""
        return Spans(**{name: values[part] for name, values in vars(self).items()})

    @property
    def pixels(self) -> int:
        """Sum of all counts."""
        return int(self.count.sum())


@dataclass(frozen=True)
class Pixels:
    """The pixels of a list of spans, in stream order (all of the first span, then all of the second, ...)."""

    span: Ints  # (P,) index of the span
    step: Ints  # (P,) 0 .. count - 1 within the span
    place: Ints  # (P,) y * size + x in the frame


def snap(xy: Floats) -> Ints:
    """Screen coordinates in pixels to integers of 1/256 pixel, to nearest.

    Raises ValueError for a vertex farther than `REACH` pixels away, where the edge functions could overflow.
    Example: (0.5, 2.25) -> (128, 576).
    """
    if not np.all(np.abs(xy) < REACH):
        raise ValueError(f"a vertex lies {REACH} pixels or more away from the frame")
    return np.rint(xy * SUBPIXELS).astype(np.int64)


BLOCK = 1 << 16
"""Faces at a time: what is computed of them stays small beside the mesh."""


def scan_convert(screen: Screen, faces: NDArray[np.int32], size: int, cull: bool = True) -> Spans:
    """Cut triangles into spans of a ``size`` x ``size`` frame.

    `faces` (F, 3) indexes the vertices of `screen` and is counter-clockwise seen from outside. Faces that turn
    their back to the viewer are left out unless `cull` is False; faces without area after snapping always are.
    Pixels outside the frame are clipped.
    """
    places = snap(screen.xy)
    starts = range(0, max(len(faces), 1), BLOCK)
    parts = [vars(_scan_convert(screen, places, faces[at : at + BLOCK], size, cull)) for at in starts]
    for at, part in zip(starts, parts, strict=True):
        part["triangle"] += np.int32(at)
    return Spans(**{name: np.concatenate([part[name] for part in parts]) for name in parts[0]})


def faces_viewer(screen: Screen, faces: NDArray[np.int32]) -> bool:
    """Whether any face turns its front to the viewer."""
    places = snap(screen.xy)
    return any((_areas(places[faces[at : at + BLOCK]]) < 0).any() for at in range(0, len(faces), BLOCK))


def _areas(corners: Ints) -> Ints:
    """(F,): twice the areas of triangles (F, 3, 2), negative for front faces since y points down."""
    ab, ac = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]


def _scan_convert(screen: Screen, places: Ints, faces: NDArray[np.int32], size: int, cull: bool) -> Spans:
    """The spans of some faces; `places`: the snapped vertices of all."""
    corners = places[faces]  # (F, 3, 2)
    area = _areas(corners)
    triangle = np.flatnonzero(area < 0 if cull else area != 0)
    order = np.where(area[triangle, None] < 0, (0, 2, 1), (0, 1, 2))  # E > 0 inside from here on
    corner = np.take_along_axis(faces[triangle], order, axis=1)  # (T, 3) vertex indices
    area = np.abs(area[triangle])

    # Edge k faces corner k, so that E_k / area is the weight of corner k.
    points = np.take_along_axis(corners[triangle], order[..., None], axis=1)
    start, end = np.roll(points, -1, axis=1), np.roll(points, -2, axis=1)
    dx, dy = np.moveaxis(end - start, 2, 0)  # (T, 3) each
    top_left = (dy < 0) | ((dy == 0) & (dx > 0))

    # One row per triangle and raster line whose centres lie between the triangle's lowest and highest corner.
    half = SUBPIXELS // 2
    first = np.clip(-((half - points[..., 1].min(axis=1)) // SUBPIXELS), 0, size)
    last = np.clip((points[..., 1].max(axis=1) - half) // SUBPIXELS, -1, size - 1)
    t, step = walk(np.maximum(last - first + 1, 0))
    y = first[t] + step

    # E at the line's column 0, less what an edge that does not own its pixels demands: inside means E + x * slope >= 0.
    at_zero = dx[t] * (y[:, None] * SUBPIXELS + half - start[t, :, 1]) - dy[t] * (half - start[t, :, 0])
    limit = at_zero - ~top_left[t]
    slope = -dy[t] * SUBPIXELS
    far = np.int64(size)
    divisor = np.where(slope == 0, 1, slope)
    bound = -limit // divisor  # floor for falling edges; negated twice it is the ceiling for rising ones
    left = np.where(slope > 0, -(limit // divisor), np.where((slope == 0) & (limit < 0), far, 0)).max(axis=1)
    right = np.where(slope < 0, bound, far - 1).min(axis=1)
    left, right = np.maximum(left, 0), np.minimum(right, far - 1)

    kept = left <= right
    t, y, left, right = t[kept], y[kept], left[kept], right[kept]
    weight = (at_zero[kept] + left[:, None] * slope[kept]) / area[t, None]
    weight_step = -dy * SUBPIXELS / area[:, None]
    gradient = np.einsum("tk,tkc->tc", weight_step, screen.normals[corner])
    line_gradient = np.einsum("tk,tkc->tc", dx * SUBPIXELS / area[:, None], screen.normals[corner])
    depth_gradient = np.einsum("tk,tk->t", weight_step, screen.depth[corner])
    return Spans(
        triangle=triangle[t].astype(np.int32),
        y=y.astype(np.int32),
        x=left.astype(np.int32),
        count=(right - left + 1).astype(np.int32),
        normal=np.einsum("sk,skc->sc", weight, screen.normals[corner[t]]),
        gradient=gradient[t],
        line_gradient=line_gradient[t],
        depth=np.einsum("sk,sk->s", weight, screen.depth[corner[t]]),
        depth_gradient=depth_gradient[t],
    )


def portions(count: Ints, most: int = 1 << 20) -> list[tuple[slice, int]]:
    """Spans in portions of so many pixels, or of one span: their slices, and the stream index of their first pixel.

    What is computed of every pixel takes little room beside the frame then.

    >>> portions(np.array([3, 3, 3, 9, 1]), 6)
    [(slice(0, 2, None), 0), (slice(2, 3, None), 6), (slice(3, 4, None), 9), (slice(4, 5, None), 18)]
    """
    ends = np.cumsum(count)
    made, at, done = [], 0, 0
    while at < len(count):
        stop = max(int(np.searchsorted(ends, done + most, side="right")), at + 1)
        made.append((slice(at, stop), done))
        at, done = stop, int(ends[stop - 1])
    return made


def expand(spans: Spans, size: int) -> Pixels:
    """Every pixel of the spans, in stream order."""
    span, step = walk(spans.count)
    first = spans.y.astype(np.int64) * size + spans.x
    return Pixels(span=span, step=step, place=first[span] + step)


def resolve(spans: Spans, size: int) -> Ints:
    """The z-buffer: for each of the size * size places the stream index of the pixel that is seen, or -1.

    The smallest depth wins; of equal depths the earlier in the stream, that is, the earlier triangle.
    """
    nearest = np.full(size * size, np.inf)
    parts = portions(spans.count)
    for part, _ in parts:
        place, depth = _depths(spans[part], size)
        np.minimum.at(nearest, place, depth)
    visible = np.full(size * size, -1, dtype=np.int64)
    for part, first in reversed(parts):
        place, depth = _depths(spans[part], size)
        seen = np.flatnonzero(depth == nearest[place])[::-1]
        visible[place[seen]] = first + seen  # of repeated places NumPy keeps the last: the earliest, since reversed
    return visible


def _depths(spans: Spans, size: int) -> tuple[Ints, Floats]:
    """Place and depth of every pixel."""
    pixels = expand(spans, size)
    return pixels.place, spans.depth[pixels.span] + pixels.step * spans.depth_gradient[pixels.span]
