# SPDX-License-Identifier: Apache-2.0
"""The papers in float64, by numbers from the papers and from geometry."""

from __future__ import annotations

from fractions import Fraction
from math import cos, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from polyshade.golden import contract as k
from polyshade.golden.reference import light, poly

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


def test_schlick() -> None:
    """c / (n - n c + c), not c^n: at 60 degrees and n = 8, 0.5 / 4.5."""
    assert light.schlick(at(60), [0, 0, 1], 8) == pytest.approx(1 / 9)
    assert light.schlick(at(0), [0, 0, 1], 8) == 1
    assert light.schlick(at(120), [0, 0, 1], 8) == 0


@pytest.mark.parametrize("m", [0.1, 0.3, 0.6])
@pytest.mark.parametrize("angle", [0, 10, 40, 89])
def test_microfacets(angle: float, m: float) -> None:
    """D and Ward's exponential as the papers print them, in angles; and P1's other way to write D's exponent."""
    g = radians(angle)
    d = np.exp(-(tan(g) ** 2) / m**2) / (4 * m**2 * cos(g) ** 4)
    assert light.beckmann(cos(g), m) == pytest.approx(d, rel=1e-9)
    assert light.beckmann(cos(g), m) == pytest.approx(
        np.exp((cos(g) ** 2 - 1) / (m * cos(g)) ** 2) / (4 * m**2 * cos(g) ** 4), rel=1e-9
    )
    assert light.ward_lobe(cos(g), m) == pytest.approx(4 * m**2 * cos(g) ** 4 * d, rel=1e-9)
    assert light.beckmann([0, -0.5], m).tolist() == light.ward_lobe([0, -0.5], m).tolist() == [0, 0]


def test_fresnel() -> None:
    """F0 head-on, 1 at grazing angles; a cosine outside [0, 1] counts as the nearest inside."""
    assert light.fresnel([1, 0, 0.5, 1.1, -1], 0.2) == pytest.approx([0.2, 1, 0.2 + 0.8 / 32, 0.2, 1])


@pytest.mark.parametrize("model", ["cook-torrance", "ward"])
@pytest.mark.parametrize(("normal_at", "light_at"), [(20, 60), (0, 80), (70, 60), (-5, 5)])
def test_physical_models(model: str, normal_at: float, light_at: float) -> None:
    """In one plane, in angles from the viewer's: H is half way to the light."""
    m, f0 = 0.4, 0.3
    nl, nv, nh, vh = (
        cos(radians(a)) for a in (normal_at - light_at, normal_at, normal_at - light_at / 2, light_at / 2)
    )
    tangent = tan(radians(normal_at - light_at / 2))
    exponential = np.exp(-(tangent**2) / m**2)
    if model == "ward":
        expected = exponential / (4 * pi * m**2 * sqrt(nl * nv))
    else:
        f = f0 + (1 - f0) * (1 - vh) ** 5
        g = min(1, 2 * nh * nv / vh, 2 * nh * nl / vh)
        expected = f * exponential / (4 * m**2 * nh**4) * g / (pi * nl * nv)
    actual = light.MODELS[model](at(normal_at), at(light_at), roughness=m, f0=f0)
    assert actual == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("model", ["cook-torrance", "ward"])
@pytest.mark.parametrize(("normal", "towards"), [(at(120), at(60)), (at(-40), at(60)), (at(0), [0, 0, -1])])
def test_what_faces_away_is_dark(model: str, normal: list, towards: list) -> None:
    """From the viewer, from the light, and with no half vector at all."""
    assert light.MODELS[model](normal, towards, roughness=0.3) == 0


@pytest.mark.parametrize("model", light.MODELS)
def test_light_and_viewer_of_every_point(model: str) -> None:
    """As if computed one by one; and turning everything about an axis changes nothing."""
    normals, lights, views = light.unit(RNG.normal(0, 0.5, (3, 20, 3)) + light.VIEW)
    many = light.light_channels(model, normals, lights, 20, view=views)
    for i in range(20):
        one = light.light_channels(model, normals[i], lights[i], 20, view=views[i])
        assert one == pytest.approx(many[i], rel=1e-12)
        turned = light.light_channels(
            model, *(v[i][[2, 0, 1]] for v in (normals, lights)), 20, view=views[i][[2, 0, 1]]
        )
        assert turned == pytest.approx(many[i], rel=1e-9)


def test_reciprocity() -> None:
    """Light and viewer may change places in every model."""
    normals, lights, views = light.unit(RNG.normal(0, 0.5, (3, 50, 3)) + light.VIEW)
    for model, specular in light.MODELS.items():
        there, back = (
            specular(normals, a, shininess=9, roughness=0.4, view=b) for a, b in ((lights, views), (views, lights))
        )
        assert there == pytest.approx(back, rel=1e-9, abs=1e-12), model


def test_channels_scale_and_cosine() -> None:
    normals = light.unit(RNG.normal(size=(30, 3)))
    plain = light.light_channels("blinn", normals, [1, 2, 3], 5)
    scaled = light.light_channels("blinn", normals, [1, 2, 3], 5, scale=3, cosine=True)
    assert np.array_equal(plain[:, 0], scaled[:, 0])
    assert scaled[:, 1] == pytest.approx(3 * plain[:, 1] * plain[:, 0].clip(0))


# ---- the lobe and its energy -------------------------------------------------------------------------------------


def test_lobe() -> None:
    """By hand: 1 - 2 * 0.25 + 4 * 0.0625 = 0.75; limited to x = 0.1: 0.84; below 0 it is 0, as for c < 0."""
    assert light.lobe(0.75, 2, 4) == pytest.approx(0.75**16)
    assert light.lobe(0.75, 2, 4, 0.1, power=2) == pytest.approx(0.84**4)
    assert light.lobe([0.4, -0.1], 2).tolist() == [0, 0]
    assert light.lobe(-0.1, 0, 0) == 0


@pytest.mark.parametrize("n", [1, 2, 16, 20.5, 100, 1024])
@pytest.mark.parametrize("row", light.ROWS)
def test_classic_energy(row: str, n: float) -> None:
    """The closed forms against the integral of cos^n, with c = cos t or cos t/2, over the angle."""
    t = (np.arange(200_000) + 0.5) / 200_000 * pi / 2
    half, weighted = light.ROWS[row]
    integral = np.sum(np.cos(t / 2 if half else t) ** n * np.sin(t) * (np.cos(t) if weighted else 1)) * pi / 400_000
    assert 2 * pi * light.energy_scale(row, n) * integral == pytest.approx(1, abs=1e-7)


@pytest.mark.parametrize("n", [1, 7, 64])
@pytest.mark.parametrize("row", light.ROWS)
def test_hemisphere(row: str, n: float) -> None:
    """The integral over given cosines against the closed forms; nearly exact with 65536 steps."""
    c = np.linspace(0, 1, 65537)
    assert light.energy_scale(row, n) * light.hemisphere(row, c, c**n) == pytest.approx(1, abs=1e-6)


RESIDUALS = {  # of P3's table, and refitted
    "phong": (4.8e-4, 4.8e-4),
    "phong-modified": (1.3e-3, 1.3e-3),
    "blinn": (5.3e-3, 2.2e-3),
    "blinn-modified": (5.7e-2, 9.7e-3),
}


@pytest.mark.parametrize("row", RESIDUALS)
def test_tables(row: str) -> None:
    """Residuals with P3's lobe over the whole hemisphere, n = 16 .. 1024."""
    c = 1 - np.linspace(1, 0, 20001) ** 2
    worst = {"paper": 0.0, "refit": 0.0}
    for n in np.geomspace(16, 1024, 60):
        integral = light.hemisphere(row, c, light.lobe(c, n / 16))
        for table, residual in worst.items():
            worst[table] = max(residual, abs(light.energy_scale(row, n, table) * integral - 1))
    assert tuple(worst.values()) == pytest.approx(RESIDUALS[row], rel=0.03)


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
    """n (1 - c); phong's highlight turns twice as fast: four times that; diffuse light counts as n = 2."""
    c = cos(radians(10))
    assert light.kappa("blinn", at(5), at(15), 32) == pytest.approx(32 * (1 - c))
    assert light.kappa("phong", at(5), at(15), 32) == pytest.approx(128 * (1 - c))
    assert light.kappa("lambert", at(5), at(15), 32) == pytest.approx(2 * (1 - c))
    assert light.kappa("blinn", at(0), [0, 0, 5], 1024) == 0
    assert light.kappa("lambert", at(0), at(180), 1) == pytest.approx(4)
    assert light.kappa("blinn", np.zeros((0, 3)), np.zeros((0, 3)), 8).shape == (0,)


def test_sharpness() -> None:
    """The curvature of every highlight at its peak is that of cos^n with n its sharpness; Schlick's is taken higher.

    m = 0.2, light from the viewer: Cook-Torrance is cos^(2/m^2 - 4) / cos^2, Ward cos^(2/m^2) / cos.
    """
    h = 1e-3
    for model in ("phong", "blinn", "schlick", "cook-torrance", "ward"):
        peak, beside = (light.MODELS[model](at(a), [0, 0, 1], shininess=50, roughness=0.2) for a in (0, np.degrees(h)))
        curvature = 2 * (1 - beside / peak) / h**2
        factor = {"schlick": sqrt(2), "cook-torrance": 50 / 44, "ward": 50 / 49}.get(model, 1)
        assert light.sharpness(model, 50, 0.2) == pytest.approx(factor * curvature, rel=0.05), model
    assert light.sharpness("lambert", 50) == light.sharpness("blinn", 0.5) == 2


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
