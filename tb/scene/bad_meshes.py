# SPDX-License-Identifier: Apache-2.0
"""Mesh files that must be refused: every format, every way to be damaged that we could think of.

`bad_meshes` yields names and contents; `plant` writes them into a folder, beside things that are no files at all,
and returns the paths. Each of them must end in one line of error that names the file.
"""

from __future__ import annotations

import base64
import json
import os
import struct
from collections.abc import Iterator
from copy import deepcopy
from pathlib import Path
from typing import Any

POINTS = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
"""A tetrahedron, counter-clockwise seen from outside."""

Points = list[tuple[Any, ...]]
Faces = list[tuple[Any, ...]]


# Writers of sound files; with unsound arguments they write unsound ones.


def obj(points: Points = POINTS, faces: Faces = FACES) -> bytes:
    rows = ["v " + " ".join(map(str, p)) for p in points]
    rows += ["f " + " ".join(str(i + 1 if isinstance(i, int) else i) for i in f) for f in faces]
    return "\n".join([*rows, ""]).encode()


def off(points: Points = POINTS, faces: Faces = FACES, counts: str | None = None) -> bytes:
    rows = ["OFF", counts if counts is not None else f"{len(points)} {len(faces)} 0"]
    rows += [" ".join(map(str, p)) for p in points]
    rows += [" ".join(map(str, (len(f), *f))) for f in faces]
    return "\n".join([*rows, ""]).encode()


def ply_head(form: str, points: int, faces: int) -> bytes:
    return (
        f"ply\nformat {form} 1.0\nelement vertex {points}\n"
        "property float x\nproperty float y\nproperty float z\n"
        f"element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    ).encode()


def ply(points: Points = POINTS, faces: Faces = FACES) -> bytes:
    rows = [" ".join(map(str, p)) for p in points]
    rows += [" ".join(map(str, (len(f), *f))) for f in faces]
    return ply_head("ascii", len(points), len(faces)) + "\n".join([*rows, ""]).encode()


def binary_ply(points: Points = POINTS, faces: Faces = FACES, order: str = "<") -> bytes:
    form = "binary_little_endian" if order == "<" else "binary_big_endian"
    body = b"".join(struct.pack(order + "3f", *p) for p in points)
    body += b"".join(struct.pack(f"{order}B{len(f)}i", len(f), *f) for f in faces)
    return ply_head(form, len(points), len(faces)) + body


def stl(points: Points = POINTS, faces: Faces = FACES) -> bytes:
    rows = ["solid s"]
    for face in faces:
        rows += ["facet normal 0 0 0", "outer loop"]
        rows += ["vertex " + " ".join(map(str, points[i])) for i in face]
        rows += ["endloop", "endfacet"]
    return "\n".join([*rows, "endsolid s", ""]).encode()


def binary_stl(points: Points = POINTS, faces: Faces = FACES, claimed: int | None = None) -> bytes:
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *(x for i in face for x in points[i]), 0) for face in faces)
    return bytes(80) + struct.pack("<I", len(faces) if claimed is None else claimed) + body


def gltf_tree(points: Points = POINTS, faces: Faces = FACES, uri: bool = True) -> tuple[dict[str, Any], bytes]:
    """The JSON tree and the buffer of a scene of one node; with `uri` the tree holds the buffer too."""
    place = b"".join(struct.pack("<3f", *p) for p in points)
    index = b"".join(struct.pack("<3I", *f) for f in faces)
    buffer: dict[str, Any] = {"byteLength": len(place + index)}
    if uri:
        buffer["uri"] = "data:application/octet-stream;base64," + base64.b64encode(place + index).decode()
    tree = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3"},
            {"bufferView": 1, "componentType": 5125, "count": 3 * len(faces), "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": len(place)},
            {"buffer": 0, "byteOffset": len(place), "byteLength": len(index)},
        ],
        "buffers": [buffer],
    }
    return tree, place + index


def gltf(points: Points = POINTS, faces: Faces = FACES) -> bytes:
    return json.dumps(gltf_tree(points, faces)[0]).encode()


def glb(points: Points = POINTS, faces: Faces = FACES) -> bytes:
    tree, buffer = gltf_tree(points, faces, uri=False)
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(buffer), b"BIN\0") + buffer
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


WRITERS = {
    "obj": (obj,),
    "off": (off,),
    "ply": (ply, binary_ply),
    "stl": (stl, binary_stl),
    "gltf": (gltf,),
    "glb": (glb,),
}
"""By suffix; the first writes text where the format has a text form."""

WORDS = ("nan", "inf", "-inf", "1e999", "1e31", "one", "1,5", "0x", "--1", "1.2.3", "1e", "\N{INFINITY}")
"""No coordinates."""


def bad_meshes() -> Iterator[tuple[str, bytes]]:
    """Name and content of every bad file; names are unique."""
    yield from _not_this_format()
    yield from _coordinates()
    yield from _indices()
    yield from _without_area()
    yield from _truncated()
    yield from _obj()
    yield from _off()
    yield from _ply()
    yield from _stl()
    yield from _gltf()
    yield from _glb()


def plant(folder: Path) -> list[Path]:
    """Write the bad files into `folder`, and add what is no regular file."""
    paths = []
    for name, content in bad_meshes():
        paths.append(folder / name)
        paths[-1].write_bytes(content)
    for suffix in WRITERS:
        (folder / f"directory.{suffix}").mkdir()
        paths += [folder / f"directory.{suffix}", folder / f"missing.{suffix}"]
    os.mkfifo(folder / "fifo.obj")
    (folder / "loop.stl").symlink_to(folder / "loop.stl")
    (folder / "dangling.ply").symlink_to(folder / "nowhere.ply")
    with (folder / "huge.off").open("wb") as file:
        file.truncate(1 << 40)  # sparse: takes no room
    paths += [folder / name for name in ("fifo.obj", "loop.stl", "dangling.ply", "huge.off")]
    paths += [folder / "obj_empty.obj" / "inside_a_file.obj", folder / ("long" * 100 + ".obj"), folder / "nul\0.obj"]
    if os.geteuid() != 0:  # root may read everything
        (folder / "forbidden.obj").write_bytes(obj())
        (folder / "forbidden.obj").chmod(0)
        paths.append(folder / "forbidden.obj")
    return paths


def _not_this_format() -> Iterator[tuple[str, bytes]]:
    noise = bytes((i * 197 + i * i * 31 + (i >> 3)) % 256 for i in range(4096))
    for suffix in WRITERS:
        yield f"{suffix}_empty.{suffix}", b""
        yield f"{suffix}_blank.{suffix}", b" \n\t\r\n\n"
        yield f"{suffix}_zeros.{suffix}", bytes(1000)
        yield f"{suffix}_noise.{suffix}", noise
        yield f"{suffix}_png.{suffix}", b"\x89PNG\r\n\x1a\n" + noise
        yield f"{suffix}_html.{suffix}", b"<!DOCTYPE html>\n<html><body>404 Not Found</body></html>\n"
        yield f"{suffix}_pointer.{suffix}", b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 12\n"
        for other, writers in WRITERS.items():
            if {suffix, other} not in ({suffix}, {"gltf", "glb"}):  # a container is known by its first bytes
                yield f"{suffix}_is_{other}.{suffix}", writers[-1]()
    for name in ("mesh", "mesh.txt", "mesh.blend", "mesh.fbx", "mesh.obj.gz", "mesh.zip", ".obj"):
        yield name, obj()


def _coordinates() -> Iterator[tuple[str, bytes]]:
    for suffix, writer in (("obj", obj), ("off", off), ("ply", ply), ("stl", stl)):
        for number, word in enumerate(WORDS):
            yield f"{suffix}_word_{number}.{suffix}", writer([*POINTS[:3], (0.0, word, 1.0)])
        yield f"{suffix}_two_coordinates.{suffix}", writer([*POINTS[:3], (0.0, 1.0)])
        yield f"{suffix}_no_coordinates.{suffix}", writer([*POINTS[:3], ()])
    for value in (float("nan"), float("inf"), -float("inf"), 3e38):
        for name, content in _binary([*POINTS[:3], (0.0, value, 1.0)], FACES):
            yield f"value_{value}_{name}", content


def _indices() -> Iterator[tuple[str, bytes]]:
    for word in ("x", "1.5", "nan", "1e9", "4294967296", "99999999999999999999", "-5", "0x1", "//"):
        for suffix, writer in (("obj", obj), ("off", off), ("ply", ply)):
            yield f"{suffix}_index_{word.replace('/', 's')}.{suffix}", writer(faces=[*FACES[:3], (0, 3, word)])
    for index in (4, 1000, 2**31 - 1):
        for suffix, writer in (("obj", obj), ("off", off), ("ply", ply)):
            yield f"{suffix}_index_{index}.{suffix}", writer(faces=[*FACES[:3], (0, 3, index)])
        for name, content in _binary(POINTS, [*FACES[:3], (0, 3, index)]):
            if "stl" not in name:
                yield f"index_{index}_{name}", content
    for order in "<>":
        yield f"binary_index_-1_{ord(order)}.ply", binary_ply(faces=[*FACES[:3], (0, 3, -1)], order=order)


def _without_area() -> Iterator[tuple[str, bytes]]:
    point: Points = [(0.5, 0.5, 0.5)] * 4
    line: Points = [(0.0, 0.0, 0.0), (1.0, 2.0, 3.0), (2.0, 4.0, 6.0), (3.0, 6.0, 9.0)]
    folded: Faces = [(0, 0, 1), (1, 2, 1), (3, 3, 3)]
    for suffix, writers in WRITERS.items():
        for writer in writers:
            name = writer.__name__
            yield f"{name}_one_point.{suffix}", writer(points=point)
            yield f"{name}_one_line.{suffix}", writer(points=line)
            yield f"{name}_folded.{suffix}", writer(faces=folded)
            yield f"{name}_no_faces.{suffix}", writer(faces=[])


def _truncated() -> Iterator[tuple[str, bytes]]:
    for part in (0.02, 0.2, 0.5, 0.7, 0.9, 0.97):
        for name, content in (*_binary(POINTS, FACES), ("text.gltf", gltf()), ("text.stl", stl())):
            cut = content[: int(part * len(content))]
            if not cut.rstrip().endswith(b"endfacet"):  # then only the solid's end is missing
                yield f"cut_{part}_{name}", cut
    for lines in (1, 2, 4, 6):
        for suffix, writer in (("off", off), ("ply", ply)):
            yield f"{suffix}_cut_{lines}.{suffix}", b"\n".join(writer().rstrip().split(b"\n")[:-lines])
    for suffix, writer in (("off", off), ("ply", ply)):
        yield f"{suffix}_cut_in_line.{suffix}", writer().rstrip()[:-2]
    for name, content in _binary(POINTS, FACES):
        yield f"last_byte_{name}", content[:-1]


def _binary(points: Points, faces: Faces) -> list[tuple[str, bytes]]:
    return [
        ("little.ply", binary_ply(points, faces)),
        ("big.ply", binary_ply(points, faces, order=">")),
        ("binary.stl", binary_stl(points, faces) if _fits(faces) else b""),
        ("binary.glb", glb(points, faces)),
    ]


def _fits(faces: Faces) -> bool:
    return all(0 <= i < len(POINTS) for face in faces for i in face)


def _obj() -> Iterator[tuple[str, bytes]]:
    body, normals = obj().decode(), "1//{} 2//{} 3//{}\n"
    bad = [
        "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "f 1 2 3\n", "# a mesh\n# of nothing\n",  # not a face
        "v 0 0 0\nv 1 0 0\nl 1 2\n", "v 0 0 0\nv 1 0 0\np 1 2\n", "v 0 0 0\nv 1 0 0\nf 1 2\nf\n",
        body + "f 1 \\\n2 x", body + "f 0 1 2\n", body + "f -5 -1 -2\n", "f -3 -2 -1\n" + body,  # indices
        body + "f " + normals.format(1, 1, 1), body + "vn 0 0 up\nf " + normals.format(1, 1, 1), body + "vn 0 0\n",
        body + "vn 0 0 1\nf " + normals.format(-2, -1, -1),
        body + "f 1/1/1/1 2/1/1/1 3/1/1/1\n", body + "f /1 /2 /3\n", body + "f - 1 2\n", body + "f 1 2 \0\n",
        body + "v nan nan nan\n", body + "v a b c\n", body + "v\n",
    ]  # fmt: skip
    for number, text in enumerate(bad):
        yield f"obj_{number}.obj", text.encode()
    yield "obj_utf16.obj", body.encode("utf-16")


def _off() -> Iterator[tuple[str, bytes]]:
    for number, counts in enumerate([
        "400 4 0", "4 400 0", "99999999999999 99999999999999 0", "-4 4 0", "4 -4 0", "4", "four four zero",
        "4.0 4.0 0.0", "", "3 5 0", "0 4 0", "4 0 0",
    ]):  # fmt: skip
        yield f"off_counts_{number}.off", off(counts=counts)
    body = off().decode()
    bad = [
        body.removeprefix("OFF\n"), "X" + body, "OFF\n", body.replace("OFF", "OFF BINARY"), body.replace("OFF", "oof"),
        "4" + body, "4" + body.replace("0.0\n", "0.0 0\n"), "n" + body.replace("4 4", "3\n4 4"),  # of four dimensions
        *(body.replace("3 2 0 3", row) for row in ("-3 2 0 3", "9 2 0 3", "three 2 0 3")),
        body.replace("\n3 ", "\n2 "), body.replace("\n", "\n#"),
    ]  # fmt: skip
    for number, text in enumerate(bad):
        yield f"off_{number}.off", text.encode()


def _ply() -> Iterator[tuple[str, bytes]]:
    edits = [
        ("ply\n", ""), ("ply\n", "plx\n"), ("format ascii 1.0\n", ""), ("ascii", "utf8"), ("ascii 1.0", "ascii 2.0"),
        ("end_header\n", ""), ("property float x\n", ""), ("float y", "float why"), ("float z", "quad z"),
        ("property float x", "property list uchar float x"), ("element vertex 4", "element corner 4"),
        ("element face 4", "element side 4"), ("element face 4", "element vertex 4"), ("element vertex 4\n", ""),
        ("property list uchar int vertex_indices", "property int vertex_indices"), ("vertex_indices", "neighbours"),
        ("property float z", "propriety float z"), ("property float z", "property z"),
        ("list uchar int vertex_indices", "list uchar vertex_indices"), ("face 4", "face 4.5"), ("face 4", "face 5"),
        *(("vertex 4", "vertex " + count) for count in ("four", "-4", "0", "99999999999999999999", "40", "3")),
        ("vertex 4", "vertex"), ("1.0 0.0 0.0", ""), ("1.0 0.0 0.0", "1.0 0.0 0.0 0.0"),
        *(("3 2 0 3", row) for row in ("4 2 0 3", "3 2 0 3 1", "-3 2 0 3", "three 2 0 3")),
    ]  # fmt: skip
    text = ply().decode()
    for number, (old, new) in enumerate(edits):
        assert old in text
        yield f"ply_edit_{number}.ply", text.replace(old, new, 1).encode()
        head, end, body = binary_ply().partition(b"end_header\n")
        changed = head.replace(old.replace("ascii", "binary_little_endian").encode(), new.encode(), 1)
        if changed != head and new != "ascii 2.0":
            yield f"ply_binary_edit_{number}.ply", changed + end + body
    strips = ply().replace(b"element face 4", b"element tristrips 4")
    bad = [
        b"ply\n", ply_head("ascii", 4, 4), ply_head("binary_little_endian", 4, 4),
        ply_head("ascii", 4, 4) + binary_ply().partition(b"end_header\n")[2],
        ply().replace(b"ascii", b"binary_little_endian"), binary_ply().replace(b"little", b"big"),
        binary_ply(faces=[*FACES, (0, 1, 2, 3)])[:-1], binary_ply(faces=[*FACES, (0, 1, 2, 4)]),
        binary_ply(faces=[*FACES, (0, 1, 2, -1)]), binary_ply(faces=[(0, 1), (1, 2)]), binary_ply(faces=[(), ()]),
        strips.replace(b"3 2 0 3", b"3 2 0 4"), strips.replace(b"\n3 ", b"\n4 "),
    ]  # fmt: skip
    for number, content in enumerate(bad):
        yield f"ply_{number}.ply", content


def _stl() -> Iterator[tuple[str, bytes]]:
    text = stl().decode()
    edits = [
        ("solid s\n", ""), ("endfacet\n", ""), ("endloop\n", ""), ("outer loop\n", ""), ("facet normal 0 0 0\n", ""),
        ("endloop\n", "vertex 1 1 1\nendloop\n"), ("vertex 1.0 0.0 0.0", "vertex 1.0 0.0 0.0 0.0"),
        ("solid s\n", "endsolid s\nsolid s\n"),
    ]  # fmt: skip
    bad = [
        *(binary_stl(claimed=claimed) for claimed in (0, 3, 5, 1000, 2**32 - 1)), bytes(84), bytes(40),
        b"solid" + binary_stl(claimed=9)[5:], *(text.replace(*edit, 1).encode() for edit in edits),
        b"solid s\nendsolid s\n", b"solid s\n",
    ]  # fmt: skip
    for number, content in enumerate(bad):
        yield f"stl_{number}.stl", content


NAN, INFINITE = float("nan"), float("inf")
GLTF: dict[str, list[Any]] = {
    # a place in the tree, and what stands there instead; None deletes it
    "asset": [None, []], "asset version": ["1.0", None], "scene": [7, -1, "0"],
    "scenes 0 nodes": [[], [3], [-1], [0, 0], ["a"]], "nodes": [[{"mesh": 0, "children": [1]}, {"children": [0]}]],
    "nodes 0": [{}, 5], "nodes 0 children": [[0]],
    "nodes 0 matrix": [[1, 0, 0], [NAN] * 16, [0] * 15 + [1], ["a"] * 16],
    "nodes 0 scale": [[INFINITE, 1, 1], [1e40, 1, 1], [2]], "nodes 0 translation": [["a", 0, 0], [0, 1e35, 0]],
    "nodes 0 rotation": [[0, 1]], "nodes 0 mesh": [9, -1, False], "nodes 0 skin": [3], "meshes": [None, 3],
    "meshes 0 primitives": [None, []], "meshes 0 primitives 0 mode": [0, 1, 77],
    "meshes 0 primitives 0 attributes": [None, {}], "meshes 0 primitives 0 attributes POSITION": [9, -2, 1],
    "meshes 0 primitives 0 attributes NORMAL": [9, 1], "meshes 0 primitives 0 indices": [9, -1, 0], "accessors": [None],
    "accessors 0 sparse": [{"count": 1}],
    "accessors 0 bufferView": [None, 5],  # without one all of its points are 0
    "accessors 0 type": ["VEC2"], "accessors 0 componentType": [5124, 5130],
    "accessors 0 count": [5, 2**62, 0, -4, 4.0, 3], "accessors 0 byteOffset": [4, -4], "accessors 1 count": [11, 15],
    "bufferViews": [None], "bufferViews 0 buffer": [4], "bufferViews 1 byteOffset": [1000],
    "bufferViews 0 byteOffset": [-8], "bufferViews 0 byteLength": [9999, None], "bufferViews 0 byteStride": [400, -12],
    "buffers": [None], "buffers 0 byteLength": [None, 100000, 8],
    "buffers 0 uri": [
        None, 5, "nowhere.bin", ".", "obj_blank.obj", "http://localhost/mesh.bin",
        "data:;base64,@@@@", "data:;base64,AAAA",
    ],
    "extensionsRequired": [
        ["KHR_draco_mesh_compression"], ["EXT_meshopt_compression"], ["EXT_mesh_gpu_instancing"], ["NEW_geometry"], [1],
    ],
}  # fmt: skip


def _gltf() -> Iterator[tuple[str, bytes]]:
    for path, values in GLTF.items():
        for number, value in enumerate(values):
            tree = deepcopy(gltf_tree()[0])
            *parents, last = (int(key) if key.isdigit() else key for key in path.split())
            place: Any = tree
            for key in parents:
                place = place[key]
            if value is None:
                del place[last]
            else:
                place[last] = value
            yield f"gltf_{path.replace(' ', '_')}_{number}.gltf", json.dumps(tree).encode()
    for number, text in enumerate(["null", "1", "[]", "{}", "[" * 100000]):
        yield f"gltf_json_{number}.gltf", text.encode()


def _glb() -> Iterator[tuple[str, bytes]]:
    sound = glb()
    yield "glb_magic.glb", b"glTX" + sound[4:]
    yield "glb_version.glb", sound[:4] + struct.pack("<I", 1) + sound[8:]
    yield "glb_length.glb", sound[:8] + struct.pack("<I", len(sound) + 100) + sound[12:]
    yield "glb_chunk_length.glb", sound[:12] + struct.pack("<I", 2**32 - 1) + sound[16:]
    yield "glb_chunk_kind.glb", sound[:16] + b"TEXT" + sound[20:]
    yield "glb_header_only.glb", struct.pack("<4sII", b"glTF", 2, 12)
    end = 20 + struct.unpack("<I", sound[12:16])[0]
    yield "glb_no_buffer.glb", sound[:8] + struct.pack("<I", end) + sound[12:end]
