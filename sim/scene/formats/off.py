# SPDX-License-Identifier: Apache-2.0
"""OFF: text, a line of counts, then one line for each point and each face."""

from __future__ import annotations

import re
from array import array

import numpy as np
from polyshade.sim.scene.formats.surface import Damage, Surface, decode, integers, numbers, without_small

_MAGIC = re.compile(rb"(?:ST)?C?(N)?(4)?(n)?OFF(?![A-Za-z])")


def read(data: bytes) -> Surface:
    """Points, of ``4OFF`` with a fourth coordinate that divides the others; normals of ``NOFF``; faces."""
    lines = [line for raw in decode(data).split(b"\n") if (line := raw.partition(b"#")[0].strip())]
    magic = _MAGIC.match(lines[0]) if lines else None
    if not magic:
        raise Damage("does not begin with OFF")
    if magic[3] or lines[0][magic.end() :].strip().startswith(b"BINARY"):
        raise Damage(f"is of the kind {lines[0].decode(errors='replace')!r}, allowed is text of three dimensions")
    rest = lines[0][magic.end() :].strip()  # the counts may follow on the same line
    lines = [rest, *lines[1:]] if rest else lines[1:]
    counts = lines[0].split() if lines else []
    if len(counts) < 2 or not all(count.isdigit() for count in counts):
        raise Damage("has no line of vertex and face counts behind OFF")
    vertices, faces = int(counts[0]), int(counts[1])
    if len(lines) - 1 < vertices + faces:
        raise Damage(f"truncated, claims {vertices} vertices and {faces} faces, {len(lines) - 1} lines follow")

    axes = 4 if magic[2] else 3
    columns = axes + 3 * bool(magic[1])
    table = array("d")
    for row, line in enumerate(lines[1 : vertices + 1]):
        words = line.split()
        if len(words) < columns:
            raise Damage(f"vertex {row} has {len(words)} numbers, {columns} are needed")
        table.extend(numbers(words[:axes], f"vertex {row}") + numbers(words[axes:columns], f"vertex {row}", False))
    corners, sizes = array("q"), array("q")
    for row, line in enumerate(lines[vertices + 1 : vertices + faces + 1]):
        words = line.split()
        (size,) = integers(words[:1], f"face {row}")
        if not 0 <= size < len(words):
            raise Damage(f"face {row} is no count and as many indices, {line.decode(errors='replace')!r}")
        corners.extend(integers(words[1 : size + 1], f"face {row}"))
        sizes.append(size)
    rows = np.frombuffer(table).reshape(-1, columns) if table else np.empty((0, columns))
    points = rows[:, :3].copy()
    if axes == 4:
        if not rows[:, 3].all():
            raise Damage(f"vertex {np.argmin(rows[:, 3] != 0)} lies at infinity, its fourth coordinate is 0")
        points /= rows[:, 3:4]
    repairs, where, sizes, _ = without_small(np.array(corners, np.int64), np.array(sizes, np.int64))
    return Surface(points, where, sizes, rows[:, axes:columns] if magic[1] else None, repairs=repairs)
