"""Meshes: where they come from, what is repaired, what is refused.

A mesh is an oriented surface of triangles, counter-clockwise seen from outside, because light falls on one side
only. What a file lacks is repaired where that is safe, and counted in `Mesh.repairs`; the rest is refused.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray
from polyshade.sim.errors import UserError
from polyshade.sim.scene.formats import read_surface
from polyshade.sim.scene.head import head_polygons
from polyshade.sim.scene.subdivide import catmull_clark, triangulate

Floats = NDArray[np.float64]
Ints = NDArray[np.integer]

MOST_SUBDIVISIONS = 4
MOST_TRIANGLES = 4_000_000
LARGEST_COORDINATE = 1e30
"""Beyond it, areas of areas could overflow a float64."""

FLAT = 1e-12
"""A triangle without area: its height is below this part of its longest edge."""

UNIT = 1e-3
"""A normal may be off unit length by as much without being counted as a repair."""


@dataclass(frozen=True)
class Mesh:
    """Triangles with a unit normal at each vertex; y up, the front towards +z, any unit, any place."""

    name: str
    vertices: Floats  # (V, 3)
    faces: NDArray[np.int32]  # (F, 3) counter-clockwise seen from outside
    normals: Floats  # (V, 3) unit length
    repairs: dict[str, int]  # what was repaired and how often; empty if nothing was


def load_mesh(spec: str, subdivide: int = 0) -> Mesh:
    """The mesh that `spec` names: ``head``, ``sphere``, or the path of an OBJ, PLY, STL, OFF, glTF or GLB file.

    Each step of `subdivide` (0 to 4) is one of Catmull and Clark: the head grows from 9,012 triangles to 36,144, a
    file's triangle becomes 6 and then 4 at each further step. The sphere has 320 triangles at 0, four times as many
    at each step, and is exact: its vertices and normals lie on the unit sphere.

    Repairs of a file, with the keys under which they are counted:

    ==================== ==============================================================================
    polygons             cuts that turned polygons into triangles (a quad takes one)
    absent_normals       vertices without a normal: the angle-weighted mean of the faces around it
    zero_normals         vertices whose normal has no length: the same
    non_unit_normals     normals off unit length by more than `UNIT`: normalized
    welded_vertices      vertices at the place of another one, joined (only where the file has no normals)
    zero_area_triangles  dropped
    unused_vertices      dropped
    ==================== ==============================================================================

    Raises UserError, in one line with the file's name, for everything that cannot be a surface.
    """
    if not 0 <= subdivide <= MOST_SUBDIVISIONS:
        raise UserError(f"--subdivide: {subdivide} is out of range, allowed is 0 to {MOST_SUBDIVISIONS}")
    if not spec:
        raise UserError("--mesh: is empty, allowed are head, sphere or the path of a mesh file")
    if spec == "head":
        return _head(subdivide)
    if spec == "sphere":
        return _sphere(subdivide)
    return _file(Path(spec), subdivide)


def _head(subdivide: int) -> Mesh:
    vertices, corners, sizes = head_polygons()
    vertices, faces = _refine(vertices, corners, sizes, subdivide)
    return Mesh("head", vertices, faces, vertex_normals(vertices, faces), {})


def _sphere(subdivide: int) -> Mesh:
    ball = trimesh.creation.icosphere(subdivisions=2 + subdivide)
    normals = ball.vertices / np.linalg.norm(ball.vertices, axis=1, keepdims=True)
    return Mesh("sphere", normals, ball.faces.astype(np.int32), normals, {})


def _file(path: Path, subdivide: int) -> Mesh:
    surface = read_surface(path)
    if len(surface.faces) * (1 if subdivide == 0 else 6 * 4 ** (subdivide - 1)) > MOST_TRIANGLES:
        raise UserError(f"{path}: at --subdivide {subdivide} it has more than {MOST_TRIANGLES} triangles")
    if np.abs(surface.vertices).max() > LARGEST_COORDINATE:
        raise UserError(f"{path}: a coordinate exceeds {LARGEST_COORDINATE:g}")
    vertices, faces, repairs = surface.vertices, surface.faces, {"polygons": surface.cuts}
    normals = None if subdivide else surface.normals  # a subdivided surface has normals of its own

    if normals is None:
        vertices, faces, repairs["welded_vertices"] = _weld(vertices, faces)
    flat = _flat(vertices, faces)
    if flat.all():
        raise UserError(f"{path}: none of its triangles has an area")
    repairs["zero_area_triangles"] = int(flat.sum())
    used, faces = np.unique(faces[~flat], return_inverse=True)
    repairs["unused_vertices"] = len(vertices) - len(used)
    if surface.normals is None:
        repairs["absent_normals"] = len(used)
    vertices, faces = vertices[used], faces.reshape(-1, 3).astype(np.int32)
    if subdivide:
        vertices, faces = _refine(vertices, faces.reshape(-1), np.full(len(faces), 3), subdivide)
        faces = faces[~_flat(vertices, faces)]
    unit = vertex_normals(vertices, faces)
    if normals is not None:
        length = np.linalg.norm(normals[used], axis=1, keepdims=True)
        repairs["zero_normals"] = int((length == 0).sum())
        repairs["non_unit_normals"] = int(((length > 0) & (np.abs(length - 1) > UNIT)).sum())
        unit = np.where(length == 0, unit, _unit(normals[used]))
    return Mesh(path.stem, vertices, faces, unit, {key: count for key, count in repairs.items() if count})


def vertex_normals(vertices: Floats, faces: Ints) -> Floats:
    """Unit normals (V, 3): the mean of the faces around a vertex, weighted by the angle each takes there.

    Unlike a mean by area or by count it does not depend on how the surface is cut into triangles. Where the faces
    cancel each other the vertex takes the normal of one of them. Example: each corner of a cube gets (1, 1, 1)/sqrt 3.
    """
    points = (vertices / np.abs(vertices).max())[faces]  # so that no square overflows or vanishes
    flat = _unit(np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]))
    total = np.zeros_like(vertices)
    for corner in range(3):
        a = _unit(points[:, (corner + 1) % 3] - points[:, corner])
        b = _unit(points[:, (corner + 2) % 3] - points[:, corner])
        angle = 2 * np.arctan2(np.linalg.norm(a - b, axis=1), np.linalg.norm(a + b, axis=1))
        for axis in range(3):
            total[:, axis] += np.bincount(faces[:, corner], flat[:, axis] * angle, len(vertices))
    cancelled = np.linalg.norm(total, axis=1) < FLAT
    some = np.zeros_like(vertices)
    some[faces] = flat[:, None]
    return _unit(np.where(cancelled[:, None], some, total))


def _unit(vectors: Floats) -> Floats:
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(length == 0, 1, length)


def _flat(vertices: Floats, faces: Ints) -> NDArray[np.bool_]:
    """(F,) whether a triangle has no area, judged by its own size."""
    a, b, c = (vertices / (np.abs(vertices).max() or 1))[faces].transpose(1, 0, 2)
    longest = np.maximum.reduce([((q - p) ** 2).sum(axis=1) for p, q in ((a, b), (b, c), (c, a))])
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) <= FLAT * longest


def _weld(vertices: Floats, faces: Ints) -> tuple[Floats, Ints, int]:
    """Join vertices at exactly the same place; also returns how many went."""
    places, place = np.unique(vertices + 0.0, axis=0, return_inverse=True)  # + 0.0: -0 and 0 are one place
    return places, place.reshape(-1)[faces], len(vertices) - len(places)


def _refine(vertices: Floats, corners: Ints, sizes: Ints, steps: int) -> tuple[Floats, NDArray[np.int32]]:
    for _ in range(steps):
        vertices, quads = catmull_clark(vertices, corners, sizes)
        corners, sizes = quads.reshape(-1), np.full(len(quads), 4)
    return vertices, triangulate(vertices, corners, sizes)
