# SPDX-License-Identifier: Apache-2.0
"""shade_skipped: every kind is counted on its own, two kinds as one, up to 2^16 - 1."""

from __future__ import annotations

import numpy as np
from polyshade import sim
from polyshade.golden import raster as golden
from polyshade.golden.types import FATE, SKIPPED, whole

from tb.runner import SEED


def test_counts() -> None:
    """100,000 clocks with any kinds at once: what is rare is counted, what is not stays at the limit."""
    rng = np.random.default_rng(SEED)
    names = [leaf.name for leaf in FATE.leaves()]
    rates = dict(zip(names, rng.permutation([0.1, 0.2, 0.3, 0.5, 0.9, 0.95, 0.4]), strict=True))
    told = {name: (rng.random(100_000) < rate).astype(np.int64) for name, rate in rates.items()}
    run = sim.load("shade_skipped").run(**{f"told_i.{name}": bits for name, bits in told.items()}, latency=1)
    total = {name: int(bits.sum()) for name, bits in told.items()}
    empty = total["outside"] + total["between"]
    faults = {name: total[name] for name in golden.FAULTS}
    wanted = golden.Scanned(*[None] * 13, faults, total["culled"], empty)
    expected = golden.skipped(wanted)
    assert max(expected.values()) == (1 << 16) - 1 > min(expected.values())
    last = {name: int(run.outputs[f"skipped_o.{name}"][-1]) for name in expected}
    assert last == expected
    assert len(whole(SKIPPED, {name: [value] for name, value in last.items()})) == 1
