# SPDX-License-Identifier: Apache-2.0
"""Everything that can be wrong with the sources before anything is simulated: ``make lint``.

* the file list names every file under ``rtl/`` once, the package first;
* Verilator ``-Wall`` elaborates every module as its own top at every point of ``scripts.flow.points``, without a
  warning, and refuses the points that are out of range in words;
* Verible's parser reads every file;
* Yosys reads every module at every point with its own reader and with slang, finds no latch, no loop, no
  undriven net and no multiplier or divider outside ``shade_mul``, and synthesizes it as far as word-level
  cells (all the way to the cells of a family: ``scripts.flow.synth``);
* Icarus, if it is installed, reads the plain Verilog that Yosys writes of each of these;
* what there should be less of does not grow: part selects, ports, idle handshakes, initial values, long modules;
* every source names its licence;
* every module is named like its file, opens with a header that states formula, latency and an example, has a row
  in ``rtl/README.md``, a golden twin, and a case in ``sim/units`` or a bench in ``tb``;
* what documents, headers and docstrings mention exists (``scripts.flow.documents``); tables are those that
  ``docs/figures.json`` gives (``scripts.drawings.tables``);
* the Python code passes ruff's rules and format.
"""

import functools
import importlib
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from polyshade.scripts.drawings import tables
from polyshade.scripts.flow import documents, tools
from polyshade.scripts.flow.points import REFUSED, points
from polyshade.sim.errors import UserError
from polyshade.sim.sources import BUILD, ROOT, Point, label, modules, sources, yardsticks
from polyshade.sim.tools import environment, package
from polyshade.sim.tools import verilator as installed
from polyshade.sim.units import cases, streams
from polyshade.sim.verilate import reached
from tqdm import tqdm

RTL = ROOT / "rtl"
LICENCE = "SPDX-License-Identifier: Apache-2.0"
CATALOGUE = RTL / "README.md"
# They hand data on unaltered, or count: there is nothing to model.
CARRIERS = {
    *("shade_delay", "shade_ring", "shade_hold", "shade_wait", "shade_valid"),
    *("shade_fifo", "shade_credit", "shade_assert", "shade_stable"),
    *("shade_door", "shade_tally", "shade_counters", "shade_pixel_points"),
}
# Machines of many parts, shade_patch_<part>, with one golden model, golden/patch.py or golden.raster.setup, and one
# bench, that of the whole.
MACHINES = ("shade_patch", "shade_scene", "shade_setup")


@dataclass(frozen=True)
class Item:
    """One check: its name and a function that returns the faults it finds, one line each."""

    name: str
    check: Callable[[], list[str]]
    slow: bool = False  # as a test only in make test-all


def items(*, synth: bool = True) -> Iterator[Item]:
    """Every check of the repository, the short ones first; those of Yosys with synthesis, or without."""
    yield Item("file list", file_list)
    yield Item("ruff check", partial(_ruff, "check", "--quiet", "--output-format=concise"))
    yield Item("ruff format", partial(_ruff, "format", "--check", "--quiet", "--output-format=concise"))
    yield Item("verible", partial(verible, sources()))
    yield Item("verilator rtl/shade.f", partial(verilator, "shade_core", {}, "-F", RTL / "shade.f"))
    yield Item("ratchets", ratchets)
    yield Item("licence", licence)
    yield Item("documents", documents.check)
    yield Item("tables", tables.check)
    for module, path in modules().items():
        yield Item(f"mirror {module}", partial(mirror, module, path))
    held = parts()
    for module in [*modules(), *comparisons()]:
        for number, point in enumerate(REFUSED.get(module, [])):
            yield Item(f"refused {label(module, point)}", partial(refused, module, point), number > 1)
        for number, point in enumerate(points(module)):
            yield Item(f"verilator {label(module, point)}", partial(verilator, module, point), number > 0)
            slow = number > 0 or module in held  # Yosys reads the tops, and with them what they hold
            yield Item(f"yosys {label(module, point)}", partial(yosys, module, point, synth), slow)


def parts() -> set[str]:
    """Modules that others hold."""
    texts = {name: re.sub(r"//.*", "", path.read_text()) for name, path in modules().items() if path.exists()}
    named = {name: set(re.findall(r"\bshade_\w+", text)) - {name} for name, text in texts.items()}
    return set.union(*named.values()) & set(texts)


def comparisons() -> dict[str, Path]:
    """The yardsticks that are built of the product's modules, whose rules they keep."""
    return {module: path for module, path in yardsticks().items() if module.startswith("shade_")}


def file_list() -> list[str]:
    """Faults of ``rtl/shade.f``: files missing, unlisted, listed twice, or a package that comes too late."""
    listed = sources()
    found = {path for path in RTL.rglob("*.sv") if not path.is_relative_to(RTL / "tech")}  # those replace others
    faults = [f"{_short(path)}: listed, but missing" for path in listed if path not in found]
    faults += [f"{_short(path)}: not listed" for path in sorted(found - set(listed))]
    faults += [f"{_short(path)}: listed twice" for path in sorted(set(listed)) if listed.count(path) > 1]
    if listed[0].name != "shade_pkg.sv":
        faults.append(f"{_short(listed[0])}: first, but the package comes first")
    return faults


def licence() -> list[str]:
    """Sources without the line that names their licence."""
    kinds = {".py", ".sv", ".sh", ".c", ".cpp", ".h", ".f"}
    sources = [name for name in documents.files(ROOT) if Path(name).suffix in kinds or name == "Makefile"]
    return [
        f"{name}: its first lines do not hold '{LICENCE}'" for name in sorted(sources) if not _licensed(ROOT / name)
    ]


def _licensed(path: Path) -> bool:
    return LICENCE in "".join(path.read_text().splitlines(True)[:2])


def mirror(module: str, path: Path) -> list[str]:
    """Faults of a module's name, header, bench, catalogue row and golden twin."""
    if not path.exists():
        return []  # told by file_list
    text = path.read_text().removeprefix(f"// {LICENCE}\n")
    faults = []
    if re.findall(r"^\s*module\s+(\w+)", text, re.MULTILINE) != [module]:
        faults.append(f"{_short(path)}: must hold the one module {module}")
    if cast := re.search(r"[~!]\s*[\w:]+'\(", re.sub(r"//.*", "", text)):
        faults.append(f"{_short(path)}: {cast[0]}: Yosys' own reader negates the width: put the value into a signal")
    header = "".join(line for line in text.splitlines(True)[: _header_lines(text)])
    if not header.startswith(f"// {module}: "):
        faults.append(f"{_short(path)}: must open with the comment '// {module}: <formula>'")
    for word in ("latency|combinational|clocks", "example"):
        if not re.search(word, header, re.IGNORECASE):
            faults.append(f"{_short(path)}: no '{word}' in its header")

    whole = next((machine for machine in MACHINES if module.startswith(machine)), module)
    bench = ROOT / "tb" / path.parent.name / f"test_{whole.removeprefix('shade_')}.py"
    if not bench.exists() and module not in tested():
        faults.append(f"{module}: no case in sim/units, and no bench {_short(bench)}")

    link = f"[`{module}`]({path.relative_to(RTL)})"
    if link not in (CATALOGUE.read_text() if CATALOGUE.exists() else ""):
        faults.append(f"{_short(CATALOGUE)}: no row '| {link} | ...'")
    own = whole in MACHINES and (ROOT / "golden" / f"{whole.removeprefix('shade_')}.py").exists()
    return faults if module in CARRIERS or own else faults + _twin(path)


@functools.cache
def tested() -> set[str]:
    """The modules that have a case or a stream, which is run by every engine."""
    return {case.module for case in cases() if not case.own_bench} | {stream.module for stream in streams()}


def verilator(module: str, point: Point, *files: str | Path) -> list[str]:
    """Warnings and errors of Verilator for one module as the top; by default from no more files than it reaches."""
    done = _verilate(module, point, *files)
    return [line for line in done.stderr.splitlines() if line.startswith("%")] or ["failed"] * (done.returncode != 0)


def refused(module: str, point: Point) -> list[str]:
    """A fault unless elaboration ends with the module's own message."""
    done = _verilate(module, point)
    told = re.search(rf"^%Warning-USERERROR: .*: {module}: ", done.stderr, re.MULTILINE)
    return [] if done.returncode and told else [f"{label(module, point)}: accepted, or refused without words"]


def yosys(module: str, point: Point, synth: bool = True) -> list[str]:
    """Faults that Yosys finds with either reader, and in what it makes of the RTL: word-level cells, or flat logic."""
    folder = BUILD / "lint" / re.sub(r"\W+", "_", label(module, point))
    shutil.rmtree(folder, ignore_errors=True)
    files = " ".join(os.path.relpath(path, folder) for path in reached(module))
    chosen = "".join(f" -chparam {name} {value}" for name, value in point.items())
    given = "".join(f" -G {name}={value}" for name, value in point.items())
    rules = """
        proc
        check -assert
        select -assert-none t:$dlatch t:$adlatch
        select -assert-none t:$mul t:$div t:$divfloor t:$mod t:$modfloor t:$pow %u %u %u %u %u *shade_mul*/* %d
    """
    script = f"""
        read_verilog -sv {files}
        hierarchy -check -top {module}{chosen}
        {rules}
        {"synth -flatten -run begin:fine; opt" if synth else "flatten"}
        check -assert
        design -reset
        read_slang -Wwidth-trunc --keep-hierarchy --top {module}{given} {files}
        {rules}
        opt_clean
        write_verilog -noattr plain.v
    """
    try:
        log = tools.yosys(script, folder)
    except UserError as error:
        return [str(error)]
    found = [line for line in log.splitlines() if "Warning: " in line]
    return found + icarus(module, folder / "plain.v")


def icarus(module: str, netlist: Path) -> list[str]:
    """Faults that Icarus finds in the plain Verilog that Yosys writes of a module; none if it is not installed."""
    if not shutil.which("iverilog"):
        return []
    command = ["iverilog", "-g2005", "-Wall", "-Wno-timescale", "-t", "null", "-s", module, netlist]
    done = subprocess.run(command, capture_output=True, text=True)
    return (done.stdout + done.stderr).splitlines()


def verible(files: list[Path]) -> list[str]:
    """What Verible's parser does not read."""
    package("verible")
    program = Path(sys.executable).parent / "verible-verilog-syntax"
    done = subprocess.run([program, *files], capture_output=True, text=True)
    return (done.stdout + done.stderr).splitlines() if done.returncode else []


# What there may be at most of. The numbers only fall.
RATCHETS = {
    "indexed part selects and bits picked by a constant of the package, a module": 1.4,
    "ports, a module": 10.8,
    "handshakes tied off or left open": 0,
    "lines of the longest module": 273,
    "registers with an initial value": 0,
}


def ratchets() -> list[str]:
    """Faults of what there is too much of, with the number that is allowed."""
    header = f"// {LICENCE}\n"
    counts = counted([path.read_text().removeprefix(header) for path in modules().values() if path.exists()])
    return [f"{name}: {counts[name]:g}, allowed {limit}" for name, limit in RATCHETS.items() if counts[name] > limit]


def counted(texts: list[str]) -> dict[str, float]:
    """How much there is of what :data:`RATCHETS` limits, in the sources of modules."""
    plain = [re.sub(r"//.*", "", text) for text in texts]

    def found(pattern: str) -> int:
        return sum(len(re.findall(pattern, text, re.MULTILINE)) for text in plain)

    numbers = (
        found(r"\w\[[^][]*(?:[+-]:[^][]*|shade_pkg::\w+)\]") / len(texts),
        found(r"^\s*(?:input|output)\b") / len(texts),
        found(r"\.valid_i\(1'b0\)|\.\w*valid_o\(\)"),
        max(len(text.splitlines()) for text in texts),
        found(r"^\s*(?:initial\b|logic\b[^;=]*_q\w*[^;=]*=[^=])"),
    )
    return dict(zip(RATCHETS, numbers, strict=True))


def _verilate(module: str, point: Point, *files: str | Path) -> subprocess.CompletedProcess[str]:
    """In a folder of its own, to which no path of a list is relative."""
    options = [f"-G{name}={value}" for name, value in point.items()]
    command = [
        installed().program,
        "--lint-only",
        "-Wall",
        "--top-module",
        module,
        *options,
        *(files or reached(module)),
    ]
    (BUILD / "lint").mkdir(parents=True, exist_ok=True)
    return subprocess.run(command, cwd=BUILD / "lint", env=environment(), capture_output=True, text=True)


def _ruff(*arguments: str) -> list[str]:
    command = [sys.executable, "-m", "ruff", *arguments]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    return (done.stdout + done.stderr).splitlines() if done.returncode else []


def _header_lines(text: str) -> int:
    lines = text.splitlines()
    return next((n for n, line in enumerate(lines) if not line.startswith("//")), len(lines))


def _twin(path: Path) -> list[str]:
    """A fault unless ``rtl/poly/shade_horner_pipe.sv`` has ``golden.poly.horner_pipe``, or ``horner`` for all kinds."""
    name, folder = path.stem.removeprefix("shade_"), path.parent.name
    try:
        model = importlib.import_module(f"polyshade.golden.{folder}")
    except ImportError:
        return [f"golden/{folder}.py: missing, the golden model of rtl/{folder}"]
    if hasattr(model, name) or hasattr(model, name.rpartition("_")[0] or name):
        return []
    return [f"golden/{folder}.py: no function {name}, the golden twin of {path.stem}"]


def _short(path: Path) -> Path:
    return path.relative_to(ROOT)


def main() -> int:
    """Run every check on all cores, print one line per fault and a summary; 1 when there is a fault."""
    checks = list(items())
    faulty = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool, tqdm(total=len(checks), disable=None, delay=2) as bar:
        for item, faults in zip(checks, pool.map(lambda item: item.check(), checks), strict=True):
            bar.update()
            faulty += bool(faults)
            for fault in faults:
                tqdm.write(f"{item.name}: {fault}")
    if not shutil.which("iverilog"):
        print("lint: iverilog: not installed, nothing was read by Icarus")
    print(f"lint: {len(checks)} checks, {faulty} failed")
    return int(faulty > 0)


if __name__ == "__main__":
    sys.exit(main())
