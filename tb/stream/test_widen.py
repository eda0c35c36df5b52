# SPDX-License-Identifier: Apache-2.0
"""shade_widen: words to beats, packets of any length, gaps and stalls; spans on a narrow bus into the core."""

from __future__ import annotations

import numpy as np
import pytest
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden.stream import widen
from polyshade.sim import core
from polyshade.sim.core import OFFSETS
from polyshade.sim.scene.raster import Spans

from tb.runner import SEED

WIDTHS = [(8, 16), (32, 256), (64, 256), (64, 128)]


@pytest.mark.parametrize(("in_w", "out_w"), WIDTHS)
@pytest.mark.parametrize(("gap", "stall"), [(0.0, 0.0), (0.5, 0.0), (0.0, 0.7), (0.3, 0.3)])
def test_beats(in_w: int, out_w: int, gap: float, stall: float) -> None:
    """Every beat, its tkeep and tlast; a clock behind its last word, and as many clocks as words and one more."""
    rng = np.random.default_rng(SEED)
    words = out_w // in_w
    word = rng.integers(0, 1 << min(in_w, 62), 3000)
    last = (rng.uniform(size=3000) < 1 / (2 * words)).astype(int)
    last[-1] = 1
    beats, came, ends = widen(word, last, words)
    model = sim.load("shade_widen", IN_W=in_w, OUT_W=out_w)
    run = model.run(s_axis_word_tdata=word, s_axis_word_tlast=last, in_gap=gap, out_stall=stall, seed=SEED)
    assert np.array_equal(run.m_axis_beat_tlast, ends)
    keep = [sum(int(c) * ((1 << in_w // 8) - 1) << i * in_w // 8 for i, c in enumerate(row)) for row in came]
    assert run.m_axis_beat_tkeep.tolist() == keep
    data = run.m_axis_beat_tdata
    wide = [sum(int(v) << 32 * i for i, v in enumerate(np.atleast_1d(row))) for row in data]
    assert wide == [sum(int(v) << in_w * i for i, v in enumerate(row)) for row in beats]
    if not gap and not stall:
        assert set((run.given - run.taken[np.cumsum(came.sum(axis=1)) - 1]).tolist()) == {1}
        assert run.taken[-1] - run.taken[0] + 1 == len(word) + len(beats) - 1


def burst() -> core.Lines:
    """Spans of a few lengths."""
    count = np.array([5, 1, 9, 2, 17], np.int32)
    line, zero = np.arange(5, dtype=np.int32), np.zeros(5)
    normal = np.array([[0.1 * i, -0.05 * i, 1.0] for i in range(5)])
    slope = np.full((5, 3), 0.003)
    return core.Lines.of(Spans(line, line, line * 0, count, normal, slope, slope * 0, zero, zero))


def test_burst_of_one_tlast() -> None:
    """BURST = 1: five spans with tlast on the last alone are five spans; BURST = 0 tells them as one broken packet."""
    lines = burst()
    whole = {"s_axis_span_tdata": lines.beats, "s_axis_span_tkeep": (1 << k.SPAN_DATA_W // 8) - 1}
    small = {"REFLECT": 0, "DIVIDE": 0, "PATH_NORMALS": 0}
    each = sim.load("shade_core", **small).run(**whole, s_axis_span_tlast=1)
    once = sim.load("shade_core", BURST=1, **small).run(**whole, s_axis_span_tlast=np.array([0, 0, 0, 0, 1]))
    for name, values in each.outputs.items():
        assert np.array_equal(once.outputs[name], values), name
    assert len(each.given) == lines.count.sum()
    assert (once.status["idle_o"], once.status["irq_o"]) == (1, 1)
    torn = sim.load("shade_core", **small).run(
        **whole, s_axis_span_tlast=np.array([0, 0, 0, 0, 1]), reads=[OFFSETS["ERRORS"]], patience=1000
    )
    assert torn.registers[OFFSETS["ERRORS"]] == 1 and not len(torn.given)
    assert torn.status["irq_o"] == 1


@pytest.mark.parametrize("in_w", [32, 64])
def test_spans_by_a_narrow_bus(in_w: int) -> None:
    """The beats of spans, word by word, come out as the spans."""
    beats = burst().beats
    words = beats.reshape(-1) if in_w == 32 else beats.astype(np.int64)[:, 0::2].reshape(-1) | (
        beats.astype(np.int64)[:, 1::2].reshape(-1) << 32
    )  # fmt: skip
    count = len(words) // len(beats)
    run = sim.load("shade_widen", IN_W=in_w).run(
        s_axis_word_tdata=words.astype(np.uint64), s_axis_word_tlast=np.tile([0] * (count - 1) + [1], len(beats))
    )
    assert np.array_equal(run.m_axis_beat_tdata, beats)
    assert set(run.m_axis_beat_tlast.tolist()) == {1}
