# SPDX-License-Identifier: Apache-2.0
"""The ULX3S: tables of the machine, its golden model, what comes out of its video pins, its bitstream.

``make board BOARD=ulx3s`` leaves ``build/board/ulx3s/ulx3s.bit`` and ``report.json``: clock rates and what is used.
``capture`` runs the whole board in Verilator and takes the pictures off the pins; ``picture`` is what they must be, bit
for bit.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from dataclasses import dataclass
from functools import cache
from math import cos, pi, sin
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from polyshade.golden import core as golden_core
from polyshade.golden import light, raster
from polyshade.golden.material import Material, planner_registers, registers
from polyshade.golden.registers import pack, unpack
from polyshade.scripts.boards.decimate import decimate
from polyshade.scripts.flow import tools
from polyshade.scripts.handoff.verify import COMPILER
from polyshade.scripts.report import save
from polyshade.sim import verilate
from polyshade.sim.errors import UserError
from polyshade.sim.scene.mesh import load_mesh
from polyshade.sim.sources import BUILD, ROOT
from polyshade.sim.tools import environment, verilator

Ints = NDArray[np.int64]

HERE = ROOT / "boards" / "ulx3s"
WORK = BUILD / "board" / "ulx3s"
TOP = "ulx3s"
OWN = sorted((HERE / "rtl").glob("*.sv"), key=lambda path: (path.stem == TOP, path.stem == "board_machine", path.stem))
COLUMNS, LINES = 320, 240
VERTICES = 500  # of the head, at most 512
RADIUS = 118 * 256  # half of its height, in 1/256 pixel
LENGTH = 0.98 * 32767  # of a normal
LIGHT = (0.3, 0.6, 0.8)
MODELS = ("blinn", "phong", "cook-torrance", "ward")
LEVELS = ((8, 0.6), (32, 0.45), (128, 0.3), (512, 0.2))  # shininess, roughness
SEED = 1
RATES = {"clk": 25.0, "fast": 125.0}  # MHz
AMBIENT, KD, KS = (6095, 4588, 3801), (48759, 36700, 30409), (22938,) * 3  # board_picture
BACKGROUND = (28, 31, 36)
TOO_LONG = 1800  # seconds of simulation
WIDTH, HEIGHT = 800, 525  # a picture with its blanks, in pixel clocks and lines


@dataclass(frozen=True)
class Head:
    """The mesh as the board has it: places in 1/256 pixel, normals S0.15 (V, 3), corners (T, 3)."""

    places: Ints
    normals: Ints
    faces: Ints


def sources() -> list[Path]:
    """The files of the product that the machine is made of."""
    tops = ("shade_core", "shade_spans", "shade_colour")
    return list(dict.fromkeys(path for top in tops for path in verilate.reached(top)))


@cache
def head() -> Head:
    """The default head with fewer triangles, centred on its vertical axis, normals a little shorter than 1."""
    mesh = load_mesh("head")
    faces = decimate(mesh.vertices, mesh.faces, VERTICES)
    used, corner = np.unique(faces, return_inverse=True)
    points, normals = mesh.vertices[used], mesh.normals[used]
    centre = (points.max(axis=0) + points.min(axis=0)) / 2
    scale = RADIUS / (np.ptp(points[:, 1]) / 2)
    places = np.rint((points - centre) * scale).astype(np.int64)
    return Head(places, np.rint(normals * LENGTH).astype(np.int64), corner.reshape(faces.shape))


def material(model: int, level: int) -> Material:
    """What the buttons have chosen."""
    shininess, roughness = LEVELS[level]
    return Material(MODELS[model], shininess, roughness, f0=0.5)


def settings(model: int, level: int) -> dict[int, int]:
    """The words of a choice, by offset."""
    surface = material(model, level)
    return pack(registers(surface, LIGHT) | planner_registers(surface))


def angle(step: int) -> tuple[int, int]:
    """cos and sin of a step of 256, S1.16."""
    turn = 2 * pi * step / 256
    return round(cos(turn) * 65536), round(sin(turn) * 65536)


def tables() -> dict[str, str]:
    """What the block RAMs hold, as $readmemh reads it."""
    mesh = head()
    rows = np.concatenate([mesh.places, mesh.normals], axis=1)
    vertices = [sum((int(v) & 0xFFFF) << 16 * i for i, v in enumerate(row)) for row in rows]
    triangles = [sum(int(v) << 10 * i for i, v in enumerate(row)) for row in mesh.faces]
    angles = [(s & 0x3FFFF) << 18 | c & 0x3FFFF for c, s in map(angle, range(256))]
    words = []
    for choice in range(32):
        entries = settings(choice >> 2 & 3, choice & 3)
        assert len(entries) == 15
        words += [offset << 32 | word for offset, word in entries.items()] + [0xFFF << 32]
    return {
        f"{name}.hex": "".join(f"{row:x}\n" for row in [*table, *[0] * (depth - len(table))])
        for name, table, depth in (
            ("vertices", vertices, 512),
            ("triangles", triangles, 1024),
            ("angles", angles, 256),
            ("settings", words, 512),
        )
    }


# ---- golden ------------------------------------------------------------------------------------------------------


def turned(step: int) -> raster.Vertices:
    """The triangles as they are sent to scan conversion (board_rotate, board_triangles)."""
    mesh = head()
    c, s = angle(step)

    def about(v: Ints) -> tuple[Ints, Ints]:
        x, z = v[:, 0], v[:, 2]
        return x * c + z * s + 32768 >> 16, z * c - x * s + 32768 >> 16

    (x, z), (nx, nz) = about(mesh.places), about(mesh.normals)
    normal = np.stack([nx, mesh.normals[:, 1], nz], axis=-1) * 2
    column, line, depth = COLUMNS * 128 + x, LINES * 128 - mesh.places[:, 1], (32768 - z) << 8
    f = mesh.faces
    zero = np.zeros(len(f), np.int64)
    return raster.Vertices(column[f], line[f], depth[f], normal[f], zero, zero)


def drawn(step: int, model: int, level: int) -> Ints:
    """(240, 320): what the frame buffer holds of a picture: {1, specular U0.4, diffuse U0.7}, 0 where nothing is."""
    found = raster.scan(turned(step), raster.View(COLUMNS, LINES))
    spans = raster.lines(found)
    normal, increment = (np.stack([spans[f"{n}.{a}"] for a in "xyz"], axis=-1) for n in ("normal", "increment"))
    values = {name: v for offset, word in settings(model, level).items() for name, v in unpack(offset, word).items()}
    told = golden_core.core(normal, increment, spans["count"], values, flat=spans["flat"], path_normals=0)
    _, column, line, depth = raster.depths(found)
    depth = np.minimum(depth >> 13, 0x7FE)
    light = 1 << 11 | told.pixels[:, 1] >> 12 << 7 | told.pixels[:, 0] >> 9
    place = line * COLUMNS + column
    order = np.lexsort((np.arange(len(place)), depth, place))
    first = order[np.r_[True, np.diff(place[order]) != 0]]
    picture = np.zeros(COLUMNS * LINES, np.int64)
    picture[place[first]] = light[first]
    return picture.reshape(LINES, COLUMNS)


def picture(step: int, model: int, level: int) -> NDArray[np.uint8]:
    """(480, 640, 3): the picture on the screen."""
    word = drawn(step, model, level)
    diffuse = (word & 0x7F) << 9 | (word & 0x7F) << 2 | word >> 5 & 3
    specular = (word >> 7 & 0xF) * 0x1111
    channels = [light.colour(diffuse, specular, AMBIENT[c], KD[c], KS[c]) >> 8 for c in range(3)]
    seen = (word >> 11 == 1)[..., None]
    small = np.where(seen, np.stack(channels, axis=-1), BACKGROUND).astype(np.uint8)
    return small.repeat(2, axis=0).repeat(2, axis=1)


# ---- simulation --------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Shot:
    """A picture off the pins: which one it is, the choice of model and level it was drawn with, its pixels."""

    number: int
    model: int
    level: int
    pixels: NDArray[np.uint8]


def capture(frames: int, model: int = -1, level: int = -1, work: Path = WORK / "sim") -> list[Shot]:
    """Run board and screen for so many pictures; the buttons are pressed in pictures ``model`` and ``level``."""
    work.mkdir(parents=True, exist_ok=True)
    for name, text in tables().items():
        (work / name).write_text(text)
    program = verilator().program
    sizes = {"VERTEX_COUNT": len(head().places), "TRIANGLE_COUNT": len(head().faces)}
    given = [f"-G{name}={value}" for name, value in sizes.items()]
    listed = [*sources(), *OWN, HERE / "sim" / "primitives.v", HERE / "sim" / "bench.sv"]
    options = [
        "--cc",
        "--main",
        "--exe",
        "--timing",
        "-O3",
        "-Wno-fatal",
        "--prefix",
        "Vboard",
        "--top-module",
        "bench",
    ]
    options += ["--x-assign", "fast", "--x-initial", "fast", "--noassert", "--Mdir", "obj", "-CFLAGS", "-O1"]
    verilate.run([program, *options, *given, *listed], work)
    verilate.run(["make", "-s", "-C", "obj", "-f", "Vboard.mk", *COMPILER, "Vboard"], work)
    pressed = [f"+{name}={at}" for name, at in (("model", model), ("level", level)) if at >= 0]
    subprocess.run(
        [work / "obj" / "Vboard", f"+frames={frames}", *pressed],
        cwd=work,
        check=True,
        capture_output=True,
        timeout=TOO_LONG,
    )
    return screen((work / "symbols.txt").read_text())


def screen(text: str) -> list[Shot]:
    """The pictures in the symbols that the bench has written; each was drawn while the one before was shown."""
    parts = re.split(r"^frame (\d+) (\d+) (\d+)$", text, flags=re.MULTILINE)[1:]
    shots, choices = [], {}
    for number, model, level, body in zip(*(parts[i::4] for i in range(4)), strict=True):
        choices[int(number)] = int(model), int(level)
        words = np.array([int(word, 16) for word in body.split()], np.int64)
        before = int(number) - 1
        if len(words) == WIDTH * HEIGHT and before in choices:
            shots.append(Shot(before, *choices[before], _shown(words)))
    return shots


def _shown(words: Ints) -> NDArray[np.uint8]:
    """The pixels of a picture that begins with its vertical sync."""
    rows = np.roll(words.reshape(HEIGHT, WIDTH), 490 - HEIGHT, axis=0)[:480]
    edge = np.flatnonzero(np.isin(rows[0] & 0x3FF, [0b1101010100, 0b0010101011, 0b0101010100, 0b1010101011]))
    first = (edge[-1] + 1) % WIDTH if edge[-1] != WIDTH - 1 else (edge[np.flatnonzero(np.diff(edge) > 1)] + 1)[:1].sum()
    rows = np.roll(rows, -int(first), axis=1)[:, :640]
    return np.stack([decoded(rows >> 20 - 10 * i & 0x3FF) for i in range(3)], axis=-1)


def decoded(symbol: Ints) -> NDArray[np.uint8]:
    """The bytes of symbols of DVI: inverted or not by bit 9, XOR or XNOR by bit 8."""
    low = np.where(symbol >> 9 & 1, ~symbol, symbol) & 0xFF
    changes = low ^ (low << 1)
    return np.where(symbol >> 8 & 1, changes, changes ^ 0xFE).astype(np.int64).astype(np.uint8)


# ---- bitstream ---------------------------------------------------------------------------------------------------


def main() -> None:
    """Leave the bitstream and the report; UserError when timing is not met."""
    for name, text in tables().items():
        WORK.mkdir(parents=True, exist_ok=True)
        (WORK / name).write_text(text)
    tech = [ROOT / "rtl" / "tech" / "ecp5" / f"{name}.sv" for name in ("shade_mul_block", "shade_mul")]
    listed = [part for path in sources() for part in (tech if path.stem == "shade_mul" else [path])]
    files = " ".join(os.path.relpath(path, WORK) for path in [*listed, *OWN])
    sizes = f"-chparam VERTEX_COUNT {len(head().places)} -chparam TRIANGLE_COUNT {len(head().faces)}"
    tools.yosys(
        f"""
        read_verilog -lib +/ecp5/cells_bb.v
        read_verilog -sv {files}
        hierarchy -check -top {TOP} {sizes}
        synth_ecp5 -top {TOP} -json {TOP}.json
        """,
        WORK,
    )
    constraints = os.path.relpath(HERE / "ulx3s.lpf", WORK)
    (WORK / "ulx3s.lpf").write_text((WORK / constraints).read_text())
    options = [
        "--85k",
        "--package=CABGA381",
        "--speed=6",
        f"--seed={SEED}",
        # nearly every block RAM is used: with the defaults wires are twice as long and routing does not end
        "--placer=static",
        "--router=router2",
        "--json",
        f"{TOP}.json",
        "--lpf",
        "ulx3s.lpf",
    ]
    # nextpnr ends with an error where a clock is missed
    tools.nextpnr_ecp5([*options, "--textcfg", f"{TOP}.config", "--report", "nextpnr.json"], WORK)
    pack_ = [str(Path(sys.executable).parent / "yowasp-ecppack"), "--compress", f"{TOP}.config", f"{TOP}.bit"]
    done = subprocess.run(pack_, cwd=WORK, env=environment(), text=True, capture_output=True)
    if done.returncode:
        raise UserError(f"ecppack: {done.stderr.strip().splitlines()[-1]}")
    report = json.loads((WORK / "nextpnr.json").read_text())
    rates = {name: (clock["achieved"], clock["constraint"]) for name, clock in report["fmax"].items()}
    used = {bel: entry for bel, entry in report["utilization"].items() if entry["used"]}
    save(WORK / "report.json", {"fmax_mhz": rates, "utilization": used, "seed": SEED})
    for name, (reached, wanted) in rates.items():
        print(f"{name}: {reached:.1f} MHz, needed {wanted:.1f}")
    for bel, entry in used.items():
        print(f"{bel}: {entry['used']} of {entry['available']}")
    print(f"{os.path.relpath(WORK / f'{TOP}.bit')}: {(WORK / f'{TOP}.bit').stat().st_size >> 10} KiB")
