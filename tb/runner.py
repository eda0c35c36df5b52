# SPDX-License-Identifier: Apache-2.0
"""From pytest to the simulator: run a cocotb bench on a model that ``sim.verilate`` compiled, once, for all engines.

The bench of ``rtl/<folder>/shade_<x>.sv`` is ``tb/<folder>/test_<x>.py``: it holds the cocotb tests and one pytest
function, which calls :func:`simulate` for every parameter point. ``build/test/<module>-<point>`` keeps the log, the
results and the waveform of the last run.

The environment decides on ``SEED`` (default 1), from which all random numbers of cocotb, of NumPy and in registers
that are not reset come, on ``FULL=1`` (every parameter point, all vectors: ``make test-all``), on ``WAVES=1`` (a VCD
waveform) and, as always with cocotb, on ``COCOTB_TEST_FILTER``.
"""

import contextlib
import fcntl
import json
import logging
import os
from collections.abc import Iterator
from pathlib import Path
from unittest import mock
from xml.etree import ElementTree

import cocotb_tools.config
import pytest
from cocotb_tools.runner import get_runner
from polyshade.sim import tools, verilate
from polyshade.sim.model import glue
from polyshade.sim.sources import BUILD, Point, label, modules, yardsticks

SEED = int(os.environ.get("SEED", "1"))
WAVES = os.environ.get("WAVES", "0") not in ("", "0")
TESTS = Path(os.environ["NETLIST"]).parent / "test" if "NETLIST" in os.environ else BUILD / "test"
FULL = os.environ.get("FULL", "0") not in ("", "0")
NETLIST = Path(os.environ["NETLIST"]) if "NETLIST" in os.environ else None  # in place of the RTL: `make mutants`
MUTANTS = [int(number) for number in os.environ.get("MUTANTS", "").split(",") if number]  # faults of it, one by one
HANGS = 600  # seconds after which a process is given up: ten times what the slowest needs, never a measure of speed

# Registers that are not reset start with random bits: a missing reset shows.
SIMULATOR_FLAGS = ["+verilator+rand+reset+2", f"+verilator+seed+{SEED}"]


def simulate(module: str, point: Point, bench: str = "", public: tuple[str, ...] = ()) -> None:
    """Run every cocotb test of a bench, by default the module's own, on the module at a parameter point.

    Fails with the words of every cocotb test that failed, and when there was none to run. Example:
    ``simulate("shade_third", {"FORM": 0})`` runs the tests of ``tb.fixed.test_third``. ``public``: what the bench reads
    or writes inside of the module.
    """
    name = "-".join([module, *(f"{name}{value}" for name, value in point.items()), *["waves"] * WAVES])
    folder = TESTS / name
    folder.mkdir(parents=True, exist_ok=True)
    bench = bench or f"tb.{(modules() | yardsticks())[module].parent.name}.test_{module.removeprefix('shade_')}"
    with _locked(folder), mock.patch.dict(os.environ, tools.environment()):
        library, _ = verilate.build(module, point, glue, waves=WAVES, public=public, netlist=NETLIST)
        os.environ |= {"MODEL": str(library), "POINT": label(module, point)}
        _link(module, library, folder)
        if MUTANTS:
            Path(os.environ["KILLED"]).write_text(json.dumps([m for m in MUTANTS if _killed(m, module, bench, folder)]))
            return
        told = _faults(label(module, point), _run(module, bench, folder))
    if WAVES:
        print(f"waveform: {folder / 'dump.vcd'}")
    if told:
        pytest.fail("\n".join([*told, f"log: {folder / 'run.log'}"]), pytrace=False)


def _killed(mutant: int, module: str, bench: str, folder: Path) -> bool:
    """Does the bench fail with a fault of the netlist?"""
    os.environ["MUTANT"] = str(mutant)
    return bool(_faults(module, _run(module, bench, folder)))


def _faults(name: str, results: Path) -> list[str]:
    """The words of every cocotb test that failed, and of there being none."""
    cases = list(ElementTree.parse(results).iter("testcase")) if results.exists() else []
    told = [
        f"{name} {case.get('name')}: {_words(fault)}"
        for case in cases for fault in [*case.iterfind("failure"), *case.iterfind("error")]
    ]  # fmt: skip
    return told if cases else [f"{name}: no cocotb test ran to its end"]


def _words(fault: ElementTree.Element) -> str | None:
    """What a scoreboard says is enough; of any other exception the traceback is needed."""
    return fault.get("message") if fault.get("type") == "Mismatch" else fault.text


def _link(module: str, library: Path, folder: Path) -> None:
    """cocotb's main program with the model."""
    cocotb = Path(cocotb_tools.config.libs_dir)
    verilate.run(
        ["g++", "-o", folder / module, _main(), library, "-L", cocotb, "-lcocotbvpi_verilator",
         f"-Wl,-rpath,{cocotb}", "-Wl,--unresolved-symbols=ignore-in-shared-libs"],
        folder,
    )  # fmt: skip


def _run(module: str, bench: str, folder: Path) -> Path:
    """Simulate and return the results file, which is missing when the simulator broke down."""
    runner = get_runner("verilator")
    runner.log.setLevel(logging.CRITICAL)  # its words stand in the logs
    results = folder / "results.xml"
    results.unlink(missing_ok=True)
    with contextlib.suppress(SystemExit, RuntimeError):  # what failed stands in the results
        runner.test(
            test_module=bench, hdl_toplevel=module, hdl_toplevel_lang="verilog", build_dir=folder, test_dir=folder,
            seed=SEED, test_args=SIMULATOR_FLAGS, waves=WAVES, results_xml=str(results), log_file=folder / "run.log",
            extra_env={"COCOTB_REWRITE_ASSERTION_FILES": ""},  # rewriting takes two thirds of a short simulation
        )  # fmt: skip
    return results


@contextlib.contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """One process at a time in a folder."""
    with open(folder / "lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def _main() -> Path:
    """cocotb's main program for Verilator, compiled once for all models; tb/Vtop.h stands for the module."""
    source = Path(cocotb_tools.config.share_dir) / "lib" / "verilator" / "verilator.cpp"
    shim, root = Path(__file__).with_name("Vtop.h"), tools.verilator().root
    parts = (source.read_bytes(), shim.read_bytes(), str(root), tools.verilator().version, WAVES)
    path = TESTS / f"main-{verilate.key_of(*parts)}"
    with verilate.once(path) as scratch:
        if scratch:
            flags = [*verilate.CXX_FLAGS, *verilate.include(root), "-I", shim.parent, f"-DVM_TRACE={int(WAVES)}"]
            verilate.run(["g++", *flags, "-c", "-o", "main.o", source], scratch)
    return path / "main.o"


def points(*points: Point) -> pytest.MarkDecorator:
    """Parametrize a test over parameter points: ``test_third[WIDTH=8,FORM=0]``; ``[default]`` has no parameter set.

    From the third on they are left to ``make test-all``.
    """
    ids = [",".join(f"{name}={value}" for name, value in point.items()) or "default" for point in points]
    chosen = [pytest.param(point, marks=pytest.mark.full if i > 1 else ()) for i, point in enumerate(points)]
    return pytest.mark.parametrize("point", chosen, ids=ids)
