# SPDX-License-Identifier: Apache-2.0
"""Polynomials against exact fractions, and against recurrences in Python's unbounded integers."""

from __future__ import annotations

import itertools
from fractions import Fraction

import numpy as np
import pytest
from polyshade.golden import contract as k
from polyshade.golden import poly
from polyshade.golden.reference.poly import NODES

from tb.runner import SEED

RNG = np.random.default_rng(SEED)
ONE = 1 << k.INTENSITY_F
COEF = 1 << k.COEF_W - 1  # |A|, |B|, |C| are below


def signed(width: int, rows: int) -> list[int]:
    """Random numbers of a signed format, its ends among them."""
    low, high = -(1 << width - 1), (1 << width - 1) - 1
    return [low, high, *RNG.integers(low, high, rows - 2, endpoint=True).tolist()]


def value(coefficients: list[int], t: Fraction) -> Fraction:
    """((A t + B) t + C) t + D, exactly."""
    result = Fraction(0)
    for coefficient in coefficients:
        result = result * t + int(coefficient)
    return result


# ---- coefficients ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("nodes", [k.NODES_LEFT, k.NODES_RIGHT])
@pytest.mark.parametrize("degree", [1, 2, 3])
def test_the_polynomial_meets_its_nodes(degree: int, nodes: int) -> None:
    """Within 2/3 ulp, as A and C of a cubic are rounded thirds; one of lower degree exactly."""
    rows = np.array([signed(k.INTENSITY_W, 400) for _ in range(4)]).T
    rows = np.concatenate([rows, list(itertools.product((-ONE, 0, ONE), repeat=4))])
    for row in rows.tolist():
        golden = [int(c) for c in poly.coef(degree, *row, nodes=nodes)]
        assert not any(golden[: 3 - degree])
        for position, intensity in zip(NODES[nodes][degree], row, strict=False):
            t = Fraction(position)
            error = abs(value(golden, t) - intensity)
            assert error <= Fraction(1, 3) * (t**3 + t) if degree == 3 else error == 0


def test_the_defect_of_the_paper() -> None:
    """A constant 1 comes out with A = 0.1875, C = 0.0859375, 27 % too bright at the end; refined it stays constant."""
    paper = poly.coef(3, ONE, ONE, ONE, ONE, form=k.FORM_PAPER)
    assert [int(c) / ONE for c in paper] == [0.1875, 0, 0.0859375, 1]
    assert int(poly.horner(*paper, 1 << k.T_F)) / ONE == 1.2734375
    for nodes in (k.NODES_LEFT, k.NODES_RIGHT):
        assert [int(c) for c in poly.coef(3, ONE, ONE, ONE, ONE, nodes=nodes)] == [0, 0, 0, ONE]


@pytest.mark.parametrize(
    ("degree", "nodes", "expected"),
    [
        (0, (5, 9, 9, 9), (0, 0, 0, 5)),
        (1, (5, 9, 77, 77), (0, 0, 4, 5)),  # unused nodes have no part in it
        (2, (1, 2, 5, 77), (0, 4, 0, 1)),  # 4 t^2 + 1
        (3, (0, 1, 8, 64), (64, 0, 0, 0)),  # 64 t^3
        (3, (0, 4, 16, 64), (0, 64, 0, 0)),
        (3, (7, 7, 7, 10), (8, -6, 1, 7)),  # through (1, 3) over 7: 8 t^3 - 6 t^2 + t
    ],
)
def test_coefficients_by_hand(degree: int, nodes: tuple[int, ...], expected: tuple[int, ...]) -> None:
    assert tuple(int(c) for c in poly.coef(degree, *nodes)) == expected


@pytest.mark.parametrize("form", [k.FORM_PAPER, k.FORM_REFINED])
@pytest.mark.parametrize("nodes", [k.NODES_LEFT, k.NODES_RIGHT])
def test_no_coefficient_overflows(nodes: int, form: int) -> None:
    """They are sums of multiples, so the ends of the range are the worst; these fit COEF_W bits, and values VALUE_W."""
    low, high = -(1 << k.INTENSITY_W - 1), (1 << k.INTENSITY_W - 1) - 1
    corners = np.array(list(itertools.product((low, high), repeat=4)))
    for degree in range(4):
        a, b, c, d = poly.coef(degree, *corners.T, nodes=nodes, form=form)
        assert np.abs([a, b, c]).max() < COEF
        t = np.linspace(0, 1 << k.T_F, 257).astype(int)[:, None]
        assert np.abs(poly.horner(a, b, c, d, t)).max() < 1 << k.VALUE_W - 1


def test_coefficients_broadcast() -> None:
    """Degrees by row, as poly_span asks for them."""
    degree = np.arange(4)[:, None]
    a, b, c, _ = poly.coef(degree, 0, ONE // 4, ONE // 2, ONE)
    assert a.shape == b.shape == c.shape == (4, 1)
    assert c[:, 0].tolist() == [0, ONE // 4, ONE // 2, ONE]
    assert b[:, 0].tolist() == [0, 0, 0, 0]
    assert poly.coef_a(degree, np.zeros((4, 5), int), 0, 0, 0).shape == (4, 5)
    with pytest.raises(TypeError, match="integers expected"):
        poly.coef(3, 0.5, 0, 0, 0)


# ---- evaluators --------------------------------------------------------------------------------------------------


def test_horner_by_hand() -> None:
    """(3 t + 5) t + 7) t + 11 at 1/2 = 15.625, in ulps and with 4 fraction bits of t; exact at t = 0 and t = 1."""
    coefficients = np.array([*(signed(k.COEF_W, 2000) for _ in "abc"), signed(k.INTENSITY_W, 2000)])
    assert np.array_equal(poly.horner(*coefficients, 0), coefficients[3])
    assert np.array_equal(poly.horner(*coefficients, 1 << k.T_F), coefficients.sum(axis=0))
    assert poly.horner(3, 5, 7, 11, 1 << 15) == 16
    assert poly.horner(3, 5, 7, 11, 8, t_f=4) == 16
    assert poly.horner(30, 50, 70, 110, 1 << 15) == 161  # 161.25
    assert poly.horner(-3, -5, -7, -11, 1 << 15) == -16  # -15.625


# ---- spans -------------------------------------------------------------------------------------------------------


def test_span_log2() -> None:
    """The smallest k with count - 1 <= 2^k, for every count there can be."""
    for count, log2 in enumerate(poly.span_log2(np.arange(1 << k.COUNT_W)).tolist()):
        assert count - 1 <= 1 << log2
        assert log2 == 0 or count - 1 > 1 << log2 - 1


def test_span_walk() -> None:
    """Every pixel of every span, in order."""
    count = RNG.integers(0, 12, 300)
    expected = [(span, j) for span, n in enumerate(count.tolist()) for j in range(n)]
    assert list(zip(*(v.tolist() for v in poly.span_walk(count)), strict=True)) == expected
    assert [len(v) for v in poly.span_walk(np.zeros(0, int))] == [0, 0]


def test_nodes_are_pixels() -> None:
    """In a span of 2^k + 1 pixels every node of the cubic is a pixel, and has the node's value within an ulp."""
    nodes = RNG.integers(0, ONE - 1, (50, k.CHANNELS, k.NODE_COUNT))
    for evaluator in (k.EVALUATOR_HORNER, k.EVALUATOR_FDIFF):
        pixels, _ = poly.poly_span(nodes, np.full(50, 3), np.full(50, 65), evaluator=evaluator)
        at_nodes = pixels.reshape(50, 65, 2)[:, [0, 16, 32, 64]].swapaxes(1, 2)
        assert np.abs(at_nodes - nodes).max() <= 1
        assert np.array_equal(at_nodes[..., 0], nodes[..., 0])


def test_nothing_to_pack() -> None:
    none = np.zeros(0, int)
    assert poly.pack_records(np.zeros((0, 2, 4), int), none, none, none).shape == (0, 6)
    assert poly.poly_span(np.zeros((0, 2, 4), int), none, none)[0].shape == (0, 2)
