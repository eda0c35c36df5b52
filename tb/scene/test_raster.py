# SPDX-License-Identifier: Apache-2.0
"""Scan conversion: answers worked out by hand, exact coverage, and the z-buffer."""

from collections.abc import Iterator

import numpy as np
import pytest
from numpy.typing import NDArray
from polyshade.sim.scene import raster
from polyshade.sim.scene.camera import Camera, Screen
from polyshade.sim.scene.mesh import load_mesh
from polyshade.sim.scene.raster import REACH, SUBPIXELS, Spans, expand, portions, resolve, scan_convert, snap


def screen(xy: object, depth: object = None, normals: object = None) -> Screen:
    points = np.array(xy, dtype=np.float64)
    return Screen(
        xy=points,
        depth=np.zeros(len(points)) if depth is None else np.array(depth, dtype=np.float64),
        normals=np.tile([0.0, 0.0, 1.0], (len(points), 1)) if normals is None else np.array(normals, dtype=np.float64),
    )


def runs(spans: Spans) -> list[tuple[int, int, int, int]]:
    return list(zip(*(a.tolist() for a in (spans.triangle, spans.y, spans.x, spans.count)), strict=True))


def coverage(spans: Spans, size: int, weight: NDArray[np.int64] | None = None) -> NDArray[np.int64]:
    """How often each place of the frame is covered, each triangle counted by its weight."""
    pixels = expand(spans, size)
    each = np.ones(len(pixels.span)) if weight is None else weight[spans.triangle[pixels.span]]
    return np.bincount(pixels.place, each, size * size).astype(np.int64)


def test_diagonal_goes_to_one_side() -> None:
    # The diagonal of the 4 x 4 square passes through the centres (3.5, 0.5), (2.5, 1.5), ...: it is the right edge of
    # the upper triangle and the left edge of the lower one, so the lower one owns them.
    square = screen([(0, 0), (4, 0), (4, 4), (0, 4)])
    spans = scan_convert(square, np.array([(0, 3, 1), (1, 3, 2)]), 8)
    upper = [(0, 0, 0, 3), (0, 1, 0, 2), (0, 2, 0, 1)]
    lower = [(1, 0, 3, 1), (1, 1, 2, 2), (1, 2, 1, 3), (1, 3, 0, 4)]
    assert runs(spans) == upper + lower


def test_edges_through_centres_belong_to_top_and_left() -> None:
    # A square with all four sides on pixel centres, in two triangles: its top and left sides are in, the others out.
    square = screen([(1.5, 1.5), (4.5, 1.5), (4.5, 4.5), (1.5, 4.5)])
    covered = coverage(scan_convert(square, np.array([(0, 3, 1), (1, 3, 2)]), 8), 8).reshape(8, 8)
    expected = np.zeros((8, 8), dtype=int)
    expected[1:4, 1:4] = 1
    assert np.array_equal(covered, expected)


def test_back_faces() -> None:
    triangle = screen([(0, 0), (4, 0), (0, 4)])
    front, back = np.array([(0, 2, 1)]), np.array([(0, 1, 2)])
    assert runs(scan_convert(triangle, front, 4)) == runs(scan_convert(triangle, back, 4, cull=False))
    assert len(scan_convert(triangle, back, 4)) == 0


def test_values_at_pixel_centres() -> None:
    # Depth 8 + x + 10 y in pixels, normal (1 - x/4, x/4, 0): at the first centre of line 1, (0.5, 1.5), depth 23.5.
    triangle = screen([(0, 0), (4, 0), (0, 4)], depth=[8, 12, 48], normals=[(1, 0, 0), (0, 1, 0), (1, 0, 0)])
    spans = scan_convert(triangle, np.array([(0, 2, 1)]), 4)
    assert spans.depth.tolist() == [13.5, 23.5, 33.5]
    assert spans.depth_gradient.tolist() == [1, 1, 1]
    assert spans.normal.tolist() == [[0.875, 0.125, 0]] * 3
    assert spans.gradient.tolist() == [[-0.25, 0.25, 0]] * 3


def test_slivers_between_centres_give_nothing() -> None:
    assert len(scan_convert(screen([(0.6, 0), (1.4, 0), (1, 9)]), np.array([(0, 2, 1)]), 8)) == 0
    assert len(scan_convert(screen([(0, 0), (4, 4), (8, 8.0001)]), np.array([(0, 2, 1)]), 8, cull=False)) == 0
    assert len(scan_convert(screen([(0, 0)]), np.empty((0, 3), dtype=int), 8)) == 0


@pytest.mark.parametrize("far", [100.0, 1000.3, REACH - 1.0])
def test_larger_than_the_frame(far: float) -> None:
    """Two triangles share a diagonal through the frame; products of their corners come close to the limit of int64."""
    around = screen([(-far, -far), (far, -far), (far, far), (-far, far)])
    faces = np.array([(0, 2, 1), (0, 3, 2)])
    spans = scan_convert(around, faces, 16)
    assert (coverage(spans, 16) == 1).all()
    assert (spans.x[spans.triangle == 0] == spans.y[spans.triangle == 0]).all()  # the upper one starts on the diagonal
    assert np.allclose(spans.normal, (0, 0, 1))


def test_outside_of_the_frame() -> None:
    for dx, dy in ((-50, 0), (50, 0), (0, -50), (0, 50)):
        moved = screen([(dx, dy), (dx + 4, dy), (dx, dy + 4)])
        assert len(scan_convert(moved, np.array([(0, 2, 1)]), 16)) == 0


def test_out_of_reach() -> None:
    assert snap(np.array([(0.5, 2.25)])).tolist() == [[128, 576]]
    for bad in (REACH, -REACH, np.inf, np.nan):
        with pytest.raises(ValueError, match="away from the frame"):
            snap(np.array([(0.0, bad)]))


def test_against_every_pixel_tested(rng: np.random.Generator) -> None:
    """The definition, pixel by pixel in Python integers, against the spans; corners lie on halves to provoke ties."""
    size = 12
    for _ in range(300):
        points = rng.integers(-6, 2 * size + 6, (3, 2)) / 2
        spans = scan_convert(screen(points), np.array([(0, 1, 2)]), size, cull=False)
        a, b, c = ((int(x), int(y)) for x, y in points * SUBPIXELS)
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if area < 0:
            b, c = c, b
        inside = [
            y * size + x
            for y in range(size)
            for x in range(size)
            if area
            and all(
                (e := (q[0] - p[0]) * (256 * y + 128 - p[1]) - (q[1] - p[1]) * (256 * x + 128 - p[0])) > 0
                or (e == 0 and (q[1] < p[1] or (q[1] == p[1] and q[0] > p[0])))
                for p, q in ((a, b), (b, c), (c, a))
            )
        ]
        assert expand(spans, size).place.tolist() == inside


def square_mesh(rng: np.random.Generator, cells: int, size: int) -> Iterator[tuple[Screen, NDArray[np.int64]]]:
    """Random triangulations of the frame: a grid of shaken corners, random diagonals; some corners on centres."""
    steps = np.linspace(0, size, cells + 1)
    corner = np.arange((cells + 1) ** 2).reshape(cells + 1, cells + 1)
    a, b, c, d = (corner[i : i + cells, j : j + cells].ravel() for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)))
    for grain in (2, 256, 10**9):
        points = np.stack(np.meshgrid(steps, steps), axis=-1)
        points[1:-1, 1:-1] += rng.uniform(-0.3, 0.3, (cells - 1, cells - 1, 2)) * size / cells
        points = np.rint(points * grain) / grain
        turn = rng.integers(0, 2, len(a)).astype(bool)[:, None]
        faces = np.where(turn, np.stack([a, b, c, a, c, d], axis=1), np.stack([b, c, d, b, d, a], axis=1))
        yield screen(points.reshape(-1, 2)), rng.permutation(faces.reshape(-1, 3))


def test_no_pixel_twice_or_left_out(rng: np.random.Generator) -> None:
    for cells in (1, 7, 40):
        for shaken, faces in square_mesh(rng, cells, 128):
            assert (coverage(scan_convert(shaken, faces, 128), 128) == 1).all()


def test_fan_around_a_centre() -> None:
    """The worst corner: many triangles meet in one pixel's centre, and exactly one owns it."""
    angle = np.linspace(0, 2 * np.pi, 38)[:-1]
    points = np.concatenate([[(8.5, 8.5)], 8.5 + 8 * np.stack([np.cos(angle), np.sin(angle)], axis=1)])
    ring = np.arange(1, 38)
    spans = scan_convert(screen(points), np.stack([np.zeros(37, int), np.roll(ring, -1), ring], axis=1), 17)
    covered = coverage(spans, 17).reshape(17, 17)
    assert covered.max() == 1
    assert covered[8, 8] == 1
    assert covered[3:14, 3:14].all()


VIEWS = [
    Camera(size=256, yaw=0.0, pitch=0.0),
    Camera(size=256, yaw=-90.0, pitch=-20.0),
    Camera(size=300, yaw=33.0, pitch=41.0, zoom=2.5),
    Camera(size=256, yaw=12.0, pitch=5.0, projection="perspective", field_of_view=60.0),
    Camera(size=64, yaw=171.0, pitch=-77.0, projection="perspective", zoom=9.0),
]


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("mesh", ["sphere", "head"])
def test_closed_surfaces_close(mesh: str, view: Camera) -> None:
    """Each ray enters a closed surface as often as it leaves it: front faces less back faces are 0 at every pixel.

    With a pixel doubled or left out at any edge the sum would be off there.
    """
    closed = load_mesh(mesh)
    projected = view.project(closed)
    a, b, c = snap(projected.xy)[closed.faces].transpose(1, 2, 0)
    facing = -np.sign((b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0])
    everything = scan_convert(projected, closed.faces, view.size, cull=False)
    front = scan_convert(projected, closed.faces, view.size)
    assert (coverage(everything, view.size, facing) == 0).all()
    assert front.pixels > 1000
    assert 2 * front.pixels == everything.pixels
    if mesh == "sphere":  # convex: a ray enters once
        assert coverage(front, view.size).max() == 1


def test_spans_are_ordered_and_inside() -> None:
    head = load_mesh("head")
    view = Camera(size=200, zoom=1.7)
    spans = scan_convert(view.project(head), head.faces, 200)
    key = spans.triangle.astype(np.int64) * 200 + spans.y
    assert (np.diff(key) > 0).all()
    assert spans.count.min() >= 1
    assert spans.x.min() == 0
    assert (spans.x + spans.count).max() == 200
    assert spans.y.min() == 0


def test_clipping_changes_nothing_inside() -> None:
    head = load_mesh("head")
    view = Camera(size=128, zoom=3.0)
    projected = view.project(head)
    moved = Screen(projected.xy + 128, projected.depth, projected.normals)
    whole = coverage(scan_convert(moved, head.faces, 384), 384).reshape(384, 384)
    clipped = coverage(scan_convert(projected, head.faces, 128), 128).reshape(128, 128)
    assert np.array_equal(clipped, whole[128:256, 128:256])


def test_both_ends_of_a_span_lie_in_the_triangle() -> None:
    """Interpolated values at the last pixel, reached by the gradient, stay within those of the corners."""
    head = load_mesh("head")
    projected = Camera(size=400).project(head)
    spans = scan_convert(projected, head.faces, 400)
    corners = head.faces[spans.triangle]
    last = spans.count - 1
    ends = ((spans.normal, projected.normals), (spans.normal + last[:, None] * spans.gradient, projected.normals))
    for value, at_corners in (
        *ends,
        (spans.depth, projected.depth),
        (spans.depth + last * spans.depth_gradient, projected.depth),
    ):
        assert (value >= at_corners[corners].min(axis=1) - 1e-9).all()
        assert (value <= at_corners[corners].max(axis=1) + 1e-9).all()


def test_expand_follows_the_stream() -> None:
    spans = scan_convert(screen([(0, 0), (4, 0), (0, 4)]), np.array([(0, 2, 1)]), 4)
    pixels = expand(spans, 4)
    assert pixels.span.tolist() == [0, 0, 0, 1, 1, 2]
    assert pixels.step.tolist() == [0, 1, 2, 0, 1, 0]
    assert pixels.place.tolist() == [0, 1, 2, 4, 5, 8]
    assert len(pixels.place) == spans.pixels == 6


def test_nearest_wins_and_ties_go_to_the_earlier() -> None:
    quad = [(0, 0), (4, 0), (4, 4), (0, 4)]
    faces = np.array([(0, 3, 1), (1, 3, 2)])
    stack = np.concatenate([faces, faces + 4, faces + 8])
    near = scan_convert(screen(quad * 3, depth=[2] * 4 + [1] * 4 + [3] * 4), stack, 6)
    visible = resolve(near, 6)
    pixels = expand(near, 6)
    seen = visible[visible >= 0]
    assert (visible.reshape(6, 6)[:4, :4] >= 0).all()
    assert (visible == -1).sum() == 36 - 16
    assert set(near.triangle[pixels.span[seen]].tolist()) == {2, 3}
    assert np.array_equal(pixels.place[seen], np.flatnonzero(visible >= 0))
    equal = scan_convert(screen(quad * 3, depth=[1] * 12), stack, 6)
    assert set(equal.triangle[expand(equal, 6).span[resolve(equal, 6)[visible >= 0]]].tolist()) == {0, 1}


def test_portions(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every span once, in order, of at most so many pixels or one span; a frame in portions is the same."""
    count = np.array([3, 3, 3, 9, 1])
    assert [(part.start, part.stop, first) for part, first in portions(count, 6)] == [
        (0, 2, 0), (2, 3, 6), (3, 4, 9), (4, 5, 18),
    ]  # fmt: skip
    assert portions(count[:0], 6) == []
    quad = [(0, 0), (16, 0), (16, 16), (0, 16)]
    faces = np.array([(0, 3, 1), (1, 3, 2)])
    spans = scan_convert(screen(quad * 2, depth=[0, 16, 16, 0, 16, 0, 0, 16]), np.concatenate([faces, faces + 4]), 16)
    whole = resolve(spans, 16)
    monkeypatch.setattr(raster, "portions", lambda count: portions(count, 7))
    assert np.array_equal(resolve(spans, 16), whole)
    monkeypatch.setattr(raster, "BLOCK", 1)
    parts = scan_convert(screen(quad * 2, depth=[0, 16, 16, 0, 16, 0, 0, 16]), np.concatenate([faces, faces + 4]), 16)
    assert all(np.array_equal(values, vars(spans)[name]) for name, values in vars(parts).items())


def test_planes_that_cross() -> None:
    """Depth is compared at every pixel: a rising and a falling plane share the frame at the line where they meet."""
    quad = [(0, 0), (16, 0), (16, 16), (0, 16)]
    faces = np.array([(0, 3, 1), (1, 3, 2)])
    both = screen(quad * 2, depth=[0, 16, 16, 0, 16, 0, 0, 16])
    spans = scan_convert(both, np.concatenate([faces, faces + 4]), 16)
    first = spans.triangle[expand(spans, 16).span[resolve(spans, 16)]].reshape(16, 16) < 2
    assert first[:, :8].all()
    assert not first[:, 8:].any()
