# SPDX-License-Identifier: Apache-2.0
"""Boxes of patches: lights a pixel and the error, by node set, tolerance and weight; leaves ``build/patches.json``.

    python -m polyshade.scripts.studies.patches

The head at 1024, light and camera of ``polyshade render``, against float64 light of each pixel's normalized normal.
In float64, so that the choice of nodes stands alone; the integer model is ``golden.patch``.

* ``inner``: the middle, and 1/2 of the way to the four corners and to the right: what ``shade_patch`` has;
* ``edge``: the upper and the left edge at 0, 1/2, 1, and the middle: the six nodes that are pixels of neighbours, too.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from polyshade.golden import patch
from polyshade.golden.material import Material
from polyshade.scripts.report import save
from polyshade.sim.scene.camera import Camera
from polyshade.sim.scene.mesh import load_mesh
from polyshade.sim.scene.raster import expand, resolve, scan_convert
from polyshade.sim.scene.triangles import Triangles
from polyshade.sim.sources import BUILD

Floats = NDArray[np.float64]
OUT = BUILD / "patches.json"
LIGHT = (0.3, 0.6, 0.8)
SHININESS = (8, 32, 128, 512)


class Scene:
    """The head's pixels and triangles."""

    def __init__(self, size: int = 1024):
        mesh = load_mesh("head")
        spans = scan_convert(Camera(size=size).project(mesh), mesh.faces, size)
        given = Triangles.of(spans)
        self.t = patch.Triangles(*(getattr(given, name) for name in patch.Triangles._fields))
        every = expand(spans, size)
        normal = spans.normal[every.span] + every.step[:, None] * spans.gradient[every.span]
        self.normal = normal / np.linalg.norm(normal, axis=1)[:, None]
        first = np.flatnonzero(np.diff(self.t.triangle, prepend=-1))
        self.of = self.t.triangle[every.span]
        self.x = every.place % size - (self.t.column[first] - self.t.box[:, 2])[self.of]
        self.y = every.place // size - self.t.line[first][self.of]
        seen = resolve(spans, size)
        self.seen = seen[seen >= 0]


def fit(light, nodes: str) -> tuple[Floats, ...]:
    """C, s, t, p, q, r over X, Y in [-1, 1) from ``light(i, j)``, i, j in halves of half a box."""
    if nodes == "inner":
        b, a, g, f, c, e = (light(i, j) for i, j in patch.NODES)
        c, s2, t2, p, q, r = (
            c,
            a + b - f - g,
            a + f - b - g,
            4 * (e - c) - a - b + f + g,
            a - b - f + g,
            2 * (a + b) - 4 * e,
        )
        return c, s2 / 2, t2 / 2, p, q, r
    o, h, w, v, z, m = (light(i, j) for i, j in ((-2, -2), (0, -2), (2, -2), (-2, 0), (-2, 2), (0, 0)))
    d, e = 2 * (o - 2 * h + w), 2 * (o - 2 * v + z)
    b, c, q = w - o - d, z - o - e, 4 * (m - h - v + o)  # of u = (X + 1) / 2, v = (Y + 1) / 2
    return (
        o + b / 2 + d / 4 + c / 2 + e / 4 + q / 4, b / 2 + d / 2 + q / 4, c / 2 + e / 2 + q / 4, d / 4, q / 4, e / 4,
    )  # fmt: skip


def measure(scene: Scene, n: float, nodes: str, tolerance: float, weighted: bool) -> dict[str, float]:
    """Lights a pixel and the NMSE of both channels."""
    material, t = Material("blinn", n), scene.t
    words, _ = patch.registers(material, LIGHT, weighted)
    words = words._replace(radius=min(int(np.sqrt(2 * tolerance / max(n, 2)) * 65536), 1 << 15))
    kx, ky, curved = patch.plan(t, words)
    of, x, y = scene.of, scene.x, scene.y
    key = (of << 24) | (y >> ky[of]) << 12 | x >> kx[of]
    key, inside, pixels = np.unique(key, return_inverse=True, return_counts=True)
    bt = key >> 24
    direct = (curved[bt] == 1) | ((kx[bt] == 2) & (ky[bt] == 2) & (pixels <= 6))
    half = np.stack([2.0 ** (kx[bt] - 1), 2.0 ** (ky[bt] - 1)], axis=-1)
    middle = np.stack([(2 * (key & 4095) + 1) * half[:, 0], (2 * (key >> 12 & 4095) + 1) * half[:, 1]], axis=-1)
    gx, gy = (g / 65536 / 2.0 ** e[:, None] for g, e in ((t.dcolumn, t.dcolumn_exp), (t.dline, t.dline_exp)))
    corner = (t.normal / 65536 - t.box[:, 2:] * gx)[bt]

    def light(i: int, j: int) -> Floats:
        at = middle + half * np.array([i, j]) / 2
        normal = corner + at[:, :1] * gx[bt] + at[:, 1:] * gy[bt]
        return material.channels(normal / np.maximum(np.linalg.norm(normal, axis=1), 1e-9)[:, None], LIGHT)

    c, s, u, p, q, r = (part[inside] for part in fit(light, nodes))
    dx, dy = ((np.stack([x, y], axis=-1) - middle[inside]) / half[inside]).T[..., None]
    exact = material.channels(scene.normal, LIGHT).clip(0, 1)
    found = (c + s * dx + u * dy + p * dx * dx + q * dx * dy + r * dy * dy).clip(0, 1)
    found = np.where(direct[inside][:, None], exact, found)
    error = ((found - exact)[scene.seen] ** 2).sum(axis=0) / (exact[scene.seen] ** 2).sum(axis=0)
    lights = np.where(direct, pixels, 6).sum() / len(x)
    return {"evaluations_per_pixel": float(lights), "nmse_diffuse": float(error[0]), "nmse_specular": float(error[1])}


def main() -> dict[str, dict]:
    """Measure all of it, leave it and print it."""
    scene, report = Scene(), {}
    points = [("inner", 0.125, True), ("edge", 0.125, True), ("inner", 0.0625, True), ("inner", 0.125, False)]
    for nodes, tolerance, weighted in points:
        for n in SHININESS:
            name = f"{nodes}/{tolerance}/{'weighted' if weighted else 'unweighted'}/{n}"
            report[name] = measure(scene, n, nodes, tolerance, weighted)
            print(name, " ".join(f"{key} {value:.3g}" for key, value in report[name].items()))
    save(OUT, report)
    return report


if __name__ == "__main__":
    main()
