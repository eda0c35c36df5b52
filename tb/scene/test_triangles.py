# SPDX-License-Identifier: Apache-2.0
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
    first = np.flatnonzero(np.r_[True, t[1:] != t[:-1]])
    dx, dy = triangles.column + step - triangles.column[first][t], triangles.line - triangles.line[first][t]
    dcolumn = triangles.dcolumn * np.exp2(-triangles.dcolumn_exp)[:, None]
    dline = triangles.dline * np.exp2(-triangles.dline_exp)[:, None]
    whole = triangles.normal[t] + dx[:, None] * dcolumn[t] + dy[:, None] * dline[t]
    return whole / (1 << k.INTENSITY_F)


def test_normals_at_both_ends_of_every_run() -> None:
    spans = spans_of("head", 128)
    triangles = Triangles.of(spans)
    last = triangles.count - 1
    assert np.abs(normal_at(triangles, 0 * last) - spans.normal).max() < 6e-5
    assert np.abs(normal_at(triangles, last) - spans.normal - last[:, None] * spans.gradient).max() < 6e-5


def test_boxes_hold_their_runs_and_runs_go_down() -> None:
    triangles = Triangles.of(spans_of("head", 128))
    t = triangles.triangle
    same = t[1:] == t[:-1]
    first = np.flatnonzero(np.r_[True, ~same])
    columns, lines, left = triangles.box[t].T
    column, line = triangles.column[first][t] - left, triangles.line[first][t]
    assert np.all((column <= triangles.column) & (triangles.column + triangles.count <= column + columns))
    assert np.all((line <= triangles.line) & (triangles.line < line + lines))
    assert np.all(np.diff(triangles.line)[same] > 0)
    assert triangles.last.sum() == len(triangles.normal)


def test_increments_fit() -> None:
    triangles = Triangles.of(spans_of("head", 128))
    parts = (triangles.dcolumn, triangles.dcolumn_exp), (triangles.dline, triangles.dline_exp)
    for (increment, exponent), size in zip(parts, triangles.box.T[:2], strict=True):
        power = np.exp2(np.floor(np.log2(np.maximum(size - 1, 1))))
        largest = np.abs(increment).max(axis=1)
        assert np.all(largest * power / np.exp2(exponent) < 2 << k.INTENSITY_F)
        assert np.all((largest >= (1 << k.INTENSITY_F) - 2) | (exponent == 15))  # no bit is lost
        assert not increment[size == 1].any()


def test_slivers_are_one_triangle_for_each_run() -> None:
    """A sliver along the diagonal: 64 pixels, an increment of 16 per column."""
    xy = np.array([[0.0, 0.0], [64.0, 64.03125], [64.0, 63.96875]])
    normals = np.eye(3)
    screen = Screen(xy=xy, depth=np.zeros(3), normals=normals)
    spans = scan_convert(screen, np.array([[0, 1, 2]], np.int32), 64, cull=False)
    triangles = Triangles.of(spans)
    assert len(spans) == len(triangles.normal) > 8
    assert np.abs(normal_at(triangles, 0 * spans.x) - spans.normal).max() < 6e-5
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
        box, *vectors = (int(beat) for beat in beats[first : first + 4])
        columns, lines, left = triangles.box[t].tolist()
        assert box == columns | lines << 16 | left << 32 | int(triangles.tag[t]) << 48
        parts = (triangles.normal, 0 * triangles.tag), (triangles.dcolumn, triangles.dcolumn_exp)
        for beat, (vector, exponent) in zip(vectors, (*parts, (triangles.dline, triangles.dline_exp)), strict=True):
            assert [beat >> 18 * i & 0x3FFFF for i in range(3)] == (vector[t] & 0x3FFFF).tolist()
            assert beat >> 54 == exponent[t]
        words = beats[first + 4 : end].view("<u4")
        runs = np.flatnonzero(triangles.triangle == t)
        assert words[::2].tolist() == (triangles.column[runs] | triangles.line[runs] << 16).tolist()
        assert words[1::2].tolist() == triangles.count[runs].tolist()
