"""Packets of triangles and runs say of every pixel what the spans say: its place and its normal."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.sim.scene.camera import Camera, Screen
from polyshade.sim.scene.mesh import load_mesh
from polyshade.sim.scene.raster import Spans, scan_convert
from polyshade.sim.scene.triangles import Triangles


def spans_of(mesh: str, size: int) -> Spans:
    loaded = load_mesh(mesh, 0)
    return scan_convert(Camera(size).project(loaded), loaded.faces, size)


def normal_at(triangles: Triangles, step: np.ndarray) -> np.ndarray:
    """The normals so many columns behind the first pixels of the runs, by the packets alone."""
    t = triangles.triangle
    dx, dy = triangles.column + step - triangles.box[t, 0], triangles.line - triangles.box[t, 1]
    whole = triangles.normal[t] + dx[:, None] * triangles.dcolumn[t] + dy[:, None] * triangles.dline[t]
    return whole / (1 << k.STEP_F)


def test_normals_at_both_ends_of_every_run() -> None:
    spans = spans_of("head", 128)
    triangles = Triangles.of(spans)
    last = triangles.count - 1
    assert np.abs(normal_at(triangles, 0 * last) - spans.normal).max() < 1e-6
    assert np.abs(normal_at(triangles, last) - spans.normal - last[:, None] * spans.gradient).max() < 1e-6


def test_boxes_hold_their_runs_and_runs_go_down() -> None:
    triangles = Triangles.of(spans_of("head", 128))
    column, line, columns, lines, left = triangles.box[triangles.triangle].T
    column = column - left
    assert np.all((column <= triangles.column) & (triangles.column + triangles.count <= column + columns))
    assert np.all((line <= triangles.line) & (triangles.line < line + lines))
    same = triangles.triangle[1:] == triangles.triangle[:-1]
    assert np.all(np.diff(triangles.line)[same] > 0)
    assert triangles.last.sum() == len(triangles.normal)
    first = np.r_[True, ~same]
    assert np.array_equal(triangles.box[:, 0], triangles.column[first])
    assert np.array_equal(triangles.box[:, 1], triangles.line[first])


def test_increments_fit() -> None:
    triangles = Triangles.of(spans_of("head", 128))
    for increment, size in zip((triangles.dcolumn, triangles.dline), triangles.box.T[2:4], strict=True):
        power = np.exp2(np.floor(np.log2(np.maximum(size - 1, 1))))[:, None]
        assert np.abs(increment * power).max() < 2 << k.STEP_F
        assert not increment[size == 1].any()


def test_slivers_are_one_triangle_for_each_run() -> None:
    """A sliver along the diagonal: 64 pixels, an increment of 16 per column."""
    xy = np.array([[0.0, 0.0], [64.0, 64.03125], [64.0, 63.96875]])
    normals = np.eye(3)
    screen = Screen(xy=xy, depth=np.zeros(3), normals=normals)
    spans = scan_convert(screen, np.array([[0, 1, 2]], np.int32), 64, cull=False)
    triangles = Triangles.of(spans)
    assert len(spans) == len(triangles.normal) > 8
    assert np.abs(normal_at(triangles, 0 * spans.x) - spans.normal).max() < 1e-6
    assert not triangles.dline.any()


def test_nothing_seen_is_no_packet() -> None:
    screen = Screen(xy=np.zeros((3, 2)), depth=np.zeros(3), normals=np.eye(3))
    triangles = Triangles.of(scan_convert(screen, np.array([[0, 1, 2]], np.int32), 16))
    assert [len(part) for part in triangles.stream().values()] == [0, 0]


def test_a_packet_is_a_triangle_and_its_runs() -> None:
    triangles = Triangles.of(spans_of("head", 128))
    beats, last = triangles.stream().values()
    ends = np.flatnonzero(last) + 1
    assert len(ends) == len(triangles.normal)
    for t, (first, end) in enumerate(zip(np.r_[0, ends[:-1]], ends, strict=True)):
        words = beats[first:end].view("<u4")
        assert words[:9].astype(np.int32).tolist() == [
            *triangles.normal[t], *triangles.dcolumn[t], *triangles.dline[t]
        ]  # fmt: skip
        column, line, columns, lines, left = triangles.box[t]
        assert words[9:12].tolist() == [column | line << 16, columns | lines << 16, triangles.tag[t] | left << 16]
        runs = np.flatnonzero(triangles.triangle == t)
        assert words[12::2].tolist() == (triangles.column[runs] | triangles.line[runs] << 16).tolist()
        assert words[13::2].tolist() == triangles.count[runs].tolist()
