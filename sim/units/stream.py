# SPDX-License-Identifier: Apache-2.0
"""Modules that take items and give words, with valid and ready or credits: spans to pixels, walks, the FIFO.

A :class:`Stream` says what such a module must do and when. Two engines run it: NumPy in bulk (:meth:`Stream.check`),
and cocotb (``tb.stream_bench``) with pauses, resets, a taker that stands still, inputs that change within a clock.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import core, normal, plan, poly
from polyshade.golden.types import RECORD, STRUCTS, pack, unpack, words
from polyshade.sim.sources import label
from polyshade.sim.units.case import FORMS, ONE, Arrays, Case, Real, Result, hexadecimal, mixed
from polyshade.sim.units.normal import unit_vectors
from polyshade.sim.units.poly import coefficient
from polyshade.sim.units.spans import CODES, PATHS, Spans, draw_of, port, settings, spans, structure

Rng = np.random.Generator
CHANNELS = ("diffuse", "specular")


class Given(NamedTuple):
    """What is to come of items: outputs by port or field, a row a word; the item of every word; words beside them."""

    words: Arrays
    owner: np.ndarray
    beside: Arrays = {}  # noqa: RUF012


@dataclass(frozen=True)
class Stream:
    """A module at a parameter point and what it must make of a stream of items.

    ``items(rng, count, kind)``: inputs by port or field, a row an item of so many words, where that is for the items to
    say; ``draw_i`` are settings, the same in all rows. ``kinds`` of items, ``usual``: those that most tests take.
    ``golden(inputs)``: what is to come.

    ``latency``: clocks from an item to its first word, or from each to its, up to ``slack`` more; its words follow each
    other in ``stride`` clocks. ``steady``: that holds for every item, else only for one that finds nothing in front of
    it, of the kinds ``alone``. ``brisk``: items follow each other so; ``work(inputs)``: clocks each that they are
    prepared for in turn, ``pace(inputs)``: those in which one is taken at most.
    ``lengths`` of items that are timed, ``longest`` of all. ``held(kind, n)``:
    items of n words that are taken while the taker stands still.

    Where words cost credits, there are ``credits`` after reset; one pays for all words up to one in which the field
    ``record`` is 1; a word that waited for it comes ``wakes`` clocks behind it. ``valid``: of the words, by default
    ``valid_o``; ``beside``: of the words beside them. ``apart``: an input that waits until an output says
    that it was taken, apart from the others of its item. ``through``: inputs from which a path leads to an output.

    ``errors(inputs, given)``: of every word, against exact value and ideal, in ulp; 0 where there is none.
    """

    module: str
    parameters: dict[str, int]
    items: Callable[[Rng, np.ndarray, Hashable], Arrays]
    golden: Callable[[Arrays], Given]
    latency: int | Callable[[Arrays, Given], ArrayLike]
    kinds: tuple = (None,)
    usual: tuple = ()
    alone: tuple = ()
    slack: int = 0
    stride: int = 1
    steady: bool = True
    brisk: bool = True
    work: Callable[[Arrays], np.ndarray] | None = None
    pace: Callable[[Arrays], int] | None = None
    longest: int = 0
    held: Callable[[Hashable, int], int] | None = None
    credits: int = 0
    record: str = ""
    wakes: int = 0
    valid: str = ""
    apart: tuple[str, str] = ("", "")
    beside: str = ""
    through: tuple[str, ...] = ()
    lengths: tuple[int, ...] = (1, 2, 3, 4, 5, 12)
    errors: Callable[[Arrays, Given], tuple[np.ndarray, np.ndarray]] | None = field(default=None)

    def __str__(self) -> str:
        return label(self.module, self.parameters)

    def clock(self, inputs: Arrays, given: Given) -> np.ndarray:
        """Clocks from an item to each of its words."""
        first = self.latency(inputs, given) if callable(self.latency) else self.latency
        first = np.broadcast_to(first, given.owner[-1] + 1)[given.owner]
        return first + self.stride * (np.arange(len(given.owner)) - np.searchsorted(given.owner, given.owner))

    def clocks(self, inputs: Arrays, given: Given) -> int:
        """From the first word of all items to the last, both counted, when nobody pauses."""
        words = np.bincount(given.owner) * self.stride
        work, pace = self.work(inputs) if self.work else 0 * words, self.pace(inputs) if self.pace else 0
        ready, end, begin = 0, work[0], work[0]
        for index, (clocks, count) in enumerate(zip(work, words, strict=True)):
            ready = max(ready, pace * index) + clocks
            end = max(end, ready) + count
        return int(end - begin - self.stride + 1)

    def mixture(self, rng: Rng, rows: int) -> np.ndarray:
        """Lengths of items, half of them of 1 to 4 words."""
        most = max(self.longest, 4)
        return np.where(rng.random(rows) < 0.5, rng.integers(1, 5, rows), rng.geometric(0.08, rows).clip(1, most))

    def check(
        self, rows: int, seed: int = 1, in_gap: float = 0.0, out_stall: float = 0.0, kind=None, model=None
    ) -> Result:
        """So many items through the RTL. ``latency`` is that of the first word, ``throughput`` in words a clock."""
        rng = np.random.default_rng([seed, 7])
        count = self.mixture(rng, rows)
        count[:2] = 3, max(self.longest, 3)  # the first word measures the latency
        inputs = self.items(rng, count, kind if kind is not None else self.kinds[0])
        given = self.golden(inputs)
        model = model or sim.load(self.module, public=(), **self.parameters)  # compiled once for both engines
        run = model.run(
            **inputs, in_gap=in_gap, out_stall=out_stall, seed=seed, pace=self.parameters.get("FOLD", 1)
        )  # fmt: skip
        total = len(given.owner)
        result = Result(total, latency=int(run.given[0] - run.taken[0]), throughput=total / run.clocks)
        if len(run.given) != total:
            result.mismatches = abs(len(run.given) - total)
            result.first_mismatch = f"{self}: {len(run.given)} words, expected {total}"
            return result
        wrong = {name: run.outputs[name] != value for name, value in given.words.items()}
        if self.steady and not out_stall:
            wrong["its clock"] = run.given - run.taken[given.owner] != self.clock(inputs, given)
        any_wrong = np.any(list(wrong.values()), axis=0)
        result.mismatches = int(np.count_nonzero(any_wrong))
        if result.mismatches:
            at = int(np.argmax(any_wrong))
            told = ", ".join(
                f"{name} expected {hexadecimal(value[at])} actual {hexadecimal(run.outputs[name][at])}"
                for name, value in given.words.items() if wrong[name][at]
            ) or f"latency {run.given[at] - run.taken[given.owner[at]]}"  # fmt: skip
            result.first_mismatch = f"{self}: word {at}, of item {given.owner[at]}: {told}"
        if self.errors:
            exact, ideal = self.errors(inputs, given)
            at = int(np.argmax(exact))
            result.max_error_ulp, result.max_error_ideal = float(exact[at]), float(ideal.max()) / ONE
            item = int(given.owner[at])
            result.worst_input = {"item": item, "word": at - int(np.searchsorted(given.owner, item))}
        return result


def ends(owner: np.ndarray, more: np.ndarray | None = None) -> np.ndarray:
    """1 where an item's last word is, unless it goes on in the next item."""
    last = np.append(np.diff(owner), 1)[: len(owner)] != 0
    return (last if more is None else last & (more[owner] == 0)).astype(np.int64)


def axis(name: str, values: list[np.ndarray], width: int, tag: np.ndarray, last: np.ndarray) -> Arrays:
    """A stream ``m_axis_<name>`` of numbers side by side."""
    data = sum((part & (1 << width) - 1) << width * i for i, part in enumerate(values))
    return {f"m_axis_{name}_tdata": data, f"m_axis_{name}_tuser": tag, f"m_axis_{name}_tlast": last}


def under(port: str, values: Arrays) -> Arrays:
    """The fields of a structure by the name of its port."""
    return {f"{port}.{name}": np.asarray(value, np.int64) for name, value in values.items()}


def axes(port: str, vectors: np.ndarray) -> Arrays:
    """Vectors (S, 3) by their fields; :func:`vectors`: the other way round."""
    return {f"{port}.{axis}": vectors[:, i] for i, axis in enumerate("xyz")}


# ---- records to pixels ---------------------------------------------------------------------------------------------


def records(rng: Rng, count: np.ndarray, _kind: Hashable) -> Arrays:
    """The fields of records: any degree, nodes in [0, 1] or of any bits; a third of them go on in the next one."""
    rows = len(count)
    degree = np.where(count <= k.DIRECT_MAX, rng.integers(0, 4, rows), rng.integers(1, 4, rows))
    shape = (rows, k.CHANNELS, k.NODE_COUNT)
    free = rng.integers(-(1 << k.INTENSITY_W - 1), 1 << k.INTENSITY_W - 1, shape)
    corner = rng.choice([free.min(), free.max(), -1, 0, 1, ONE, -ONE], shape)
    free = np.where(rng.random(shape) < 0.25, corner, free)
    kind = rng.integers(0, 3, (rows, 1, 1))
    nodes = np.select([kind == 0, kind == 1], [free, rng.integers(-ONE, ONE, shape)], rng.integers(0, ONE + 1, shape))
    beats = poly.pack_records(nodes, degree, count, rng.integers(0, 1 << k.TAG_W, rows), rng.random(rows) < 1 / 3)
    return unpack(RECORD, beats)


def _noise(rng: Rng, record: Arrays) -> np.ndarray:
    """Records as beats; bits without a meaning are random."""
    leaves = list(RECORD.leaves())
    used = words(leaves, [np.int64(-1)] * len(leaves), k.RECORD_DATA_W)
    beats = pack(RECORD, record)
    spare = ~used
    spare[-1] &= np.uint32((1 << (k.RECORD_DATA_W - 1) % 32 + 1) - 1)
    return beats | rng.integers(0, 1 << 32, beats.shape, dtype=np.uint32) & spare


def _nodes(record: Arrays) -> np.ndarray:
    """(S, 2, 4)."""
    return np.stack([np.stack([record[f"{c}.n{n}"] for n in range(k.NODE_COUNT)], -1) for c in CHANNELS], 1)


def poly_span(evaluator: int, form: str, **more: int) -> Stream:
    node_set = more.get("NODES", k.NODES_LEFT)

    def golden(i: Arrays) -> Given:
        record = unpack(RECORD, i["s_axis_span_tdata"])
        pixels, owner = poly.poly_span(
            _nodes(record), record["head.degree"], record["head.count"], evaluator=evaluator, node_set=node_set,
            form=FORMS[form],
        )  # fmt: skip
        last = ends(owner, record["head.more"])
        return Given(axis("pixel", list(pixels.T), k.PIXEL_W, record["head.tag"][owner], last), owner)

    def errors(i: Arrays, given: Given) -> tuple[np.ndarray, np.ndarray]:
        """Against the exact polynomial through the nodes, clamped to what a pixel holds, in this form and refined."""
        record, owner = unpack(RECORD, i["s_axis_span_tdata"]), given.owner
        degree, count, nodes = record["head.degree"], record["head.count"], _nodes(record)
        j = np.arange(len(owner)) - np.searchsorted(owner, owner)
        t = np.ldexp(j.astype(Real), -poly.span_log2(count)[owner])[:, None]
        direct = np.flatnonzero(degree[owner] == k.DEGREE_DIRECT)
        pixels = given.words["m_axis_pixel_tdata"][:, None] >> np.array([0, k.PIXEL_W]) & (1 << k.PIXEL_W) - 1
        named = {"degree_i": degree[:, None]} | {f"i{n + 1}_i": nodes[..., n] for n in range(k.NODE_COUNT)}

        def error(formula: str) -> np.ndarray:
            a, b, c, d = (coefficient(name, node_set, formula)(named)[owner] for name in "abcd")
            value = ((a * t + b) * t + c) * t + d
            value[direct] = nodes[owner[direct], :, j[direct]]
            return np.abs(pixels - value.clip(0, (1 << k.PIXEL_W) - 1)).max(axis=1)

        return error(form), error("refined")

    horner = evaluator == k.EVALUATOR_HORNER
    longest = 1 << more.get("LOG2_MAX", k.LOG2_MAX)
    return Stream(
        "shade_poly_span", {"EVALUATOR": evaluator, "FORM": FORMS[form]} | more,
        lambda rng, count, kind: {"s_axis_span_tdata": _noise(rng, records(rng, count, kind))}, golden,
        k.LATENCY_POLY_SPAN_HORNER if horner else k.LATENCY_POLY_SPAN_FDIFF, longest=longest, errors=errors,
        held=lambda _, n: (1 << k.FIFO_LOG2) // n + 1,
    )  # fmt: skip


def poly_line(**parameters: int) -> Stream:
    """As ``shade_poly_span``; a record is taken with its last pixel."""

    def items(rng: Rng, count: np.ndarray, kind: Hashable) -> Arrays:
        record = records(rng, count, kind)
        short = np.select([count < 3, count == 3], [k.DEGREE_DIRECT, rng.integers(0, 2, len(count))], 3)
        record["head.degree"] = np.minimum(record["head.degree"], short)
        return {"s_axis_span_tdata": _noise(rng, record)}

    return replace(
        poly_span(k.EVALUATOR_FDIFF, "refined"), module="shade_poly_line", parameters=parameters, items=items,
        latency=lambda _, given: k.LATENCY_POLY_LINE + 1 - np.bincount(given.owner),
        longest=(1 << parameters.get("LOG2_MAX", k.RECORD_LOG2)) + 1, through=("s_axis_span_tdata",),
        held=lambda _, n: (1 << k.FIFO_LOG2) // n,
    )  # fmt: skip


def _span_walk(**parameters: int) -> Stream:
    def golden(i: Arrays) -> Given:
        record = structure(i, "record_i")
        owner, j = poly.span_walk(record["head.count"])
        direct = record["head.degree"][owner] == k.DEGREE_DIRECT
        log2 = poly.span_log2(record["head.count"])[owner]
        nodes, at = _nodes(record), np.arange(k.NODE_COUNT) + np.where(direct, j, 0)[:, None]
        shown = np.where(at[:, None] < 4, np.take_along_axis(nodes[owner], at.clip(max=3)[:, None], -1), 0)
        words = {f"{c}.n{n}": shown[:, i, n] for i, c in enumerate(CHANNELS) for n in range(k.NODE_COUNT)}
        words |= {
            "first": (j == 0) | direct, "last": ends(owner, record["head.more"]), "log2": log2,
            "degree": record["head.degree"][owner], "t": j << k.T_F - log2, "tag": record["head.tag"][owner],
        }  # fmt: skip
        return Given(under("token_o", words), owner)

    return Stream(
        "shade_span_walk", parameters,
        lambda *of: under("record_i", records(*of)), golden, 2, wakes=2,
        longest=1 << parameters.get("LOG2_MAX", k.LOG2_MAX), credits=1 << parameters.get("CREDIT_LOG2", k.FIFO_LOG2),
    )  # fmt: skip


def _walk(**parameters: int) -> Stream:
    def golden(i: Arrays) -> Given:
        owner = np.repeat(np.arange(len(i["count_i"])), i["count_i"])
        first = np.append(1, np.diff(owner)) != 0
        return Given({"first_o": first.astype(np.int64), "last_o": ends(owner)}, owner)

    room = parameters.get("CREDIT_LOG2", k.FIFO_LOG2)
    enough = room > 1  # a credit needs two clocks to come back
    return Stream(
        "shade_walk", parameters, lambda rng, count, kind: {"count_i": count}, golden, 1, valid="issue_o",
        longest=(1 << parameters.get("COUNT_W", k.COUNT_W)) - 1, credits=1 << room, steady=enough, brisk=enough,
        wakes=1, through=("valid_i",),
    )  # fmt: skip


# ---- spans to normals ----------------------------------------------------------------------------------------------


def lines(rng: Rng, count: np.ndarray) -> Spans:
    """Lines between unit normals, bent by any angle."""
    rows = len(count)
    first, other = (unit_vectors(rng, rows).T / ONE for _ in range(2))
    last = first + (other - first) * np.ldexp(1.0, -rng.integers(0, 10, (rows, 1)))
    last /= np.linalg.norm(last, axis=1, keepdims=True)
    step = (last - first) / np.maximum(count - 1, 1)[:, None]
    vectors = (np.rint(v * (1 << k.STEP_F)).astype(np.int64) for v in (first, step))
    cosine = np.rint(np.sum(first * last, axis=1) * ONE).astype(np.int64)
    return Spans(*vectors, count, rng.integers(0, 1 << k.TAG_W, rows), cosine, np.zeros(rows, np.int64))


def pixel_normals(variants=range(8)) -> Stream:
    """``shade_pixel_normals``: variants and thresholds of all kinds, next to 0 and 1 too."""

    def items(rng: Rng, count: np.ndarray, _kind: Hashable) -> Arrays:
        rows = len(count)
        others = rng.integers(-ONE // 8, ONE + ONE // 8, rows), rng.choice([-1, 0, ONE, ONE + 1], rows)
        threshold = np.choose(rng.integers(0, 10, rows).clip(max=2), [*others, k.METRIC_THRESHOLD])
        beats = {"s_axis_line_tdata": lines(rng, count).beats()}
        return beats | {"variant_i": rng.choice(variants, rows), "threshold_i": threshold}

    def golden(i: Arrays) -> Given:
        s = Spans.of(i, "s_axis_line_tdata")
        vectors, owner = normal.pixel_normals(s.normal, s.step, s.count, s.cosine, i["variant_i"], i["threshold_i"])
        return Given(axis("normal", list(vectors.T), k.INTENSITY_W, s.tag[owner], ends(owner)), owner)

    def errors(i: Arrays, given: Given) -> tuple[np.ndarray, np.ndarray]:
        """Of the pixels that are normalized exactly, against the unit vector of the interpolated normal."""
        s, owner = Spans.of(i, "s_axis_line_tdata"), given.owner
        j = np.arange(len(owner)) - np.searchsorted(owner, owner)
        exact = (j % 2 == 0) | (j == s.count[owner] - 1) | (i["variant_i"][owner] == k.VARIANT_EXACT)
        true = (s.normal[owner] + j[:, None] * s.step[owner]).astype(Real)
        data = given.words["m_axis_normal_tdata"][:, None] >> k.INTENSITY_W * np.arange(3)
        vectors = (data & (1 << k.INTENSITY_W) - 1) - ((data >> k.INTENSITY_W - 1 & 1) << k.INTENSITY_W)

        def error(v: np.ndarray) -> np.ndarray:
            unit = v * ONE / np.sqrt((v**2).sum(axis=1, keepdims=True))
            return np.where(exact, np.abs(vectors - unit).max(axis=1), 0)

        return error(np.floor(true / (1 << k.STEP_F - k.INTENSITY_F) + Real(0.5))), error(true)

    return Stream(
        "shade_pixel_normals", {}, items, golden, k.LATENCY_PIXEL_NORMALS, longest=k.PIXELS_MAX, errors=errors,
        held=lambda _, n: (1 << k.NORMAL_FIFO_LOG2) // n + 1,
    )  # fmt: skip


def _pixel_points() -> Stream:
    def items(rng: Rng, count: np.ndarray, variant: Hashable) -> Arrays:
        return spans(rng, count).leaves("span_i") | port({"variant": variant, "threshold": k.METRIC_THRESHOLD})

    def golden(i: Arrays) -> Given:
        s, draw = Spans.of(i, "span_i"), draw_of(i)
        n, owner = normal.pixel_normals(s.normal, s.step, s.count, s.cosine, draw["variant"], draw["threshold"])
        zero, one = np.zeros_like(owner), np.ones_like(owner)
        place = {"slot": zero, "shared": zero, "last": one, "head.count": one, "head.degree": zero, "head.log2": zero}
        place |= {"head.more": 1 - ends(owner), "head.tag": s.tag[owner]}
        return Given(axes("normal_o", n) | under("place_o", place), owner)

    return Stream(
        "shade_pixel_points", {}, items, golden, k.LATENCY_PIXEL_NORMALS, kinds=tuple(range(8)), longest=k.PIXELS_MAX,
        credits=1 << k.RECORD_FIFO_LOG2, steady=False, brisk=False,
    )  # fmt: skip


# ---- spans to nodes --------------------------------------------------------------------------------------------------

PLANNED = ("main", "log2", "degree", "last_count", "last_log2", "last_degree")
LIMITS = "normals at the ends of S2.29 and around the last one that is not saturated"


def planned(rng: Rng, count: np.ndarray, kind: Hashable) -> Arrays:
    """Planned spans of all kinds: of one record or several, of any degree; normals with any 32 bits."""
    rows = len(count)
    log2, degree = rng.integers(2, 5, rows), rng.integers(0, 4, rows)
    log2[degree == k.DEGREE_DIRECT] = 2
    main = np.where(rng.random(rows) < 0.5, 0, rng.integers(0, 8, rows))
    direct = (main > 0) & (degree == k.DEGREE_DIRECT)  # then all of a span's records are
    last_degree = np.where(direct, k.DEGREE_DIRECT, rng.integers(0, 4, rows))
    first = (main > 0) & (degree != k.DEGREE_DIRECT)  # the last record shares its first node
    low = np.select([last_degree == k.DEGREE_DIRECT, last_degree == k.DEGREE_CUBIC], [1 + first, 5], last_degree + 2)
    high = np.where(last_degree == k.DEGREE_DIRECT, 4, np.maximum(low, (1 << log2) + 1))
    last_count = rng.integers(low, high, endpoint=True)
    n = rng.integers(-(1 << 31), 1 << 31, (rows, 3))
    if kind == LIMITS:
        main, last_degree, last_count = 0 * main, 0 * main, 0 * main + 1
        most, half = 1 << k.STEP_W - 1, 1 << k.STEP_F - k.NODE_F - 1
        edges = [most - 1, most - half, most - half - 1, most - 2 * half, -most, half - most, half - most - 1, 0]
        n = rng.choice(edges, (rows, 3))
    g = rng.integers(-(1 << 31), 1 << 31, (rows, 3)) >> rng.integers(0, 31, (rows, 1))
    job = axes("normal", n) | axes("increment", g)
    job |= {"flat": rng.integers(0, 2, rows), "tag": rng.integers(0, 1 << k.TAG_W, rows)}
    values = (main, log2, degree, last_count, poly.span_log2(last_count), last_degree)
    cut = dict(zip(PLANNED, values, strict=True)) | {"split": (main != 0).astype(np.int64)}
    return under("job_i", job) | under("plan_i", cut)


def vectors(part: Arrays, *names: str) -> Iterator[np.ndarray]:
    """Vectors (S, 3) from their fields."""
    return (np.stack([part[f"{name}.{a}"] for a in "xyz"], -1) for name in names)


def _stretch() -> Stream:
    def golden(i: Arrays) -> Given:
        job, cut = structure(i, "job_i"), structure(i, "plan_i")
        words = plan.stretch(*(cut[name] for name in PLANNED))
        owner, shift = words.pop("span"), words.pop("step_log2")
        n, g = vectors(job, "normal", "increment")
        step = plan.wrap(g[owner] << shift[:, None], k.STEP_W)
        words |= axes("normal", n[owner]) | axes("step", step)
        fresh = np.append(1, np.diff(owner)) != 0
        words |= {"tag": job["tag"][owner], "flat": job["flat"][owner], "fresh": fresh, "more": 1 - ends(owner)}
        words |= {"single": words["records"] == 1}
        return Given(under("stretch_o", words), owner)

    return Stream(
        "shade_stretch", {}, planned, golden, lambda i, given: 3 - np.bincount(given.owner),  # taken with its last word
        through=("plan_i", "ready_i"), apart=("job_i", "job_taken_o"),
    )  # fmt: skip


def _places(nodes: plan.Nodes, tag: np.ndarray) -> Arrays:
    """Where nodes stand in their records, by the fields of ``place_t``."""
    head = {name: getattr(nodes, name)[nodes.record] for name in ("count", "more", "degree", "log2")}
    place = under("head", head | {"tag": tag[nodes.span[nodes.record]]})
    return place | {"slot": nodes.slot, "shared": nodes.shared, "last": ends(nodes.record)}


def _node_walk(**parameters: int) -> Stream:
    def golden(i: Arrays) -> Given:
        job, cut = structure(i, "job_i"), structure(i, "plan_i")
        nodes = plan.node_walk(*vectors(job, "normal", "increment"), *(cut[name] for name in PLANNED))
        owner = nodes.span[nodes.record]
        words = under("place", _places(nodes, job["tag"])) | {"flat": job["flat"][owner]}
        return Given(under("node_o", words | axes("normal", nodes.vector)), owner)

    fold, room = parameters.get("FOLD", 1), parameters.get("CREDIT_LOG2", k.RECORD_FIFO_LOG2)
    return Stream(
        "shade_node_walk", parameters, planned, golden,
        lambda i, _: k.LATENCY_NODE_WALK - i["plan_i.split"], kinds=(None, LIMITS), stride=fold,
        slack=fold - 1, steady=False, brisk=room > 2, credits=1 << room, record="node_o.place.last",
        through=("valid_i", "plan_i"), apart=("job_i", "job_taken_o"),
    )  # fmt: skip


def _line(**parameters: int) -> Stream:
    def items(rng: Rng, count: np.ndarray, kind: tuple[int, int]) -> Arrays:
        code, degree = kind
        return spans(rng, count).leaves("span_i") | port(settings(rng, code) | {"fixed_degree": degree})

    def golden(i: Arrays) -> Given:
        s = Spans.of(i, "span_i")
        nodes, n, zero, short = plan.line(s.normal, s.step, s.count, draw_of(i), s.flat)
        words = axes("normal", n) | {"zero": zero, "too_short": short}
        return Given(under("unit_o", words), nodes.span[nodes.record], under("place_o", _places(nodes, s.tag)))

    fold = parameters.get("FOLD", 1)
    return Stream(
        "shade_line", parameters, items, golden, k.line_latency(fold), steady=False,
        kinds=((k.MODEL_BLINN, 0), (k.MODEL_LAMBERT, 0), (k.MODEL_BLINN, 3)), usual=((k.MODEL_BLINN, 3),), stride=fold,
        credits=1 << k.RECORD_FIFO_LOG2, record="place_o.last", beside="place_valid_o",
        longest=k.PIXELS_MAX, lengths=(5, 9, 33), slack=fold - 1,
        pace=lambda _: k.planner_pace(),
    )  # fmt: skip


# ---- spans to light --------------------------------------------------------------------------------------------------


def _phong(form: str, **more: int) -> Stream:
    def items(rng: Rng, count: np.ndarray, code: int) -> Arrays:
        return {"s_axis_span_tdata": spans(rng, count).beats()} | port(settings(rng, code))

    built = {name.lower(): value for name, value in more.items()}

    def golden(i: Arrays) -> Given:
        s = Spans.of(i, "s_axis_span_tdata")
        pixels, owner = core.phong(s.normal, s.step, s.count, draw_of(i), form=FORMS[form], **built)
        return Given(axis("pixel", list(pixels.T), k.PIXEL_W, s.tag[owner], ends(owner)), owner)

    return Stream(
        "shade_phong", {"FORM": FORMS[form]} | more, items, golden,
        k.LATENCY_PHONG - (not more.get("REFLECT", 1)) * k.LATENCY_REFLECT, kinds=tuple(CODES), usual=(k.MODEL_BLINN,),
        longest=k.PIXELS_MAX, held=lambda _, n: (1 << k.PHONG_FIFO_LOG2) // n + 1,
    )  # fmt: skip


def _lane(form: str = "refined", **more: int) -> Stream:
    """Kinds: path, model, degree (0: adaptive, None: any). With two multipliers fewer paths and models are left."""
    fold, by_normals = more.get("FOLD", 1), more.get("PATH_NORMALS", 1) == 1
    horner = more.get("EVALUATOR", k.EVALUATOR_FDIFF) == k.EVALUATOR_HORNER
    spanwise = horner or form == "paper"  # by shade_poly_span
    built = {name.lower(): value for name, value in more.items() if name != "FOLD"}

    def items(rng: Rng, count: np.ndarray, kind: tuple) -> Arrays:
        path, code, degree = kind
        degree = int(rng.choice([0, 0, 1, 2, 3])) if degree is None else degree
        s = spans(rng, count)
        s.flat &= kind[2] is None
        return s.leaves("span_i") | port(settings(rng, code) | {"path": path, "variant": code, "fixed_degree": degree})

    def golden(i: Arrays) -> Given:
        s = Spans.of(i, "span_i")
        options = {"flat": s.flat, "cosine": s.cosine, "form": FORMS[form]} | built
        drawn = core.lane(s.normal, s.step, s.count, draw_of(i), **options)
        words = {f"pixel.{name}": drawn.pixels[:, i] for i, name in enumerate(CHANNELS)}
        words |= {"tag": s.tag[drawn.span], "last": ends(drawn.span)}
        return Given(under("drawn_o", words), drawn.span, {"flags_o": drawn.flags})

    def normals(path: int) -> bool:
        return path == k.PATH_NORMALS and by_normals

    def nodes(i: Arrays) -> np.ndarray:
        """In which light is computed: of each span's first record."""
        draw, count = draw_of(i), i["span_i.count"]
        return np.where(count <= k.DIRECT_MAX, count, draw["fixed_degree"] + 1)

    def latency(i: Arrays, _given: Given) -> ArrayLike:
        path = draw_of(i)["path"]
        clocks = k.lane_latency(fold) if fold > 1 else k.LATENCY_LANE_NORMALS if normals(path) else k.LATENCY_LANE
        clocks += (k.LATENCY_POLY_SPAN_HORNER - k.LATENCY_POLY_LINE) * horner
        clocks -= (not more.get("REFLECT", 1) and fold == 1) * k.LATENCY_REFLECT
        return clocks if normals(path) else clocks + fold * (nodes(i) - 1)

    def work(i: Arrays) -> np.ndarray:
        return 0 * i["span_i.count"] if normals(draw_of(i)["path"]) else fold * nodes(i)

    def held(kind: tuple, n: int) -> int:
        """Pixels and records begun, with a credit; before them normals, or spans in the walk and in front of it."""
        pixels, kept = 1 << k.FIFO_LOG2, 1 << k.RECORD_FIFO_LOG2
        if normals(kind[0]):
            return (pixels + spanwise + kept + (1 << k.NORMAL_FIFO_LOG2)) // n + 1
        return pixels // n + spanwise + kept + 2 + (1 << k.SPAN_FIFO_LOG2)

    return Stream(
        "shade_lane", more if form == "refined" else {"FORM": FORMS[form]} | more, items, golden, latency,
        kinds=tuple((path, code, None) for code in CODES for path in PATHS),
        usual=tuple((path, k.MODEL_BLINN, k.DEGREE_CUBIC) for path in PATHS),
        alone=tuple((path, k.MODEL_BLINN, degree) for path in PATHS for degree in (1, 2, 3)), steady=False, work=work,
        longest=k.PIXELS_MAX, held=held, beside="lit_o", slack=fold - 1,
        pace=lambda i: 0 if normals(draw_of(i)["path"]) else k.planner_pace(),
        lengths=(1, 2, 3, 4, 5, 33),
    )  # fmt: skip


def _paint(**parameters: int) -> Stream:
    def items(rng: Rng, count: np.ndarray, colour: int) -> Arrays:
        rows, most = len(count), (1 << k.PIXEL_W) - 1
        free, corner = rng.integers(0, most, (2, rows)), rng.choice([0, most], (2, rows))
        light = np.where(rng.random((2, rows)) < 0.25, corner, free)
        fields = {"pixel.diffuse": light[0], "pixel.specular": light[1], "last": rng.integers(0, 2, rows)}
        fields["tag"] = rng.integers(0, 1 << k.TAG_W, rows)
        draw = settings(rng, k.MODEL_BLINN) | {"colour": colour}
        return under("drawn_i", fields) | port(draw)

    def golden(i: Arrays) -> Given:
        drawn = structure(i, "drawn_i")
        light = np.stack([drawn["pixel.diffuse"], drawn["pixel.specular"]], -1)
        words = dict(zip(("pixel.red", "pixel.green", "pixel.blue"), core.paint(light, draw_of(i)).T, strict=True))
        words |= {"tag": drawn["tag"], "last": drawn["last"]}
        return Given(under("painted_o", words), np.arange(len(light)))

    return Stream(
        "shade_paint", parameters, items, golden, k.LATENCY_PAINT, kinds=(1, 0), lengths=(1,),
        held=lambda _, n: 1 << parameters.get("FIFO_LOG2", k.FIFO_LOG2),
    )  # fmt: skip


# ---- runs of triangles to scalars of pixels --------------------------------------------------------------------------


def _direct_moves() -> Stream:
    """Good runs, empty and long ones, some that are not below the one before."""

    def items(rng: Rng, count: np.ndarray, _kind: Hashable) -> Arrays:
        rows = len(count)
        run = {name: rng.integers(0, 4, rows) == 0 for name in ("first", "last")}
        run["first"][0] = True
        run |= {"column": rng.integers(0, 4096, rows), "line": rng.integers(0, 8, rows).cumsum() % 4096}
        run |= {"count": rng.choice([0, 1, 5, k.PIXELS_MAX, k.PIXELS_MAX + 1, 8191], rows)}
        return under("run_i", run | {"tag": rng.integers(0, 1 << k.TAG_W, rows)})

    def golden(i: Arrays) -> Given:
        run, rows, column, line = structure(i, "run_i"), [], 0, 0
        for x, y, count, first in zip(*(run[n].tolist() for n in ("column", "line", "count", "first")), strict=True):
            good = 0 < count <= k.PIXELS_MAX and bool(first or y >= line)
            move = good and not first
            rows.append((move * (y - line), move * (x - column), good))
            if good or first:
                column, line = x, y + good
        words = dict(zip(("lines", "columns", "good"), np.array(rows, np.int64).T, strict=True))
        words |= {name: run[name] for name in ("first", "last", "count", "tag")}
        return Given(under("moves_o", words), np.arange(len(rows)))

    return Stream(
        "shade_direct_moves", {}, items, golden, 1, lengths=(1,), through=("ready_i",), held=lambda _, n: 1
    )  # fmt: skip


def _direct_run(**parameters: int) -> Stream:
    """Sums modulo their widths."""
    start = {leaf.name: leaf for leaf in STRUCTS["start_t"].leaves()}

    def items(rng: Rng, count: np.ndarray, _kind: Hashable) -> Arrays:
        values = {name: rng.integers(*leaf.range, len(count), endpoint=True) for name, leaf in start.items()}
        return under("start_i", values | {"count": count})

    def golden(i: Arrays) -> Given:
        owner, j = poly.span_walk(i["start_i.count"])
        at = {name: value[owner] for name, value in structure(i, "start_i").items()}
        p = at["at.p"] + j * at["p_column"] + j * (j - 1) * at["p_columns"]
        words = {c: plan.wrap(at[f"at.{c}"] + j * at[f"{c}_column"], start[f"at.{c}"].width) for c in "ah"}
        words = under("scalars_o", words | {"p": p & (1 << k.DIRECT_P_W) - 1})
        return Given(words | {"tag_o": at["tag"], "last_o": ends(owner)}, owner)

    return Stream(
        "shade_direct_run", parameters, items, golden, 1, longest=k.PIXELS_MAX, wakes=1,
        credits=1 << parameters.get("FIFO_LOG2", k.DIRECT_FIFO_LOG2),
    )  # fmt: skip


SMALL = {"REFLECT": 0, "DIVIDE": 0}


def streams() -> Iterator[Stream]:
    """All of them; tests take the first two points of a module by default."""
    yield from (poly_span(k.EVALUATOR_HORNER, "refined"), poly_span(k.EVALUATOR_FDIFF, "paper"))
    yield from (poly_span(k.EVALUATOR_HORNER, "paper"), poly_span(k.EVALUATOR_FDIFF, "refined"))
    yield poly_span(k.EVALUATOR_HORNER, "paper", NODES=k.NODES_RIGHT)
    yield poly_span(k.EVALUATOR_FDIFF, "paper", NODES=k.NODES_RIGHT, LOG2_MAX=6)
    yield from (poly_line(), poly_line(LOG2_MAX=12))
    yield from (_span_walk(), _span_walk(LOG2_MAX=6, CREDIT_LOG2=2), _walk(), _walk(COUNT_W=4, CREDIT_LOG2=1))
    yield from (pixel_normals(), _pixel_points(), _stretch())
    yield from (_node_walk(), _node_walk(CREDIT_LOG2=1), _node_walk(FOLD=6), _line(), _line(FOLD=6))
    yield from (_line(FOLD=fold) for fold in (2, 3, 4, 5, 7, 8))
    yield from (_phong("refined"), _phong("refined", **SMALL), _phong("paper"))
    small = SMALL | {"PATH_NORMALS": 0}
    yield from (_lane(), _lane("paper", EVALUATOR=k.EVALUATOR_HORNER, **small), _lane(FOLD=6, **small))
    yield from (_lane(FOLD=fold, **small) for fold in (2, 3, 4, 5, 7, 8))
    yield from (_paint(), _paint(FIFO_LOG2=4))
    yield from (_direct_moves(), _direct_run())


def measured() -> dict[str, Stream]:
    """Those whose errors are measured, by their names in ``units.json``."""
    found = {}
    for form in FORMS:
        for evaluator, point in ((k.EVALUATOR_HORNER, ""), (k.EVALUATOR_FDIFF, f"[EVALUATOR={k.EVALUATOR_FDIFF}]")):
            found[f"shade_poly_span{point}/{form}"] = poly_span(evaluator, form)
    found["shade_poly_line/refined"] = poly_line()
    papers = range(k.VARIANT_V1, k.VARIANT_V6 + 1)
    found["shade_pixel_normals/refined"] = pixel_normals([k.VARIANT_REFINED])
    return found | {"shade_pixel_normals/paper": pixel_normals(papers)}


def cases() -> Iterator[Case]:
    """The FIFO by NumPy, a word on every clock; what else it does: tb/stream/test_fifo.py."""
    same = lambda i: {"data_o": i["data_i"]}  # noqa: E731
    for point in ({}, {"LOG2": 1}, {"LOG2": 1, "BLOCK": 1}, {"BLOCK": 1}):
        yield Case(
            "shade_fifo", "refined", point, same, same, same, mixed({"data_i": (0, (1 << 32) - 1)}), None,
            k.LATENCY_FIFO_BLOCK if "BLOCK" in point else k.LATENCY_FIFO, bound=0, unit_f=0, ordered=True,
            own_bench=True,
        )  # fmt: skip
