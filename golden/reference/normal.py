# SPDX-License-Identifier: Apache-2.0
"""Unit normals in float64: P2's criterion, P4's metrics and midpoints, and the methods that both compare with.

Vectors are arrays (..., 3), c is the cosine between two of them, z = N.N the square of a length. Formulas of a
datapath take ``q``, through which their constants, products, quotients and roots pass: :func:`fixed` makes of the
float64 formula that of a datapath with 16 fraction bits.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.polynomial import Chebyshev, Polynomial
from numpy.typing import ArrayLike, NDArray

from .. import contract as k

Floats = NDArray[np.float64]
Quantizer = Callable[[ArrayLike], ArrayLike]

LIMIT = np.cos(np.pi / 4)
"""Cosine at which d2 changes its straight line."""
ROOT5 = (0.2075806, 1.454895, -1.34491, 1.106812, -0.536499, 0.1121216)
"""Coefficients of 1, z, ... z^5 in the square root of Analog Devices (P4, section 2)."""
SERIES_DEGREE = 40  # the terms of a Chebyshev series beyond it are below the float64 resolution


def real(x: ArrayLike) -> ArrayLike:
    """x: no rounding."""
    return x


def fixed(x: ArrayLike) -> Floats:
    """x rounded to 16 fraction bits, ties up.

    >>> float(fixed(1 / 3)) * 65536
    21845.0
    """
    return np.floor(np.asarray(x) * (1 << k.INTENSITY_F) + 0.5) / (1 << k.INTENSITY_F)


def dot(a: ArrayLike, b: ArrayLike) -> Floats:
    """a . b of vectors (..., 3), shape (..., 1)."""
    return np.sum(np.asarray(a) * b, axis=-1, keepdims=True)


# ---- P2: can normalization be left out? --------------------------------------------------------------------------


def shortfall(c: ArrayLike) -> Floats:
    """delta = 1 - sqrt((1 + c)/2): by how much the middle of two unit normals is too short, and diffuse light too dark.

    >>> round(100 * float(shortfall(np.cos(0.2))), 5)  # per cent, at 0.2 rad (P2, Fig. 2)
    0.49958
    """
    return 1 - np.sqrt((1 + np.asarray(c)) / 2)


def specular_shortfall(c: ArrayLike, n: ArrayLike) -> Floats:
    """1 - ((1 + c)/2)^(n/2): by how much cos^n is too dark in the middle of two unit normals (P2, Fig. 5)."""
    return 1 - ((1 + np.asarray(c)) / 2) ** (np.asarray(n) / 2)


def criterion(ab: ArrayLike, bc: ArrayLike, ca: ArrayLike) -> Floats:
    """eta of a triangle with these cosines between its normals: the sum of ``shortfall`` over its edges (P2)."""
    return shortfall(ab) + shortfall(bc) + shortfall(ca)


def chebyshev(function: Callable[[Floats], Floats], degree: int, *, series: bool = False) -> Floats:
    """Coefficients of 1, c, c^2, ... of a Chebyshev approximation on [0, 1].

    The polynomial through the Chebyshev nodes, or with ``series`` the truncated Chebyshev series.

    >>> [round(float(a), 8) for a in chebyshev(shortfall, 1)]
    [0.28546133, -0.29073021]
    """
    fitted = Chebyshev.interpolate(function, SERIES_DEGREE if series else degree, domain=[0, 1])
    return fitted.truncate(degree + 1).convert(kind=Polynomial).coef


# ---- P4: length of a middle --------------------------------------------------------------------------------------


def d1(c: ArrayLike, m: ArrayLike) -> Floats:
    """cos(x/m), x the angle between the ends of a line of m sectors: the length of a middle of two points."""
    return np.cos(np.arccos(c) / m)


def d1a(c: ArrayLike, m: ArrayLike) -> Floats:
    """0.06 c + 0.007 m + 0.894, P4's estimate of ``d1`` for m = 3 .. 12.

    >>> round(float(d1a(0, 3)), 3)  # its least value
    0.915
    """
    return 0.06 * np.asarray(c) + 0.007 * np.asarray(m) + 0.894


def d2(c: ArrayLike) -> Floats:
    """P4's estimate of cos(x/2): 0.25 c + 0.75 for x < pi/4, else 0.305 c + 0.712."""
    c = np.asarray(c)
    return np.where(c > LIMIT, 0.25 * c + 0.75, 0.305 * c + 0.712)


# ---- factors that make the middle (a + b) a unit vector, from c --------------------------------------------------


def invc(c: ArrayLike, q: Quantizer = real) -> Floats:
    """InvC = 1/sqrt(2 (1 + c)), which is also the first step of bisection: a root and a division."""
    return q(1 / q(np.sqrt(2 * (1 + c))))


def invc1(c: ArrayLike, q: Quantizer = real) -> Floats:
    """0.683 - 0.191 c (P4).

    >>> round(float(invc1(1)), 3)  # of two equal normals; it should be 1/2
    0.492
    """
    return q(0.683) - q(q(0.191) * c)


def invc2(c: ArrayLike, q: Quantizer = real) -> Floats:
    """0.703 - 0.3 c + 0.098 c^2 (P4).

    >>> round(float(invc2(1)), 3)
    0.501
    """
    return q(0.703) - q((q(0.3) - q(q(0.098) * c)) * c)


def barrera(c: ArrayLike, q: Quantizer = real) -> Floats:
    """(5 - c)/8, Barrera's middle: the same as one Newton-Raphson step on (a + b)/2, whose z is (1 + c)/2."""
    return q((5 - c) / 8)


# ---- factors that make any vector a unit vector, from z ----------------------------------------------------------


def rsqrt(z: ArrayLike, q: Quantizer = real) -> Floats:
    """1/sqrt(z): a root and a division."""
    return q(1 / q(np.sqrt(z)))


def lyon_printed(z: ArrayLike, q: Quantizer = real) -> Floats:
    """1 + ((1 - z) + (1 - z)^2)/2, Lyon's factor as P4 prints it."""
    u = 1 - z
    return 1 + q((u + q(u * u)) / 2)


def lyon(z: ArrayLike, q: Quantizer = real) -> Floats:
    """1 + u/2 + 3 u^2/8, u = 1 - z: three terms of the Taylor series, which Lyon's factor is."""
    u = 1 - z
    return 1 + q(u * (1 / 2 + q(0.375 * u)))


def newton(z: ArrayLike, q: Quantizer = real) -> Floats:
    """(3 - z)/2, one Newton-Raphson step from 1 (P2)."""
    return q((3 - z) / 2)


def root5(z: ArrayLike, q: Quantizer = real) -> Floats:
    """1/p(z), p the root of degree 5 of Analog Devices (``ROOT5``) by Horner's scheme; made for 1/2 <= z <= 1."""
    root = q(ROOT5[-1])
    for coefficient in ROOT5[-2::-1]:
        root = q(root * z) + q(coefficient)
    return q(1 / root)


# ---- vectors -----------------------------------------------------------------------------------------------------


def middle_by_cosine(factor: Callable, a: ArrayLike, b: ArrayLike, q: Quantizer = real) -> Floats:
    """(a + b) factor(c) for a factor such as ``invc``."""
    a, b = np.asarray(a), np.asarray(b)
    return q((a + b) * factor(q(dot(a, b)), q))


def middle_by_length(factor: Callable, a: ArrayLike, b: ArrayLike, q: Quantizer = real) -> Floats:
    """N factor(N.N) of N = (a + b)/2 for a factor such as ``rsqrt``."""
    n = q((np.asarray(a) + np.asarray(b)) / 2)
    return q(n * factor(q(dot(n, n)), q))


def slerp(a: ArrayLike, b: ArrayLike, t: float = 1 / 2, q: Quantizer = real) -> Floats:
    """(a sin((1 - t) x) + b sin(t x))/sin x, x the angle between a and b; a where they are equal.

    >>> slerp([1, 0, 0], [0, 1, 0], 1 / 3).round(4).tolist()  # 30 of 90 degrees
    [0.866, 0.5, 0.0]
    """
    a, b = np.asarray(a), np.asarray(b)
    x = q(np.arccos(np.clip(q(dot(a, b)), -1, 1)))
    whole = q(np.sin(x))
    equal = whole == 0
    safe = np.where(equal, 1, whole)
    wa, wb = (q(q(np.sin(q(part * x))) / safe) for part in (1 - t, t))
    return np.where(equal, a, q(a * wa) + q(b * wb))


def bisection(a: ArrayLike, b: ArrayLike, steps: int, q: Quantizer = real) -> list[Floats]:
    """The unit normals at 1/2, 1/4, ... of the arc from a to b.

    N_(k+1) = (a + N_k)/z_k with z_k = sqrt(2 (1 + cos(x/2^k))); since z_k/2 is the cosine of the next half angle,
    z_(k+1) = sqrt(2 + z_k): one root a step, not the two that P4 counts.

    >>> [n.round(4).tolist() for n in bisection([1, 0, 0], [0, 1, 0], 2)]  # at 45 and at 22.5 degrees
    [[0.7071, 0.7071, 0.0], [0.9239, 0.3827, 0.0]]
    """
    a, n = np.asarray(a), np.asarray(b)
    z = 2 * q(dot(a, n))
    found = []
    for _ in range(steps):
        z = q(np.sqrt(2 + z))
        n = q((a + n) * q(1 / z))
        found.append(n)
    return found


# ---- the methods beside each other -------------------------------------------------------------------------------


class Operations(NamedTuple):
    """How many operations a method takes; halves, doubles and the like cost nothing in hardware and are left out."""

    additions: int
    multiplications: int
    divisions: int = 0
    roots: int = 0
    trigonometric: int = 0


class Method(NamedTuple):
    """A way to the unit normal in the middle of two: ``middle(a, b, q=real)``, and what it costs, a + b included."""

    middle: Callable[..., Floats]
    operations: Operations


METHODS = {
    "root and division": Method(partial(middle_by_length, rsqrt), Operations(5, 6, 1, 1)),
    "Lyon, as printed": Method(partial(middle_by_length, lyon_printed), Operations(8, 7)),
    "Lyon, series": Method(partial(middle_by_length, lyon), Operations(8, 8)),
    "Newton-Raphson step": Method(partial(middle_by_length, newton), Operations(6, 6)),
    "degree-5 root": Method(partial(middle_by_length, root5), Operations(10, 11, 1)),
    "Barrera": Method(partial(middle_by_cosine, barrera), Operations(6, 6)),
    "InvC1": Method(partial(middle_by_cosine, invc1), Operations(6, 7)),
    "InvC2": Method(partial(middle_by_cosine, invc2), Operations(7, 8)),
    "SLERP": Method(lambda a, b, q=real: slerp(a, b, q=q), Operations(5, 9, 2, 0, 4)),
    "bisection": Method(lambda a, b, q=real: bisection(a, b, 1, q)[0], Operations(6, 6, 1, 1)),
}
"""Methods by name, in the order of the papers' texts."""


def length_error(vectors: ArrayLike) -> Floats:
    """| |v| - 1 | of vectors (..., 3)."""
    return np.abs(np.linalg.norm(vectors, axis=-1) - 1)


def arcs(angles: Sequence[float] | Floats, count: int, rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Random pairs of unit normals, each (len(angles), count, 3), with these angles between them, in radians."""
    a, across = rng.normal(size=(2, len(angles), count, 3))
    a /= np.linalg.norm(a, axis=-1, keepdims=True)
    across -= dot(across, a) * a
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    x = np.asarray(angles)[:, None, None]
    return a, a * np.cos(x) + across * np.sin(x)
