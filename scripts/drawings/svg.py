# SPDX-License-Identifier: Apache-2.0
"""Drawings of the documentation as SVG: a few strokes and texts, and timing diagrams."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from html import escape
from pathlib import Path

INK, FAINT, ACCENT, FILL = "#22303c", "#c3cad1", "#00798c", "#e8f3f4"
SANS = "Helvetica, Arial, 'DejaVu Sans', sans-serif"
MONO = "'DejaVu Sans Mono', Menlo, Consolas, monospace"


@dataclass
class Svg:
    """A drawing of a size in pixels, on a white card that stays readable on a dark page."""

    width: float
    height: float
    parts: list[str] = field(default_factory=list)

    def path(self, d: str, stroke: str = INK, width: float = 1.4, fill: str = "none", more: str = "") -> None:
        """Any line: ``d`` as SVG has it."""
        self.parts.append(f'<path d="{d}" stroke="{stroke}" stroke-width="{width}" fill="{fill}" {more}/>')

    def arrow(self, d: str, stroke: str = INK, dash: str = "") -> None:
        """A line with a head at its end."""
        self.path(d, stroke, 1.6, more=f'marker-end="url(#head)" stroke-dasharray="{dash}"')

    def box(self, x: float, y: float, width: float, height: float, fill: str = FILL, stroke: str = ACCENT) -> None:
        """A rectangle with round corners."""
        self.parts.append(
            f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="6" fill="{fill}" stroke="{stroke}" '
            'stroke-width="1.4"/>'
        )

    def text(self, x: float, y: float, words: str, size: float = 12, anchor: str = "middle", **style: str) -> None:
        """Words at a place; ``style``: ``fill``, ``font_family``, ``font_weight``, ..."""
        more = "".join(f' {name.replace("_", "-")}="{value}"' for name, value in style.items())
        self.parts.append(
            f'<text x="{x}" y="{y}" font-size="{size}" text-anchor="{anchor}"{more}>{escape(words)}</text>'
        )

    def save(self, path: Path) -> None:
        """Write the file."""
        body = "\n".join(self.parts)
        path.write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {self.height}" width="{self.width}" '
            f'height="{self.height}" font-family="{SANS}" fill="{INK}">\n'
            '<defs><marker id="head" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" '
            f'orient="auto"><path d="M0 0.5L8 4L0 7.5z" fill="{INK}"/></marker></defs>\n'
            f'<rect width="{self.width}" height="{self.height}" rx="8" fill="#ffffff"/>\n{body}\n</svg>\n'
        )


def timing(
    rows: Sequence[tuple[str, Sequence]], cell: float, title: str, marks: dict[str, tuple[int, int]],
    numbers: Sequence[int] | None = None,
) -> Svg:  # fmt: skip
    """A timing diagram: a column a clock, each beginning with its rising edge; ``clk_i`` is drawn on top.

    ``rows``: (name, values), one value a clock. Numbers 0 and 1 throughout make a wave; otherwise values are words on a
    bus, equal neighbours joined, "" for nothing of interest. ``marks``: arrows below them from a column to a column.
    ``numbers`` of the columns: where they jump, clocks are left out.
    """
    left, top, pitch, high = 172, 62, 27, 17
    clocks = len(rows[0][1])
    numbers = range(clocks) if numbers is None else numbers
    made = Svg(left + clocks * cell + 16, top + pitch * (len(rows) + 1) + 30 * len(marks) + 14)
    made.text(16, 26, title, 14, "start", font_weight="bold")

    bottom = top + pitch * (len(rows) + 1)
    for clock in range(clocks + 1):
        made.path(f"M{left + clock * cell} {top - 8}V{bottom}", FAINT, 0.6)
    for clock in range(clocks):
        made.text(left + (clock + 0.5) * cell, top - 12, str(numbers[clock]), 9, fill="#7b8691")

    half = cell / 2
    wave = "".join(f"v{-high}h{half}v{high}h{half}" for _ in range(clocks))
    for index, (name, values) in enumerate([("clk_i", None), *rows]):
        y = top + pitch * index + high
        made.text(left - 12, y - 4, name, 11.5, "end", font_family=MONO)
        if values is None:
            made.path(f"M{left} {y}{wave}")
        elif all(isinstance(value, int) for value in values):
            levels = "".join(f"V{y - high * value}h{cell}" for value in values)
            made.path(f"M{left} {y - high * values[0]}{levels}", ACCENT, 1.6)
        else:
            _bus(made, left, y, cell, high, values)

    for clock in range(1, clocks):
        if numbers[clock] != numbers[clock - 1] + 1:
            made.path(f"M{left + clock * cell} {top - 24}V{bottom}", "#ffffff", 7)
            made.text(left + clock * cell, top - 12, "…", 12)

    for index, (words, (first, last)) in enumerate(marks.items()):
        x0, x1, y = left + first * cell, left + last * cell, bottom + 22 + 30 * index
        made.path(f"M{x0} {bottom}V{y + 4}M{x1} {bottom}V{y + 4}", FAINT, 1)
        made.arrow(f"M{x0} {y}H{x1 - 1}")
        made.text((x0 + x1) / 2, y - 6, words, 11)
    return made


def _bus(made: Svg, left: float, y: float, cell: float, high: float, values: Sequence[str]) -> None:
    first = 0
    while first < len(values):
        last = first
        while last + 1 < len(values) and values[last + 1] == values[first]:
            last += 1
        x0, x1, middle, slope = left + first * cell, left + (last + 1) * cell, y - high / 2, 3
        if values[first] == "":
            made.path(f"M{x0} {middle}H{x1}", FAINT)
        else:
            made.path(
                f"M{x0} {middle}l{slope} {-high / 2}H{x1 - slope}l{slope} {high / 2}l{-slope} {high / 2}H{x0 + slope}z",
                INK,
                1,
                FILL,
            )
            made.text((x0 + x1) / 2, middle + 3.5, values[first], 10)
        first = last + 1
