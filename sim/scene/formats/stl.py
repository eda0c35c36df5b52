"""STL: 50 bytes for each triangle behind a header of 84, or text."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

from polyshade.sim.scene.formats.common import Checked, Damage, decode, numbers


def check(data: bytes, path: Path) -> Checked:
    """Binary if the length is what the header claims, whatever the header says; else text with every block closed."""
    claimed = int.from_bytes(data[80:84], "little")
    if len(data) == 84 + 50 * claimed:
        return Checked(claimed, 0, data)
    if data.lstrip()[:5].lower() != b"solid":
        claim = f"{len(data)} bytes, its header claims {claimed} triangles in {84 + 50 * claimed}"
        raise Damage(f"truncated, or no STL file: has {claim}")
    count: Counter[str] = Counter()
    text = decode(data)
    for number, line in enumerate(text.split("\n"), 1):
        word, *rest = line.lower().split() or [""]
        count[word] += 1
        if word == "vertex" and len(numbers(rest, f"line {number}")) != 3:
            raise Damage(f"line {number}: a vertex needs three numbers")
    facets = count["facet"]
    closed = all(count[word] == facets for word in ("outer", "endloop", "endfacet"))
    if not closed or count["vertex"] != 3 * facets or count["solid"] != count["endsolid"]:
        raise Damage(f"truncated or damaged, {facets} facets, {count['vertex']} vertices, or an end is missing")
    return Checked(facets, 0, text.encode())
