# SPDX-License-Identifier: Apache-2.0
"""shade_cross: sums of two products in one, two and four passes, to the bit."""

import numpy as np
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden.raster import cross

from tb.runner import SEED

LOW = 17


def test_every_number_of_passes() -> None:
    """Wide and small factors: 25 bits in parts of 8 and 17 bits, and 18 bits as they are; both signs."""
    rng = np.random.default_rng(SEED)
    rows, wanted, last = [], [], []
    for _ in range(20_000):
        wide_p, wide_q, minus = rng.integers(0, 2, 3)
        p, s = (int(rng.integers(-(1 << 24), 1 << 24) if wide_p else rng.integers(-(1 << 17), 1 << 17)) for _ in "ps")
        q, t = (int(rng.integers(-(1 << 24), 1 << 24) if wide_q else rng.integers(-(1 << 17), 1 << 17)) for _ in "qt")
        passes = [(a, b) for a in (1, 0)[1 - wide_p :] for b in (1, 0)[1 - wide_q :]]
        for i, (a, b) in enumerate(passes):
            shift = b == 0 if wide_q else a == 0 and wide_p
            parts = [_part(p, a, wide_p), _part(q, b, wide_q), _part(s, a, wide_p), _part(t, b, wide_q)]
            rows.append([i == 0, bool(shift), minus, *parts])
        last.append(len(rows) - 1)
        wanted.append(int(cross(p, q, s, t, minus)))
    names = ("first_i", "shift_i", "minus_i", "p_i", "q_i", "s_i", "t_i")
    columns = dict(zip(names, np.array(rows, np.int64).T, strict=True))
    run = sim.load("shade_cross").run(latency=k.LATENCY_CROSS, seed=SEED, **columns)
    assert np.array_equal(run.sum_o[np.array(last)], wanted)


def _part(x: int, upper: int, wide: int) -> int:
    return x if not wide else x >> LOW if upper else x & (1 << LOW) - 1
