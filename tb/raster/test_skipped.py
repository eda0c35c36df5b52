# SPDX-License-Identifier: Apache-2.0
"""shade_skipped: every kind is counted on its own, two kinds as one, up to 2^16 - 1."""

from __future__ import annotations

import numpy as np
import pytest
from polyshade import sim
from polyshade.golden.types import FATE, SKIPPED

from tb.runner import SEED


@pytest.mark.parametrize("often", [0.001, 1.0])
def test_counts(often: float) -> None:
    """Any kinds at once, in every clock as many as were told: seldom, from 0 on, and often, up to the limit.

    Every second clock tells nothing, so that a count just below the limit has to stay there.
    """
    rng = np.random.default_rng(SEED)
    names = [leaf.name for leaf in FATE.leaves()]
    rates = often * np.linspace(0.7, 1, len(names))
    told = {
        name: (rng.random(200_000) < rate) * (np.arange(200_000) % 2) for name, rate in zip(names, rates, strict=True)
    }
    run = sim.load("shade_skipped").run(**{f"told_i.{name}": bits for name, bits in told.items()}, latency=1)
    kinds = {leaf.name: (leaf.name,) for leaf in SKIPPED.leaves()} | {"empty": ("outside", "between")}
    for name, parts in kinds.items():
        count = np.minimum(np.cumsum(sum(told[part] for part in parts)), (1 << 16) - 1)
        assert np.array_equal(run.outputs[f"skipped_o.{name}"], count), name
