"""OBJ: text lines, ``v`` and ``vn`` for points and normals, ``f`` for faces of any number of corners."""

from __future__ import annotations

import re
from pathlib import Path

from polyshade.sim.scene.formats.common import Checked, Damage, decode, numbers

_Corner = tuple[int, int]
"""Indices of a point and of a normal, counted from 1; the normal's is 0 when there is none."""


def check(data: bytes, path: Path) -> Checked:
    """Rewrite the file's geometry: triangles with absolute indices, and normals only if every corner has one.

    The reader takes a relative index from the end of the file, but it counts from the face that has it; it takes
    index 0 for 1, and it wants all faces alike. Lines of other kinds (groups, materials, curves) are left out.
    """
    points: dict[str, list[str]] = {"v": [], "vn": []}
    faces: list[list[_Corner]] = []
    lines = decode(data).replace("\\\n", " ").split("\n")
    for number, line in enumerate(lines, 1):
        kind, *words = line.partition("#")[0].split() or [""]
        where = f"line {number}"
        if kind in points:
            if len(words) < 3:
                raise Damage(f"{where}: {kind} needs three numbers")
            points[kind].append(" ".join(map(repr, numbers(words[:3], where))))
        elif kind == "f":
            if len(words) < 3:
                raise Damage(f"{where}: a face needs three corners")
            faces.append([_corner(word, len(points["v"]), len(points["vn"]), where) for word in words])
    if not faces:
        raise Damage("has no faces")
    for kind, indices in zip(points, zip(*(corner for face in faces for corner in face), strict=True), strict=True):
        if max(indices) > len(points[kind]):
            raise Damage(f"a face names {kind} {max(indices)}, the file has {len(points[kind])}")

    with_normals = all(normal for face in faces for _, normal in face)
    triangles = [(f[0], f[i], f[i + 1]) for f in faces for i in range(1, len(f) - 1)]
    rows = [f"v {point}" for point in points["v"]]
    if with_normals:
        rows += [f"vn {normal}" for normal in points["vn"]]
        rows += ["f {}//{} {}//{} {}//{}".format(*a, *b, *c) for a, b, c in triangles]
    else:
        rows += [f"f {a[0]} {b[0]} {c[0]}" for a, b, c in triangles]
    return Checked(len(triangles), len(triangles) - len(faces), "\n".join([*rows, ""]).encode())


def _corner(word: str, points: int, normals: int, where: str) -> _Corner:
    """Read ``point``, ``point/texture``, ``point//normal`` or ``point/texture/normal``.

    `points` and `normals` have been defined so far. Example: with 8 points ``-1//3`` is (8, 3).
    """
    parts = re.fullmatch(r"([+-]?\d+)(?:/(?:[+-]?\d+)?(?:/([+-]?\d+)?)?)?", word)
    if not parts:
        raise Damage(f"{where}: {word!r} is no corner of a face")
    point, normal = parts.groups()
    return _absolute(int(point), points, where), _absolute(int(normal), normals, where) if normal else 0


def _absolute(index: int, defined: int, where: str) -> int:
    absolute = index if index > 0 else defined + 1 + index
    if index == 0 or absolute < 1:
        raise Damage(f"{where}: index {index} is none, they count from 1, and back from -1 to -{defined}")
    return absolute
