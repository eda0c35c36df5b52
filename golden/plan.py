"""The planner: cuts a span into records that ``shade_poly_span`` draws, by one number: the kappa ladder.

Along an arc whose end normals have the dot product c, the error of interpolating cos^n depends on

    kappa = n (1 - c)

alone, and half the length has a quarter of it. So shifts and three comparisons choose the length of the segments, a
power of two of pixels, and their degree:

    k = largest with kappa(2^k) <= T3;   degree 1 if kappa(2^k) <= T1, 2 if <= T2, else 3

Where not even 4 pixels are short enough, or a record has no more pixels than its polynomial has nodes, its pixels
are lit directly. Integers: kappa and the thresholds are U11.20.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from golden import contract as k
from golden.fixed import ONE, Int, clamp, integers, round, weigh, wrap
from golden.poly import span_log2
from golden.stream import walk

KAPPA_F = 20
KAPPA_MAX = (1 << 31) - 1
LOG2_MIN = 2  # nodes at a quarter of a segment are pixels: 4 pixels at least
THRESHOLDS = tuple((1 << KAPPA_F) >> shift for shift in (5, 2, 0))  # T1, T2, T3 = 1/32, 1/4, 1

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


def plan(count: ArrayLike, kappa: ArrayLike, thresholds: tuple[int, int, int] = THRESHOLDS) -> Records:
    """Records of spans of ``count`` pixels, 1 .. 4096, whose arc of 2^span_log2(count) pixels has ``kappa`` (U11.20).

    >>> plan([20], [3 << 20]).count.tolist(), plan([20], [3 << 20]).degree.tolist()  # 3 -> two segments with 3/4 each
    ([16, 4], [3, 2])
    """
    count, kappa = integers(count, kappa)
    t1, t2, t3 = thresholds
    whole = span_log2(count)
    log2 = whole.copy()
    while (shorter := (kappa >> 2 * (whole - log2) > t3) & (log2 > LOG2_MIN)).any():
        log2 -= shorter
    direct = kappa >> 2 * (whole - log2) > t3  # at 4 pixels a record, or because the span is that short
    segments = np.maximum(np.where(direct, -(-count >> log2), -(-(count - 1) >> log2)), 1)

    span, index = walk(segments)
    start = index << log2[span]
    last = index == segments[span] - 1
    pixels = np.where(last, count[span] - start, 1 << log2[span])
    own = span_log2(pixels)
    local = kappa[span] >> 2 * (whole[span] - own)
    degree = np.select([local <= t1, local <= t2], [k.DEGREE_LINEAR, k.DEGREE_QUADRATIC], k.DEGREE_CUBIC)
    degree[direct[span] | (pixels <= degree + 1)] = k.DEGREE_DIRECT
    return Records(span, start, pixels, degree, own)


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
    more: Int  # the span goes on behind this record


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
    return Nodes(rounded, slot, (continued[record] & (node == 0)).astype(np.int64), record, span, count, kind, 1 - last)
