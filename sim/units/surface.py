# SPDX-License-Identifier: Apache-2.0
"""The direct form: 1/sqrt(P) - 1."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import direct
from polyshade.sim.units.case import Arrays, Case, Real, every, in_forms

LENGTHS = 1 << k.DIRECT_P_OUT_F + 1


def _rho(form: str) -> Iterator[Case]:
    """1/sqrt(P) - 1 of all P: next to 1, where nothing may be lost, and of every size."""
    if form != "refined":
        return
    one = 1 << k.DIRECT_P_OUT_F

    def golden(i: Arrays) -> Arrays:
        return dict(zip(("rho_o", "short_o", "long_o"), direct.rho(i["p_i"]), strict=True))

    def exact(i: Arrays) -> Arrays:
        """Next to 1/4 the table gives up 2^-17, and below 1/4 it is told: nothing to compare with."""
        p = np.ldexp(np.maximum(i["p_i"], 1).astype(Real), -k.DIRECT_P_OUT_F)
        within = p >= 33 / 128
        return golden(i) | {"rho_o": np.where(within, np.ldexp(1 / np.sqrt(p) - 1, k.RHO_F), golden(i)["rho_o"])}

    def random(rng: np.random.Generator, rows: int) -> Arrays:
        near = (one + (np.ldexp(rng.standard_normal(rows), rng.integers(0, 20, rows)))).astype(np.int64)
        segment = rng.integers(0, 256, rows) << k.DIRECT_P_OUT_F - k.RHO_INDEX_W
        edges = np.maximum(segment + rng.integers(-1, 2, rows), 0)
        p = np.select([rng.random(rows) < 0.25, rng.random(rows) < 0.25], [near, edges], rng.integers(0, LENGTHS, rows))
        return {"p_i": p}

    yield Case(
        "shade_rho", form, {}, golden, exact, exact, random, None, k.LATENCY_RHO, bound=20,
        more_f={"rho_o": k.RHO_F},
    )  # fmt: skip
    rows = lambda i: {"row_o": direct.rho_rom(i["i_i"])}  # noqa: E731
    yield Case(
        "shade_rho_rom", form, {}, rows, rows, rows, None, every({"i_i": (0, (1 << k.RHO_INDEX_W) - 1)}), 1, bound=0,
    )  # fmt: skip


def cases() -> list[Case]:
    """All cases of this file."""
    return list(in_forms(_rho))
