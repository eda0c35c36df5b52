# SPDX-License-Identifier: Apache-2.0
"""Every claim of the papers against what this project measures, and their figures drawn again: ``make papers``.

    build/papers.json   [{paper, claim, claimed, measured, holds, relation, unit, kind, figure, note}]
    build/papers/*.png  the figures

A paper's claims are measured by a few steps, ``STEPS`` of a module: generators of claims that draw their figures on the
way.
Every measured number comes from the RTL, through ``sim``, or from the golden package; none is written down.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from types import ModuleType

from polyshade.scripts.report import save
from polyshade.scripts.studies.papers import (
    p1_arithmetic,
    p1_face,
    p1_light,
    p1_line,
    p2_criterion,
    p3_energy,
    p4_face,
    p4_vectors,
)
from polyshade.scripts.studies.papers.claims import Claim
from polyshade.sim.sources import BUILD
from tqdm import tqdm

PARTS = (p1_light, p1_arithmetic, p1_line, p1_face, p2_criterion, p3_energy, p4_vectors, p4_face)


def main(out: Path = BUILD / "papers.json", *, size: int = 512, parts: Sequence[ModuleType] = PARTS) -> list[dict]:
    """Measure all claims, draw all figures, write ``out`` and ``<folder of out>/papers/*.png``; the rows of ``out``.

    ``size`` of the frames on which the methods are compared.
    """
    steps = [step for part in parts for step in part.STEPS]
    figures = out.parent / "papers"
    figures.mkdir(parents=True, exist_ok=True)
    claims: list[Claim] = []
    with tqdm(steps, desc="papers", disable=None, delay=2, leave=False) as bar:
        for step in bar:
            bar.set_description(step.__name__)
            claims += step(figures, size)
    rows = [asdict(claim) for claim in claims]
    save(out, rows)
    for claim in claims:
        print(claim)
    print(f"{out}: {sum(claim.holds for claim in claims)} of {len(claims)} claims hold; figures in {figures}")
    return rows
