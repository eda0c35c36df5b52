"""Every arithmetic unit with its golden twin, the exact value of its formula, and vectors: for tests and report.

A :class:`Case` is a module at a parameter point with a stream of vectors: all of them at reduced widths, directed
corners and random ones at full width. :meth:`Case.check` runs it through the RTL and measures

    mismatches        RTL against golden model, in every bit, and in every latency
    max_error_ulp     golden model against the exact value of the unit's formula, in units of its last bit
    max_error_ideal   against the function that the formula approximates, as a number (1.0: full intensity)
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np

import sim
from golden import contract as k
from golden import fixed, normal, poly

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
    the outputs.
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
            self._compare(inputs, run, result, seed)
            self._measure(inputs, result)
            total.add(result)
            tick(rows)
        return total

    def _compare(self, inputs: Arrays, run: sim.Run, result: Result, seed: int) -> None:
        expected = self.golden(inputs)
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
            given = ", ".join(f"{name}={_hex(value[at])}" for name, value in inputs.items())
            parameters = "".join(f", {name}={value}" for name, value in self.parameters.items())
            result.first_mismatch = (
                f"{self}: vector {at}: {given}: {values}, latency {int(run.given[at] - run.taken[at])} of "
                f'{self.latency}; again with a waveform: python -c \'import sim; print(sim.load("{self.module}", '
                f"waves=True{parameters}).run({given}, latency={self.latency}).outputs)'"
            )

    def _measure(self, inputs: Arrays, result: Result) -> None:
        golden, exact, ideal = self.golden(inputs), self.exact(inputs), self.ideal(inputs)
        for name, value in golden.items():
            error = np.abs(value - exact[name])
            at = int(np.argmax(error))
            if float(error[at]) > result.max_error_ulp or not result.worst_input:
                result.max_error_ulp = float(error[at])
                result.worst_input = {port: int(array[at]) for port, array in inputs.items()}
            distance = float(np.abs(value - ideal[name]).max()) / (1 << self.unit_f)
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
            yield Case(
                module, form, point | more, golden,
                lambda i, v=values: {f"{n}_o": f(i) for n, f in v.items()},
                lambda i, v=ideals: {f"{n}_o": f(i) for n, f in v.items()},
                random, all_of, k.LATENCY_COEF,
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

    def late(c: np.ndarray) -> np.ndarray:
        """c_i is taken LATENCY_MUL clocks after s_i; the last one stays."""
        return np.r_[c[k.LATENCY_MUL :], np.repeat(c[-1:], k.LATENCY_MUL)][: len(c)]

    def exact(i: Arrays) -> Arrays:
        return {"y_o": i["s_i"] * (i["t_i"].astype(Real) / (1 << t_f)) + late(i["c_i"])}

    yield Case(
        "shade_horner_step", form, {}, lambda i: {"y_o": poly.horner_step(i["s_i"], i["t_i"], late(i["c_i"]))},
        exact, exact, mixed({"s_i": half, "t_i": (0, 1 << t_f), "c_i": half}), None, k.LATENCY_HORNER_STEP,
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
    last = np.r_[owner[1:] != owner[:-1], True]
    expected = {
        "m_axis_pixel_tdata": pixels[:, 0] | pixels[:, 1] << k.PIXEL_W,
        "m_axis_pixel_tuser": tag[owner],
        "m_axis_pixel_tlast": last.astype(np.int64),
    }
    declared = k.LATENCY_POLY_SPAN_HORNER if evaluator == k.EVALUATOR_HORNER else k.LATENCY_POLY_SPAN_FDIFF
    result = Result(vectors=len(pixels), latency=int(run.given[0] - run.taken[0]), throughput=len(pixels) / run.clocks)
    bad = poly.span_errors(degree, count)
    status = {"error_o": int(np.bitwise_or.reduce(bad)), "error_count_o": int(np.count_nonzero(bad))}
    unequal = [name for name, value in expected.items() if not np.array_equal(value, run.outputs[name])]
    if len(run.given) != len(pixels):
        result.mismatches = abs(len(run.given) - len(pixels))
        result.first_mismatch = f"shade_poly_span: {len(run.given)} pixels, expected {len(pixels)}"
    elif unequal:
        wrong = np.any([expected[name] != run.outputs[name] for name in unequal], axis=0)
        at = int(np.argmax(wrong))
        result.mismatches = int(np.count_nonzero(wrong))
        result.first_mismatch = f"shade_poly_span: pixel {at} of span {owner[at]}: " + ", ".join(
            f"{name} expected {_hex(expected[name][at])} actual {_hex(run.outputs[name][at])}" for name in unequal
        )
    elif run.status != status:
        result.mismatches, result.first_mismatch = 1, f"shade_poly_span: status {run.status}, expected {status}"
    elif not out_stall and result.latency != declared:
        result.mismatches = 1
        result.first_mismatch = f"shade_poly_span: latency {result.latency}, declared {declared}"

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


def cases() -> list[Case]:
    """All cases of all units, both forms, in the order of the data's way."""
    parts = (_steps, _waits, _third, _coef, _horner, _fdiff, _roots)
    return [case for part in parts for form in FORMS for case in part(form)]
