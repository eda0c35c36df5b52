# SPDX-License-Identifier: Apache-2.0
"""The camera's conventions: which way things turn, what is near, what fits."""

import numpy as np
import pytest
from polyshade.sim.errors import UserError
from polyshade.sim.scene.camera import MARGIN, PROJECTIONS, RANGES, Camera
from polyshade.sim.scene.mesh import Mesh, load_mesh

AXES = np.array([(1.0, 0, 0), (0, 1.0, 0), (0, 0, 1.0), (-1.0, 0, 0), (0, -1.0, 0), (0, 0, -1.0)])
"""The corners of an octahedron: to the right, up, to the viewer, and their opposites."""

FACES = np.array(
    [(0, 1, 2), (1, 3, 2), (3, 4, 2), (4, 0, 2), (1, 0, 5), (3, 1, 5), (4, 3, 5), (0, 4, 5)], dtype=np.int32
)
RIGHT, UP, FRONT = 0, 1, 2


def octahedron(scale: float = 1.0, offset: tuple[float, float, float] = (0, 0, 0)) -> Mesh:
    return Mesh("octahedron", AXES * scale + offset, FACES, AXES, {})


def plain(**options: object) -> Camera:
    return Camera(**{"size": 100, "yaw": 0.0, "pitch": 0.0, **options})


def test_screen_axes() -> None:
    screen = plain().project(octahedron())
    half = 50 * (1 - 2 * MARGIN)
    assert np.allclose(screen.xy[RIGHT], (50 + half, 50))
    assert np.allclose(screen.xy[UP], (50, 50 - half))
    assert np.allclose(screen.xy[FRONT], (50, 50))
    assert screen.depth[FRONT] < screen.depth[RIGHT] < screen.depth[FRONT + 3]
    assert np.allclose(screen.normals, AXES)


def test_positive_yaw_turns_the_front_to_the_right() -> None:
    screen = plain(yaw=90.0).project(octahedron())
    assert np.allclose(screen.normals[FRONT], (1, 0, 0))
    assert np.allclose(screen.normals[RIGHT], (0, 0, -1))
    assert screen.xy[FRONT][0] > 50


def test_positive_pitch_shows_the_top() -> None:
    screen = plain(pitch=90.0).project(octahedron())
    assert np.allclose(screen.normals[UP], (0, 0, 1))
    assert np.allclose(screen.normals[FRONT], (0, -1, 0))
    assert screen.depth[UP] < screen.depth[FRONT]


def test_yaw_is_applied_before_pitch() -> None:
    assert np.allclose(plain(yaw=90.0, pitch=90.0).project(octahedron()).normals[FRONT], (1, 0, 0))


@pytest.mark.parametrize("projection", PROJECTIONS)
@pytest.mark.parametrize("mesh", ["sphere", "head"])
@pytest.mark.parametrize("turn", [0.0, 30.0, 145.0])
def test_the_mesh_fills_the_frame(mesh: str, projection: str, turn: float) -> None:
    camera = Camera(size=500, yaw=turn, projection=projection)
    screen = camera.project(load_mesh(mesh))
    low, high = screen.xy.min(axis=0), screen.xy.max(axis=0)
    assert np.allclose((low + high) / 2, 250)
    assert np.isclose((high - low).max(), 500 * (1 - 2 * MARGIN))
    assert np.allclose(np.linalg.norm(screen.normals, axis=1), 1)
    larger = Camera(size=500, yaw=turn, projection=projection, zoom=3.0).project(load_mesh(mesh))
    assert np.allclose(larger.xy - 250, 3 * (screen.xy - 250))


@pytest.mark.parametrize("projection", PROJECTIONS)
def test_size_and_place_of_the_mesh_do_not_matter(projection: str) -> None:
    expected = plain(projection=projection).project(octahedron()).xy
    for scale, offset in ((1e-200, (0, 0, 0)), (1e29, (0, 0, 0)), (1e-3, (100, -50, 3)), (7.0, (1e6, 0, -1e6))):
        assert np.allclose(plain(projection=projection).project(octahedron(scale, offset)).xy, expected, atol=1e-4)


def test_perspective() -> None:
    """The nearer of two equal segments is drawn larger, and depth is linear in screen space."""
    ends = np.array([(-1.0, -1, 1), (1, -1, 1), (-1, 1, -1), (1, 1, -1)])
    middle = (ends[:1] + 3 * ends[3:]) / 4
    points = np.concatenate([ends, middle])
    mesh = Mesh("points", points, np.empty((0, 3), np.int32), np.tile((0.0, 0, 1), (5, 1)), {})
    screen = plain(projection="perspective", field_of_view=80.0).project(mesh)
    near, far = screen.xy[1] - screen.xy[0], screen.xy[3] - screen.xy[2]
    assert near[0] > far[0] > 0
    share = (screen.xy[4] - screen.xy[0]) / (screen.xy[3] - screen.xy[0])
    assert np.isclose(share[0], share[1])
    assert np.isclose(screen.depth[4], screen.depth[0] + share[0] * (screen.depth[3] - screen.depth[0]))
    # sin 40 deg = 0.6428: the eye is 1.5557 radii away, so near and far are drawn in the ratio of their distances.
    z = 1 / np.sqrt(3)
    assert np.isclose(near[0] / far[0], (1.555724 + z) / (1.555724 - z))


def test_narrow_perspective_becomes_orthographic() -> None:
    head = load_mesh("head")
    flat = Camera(size=256).project(head).xy
    assert np.abs(Camera(size=256, projection="perspective", field_of_view=1.0).project(head).xy - flat).max() < 2
    assert np.abs(Camera(size=256, projection="perspective", field_of_view=60.0).project(head).xy - flat).max() > 10


@pytest.mark.parametrize("name", RANGES)
def test_ranges(name: str) -> None:
    low, high = RANGES[name]
    for value in (low, high):
        assert np.isfinite(Camera(**{name: value, "projection": "perspective"}).project(octahedron()).xy).all()
    for value in (low - 1, high + 1, float("nan"), float("inf")):
        with pytest.raises(UserError, match=f"^--{name.replace('_', '-')}: .* allowed is {low} to {high}$"):
            Camera(**{name: value})


def test_unknown_projection() -> None:
    with pytest.raises(UserError, match=r"^--projection: 'fisheye' is none of orthographic, perspective$"):
        Camera(projection="fisheye")
