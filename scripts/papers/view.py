"""The default head, scan-converted, on which methods of shading are compared."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
from numpy.typing import NDArray

import sim
from golden import contract as k
from golden import plan, poly
from golden.reference import light as reference
from sim import frame
from sim.scene.camera import Camera
from sim.scene.mesh import load_mesh
from sim.scene.raster import Spans, expand, resolve, scan_convert

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
        spans, settings = self.spans, self.settings
        pixels = expand(spans, settings.camera.size)
        normal = spans.normal[pixels.span] + pixels.step[:, None] * spans.gradient[pixels.span]
        return reference.light_channels(MODEL, normal, settings.light, settings.shininess).clip(0, 1)

    @cached_property
    def kappa(self) -> NDArray[np.int64]:
        """kappa of every span, as the planner gets it."""
        spans = self.spans
        end = spans.normal + (1 << poly.span_log2(spans.count))[:, None] * spans.gradient
        return plan.quantize_kappa(reference.kappa(MODEL, spans.normal, end, self.settings.shininess))

    def shade(self, records: plan.Records, form: int = k.FORM_REFINED) -> tuple[dict, float]:
        """Errors (``sim.frame.errors``) of a plan's pixels out of the RTL, and its light evaluations a pixel."""
        nodes, evaluations = frame.node_light(self.spans, records, self.settings)
        beats = poly.pack_spans(nodes, records.degree, records.count)
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
    return View(frame.Settings(model=MODEL, camera=Camera(size), shininess=shininess), *_geometry(size))
