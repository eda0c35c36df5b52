# SPDX-License-Identifier: Apache-2.0
"""Triangles of every kind: small and large, slivers, far outside, fans; and what a stream of them must give."""

from __future__ import annotations

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import raster as golden

PLACE = 1 << k.COORDINATE_W - 1
NORMAL = 1 << k.VERTEX_F
KINDS = {"subpixel": 100, "small": 600, "middle": 256 * 20, "great": 256 * 300, "sliver": 256 * 100, "huge": PLACE}


def triangles(rng: np.random.Generator, kind: str, rows: int, size: int = 128) -> golden.Vertices:
    """Random triangles of a kind around a frame of size x size pixels, half of them with normals close together."""
    span = KINDS[kind]
    if kind == "huge":
        places = rng.integers(-PLACE, PLACE, (rows, 3, 2))
    else:
        places = rng.integers(-size * 64, size * 320, (rows, 1, 2)) + rng.integers(-span, span, (rows, 3, 2))
    if kind == "sliver":
        along = rng.integers(-span, span, (rows, 2))
        places[:, 1] = places[:, 0] + along
        places[:, 2] = places[:, 0] + along * rng.integers(0, 257, (rows, 1)) // 256 + rng.integers(-3, 4, (rows, 2))
    normal = rng.integers(-NORMAL, NORMAL, (rows, 3, 3))
    near = np.clip(normal[:, :1] + rng.integers(-3000, 3000, (rows, 3, 3)), -NORMAL, NORMAL - 1)
    normal = np.where((rng.random(rows) < 0.5)[:, None, None], near, normal)
    normal[np.all(normal == 0, axis=2)] = 1
    depth = rng.integers(0, 1 << k.DEPTH_F, (rows, 3))
    tag, flat = rng.integers(0, 1 << k.TAG_W, rows), rng.integers(0, 2, rows)
    return golden.Vertices(places[..., 0], places[..., 1], depth, normal, tag, flat)


def mixture(rng: np.random.Generator, rows: int, size: int = 128) -> golden.Vertices:
    """All kinds but the huge ones, in turn."""
    return join(
        [triangles(rng, kind, rows, size) for kind in KINDS if kind != "huge"], np.argsort(rng.random(5 * rows))
    )


def fan(rng: np.random.Generator, rows: int, size: int) -> golden.Vertices:
    """A closed fan: triangles around a point, each with a common edge with the next; all pixels in it, once each."""
    angle = np.sort(rng.random(rows)) * 2 * np.pi
    angle = np.r_[angle, np.arange(4) * np.pi / 2]  # no gap of half a turn
    angle.sort()
    rim = np.rint(256 * size * (0.5 + 0.45 * np.stack([np.cos(angle), np.sin(angle)], -1))).astype(np.int64)
    middle = np.broadcast_to(np.int64(128 * size) + rng.integers(-9000, 9000, 2), rim.shape)
    places = np.stack([middle, rim, np.roll(rim, -1, axis=0)], axis=1)
    count = len(rim)
    depth, normal = np.zeros((count, 3), np.int64), np.full((count, 3, 3), 1000)
    index = np.arange(count)
    return golden.Vertices(places[..., 0], places[..., 1], depth, normal, index, np.zeros_like(index))


def join(parts: list[golden.Vertices], order: np.ndarray | None = None) -> golden.Vertices:
    """Lists of triangles one behind the other, or in an order."""
    names = ("x", "y", "depth", "normal", "tag", "flat")
    whole = golden.Vertices(*(np.concatenate([getattr(part, name) for part in parts]) for name in names))
    return whole if order is None else golden.take(whole, order)


def edges(v: golden.Vertices, row: int) -> list[dict[str, int]]:
    """The three edges of a triangle by the names of ``edge_t``, the two from its top vertex first."""
    places = [(int(x), int(y)) for x, y in zip(v.x[row], v.y[row], strict=True)]
    positive = golden.twice_area(v)[row] > 0
    height = [y for _, y in places]
    top = next(i for i in range(3) if height[i] < height[i - 1] and height[i] <= height[(i + 1) % 3])
    made = []
    for a, b in ((top - 1, top), (top, (top + 1) % 3), ((top + 1) % 3, top - 1)):
        up = height[b] < height[a]
        (x, y), (x2, y2) = (places[b], places[a]) if up else (places[a], places[b])
        dx, dy = x2 - x, y2 - y
        line, column = int(golden.line_of(y)), int(golden.line_of(x))
        rest = -((x + 128 - 256 * column) * dy + (256 * line + 128 - y) * dx) >> k.SUBPIXEL_F
        shape = {"rest": rest, "dx": dx, "dy": dy, "column": column, "line": line}
        made.append(shape | {"lines": int(golden.line_of(y2)) - line, "right": int(up != positive)})
    return made
