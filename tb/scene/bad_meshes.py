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
    body = obj().decode()
    bad = {
        "only_vertices": "v 0 0 0\nv 1 0 0\nv 0 1 0\n",
        "only_faces": "f 1 2 3\n",
        "only_comments": "# a mesh\n# of nothing\n",
        "only_lines": "v 0 0 0\nv 1 0 0\nl 1 2\n",
        "only_points": "v 0 0 0\nv 1 0 0\np 1 2\n",
        "face_of_two": "v 0 0 0\nv 1 0 0\nf 1 2\nf\n",
        "continued": body + "f 1 \\\n2 x",
        "index_zero": body + "f 0 1 2\n",
        "before_the_first": body + "f -5 -1 -2\n",
        "relative_too_early": "f -3 -2 -1\n" + body,
        "normal_missing": body + "f 1//1 2//1 3//1\n",
        "normal_word": body + "vn 0 0 up\nf 1//1 2//1 3//1\n",
        "normal_short": body + "vn 0 0\n",
        "normal_relative": body + "vn 0 0 1\nf 1//-2 2//-1 3//-1\n",
        "corner_of_four": body + "f 1/1/1/1 2/1/1/1 3/1/1/1\n",
        "corner_without_point": body + "f /1 /2 /3\n",
        "corner_minus": body + "f - 1 2\n",
        "unused_nan": body + "v nan nan nan\n",
        "unused_word": body + "v a b c\n",
        "vertex_alone": body + "v\n",
        "binary_tail": body + "f 1 2 \0\n",
    }
    for name, text in bad.items():
        yield f"obj_{name}.obj", text.encode()
    yield "obj_utf16.obj", body.encode("utf-16")


def _off() -> Iterator[tuple[str, bytes]]:
    for name, counts in {
        "claims_vertices": "400 4 0",
        "claims_faces": "4 400 0",
        "claims_all": "99999999999999 99999999999999 0",
        "negative": "-4 4 0",
        "negative_faces": "4 -4 0",
        "one_count": "4",
        "words": "four four zero",
        "floats": "4.0 4.0 0.0",
        "no_counts": "",
        "too_few_vertices": "3 5 0",
        "no_vertices": "0 4 0",
        "no_faces_claimed": "4 0 0",
    }.items():
        yield f"off_{name}.off", off(counts=counts)
    body = off().decode()
    for name, text in {
        "no_magic": body.removeprefix("OFF\n"),
        "other_magic": "X" + body,
        "four_dimensions": "4" + body,
        "at_infinity": "4" + body.replace("0.0\n", "0.0 0\n"),
        "of_any_dimension": "n" + body.replace("4 4", "3\n4 4"),
        "binary": body.replace("OFF", "OFF BINARY"),
        "lower_case": body.replace("OFF", "oof"),
        "only_magic": "OFF\n",
        "counts_of_two": body.replace("\n3 ", "\n2 "),
        "count_negative": body.replace("3 2 0 3", "-3 2 0 3"),
        "count_too_large": body.replace("3 2 0 3", "9 2 0 3"),
        "count_word": body.replace("3 2 0 3", "three 2 0 3"),
        "all_comments": body.replace("\n", "\n#"),
    }.items():
        yield f"off_{name}.off", text.encode()


def _ply() -> Iterator[tuple[str, bytes]]:
    edits = {
        "no_magic": ("ply\n", ""),
        "other_magic": ("ply\n", "plx\n"),
        "no_format": ("format ascii 1.0\n", ""),
        "other_format": ("ascii", "utf8"),
        "other_version": ("ascii 1.0", "ascii 2.0"),
        "no_end": ("end_header\n", ""),
        "no_x": ("property float x\n", ""),
        "renamed_y": ("float y", "float why"),
        "unknown_type": ("float z", "quad z"),
        "list_of_x": ("property float x", "property list uchar float x"),
        "no_vertex": ("element vertex 4", "element corner 4"),
        "no_face": ("element face 4", "element side 4"),
        "no_list": ("property list uchar int vertex_indices", "property int vertex_indices"),
        "other_list": ("vertex_indices", "neighbours"),
        "property_first": ("element vertex 4\n", ""),
        "property_word": ("property float z", "propriety float z"),
        "property_short": ("property float z", "property z"),
        "list_short": ("list uchar int vertex_indices", "list uchar vertex_indices"),
        "count_word": ("vertex 4", "vertex four"),
        "count_negative": ("vertex 4", "vertex -4"),
        "count_missing": ("vertex 4", "vertex"),
        "count_float": ("face 4", "face 4.5"),
        "count_zero": ("vertex 4", "vertex 0"),
        "count_huge": ("vertex 4", "vertex 99999999999999999999"),
        "more_vertices": ("vertex 4", "vertex 40"),
        "more_faces": ("face 4", "face 5"),
        "fewer_vertices": ("vertex 4", "vertex 3"),
        "twice": ("element face 4", "element vertex 4"),
        "list_too_long": ("3 2 0 3", "4 2 0 3"),
        "list_too_short": ("3 2 0 3", "3 2 0 3 1"),
        "list_negative": ("3 2 0 3", "-3 2 0 3"),
        "list_word": ("3 2 0 3", "three 2 0 3"),
        "blank_row": ("1.0 0.0 0.0", ""),
        "extra_number": ("1.0 0.0 0.0", "1.0 0.0 0.0 0.0"),
    }
    text = ply().decode()
    for name, (old, new) in edits.items():
        assert old in text
        yield f"ply_{name}.ply", text.replace(old, new, 1).encode()
        head, end, body = binary_ply().partition(b"end_header\n")
        changed = head.replace(old.replace("ascii", "binary_little_endian").encode(), new.encode(), 1)
        if changed != head and name != "other_version":
            yield f"ply_binary_{name}.ply", changed + end + body
    yield "ply_only_magic.ply", b"ply\n"
    yield "ply_only_header.ply", ply_head("ascii", 4, 4)
    yield "ply_only_binary_header.ply", ply_head("binary_little_endian", 4, 4)
    yield "ply_binary_as_text.ply", ply_head("ascii", 4, 4) + binary_ply().partition(b"end_header\n")[2]
    yield "ply_text_as_binary.ply", ply().replace(b"ascii", b"binary_little_endian")
    yield "ply_wrong_order.ply", binary_ply().replace(b"little", b"big")
    yield "ply_mixed_cut.ply", binary_ply(faces=[*FACES, (0, 1, 2, 3)])[:-1]
    yield "ply_mixed_index.ply", binary_ply(faces=[*FACES, (0, 1, 2, 4)])
    yield "ply_mixed_negative.ply", binary_ply(faces=[*FACES, (0, 1, 2, -1)])
    strips = ply().replace(b"element face 4", b"element tristrips 4")
    yield "ply_strips_index.ply", strips.replace(b"3 2 0 3", b"3 2 0 4")
    yield "ply_strips_short.ply", strips.replace(b"\n3 ", b"\n4 ")
    yield "ply_binary_face_of_two.ply", binary_ply(faces=[(0, 1), (1, 2)])
    yield "ply_binary_face_of_none.ply", binary_ply(faces=[(), ()])


def _stl() -> Iterator[tuple[str, bytes]]:
    for claimed in (0, 3, 5, 1000, 2**32 - 1):
        yield f"stl_claims_{claimed}.stl", binary_stl(claimed=claimed)
    yield "stl_header_only.stl", bytes(84)
    yield "stl_half_header.stl", bytes(40)
    yield "stl_solid_binary.stl", b"solid" + binary_stl(claimed=9)[5:]
    edits = {
        "no_begin": ("solid s\n", ""),
        "no_endfacet": ("endfacet\n", ""),
        "no_endloop": ("endloop\n", ""),
        "no_outer": ("outer loop\n", ""),
        "no_facet": ("facet normal 0 0 0\n", ""),
        "four_vertices": ("endloop\n", "vertex 1 1 1\nendloop\n"),
        "four_numbers": ("vertex 1.0 0.0 0.0", "vertex 1.0 0.0 0.0 0.0"),
        "end_first": ("solid s\n", "endsolid s\nsolid s\n"),
    }
    text = stl().decode()
    for name, (old, new) in edits.items():
        yield f"stl_{name}.stl", text.replace(old, new, 1).encode()
    yield "stl_nothing_inside.stl", b"solid s\nendsolid s\n"
    yield "stl_solid_only.stl", b"solid s\n"


def _gltf() -> Iterator[tuple[str, bytes]]:
    """Each change is a path into the tree and what stands there instead; None deletes it."""
    changes: dict[str, tuple[tuple[str | int, ...], Any]] = {
        "no_asset": (("asset",), None),
        "asset_list": (("asset",), []),
        "version_1": (("asset", "version"), "1.0"),
        "version_none": (("asset", "version"), None),
        "scene_missing": (("scene",), 7),
        "scene_negative": (("scene",), -1),
        "scene_word": (("scene",), "0"),
        "scene_empty": (("scenes", 0, "nodes"), []),
        "node_missing": (("scenes", 0, "nodes"), [3]),
        "node_negative": (("scenes", 0, "nodes"), [-1]),
        "node_twice": (("scenes", 0, "nodes"), [0, 0]),
        "node_word": (("scenes", 0, "nodes"), ["a"]),
        "node_without_mesh": (("nodes", 0), {}),
        "node_own_child": (("nodes", 0, "children"), [0]),
        "node_number": (("nodes", 0), 5),
        "matrix_short": (("nodes", 0, "matrix"), [1, 0, 0]),
        "matrix_nan": (("nodes", 0, "matrix"), [float("nan")] * 16),
        "matrix_zero": (("nodes", 0, "matrix"), [0] * 15 + [1]),
        "matrix_words": (("nodes", 0, "matrix"), ["a"] * 16),
        "scale_infinite": (("nodes", 0, "scale"), [float("inf"), 1, 1]),
        "scale_huge": (("nodes", 0, "scale"), [1e40, 1, 1]),
        "scale_short": (("nodes", 0, "scale"), [2]),
        "translation_word": (("nodes", 0, "translation"), ["a", 0, 0]),
        "translation_huge": (("nodes", 0, "translation"), [0, 1e35, 0]),
        "rotation_short": (("nodes", 0, "rotation"), [0, 1]),
        "mesh_missing": (("nodes", 0, "mesh"), 9),
        "mesh_negative": (("nodes", 0, "mesh"), -1),
        "mesh_bool": (("nodes", 0, "mesh"), False),
        "no_meshes": (("meshes",), None),
        "meshes_number": (("meshes",), 3),
        "no_primitives": (("meshes", 0, "primitives"), None),
        "empty_primitives": (("meshes", 0, "primitives"), []),
        "mode_points": (("meshes", 0, "primitives", 0, "mode"), 0),
        "mode_lines": (("meshes", 0, "primitives", 0, "mode"), 1),
        "mode_unknown": (("meshes", 0, "primitives", 0, "mode"), 77),
        "no_attributes": (("meshes", 0, "primitives", 0, "attributes"), None),
        "no_position": (("meshes", 0, "primitives", 0, "attributes"), {}),
        "position_missing": (("meshes", 0, "primitives", 0, "attributes", "POSITION"), 9),
        "position_negative": (("meshes", 0, "primitives", 0, "attributes", "POSITION"), -2),
        "position_scalar": (("meshes", 0, "primitives", 0, "attributes", "POSITION"), 1),
        "normal_missing": (("meshes", 0, "primitives", 0, "attributes", "NORMAL"), 9),
        "normal_scalar": (("meshes", 0, "primitives", 0, "attributes", "NORMAL"), 1),
        "indices_missing": (("meshes", 0, "primitives", 0, "indices"), 9),
        "indices_negative": (("meshes", 0, "primitives", 0, "indices"), -1),
        "indices_vec3": (("meshes", 0, "primitives", 0, "indices"), 0),
        "no_accessors": (("accessors",), None),
        "accessor_sparse": (("accessors", 0, "sparse"), {"count": 1}),
        "accessor_empty": (("accessors", 0, "bufferView"), None),  # all of its points are 0
        "accessor_view": (("accessors", 0, "bufferView"), 5),
        "accessor_type": (("accessors", 0, "type"), "VEC2"),
        "accessor_component": (("accessors", 0, "componentType"), 5124),
        "accessor_double": (("accessors", 0, "componentType"), 5130),
        "accessor_count_large": (("accessors", 0, "count"), 5),
        "accessor_count_huge": (("accessors", 0, "count"), 2**62),
        "accessor_count_zero": (("accessors", 0, "count"), 0),
        "accessor_count_negative": (("accessors", 0, "count"), -4),
        "accessor_count_float": (("accessors", 0, "count"), 4.0),
        "accessor_count_small": (("accessors", 0, "count"), 3),
        "accessor_offset": (("accessors", 0, "byteOffset"), 4),
        "accessor_offset_negative": (("accessors", 0, "byteOffset"), -4),
        "corners_not_by_three": (("accessors", 1, "count"), 11),
        "index_count_large": (("accessors", 1, "count"), 15),
        "view_buffer": (("bufferViews", 0, "buffer"), 4),
        "view_offset": (("bufferViews", 1, "byteOffset"), 1000),
        "view_offset_negative": (("bufferViews", 0, "byteOffset"), -8),
        "view_length": (("bufferViews", 0, "byteLength"), 9999),
        "view_no_length": (("bufferViews", 0, "byteLength"), None),
        "view_stride": (("bufferViews", 0, "byteStride"), 400),
        "view_stride_zero": (("bufferViews", 0, "byteStride"), -12),
        "no_views": (("bufferViews",), None),
        "no_buffers": (("buffers",), None),
        "buffer_no_uri": (("buffers", 0, "uri"), None),
        "buffer_no_length": (("buffers", 0, "byteLength"), None),
        "buffer_length_large": (("buffers", 0, "byteLength"), 100000),
        "buffer_length_small": (("buffers", 0, "byteLength"), 8),
        "buffer_file_missing": (("buffers", 0, "uri"), "nowhere.bin"),
        "buffer_file_directory": (("buffers", 0, "uri"), "."),
        "buffer_file_short": (("buffers", 0, "uri"), "obj_blank.obj"),
        "buffer_remote": (("buffers", 0, "uri"), "http://localhost/mesh.bin"),
        "buffer_uri_number": (("buffers", 0, "uri"), 5),
        "buffer_base64_damaged": (("buffers", 0, "uri"), "data:;base64,@@@@"),
        "buffer_base64_short": (("buffers", 0, "uri"), "data:;base64,AAAA"),
        "extension_draco": (("extensionsRequired",), ["KHR_draco_mesh_compression"]),
        "extension_meshopt": (("extensionsRequired",), ["EXT_meshopt_compression"]),
        "extension_instances": (("extensionsRequired",), ["EXT_mesh_gpu_instancing"]),
        "extension_unknown": (("extensionsRequired",), ["NEW_geometry"]),
        "skin_missing": (("nodes", 0, "skin"), 3),
        "extension_number": (("extensionsRequired",), [1]),
    }
    for name, (path, value) in changes.items():
        tree = deepcopy(gltf_tree()[0])
        *parents, last = path
        place: Any = tree
        for key in parents:
            place = place[key]
        if value is None:
            del place[last]
        else:
            place[last] = value
        yield f"gltf_{name}.gltf", json.dumps(tree).encode()
    cycle = gltf_tree()[0]
    cycle["nodes"] = [{"mesh": 0, "children": [1]}, {"children": [0]}]
    yield "gltf_node_cycle.gltf", json.dumps(cycle).encode()
    for name, text in {"null": "null", "number": "1", "list": "[]", "object": "{}", "deep": "[" * 100000}.items():
        yield f"gltf_json_{name}.gltf", text.encode()


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
