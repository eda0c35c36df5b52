# SPDX-License-Identifier: Apache-2.0
"""shade_cross: sums of two products, of small and of wide factors, to the bit."""

import numpy as np
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden.raster import cross

from tb.runner import SEED

LOW = 17


def test_every_number_of_products() -> None:
    """Two products, and four of second factors of 25 bits in parts of 8 and 17; both signs."""
    rng = np.random.default_rng(SEED)
    rows, wanted, last = [], [], []
    for _ in range(20_000):
        wide, minus = (int(bit) for bit in rng.integers(0, 2, 2))
        p, s = (int(rng.integers(-(1 << 24), 1 << 24)) for _ in "ps")
        q, t = (int(rng.integers(-(1 << 24), 1 << 24) if wide else rng.integers(-(1 << 17), 1 << 17)) for _ in "qt")
        for low in (0, 1)[1 - wide :]:
            parts = (x if not wide else x & (1 << LOW) - 1 if low else x >> LOW for x in (q, t))
            for second, (a, b) in enumerate(zip((p, s), parts, strict=True)):
                rows.append([not second and low == 1 - wide, not second and low, minus ^ second, a, b])
        last.append(len(rows) - 1)
        wanted.append(int(cross(p, q, s, t, minus)))
    columns = dict(zip(("first_i", "shift_i", "minus_i", "p_i", "q_i"), np.array(rows, np.int64).T, strict=True))
    run = sim.load("shade_cross").run(latency=k.LATENCY_CROSS, seed=SEED, **columns)
    assert np.array_equal(run.sum_o[np.array(last)], wanted)
