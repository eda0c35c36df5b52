# SPDX-License-Identifier: Apache-2.0
"""A claim of a paper and what was measured of it."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal

import numpy as np


@dataclass(frozen=True)
class Claim:
    """One row of ``build/papers.json``.

    ``relation`` in which ``measured`` must stand to ``claimed`` for ``holds``: ``<=``, ``>=``, or ``=`` to the last
    digit that is claimed. ``kind``: ``paper``, what the paper says; ``defect``, what is wrong with it; ``repair``,
    what the refined form promises.
    """

    paper: str
    claim: str
    claimed: float
    measured: float
    holds: bool
    relation: str
    unit: str
    kind: str
    figure: str | None
    note: str

    def __str__(self) -> str:
        verdict = "holds  " if self.holds else "differs"
        unit = f" {self.unit}" if self.unit else ""
        return (
            f"{verdict} {self.paper} {self.kind:6} {self.claim}: "
            f"{self.relation} {self.claimed:.4g}{unit}, measured {self.measured:.4g}{unit}"
        )


def check(
    claim: str,
    claimed: str,
    measured: float,
    *,
    paper: str,
    kind: str = "paper",
    unit: str = "",
    figure: str | None = None,
    note: str = "",
) -> Claim:
    """Compare a measured number with a claimed one, written with its relation and its digits.

    >>> check("x", "= 1.4e-2", 0.0142, paper="P0").holds, check("x", "= 1.4e-2", 0.0147, paper="P0").holds
    (True, False)
    >>> check("x", "<= 0.79", 0.78125, paper="P0").holds
    True
    """
    relation, number = claimed.split()
    value, measured = float(number), float(measured)
    half_digit = 0.5 * 10.0 ** Decimal(number).as_tuple().exponent
    holds = {
        "<=": measured <= value,
        ">=": measured >= value,
        "=": abs(measured - value) <= half_digit,
    }[relation]
    return Claim(paper, claim, value, measured, holds, relation, unit, kind, figure, note)


def nmse(value: np.ndarray, exact: np.ndarray) -> float:
    """sum (I - Iref)^2 / sum Iref^2."""
    return float(np.sum((value - exact) ** 2) / np.sum(exact**2))
