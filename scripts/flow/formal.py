# SPDX-License-Identifier: Apache-2.0
"""``make formal``: properties of the modules with flow control, and of small arithmetic; left in ``build/formal.json``.

    [{module, property, engine, depth, result, seconds, meaning, assumptions, mutant}]

A proof is a module ``formal_<name>`` in ``tb/formal`` around the RTL. Labels of its immediate assertions are the
properties, the comment above a label is its meaning; ``assume`` is what the surroundings must keep. Yosys makes an
and-inverter graph of it in which every register starts in any state, and ABC proves it:

``pdr``      unbounded: holds in every clock that can be reached. ``depth``: frames that the proof took
``window``   of a pipeline without feedback: holds in every clock, as a result depends on the ``depth`` clocks before it
``bmc``      holds for ``depth`` clocks after a reset: ``bounded``

``failed``: there is a counterexample, or no engine ended with an answer. Beside each property stands a mutant, a change
of the RTL by which it must fail (``// mutant: OLD => NEW``): ``mutant`` tells whether it did, so that no property is
one that cannot fail. (null: an assertion in the RTL itself, which its benches provoke.)
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from polyshade.golden import contract as k
from polyshade.scripts.flow import tools
from polyshade.scripts.report import save
from polyshade.sim.errors import UserError
from polyshade.sim.sources import BUILD, ROOT, Point, label
from polyshade.sim.verilate import reached
from tqdm import tqdm

OUT = BUILD / "formal.json"
WORK = BUILD / "formal"
PROOFS = ROOT / "tb" / "formal"
LABEL = re.compile(r"((?:^ *//.*\n)*)^.*?\b(\w+) : (assert|assume) \(", re.MULTILINE)
MUTANT = re.compile(r"// mutant: (.*?) => (.*)$", re.MULTILINE)


@dataclass(frozen=True)
class Proof:
    """One wrapper at one parameter point. ``modules``: those it is about; the first one names the report's entries."""

    name: str
    modules: tuple[str, ...]
    point: Point = field(default_factory=dict)
    window: int = 0  # clocks of a pipeline without feedback
    depth: int = 0  # clocks to fall back to where pdr does not end
    seconds: int = 300  # for each engine
    quick: bool = True  # part of `make test`

    @property
    def title(self) -> str:
        """``formal_fifo[LOG2=3]``."""
        return label(f"formal_{self.name}", self.point)

    @property
    def source(self) -> Path:
        """The wrapper."""
        return PROOFS / f"formal_{self.name}.sv"

    def labels(self, kind: str) -> dict[str, str]:
        """The labels of a kind, assert or assume, each with the comment above it, or above the one before."""
        found, meaning = {}, ""
        for comment, name, what in LABEL.findall(self.source.read_text()):
            words = re.sub(r"^ *// ?", "", MUTANT.sub("", comment), flags=re.MULTILINE).split()
            meaning = " ".join(words) or meaning
            if what == kind:
                found[name] = meaning
        return found

    @property
    def mutants(self) -> dict[str, tuple[str, str]]:
        """Of every property a text of the RTL and what replaces it."""
        found = LABEL.findall(self.source.read_text())
        return {name: match.groups() for comment, name, _ in found if (match := MUTANT.search(comment))}


LIMITS = ("shade_saturate", "shade_limit", "shade_clamp")
ALL = [
    *(Proof("fifo", ("shade_fifo",), {"LOG2": log2, "BLOCK": block}) for log2 in (1, 2) for block in (0, 1)),
    *(Proof("fifo", ("shade_fifo",), {"LOG2": 3, "BLOCK": block}, quick=False) for block in (0, 1)),
    Proof("credit", ("shade_credit",)),
    Proof("walk", ("shade_walk",)),
    Proof("walk", ("shade_walk",), {"CREDIT_LOG2": 3, "COUNT_W": 5}),
    Proof("span_walk", ("shade_span_walk",), quick=False),
    Proof("node_walk", ("shade_node_walk",), depth=12, quick=False),
    Proof("door", ("shade_door",)),
    Proof("room", ("shade_patch_room",)),
    Proof("widen", ("shade_widen",)),
    Proof("direct_door", ("shade_direct_door",), seconds=60),
    Proof("registers", ("shade_registers",), depth=40, quick=False),
    Proof("collect", ("shade_collect",), quick=False),
    *(
        Proof("round", ("shade_round",), point, 1)
        for point in ({}, {"WIDTH": 20, "DROP": 1}, {"WIDTH": 20, "DROP": 19})
    ),
    *(Proof("saturate", LIMITS, point, 1) for point in ({}, {"WIDTH": 18, "OUT_W": 2}, {"WIDTH": 20, "OUT_W": 18})),
    *(
        Proof("third", ("shade_third",), {"WIDTH": width, "FORM": form}, k.LATENCY_THIRD + 1, quick=width < 18)
        for width in (9, 18)
        for form in (1, 0)
    ),
    Proof("third", ("shade_third",), {"WIDTH": 20, "FORM": 0}, k.LATENCY_THIRD + 1, quick=False),
    Proof("weigh", ("shade_weigh",), {}, k.LATENCY_WEIGH + 1),
]


def sources(proof: Proof) -> list[Path]:
    """The RTL that a proof reads, in order."""
    return list(dict.fromkeys(path for module in proof.modules for path in reached(module)))


def graph(proof: Proof, folder: Path, files: list[Path]) -> list[str]:
    """Write ``proof.aig`` into the folder; return the names of its properties, in the order of its outputs."""
    chosen = tools.chparam(proof.point)
    top = f"formal_{proof.name}"
    script = f"""
        read_verilog -sv -formal {" ".join(map(str, files))} {proof.source}
        hierarchy -check -top {top}{chosen}
        prep -flatten -top {top}
        memory_map
        async2sync
        dffunmap
        chformal -lower
        opt -full
        formalff -clk2ff -ff2anyinit
        setundef -anyseq
        opt -fast
        techmap
        setundef -anyseq
        aigmap
        opt_clean
        write_aiger -B -I -zinit -ywmap proof.json proof.aig
    """
    tools.yosys(script, folder)
    # the name of a label, or of the instance of shade_assert in which an assertion stands
    asserts = json.loads((folder / "proof.json").read_text())["asserts"]
    return [re.sub(r"\$flatten|u_dut\.|\.?\$assert.*", "", ".".join(path).replace("\\", "")) for path in asserts]


def feedback(module: str, folder: Path) -> bool:
    """Has a module a loop through its registers? Looked for with wires in their place."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "wire.v").write_text("module \\$_DFF_P_ (input C, input D, output Q);\n  assign Q = D;\nendmodule\n")
    script = f"""
        read_verilog -sv {" ".join(map(str, reached(module)))}
        hierarchy -check -top {module}
        proc
        flatten
        dffunmap
        simplemap
        techmap -map wire.v
        select -assert-none t:$_DFF_*
        opt_clean
        scc
    """
    return "Found 0 SCCs" not in tools.yosys(script, folder)


def abc(commands: str, folder: Path, seconds: int) -> str:
    """Run ABC in a folder and return what it prints. Raises UserError where it is missing."""
    import pyosys

    program = Path(pyosys.__file__).parent / "yosys-abc"
    if not program.exists():
        raise UserError("yosys-abc: missing, a part of the package pyosys, install with: make distclean setup")
    command = [str(program), "-c", f"read_aiger proof.aig; fold; strash; {commands}"]
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=seconds + 60)
    except subprocess.TimeoutExpired:
        return ""
    (folder / "abc.log").write_text(done.stdout + done.stderr)
    return done.stdout


def prove(proof: Proof, folder: Path, names: list[str]) -> dict[str, tuple[str, int, str]]:
    """Of every property engine, depth and result."""
    if proof.window:
        return bounded(proof, folder, names, "window", proof.window, "proven")
    log = abc(f"scorr; pdr -a -T {proof.seconds}", folder, proof.seconds)
    found = {name: ("pdr", int(at), "failed") for name, at in asserted(names, log).items()}
    depth = max(map(int, re.findall(r"^Invariant F\[(\d+)\]", log, re.MULTILINE)), default=1)
    proved = [names[int(number)] for number in re.findall(r"^Proved output +(\d+)", log, re.MULTILINE)]
    found |= dict.fromkeys(proved, ("pdr", depth, "proven"))
    if proof.depth and len(found) < len(names):
        found = bounded(proof, folder, names, "bmc", proof.depth, "bounded") | found
    return {name: found.get(name, ("pdr", 0, "failed")) for name in names}


def bounded(
    proof: Proof, folder: Path, names: list[str], engine: str, depth: int, passed: str
) -> dict[str, tuple[str, int, str]]:
    """The same by search for a counterexample of at most ``depth`` clocks."""
    frames = depth + 1  # a clock's assertions are looked at in the next one
    log = abc(f"bmc3 -a -F {frames} -T {proof.seconds}", folder, proof.seconds)
    found = {name: (engine, int(at), "failed") for name, at in asserted(names, log).items()}
    ended = re.search(rf"(in|after) {frames} frames", log)
    return {name: found.get(name, (engine, depth, passed) if ended else (engine, 0, "failed")) for name in names}


def asserted(names: list[str], log: str) -> dict[str, str]:
    """The properties with a counterexample, and its number of clocks."""
    pattern = r"^Output +(\d+) was asserted in frame +(\d+)"
    return {names[int(number)]: at for number, at in re.findall(pattern, log, re.MULTILINE)}


def check(proof: Proof) -> list[dict]:
    """The rows of a proof, without mutants."""
    folder = WORK / re.sub(r"\W+", "_", proof.title)
    shutil.rmtree(folder, ignore_errors=True)
    began = time.perf_counter()
    if proof.window and any(feedback(module, folder / "feedback") for module in proof.modules):
        raise UserError(f"{proof.title}: not a pipeline without feedback, a window does not prove it")
    results = prove(proof, folder, graph(proof, folder, sources(proof)))
    spent = (time.perf_counter() - began) / len(results)
    meanings, assumptions = proof.labels("assert"), proof.labels("assume")
    return [
        {
            "module": label(proof.modules[0], proof.point),
            "property": name,
            "engine": engine,
            "depth": depth,
            "result": result,
            "seconds": round(spent, 2),
            "meaning": meanings.get(name, "an assertion in the RTL"),
            "assumptions": assumptions,
        }
        for name, (engine, depth, result) in results.items()
    ]


def mutated(proof: Proof, name: str) -> dict[Path, str]:
    """The sources of a proof with the mutant of a property. Raises UserError where its text is not there just once."""
    old, new = proof.mutants[name]
    texts = {path: path.read_text() for path in sources(proof)}
    chosen = [path for path in texts if path.stem in proof.modules]
    if (places := sum(texts[path].count(old) for path in chosen)) != 1:
        raise UserError(f"{proof.source.name}: mutant of {name}: {places} places have its text, allowed is one")
    return texts | {path: texts[path].replace(old, new) for path in chosen}


def killed(proof: Proof, name: str) -> bool:
    """Does the property fail on its mutant?"""
    folder = WORK / re.sub(r"\W+", "_", f"{proof.title} {name}")
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "rtl").mkdir(parents=True)
    texts = {folder / "rtl" / path.name: text for path, text in mutated(proof, name).items()}
    for path, text in texts.items():
        path.write_text(text)
    names = graph(proof, folder, list(texts))
    depth = 1 + (proof.window or 24)
    log = abc(f"cone -O {names.index(name)}; scleanup; bmc3 -F {depth} -T {proof.seconds}", folder, proof.seconds)
    return "was asserted in frame" in log


def main(names: list[str], quick: bool = False) -> int:
    """Run the proofs of these names, or all, and their mutants; 1 when a property or a mutant's check fails.

    All of them leave ``build/formal.json``.
    """
    if unknown := set(names) - {proof.name for proof in ALL}:
        allowed = ", ".join(dict.fromkeys(proof.name for proof in ALL))
        raise UserError(f"{min(unknown)}: is no proof, allowed are {allowed}")
    proofs = [proof for proof in ALL if (proof.quick or not quick) and (proof.name in names or not names)]
    first = {proof.name: proof for proof in reversed(proofs)}  # mutants at the first point of each wrapper
    for proof in first.values():  # what is wrong is told before the work
        for name in proof.labels("assert"):
            mutated(proof, name)
    rows, mutants = [], {}
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = {pool.submit(check, proof): proof for proof in sorted(proofs, key=lambda proof: proof.quick)}
        tries = {
            pool.submit(killed, proof, name): (proof.name, name)
            for proof in first.values()
            for name in proof.labels("assert")
        }
        for job in tqdm([*jobs, *tries], "formal", disable=None, delay=2):
            if job in jobs:
                rows += [row | {"proof": jobs[job].name} for row in job.result()]
            else:
                mutants[tries[job]] = job.result()
    for row in rows:
        row["mutant"] = mutants.get((row.pop("proof"), row["property"]))
    rows.sort(key=lambda row: (row["module"], row["property"]))
    if not quick and not names:
        save(OUT, rows)
    for row in rows:
        if row["result"] == "failed" or row["mutant"] is False:
            cause = row["result"] if row["result"] == "failed" else "does not fail on its mutant"
            print(f"{row['module']}: {row['property']}: {cause} ({row['engine']}, {row['depth']} clocks)")
    results = [row["result"] for row in rows]
    print(", ".join(f"{results.count(result)} {result}" for result in ("proven", "bounded", "failed")))
    return int("failed" in results or any(row["mutant"] is False for row in rows))
