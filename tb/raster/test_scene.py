# SPDX-License-Identifier: Apache-2.0
"""shade_scene: pictures from vertices, pixel for pixel; gaps, stalls, bad triangles; the picture that a user gets."""

from __future__ import annotations

import numpy as np
import pytest
from polyshade.golden import contract as k
from polyshade.golden import raster as golden
from polyshade.golden.material import Material
from polyshade.sim import frame, picture
from polyshade.sim.scan import vertices
from polyshade.sim.scene.camera import Camera

from tb.raster.test_spans import skipped
from tb.raster.vectors import mixture
from tb.runner import SEED

BACKGROUND = (28, 31, 36)
LIGHT = (0.3, 0.6, 0.8)


def short(v: golden.Vertices) -> golden.Vertices:
    """The triangles with unit normals, from which light is exact."""
    length = np.sqrt((v.normal.astype(float) ** 2).sum(axis=-1, keepdims=True))
    unit = np.rint(v.normal / length * ((1 << k.VERTEX_F) - 1)).astype(np.int64)
    return golden.Vertices(v.x, v.y, v.depth, unit, v.tag, v.flat)


@pytest.mark.parametrize("double", [0, 1])
@pytest.mark.parametrize(("in_gap", "out_stall"), [(0.0, 0.0), (0.3, 0.6)])
def test_pictures(double: int, in_gap: float, out_stall: float) -> None:
    """Three pictures of triangles that hide each other; some are faulty, culled or outside."""
    rng = np.random.default_rng([SEED, double])
    view = golden.View(40, 37, k.CULL_BACK)
    frames = [short(mixture(rng, rows, 40)) for rows in (12, 3, 12)]
    frames[0].normal[::5, 1] = 0
    frames[2].x[1::4, 2], frames[2].y[1::4, 2] = frames[2].x[1::4, 0], frames[2].y[1::4, 0]
    options = {"in_gap": in_gap, "out_stall": out_stall, "seed": SEED}
    drawn = picture.draw(frames, view, Material(), LIGHT, BACKGROUND, 6, double, **options)
    assert drawn.mismatches == 0
    scanned = [golden.skipped(golden.scan(v, view)) for v in frames]
    told = golden.Scanned(*[None] * 13, {}, 0, 0)
    total = {name: sum(part[name] for part in scanned) for name in scanned[0]}
    faults = {name: total[name] for name in golden.FAULTS}
    assert drawn.skipped == skipped(golden.replace(told, faults=faults, **{n: total[n] for n in ("culled", "empty")}))
    assert all(total[name] for name in ("normal", "area", "culled", "empty"))


@pytest.mark.parametrize("shininess", [32.0])
def test_the_picture_of_a_head(shininess: float) -> None:
    """What is read from the block RAM is what ``polyshade render`` leaves in image.png."""
    settings = frame.Settings(
        camera=Camera(size=128), path="direct", scan="rtl", material=Material(model="blinn", shininess=shininess)
    )
    mesh = settings.load()
    image = np.asarray(frame.render(settings, mesh).image())
    sent = vertices(settings.camera.project(mesh), mesh.faces)
    drawn = picture.draw([sent], golden.View(128, 128), settings.material, settings.light, BACKGROUND, 7)
    assert drawn.mismatches == 0
    assert np.array_equal(drawn.pictures[0], image)
    print(f"{drawn.pixels / drawn.seconds:.0f} pixels a second, {drawn.pixels / drawn.clocks:.2f} a clock")
