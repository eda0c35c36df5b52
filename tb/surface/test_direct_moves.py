# SPDX-License-Identifier: Apache-2.0
"""shade_direct_moves: runs in, moves out; faulty ones are told and move nothing."""

import numpy as np
import pytest
from polyshade import sim
from polyshade.golden import contract as k

from tb.runner import SEED


@pytest.mark.parametrize(("in_gap", "out_stall"), [(0, 0), (0.3, 0.3)])
def test_runs(in_gap: float, out_stall: float) -> None:
    rng = np.random.default_rng([SEED, 5])
    rows = 5000
    run = {
        "column": rng.integers(0, 4096, rows),
        "line": rng.integers(0, 8, rows).cumsum() % 4096,
        "count": rng.choice([0, 1, 5, k.PIXELS_MAX, k.PIXELS_MAX + 1, 8191], rows),
        "first": rng.integers(0, 4, rows) == 0,
        "last": rng.integers(0, 4, rows) == 0,
        "tag": rng.integers(0, 1 << 16, rows),
    }
    run["first"][0] = True
    taken = sim.load("shade_direct_moves").run(
        **{f"run_i.{name}": value for name, value in run.items()}, in_gap=in_gap, out_stall=out_stall, seed=SEED
    )
    column = line = 0
    for i in range(rows):
        x, y, count, first, last = (int(run[name][i]) for name in ("column", "line", "count", "first", "last"))
        order = not first and y < line
        good = 0 < count <= k.PIXELS_MAX and not order
        move = good and not first
        told = {
            "lines": y - line if move else 0, "columns": x - column if move else 0, "good": good, "first": first,
            "last": last, "count": count, "tag": run["tag"][i],
        }  # fmt: skip
        assert {name: taken.outputs[f"moves_o.{name}"][i] for name in told} == told, i
        if good or first:
            column, line = x, y + good
    if not out_stall:
        assert np.all(taken.given - taken.taken == 1)
