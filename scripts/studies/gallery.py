# SPDX-License-Identifier: Apache-2.0
"""``polyshade gallery``: every model, energy scale and form through the RTL, on one sheet."""

from __future__ import annotations

from PIL import Image, ImageDraw, ImageFont
from polyshade.golden.material import MODELS, Material
from polyshade.golden.reference.light import ROWS
from polyshade.sim.batch import Shots, shoot_all
from polyshade.sim.frame import Settings
from polyshade.sim.scene.camera import Camera

COLUMNS = 6
EXPOSURE = 0.18  # with it the scale of no row for n = 32 comes to more than 1
INK, PAPER, WRONG = (222, 226, 230), (16, 18, 22), (255, 92, 92)


def surfaces() -> list[Material]:
    """The sheet, row by row: models and energy scales, refined above paper."""
    models = [[Material(model, form=form) for model in MODELS] for form in ("refined", "paper")]
    scales = [
        [Material(row.partition("-")[0], energy=row, exposure=EXPOSURE, form=form) for row in ROWS]
        for form in ("refined", "paper")
    ]
    return [surface for row in (*models, *scales) for surface in row]


def shoot(mesh: str, size: int, scheduler: str | None = None) -> Shots:
    """Render all of them."""
    return shoot_all([Settings(mesh, camera=Camera(size), material=surface) for surface in surfaces()], scheduler)


def caption(report: dict) -> tuple[str, str]:
    """Two lines: what is shown, how it was measured."""
    physical = report["model"] in ("cook-torrance", "ward")
    parameter = f"m = {report['roughness']:g}" if physical else f"n = {report['shininess']:g}"
    name = report["model"] if report["energy"] == "none" else f"energy {report['energy']}"
    shown = name if name == "lambert" else f"{name}, {parameter}"
    return f"{shown}, {report['form']}", f"NMSE {report['nmse'] or 0:.0e}, {report['mismatches']} mismatches"


def sheet(shots: Shots) -> Image.Image:
    """The pictures side by side, each with its caption."""
    size = len(shots.frames[0].picture)
    letter = max(10, size // 18)
    font, gap = ImageFont.load_default(letter), letter // 2
    width, height = size + gap, size + 3 * letter + gap
    made = Image.new("RGB", (COLUMNS * width + gap, len(shots.frames) // COLUMNS * height + gap), PAPER)
    draw = ImageDraw.Draw(made)
    for place, (picture, report) in enumerate(shots.frames):
        row, column = divmod(place, COLUMNS)
        left, top = gap + column * width, gap + row * height
        made.paste(Image.fromarray(picture), (left, top))
        ink = WRONG if report["mismatches"] else INK
        for line, text in enumerate(caption(report)):
            draw.text((left, top + size + gap // 2 + 1.2 * letter * line), text, ink, font)
    return made
