# SPDX-License-Identifier: Apache-2.0
"""The core on whole frames: what goes in by hand-computed numbers; injected faults are found, whatever they are."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from polyshade.golden import contract as k
from polyshade.golden import core as golden
from polyshade.golden.material import Material, planner_registers, registers
from polyshade.golden.registers import faults
from polyshade.sim import core
from polyshade.sim.scene.raster import Spans, portions

ONE = 1 << k.INTENSITY_F


@pytest.mark.parametrize(
    ("intensity", "expected"),
    [
        (0.0, 0), (1.0, 65536), (-1.0, -65536), (0.5, 32768), (1 / 3, 21845), (2 / 3, 43691),
        (1.5 / 65536, 2), (2.5 / 65536, 2), (-1.5 / 65536, -2), (0.49 / 65536, 0),  # to nearest
        (1.9999999, 131071), (2.0, 131071), (1e300, 131071), (-2.0, -131072), (-2.1, -131072), (float("-inf"), -131072),
    ],
)  # fmt: skip
def test_quantize(intensity: float, expected: int) -> None:
    assert core.quantize(intensity) == expected


def spans(count: list[int], normal: list, gradient: list) -> Spans:
    """Spans below each other."""
    line, zero = np.arange(len(count), dtype=np.int32), np.zeros(len(count))
    slope = np.array(gradient)
    return Spans(line, line, line * 0, np.array(count, np.int32), np.array(normal), slope, slope * 0, zero, zero)


def test_lines() -> None:
    """Normal and increment to nearest; that of a single pixel does not count, were it beyond any format."""
    lines = core.Lines.of(spans([2, 1], [[0, 0, 1], [0.5, 0, 0]], [[1, 1.6 / (1 << 29), -1], [1e9, -1e9, 0.25]]))
    assert lines.n.tolist() == [[0, 0, 1 << 29], [1 << 28, 0, 0]]
    assert lines.g.tolist() == [[1 << 29, 2, -1 << 29], [0, 0, 0]]
    assert lines.cosine.tolist() == [0, ONE]
    assert lines.tag.tolist() == [0, 1]
    assert lines.flat.tolist() == [0, 0]
    assert lines.beats[0].tolist() == [0, 0, 1 << 29, 1 << 29, 2, 7 << 29, 2, 0]
    assert lines.beats[1].tolist() == [1 << 28, 0, 0, 0, 0, 0, 1 | 1 << 16, ONE]


def test_flat_lines() -> None:
    """The criterion's answer belongs to a triangle, the bit to each of its spans."""
    three = spans([2, 1, 5], [[0, 0, 1]] * 3, [[0, 0, 0]] * 3)
    three.triangle[:] = 1, 1, 0
    lines = core.Lines.of(three, [False, True])
    assert lines.flat.tolist() == [1, 1, 0]
    assert (lines.beats[:, -1] >> k.SPAN_FLAT % 32 & 1).tolist() == [1, 1, 0]


@pytest.fixture
def drawn() -> SimpleNamespace:
    """Three spans of 3, 1 and 4 pixels: what goes in, what must come out, and what comes out."""
    turning = spans([3, 1, 4], [[0.0, 0, 1], [0.6, 0, 0.8], [0, 0.6, 0.8]], [[0.01, 0, 0]] * 3)
    lines, surface = core.Lines.of(turning), Material()
    lines.tag[:] = 7, 65535, 0
    words = registers(surface, (0.3, 0.6, 0.8)) | planner_registers(surface)
    wanted = golden.lane(lines.n, lines.g, lines.count, words)
    outputs = {
        "m_axis_pixel_tdata": wanted.pixels[:, 0] | wanted.pixels[:, 1] << k.PIXEL_W,
        "m_axis_pixel_tuser": lines.tag[wanted.span],
        "m_axis_pixel_tlast": np.array([0, 0, 1, 1, 0, 0, 0, 1]),
    }
    return SimpleNamespace(lines=lines, words=words, wanted=wanted, outputs=outputs)


def compare(drawn: SimpleNamespace, outputs: dict[str, np.ndarray]) -> tuple[np.ndarray, int, dict]:
    return core.compare(outputs, drawn.lines, drawn.lines.beats, drawn.wanted)


@pytest.mark.parametrize("lanes", [1, pytest.param(2, marks=pytest.mark.full), 4])
def test_the_core_itself(drawn: SimpleNamespace, lanes: int) -> None:
    """It gives what the fixture says, and nothing is found in it."""
    point = {"LANES": lanes, "EVALUATOR": k.EVALUATOR_FDIFF, "FORM": k.FORM_REFINED}
    made = core.draw(drawn.lines, drawn.words, **point)
    assert np.array_equal(made.pixels, drawn.wanted.pixels)
    assert (made.mismatches, made.first_mismatch, made.counter_mismatches) == (0, {}, {})
    counted = {name: made.counters[name] for name in ("pixels", "spans", "evaluations", "errors")}
    assert counted == {"pixels": 8, "spans": 3, "evaluations": len(drawn.wanted.flags), "errors": 0}
    assert made.clocks >= made.counters["clocks"] > 8 / lanes


def test_portions(drawn: SimpleNamespace, monkeypatch: pytest.MonkeyPatch) -> None:
    """A frame in portions of at most 4 pixels: sums as of a whole; a wrong pixel is found where the frame has it."""
    point = {"LANES": 1, "EVALUATOR": k.EVALUATOR_FDIFF, "FORM": k.FORM_REFINED}
    whole = core.draw(drawn.lines, drawn.words, **point)
    monkeypatch.setattr(core, "portions", lambda count: portions(count, 4))
    assert [part for part, _ in core.portions(drawn.lines.count)] == [slice(0, 2), slice(2, 3)]
    parts = core.draw(drawn.lines, drawn.words, **point)
    assert np.array_equal(parts.pixels, whole.pixels)
    for name in ("evaluations", "records", "status", "mismatches", "first_mismatch", "counter_mismatches"):
        assert getattr(parts, name) == getattr(whole, name), name
    assert {**parts.counters, "clocks": 0} == {**whole.counters, "clocks": 0}
    assert 0 < parts.clocks - whole.clocks < 2 * whole.clocks

    true = golden.lane

    def wrong(*arguments, **options) -> golden.Drawn:
        made = true(*arguments, **options)
        made.pixels[-1, 0] ^= len(made.pixels) == len(drawn.wanted.pixels[4:]) and made.span[-1] == 0
        return made

    monkeypatch.setattr(golden, "lane", wrong)
    parts = core.draw(drawn.lines, drawn.words, **point)
    assert parts.mismatches == 1
    assert (parts.first_mismatch["pixel"], parts.first_mismatch["span"]) == (7, 2)


@pytest.mark.parametrize("at", range(8))
@pytest.mark.parametrize(
    ("name", "flip", "shift"),
    [
        *(("m_axis_pixel_tdata", bit, 0) for bit in (1, 1 << 15, 1 << 16, 1 << 31)),
        ("m_axis_pixel_tuser", 1, 32),
        ("m_axis_pixel_tuser", 1 << 15, 32),
        ("m_axis_pixel_tlast", 1, 48),
    ],
)
def test_one_wrong_bit(drawn: SimpleNamespace, at: int, name: str, flip: int, shift: int) -> None:
    """In any pixel, in value, tag or end of span: one mismatch, with its place, input and both outputs."""
    drawn.outputs[name][at] ^= flip
    pixels, mismatches, first = compare(drawn, drawn.outputs)
    assert mismatches == 1
    span = [0, 0, 0, 1, 2, 2, 2, 2][at]
    assert (first["pixel"], first["span"]) == (at, span)
    assert int(first["expected"], 16) ^ int(first["actual"], 16) == flip << shift
    assert int(first["input"], 16) == sum(int(word) << 32 * i for i, word in enumerate(drawn.lines.beats[span]))
    changed = flip if shift == 0 else 0
    assert (
        pixels[at].tolist() == (drawn.wanted.pixels[at] ^ [changed & 0xFFFF, changed >> 16]).tolist()
    )  # as it is shown


@pytest.mark.parametrize(("at", "mismatches"), [(7, 1), (0, 8), (3, 5)])
def test_a_missing_pixel(drawn: SimpleNamespace, at: int, mismatches: int) -> None:
    """All behind it are at the wrong place."""
    pixels, found, first = compare(drawn, {name: np.delete(value, at) for name, value in drawn.outputs.items()})
    assert (found, first["pixel"]) == (mismatches, at)
    assert (first["actual"] == "none") == (at == 7)
    assert pixels.shape == (8, 2)
    assert pixels[7].tolist() == [0, 0]


@pytest.mark.parametrize("extra", [1, 5])
def test_extra_pixels(drawn: SimpleNamespace, extra: int) -> None:
    outputs = {name: np.append(value, value[:extra]) for name, value in drawn.outputs.items()}
    pixels, mismatches, first = compare(drawn, outputs)
    assert mismatches == extra
    assert (first["pixel"], first["span"], first["input"], first["expected"]) == (8, -1, "none", "none")
    assert int(first["actual"], 16) & 0xFFFFFFFF == drawn.outputs["m_axis_pixel_tdata"][0]
    assert np.array_equal(pixels, drawn.wanted.pixels)


def test_no_pixels_at_all(drawn: SimpleNamespace) -> None:
    outputs = {name: value[:0] for name, value in drawn.outputs.items()}
    assert compare(drawn, outputs)[1] == 8
    nothing = drawn.wanted._replace(pixels=drawn.wanted.pixels[:0], span=drawn.wanted.span[:0])
    drawn.wanted = nothing
    assert compare(drawn, outputs)[1:] == (0, {})
    assert compare(drawn, drawn.outputs)[1] == 8


def test_wrong_counters(drawn: SimpleNamespace) -> None:
    """A counter or a bit of STATUS that is not the golden model's is told by name; clocks and stalls are free."""
    flagged = drawn.wanted._replace(flags=drawn.wanted.flags | 1 << k.LIGHT_ZERO)
    counters = {"pixels": 8, "spans": 3, "clocks": 1, "stalls": 1, "evaluations": len(flagged.flags), "errors": 0}
    bits = dict.fromkeys((f.name for f in faults() if f.path.startswith("node.")), 0) | {"light_zero": 1}
    assert core.compare_counters(counters, bits, flagged) == {}
    counters |= {"spans": 4, "errors": 1}
    bits |= {"light_zero": 0, "normal_short": 1}
    assert core.compare_counters(counters, bits, flagged) == {
        "spans": "expected 3 actual 4",
        "errors": "expected 0 actual 1",
        "light_zero": "expected 1 actual 0",
        "normal_short": "expected 0 actual 1",
    }
