# SPDX-License-Identifier: Apache-2.0
"""Polynomial shading of a raster line (paper P1): coefficients, evaluators, whole spans. Mirrors ``rtl/poly``.

Integers in units of 2^-16: node intensities S1.16 (18 bits), coefficients S8.16, values S10.16, t U1.16, pixels U0.16.
Every function takes arrays of any shape, with broadcasting.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from . import contract as k
from .fixed import Int, integers, round, saturate, third, wrap
from .stream import walk
from .types import RECORD, pack


def coef_a(degree: ArrayLike, i1, i2, i3, i4, *, nodes: int = k.NODES_LEFT, form: int = k.FORM_REFINED) -> Int:
    """A of the cubic through four nodes; 0 for a lower degree (``shade_coef_a``).

    Left {0, 1/4, 1/2, 1}: 8 (8 I2 + I4 - 3 I1 - 6 I3)/3, right {0, 1/2, 3/4, 1}: 8 (6 I2 + 3 I4 - I1 - 8 I3)/3,
    to nearest. Paper: only the part that P1 divides goes through its 43/128. |A| <= 48 max|I|.

    >>> int(coef_a(3, 0, 1024, 8192, 65536))  # the nodes of t^3
    65536
    """
    degree, i1, i2, i3, i4 = integers(degree, i1, i2, i3, i4)
    if nodes == k.NODES_LEFT:
        refined = third(8 * (8 * i2 + i4 - 3 * i1 - 6 * i3))
        paper = third(8 * (8 * i2 + i4), k.FORM_PAPER) - 8 * (i1 + 2 * i3)
    else:
        refined = third(8 * (6 * i2 + 3 * i4 - i1 - 8 * i3))
        paper = 8 * (2 * i2 + i4) + third(-8 * (i1 + 8 * i3), k.FORM_PAPER)
    return np.where(degree == k.DEGREE_CUBIC, refined if form == k.FORM_REFINED else paper, 0)


def coef_b(degree: ArrayLike, i1, i2, i3, i4, *, nodes: int = k.NODES_LEFT) -> Int:
    """B: of the cubic, or of the parabola through the nodes {0, 1/2, 1}; else 0 (``shade_coef_b``).

    Exact, |B| <= 76 max|I|.

    >>> int(coef_b(3, 0, 4096, 16384, 65536))  # the nodes of t^2
    65536
    """
    degree, i1, i2, i3, i4 = integers(degree, i1, i2, i3, i4)
    if nodes == k.NODES_LEFT:
        cubic = 2 * (7 * i1 - 16 * i2 + 10 * i3 - i4)
    else:
        cubic = 2 * (3 * i1 - 14 * i2 + 16 * i3 - 5 * i4)
    return np.select([degree == k.DEGREE_CUBIC, degree == k.DEGREE_QUADRATIC], [cubic, 2 * (i1 - 2 * i2 + i3)], 0)


def coef_c(degree: ArrayLike, i1, i2, i3, i4, *, nodes: int = k.NODES_LEFT, form: int = k.FORM_REFINED) -> Int:
    """C of the cubic, the parabola or the line; 0 for degree 0 (``shade_coef_c``). |C| <= 30 max|I|.

    Left: (32 I2 + I4 - 21 I1 - 12 I3)/3, right: (36 I2 + 9 I4 - 13 I1 - 32 I3)/3, to nearest;
    degree 2: 4 I2 - 3 I1 - I3; degree 1: I2 - I1.

    >>> int(coef_c(3, 0, 16384, 32768, 65536))  # the nodes of t
    65536
    """
    degree, i1, i2, i3, i4 = integers(degree, i1, i2, i3, i4)
    if nodes == k.NODES_LEFT:
        refined = third(32 * i2 + i4 - 21 * i1 - 12 * i3)
        paper = third(32 * i2 + i4, k.FORM_PAPER) - 7 * i1 - 4 * i3
    else:
        refined = third(36 * i2 + 9 * i4 - 13 * i1 - 32 * i3)
        paper = 3 * (4 * i2 + i4) + third(-(13 * i1 + 32 * i3), k.FORM_PAPER)
    cubic = refined if form == k.FORM_REFINED else paper
    lower = [4 * i2 - 3 * i1 - i3, i2 - i1]
    return np.select([degree == d for d in (k.DEGREE_CUBIC, k.DEGREE_QUADRATIC, k.DEGREE_LINEAR)], [cubic, *lower], 0)


def coef(degree: ArrayLike, i1, i2, i3, i4, *, nodes: int = k.NODES_LEFT, form: int = k.FORM_REFINED):
    """(A, B, C, D) of a span in the frame of the cubic, for degree 3, 2, 1 or 0 (``shade_coef``).

    >>> [int(v) for v in coef(2, 16384, 32768, 65536, 0)]  # 1/4, 1/2, 1 -> 0, 1/2, 1/4, 1/4
    [0, 32768, 16384, 16384]
    """
    degree, i1, i2, i3, i4 = integers(degree, i1, i2, i3, i4)
    return (
        coef_a(degree, i1, i2, i3, i4, nodes=nodes, form=form),
        coef_b(degree, i1, i2, i3, i4, nodes=nodes),
        coef_c(degree, i1, i2, i3, i4, nodes=nodes, form=form),
        i1,
    )


def horner_step(s: ArrayLike, t: ArrayLike, c: ArrayLike, *, t_f: int = k.T_F) -> Int:
    """round(s t) + c, t with t_f fraction bits (``shade_horner_step``).

    >>> int(horner_step(5, 8, 10, t_f=4))  # 5 * 1/2 rounds to 3
    13
    """
    s, t, c = integers(s, t, c)
    return round(s * t, t_f) + c


def horner(a: ArrayLike, b, c, d, t, *, t_f: int = k.T_F) -> Int:
    """((A t + B) t + C) t + D with three guard bits (``shade_horner_pipe``, ``shade_horner_seq``).

    Error at most 1/2 + 3/16 ulp: half an ulp of the guarded format after each of three products (t <= 1 does not
    amplify them), half an ulp at the end.

    >>> int(horner(65536, 65536, 65536, 65536, 32768)) / 65536
    1.875
    """
    a, b, c, d, t = integers(a, b, c, d, t)
    guard = k.HORNER_GUARD
    s = horner_step(a << guard, t, b << guard, t_f=t_f)
    s = horner_step(s, t, c << guard, t_f=t_f)
    s = horner_step(s, t, d << guard, t_f=t_f)
    return round(s, guard)


def fdiff(a: ArrayLike, b, c, d, log2: ArrayLike, j: ArrayLike) -> Int:
    """The polynomial at pixel j of a segment with h = 2^-log2, to nearest, ties up (``shade_fdiff``).

    Forward differences whose state keeps every fraction bit are exact; so is this: with t = j / 2^k all terms are whole
    multiples of 2^-3k, and one rounding gives the result. Error at most 1/2 ulp. j <= 2^k <= 2^12.

    >>> [int(v) for v in fdiff(0, 0, 65536, 16384, 2, np.arange(5))]  # C = 1, D = 1/4
    [16384, 32768, 49152, 65536, 81920]
    """
    a, b, c, d, log2, j = integers(a, b, c, d, log2, j)
    exact = ((a * j + (b << log2)) * j + (c << 2 * log2)) * j + (d << 3 * log2)
    drop = 3 * log2
    return (exact + (np.int64(1) << drop >> 1)) >> drop


def span_log2(count: ArrayLike) -> Int:
    """k = ceil(log2(count - 1)), 0 for two pixels and fewer: the pixels of a span lie at t = j 2^-k.

    >>> [int(v) for v in span_log2([1, 2, 3, 5, 6, 9, 4096])]
    [0, 0, 1, 2, 3, 3, 12]
    """
    (count,) = integers(count)
    steps = np.maximum(count - 2, 0)
    return sum((steps >> bit > 0).astype(np.int64) for bit in range(k.COUNT_W))


def span_walk(count: ArrayLike) -> tuple[Int, Int]:
    """The pixels of a sequence of records, in order: (index of the record, index j of the pixel in it).

    >>> [v.tolist() for v in span_walk([3, 2])]
    [[0, 0, 0, 1, 1], [0, 1, 2, 0, 1]]
    """
    return walk(count)


def poly_span(
    nodes: ArrayLike,
    degree: ArrayLike,
    count: ArrayLike,
    *,
    evaluator: int = k.EVALUATOR_HORNER,
    node_set: int = k.NODES_LEFT,
    form: int = k.FORM_REFINED,
) -> tuple[Int, Int]:
    """The pixels of a sequence of spans (``shade_poly_span``): (pixels (P, 2) U0.16, index of their span (P,)).

    ``nodes`` (S, 2, 4) S1.16: of every span and channel (diffuse, specular) the intensities at the nodes of its degree,
    t = 0 first; in direct mode those of its pixels. ``degree`` (S,) 0 .. 3, ``count`` (S,) pixels, in direct mode at
    most 4. Values are clamped to [0, 1 - 2^-16].

    >>> poly_span([[[0, 32768, 0, 0], [16384, 16384, 0, 0]]], [1], [3])[0].tolist()
    [[0, 16384], [16384, 16384], [32768, 16384]]
    """
    (nodes,) = integers(nodes)
    degree, count = integers(degree, count)
    span, j = span_walk(count)
    direct = np.flatnonzero(degree[span] == k.DEGREE_DIRECT)
    a, b, c, d = (v[span] for v in coef(degree[:, None], *np.moveaxis(nodes, -1, 0), nodes=node_set, form=form))
    d[direct] = nodes[span[direct], :, j[direct]]
    log2 = span_log2(count)[span, None]
    if evaluator == k.EVALUATOR_HORNER:
        value = horner(a, b, c, d, j[:, None] << (k.T_F - log2))
    else:
        value = fdiff(a, b, c, d, log2, j[:, None])
    return saturate(value, k.PIXEL_W), span


def poly_start(degree: ArrayLike, i1, i2, i3, i4, log2: ArrayLike, log2_max: int = k.RECORD_LOG2):
    """(d1, d2, d3): first forward differences of a channel's polynomial, h = 2^-log2 (``shade_poly_start``).

    In units of 2^-3 log2_max ulp, modulo 2^(20 + 3 log2_max), with the coefficients of ``coef``. Degree 1 .. 3.

    >>> [int(v) >> 15 for v in poly_start(1, 0, 32768, 0, 0, 1)]  # a line to 1/2 in two steps
    [16384, 0, 0]
    """
    degree, log2 = integers(degree, log2)
    a, b, c, _ = coef(degree, i1, i2, i3, i4)
    e = log2_max - log2
    cubic, square, line = a << 3 * e, b << 2 * e + log2_max, c << e + 2 * log2_max
    differences = cubic + square + line, 6 * cubic + 2 * square, 6 * cubic
    return tuple(wrap(d, k.INTENSITY_W + 2 + 3 * log2_max) for d in differences)


def poly_state(node: ArrayLike, d1, d2, d3, j: ArrayLike, log2_max: int = k.RECORD_LOG2) -> Int:
    """Pixel j of what begins with the node and these differences, U0.16 (``shade_poly_state``).

    >>> [int(v) for v in poly_state(0, 16384 << 15, 0, 0, np.arange(3))]
    [0, 16384, 32768]
    """
    node, d1, d2, d3, j = integers(node, d1, d2, d3, j)
    f, width = 3 * log2_max, k.INTENSITY_W + 2
    exact = (node << f) + j * d1 + (j * (j - 1) >> 1) * d2 + (j * (j - 1) * (j - 2) // 6) * d3
    return saturate(wrap(round(wrap(exact, width + f), f), width), k.PIXEL_W)


def poly_line(nodes: ArrayLike, degree: ArrayLike, count: ArrayLike) -> tuple[Int, Int]:
    """``poly_span`` by forward differences of records that are no shorter than a planner's (``shade_poly_line``).

    >>> poly_line([[[0, 32768, 0, 0], [16384, 16384, 0, 0]]], [1], [3])[0].tolist()
    [[0, 16384], [16384, 16384], [32768, 16384]]
    """
    return poly_span(nodes, degree, count, evaluator=k.EVALUATOR_FDIFF)


def pack_records(
    nodes: ArrayLike, degree: ArrayLike, count: ArrayLike, tag: ArrayLike = 0, more: ArrayLike = 0
) -> np.ndarray:
    """Records as beats of ``s_axis_span_tdata``: (S, 6) uint32, least significant word first. Layout: golden.types.

    ``more``: 1 where the span goes on in the next beat; its last pixel is not marked as the last.
    """
    (nodes,) = integers(nodes)
    lit = {
        f"{name}.n{i}": nodes[:, c, i] for c, name in enumerate(("diffuse", "specular")) for i in range(k.NODE_COUNT)
    }
    head = {"count": count, "more": more, "degree": degree, "tag": tag, "log2": span_log2(count)}
    return pack(RECORD, lit | {f"head.{name}": value for name, value in head.items()})
