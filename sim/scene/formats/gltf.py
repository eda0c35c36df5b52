# SPDX-License-Identifier: Apache-2.0
"""glTF 2, a JSON tree with numbers in buffers, and its binary container GLB."""

from __future__ import annotations

import base64
import json
import re
from math import prod
from pathlib import Path
from typing import Any
from urllib.parse import unquote, unquote_to_bytes

import numpy as np
from polyshade.sim.scene.formats.surface import Damage, Floats, Ints, Surface

_TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_SHAPES = {"SCALAR": (), "VEC3": (3,), "VEC4": (4,), "MAT4": (4, 4)}
_UNSIGNED, _INDICES = ("<u1", "<u2"), ("<u1", "<u2", "<u4")
_TRIANGLES, _STRIP, _FAN = 4, 5, 6
_MOST = 1 << 26
"""Items of an accessor without data, which need no byte in the file."""

_NO_GEOMETRY = re.compile(
    r"KHR_mesh_quantization|[A-Z]+_\w*(material|texture|image|light|animation|audio|xmp|metadata|articulations)\w*"
)
"""Required extensions that leave points and faces as they are, or that this reader knows."""


def read(data: bytes, path: Path) -> Surface:
    """The scene's triangles, placed, with default morph weights and skins in the pose of the nodes.

    `path` is where external buffers are looked for. Primitives of points and lines, those without positions and nodes
    whose matrix has no inverse (a scale of 0 hides a node) are passed over.
    """
    embedded = None
    spare = 0
    if data[:4] == b"glTF":
        spare = len(data) - int.from_bytes(data[8:12], "little")
        data, embedded = _chunks(data)
    try:
        tree = json.loads(data.removeprefix(b"\xef\xbb\xbf"))
    except (ValueError, RecursionError) as error:
        raise Damage(f"holds no valid JSON ({error})") from None
    if not isinstance(tree, dict) or not str(tree.get("asset", {}).get("version")).startswith("2."):
        raise Damage("is no glTF file of version 2")
    for name in tree.get("extensionsRequired", []):
        if not _NO_GEOMETRY.fullmatch(name):
            raise Damage(f"needs the extension {name}, which is not supported")
    return _Scene(tree, path, embedded, {"trailing_bytes": spare} if spare else {}).surface()


def _chunks(data: bytes) -> tuple[bytes, bytes | None]:
    """A header of 12 bytes, then chunks of length, kind and content: JSON first, then the buffer."""
    length = int.from_bytes(data[8:12], "little")
    if data[4:8] != b"\x02\0\0\0" or length > len(data):
        raise Damage(f"is no whole GLB file of version 2: has {len(data)} bytes, its header claims {length}")
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
    return chunks[b"JSON"], chunks.get(b"BIN\0")


class _Scene:
    """A tree and its buffers; ``surface`` walks the scene from its roots."""

    def __init__(self, tree: dict[str, Any], path: Path, embedded: bytes | None, repairs: dict[str, int]):
        self.tree, self.path, self.repairs = tree, path, repairs
        self.buffers = [self._buffer(i, b, embedded) for i, b in enumerate(tree.get("buffers", []))]

    def surface(self) -> Surface:
        nodes = self.tree.get("nodes", [])
        places = self._places(nodes)
        parts = []
        for index, place in places.items():
            node = nodes[index]
            if "mesh" not in node:
                continue
            mesh = self.item("meshes", node["mesh"])
            joints = self._joints(node["skin"], places) if "skin" in node else None
            if joints is None and abs(np.linalg.det(place[:3, :3])) <= 1e-12 * np.abs(place[:3, :3]).max() ** 3:
                self._count("hidden_nodes")
                continue
            for primitive in mesh["primitives"]:
                weights = node.get("weights", mesh.get("weights", []))
                parts += self._primitive(primitive, place, joints, weights)
        if not parts:
            raise Damage("has no triangles in its scene")
        first = np.cumsum([0, *(len(part[0]) for part in parts)])
        points = np.concatenate([part[0] for part in parts])
        corners = np.concatenate([part[1] + at for part, at in zip(parts, first[:-1], strict=True)])
        sizes = np.full(len(corners) // 3, 3)
        if all(part[2] is None for part in parts):
            return Surface(points, corners, sizes, crease=0.0, repairs=self.repairs)
        normals = np.concatenate([np.zeros_like(p) if n is None else n for p, _, n in parts])
        own = [np.full(len(c), -1) if n is None else c + at for (_, c, n), at in zip(parts, first[:-1], strict=True)]
        return Surface(points, corners, sizes, normals, np.concatenate(own), 0.0, self.repairs)

    def _count(self, what: str) -> None:
        self.repairs[what] = self.repairs.get(what, 0) + 1

    def item(self, kind: str, index: object) -> dict[str, Any]:
        """An entry of one of the tree's lists."""
        entries = self.tree.get(kind, [])
        if type(index) is not int or not 0 <= index < len(entries):
            raise Damage(f"{kind} {index!r} does not exist, the file has {len(entries)}")
        return entries[index]

    def _buffer(self, index: int, buffer: dict[str, Any], embedded: bytes | None) -> memoryview:
        uri = buffer.get("uri")
        if uri is None:
            data = embedded if index == 0 else None
            if data is None:
                raise Damage(f"buffer {index} has no data")
        elif uri.startswith("data:"):
            kind, _, text = uri.partition(",")
            data = base64.b64decode(text, validate=True) if kind.endswith(";base64") else unquote_to_bytes(text)
        else:
            file = self.path.parent / unquote(uri)
            if not file.is_file():
                raise Damage(f"its buffer {uri!r} does not exist")
            data = file.read_bytes()
        if len(data) < buffer["byteLength"]:
            raise Damage(f"buffer {index} has {len(data)} bytes, {buffer['byteLength']} are claimed")
        return memoryview(data)[: buffer["byteLength"]]

    # Nodes.

    def _places(self, nodes: list[dict[str, Any]]) -> dict[int, Floats]:
        """The matrix (4, 4) to the scene's space of every node that the scene reaches."""
        if self.tree.get("scenes"):
            roots = self.item("scenes", self.tree.get("scene", 0)).get("nodes", [])
        else:  # then all nodes that have no parent
            children = {child for node in nodes for child in node.get("children", [])}
            roots = [index for index in range(len(nodes)) if index not in children]
        places: dict[int, Floats] = {}
        waiting = [(root, np.eye(4)) for root in roots]
        while waiting:
            index, above = waiting.pop()
            node = self.item("nodes", index)
            if index in places:
                raise Damage(f"node {index} is reached twice")
            places[index] = above @ _matrix(node, index)
            waiting += [(child, places[index]) for child in reversed(node.get("children", []))]
        return places

    def _joints(self, index: int, places: dict[int, Floats]) -> Floats:
        """A skin's matrices (J, 4, 4) from the mesh's space in its bind pose to the scene's."""
        skin = self.item("skins", index)
        if missing := [joint for joint in skin["joints"] if joint not in places]:
            raise Damage(f"skin {index} has the joint {missing[0]}, which is not in the scene")
        matrices = np.stack([places[joint] for joint in skin["joints"]])
        if "inverseBindMatrices" in skin:
            bind = self._values(skin["inverseBindMatrices"], "MAT4", ("<f4",)).transpose(0, 2, 1)
            if len(bind) < len(matrices):
                raise Damage(f"skin {index} has {len(matrices)} joints and {len(bind)} matrices")
            matrices = matrices @ bind[: len(matrices)]
        return matrices

    # Meshes.

    def _primitive(
        self, primitive: dict[str, Any], place: Floats, joints: Floats | None, weights: list[float]
    ) -> list[tuple[Floats, Ints, Floats | None]]:
        """Points, corners of triangles and normals of a primitive in the scene's space; nothing without triangles."""
        mode, attributes = primitive.get("mode", _TRIANGLES), primitive["attributes"]
        if mode not in range(7):
            raise Damage(f"a primitive has the mode {mode!r}, allowed are 0 to 6")
        if mode < _TRIANGLES:
            return []
        if "POSITION" not in attributes:
            self._count("empty_primitives")
            return []
        points = self._vectors(attributes["POSITION"])
        normals = self._vectors(attributes["NORMAL"], len(points)) if "NORMAL" in attributes else None
        for weight, target in zip(weights, primitive.get("targets", []), strict=False):
            if weight and "POSITION" in target:
                points = points + weight * self._vectors(target["POSITION"], len(points))
            if weight and normals is not None and "NORMAL" in target:
                normals = normals + weight * self._vectors(target["NORMAL"], len(points))
        if "indices" in primitive:
            corners = self._values(primitive["indices"], "SCALAR", _INDICES).astype(np.int64)
        else:
            corners = np.arange(len(points))
        if mode == _TRIANGLES and len(corners) % 3:
            raise Damage(f"a primitive of triangles has {len(corners)} corners")
        if len(corners) and corners.max() >= len(points):
            raise Damage(f"a face names a vertex outside of 0 to {len(points) - 1}")
        if mode != _TRIANGLES:
            step = np.arange(max(len(corners) - 2, 0))
            odd = step % 2 if mode == _STRIP else 0
            start = step if mode == _STRIP else np.zeros_like(step)
            first = (start + odd, step + 1 - odd) if mode == _STRIP else (start, step + 1)
            corners = corners[np.stack([*first, step + 2], axis=1)].reshape(-1)
        if joints is not None:
            place = self._skinned(attributes, joints, len(points))
        turn = place[..., :3, :3]
        points = points @ turn.T if joints is None else np.einsum("vij,vj->vi", turn, points)
        points += place[..., :3, 3]
        if normals is not None:
            normals = _turned(turn, normals)
        if joints is None and np.linalg.det(turn) < 0:  # mirrored: the faces must be turned to stay outside
            corners = corners.reshape(-1, 3)[:, ::-1].reshape(-1)
        return [(points, corners, normals)] if len(corners) else []

    def _skinned(self, attributes: dict[str, Any], joints: Floats, count: int) -> Floats:
        """The matrix (V, 4, 4) of every point, the mean of its joints' by weight."""
        total, whole = np.zeros((count, 4, 4)), np.zeros(count)
        for number in range(sum(name.startswith("JOINTS_") for name in attributes)):
            which = self._values(attributes[f"JOINTS_{number}"], "VEC4", _UNSIGNED, count).astype(np.int64)
            weight = self._values(attributes[f"WEIGHTS_{number}"], "VEC4", ("<f4", *_UNSIGNED), count)
            if which[weight != 0].max(initial=0) >= len(joints):
                raise Damage(f"a point names the joint {which.max()}, its skin has {len(joints)}")
            for column in range(4):
                used = np.where(weight[:, column] != 0, which[:, column], 0)
                total += weight[:, column, None, None] * joints[used]
                whole += weight[:, column]
        if not (whole > 0).all():
            raise Damage("a point of a skinned mesh has no weight")
        return total / whole[:, None, None]

    def _vectors(self, index: object, count: int | None = None) -> Floats:
        return self._values(index, "VEC3", tuple(_TYPES.values()), count)

    def _values(self, index: object, shape: str, kinds: tuple[str, ...], count: int | None = None) -> Any:
        """An accessor's items: float64 if they are floats or normalized integers, else as they are.

        Raises Damage when it has not the shape, type or count that its use needs, or its bytes are missing.
        """
        entry = self.item("accessors", index)
        kind, length = _TYPES.get(entry.get("componentType")), entry.get("count")
        if entry.get("type") != shape or kind not in kinds or type(length) is not int or length < 1:
            raise Damage(f"accessor {index} is not what its use needs")
        if count is not None and length != count:
            raise Damage(f"accessor {index} has {length} items, the primitive has {count} positions")
        if "bufferView" in entry:
            items = self._bytes(entry["bufferView"], entry.get("byteOffset", 0), kind, _SHAPES[shape], length, index)
        elif length <= _MOST:
            items = np.zeros((length, *_SHAPES[shape]), kind)
        else:
            raise Damage(f"accessor {index} has {length} items and no data, allowed are {_MOST}")
        if "sparse" in entry:
            sparse, items = entry["sparse"], items.copy()
            where, values = sparse["indices"], sparse["values"]
            few, wide = sparse["count"], _TYPES.get(where["componentType"])
            if wide not in _INDICES or type(few) is not int or not 0 < few <= length:
                raise Damage(f"accessor {index} has sparse values that are none")
            at = self._bytes(where["bufferView"], where.get("byteOffset", 0), wide, (), few, index)
            if at.max() >= length:
                raise Damage(f"accessor {index} has a sparse value at {at.max()}, it has {length} items")
            shown = _SHAPES[shape]
            items[at] = self._bytes(values["bufferView"], values.get("byteOffset", 0), kind, shown, few, index)
        if kind == "<f4":
            return items.astype(np.float64)
        if entry.get("normalized"):
            return np.maximum(items / np.iinfo(kind).max, -1.0)
        return items.astype(np.float64) if shape == "VEC3" else items

    def _bytes(self, view: object, start: int, kind: str, shape: tuple[int, ...], count: int, index: object) -> Any:
        """So many items of a view of a buffer, as they lie there."""
        entry = self.item("bufferViews", view)
        number = entry.get("buffer")
        self.item("buffers", number)
        size = np.dtype(kind).itemsize * prod(shape)
        first, length, stride = entry.get("byteOffset", 0), entry["byteLength"], entry.get("byteStride", size)
        end = start + (count - 1) * stride + size
        if min(start, first, stride) < 0 or end > length or first + length > len(self.buffers[number]):
            raise Damage(f"accessor {index} reaches beyond its buffer")
        inner = tuple(np.dtype(kind).itemsize * prod(shape[i + 1 :]) for i in range(len(shape)))
        return np.ndarray((count, *shape), kind, self.buffers[number], first + start, (stride, *inner))


def _matrix(node: dict[str, Any], index: int) -> Floats:
    """A node's own matrix (4, 4)."""
    if "matrix" in node:
        matrix = np.array(node["matrix"], np.float64).reshape(4, 4).T
    else:
        x, y, z, w = np.array(node.get("rotation", (0, 0, 0, 1)), np.float64)
        scale, move = (np.array(node.get(k, (v,) * 3), np.float64) for k, v in (("scale", 1), ("translation", 0)))
        norm = 2 / ((x * x + y * y + z * z + w * w) or 1.0)
        turn = np.eye(3) - norm * np.array(
            [
                [y * y + z * z, z * w - x * y, -x * z - y * w],
                [-x * y - z * w, x * x + z * z, x * w - y * z],
                [y * w - x * z, -y * z - x * w, x * x + y * y],
            ]
        )
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = turn * scale.reshape(3), move.reshape(3)
    if not np.isfinite(matrix).all():
        raise Damage(f"the place of node {index} is not finite")
    return matrix


def _turned(turn: Floats, normals: Floats) -> Floats:
    """Normals after a linear map of the points, of unchanged length: the map's cofactors turn them."""
    a, b, c = np.moveaxis(turn, -1, 0)
    cofactors = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=-1)
    sign = np.sign(np.linalg.det(turn))
    turned = np.einsum("...ij,...j->...i", cofactors, normals) * sign[..., None]
    now = np.linalg.norm(turned, axis=-1, keepdims=True)
    return turned * (np.linalg.norm(normals, axis=-1, keepdims=True) / np.where(now == 0, 1, now))
