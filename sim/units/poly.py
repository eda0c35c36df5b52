# SPDX-License-Identifier: Apache-2.0
"""Coefficients of a span and their evaluation."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import poly
from polyshade.sim.units.case import FORMS, ONE, Arrays, Case, Real, every, in_forms, mixed, signed_range

# numerators over 3 of the cubic's coefficients, in I1 .. I4 (P1, section IV, both parts brought together)
CUBIC = {
    k.NODES_LEFT: {"a": (-24, 64, -48, 8), "b": (42, -96, 60, -6), "c": (-21, 32, -12, 1)},
    k.NODES_RIGHT: {"a": (-8, 48, -64, 24), "b": (18, -84, 96, -30), "c": (-13, 36, -32, 9)},
}
LOWER = {"a": {}, "b": {2: (2, -4, 2, 0)}, "c": {2: (-3, 4, -1, 0), 1: (-1, 1, 0, 0)}}
# what P1 divides by three goes through 43/128: (divided, exact) in I1 .. I4
PAPER = {
    k.NODES_LEFT: {"a": ((0, 64, 0, 8), (-8, 0, -16, 0)), "c": ((0, 32, 0, 1), (-7, 0, -4, 0))},
    k.NODES_RIGHT: {"a": ((-8, 0, -64, 0), (0, 16, 0, 8)), "c": ((-13, 0, -32, 0), (0, 12, 0, 3))},
}


def _weighted(weights, inputs: Arrays) -> np.ndarray:
    return sum(w * inputs[f"i{i}_i"].astype(Real) for i, w in enumerate(weights, 1))


def coefficient(name: str, nodes: int, form: str) -> Callable[[Arrays], np.ndarray]:
    """The exact value of a coefficient's formula."""

    def exact(inputs: Arrays) -> np.ndarray:
        if name == "d":
            return inputs["i1_i"].astype(Real)
        if form == "paper" and name in PAPER[nodes]:
            divided, whole = PAPER[nodes][name]
            cubic = _weighted(divided, inputs) * 43 / 128 + _weighted(whole, inputs)
        else:
            cubic = _weighted(CUBIC[nodes][name], inputs) / 3
        lower = {degree: _weighted(weights, inputs) for degree, weights in LOWER[name].items()}
        degree = inputs["degree_i"]
        return np.select([degree == 3, *(degree == d for d in lower)], [cubic, *lower.values()], Real(0))

    return exact


def _coef(form: str) -> Iterator[Case]:
    def golden_part(name: str, nodes: int) -> Callable[[Arrays], Arrays]:
        of = partial(getattr(poly, f"coef_{name}"), nodes=nodes, **({} if name == "b" else {"form": FORMS[form]}))
        return lambda i: {f"{name}_o": of(i["degree_i"], *(i[f"i{n}_i"] for n in range(1, 5)))}

    def golden_all(nodes: int) -> Callable[[Arrays], Arrays]:
        of = partial(poly.coef, nodes=nodes, form=FORMS[form])
        names = [f"{name}_o" for name in "abcd"]
        return lambda i: dict(zip(names, of(i["degree_i"], *(i[f"i{n}_i"] for n in range(1, 5))), strict=True))

    for nodes, width in itertools.product((k.NODES_LEFT, k.NODES_RIGHT), (k.INTENSITY_W, 5)):
        ranges = {"degree_i": (0, 3), **{f"i{n}_i": signed_range(width) for n in range(1, 5)}}
        random = mixed(ranges, ONE, -ONE) if width == k.INTENSITY_W else None
        all_of = None if random else every(ranges)
        point = {"WIDTH": width, "NODES": nodes}
        units = [("shade_coef", "abcd", golden_all(nodes), {"FORM": FORMS[form]})]
        units += [(f"shade_coef_{n}", n, golden_part(n, nodes), {"FORM": FORMS[form]}) for n in "ac"]
        if form == "refined":  # B has one form
            units.append(("shade_coef_b", "b", golden_part("b", nodes), {}))
        for module, names, golden, more in units:
            values = {n: coefficient(n, nodes, form) for n in names}
            ideals = {n: coefficient(n, nodes, "refined") for n in names}
            exact = lambda i, v=values: {f"{n}_o": f(i) for n, f in v.items()}  # noqa: E731
            ideal = lambda i, v=ideals: {f"{n}_o": f(i) for n, f in v.items()}  # noqa: E731
            yield Case(
                module, form, point | more, golden, exact, exact if form == "refined" else ideal, random, all_of,
                k.LATENCY_COEF, bound=0 if names == "b" else 1 / 3,
            )  # fmt: skip


def _horner_step(form: str) -> Iterator[Case]:
    for width, t_f in ((k.VALUE_W + k.HORNER_GUARD, k.T_F), (12, 4)):
        half = signed_range(width - 1)  # s and c, so that the sum fits

        def exact(i: Arrays, t_f: int = t_f) -> Arrays:
            return {"y_o": i["s_i"] * (i["t_i"].astype(Real) / (1 << t_f)) + i["c_i"]}

        yield Case(
            "shade_horner_step", form, {"WIDTH": width, "T_F": t_f},
            lambda i, t_f=t_f: {"y_o": poly.horner_step(i["s_i"], i["t_i"], i["c_i"], t_f=t_f)}, exact, exact,
            mixed({"s_i": half, "t_i": (0, 1 << t_f), "c_i": half}), None, k.LATENCY_HORNER_STEP,
            late={"c_i": k.LATENCY_MUL}, unit_f=k.INTENSITY_F + k.HORNER_GUARD,
        )  # fmt: skip


def _horner(form: str) -> Iterator[Case]:
    points = [(k.COEF_W, k.INTENSITY_W, k.T_F), (4, 4, 4), (10, 6, 4)]
    for coef_w, d_w, t_f in points:
        ranges = {f"{n}_i": signed_range(coef_w) for n in "abc"} | {"d_i": signed_range(d_w), "t_i": (0, 1 << t_f)}
        full = coef_w > 4

        def exact(i: Arrays, t_f: int = t_f) -> Arrays:
            t = i["t_i"].astype(Real) / (1 << t_f)
            return {"y_o": ((i["a_i"] * t + i["b_i"]) * t + i["c_i"]) * t + i["d_i"]}

        for module, latency, clocks in (
            ("shade_horner_pipe", k.LATENCY_HORNER_PIPE, 1),
            ("shade_horner_seq", k.LATENCY_HORNER_SEQ, k.LATENCY_HORNER_SEQ),
        ):
            yield Case(
                module, form, {"COEF_W": coef_w, "D_W": d_w, "T_F": t_f},
                lambda i, t_f=t_f: {"y_o": poly.horner(*(i[f"{n}_i"] for n in "abcdt"), t_f=t_f)}, exact, exact,
                mixed(ranges, 1 << t_f >> 1) if full else None, None if full else every(ranges), latency, clocks,
                bound=1 / 2 + 3 / 16,
            )  # fmt: skip


def _fdiff(form: str) -> Iterator[Case]:
    names = [*(f"{n}_i" for n in "abcd"), "log2_i"]

    def held(i: Arrays) -> tuple[list[np.ndarray], np.ndarray]:
        """What was taken with the first pixel of a segment, and the number of the pixel in it."""
        j = pixel_index(i["first_i"])
        return [i[name][np.arange(len(j)) - j] for name in names], j

    def golden(i: Arrays) -> Arrays:
        taken, j = held(i)
        return {"y_o": poly.fdiff(*taken, j)}

    def exact(i: Arrays) -> Arrays:
        (a, b, c, d, log2), j = held(i)
        t = np.ldexp(j.astype(Real), -log2)
        return {"y_o": ((a * t + b) * t + c) * t + d}

    ranges = {f"{n}_i": signed_range(k.COEF_W) for n in "abc"} | {"d_i": signed_range(k.INTENSITY_W)}
    ranges |= {"log2_i": (0, 15)}

    def random(rng: np.random.Generator, rows: int) -> Arrays:
        """Whole segments and parts of them, the longest that fits first; behind a first pixel inputs are random."""
        most = min(k.LOG2_MAX, max(rows // 4, 1).bit_length())
        log2 = rng.integers(0, most, rows // 2 + 1, endpoint=True)
        count = np.where(
            rng.random(len(log2)) < 0.5, (1 << log2) + 1, rng.integers(1, 12, len(log2)).clip(max=(1 << log2) + 1)
        )
        log2[0], count[0] = most, (1 << most) + 1
        count = count[np.cumsum(count) <= rows]
        count = np.r_[count, np.ones(rows - count.sum(), int)]
        log2 = np.resize(log2, len(count))
        first = mixed(ranges)(rng, len(count)) | {"log2_i": log2}
        tie = near_tie(rng, log2, count)
        chosen = (rng.random(len(log2)) < 0.25) & (count > 1) & (log2 > 0)
        segments = spread(first | {name: np.where(chosen, tie[name], first[name]) for name in tie}, count)
        noise = mixed(ranges)(rng, rows)
        return segments | {name: np.where(segments["first_i"], segments[name], noise[name]) for name in names}

    def single(rng: np.random.Generator, rows: int) -> Arrays:
        """A segment on every pixel."""
        return mixed(ranges | {"log2_i": (0, k.LOG2_MAX)})(rng, rows) | {"first_i": np.ones(rows, np.int64)}

    def all_of() -> Iterator[Arrays]:
        ranges = {f"{n}_i": signed_range(4) for n in "abcd"} | {"log2_i": (0, 3)}
        for part in every(ranges)():
            yield spread(part, (1 << part["log2_i"]) + 1)

    yield Case("shade_fdiff", form, {}, golden, exact, exact, random, None, k.LATENCY_FDIFF, ordered=True)
    yield Case("shade_fdiff", form, {}, golden, exact, exact, single, None, k.LATENCY_FDIFF, note="single pixels")
    yield Case(
        "shade_fdiff", form, {"COEF_W": 4, "D_W": 4, "LOG2_MAX": 3}, golden, exact, exact, None, all_of,
        k.LATENCY_FDIFF, ordered=True,
    )  # fmt: skip


def near_tie(rng: np.random.Generator, log2: np.ndarray, count: np.ndarray) -> Arrays:
    """Coefficients by which a pixel of an odd index lies up to three units of the last bit of its sum below a half.

    In these units, with L = log2, the value is a j^3 + 2^L b j^2 + 2^2L c j: three digits, found one after the other.
    """
    found: dict[str, list[int]] = {"a_i": [], "b_i": [], "c_i": []}
    for bits, pixels in zip(log2.tolist(), count.tolist(), strict=True):
        base, j = 1 << bits, int(rng.integers(0, max(pixels // 2, 1))) * 2 + 1
        rest, inverse = (1 << max(3 * bits - 1, 0)) - int(rng.integers(1, 4)), pow(j, -1, base)
        for name, power in zip(found, (3, 2, 1), strict=True):
            digit = rest * inverse**power % base
            rest = rest - digit * j**power >> bits
            found[name].append(digit)
    return {name: np.array(digits, np.int64) for name, digits in found.items()}


def _poly_start(form: str) -> Iterator[Case]:
    """First differences of every degree, at every length that a planner gives it."""
    nodes = {f"nodes_i.n{n}": signed_range(k.INTENSITY_W) for n in range(4)}
    for log2_max in (k.RECORD_LOG2, k.LOG2_MAX):

        def vectors(rng: np.random.Generator, rows: int, log2_max: int = log2_max) -> Arrays:
            degree = rng.integers(1, 4, rows)
            log2 = rng.integers(np.minimum(degree, 2), log2_max + 1)
            return mixed(nodes, ONE, -ONE)(rng, rows) | {"degree_i": degree, "log2_i": log2}

        def golden(i: Arrays, log2_max: int = log2_max) -> Arrays:
            d = poly.poly_start(i["degree_i"], *(i[name] for name in nodes), i["log2_i"], log2_max)
            return {f"d{n + 1}_o": value for n, value in enumerate(d)}

        yield Case(
            "shade_poly_start", form, {"LOG2_MAX": log2_max}, golden, golden, golden, vectors, None,
            k.LATENCY_POLY_START, bound=0, unit_f=0,
        )  # fmt: skip


def _poly_state(form: str) -> Iterator[Case]:
    """Steps from any differences; behind a first pixel inputs are random."""
    width = k.INTENSITY_W + 2 + 3 * k.RECORD_LOG2
    names = ("node_i", "d1_i", "d2_i", "d3_i")
    ranges = {"node_i": signed_range(k.INTENSITY_W)} | {name: signed_range(width) for name in names[1:]}

    def vectors(rng: np.random.Generator, rows: int) -> Arrays:
        first = (rng.random(rows) < 0.2).astype(np.int64)
        first[0] = 1
        gentle = {name: value >> rng.integers(0, 18, rows) for name, value in mixed(ranges)(rng, rows).items()}
        return gentle | {"begin_i": first}

    def golden(i: Arrays) -> Arrays:
        j = pixel_index(i["begin_i"])
        return {"pixel_o": poly.poly_state(*(i[name][np.arange(len(j)) - j] for name in names), j)}

    yield Case(
        "shade_poly_state", form, {}, golden, golden, golden, vectors, None, k.LATENCY_POLY_STATE, bound=0, unit_f=0,
        ordered=True,
    )  # fmt: skip


def spread(segments: Arrays, count: np.ndarray) -> Arrays:
    """Segments to pixels: every row ``count`` times, with ``first_i`` at the first."""
    rows = {name: np.repeat(value, count) for name, value in segments.items()}
    first = np.zeros(int(count.sum()), np.int64)
    first[np.cumsum(count) - count] = 1
    return rows | {"first_i": first}


def pixel_index(first: np.ndarray) -> np.ndarray:
    """Index of each pixel in its segment, from the marks of the first ones."""
    position = np.arange(len(first))
    return position - np.maximum.accumulate(np.where(first, position, 0))


def cases() -> Iterator[Case]:
    """All cases of ``rtl/poly`` but whole spans, a stream."""
    yield from in_forms(_coef)
    yield from in_forms(_horner_step, _horner, _fdiff, _poly_start, _poly_state, only="refined")
