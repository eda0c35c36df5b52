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
    """Cut convex polygons into fans: triangles (sum of sizes - 2 F, 3).

    A fan starts at the polygon's first corner; a quad's at its second where that gives the shorter diagonal.
    """
    start = np.cumsum(sizes) - sizes
    pivot = np.zeros_like(start)
    quad = np.flatnonzero(sizes == 4)
    a, b, c, d = (vertices[corners[start[quad] + k]] for k in range(4))
    pivot[quad] = np.linalg.norm(a - c, axis=1) > np.linalg.norm(b - d, axis=1)
    face = np.repeat(np.arange(len(sizes)), sizes - 2)
    step = np.arange(len(face)) - (start - 2 * np.arange(len(sizes)))[face]

    def corner(k: Ints) -> Ints:
        return corners[start[face] + (pivot[face] + k) % sizes[face]]

    return np.stack([corner(np.zeros_like(step)), corner(step + 1), corner(step + 2)], axis=1).astype(np.int32)
