# SPDX-License-Identifier: Apache-2.0
"""The register map in the forms that others read, from ``golden/registers.py``: C, SystemRDL, IP-XACT.

``header`` is ``driver/shade_registers.h`` here (``make generate``); ``systemrdl`` and ``memory_map`` are parts of the
bundle.
"""

from __future__ import annotations

from xml.etree import ElementTree

from polyshade.golden import contract as k
from polyshade.golden import packets, registers
from polyshade.golden.types import Field

SPIRIT = "http://www.accellera.org/XMLSchema/IPXACT/1685-2014"
SETTINGS = ("LOBE_K1_F", "LOBE_K2_F", "LOBE_FINE", "LOBE_FINE_F", "SHARPNESS_F")  # that the driver computes with

HEADER = """\
/* SPDX-License-Identifier: Apache-2.0
 * Registers and packets of shade_core.
 *
 * Generated from golden/registers.py and golden/packets.py by `make generate`: change them there.
 * SHADE_<register>: byte offset; _RESET: its word after reset; SHADE_<register>_<field>_LSB, _W: lowest bit and width.
 */
#ifndef SHADE_REGISTERS_H
#define SHADE_REGISTERS_H
"""


def header() -> str:
    """The C header."""
    lines = [HEADER]
    for title, group in registers.GROUPS.items():
        lines.append(f"/* {title} */")
        for register in group:
            lines.append(_define(register.name, f"0x{register.offset:03x}", register.access))
            if register.reset:
                lines.append(_define(f"{register.name}_RESET", f"0x{register.reset:08x}u"))
            for field in register.fields:
                lines += _place(f"{register.name}_{field.name}", field)
        lines.append("")
    codes = {name: code for name, code in k.constants().items() if _is_code(name)}
    lines += ["/* codes */", *(_define(name, str(code)) for name, code in codes.items()), ""]
    lines += ["/* fraction bits of the lobe and of the sharpness */"]
    lines += [_define(name, str(getattr(k, name))) for name in SETTINGS]
    for name in ("SPAN", "PIXEL", "COLOURED"):
        packet = packets.PACKETS[name]
        lines += ["", f"/* {name}: {packet.meaning} */", _define(f"{name}_WORDS", str(-(-packet.width // 32)))]
        for field in packet.fields:
            lines += _place(f"{name}_{field.name.replace('.', '_')}", field)
    return "\n".join([*lines, "", "#endif", ""])


def _is_code(name: str) -> bool:
    return name.startswith(("PATH_", "MODEL_", "VARIANT_")) and not name.endswith("_W")


def _define(name: str, value: str, comment: str = "") -> str:
    line = f"#define SHADE_{name.upper():<32} {value}"
    return f"{line:<60} /* {comment} */" if comment else line


def _place(name: str, field: Field) -> list[str]:
    told = ": ".join(filter(None, (field.format, field.meaning)))
    return [_define(f"{name}_LSB", str(field.lsb)), _define(f"{name}_W", str(field.width), told)]


def systemrdl() -> str:
    """The map in SystemRDL 2.0. Signed fields and formats are told in the descriptions."""
    lines = [
        "// SPDX-License-Identifier: Apache-2.0",
        "// Registers of shade_core. Words of 32 bits; a write to a setting while STATUS.busy is answered by SLVERR.",
        "addrmap shade {",
        '  name = "shade_core";',
        "  default regwidth = 32;",
        "  addressing = compact;",
    ]
    for register in registers.every():
        lines.append("  reg {")
        for field in register.fields:
            software = "w" if field.name == "clear" else {"rw": "rw", "ro": "r"}[register.access]
            hardware = "r" if register.access == "rw" else "w"
            constant = register.name in ("ID", "VERSION")
            lines += [
                "    field {",
                f"      desc = {_quoted(field)};",
                f"      sw = {software};",
                f"      hw = {'na' if constant else hardware};",
                *(["      singlepulse;"] if field.name == "clear" else []),
                f"    }} {field.name}[{field.lsb + field.width - 1}:{field.lsb}] = {field.width}'h{field.reset:x};",
            ]
        lines.append(f"  }} {register.name} @ 0x{register.offset:x};")
    return "\n".join([*lines, "};", ""])


def _quoted(field: Field) -> str:
    told = ": ".join(filter(None, (field.format, field.meaning)))
    return '"' + told.replace("\\", "\\\\").replace('"', '\\"') + '"'


def memory_map() -> ElementTree.Element:
    """The map as an element of IP-XACT (IEEE 1685-2014)."""
    root = element("memoryMaps")
    memory = element("memoryMap", root)
    element("name", memory, "s_axil")
    block = element("addressBlock", memory)
    for name, value in {"name": "registers", "baseAddress": "'h0", "range": "'h1000", "width": "32"}.items():
        element(name, block, value)
    element("usage", block, "register")
    for register in registers.every():
        entry = element("register", block)
        element("name", entry, register.name)
        element("addressOffset", entry, f"'h{register.offset:x}")
        element("size", entry, "32")
        for field in register.fields:
            part = element("field", entry)
            element("name", part, field.name)
            element("description", part, ": ".join(filter(None, (field.format, field.meaning))))
            element("bitOffset", part, str(field.lsb))
            reset = element("reset", element("resets", part))
            element("value", reset, f"'h{field.reset:x}")
            element("bitWidth", part, str(field.width))
            access = "write-only" if field.name == "clear" else {"rw": "read-write", "ro": "read-only"}[register.access]
            element("access", part, access)
    element("addressUnitBits", memory, "8")
    return root


def element(name: str, parent: ElementTree.Element | None = None, text: str = "") -> ElementTree.Element:
    """An element of IP-XACT, the last child of its parent."""
    tag = f"{{{SPIRIT}}}{name}"
    made = ElementTree.Element(tag) if parent is None else ElementTree.SubElement(parent, tag)
    made.text = text or None
    return made
