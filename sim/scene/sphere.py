# SPDX-License-Identifier: Apache-2.0
"""The unit sphere as a subdivided icosahedron."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from numpy.typing import NDArray


def sphere(steps: int) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Vertices on the unit sphere and counter-clockwise faces: an icosahedron whose triangles are cut into four."""
    golden = (1 + 5**0.5) / 2
    corners = [(a, b * golden, 0.0) for a in (-1, 1) for b in (-1, 1)]
    corners = np.array([np.roll(corner, k) for k in range(3) for corner in corners])
    near = np.linalg.norm(corners[:, None] - corners, axis=2) < 2.1  # an edge is 2 long, a diagonal twice golden
    faces = np.array([t for t in combinations(range(12), 3) if all(near[a, b] for a, b in combinations(t, 2))])
    inward = np.linalg.det(corners[faces]) < 0
    faces[inward] = faces[inward, ::-1]
    vertices = corners / np.linalg.norm(corners, axis=1, keepdims=True)
    for _ in range(steps):
        vertices, faces = _quarter(vertices, faces)
        vertices /= np.linalg.norm(vertices, axis=1, keepdims=True)
    return vertices, faces.astype(np.int32)


def _quarter(vertices: NDArray[np.float64], faces: NDArray) -> tuple[NDArray[np.float64], NDArray]:
    """Each triangle cut into four at the middles of its edges."""
    edges = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    ends, edge = np.unique(edges, axis=0, return_inverse=True)
    a, b, c = faces.T
    ab, bc, ca = edge.reshape(-1, 3).T + len(vertices)
    parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.concatenate([vertices, vertices[ends].mean(axis=1)]), np.concatenate([np.stack(p, axis=1) for p in parts])
