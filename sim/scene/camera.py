# SPDX-License-Identifier: Apache-2.0
"""The camera: turns a mesh, fits it into a square frame, projects it.

Axes. Mesh and camera space are right-handed: x to the right, y up, z towards the viewer. Screen space is measured
in pixels from the top left corner, x to the right, y down; the centre of pixel (i, j) is (i + 0.5, j + 0.5).
Light is computed in camera space with the viewer at infinity in direction (0, 0, 1).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, radians, sin
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from polyshade.sim.errors import UserError

if TYPE_CHECKING:
    from polyshade.sim.scene.mesh import Mesh

Floats = NDArray[np.float64]

MARGIN = 0.02
"""Free part of the frame on each side of the mesh at zoom 1."""

PROJECTIONS = ("orthographic", "perspective")

RANGES = {
    "size": (16, 4096),
    "yaw": (-360.0, 360.0),
    "pitch": (-90.0, 90.0),
    "zoom": (0.05, 50.0),
    "field_of_view": (1.0, 120.0),
}
"""What each number of the camera may be, ends included."""


@dataclass(frozen=True)
class Screen:
    """A projected mesh: what scan conversion needs of each vertex."""

    xy: Floats  # (V, 2) pixels, y down
    depth: Floats  # (V,) smaller is nearer; linear in screen space
    normals: Floats  # (V, 3) unit normals in camera space


@dataclass(frozen=True)
class Camera:
    """A turntable camera that fills its frame with whatever mesh it is given.

    yaw             degrees; positive turns the mesh's front to the viewer's right
    pitch           degrees; positive tips the mesh's front down, so that it is seen from above
    zoom            factor on the fitted scale, about the frame's centre
    field_of_view   degrees under which a perspective eye sees the mesh's bounding sphere: its distance is
                    radius / sin(field_of_view / 2), hence always outside of the mesh, and nothing is ever behind it

    Raises UserError when a number is out of its range (`RANGES`) or the projection is unknown.
    """

    size: int = 1024
    projection: str = "orthographic"
    yaw: float = 30.0
    pitch: float = 5.0
    zoom: float = 1.0
    field_of_view: float = 30.0

    def __post_init__(self) -> None:
        if self.projection not in PROJECTIONS:
            raise UserError(f"--projection: {self.projection!r} is none of {', '.join(PROJECTIONS)}")
        for name, (low, high) in RANGES.items():
            value = getattr(self, name)
            if not low <= value <= high:  # also refuses NaN
                option = "--" + name.replace("_", "-")
                raise UserError(f"{option}: {value} is out of range, allowed is {low} to {high}")

    @property
    def rotation(self) -> Floats:
        """(3, 3) matrix from mesh to camera space: first yaw about y, then pitch about x."""
        cy, sy = cos(radians(self.yaw)), sin(radians(self.yaw))
        cp, sp = cos(radians(self.pitch)), sin(radians(self.pitch))
        about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
        about_x = np.array([[1, 0, 0], [0, cp, -sp], [0, sp, cp]])
        return about_x @ about_y

    def project(self, mesh: Mesh) -> Screen:
        """Turn, project and fit `mesh`.

        Orthographic depth is -z. Perspective depth is -1/w, w the distance from the eye along the line of sight:
        unlike w itself it is linear in screen space. Normals are interpolated linearly in screen space either way.
        """
        points = mesh.vertices @ self.rotation.T
        points -= (points.min(axis=0) + points.max(axis=0)) / 2
        points /= max(points.max(), -points.min())  # so that the squares of the next line neither overflow nor vanish
        points /= np.sqrt(np.einsum("vi,vi->v", points, points).max())
        if self.projection == "perspective":
            distance = 1 / sin(radians(self.field_of_view) / 2) - points[:, 2]
            plane, depth = points[:, :2] / distance[:, None], -1 / distance
        else:
            plane, depth = points[:, :2], -points[:, 2]
        low, high = plane.min(axis=0), plane.max(axis=0)
        scale = self.zoom * self.size * (1 - 2 * MARGIN) / (high - low).max()
        xy = (plane - (low + high) / 2) * (scale, -scale) + self.size / 2
        return Screen(xy=xy, depth=depth, normals=mesh.normals @ self.rotation.T)
