"""Write what the RTL takes from the golden model: ``python -m scripts.generate`` (``--check``: compare).

``rtl/shade_pkg.sv`` from ``golden/contract.py`` and ``golden/registers.py``, the table
``rtl/fixed/shade_rsqrt_rom.sv`` from ``golden/fixed.py``, ``docs/registers.md`` from ``golden/registers.py``.
"""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path

from golden import contract as k
from golden import fixed, registers

ROOT = Path(__file__).resolve().parent.parent
HEADER = """\
// shade_pkg: formats, latencies, limits and codes of Polyshade.
//
// Generated from golden/contract.py and golden/registers.py by `python -m scripts.generate`: change them there.
// W: width in bits, F: fraction bits among them. S1.16: sign, 1 integer bit, 16 fraction bits.
// Latencies are in clocks from an input taken to the output that it causes.

/* verilator lint_off UNUSEDPARAM */  // no single module uses every constant
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
    lines += ["", "  // the settings of a draw call: what can be written, by the names of docs/registers.md"]
    lines += ["  typedef struct packed {"]
    lines += [
        f"    logic {'signed ' if field.format.startswith('S') else ''}[{field.width - 1}:0] {field.name};"
        for field in registers.settings()
    ]
    lines += ["  } draw_t;"]
    return "\n".join([*lines, "", "endpackage", "/* verilator lint_on UNUSEDPARAM */", ""])


ROM_HEADER = """\
// shade_rsqrt_rom: the table of shade_rsqrt: 1/sqrt(m) = c0 + c1 d + c2 d^2 on segment i_i / 32 of [1, 4).
//
// Generated from golden.fixed.rsqrt_rom by `python -m scripts.generate`: change it there.
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


MAP_HEADER = """\
# Registers

Generated from `golden/registers.py` by `python -m scripts.generate`: change them there. Words of 32 bits on AXI4-Lite,
by byte offset; unnamed bits read 0. `S1.16`: signed, one integer bit, 16 fraction bits; `U`: unsigned. Access `ro`:
writing changes nothing. Values come from physical parameters by `golden.material`, words by `golden.registers.pack`:

```python
from golden.material import Material, colour_registers, planner_registers, registers
from golden.registers import pack

surface = Material("cook-torrance", roughness=0.3)
words = pack(registers(surface, light=(0.3, 0.6, 0.8)) | planner_registers(surface) | colour_registers(surface))
```
"""


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
    return "\n".join(lines)


GENERATED = {
    "rtl/shade_pkg.sv": package,
    "rtl/fixed/shade_rsqrt_rom.sv": rsqrt_rom,
    "docs/registers.md": register_map,
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
            print(f"{name} is out of date: run `python -m scripts.generate`", file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
