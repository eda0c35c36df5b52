# SPDX-License-Identifier: Apache-2.0
"""golden.light, from the angles to the light of six models: corners by hand, whole spheres against float64."""

import numpy as np
import pytest
from polyshade.golden import contract as k
from polyshade.golden import light
from polyshade.golden.fixed import ONE
from polyshade.golden.material import MODELS, Material, registers

Z = (0, 0, ONE)
PHYSICAL = ("cook-torrance", "ward")


def flags(*bits: int) -> int:
    return sum(1 << bit for bit in bits)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("local", [False, True])
def test_light_from_the_viewer(model: str, local: bool) -> None:
    """c = 1: all of the lobe, 1 or 1/2 by automatic exposure; nothing of Lambert."""
    words = registers(Material(model, f0=1), None if local else (0, 0, 1))
    diffuse, specular, told = light.light_local(*Z, *Z, *Z, words) if local else light.light(*Z, words)
    expected = {"lambert": 0, "cook-torrance": ONE // 2, "ward": ONE // 2}.get(model, ONE)
    assert (int(diffuse), int(specular), int(told)) == (ONE, expected, 0)


@pytest.mark.parametrize("model", PHYSICAL)
@pytest.mark.parametrize("normal", [(ONE, 0, 0), (0, 0, -ONE), (-56756, 0, 32768)])
def test_what_faces_away_is_dark(model: str, normal: tuple) -> None:
    """N.V = 0, both below 0, N.L below 0: the denominator is 0, and told."""
    _, specular, told = light.light(*normal, registers(Material(model), (0.6, 0, 0.8)))
    assert (int(specular), int(told)) == (0, flags(k.LIGHT_ZERO))


@pytest.mark.parametrize("model", PHYSICAL)
def test_grazing(model: str) -> None:
    """N.L = N.V = 2^-16 and N = H: the quotient is 2^16 (Ward) or more, and the light saturates."""
    l, v = (ONE, 0, 1), (-ONE, 0, 1)  # noqa: E741
    words = registers(Material(model))
    _, specular, told = light.reflectance(Z, l, v, Z, 1, ONE, words)
    assert (int(specular), int(told)) == (2 * ONE - 1, flags(k.LIGHT_SATURATED))


@pytest.mark.parametrize("model", sorted(set(MODELS) - {"phong"}))
def test_no_halfway_vector(model: str) -> None:
    """L = -V: without H no specular light, told where H is needed; Phong needs none."""
    n, x = (46341, 0, 46341), (ONE, 0, 0)
    diffuse, specular, told = light.light_local(*n, *x, -ONE, 0, 0, registers(Material(model)))
    assert (int(diffuse), int(specular)) == (46341, 0)
    assert int(told) == (0 if model == "lambert" else flags(k.LIGHT_ZERO))
    _, specular, told = light.light_local(39322, 0, 52429, *x, -ONE, 0, 0, registers(Material("phong", 1)))
    assert (int(specular), int(told)) == (pytest.approx(0.28 * ONE, abs=2), 0)  # R = (-0.28, 0, 0.96)


@pytest.mark.parametrize(
    ("code", "phong", "divide"), [(6, 1, 1), (7, 1, 1), (1, 0, 1), (3, 1, 0), (4, 1, 0), (5, 1, 0)]
)
def test_reserved_or_left_out(code: int, phong: int, divide: int) -> None:
    """Diffuse light alone, and told; other models stay."""
    words = registers(Material("blinn"), (0, 0, 1))
    assert [int(i) for i in light.light(*Z, words | {"model": code}, phong=phong, divide=divide)] == [ONE, 0, 1]
    assert [int(i) for i in light.light(*Z, words, phong=phong, divide=divide)] == [ONE, ONE, 0]


def test_out_of_range() -> None:
    """A normal too long: its cosine counts as 1 and is told; twice too long: the diffuse light saturates."""
    words = registers(Material("ward"), (0, 0, 1))
    assert [int(i) for i in light.light(0, 0, ONE + 1, words)] == [ONE + 1, ONE // 2, flags(k.LIGHT_RANGE)]
    steep = words | {"lx": ONE, "ly": ONE, "lz": ONE}
    diffuse, _, told = light.light(ONE, ONE, ONE, steep)
    assert (int(diffuse), int(told)) == (2 * ONE - 1, flags(k.LIGHT_RANGE, k.LIGHT_SATURATED))


def test_versine_out_of_range() -> None:
    """What does not fit is told; a vector an ulp too long counts as parallel."""
    two, most, least = 2 << k.VERSINE_F, [2 * ONE - 1] * 3, [-2 * ONE] * 3
    for form in (k.FORM_REFINED, k.FORM_PAPER):
        assert [int(v) for v in light.versine(*most, *least, form=form)] == [two, 1]
    assert [int(v) for v in light.versine(*least, *least, form=k.FORM_PAPER)] == [0, 1]
    assert [int(v) for v in light.versine(*Z, 0, 0, ONE + 1, form=k.FORM_PAPER)] == [0, 1]


@pytest.mark.parametrize(("model", "value"), [
    *((model, n) for model in ("phong", "blinn", "schlick") for n in (8, 16, 32, 128, 512)),
    *((model, m) for model in PHYSICAL for m in (0.1, 0.2, 0.3)),
])  # fmt: skip
def test_sphere(model: str, value: float) -> None:
    """A sphere that light meets from the side: NMSE of both channels against the original model in float64."""
    grid = np.linspace(-1, 1, 256)
    x, y = (axis[np.add.outer(grid**2, grid**2) < 0.999] for axis in np.meshgrid(grid, grid))
    normals = np.stack([x, y, np.sqrt(1 - x**2 - y**2)], axis=-1)
    surface = Material(model, **{"roughness" if model in PHYSICAL else "shininess": value})
    towards = (-0.4, 0.5, 0.8)
    words = registers(surface, towards)
    diffuse, specular, _ = light.light(*np.rint(normals * ONE).astype(np.int64).T, words)
    expected = surface.channels(normals, towards).clip(-1, 2 - 1 / ONE)
    for channel, reference in zip((diffuse, specular), expected.T, strict=True):
        assert np.sum((channel / ONE - reference) ** 2) <= 2e-6 * np.sum(reference**2)
