"""The RTL's file list, ``rtl/shade.f``, which simulation, lint, synthesis and hand-off all read."""

from pathlib import Path

from scripts.tools import ROOT

FILE_LIST = ROOT / "rtl" / "shade.f"


def sources() -> list[Path]:
    """Every listed file in order, as absolute paths; the package comes first. ``//`` starts a comment."""
    lines = (line.split("//")[0].strip() for line in FILE_LIST.read_text().splitlines())
    return [ROOT / line for line in lines if line]


def modules() -> dict[str, Path]:
    """Name and file of every module, in the order of the list: one module a file, named like the file."""
    return {path.stem: path for path in sources() if not path.stem.endswith("_pkg")}
