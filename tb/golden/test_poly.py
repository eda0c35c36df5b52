# SPDX-License-Identifier: Apache-2.0
"""Polynomials against exact fractions, and against recurrences in Python's unbounded integers."""

from __future__ import annotations

import itertools
from fractions import Fraction
from math import floor

import numpy as np
import pytest
from polyshade.golden import contract as k
from polyshade.golden import poly
from polyshade.golden.reference.poly import NODES

from tb.runner import SEED

RNG = np.random.default_rng(SEED)
HALF = Fraction(1, 2)
ONE = 1 << k.INTENSITY_F
COEF = 1 << k.COEF_W - 1  # |A|, |B|, |C| are below


def signed(width: int, rows: int) -> list[int]:
    """Random numbers of a signed format, its ends among them."""
    low, high = -(1 << width - 1), (1 << width - 1) - 1
    return [low, high, *RNG.integers(low, high, rows - 2, endpoint=True).tolist()]


def interpolate(positions: tuple[float, ...], values: list[int]) -> list[Fraction]:
    """Coefficients, highest power first, of the polynomial through points: Newton's divided differences, expanded."""
    t = [Fraction(position) for position in positions]
    table = [Fraction(value) for value in values]
    for order in range(1, len(t)):
        for i in range(len(t) - 1, order - 1, -1):
            table[i] = (table[i] - table[i - 1]) / (t[i] - t[i - order])
    result: list[Fraction] = []
    for difference, position in zip(reversed(table), reversed(t), strict=True):  # result (t - position) + difference
        result = [a - position * b for a, b in zip([*result, Fraction(0)], [Fraction(0), *result], strict=True)]
        result[-1] += difference
    return result


def value(coefficients: list[int], t: Fraction) -> Fraction:
    """((A t + B) t + C) t + D, exactly."""
    result = Fraction(0)
    for coefficient in coefficients:
        result = result * t + int(coefficient)
    return result


def nearest(x: Fraction) -> int:
    """To nearest, ties up."""
    return floor(x + HALF)


# ---- coefficients ------------------------------------------------------------------------------------------------


def test_interpolate() -> None:
    """The helper itself: t^3 + 2 t through its own values."""
    t = (0, 0.25, 0.5, 1)
    assert interpolate(t, [Fraction(p) ** 3 + 2 * Fraction(p) for p in t]) == [1, 0, 2, 0]
    assert interpolate((0, 1), [5, 7]) == [2, 5]


@pytest.mark.parametrize("nodes", [k.NODES_LEFT, k.NODES_RIGHT])
@pytest.mark.parametrize("degree", [1, 2, 3])
def test_coefficients_are_those_of_the_interpolating_polynomial(degree: int, nodes: int) -> None:
    """A and C to nearest (never a tie: a third), B and D exact; so the polynomial meets its nodes within 2/3 ulp."""
    positions = NODES[nodes][degree]
    rows = np.array([signed(k.INTENSITY_W, 400) for _ in range(4)]).T
    rows = np.concatenate([rows, list(itertools.product((-ONE, 0, ONE), repeat=4))])
    for row in rows.tolist():
        golden = [int(c) for c in poly.coef(degree, *row, nodes=nodes)]
        exact = interpolate(positions, row[: degree + 1])
        exact = [Fraction(0)] * (4 - len(exact)) + exact
        assert golden[1::2] == exact[1::2]
        assert golden[0] == nearest(exact[0])
        assert golden[2] == nearest(exact[2])
        for position, intensity in zip(positions, row, strict=False):
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


def test_bounds_of_the_coefficients() -> None:
    """Sums of the weights' magnitudes, as the docstrings state them: 48, 76, 30."""
    signs = np.array(list(itertools.product((-3, 3), repeat=4)))
    worst = [0, 0, 0]
    for nodes, degree in itertools.product((k.NODES_LEFT, k.NODES_RIGHT), (1, 2, 3)):
        found = [np.abs(c).max() / 3 for c in poly.coef(degree, *signs.T, nodes=nodes)[:3]]
        worst = [max(pair) for pair in zip(worst, found, strict=True)]
    assert worst == [48, 76, 30]


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


def recurrence(a: int, b: int, c: int, d: int, log2: int) -> list[int]:
    """Forward differences as they stand in the book: I += d1, d1 += d2, d2 += d3; in units of 2^-3k ulp."""
    i, d1, d2, d3 = d << 3 * log2, a + (b << log2) + (c << 2 * log2), 6 * a + (2 * b << log2), 6 * a
    values = []
    for _ in range((1 << log2) + 1):
        values.append((i + (1 << 3 * log2 >> 1)) >> 3 * log2)
        i, d1, d2 = i + d1, d1 + d2, d2 + d3
    return values


@pytest.mark.parametrize("log2", range(k.LOG2_MAX + 1))
def test_fdiff_is_the_recurrence(log2: int) -> None:
    """At every pixel of a segment, the longest included; extreme coefficients first."""
    segments = [[COEF - 1] * 3 + [(1 << 17) - 1], [-COEF] * 3 + [-(1 << 17)], [-COEF, COEF - 1, -COEF, 0]]
    segments += np.array([signed(k.COEF_W, 8), signed(k.COEF_W, 8), signed(k.COEF_W, 8), signed(18, 8)]).T.tolist()
    for segment in segments[: 4 if log2 > 8 else None]:
        golden = poly.fdiff(*segment, log2, np.arange((1 << log2) + 1))
        assert golden.tolist() == recurrence(*segment, log2)


def test_evaluators_agree() -> None:
    """Horner and forward differences are never more than one ulp apart."""
    a, b, c, d = np.array([signed(k.COEF_W, 3000), signed(k.COEF_W, 3000), signed(k.COEF_W, 3000), signed(18, 3000)])
    log2 = RNG.integers(0, k.LOG2_MAX, 3000, endpoint=True)
    j = RNG.integers(0, 1 << log2, endpoint=True)
    apart = poly.horner(a, b, c, d, j << (k.T_F - log2)) - poly.fdiff(a, b, c, d, log2, j)
    assert np.abs(apart).max() == 1


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


@pytest.mark.parametrize("evaluator", [k.EVALUATOR_HORNER, k.EVALUATOR_FDIFF])
@pytest.mark.parametrize("form", [k.FORM_PAPER, k.FORM_REFINED])
@pytest.mark.parametrize("node_set", [k.NODES_LEFT, k.NODES_RIGHT])
def test_poly_span(evaluator: int, form: int, node_set: int) -> None:
    """Pixel by pixel: coefficients of the span, t = j / 2^k, clamped at the end and not before."""
    nodes = RNG.integers(-ONE, 2 * ONE, (40, k.CHANNELS, k.NODE_COUNT))
    degree = RNG.integers(0, 4, 40)
    count = np.where(degree == 0, RNG.integers(1, 5, 40), RNG.integers(1, 70, 40))
    pixels, owner = poly.poly_span(nodes, degree, count, evaluator=evaluator, form=form, node_set=node_set)
    expected = []
    for span, j in zip(*poly.span_walk(count), strict=True):
        row, log2 = [], int(poly.span_log2(count[span]))
        for channel in nodes[span]:
            if degree[span] == 0:
                raw = int(channel[j])
            else:
                cubic = [int(c) for c in poly.coef(degree[span], *channel, nodes=node_set, form=form)]
                if evaluator == k.EVALUATOR_FDIFF:
                    raw = nearest(value(cubic, Fraction(int(j), 1 << log2)))
                else:
                    raw = int(poly.horner(*cubic, int(j) << k.T_F - log2))
            row.append(min(max(raw, 0), (1 << k.PIXEL_W) - 1))
        expected.append(row)
    assert pixels.tolist() == expected
    assert np.array_equal(owner, poly.span_walk(count)[0])
    assert {0, (1 << k.PIXEL_W) - 1} <= set(pixels.ravel().tolist())  # both ends of the clamp were met


def test_nodes_are_pixels() -> None:
    """In a span of 2^k + 1 pixels every node of the cubic is a pixel, and has the node's value within an ulp."""
    nodes = RNG.integers(0, ONE - 1, (50, k.CHANNELS, k.NODE_COUNT))
    for evaluator in (k.EVALUATOR_HORNER, k.EVALUATOR_FDIFF):
        pixels, _ = poly.poly_span(nodes, np.full(50, 3), np.full(50, 65), evaluator=evaluator)
        at_nodes = pixels.reshape(50, 65, 2)[:, [0, 16, 32, 64]].swapaxes(1, 2)
        assert np.abs(at_nodes - nodes).max() <= 1
        assert np.array_equal(at_nodes[..., 0], nodes[..., 0])


def test_pack_records() -> None:
    """Field by field into one number of 192 bits, as the contract lays it out."""
    nodes = np.array([signed(k.INTENSITY_W, 80)]).reshape(10, k.CHANNELS, k.NODE_COUNT)
    degree, count, tag = np.arange(10) % 4, RNG.integers(0, 1 << k.COUNT_W, 10), RNG.integers(0, 1 << k.TAG_W, 10)
    beats = poly.pack_records(nodes, degree, count, tag)
    assert (beats.dtype, beats.shape) == (np.uint32, (10, 6))
    for row, beat in enumerate(beats):
        number = sum(int(word) << 32 * i for i, word in enumerate(beat))
        fields = [int(v) % (1 << k.INTENSITY_W) << k.INTENSITY_W * i for i, v in enumerate(nodes[row].ravel())]
        fields += [int(count[row]) << k.RECORD_COUNT_LSB, int(degree[row]) << k.RECORD_DEGREE_LSB]
        log2 = int(poly.span_log2(count[row]))
        assert number == sum(fields) + (int(tag[row]) << k.RECORD_TAG_LSB) + (log2 << k.RECORD_TAG_LSB + k.TAG_W)


def test_nothing_to_pack() -> None:
    none = np.zeros(0, int)
    assert poly.pack_records(np.zeros((0, 2, 4), int), none, none, none).shape == (0, 6)
    assert poly.poly_span(np.zeros((0, 2, 4), int), none, none)[0].shape == (0, 2)
