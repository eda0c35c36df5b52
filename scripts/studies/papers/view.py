# SPDX-License-Identifier: Apache-2.0
"""The default head, scan-converted, on which methods of shading are compared, their light in float64."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import plan, poly
from polyshade.golden.material import Material
from polyshade.golden.reference import light as reference
from polyshade.sim import frame
from polyshade.sim.core import quantize
from polyshade.sim.scene.camera import Camera
from polyshade.sim.scene.mesh import load_mesh
from polyshade.sim.scene.raster import Spans, resolve, scan_convert

MODEL = "blinn"


@dataclass(frozen=True)
class View:
    """Spans of the head and which of their pixels are seen; Blinn-Phong light."""

    settings: frame.Settings
    spans: Spans
    visible: NDArray[np.int64]

    @cached_property
    def exact(self) -> NDArray[np.float64]:
        """(P, 2) light of every pixel in float64, clamped: Phong's method."""
        return self.light(frame.normals(self.spans, self.settings.camera.size)).clip(0, 1)

    @cached_property
    def kappa(self) -> NDArray[np.int64]:
        """kappa of every span, as the planner gets it."""
        spans = self.spans
        end = spans.normal + (1 << poly.span_log2(spans.count))[:, None] * spans.gradient
        return plan.quantize_kappa(reference.kappa(MODEL, spans.normal, end, self.shininess))

    @property
    def shininess(self) -> float:
        """Exponent of the highlight."""
        return self.settings.material.shininess

    def light(self, normal: ArrayLike, *, as_given: bool = False) -> NDArray[np.float64]:
        """Diffuse and specular light of normals (..., 3), unclamped."""
        return self.settings.material.channels(normal, self.settings.light, as_given=as_given)

    def node_light(self, records: plan.Records) -> tuple[NDArray[np.int64], int]:
        """Intensities (R, 2, 4) S1.16 at the nodes, and how often light was computed.

        Once where neighbours share a node.
        """
        nodes, spans = records.nodes, self.spans
        unique, index = np.unique((records.span[:, None] << 32) + nodes, return_inverse=True)
        span, position = unique >> 32, unique & 0xFFFFFFFF
        light = self.light(spans.normal[span] + position[:, None] * spans.gradient[span])
        return np.moveaxis(quantize(light)[index.reshape(nodes.shape)], -1, 1), len(unique)

    def shade(self, records: plan.Records, form: int = k.FORM_REFINED) -> tuple[dict, float]:
        """Errors (``sim.frame.errors``) of a plan's pixels out of the RTL, and its light evaluations a pixel."""
        nodes, evaluations = self.node_light(records)
        beats = poly.pack_records(nodes, records.degree, records.count)
        model = sim.load("shade_poly_span", EVALUATOR=k.EVALUATOR_HORNER, FORM=form)
        data = model.run(s_axis_span_tdata=beats).m_axis_pixel_tdata
        intensity = np.stack([data & 0xFFFF, data >> k.PIXEL_W], axis=1) / frame.ONE
        return frame.errors(intensity, self.exact, self.visible), evaluations / len(data)


@cache
def _geometry(size: int) -> tuple[Spans, NDArray[np.int64]]:
    mesh = load_mesh("head")
    spans = scan_convert(Camera(size).project(mesh), mesh.faces, size)
    return spans, resolve(spans, size)


def view(size: int, shininess: float) -> View:
    """The head in a frame of ``size``, with a highlight of exponent ``shininess``."""
    return View(frame.Settings(camera=Camera(size), material=Material(MODEL, shininess)), *_geometry(size))
