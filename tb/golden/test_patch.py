# SPDX-License-Identifier: Apache-2.0
"""golden.patch: boxes, nodes and polynomials against what they stand for, and the error of a whole frame."""

from __future__ import annotations

import numpy as np
import pytest
from polyshade.golden import contract as k
from polyshade.golden import direct, patch
from polyshade.golden.material import Material
from polyshade.sim.scene.camera import Camera
from polyshade.sim.scene.mesh import load_mesh
from polyshade.sim.scene.raster import expand, resolve, scan_convert
from polyshade.sim.scene.triangles import Triangles

LIGHT = (0.3, 0.6, 0.8)
ONE = 1 << k.INTENSITY_F


def test_norm_is_never_short() -> None:
    """Between the length and sqrt(3/2) of it, as for (2, 1, 1)."""
    v = np.random.default_rng(1).integers(-(1 << 26), 1 << 26, (3, 100_000))
    ratio = patch.norm(*v) / np.sqrt((v.astype(float) ** 2).sum(axis=0))
    assert ratio.min() > 1 - 1e-6
    assert ratio.max() < np.sqrt(1.5) + 1e-6


def parabola(c, s, t, p, q, r, i, j):
    """At i, j quarters of a box."""
    return c + (s * i + t * j) / 2 + (p * i * i + q * i * j + r * j * j) / 4


def worst(parts: np.ndarray) -> float:
    """Error in ulp at any pixel, of the polynomial that goes through the nodes as they are quantized."""
    nodes = [np.rint(parabola(*parts, *node)).astype(np.int64) for node in patch.NODES]
    found = patch.coefficients(*nodes)
    b, a, g, f, c, e = (node.astype(float) for node in nodes)
    s, t, q = (a + b - f - g) / 2, (a + f - b - g) / 2, a - b - f + g
    through = c, s, t, 4 * (e - c) - 2 * s, q, 2 * (a + b) - 4 * e
    pixels = [(x, y) for x in range(-8, 8) for y in range(-8, 8)]
    exact = ((x, y, parabola(*through, x / 4, y / 4).clip(0, ONE - 1)) for x, y in pixels)
    return max(float(np.abs(patch.value(found, x, y) - wanted).max()) for x, y, wanted in exact)


def test_parabolas_are_exact() -> None:
    """Any polynomial of degree 2 of which nothing is cut comes out at every pixel to half an ulp."""
    rng = np.random.default_rng(2)
    parts = rng.integers(-100, 100, (6, 1000)) * 64 + np.array([[20000], [0], [0], [0], [0], [0]])
    assert worst(parts) <= 0.5


def test_parabolas_that_are_cut() -> None:
    """S1.18 holds the rest to 48 ulp in the corner of a box: 6 units for s and t, 60 for p, q and r."""
    rng = np.random.default_rng(2)
    assert 16 < worst(rng.integers(-6000, 6000, (6, 20000)) + np.array([[20000], [0], [0], [0], [0], [0]])) <= 48.5


def test_light_of_normals_of_any_length() -> None:
    """Lengths 0.52 to 1.4: diffuse light within 3 ulp of the exact cosine, the versine as near as its formula is."""
    rng = np.random.default_rng(3)
    words, _ = patch.registers(Material("blinn", 32), LIGHT)
    n = rng.normal(size=(200_000, 3)) + np.array([0, 0, 1])
    n *= (rng.uniform(0.52, 1.4, len(n)) / np.linalg.norm(n, axis=1))[:, None]
    exact = np.rint(n * ONE).astype(np.longdouble) / ONE
    l, h = (words.l[0].astype(np.longdouble) / ONE, words.h[0].astype(np.longdouble) / ONE)  # noqa: E741
    length = np.sqrt((exact**2).sum(axis=1))
    cut = {"a": (exact @ l, k.DIRECT_DIFFUSE_F), "h": (exact @ h, k.DIRECT_X_F), "p": (length**2, k.DIRECT_P_OUT_F)}
    still = dict.fromkeys(patch.Scalars._fields, np.int64(0))
    still |= {name: np.floor(value * 2**f).astype(np.int64) for name, (value, f) in cut.items()}
    at = patch.Scalars(**{name: v if name[0] == "p" else np.stack([v]) for name, v in still.items()})
    straight = direct.Lobe(np.arange(1024) * 64, np.full(1024, 1024), 0, 0)  # the table is x itself, up to 1
    diffuse, specular, short = patch.light(at, np.int64(0), np.int64(0), straight, words.excess)
    assert not short.any()
    assert np.abs(diffuse - exact @ l / length * ONE).max() < 3
    versine = np.sqrt(h @ h) - exact @ h / length
    seen = (versine < 0.999) & (exact @ h > 0)
    bound = (np.abs(1 / length - 1) + np.abs(1 - exact @ h)) * 2.0**-17 + 2.0**-16
    assert (np.abs(specular / ONE - versine) < bound)[seen].all()


def frame(n: float, weighted: bool = True) -> tuple[float, np.ndarray]:
    """Evaluations a pixel and the NMSE of both channels of the head at 1024."""
    mesh = load_mesh("head")
    spans = scan_convert(Camera().project(mesh), mesh.faces, 1024)
    given = Triangles.of(spans)
    material = Material("blinn", n)
    words, lobe = patch.registers(material, LIGHT, weighted)
    drawn = patch.draw(patch.Triangles(*(getattr(given, f) for f in patch.Triangles._fields)), words, lobe)
    every = expand(spans, 1024)
    normal = spans.normal[every.span] + every.step[:, None] * spans.gradient[every.span]
    exact = material.channels(normal / np.linalg.norm(normal, axis=1)[:, None], LIGHT).clip(0, 1)
    intensity = np.zeros_like(exact)
    intensity[drawn.order] = drawn.pixels / ONE
    seen = resolve(spans, 1024)
    seen = seen[seen >= 0]
    error = ((intensity - exact)[seen] ** 2).sum(axis=0) / (exact[seen] ** 2).sum(axis=0)
    return drawn.evaluations / len(exact), error


@pytest.mark.parametrize(("n", "evaluations"), [(8, 0.18), (32, 0.20), (128, 0.22), (512, 0.25)])
def test_the_head(n: float, evaluations: float) -> None:
    """Few lights a pixel at every shininess, and an error that nobody sees."""
    found, error = frame(n)
    assert found <= evaluations
    assert error.max() <= 1e-5


def test_without_the_weight() -> None:
    """Boxes far from the highlight as small as in it: three times as many lights at n = 512."""
    found, error = frame(512, weighted=False)
    assert found > 0.6
    assert error.max() <= 1e-5


def test_models_that_patches_do_not_have() -> None:
    with pytest.raises(ValueError, match="model: ward is none of lambert, blinn"):
        patch.registers(Material("ward"), LIGHT)
