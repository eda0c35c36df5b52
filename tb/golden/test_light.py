# SPDX-License-Identifier: Apache-2.0
"""golden.light: angles, directions, Fresnel's factor and colours by hand, in exact fractions."""

from fractions import Fraction

import numpy as np
import pytest
from polyshade.golden import contract as k
from polyshade.golden import light
from polyshade.golden.fixed import ONE

AXES = np.eye(3, dtype=int) * ONE
CUT = k.VERSINE_CUT
TWO = 2 << k.VERSINE_F - CUT  # x of opposite vectors, U2.20


def versine(*vectors: int, form: int = k.FORM_REFINED) -> list[int]:
    """x, cut to U2.20, and its range."""
    x, told = light.versine(*vectors, form=form)
    return [int(x) >> CUT, int(told)]


def ints(values) -> list[int]:
    return [int(value) for value in values]


@pytest.mark.parametrize(("form", "opposite"), [(k.FORM_REFINED, TWO - 32), (k.FORM_PAPER, TWO)])
def test_versine_of_axes(form: int, opposite: int) -> None:
    """0 of equal ones, 1 of perpendicular ones, 2 of opposite ones: less 2^-15 where 2 saturates to 2 - 2^-16."""
    for i, a in enumerate(AXES):
        assert versine(*a, *a, form=form) == [0, 0]
        assert versine(*a, *AXES[i - 1], form=form) == [TWO // 2, 0]
        assert versine(*a, *-a, form=form) == [opposite, 0]


def test_versine_of_lengths_that_are_wrong() -> None:
    """A vector one ulp too long or too short: the chord sees next to nothing, the dot product all of it, clamped."""
    for wrong, dot in ((ONE + 1, [0, 1]), (ONE - 1, [16, 0])):
        assert versine(0, 0, ONE, 0, 0, wrong) == [0, 0]
        assert versine(0, 0, ONE, 0, 0, wrong, form=k.FORM_PAPER) == dot


def test_versine_out_of_range() -> None:
    for form in (k.FORM_REFINED, k.FORM_PAPER):
        assert versine(*[2 * ONE - 1] * 3, *[-2 * ONE] * 3, form=form) == [TWO, 1]
    assert versine(*[-2 * ONE] * 6, form=k.FORM_PAPER) == [0, 1]


def test_versine_of_every_shift() -> None:
    """Half a last place of the bits that count: a chord of 2^-16 is x = 2^-33, of 3 2^-15 it is 9 2^-31."""
    for shift in range(k.LOBE_FINE + 1):
        places = 0 if shift == k.LOBE_FINE else shift
        for far in (1, 6, 300, 3000):
            x, _ = light.versine(0, 0, ONE, far, 0, ONE, shift)
            exact = Fraction(far * far, 2**33)
            assert int(x) / 2 ** (CUT - places) == int(exact * 2 ** (k.VERSINE_F - CUT + places) + Fraction(1, 2))


def test_reflect() -> None:
    """From the normal, along the surface, from behind; 3-4-5; so long that it saturates."""
    z = AXES[2]
    assert ints(light.reflect(*z, *z)) == [0, 0, ONE]
    assert ints(light.reflect(*z, *AXES[0])) == [-ONE, 0, 0]
    assert ints(light.reflect(*z, *-z)) == [0, 0, 1 - ONE]  # 2 saturates
    third, fourth = round(Fraction(3, 5) * ONE), round(Fraction(4, 5) * ONE)
    assert ints(light.reflect(*z, third, 0, fourth)) == [-third, 0, fourth]
    most, least = 2 * ONE - 1, -2 * ONE
    assert ints(light.reflect(most, most, most, least, most, most)) == [most, most, most]
    assert ints(light.reflect(least, most, most, most, most, most)) == [least, most, most]


def test_halfway() -> None:
    x, _, z = AXES
    diagonal = round(ONE / np.sqrt(2))
    assert ints(light.halfway(*z, *z)) == [0, 0, ONE, ONE]
    assert ints(light.halfway(*x, *z)) == [diagonal, 0, diagonal, diagonal]
    assert ints(light.halfway(*z, *-z)) == [0, 0, 0, 0]
    assert ints(light.halfway(1, 0, -ONE, *z)) == [ONE, 0, 0, 0]  # the shortest sum there is


def test_fresnel() -> None:
    """F0 at c = 1, 1 at c = 0; what is above 1 counts as 1."""
    f0 = np.arange(0, ONE + 1, 255)
    assert np.array_equal(light.fresnel([ONE, ONE + 1, 2 * ONE - 1], f0[:, None]), f0[:, None].repeat(3, axis=1))
    assert np.all(light.fresnel(0, f0) == ONE)
    assert np.all(light.fresnel([0, 77, ONE], 2 * ONE - 1) == ONE)


def test_powers_of_the_lobe() -> None:
    """(1 - x)^(2^power) of an x of few bits; more squarings than stages count as these; 0 beyond x = 1, always."""
    x, highlight = 3 << k.VERSINE_F - 4, (1 << k.LOBE_K1_F, 0, 0, ONE)
    expected = [round(Fraction(13, 16) ** (1 << power) * ONE) for power in (0, 1, 2, 3, 4, 4, 4, 4)]
    assert ints(light.lobe(x, *highlight, np.arange(8))) == expected
    assert ints(light.lobe(x, *highlight, np.arange(8), stages=2)) == expected[:3] + expected[2:3] * 5
    assert ints(light.lobe((TWO // 2 + 1) << CUT, *highlight, np.arange(8))) == [0] * 8


def test_colour() -> None:
    """Negative light is none; half an ulp rounds up; the sum saturates."""
    assert light.colour(-ONE, -1, 1234, ONE, ONE) == 1234
    assert light.colour(1, 0, 0, [ONE // 2, ONE // 2 - 1], 0).tolist() == [1, 0]
    assert light.colour(ONE - 2, 1, 0, ONE, ONE) == ONE - 1
    assert light.colour(ONE - 1, 1, 0, ONE, ONE) == ONE - 1
    assert light.colour(*[2 * ONE - 1] * 5) == ONE - 1
