"""Every arithmetic unit with its golden twin, the exact value of its formula, and vectors: for tests and report.

A :class:`Case` is a module at a parameter point with a stream of vectors: all of them at reduced widths, directed
corners and random ones at full width. :meth:`Case.check` runs it through the RTL and measures

    mismatches        RTL against golden model, in every bit, and in every latency
    max_error_ulp     golden model against the exact value of the unit's formula, in units of its last bit
    max_error_ideal   against the function that the formula approximates, as a number (1.0: full intensity)
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

import sim
from golden import contract as k
from golden import fixed, normal, plan, poly

Arrays = dict[str, np.ndarray]
CHUNK = 1 << 20
Real = np.longdouble  # 64 bits of mantissa: every exact value here has an error below 2^-50 ulp


@dataclass
class Result:
    """What a case measured; see the module's docstring."""

    vectors: int = 0
    mismatches: int = 0
    first_mismatch: str = ""
    max_error_ulp: float = 0.0
    max_error_ideal: float = 0.0
    worst_input: dict[str, int] = field(default_factory=dict)
    latency: int = 0
    throughput: float = 0.0

    def add(self, other: Result) -> None:
        """Take another result of the same unit in."""
        if other.max_error_ulp > self.max_error_ulp or not self.vectors:
            self.max_error_ulp, self.worst_input = other.max_error_ulp, other.worst_input
        self.max_error_ideal = max(self.max_error_ideal, other.max_error_ideal)
        self.vectors += other.vectors
        self.mismatches += other.mismatches
        self.first_mismatch = self.first_mismatch or other.first_mismatch
        self.latency, self.throughput = other.latency, other.throughput


@dataclass(frozen=True)
class Case:
    """A module at a parameter point and what it must compute.

    ``golden``, ``exact``, ``ideal``: inputs -> outputs by port name; ``vectors(rng, rows)`` makes random inputs,
    ``all_vectors`` yields every input. ``latency``: declared; of every single vector. ``unit_f``: fraction bits of
    the outputs, ``more_f``: of those ports that have others.
    """

    module: str
    form: str
    parameters: dict[str, int]
    golden: Callable[[Arrays], Arrays]
    exact: Callable[[Arrays], Arrays]
    ideal: Callable[[Arrays], Arrays]
    vectors: Callable[[np.random.Generator, int], Arrays] | None
    all_vectors: Callable[[], Iterator[Arrays]] | None
    latency: int
    clocks_per_vector: int = 1
    unit_f: int = k.INTENSITY_F
    more_f: dict[str, int] = field(default_factory=dict)

    def __str__(self) -> str:
        point = ",".join(f"{name}={value}" for name, value in self.parameters.items())
        return f"{self.module}/{self.form}{f'[{point}]' if point else ''}{'' if self.vectors else '/all'}"

    def stream(self, vectors: int, seed: int) -> Iterator[Arrays]:
        """The vectors of a run, chunk by chunk: all there are, or ``vectors`` of a seed."""
        if self.all_vectors:
            yield from self.all_vectors()
            return
        for chunk, first in enumerate(range(0, vectors, CHUNK)):
            yield self.vectors(np.random.default_rng([seed, chunk]), min(CHUNK, vectors - first))

    def check(self, vectors: int = CHUNK, seed: int = 1, tick: Callable[[int], object] = lambda rows: None) -> Result:
        """Run the vectors through RTL, golden model and exact formula. ``tick`` is told the rows that are done."""
        model = sim.load(self.module, **self.parameters)
        fixed_latency = self.latency if model.interface.clock and not model.interface.out.valid else 0
        total = Result(latency=self.latency)
        for inputs in self.stream(vectors, seed):
            rows = len(next(iter(inputs.values())))
            run = model.run(latency=fixed_latency, seed=seed, **inputs)
            result = Result(vectors=rows, latency=self.latency, throughput=rows / (run.clocks - self.latency))
            golden = self.golden(inputs)
            self._compare(model, inputs, golden, run, result)
            self._measure(inputs, golden, result)
            total.add(result)
            tick(rows)
        return total

    def _compare(self, model: sim.Model, inputs: Arrays, expected: Arrays, run: sim.Run, result: Result) -> None:
        wrong = np.zeros(result.vectors, bool)
        for name, value in expected.items():
            actual = run.outputs[name]
            if len(actual) != len(value):
                result.mismatches = abs(len(actual) - len(value))
                result.first_mismatch = f"{self}: {len(actual)} outputs of {name}, expected {len(value)}"
                return
            wrong |= actual != value
        late = run.given - run.taken != self.latency
        result.mismatches = int(np.count_nonzero(wrong | late))
        if result.mismatches:
            at = int(np.argmax(wrong | late))
            values = ", ".join(
                f"{name} expected {_hex(value[at])} actual {_hex(run.outputs[name][at])}"
                for name, value in expected.items()
            )
            row = {name: value[at] for name, value in inputs.items()}
            given = ", ".join(f"{name}={_hex(value)}" for name, value in row.items())
            clocks = int(run.given[at] - run.taken[at])
            result.first_mismatch = (
                f"{self}: vector {at}: {given}: {values}, latency {clocks} of {self.latency}; again with a waveform: "
                + model.again(**row, **({"latency": self.latency} if not model.interface.out.valid else {}))
            )

    def _measure(self, inputs: Arrays, golden: Arrays, result: Result) -> None:
        exact = self.exact(inputs)
        ideal = exact if self.ideal is self.exact else self.ideal(inputs)
        for name, value in golden.items():
            error = np.abs(value - exact[name])
            at = int(np.argmax(error))
            if float(error[at]) > result.max_error_ulp or not result.worst_input:
                result.max_error_ulp = float(error[at])
                result.worst_input = {port: int(array[at]) for port, array in inputs.items()}
            distance = float(np.abs(value - ideal[name]).max()) / (1 << self.more_f.get(name, self.unit_f))
            result.max_error_ideal = max(result.max_error_ideal, distance)


def _hex(value: int) -> str:
    return f"{int(value):#x}"


# ---- vectors ----------------------------------------------------------------------------------------------------


def signed_range(width: int) -> tuple[int, int]:
    """Smallest and largest number of a signed format."""
    return -(1 << width - 1), (1 << width - 1) - 1


def corners(low: int, high: int, *more: int) -> np.ndarray:
    """Values where units break: the ends of a range and their neighbours, around zero, and those named."""
    values = {low, low + 1, high - 1, high, -1, 0, 1, *more}
    return np.array(sorted(value for value in values if low <= value <= high))


def mixed(ranges: dict[str, tuple[int, int]], *more: int) -> Callable[[np.random.Generator, int], Arrays]:
    """Vectors of which an eighth takes every input from its corners, an eighth is small, the rest is uniform."""

    def make(rng: np.random.Generator, rows: int) -> Arrays:
        kind = rng.integers(0, 8, rows)
        arrays = {}
        for name, (low, high) in ranges.items():
            value = rng.integers(low, high, rows, endpoint=True)
            small = rng.integers(max(low, -16), min(high, 16), rows, endpoint=True)
            corner = rng.choice(corners(low, high, *more), rows)
            arrays[name] = np.select([kind == 0, kind == 1], [corner, small], value)
        return arrays

    return make


def every(ranges: dict[str, tuple[int, int]]) -> Callable[[], Iterator[Arrays]]:
    """All combinations of all values, in chunks."""

    def make() -> Iterator[Arrays]:
        sizes = [high - low + 1 for low, high in ranges.values()]
        total = int(np.prod(sizes))
        for first in range(0, total, CHUNK):
            index = np.unravel_index(np.arange(first, min(first + CHUNK, total)), sizes)
            yield {name: part + low for (name, (low, _)), part in zip(ranges.items(), index, strict=True)}

    return make


def late(values: np.ndarray, clocks: int) -> np.ndarray:
    """What a port that is taken so many clocks after the others gives to each row; the last value stays."""
    return np.r_[values[clocks:], np.repeat(values[-1:], clocks)][: len(values)]


# ---- the units ---------------------------------------------------------------------------------------------------

FORMS = {"refined": k.FORM_REFINED, "paper": k.FORM_PAPER}
ONE = 1 << k.INTENSITY_F


def _third(form: str) -> Iterator[Case]:
    def exact(inputs: Arrays) -> Arrays:
        x = inputs["x_i"].astype(Real)
        return {"y_o": x / 3 if form == "refined" else x * 43 / 128}

    for width in (20, 18, 12, 4, 26):
        ranges = {"x_i": signed_range(width)}
        yield Case(
            "shade_third", form, {"WIDTH": width, "FORM": FORMS[form]},
            lambda i: {"y_o": fixed.third(i["x_i"], FORMS[form])}, exact, lambda i: {"y_o": i["x_i"].astype(Real) / 3},
            mixed(ranges) if width > 20 else None, every(ranges) if width <= 20 else None, k.LATENCY_THIRD,
        )  # fmt: skip


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


def _coefficient(name: str, nodes: int, form: str) -> Callable[[Arrays], np.ndarray]:
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
    def golden_part(name: str, nodes: int):
        def golden(i: Arrays) -> Arrays:
            arguments = [i["degree_i"], *(i[f"i{n}_i"] for n in range(1, 5))]
            value = {
                "a": lambda: poly.coef_a(*arguments, nodes=nodes, form=FORMS[form]),
                "b": lambda: poly.coef_b(*arguments, nodes=nodes),
                "c": lambda: poly.coef_c(*arguments, nodes=nodes, form=FORMS[form]),
            }[name]()
            return {f"{name}_o": value}

        return golden

    def golden_all(nodes: int):
        def golden(i: Arrays) -> Arrays:
            values = poly.coef(i["degree_i"], *(i[f"i{n}_i"] for n in range(1, 5)), nodes=nodes, form=FORMS[form])
            return {f"{name}_o": value for name, value in zip("abcd", values, strict=True)}

        return golden

    for nodes, width in itertools.product((k.NODES_LEFT, k.NODES_RIGHT), (k.INTENSITY_W, 5)):
        ranges = {"degree_i": (0, 3), **{f"i{n}_i": signed_range(width) for n in range(1, 5)}}
        random = mixed(ranges, ONE, -ONE) if width == k.INTENSITY_W else None
        all_of = None if random else every(ranges)
        point = {"WIDTH": width, "NODES": nodes}
        units = [("shade_coef", "abcd", golden_all(nodes), {"FORM": FORMS[form]})]
        units += [(f"shade_coef_{n}", n, golden_part(n, nodes), {"FORM": FORMS[form]}) for n in "ac"]
        if form == "refined":  # B and D have one form
            units.append(("shade_coef_b", "b", golden_part("b", nodes), {}))
        for module, names, golden, more in units:
            values = {n: _coefficient(n, nodes, form) for n in names}
            ideals = {n: _coefficient(n, nodes, "refined") for n in names}
            exact = lambda i, v=values: {f"{n}_o": f(i) for n, f in v.items()}  # noqa: E731
            ideal = lambda i, v=ideals: {f"{n}_o": f(i) for n, f in v.items()}  # noqa: E731
            yield Case(
                module, form, point | more, golden, exact, exact if form == "refined" else ideal, random, all_of,
                k.LATENCY_COEF,
            )  # fmt: skip
    if form == "refined":
        for width in (k.INTENSITY_W, 12):
            same = {"i1_i": signed_range(width)}
            yield Case(
                "shade_coef_d", form, {"WIDTH": width}, lambda i: {"d_o": poly.coef_d(i["i1_i"])},
                lambda i: {"d_o": i["i1_i"].astype(Real)}, lambda i: {"d_o": i["i1_i"].astype(Real)},
                mixed(same) if width == k.INTENSITY_W else None, None if width == k.INTENSITY_W else every(same),
                k.LATENCY_COEF,
            )  # fmt: skip


def _horner(form: str) -> Iterator[Case]:
    if form != "refined":
        return
    points = [(k.COEF_W, k.INTENSITY_W, k.T_F), (4, 4, 4)]
    for coef_w, d_w, t_f in points:
        ranges = {f"{n}_i": signed_range(coef_w) for n in "abc"} | {"d_i": signed_range(d_w), "t_i": (0, 1 << t_f)}
        full = coef_w == k.COEF_W

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
            )  # fmt: skip


def _fdiff(form: str) -> Iterator[Case]:
    if form != "refined":
        return

    def golden(i: Arrays) -> Arrays:
        return {"y_o": poly.fdiff(*(i[f"{n}_i"] for n in "abcd"), i["log2_i"], pixel_index(i["first_i"]))}

    def exact(i: Arrays) -> Arrays:
        t = np.ldexp(pixel_index(i["first_i"]).astype(Real), -i["log2_i"])
        return {"y_o": ((i["a_i"] * t + i["b_i"]) * t + i["c_i"]) * t + i["d_i"]}

    def random(rng: np.random.Generator, rows: int) -> Arrays:
        log2 = rng.integers(0, k.LOG2_MAX, rows // 2 + 1, endpoint=True)
        log2[0] = k.LOG2_MAX  # the longest segment, whole
        count = (1 << log2) + 1
        count = count[np.cumsum(count) <= rows]
        count = np.r_[count, np.ones(rows - count.sum(), int)]
        log2 = np.resize(log2, len(count))
        ranges = {f"{n}_i": signed_range(k.COEF_W) for n in "abc"} | {"d_i": signed_range(k.INTENSITY_W)}
        return spread(mixed(ranges)(rng, len(count)) | {"log2_i": log2}, count)

    def all_of() -> Iterator[Arrays]:
        ranges = {f"{n}_i": signed_range(4) for n in "abcd"} | {"log2_i": (0, 3)}
        for part in every(ranges)():
            yield spread(part, (1 << part["log2_i"]) + 1)

    yield Case("shade_fdiff", form, {}, golden, exact, exact, random, None, k.LATENCY_FDIFF)
    yield Case(
        "shade_fdiff", form, {"COEF_W": 4, "D_W": 4, "LOG2_MAX": 3}, golden, exact, exact, None, all_of, k.LATENCY_FDIFF
    )


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


def _steps(form: str) -> Iterator[Case]:
    """The building blocks: round, saturate, multiply, delay."""
    if form != "refined":
        return
    for width, drop in ((20, 7), (26, 9), (2, 1)):
        ranges = {"x_i": signed_range(width)}
        yield Case(
            "shade_round", form, {"WIDTH": width, "DROP": drop}, lambda i, d=drop: {"y_o": fixed.round(i["x_i"], d)},
            lambda i, d=drop: {"y_o": np.ldexp(i["x_i"].astype(Real), -d)},
            lambda i, d=drop: {"y_o": np.ldexp(i["x_i"].astype(Real), -d)},
            mixed(ranges) if width > 20 else None, every(ranges) if width <= 20 else None, 0,
        )  # fmt: skip
    for width, out_w in ((20, 12), (k.VALUE_W, k.PIXEL_W)):
        ranges = {"x_i": signed_range(width)}
        clamp = lambda i, o=out_w: {"y_o": fixed.saturate(i["x_i"], o)}  # noqa: E731
        yield Case(
            "shade_saturate", form, {"WIDTH": width, "OUT_W": out_w}, clamp, clamp, clamp,
            mixed(ranges, 1 << out_w) if width > 20 else None, every(ranges) if width <= 20 else None, 0,
        )  # fmt: skip
    clamp = lambda i: dict(zip(("y_o", "clamped_o"), fixed.clamp(i["x_i"]), strict=True))  # noqa: E731
    yield Case("shade_clamp", form, {}, clamp, clamp, clamp, None, every({"x_i": signed_range(k.INTENSITY_W)}), 0)
    for width in (k.INTENSITY_W, 9):
        square = lambda i: {"y_o": fixed.square(i["x_i"])}  # noqa: E731
        yield Case(
            "shade_square", form, {"WIDTH": width}, square, square, square, None, every({"x_i": signed_range(width)}),
            k.LATENCY_MUL, unit_f=0,
        )  # fmt: skip
    for a_w, b_w, stages in ((30, 18, 2), (18, 18, 2), (35, 18, 0), (10, 10, 2), (20, 2, 2)):
        ranges = {"a_i": signed_range(a_w), "b_i": signed_range(b_w)}
        product = lambda i: {"p_o": fixed.mul(i["a_i"], i["b_i"])}  # noqa: E731
        small = a_w + b_w <= 22
        yield Case(
            "shade_mul", form, {"A_W": a_w, "B_W": b_w, "STAGES": stages}, product, product, product,
            None if small else mixed(ranges), every(ranges) if small else None, stages, unit_f=0,
        )  # fmt: skip


def _waits(form: str) -> Iterator[Case]:
    """What takes part in the data's way without changing it, and Horner's single step."""
    if form != "refined":
        return
    for parameters, width in (({"WIDTH": 20, "DEPTH": 0}, 20), ({"WIDTH": 12, "DEPTH": 3}, 12)):
        same = lambda i: {"q_o": i["d_i"]}  # noqa: E731
        yield Case(
            "shade_delay", form, parameters, same, same, same, None, every({"d_i": (0, (1 << width) - 1)}),
            parameters["DEPTH"], unit_f=0,
        )  # fmt: skip
    same = lambda i: {"data_o": i["data_i"]}  # noqa: E731
    yield Case(
        "shade_fifo", form, {}, same, same, same, mixed({"data_i": (0, (1 << 32) - 1)}), None, k.LATENCY_FIFO, unit_f=0
    )

    width, t_f = k.VALUE_W + k.HORNER_GUARD, k.T_F
    half = signed_range(width - 1)  # s and c, so that the sum fits

    def exact(i: Arrays) -> Arrays:
        return {"y_o": i["s_i"] * (i["t_i"].astype(Real) / (1 << t_f)) + late(i["c_i"], k.LATENCY_MUL)}

    yield Case(
        "shade_horner_step", form, {},
        lambda i: {"y_o": poly.horner_step(i["s_i"], i["t_i"], late(i["c_i"], k.LATENCY_MUL))}, exact, exact,
        mixed({"s_i": half, "t_i": (0, 1 << t_f), "c_i": half}), None, k.LATENCY_HORNER_STEP,
        unit_f=k.INTENSITY_F + k.HORNER_GUARD,
    )  # fmt: skip


def check_poly_span(
    form: str, evaluator: int, spans: int, seed: int = 1, in_gap: float = 0.0, out_stall: float = 0.0
) -> Result:
    """Whole spans through ``shade_poly_span``: random nodes, degrees, lengths up to 4096, faulty ones among them.

    Errors are measured against the exact polynomial through the quantized nodes, clamped. ``latency`` is that of the
    first pixel, ``throughput`` in pixels a clock. Intensities reach over [-1, 1], so that clamping is exercised.
    """
    rng = np.random.default_rng([seed, evaluator])
    nodes = rng.integers(-ONE, ONE, (spans, k.CHANNELS, k.NODE_COUNT), endpoint=True)
    nodes[::3] = rng.integers(0, ONE, nodes[::3].shape, endpoint=True)
    degree = rng.integers(0, 3, spans, endpoint=True)
    count = np.where(degree == k.DEGREE_DIRECT, rng.integers(1, 4, spans, endpoint=True), rng.geometric(0.08, spans))
    count[rng.integers(0, spans, spans // 64)] = 0
    count[rng.integers(0, spans, 2)] = rng.integers(k.PIXELS_MAX + 1, 1 << k.COUNT_W, 2)
    degree[1], count[1] = k.DEGREE_CUBIC, k.PIXELS_MAX
    degree[0], count[0] = k.DEGREE_LINEAR, 3  # its first pixel measures the latency
    tag = rng.integers(0, 1 << k.TAG_W, spans)

    model = sim.load("shade_poly_span", EVALUATOR=evaluator, FORM=FORMS[form])
    run = model.run(
        s_axis_span_tdata=poly.pack_spans(nodes, degree, count, tag), in_gap=in_gap, out_stall=out_stall, seed=seed
    )
    pixels, owner = poly.poly_span(nodes, degree, count, evaluator=evaluator, form=FORMS[form])
    bad = poly.span_errors(degree, count)
    result = _stream_result(
        run, "pixel", pixels[:, 0] | pixels[:, 1] << k.PIXEL_W, tag, owner, bad, np.count_nonzero(bad),
        k.LATENCY_POLY_SPAN_HORNER if evaluator == k.EVALUATOR_HORNER else k.LATENCY_POLY_SPAN_FDIFF, bool(out_stall),
    )  # fmt: skip

    span, j = poly.span_walk(degree, count)
    for formula, name in ((form, "max_error_ulp"), ("refined", "max_error_ideal")):
        error = np.abs(pixels - _exact_pixels(formula, nodes, degree, count, span, j))
        at = np.unravel_index(np.argmax(error), error.shape)
        if name == "max_error_ulp":
            result.max_error_ulp = float(error[at])
            result.worst_input = {"span": int(span[at[0]]), "pixel": int(j[at[0]]), "channel": int(at[1])}
        else:
            result.max_error_ideal = float(error[at]) / ONE
    return result


def _stream_result(
    run: sim.Run, word: str, data, tag, owner, errors, dropped: int, declared: int, stalled: bool
) -> Result:
    """Compare the words of a stream ``m_axis_<word>``, its tags, its ends, the status and the first one's latency."""
    unit = f"m_axis_{word}"
    last = np.r_[owner[1:] != owner[:-1], True].astype(np.int64)
    expected = {f"{unit}_tdata": data, f"{unit}_tuser": tag[owner], f"{unit}_tlast": last}
    result = Result(vectors=len(data), latency=int(run.given[0] - run.taken[0]), throughput=len(data) / run.clocks)
    status = {"error_o": int(np.bitwise_or.reduce(errors)), "error_count_o": int(dropped)}
    unequal = [name for name, value in expected.items() if not np.array_equal(value, run.outputs[name])]
    if len(run.given) != len(data):
        result.mismatches = abs(len(run.given) - len(data))
        result.first_mismatch = f"{unit}: {len(run.given)} words, expected {len(data)}"
    elif unequal:
        wrong = np.any([expected[name] != run.outputs[name] for name in unequal], axis=0)
        at = int(np.argmax(wrong))
        result.mismatches = int(np.count_nonzero(wrong))
        result.first_mismatch = f"{unit}: word {at}, of item {owner[at]}: " + ", ".join(
            f"{name} expected {_hex(expected[name][at])} actual {_hex(run.outputs[name][at])}" for name in unequal
        )
    elif run.status != status:
        result.mismatches, result.first_mismatch = 1, f"{unit}: status {run.status}, expected {status}"
    elif not stalled and result.latency != declared:
        result.mismatches, result.first_mismatch = 1, f"{unit}: latency {result.latency}, declared {declared}"
    return result


def check_pixel_normals(
    lines: int, seed: int = 1, in_gap: float = 0.0, out_stall: float = 0.0, variants: Sequence[int] = range(8)
) -> Result:
    """Whole lines of normals through ``shade_pixel_normals``: random ends, lengths, variants, thresholds, some faulty.

    ``max_error_ulp`` and ``max_error_ideal`` of the pixels that are normalized exactly, against the unit vector of the
    interpolated normal; ``latency`` of the first normal, ``throughput`` in normals a clock.
    """
    rng = np.random.default_rng([seed, 7])
    count = rng.geometric(0.1, lines)
    count[rng.integers(1, lines, lines // 64)] = 0
    count[rng.integers(2, lines, 2)] = rng.integers(k.PIXELS_MAX + 1, 1 << k.COUNT_W, 2)
    count[1] = k.PIXELS_MAX
    count[0] = 3  # its first normal measures the latency
    first, other = (unit_vectors(rng, lines).T / ONE for _ in range(2))
    bend = np.ldexp(1.0, -rng.integers(0, 10, (lines, 1)))
    last = first + (other - first) * bend
    last /= np.linalg.norm(last, axis=1, keepdims=True)
    scale = 1 << k.STEP_F
    normals = np.rint(first * scale).astype(np.int64)
    steps = np.rint((last - first) / np.maximum(count - 1, 1)[:, None] * scale).astype(np.int64)
    cosine = np.rint(np.sum(first * last, axis=1) * ONE).astype(np.int64)
    variant = rng.choice(variants, lines)
    threshold = np.where(rng.random(lines) < 0.9, k.METRIC_THRESHOLD, rng.integers(-ONE // 8, ONE + ONE // 8, lines))
    tag = rng.integers(0, 1 << k.TAG_W, lines)

    model = sim.load("shade_pixel_normals")
    run = model.run(
        s_axis_line_tdata=normal.pack_lines(normals, steps, count, cosine, tag), variant_i=variant,
        threshold_i=threshold, in_gap=in_gap, out_stall=out_stall, seed=seed,
    )  # fmt: skip
    golden, owner = normal.pixel_normals(normals, steps, count, cosine, variant, threshold)
    mask = (1 << k.INTENSITY_W) - 1
    data = sum((golden[:, i] & mask) << k.INTENSITY_W * i for i in range(3))
    errors = normal.line_errors(count, variant, threshold)
    dropped = np.count_nonzero((count == 0) | (count > k.PIXELS_MAX))
    result = _stream_result(run, "normal", data, tag, owner, errors, dropped, k.LATENCY_PIXEL_NORMALS, bool(out_stall))

    j = np.arange(len(owner)) - np.searchsorted(owner, owner)
    exact = (j % 2 == 0) | (j == count[owner] - 1) | (variant[owner] == k.VARIANT_EXACT)
    ideal = (normals[owner] + j[:, None] * steps[owner])[exact].astype(Real)
    quantized = np.floor(ideal / (1 << k.STEP_F - k.INTENSITY_F) + Real(0.5))

    def error(vector: np.ndarray) -> np.ndarray:
        return np.abs(golden[exact] - vector * ONE / np.sqrt((vector**2).sum(axis=1, keepdims=True)))

    distance = error(quantized)
    at = np.unravel_index(np.argmax(distance), distance.shape)
    result.max_error_ulp, result.max_error_ideal = float(distance[at]), float(error(ideal).max()) / ONE
    result.worst_input = {"line": int(owner[exact][at[0]]), "pixel": int(j[exact][at[0]])}
    return result


def _exact_pixels(form: str, nodes, degree, count, span, j) -> np.ndarray:
    """(P, 2) the exact polynomial through the nodes at every pixel, clamped to what a pixel holds, in ulp."""
    inputs = {"degree_i": degree[:, None]} | {f"i{n + 1}_i": nodes[..., n] for n in range(k.NODE_COUNT)}
    a, b, c, d = (_coefficient(name, k.NODES_LEFT, form)(inputs)[span] for name in "abcd")
    t = np.ldexp(j.astype(Real), -poly.span_log2(count)[span])[:, None]
    direct = np.flatnonzero(degree[span] == k.DEGREE_DIRECT)
    value = ((a * t + b) * t + c) * t + d
    value[direct] = nodes[span[direct], :, j[direct]]
    return value.clip(0, (1 << k.PIXEL_W) - 1)


def _roots(form: str) -> Iterator[Case]:
    """Reciprocal square root and exact normalizer: arguments of every length, down to one unit."""
    if form != "refined":
        return

    def lengths(make: Callable[[np.random.Generator, int], Arrays], bits: int):
        """Vectors of which each is shortened by a random number of bits."""

        def shorter(rng: np.random.Generator, rows: int) -> Arrays:
            shift = rng.integers(0, bits, rows)
            return {name: value >> shift for name, value in make(rng, rows).items()}

        return shorter

    def rsqrt(i: Arrays) -> Arrays:
        y, e = fixed.rsqrt(i["z_i"])
        return {"y_o": y, "e_o": e, "zero_o": (i["z_i"] == 0).astype(np.int64)}

    def root(i: Arrays) -> Arrays:
        golden = rsqrt(i)
        z = np.maximum(i["z_i"], 1).astype(Real)
        exact = np.ldexp(1 / np.sqrt(z), golden["e_o"] + k.RSQRT_F)
        return golden | {"y_o": np.where(i["z_i"] == 0, 0, exact)}

    argument = {"z_i": (0, (1 << k.RSQRT_W) - 1)}
    yield Case(
        "shade_rsqrt", form, {}, rsqrt, root, root, lengths(mixed(argument), k.RSQRT_W), None, k.LATENCY_RSQRT,
        unit_f=k.RSQRT_F,
    )  # fmt: skip

    def unit(i: Arrays) -> Arrays:
        components = normal.normalize(i["x_i"], i["y_i"], i["z_i"])
        zero = (i["x_i"] | i["y_i"] | i["z_i"]) == 0
        return dict(zip(("x_o", "y_o", "z_o"), components, strict=True)) | {"zero_o": zero.astype(np.int64)}

    def exact(i: Arrays) -> Arrays:
        vector = [i[f"{c}_i"].astype(Real) for c in "xyz"]
        length = np.sqrt(sum(c * c for c in vector))
        return unit(i) | {
            f"{c}_o": v * ONE / np.where(length == 0, 1, length) for c, v in zip("xyz", vector, strict=True)
        }

    vector = {f"{c}_i": signed_range(k.INTENSITY_W) for c in "xyz"}
    yield Case(
        "shade_normalize", form, {}, unit, exact, exact, lengths(mixed(vector, ONE, -ONE), k.INTENSITY_W), None,
        k.LATENCY_NORMALIZE,
    )  # fmt: skip


# constants of the normals' formulas in fractions of 2^16 (golden.contract), by the form and degree of the unit
INVC = {
    ("refined", 2): (k.INVC_0, k.INVC_C, k.INVC_UU, k.INVC_UUUU),
    ("paper", 2): (k.INVC2_0, k.INVC2_C, k.INVC2_CC, 0),
    ("paper", 1): (k.INVC1_0, k.INVC1_C, 0, 0),
}
DEGREES = {"refined": (2,), "paper": (2, 1)}


def _weigh(form: str) -> Iterator[Case]:
    if form != "refined":
        return
    for width, f, out_w, out_f, weights in (
        (20, k.SQUARE_F, 26, k.SQUARE_F, (k.INVC2_0, k.INVC2_C, k.INVC2_CC, 1)),
        (6, 4, 20, 16, (k.D1_0, k.ETA2_C, k.ETA2_CC, -1)),
        (6, 4, 6, 2, (-65536, 65535, 0, -21845)),
    ):
        k0, *by_input = weights

        def golden(i: Arrays, f=f, out_f=out_f, k0=k0, by_input=by_input) -> Arrays:
            terms = itertools.chain(*zip(by_input, (i["x_i"], i["y_i"], i["z_i"]), strict=True))
            return {"w_o": fixed.weigh(k0, *terms, f=f, out_f=out_f)}

        def exact(i: Arrays, f=f, out_f=out_f, k0=k0, by_input=by_input) -> Arrays:
            value = sum(w * i[f"{n}_i"].astype(Real) for w, n in zip(by_input, "xyz", strict=True)) / (1 << f) + k0
            return {"w_o": value * (1 << out_f) / (1 << k.CONSTANT_F)}

        ranges = {f"{n}_i": signed_range(width) for n in "xyz"}
        parameters = {"WIDTH": width, "F": f, "OUT_W": out_w, "OUT_F": out_f}
        yield Case(
            "shade_weigh", form, parameters | dict(zip(("K0", "KX", "KY", "KZ"), weights, strict=True)), golden, exact,
            exact, mixed(ranges) if width > 6 else None, None if width > 6 else every(ranges), k.LATENCY_WEIGH,
            unit_f=out_f,
        )  # fmt: skip


def unit_vectors(rng: np.random.Generator, rows: int) -> np.ndarray:
    """(3, rows) unit vectors in all directions, S1.16."""
    free = rng.standard_normal((3, rows))
    return np.rint(free / np.linalg.norm(free, axis=0) * ONE).astype(np.int64)


def arcs(rng: np.random.Generator, rows: int) -> Arrays:
    """Pairs of vectors ax_i .. bz_i and c_i, S1.16.

    An eighth each: components from the corners, vectors of a few ulp, equal unit vectors, opposite ones, axes; the rest
    are unit vectors with angles of any size. c is the rounded cosine, in a quarter of the rows any number.
    """
    kind = rng.integers(0, 8, rows)
    axes = np.eye(3, dtype=np.int64)[:, rng.integers(0, 3, (2, rows))] * rng.choice([ONE, -ONE], (2, rows))
    corner = rng.choice(corners(*signed_range(k.INTENSITY_W), ONE, -ONE), (3, 2, rows))
    short = rng.integers(-4, 4, (3, 2, rows), endpoint=True)
    a = unit_vectors(rng, rows)
    bent = a + rng.standard_normal((3, rows)) * np.ldexp(float(ONE), -rng.integers(0, 12, rows))
    b = np.rint(bent / np.linalg.norm(bent, axis=0) * ONE).astype(np.int64)
    first = [kind == n for n in range(5)]
    a = np.select(first, [corner[:, 0], short[:, 0], a, a, axes[:, 0]], a)
    b = np.select(first, [corner[:, 1], short[:, 1], a, -a, axes[:, 1]], b)
    low, high = signed_range(k.INTENSITY_W)
    any_c = mixed({"c_i": (low, high)}, ONE, ONE + 1, ONE - 1)(rng, rows)["c_i"]
    c = np.where(rng.random(rows) < 0.25, any_c, normal.dot3(*a, *b).clip(low, high))
    return dict(zip(("ax_i", "ay_i", "az_i", "bx_i", "by_i", "bz_i", "c_i"), (*a, *b, c), strict=True))


def _ends(i: Arrays) -> list[np.ndarray]:
    return [i[f"{v}{c}_i"] for v in "ab" for c in "xyz"]


def _vectors(form: str) -> Iterator[Case]:
    """Dot product, vector times number, and the scaled sum."""
    if form != "refined":
        return

    def without_c(rng: np.random.Generator, rows: int) -> Arrays:
        return {name: value for name, value in arcs(rng, rows).items() if name != "c_i"}

    def dot(i: Arrays) -> Arrays:
        v = [x.astype(Real) for x in _ends(i)]
        return {"d_o": sum(a * b for a, b in zip(v[:3], v[3:], strict=True)) / ONE}

    yield Case(
        "shade_dot3", form, {}, lambda i: {"d_o": normal.dot3(*_ends(i))}, dot, dot, without_c, None, k.LATENCY_DOT3
    )

    def named(vector) -> Arrays:
        return dict(zip(("x_o", "y_o", "z_o"), vector, strict=True))

    def scaled(i: Arrays) -> Arrays:
        return named(i[f"{c}_i"] * (i["s_i"].astype(Real) / (1 << k.INVC_F)) for c in "xyz")

    factor = (0, (1 << k.INVC_F) - 1)
    vectors = mixed({f"{c}_i": signed_range(k.INTENSITY_W) for c in "xyz"} | {"s_i": factor}, ONE, -ONE)
    for fold, latency in ((1, k.LATENCY_SCALE3), (3, k.LATENCY_SCALE3_FOLDED)):
        yield Case(
            "shade_scale3", form, {"FOLD": fold}, lambda i: named(normal.scale3(*(i[f"{n}_i"] for n in "xyzs"))),
            scaled, scaled, vectors, None, latency, fold,
        )  # fmt: skip

    for wait in (1, 4):

        def golden(i: Arrays, wait: int = wait) -> Arrays:
            return named(normal.bisect(*_ends(i), late(i["invc_i"], wait)))

        def exact(i: Arrays, wait: int = wait) -> Arrays:
            return named(_bisected(*_ends(i), late(i["invc_i"], wait).astype(Real) / (1 << k.INVC_F)))

        yield Case(
            "shade_bisect", form, {"WAIT": wait}, golden, exact, exact,
            lambda rng, rows: without_c(rng, rows) | mixed({"invc_i": factor}, ONE)(rng, rows), None,
            wait + k.LATENCY_SCALE3,
        )  # fmt: skip


def _bisected(ax, ay, az, bx, by, bz, s) -> list[np.ndarray]:
    """(a + b) s, where a + b is limited to what S1.16 holds."""
    low, high = signed_range(k.INTENSITY_W)
    return [(a + b).clip(low, high) * s for a, b in ((ax, bx), (ay, by), (az, bz))]


def _invc(form: str, degree: int, c: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """InvC and cos(psi/2) of a unit as numbers, from c as a number in [0, 1], exactly by its formula."""
    c = np.asarray(c, Real)
    square = (1 - c if form == "refined" else c) ** 2
    k0, k1, k2, k4 = INVC[form, degree]
    value = (k0 + k1 * c + k2 * square + k4 * square**2) / ONE
    if form == "refined":
        return value, (k.D2_NEAR_0 + k.D2_NEAR_C * c + k.HALF_UU * square + k.HALF_UUUU * square**2) / ONE
    far = c * ONE <= k.D2_LIMIT
    return value, np.where(far, k.D2_FAR_0 + k.D2_FAR_C * c, k.D2_NEAR_0 + k.D2_NEAR_C * c) / ONE


def _true_invc(c: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """1/sqrt(2 (1 + c)) and sqrt((1 + c)/2)."""
    half = np.sqrt((1 + np.asarray(c, Real)) / 2)
    return 1 / (2 * half), half


def _cosine(c: np.ndarray) -> np.ndarray:
    """c in S1.16 as a number, clamped to [0, 1]."""
    return c.clip(0, ONE).astype(Real) / ONE


def _cosines(form: str) -> Iterator[Case]:
    """The functions of one cosine, each over every cosine that 18 bits hold."""
    everything = every({"c_i": signed_range(k.INTENSITY_W)})
    for degree in DEGREES[form]:

        def golden(i: Arrays, degree: int = degree) -> Arrays:
            values = normal.invc(i["c_i"], FORMS[form], degree)
            return dict(zip(("invc_o", "half_o", "clamped_o"), values, strict=True))

        def value(i: Arrays, function: Callable, golden=golden) -> Arrays:
            invc, half = function(_cosine(i["c_i"]))
            return golden(i) | {"invc_o": invc * (1 << k.INVC_F), "half_o": half * ONE}

        yield Case(
            "shade_invc", form, {"FORM": FORMS[form], "DEGREE": degree}, golden,
            lambda i, value=value, d=degree: value(i, lambda c: _invc(form, d, c)),
            lambda i, value=value: value(i, _true_invc), None, everything, k.LATENCY_INVC, more_f={"invc_o": k.INVC_F},
        )  # fmt: skip

    def with_powers() -> Iterator[Arrays]:
        """Every c; u^2 and u^4 come a clock later."""
        c = np.append(np.arange(ONE + 1), ONE)
        cut, square = 2 * k.INTENSITY_F - k.SQUARE_F, (ONE - c) ** 2
        powers = {"uu_i": square >> cut, "uuuu_i": (square >> k.INTENSITY_F) ** 2 >> cut}
        yield {"c_i": c} | {name: np.r_[0, power[:-1]] for name, power in powers.items()}

    yield Case(
        "shade_half", form, {"FORM": FORMS[form]}, lambda i: {"half_o": normal.half(i["c_i"], FORMS[form])},
        lambda i: {"half_o": _invc(form, 2, _cosine(i["c_i"]))[1] * ONE},
        lambda i: {"half_o": _true_invc(_cosine(i["c_i"]))[1] * ONE}, None, with_powers, k.LATENCY_HALF,
    )  # fmt: skip


def _nodes(form: str) -> Iterator[Case]:
    """Midpoint and node chain; ideal: the same sums, scaled by the true functions of c."""
    for degree in DEGREES[form]:
        point = {"FORM": FORMS[form], "DEGREE": degree}
        outputs = ("x_o", "y_o", "z_o", "half_o", "clamped_o")

        def middle(i: Arrays, point=point, outputs=outputs) -> Arrays:
            values = normal.midpoint(*_ends(i), i["c_i"], point["FORM"], point["DEGREE"])
            return dict(zip(outputs, values, strict=True))

        def exact_middle(i: Arrays, function: Callable, outputs=outputs, middle=middle) -> Arrays:
            s, h = function(_cosine(i["c_i"]))
            return middle(i) | dict(zip(outputs, (*_bisected(*_ends(i), s), h * ONE), strict=False))

        def chain(i: Arrays, point=point) -> Arrays:
            values = normal.node_chain(*_ends(i), i["c_i"], point["FORM"], point["DEGREE"])
            return dict(zip(NODE_PORTS, values, strict=True))

        def exact_chain(i: Arrays, function: Callable, chain=chain) -> Arrays:
            a, b = _ends(i)[:3], _ends(i)[3:]
            s, h = function(_cosine(i["c_i"]))
            m, s = _bisected(*a, *b, s), function(h)[0]
            return chain(i) | dict(
                zip(NODE_PORTS, (*a, *_bisected(*a, *m, s), *m, *_bisected(*m, *b, s), *b), strict=False)
            )

        units = (
            ("shade_midpoint", middle, exact_middle, k.LATENCY_MIDPOINT),
            ("shade_node_chain", chain, exact_chain, k.LATENCY_NODE_CHAIN),
        )
        for module, golden, exact, latency in units:
            yield Case(
                module, form, point, golden,
                lambda i, exact=exact, d=degree: exact(i, lambda c: _invc(form, d, c)),
                lambda i, exact=exact: exact(i, _true_invc), arcs, None, latency,
            )  # fmt: skip


NODE_PORTS = (*(f"n{n}{c}_o" for n in range(5) for c in "xyz"), "clamped_o")


def _decisions(form: str) -> Iterator[Case]:
    """What tells whether to normalize: P4's metrics, P2's criterion."""
    rng = np.random.default_rng(1)
    low, high = signed_range(k.INTENSITY_W)

    def thresholds(rows: int, default: int, width: int) -> np.ndarray:
        """Half of them the default, the rest of all kinds."""
        other = mixed({"t": signed_range(width)}, 1 << width - 2, (1 << width - 2) + 1)(rng, rows)["t"]
        return np.where(rng.random(rows) < 0.5, default, other)

    if form == "paper":
        ports = ["d1a_o", "d2_o", "needs_d1_o", "needs_d2_o", "clamped_o", "m_error_o", "threshold_error_o"]

        def golden(i: Arrays) -> Arrays:
            return dict(zip(ports, normal.metric(i["c_i"], i["m_i"], i["threshold_i"]), strict=True))

        def exact(i: Arrays) -> Arrays:
            c, m = _cosine(i["c_i"]), i["m_i"].clip(k.METRIC_M_MIN, k.METRIC_M_MAX)
            return golden(i) | {"d1a_o": k.D1_0 + k.D1_C * c + k.D1_M * m, "d2_o": _invc(form, 2, c)[1] * ONE}

        def ideal(i: Arrays) -> Arrays:
            c, m = _cosine(i["c_i"]), i["m_i"].clip(k.METRIC_M_MIN, k.METRIC_M_MAX)
            return golden(i) | {"d1a_o": np.cos(np.arccos(c) / m) * ONE, "d2_o": _true_invc(c)[1] * ONE}

        def all_of() -> Iterator[Arrays]:
            for m in (*range(16), (1 << k.COUNT_W) - 1):
                c = np.arange(low, high + 1)
                threshold = thresholds(len(c), k.METRIC_THRESHOLD, k.INTENSITY_W)
                yield {"c_i": c, "m_i": np.full(len(c), m), "threshold_i": threshold}

        yield Case("shade_metric", form, {}, golden, exact, ideal, None, all_of, k.LATENCY_METRIC)

    def exact_eta(i: Arrays, degree: int) -> np.ndarray:
        c = [_cosine(i[f"{edge}_i"]) for edge in ("ab", "bc", "ca")]
        if form == "refined":
            return sum(k.ETA_U * (1 - x) + k.ETA_UU * (1 - x) ** 2 + k.ETA_UUUU * (1 - x) ** 4 for x in c)
        k0, k1, k2 = (k.ETA2_0, k.ETA2_C, k.ETA2_CC) if degree == 2 else (k.ETA1_0, k.ETA1_C, 0)
        return sum(k0 + k1 * x + k2 * x * x for x in c)

    def every_cosine() -> Iterator[Arrays]:
        """Every c at one edge, the others flat, and at all three."""
        c = np.arange(low, high + 1)
        flat = np.full(len(c), ONE)
        for ab, bc, ca in ((c, flat, flat), (flat, c, flat), (flat, flat, c), (c, c, c)):
            threshold = thresholds(len(c), 26214, k.ETA_W)
            yield {"ab_i": ab, "bc_i": bc, "ca_i": ca, "threshold_i": threshold}

    def random(rng: np.random.Generator, rows: int) -> Arrays:
        """Triangles of every flatness, down to one ulp of a cosine."""
        rest = np.ldexp(rng.random((3, rows)), rng.integers(0, 18, rows))
        dense = {f"{edge}_i": (ONE - u).astype(np.int64) for edge, u in zip(("ab", "bc", "ca"), rest, strict=True)}
        free = mixed(dict.fromkeys(dense, (low, high)) | {"threshold_i": signed_range(k.ETA_W)}, ONE)(rng, rows)
        chosen = rng.random(rows) < 0.75
        return free | {name: np.where(chosen, value, free[name]) for name, value in dense.items()}

    for degree in DEGREES[form]:

        def eta(i: Arrays, degree: int = degree) -> Arrays:
            edges = (i[f"{edge}_i"] for edge in ("ab", "bc", "ca"))
            values = plan.criterion(*edges, i["threshold_i"], FORMS[form], degree)
            return dict(zip(("eta_o", "normalize_o", "clamped_o", "threshold_error_o"), values, strict=True))

        def exact(i: Arrays, eta=eta, degree: int = degree) -> Arrays:
            return eta(i) | {"eta_o": exact_eta(i, degree) * (1 << k.ETA_F - k.CONSTANT_F)}

        def ideal(i: Arrays, eta=eta) -> Arrays:
            true = sum(1 - _true_invc(_cosine(i[f"{edge}_i"]))[1] for edge in ("ab", "bc", "ca"))
            return eta(i) | {"eta_o": true * (1 << k.ETA_F)}

        for vectors, all_of in ((None, every_cosine), (random, None)):
            yield Case(
                "shade_criterion", form, {"FORM": FORMS[form], "DEGREE": degree}, eta, exact, ideal, vectors, all_of,
                k.LATENCY_CRITERION, unit_f=k.ETA_F,
            )  # fmt: skip


def _increment(form: str) -> Iterator[Case]:
    """Triangles of normals: starts, pixels, lines. The exact value keeps every bit of the sums."""
    if form != "refined":
        return
    names = [f"{c}{kind}_i" for kind in "ngl" for c in "xyz"]

    def vectors(rng: np.random.Generator, rows: int) -> Arrays:
        unit = 1 << k.STEP_F
        values = mixed(dict.fromkeys(names[:3], (-unit, unit)) | dict.fromkeys(names[3:], (-unit >> 10, unit >> 10)))
        first = (rng.random(rows) < 0.01).astype(np.int64)
        first[0] = 1
        return values(rng, rows) | {"first_i": first, "line_i": (rng.random(rows) < 0.1).astype(np.int64)}

    def golden(i: Arrays) -> Arrays:
        return {
            f"{c}_o": normal.increment(i["first_i"], i["line_i"], *(i[f"{c}{kind}_i"] for kind in "ngl")) for c in "xyz"
        }

    def exact(i: Arrays) -> Arrays:
        ulp = 1 << k.STEP_F - k.INTENSITY_F
        sums = (normal.increment_sum(i["first_i"], i["line_i"], *(i[f"{c}{kind}_i"] for kind in "ngl")) for c in "xyz")
        return {f"{c}_o": value.astype(Real) / ulp for c, value in zip("xyz", sums, strict=True)}

    yield Case("shade_increment", form, {}, golden, exact, exact, vectors, None, k.LATENCY_INCREMENT)


def cases() -> list[Case]:
    """All cases of all units, both forms, in the order of the data's way."""
    parts = (
        _steps, _weigh, _waits, _third, _coef, _horner, _fdiff, _roots, _vectors, _cosines, _nodes, _decisions,
        _increment,
    )  # fmt: skip
    return [case for part in parts for form in FORMS for case in part(form)]
