# SPDX-License-Identifier: Apache-2.0
"""What a unit is measured by: its golden twin, the exact value of its formula, and vectors.

A :class:`Case` is a module at a parameter point with a stream of vectors: all of them at reduced widths, directed
corners and random ones at full width. :meth:`Case.check` runs it through the RTL and measures

    mismatches        RTL against golden model, in every bit, and in every latency
    max_error_ulp     golden model against the exact value of the unit's formula, in units of its last bit
    max_share         the same, in units of what is allowed for the vector, where that differs from vector to vector
    max_error_ideal   against the function that the formula approximates, as a number (1.0: full intensity)

Two engines run a case: this one, NumPy, with a vector on every clock, and cocotb (``tb.case_bench``), with gaps and
resets.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
from polyshade import sim
from polyshade.golden import contract as k

Arrays = dict[str, np.ndarray]
CHUNK = 1 << 20
Real = np.longdouble  # 64 bits of mantissa: every exact value here has an error below 2^-50 ulp
FORMS = {"refined": k.FORM_REFINED, "paper": k.FORM_PAPER}
ONE = 1 << k.INTENSITY_F


@dataclass
class Result:
    """What a case measured; see the module's docstring."""

    vectors: int = 0
    mismatches: int = 0
    first_mismatch: str = ""
    max_error_ulp: float = 0.0
    max_share: float = 0.0
    max_error_ideal: float = 0.0
    worst_input: dict[str, int] = field(default_factory=dict)
    latency: int = 0
    throughput: float = 0.0

    def add(self, other: Result) -> None:
        """Take another result of the same unit in."""
        if other.max_error_ulp > self.max_error_ulp or not self.vectors:
            self.max_error_ulp, self.worst_input = other.max_error_ulp, other.worst_input
        self.max_share = max(self.max_share, other.max_share)
        self.max_error_ideal = max(self.max_error_ideal, other.max_error_ideal)
        self.vectors += other.vectors
        self.mismatches += other.mismatches
        self.first_mismatch = self.first_mismatch or other.first_mismatch
        self.latency, self.throughput = other.latency, other.throughput


@dataclass(frozen=True)
class Case:
    """A module at a parameter point and what it must compute.

    ``golden``, ``exact``, ``ideal``: inputs -> outputs by port name, of structures by field (``n_i.x``);
    ``vectors(rng, rows)`` makes random inputs, ``all_vectors`` yields every input. ``latency``: declared; of every
    single vector. ``bound``: of the error against ``exact`` in ulp, in the paper's form at least 1/2; rounding to
    nearest: 1/2. ``tolerance``: beside the bound what the error of each vector may be, in ulp, by port. ``late``:
    inputs that are taken so many clocks after the others, whole vectors. ``ordered``: an output depends on the vectors
    before.
    ``own_bench``: cocotb does not run it, as the module's bench does more. ``unit_f``: fraction bits of the outputs,
    ``more_f``: of those ports that have others. ``chunk``: vectors a run, for inputs that are constant in it: settings,
    which change while nothing is in flight. ``note``: what sets apart cases of the same point.
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
    bound: float = 1 / 2
    tolerance: Callable[[Arrays], Arrays] | None = None
    late: Mapping[str, int] = field(default_factory=dict)
    ordered: bool = False
    own_bench: bool = False
    unit_f: int = k.INTENSITY_F
    more_f: dict[str, int] = field(default_factory=dict)
    chunk: int = CHUNK
    note: str = ""

    def __str__(self) -> str:
        point = ",".join(f"{name}={value}" for name, value in self.parameters.items())
        kind = f"/{self.note}" * bool(self.note) + "/all" * (not self.vectors)
        return f"{self.module}/{self.form}{f'[{point}]' if point else ''}{kind}"

    @property
    def limit(self) -> float:
        """What the error may be, in ulp."""
        return self.bound if self.form == "refined" else max(self.bound, 1 / 2)

    def stream(self, vectors: int, seed: int) -> Iterator[Arrays]:
        """The vectors of a run, chunk by chunk: all there are, or ``vectors`` of a seed."""
        if self.all_vectors:
            yield from self.all_vectors()
            return
        for chunk, first in enumerate(range(0, vectors, self.chunk)):
            yield self.vectors(np.random.default_rng([seed, chunk]), min(self.chunk, vectors - first))

    def check(
        self,
        vectors: int = CHUNK,
        seed: int = 1,
        tick: Callable[[int], object] = lambda rows: None,
        errors: bool = True,
    ) -> Result:
        """Run the vectors through RTL, golden model and exact formula. ``tick`` is told the rows that are done.

        ``errors=False``: without the exact formula, which takes longer than the RTL.
        """
        model = sim.load(self.module, public=(), **self.parameters)  # compiled once for both engines
        total = Result(latency=self.latency)
        for inputs in self.stream(vectors, seed):
            golden = self.golden(inputs)
            result = self.compare(model, inputs, golden, seed)
            if errors:
                self._measure(inputs, golden, result)
            total.add(result)
            tick(result.vectors)
        return total

    def compare(self, model: sim.Model, inputs: Arrays, golden: Arrays, seed: int, **run: object) -> Result:
        """Vectors through the RTL, every bit and latency against the golden outputs; ``run``: of ``Model.run``."""
        rows = len(next(iter(inputs.values())))
        fixed_latency = self.latency if model.interface.clock and not model.interface.out.valid else 0
        pace = self.clocks_per_vector if model.interface.phase else 1
        made = model.run(latency=fixed_latency, pace=pace, seed=seed, **run, **self._delayed(inputs))
        clocks = max(made.clocks - self.latency, 1)
        result = Result(vectors=rows, latency=self.latency, throughput=len(made.given) / clocks)
        self._compare(model, inputs, golden, made, result)
        return result

    def sample(self, rows: int, seed: int) -> Iterator[Arrays]:
        """About so many vectors for a slow engine, run by run; settings are others in each of eight runs.

        Of all vectors there are: some of the first, some of the last, random ones.
        """
        rng = np.random.default_rng(seed)
        if not self.all_vectors:
            runs = 1 if self.chunk == CHUNK else 8
            for _ in range(runs):
                yield self.vectors(rng, rows // runs)
            return
        for inputs in itertools.islice(self.all_vectors(), 8):
            total = len(next(iter(inputs.values())))
            index = np.r_[: min(8, total), rng.integers(0, total, rows // 4), max(total - 8, 0) : total]
            index = np.arange(min(rows, total)) if self.ordered else index
            yield {name: value[index] for name, value in inputs.items()}

    @property
    def _later(self) -> int:
        """By how many vectors the latest input is late."""
        return max(self.late.values(), default=0) // self.clocks_per_vector

    def _delayed(self, inputs: Arrays) -> Arrays:
        """Inputs as they are driven: those that are late behind the others; some vectors more, that nobody looks at."""
        if not self.late:
            return inputs
        most = self._later
        shifts = {name: self.late.get(name.partition(".")[0], 0) // self.clocks_per_vector for name in inputs}
        return {
            name: np.r_[np.repeat(value[:1], shifts[name]), value, np.repeat(value[-1:], most - shifts[name])]
            for name, value in inputs.items()
        }

    def _compare(self, model: sim.Model, inputs: Arrays, expected: Arrays, run: sim.Run, result: Result) -> None:
        wrong = np.zeros(result.vectors, bool)
        rows, most = result.vectors, self._later
        if len(run.given) != rows + most:
            result.mismatches = abs(len(run.given) - rows - most)
            result.first_mismatch = f"{self}: {len(run.given) - most} outputs, expected {rows}"
            return
        for name, value in expected.items():
            wrong |= run.outputs[name][:rows] != value
        tardy = (run.given - run.taken != self.latency)[:rows]
        result.mismatches = int(np.count_nonzero(wrong | tardy))
        if result.mismatches:
            at = int(np.argmax(wrong | tardy))
            values = ", ".join(
                f"{name} expected {hexadecimal(value[at])} actual {hexadecimal(run.outputs[name][at])}"
                for name, value in expected.items()
            )
            row = {name: value[at] for name, value in inputs.items()}
            given = ", ".join(f"{name}={hexadecimal(value)}" for name, value in row.items())
            clocks = int(run.given[at] - run.taken[at])
            result.first_mismatch = (
                f"{self}: vector {at}: {given}: {values}, latency {clocks} of {self.latency}; again with a waveform: "
                + model.again(**row, **({"latency": self.latency} if not model.interface.out.valid else {}))
            )

    def _measure(self, inputs: Arrays, golden: Arrays, result: Result) -> None:
        exact = self.exact(inputs)
        ideal = exact if self.ideal is self.exact else self.ideal(inputs)
        tolerance = self.tolerance(inputs) if self.tolerance else {}
        for name, value in golden.items():
            error = np.abs(value - exact[name])
            if name in tolerance:
                share = np.divide(
                    error, tolerance[name], out=np.where(error > 0, np.inf, 0.0), where=tolerance[name] > 0
                )
                result.max_share = max(result.max_share, float(share.max()))
            at = int(np.argmax(error))
            if float(error[at]) > result.max_error_ulp or not result.worst_input:
                result.max_error_ulp = float(error[at])
                result.worst_input = {port: int(array[at]) for port, array in inputs.items()}
            distance = float(np.abs(value - ideal[name]).max()) / (1 << self.more_f.get(name, self.unit_f))
            result.max_error_ideal = max(result.max_error_ideal, distance)


def hexadecimal(value: int) -> str:
    """A number as a message shows it."""
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


def shortened(make: Callable[[np.random.Generator, int], Arrays], bits: int) -> Callable:
    """Vectors of which each is shortened by a random number of bits."""

    def shorter(rng: np.random.Generator, rows: int) -> Arrays:
        shift = rng.integers(0, bits, rows)
        return {name: value >> shift for name, value in make(rng, rows).items()}

    return shorter


def thresholds(rng: np.random.Generator, rows: int, default: int, width: int) -> np.ndarray:
    """Half of them the default, the rest of all kinds."""
    other = mixed({"t": signed_range(width)}, 1 << width - 2, (1 << width - 2) + 1)(rng, rows)["t"]
    return np.where(rng.random(rows) < 0.5, default, other)


def in_forms(*parts: Callable[[str], Iterator[Case]], only: str = "") -> Iterator[Case]:
    """The cases of units that are given as functions of the form, each in both forms or in one."""
    for part in parts:
        for form in [only] if only else FORMS:
            yield from part(form)
