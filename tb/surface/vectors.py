# SPDX-License-Identifier: Apache-2.0
"""Triangles for the benches of patches: random ones of all sizes, as scan conversion finds them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from polyshade.golden import patch as golden
from polyshade.sim.scene.camera import Screen
from polyshade.sim.scene.raster import scan_convert
from polyshade.sim.scene.triangles import Triangles

LIGHT = (0.3, 0.6, 0.8)


def triangles(rng: np.random.Generator, count: int, size: int = 256) -> Triangles:
    """Random triangles: a third of up to 8 pixels a side, a third of 40, a third of the whole frame; any curvature."""
    reach = rng.choice([4, 20, size / 2], (count, 1, 1))
    corners = np.clip(rng.uniform(0, size, (count, 1, 2)) + rng.uniform(-1, 1, (count, 3, 2)) * reach, 0, size)
    bend = rng.choice([0, 0.02, 0.3], (count, 1, 1))
    normals = rng.normal(size=(count, 1, 3)) * [0.5, 0.5, 0.1] + [0, 0, 1] + bend * rng.normal(size=(count, 3, 3))
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    screen = Screen(xy=corners.reshape(-1, 2), depth=np.zeros(3 * count), normals=normals.reshape(-1, 3))
    return Triangles.of(scan_convert(screen, np.arange(3 * count, dtype=np.int32).reshape(-1, 3), size, cull=False))


def part(given: Triangles, keep: np.ndarray) -> Triangles:
    """Some of the triangles (T,) with their runs."""
    runs, place = keep[given.triangle], np.cumsum(keep) - 1
    return replace(
        given,
        **{
            name: getattr(given, name)[keep]
            for name in ("normal", "dcolumn", "dcolumn_exp", "dline", "dline_exp", "box", "tag", "flat")
        },
        triangle=place[given.triangle[runs]],
        **{name: getattr(given, name)[runs] for name in ("column", "line", "count")},
    )


def model(given: Triangles) -> golden.Triangles:
    """As the golden model takes them."""
    return golden.Triangles(*(getattr(given, name) for name in golden.Triangles._fields))
