"""Meshes: what the formats say, what is repaired, and the two meshes that need no file."""

import base64
import json
import struct
from importlib.metadata import PackageNotFoundError
from pathlib import Path

import numpy as np
import pytest
from polyshade.sim.errors import UserError
from polyshade.sim.scene import head as head_module
from polyshade.sim.scene.mesh import Mesh, Reading, load_mesh
from polyshade.sim.scene.normals import vertex_normals

from tb.scene.bad_meshes import FACES, POINTS, WRITERS, binary_ply, binary_stl, gltf_tree, obj, off, ply, stl
from tb.scene.shapes import CUBE, SIDES

PLANE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


@pytest.fixture
def load(tmp_path: Path):
    def loader(text: str | bytes, suffix: str = "obj", subdivide: int = 0, **options) -> Mesh:
        path = tmp_path / f"mesh.{suffix}"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return load_mesh(str(path), subdivide, Reading(subdivide, **options))

    return loader


def triangles(mesh: Mesh) -> set[tuple]:
    """The triangles as sets of corners in order, whatever vertex is named first."""
    rolled = (np.roll(mesh.vertices[face], k, axis=0) for face in mesh.faces for k in range(3))
    return {tuple(map(tuple, corners.tolist())) for corners in rolled}


def closed(mesh: Mesh) -> bool:
    """Whether every edge, by the places of its ends, is used once in each direction."""
    _, place = np.unique(mesh.vertices, axis=0, return_inverse=True)
    corners = place.reshape(-1)[mesh.faces]
    edges = [(a, b) for k in range(3) for a, b in zip(corners[:, k].tolist(), corners[:, k - 2].tolist(), strict=True)]
    return sorted(edges) == sorted((b, a) for a, b in edges)


def test_formats_agree(load) -> None:
    expected = None
    for suffix, writers in WRITERS.items():
        for writer in writers:
            mesh = load(writer(), suffix)
            expected = expected or triangles(mesh)
            assert triangles(mesh) == expected
            assert mesh.name == "mesh"
            assert mesh.faces.dtype == np.int32
            assert mesh.repairs["absent_normals"] == 4


# Repairs.


def test_absent_normals_are_weighted_by_angle(load) -> None:
    # A cube: whatever diagonal cuts its sides, each corner sees three right angles.
    cut = [side[i:] + side[:i] for i, side in zip((0, 1, 0, 1, 1, 0), SIDES, strict=True)]
    mesh = load(off(CUBE, [t for a, b, c, d in cut for t in ((a, b, c), (a, c, d))]), "off", crease=180)
    assert np.allclose(mesh.normals, np.sign(mesh.vertices) / np.sqrt(3))
    assert mesh.repairs == {"absent_normals": 8}


def test_opposite_faces_do_not_leave_a_vertex_without_normal() -> None:
    vertices = np.array([(0.0, 0, 0), (1, 0, 0), (0, 1, 0)])
    normals = vertex_normals(vertices, np.array([(0, 1, 2), (0, 2, 1)]))
    assert np.allclose(np.abs(normals), (0, 0, 1))


def test_normals_of_the_file_are_kept(load) -> None:
    text = PLANE + "vn 0 0.6 0.8\nvn 0 0 2\nvn 0 0 0\nf 1//1 2//2 3//3 4//1\n"
    mesh = load(text)
    at = {tuple(v): n for v, n in zip(mesh.vertices.tolist(), mesh.normals, strict=True)}
    assert np.allclose(at[0.0, 0.0, 0.0], (0, 0.6, 0.8))
    assert np.allclose(at[1.0, 0.0, 0.0], (0, 0, 1))
    assert np.allclose(at[1.0, 1.0, 0.0], (0, 0, 1))  # from the faces
    assert mesh.repairs == {"polygons": 1, "zero_normals": 1, "non_unit_normals": 1}


def test_a_vertex_with_two_normals_is_two_vertices(load) -> None:
    mesh = load(PLANE + "vn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//2 3//2 4//2\n")
    assert len(mesh.vertices) == 6
    assert sorted(set(map(tuple, mesh.normals.tolist()))) == [(0, 0, 1), (0, 1, 0)]


def test_only_absent_normals_are_computed(load) -> None:
    mesh = load(PLANE + "vn 0 1 0\nf 1//1 2//1 3//1\nf 1 3 4\n")
    assert np.allclose(mesh.normals[mesh.faces[0]], (0, 1, 0))
    assert np.allclose(mesh.normals[mesh.faces[1]], (0, 0, 1))
    assert mesh.repairs == {"absent_normals": 3}


@pytest.mark.parametrize("order", ["<", ">"])
def test_ply_normals_and_other_properties(load, order: str) -> None:
    form = "binary_little_endian" if order == "<" else "binary_big_endian"
    properties = ("double x", "double y", "double z", "float nx", "float ny", "float nz", "uchar quality")
    rows = [
        f"ply\nformat {form} 1.0\ncomment caf\N{LATIN SMALL LETTER E WITH ACUTE}\nelement vertex 4",
        *(f"property {name}" for name in properties),
        "element face 4\nproperty uchar flag\nproperty list ushort uint vertex_index",
        "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n",
    ]
    head = "\n".join(rows)
    body = b"".join(struct.pack(order + "3d3fB", *p, 0, 0, 1, 7) for p in POINTS)
    body += b"".join(struct.pack(order + "BH3I", 1, 3, *f) for f in FACES) + struct.pack(order + "2i", 0, 1)
    mesh = load(head.encode("latin-1") + body, "ply")
    assert triangles(mesh) == triangles(load(obj()))
    assert np.allclose(mesh.normals, (0, 0, 1))
    assert mesh.repairs == {}


def test_polygons(load) -> None:
    hexagon = [(np.cos(k * np.pi / 3), np.sin(k * np.pi / 3), 0.0) for k in range(6)]
    for name, mesh in {
        "obj": load(obj(hexagon, [range(6)])),
        "off": load(off(hexagon, [tuple(range(6))]), "off"),
    }.items():
        assert len(mesh.faces) == 4, name
        assert mesh.repairs["polygons"] == 3, name
        assert np.allclose(mesh.normals, (0, 0, 1)), name
    square = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)]
    for writer in (ply, binary_ply):
        mesh = load(writer(square, [(0, 1, 2, 3)]), "ply")
        assert len(mesh.faces) == 2
        assert mesh.repairs["polygons"] == 1
    mixed = [*square, (2.0, 0.5, 0.0)]
    for writer, suffix in ((ply, "ply"), (off, "off"), (obj, "obj")):
        mesh = load(writer(mixed, [(0, 1, 2, 3), (1, 4, 2)]), suffix)
        assert len(mesh.faces) == 3
        assert mesh.repairs["polygons"] == 1


def test_stl_is_welded(load) -> None:
    for writer in (stl, binary_stl):
        mesh = load(writer(), "stl")
        assert mesh.repairs == {"welded_vertices": 8, "absent_normals": 4}
        assert closed(mesh)
        assert len(load(writer(), "stl", crease=180).vertices) == 4


def test_faces_without_area_are_dropped(load) -> None:
    mesh = load(PLANE + "v 2 0 0\nf 1 2 3\nf 1 2 5\nf 1 1 3\nf 4 4 4\n")
    assert mesh.repairs == {"zero_area_triangles": 3, "unused_vertices": 2, "absent_normals": 3}
    assert len(mesh.faces) == 1


def test_small_is_not_flat(load) -> None:
    """A triangle counts as flat by its own proportions, however small it or the whole mesh is."""
    tiny = load("v 0 0 0\nv 1e-150 0 0\nv 0 1e-150 0\nf 1 2 3\n")
    assert np.allclose(tiny.normals, (0, 0, 1))
    beside = load("v 0 0 0\nv 1e-30 0 0\nv 0 1e-30 0\nv 1 1 1\nv 2 1 1\nv 1 2 1\nf 1 2 3\nf 4 5 6\n")
    assert len(beside.faces) == 2
    assert np.allclose(np.linalg.norm(beside.normals, axis=1), 1)


# Formats.


def test_obj_dialects(load) -> None:
    expected = triangles(load(PLANE + "f 1 2 3\nf 1 3 4\n"))
    for text in (
        PLANE + "f 1/1 2/2 3/3\nf 1/1/ 3// 4/\n",
        PLANE + "f -4 -3 -2\nf -4 -2 -1\n",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 0 1 0\nf 1 3 -1\n",  # relative to the face, not to the file's end
        "f 1 2 3\nf 1 3 4\n" + PLANE,
        PLANE.replace("\n", "\r\n") + "f 1 2 3\r\nf 1 3 4\r\n",
        PLANE.replace("\n", "\r") + "f 1 2 3\rf 1 3 4\r",
        PLANE + "f 1 \\\n 2 \\\n 3\nf 1 3 4",
        "mtllib none.mtl\no a\ng b\ns 1\nusemtl c\n" + PLANE + "vt 0 0\nl 1 2\np 3\nf 1 2 3 # first\nf 1 3 4\n#end",
        PLANE.replace("v 0 0 0", "v  0.0\t0 0e0 0.5 0.5 0.5") + "f +1 +2 +3\nf 1 3 4\n",
        "# caf\N{LATIN SMALL LETTER E WITH ACUTE}\n" + PLANE + "f 1 2 3\nf 1 3 4\n",
    ):
        assert triangles(load(text.encode("latin-1"))) == expected


def test_off_dialects(load) -> None:
    expected = triangles(load(off(), "off"))
    text = off().decode()
    for variant in (
        text.replace("OFF\n", "OFF "),
        text.replace("OFF\n", "# by hand\nOFF # magic\n\n"),
        text.replace("4 4 0", "4 4"),
        text.replace("OFF", "COFF").replace("1.0 0.0 0.0", "1.0 0.0 0.0 255 0 0 255"),
        text.replace("3 2 0 3", "3 2 0 3 0.5 0.5 0.5"),
        text.replace("\n", "\r\n") + "\n\n",
    ):
        assert triangles(load(variant, "off")) == expected


def test_stl_dialects(load) -> None:
    expected = triangles(load(stl(), "stl"))
    text = stl().decode()
    half = [("a", FACES[:2]), ("b", FACES[2:])]
    for variant in (
        text.upper().encode(),
        text.replace("\n", "\r\n    ").encode(),
        text.replace("solid s", "solid caf\N{LATIN SMALL LETTER E WITH ACUTE}").encode("latin-1"),
        b"".join(stl(faces=faces).replace(b"solid s", b"solid " + name.encode()) for name, faces in half),
        b"solid" + binary_stl()[5:],  # binary all the same
    ):
        assert triangles(load(variant, "stl")) == expected


def test_gltf_places_its_parts(load) -> None:
    tree, _ = gltf_tree()
    tree["scenes"] = [{"nodes": [0, 2]}]
    tree["nodes"] = [
        {"translation": [10, 0, 0], "children": [1]},
        {"mesh": 0, "scale": [2, 3, 4]},
        {"mesh": 0, "scale": [-1, 1, 1]},  # mirrored: its faces must be turned to stay outside
    ]
    mesh = load(json.dumps(tree), "gltf")
    assert len(mesh.faces) == 8
    assert closed(mesh)
    a, b, c = mesh.vertices[mesh.faces].transpose(1, 0, 2)
    volumes = (np.cross(a, b) * c).sum(axis=1) / 6
    assert np.isclose(volumes.sum(), 24 / 6 + 1 / 6)
    assert mesh.vertices.max(axis=0).tolist() == [12, 3, 4]
    assert mesh.vertices.min(axis=0).tolist() == [-1, 0, 0]


def test_gltf_normals_follow_their_part(load) -> None:
    tree, data = gltf_tree(uri=False)
    tree["accessors"].append({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"})
    tree["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 2
    points = [(0.0, 0.0, 1.0), (0.6, 0.0, 0.8), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)]  # unit: they serve as both
    moved = b"".join(struct.pack("<3f", *p) for p in points) + data[48:]
    uri = "data:application/octet-stream;base64," + base64.b64encode(moved).decode()
    tree["buffers"] = [{"byteLength": len(moved), "uri": uri}]
    plain = load(json.dumps(tree), "gltf")
    assert np.allclose(plain.normals, points)
    assert plain.repairs == {}
    tree["nodes"] = [{"mesh": 0, "scale": [1, 1, 4]}]  # a stretched surface's normals lean the other way
    leaning = load(json.dumps(tree), "gltf")
    assert np.allclose(leaning.normals[1], np.array([0.6, 0, 0.2]) / np.hypot(0.6, 0.2))
    assert leaning.repairs == {}


def test_gltf_with_a_buffer_beside_it(tmp_path: Path) -> None:
    tree, data = gltf_tree(uri=False)
    tree["buffers"][0]["uri"] = "the%20data.bin"
    (tmp_path / "the data.bin").write_bytes(data)
    (tmp_path / "mesh.gltf").write_text(json.dumps(tree))
    assert len(load_mesh(str(tmp_path / "mesh.gltf")).faces) == 4


# Subdivision of files.


def test_subdivide_a_file(load) -> None:
    mesh = load(off(CUBE, SIDES), "off", subdivide=2)
    assert len(mesh.faces) == 6 * 8 * 4  # of quads
    assert closed(mesh)
    assert (np.abs(mesh.vertices) < 1).all()
    assert (mesh.vertices * mesh.normals).sum(axis=1).min() > 0
    turned = np.roll(mesh.vertices, 1, axis=1)  # as round as the cube: a diagonal would show
    assert np.isclose(np.sort(turned, axis=0), np.sort(mesh.vertices, axis=0)).all()
    rows = stl()
    assert closed(load(rows, "stl", subdivide=1))


def test_too_many_triangles(load, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("polyshade.sim.scene.mesh.MOST_TRIANGLES", 95)
    assert len(load(obj(), subdivide=1).faces) == 24
    with pytest.raises(UserError, match=r"mesh\.obj: at --subdivide 2 it has 96 triangles, allowed are 95$"):
        load(obj(), subdivide=2)


# The meshes that need no file.


@pytest.mark.parametrize("steps", [0, 1, 2])
def test_sphere(steps: int) -> None:
    sphere = load_mesh("sphere", steps)
    assert len(sphere.faces) == 320 * 4**steps
    assert closed(sphere)
    assert np.allclose(np.linalg.norm(sphere.vertices, axis=1), 1, atol=1e-15)
    assert np.array_equal(sphere.vertices, sphere.normals)
    facing = np.cross(*(sphere.vertices[sphere.faces[:, k]] - sphere.vertices[sphere.faces[:, 0]] for k in (1, 2)))
    assert ((facing * sphere.vertices[sphere.faces[:, 0]]).sum(axis=1) > 0).all()


@pytest.mark.parametrize(("steps", "least", "most"), [(0, 8_000, 10_000), (1, 32_000, 40_000)])
def test_head(steps: int, least: int, most: int) -> None:
    head = load_mesh("head", steps)
    assert least <= len(head.faces) <= most
    assert closed(head)
    assert head.repairs == {}
    assert np.allclose(np.linalg.norm(head.normals, axis=1), 1)
    a, b, c = head.vertices[head.faces].transpose(1, 0, 2)
    face_normals = np.cross(b - a, c - a)
    assert np.linalg.norm(face_normals, axis=1).min() > 0
    assert (np.cross(a, b) * c).sum() > 0  # turned outwards
    # Of a fine mesh hardly a face turns away from the normals at its corners.
    assert ((face_normals[:, None] * head.normals[head.faces]).sum(axis=2) > 0).mean() > 0.99


def test_the_head_looks_ahead_and_is_symmetric() -> None:
    head = load_mesh("head")
    low, high = head.vertices.min(axis=0), head.vertices.max(axis=0)
    tip = head.vertices[head.vertices[:, 2].argmax()]  # of the nose
    assert abs(tip[0]) < 0.02
    assert low[1] + 0.4 * (high - low)[1] < tip[1] < low[1] + 0.7 * (high - low)[1]
    mirrored = head.vertices * (-1, 1, 1)
    distance = [np.abs(head.vertices - v).sum(axis=1).min() for v in mirrored[::97]]
    assert max(distance) < 0.03


def test_head_without_its_data(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def missing(name: str) -> None:
        raise PackageNotFoundError(name)

    monkeypatch.setattr(head_module, "distribution", missing)
    with pytest.raises(UserError, match=r"^--mesh head: .* run `make setup`$"):
        load_mesh("head")

    class Empty:
        def locate_file(self, name: str) -> Path:
            return tmp_path / name

    monkeypatch.setattr(head_module, "distribution", lambda name: Empty())
    with pytest.raises(UserError, match=r"^--mesh head: .* run `make setup`$"):
        load_mesh("head")
