# SPDX-License-Identifier: Apache-2.0
"""The shading core on whole frames: spans and settings in, pixels out, everything compared with the golden model.

What the Verilated ``shade_core`` gives, value, tag and end mark of every pixel, counters and status, is compared with
``golden.core``, bit for bit.
"""

from __future__ import annotations

import time
from bisect import bisect_right
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import core as golden
from polyshade.golden import registers
from polyshade.golden.normal import pack_spans
from polyshade.golden.reference.light import dot, unit
from polyshade.sim.scene.raster import Spans, portions

Ints = NDArray[np.int64]
TAGS = 1 << k.TAG_W
OFFSETS = {register.name: register.offset for register in registers.every()}
WHOLE = {"s_axis_span_tkeep": (1 << k.SPAN_DATA_W // 8) - 1, "s_axis_span_tlast": 1}  # beside a packet's data
COUNTERS = [register.name for register in registers.GROUPS["Counters"]]


@dataclass(frozen=True)
class Lines:
    """Spans as the core takes them: normal and increment (S, 3) S2.29, pixels, cosine of the ends S1.16, tag (S,).

    ``flat`` (S,): the span's triangle passed P2's criterion.
    """

    n: Ints
    g: Ints
    count: Ints
    cosine: Ints
    tag: Ints
    flat: Ints

    @classmethod
    def of(cls, spans: Spans, flat: ArrayLike = False) -> Lines:
        """Quantized, to nearest; ``flat`` is told of every triangle, or of all at once.

        A span of one pixel needs no increment; slivers have some that no format could hold.
        Of others none exceeds 2: with both ends a component of a normal is within [-1, 1].
        """
        gradient = np.where(spans.count[:, None] > 1, spans.gradient, 0)
        n, g = (np.rint(part * (1 << k.STEP_F)).astype(np.int64) for part in (spans.normal, gradient))
        last = spans.normal + (spans.count[:, None] - 1) * gradient
        cosine = quantize(dot(unit(spans.normal), unit(last)))
        flat = np.asarray(flat, np.int64)
        flat = flat[spans.triangle] if flat.ndim else np.full(len(spans), flat)
        return cls(n, g, spans.count.astype(np.int64), cosine, np.arange(len(spans)) % TAGS, flat)

    def __getitem__(self, part: slice) -> Lines:
        """Some of them."""
        return Lines(**{name: values[part] for name, values in vars(self).items()})

    @property
    def beats(self) -> NDArray[np.uint32]:
        """(S, 8): ``s_axis_span_tdata``."""
        return pack_spans(self.n, self.g, self.count, self.cosine, self.tag, self.flat)


def quantize(value: ArrayLike) -> Ints:
    """Intensity, cosine or component of a vector to S1.16, to nearest, saturating."""
    limit = 1 << k.INTENSITY_W - 1
    return np.clip(np.rint(np.multiply(value, 1 << k.INTENSITY_F)), -limit, limit - 1).astype(np.int64)


@dataclass(frozen=True)
class Compared:
    """What the core made of spans. ``pixels`` (P, 2) U0.16: in the order of the spans, 0 where none came."""

    pixels: NDArray[np.uint16]
    evaluations: int  # of light
    records: int
    clocks: int  # from the first span to the last pixel
    seconds: float  # of simulation
    counters: dict[str, int]
    status: list[str]  # names of the bits that are set
    mismatches: int  # pixels
    first_mismatch: dict = field(default_factory=dict)
    counter_mismatches: dict[str, str] = field(default_factory=dict)  # by name: "expected 1 actual 2"

    def __add__(self, later: Compared) -> Compared:
        """Of both together, one after the other."""
        return Compared(
            np.concatenate([self.pixels, later.pixels]), self.evaluations + later.evaluations,
            self.records + later.records, self.clocks + later.clocks, self.seconds + later.seconds,
            {name: count + later.counters[name] for name, count in self.counters.items()},
            [*self.status, *(name for name in later.status if name not in self.status)],
            self.mismatches + later.mismatches, self.first_mismatch or later.first_mismatch,
            self.counter_mismatches | later.counter_mismatches,
        )  # fmt: skip


def draw(
    lines: Lines, words: Mapping[str, int], stage: Callable[[str], None] = lambda name: None,
    options: Mapping[str, object] | None = None, **parameters: int,
) -> Compared:  # fmt: skip
    """Draw spans by ``shade_core`` at a parameter point, settings by the names of ``golden.registers``; compare.

    ``options``: of :meth:`sim.Model.run`.

    Of more pixels than a `portions` the core starts anew for every portion, so that their number needs no memory.
    """
    model = sim.load("shade_core", **parameters)
    stage("simulate")
    made = None
    for part, pixel in portions(lines.count) or [(slice(0, 0), 0)]:
        more = _draw(model, lines[part], words, parameters, options or {})
        if first := more.first_mismatch:
            first["pixel"] += pixel
            first["span"] += part.start * (first["span"] >= 0)
        made = made + more if made else more
    stage("compare")
    return made


def _draw(
    model: sim.Model, lines: Lines, words: Mapping[str, int], parameters: Mapping[str, int], options: Mapping
) -> Compared:
    beats, writes = lines.beats, registers.pack(words)
    began = time.perf_counter()
    reads = [OFFSETS[name] for name in ("STATUS", *COUNTERS)]
    run = model.run(s_axis_span_tdata=beats, **WHOLE, writes=writes, reads=reads, **options)
    seconds = time.perf_counter() - began
    built = {name.lower(): value for name, value in parameters.items() if name not in ("LANES", "FOLD")}
    wanted = golden.lane(lines.n, lines.g, lines.count, words, flat=lines.flat, cosine=lines.cosine, **built)
    pixels, mismatches, first = compare(run.outputs, lines, beats, wanted, parameters.get("LANES", 1))
    if first.get("input", "none") != "none":
        first["again"] = model.again(s_axis_span_tdata=beats[first["span"]], **WHOLE, writes=writes)
    counters = {name.lower(): run.registers[OFFSETS[name]] for name in COUNTERS}
    bits = registers.unpack(OFFSETS["STATUS"], run.registers[OFFSETS["STATUS"]])
    clocks = int(run.given[-1] - run.taken[0] + 1) if len(run.given) else 0
    return Compared(
        pixels, len(wanted.flags), wanted.records, clocks, seconds, counters,
        [name for name, bit in bits.items() if bit], mismatches, first, compare_counters(counters, bits, wanted),
    )  # fmt: skip


def compare(
    outputs: Mapping[str, Ints], lines: Lines, beats: NDArray[np.uint32], wanted: golden.Drawn, lanes: int = 1
) -> tuple[Ints, int, dict]:
    """The pixels (P, 2) that came, the number of those that differ, and the first of these.

    It is told by ``pixel``, ``span`` and ``input``, ``expected`` and ``actual`` as {tlast, tuser, tdata}.
    """
    owner = wanted.span
    ends = np.append(np.diff(owner), 1)[: len(owner)] != 0
    expected = join(ends.astype(np.int64), lines.tag[owner], wanted.pixels[:, 0] | wanted.pixels[:, 1] << k.PIXEL_W)
    count = len(expected)
    actual, extra = np.full(count, -1), []
    for came in streams(outputs, lanes):
        at = np.arange(len(came)) if lanes == 1 else positions(came, owner, lines.tag)
        own = at < count
        actual[at[own]] = came[own]
        extra += came[~own].tolist()
    wrong = np.flatnonzero(actual != expected)
    mismatches, first = len(wrong) + len(extra), {}
    if mismatches:
        at = int(wrong[0]) if len(wrong) else count
        span = int(owner[at]) if at < count else -1
        came = actual[at] if at < count else extra[0]
        first = {
            "pixel": at,
            "span": span,
            "input": f"0x{beats[span, ::-1].astype('>u4').tobytes().hex()}" if span >= 0 else "none",
            "expected": f"{expected[at]:#x}" if at < count else "none",
            "actual": f"{came:#x}" if came >= 0 else "none",
        }
    data, mask = actual.clip(0), (1 << k.PIXEL_W) - 1
    return np.stack([data & mask, data >> k.PIXEL_W & mask], axis=-1).astype(np.uint16), mismatches, first


def positions(came: Ints, owner: Ints, tags: Ints) -> Ints:
    """Where the pixels of a lane stand among all: its spans come in order, their tags tell which."""
    last, tag = came >> k.TAG_W + k.PIXEL_DATA_W & 1, came >> k.PIXEL_DATA_W & (1 << k.TAG_W) - 1
    begins = np.r_[1, last[:-1]][: len(came)]
    first = np.flatnonzero(begins)
    at: dict[int, list[int]] = {}
    for index, value in enumerate(tags.tolist()):
        at.setdefault(value, []).append(index)
    spans, span = [], -1
    for value in tag[first].tolist():  # the next one of that tag
        same = at.get(value, [])
        place = bisect_right(same, span)
        span = same[place] if place < len(same) else len(tags)
        spans.append(span)
    segment = np.cumsum(begins) - 1
    span = np.array(spans, np.int64)[segment]
    where = np.searchsorted(owner, span) + np.arange(len(came)) - first[segment]
    return np.where(where < np.searchsorted(owner, span, "right"), where, len(owner))


def streams(outputs: Mapping[str, Ints], lanes: int) -> list[Ints]:
    """What every lane gave, as {tlast, tuser, tdata}."""
    last, tag, data = (outputs[f"m_axis_pixel_{name}"] for name in ("tlast", "tuser", "tdata"))
    if lanes == 1:
        return [join(last, tag, data)]
    valid, words = outputs["m_axis_pixel_tvalid"], data.view(np.uint32).reshape(-1, lanes).astype(np.int64)
    mask = (1 << k.TAG_W) - 1
    beats = (join(last >> i & 1, tag >> k.TAG_W * i & mask, words[:, i]) for i in range(lanes))
    return [beat[valid >> i & 1 == 1] for i, beat in enumerate(beats)]


def join(last: Ints, tag: Ints, data: Ints) -> Ints:
    """{tlast, tuser, tdata} of ``m_axis_pixel``."""
    return (last << k.TAG_W | tag) << k.PIXEL_DATA_W | data


def compare_counters(counters: Mapping[str, int], bits: Mapping[str, int], wanted: golden.Drawn) -> dict[str, str]:
    """What differs from the golden model among counters and bits of STATUS."""
    known, told = golden.counted(wanted)
    expected = {**known, **told, "errors": 0}
    actual = {**counters, **bits}
    return {
        name: f"expected {value} actual {actual[name]}" for name, value in expected.items() if value != actual[name]
    }
