# SPDX-License-Identifier: Apache-2.0
"""Scripts and constraints for every flow, and the descriptions that package managers read.

One clock, ``clk_i``; everything else is synchronous to it. The scripts of the vendors' tools take the name of a
configuration, and find its files and parameters in ``configurations.tcl``.
"""

from __future__ import annotations

import yaml
from polyshade.golden.registers import VERSION
from polyshade.scripts.handoff.configurations import CONFIGURATIONS, Configuration
from polyshade.sim.sources import ROOT

MHZ = 148.5  # 1080p60 at a pixel a clock
PERIOD = round(1000 / MHZ, 3)
RELEASE = ".".join(map(str, VERSION))

SDC = f"""\
# Timing of Polyshade: one clock, all ports synchronous to it. {MHZ} MHz is a pixel a clock of 1080p60.
# Ports are given 30 % of the period outside: a core that is placed alone, between registers of yours.
create_clock -name clk_i -period {PERIOD} [get_ports clk_i]
set_input_delay -clock clk_i {PERIOD * 0.3:.3f} [remove_from_collection [all_inputs] [get_ports clk_i]]
set_output_delay -clock clk_i {PERIOD * 0.3:.3f} [all_outputs]
"""
XDC = f"""\
# Vivado: the core out of context. In a design of yours the clock comes from there: leave this file out.
create_clock -name clk_i -period {PERIOD} [get_ports clk_i]
set_input_delay -clock clk_i {PERIOD * 0.3:.3f} [filter [all_inputs] {{NAME != clk_i}}]
set_output_delay -clock clk_i {PERIOD * 0.3:.3f} [all_outputs]
"""
LPF = f"""\
# Lattice Diamond, nextpnr-ecp5. Pins are the board's: LOCATE COMP "clk_i" SITE "G2";
FREQUENCY PORT "clk_i" {MHZ} MHZ;
"""
CST = """\
// Gowin: pins are the board's, such as IO_LOC "clk_i" 52; IO_PORT "clk_i" IO_TYPE=LVCMOS33; timing stands in shade.sdc.
"""
PDC = f"""\
# Radiant (Nexus): timing in the language of SDC.
create_clock -name clk_i -period {PERIOD} [get_ports clk_i]
"""

CONSTRAINTS = {"shade.sdc": SDC, "shade.xdc": XDC, "shade.lpf": LPF, "shade.cst": CST, "shade.pdc": PDC}


def tcl_configurations() -> str:
    """Tops, parameters and files of all configurations."""
    lines = ["# Tops, parameters and files of every configuration; paths are relative to the bundle."]
    for part in CONFIGURATIONS.values():
        lines += [
            f"set tops({part.name}) {part.top}",
            f"set parameters({part.name}) {{{' '.join(f'{name} {value}' for name, value in part.point.items())}}}",
            f"set sources({part.name}) {{",
            *(f"  {name}" for name in listed(part)),
            "}",
        ]
    return "\n".join([*lines, CHOOSE])


CHOOSE = """\
# the configuration named on the command line, the first word of it
set config [lindex $argv 0]
if {$config eq ""} {set config core_small}
if {![info exists tops($config)]} {
  puts stderr "$config: no such configuration, allowed [lsort [array names tops]]"
  exit 2
}
set bundle [file normalize [file join [file dirname [info script]] ..]]
set top $tops($config)
set files {}
foreach name $sources($config) {lappend files [file join $bundle $name]}
"""
HEAD = "source [file join [file dirname [info script]] configurations.tcl]\n"
VIVADO = f"""\
# vivado -mode batch -source vivado.tcl -tclargs core_small
{HEAD}set part xc7a100tcsg324-1
read_verilog -sv $files
read_xdc -mode out_of_context [file join $bundle constraints shade.xdc]
set generics {{}}
foreach {{name value}} $parameters($config) {{lappend generics -generic $name=$value}}
synth_design -mode out_of_context -top $top -part $part {{*}}$generics
opt_design
place_design
phys_opt_design
route_design
report_utilization -file $config.utilization.rpt
report_timing_summary -file $config.timing.rpt
write_checkpoint -force $config.dcp
"""
QUARTUS = f"""\
# quartus_sh -t quartus.tcl core_small
{HEAD}package require ::quartus::project
package require ::quartus::flow
project_new -overwrite $config
set_global_assignment -name FAMILY "Cyclone V"
set_global_assignment -name DEVICE 5CSEBA6U23I7
set_global_assignment -name TOP_LEVEL_ENTITY $top
set_global_assignment -name VERILOG_MACRO "SYNTHESIS=1"
foreach file $files {{set_global_assignment -name SYSTEMVERILOG_FILE $file}}
foreach {{name value}} $parameters($config) {{set_parameter -name $name $value}}
set_global_assignment -name SDC_FILE [file join $bundle constraints shade.sdc]
set_instance_assignment -name VIRTUAL_PIN ON -to *
set_instance_assignment -name VIRTUAL_PIN OFF -to clk_i
execute_flow -compile
project_close
"""
RADIANT = f"""\
# radiantc radiant.tcl core_small
{HEAD}prj_create -name $config -impl impl_1 -dev LIFCL-40-9BG400C -synthesis synplify
foreach file $files {{prj_add_source $file}}
prj_add_source [file join $bundle constraints shade.pdc]
prj_set_impl_opt top $top
set values {{}}
foreach {{name value}} $parameters($config) {{lappend values $name=$value}}
prj_set_impl_opt HDL_PARAM [join $values ";"]
prj_run Synthesis -impl impl_1
prj_run Map -impl impl_1
prj_run PAR -impl impl_1
prj_close
"""
DIAMOND = f"""\
# diamondc diamond.tcl core_small; on ECP5 take the files of lists/*_ecp5.f, whose multipliers hold their registers
{HEAD}prj_project new -name $config -impl impl_1 -dev LFE5U-85F-8BG381C -synthesis synplify
foreach file $files {{prj_src add $file}}
prj_src add [file join $bundle constraints shade.lpf]
prj_impl option top $top
set values {{}}
foreach {{name value}} $parameters($config) {{lappend values $name=$value}}
prj_impl option HDL_PARAM [join $values ";"]
prj_run Synthesis -impl impl_1
prj_run Map -impl impl_1
prj_run PAR -impl impl_1
prj_project close
"""
GOWIN = f"""\
# gw_sh gowin.tcl core_small; gw_sh takes no parameters of a top: it gets the plain Verilog, which has them inside
{HEAD}create_project -name $config -dir . -pn GW2A-LV18PG256C8/I7 -device_version C -force
add_file [file join $bundle verilog $config.v]
add_file [file join $bundle constraints shade.cst]
add_file [file join $bundle constraints shade.sdc]
set_option -top_module $top
set_option -verilog_std v2001
run all
"""
LIBERO = f"""\
# libero SCRIPT:libero.tcl "SCRIPT_ARGS:core_small"; the plain Verilog has the parameters inside
{HEAD}new_project -location ./$config -name $config -hdl VERILOG \\
  -family PolarFire -die MPF300T -package FCG1152 -speed -1
import_files -hdl_source [file join $bundle verilog $config.v]
import_files -sdc [file join $bundle constraints shade.sdc]
build_design_hierarchy
set_root -module ${{top}}::work
organize_tool_files -tool SYNTHESIZE -file [file join $bundle constraints shade.sdc] -module ${{top}}::work
run_tool -name SYNTHESIZE
run_tool -name PLACEROUTE
run_tool -name VERIFYTIMING
"""
SCRIPTS = {
    "vivado.tcl": VIVADO, "quartus.tcl": QUARTUS, "radiant.tcl": RADIANT, "diamond.tcl": DIAMOND,
    "gowin.tcl": GOWIN, "libero.tcl": LIBERO,
}  # fmt: skip


def listed(part: Configuration, technology: str = "") -> list[str]:
    """The files of a configuration in the bundle; those of a technology in place of generic ones."""
    names = [str(path.relative_to(ROOT)) for path in part.files]
    if technology:
        folder = f"rtl/tech/{technology}"
        own = {"rtl/fixed/shade_mul.sv": [f"{folder}/shade_mul_block.sv", f"{folder}/shade_mul.sv"]}
        names = [name for old in names for name in own.get(old, [old])]
    return names


def yosys(part: Configuration) -> str:
    """Yosys for ECP5, in the bundle's folder: ``yosys scripts/<name>.ys``."""
    files = " ".join(listed(part, "ecp5"))
    chosen = "".join(f" -chparam {name} {value}" for name, value in part.point.items())
    return f"""\
# In the bundle's folder: mkdir -p build && yosys scripts/{part.name}.ys, then
# nextpnr-ecp5 --85k --package CABGA381 --speed 8 --freq {MHZ} --timing-allow-fail --out-of-context --placer static \\
#   --json build/{part.name}.json
read_verilog -lib +/ecp5/cells_bb.v
read_verilog -sv {files}
hierarchy -check -top {part.top}{chosen}
synth_ecp5 -top {part.top}
tee -o build/{part.name}.txt stat
write_json build/{part.name}.json
"""


def fusesoc(parts: list[Configuration]) -> str:
    """The description for FuseSoC: lint and synthesis of every configuration, the smoke tests as simulations."""
    files = list(dict.fromkeys(name for part in CONFIGURATIONS.values() for name in listed(part)))
    tree: dict = {
        "name": f"polyshade:shade:shade:{RELEASE}",
        "description": "Polynomial shading: spans, triangles or vertices in, shaded pixels out",
        "filesets": {
            "rtl": {"files": files, "file_type": "systemVerilogSource"},
        },
        "parameters": {},
        "targets": {"default": {"filesets": ["rtl"]}},
    }
    for part in parts:
        for name in part.point:
            tree["parameters"][name] = {"datatype": "int", "paramtype": "vlogparam"}
        values = [f"{name}={value}" for name, value in part.point.items()]
        vectors = [{f"smoke/{part.name}_{kind}.hex": {"file_type": "user", "copyto": f"smoke/{part.name}_{kind}.hex"}}
                   for kind in ("in", "out", *(["registers"] if part.top == "shade_core" else []))]  # fmt: skip
        tree["filesets"][f"smoke_{part.name}"] = {
            "files": [{f"smoke/{part.name}.v": {"file_type": "verilogSource"}}, *vectors],
        }
        tree["filesets"][f"plain_{part.name}"] = {"files": [f"verilog/{part.name}.v"], "file_type": "verilogSource"}
        tree["targets"][f"lint_{part.name}"] = {
            "default_tool": "verilator", "filesets": ["rtl"], "toplevel": part.top, "parameters": values,
            "tools": {"verilator": {"mode": "lint-only", "verilator_options": ["-Wall"]}},
        }  # fmt: skip
        tree["targets"][f"smoke_{part.name}"] = {
            "default_tool": "icarus", "toplevel": "smoke",
            "filesets": [f"smoke_{part.name}", f"plain_{part.name}"],
            "tools": {"icarus": {"iverilog_options": ["-g2005"]}},
        }  # fmt: skip
        tree["targets"][f"synth_{part.name}"] = {
            "default_tool": "vivado", "filesets": ["rtl"], "toplevel": part.top, "parameters": values,
            "tools": {"vivado": {"part": "xc7a100tcsg324-1", "pnr": "none"}},
        }  # fmt: skip
    return "CAPI=2:\n" + yaml.safe_dump(tree, sort_keys=False)


def bender() -> str:
    """The manifest for Bender."""
    files = list(dict.fromkeys(name for part in CONFIGURATIONS.values() for name in listed(part)))
    return "\n".join(["package:", "  name: polyshade", "sources:", *(f"  - {name}" for name in files), ""])
