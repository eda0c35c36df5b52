# SPDX-License-Identifier: Apache-2.0
"""The scalars of the direct form and of patches: dot products, and 1/sqrt(P) - 1."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import direct
from polyshade.sim.units.case import ONE, Arrays, Case, Real, every, in_forms, mixed, signed_range

LENGTHS = 1 << k.DIRECT_P_OUT_F + 1


def _rho(form: str) -> Iterator[Case]:
    """1/sqrt(P) - 1 of all P: next to 1, where nothing may be lost, and of every size."""
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


def _dot_scaled(form: str) -> Iterator[Case]:
    """Dot products of any vectors at every shift, next to the ends of its range, too: modulo 4, cut."""
    axes = {name: [f"{name}.{axis}" for axis in "xyz"] for name in ("a_i", "b_i")}

    def parts(i: Arrays) -> tuple[np.ndarray, np.ndarray]:
        return tuple(np.stack([i[axis] for axis in axes[name]], axis=-1) for name in axes)

    def golden(i: Arrays) -> Arrays:
        return {"d_o": direct.dot_scaled(*parts(i), i["shift_i"])}

    def exact(i: Arrays) -> Arrays:
        dot = (np.multiply(*parts(i))).sum(axis=-1).astype(Real)
        d = np.ldexp(dot, k.DIRECT_P_F + 1 - direct.VECTOR_F - i["shift_i"])
        turn = Real(1 << k.PATCH_SCALAR_W)
        return {"d_o": d - turn * np.floor(d / turn + Real(0.5))}

    inputs = dict.fromkeys([*axes["a_i"], *axes["b_i"]], signed_range(k.INTENSITY_W)) | {"shift_i": (0, 31)}
    yield Case(
        "shade_dot_scaled", form, {}, golden, exact, exact, mixed(inputs, ONE, -ONE), None, k.LATENCY_DOT_SCALED,
        bound=1, unit_f=k.DIRECT_P_F,
    )  # fmt: skip


def cases() -> Iterator[Case]:
    """All cases of this file."""
    return in_forms(_dot_scaled, _rho, only="refined")
