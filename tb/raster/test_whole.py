# SPDX-License-Identifier: Apache-2.0
"""Whole meshes and 100,000 triangles through the scan converter in RTL: for ``make test-all``."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from polyshade.golden import contract as k
from polyshade.golden import raster as golden
from polyshade.sim.scan import scan
from polyshade.sim.scene.camera import Camera
from polyshade.sim.scene.mesh import load_mesh
from polyshade.sim.scene.raster import scan_convert

from tb.raster.test_spans import once, same
from tb.raster.vectors import mixture
from tb.runner import SEED
from tb.scene.shapes import CUBE, SIDES


def obj(points: np.ndarray, sides: np.ndarray) -> str:
    """A mesh as text."""
    lines = ["v " + " ".join(map(str, point)) for point in points]
    return "\n".join([*lines, *("f " + " ".join(str(i + 1) for i in side) for side in sides), ""])


def grid(rows: int, columns: int) -> np.ndarray:
    """Quadrilaterals between points of a closed grid."""
    i, j = (part.ravel() for part in np.mgrid[:rows, :columns])
    down, right = (i + 1) % rows, (j + 1) % columns
    return np.stack([i * columns + j, down * columns + j, down * columns + right, i * columns + right], -1)


def torus(rows: int, columns: int, width: float) -> str:
    """A ring; with few columns its triangles are slivers."""
    a, b = (2 * np.pi * part / n for part, n in zip(np.mgrid[:rows, :columns], (rows, columns), strict=True))
    radius = 1 + width * np.cos(b)
    points = np.stack([radius * np.cos(a), radius * np.sin(a), width * np.sin(b)], -1).reshape(-1, 3)
    return obj(points, grid(rows, columns))


FILES = {
    "cube": obj(np.array(CUBE), np.array(SIDES)),
    "ring": torus(60, 30, 0.4),
    "wire": torus(200, 6, 0.02),
    "needles": torus(700, 5, 0.6),
    "coin": torus(40, 40, 0.9),
}
MESHES = {"head": ("head", 0), "fine-head": ("head", 1), "sphere": ("sphere", 0), "fine-sphere": ("sphere", 2)}


@pytest.mark.full
@pytest.mark.parametrize("size", [256, 512, 1024])
@pytest.mark.parametrize("name", [*MESHES, *FILES])
def test_meshes(tmp_path: Path, name: str, size: int) -> None:
    """Coverage, every bit and the order of depths as golden and float64 have them."""
    spec, steps = MESHES.get(name, (str(tmp_path / "mesh.obj"), 0))
    if name in FILES:
        Path(spec).write_text(FILES[name])
    mesh = load_mesh(spec, steps)
    screen = Camera(size=size, yaw=30.0, pitch=20.0).project(mesh)
    made = scan(screen, mesh.faces, size, scan_convert(screen, mesh.faces, size))
    assert len(made.golden.index)
    assert (made.mismatches, made.coverage_mismatches, made.depth_mismatches) == (0, 0, 0)


@pytest.mark.full
@pytest.mark.parametrize("seed", range(4))
def test_100_000_triangles(seed: int) -> None:
    """Slivers, subpixel ones, great ones: every bit, and all come to an end."""
    v = mixture(np.random.default_rng([SEED, 77, seed]), 5000)
    assert len(same(v, golden.View(128, 101, k.CULL_NONE)).given) > 10_000


@pytest.mark.full
@pytest.mark.parametrize("seed", range(20))
def test_fans(seed: int) -> None:
    """Each pixel of closed fans of 64 to 1,000 triangles once."""
    rng = np.random.default_rng([SEED, 78, seed])
    once(rng, int(rng.integers(60, 996)), int(rng.integers(200, 400)))
