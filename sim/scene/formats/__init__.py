"""Mesh files. trimesh reads them; this package makes sure that what comes out is what the file says.

trimesh is lenient: it fills gaps, stops at the first number it cannot read, lets faces fall away. So each format has
a check that goes over the raw file first, refuses what is damaged and tells the cause, and counts the triangles
that must come out.
"""

from __future__ import annotations

import io
import logging
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np
import trimesh
from numpy.typing import NDArray
from polyshade.sim.errors import UserError
from polyshade.sim.scene.formats import gltf, obj, off, ply, stl
from polyshade.sim.scene.formats.common import Checked, Damage

logging.getLogger("trimesh").addHandler(logging.NullHandler())  # it would print tracebacks of what it survives

_CHECKS: dict[str, Callable[[bytes, Path], Checked]] = {
    "obj": obj.check,
    "ply": ply.check,
    "stl": stl.check,
    "off": off.check,
    "gltf": gltf.check,
    "glb": gltf.check_binary,
}

LARGEST_FILE = 1 << 30
"""Bytes; a larger file is refused before it is read."""


class _Beside(trimesh.resolvers.FilePathResolver):
    """Finds the files that a glTF file refers to by percent-encoded names, in its own folder or below."""

    def get(self, name: str) -> bytes:
        return super().get(unquote(name))


@dataclass(frozen=True)
class Surface:
    """A mesh file's triangles, in the file's own units and axes."""

    vertices: NDArray[np.float64]  # (V, 3), finite
    faces: NDArray[np.int64]  # (F, 3), at least one, every index in range
    normals: NDArray[np.float64] | None  # (V, 3) as the file has them, any length; None if a part has none
    cuts: int  # that turned polygons into triangles: a quad takes one


def read_surface(path: Path) -> Surface:
    """Read an OBJ, PLY, STL, OFF, glTF or GLB file; the parts of a glTF scene are placed and joined.

    Raises UserError, naming file and cause, when the file is missing, unreadable, damaged or holds no surface.
    """
    suffix = path.suffix.lower().removeprefix(".")
    try:
        data = _content(path, suffix)
        checked = _CHECKS[suffix](data, path)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            surface = _read(checked, suffix, path)
        _accept(surface, checked)
    except Damage as damage:
        raise UserError(f"{path}: {damage}") from None
    except OSError as error:
        raise UserError(f"{path}: cannot be read, {error.strerror or error}") from None
    except Exception as error:  # whatever a damaged tree or a name like "\0" may lead to
        raise UserError(f"{path}: damaged, or no mesh file ({type(error).__name__}: {error})") from None
    return surface


def _content(path: Path, suffix: str) -> bytes:
    if path.is_dir():
        raise Damage("is a directory, not a mesh file")
    size = path.stat().st_size
    if not path.is_file():
        raise Damage("is not a regular file")
    if suffix not in _CHECKS:
        raise Damage(f"unknown kind of mesh file, known are {', '.join('.' + known for known in _CHECKS)}")
    if not 0 < size <= LARGEST_FILE:
        raise Damage(f"has {size} bytes, allowed are 1 to {LARGEST_FILE}" if size else "is empty")
    return path.read_bytes()


def _read(checked: Checked, suffix: str, path: Path) -> Surface:
    """Let trimesh read the file, then place and join the parts of its scene."""
    options: dict[str, Any] = {"process": False}
    if suffix in ("gltf", "glb"):
        options |= {"skip_materials": True, "resolver": _Beside(str(path))}
    if suffix == "ply":
        options |= {"skip_materials": True, "fix_texture": False}  # vertices stay whole along the seams of a texture
    scene = trimesh.load_scene(io.BytesIO(checked.data), file_type=suffix, **options)

    vertices, faces, normals, count = [], [], [], 0
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        part, turn = scene.geometry[name], transform[:3, :3]
        if not isinstance(part, trimesh.Trimesh):
            continue  # points and lines
        mirrored = np.linalg.det(turn) < 0
        vertices.append(part.vertices @ turn.T + transform[:3, 3])
        faces.append(part.faces[:, :: -1 if mirrored else 1] + count)
        count += len(part.vertices)
        if "vertex_normals" in part._cache:  # the file's own; the property alone would compute them
            length = np.linalg.norm(part.vertex_normals, axis=1, keepdims=True)
            turned = part.vertex_normals @ np.linalg.inv(turn)
            now = np.linalg.norm(turned, axis=1, keepdims=True)
            normals.append(turned * length / np.where(now == 0, 1, now))
    if not faces:
        raise Damage("has no faces")
    return Surface(
        vertices=np.concatenate(vertices).astype(np.float64),
        faces=np.concatenate(faces).astype(np.int64),
        normals=np.concatenate(normals).astype(np.float64) if len(normals) == len(faces) else None,
        cuts=checked.cuts,
    )


def _accept(surface: Surface, checked: Checked) -> None:
    """What must hold for every format."""
    if len(surface.faces) != checked.triangles:
        raise Damage(f"damaged, {len(surface.faces)} of its {checked.triangles} triangles can be read")
    if surface.faces.min() < 0 or surface.faces.max() >= len(surface.vertices):
        raise Damage(f"a face names a vertex outside of 0 to {len(surface.vertices) - 1}")
    for what, values in (("vertex", surface.vertices), ("normal", surface.normals)):
        if values is not None and not np.isfinite(values).all():
            row = int(np.argmin(np.isfinite(values).all(axis=1)))
            raise Damage(f"{what} {row} has a coordinate that is not finite")
