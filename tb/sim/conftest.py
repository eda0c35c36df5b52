# SPDX-License-Identifier: Apache-2.0
"""Toy modules beside the RTL, and a cache of compiled models of their own."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from polyshade.sim import model, sources, verilate


@pytest.fixture
def fresh(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache of models, in which Verilator's own part is there already."""
    runtime = verilate.runtime()
    monkeypatch.setattr(verilate, "runtime", lambda: runtime)
    monkeypatch.setattr(verilate, "CACHE", tmp_path / "cache")
    monkeypatch.setattr(model, "_loaded", {})
    return tmp_path / "cache"


@pytest.fixture
def compiled(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The programs that were run to compile models."""
    programs, run = [], verilate.run

    def record(command: list[str | Path], directory: Path) -> None:
        programs.append(Path(command[0]).name)
        run(command, directory)

    monkeypatch.setattr(verilate, "run", record)
    return programs


@pytest.fixture
def toy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str, str], Path]:
    """Add a module to the file list, for this test: ``toy("shade_toy", "module shade_toy ... endmodule")``."""
    files: dict[str, Path] = {}
    known = sources.modules()
    monkeypatch.setattr(verilate, "modules", lambda: known | files)
    monkeypatch.setattr(verilate, "sources", lambda: [*sources.sources(), *files.values()])

    def add(name: str, text: str) -> Path:
        files[name] = tmp_path / f"{name}.sv"
        files[name].write_text(text)
        return files[name]

    return add
