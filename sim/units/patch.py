# SPDX-License-Identifier: Apache-2.0
"""Arithmetic parts of patches that stand alone; the whole is compared in every bit by ``tb/surface/test_patch.py``."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import patch
from polyshade.sim.units.case import Arrays, Case, Real, every, in_forms, mixed, signed_range


def _norm(form: str) -> Iterator[Case]:
    if form != "refined":
        return
    for width in (k.PATCH_PLAN_F + 6, 5):
        ranges = {f"{axis}_i": signed_range(width) for axis in "xyz"}
        most = (1 << width) - 1

        def golden(i: Arrays, most: int = most) -> Arrays:
            return {"y_o": np.minimum(patch.norm(*i.values()), most)}

        def exact(i: Arrays, most: int = most) -> Arrays:
            parts = [np.abs(part.astype(Real)) for part in i.values()]
            return {"y_o": np.minimum((sum(parts) + np.maximum.reduce(parts)) / 2, most)}

        def length(i: Arrays) -> Arrays:
            return {"y_o": np.sqrt(sum(part.astype(Real) ** 2 for part in i.values()))}

        full = width > 5
        yield Case(
            "shade_patch_norm", form, {"WIDTH": width}, golden, exact, length, mixed(ranges) if full else None,
            None if full else every(ranges), k.LATENCY_PATCH_NORM, unit_f=k.PATCH_PLAN_F,
        )  # fmt: skip


def cases() -> Iterator[Case]:
    """All cases of ``rtl/surface`` that belong to patches."""
    return in_forms(_norm)
