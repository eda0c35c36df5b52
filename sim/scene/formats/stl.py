# SPDX-License-Identifier: Apache-2.0
"""STL: 50 bytes for each triangle behind a header of 84, or text."""

from __future__ import annotations

import io
from array import array
from collections import Counter

import numpy as np
from polyshade.sim.scene.formats.surface import Damage, Surface, decode, numbers

_HEAD, _FACET = 84, 50
_ROW = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def read(data: bytes) -> Surface:
    """Triangles of three points each. The facets' own normals are passed over: the corners' order gives the same."""
    claimed = int.from_bytes(data[80:84], "little") if len(data) >= _HEAD else 0
    spare = len(data) - _HEAD - _FACET * claimed
    if spare == 0 or (spare > 0 and claimed and not _is_text(data)):
        if spare and spare % _FACET == 0:
            raise Damage(f"its header claims {claimed} triangles, there are {claimed + spare // _FACET}")
        rows = np.frombuffer(data, _ROW, claimed, _HEAD)
        points = rows["corners"].reshape(-1, 3).astype(np.float64)
        repairs = {"trailing_bytes": spare} if spare else {}
    elif _is_text(data):
        points, ends = _text(decode(data))
        repairs = {} if ends else {"missing_end": 1}
    else:
        claim = f"{len(data)} bytes, its header claims {claimed} triangles in {_HEAD + _FACET * claimed}"
        raise Damage(f"truncated, or no STL file: has {claim}")
    return Surface(points, np.arange(len(points)), np.full(len(points) // 3, 3), repairs=repairs)


def _is_text(data: bytes) -> bool:
    """Whether the first words are those of a text file: `solid` alone may also begin a binary one's header."""
    words = (line.split() for line in data[:4096].removeprefix(b"\xef\xbb\xbf").lower().splitlines())
    kinds = [line[0] for line in words if line and not line[0].startswith((b"#", b";", b"//"))]
    return kinds[:1] == [b"solid"] and b"\0" not in data[:4096]


def _text(text: bytes) -> tuple[np.ndarray, bool]:
    """The points (3 F, 3), and whether every solid has its end; every facet must be whole."""
    count: Counter[bytes] = Counter()
    points, word = array("d"), b""
    for number, line in enumerate(io.BytesIO(text), 1):
        word, *rest = line.split() or [b""]
        word = word.lower()
        count[word] += 1
        if word == b"vertex":
            if len(rest) != 3:
                raise Damage(f"line {number}: a vertex needs three numbers")
            points.extend(numbers(rest, f"line {number}"))
        elif word == b"endfacet" and len(points) != 9 * count[b"endfacet"]:
            raise Damage(f"line {number}: a facet without exactly three vertices")
    facets = count[b"facet"]
    closed = all(count[word] == facets for word in (b"outer", b"endloop", b"endfacet"))
    if not closed or len(points) != 9 * facets or count[b"solid"] < count[b"endsolid"]:
        raise Damage(f"truncated or damaged, {facets} facets, {count[b'vertex']} vertices, or an end is missing")
    ended = count[b"solid"] == count[b"endsolid"]
    if not ended and word and word != b"endfacet":
        raise Damage(f"truncated in {word.decode(errors='replace')!r}")
    found = np.frombuffer(points).reshape(-1, 3) if points else np.empty((0, 3))
    return found, ended
