"""OFF: text, a line of counts, then one line for each vertex and each face."""

from __future__ import annotations

import re
from pathlib import Path

from polyshade.sim.scene.formats.common import Checked, Damage, decode, numbers


def check(data: bytes, path: Path) -> Checked:
    """Compare the counts with the lines that follow, and read every number of them."""
    text = decode(data)
    lines = [line for raw in text.split("\n") if (line := raw.partition("#")[0].strip())]
    magic = re.match(r"(ST)?C?N?OFF\b", lines[0]) if lines else None
    if not magic:
        raise Damage("does not begin with OFF")
    rest = lines[0][magic.end() :].strip()  # the counts may follow on the same line
    lines = [rest, *lines[1:]] if rest else lines[1:]
    counts = lines[0].split() if lines else []
    if len(counts) < 2 or not all(count.isdecimal() for count in counts):
        raise Damage("has no line of vertex and face counts behind OFF")
    vertices, faces = int(counts[0]), int(counts[1])
    if len(lines) - 1 < vertices + faces:
        raise Damage(f"truncated, claims {vertices} vertices and {faces} faces, {len(lines) - 1} lines follow")
    for row, line in enumerate(lines[1 : vertices + 1]):
        if len(numbers(line.split(), f"vertex {row}")) < 3:
            raise Damage(f"vertex {row} has fewer than three coordinates")
    triangles = 0
    for row, line in enumerate(lines[vertices + 1 : vertices + faces + 1]):
        count, *words = line.split()
        corners = int(count) if count.isdecimal() else 0
        if corners < 3 or len(words) < corners or not all(word.isdecimal() for word in words[:corners]):
            raise Damage(f"face {row} is no count of at least three and as many indices, {line!r}")
        if any(int(word) >= vertices for word in words[:corners]):
            raise Damage(f"face {row} names a vertex outside of 0 to {vertices - 1}, {line!r}")
        triangles += corners - 2
    if not triangles:
        raise Damage("has no faces")
    return Checked(triangles, triangles - faces, text.encode())
