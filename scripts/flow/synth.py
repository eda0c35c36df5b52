# SPDX-License-Identifier: Apache-2.0
"""Area and clock rate of every module on every FPGA family: ``make synth``, left in ``build/synth.json``.

    {"<module>": {"<family>": {"lut": 1, "ff": 2, "dsp": 3, "bram": 4, "fmax_mhz": 5.6}}}

Every module of ``rtl/shade.f`` is taken at its default parameters, some at others as well
(``shade_poly_span[EVALUATOR=1]``), and the yardsticks of ``scripts/studies/yardsticks`` in the same way.

How the figures come about:

* The module keeps its boundary (nothing is optimized across it), and a generated harness puts a register on
  every input and output bit. So a path from an input or to an output counts like one between registers, and
  a module without a clock of its own has a clock rate too. The harness' registers are not in ``ff``.
* ``ecp5``: Yosys ``synth_ecp5``, nextpnr for an LFE5U-85 of speed grade 8 in a CABGA381, out of context, placed
  by ``static``: on large designs better than the default, and no slower.
  ``lut`` is what nextpnr occupies: every LUT4, two for a carry cell, six for a 16 x 4 distributed RAM (four
  of data, two of write port). ``fmax_mhz`` is the **median over the placer seeds 1, 2, 3** of the slowest
  path from register to register.
* The other families (``scripts/flow/families.py``): Yosys; and nextpnr with seed 1 where it exists for the family,
  for the modules of ``WIDE`` and with ``--family``. Their harness is a chain of registers, as they place pins as well.
  Where a design does not fit, ``fmax_mhz`` is null and ``unplaced`` tells why. ``bram`` counts blocks of 4 kbit
  (``ice40``), 5 (``efinix``), 9 (``machxo2``), 10 (``cyclonev``), 18 (``ecp5``, ``nexus``, ``gowin``), 20
  (``polarfire``, ``gatemate``) and 18 kbit halves (``xilinx7``, ``ultrascale``).

A result is kept beside its log under ``build/synth/`` with a hash of the netlist before synthesis, the
commands and the tools' versions, and taken again as long as that hash is the same.
"""

import hashlib
import json
import os
import re
import statistics
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

from polyshade.scripts.flow import tools
from polyshade.scripts.flow.families import BRAM, DSP, FAMILIES, FF, LUT, USUAL, WIDE, count, family
from polyshade.scripts.flow.points import VARIANTS
from polyshade.scripts.report import save
from polyshade.sim.errors import UserError
from polyshade.sim.sources import BUILD, Point, label, modules, yardsticks
from polyshade.sim.verilate import reached
from tqdm import tqdm

OUT = BUILD / "synth.json"
WORK = BUILD / "synth"
SEEDS = (1, 2, 3)
ASSERTIONS = ("shade_assert", "shade_stable")  # for simulation and proofs: nothing is left of them in synthesis


@dataclass(frozen=True)
class Design:
    """A module at a parameter point, and the files that hold it."""

    module: str
    point: Point
    files: list[Path]

    @property
    def name(self) -> str:
        """The name in the report, such as ``shade_third[FORM=0]``."""
        return label(self.module, self.point)

    @property
    def folder(self) -> Path:
        """Where scripts, logs and results of this design stand."""
        return WORK / re.sub(r"\W+", "_", self.name).rstrip("_")


def designs(names: list[str] | None = None) -> list[Design]:
    """Every design, or those of the named modules; UserError for a name that is none."""
    known = [name for name in [*modules(), *yardsticks()] if name not in ASSERTIONS]
    for name in names or []:
        if name not in known:
            raise UserError(f"{name}: no such module, allowed {', '.join(known)}")
    return [
        Design(module, point, reached(module))
        for module in known
        if not names or module in names
        for point in [{}, *VARIANTS.get(module, [])]
    ]


def elaborate(design: Design) -> str:
    """Leave the elaborated module as ``unit`` and its harness in the design's folder.

    Returns the netlist as text without names and places of the source, which is what results depend on.
    """
    folder = design.folder
    folder.mkdir(parents=True, exist_ok=True)
    files = " ".join(os.path.relpath(path, folder) for path in design.files)
    chosen = "".join(f" -chparam {name} {value}" for name, value in design.point.items())
    script = f"""
        read_verilog -sv {files}
        hierarchy -check -top {design.module}{chosen}
        proc
        flatten
        opt_clean
        rename -top unit
        write_rtlil unit.il
        write_json ports.json
        write_verilog -noattr unit.v
    """
    tools.yosys(script, folder)
    ports = json.loads((folder / "ports.json").read_text())["modules"]["unit"]["ports"]
    (folder / "harness.v").write_text(harness(ports))
    (folder / "chain.v").write_text(chain(ports))
    netlist = (folder / "unit.v").read_text()
    return "\n".join(line for line in netlist.splitlines() if not line.startswith("/*"))


def harness(ports: dict[str, dict]) -> str:
    """Verilog that puts a register on every input and output bit of ``unit``; ports as Yosys writes them.

    >>> print(harness({"a_i": {"direction": "input", "bits": [2, 3]}}))
    module harness(input clk_i, input [1:0] a_i);
      reg [1:0] a_i_q;
      always @(posedge clk_i) a_i_q <= a_i;
      unit u_unit (.a_i(a_i_q));
    endmodule
    """
    heads, body, pins = ["input clk_i"], [], []
    for name, port in ports.items():
        if name == "clk_i":
            pins.append(".clk_i(clk_i)")
            continue
        kind, width = port["direction"], f"[{len(port['bits']) - 1}:0]"
        heads.append(f"{kind} {width} {name}")
        inner = f"{name}_q" if kind == "input" else f"{name}_d"
        pins.append(f".{name}({inner})")
        if kind == "input":
            body += [f"reg {width} {inner};", f"always @(posedge clk_i) {inner} <= {name};"]
        else:
            body += [f"wire {width} {inner};", f"reg {width} {name}_q;"]
            body += [f"always @(posedge clk_i) {name}_q <= {inner};", f"assign {name} = {name}_q;"]
    body.append(f"unit u_unit ({', '.join(pins)});")
    return "\n".join([f"module harness({', '.join(heads)});", *(f"  {line}" for line in body), "endmodule"])


def chain(ports: dict[str, dict]) -> str:
    """As :func:`harness`, with three pins: inputs are a shift register, outputs are added to one that leads out.

    >>> print(chain({"a_i": {"direction": "input", "bits": [2, 3]}, "y_o": {"direction": "output", "bits": [4]}}))
    module harness(input clk_i, input chain_i, output chain_o);
      reg [1:0] inputs_q;
      wire [0:0] outputs;
      reg [0:0] outputs_q;
      always @(posedge clk_i) inputs_q <= {inputs_q, chain_i};
      always @(posedge clk_i) outputs_q <= outputs ^ {outputs_q, 1'b0};
      assign chain_o = outputs_q[0];
      unit u_unit (.a_i(inputs_q[0 +: 2]), .y_o(outputs[0 +: 1]));
    endmodule
    """
    widths, pins = {"input": 0, "output": 0}, []
    for name, port in ports.items():
        if name == "clk_i":
            pins.append(".clk_i(clk_i)")
            continue
        kind, width = port["direction"], len(port["bits"])
        vector = "inputs_q" if kind == "input" else "outputs"
        pins.append(f".{name}({vector}[{widths[kind]} +: {width}])")
        widths[kind] += width
    inputs, outputs = (max(width, 1) - 1 for width in widths.values())
    body = [
        f"reg [{inputs}:0] inputs_q;",
        f"wire [{outputs}:0] outputs;",
        f"reg [{outputs}:0] outputs_q;",
        "always @(posedge clk_i) inputs_q <= {inputs_q, chain_i};",
        "always @(posedge clk_i) outputs_q <= outputs ^ {outputs_q, 1'b0};",
        f"assign chain_o = outputs_q[{outputs}];",
        f"unit u_unit ({', '.join(pins)});",
    ]
    head = "module harness(input clk_i, input chain_i, output chain_o);"
    return "\n".join([head, *(f"  {line}" for line in body), "endmodule"])


def synthesize(design: Design, name: str) -> dict[str, int]:
    """LUT, FF, DSP, BRAM of an elaborated design after Yosys' mapping; leaves ``<family>/netlist.json``."""
    script = f"""
        read_rtlil ../unit.il
        setattr -mod -set keep_hierarchy 1 unit
        read_verilog ../{"harness" if name == "ecp5" else "chain"}.v
        {FAMILIES[name].command} -top harness
        tee -q -o cells.json stat -json unit
        setattr -mod -unset keep_hierarchy unit
        flatten
        write_json netlist.json
    """
    folder = design.folder / name
    tools.yosys(script, folder)
    module = json.loads((folder / "cells.json").read_text())["modules"]["\\unit"]
    return count(name, module["num_cells_by_type"])


def place_and_route(folder: Path, seeds: tuple[int, ...] = SEEDS) -> tuple[int, float | None]:
    """LUTs that nextpnr occupies on an ECP5 and the median clock rate in MHz over the seeds.

    The rate is None where no path leads from a register to a register.
    """
    rates, luts = [], 0
    for seed in seeds:
        files = ["--json", "netlist.json", "--report", "report.json", "--seed", str(seed)]
        tools.nextpnr_ecp5([*FAMILIES["ecp5"].placer.options, *files], folder)
        report = json.loads((folder / "report.json").read_text())
        used = {bel: entry["used"] for bel, entry in report["utilization"].items()}
        luts = used["TRELLIS_COMB"] + 2 * used["TRELLIS_RAMW"]
        rates += [clock["achieved"] for clock in report["fmax"].values()]
    return luts, round(statistics.median(rates), 2) if rates else None


def place(folder: Path, name: str) -> dict[str, float | str | None]:
    """The clock rate in MHz with the first seed, or why there is none."""
    placer = FAMILIES[name].placer
    for file, text in placer.files:
        (folder / file).write_text(text)
    files = ["--json", "netlist.json", "--report", "report.json", "--seed", str(SEEDS[0])]
    try:
        tools.nextpnr(placer.program, [*placer.options, *files], folder)
    except UserError as error:
        return {"fmax_mhz": None, "unplaced": str(error).partition("ERROR: ")[2] or str(error)}
    rates = [clock["achieved"] for clock in json.loads((folder / "report.json").read_text())["fmax"].values()]
    return {"fmax_mhz": round(min(rates), 2) if rates else None}


def fingerprint(name: str, netlist: str, placed: bool = False) -> str:
    """A hash of everything that a result depends on."""
    wheels = ["pyosys"]
    if name == "ecp5" or placed:
        wheels.append(f"yowasp-nextpnr-{FAMILIES[name].placer.program}")
    told = [netlist, FAMILIES[name], SEEDS, placed, [version(wheel) for wheel in wheels]]
    return hashlib.sha256(repr(told).encode()).hexdigest()


def kept(design: Design, name: str, netlist: str, placed: bool = False) -> dict[str, int | float | None] | None:
    """The result that is kept of an elaborated design; None if there is none, or something changed since."""
    path = design.folder / name / "result.json"
    found = json.loads(path.read_text()) if path.exists() else {"key": None}
    return found["result"] if found["key"] == fingerprint(name, netlist, placed) else None


def measure(design: Design, name: str, netlist: str, placed: bool = False) -> dict[str, int | float | None]:
    """One entry of the report, from the kept result if nothing changed since; ``placed``: not on ECP5 alone."""
    placed = placed and name != "ecp5" and FAMILIES[name].placer is not None
    if found := kept(design, name, netlist, placed):
        return found
    result: dict[str, int | float | None] = {**synthesize(design, name), "fmax_mhz": None}
    folder = design.folder / name
    if name == "ecp5":
        result["lut"], result["fmax_mhz"] = place_and_route(folder)
    elif placed:
        result |= place(folder, name)
    save(folder / "result.json", {"key": fingerprint(name, netlist, placed), "result": result})
    return result


def main(names: list[str] | None = None, families: tuple[str, ...] = ()) -> dict[str, dict]:
    """Measure the named modules (all without a name), leave ``build/synth.json`` and print a table.

    Of named modules, or families, only their entries are renewed. Raises UserError for a name that is none.
    """
    for name in families:
        family(name)
    chosen = designs(names)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        netlists = list(pool.map(elaborate, chosen))
        # the slow family first, so that the last jobs to end are short
        jobs = {
            pool.submit(measure, design, name, netlist, wide): (design.name, name)
            for name in FAMILIES
            for design, netlist in zip(chosen, netlists, strict=True)
            for wide in [bool(families) or design.module in WIDE]
            if name in (families or (FAMILIES if wide else USUAL))
        }
        for job in tqdm(as_completed(jobs), "synth", len(jobs), disable=None, delay=2):
            if job.exception():
                pool.shutdown(cancel_futures=True)
            job.result()

    report = {design.name: {} for design in chosen}
    for job, (design_name, name) in jobs.items():
        report[design_name][name] = job.result()
    if (names or families) and OUT.exists():
        before = json.loads(OUT.read_text())
        report = before | {name: (before.get(name, {}) if families else {}) | found for name, found in report.items()}
    save(OUT, report)
    print(table(report))
    return report


def table(report: dict[str, dict]) -> str:
    """The report as text: a line for each design and family."""
    width = max(map(len, report))
    parts = (LUT, FF, DSP, BRAM, "fmax_mhz")
    lines = [f"{'':<{width}}{'family':>12}" + "".join(f"{part.removesuffix('_mhz'):>8}" for part in parts)]
    for name, families in report.items():
        for where, found in families.items():
            values = "".join(f"{'-' if (value := found[part]) is None else value:>8}" for part in parts)
            lines.append(f"{name:<{width}}{where:>12}{values}  {found.get('unplaced', '')}".rstrip())
    return "\n".join(lines)


if __name__ == "__main__":
    main()
