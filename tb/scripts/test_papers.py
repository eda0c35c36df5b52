# SPDX-License-Identifier: Apache-2.0
"""The report on the papers at a small size: its shape, its figures, and numbers that are known by hand."""

import json
import math
from dataclasses import asdict
from xml.etree import ElementTree

import numpy as np
import pytest
from polyshade.golden import contract as k
from polyshade.golden.reference import light as reference_light
from polyshade.golden.reference import poly as reference
from polyshade.scripts.drawings import svg, waves
from polyshade.scripts.studies import papers
from polyshade.scripts.studies.papers import p2_criterion, p3_energy, p4_vectors
from polyshade.scripts.studies.papers.claims import check, nmse
from polyshade.scripts.studies.papers.lobe import C
from polyshade.scripts.studies.papers.p1_arithmetic import signed_digits
from polyshade.scripts.studies.papers.p1_light import run_direct, shape
from polyshade.scripts.studies.papers.p2_criterion import FORMS, decide, edge_error, edges_of, flat_eta
from polyshade.scripts.studies.papers.p3_energy import integral
from polyshade.scripts.studies.papers.p4_face import gains, middles
from polyshade.sim.scene.mesh import load_mesh

SIZE = 128
QUICK = (p2_criterion, p3_energy, p4_vectors)  # what the default run measures
KEYS = ["paper", "claim", "claimed", "measured", "holds"]


@pytest.fixture(scope="module")
def report(tmp_path_factory, request):
    """The folder of a report, and its rows: of all parts where a test runs that needs them."""
    out = tmp_path_factory.mktemp("build") / "papers.json"
    whole = any(item.path == request.path and item.get_closest_marker("full") for item in request.session.items)
    return out, papers.main(out, size=SIZE, parts=papers.PARTS if whole else QUICK)


def whole(*parameters: tuple) -> list:
    """Cases of rows that only the whole report has."""
    return [pytest.param(*each, marks=pytest.mark.full) for each in parameters]


def row(rows: list[dict], *words: str) -> dict:
    """The one row whose claim has all the words."""
    (found,) = (each for each in rows if all(word in each["claim"] for word in words))
    return found


def test_rows(report):
    out, rows = report
    assert json.loads(out.read_text()) == rows
    measured = {each["paper"] for each in rows}
    assert measured >= {"P2", "P3", "P4"}
    assert len(rows) > (250 if "P1" in measured else 100)
    assert len({each["claim"] for each in rows}) == len(rows)
    for each in rows:
        assert list(each)[: len(KEYS)] == KEYS
        assert all(math.isfinite(each[name]) for name in ("claimed", "measured"))
        assert isinstance(each["holds"], bool)
        assert each["kind"] in ("paper", "defect", "repair")
    assert [path.name for path in out.parent.iterdir() if path.name.startswith(".")] == []


def test_figures(report):
    out, rows = report
    drawn = {path.name: path.read_bytes() for path in (out.parent / "papers").iterdir()}
    assert {each["figure"] for each in rows} - {None} <= set(drawn)
    assert all(content.startswith(b"\x89PNG") and len(content) > 10_000 for content in drawn.values())


@pytest.mark.parametrize(
    ("words", "measured"),
    [
        (("least d1a",), (58589 + 3 * 459) / 65536),  # 0.894 + 3 * 0.007
        (("InvC2 of two equal normals",), 65668 / 131072),
        (("refined InvC of two equal normals",), 0),
        (("refined criterion: |eta| of a flat triangle",), 0),
        (("SLERP",), 4),
        (("bisection needs two roots",), 1),
        (("cos^n less its 16th power", "least"), 0),  # Bernoulli's inequality
        *whole(
            (("Fig. 7: relative error",), 100 / 128),
            (("relative error with 3 adders",), 2.0**-16),
            (("relative error with 4 adders",), 2.0**-32),
            (("constant intensity 1 ", "A, "), 0.1875),
            (("constant intensity 1 ", "C, "), 11 / 128),
            (("constant intensity 1 ", "I(1), "), 1 + 0.1875 + 11 / 128),
            (("times up to",), 24),
            (("more convenient",), 18),
            (("clocks a value", "five steps"), 6),
            (("pixels of 14 frames", "differ from the golden model"), 0),
            (("pixels of 36 frames", "differ from the golden model"), 0),
            (("V1 at 0.9 is V3",), 0),
            (("D16 as printed, without a clamp",), 1.875**16),  # kappa = 1/(8 0.04) - 1/4
            (("gain, D16", "exponential as 15"), 26 / 6),
            (("gain, Ward", "exponential as 15"), 20.5 / 5),
        ),
    ],
)
def test_known_values(report, words, measured):
    assert row(report[1], *words)["measured"] == pytest.approx(measured, rel=1e-9)


@pytest.mark.full
def test_constant_is_27_percent_too_bright(report):
    found = row(report[1], "too bright")
    assert found["holds"]
    assert found["measured"] == pytest.approx(100 * (0.1875 + 11 / 128), abs=0.01)  # 1 ulp of 1/2 is 0.003 %


@pytest.mark.full
def test_what_cannot_hold_is_reported(report):
    assert not row(report[1], "as printed", "diffuse")["holds"]
    assert row(report[1], "adaptive method, refined", "worst")["holds"]


@pytest.mark.parametrize(
    ("words", "measured"),
    [
        (("Fig. 2: largest relative error of diffuse light",), 0.49958),
        (("Chebyshev nodes, degree 1: largest absolute error",), 7.43e-3),
        (("truncated series, degree 2: largest absolute error",), 5.99e-4),
        (("d1a from d1",), 5.66),
        (("d2 from cos(x/2)",), 0.692),
        (("largest relative error of InvC1",), 3.41),
        (("largest relative error of InvC2",), 0.581),
        (("bigger part of the interval",), 97),
        (("Barrera",), 11.6),
        (("cos^n less its 16th power", "largest"), 0.0170),
        (("Table 1, phong:",), 4.7e-4),
        (("Table 1, blinn-modified, as printed",), 5.613e-2),
        *whole(
            (("Table 1, V3: largest error",), 13.4),
            (("Table 1, V6: largest error",), 10.1),
            (("Cook-Torrance D, 16th power as printed", "m = 0.3"), 3.21),
            (("Cook-Torrance D, 16th power as printed", "m = 0.6"), 47.6),
            (("Ward, 16th power as printed", "m = 0.6"), 11.94),
            (("Cook-Torrance D, shade_lobe", "m = 0.6"), 0.672),
        ),
    ],
)
def test_values_of_the_design(report, words, measured):
    """Numbers that double precision gave elsewhere, to their last digit."""
    assert row(report[1], *words)["measured"] == pytest.approx(measured, rel=3e-3)


@pytest.mark.full
def test_lobes(report):
    """P1's 16th power is exact to 1.3 % at one roughness only; the refined one keeps all that it promises."""
    printed = [each for each in report[1] if "16th power as printed: largest error" in each["claim"]]
    assert [each["claim"][-7:] for each in printed if each["holds"]] == ["m = 0.2"] * 2
    refined = [each for each in report[1] if "shade_lobe, refined: largest error" in each["claim"]]
    assert len(refined) == len(printed) == 10
    assert all(each["holds"] for each in refined)


@pytest.mark.full
def test_faces(report):
    """Every pixel lit by the RTL: P1's lobes show, the refined ones do not."""
    rows = [each for each in report[1] if each["claim"].startswith("Fig. 6")]
    assert [each["holds"] for each in rows] == [False, True] * 2


def test_energy_conserving_scales(report):
    """P3's residuals come out again, but for one; what the RTL gives never has more energy than it got."""
    rows = [each for each in report[1] if "up to 6/sqrt(n)" in each["claim"]]
    assert [each["holds"] for each in rows] == [True, True, True, False, True, True]
    assert all(each["holds"] for each in report[1] if "classic scale" in each["claim"])
    assert all(each["holds"] for each in report[1] if "as quantized" in each["claim"])


@pytest.mark.parametrize("row", reference_light.ROWS)
def test_integrals_of_table_1(row):
    """Gauss' rule against the trapezoidal rule of a fine grid; P3's cut loses what Blinn's lobe has beyond it."""
    half, weighted = reference_light.ROWS[row]
    t = np.linspace(0, np.pi / 2, 100_001)
    lobe = reference_light.lobe(np.cos(t / 2 if half else t), 100 / 16)
    summed = np.trapezoid(lobe * np.sin(t) * (np.cos(t) if weighted else 1), t)
    assert integral(row, 100) == pytest.approx(summed, rel=1e-8)
    assert (integral(row, 100, whole=False) < 0.999 * summed) == half


@pytest.mark.parametrize(("ward", "bound"), [(0, 2.5), (1, 1.25)])
@pytest.mark.parametrize("m", [0.05, 0.2, 0.45, 0.7])
def test_yardstick_of_the_lobe(ward, bound, m):
    """Every 17-bit cosine, over the whole range of the roughness."""
    exact = shape("ward" if ward else "cook-torrance", C, m)
    assert np.abs(run_direct(m, ward).y_o - 65536 * exact).max() <= bound


def test_refined_criterion_decides_like_the_exact_one(report):
    """P2's polynomials do not: they are not 0 for a flat triangle."""
    bars = [each for each in report[1] if "decides otherwise" in each["claim"]]
    assert len(bars) == 2 * 4 * len(FORMS)
    assert all(each["holds"] for each in bars if each["kind"] == "repair")
    assert not any(each["holds"] for each in bars if "linear" in each["claim"])


def test_criterion_of_edges():
    sphere = load_mesh("sphere")
    edges = edges_of(sphere)
    assert len(edges) == len(sphere.faces) * 3 // 2
    assert edges.tolist() == sorted(edges.tolist())
    for shares in (decide(sphere, edges), decide(sphere, sphere.faces)):
        assert not shares["refined"].any()
    for form, degree, _ in FORMS.values():
        flat = 3 * edge_error(form, degree)[-1]  # of c = 1, where the exact share is 0
        assert flat_eta(form, degree) == pytest.approx(flat, abs=2**-18)


def test_productivity_by_hand():
    """100 points in 10 lines have 45 even ones. Clocks: a point 5 * 4 + 6 * 4 + 14 + 16, its mean 3 * 4."""
    assert middles(np.arange(1, 20, 2)) == 45
    assert middles([0, 1, 2, 3, 4]) == 2
    before = 100 * 74 + 10 * (3 * 4 + 3 * 14)
    after = 55 * 74 + 45 * 12 + 10 * (4 * 4 + 5 * 4) + 3 * 4 + 3 * 14
    assert gains("V3") == pytest.approx((before / after, 600 / (330 + 50), 230 / 113))


def test_relations():
    relation = {
        claimed: check("x", claimed, 0.0142, paper="P").holds for claimed in ("= 1.4e-2", "= 1.3e-2", ">= 0.0142")
    }
    assert relation == {"= 1.4e-2": True, "= 1.3e-2": False, ">= 0.0142": True}
    assert not check("x", "<= 1e-4", 1.1e-4, paper="P").holds
    assert list(asdict(check("x", "= 1", 1, paper="P")))[: len(KEYS)] == KEYS


def test_nmse():
    assert nmse(np.array([1.0, 2.5]), np.array([1.0, 2.0])) == pytest.approx(0.25 / 5)


def test_signed_digits():
    """Against the definition: the fewest terms +-2^k with this sum, found by search."""
    reach = {0: {0}}
    powers = [sign << shift if sign > 0 else -(1 << shift) for shift in range(7) for sign in (1, -1)]
    for terms in (1, 2, 3):
        reach[terms] = {value + power for value in reach[terms - 1] for power in powers}
    for factor in range(40):
        assert signed_digits(factor) == min(terms for terms, values in reach.items() if factor in values)


@pytest.mark.parametrize("nodes", [k.NODES_LEFT, k.NODES_RIGHT])
@pytest.mark.parametrize("form", [k.FORM_PAPER, k.FORM_REFINED])
def test_reference_reproduces_cubics(nodes, form):
    cubic = (0.5, -1.25, 0.75, 0.125)
    intensity = reference.horner(cubic, np.array(reference.NODES[nodes][3]))
    assert np.allclose(reference.coef(3, intensity, nodes=nodes, form=form), cubic, atol=1e-13)


def test_waves(tmp_path):
    """Values that the rising edges see: three clocks of reset, then clocks 0 and 1; names below the module."""
    changes = "".join(
        f"#{2 * clock}\n0!\nb{value:b} $\n{value & 1}%\n#{2 * clock + 1}\n1!\n"
        for clock, value in enumerate([0, 0, 0, 5, 6])
    )
    (tmp_path / "m.vcd").write_text(
        "$timescale 1ps $end\n$scope module TOP $end\n$scope module m $end\n$var wire 1 ! clk_i $end\n"
        "$scope module u_x $end\n$var wire 3 $ x_q [2:0] $end\n$upscope $end\n$var wire 1 % y $end\n"
        f"$upscope $end\n$upscope $end\n$enddefinitions $end\n\n{changes}"
    )
    wave = waves.read(tmp_path / "m.vcd", ["u_x.x_q", "y"])
    assert {name: values.tolist() for name, values in wave.items()} == {"u_x.x_q": [5, 6], "y": [1, 0]}
    assert waves.read(tmp_path / "m.vcd", ["u_x.x_q"], signed=["u_x.x_q"])["u_x.x_q"].tolist() == [-3, -2]
    with pytest.raises(KeyError):
        waves.read(tmp_path / "m.vcd", ["z"])


def test_record_agrees_with_the_run():
    run, wave = waves.record("shade_rsqrt", ["y_o"], z_i=np.arange(1, 60))
    assert wave["y_o"][run.given].tolist() == run.y_o.tolist()


def test_timing_diagram(tmp_path):
    rows = [("valid", [0, 1, 1]), ("word", ["", "a < b", "a < b"])]
    svg.timing(rows, 30, "title", {"2 clocks": (1, 3)}).save(tmp_path / "t.svg")
    texts = [each.text for each in ElementTree.parse(tmp_path / "t.svg").iter() if each.tag.endswith("text")]
    assert texts.count("a < b") == 1  # equal neighbours are one word
    assert {"title", "clk_i", "valid", "2 clocks"} <= set(texts)
