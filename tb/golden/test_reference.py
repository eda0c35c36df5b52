"""The papers in float64, by numbers from the papers and from geometry."""

from __future__ import annotations

from fractions import Fraction
from math import cos, radians, sin, sqrt

import numpy as np
import pytest

from golden import contract as k
from golden.reference import light, poly
from tb.runner import SEED

RNG = np.random.default_rng(SEED)


def at(degrees: float) -> list[float]:
    """A direction so many degrees to the right of the viewer's."""
    return [sin(radians(degrees)), 0, cos(radians(degrees))]


# ---- light -------------------------------------------------------------------------------------------------------


def test_unit() -> None:
    assert light.unit([3, 0, 4]).tolist() == [0.6, 0, 0.8]
    assert light.unit([[0, 0, 0], [0, -2, 0]]).tolist() == [[0, 0, 0], [0, -1, 0]]  # no direction stays none


@pytest.mark.parametrize("angle", [0, 30, 60, 90, 120, 180])
def test_diffuse(angle: float) -> None:
    """The cosine between normal and light, below the horizon too; lengths do not matter."""
    assert light.diffuse(at(angle), [0, 0, 1]) == pytest.approx(cos(radians(angle)), abs=1e-15)
    assert light.diffuse(7 * np.array(at(angle)), [0, 0, 0.01]) == pytest.approx(cos(radians(angle)), abs=1e-15)


@pytest.mark.parametrize("n", [1, 2, 32, 1000.5])
def test_blinn(n: float) -> None:
    """cos^n of the angle to the half vector: for a light at 60 degrees that is at 30."""
    for angle in (30, 0, 45, 75):
        assert light.blinn(at(angle), at(60), n) == pytest.approx(cos(radians(angle - 30)) ** n, rel=1e-9)
    assert light.blinn(at(-61), at(60), n) == 0
    assert light.blinn(at(0), at(0), n) == 1
    assert light.blinn(at(10), [0, 0, -1], n) == 0  # a light right behind: there is no half vector


@pytest.mark.parametrize("n", [1, 2, 32, 1000.5])
def test_phong(n: float) -> None:
    """cos^n of the angle between the mirrored light and the viewer: it turns twice as fast as the normal."""
    for angle in (30, 20, 45, 70):
        assert light.phong(at(angle), at(60), n) == pytest.approx(cos(radians(2 * angle - 60)) ** n, rel=1e-9)
    assert light.phong(at(80), at(60), n) == 0
    assert light.phong(at(0), at(0), n) == 1


def test_channels() -> None:
    """Diffuse and specular light, in this order, for any shape of normals."""
    normals = RNG.normal(size=(4, 5, 3))
    for model, specular in light.MODELS.items():
        both = light.light_channels(model, normals, [1, 2, 3], 20)
        assert both.shape == (4, 5, 2)
        assert np.array_equal(both[..., 0], light.diffuse(normals, [1, 2, 3]))
        assert np.array_equal(both[..., 1], specular(normals, [1, 2, 3], shininess=20, roughness=0.3))
    assert not light.lambert(normals, [1, 2, 3]).any()


def test_kappa() -> None:
    """n (1 - c); phong's highlight turns twice as fast: four times that; diffuse light counts as n = 1."""
    c = cos(radians(10))
    assert light.kappa("blinn", at(5), at(15), 32) == pytest.approx(32 * (1 - c))
    assert light.kappa("phong", at(5), at(15), 32) == pytest.approx(128 * (1 - c))
    assert light.kappa("lambert", at(5), at(15), 32) == pytest.approx(1 - c)
    assert light.kappa("blinn", at(0), [0, 0, 5], 1024) == 0
    assert light.kappa("lambert", at(0), at(180), 1) == pytest.approx(2)
    assert light.kappa("blinn", np.zeros((0, 3)), np.zeros((0, 3)), 8).shape == (0,)


def test_half_the_arc_has_a_quarter_of_kappa() -> None:
    """What the planner goes by; for an arc as long as 20 degrees it is true within 1 %."""
    assert light.kappa("blinn", at(0), at(10), 32) / light.kappa("blinn", at(0), at(20), 32) == pytest.approx(
        0.25, rel=0.01
    )


# ---- polynomials -------------------------------------------------------------------------------------------------


def test_thirds() -> None:
    """43/128; 21845/65536 with three adders, and every further one doubles the bits."""
    assert poly.third_paper(128) == 43
    assert poly.third_paper(3) - 1 == pytest.approx(0.0078125)
    assert poly.third_log(65536, 3) == 21845
    assert poly.third_log(3, 3) - 1 == pytest.approx(-(2**-16))
    assert poly.third_log(3, 4) - 1 == pytest.approx(-(2**-32))
    assert poly.third_exact(3) == 1
    for third in (poly.third_paper, poly.third_log, poly.third_exact):
        assert third([3.0, 6.0]).tolist() == [third(3), 2 * third(3)]


@pytest.mark.parametrize("form", [k.FORM_PAPER, k.FORM_REFINED])
@pytest.mark.parametrize("nodes", [k.NODES_LEFT, k.NODES_RIGHT])
@pytest.mark.parametrize("degree", [1, 2, 3])
def test_polynomials_meet_their_nodes(degree: int, nodes: int, form: int) -> None:
    """With an exact third both forms are the interpolating polynomial."""
    intensity = RNG.random((100, degree + 1))
    coefficients = poly.coef(degree, intensity, nodes=nodes, form=form)
    for node, t in enumerate(poly.NODES[nodes][degree]):
        assert poly.horner(coefficients, t) == pytest.approx(intensity[:, node], abs=1e-13)


def test_nodes() -> None:
    assert poly.NODES[k.NODES_LEFT][3] == (0, 0.25, 0.5, 1)
    assert poly.NODES[k.NODES_RIGHT][3] == (0, 0.5, 0.75, 1)
    assert all(poly.NODES[nodes][2] == (0, 0.5, 1) and poly.NODES[nodes][1] == (0, 1) for nodes in poly.NODES)


def test_coefficients_by_hand() -> None:
    """I = 1, 2, 5, 3 with both node sets, in fractions."""
    i1, i2, i3, i4 = map(Fraction, (1, 2, 5, 3))
    left = (8 * (8 * i2 + i4) / 3 - 8 * (i1 + 2 * i3), 2 * (7 * i1 - 16 * i2 + 10 * i3 - i4),
            (32 * i2 + i4) / 3 - 7 * i1 - 4 * i3, i1)  # fmt: skip
    assert left == (Fraction(-112, 3), 44, Fraction(-14, 3), 1)
    assert poly.coef(3, [1, 2, 5, 3]) == pytest.approx([float(c) for c in left])
    right = (Fraction(-160, 3), 80, Fraction(-74, 3), 1)
    assert sum(right) == 3
    assert poly.coef(3, [1, 2, 5, 3], nodes=k.NODES_RIGHT) == pytest.approx([float(c) for c in right])


def test_the_defect_of_the_paper() -> None:
    """A constant 1 ends at 1.273; in the difference form even the paper's third keeps it constant."""
    paper = poly.coef(3, np.ones(4), third=poly.third_paper)
    assert paper == pytest.approx((0.1875, 0, 0.0859375, 1))
    assert poly.horner(paper, 1) == 1.2734375
    for nodes in (k.NODES_LEFT, k.NODES_RIGHT):
        kept = poly.coef(3, np.ones(4), nodes=nodes, form=k.FORM_REFINED, third=poly.third_paper)
        assert kept == pytest.approx((0, 0, 0, 1))


def test_horner() -> None:
    t = np.linspace(0, 1, 11)
    a, b, c, d = 2.0, -3.0, 0.5, sqrt(2)
    assert poly.horner((a, b, c, d), t) == pytest.approx(a * t**3 + b * t**2 + c * t + d)
