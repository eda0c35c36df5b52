"""P2's criterion: whether a triangle is flat enough to go without normalizing."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from golden import contract as k
from golden import plan
from sim.units.case import FORMS, ONE, Arrays, Case, in_forms, mixed, signed_range, thresholds
from sim.units.normal import DEGREES, cosine, true_invc


def _criterion(form: str) -> Iterator[Case]:
    """P2's criterion at every cosine, and over triangles of every flatness."""
    low, high = signed_range(k.INTENSITY_W)

    def exact_eta(i: Arrays, degree: int) -> np.ndarray:
        c = [cosine(i[f"{edge}_i"]) for edge in ("ab", "bc", "ca")]
        if form == "refined":
            return sum(k.ETA_U * (1 - x) + k.ETA_UU * (1 - x) ** 2 + k.ETA_UUUU * (1 - x) ** 4 for x in c)
        k0, k1, k2 = (k.ETA2_0, k.ETA2_C, k.ETA2_CC) if degree == 2 else (k.ETA1_0, k.ETA1_C, 0)
        return sum(k0 + k1 * x + k2 * x * x for x in c)

    def every_cosine() -> Iterator[Arrays]:
        """Every c at one edge, the others flat, and at all three."""
        rng = np.random.default_rng(1)
        c = np.arange(low, high + 1)
        flat = np.full(len(c), ONE)
        for ab, bc, ca in ((c, flat, flat), (flat, c, flat), (flat, flat, c), (c, c, c)):
            threshold = thresholds(rng, len(c), 26214, k.ETA_W)
            yield {"ab_i": ab, "bc_i": bc, "ca_i": ca, "threshold_i": threshold}

    def random(rng: np.random.Generator, rows: int) -> Arrays:
        """Triangles of every flatness, down to one ulp of a cosine."""
        rest = np.ldexp(rng.random((3, rows)), rng.integers(0, 18, rows))
        dense = {f"{edge}_i": (ONE - u).astype(np.int64) for edge, u in zip(("ab", "bc", "ca"), rest, strict=True)}
        free = mixed(dict.fromkeys(dense, (low, high)) | {"threshold_i": signed_range(k.ETA_W)}, ONE)(rng, rows)
        chosen = rng.random(rows) < 0.75
        return free | {name: np.where(chosen, value, free[name]) for name, value in dense.items()}

    for degree in DEGREES[form]:

        def eta(i: Arrays, degree: int = degree) -> Arrays:
            edges = (i[f"{edge}_i"] for edge in ("ab", "bc", "ca"))
            values = plan.criterion(*edges, i["threshold_i"], FORMS[form], degree)
            return dict(zip(("eta_o", "normalize_o", "clamped_o", "threshold_error_o"), values, strict=True))

        def exact(i: Arrays, eta=eta, degree: int = degree) -> Arrays:
            return eta(i) | {"eta_o": exact_eta(i, degree) * (1 << k.ETA_F - k.CONSTANT_F)}

        def ideal(i: Arrays, eta=eta) -> Arrays:
            true = sum(1 - true_invc(cosine(i[f"{edge}_i"]))[1] for edge in ("ab", "bc", "ca"))
            return eta(i) | {"eta_o": true * (1 << k.ETA_F)}

        for vectors, all_of in ((None, every_cosine), (random, None)):
            yield Case(
                "shade_criterion", form, {"FORM": FORMS[form], "DEGREE": degree}, eta, exact, ideal, vectors, all_of,
                k.LATENCY_CRITERION, unit_f=k.ETA_F,
            )  # fmt: skip


def cases() -> Iterator[Case]:
    """All cases of ``rtl/plan``."""
    return in_forms(_criterion)
