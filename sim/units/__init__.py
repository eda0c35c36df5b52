# SPDX-License-Identifier: Apache-2.0
"""Every arithmetic unit with its golden twin, the exact value of its formula, and vectors: for tests and report.

One file a folder of ``rtl/``, of ``light`` two; ``case`` says what is measured and makes the vectors.
"""

from polyshade.sim.units import fixed, light, normal, plan, poly, reflectance, stream, surface
from polyshade.sim.units.case import FORMS, Case, Result
from polyshade.sim.units.normal import unit_vectors
from polyshade.sim.units.stream import Stream, streams

__all__ = ["FORMS", "Case", "Result", "Stream", "cases", "streams", "unit_vectors"]


def cases() -> list[Case]:
    """All cases of all units, both forms, in the order of the data's way."""
    parts = (fixed, stream, poly, normal, plan, light, reflectance, surface)
    return [case for part in parts for case in part.cases()]
