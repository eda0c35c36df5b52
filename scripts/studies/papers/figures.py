# SPDX-License-Identifier: Apache-2.0
"""The look of the figures: one palette, one style, no state of a plotting library that outlives a figure."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

EXACT, PAPER, REFINED, THIRD = "#22303c", "#d1495b", "#00798c", "#e09f3e"
DEGREES = {0: "#c9ced6", 1: "#8ecae6", 2: "#2a9d8f", 3: "#e76f51"}
"""Colours of degree 0 (lit directly), 1, 2, 3."""
DEGREE_NAMES = {0: "lit directly", 1: "degree 1", 2: "degree 2", 3: "degree 3"}
SHADES = ["#9bd1d6", "#4fa8b0", "#00798c", "#004e5a"]
"""Light to dark, for a parameter that grows."""

DPI = 150
STYLE = {
    "font.size": 9.5,
    "axes.titlesize": 10.5,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.edgecolor": "#8a939c",
    "axes.labelcolor": EXACT,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e4e7ea",
    "grid.linewidth": 0.7,
    "lines.linewidth": 1.7,
    "lines.markersize": 4.5,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "legend.handlelength": 2.6,
    "xtick.color": "#4a545e",
    "ytick.color": "#4a545e",
    "text.color": EXACT,
}


@contextmanager
def drawing(path: Path, width: float, height: float, rows: int = 1, columns: int = 1, **grid) -> Iterator[list[Axes]]:
    """Axes, row by row, of a figure of so many inches that is written as PNG when the block ends.

    ``grid``: options of ``Figure.subplots``. The file is the same, byte for byte, whenever its data is.
    """
    with mpl.rc_context(STYLE):
        made = Figure(figsize=(width, height), layout="constrained")
        yield list(made.subplots(rows, columns, squeeze=False, **grid).flat)
        made.savefig(path, dpi=DPI, metadata={"Software": None})
