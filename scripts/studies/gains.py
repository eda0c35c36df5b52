# SPDX-License-Identifier: Apache-2.0
"""What the core gains over its yardstick ``shade_phong``: the same spans, the same light; part of ``make bench``.

Products of two 18-bit numbers that are executed for a pixel, and pixels a clock, of the default head and of a sphere of
320 triangles, which has long spans, at 1024 x 1024, Blinn-Phong, n = 32.
Both compute the Blinn-Phong light alone (REFLECT = 0, DIVIDE = 0). Every pixel is compared with the golden model.

Beside them what the weight of kappa saves: light evaluations a pixel of every eighth span of the head, and NMSE of its
highlight against float64, n = 8 to 512, with the weight and without, by the golden model alone.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import core as golden
from polyshade.golden.material import Material, planner_registers, registers
from polyshade.golden.registers import draw, pack
from polyshade.sim import frame
from polyshade.sim.core import WHOLE, Lines
from polyshade.sim.errors import UserError
from polyshade.sim.scene.camera import Camera
from polyshade.sim.scene.mesh import load_mesh
from polyshade.sim.scene.raster import scan_convert

PLAIN = {"REFLECT": 0, "DIVIDE": 0}
CORE = PLAIN | {"PATH_NORMALS": 0}
LIGHT = (0.3, 0.6, 0.8)
MESHES = ("head", "sphere")


def main(size: int = 1024, tick: Callable[[str], object] = lambda name: None) -> Iterator[tuple[str, dict]]:
    """Rows of ``build/bench.json``. ``ratio`` is the value over that of ``versus``."""
    surface = Material()
    words = registers(surface, LIGHT) | planner_registers(surface)
    for name in MESHES:
        mesh = load_mesh(name)
        lines = Lines.of(scan_convert(Camera(size).project(mesh), mesh.faces, size))
        drawn = golden.lane(lines.n, lines.g, lines.count, words, reflect=0, divide=0)
        exact, _ = golden.phong(lines.n, lines.g, lines.count, words, reflect=0, divide=0)
        tick(f"phong {name}")
        bus = WHOLE | {"writes": pack(words)}
        clocks = {"phong": _clocks("shade_phong", lines, exact, PLAIN, draw_i=draw(words))}
        tick(f"core {name}")
        clocks["core"] = _clocks("shade_core", lines, drawn.pixels, CORE, **bus)
        tick(f"core folded {name}")
        clocks["core_folded"] = _clocks("shade_core", lines, drawn.pixels, CORE | {"FOLD": 6}, **bus)
        rates = {f"pixels_per_clock_{unit}_{name}": len(exact) / n for unit, n in clocks.items()}
        yield from _rows(rates, "pixels/clock", f"pixels_per_clock_phong_{name}")
        products = {
            f"products_core_{name}": golden.products(lines.g, drawn, reflect=0, divide=0) / len(exact),
            f"products_phong_{name}": golden.phong_products(len(exact), reflect=0, divide=0) / len(exact),
        }
        yield from _rows(products, "18x18 products/pixel", f"products_core_{name}")
    tick("weight of kappa")
    yield from weighed(size)


def weighed(size: int = 1024) -> Iterator[tuple[str, dict]]:
    """Rows ``evaluations_``, ``nmse_diffuse_``, ``nmse_specular_`` of shininess and form, weighed versus plain."""
    mesh = load_mesh("head")
    spans = scan_convert(Camera(size, yaw=30.0).project(mesh), mesh.faces, size)[::8]
    lines = Lines.of(spans)
    for n in (8, 32, 128, 512):
        surface = Material(shininess=float(n))
        words = registers(surface, LIGHT) | planner_registers(surface)
        exact = frame.reference(spans, size, surface, LIGHT)
        for form in ("plain", "weighed"):
            chosen = words | ({"weight": 0} if form == "plain" else {})
            drawn = golden.lane(lines.n, lines.g, lines.count, chosen, reflect=0, divide=0)
            told = frame.errors(drawn.pixels / frame.ONE, exact, np.arange(len(exact)))
            values = {"evaluations": len(drawn.flags) / len(exact)}
            values |= {name: told[name] for name in ("nmse_diffuse", "nmse_specular")}
            if form == "plain":
                plain = values
            for name, value in values.items():
                unit = "evaluations/pixel" if name == "evaluations" else "NMSE"
                versus = {"versus": f"{name}_n{n}_plain", "ratio": value / plain[name]}
                yield f"{name}_n{n}_{form}", {"value": value, "unit": unit} | versus


def _rows(values: dict[str, float], unit: str, versus: str) -> Iterator[tuple[str, dict]]:
    for name, value in values.items():
        yield name, {"value": value, "unit": unit, "versus": versus, "ratio": value / values[versus]}


def _clocks(module: str, lines: Lines, wanted: np.ndarray, parameters: dict[str, int], **inputs) -> int:
    """Clocks of a frame through a module. UserError if a pixel differs from the golden model's."""
    model = sim.load(module, waves=False, **parameters)
    run = model.run(s_axis_span_tdata=lines.beats, **inputs)
    if not np.array_equal(run.m_axis_pixel_tdata, wanted[:, 0] | wanted[:, 1] << k.PIXEL_W):
        raise UserError(f"{model!r}: pixels differ from the golden model, see make test")
    return int(run.given[-1] - run.taken[0] + 1)
