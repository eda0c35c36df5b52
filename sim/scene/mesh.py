# SPDX-License-Identifier: Apache-2.0
"""Meshes: where they come from, what is repaired, what is refused.

A mesh is an oriented surface of triangles, counter-clockwise seen from outside, because light falls on one side
only. What a file lacks is repaired where that is safe, and counted in `Mesh.repairs`; the rest is refused.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from polyshade.sim.errors import UserError
from polyshade.sim.scene.formats import read_surface
from polyshade.sim.scene.formats.surface import Surface
from polyshade.sim.scene.head import head_polygons
from polyshade.sim.scene.normals import ROUND, Edges, blocks, face_normals, group_normals, groups, joined
from polyshade.sim.scene.sphere import sphere
from polyshade.sim.scene.subdivide import catmull_clark, cut, triangulate

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

UP = ("y", "z")


@dataclass(frozen=True)
class Reading:
    """How to read a mesh. Raises UserError for a value out of range or unknown.

    ``crease``: compute all normals anew, smooth across edges of so many degrees and less; None: the file's normals, and
    where it has none what its format wants (glTF flat faces, others smooth up to 60 degrees).
    """

    subdivide: int = 0
    crease: float | None = None
    flip: bool = False
    two_sided: bool = False
    up: str = "y"

    def __post_init__(self) -> None:
        if not 0 <= self.subdivide <= MOST_SUBDIVISIONS:
            raise UserError(f"--subdivide: {self.subdivide} is out of range, allowed is 0 to {MOST_SUBDIVISIONS}")
        if self.crease is not None and not 0 <= self.crease <= ROUND:
            raise UserError(f"--crease: {self.crease} is out of range, allowed is 0 to {ROUND:g}")
        if self.up not in UP:
            raise UserError(f"--up: {self.up!r} is none of {', '.join(UP)}")


@dataclass(frozen=True)
class Mesh:
    """Triangles with a unit normal at each vertex; y up, the front towards +z, any unit, any place."""

    name: str
    vertices: Floats  # (V, 3)
    faces: NDArray[np.int32]  # (F, 3) counter-clockwise seen from outside
    normals: Floats  # (V, 3) unit length
    repairs: dict[str, int]  # what was repaired and how often; empty if nothing was
    hints: list[str] = field(default_factory=list)  # what the user may want to do about it


def load_mesh(spec: str, subdivide: int = 0, reading: Reading | None = None) -> Mesh:
    """The mesh that `spec` names: ``head``, ``sphere``, or the path of an OBJ, PLY, STL, OFF, glTF or GLB file.

    Each step of `subdivide` (0 to 4) is one of Catmull and Clark: the head grows from 9,012 triangles to 36,144, a
    file's triangle becomes 6, a quad 8, and 4 of each at a further step. The sphere has 320 triangles at 0, four times
    as many at each step, and is exact: its vertices and normals lie on the unit sphere.

    What is found in a file and mended or passed over, with the keys under which it is counted:

    ==================== ==============================================================================
    polygons             cuts that turned polygons into triangles (a quad takes one)
    dropped_faces        faces of fewer than three corners
    absent_normals       places without a normal, or with one that is not finite: computed
    zero_normals         normals without length: computed
    non_unit_normals     normals off unit length by more than `UNIT`: normalized
    welded_vertices      vertices at the place of another one, joined (only where normals are computed)
    zero_area_triangles  dropped
    unused_vertices      dropped
    mixed_winding        edges that two faces run through in the same direction; they stay
    inward_faces         all faces, of a closed surface that is inside out; they stay
    trailing_bytes       bytes behind the end of a binary file
    missing_end          a text STL file without its last line
    hidden_nodes         nodes of glTF whose matrix has no inverse
    empty_primitives     primitives of glTF without positions
    ==================== ==============================================================================

    Raises UserError, in one line with the file's name, for everything that cannot be a surface.
    """
    reading = reading or Reading(subdivide)
    if not spec:
        raise UserError("--mesh: is empty, allowed are head, sphere or the path of a mesh file")
    if spec == "head":
        mesh = _built("head", *_refine(*head_polygons(), reading.subdivide), reading)
    elif spec == "sphere":
        vertices, faces = sphere(2 + reading.subdivide)
        mesh = Mesh("sphere", vertices, faces, vertices, {}) if reading.crease is None else None
        mesh = mesh or _built("sphere", vertices, faces, reading)
    else:
        mesh = _file(Path(spec), reading)
    return _both_sides(mesh) if reading.two_sided else mesh


def _built(name: str, vertices: Floats, faces: Ints, reading: Reading) -> Mesh:
    """A mesh without normals of its own, each place a vertex."""
    crease = ROUND if reading.crease is None else reading.crease
    group, count = groups(vertices, faces, Edges.of(faces, len(vertices)), crease)
    return _mesh(name, vertices, faces, group, group_normals(vertices, faces, group, count), reading)


def _mesh(name: str, points: Floats, faces: Ints, normal_of: Ints, normals: Floats, reading: Reading) -> Mesh:
    """Number the vertices: a point with two normals is two of them. What no face uses is left out."""
    corner, normal_of = faces.reshape(-1), normal_of.reshape(-1)
    if np.array_equal(corner, normal_of):
        used, corner = _compact(corner, len(points))
        points, normals = (points, normals) if used is None else (points[used], normals[used])
    else:
        pair, corner = np.unique(corner.astype(np.int64) * len(normals) + normal_of, return_inverse=True)
        points, normals = points[pair // len(normals)], normals[pair % len(normals)]
    faces = corner.reshape(-1, 3).astype(np.int32, copy=False)
    if reading.flip:
        faces = np.ascontiguousarray(faces[:, ::-1])
        agree = sum(
            int(np.sign(np.einsum("fi,fi->f", face_normals(points, faces[some]), normals[faces[some, 0]])).sum())
            for some in blocks(len(faces))
        )
        normals = normals if agree >= 0 else -normals  # a file's normals may be right, and its faces turned
    return Mesh(name, points, faces, normals, {})


def _compact(corner: Ints, count: int) -> tuple[Ints | None, Ints]:
    """The vertices that are used, None if all are, and the corners by their numbers among these."""
    used = np.zeros(count, bool)
    used[corner] = True
    return (None, corner) if used.all() else (np.flatnonzero(used), (np.cumsum(used) - 1)[corner])


def _file(path: Path, reading: Reading) -> Mesh:
    surface = read_surface(path)
    steps = reading.subdivide
    grown = len(surface.corners) * 2 * 4 ** (steps - 1) if steps else int((surface.sizes - 2).sum())
    if grown > MOST_TRIANGLES:
        raise UserError(f"{path}: at --subdivide {steps} it has {grown} triangles, allowed are {MOST_TRIANGLES}")
    if max(surface.points.max(), -surface.points.min()) > LARGEST_COORDINATE:
        raise UserError(f"{path}: a coordinate exceeds {LARGEST_COORDINATE:g}")
    points, normals = surface.points, surface.normals
    if reading.up == "z":
        points, normals = (part if part is None else part[:, (0, 2, 1)] * (1, 1, -1) for part in (points, normals))
    places, place = joined(points)

    # Triangles, as corners of the file's polygons.
    slots = cut(points, surface.corners, surface.sizes)
    repairs = surface.repairs | {"polygons": int((surface.sizes - 3).sum())}
    flat = _flat(points, surface.corners[slots])
    if flat.all():
        raise UserError(f"{path}: none of its triangles has an area")
    repairs["zero_area_triangles"] = int(flat.sum())
    slots = slots[~flat].astype(np.int32)
    faces = surface.corners[slots].astype(np.int32, copy=False)
    edges = Edges.of(place[faces], len(places))
    repairs["mixed_winding"] = edges.mixed

    # Normals: the file's where it has them and they are not computed anew.
    if normals is None or steps or reading.crease is not None:
        normal_of = np.full(faces.shape, -1, np.int32)
    else:
        normal_of = faces if surface.normal_of is None else surface.normal_of[slots].astype(np.int32)
        normal_of, normals = _checked(normal_of, normals, place[faces], repairs)
    absent = normal_of < 0
    if absent.any():
        repairs["welded_vertices"] = len(points) - len(places)
        points, faces = places, place[faces].astype(np.int32)
    used = np.zeros(len(points), bool)
    used[faces] = True
    repairs["unused_vertices"] = int((~used).sum())
    if normals is None:
        repairs["absent_normals"] = int(used.sum())
    if steps:
        mesh = _subdivided(path, places, place, surface, reading)
    else:
        if absent.any():
            crease = surface.crease if reading.crease is None else reading.crease
            group, count = groups(points, faces, edges, crease)
            computed = group_normals(points, faces, group, count)
            if absent.all():
                normal_of, normals = group, computed
            else:
                normal_of = np.where(absent.reshape(-1), group + len(normals), normal_of.reshape(-1))
                normals = np.concatenate([normals, computed])
        mesh = _mesh(path.stem, points, faces, normal_of, normals, reading)
    inward = edges.closed and _volume(mesh) < 0
    repairs["inward_faces"] = len(mesh.faces) if inward else 0
    hints = [] if reading.two_sided else _hints(edges.mixed, inward)
    return replace(mesh, repairs={key: count for key, count in repairs.items() if count}, hints=hints)


def _checked(normal_of: Ints, normals: Floats, places: Ints, repairs: dict[str, int]) -> tuple[Ints, Floats]:
    """The file's normals, of unit length; those that are none are absent from now on. ``places``: of the corners."""
    used = np.zeros(len(normals), bool)
    used[normal_of[normal_of >= 0]] = True
    longest = np.abs(normals).max(axis=1, keepdims=True)
    finite = np.isfinite(longest)
    scaled = np.where(finite, normals, 0) / np.where(finite & (longest > 0), longest, 1)  # no square overflows
    length = np.linalg.norm(scaled, axis=1, keepdims=True)
    zero = used & finite[:, 0] & (length[:, 0] == 0)
    off = np.abs(length * np.where(finite, longest, 1) - 1)[:, 0] > UNIT
    repairs["zero_normals"] = int(zero.sum())
    repairs["non_unit_normals"] = int((used & finite[:, 0] & ~zero & off).sum())
    absent = (normal_of < 0) | ~finite[normal_of, 0]
    repairs["absent_normals"] = len(np.unique(places[absent]))
    good = finite[:, 0] & (length[:, 0] > 0)
    if not good.all():
        normal_of = np.where((normal_of >= 0) & good[normal_of], normal_of, -1)
    return normal_of, scaled / np.where(length == 0, 1, length)


def _subdivided(path: Path, places: Floats, place: Ints, surface: Surface, reading: Reading) -> Mesh:
    """Catmull and Clark's surface of the file's polygons, quads as quads."""
    corners, sizes = place[surface.corners], surface.sizes
    face = np.repeat(np.arange(len(sizes)), sizes)
    last = np.cumsum(sizes) - 1
    following = np.roll(corners, -1)
    following[last] = corners[last - sizes + 1]
    kept = corners != following  # one corner at a place
    corners, face = corners[kept], face[kept]
    sizes = np.bincount(face, minlength=len(sizes))
    area = _areas(places, corners, sizes)
    kept = (sizes > 2) & (area > 0)
    corners, sizes = corners[kept[face]], sizes[kept]
    used, corners = np.unique(corners, return_inverse=True)
    vertices, faces = _refine(places[used], corners, sizes, reading.subdivide)
    return _built(path.stem, vertices, faces[~_flat(vertices, faces)], reading)


def _areas(points: Floats, corners: Ints, sizes: Ints) -> Floats:
    """(F,) areas of polygons, those below `FLAT` of the square of their size as 0."""
    face = np.repeat(np.arange(len(sizes)), sizes)
    start = np.cumsum(sizes) - sizes
    scale = np.abs(points).max() or 1
    vectors = (points[corners] - points[corners[start[face]]]) / scale
    following = np.roll(vectors, -1, axis=0)  # behind the last corner stands another face's first: its vector is 0
    total = np.stack([np.bincount(face, part, len(sizes)) for part in np.cross(vectors, following).T], axis=1)
    size = np.zeros(len(sizes))
    np.maximum.at(size, face, (vectors**2).sum(axis=1))
    area = np.linalg.norm(total, axis=1)
    return np.where(area <= FLAT * size, 0, area)


def _hints(mixed: int, inward: bool) -> list[str]:
    """What to do about the winding of the faces."""
    if mixed:
        return [f"{mixed} edges join faces of opposite winding, parts may be missing: --two-sided shows them"]
    if inward:
        return ["all faces are turned inwards: --flip turns them, --two-sided shows both sides"]
    return []


def _volume(mesh: Mesh) -> float:
    """Of a closed surface; negative if its faces are clockwise seen from outside. In units of its size."""
    centre = mesh.vertices.mean(axis=0)
    scale = np.abs(mesh.vertices - centre).max() or 1
    total = 0.0
    for some in blocks(len(mesh.faces)):
        a, b, c = ((mesh.vertices[mesh.faces[some, k]] - centre) / scale for k in range(3))
        total += np.einsum("fi,fi->", a, np.cross(b, c))
    return total / 6


def _both_sides(mesh: Mesh) -> Mesh:
    """Every triangle a second time with its back to the front, whose normals point the other way."""
    back = mesh.faces[:, ::-1] + np.int32(len(mesh.vertices))
    return replace(
        mesh,
        vertices=np.concatenate([mesh.vertices, mesh.vertices]),
        faces=np.concatenate([mesh.faces, back]),
        normals=np.concatenate([mesh.normals, -mesh.normals]),
    )


def _flat(vertices: Floats, faces: Ints) -> NDArray[np.bool_]:
    """(F,) whether a triangle has no area, judged by its own size."""
    scale = np.abs(vertices).max() or 1
    made = np.empty(len(faces), bool)
    for some in blocks(len(faces)):
        a, b, c = (vertices[faces[some, k]] / scale for k in range(3))
        longest = np.maximum.reduce([((q - p) ** 2).sum(axis=1) for p, q in ((a, b), (b, c), (c, a))])
        made[some] = np.linalg.norm(np.cross(b - a, c - a), axis=1) <= FLAT * longest
    return made


def _refine(vertices: Floats, corners: Ints, sizes: Ints, steps: int) -> tuple[Floats, NDArray[np.int32]]:
    for _ in range(steps):
        vertices, quads = catmull_clark(vertices, corners, sizes)
        corners, sizes = quads.reshape(-1), np.full(len(quads), 4)
    return vertices, triangulate(vertices, corners, sizes)
