"""One frame through the RTL: mesh -> spans -> plan -> light at the nodes -> RTL -> z-buffer -> pictures and report.

Path ``poly``: the light at the nodes is float64, quantized to S1.16; coefficients and every pixel come out of the
Verilated ``shade_poly_span``. Path ``normals``: every normal comes out of ``shade_pixel_normals``, its light is
float64. Each pixel or normal is compared with the golden model, bit for bit.
"""

from __future__ import annotations

import json
import os
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from tqdm import tqdm

import sim
from golden import contract, plan, poly
from golden import normal as normals
from golden.reference import light as reference
from sim import tools
from sim.errors import UserError
from sim.scene.camera import Camera
from sim.scene.mesh import load_mesh
from sim.scene.raster import Spans, expand, resolve, scan_convert

FORMS = {"paper": contract.FORM_PAPER, "refined": contract.FORM_REFINED}
EVALUATORS = {"horner": contract.EVALUATOR_HORNER, "fdiff": contract.EVALUATOR_FDIFF}
PATHS = ("poly", "normals")
VARIANTS = {name.removeprefix("VARIANT_"): code for name, code in contract.constants().items() if "VARIANT_V" in name}
VARIANTS |= {"refined": contract.VARIANT_REFINED, "exact": contract.VARIANT_EXACT}
RANGES = {"shininess": (1.0, 1024.0), "threshold": (0.0, 1.0), "degree": (1, 3)}
ONE = 1 << contract.INTENSITY_F
TAGS = 1 << contract.TAG_W
DIFFERENCE_GAIN = 256  # an error of 1/256, one step of an 8-bit picture, is white

# what a material adds to the two intensities on their way into a picture
AMBIENT, DIFFUSE, SPECULAR = 0.10, 0.80, 0.35
SKIN = np.array([0.93, 0.70, 0.58])
BACKGROUND = np.array([0.11, 0.12, 0.14])


@dataclass(frozen=True)
class Settings:
    """What to render and how. Raises UserError for a value out of range or unknown."""

    mesh: str = "head"
    subdivide: int = 0
    camera: Camera = field(default_factory=Camera)
    path: str = "poly"
    form: str = "refined"
    evaluator: str = "horner"
    variant: str = "refined"  # of path normals, and the threshold below which V1, V2, V4 and V5 normalize
    threshold: float = 0.9
    model: str = "blinn"
    shininess: float = 32.0
    light: tuple[float, float, float] = (0.3, 0.6, 0.8)
    degree: int = 3  # of every span in form paper

    def __post_init__(self) -> None:
        choices = {
            "path": PATHS,
            "form": FORMS,
            "evaluator": EVALUATORS,
            "variant": VARIANTS,
            "model": reference.MODELS,
        }
        for name, allowed in choices.items():
            if getattr(self, name) not in allowed:
                raise UserError(f"--{name}: {getattr(self, name)!r} is none of {', '.join(allowed)}")
        for name, (low, high) in RANGES.items():
            if not low <= getattr(self, name) <= high:  # also refuses NaN
                raise UserError(f"--{name}: {getattr(self, name)} is out of range, allowed is {low} to {high}")
        if not 1e-6 < np.abs(self.light).max() < 1e6:  # also refuses NaN
            raise UserError(f"--light: {self.light} is no direction, allowed is 1e-06 to 1e+06 for its longest part")


@dataclass(frozen=True)
class Frame:
    """A rendered frame: intensities per place, from the RTL and from float64, and the report."""

    visible: NDArray[np.int64]  # (size * size,) index of the pixel in stream order, -1: background
    intensity: NDArray[np.float64]  # (P, 2) diffuse and specular of every pixel in stream order
    exact: NDArray[np.float64]  # the same in float64
    report: dict
    size: int

    def picture(self, intensity: NDArray[np.float64]) -> Image.Image:
        """The intensities as a picture: ambient, diffuse and specular light on skin."""
        colour = np.tile(BACKGROUND, (self.size * self.size, 1))
        seen = self.visible >= 0
        diffuse, specular = np.moveaxis(intensity[self.visible[seen]], -1, 0)
        colour[seen] = (AMBIENT + DIFFUSE * diffuse[:, None]) * SKIN + SPECULAR * specular[:, None]
        return Image.fromarray(np.rint(255 * colour.clip(0, 1)).astype(np.uint8).reshape(self.size, self.size, 3))

    def difference(self) -> Image.Image:
        """|RTL - float64| times DIFFERENCE_GAIN: diffuse in green, specular in red."""
        colour = np.zeros((self.size * self.size, 3))
        seen = self.visible >= 0
        error = np.abs(self.intensity - self.exact)[self.visible[seen]]
        colour[seen, 0], colour[seen, 1] = error[:, 1], error[:, 0]
        levels = np.rint(255 * (DIFFERENCE_GAIN * colour).clip(0, 1))
        return Image.fromarray(levels.astype(np.uint8).reshape(self.size, self.size, 3))

    def save(self, folder: Path) -> None:
        """image.png, reference.png, difference.png and report.json, all or none."""
        files = {
            "image.png": self.picture(self.intensity),
            "reference.png": self.picture(self.exact),
            "difference.png": self.difference(),
        }
        names = [*files, "report.json"]
        try:
            folder.mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryDirectory(prefix=".polyshade-", dir=folder) as scratch:
                for name, image in files.items():
                    image.save(Path(scratch, name))
                Path(scratch, names[-1]).write_text(json.dumps(self.report, indent=2) + "\n")
                if taken := [name for name in names if (folder / name).is_dir()]:
                    raise UserError(f"--out {folder}: {taken[0]} in it is a folder, allowed a file or nothing")
                for name in names:
                    os.replace(Path(scratch, name), folder / name)
        except OSError as error:
            raise UserError(f"--out {folder}: cannot be written ({error.strerror})") from error


def plan_spans(spans: Spans, settings: Settings) -> plan.Records:
    """The records of a frame's spans; the paper's form has one a span, of a fixed degree."""
    if settings.form == "paper":
        return plan.plan_fixed(spans.count, settings.degree)
    reach = (1 << poly.span_log2(spans.count))[:, None]
    kappa = reference.kappa(settings.model, spans.normal, spans.normal + reach * spans.gradient, settings.shininess)
    return plan.plan(spans.count, plan.quantize_kappa(kappa))


def node_light(spans: Spans, records: plan.Records, settings: Settings) -> tuple[NDArray[np.int64], int]:
    """Intensities (R, 2, 4) S1.16 at the nodes, and how often light was computed.

    Once where neighbours share a node.
    """
    nodes = records.nodes
    unique, index = np.unique((records.span[:, None] << 32) + nodes, return_inverse=True)
    span, position = unique >> 32, unique & 0xFFFFFFFF
    normal = spans.normal[span] + position[:, None] * spans.gradient[span]
    light = reference.light_channels(settings.model, normal, settings.light, settings.shininess)
    return np.moveaxis(quantize(light)[index.reshape(nodes.shape)], -1, 1), len(unique)


def quantize(intensity: NDArray[np.float64]) -> NDArray[np.int64]:
    """Intensity to S1.16, to nearest, saturating."""
    limit = 1 << contract.INTENSITY_W - 1
    return np.clip(np.rint(intensity * ONE), -limit, limit - 1).astype(np.int64)


@dataclass(frozen=True)
class Drawn:
    """What a way through the RTL made of a frame's spans."""

    intensity: NDArray[np.float64]  # (P, 2) of every pixel in stream order, clamped
    run: sim.Run
    seconds: float  # of simulation
    evaluations: int  # of light
    more: dict  # its own part of the report


def draw_poly(spans: Spans, settings: Settings, stage: Callable[[str], None]) -> Drawn:
    """Polynomials: light at the nodes from float64, every pixel from ``shade_poly_span``."""
    stage("plan")
    records = plan_spans(spans, settings)
    nodes, evaluations = node_light(spans, records, settings)
    tag = np.arange(len(records)) % TAGS
    beats = poly.pack_spans(nodes, records.degree, records.count, tag)
    parameters = {"EVALUATOR": EVALUATORS[settings.evaluator], "FORM": FORMS[settings.form]}
    model = sim.load("shade_poly_span", **parameters)
    stage("simulate")
    began = time.perf_counter()
    run = model.run(s_axis_span_tdata=beats)
    seconds = time.perf_counter() - began
    stage("compare")
    golden, owner = poly.poly_span(
        nodes, records.degree, records.count, evaluator=parameters["EVALUATOR"], form=parameters["FORM"]
    )
    pixels, mismatch = _compare(run, beats, golden, tag, owner)
    if record := mismatch.get("first_mismatch"):
        record["again"] = model.again(s_axis_span_tdata=beats[record["record"]])
    degree = settings.degree if settings.form == "paper" else None  # refined: the planner's
    more = {"evaluator": settings.evaluator, "degree": degree, "records": len(records), **mismatch}
    return Drawn(pixels / ONE, run, seconds, evaluations, more)


def draw_normals(spans: Spans, settings: Settings, stage: Callable[[str], None]) -> Drawn:
    """Pixel normals: every normal from ``shade_pixel_normals``, light from float64 with the normals as they are."""
    stage("plan")
    ends = spans.normal, spans.normal + (spans.count[:, None] - 1) * spans.gradient
    cosine = quantize(np.sum(reference.unit(ends[0]) * reference.unit(ends[1]), axis=-1))
    scale = 1 << contract.STEP_F
    first, step = (np.rint(part * scale).astype(np.int64) for part in (spans.normal, spans.gradient))
    tag = np.arange(len(spans)) % TAGS
    beats = normals.pack_lines(first, step, spans.count, cosine, tag)
    model = sim.load("shade_pixel_normals")
    stage("simulate")
    began = time.perf_counter()
    code, threshold = VARIANTS[settings.variant], int(quantize(np.asarray(settings.threshold)))
    run = model.run(s_axis_line_tdata=beats, variant_i=code, threshold_i=threshold)
    seconds = time.perf_counter() - began
    stage("compare")
    golden, owner = normals.pixel_normals(first, step, spans.count, cosine, code, threshold)
    width = contract.INTENSITY_W
    words = sum((golden[:, i] & (1 << width) - 1) << width * i for i in range(3))
    actual, mismatch = _compare_words(run, "normal", beats, words, tag, owner)
    if record := mismatch.get("first_mismatch"):
        settings_beside = {"variant_i": code, "threshold_i": threshold}
        record["again"] = model.again(s_axis_line_tdata=beats[record["record"]], **settings_beside)
    vectors = np.stack([actual << 64 - width * (i + 1) >> 64 - width for i in range(3)], axis=-1) / ONE
    light = reference.light_channels(settings.model, vectors, settings.light, settings.shininess, as_given=True)
    form = "paper" if settings.variant.startswith("V") else "refined"
    more = {"form": form, "variant": settings.variant, "threshold": settings.threshold, **mismatch}
    return Drawn(light.clip(0, 1), run, seconds, len(golden), more)


def render(settings: Settings) -> Frame:
    """Render a frame through the RTL and compare it with the golden model and with float64.

    ``report["mismatches"]`` counts the pixels whose value, tag or end-of-span mark differs from the golden model's;
    ``report["first_mismatch"]`` tells the first of them.
    """
    began = time.perf_counter()
    with tqdm(total=6, desc="load", disable=None, delay=2, leave=False) as bar:

        def stage(name: str) -> None:
            bar.update()
            bar.set_description(name)

        size = settings.camera.size
        mesh = load_mesh(settings.mesh, settings.subdivide)
        stage("scan")
        spans = scan_convert(settings.camera.project(mesh), mesh.faces, size)
        visible = resolve(spans, size)
        drawn = (draw_poly if settings.path == "poly" else draw_normals)(spans, settings, stage)
        stage("reference")
        every = expand(spans, size)
        normal = spans.normal[every.span] + every.step[:, None] * spans.gradient[every.span]
        light = reference.light_channels(settings.model, normal, settings.light, settings.shininess)
        exact = light.clip(0, 1)

    pixels, cycles = spans.pixels, drawn.run.clocks
    camera = settings.camera
    report = {
        "mesh": settings.mesh,
        "subdivide": settings.subdivide,
        "size": size,
        "projection": camera.projection,
        "yaw": camera.yaw,
        "pitch": camera.pitch,
        "zoom": camera.zoom,
        "field_of_view": camera.field_of_view,
        "form": settings.form,
        "path": settings.path,
        "model": settings.model,
        "shininess": settings.shininess,
        "light": " ".join(f"{part:g}" for part in settings.light),
        "triangles": len(mesh.faces),
        "repairs": mesh.repairs,
        "spans": len(spans),
        "pixels": pixels,
        "visible_pixels": int((visible >= 0).sum()),
        **drawn.more,
        "cycles": cycles,
        "pixels_per_cycle": pixels / cycles if cycles else None,
        "light_evaluations": drawn.evaluations,
        "light_evaluations_per_pixel": drawn.evaluations / pixels if pixels else None,
        **errors(drawn.intensity, exact, visible),
        "simulated_pixels_per_second": pixels / drawn.seconds,
        "wall_seconds": time.perf_counter() - began,
        "versions": tools.versions(),
    }
    return Frame(visible, drawn.intensity, exact, report, size)


def _compare(run: sim.Run, beats, golden, tag, owner) -> tuple[NDArray[np.int64], dict]:
    """The RTL's pixels (P, 2), and ``mismatches`` with the first one."""
    words = golden[:, 0] | golden[:, 1] << contract.PIXEL_W
    actual, result = _compare_words(run, "pixel", beats, words, tag, owner)
    mask = (1 << contract.PIXEL_W) - 1
    return np.stack([actual & mask, actual >> contract.PIXEL_W & mask], axis=-1), result


def _compare_words(run: sim.Run, stream: str, beats, words, tag, owner) -> tuple[NDArray[np.int64], dict]:
    """The data that ``m_axis_<stream>`` gave, as many as there should be (0 where none came), and ``mismatches``.

    ``first_mismatch``: the pixel, its record (-1: none) and input; expected and actual as {tlast, tuser, tdata}.
    """
    last = np.append(np.diff(owner), 1)[: len(owner)] != 0
    expected = last.astype(np.int64), tag[owner], words
    actual = [run.outputs[f"m_axis_{stream}_{name}"] for name in ("tlast", "tuser", "tdata")]
    count, came = len(words), len(actual[0])
    shared = min(count, came)
    wrong = np.flatnonzero(np.any([e[:shared] != a[:shared] for e, a in zip(expected, actual, strict=True)], axis=0))
    result: dict = {"mismatches": len(wrong) + abs(count - came)}
    if result["mismatches"]:
        at = int(wrong[0]) if len(wrong) else shared
        record = int(owner[at]) if at < count else -1

        def shown(parts, rows: int) -> str:
            ends, tags, data = parts
            width = {"pixel": contract.PIXEL_DATA_W, "normal": contract.NORMAL_DATA_W}[stream]
            whole = (int(ends[at]) << contract.TAG_W | int(tags[at])) << width | int(data[at]) if at < rows else 0
            return f"{whole:#x}" if at < rows else "none"

        result["first_mismatch"] = {
            "pixel": at,
            "record": record,
            "input": f"0x{beats[record, ::-1].astype('>u4').tobytes().hex()}" if record >= 0 else "none",
            "expected": shown(expected, count),
            "actual": shown(actual, came),
        }
    data = np.zeros(count, np.int64)
    data[:shared] = actual[2][:shared]
    return data, result


def errors(intensity, exact, visible) -> dict[str, float | None]:
    """NMSE = sum (I - Iref)^2 / sum Iref^2 over the visible pixels, of both channels and of each; PSNR for peak 1."""
    seen = visible[visible >= 0]
    error, signal = (intensity - exact)[seen] ** 2, exact[seen] ** 2

    def ratio(numerator: float, denominator: float) -> float | None:
        return float(numerator / denominator) if denominator else None

    mean = error.mean() if len(seen) else 0
    return {
        "nmse": ratio(error.sum(), signal.sum()),
        "nmse_diffuse": ratio(error[:, 0].sum(), signal[:, 0].sum()),
        "nmse_specular": ratio(error[:, 1].sum(), signal[:, 1].sum()),
        "psnr_db": float(-10 * np.log10(mean)) if mean else None,
        "max_error": float(np.sqrt(error.max())) if len(seen) else 0.0,
    }
