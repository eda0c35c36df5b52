# SPDX-License-Identifier: Apache-2.0
"""FPGA families: how Yosys maps to each, what its cells count for, and which nextpnr places for it.

A family without a ``Placer`` has no place-and-route that comes as a wheel: its clock rate stays unknown.
"""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass

from polyshade.sim.errors import UserError

LUT, FF, DSP, BRAM = "lut", "ff", "dsp", "bram"


@dataclass(frozen=True)
class Placer:
    """nextpnr of a family: the wheel's program, what it is told, and the device by its name in a data sheet."""

    program: str
    options: tuple[str, ...]
    device: str
    files: tuple[tuple[str, str], ...] = ()  # files that the options name, and what they hold


@dataclass(frozen=True)
class Family:
    """How Yosys maps to a family, and what its cells count for: (pattern of the name, resource, amount).

    Cells that match nothing (wide multiplexers, carry chains whose LUTs are cells of their own, buffers, constants)
    count for nothing.
    """

    title: str
    command: str
    cells: tuple[tuple[str, str, int], ...]
    placer: Placer | None = None


# Of these every module is measured; of the others those of WIDE alone, or what ``--family`` asks for.
USUAL = ("ecp5", "ice40", "gowin", "xilinx7")
WIDE = ("shade_direct",)

LATTICE = (("LUT4", LUT, 1), ("TRELLIS_DPR16X4", LUT, 6), ("TRELLIS_FF", FF, 1))
XILINX = (
    ("LUT[1-6]|INV|SRL16E|SRLC32E", LUT, 1),
    ("RAM32X1D|RAM64X1D", LUT, 2),
    ("RAM32M|RAM64M|RAM128X1D", LUT, 4),
    ("FD[CPRS]E.*", FF, 1),
    ("DSP48E[12]", DSP, 1),
    ("RAMB18E[12]", BRAM, 1),
    ("RAMB36E[12]", BRAM, 2),
)

FAMILIES = {
    "ecp5": Family(
        "Lattice ECP5",
        "synth_ecp5",
        (*LATTICE, ("CCU2C", LUT, 2), ("MULT18X18D", DSP, 1), ("DP16KD|PDPW16KD", BRAM, 1)),
        Placer(
            "ecp5",
            (
                "--85k",
                "--package=CABGA381",
                "--speed=8",
                "--freq=200",
                "--timing-allow-fail",
                "--out-of-context",
                "--placer=static",
            ),
            "LFE5U-85F-8",
        ),
    ),
    "ice40": Family(
        "Lattice iCE40 UltraPlus",
        "synth_ice40 -device u -dsp",
        (("SB_LUT4", LUT, 1), ("SB_DFF.*", FF, 1), ("SB_MAC16", DSP, 1), ("SB_RAM40_4K.*", BRAM, 1)),
        Placer("ice40", ("--up5k", "--package", "sg48", "--freq", "60", "--timing-allow-fail"), "iCE40UP5K"),
    ),
    "nexus": Family(
        "Lattice CrossLink-NX",
        "synth_nexus -family lifcl -noiopad",
        (
            ("LUT4|INV", LUT, 1),
            ("CCU2", LUT, 2),
            ("DPR16X4", LUT, 6),
            ("FD1P3.*", FF, 1),
            ("MULT(9X9|18X18|18X36|36X36).*|MULTPREADD.*|MULTADDSUB.*", DSP, 1),
            ("PDP16K.*|PDPSC16K.*|DP16K.*|SP16K.*", BRAM, 1),
        ),
        Placer(
            "nexus",
            ("--device", "LIFCL-40-9BG400C", "--pdc", "pins.pdc", "--freq", "200", "--timing-allow-fail"),
            "LIFCL-40-9",
            (
                (
                    "pins.pdc",
                    "".join(
                        f"ldc_set_location -site {{{site}}} [get_ports {port}]\n"
                        for port, site in (("clk_i", "L13"), ("chain_i", "G14"), ("chain_o", "G15"))
                    ),
                ),
            ),
        ),
    ),
    "machxo2": Family(
        "Lattice MachXO2",
        "synth_lattice -family xo2 -noiopad",
        (*LATTICE, ("CCU2D", LUT, 2), ("DP8KC|PDPW8KC", BRAM, 1)),
    ),
    "gowin": Family(
        "Gowin GW2A",
        "synth_gowin -family gw2a -noiopads",
        (
            ("LUT[1-4]|ALU", LUT, 1),
            ("RAM16SDP4", LUT, 6),
            ("DFF.*", FF, 1),
            ("MULT(9X9|18X18|36X36)|MULTALU.*|MULTADDALU.*", DSP, 1),
            ("SP|SPX9|SDPB|SDPX9B|DPB|DPX9B|pROM.*", BRAM, 1),
        ),
        Placer(
            "himbaechel-gowin",
            (
                "--device",
                "GW2A-LV18PG256C8/I7",
                "--vopt",
                "family=GW2A-18",
                "--vopt",
                "cst=pins.cst",
                "--freq",
                "200",
                "--timing-allow-fail",
            ),
            "GW2A-18 C8/I7",
            (("pins.cst", ""),),
        ),
    ),
    "gatemate": Family(
        "Cologne Chip GateMate",
        "synth_gatemate -luttree -nomx8 -nomx4 -noiopad -noclkbuf",
        (
            ("CC_LUT[1-4]|CC_L2T[4-6]|CC_MX2|CC_ADDF", LUT, 1),
            ("CC_DFF|CC_DLT", FF, 1),
            ("CC_MULT", DSP, 1),
            ("CC_BRAM_20K|CC_FIFO_40K", BRAM, 1),
            ("CC_BRAM_40K", BRAM, 2),
        ),
        Placer(
            "himbaechel-gatemate",
            ("--device", "CCGM1A1", "--vopt", "allow-unconstrained", "--freq", "100", "--timing-allow-fail"),
            "CCGM1A1",
        ),
    ),
    "xilinx7": Family("AMD 7 series", "synth_xilinx -family xc7 -noiopad -noclkbuf", XILINX),
    "ultrascale": Family("AMD UltraScale+", "synth_xilinx -family xcup -noiopad -noclkbuf", XILINX),
    "cyclonev": Family(
        "Intel Cyclone V",
        "synth_intel_alm -family cyclonev",
        (
            ("MISTRAL_(ALUT[2-6]|ALUT_ARITH|NOT)", LUT, 1),
            ("MISTRAL_MLAB", LUT, 2),
            ("MISTRAL_FF", FF, 1),
            ("MISTRAL_MUL(9X9|18X18|27X27)", DSP, 1),
            ("MISTRAL_M(10K|20K)", BRAM, 1),
        ),
    ),
    "polarfire": Family(
        "Microchip PolarFire",
        "synth_microchip -family polarfire -noiopad",
        (
            ("CFG[1-4]|ARI1", LUT, 1),
            ("RAM64x12", LUT, 12),
            ("SLE.*", FF, 1),
            ("MACC_PA", DSP, 1),
            ("RAM1K20", BRAM, 1),
        ),
    ),
    "efinix": Family(
        "Efinix Trion",
        "synth_efinix",
        (("EFX_LUT4|EFX_ADD", LUT, 1), ("EFX_FF", FF, 1), ("EFX_MULT", DSP, 1), ("EFX_RAM_5K", BRAM, 1)),
    ),
}


def family(name: str) -> Family:
    """A family by its name; UserError for one that is not known."""
    if name not in FAMILIES:
        raise UserError(f"{name}: no such family, allowed {', '.join(FAMILIES)}")
    return FAMILIES[name]


def count(name: str, cells: dict[str, int]) -> dict[str, int]:
    """Resources of a family that its cells take: ``count("ecp5", {"CCU2C": 3})["lut"]`` is 6."""
    total = Counter({LUT: 0, FF: 0, DSP: 0, BRAM: 0})
    for cell, number in cells.items():
        for pattern, resource, amount in FAMILIES[name].cells:
            if re.fullmatch(pattern, cell):
                total[resource] += amount * number
    return dict(total)
