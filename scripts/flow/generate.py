# SPDX-License-Identifier: Apache-2.0
"""Write what the RTL takes from the golden model: ``make generate`` (``--check``: compare).

``rtl/shade_pkg.sv`` from ``golden/contract.py``, ``golden/registers.py`` and ``golden/types.py``, the tables
``rtl/fixed/shade_rsqrt_rom.sv`` from ``golden/fixed.py`` and ``rtl/surface/shade_rho_rom.sv`` from
``golden/direct.py``, ``docs/registers.md`` from ``golden/registers.py``, ``docs/interface.md`` from
``golden/packets.py`` and the contract, ``scripts/handoff/driver/shade_registers.h`` from the registers and packets.
"""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path

from polyshade.golden import contract as k
from polyshade.golden import direct, fixed, material, packets, registers, types
from polyshade.scripts.handoff import registers as forms

ROOT = Path(__file__).resolve().parents[2]
HEADER = """\
// SPDX-License-Identifier: Apache-2.0
// shade_pkg: formats, latencies, limits and codes of Polyshade.
//
// Generated from golden/contract.py, golden/registers.py and golden/types.py by `make generate`: change them there.
// W: width in bits, F: fraction bits among them. S1.16: sign, 1 integer bit, 16 fraction bits.
// Latencies are in clocks from an input taken to the output that it causes.

/* verilator lint_off UNUSEDPARAM */  // no single module uses every constant
/* verilator lint_off UNUSEDSIGNAL */  // nor has a word of registers a setting in every bit
"""


def package() -> str:
    """The text of the package: one constant a line, with the comment that stands behind it in the contract."""
    source = Path(k.__file__).read_text()
    lines = [HEADER, "package shade_pkg;"]
    values = k.constants()
    for line in source.split("def constants")[0].splitlines():
        if section := re.match(r"# -+ (.*?) -+$", line):
            lines += ["", f"  // {section[1]}"]
        elif match := re.match(r"([A-Z0-9_, ]+) = [^#]*(?:#\s*(.*))?$", line):
            for name in match[1].split(", "):
                comment = f"  // {match[2]}" if match[2] else ""
                lines.append(f"  localparam int {name} = {values.pop(name)};{comment}")
    assert not values, f"constants that the generator did not find: {sorted(values)}"
    lines += ["", "  // registers: byte offset, lowest bit of a field, word after reset"]
    for name, (value, comment) in registers.constants().items():
        lines.append(f"  localparam int {name} = {value};{comment and f'  // {comment}'}")
    lines += ["", "  // widths of the structures below"]
    lines += [f"  localparam int {name} = {value};" for name, value in types.constants().items()]
    lines += [*_structs(), *_register_file()]
    return "\n".join(
        [*lines, "", "endpackage", "/* verilator lint_on UNUSEDPARAM */", "/* verilator lint_on UNUSEDSIGNAL */", ""]
    )


def _structs() -> list[str]:
    """Every packed structure: the last field comes first, it stands at the top."""
    lines = []
    for struct in types.STRUCTS.values():
        lines += ["", f"  // {struct.meaning}", "  typedef struct packed {"]
        for field in reversed(struct.placed()):
            name, told = field.name or f"unused_{field.lsb}", ": ".join(filter(None, (field.format, field.meaning)))
            sign = "signed " if field.format.startswith("S") else ""
            bits = f"logic {sign}[{field.width - 1}:0]" if field.width > 1 else "logic"
            kind = field.struct.name if field.struct else bits
            lines.append(f"    {kind} {name};{told and f'  // {told}'}")
        lines.append(f"  }} {struct.name};")
    return lines


def _register_file() -> list[str]:
    """The settings after reset, which register is meant as a structure; settings and STATUS into words and back.

    The functions take structures as vectors: Yosys' own reader does not know the fields of a function's variables.
    """
    every, placed = list(registers.every()), {field.path: field for field in registers.settings()}
    settings = [(placed[leaf.name], leaf.lsb) for leaf in types.DRAW.leaves()]
    faults = [(field, types.STATUS.leaf(field.path).lsb) for field in registers.faults()]
    select = {register.name: len(every) - 1 - i for i, register in enumerate(every)}
    owner = {field.name: register.name for register in every for field in register.fields}

    def each(statement: str) -> list[str]:
        return [
            "    "
            + statement.format(
                word=f"{field.lsb}+:{field.width}", draw=f"{lsb}+:{field.width}", width=field.width,
                select=select[owner[field.name]],
            )
            + f"  // {field.name}"
            for field, lsb in settings
        ]  # fmt: skip

    resets = [f"    {field.width}'d{field.reset}" for field, _ in reversed(settings)]
    names = [f"  // {field.path}" for field, _ in reversed(settings)]
    return [
        "",
        "  localparam draw_t DRAW_RESET = {",
        *(f"{reset},{name}" for reset, name in zip(resets[:-1], names[:-1], strict=True)),
        f"{resets[-1]}{names[-1]}",
        "  };",
        "",
        "  // one register of all",
        "  typedef struct packed {",
        *(f"    logic {register.name.lower()};" for register in every),
        "  } select_t;",
        "",
        "  // the register at an offset; nothing where there is none",
        "  function automatic select_t register_at(input logic [11:0] offset);",
        "    register_at = {",
        *(f"      offset == 12'(REG_{register.name})," for register in every[:-1]),
        f"      offset == 12'(REG_{every[-1].name})",
        "    };",
        "  endfunction",
        "",
        "  // the word of the settings that are selected, else 0",
        "  function automatic logic [31:0] draw_word(input draw_t draw, input select_t select);",
        "    draw_word = 32'd0;",
        *each("draw_word[{word}] |= {{{width}{{select[{select}]}}}} & draw[{draw}];"),
        "  endfunction",
        "",
        "  // the settings after a word was written to those that are selected",
        "  function automatic draw_t draw_written(input draw_t draw, input select_t select, input logic [31:0] word);",
        "    draw_written = draw;",
        *each("if (select[{select}]) draw_written[{draw}] = word[{word}];"),
        "  endfunction",
        "",
        "  // the word STATUS",
        "  function automatic logic [31:0] status_word(input logic busy, input status_t status);",
        "    status_word = 32'd0;",
        "    status_word[0] = busy;",
        *(f"    status_word[{field.lsb}] = status[{lsb}];  // {field.name}" for field, lsb in faults),
        "  endfunction",
    ]


ROM_HEADER = """\
// SPDX-License-Identifier: Apache-2.0
// shade_rsqrt_rom: the table of shade_rsqrt: 1/sqrt(m) = c0 + c1 d + c2 d^2 on segment i_i / 32 of [1, 4).
//
// Generated from polyshade.golden.fixed.rsqrt_rom by `make generate`: change it there.
// row_o = {c0, c1, c2}: c0 U0.22, with the half ulp of the result's rounding; c1 S0.18, negative; c2 U0.12, 11 bits;
// rows below segment 32 are 0. Block RAM or LUTs, as the tool sees fit (6,528 bits). Latency 1 clock, one row a clock.
// Example: i = 32 -> c0 = 1/sqrt(1 + 1/64) + 2^-21.
"""


def rsqrt_rom() -> str:
    """The text of the table's module."""
    width = k.RSQRT_C0_F + k.RSQRT_C1_F + k.RSQRT_C2_W
    table = fixed.rsqrt_rom(range(1 << k.RSQRT_INDEX_W)).tolist()
    rows = [f"      {k.RSQRT_INDEX_W}'d{i}: row_o <= {width}'h{row:x};" for i, row in enumerate(table) if row]
    return "\n".join(
        [
            f"{ROM_HEADER}module shade_rsqrt_rom (",
            "  input  logic                                clk_i,",
            "  input  logic [shade_pkg::RSQRT_INDEX_W-1:0] i_i,",
            f"  output logic [{width - 1:30d}:0] row_o",
            ");",
            "  always_ff @(posedge clk_i) begin",
            "    case (i_i)",
            *rows,
            "      default: row_o <= '0;",
            "    endcase",
            "  end",
            "endmodule",
            "",
        ]
    )


RHO_HEADER = """\
// SPDX-License-Identifier: Apache-2.0
// shade_rho_rom: the table of shade_rho: 1/sqrt(P) - 1 = c0 + c1 d + c2 d^2 on segment i_i / 128 of P.
//
// Generated from polyshade.golden.direct.rho_rom by `make generate`: change it there.
// row_o = {c0, c1, c2}: c0 S1.25; c1 S2.15, negative; c2 U4.7. Rows 0 to 31 are constant.
// Block RAM or LUTs, as the tool sees fit (14,336 bits). Latency 1 clock, one row a clock.
// Example: i = 64 -> c0 = 1/sqrt(129/256) - 1.
"""


def rho_rom() -> str:
    """The text of the table's module."""
    width = k.RHO_C0_W + k.INTENSITY_W + k.RHO_C2_W
    table = direct.rho_rom(range(1 << k.RHO_INDEX_W)).tolist()
    rows = [f"      {k.RHO_INDEX_W}'d{i}: row_o <= {width}'h{row:x};" for i, row in enumerate(table)]
    return "\n".join(
        [
            f"{RHO_HEADER}module shade_rho_rom (",
            "  input  logic                              clk_i,",
            "  input  logic [shade_pkg::RHO_INDEX_W-1:0] i_i,",
            f"  output logic [{width - 1:28d}:0] row_o",
            ");",
            "  always_ff @(posedge clk_i) begin",
            "    case (i_i)",
            *rows,
            "      default: row_o <= '0;",
            "    endcase",
            "  end",
            "endmodule",
            "",
        ]
    )


MAP_HEADER = """\
# Registers

Generated from `golden/registers.py` by `make generate`: change them there. Words of 32 bits on AXI4-Lite,
by byte offset; unnamed bits read 0. `S1.16`: signed, one integer bit, 16 fraction bits; `U`: unsigned. Access `ro`:
writing changes nothing.

An offset without a register is answered `SLVERR` and reads 0. So is a write to an `rw` register while `busy`, and
nothing changes: a draw call cannot be torn. The one exception is `CONTROL` with `clear` set and its other bits as they
are read.

Values come from physical parameters by `polyshade.golden.material`, words by `polyshade.golden.registers.pack`; without
Python by the [C driver](../scripts/handoff/driver/README.md), whose words are the same:

```python
from polyshade.golden.material import Material, colour_registers, planner_registers, registers
from polyshade.golden.registers import pack

surface = Material("cook-torrance", roughness=0.3)
words = pack(registers(surface, light=(0.3, 0.6, 0.8)) | planner_registers(surface) | colour_registers(surface))
```
"""

FORMULAS = """\
## Formulas

The viewer is V = (0, 0, 1), infinitely far; x points right, y up. n: shininess; m: roughness; numbers to nearest, ties up.

| register | value |
|---|---|
| `LX` `LY` `LZ` | the unit vector L to the light |
| `HX` `HY` `HZ`, `VH` | H = (L + V) / abs(L + V) and V.H = H.z; all 0 for L = (0, 0, -1) |
| `SHARPNESS` | n of the cos^n that turns as fast as the highlight, at least 2: lambert 2, phong 4 n, blinn n, schlick sqrt(2) n, cook-torrance and ward 2 / m^2; mantissa in [1, 2) times 2^exponent |
| `K1` `K2` `XMAX` `power` | the highlight max(0, 1 - k1 x + k2 x^2)^(2^power), x = min(1 - c, xmax), c = N.H or R.V; as the papers print it k1 = n / 16, k2 = 0, xmax = 1, power = 4, where n is 2 / m^2 - 4 for cook-torrance, 2 / m^2 for ward |
| `shift` | `K1` = k1 / 2^shift, `K2` = k2 / 4^shift, `XMAX` = min(xmax 2^shift, 2 - 2^-16), with the first of 7, 0, 1, .. 6 by which K1 < 2, abs(K2) < 1 and K1 - K2 X < 2; 7 stands for `K1` = 4 k1, `K2` = 4 k2, `XMAX` = xmax |
| `INV_N` | schlick: 1 / n = mantissa 2^-exponent, exponent = floor(log2 n), mantissa in (1/2, 1] |
| `GAIN` | exposure times energy scale times Fresnel's factor F(V.H), mantissa in [1, 2) times 2^exponent; 1 for blinn, phong and schlick without scale; 1 / (4 pi m^2) for cook-torrance and ward |
| `F0` | cook-torrance with a light of every point; else 1 |

F(c) = f0 + (1 - f0)(1 - c)^5, f0 = 1 but for cook-torrance. The refined k1, k2, xmax have the least maximal error; these
are their words for blinn and phong:

| n | `K1` | `K2` | `XMAX` | `SHARPNESS` of blinn | of phong |
|---|---|---|---|---|---|
"""  # noqa: E501


def formulas() -> str:
    """How the words come about, and those of common shininesses."""
    lines = [FORMULAS.rstrip()]
    for n in (8, 16, 32, 64, 128, 256, 512, 1024):
        surfaces = [material.Material(model, n) for model in ("blinn", "phong")]
        lobe = registers.pack(material.lobe_registers(*surfaces[0].lobe))
        words = [*lobe.values(), *(w for s in surfaces for w in registers.pack(material.planner_registers(s)).values())]
        lines.append(f"| {n} | " + " | ".join(f"`{word:#x}`" for word in words) + " |")
    return "\n".join([*lines, ""])


def register_map() -> str:
    """The page of the register map: a table for every group, a row for every field."""
    lines = [MAP_HEADER]
    for title, group in registers.GROUPS.items():
        lines += [f"## {title}", ""]
        lines += [
            "| offset | register | access | bits | field | format | reset | meaning |",
            "|---|---|---|---|---|---|---|---|",
        ]
        for register in group:
            where = f"`{register.offset:#05x}` | `{register.name}` | {register.access}"
            for field in register.fields:
                value = f"{field.reset:#x}" if field.reset > 9 else f"{field.reset}"
                lines.append(
                    f"| {where} | {field.bits} | `{field.name}` | {field.format} | {value} | {field.meaning} |"
                )
                where = " | | "
        lines.append("")
    return "\n".join([*lines, formulas()])


INTERFACE_HEADER = """\
# Packets, codes, latencies

Generated from `golden/packets.py` and `golden/contract.py` by `make generate`: change them there. The same
constants stand in `rtl/shade_pkg.sv`. Every packet is one beat of an AXI4-Stream; bits without a field, such as 207:205
and 255:243 of SPAN, are ignored where they come in, and 0 where they go out. `S1.16`: signed, one integer bit, 16
fraction bits; `U`: unsigned. Settings and counters: [registers](registers.md).
"""
CODES = {
    "PATH": "way through the core",
    "MODEL": "light",
    "VARIANT": "normals of path 1",
    "DEGREE": "degree of a record",
    "EVALUATOR": "parameter EVALUATOR",
    "FORM": "parameter FORM",
    "NODES": "parameter NODES",
    "LIGHT": "bits of flags_o of the light units",
    "LANE": "more bits of a lane's",
}


def interface() -> str:
    """The page of packets, codes and latencies."""
    lines = [INTERFACE_HEADER, "## Packets", ""]
    for name, packet in packets.PACKETS.items():
        lines += [f"### {name}, {packet.width} bits", "", f"{packet.meaning[0].upper()}{packet.meaning[1:]}.", ""]
        lines += [f"On {packet.stream}.", "", "| bits | field | format | meaning |", "|---|---|---|---|"]
        lines += [f"| {f.bits} | `{f.name}` | {f.format} | {f.meaning} |" for f in packet.fields]
        lines.append("")
    comments = dict(re.findall(r"^([A-Z0-9_]+) = [^#\n]*#\s*(.*)$", Path(k.__file__).read_text(), re.MULTILINE))
    lines += ["## Codes", "", "| constant | value | meaning |", "|---|---|---|"]
    for prefix, title in CODES.items():
        lines.append(f"| **{title}** | | |")
        lines += [
            f"| `{name}` | {value} | {comments.get(name, '').replace('|', chr(92) + '|')} |"
            for name, value in k.constants().items()
            if re.fullmatch(rf"{prefix}_[A-Z0-9]+(_[A-Z]+)*", name) and not name.endswith(("_W", "_MAX", "_F"))
        ]
    lines += [
        "", "## Timing", "",
        "Streams of `shade_core`, from a waveform (`make pictures`).", "",
        "![Three spans through the core](timing_core.svg)", "",
        "## Latencies", "",
        "In clocks from an input taken to the output that it causes. The module is named like the constant.", "",
        "| constant | clocks | made of |", "|---|---|---|",
    ]  # fmt: skip
    lines += [
        f"| `{name}` | {value} | {comments.get(name, '')} |"
        for name, value in k.constants().items()
        if name.startswith("LATENCY_")
    ]
    return "\n".join([*lines, ""])


GENERATED = {
    "docs/interface.md": interface,
    "rtl/shade_pkg.sv": package,
    "rtl/fixed/shade_rsqrt_rom.sv": rsqrt_rom,
    "rtl/surface/shade_rho_rom.sv": rho_rom,
    "docs/registers.md": register_map,
    "scripts/handoff/driver/shade_registers.h": forms.header,
}


def main() -> int:
    """Write the files, or tell which of them are out of date."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="fail when a file on disk is not up to date")
    check = parser.parse_args().check
    for name, text in GENERATED.items():
        path = ROOT / name
        if not check:
            path.write_text(text())
        elif not path.exists() or path.read_text() != text():
            print(f"{name} is out of date: run `make generate`", file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
