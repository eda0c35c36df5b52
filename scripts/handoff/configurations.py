# SPDX-License-Identifier: Apache-2.0
"""The machines that the bundle hands over: a top at a parameter point, what it is, and how its smoke test is drawn."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from polyshade.scripts.flow.points import FOLDED, SMALL
from polyshade.sim.errors import UserError
from polyshade.sim.sources import Point, label
from polyshade.sim.verilate import reached


@dataclass(frozen=True)
class Configuration:
    """A top at a parameter point. ``path``: of ``polyshade render``, which draws the picture of its smoke test."""

    name: str
    top: str
    point: Point
    path: str
    meaning: str

    @property
    def label(self) -> str:
        """As in the reports: ``shade_core[FOLD=6]``."""
        return label(self.top, self.point)

    @property
    def files(self) -> list[Path]:
        """Its sources, the package first."""
        return reached(self.top)


CONFIGURATIONS = {
    part.name: part
    for part in (
        Configuration(
            "core", "shade_core", {}, "line", "spans to pixels, six models, polynomials and a path of normals"
        ),
        Configuration("core_small", "shade_core", SMALL, "line", "spans to pixels, Lambert and Blinn-Phong"),
        Configuration("core_folded", "shade_core", FOLDED, "line", "the same, a node in six clocks, fewer multipliers"),
        Configuration("direct", "shade_direct", {}, "direct", "triangles and runs to pixels, from scalars"),
        Configuration("patch", "shade_patch", {}, "patch", "triangles and runs to pixels, polynomials over boxes"),
        Configuration("spans", "shade_spans", {}, "scan", "vertices to spans"),
    )
}


def chosen(names: list[str]) -> list[Configuration]:
    """Those of these names, all without a name; UserError for one that is none."""
    for name in names:
        if name not in CONFIGURATIONS:
            raise UserError(f"{name}: no such configuration, allowed {', '.join(CONFIGURATIONS)}")
    return [part for name, part in CONFIGURATIONS.items() if not names or name in names]
