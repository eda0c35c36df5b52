"""glTF 2, a JSON tree with numbers in buffers, and its binary container GLB."""

from __future__ import annotations

import base64
import json
import re
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from polyshade.sim.scene.formats.common import Checked, Damage

_BYTES = {5121: 1, 5123: 2, 5125: 4, 5126: 4}
_UNSIGNED, _FLOAT = (5121, 5123, 5125), (5126,)
_TRIANGLES = 4
_NO_GEOMETRY = re.compile(r"KHR_(materials_\w+|texture_\w+|lights_punctual)")


def check(data: bytes, path: Path) -> Checked:
    """Follow the scene from its roots to the buffers; `path` is where external buffers are looked for."""
    return Checked(_triangles(data, path, None), 0, data)


def check_binary(data: bytes, path: Path) -> Checked:
    """A header of 12 bytes, then chunks of length, kind and content: JSON first, then the buffer."""
    length = int.from_bytes(data[8:12], "little")
    if data[:8] != b"glTF\x02\0\0\0":
        raise Damage("is no GLB file of version 2")
    if length != len(data):
        raise Damage(f"has {len(data)} bytes, its header claims {length}")
    chunks: dict[bytes, bytes] = {}
    at = 12
    while at < length:
        size, kind = int.from_bytes(data[at : at + 4], "little"), data[at + 4 : at + 8]
        if at + 8 + size > length:
            raise Damage(f"truncated, a chunk claims {size} bytes, {max(length - at - 8, 0)} follow")
        chunks.setdefault(kind, data[at + 8 : at + 8 + size])
        at += 8 + size
    if b"JSON" not in chunks:
        raise Damage("has no JSON chunk")
    return Checked(_triangles(chunks[b"JSON"], path, chunks.get(b"BIN\0")), 0, data)


def _triangles(text: bytes, path: Path, embedded: bytes | None) -> int:
    """Count the triangles of the scene; raises Damage when anything they need is missing."""
    try:
        tree = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise Damage(f"holds no valid JSON ({error})") from None
    if not isinstance(tree, dict) or not str(tree.get("asset", {}).get("version")).startswith("2."):
        raise Damage("is no glTF file of version 2")
    for name in tree.get("extensionsRequired", []):
        if not _NO_GEOMETRY.fullmatch(name):
            raise Damage(f"needs the extension {name}, which is not supported")
    for number, buffer in enumerate(tree.get("buffers", [])):
        found = _buffer_size(buffer.get("uri"), path, embedded if number == 0 else None)
        if found < buffer["byteLength"]:
            raise Damage(f"buffer {number} has {found} bytes, {buffer['byteLength']} are claimed")

    total = 0
    reached: set[int] = set()
    waiting = list(_item(tree, "scenes", tree.get("scene", 0)).get("nodes", []))
    while waiting:
        index = waiting.pop()
        node = _item(tree, "nodes", index)
        if index in reached:
            raise Damage(f"node {index} is reached twice")
        reached.add(index)
        waiting += node.get("children", [])
        if "mesh" in node:
            primitives = _item(tree, "meshes", node["mesh"])["primitives"]
            total += sum(_corners(tree, p) // 3 for p in primitives if p.get("mode", _TRIANGLES) == _TRIANGLES)
    if not total:
        raise Damage("has no triangles in its scene")
    return total


def _buffer_size(uri: str | None, path: Path, embedded: bytes | None) -> int:
    if uri is None:
        if embedded is None:
            raise Damage("a buffer has no data")
        return len(embedded)
    if uri.startswith("data:"):
        return len(base64.b64decode(uri.partition(",")[2], validate=True))
    file = path.parent / unquote(uri)
    if not file.is_file():
        raise Damage(f"its buffer {uri!r} does not exist")
    return file.stat().st_size


def _corners(tree: dict[str, Any], primitive: dict[str, Any]) -> int:
    """Corners of a primitive of triangles, its accessors checked."""
    attributes = primitive["attributes"]
    points = _accessor(tree, attributes.get("POSITION"), "VEC3", _FLOAT)
    if "NORMAL" in attributes and _accessor(tree, attributes["NORMAL"], "VEC3", _FLOAT) != points:
        raise Damage("a primitive has more or fewer normals than positions")
    corners = _accessor(tree, primitive["indices"], "SCALAR", _UNSIGNED) if "indices" in primitive else points
    if corners % 3:
        raise Damage(f"a primitive of triangles has {corners} corners")
    return corners


def _accessor(tree: dict[str, Any], index: object, shape: str, kinds: tuple[int, ...]) -> int:
    """How many items an accessor has; raises Damage when it is not of the shape and type or its bytes are missing."""
    entry = _item(tree, "accessors", index)
    if "sparse" in entry or "bufferView" not in entry:
        raise Damage(f"accessor {index} is sparse or has no data, which is not supported")
    kind, count, start = entry.get("componentType"), entry.get("count"), entry.get("byteOffset", 0)
    if entry.get("type") != shape or kind not in kinds or type(count) is not int or count < 1:
        raise Damage(f"accessor {index} is not what its use needs")
    view = _item(tree, "bufferViews", entry["bufferView"])
    buffer = _item(tree, "buffers", view.get("buffer"))
    size = _BYTES[kind] * (3 if shape == "VEC3" else 1)
    end = start + (count - 1) * view.get("byteStride", size) + size
    first = view.get("byteOffset", 0)
    if min(start, first) < 0 or end > view["byteLength"] or first + view["byteLength"] > buffer["byteLength"]:
        raise Damage(f"accessor {index} reaches beyond its buffer")
    return count


def _item(tree: dict[str, Any], kind: str, index: object) -> dict[str, Any]:
    entries = tree.get(kind, [])
    if type(index) is not int or not 0 <= index < len(entries):
        raise Damage(f"{kind} {index!r} does not exist, the file has {len(entries)}")
    return entries[index]
