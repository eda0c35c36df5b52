# SPDX-License-Identifier: Apache-2.0
"""Catmull-Clark subdivision and triangulation of polygon meshes, vectorized over faces of any number of corners."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.integer]


def catmull_clark(vertices: Floats, corners: Ints, sizes: Ints) -> tuple[Floats, Ints]:
    """One Catmull-Clark step (Catmull and Clark, 1978) of an oriented polygon mesh.

    vertices (V, 3); corners: the vertex indices of all faces, end to end; sizes (F,): corners of each face.
    Returns vertices (V + E + F, 3) and quads (sum of sizes, 4), oriented as before. The new points are

        face    Q = mean of its corners
        edge    (a + b + Q1 + Q2) / 4
        vertex  (mean of Q + 2 * mean of edge midpoints + (n - 3) * P) / n,   n faces around it

    The rim of an open mesh becomes the cubic B-spline of its own points: edge (a + b) / 2, vertex
    (a + 6 P + b) / 8. An edge of three or more faces is a rim too; a vertex with other than two rim edges stays.
    Example: a cube (8 vertices, 6 quads) becomes 26 vertices, 24 quads; its corner (1, 1, 1) moves to (5, 5, 5) / 9.
    """
    count = len(vertices)
    face = np.repeat(np.arange(len(sizes)), sizes)
    start = np.cumsum(sizes) - sizes
    slot = np.arange(len(corners))
    following = np.where(slot + 1 == (start + sizes)[face], start[face], slot + 1)
    preceding = np.empty_like(following)
    preceding[following] = slot

    def gather(values: Floats, into: Ints, length: int) -> Floats:
        return np.stack([np.bincount(into, column, length) for column in values.T], axis=1)

    face_points = gather(vertices[corners], face, len(sizes)) / sizes[:, None]

    ends = np.sort(np.stack([corners, corners[following]], axis=1), axis=1)
    key, edge, uses = np.unique(ends[:, 0] * np.int64(count) + ends[:, 1], return_inverse=True, return_counts=True)
    a, b = np.divmod(key, count)
    middle = (vertices[a] + vertices[b]) / 2
    rim = uses != 2
    edge_points = (middle + gather(face_points[face], edge, len(key)) / 2) / 2
    edge_points[rim] = middle[rim]

    valence = np.maximum(np.bincount(corners, minlength=count), 1)[:, None]
    around = gather(face_points[face], corners, count) / valence
    both, twice = np.concatenate([a, b]), np.concatenate([middle, middle])
    spokes = gather(twice, both, count) / np.maximum(np.bincount(both, minlength=count), 1)[:, None]
    points = (around + 2 * spokes + (valence - 3) * vertices) / valence
    on_rim = np.concatenate([rim, rim])
    rims = np.bincount(both[on_rim], minlength=count)
    curve = (gather(twice[on_rim], both[on_rim], count) + 2 * vertices) / 4
    points = np.where((rims == 0)[:, None], points, np.where((rims == 2)[:, None], curve, vertices))

    edge = edge.reshape(-1)
    quads = np.stack([corners, count + edge, count + len(key) + face, count + edge[preceding]], axis=1)
    return np.concatenate([points, edge_points, face_points]), quads


def triangulate(vertices: Floats, corners: Ints, sizes: Ints) -> NDArray[np.int32]:
    """Cut polygons into triangles (sum of sizes - 2 F, 3), as vertices; see `cut`."""
    return corners[cut(vertices, corners, sizes)].astype(np.int32)


def cut(vertices: Floats, corners: Ints, sizes: Ints) -> Ints:
    """Cut polygons into triangles: (sum of sizes - 2 F, 3) places in ``corners``, in the order of the faces.

    A convex polygon becomes a fan from its first corner. A quad is cut along the diagonal that lies inside, of two the
    shorter one. Any other polygon with a corner that is not convex loses one ear after the other.
    """
    start = np.cumsum(sizes) - sizes
    if (sizes == 3).all():
        return np.arange(len(corners)).reshape(-1, 3)
    pivot = np.zeros_like(start)
    quad = np.flatnonzero(sizes == 4)
    pivot[quad] = _inner_diagonal(*(vertices[corners[start[quad] + k]] for k in range(4)))
    face = np.repeat(np.arange(len(sizes)), sizes - 2)
    first = start - 2 * np.arange(len(sizes))  # of a face's triangles
    step = np.arange(len(face)) - first[face]

    def corner(k: Ints) -> Ints:
        return start[face] + (pivot[face] + k) % sizes[face]

    made = np.stack([corner(np.zeros_like(step)), corner(step + 1), corner(step + 2)], axis=1)
    for large in np.flatnonzero(sizes > 4):
        at, size = start[large], sizes[large]
        ears = _ears(vertices[corners[at : at + size]])
        if ears is not None:
            made[first[large] : first[large] + size - 2] = at + ears
    return made


def _inner_diagonal(a: Floats, b: Floats, c: Floats, d: Floats) -> NDArray[np.bool_]:
    """(Q,) of quads: False to cut from a to c, True from b to d."""
    normal = np.cross(c - a, d - b)

    def turned(p: Floats, q: Floats, r: Floats) -> NDArray[np.bool_]:
        return np.einsum("qi,qi->q", np.cross(q - p, r - p), normal) < 0

    first, second = turned(a, b, c) | turned(a, c, d), turned(b, c, d) | turned(b, d, a)
    shorter = np.linalg.norm(a - c, axis=1) > np.linalg.norm(b - d, axis=1)
    return np.where(first == second, shorter, first)


def _ears(points: Floats) -> Ints | None:
    """The triangles (N - 2, 3) of one polygon (N, 3), ear by ear; None if all of its corners are convex.

    It is looked at along its normal. Where nothing is an ear, in a polygon that crosses itself, any corner goes.
    """
    points = points - points[0]
    normal = np.cross(points, np.roll(points, -1, axis=0)).sum(axis=0)
    axis = int(np.abs(normal).argmax())
    flat = np.delete(points, axis, axis=1) * (1, (-1 if axis == 1 else 1) * np.copysign(1, normal[axis]))
    flat = flat / (np.abs(flat).max() or 1)

    def area(p: Floats, q: Floats, r: Floats) -> Floats:
        return (q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1]) - (q[..., 1] - p[..., 1]) * (r[..., 0] - p[..., 0])

    if (area(np.roll(flat, 1, axis=0), flat, np.roll(flat, -1, axis=0)) > 0).all():
        return None
    left, made, at, tried = list(range(len(flat))), [], 0, 0
    while len(left) > 3:
        at %= len(left)
        before, here, after = left[at - 1], left[at], left[(at + 1) % len(left)]
        p, q, r = flat[before], flat[here], flat[after]
        if tried < len(left):
            others = flat[[k for k in left if k not in (before, here, after)]]
            inside = (area(p, q, others) >= 0) & (area(q, r, others) >= 0) & (area(r, p, others) >= 0)
            inside &= ~((others == p) | (others == r)).all(axis=1)  # a slit's two sides share their corners
            if area(p, q, r) <= 0 or inside.any():
                at, tried = at + 1, tried + 1
                continue
        made.append((before, here, after))
        del left[at]
        tried = 0
    return np.array([*made, left])
