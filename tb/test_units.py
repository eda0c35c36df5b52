# SPDX-License-Identifier: Apache-2.0
"""Every unit against its golden model, by both engines: millions of vectors by NumPy, gaps and resets by cocotb.

The cases stand in ``sim/units``: vectors, golden twin, exact value of the formula and the error's bound.
"""

from collections.abc import Iterator

import numpy as np
import pytest
from polyshade.golden import contract as k
from polyshade.golden import light, normal, plan
from polyshade.golden.fixed import ONE
from polyshade.sim.sources import Point, label
from polyshade.sim.units import Case, Stream, cases, streams, unit_vectors
from polyshade.sim.units.stream import measured

from tb.runner import FULL, SEED, simulate

CASES = cases()
VECTORS = 10_000_000 if FULL else 250_000


def ranked(cases: list[Case], *by: str) -> Iterator[tuple[Case, int, int]]:
    """Cases with the number of their parameter point among those that agree in ``by``, and how many these are."""
    points: dict[tuple, list[Point]] = {}
    for case in cases:
        group = points.setdefault(tuple(getattr(case, name) for name in by), [])
        if case.parameters not in group:
            group.append(case.parameters)
    for case in cases:
        group = points[tuple(getattr(case, name) for name in by)]
        yield case, group.index(case.parameters), len(group)


def of_all() -> Iterator[tuple]:
    """Every case; points between the first and the last of a module in a form are left to ``make test-all``."""
    for case, number, count in ranked(CASES, "module", "form"):
        yield pytest.param(case, id=str(case), marks=pytest.mark.full if 0 < number < count - 1 else ())


def at_points() -> Iterator[tuple]:
    """Every module at every point of its cases; by default the first one, and of what is folded the last one."""
    found = {}
    for case, number, count in ranked([case for case in CASES if not case.own_bench], "module"):
        folded = number == count - 1 and case.clocks_per_vector > 1
        marks = () if number == 0 or folded else pytest.mark.full
        name = label(case.module, case.parameters)
        found[name] = pytest.param(case.module, case.parameters, id=name, marks=marks)
    yield from found.values()


def streams_at_points(slow: bool) -> Iterator[tuple]:
    """Every stream, or those that NumPy runs, which knows no credits.

    From the third of a module on they are left to ``make test-all``.
    """
    numbers: dict[str, int] = {}
    for stream in streams():
        numbers[stream.module] = number = numbers.get(stream.module, 0) + 1
        if slow or not (stream.credits or stream.apart[0]):
            yield pytest.param(stream, id=str(stream), marks=pytest.mark.full if number > 2 else ())


@pytest.mark.parametrize("case", [*of_all()])
def test_numpy(case: Case) -> None:
    """No vector differs, in any bit or clock; no error is beyond its bound."""
    wanted = VECTORS if case.form == "refined" else max(VECTORS // 10, 100_000)
    result = case.check(wanted, SEED)
    assert result.mismatches == 0, result.first_mismatch
    assert result.vectors >= (1 if case.all_vectors else wanted)
    assert result.max_error_ulp <= case.limit + 1e-9, result.worst_input
    assert result.max_share <= 1, result.worst_input
    assert result.throughput == pytest.approx(1 / case.clocks_per_vector, rel=0.01 if result.vectors > 1000 else 0.5)


@pytest.mark.parametrize(("module", "point"), [*at_points()])
def test_cocotb(module: str, point: Point) -> None:
    """All outputs on every clock, with gaps and resets."""
    simulate(module, point, "tb.case_bench")


@pytest.mark.parametrize("stream", [*streams_at_points(slow=True)])
def test_stream_cocotb(stream: Stream) -> None:
    """Words, order and clocks, with pauses, resets, and a taker that stands still."""
    simulate(stream.module, stream.parameters, "tb.stream_bench")


PAUSES = [(0, 0), (0.3, 0.3), *(pytest.param(*pause, marks=pytest.mark.full) for pause in ((0.4, 0), (0, 0.4)))]


@pytest.mark.parametrize(("in_gap", "out_stall"), PAUSES)
@pytest.mark.parametrize("stream", [*streams_at_points(slow=False)])
def test_stream_numpy(stream: Stream, in_gap: float, out_stall: float) -> None:
    """Thousands of items of every kind; a word a clock, or as many as there is work for."""
    for kind in stream.usual or stream.kinds:
        result = stream.check(20_000 if FULL else 3_000, SEED, in_gap, out_stall, kind)
        assert result.mismatches == 0, result.first_mismatch
        if not in_gap and not out_stall and stream.parameters.get("FOLD", 1) == 1:
            assert result.throughput >= 0.98


@pytest.mark.parametrize("name", measured())
def test_errors_of_streams(name: str) -> None:
    """Of poly_span A and C err by 1/3 ulp at most, never in the same direction, because 3 divides the sum of 3 A and
    3 C: (t - t^3)/3 <= 2/(9 sqrt 3); in the paper's form by 1/2 each. Evaluator: 1/2, Horner 3/16 more."""
    if "normals" in name:
        bound = 5 / 8
    else:
        bound = (2 / (9 * 3**0.5) if "refined" in name else 1) + (
            1 / 2 if "EVALUATOR" in name or "line" in name else 11 / 16
        )
    result = measured()[name].check(100_000 if FULL else 20_000, SEED)
    assert result.mismatches == 0, result.first_mismatch
    assert result.max_error_ulp <= bound + 1e-9, result.worst_input


def test_midpoint_of_every_cosine() -> None:
    """The sum of two unit normals is 2 cos(psi/2) long; times InvC it is 1, exactly so for equal normals."""
    c = np.arange(ONE + 1)
    invc, half, clamped = normal.invc(c)
    true = np.sqrt((1 + c / ONE) / 2)
    length, wrong = np.abs(2 * true * invc / (1 << k.INVC_F) - 1), np.abs(half / ONE - true)
    narrow = c >= ONE // 2  # up to 60 degrees
    assert length.max() <= 1.6e-4
    assert wrong[narrow].max() <= 7.2e-5
    assert wrong.max() <= 1.8e-4
    assert (invc[-1], half[-1]) == (1 << k.INVC_F - 1, ONE)
    assert not clamped.any()


def test_halfway_of_unit_vectors() -> None:
    """V.H is within 1.6 ulp; up to 120 degrees between L and V it is, as good as their lengths, |L + V| / 2."""
    l, v = (unit_vectors(np.random.default_rng([SEED, part]), 1_000_000) for part in range(2))  # noqa: E741
    *h, vh = light.halfway(*l, *v)
    s = (l + v).astype(np.longdouble)
    length = np.sqrt((s * s).sum(axis=0))
    assert np.any(h, axis=0).all()
    assert np.abs(vh - ((v * s).sum(axis=0) / length).clip(0, ONE)).max() <= 1.6
    assert np.abs(vh - length / 2)[length >= ONE].max() <= 3.4


def test_errors_of_printed_constants() -> None:
    """Of 16 fraction bits are the constants of the papers' forms: how far that takes the results, in ulp of each."""
    c = np.arange(ONE + 1)
    x = c.astype(np.longdouble) / ONE

    def worst(values: np.ndarray, exact: np.ndarray, fraction: int) -> float:
        return float(np.abs(values - np.ldexp(exact, fraction)).max())

    d1a = max(
        worst(normal.metric(c, m)[0], 0.894 + 0.06 * x + 0.007 * m, k.INTENSITY_F)
        for m in range(k.METRIC_M_MIN, k.METRIC_M_MAX + 1)
    )
    first, second = (normal.invc(c, k.FORM_PAPER, degree)[0] for degree in (1, 2))
    assert d1a == pytest.approx(3.3, abs=0.05)
    assert worst(first, 0.683 - 0.191 * x, k.INVC_F) == pytest.approx(1.65, abs=0.05)
    assert worst(second, 0.703 - 0.3 * x + 0.098 * x * x, k.INVC_F) == pytest.approx(2.3, abs=0.05)
    printed = {1: 0.28546133 - 0.29073021 * x, 2: 0.29222919 - 0.34122087 * x + 0.04942337 * x * x}
    for degree, error in ((1, 4.1), (2, 9.0)):
        eta = plan.criterion(c, c, c, 0, k.FORM_PAPER, degree)[0]
        assert worst(eta, 3 * printed[degree], k.ETA_F) == pytest.approx(error, abs=0.05)


def test_nodes_lie_on_the_arc() -> None:
    """Up to 60 degrees every node is within 2.5e-4 of the point that slerp gives; the ends are the ends."""
    rng = np.random.default_rng(SEED)
    a, across = (v / np.linalg.norm(v, axis=0) for v in rng.standard_normal((2, 3, 1_000_000)))
    across -= a * (a * across).sum(axis=0)
    across /= np.linalg.norm(across, axis=0)
    angle = rng.random(a.shape[1]) * np.pi / 3
    arc = [a * np.cos(t * angle) + across * np.sin(t * angle) for t in np.arange(5) / 4]
    ends = [np.rint(v * ONE).astype(np.int64) for v in (arc[0], arc[-1])]
    nodes = normal.node_chain(*ends[0], *ends[1], np.minimum(normal.dot3(*ends[0], *ends[1]), ONE))
    for node, exact in zip(np.reshape(nodes[:15], (5, 3, -1)), arc, strict=True):
        assert np.linalg.norm(node / ONE - exact, axis=0).max() <= 2.5e-4
    assert np.array_equal(nodes[:3], ends[0])
    assert np.array_equal(nodes[12:15], ends[1])
