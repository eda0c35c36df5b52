# SPDX-License-Identifier: Apache-2.0
"""The planner: against a plain program of its rule, and by what any plan must keep."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from polyshade.golden import contract as k
from polyshade.golden import plan, poly
from polyshade.golden.reference import light

from tb.runner import SEED

RNG = np.random.default_rng(SEED)
UNIT = 1 << plan.KAPPA_F
T1, T2, T3 = plan.THRESHOLDS


def span_log2(count: int) -> int:
    """The smallest k with count - 1 <= 2^k."""
    return max(count - 2, 0).bit_length()


def plainly(
    count: int, kappa: int, thresholds: tuple[int, int, int] = plan.THRESHOLDS, log2_max: int = k.LOG2_MAX
) -> list[tuple[int, ...]]:
    """Records (start, count, degree, log2) of a span, in the words of the module's docstring."""
    t1, t2, t3 = thresholds
    whole = min(span_log2(count), log2_max)

    def of(log2: int) -> int:
        return kappa >> 2 * max(whole - log2, 0)

    shortest = min(whole, k.LOG2_MIN)
    fitting = [log2 for log2 in range(shortest, whole + 1) if of(log2) <= t3]
    length = 1 << (max(fitting) if fitting else k.LOG2_MIN)
    records, start = [], 0
    while start < count:
        rest = count - start
        # the last pixel of a span is the last node of its last segment; where pixels are lit directly there is no node
        last = rest <= length + bool(fitting)
        pixels = rest if last else length
        own = span_log2(pixels)
        degree = 1 if of(own) <= t1 else 2 if of(own) <= t2 else 3
        if not fitting or (last and pixels <= degree + 1):
            degree = 0
        records.append((start, pixels, degree, own))
        start += pixels
    return records


def rows(records: plan.Records) -> list[tuple[int, ...]]:
    columns = (records.span, records.start, records.count, records.degree, records.log2)
    return list(zip(*(column.tolist() for column in columns), strict=True))


# all short spans, long ones, powers of two and their neighbours; kappas from flat to sharp, and at every threshold
COUNTS = [*range(1, 41), *(n + d for n in (64, 128, 1000, 2048) for d in (-1, 0, 1, 2)), 4094, 4095, 4096]
EDGES = [(t << 2 * s) + d for t in plan.THRESHOLDS for s in (0, 1, 2, 5, 8) for d in (-1, 0, 1)]
KAPPAS = sorted(
    {0, 1, UNIT // 3, 3 * UNIT, 2000 * UNIT, plan.KAPPA_MAX, *(e for e in EDGES if 0 <= e <= plan.KAPPA_MAX)}
)
SPANS = np.array(list(itertools.product(COUNTS, KAPPAS)))


@pytest.fixture(scope="module")
def records() -> plan.Records:
    return plan.plan(*SPANS.T)


def test_the_rule(records: plan.Records) -> None:
    """Record for record what the docstring says."""
    expected = [
        (span, *record) for span, (count, kappa) in enumerate(SPANS.tolist()) for record in plainly(count, kappa)
    ]
    assert rows(records) == expected


def test_other_thresholds() -> None:
    thresholds = (UNIT // 100, UNIT // 7, 3 * UNIT // 2)
    count, kappa = RNG.integers(1, 4097, 300), RNG.integers(0, 1 << RNG.integers(1, 31, 300))
    expected = [
        (span, *record)
        for span, pair in enumerate(zip(count.tolist(), kappa.tolist(), strict=True))
        for record in plainly(*pair, thresholds)
    ]
    assert rows(plan.plan(count, kappa, thresholds)) == expected


@pytest.mark.parametrize(
    ("count", "kappa", "expected"),
    [
        (1, 0, [(0, 1, 0, 0)]),  # a pixel has the light of a pixel
        (2, 0, [(0, 2, 0, 0)]),  # a line through two pixels would be the pixels
        (3, 0, [(0, 3, 1, 1)]),
        (4, 0, [(0, 4, 1, 2)]),
        (4, T2, [(0, 4, 2, 2)]),
        (4, T2 + 1, [(0, 4, 0, 2)]),  # a cubic needs four nodes: four pixels
        (4, plan.KAPPA_MAX, [(0, 4, 0, 2)]),
        (5, T2 + 1, [(0, 5, 3, 2)]),
        (9, T3, [(0, 9, 3, 3)]),  # 2^3 + 1 pixels: the last is the last node
        (9, T3 + 4, [(0, 4, 2, 2), (4, 5, 2, 2)]),  # half the length, a quarter of kappa: 1/4
        (9, 4 * T2 + 4, [(0, 4, 3, 2), (4, 5, 3, 2)]),
        (8, 4 * T2 + 4, [(0, 4, 3, 2), (4, 4, 0, 2)]),  # four pixels share a node with the next, the last do not
        (8, 4 * T2, [(0, 4, 2, 2), (4, 4, 2, 2)]),
        (8, T3, [(0, 8, 3, 3)]),
        (3, T3 + 1, [(0, 3, 0, 1)]),
        (9, 4 * T3 + 4, [(0, 4, 0, 2), (4, 4, 0, 2), (8, 1, 0, 0)]),  # too sharp for 4 pixels: lit directly
        (10, T1, [(0, 10, 1, 4)]),
        (4096, 0, [(0, 4096, 1, 12)]),
        (4096, 4 * T3, [(0, 2048, 3, 11), (2048, 2048, 3, 11)]),
    ],
)
def test_by_hand(count: int, kappa: int, expected: list[tuple[int, ...]]) -> None:
    assert [row[1:] for row in rows(plan.plan([count], [kappa]))] == expected


def test_the_rtl_takes_every_record(records: plan.Records) -> None:
    """Counts that their field can hold; so every pixel that was planned is drawn."""
    assert records.count.min() >= 1
    assert records.count.max() <= k.PIXELS_MAX
    assert np.array_equal(records.log2, poly.span_log2(records.count))
    assert records.count[records.degree == k.DEGREE_DIRECT].max() <= k.DIRECT_MAX


def test_degree_and_length(records: plan.Records) -> None:
    """A record has at least as many pixels as nodes of its own, and its arc is within the threshold of its degree."""
    count, kappa = SPANS[records.span].T
    local = kappa >> 2 * (poly.span_log2(count) - records.log2)
    curved = records.degree != k.DEGREE_DIRECT
    last = np.append(records.span[1:] != records.span[:-1], True)
    assert (records.count[curved & last] > records.degree[curved & last] + 1).all()
    assert (records.count[curved] > records.degree[curved]).all()  # the last node is the next record's
    assert (local[curved] <= np.array([0, T1, T2, T3])[records.degree[curved]]).all()
    assert (local[curved] > np.array([0, -1, T1, T2])[records.degree[curved]]).all()  # and no higher than need be
    assert records.start[curved].max() > 0


def test_nodes_are_pixels_that_neighbours_share(records: plan.Records) -> None:
    """Nodes fall on whole pixels; the last node of a record is the first of the next; direct ones are the pixels."""
    quarters = plan.QUARTERS[records.degree]
    curved = records.degree != k.DEGREE_DIRECT
    assert ((quarters[curved] << records.log2[curved, None]) % 4 == 0).all()
    t = np.array([[0, 0, 0, 0], [0, 1, 0, 0], [0, 1 / 2, 1, 0], [0, 1 / 4, 1 / 2, 1]])[records.degree]  # node set left
    nodes = records.start[:, None] + t * (1 << records.log2)[:, None]
    assert np.array_equal(records.nodes[curved], nodes[curved])

    inside = np.flatnonzero((records.span[1:] == records.span[:-1]) & curved[:-1])
    assert len(inside)
    last = records.nodes[inside, records.degree[inside]]
    assert np.array_equal(last, records.start[inside + 1])
    assert np.array_equal(last, records.nodes[inside + 1, 0])

    for pixels in range(1, k.DIRECT_MAX + 1):
        direct = ~curved & (records.count == pixels)
        offsets = [*range(pixels), *[pixels - 1] * (k.NODE_COUNT - pixels)]
        assert np.array_equal(records.nodes[direct], records.start[direct, None] + offsets)
        assert direct.any()


def test_nodes_reach_no_farther_than_the_segment(records: plan.Records) -> None:
    """A node is at most a segment away, behind the end of a span only in its last record."""
    reach = records.nodes.max(axis=1) - records.start
    assert (reach <= 1 << records.log2).all()
    beyond = records.nodes.max(axis=1) >= SPANS[records.span, 0]
    last = np.append(records.span[1:] != records.span[:-1], True)
    assert beyond.any()
    assert last[beyond].all()


def test_more_kappa_more_records() -> None:
    """A sharper arc is never cut into fewer pieces, nor its pieces made longer."""
    kappa = np.unique(np.r_[0, np.geomspace(1, plan.KAPPA_MAX, 400).astype(np.int64)])
    for count in (1, 2, 3, 4, 5, 17, 33, 100, 4096):
        records = plan.plan(np.full(len(kappa), count), kappa)
        pieces = np.bincount(records.span)
        assert (np.diff(pieces) >= 0).all()
        longest = [records.count[records.span == span].max() for span in range(len(kappa))]
        assert (np.diff(longest) <= 0).all()
        assert pieces[0] == 1
        assert longest[-1] <= 4 or count == 4096


def expanded(planned: plan.Plan) -> list[tuple[int, ...]]:
    """Records (span, start, count, degree, log2) of a plan."""
    made = []
    for span, (main, log2, degree, *last) in enumerate(zip(*(part.tolist() for part in planned), strict=True)):
        made += [(span, i << log2, 1 << log2, degree, log2) for i in range(main)]
        made.append((span, main << log2, last[0], last[2], last[1]))
    return made


@pytest.mark.parametrize("log2_max", [k.RECORD_LOG2, k.LOG2_MAX])
def test_planner(log2_max: int) -> None:
    """From increments: the plan by their kappa; flat ones as if it were 0."""
    rows = 2000
    g = RNG.integers(-1 << 31, 1 << 31, (3, rows)) >> RNG.integers(4, 32, rows)
    count, flat = RNG.integers(1, 4097, rows), RNG.integers(0, 4, rows) == 0
    mantissa, exponent = plan.quantize_sharpness(48)
    kappa = np.where(flat, 0, plan.kappa(*g, np.minimum(poly.span_log2(count), log2_max), mantissa, exponent))
    planned = plan.planner(*g, count, mantissa, exponent, flat=flat, log2_max=log2_max)
    assert expanded(planned) == rows_of(count, kappa, log2_max)
    assert (planned.main[flat & (count <= (1 << log2_max) + 1)] == 0).all()
    assert set(planned.last_degree[flat].tolist()) <= {0, 1}


def rows_of(count: np.ndarray, kappa: np.ndarray, log2_max: int) -> list[tuple[int, ...]]:
    """The records of spans, span by span, in the words of the module's docstring."""
    spans = enumerate(zip(count.tolist(), kappa.tolist(), strict=True))
    return [(span, *record) for span, pair in spans for record in plainly(*pair, log2_max=log2_max)]


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_planner_of_the_paper(degree: int) -> None:
    """One record a span of the fixed degree, but for flat spans."""
    count = np.array([1, 3, 4, 5, 6, 4096])
    planned = plan.planner(1 << 28, 0, 0, count, 1 << k.SHARPNESS_F, 10, fixed_degree=degree, log2_max=12)
    assert expanded(planned) == rows(plan.plan_fixed(count, degree))
    flat = plan.planner(1 << 28, 0, 0, count, 1 << k.SHARPNESS_F, 10, fixed_degree=degree, flat=1, log2_max=12)
    assert flat.last_degree.tolist() == [0, 1, 1, 1, 1, 1]
    short = plan.planner(0, 0, 0, [33, 34, 4096], 1 << k.SHARPNESS_F, 10, fixed_degree=degree)
    assert [part.tolist() for part in short] == [
        [0, 1, 127], [5, 5, 5], [degree] * 3, [33, 2, 32], [5, 0, 5], [degree, 0, degree]
    ]  # fmt: skip


def test_any_count_has_a_plan() -> None:
    """Counts that are no spans: nothing negative, nothing that its port cannot hold."""
    for kappa in (0, T3 + 1, plan.KAPPA_MAX):
        planned = plan.segments(np.arange(1 << k.COUNT_W), kappa)
        for part, bits in zip(planned, (k.COUNT_W, k.LOG2_W, 2, k.COUNT_W, k.LOG2_W, 2), strict=True):
            assert part.min() >= 0
            assert part.max() < 1 << bits
        assert [int(part[0]) for part in (planned.main, planned.last_count, planned.last_degree)] == [0, 0, 0]


def test_kappa() -> None:
    """Within 2^-12 of n |g|^2 4^log2 / 2, saturated exactly where that does not fit; 0 of 0."""
    rows = 100_000
    g = RNG.integers(-1 << 31, 1 << 31, (3, rows)) >> RNG.integers(0, 32, rows) >> RNG.integers(0, 4, (3, rows))
    log2, exponent = RNG.integers(0, 14, rows), RNG.integers(0, 13, rows)
    mantissa = RNG.integers(1 << 16, 1 << 17, rows)
    value = plan.kappa(*g, log2, mantissa, exponent)
    true = np.ldexp((g.astype(float) ** 2).sum(axis=0) * mantissa, 2 * log2 + exponent - 58 - 16 - 1 + plan.KAPPA_F)
    fits = true < plan.KAPPA_MAX
    assert (np.abs(value - true)[fits] <= 1 + true[fits] * 2.0**-12).all()
    assert (value[true > plan.KAPPA_MAX * (1 + 2.0**-12)] == plan.KAPPA_MAX).all()
    assert fits.any() and not fits.all()
    assert plan.kappa(0, 0, 0, 13, (1 << 17) - 1, 15) == 0


@pytest.mark.parametrize(
    ("n", "expected"), [(1, (65536, 0)), (1.5, (98304, 0)), (2 - 2**-18, (65536, 1)), (1024, (65536, 10))]
)
def test_quantize_sharpness(n: float, expected: tuple[int, int]) -> None:
    assert plan.quantize_sharpness(n) == expected


@pytest.mark.parametrize("degree", [1, 2, 3])
def test_fixed_degree(degree: int) -> None:
    """A record a span; up to 4 pixels are lit directly."""
    counts = np.array([1, 3, 4, 5, 6, 4096])
    records = plan.plan_fixed(counts, degree)
    assert np.array_equal(records.count, counts)
    assert records.span.tolist() == list(range(6))
    assert records.start.tolist() == [0] * 6
    assert records.degree.tolist() == [0, 0, 0, degree, degree, degree]
    assert records.log2.tolist() == [0, 1, 2, 2, 3, 12]
    assert records.count[records.degree == k.DEGREE_DIRECT].max() <= k.DIRECT_MAX


@pytest.mark.parametrize(
    ("kappa", "expected"),
    [(0.0, 0), (1.0, UNIT), (2**-20, 1), (0.6 * 2**-20, 1), (0.4 * 2**-20, 0), (-1e-9, 0), (-5.0, 0),
     (1e9, plan.KAPPA_MAX), (float("inf"), plan.KAPPA_MAX), (2047.9999999, plan.KAPPA_MAX)],
)  # fmt: skip
def test_quantize_kappa(kappa: float, expected: int) -> None:
    assert plan.quantize_kappa(kappa) == expected
    assert plan.quantize_kappa([[kappa]]).shape == (1, 1)


@pytest.mark.parametrize(("model", "shininess"), [("blinn", 32), ("blinn", 512), ("phong", 64), ("lambert", 1)])
def test_what_is_planned_is_smooth_enough(model: str, shininess: float) -> None:
    """Arcs of some tenths of a radian, planned and interpolated: error of the pixels in both channels.

    A chord under cos^n is at most kappa/4 off. Cubics are worst on long arcs, whose middle turns faster than the ends.
    """
    spans, towards = 400, light.unit([-0.3, 0.4, 0.8])
    count = RNG.integers(1, 300, spans)
    normal = light.unit(towards + RNG.normal(0, 0.3, (spans, 3)))
    end = light.unit(normal + RNG.normal(0, 0.15, (spans, 3)))
    gradient = (end - normal) / np.maximum(count - 1, 1)[:, None]
    reach = (1 << poly.span_log2(count))[:, None]
    kappa = light.kappa(model, normal, normal + reach * gradient, shininess)
    records = plan.plan(count, plan.quantize_kappa(kappa))

    def lit(span: np.ndarray, step: np.ndarray) -> np.ndarray:
        return light.light_channels(model, normal[span] + step[..., None] * gradient[span], towards, shininess)

    nodes = lit(np.repeat(records.span[:, None], 4, axis=1), records.nodes)  # (R, 4, 2)
    quantized = np.rint(nodes * (1 << k.INTENSITY_F)).astype(np.int64).swapaxes(1, 2)
    pixels, owner = poly.poly_span(quantized, records.degree, records.count)
    step = records.start[owner] + poly.span_walk(records.count)[1]
    exact = lit(records.span[owner], step).clip(0, 1)
    error = np.abs(pixels / (1 << k.PIXEL_W) - exact)
    assert error[records.degree[owner] == k.DEGREE_LINEAR].max() < 1.1 * T1 / UNIT / 4
    assert error.max() < 0.03
    assert (error**2).sum() / (exact**2).sum() < 1e-5
    assert len(np.unique(records.degree)) >= 3
