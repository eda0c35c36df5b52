# SPDX-License-Identifier: Apache-2.0
"""The package as a whole: it stands alone, its examples are true, the RTL's constants are its own."""

from __future__ import annotations

import doctest
import importlib
import pkgutil
import re
import shutil
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest
from polyshade import golden
from polyshade.golden import contract as k
from polyshade.golden import registers, types
from polyshade.scripts.flow import generate
from polyshade.sim.sources import ROOT

from tb.runner import HANGS

MODULES = ["polyshade.golden", *(m.name for m in pkgutil.walk_packages(golden.__path__, "polyshade.golden."))]


@pytest.fixture(params=MODULES)
def module(request: pytest.FixtureRequest) -> ModuleType:
    return importlib.import_module(request.param)


def test_doctests(module: ModuleType) -> None:
    assert not doctest.testmod(module).failed


def test_there_are_doctests() -> None:
    """In every public function of the integer models."""
    finder = doctest.DocTestFinder(exclude_empty=True)
    for name in ("polyshade.golden.fixed", "polyshade.golden.poly"):
        shown = {test.name for test in finder.find(importlib.import_module(name)) if test.examples}
        assert len(shown) >= 4, name


def test_docstrings(module: ModuleType) -> None:
    """Everything public is explained."""
    assert module.__doc__
    for name, value in vars(module).items():
        if not name.startswith("_") and getattr(value, "__module__", None) == module.__name__ and callable(value):
            assert value.__doc__, f"{module.__name__}.{name}"


ALONE = """
import sys
before = set(sys.modules)
for name in sys.argv[2:]:
    __import__(name)
golden = sys.modules["mine.golden"]
assert golden.__file__.startswith(sys.argv[1]), golden.__file__
roots = {name.partition(".")[0] for name in set(sys.modules) - before} - set(sys.stdlib_module_names)
print(*sorted(root for root in roots if not root.startswith("_")))
from mine.golden import poly
print(poly.poly_span([[[0, 32768, 0, 0]] * 2], [1], [3])[0].tolist())
"""


def test_importable_alone(tmp_path: Path) -> None:
    """A copy of the folder, anywhere, needs NumPy and nothing else."""
    shutil.copytree(ROOT / "golden", tmp_path / "mine" / "golden", ignore=shutil.ignore_patterns("__pycache__"))
    names = [name.replace("polyshade", "mine") for name in MODULES]
    done = subprocess.run(
        [sys.executable, "-c", ALONE, str(tmp_path), *names], cwd=tmp_path, env={"PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True, text=True, timeout=HANGS,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.splitlines() == ["mine numpy", "[[0, 0], [16384, 16384], [32768, 32768]]"]


def test_examples_of_the_readme() -> None:
    """They run, and where a result stands beside one it is true."""
    (block,) = re.findall(r"```python\n(.*?)```", (ROOT / "golden" / "README.md").read_text(), re.DOTALL)
    names: dict[str, object] = {}
    exec(block, names)
    span = next(line for line in block.splitlines() if "poly_span" in line)
    assert "0, 1/4, 1/2 in both channels" in span
    assert (eval(span, names) / (1 << k.PIXEL_W)).tolist() == [[0, 0], [0.25, 0.25], [0.5, 0.5]]


# ---- the contract ------------------------------------------------------------------------------------------------


def test_the_package_of_the_rtl_is_up_to_date() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "polyshade.scripts.flow.generate", "--check"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=HANGS,
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_what_is_not_up_to_date(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Any generated file that is missing or differs is named."""

    def run(*arguments: str) -> int:
        monkeypatch.setattr(sys, "argv", ["generate", *arguments])
        return generate.main()

    monkeypatch.setattr(generate, "ROOT", tmp_path)
    files = [tmp_path / name for name in generate.GENERATED]
    for path in files:
        path.parent.mkdir(parents=True, exist_ok=True)
    assert run("--check") == 1
    assert run() == run("--check") == 0
    for path in files:
        capsys.readouterr()
        text = path.read_text()
        path.write_text(text.replace("1", "2", 1))
        assert run("--check") == 1
        assert str(path.relative_to(tmp_path)) in capsys.readouterr().err
        assert run() == 0
        assert path.read_text() == text


def test_every_constant_reaches_the_rtl() -> None:
    text = generate.package()
    written = {name: int(value) for name, value in re.findall(r"localparam int (\w+) = (-?\d+);", text)}
    words = {name: value for name, (value, _) in registers.constants().items()}
    assert written == k.constants() | words | types.constants()


def test_formats_fit() -> None:
    assert k.PIXELS_MAX == 1 << k.LOG2_MAX
    assert k.PIXELS_MAX.bit_length() <= k.COUNT_W
    assert k.DIRECT_MAX == k.NODE_COUNT
