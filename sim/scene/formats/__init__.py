# SPDX-License-Identifier: Apache-2.0
"""Mesh files: one reader a format, from bytes to points, polygons and normals, and what all of them must satisfy."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from polyshade.sim.errors import UserError
from polyshade.sim.scene.formats import gltf, obj, off, ply, stl
from polyshade.sim.scene.formats.surface import Damage, Surface

_READERS: dict[str, Callable[[bytes, Path], Surface]] = {
    "obj": lambda data, path: obj.read(data),
    "ply": lambda data, path: ply.read(data),
    "stl": lambda data, path: stl.read(data),
    "off": lambda data, path: off.read(data),
    "gltf": gltf.read,
    "glb": gltf.read,
}

LARGEST_FILE = 1 << 30
"""Bytes; a larger file is refused before it is read."""


def read_surface(path: Path) -> Surface:
    """Read an OBJ, PLY, STL, OFF, glTF or GLB file; the parts of a glTF scene are placed and joined.

    Every point is finite, every corner names a point, every face has at least three corners, and there is a face.
    Raises UserError, naming file and cause, when the file is missing, unreadable, damaged or holds no surface.
    """
    try:
        suffix = path.suffix.lower().removeprefix(".")
        data = _content(path, suffix)
        with np.errstate(all="ignore"):  # what is not finite is found afterwards
            surface = _READERS[suffix](data, path)
        _accept(surface)
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
    if suffix not in _READERS:
        raise Damage(f"unknown kind of mesh file, known are {', '.join('.' + known for known in _READERS)}")
    if not 0 < size <= LARGEST_FILE:
        raise Damage(f"has {size} bytes, allowed are 1 to {LARGEST_FILE}" if size else "is empty")
    return path.read_bytes()


def _accept(surface: Surface) -> None:
    """What must hold for every format."""
    if not len(surface.sizes):
        raise Damage("has no faces")
    if surface.corners.min() < 0 or surface.corners.max() >= len(surface.points):
        raise Damage(f"a face names a vertex outside of 0 to {len(surface.points) - 1}")
    finite = np.isfinite(surface.points).all(axis=1)
    if not finite.all():
        raise Damage(f"vertex {np.argmin(finite)} has a coordinate that is not finite")
