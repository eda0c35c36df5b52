# SPDX-License-Identifier: Apache-2.0
"""OBJ: text lines, ``v`` and ``vn`` for points and normals, ``f`` for faces of any number of corners."""

from __future__ import annotations

import io
import re
from array import array
from collections.abc import Iterator

import numpy as np
from polyshade.sim.scene.formats.surface import Damage, Surface, decode, numbers, without_small

_GEOMETRY = (b"v", b"vn", b"vt", b"f", b"l", b"p")
"""What a backslash at the end of the line continues; at the end of a name or a comment it is a part of that."""

_CORNER = re.compile(rb"([+-]?\d{1,18})(?:/(?:[+-]?\d+)?(?:/([+-]?\d{1,18})?)?)?")


def read(data: bytes) -> Surface:
    """Points, normals and faces; lines of other kinds (groups, materials, curves) are passed over.

    An index counts from 1, or back from the face's own line from -1. A normal's index may be 0 or absent.
    """
    points, normals = array("d"), array("d")
    corners, normal_of, sizes = array("q"), array("q"), array("q")
    for number, words in _statements(decode(data)):
        kind = words[0]
        if kind == b"v" or kind == b"vn":
            if len(words) < 4:
                raise Damage(f"line {number}: {kind.decode()} needs three numbers")
            values = numbers(words[1:4], f"line {number}", finite=kind == b"v")
            (points if kind == b"v" else normals).extend(values)
        elif kind == b"f":
            where = f"line {number}"
            for word in words[1:]:
                if word.isdigit():
                    point, normal = int(word), 0
                else:
                    point, normal = _corner(word, len(points) // 3, len(normals) // 3, where)
                if not 0 < point < 1 << 62:
                    raise Damage(f"{where}: index {point} is none, they count from 1")
                corners.append(point - 1)
                normal_of.append(normal - 1)
            sizes.append(len(words) - 1)
    where = np.frombuffer(corners, np.int64) if corners else np.empty(0, np.int64)
    lean = np.frombuffer(normal_of, np.int64) if normal_of else where
    for kind, index, values in (("v", where, points), ("vn", lean, normals)):
        if len(index) and index.max() >= len(values) // 3:
            raise Damage(f"a face names {kind} {index.max() + 1}, the file has {len(values) // 3}")
    repairs, where, sizes, (lean,) = without_small(where, np.array(sizes, np.int64), lean)
    return Surface(
        np.frombuffer(points).reshape(-1, 3) if points else np.empty((0, 3)), where, sizes,
        np.frombuffer(normals).reshape(-1, 3) if (lean >= 0).any() else None, lean, repairs=repairs,
    )  # fmt: skip


def _statements(text: bytes) -> Iterator[tuple[int, list[bytes]]]:
    """The words of every line with geometry and the number of its first line, continued lines joined."""
    lines = enumerate(io.BytesIO(text), 1)
    for number, line in lines:
        words = line.partition(b"#")[0].split() if b"#" in line else line.split()
        if not words or words[0] not in _GEOMETRY:
            continue
        while words and words[-1].endswith(b"\\"):
            following = next(lines, (0, b""))[1].partition(b"#")[0].split()
            words = [*words[:-1], *filter(None, [words[-1][:-1]]), *following]
        yield number, words


def _corner(word: bytes, points: int, normals: int, where: str) -> tuple[int, int]:
    """``point``, ``point/texture``, ``point//normal`` or ``point/texture/normal``, as indices from 1.

    `points` and `normals` have been defined so far. Example: with 8 points ``-1//3`` is (8, 3).
    """
    parts = _CORNER.fullmatch(word)
    if not parts:
        raise Damage(f"{where}: {word.decode(errors='replace')!r} is no corner of a face")
    point, normal = int(parts[1]), int(parts[2] or 0)
    if point == 0 or point < -points or normal < -normals:
        raise Damage(f"{where}: {word.decode()!r} is no corner, indices count from 1, and back from -1 to -{points}")
    return point + (points + 1) * (point < 0), normal + (normals + 1) * (normal < 0)
