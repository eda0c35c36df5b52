# SPDX-License-Identifier: Apache-2.0
"""shade_scalar_light: to the bit of golden.direct.scalar_light, as a pixel and as a node to be interpolated."""

import numpy as np
import pytest
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden.direct import rho, scalar_light
from polyshade.golden.fixed import saturate

from tb.runner import FULL, SEED
from tb.surface.direct_vectors import ENTRIES, filled, lobe

ROWS = 1_000_000 if FULL else 100_000


@pytest.mark.parametrize(("signed", "memory"), [(0, 0), (1, 1)])
def test_light(signed: int, memory: int) -> None:
    """Any scalars of any P; rho comes LATENCY_RHO clocks behind them."""
    rng = np.random.default_rng([SEED, 21])
    table = lobe(32.0, 1, 100)
    a, h, p = (
        rng.integers(low, high, ROWS)
        for low, high in (
            (-(2 << k.DIRECT_DIFFUSE_F), 2 << k.DIRECT_DIFFUSE_F),
            (-(2 << k.DIRECT_X_F), 2 << k.DIRECT_X_F),
            (0, 2 << k.DIRECT_P_OUT_F),
        )
    )
    late = np.r_[np.zeros(k.LATENCY_RHO, np.int64), rho(p)[0]][: ENTRIES + ROWS]
    inputs = filled(table, a_i=a, h_i=h)
    inputs["rho_i"] = np.r_[np.zeros(ENTRIES, np.int64), late][: ENTRIES + ROWS]
    run = sim.load("shade_scalar_light", SIGNED=signed, MEMORY=memory).run(
        **inputs, excess_i=table.excess, latency=k.LATENCY_DIRECT_LIGHT
    )
    diffuse, specular, _ = scalar_light(a, h, p, table)
    end = ROWS - k.LATENCY_RHO
    wanted = {"diffuse_o": diffuse if signed else saturate(diffuse, k.PIXEL_W), "specular_o": specular}
    for name, values in wanted.items():
        assert np.array_equal(run.outputs[name][ENTRIES:][:end], values[:end]), name
