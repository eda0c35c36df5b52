# SPDX-License-Identifier: Apache-2.0
"""Which machine to choose: area, clock rate, speed and error of every path and number of lanes: ``make machines``.

Leaves ``build/machines.json``: ``{"<path>/<lanes>/<models>/<lights>": {...}}``. :data:`MACHINES` is the list; a new one
needs its synthesis point, what draws a frame by it, and the products of a frame. Registers on AXI4-Lite are not
counted, all else from packet to pixel is. Frames: yaw 30, shininess 32 where a key says nothing else, scan
conversion by NumPy: the error is that of the machine alone.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from dataclasses import dataclass, replace

from polyshade.golden import contract as k
from polyshade.golden import core as golden
from polyshade.golden.material import Material
from polyshade.scripts.flow import synth
from polyshade.scripts.flow.points import SMALL
from polyshade.scripts.report import save
from polyshade.sim import frame
from polyshade.sim.errors import UserError
from polyshade.sim.scene.camera import Camera
from polyshade.sim.sources import BUILD, ROOT, Point
from polyshade.sim.verilate import reached
from tqdm import tqdm

OUT = BUILD / "machines.json"
WORK = BUILD / "machines"  # a row each
SCENES = {
    "head1024": ("head", 0, 1024),
    "head512": ("head", 0, 512),
    "head256": ("head", 0, 256),
    "head36k": ("head", 1, 1024),
    "sphere320": ("sphere", 0, 1024),
}
SHININESS = (8, 32, 128, 512)


@dataclass(frozen=True)
class Shot:
    """What a machine made of a frame."""

    pixels: int
    clocks: int
    evaluations: int
    products: int
    nmse_diffuse: float
    nmse_specular: float


@dataclass(frozen=True)
class Machine:
    """``top`` at ``point`` is synthesized, without module ``apart``; ``shoot(settings)`` draws a frame."""

    top: str
    point: Point
    shoot: Callable[[frame.Settings], Shot]
    apart: str | None = None


def by_path(path: str, lanes: int, products: Callable[[dict], int]) -> Callable[[frame.Settings], Shot]:
    """Frames as ``polyshade render --path`` draws them; ``products`` from the report."""

    def shoot(settings: frame.Settings) -> Shot:
        report = frame.render(replace(settings, path=path, lanes=lanes)).report
        if report["mismatches"]:
            raise RuntimeError(f"{path}: {report['mismatches']} pixels differ from the golden model")
        told = (report[name] for name in ("pixels", "cycles", "light_evaluations"))
        return Shot(*told, products(report), report["nmse_diffuse"], report["nmse_specular"])

    return shoot


def direct_products(report: dict) -> int:
    """36 for each triangle, 5 for each pixel; in this report a triangle is one that was seen."""
    return 36 * report["triangles"] + 5 * report["pixels"]


def patch_products(report: dict) -> int:
    """52 for each triangle, of the planner and the set-up, 5 for each light."""
    return 52 * report["triangles"] + 5 * report["light_evaluations"]


def line_products(report: dict) -> int:
    """Of kappa for each triangle, of the normal and its light at each node; nothing at a pixel."""
    node = k.PRODUCTS_UNIT + k.PRODUCTS_LIGHT
    return k.PRODUCTS_KAPPA * report["triangles"] + node * report["light_evaluations"]


def vector_products(report: dict) -> int:
    """At each pixel."""
    return golden.phong_products(report["pixels"], reflect=0, divide=0)


def row(path: str, lanes: int, top: str, products: Callable[[dict], int], point: Point, apart=None) -> Machine:
    """A machine that ``polyshade render --path`` draws frames by."""
    return Machine(top, point, by_path(path, lanes, products), apart)


MACHINES: dict[str, Machine] = {
    "direct/1/blinn/1": row("direct", 1, "shade_direct", direct_products, {}),
    **{f"patch/{n}/blinn/1": row("patch", n, "shade_patch", patch_products, {"LANES": n}) for n in (1, 2, 4, 8)},
    "vector/1/blinn/1": row("vector", 1, "shade_phong", vector_products, {"REFLECT": 0, "DIVIDE": 0}),
    **{
        f"line/{n}/blinn/1": row("line", n, "shade_core", line_products, {"LANES": n, **SMALL}, "shade_registers")
        for n in (1, 4)
    },
}


def area(machine: Machine) -> dict[str, float | int | None]:
    """ECP5: LUT, FF, DSP, block RAM and clock rate, of the flow of ``make synth``; what is ``apart`` is taken off."""

    def measured(module: str, point: Point) -> dict:
        design = synth.Design(module, point, reached(module))
        return synth.measure(design, "ecp5", synth.elaborate(design))

    found = dict(measured(machine.top, machine.point))
    if machine.apart:
        less = measured(machine.apart, {})
        found |= {name: found[name] - less[name] for name in ("lut", "ff", "dsp", "bram")}
    return {name: found[name] for name in ("lut", "ff", "dsp", "bram", "fmax_mhz")}


def speed(machine: Machine) -> dict[str, dict[str, float]]:
    """Pixels a clock, products and evaluations a pixel, errors."""
    settings = frame.Settings(material=Material(shininess=32.0), scan="host")

    def shoot(scene: str, material: Material) -> Shot:
        mesh, subdivide, size = SCENES[scene]
        camera = Camera(size=size, yaw=30.0)
        return machine.shoot(replace(settings, mesh=mesh, subdivide=subdivide, camera=camera, material=material))

    shots = {scene: shoot(scene, settings.material) for scene in SCENES}
    shines = {str(n): shoot("head1024", Material(shininess=float(n))) for n in SHININESS}
    return {
        "pixels_per_clock": {name: shot.pixels / shot.clocks for name, shot in shots.items()},
        "products_per_pixel": {name: shot.products / shot.pixels for name, shot in shots.items()},
        "evaluations_per_pixel": {n: shot.evaluations / shot.pixels for n, shot in shines.items()},
        "nmse_diffuse": {n: shot.nmse_diffuse for n, shot in shines.items()},
        "nmse_specular": {n: shot.nmse_specular for n, shot in shines.items()},
    }


def state() -> str:
    """A hash of all sources that a row depends on."""
    found = hashlib.sha256()
    for path in sorted(
        [*(ROOT / "rtl").rglob("*.sv"), *(ROOT / "golden").rglob("*.py"), *(ROOT / "sim").rglob("*.py")]
    ):
        found.update(path.read_bytes())
    return found.hexdigest()


def kept(name: str, key: str) -> dict | None:
    """A row that was measured from the same sources."""
    path = WORK / f"{name.replace('/', '_')}.json"
    found = json.loads(path.read_text()) if path.exists() else {"key": None}
    return found["row"] if found["key"] == key else None


def main(names: list[str] | None = None) -> dict[str, dict]:
    """Measure the named machines, or all, and leave all that are measured: a stop costs no row that is whole.

    Raises UserError for a name that is none.
    """
    for name in names or []:
        if name not in MACHINES:
            raise UserError(f"{name}: no such machine, allowed {', '.join(MACHINES)}")
    key = state()
    report = {name: found for name in MACHINES if (found := kept(name, key))}
    for name in tqdm(names or list(MACHINES), "machines", disable=None, delay=2):
        if name not in report:
            report[name] = area(MACHINES[name]) | speed(MACHINES[name])
            save(WORK / f"{name.replace('/', '_')}.json", {"key": key, "row": report[name]})
        save(OUT, {name: report[name] for name in MACHINES if name in report})
    for name, found in report.items():
        clock = found["fmax_mhz"] or 0
        rate = found["pixels_per_clock"]["head1024"]
        print(f"{name:<18}{found['lut']:>7} LUT{found['ff']:>7} FF{found['dsp']:>4} DSP{clock:>8.1f} MHz{rate:>7.3f}")
    return report
