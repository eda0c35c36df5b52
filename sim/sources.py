# SPDX-License-Identifier: Apache-2.0
"""Where things are: the repository, its build folder, the RTL's file list that every tool reads."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILD = ROOT / "build"
FILE_LIST = ROOT / "rtl" / "shade.f"
YARDSTICKS = ROOT / "scripts" / "studies" / "yardsticks"

Point = dict[str, int]  # parameters of a module


def sources() -> list[Path]:
    """Every listed file in order, as absolute paths; the package comes first. ``//`` starts a comment."""
    lines = (line.split("//")[0].strip() for line in FILE_LIST.read_text().splitlines())
    return [FILE_LIST.parent / line for line in lines if line]


def modules() -> dict[str, Path]:
    """Name and file of every module, in the order of the list: one module a file, named like the file."""
    return {path.stem: path for path in sources() if not path.stem.endswith("_pkg")}


def yardsticks() -> dict[str, Path]:
    """Name and file of the modules that others are measured against; they are no part of the product."""
    return {path.stem: path for path in sorted(YARDSTICKS.glob("*.sv"))}


def label(module: str, point: Point) -> str:
    """``shade_third[WIDTH=4,FORM=1]``: how a module at a point is called in tests, messages and reports."""
    return module + ("[" + ",".join(f"{k}={v}" for k, v in point.items()) + "]" if point else "")
