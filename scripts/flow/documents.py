# SPDX-License-Identifier: Apache-2.0
"""What documents, headers and docstrings mention exists: files, sections, modules, commands. Part of ``make lint``."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from polyshade.scripts.cli import cli
from polyshade.sim.sources import ROOT, modules, yardsticks

LEFT_OUT = {".venv", ".git", "build"}
SOURCES = ("golden", "sim", "scripts")  # Python whose docstrings are read; tests make up files of their own
LINK = re.compile(r"\]\(([^)\s]+)\)")
FILE = re.compile(
    r"(?<![\w/.<*-])(?:\.\./)*((?:[\w.-]+/)*(?:[\w-]{2,}\.(?:py|sv|sh|cpp|md|vlt|cff|toml)|shade\.f))(?![\w/])"
)
SECTION = re.compile(r'(README|[\w/]+\.md), "([^"]+)"')
MODULE = re.compile(r"(?<![\w/])(shade_[a-z0-9_]*[a-z0-9])(?![\w*])")
MAKE = re.compile(r"`make ([a-z][a-z-]*)|(?<=\n)make ([a-z][a-z-]*)(?=[^`]*```)")  # in quotes, or a line of a block
COMMAND = re.compile(r"(?:`|bin/)polyshade ([a-z]+)")


@cache
def files(root: Path) -> frozenset[str]:
    """Every file of the repository, relative to its root."""
    folders = [path for path in root.iterdir() if path.is_dir() and path.name not in LEFT_OUT]
    inside = (path for folder in folders for path in folder.rglob("*"))
    return frozenset(str(path.relative_to(root)) for path in [*root.iterdir(), *inside] if path.is_file())


def slug(heading: str) -> str:
    """The anchor of a heading, as GitHub makes it."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower().replace("`", "")).replace(" ", "-")


def headings(path: Path) -> list[str]:
    """The headings of a document."""
    return re.findall(r"^#+ (.*)$", path.read_text(), re.MULTILINE)


def links(root: Path, name: str, text: str) -> Iterator[str]:
    """Links of a document to files and sections that do not exist."""
    for target in LINK.findall(text):
        if re.match(r"[a-z]+:", target):
            continue
        file, _, anchor = target.partition("#")
        path = (root / name).parent / file if file else root / name
        if not path.exists():
            yield f"{name}: link to {target}, which does not exist"
        elif anchor and anchor not in map(slug, headings(path)):
            yield f"{name}: link to {target}, a section that does not exist"


def mentions(root: Path, name: str, text: str) -> Iterator[str]:
    """Files, sections and commands named in a text that do not exist. A file may be named by the end of its path."""
    known = files(root)
    text = LINK.sub("]", text)
    for file in FILE.findall(text):
        if not any(path == file or path.endswith("/" + file) for path in known):
            yield f"{name}: names the file {file}, which does not exist"
    for document, section in SECTION.findall(text):
        path = root / ("README.md" if document == "README" else document)
        if not path.exists() or section not in headings(path):
            yield f'{name}: names the section "{section}" of {document}, which does not exist'
    targets = re.findall(r"^([a-z][a-z -]*):", (root / "Makefile").read_text(), re.MULTILINE)
    for target in map("".join, MAKE.findall(text)):
        if target not in " ".join(targets).split():
            yield f"{name}: names the command make {target}, which does not exist"
    for command in COMMAND.findall(text):
        if command not in cli.commands:
            yield f"{name}: names the command polyshade {command}, which does not exist"


def header(name: str, text: str) -> Iterator[str]:
    """Modules named in the comments of a source that do not exist."""
    technology = {path.stem for path in (ROOT / "rtl" / "tech").rglob("*.sv")}
    known = {*modules(), *yardsticks(), *technology, "shade_pkg", "shade_lobe_pkg"}
    comments = "\n".join(re.findall(r"//(.*)$", text, re.MULTILINE))
    for module in MODULE.findall(comments):
        if module not in known:
            yield f"{name}: names the module {module}, which does not exist"


def docstrings(text: str) -> str:
    """All docstrings of a Python source."""
    kinds = (ast.Module, ast.FunctionDef, ast.ClassDef)
    return "\n".join(ast.get_docstring(node) or "" for node in ast.walk(ast.parse(text)) if isinstance(node, kinds))


def check(root: Path = ROOT) -> list[str]:
    """Every fault, a line each."""
    faults: list[str] = []
    for name in sorted(files(root)):
        path, folder = root / name, name.partition("/")[0]
        if name.endswith(".md"):
            faults += [*links(root, name, path.read_text()), *mentions(root, name, path.read_text())]
        elif name.endswith(".sv") and folder == "rtl":
            text = path.read_text()
            faults += [
                *header(name, text),
                *mentions(root, name, "\n".join(re.findall(r"//(.*)$", text, re.MULTILINE))),
            ]
        elif name.endswith(".py") and folder in SOURCES:
            faults += mentions(root, name, docstrings(path.read_text()))
    return list(dict.fromkeys(faults))
