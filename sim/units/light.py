"""Light at a node: angles, reflected light."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from golden import contract as k
from golden import light
from sim.units.case import FORMS, ONE, Arrays, Case, Real, in_forms, signed_range
from sim.units.normal import ends

LIMITS = signed_range(k.INTENSITY_W)


def _two(i: Arrays) -> tuple[np.ndarray, np.ndarray]:
    """The two vectors (3, rows) that the inputs begin with, as numbers."""
    v = np.stack(list(i.values())[:6]).astype(Real) / ONE
    return v[:3], v[3:]


def _versine(form: str) -> Iterator[Case]:
    """1 - cos of an angle; ideal: of the true angle, where that is acute, of unit vectors but for their rounding."""

    def golden(i: Arrays) -> Arrays:
        return dict(zip(("x_o", "range_o"), light.versine(*i.values(), form=FORMS[form]), strict=True))

    def exact(i: Arrays) -> Arrays:
        a, b = _two(i)
        low, high = LIMITS
        chord = (((a - b) * ONE).clip(low, high) / ONE) ** 2
        x = chord.sum(axis=0) / 2 if form == "refined" else 1 - (a * b).sum(axis=0)
        return golden(i) | {"x_o": np.ldexp(x.clip(0, 2), k.VERSINE_F)}

    def ideal(i: Arrays) -> Arrays:
        a, b = _two(i)
        lengths = [np.sqrt((v * v).sum(axis=0)) for v in (a, b)]
        unit = np.all([np.abs(length - 1) < 1 / ONE for length in lengths], axis=0)
        a, b = (v / np.where(unit, length, 1) for v, length in zip((a, b), lengths, strict=True))
        x = ((a - b) ** 2).sum(axis=0) / 2
        values = exact(i)
        return values | {"x_o": np.where(unit & (x <= 1), np.ldexp(x, k.VERSINE_F), values["x_o"])}

    yield Case(
        "shade_versine", form, {"FORM": FORMS[form]}, golden, exact, ideal, ends(), None, k.LATENCY_VERSINE,
        unit_f=k.VERSINE_F,
    )  # fmt: skip


def _directions(form: str) -> Iterator[Case]:
    """The mirrored direction of light."""
    if form != "refined":
        return

    def reflected(i: Arrays) -> Arrays:
        return dict(zip(("x_o", "y_o", "z_o"), light.reflect(*i.values()), strict=True))

    def exact(i: Arrays) -> Arrays:
        n, l = _two(i)  # noqa: E741
        twice = 2 * (n * l).sum(axis=0)
        r = (twice.clip(-LIMITS[1] / ONE, 2) * n - l) * ONE
        return dict(zip(("x_o", "y_o", "z_o"), r.clip(*LIMITS), strict=True))

    yield Case("shade_reflect", form, {}, reflected, exact, exact, ends("nl"), None, k.LATENCY_REFLECT)


def cases() -> Iterator[Case]:
    """All cases of ``rtl/light``."""
    return in_forms(_versine, _directions)
