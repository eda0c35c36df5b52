# SPDX-License-Identifier: Apache-2.0
"""Normals that a mesh lacks: which faces share one at a vertex, and what it is. Millions of faces, block by block."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import cos, radians

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.integer]

BLOCK = 1 << 17
"""Faces at a time: what is computed of them stays small beside the mesh."""

ROUND = 180.0
"""Degrees of an edge: none is hard."""

MIX = np.uint64(0x9E3779B97F4A7C15)
"""An odd number whose bits look random: 2**64 divided by the golden ratio."""

SHORT = 1e-12
"""Length of a sum of unit vectors below which they cancel each other."""


def blocks(count: int) -> Iterator[slice]:
    """The slices of so many rows."""
    return (slice(at, min(at + BLOCK, count)) for at in range(0, count, BLOCK))


def unit(vectors: Floats) -> Floats:
    """Vectors of unit length; one without length stays."""
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(length == 0, 1, length)


def face_normals(vertices: Floats, faces: Ints) -> Floats:
    """Unit normals (F, 3) of triangles that have an area."""
    made = np.empty((len(faces), 3))
    scale = np.abs(vertices).max() or 1  # so that no square overflows or vanishes
    for some in blocks(len(faces)):
        a, b, c = (vertices[faces[some, k]] / scale for k in range(3))
        made[some] = unit(np.cross(b - a, c - a))
    return made


@dataclass(frozen=True)
class Edges:
    """The edges of triangles: which two corners begin one edge, in two faces.

    Corner 3 f + k is the k-th of face f; the edge that begins there runs to the face's next corner.
    """

    first: Ints  # (P,)
    second: Ints  # (P,)
    mixed: int  # edges of two faces that run through them in the same direction
    closed: bool  # every edge has two faces, that run through it in opposite directions

    @classmethod
    def of(cls, faces: Ints, vertices: int) -> Edges:
        """Sort the edges by their ends; of an edge of many faces at most three others are told of each."""
        key = np.empty(faces.size, np.int64)
        for k in range(3):
            a, b = faces[:, k], faces[:, (k + 1) % 3]
            key[k::3] = np.minimum(a, b).astype(np.int64) * vertices + np.maximum(a, b)
        order = np.argsort(key).astype(np.int32 if key.size < 1 << 31 else np.int64)
        key = key[order]
        same = key[1:] == key[:-1]
        alone = np.append(True, ~same) & np.append(~same, True)
        twice = np.flatnonzero(same & ~np.append(False, same[:-1]) & ~np.append(same[1:], False))
        start = faces.reshape(-1)
        mixed = int((start[order[twice]] == start[order[twice + 1]]).sum())
        closed = not alone.any() and 2 * len(twice) == len(key) and mixed == 0
        first, second = [order[:-1][same]], [order[1:][same]]
        for shift in (2, 3):
            if 2 * len(twice) + alone.sum() < len(key):
                more = key[shift:] == key[:-shift]
                first, second = [*first, order[:-shift][more]], [*second, order[shift:][more]]
        return cls(np.concatenate(first), np.concatenate(second), mixed, closed)


def groups(vertices: Floats, faces: Ints, edges: Edges, crease: float) -> tuple[Ints, int]:
    """(3 F,): the group of each corner, and how many there are: corners of a group share their normal.

    They are the corners at a vertex that can be reached from one another across edges of `crease` degrees and less.
    """
    if crease >= ROUND:
        return faces.reshape(-1), len(vertices)
    if crease == 0:
        return np.repeat(np.arange(len(faces), dtype=faces.dtype), 3), len(faces)
    normal = face_normals(vertices, faces)
    least = cos(radians(crease)) - 1e-9  # an edge of exactly so many degrees is smooth
    soft = np.empty(len(edges.first), bool)
    for some in blocks(len(soft)):
        pair = normal[edges.first[some] // 3], normal[edges.second[some] // 3]
        soft[some] = np.einsum("pi,pi->p", *pair) >= least
    del normal
    corner = faces.reshape(-1)
    hard = np.zeros(len(vertices), bool)
    for side in (edges.first, edges.second):
        hard[corner[side[~soft]]] = True  # the other end is where the other face's edge begins, or where it ends
        hard[corner[_following(side[~soft])]] = True
    split = np.flatnonzero(hard[corner])  # only these corners can have a group other than their vertex
    if not len(split):
        return corner, len(vertices)

    first, second = edges.first[soft], edges.second[soft]
    opposed = corner[first] != corner[second]
    across = np.where(opposed, _following(second), second), np.where(opposed, second, _following(second))
    links = np.concatenate([np.stack([first, across[0]]), np.stack([_following(first), across[1]])], axis=1)
    links = links[:, hard[corner[links[0]]]]
    made = corner.astype(np.int64)
    made[split] = len(vertices) + _connected(np.searchsorted(split, links), len(split))
    used, made = np.unique(made, return_inverse=True)
    return made.reshape(-1), len(used)


def _following(corner: Ints) -> Ints:
    """The next corner of the same face."""
    return corner - corner % 3 + (corner + 1) % 3


def _connected(links: Ints, count: int) -> Ints:
    """(count,): the smallest index that each one is connected with, by links (2, L)."""
    label = np.arange(count)
    while True:
        least = np.minimum(label[links[0]], label[links[1]])
        new = label.copy()
        for side in links:
            np.minimum.at(new, side, least)
        new = new[new]
        if np.array_equal(new, label):
            return label
        label = new


def group_normals(vertices: Floats, faces: Ints, group: Ints, count: int) -> Floats:
    """Unit normals (count, 3) of groups of corners: the mean of their faces, weighted by the angle at the corner.

    Unlike a mean by area or by count it does not depend on how the surface is cut into triangles. Where the faces
    cancel each other the group takes the normal of one of them. Example: each corner of a cube, all of whose corners
    are one group, gets (1, 1, 1)/sqrt 3.
    """
    scale = np.abs(vertices).max() or 1
    total, some_face = np.zeros((count, 3)), np.zeros((count, 3))
    group = group.reshape(-1, 3)
    for some in blocks(len(faces)):
        points = [vertices[faces[some, k]] / scale for k in range(3)]
        sides = [unit(points[(k + 1) % 3] - points[k]) for k in range(3)]
        flat = unit(np.cross(points[1] - points[0], points[2] - points[0]))
        for k in range(3):
            a, b = sides[k], -sides[k - 1]
            angle = 2 * np.arctan2(np.linalg.norm(a - b, axis=1), np.linalg.norm(a + b, axis=1))
            np.add.at(total, group[some, k], flat * angle[:, None])
            some_face[group[some, k]] = flat
    cancelled = np.linalg.norm(total, axis=1) < SHORT
    total[cancelled] = some_face[cancelled]
    return unit(total)


def vertex_normals(vertices: Floats, faces: Ints) -> Floats:
    """Unit normals (V, 3) of a surface without hard edges."""
    return group_normals(vertices, faces, faces, len(vertices))


def joined(points: Floats) -> tuple[Floats, Ints]:
    """The different points (P, 3) in the order of their first appearance, and for each point (V,) which one it is."""
    bits = (points + 0.0).view(np.uint64)  # + 0.0: -0 and 0 are one place
    key = np.zeros(len(points), np.uint64)
    for column in bits.T:  # a mixing of 192 bits into 64
        key = (key ^ column) * MIX
        key ^= key >> np.uint64(29)
    order = np.argsort(key, kind="stable")
    new = np.append(True, np.diff(key[order]) != 0)
    place = np.empty(len(points), np.int64)
    place[order] = order[new][np.cumsum(new) - 1]  # the first point with the same key
    if not np.array_equal(points[place], points):  # two places with one key
        _, first, place = np.unique(points + 0.0, axis=0, return_index=True, return_inverse=True)
        place = first[place.reshape(-1)]
    first = place == np.arange(len(points))
    return points[first], (np.cumsum(first) - 1)[place]
