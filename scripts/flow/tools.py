# SPDX-License-Identifier: Apache-2.0
"""Run Yosys and nextpnr.

``python -m polyshade.scripts.flow.tools`` prints what is found; with the argument ``cocotb`` it checks what only the
tests need.
"""

import os
import subprocess
import sys
from pathlib import Path

from polyshade.sim.errors import UserError
from polyshade.sim.sources import ROOT, Point
from polyshade.sim.tools import environment, package, versions


def yosys(script: str, directory: Path) -> str:
    """Run Yosys commands in ``directory`` and return the log; the script and the log stay there.

    Raises UserError with Yosys' own message when a command fails.
    """
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "yosys.ys").write_text(script)
    command = [sys.executable, "-m", "polyshade.scripts.flow.yosys", "yosys.ys"]
    return _run("yosys", command, directory, {**os.environ, "PYTHONPATH": str(ROOT)})


def chparam(point: Point) -> str:
    """Options of Yosys' ``hierarchy`` for a parameter point; negative numbers by their bits, as it reads no sign."""
    numbers = {name: value if value >= 0 else f"32'sh{value & 0xFFFFFFFF:08x}" for name, value in point.items()}
    return "".join(f" -chparam {name} {value}" for name, value in numbers.items())


def nextpnr_ecp5(arguments: list[str], directory: Path) -> str:
    """Run nextpnr for ECP5, see :func:`nextpnr`."""
    return nextpnr("ecp5", arguments, directory)


def nextpnr(family: str, arguments: list[str], directory: Path) -> str:
    """Run nextpnr of a family, such as ``ice40``, in ``directory`` and return the log. Paths must be relative to it.

    Raises UserError with nextpnr's own message when it fails, or when it is not installed.
    """
    package(f"yowasp_nextpnr_{family.replace('-', '_')}")
    program = Path(sys.executable).parent / f"yowasp-nextpnr-{family}"
    return _run(f"nextpnr-{family}", [str(program), *arguments], directory, environment())


def _run(name: str, command: list[str], directory: Path, env: dict[str, str]) -> str:
    done = subprocess.run(command, cwd=directory, env=env, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    log = directory / f"{name}.log"
    log.write_text(done.stdout)
    if done.returncode:
        lines = done.stdout.strip().splitlines() or ["no message"]
        cause = next((line for line in reversed(lines) if line.startswith("ERROR")), lines[-1])
        raise UserError(f"{os.path.relpath(log, ROOT)}: {cause}")
    return done.stdout


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
