# SPDX-License-Identifier: Apache-2.0
"""Whole streams: the buffer, spans to pixels, lines to normals."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import normal, poly
from polyshade.sim.units.case import FORMS, ONE, Case, Real, Result, hexadecimal, in_forms, mixed
from polyshade.sim.units.normal import unit_vectors
from polyshade.sim.units.poly import coefficient


def check_poly_span(
    form: str, evaluator: int, spans: int, seed: int = 1, in_gap: float = 0.0, out_stall: float = 0.0
) -> Result:
    """Whole spans through ``shade_poly_span``: random nodes, degrees, lengths up to 4096.

    Errors are measured against the exact polynomial through the quantized nodes, clamped. ``latency`` is that of the
    first pixel, ``throughput`` in pixels a clock. Intensities reach over [-1, 1], so that clamping is exercised.
    """
    rng = np.random.default_rng([seed, evaluator])
    nodes = rng.integers(-ONE, ONE, (spans, k.CHANNELS, k.NODE_COUNT), endpoint=True)
    nodes[::3] = rng.integers(0, ONE, nodes[::3].shape, endpoint=True)
    degree = rng.integers(0, 3, spans, endpoint=True)
    count = np.where(degree == k.DEGREE_DIRECT, rng.integers(1, 4, spans, endpoint=True), rng.geometric(0.08, spans))
    degree[1], count[1] = k.DEGREE_CUBIC, k.PIXELS_MAX
    degree[0], count[0] = k.DEGREE_LINEAR, 3  # its first pixel measures the latency
    tag, more = rng.integers(0, 1 << k.TAG_W, spans), rng.integers(0, 2, spans)

    beats = poly.pack_records(nodes, degree, count, tag, more)
    model = sim.load("shade_poly_span", EVALUATOR=evaluator, FORM=FORMS[form])
    run = model.run(s_axis_span_tdata=beats, in_gap=in_gap, out_stall=out_stall, seed=seed)
    pixels, owner = poly.poly_span(nodes, degree, count, evaluator=evaluator, form=FORMS[form])
    result = _stream_result(
        run, "pixel", pixels[:, 0] | pixels[:, 1] << k.PIXEL_W, tag, owner,
        k.LATENCY_POLY_SPAN_HORNER if evaluator == k.EVALUATOR_HORNER else k.LATENCY_POLY_SPAN_FDIFF, bool(out_stall),
        more,
    )  # fmt: skip

    span, j = poly.span_walk(count)
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
    a, b, c, d = (coefficient(name, k.NODES_LEFT, form)(inputs)[span] for name in "abcd")
    t = np.ldexp(j.astype(Real), -poly.span_log2(count)[span])[:, None]
    direct = np.flatnonzero(degree[span] == k.DEGREE_DIRECT)
    value = ((a * t + b) * t + c) * t + d
    value[direct] = nodes[span[direct], :, j[direct]]
    return value.clip(0, (1 << k.PIXEL_W) - 1)


def check_pixel_normals(
    lines: int, seed: int = 1, in_gap: float = 0.0, out_stall: float = 0.0, variants: Sequence[int] = range(8)
) -> Result:
    """Whole lines of normals through ``shade_pixel_normals``: random ends, lengths, variants, thresholds.

    ``max_error_ulp`` and ``max_error_ideal`` of the pixels that are normalized exactly, against the unit vector of the
    interpolated normal; ``latency`` of the first normal, ``throughput`` in normals a clock.
    """
    rng = np.random.default_rng([seed, 7])
    count = rng.geometric(0.1, lines)
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
        s_axis_line_tdata=normal.pack_spans(normals, steps, count, cosine, tag), variant_i=variant,
        threshold_i=threshold, in_gap=in_gap, out_stall=out_stall, seed=seed,
    )  # fmt: skip
    golden, owner = normal.pixel_normals(normals, steps, count, cosine, variant, threshold)
    mask = (1 << k.INTENSITY_W) - 1
    data = sum((golden[:, i] & mask) << k.INTENSITY_W * i for i in range(3))
    result = _stream_result(run, "normal", data, tag, owner, k.LATENCY_PIXEL_NORMALS, bool(out_stall))

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


def _stream_result(run: sim.Run, word: str, data, tag, owner, declared: int, stalled: bool, more=None) -> Result:
    """Compare the words of a stream ``m_axis_<word>``, its tags, its ends and the first one's latency.

    ``more``: 1 for the items whose last word is no end.
    """
    unit = f"m_axis_{word}"
    last = np.r_[owner[1:] != owner[:-1], True].astype(np.int64)
    if more is not None:
        last &= 1 - more[owner]
    expected = {f"{unit}_tdata": data, f"{unit}_tuser": tag[owner], f"{unit}_tlast": last}
    result = Result(vectors=len(data), latency=int(run.given[0] - run.taken[0]), throughput=len(data) / run.clocks)
    unequal = [name for name, value in expected.items() if not np.array_equal(value, run.outputs[name])]
    if len(run.given) != len(data):
        result.mismatches = abs(len(run.given) - len(data))
        result.first_mismatch = f"{unit}: {len(run.given)} words, expected {len(data)}"
    elif unequal:
        wrong = np.any([expected[name] != run.outputs[name] for name in unequal], axis=0)
        at = int(np.argmax(wrong))
        result.mismatches = int(np.count_nonzero(wrong))
        result.first_mismatch = f"{unit}: word {at}, of item {owner[at]}: " + ", ".join(
            f"{name} expected {hexadecimal(expected[name][at])} actual {hexadecimal(run.outputs[name][at])}"
            for name in unequal
        )
    elif not stalled and result.latency != declared:
        result.mismatches, result.first_mismatch = 1, f"{unit}: latency {result.latency}, declared {declared}"
    return result


def _fifo(form: str) -> Iterator[Case]:
    if form != "refined":
        return
    same = lambda i: {"data_o": i["data_i"]}  # noqa: E731
    yield Case(
        "shade_fifo",
        form,
        {},
        same,
        same,
        same,
        mixed({"data_i": (0, (1 << 32) - 1)}),
        None,
        k.LATENCY_FIFO,
        bound=0,
        unit_f=0,
        ordered=True,  # a consumer that stalls: tb/stream/test_fifo.py
    )


def cases() -> Iterator[Case]:
    """All cases of ``rtl/stream``."""
    return in_forms(_fifo)
