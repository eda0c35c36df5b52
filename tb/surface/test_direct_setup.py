# SPDX-License-Identifier: Apache-2.0
"""shade_direct_setup: vectors in, coefficients out, to the bit of golden.direct.setup, with pauses on both sides."""

import numpy as np
import pytest
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden.direct import setup

from tb.runner import SEED
from tb.surface.direct_vectors import direction, vector

LOW, HIGH = -(1 << k.INTENSITY_W - 1), (1 << k.INTENSITY_W - 1) - 1


@pytest.mark.parametrize(("in_gap", "out_stall"), [(0, 0), (0.5, 0), (0, 0.9), (0.3, 0.3)])
def test_triangles(in_gap: float, out_stall: float) -> None:
    """Vectors of every size and exponent, the extremes; increments that are none, with any vector; 12 clocks each."""
    rng = np.random.default_rng([SEED, 4])
    rows = 3000
    n, c, l = (rng.integers(LOW, HIGH, (rows, 3), endpoint=True) for _ in range(3))  # noqa: E741
    n[:4], c[:4], l[:4] = LOW, HIGH, LOW
    exponents = rng.integers(0, 16, (rows, 2))
    wide, tall = rng.integers(0, 4, (2, rows)) > 0
    light, half = direction(rng), direction(rng)
    triples = np.stack([n, c, l], axis=1).reshape(-1, 3)
    run = sim.load("shade_direct_setup").run(
        **{f"vector_i.mantissa.{axis}": triples[:, i] for i, axis in enumerate("xyz")},
        **{"vector_i.exp": np.c_[rng.integers(0, 16, rows), exponents].ravel()},
        kind_i=np.tile(np.arange(3), rows), wide_i=np.repeat(wide, 3), tall_i=np.repeat(tall, 3), cut_i=0,
        **vector("l_i", light), **vector("h_i", half), in_gap=in_gap, out_stall=out_stall, seed=SEED,
    )  # fmt: skip
    wanted = setup(n, c * wide[:, None], exponents[:, 0], l * tall[:, None], exponents[:, 1], light, half)
    mask = (1 << k.DIRECT_P_W) - 1  # the RTL gives what P grows by to the next pixel
    wanted = wanted._replace(
        p_column=wanted.p_column + wanted.p_columns & mask, p_line=wanted.p_line + wanted.p_lines & mask
    )
    for name, values in wanted._asdict().items():
        assert np.array_equal(run.outputs[f"coefficients_o.{name}"], values), name
    if not in_gap and not out_stall:
        clocks = 3 + np.where(wide, 4, 1) + np.where(tall, np.where(wide, 5, 4), 1)
        between = np.diff(run.taken[::3])  # at most two are inside
        assert np.all((clocks[:-1] <= between) & (between <= 12))
        last = clocks - 3 - np.where(wide, 4, 1)
        assert set((run.given - run.taken[2::3] - last).tolist()) == {7}
