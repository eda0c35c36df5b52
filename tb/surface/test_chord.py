# SPDX-License-Identifier: Apache-2.0
"""shade_chord: to the bit of golden.direct.chord, near the chords, on every clock."""

import numpy as np
import pytest
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden.direct import Lobe, chord

from tb.runner import FULL, SEED
from tb.surface.direct_vectors import ENTRIES, filled, lobe

ROWS = 2_000_000 if FULL else 300_000


@pytest.mark.parametrize("shift", [0, 1, 4, 7])
def test_chord(shift: int) -> None:
    """Any x, any table; a real one to 3/4 ulp of its chords."""
    rng = np.random.default_rng([SEED, shift])
    x = rng.integers(-(1 << 26), 1 << 26, ROWS) >> rng.integers(0, 26, ROWS)
    dark = rng.integers(0, 8, ROWS) == 0
    any_table = Lobe(rng.integers(0, 1 << 17, ENTRIES), rng.integers(-(1 << 14), 1 << 14, ENTRIES), shift, 0)
    for table in (any_table, lobe(12 * 2.0**shift, shift)):
        run = sim.load("shade_chord").run(**filled(table, x_i=x, dark_i=dark), latency=k.LATENCY_CHORD)
        wanted = np.where(dark, 0, chord(x, table))
        assert np.array_equal(run.specular_o[ENTRIES:], wanted)
        scaled = np.maximum(x, 0) * 2.0**shift / (1 << k.DIRECT_X_F)
        near = ~dark & (scaled < 1)
        ends = np.r_[table.value, 0] * 1.0
        exact = ends[(scaled * ENTRIES).astype(int).clip(0, ENTRIES - 1)]
        exact += table.slope[(scaled * ENTRIES).astype(int).clip(0, ENTRIES - 1)] / 16 * (scaled * ENTRIES % 1)
        error = np.abs(wanted - exact.clip(0, 65535))[near]
        assert table is any_table or error.max() <= 3 / 4
