# SPDX-License-Identifier: Apache-2.0
"""Catmull-Clark and the cutting of polygons, by hand-computed answers."""

import numpy as np
import pytest
from polyshade.sim.scene.subdivide import catmull_clark, triangulate

CUBE = np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
SIDES = np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])


def fours(quads: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return quads.reshape(-1), np.full(len(quads), 4)


def volume(vertices: np.ndarray, triangles: np.ndarray) -> float:
    a, b, c = vertices[triangles].transpose(1, 0, 2)
    return float((np.cross(a, b) * c).sum() / 6)


def test_cube() -> None:
    vertices, quads = catmull_clark(CUBE, *fours(SIDES))
    assert vertices.shape == (26, 3)
    assert quads.shape == (24, 4)
    assert np.allclose(vertices[7], (5 / 9, 5 / 9, 5 / 9))  # from (1, 1, 1)
    edges = {tuple(np.round(v, 9)) for v in vertices[8:20]}
    assert (0.75, 0.75, 0.0) in edges  # (a + b + Q1 + Q2)/4 = (2 + 1 + 0)/4
    faces = {tuple(np.round(v, 9)) for v in vertices[20:]}
    assert faces == {tuple(s * e for e in row) for row in np.eye(3) for s in (-1.0, 1.0)}
    assert volume(vertices, triangulate(vertices, *fours(quads))) > 0  # turned outwards, as before


def test_a_closed_surface_stays_closed() -> None:
    vertices, quads = CUBE, SIDES
    for _ in range(3):
        vertices, quads = catmull_clark(vertices, *fours(quads))
        directed = np.concatenate([np.stack([quads[:, k], quads[:, k - 3]], axis=1) for k in range(4)])
        there = {tuple(e) for e in directed.tolist()}
        assert len(there) == len(directed)
        assert there == {(b, a) for a, b in there}
        assert len(vertices) - len(directed) // 2 + len(quads) == 2  # Euler


def test_the_rim_is_a_spline_of_itself() -> None:
    vertices = np.array([(0.0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
    refined, quads = catmull_clark(vertices, np.arange(4), np.array([4]))
    assert np.allclose(refined[0], (1 / 8, 1 / 8, 0))  # (a + 6 P + b)/8
    assert {tuple(v[:2]) for v in refined[4:8]} == {(0.5, 0), (1, 0.5), (0.5, 1), (0, 0.5)}
    assert np.allclose(refined[8], (0.5, 0.5, 0))
    assert quads.shape == (4, 4)


def test_a_flat_grid_stays_where_it_is() -> None:
    side = np.arange(4.0)
    vertices = np.stack([*np.meshgrid(side, side), np.zeros((4, 4))], axis=-1).reshape(-1, 3)
    corner = np.arange(16).reshape(4, 4)
    quads = np.stack([corner[:3, :3], corner[:3, 1:], corner[1:, 1:], corner[1:, :3]], axis=-1).reshape(-1, 4)
    refined, _ = catmull_clark(vertices, *fours(quads))
    assert np.allclose(refined[[5, 6, 9, 10]], vertices[[5, 6, 9, 10]])  # inner vertices of a regular grid
    assert np.allclose(refined[:, 2], 0)


def test_edges_of_three_faces_are_rims() -> None:
    """Three squares share an edge: nothing is smoothed across it, and its ends stay where they are."""
    vertices = np.array([(0.0, 0, 0), (0, 1, 0)] + [(x, y, z) for x, z in ((1, 0), (-1, 1), (-1, -1)) for y in (0, 1)])
    quads = np.array([(0, 1, 3, 2), (0, 1, 5, 4), (0, 1, 7, 6)])
    refined, _ = catmull_clark(vertices, *fours(quads))
    assert np.allclose(refined[:2], vertices[:2])
    assert any(np.allclose(v, (0, 0.5, 0)) for v in refined[8:])


@pytest.mark.parametrize("sizes", [(3,), (4,), (5,), (3, 4, 6), (6, 3, 3, 5)])
def test_faces_of_any_size(sizes: tuple[int, ...]) -> None:
    angles = [np.arange(n) * 2 * np.pi / n for n in sizes]
    vertices = np.concatenate([np.stack([np.cos(a) + 3 * k, np.sin(a), 0 * a], axis=1) for k, a in enumerate(angles)])
    corners = np.arange(len(vertices))
    triangles = triangulate(vertices, corners, np.array(sizes))
    assert len(triangles) == sum(n - 2 for n in sizes)
    normal = np.cross(*(vertices[triangles[:, k]] - vertices[triangles[:, 0]] for k in (1, 2)))
    area = sum(n / 2 * np.sin(2 * np.pi / n) for n in sizes)
    assert (normal[:, 2] > 0).all()
    assert np.isclose(normal[:, 2].sum() / 2, area)
    refined, quads = catmull_clark(vertices, corners, np.array(sizes))
    assert len(quads) == sum(sizes)
    assert len(refined) == 2 * sum(sizes) + len(sizes)


def test_quads_are_cut_along_the_shorter_diagonal() -> None:
    kite = np.array([(0.0, 0, 0), (1, -3, 0), (2, 0, 0), (1, 3, 0)])
    assert triangulate(kite, np.arange(4), np.array([4])).tolist() == [[0, 1, 2], [0, 2, 3]]
    assert triangulate(kite, np.array([1, 2, 3, 0]), np.array([4])).tolist() == [[2, 3, 0], [2, 0, 1]]
