# SPDX-License-Identifier: Apache-2.0
"""``make mutants``: faults in every module that its own tests must see; left in ``build/mutants.json``.

    {"<module>": {generated, killed, equivalent, undecided, survived: [..], seed, named, seconds}}

Yosys chooses faults in the module's cells: an input or output bit that is inverted, stuck, or inverted where another
bit is 0 or 1. All of a module stand in one netlist with an input ``mutant_i`` that chooses one, so that they are
compiled once. A mutant is killed by the module's own tests, the cheapest first:

1. the vectors of its cases in ``sim/units``, the items of its stream,
2. the tests of its file that drive it with NumPy, or those of the module around it,
3. its cocotb bench, or the one of all units with gaps and resets, up to the first test that fails.

A survivor is set beside the module without a fault: ABC searches for inputs after a reset by which an output differs in
a clock in which it is valid. Where there are none it is ``equivalent``. The others ``survived``; of these ``undecided``
had no answer within ``SECONDS``. They count as survivors, as inputs are free there and need not be legal.

A module whose RTL and tests are as they were when it was judged is not judged again: a run that was interrupted goes
on where it ended. Each row says how long its judgement took.

``tb/floors.json`` holds what per cent of the mutants that are not equivalent each module's tests must kill; a run with
the default seed raises those of its modules. ``NAMED`` are faults of the RTL's text that tests once did not see.
"""

from __future__ import annotations

import contextlib
import inspect
import io
import itertools
import json
import math
import os
import re
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, field
from functools import cache
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pytest
from _pytest.runner import runtestprotocol
from polyshade import sim
from polyshade.golden.material import Material
from polyshade.scripts.flow import formal, soak, tools
from polyshade.scripts.report import save
from polyshade.sim import patch
from polyshade.sim.errors import UserError
from polyshade.sim.sources import BUILD, ROOT, Point, label, modules
from polyshade.sim.units import Case, Stream, cases, streams
from polyshade.sim.units.case import Arrays
from polyshade.sim.verilate import key_of, once, ports, reached
from tqdm import tqdm

OUT = BUILD / "mutants.json"
WORK = BUILD / "mutants"
FLOORS = ROOT / "tb" / "floors.json"
COUNT = 60  # mutants of a module
SEED = 1
SMALL = 3_000_000  # bytes of a netlist with which a search for a difference leaves nothing out
SECONDS = 6  # of a search for a difference
ITEMS = 300  # of a stream
VECTORS = (2_000, 1 << 18)  # of a case: for all mutants; for those that live on, all of 18 input bits
NONE = ("shade_assert", "shade_stable")  # assertions alone: synthesis and mutants leave them out
CUT = ("shade_mul", "shade_rsqrt", "shade_rsqrt_rom")  # parts that a search for a difference cuts out
PARTS = "shade_patch"  # the parts of this one are tested in it
AROUND = {"shade_setup_": "shade_spans", "shade_scene_": "shade_scene"}  # parts without tests are tested in these
POINTS: dict[str, Point] = {  # at which tests have a module, where its default is none
    PARTS: {"LANES": 2},
    "shade_scene": {"COLUMNS_LOG2": 6, "LINES_LOG2": 6, "DOUBLE": 0},
    "shade_widen": {"IN_W": 8, "OUT_W": 16},
}
CLOCKS = 2_000_000  # of a run, after which a mutant hangs
SLOW = 3.0  # seconds of a test that is left out


NAMED: dict[str, dict[str, tuple[str, str]]] = {  # of a module: what is wrong, a text of its source, what replaces it
    "shade_gain": {"light that rounds up to 2 becomes 0": (" || rounded[F+1]", "")},
    "shade_node_walk": {
        "no saturation at the end of the range": ("sum[W] == sum[W-1] ? W'(sum) : {1'b0, {(W - 1) {1'b1}}}", "W'(sum)"),
        "a reset leaves a node": ("valid_q             <= !rst_i && go_q;", "valid_q <= go_q;"),
    },
    "shade_lane": {"the other path's credits": ("record_taken && !pixels", "record_taken")},
    "shade_fifo": {
        "a reset leaves a credit": ("taken_o       <= 1'b0;", ""),
        "one place fewer is free": (
            "assign read = write_q != read_q && room;",
            "assign read = write_q != read_q && room && ~&read_q;",
        ),
    },
    "shade_credit": {"a reset leaves credits spent": ("rst_i ? ALL : credit_d", "credit_d")},
}


@dataclass(frozen=True)
class Target:
    """A module with faults, and the module, itself or one around it, that is simulated."""

    module: str
    top: str
    point: Point
    bench: str = ""
    file: Path | None = None  # with tests that drive it with NumPy

    @property
    def cases(self) -> list[Case]:
        """The cases of the top at its point."""
        return [case for case in cases() if case.module == self.top and case.parameters == self.point]


def targets() -> list[Target]:
    """Every module with what it is tested by."""
    known = {stream.module: stream for stream in reversed([*streams()])}
    points = {case.module: case.parameters for case in reversed(cases()) if case.parameters.get("DEPTH") != 0}
    points |= {module: stream.parameters for module, stream in known.items()} | POINTS
    found = []
    for module in modules():
        inner = module.startswith(f"{PARTS}_") and module not in points
        own, top = _tests(modules()[module]), PARTS if inner else module
        if not own.exists() and module not in points:
            top = next((around for part, around in AROUND.items() if module.startswith(part)), top)
        around = _tests(modules()[top])
        text = own.read_text() if own.exists() else ""
        first = "[default]" if "def test_cocotb(point)" in text else ""
        bench = f"{own.relative_to(ROOT)}::test_cocotb{first}" if "def test_cocotb(" in text else ""
        if module in known:
            bench = f"tb/test_units.py::test_stream_cocotb[{label(module, points[module])}]"
        driven = around if around.exists() and "sim.load(" in around.read_text() and top != PARTS else None
        if module not in NONE:
            found.append(Target(module, top, points.get(top, {}), "" if top != module else bench, driven))
    return found


def _tests(path: Path) -> Path:
    return ROOT / "tb" / path.parent.name / f"test_{path.stem.removeprefix('shade_')}.py"


class Differs(UserError):
    """A module fails its tests without a fault."""


# ---- the netlist with all of them ----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Netlist:
    """``netlist.v``, ``netlist.il`` and what each mutant is, from 1 on."""

    folder: Path
    mutants: list[str]

    @property
    def verilog(self) -> Path:
        return self.folder / "netlist.v"


def told(line: str) -> str:
    """A mutant as the report tells it: ``shade_fifo.sv:43 cnot0 $add Y[4] (write_q)``."""
    chosen = dict(re.findall(r"-(\w+) (\S+)", line))
    places = re.findall(r"-src \S*/(\w+\.sv:\d+)", line) or [chosen["module"]]
    kind = re.sub(r"\$.*", "", chosen["cell"].lstrip("$"))
    wire = f" ({chosen['wire']}[{chosen['wirebit']}])" if "wire" in chosen else ""
    return f"{places[-1]} {chosen['mode']} {kind} {chosen['port']}[{chosen['portbit']}]{wire}"


def netlist(target: Target, count: int, seed: int) -> Netlist:
    """The faults of a module in one netlist, made unless it is there."""
    files = reached(target.top)
    parts = (
        target,
        count,
        seed,
        [path.read_bytes() for path in files],
        inspect.getsource(_netlist),
        inspect.getsource(_read),
        version("pyosys"),
    )
    key = key_of(*parts)
    path = WORK / f"{target.module}-{key}"
    with once(path) as scratch:
        if scratch:
            _netlist(target, files, count, seed, scratch)
    return Netlist(path, json.loads((path / "mutants.json").read_text()))


def base(name: str) -> str:
    """``$paramod\\shade_mul\\A_W=s32'...``, Yosys' name of a module at a point, is one of ``shade_mul``."""
    found = re.search(r"shade_\w+|yardstick_\w+", name)
    return found[0] if found else name


def _read(target: Target, files: list[Path], folder: Path, changed: dict[str, str]) -> None:
    """``plain.il``: the module that is simulated, at its point; ``changed``: other texts of some files."""
    (folder / "rtl").mkdir()
    for path in files:
        (folder / "rtl" / path.name).write_text(changed.get(path.name) or path.read_text())
    chosen = tools.chparam(target.point)
    script = f"""
        read_verilog -noassert -sv {" ".join(f"rtl/{path.name}" for path in files)}
        hierarchy -check -top {target.top}{chosen}
        rename -top {target.top}
        proc
        opt -purge
        memory_collect
        opt_clean
        write_rtlil plain.il
    """
    tools.yosys(script, folder)


def _netlist(target: Target, files: list[Path], count: int, seed: int, folder: Path) -> None:
    _read(target, files, folder, {})
    text = (folder / "plain.il").read_text()
    names = re.findall(r"^module (\S+)$", text, re.MULTILINE)
    ours = [name for name in names if base(name) == target.module]
    if not ours:
        raise UserError(f"{target.module}: not in {target.top}")
    where = " ".join(ours)
    tools.yosys(f"read_rtlil plain.il\nmutate -list {count} -seed {seed} -o list.txt {where}\n", folder)
    lines = (folder / "list.txt").read_text().splitlines()
    bits = max(1, len(lines).bit_length())
    faults = [
        line.replace("mutate ", f"mutate -ctrl mutant_i {bits} {number} ", 1) for number, line in enumerate(lines, 1)
    ]
    tools.yosys(
        "\n".join(
            ["read_rtlil plain.il", *faults, "opt_clean", "write_rtlil netlist.il", "write_verilog -noattr bare.v"]
        ),
        folder,
    )
    # a fault may choose two ways of a case at once, which is for the tests to see, not for the simulator
    text = (folder / "bare.v").read_text().replace("// synopsys parallel_case", "")
    (folder / "netlist.v").write_text(_with_parameters(target, text, folder))
    _alone(target, names, folder)
    (folder / "mutants.json").write_text(json.dumps([told(line) for line in lines]))
    for name in ("plain.il", "bare.v"):
        (folder / name).unlink()


def _with_parameters(target: Target, text: str, folder: Path) -> str:
    """The top with its parameters, which Yosys takes out and benches read."""
    ports(target.top, target.point, folder)
    tree = json.loads((folder / "tree.json").read_text())
    top = next(module for module in tree["modulesp"] if module["name"] == target.top)
    given = []
    for item in top["stmtsp"]:
        if item.get("varType") == "GPARAM":
            base, number = re.fullmatch(r"\d+'s?([hd])(\w+)", item["valuep"][0]["name"]).groups()
            given.append(f"  parameter {item['name']} = {int(number, 16 if base == 'h' else 10)};\n")
    return re.sub(rf"^(module {target.top}\(.*?\);\n)", lambda head: head[1] + "".join(given), text, flags=re.M | re.S)


# ---- the tests -----------------------------------------------------------------------------------------------------


def _frames(_model: sim.Model) -> bool:
    """Triangles of all kinds through ``shade_patch``: equal?"""
    for model, seed in (("blinn", 1), ("lambert", 2), ("blinn", 3)):
        given = soak.triangles(np.random.default_rng(seed), 120)
        light = soak.direction(np.random.default_rng(seed))
        made = patch.draw(given, Material(model, 100), light, lanes=2, seed=seed, out_stall=0.2 * (seed != 3))
        if made.mismatches or made.counter_mismatches:
            return False
    return True


def _equal(stream: Stream) -> Callable[[sim.Model], bool]:
    """Items of all kinds through a module, without pauses and with them: equal?"""
    runs = [(pause, kind) for kind in stream.usual or stream.kinds for pause in ((), (0.3, 0.3))]
    return lambda model: (
        not any(stream.check(ITEMS, 1, *pause, kind=kind, model=model).mismatches for pause, kind in runs)
    )


@cache
def whole_streams() -> dict[str, Callable[[sim.Model], bool]]:
    """What runs a whole stream through a module, by module; not those that NumPy cannot drive."""
    able = {s.module: s for s in reversed([*streams()]) if not (s.credits or s.apart[0])}
    return {PARTS: _frames} | {module: _equal(stream) for module, stream in able.items()}


def thinned(chunks: Iterator[Arrays], rows: int) -> Iterator[Arrays]:
    """About so many rows of each chunk, in odd steps, so that every bit changes."""
    for inputs in itertools.islice(chunks, 64):
        step = len(next(iter(inputs.values()))) // rows | 1
        yield {name: values[::step] for name, values in inputs.items()}


def by_cases(target: Target, faults: Netlist, alive: list[int], vectors: int) -> Iterator[int]:
    """The mutants that the vectors of the module's cases kill."""
    model = sim.load(target.top, **target.point)
    alive = list(alive)
    for case in target.cases:
        chunks = case.stream(vectors, SEED)
        for inputs in thinned(chunks, vectors) if case.all_vectors else chunks:
            golden = case.golden(inputs)
            model.mutant, model.most = 0, sim.model.NEVER
            if case.compare(model, inputs, golden, SEED).mismatches:
                raise Differs(f"{target.module}: differs from the golden model without a fault")
            model.most = 4 * len(next(iter(inputs.values()))) * case.clocks_per_vector + 10_000
            for mutant in list(alive):
                model.mutant = mutant
                try:
                    killed = case.compare(model, inputs, golden, SEED).mismatches
                except sim.SimulationError:
                    killed = True
                if killed:
                    alive.remove(mutant)
                    yield mutant


def by_stream(target: Target, faults: Netlist, alive: list[int]) -> Iterator[int]:
    """The mutants that a whole stream through the module kills."""
    model, check = sim.load(target.top, **target.point), whole_streams()[target.top]
    model.mutant, model.most = 0, sim.model.NEVER
    if not check(model):
        raise Differs(f"{target.module}: differs from the golden model without a fault")
    model.most = CLOCKS
    for mutant in alive:
        model.mutant = mutant
        try:
            killed = not check(model)
        except Exception:  # a stream that is torn is no packet any more, and what unpacks it may fail in any way
            killed = True
        if killed:
            yield mutant


@dataclass
class Mutants:
    """A plugin of pytest: every test with each mutant that lives on, from 0, none, on."""

    target: Target
    faults: Netlist
    alive: list[int]
    dead: list[int] = field(default_factory=list)
    taken: bool = False  # the test has loaded the netlist

    def netlist(self, module: str, point: Point) -> Path | None:
        if module != self.target.top:
            return None
        if point != self.target.point:
            pytest.skip("another point")
        self.taken = True
        return self.faults.verilog

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        model = sim.load(self.target.top, **self.target.point)
        for item in session.items:
            if "cocotb" in item.name:
                continue
            model.mutant, model.most, self.taken = 0, sim.model.NEVER, False
            began = time.monotonic()
            if _fails(item):
                raise Differs(f"{self.target.module}: {item.nodeid} fails without a fault")
            if not self.taken or time.monotonic() - began > SLOW:
                continue
            model.most = CLOCKS
            for model.mutant in [mutant for mutant in self.alive if mutant not in self.dead]:
                if _fails(item):
                    self.dead.append(model.mutant)
        return True


def _fails(item: pytest.Item) -> bool:
    return any(report.failed for report in runtestprotocol(item, log=False, nextitem=None))


def by_file(target: Target, faults: Netlist, alive: list[int]) -> Iterator[int]:
    """The mutants that the NumPy-driven tests of a file kill."""
    plugin = Mutants(target, faults, alive)
    chosen = ["-q", "-n", "0", "--timeout", "0", "-p", "no:cacheprovider", str(target.file)]
    with sim.netlists(plugin.netlist), contextlib.redirect_stdout(io.StringIO()):
        code = pytest.main(chosen, [plugin])
    if code not in (pytest.ExitCode.OK, pytest.ExitCode.NO_TESTS_COLLECTED):
        raise Differs(f"{target.module}: {target.file.name} did not run, pytest told {code}")
    yield from plugin.dead


def by_bench(target: Target, faults: Netlist, alive: list[int]) -> Iterator[int]:
    """The mutants that a cocotb bench kills."""
    tests = [target.bench] if target.bench else []
    if any(not case.own_bench for case in target.cases):
        tests.insert(0, f"tb/test_units.py::test_cocotb[{label(target.top, target.point)}]")

    alive = [0, *alive]  # 0: without a fault
    for test in tests:
        path = faults.folder / f"killed-{os.getpid()}.json"
        path.unlink(missing_ok=True)
        more = {"MUTANTS": ",".join(map(str, alive)), "NETLIST": str(faults.verilog), "KILLED": str(path)}
        more["COCOTB_MAX_FAILURES"] = "1"
        command = [sys.executable, "-m", "pytest", "-q", "-n", "0", "--timeout", "0", "-p", "no:cacheprovider", test]
        done = subprocess.run(command, cwd=ROOT, env=os.environ | more, capture_output=True, text=True)
        if not path.exists():
            (faults.folder / "bench.log").write_text(done.stdout + done.stderr)
            raise UserError(f"{faults.folder / 'bench.log'}: {test} did not run")
        dead = json.loads(path.read_text())
        if 0 in dead:
            raise Differs(f"{target.module}: {test} fails without a fault")
        yield from dead
        alive = [mutant for mutant in alive if mutant not in dead]


def exhausted(target: Target, faults: Netlist, alive: list[int]) -> bool:
    """Every input of a module without feedback was driven, and no mutant differs: they are equivalent.

    Modules with a reset are left out, and those of a million inputs or more.
    """
    every = [case for case in target.cases if case.all_vectors and not case.ordered]
    if not every or sim.load(target.top, **target.point).interface.reset:
        return False
    rows = sum(len(next(iter(inputs.values()))) for inputs in itertools.islice(every[0].all_vectors(), 5))
    return rows <= 1 << 21 and not set(by_cases(target, faults, alive, 1 << 21))


# ---- survivors -----------------------------------------------------------------------------------------------------


def _alone(target: Target, names: list[str], folder: Path) -> None:
    """``alone.il`` and ``alone.v``: the module, its simple parts dissolved, others cut out; ``whole``: all dissolved.

    What goes into a part that is cut out becomes an output, what comes from it an input.
    """
    simple = {path.stem for path in modules().values() if path.parent.name == "fixed"} - set(CUT)
    whole = [name for name in names if base(name) == target.module]
    kept = [name for name in names if base(name) not in simple and name not in whole]
    keep = [f"setattr -mod -set keep_hierarchy 1 {name}" for name in kept]
    steps = [
        "read_rtlil netlist.il", *keep, f"hierarchy -top {whole[0]}", "flatten", f"select {whole[0]}", "expose -evert",
        "select -clear", f"rename {whole[0]} alone", "delete alone %n", "opt_clean", "write_rtlil alone.il",
        "write_verilog -noattr alone.v",
    ]  # fmt: skip
    tools.yosys("\n".join(steps), folder)
    apart = any(base(name) not in simple and name not in whole for name in names)  # else they are the same
    if apart and target.top == target.module and (folder / "netlist.il").stat().st_size < SMALL:
        steps = [line.replace("alone", "whole") for line in steps if not re.match("setattr|expose", line)]
        tools.yosys("\n".join(steps), folder)


def difference(target: Target, faults: Netlist, mutant: int, seconds: int = SECONDS) -> str:
    """``equivalent``, ``different``, or ``undecided``: can an output that is valid differ, after a reset?

    Looked for with parts cut out, whose outputs are free, which is quick; and if one differs there, in a small module
    with its parts.
    """
    answer = _difference("alone", faults, mutant, seconds)
    if answer == "equivalent" or not (faults.folder / "whole.il").exists():
        return answer
    return _difference("whole", faults, mutant, seconds)


def _difference(design: str, faults: Netlist, mutant: int, seconds: int) -> str:
    folder = faults.folder / f"{design}-{mutant}"
    folder.mkdir(exist_ok=True)
    text = (faults.folder / f"{design}.v").read_text()
    found = re.findall(r"^  (input|output) (?:signed )?(\[\d+:\d+\] )?(\S+ ?);", text, re.MULTILINE)
    ports = {name: (way, width or "[0:0] ") for way, width, name in found if name != "mutant_i"}
    ins, outs = ([name for name, (way, _) in ports.items() if way == kind] for kind in ("input", "output"))
    valid = "valid_o" if "valid_o" in outs else ""
    masked = {name for name in outs if valid and re.fullmatch(r"(?!ready|taken|credit)\w+_o", name)} - {valid}
    clocked = "clk_i" in ins

    def side(letter: str, number: int) -> str:
        given = [f".{name}({'rst' if name == 'rst_i' else name})" for name in ins]
        given += [f".mutant_i({number})", *(f".{name}({letter}{i})" for i, name in enumerate(outs))]
        return f"  {design} u_{letter} ({', '.join(given)});\n"

    wires = "".join(f"  wire {ports[name][1]}a{i}, b{i};\n" for i, name in enumerate(outs))
    shown = f"a{outs.index(valid)}" if valid else "1"
    same = " && ".join(
        f"({f'!{shown} || ' * (n in masked)}a{i} === b{i})".replace("===", "==") for i, n in enumerate(outs)
    )
    begun = "reg begun_q = 0;\n  always @(posedge clk_i) begun_q <= 1;" if clocked else "wire begun_q = 1;"
    (folder / "miter.v").write_text(
        f"module miter({', '.join(f'input {ports[name][1]}{name}' for name in ins)});\n  {begun}\n"
        + "  wire rst = rst_i | !begun_q;\n" * ("rst_i" in ins)
        + wires + side("a", 0) + side("b", mutant)
        + f"  always @({'posedge clk_i' if clocked else '*'}) if (begun_q) same: assert ({same});\nendmodule\n"
    )  # fmt: skip
    script = f"""
        read_rtlil ../{design}.il
        read_verilog -formal -sv miter.v
        prep -flatten -top miter
        memory_map
        async2sync
        dffunmap
        chformal -lower
        zinit -all
        opt -full
        formalff -clk2ff
        setundef -zero
        opt -fast
        techmap
        setundef -zero
        aigmap
        opt_clean
        write_aiger -B -I -zinit proof.aig
    """
    tools.yosys(script, folder)
    log = formal.abc(f"scorr; dc2; bmc3 -F 60 -T {seconds // 3}; pdr -T {seconds}; sat", folder, 2 * seconds)
    if re.search(r"was asserted in frame|^SATISFIABLE", log, re.MULTILINE):
        return "different"
    return "equivalent" if re.search(r"Property proved|^UNSATISFIABLE", log, re.MULTILINE) else "undecided"


# ---- the whole -----------------------------------------------------------------------------------------------------


def engines(target: Target, bench: bool) -> list[Callable[[Netlist, list[int]], Iterable[int]]]:
    """What kills mutants of a module, the cheapest first."""
    found: list[Callable[[Netlist, list[int]], Iterable[int]]] = []
    if target.cases:
        found += [lambda faults, alive, v=v: by_cases(target, faults, alive, v) for v in VECTORS]
    if target.top in whole_streams():
        found.append(lambda faults, alive: by_stream(target, faults, alive))
    if target.file:
        found.append(lambda faults, alive: by_file(target, faults, alive))
    if bench and (target.bench or any(not case.own_bench for case in target.cases)):
        found.append(lambda faults, alive: by_bench(target, faults, alive))
    return found


def named(target: Target, what: str) -> bool:
    """Is a fault of the RTL's text killed?"""
    old, new = NAMED[target.module][what]
    path = modules()[target.module]
    if (places := path.read_text().count(old)) != 1:
        raise UserError(f"{target.module}: {places} places have the text of the fault {what!r}, allowed is one")
    files = reached(target.top)
    key = key_of(target, what, old, new, [file.read_bytes() for file in files], inspect.getsource(_read))
    folder = WORK / f"{target.module}-{key}"
    with once(folder) as scratch:
        if scratch:
            _read(target, files, scratch, {path.name: path.read_text().replace(old, new)})
            tools.yosys("read_rtlil plain.il\nwrite_verilog -noattr bare.v\n", scratch)
            (scratch / "netlist.v").write_text(_with_parameters(target, (scratch / "bare.v").read_text(), scratch))
    faults = Netlist(folder, [])
    with sim.netlists(lambda module, point: faults.verilog):
        try:
            for engine in engines(target, True):
                list(engine(faults, []))
        except (Differs, sim.SimulationError):
            return True
    return False


def judge(target: Target, count: int = COUNT, seed: int = SEED, bench: bool = True, decide: bool = True) -> dict:
    """The report of a module."""
    faults, began = netlist(target, count, seed), time.monotonic()
    alive = list(range(1, len(faults.mutants) + 1))
    quick = engines(target, False)
    benches = engines(target, bench)[len(quick) :]
    answers: dict[int, str] = {}

    def attack(engine: Callable[[Netlist, list[int]], Iterable[int]]) -> None:
        able = [mutant for mutant in alive if answers.get(mutant) != "equivalent"]
        dead = set(engine(faults, able)) if able else set()
        alive[:] = [mutant for mutant in alive if mutant not in dead]

    def settle() -> None:
        for mutant in [mutant for mutant in alive if mutant not in answers] if decide else ():
            answers[mutant] = difference(target, faults, mutant)

    with sim.netlists(lambda module, point: faults.verilog):
        for engine in quick:
            attack(engine)
        if alive and exhausted(target, faults, alive):
            answers = dict.fromkeys(alive, "equivalent")
        if quick:  # cheaper than a bench, which kills none that is equivalent
            settle()
        for engine in benches:
            attack(engine)
    settle()
    equal = [mutant for mutant, answer in answers.items() if answer == "equivalent"]
    survived = [mutant for mutant in alive if mutant not in equal]
    return {
        "generated": len(faults.mutants),
        "killed": len(faults.mutants) - len(alive),
        "equivalent": len(equal),
        "undecided": sum(answers.get(mutant, "undecided") == "undecided" for mutant in survived),
        "survived": [
            f"{mutant}: {faults.mutants[mutant - 1]}: {answers.get(mutant, 'undecided')}" for mutant in survived
        ],
        "seed": seed,
        "named": {what: named(target, what) for what in NAMED.get(target.module, {})} if bench else {},
        "seconds": round(time.monotonic() - began, 1),
    }


def share(row: dict) -> float:
    """Per cent of the mutants that are not equivalent that were killed."""
    real = row["generated"] - row["equivalent"]
    return 100 * row["killed"] / real if real else 100.0


def floors() -> dict[str, float]:
    """Per cent that must be killed, of every module."""
    return json.loads(FLOORS.read_text()) if FLOORS.exists() else {}


def main(names: list[str] | None = None, count: int = COUNT, seed: int = SEED) -> int:
    """Judge the named modules (all without a name); 1 where fewer mutants are killed than the floor says."""
    known = {target.module: target for target in targets()}
    for name in names or []:
        if name not in known:
            raise UserError(f"{name}: no module with mutants, allowed {', '.join(known)}")
    if not 1 <= count <= 10_000:
        raise UserError(f"--count: {count} is out of range, allowed is 1 to 10000")
    wanted = [known[name] for name in names] if names else list(known.values())
    report: dict[str, dict] = {}
    WORK.mkdir(parents=True, exist_ok=True)
    with ProcessPoolExecutor(int(os.environ.get("JOBS") or os.cpu_count())) as pool:
        running = {pool.submit(_job, target, count, seed): target.module for target in wanted}
        for done in tqdm(as_completed(running), "mutants", len(running), disable=None):
            report[running[done]] = done.result()
            if not names:  # an interrupted run leaves what it has
                save(OUT, {name: report[name] for name in known if name in report})
    limits, low = floors(), []
    for name in (name for name in known if name in report):
        row = report[name]
        counts = f"{row['killed']:3} killed of {row['generated']:3}, {row['equivalent']:3} equivalent"
        print(f"{name:24} {counts}: {share(row):.1f} %")
        for line in row["survived"]:
            print(f"  survived {line}")
        low += [f"{name}: {what}: not killed" for what, killed in row["named"].items() if not killed]
        if seed == SEED and count == COUNT and share(row) < limits.get(name, 0):
            low.append(f"{name}: {share(row):.1f} % of its mutants killed, {limits[name]} % needed")
    if seed == SEED and count == COUNT and not low:
        raised = {name: max(limits.get(name, 0), math.floor(10 * share(row)) / 10) for name, row in report.items()}
        save(FLOORS, {name: (limits | raised)[name] for name in known if name in limits | raised})
    total = {key: sum(row[key] for row in report.values()) for key in ("generated", "killed", "equivalent")}
    counts = f"{total['killed']} killed, {total['equivalent']} equivalent"
    print(f"{total['generated']} mutants, {counts}: {share(total):.2f} %")
    for line in low:
        print(line)
    return 1 if low else 0


def _job(target: Target, count: int, seed: int) -> dict:
    files = [target.file, *([ROOT / target.bench.partition("::")[0]] if target.bench else [])]
    files += [*(ROOT / "tb").glob("*.py"), *(ROOT / "sim" / "units").glob("*.py")]
    tests = [path.read_bytes() for path in sorted({path for path in files if path})]
    key = key_of(
        target,
        seed,
        [path.read_bytes() for path in reached(target.top)],
        tests,
        NAMED.get(target.module),
        VECTORS,
        ITEMS,
    )
    path = WORK / f"{target.module}-{count}-{key}.json"
    if not path.exists():
        save(path, judge(target, count, seed))
    return json.loads(path.read_text())
