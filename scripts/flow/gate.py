# SPDX-License-Identifier: Apache-2.0
"""Netlists against the golden model: ``make gate``, left in ``build/gate.json``.

    [{"netlist": "shade_third[WIDTH=26]", "family": "ecp5", "test": "refined", "vectors": 100000, "mismatches": 0}]

Every unit, at every parameter point of its cases, is synthesized for every family of ``FAMILIES`` as a user's flow does
it, flattened, all the way to the family's cells. The cells become their simulation models and the result takes the
place of the RTL: the unit's own vectors run through it and are compared with the golden model in every bit and in every
latency; so do the streams of ``STREAMS``, among them a whole core, which Icarus runs in four states as well. What
synthesis gets wrong, and what the RTL leaves undefined, shows here.

* Models of cells are those of Yosys; it has none of ECP5's multiplier and block RAM, which :func:`blocks_ecp5` writes.
* Initial values that a family gives to registers are taken out: registers without reset start with random contents.
* ``VECTORS`` random vectors a case; of cases over all inputs at most as many, spread over them.

A netlist stays in ``build/gate/`` with a hash of what it was made from, and is taken again as long as that is the same.
"""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, replace
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden.material import planner_registers, registers
from polyshade.scripts.flow import fourstate, tools
from polyshade.scripts.flow.points import SMALL
from polyshade.scripts.report import save
from polyshade.sim import core
from polyshade.sim.errors import UserError
from polyshade.sim.sources import BUILD, Point, label
from polyshade.sim.units import Case, Result, cases
from polyshade.sim.units.case import Arrays
from polyshade.sim.units.stream import pixel_normals, poly_span
from polyshade.sim.verilate import reached
from tqdm import tqdm

OUT = BUILD / "gate.json"
WORK = BUILD / "gate"
VECTORS = 100_000
MODULE = re.compile(r"^(?:\(\*[^\n]*\*\)\s*)*(module (\w+).*?^endmodule)", re.MULTILINE | re.DOTALL)


@dataclass(frozen=True)
class Family:
    """How Yosys maps to a family, and how it reads the simulation models of its cells."""

    synthesis: str
    models: str  # a file of Yosys'
    options: str


FAMILIES = {
    "ecp5": Family("synth_ecp5", "ecp5/cells_sim.v", "-DNO_INCLUDES -I{share}/ecp5"),
    "ice40": Family("synth_ice40 -dsp", "ice40/cells_sim.v", "-DNO_ICE40_DEFAULT_ASSIGNMENTS"),  # multipliers: of UP5K
}


def blocks_ecp5() -> str:
    """Verilog of MULT18X18D and DP16KD as far as synthesis uses them: their data sheet's behaviour, written anew.

    MULT18X18D: p = a b, each operand signed or not; its registers in front of, within and behind the product have CLK0,
    CE0 and a synchronous RST0. DP16KD: 18 Kibit; port A writes, port B reads, both of 18 bits or both of 36, which take
    the data pins of both ports. A netlist with another width is refused.
    """

    def bits(name: str, width: int) -> str:
        return ", ".join(f"{name}{i}" for i in reversed(range(width)))

    groups = ("CLK", "CE", "RST")
    inputs = [bits("A", 18), bits("B", 18), bits("C", 18), "SIGNEDA, SIGNEDB, SOURCEA, SOURCEB"]
    inputs += [bits(group, 4) for group in groups] + [bits("SRIA", 18), bits("SRIB", 18)]
    stages = ("INPUTA", "INPUTB", "INPUTC", "PIPELINE", "OUTPUT")
    registers = [f'REG_{s}_{part} = "{default}"' for s in stages
                 for part, default in (("CLK", "NONE"), ("CE", "CE0"), ("RST", "RST0"))]  # fmt: skip
    more = ["CLK0_DIV", "CLK1_DIV", "CLK2_DIV", "CLK3_DIV", "HIGHSPEED_CLK", "GSR", "CAS_MATCH_REG", "SOURCEB_MODE"]
    more += ["MULT_BYPASS", "RESETMODE"]
    parameters = ", ".join([*registers, *(f'{name} = ""' for name in more)])
    cross = ", ".join(f'{name} = "{value}"' for name, value in (
        ("REGMODE_A", "NOREG"), ("REGMODE_B", "NOREG"), ("RESETMODE", "SYNC"), ("ASYNC_RESET_RELEASE", "SYNC"),
        ("CSDECODE_A", ""), ("CSDECODE_B", ""), ("WRITEMODE_A", "NORMAL"), ("WRITEMODE_B", "NORMAL"),
        ("CLKAMUX", "CLKA"), ("CLKBMUX", "CLKB"), ("GSR", ""), ("INIT_DATA", "STATIC"),
    ))  # fmt: skip
    initial = ", ".join(f"INITVAL_{i:02X} = 320'b0" for i in range(64))
    ports = [
        f"input {bits(f'DI{p}', 18)}, input {bits(f'AD{p}', 14)}, input CE{p}, OCE{p}, CLK{p}, WE{p}, RST{p}, "
        f"input {bits(f'CS{p}', 3)}, output {bits(f'DO{p}', 18)}" for p in "AB"
    ]  # fmt: skip

    def stage(name: str, source: str, width: str) -> str:
        own = f"{name.lower()}_stage"
        return f"""
  reg signed {width} {own}_q;
  wire signed {width} {own} = REG_{name}_CLK == "NONE" ? {source} : {own}_q;
  always @(posedge CLK0) if (RST0) {own}_q <= 0; else if (CE0) {own}_q <= {source};"""

    return f"""
module MULT18X18D #(parameter {parameters}) (
  input {", ".join(inputs)}, output {bits("P", 36)});
  wire signed [18:0] a_in = {{SIGNEDA & A17, {bits("A", 18)}}};
  wire signed [18:0] b_in = {{SIGNEDB & B17, {bits("B", 18)}}};{stage("INPUTA", "a_in", "[18:0]")}\
{stage("INPUTB", "b_in", "[18:0]")}
  wire signed [37:0] product = inputa_stage * inputb_stage;{stage("PIPELINE", "product", "[37:0]")}\
{stage("OUTPUT", "pipeline_stage", "[37:0]")}
  assign {{{bits("P", 36)}}} = output_stage[35:0];
endmodule

module DP16KD #(parameter DATA_WIDTH_A = 18, DATA_WIDTH_B = 18, {cross}, {initial}) (
  {", ".join(ports)});
  // words of 18 bits; a port of 36 takes two of them, the even one below
  reg [17:0] memory [0:1023];
  wire [13:0] ada = {{{bits("ADA", 14)}}};
  wire [13:0] adb = {{{bits("ADB", 14)}}};
  wire [17:0] dia = {{{bits("DIA", 18)}}};
  wire [17:0] dib = {{{bits("DIB", 18)}}};
  reg [17:0] doa, dob;
  assign {{{bits("DOA", 18)}}} = doa;
  assign {{{bits("DOB", 18)}}} = dob;
  generate
    if (DATA_WIDTH_A == 36 && DATA_WIDTH_B == 36) begin : wide
      always @(posedge CLKA) begin
        if (CEA && WEA) begin
          if (ada[0]) memory[{{ada[13:5], 1'b0}}][8:0] <= dia[8:0];
          if (ada[1]) memory[{{ada[13:5], 1'b0}}][17:9] <= dia[17:9];
          if (ada[2]) memory[{{ada[13:5], 1'b1}}][8:0] <= dib[8:0];
          if (ada[3]) memory[{{ada[13:5], 1'b1}}][17:9] <= dib[17:9];
        end
      end
      always @(posedge CLKB) if (CEB) {{dob, doa}} <= {{memory[{{adb[13:5], 1'b1}}], memory[{{adb[13:5], 1'b0}}]}};
    end else if (DATA_WIDTH_A == 18 && DATA_WIDTH_B == 18) begin : even
      always @(posedge CLKA) if (CEA && WEA) begin
        if (ada[0]) memory[ada[13:4]][8:0] <= dia[8:0];
        if (ada[1]) memory[ada[13:4]][17:9] <= dia[17:9];
      end
      always @(posedge CLKB) if (CEB) dob <= memory[adb[13:4]];
      initial doa = 0;
    end else begin : other
      model_of_this_width_is_missing missing ();
    end
  endgenerate
endmodule
"""


def netlist(family: str, module: str, point: Point) -> Path:
    """The file of a module's netlist, made of simulation models of a family's cells; synthesized unless it is there."""
    folder = WORK / family / re.sub(r"\W+", "_", label(module, point)).rstrip("_")
    folder.mkdir(parents=True, exist_ok=True)
    files, chosen = reached(module), tools.chparam(point)
    share = Path(find_spec("pyosys").origin).parent / "share"
    synthesis = f"""
        read_verilog -noassert -sv {" ".join(os.path.relpath(path, folder) for path in files)}
        hierarchy -check -top {module}{chosen}
        rename -top {module}
        {FAMILIES[family].synthesis} -top {module}
        select {module}
        write_rtlil -selected mapped.il
    """
    models = f"""
        read_rtlil mapped.il
        read_verilog -overwrite {FAMILIES[family].options.format(share=share)} cells.v
        {"read_verilog -overwrite blocks.v" if family == "ecp5" else ""}
        hierarchy -check -top {module}
        proc
        flatten
        setattr -unset init
        opt_clean
        write_verilog -noattr netlist.v
    """
    told = [synthesis, models, blocks_ecp5(), [path.read_bytes() for path in files], version("pyosys")]
    key, stamp, made = hashlib.sha256(repr(told).encode()).hexdigest(), folder / "key", folder / "netlist.v"
    if not (stamp.exists() and made.exists() and stamp.read_text() == key):
        (folder / "blocks.v").write_text(blocks_ecp5())
        tools.yosys(synthesis, folder)
        cells = (share / FAMILIES[family].models).read_text()
        (folder / "cells.v").write_text(used(cells, (folder / "mapped.il").read_text()))
        tools.yosys(models, folder)
        stamp.write_text(key)
    return made


def used(models: str, netlist: str) -> str:
    """The models of the cells in a netlist, and of the cells in these, without attributes.

    To read them all takes most of a minute.
    """
    texts = {found[2]: found[1] for found in MODULE.finditer(models)}
    names, todo = set(), {name for name in re.findall(r"\w+", netlist) if name in texts}
    while todo:
        names |= todo
        todo = {name for known in todo for name in re.findall(r"\w+", texts[known]) if name in texts} - names
    kept = MODULE.sub(lambda found: found[1] if found[2] in names else "", models)
    return f"{kept}\nmodule none ();\nendmodule\n"  # Yosys refuses a file without any


def spread(chunks: Iterator[Arrays], total: int) -> Iterator[Arrays]:
    """At most about ``total`` of the rows of all chunks, evenly spread in each."""
    for arrays in chunks:
        rows = len(next(iter(arrays.values())))
        step = max(1, rows // total)
        yield {name: values[::step] for name, values in arrays.items()}
        total = max(1, total - len(range(0, rows, step)))


def check(case: Case, family: str, vectors: int = VECTORS, seed: int = 1) -> dict:
    """One entry of the report: a case on the netlist of its module."""
    if case.all_vectors:
        everything = case.all_vectors
        case = replace(case, all_vectors=lambda: spread(everything(), vectors))
    with sim.netlists(lambda module, point: netlist(family, module, point)):
        result = case.check(vectors, seed)
    name = label(case.module, case.parameters)
    found = {"netlist": name, "family": family, "test": str(case).removeprefix(case.module).strip("/")}
    told = {"first_mismatch": result.first_mismatch} if result.mismatches else {}
    return {**found, "vectors": result.vectors, "mismatches": result.mismatches, **told}


def _core(vectors: int, seed: int) -> Result:
    """Spans through a core of one lane with Lambert's and Blinn-Phong's light, by random registers."""
    from polyshade.scripts.flow import soak

    total = Result()
    for part in range(max(1, vectors // 20_000)):
        rng = np.random.default_rng([seed, part])
        surface = soak.material(rng, ("lambert", "blinn"))
        words = registers(surface, soak.direction(rng)) | planner_registers(surface)
        made = core.draw(soak.lines(rng, 400), words, options={"in_gap": 0.2, "out_stall": 0.2, "seed": seed}, **CORE)
        first = str(made.first_mismatch or made.counter_mismatches or "")
        total.add(Result(len(made.pixels), made.mismatches + len(made.counter_mismatches), first))
    return total


CORE = {"LANES": 1, "EVALUATOR": k.EVALUATOR_FDIFF, "FORM": k.FORM_REFINED, **SMALL}
FOUR = "four states"
SPAN, LINE = poly_span(k.EVALUATOR_FDIFF, "refined"), pixel_normals()
STREAMS: dict[str, tuple[str, Point, Callable[[int, int], Result]]] = {  # what it is: module, point, vectors and seed
    "spans of random registers": ("shade_core", CORE, _core),
    "spans": (SPAN.module, SPAN.parameters, lambda n, s: SPAN.check(n // 12, s, 0.2, 0.2)),
    "lines": (LINE.module, LINE.parameters, lambda n, s: LINE.check(n // 10, s, 0.2, 0.2)),
}


def four_states(family: str) -> dict:
    """One entry of the report: the core's netlist in Icarus, with unknown bits."""
    folder = WORK / family / "four_states"
    compared, wrong, first = fourstate.check(netlist(family, "shade_core", CORE), folder, CORE)
    found = {"netlist": label("shade_core", CORE), "family": family, "test": FOUR, "vectors": compared}
    return {**found, "mismatches": wrong, **({"first_mismatch": first} if wrong else {})}


def stream(name: str, family: str, vectors: int = VECTORS, seed: int = 1) -> dict:
    """One entry of the report: a stream on the netlist of its module."""
    module, point, check_stream = STREAMS[name]
    with sim.netlists(lambda module, point: netlist(family, module, point)):
        result = check_stream(vectors, seed)
    told = {"first_mismatch": result.first_mismatch} if result.mismatches else {}
    found = {"netlist": label(module, point), "family": family, "test": name}
    return {**found, "vectors": result.vectors, "mismatches": result.mismatches, **told}


def main(names: list[str] | None = None) -> int:
    """Check the cases of the named modules (all without a name), leave ``build/gate.json``; 1 if anything differs."""
    chosen = cases()
    known = {case.module for case in chosen} | {module for module, _, _ in STREAMS.values()}
    for name in names or []:
        if name not in known:
            raise UserError(f"{name}: no such unit, allowed {', '.join(sorted(known))}")
    wanted = [index for index, case in enumerate(chosen) if not names or case.module in names]
    long = [name for name, (module, _, _) in STREAMS.items() if not names or module in names]
    if "shade_core" in (names or ["shade_core"]):
        fourstate.installed()  # told before the work
        long.append(FOUR)
    jobs = [(job, family) for job in [*long, *wanted] for family in FAMILIES]  # the longest first
    report = []
    with ProcessPoolExecutor(int(os.environ.get("JOBS") or os.cpu_count())) as pool:
        running = [pool.submit(_job, *job) for job in jobs]
        for done in tqdm(as_completed(running), "gate", len(running), disable=None):
            report.append(done.result())
    report.sort(key=lambda entry: (entry["family"], entry["netlist"], entry["test"]))
    if not names:
        save(OUT, report)
    wrong = [entry for entry in report if entry["mismatches"]]
    vectors = sum(entry["vectors"] for entry in report)
    print(f"{len(report)} runs on netlists, {vectors} vectors, {len(wrong)} with mismatches")
    for entry in wrong:
        print(f"  {entry['netlist']} {entry['family']} {entry['test']}: {entry['first_mismatch']}")
    return 1 if wrong else 0


def _job(job: int | str, family: str) -> dict:
    """A case by its number, as functions do not travel between processes, or a stream by its name."""
    if job == FOUR:
        return four_states(family)
    return stream(job, family) if isinstance(job, str) else check(cases()[job], family)


if __name__ == "__main__":
    raise SystemExit(main())
