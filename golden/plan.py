# SPDX-License-Identifier: Apache-2.0
"""The planner: cuts a span into records that ``shade_poly_span`` draws, by one number: the kappa ladder.

Along an arc whose end normals have the dot product c, the error of interpolating cos^n depends on

    kappa = n (1 - c)

alone, and half the length has a quarter of it. So shifts and three comparisons choose the length of the segments, a
power of two of pixels, and their degree:

    k = largest with kappa(2^k) <= T3;   degree 1 if kappa(2^k) <= T1, 2 if <= T2, else 3

Where not even 4 pixels are short enough, pixels are lit directly, four a record. So are those of a last record with no
more pixels than its polynomial has nodes; the others share their nodes with their neighbours. Integers: kappa and the
thresholds are U11.20. Mirrors ``rtl/plan``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import contract as k
from .fixed import ONE, Int, clamp, integers, round, weigh, wrap
from .normal import unit
from .poly import span_log2
from .stream import walk

KAPPA_F = k.KAPPA_F
KAPPA_MAX = (1 << k.KAPPA_W) - 1
THRESHOLDS = tuple(int(t * (1 << KAPPA_F)) for t in (3 / 64, 5 / 16, 1))  # T1, T2, T3

# position of node i in quarters of a segment, by degree (node set left)
QUARTERS = np.array([[0, 0, 0, 0], [0, 4, 0, 0], [0, 2, 4, 0], [0, 1, 2, 4]])


@dataclass(frozen=True)
class Records:
    """What the spans become: arrays (R,), ordered by span and start.

    Pixel ``start`` .. ``start + count - 1`` of ``span`` lie at t = j / 2^log2. ``degree`` 0: lit directly.
    """

    span: Int
    start: Int
    count: Int
    degree: Int
    log2: Int

    def __len__(self) -> int:
        return len(self.span)

    @property
    def nodes(self) -> Int:
        """(R, 4) position, in pixels from the span's start, of every node; unused ones repeat the first.

        Every node lies on a pixel, so that neighbouring records share the node between them. (The last record of a span
        may reach beyond its end: its last nodes continue the line of normals.)
        """
        steps = (QUARTERS[self.degree] << self.log2[:, None]) >> 2
        pixels = np.minimum(np.arange(k.NODE_COUNT), self.count[:, None] - 1)
        return self.start[:, None] + np.where(self.degree[:, None] == k.DEGREE_DIRECT, pixels, steps)


def quantize_kappa(kappa: ArrayLike) -> Int:
    """Real kappa to U11.20, to nearest, saturating."""
    return np.clip(np.rint(np.asarray(kappa, float) * (1 << KAPPA_F)), 0, KAPPA_MAX).astype(np.int64)


def quantize_sharpness(n: float) -> tuple[int, int]:
    """(mantissa, exponent) of a sharpness: n = mantissa 2^-16 2^exponent, mantissa U1.16 in [1, 2), to nearest.

    >>> quantize_sharpness(48)
    (98304, 5)
    """
    fraction, exponent = np.frexp(n)
    mantissa = int(np.rint(np.ldexp(fraction, k.SHARPNESS_F + 1)))
    carry = mantissa >> k.SHARPNESS_F + 1
    return mantissa >> carry, int(exponent) - 1 + carry


def kappa(gx: ArrayLike, gy, gz, log2: ArrayLike, mantissa: ArrayLike, exponent: ArrayLike) -> Int:
    """n |g|^2 4^log2 / 2, U11.20, cut and saturated (``shade_kappa``): 1 - c of 2^log2 increments g, times n.

    g is S2.29; its components are shifted by as many bits as leave each its sign, and cut to 18 bits, the sum of their
    squares to 17. n = mantissa 2^(exponent - 16), mantissa 17 bits. Within 2^-12 of the exact value, relative.

    >>> int(kappa(1 << 22, 0, 0, 5, 1 << 16, 5)) / (1 << KAPPA_F)  # 32 (32 / 128)^2 / 2
    1.0
    """
    *g, log2, mantissa, exponent = integers(gx, gy, gz, log2, mantissa, exponent)
    magnitude = np.bitwise_or.reduce([c ^ (c >> k.STEP_W) for c in g])
    common = k.STEP_W - 1 - sum((magnitude >> bit > 0).astype(np.int64) for bit in range(k.STEP_W - 1))
    squares = sum(((c << common) >> k.STEP_W - 18) ** 2 for c in g) >> 19
    drop = 9 + 2 * common - exponent - 2 * log2  # of twice the product
    value = 2 * squares * mantissa >> np.maximum(drop, 0)
    return np.where(drop < 0, KAPPA_MAX, np.minimum(value, KAPPA_MAX))


def weight(n: ArrayLike, h: ArrayLike, exponent: ArrayLike, kappa: ArrayLike, limit: ArrayLike) -> Int:
    """How many times kappa may be halved because the highlight is far (``shade_weight``).

    floor((x 2^exponent - 4 kappa) / 8) in 0 .. limit, x = 1 - N.H cut to [0, 2): of the first normal ``n`` (S, 3)
    S2.29, of which 15 fraction bits count, and ``h`` (3,) S1.16; kappa U11.20, cut to 2 fraction bits.

    >>> int(weight([[0, 0, int(0.9 * 2**29)]], [0, 0, 1 << 16], 9, 2 << 20, 7)[0])
    5
    """
    n, h = integers(n, h)
    exponent, kappa, limit = integers(exponent, kappa, limit)
    dot = round(((n >> k.STEP_W - k.INTENSITY_W) * h).sum(axis=-1), k.NODE_F)
    far = np.clip(ONE - dot, 0, 2 * ONE - 1) << exponent >> k.INTENSITY_F
    return np.clip(far - (kappa >> KAPPA_F - 2) >> 3, 0, limit)


class Plan(NamedTuple):
    """What a span becomes: ``main`` records of ``degree`` with 2^log2 pixels each, and a last one (arrays (S,))."""

    main: Int
    log2: Int
    degree: Int
    last_count: Int
    last_log2: Int
    last_degree: Int


def segments(
    count: ArrayLike, kappa: ArrayLike, thresholds: tuple[int, int, int] = THRESHOLDS, log2_max: int = k.LOG2_MAX
) -> Plan:
    """The plan of spans of ``count`` pixels whose arc of 2^min(span_log2(count), log2_max) has ``kappa`` (U11.20).

    >>> [int(v) for v in segments(20, 4 << 20)]  # 4 -> two segments with 1 each
    [1, 4, 3, 4, 2, 2]
    """
    count, kappa = integers(count, kappa)
    t1, t2, t3 = thresholds
    whole = np.minimum(span_log2(count), log2_max)
    halvings = sum((kappa >> 2 * h > t3).astype(np.int64) for h in range(k.KAPPA_W // 2 + 1))
    direct = halvings > np.maximum(whole - k.LOG2_MIN, 0)
    log2 = np.where(direct, k.LOG2_MIN, whole - halvings)
    main = np.maximum(count - 2 + direct, 0) >> log2  # curved, the last pixel is the last node
    last_count = count - (main << log2)
    last_log2 = span_log2(last_count)

    def degree(length: Int) -> Int:
        local = kappa >> 2 * np.maximum(whole - length, 0)
        return np.select([direct, local <= t1, local <= t2], [k.DEGREE_DIRECT, k.DEGREE_LINEAR, k.DEGREE_QUADRATIC], 3)

    last = degree(last_log2)
    return Plan(main, log2, degree(log2), last_count, last_log2, np.where(last_count <= last + 1, 0, last))


def planner(
    gx: ArrayLike, gy, gz, count: ArrayLike, mantissa: int, exponent: int,
    thresholds: tuple[int, int, int] = THRESHOLDS, fixed_degree: int = 0, flat: ArrayLike = 0,
    log2_max: int = k.RECORD_LOG2, far: Callable[[Int], ArrayLike] = np.zeros_like,
) -> Plan:  # fmt: skip
    """The plan of spans with the increment g, S2.29, and ``count`` pixels, 0 .. 8191 (``shade_planner``).

    ``kappa``, then ``segments``. ``fixed_degree`` 1 .. 3: records of this degree, one a span where that has up to
    2^log2_max + 1 pixels, as the paper has it; up to 4 pixels are lit directly. ``flat``: kappa of them counts as
    0: records of degree 1, whatever the fixed degree. ``far``: how many times kappa is halved, from kappa.

    >>> [int(v) for v in planner(1 << 22, 0, 0, 33, 1 << 16, 7)]  # kappa = 4
    [1, 4, 3, 17, 4, 3]
    """
    count, flat = integers(count, flat)
    single = (flat > 0) | (fixed_degree > 0)
    whole = np.minimum(span_log2(count), log2_max)
    arc = kappa(gx, gy, gz, whole, mantissa, exponent)
    arc = np.where(single, 0, arc >> far(arc))
    planned = segments(count, arc, thresholds, log2_max)
    if not fixed_degree:
        return planned
    degree = np.where(planned.last_count <= k.DIRECT_MAX, k.DEGREE_DIRECT, fixed_degree)
    return planned._replace(
        degree=np.where(flat, planned.degree, fixed_degree), last_degree=np.where(flat, planned.last_degree, degree)
    )


def plan(count: ArrayLike, kappa: ArrayLike, thresholds: tuple[int, int, int] = THRESHOLDS) -> Records:
    """Records of spans of ``count`` pixels, 1 .. 4096, whose arc of 2^span_log2(count) pixels has ``kappa`` (U11.20).

    >>> plan([20], [4 << 20]).count.tolist(), plan([20], [4 << 20]).degree.tolist()  # 4 -> two segments with 1 each
    ([16, 4], [3, 2])
    """
    planned = segments(count, kappa, thresholds)
    span, index = walk(planned.main + 1)
    last = index == planned.main[span]
    return Records(
        span,
        index << planned.log2[span],
        np.where(last, planned.last_count[span], np.int64(1) << planned.log2[span]),
        np.where(last, planned.last_degree[span], planned.degree[span]),
        np.where(last, planned.last_log2[span], planned.log2[span]),
    )


def plan_fixed(count: ArrayLike, degree: int) -> Records:
    """One record a span, of one degree, as the paper has it; up to four pixels are lit directly."""
    (count,) = integers(count)
    degrees = np.where(count <= k.DIRECT_MAX, k.DEGREE_DIRECT, degree)
    return Records(np.arange(count.size), np.zeros_like(count), count, degrees, span_log2(count))


def criterion(
    ab: ArrayLike,
    bc: ArrayLike,
    ca: ArrayLike,
    threshold: ArrayLike,
    form: int = k.FORM_REFINED,
    degree: int = 2,
) -> tuple[Int, Int, Int, Int]:
    """(eta, eta > threshold, a cosine clamped, threshold clamped) of a triangle (``shade_criterion``).

    eta, S1.18, is the sum over the edges, whose normals have the cosines ab, bc, ca (S1.16, clamped to [0, 1]), of
    delta(c) = 1 - sqrt((1 + c)/2). Refined: u/4 + 35 u^2/1024 + 9 u^4/1024, u = 1 - c. Paper: 0.28546133 -
    0.29073021 c or 0.29222919 - 0.34122087 c + 0.04942337 c^2. Powers are cut to 18 fraction bits (u^2 to 16 before it
    is squared), the sum is rounded once, to nearest, ties up. The threshold, S1.18, is clamped to [0, 1].

    >>> [int(v) for v in criterion(64225, 64225, 64225, 2621)]  # three edges of 11.5 degrees: 0.01504 > 0.01
    [3944, 1, 0, 0]
    """
    *edges, threshold = integers(ab, bc, ca, threshold)
    edges, flags = zip(*(clamp(c) for c in edges), strict=True)
    threshold, threshold_error = clamp(threshold, k.ETA_F)
    values = [ONE - c for c in edges] if form == k.FORM_REFINED else edges
    align, cut = k.SQUARE_F - k.INTENSITY_F, 2 * k.INTENSITY_F - k.SQUARE_F
    first = sum(v << align for v in values)
    second = sum(v * v >> cut for v in values)
    fourth = sum((v * v >> k.INTENSITY_F) ** 2 >> cut for v in values)
    if form == k.FORM_REFINED:
        weights = (0, k.ETA_U, first, k.ETA_UU, second, k.ETA_UUUU, fourth)
    elif degree == 2:
        weights = (3 * k.ETA2_0, k.ETA2_C, first, k.ETA2_CC, second)
    else:
        weights = (3 * k.ETA1_0, k.ETA1_C, first)
    eta = weigh(*weights, f=k.SQUARE_F, out_f=k.ETA_F)
    return eta, (eta > threshold).astype(np.int64), flags[0] | flags[1] | flags[2], threshold_error


@dataclass(frozen=True)
class Nodes:
    """Where light is to be computed: arrays (T,), in the order in which ``shade_node_walk`` gives them.

    ``vector`` (T, 3) S2.15: the interpolated normal, not of unit length. ``slot``: number of the node in its record;
    ``shared``: first of a record whose slot 0 is the last node of the record before. ``record`` numbers the records.
    """

    vector: Int
    slot: Int
    shared: Int
    record: Int
    span: Int  # (R,) of every record, as are:
    count: Int
    degree: Int
    log2: Int  # of the record's arc in pixels
    more: Int  # the span goes on behind this record


def stretch(main: ArrayLike, log2, degree, last_count, last_log2, last_degree) -> dict[str, Int]:
    """The stretches of planned spans, in order, by the names of ``stretch_t`` (``shade_stretch``); ``span``: whose.

    ``step_log2``: from node to node it is the increment times 2^step_log2.

    >>> {name: value.tolist() for name, value in stretch([2], [4], [3], [9], [3], [1]).items() if name != "span"}
    {'degree': [3, 1], 'log2': [4, 3], 'count': [16, 9], 'records': [2, 1], 'step_log2': [2, 3], 'shared': [0, 1]}
    """
    main, log2, degree, last_count, last_log2, last_degree = integers(
        main, log2, degree, last_count, last_log2, last_degree
    )
    span, index = walk(1 + (main > 0))
    last = index == (main[span] > 0)
    kind, length = np.where(last, last_degree[span], degree[span]), np.where(last, last_log2[span], log2[span])
    return {
        "span": span,
        "degree": kind,
        "log2": length,
        "count": np.where(last, last_count[span], np.int64(1) << log2[span]),
        "records": np.where(last, 1, main[span]),
        "step_log2": np.where(kind > 0, length + 1 - kind, 0),
        "shared": ((index > 0) & (degree[span] > 0)).astype(np.int64),
    }


def node_walk(n: ArrayLike, g: ArrayLike, main, log2, degree, last_count, last_log2, last_degree) -> Nodes:
    """The nodes of planned spans, (S,) each; ``n``, ``g`` (S, 3) S2.29 (``shade_node_walk``).

    N(j) = N + j G, rounded to S2.15, to nearest, ties up, saturated. Words of 32 bits wrap, as in the RTL.

    >>> walked = node_walk([[0, 0, 1 << 29]], [[1 << 14, 0, 0]], [0], [2], [3], [5], [2], [3])
    >>> walked.slot.tolist(), walked.vector[:, 0].tolist()
    ([0, 1, 2, 3], [0, 1, 2, 4])
    """
    n, g = integers(n, g)
    main, log2, degree, last_count, last_log2, last_degree = integers(
        main, log2, degree, last_count, last_log2, last_degree
    )
    span, index = walk(main + 1)
    last = index == main[span]
    kind = np.where(last, last_degree[span], degree[span])
    length = np.where(last, last_log2[span], log2[span])
    count = np.where(last, last_count[span], np.int64(1) << log2[span])
    continued = (index > 0) & (degree[span] != k.DEGREE_DIRECT)
    record, node = walk(np.where(kind == k.DEGREE_DIRECT, count, kind + 1) - continued)
    slot = node + continued[record]
    steps = np.where(kind[record] == k.DEGREE_DIRECT, slot, (QUARTERS[kind[record], slot & 3] << length[record]) >> 2)
    at, owner = (index << log2[span])[record] + steps, span[record]
    vector = wrap(n[owner] + at[:, None] * g[owner], k.STEP_W)
    rounded = np.minimum(round(vector, k.STEP_F - k.NODE_F), (1 << k.INTENSITY_W - 1) - 1)
    return Nodes(
        rounded, slot, (continued[record] & (node == 0)).astype(np.int64), record, span, count, kind, length, 1 - last
    )


def line(
    n: ArrayLike, g: ArrayLike, count: ArrayLike, draw: Mapping[str, int], flat: ArrayLike = 0,
    log2_max: int = k.RECORD_LOG2,
):  # fmt: skip
    """(nodes, unit normals (T, 3) S1.16, 1 where one is zero, too short (T,)) of spans (``shade_line``).

    ``draw``: settings by the names of ``golden.registers``. ``flat``: with Lambert's light alone one line without
    normalizing.
    """
    n, g = integers(n, g)
    (flat,) = integers(flat)
    flat = np.broadcast_to(flat & (draw["model"] == k.MODEL_LAMBERT), np.shape(count))
    thresholds = tuple(draw[name] for name in ("t1", "t2", "t3"))
    sharpness = draw["sharpness"], draw["sharpness_exp"]
    h = [draw[name] for name in ("hx", "hy", "hz")]
    far = lambda arc: weight(n, h, draw["sharpness_exp"], arc, draw["weight"])  # noqa: E731
    nodes = node_walk(n, g, *planner(*g.T, count, *sharpness, thresholds, draw["fixed_degree"], flat, log2_max, far))
    *normal, zero, short = unit(*nodes.vector.T, flat[nodes.span[nodes.record]])
    return nodes, np.stack(normal, axis=-1), zero, short
