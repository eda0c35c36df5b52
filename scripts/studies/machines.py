# SPDX-License-Identifier: Apache-2.0
"""Which machine to choose: area, clock rate, speed and error of every path and number of lanes: ``make machines``.

Leaves ``build/machines.json``: ``{"<path>/<lanes>/<models>/<lights>": {...}}``. :data:`MACHINES` is the list; a new one
needs its synthesis point, what draws a frame by it, and the products of a frame. Registers on AXI4-Lite are not
counted, all else from packet to pixel is. Frames: yaw 30, shininess 32 where a key says nothing else.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from polyshade import sim
from polyshade.golden import core as golden
from polyshade.golden import registers
from polyshade.golden.material import Material
from polyshade.scripts.flow import synth
from polyshade.scripts.report import save
from polyshade.sim import frame
from polyshade.sim.core import Lines
from polyshade.sim.scene.camera import Camera
from polyshade.sim.scene.raster import resolve, scan_convert
from polyshade.sim.sources import BUILD, Point
from polyshade.sim.verilate import reached
from tqdm import tqdm

OUT = BUILD / "machines.json"
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


def vector(settings: frame.Settings) -> Shot:
    """A frame by ``shade_phong``, Lambert and Blinn-Phong."""
    built = {"REFLECT": 0, "DIVIDE": 0}
    mesh, size = settings.load(), settings.camera.size
    screen = settings.camera.project(mesh)
    spans = scan_convert(screen, mesh.faces, size)
    lines = Lines.of(spans)
    run = sim.load("shade_phong", **built).run(s_axis_span_tdata=lines.beats, draw_i=registers.draw(settings.registers))
    wanted, _ = golden.phong(lines.n, lines.g, lines.count, settings.registers, reflect=0, divide=0)
    pixels = np.stack([run.m_axis_pixel_tdata & 0xFFFF, run.m_axis_pixel_tdata >> 16], axis=-1)
    if not np.array_equal(pixels, wanted):
        raise RuntimeError("shade_phong: pixels differ from the golden model")
    exact = frame.reference(spans, size, settings.material, settings.light)
    told = frame.errors(pixels / frame.ONE, exact, resolve(spans, size))
    clocks = int(run.given[-1] - run.taken[0] + 1)
    products = golden.phong_products(len(pixels), reflect=0, divide=0)
    return Shot(len(pixels), clocks, len(pixels), products, told["nmse_diffuse"], told["nmse_specular"])


MACHINES: dict[str, Machine] = {
    "direct/1/blinn/1": Machine("shade_direct", {}, by_path("direct", 1, direct_products)),
    "vector/1/blinn/1": Machine("shade_phong", {"REFLECT": 0, "DIVIDE": 0}, vector),
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
    settings = frame.Settings(material=Material(shininess=32.0))

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


def main() -> dict[str, dict]:
    """Measure every machine; the report is whole or as it was."""
    report = {
        name: area(machine) | speed(machine)
        for name, machine in tqdm(MACHINES.items(), "machines", disable=None, delay=2)
    }
    save(OUT, report)
    for name, found in report.items():
        clock = found["fmax_mhz"] or 0
        rate = found["pixels_per_clock"]["head1024"]
        print(f"{name:<18}{found['lut']:>7} LUT{found['ff']:>7} FF{found['dsp']:>4} DSP{clock:>8.1f} MHz{rate:>7.3f}")
    return report
