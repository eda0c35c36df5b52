# SPDX-License-Identifier: Apache-2.0
"""A SoC of LiteX in Verilator: ``make soc``. A program in C on its soft core draws a picture by ``shade_core``.

The SoC (``scripts/handoff/litex``) is made by LiteX with a VexRiscv, its program compiled by Zig; both live
in an environment of their own, ``.venv/soc``. Every pixel that the program prints is compared with the golden model:
``build/soc/report.json``.
"""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
from polyshade.golden import core as golden
from polyshade.golden import registers
from polyshade.scripts.handoff.configurations import CONFIGURATIONS
from polyshade.scripts.handoff.flows import listed
from polyshade.scripts.handoff.verify import COMPILER
from polyshade.scripts.report import save
from polyshade.sim import core, frame, verilate
from polyshade.sim.errors import UserError
from polyshade.sim.scene.camera import Camera
from polyshade.sim.scene.raster import scan_convert
from polyshade.sim.sources import BUILD, ROOT
from polyshade.sim.tools import verilator

HERE = ROOT / "scripts" / "handoff" / "litex"
DRIVER = ROOT / "scripts" / "handoff" / "driver"
PYTHON = ROOT / ".venv" / "soc" / "bin" / "python"
WORK = BUILD / "soc"
SIZE = 24  # of the picture
TARGET = ["-target", "riscv32-freestanding-none", "-mcpu=generic_rv32", "-mabi=ilp32"]
CLOCKS = 20_000_000  # a picture takes about a tenth of it
TOO_LONG = 1200  # seconds


def drawing(lines: core.Lines, words: dict[int, int]) -> str:
    """Words and spans for the program. A soft core without floating point takes the words from a table."""
    pairs = ", ".join(f"{{0x{offset:03x}, 0x{word:08x}u}}" for offset, word in words.items())
    count, flat, cosine = (np.broadcast_to(part, len(lines.n)) for part in (lines.count, lines.flat, lines.cosine))
    spans = "".join(
        f"    {{{{{', '.join(map(str, n))}}}, {{{', '.join(map(str, g))}}}, {c}, {t}, {v}, {int(f)}}},\n"
        for n, g, c, t, v, f in zip(lines.n, lines.g, count, lines.tag, cosine, flat, strict=True)
    )
    return (
        '#include "shade.h"\n'
        f"enum {{ WORDS = {len(words)}, SPANS = {len(lines.n)} }};\n"
        f"static const struct shade_word words[] = {{{pairs}}};\n"
        f"static const struct shade_span spans[] = {{\n{spans}}};\n"
    )


def bundle(folder: Path) -> Path:
    """What the wrapper reads of a bundle: the sources and the list of the core."""
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "lists").mkdir(parents=True)
    shutil.copytree(ROOT / "rtl", folder / "rtl")
    names = listed(CONFIGURATIONS["core_small"])
    (folder / "lists" / "core.f").write_text("".join(f"../{name}\n" for name in names))
    return folder


def build(text: str, work: Path = WORK) -> Path:
    """SoC and program of such a drawing.h, compiled; the simulation's path."""
    if not PYTHON.exists():
        raise UserError(f"{PYTHON.relative_to(ROOT)}: LiteX is not installed, make it with: make soc")
    work.mkdir(parents=True, exist_ok=True)
    (work / "drawing.h").write_text(text)
    made = [PYTHON, HERE / "soc.py", bundle(work / "bundle"), work]
    verilate.run(made, work)  # the addresses
    flags = ["-std=c99", "-Os", "-Wall", "-Wextra", "-Werror", "-ffreestanding", "-nostdlib", "-ffunction-sections"]
    link = ["-Wl,--gc-sections", "-Wl,-T," + str(HERE / "link.ld"), "-I", str(DRIVER), "-I", str(work)]
    zig = [PYTHON, "-m", "ziglang"]
    verilate.run([*zig, "cc", *TARGET, *flags, *link, HERE / "main.c", DRIVER / "shade.c", "-o", "program.elf"], work)
    verilate.run([*zig, "objcopy", "-O", "binary", "program.elf", "program.bin"], work)
    verilate.run([*made, work / "program.bin"], work)
    options = ["--cc", "--exe", "-O3", "-Wno-fatal", "--noassert", "--prefix", "Vsoc", "--top-module", "soc"]
    options += ["--Mdir", "obj", "-CFLAGS", "-O1", "-f", "sources.f", str(HERE / "main.cpp")]
    verilate.run([verilator().program, *options], work)
    verilate.run(["make", "-s", "-C", "obj", "-f", "Vsoc.mk", *COMPILER, "Vsoc"], work)
    return work / "obj" / "Vsoc"


def draw(size: int = SIZE, work: Path = WORK) -> dict:
    """Draw the default head on the SoC, compare: ``pixels, mismatches, first, clocks``."""
    settings = frame.Settings(camera=Camera(size), path="line")
    mesh = settings.load()
    lines = core.Lines.of(scan_convert(settings.camera.project(mesh), mesh.faces, size))
    wanted = golden.lane(lines.n, lines.g, lines.count, settings.registers, flat=lines.flat, cosine=lines.cosine)
    tags = lines.tag[wanted.span]
    expected = [f"{t:04x} {s << 16 | d:08x}" for t, (d, s) in zip(tags, wanted.pixels.tolist(), strict=True)]
    program = build(drawing(lines, registers.pack(settings.registers)), work)
    done = subprocess.run([program, str(CLOCKS)], cwd=work, text=True, capture_output=True, timeout=TOO_LONG)
    *given, last = done.stdout.splitlines()
    given = [line for line in given if line != "done"]
    differ = [i for i, pair in enumerate(zip(expected, given, strict=False)) if pair[0] != pair[1]]
    wrong = len(differ) + abs(len(expected) - len(given))
    first = [expected[differ[0]], given[differ[0]]] if differ else []
    clocks = int(last) if last.isdigit() else 0
    return {"pixels": len(expected), "mismatches": wrong or int(not clocks), "first": first, "clocks": clocks}


def main() -> int:
    """1 when a pixel differs."""
    told = draw()
    save(WORK / "report.json", told)
    pixels, wrong, clocks = (told[name] for name in ("pixels", "mismatches", "clocks"))
    print(f"{pixels} pixels of a C program on a VexRiscv, {wrong} mismatches, {clocks} clocks")
    return int(told["mismatches"] > 0)
