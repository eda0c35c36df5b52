# SPDX-License-Identifier: Apache-2.0
"""Fewer triangles: edges collapse onto one of their ends, the least error of a quadric first (Garland, Heckbert)."""

from __future__ import annotations

import heapq

import numpy as np
from numpy.typing import NDArray


def decimate(vertices: NDArray[np.float64], faces: NDArray[np.integer], most: int) -> NDArray[np.int64]:
    """Faces of at most so many of the vertices, which stay where they are with all that belongs to them.

    An end is kept, so that no new normal is needed. A rim is held by planes across its edges. A collapse that turns a
    face over, or that would make an edge of three faces, is left out.
    """
    face = {i: tuple(corner) for i, corner in enumerate(np.asarray(faces).tolist())}
    around: list[set[int]] = [set() for _ in vertices]
    quadric = np.zeros((len(vertices), 4, 4))
    for i, corner in face.items():
        a, b, c = vertices[list(corner)]
        normal = np.cross(b - a, c - a)
        plane = np.append(normal, -normal @ a) / max(float(np.linalg.norm(normal)), 1e-30) ** 0.5
        for v in corner:
            around[v].add(i)
            quadric[v] += np.outer(plane, plane)
    for corner in face.values():
        a, b, c = vertices[list(corner)]
        for v, u in zip(corner, corner[1:] + corner[:1], strict=True):
            p, q = vertices[v], vertices[u]
            if len(around[v] & around[u]) == 1:
                across = np.cross(q - p, np.cross(b - a, c - a))
                across *= 3 * np.linalg.norm(q - p) / max(float(np.linalg.norm(across)), 1e-30)
                plane = np.append(across, -across @ p)
                quadric[v] += np.outer(plane, plane)
                quadric[u] += np.outer(plane, plane)
    place = np.column_stack([vertices, np.ones(len(vertices))])

    def near(v: int) -> set[int]:
        return {u for i in around[v] for u in face[i]} - {v}

    def cost(v: int, u: int) -> tuple[float, int, int]:
        """Of v's collapse onto u."""
        return float(place[u] @ (quadric[v] + quadric[u]) @ place[u]), v, u

    heap = [cost(v, u) for v in range(len(vertices)) for u in near(v)]
    heapq.heapify(heap)
    left = sum(bool(s) for s in around)
    while left > most and heap:
        error, v, u = heapq.heappop(heap)
        if u not in near(v) or not around[u] or cost(v, u)[0] != error:
            continue
        gone = around[v] & around[u]
        if len(near(v) & near(u)) != len(gone) or any(_turns(vertices, face[i], v, u) for i in around[v] - gone):
            continue
        for i in gone:
            for w in face[i]:
                around[w].discard(i)
            del face[i]
        for i in around[v]:
            face[i] = tuple(u if w == v else w for w in face[i])
            around[u].add(i)
        around[v] = set()
        quadric[u] += quadric[v]
        left -= 1
        for w in near(u):
            heapq.heappush(heap, cost(u, w))
            heapq.heappush(heap, cost(w, u))
    return np.array(list(face.values()), np.int64)


def _turns(vertices: NDArray[np.float64], corner: tuple[int, ...], v: int, u: int) -> bool:
    """Would the face look elsewhere with u in place of v?"""
    a, b, c = vertices[list(corner)]
    p, q, r = vertices[[u if w == v else w for w in corner]]
    before, after = np.cross(b - a, c - a), np.cross(q - p, r - p)
    return bool(before @ after <= 0.2 * np.linalg.norm(before) * np.linalg.norm(after))
