# SPDX-License-Identifier: Apache-2.0
"""shade_direct_run: a run in, the scalars of its pixels out, one a clock."""

import numpy as np
from polyshade import sim
from polyshade.golden import contract as k

from tb.runner import SEED

WIDTH = {"at.a": k.DIRECT_A_W, "at.h": k.DIRECT_H_W, "at.p": k.DIRECT_P_W, "p_column": k.DIRECT_P_W}
WIDTH |= {"a_column": k.DIRECT_A_W, "h_column": k.DIRECT_H_W, "p_columns": k.DIRECT_P_W}


def test_runs() -> None:
    """As many pixels as there are credits; sums modulo their widths; latency, no bubble."""
    rng = np.random.default_rng([SEED, 6])
    count = np.array([1, 2, 3, 1, 1, 20, 7, 1, 28])
    assert count.sum() == 1 << k.DIRECT_FIFO_LOG2
    value = {
        name: rng.integers(0, 1 << w, len(count)) - (0 if name.startswith(("at.p", "p_")) else 1 << w - 1)
        for name, w in WIDTH.items()
    }
    tag = rng.integers(0, 1 << 16, len(count))
    run = sim.load("shade_direct_run").run(
        **{f"start_i.{name}": part for name, part in value.items()},
        **{"start_i.count": count, "start_i.tag": tag}, credit_i=0,
    )  # fmt: skip
    of, j = np.repeat(np.arange(len(count)), count), np.concatenate([np.arange(n) for n in count])
    at = {name: part[of] for name, part in value.items()}
    wanted = {
        "a": at["at.a"] + j * at["a_column"],
        "h": at["at.h"] + j * at["h_column"],
        "p": at["at.p"] + j * at["p_column"] + j * (j - 1) * at["p_columns"],
    }
    for name, part in wanted.items():
        mask = (1 << WIDTH[f"at.{name}"]) - 1
        assert np.array_equal(run.outputs[f"scalars_o.{name}"] & mask, part & mask), name
    assert np.array_equal(run.tag_o, tag[of])
    assert np.array_equal(run.last_o, j == count[of] - 1)
    assert np.array_equal(run.given, np.arange(len(of)) + 1)
