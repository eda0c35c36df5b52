# SPDX-License-Identifier: Apache-2.0
"""One frame through the RTL: mesh -> spans -> ``shade_core`` -> z-buffer -> pictures and report.

Scan conversion and z-buffer are done here, all between them by the Verilated core. Each pixel is compared with the
golden model, bit for bit, and with light in float64 by the original model at every pixel.
"""

from __future__ import annotations

import contextlib
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
from polyshade.golden import contract
from polyshade.golden.material import DIRECT_MODELS, FORMS, Material, planner_registers, registers
from polyshade.golden.plan import criterion
from polyshade.golden.reference.light import dot
from polyshade.golden.scene import level
from polyshade.sim import core, direct, patch, tools, vector
from polyshade.sim.core import quantize
from polyshade.sim.errors import UserError
from polyshade.sim.picture import painted
from polyshade.sim.scan import fits, scan, triangles
from polyshade.sim.scene.camera import Camera
from polyshade.sim.scene.mesh import Mesh, Reading, load_mesh
from polyshade.sim.scene.raster import Spans, expand, faces_viewer, portions, resolve, scan_convert
from polyshade.sim.scene.triangles import Triangles
from tqdm import tqdm

PATHS = {
    "line": contract.PATH_POLY,
    "normals": contract.PATH_NORMALS,
    "patch": None,
    "direct": None,
    "vector": None,
}  # None: no path of the core
EVALUATORS = {"horner": contract.EVALUATOR_HORNER, "fdiff": contract.EVALUATOR_FDIFF}
VARIANTS = {name.removeprefix("VARIANT_"): code for name, code in contract.constants().items() if "VARIANT_V" in name}
VARIANTS |= {"refined": contract.VARIANT_REFINED, "exact": contract.VARIANT_EXACT}
LIGHTS_MAX = {"patch": contract.PATCH_LIGHTS_MAX}  # of other paths one
LANES = (1, 2, 4, 8)
CORE_LANES = (1, 2, 4)
# parameters of the core; a folded one has the models FOLDED_MODELS alone
LIGHT_UNITS = {"full": {}, "folded": {"FOLD": 6, "REFLECT": 0, "DIVIDE": 0, "PATH_NORMALS": 0}}
FOLDED_MODELS = ("lambert", "blinn")
PATCH_MODELS = ("lambert", "blinn")
SURFACE_MODELS = {"patch": PATCH_MODELS, "direct": DIRECT_MODELS}  # what a path over triangles can draw
RANGES = {"threshold": (0.0, 1.0), "degree": (1, 3), "criterion": (0.0, 1.0)}
ONE = 1 << contract.INTENSITY_F
SCANS = ("host", "rtl", None)
CHOICES = {"scan": SCANS, "path": PATHS, "evaluator": EVALUATORS, "lanes": LANES, "light_unit": LIGHT_UNITS}
CHOICES |= {"variant": VARIANTS}
DIFFERENCE_GAIN = 256  # an error of 1/256, one step of an 8-bit picture, is white
BLOCK = 1 << 20  # pixels at a time: what is computed of them stays small beside the frame
BACKGROUND = np.array([0.11, 0.12, 0.14])


@dataclass(frozen=True)
class Settings:
    """What to render and how. Raises UserError for a value out of range or unknown."""

    mesh: str = "head"
    subdivide: int = 0
    camera: Camera = field(default_factory=Camera)
    material: Material = field(default_factory=Material)
    light: tuple[float, float, float] = (0.3, 0.6, 0.8)
    more_lights: tuple[tuple[float, float, float], ...] = ()  # of path patch: beside it, LIGHTS_MAX in all
    path: str = "line"
    evaluator: str = "fdiff"
    lanes: int = 1
    light_unit: str = "full"
    variant: str = "refined"  # of path normals, and the threshold below which V1, V2, V4 and V5 normalize
    threshold: float = 0.9
    degree: int = 3  # of every span in form paper
    criterion: float = 0.005  # P2's eta, up to which Lambert's light alone draws a triangle without normalizing
    scan: str | None = None  # who converts triangles: sim.scene.raster or the RTL; None: the RTL where it can
    crease: float | None = None  # these four: see Reading
    flip: bool = False
    two_sided: bool = False
    up: str = "y"

    def __post_init__(self) -> None:
        _ = self.reading  # refuses what it must
        for name, allowed in CHOICES.items():
            if getattr(self, name) not in allowed:
                option = name.replace("_", "-")
                raise UserError(
                    f"--{option}: {getattr(self, name)!r} is none of {', '.join(str(v) for v in allowed if v)}"
                )
        for name, (low, high) in RANGES.items():
            if not low <= getattr(self, name) <= high:  # also refuses NaN
                raise UserError(f"--{name}: {getattr(self, name)} is out of range, allowed is {low} to {high}")
        for light in self.lights:
            if not 1e-6 < np.abs(light).max() < 1e6:  # also refuses NaN
                raise UserError(f"--light: {light} is no direction, allowed is 1e-06 to 1e+06 for its longest part")
        if len(self.lights) > LIGHTS_MAX.get(self.path, 1):
            allowed = f"1 is allowed, with --path patch up to {contract.PATCH_LIGHTS_MAX}"
            raise UserError(f"--light: {len(self.lights)} are given, {allowed}")
        if self.scan == "rtl" and self.needs_cosines:
            raise UserError(f"--scan: rtl gives no cosines, which variant {self.variant} needs, allowed is host")
        models = SURFACE_MODELS.get(self.path, (self.material.model,))
        if self.material.model not in models:
            raise UserError(f"--path: {self.path} is allowed with --model {', '.join(models)}")
        if PATHS[self.path] is None and self.form != "refined":
            raise UserError(f"--path: {self.path} is allowed with --form refined")
        if self.path in SURFACE_MODELS and self.material.cosine:
            raise UserError(f"--path: {self.path} is allowed with --energy rows that are not modified")
        if self.path in ("direct", "vector") and self.lanes != 1:
            raise UserError(f"--lanes: 1 is allowed with --path {self.path}")
        if self.path != "patch" and self.lanes not in CORE_LANES:
            raise UserError(
                f"--lanes: {self.lanes} is allowed with --path patch, else {', '.join(map(str, CORE_LANES))}"
            )
        if self.light_unit == "folded" and (self.path != "line" or self.material.model not in FOLDED_MODELS):
            raise UserError(f"--light-unit: folded is allowed with --path line and --model {', '.join(FOLDED_MODELS)}")

    @property
    def needs_cosines(self) -> bool:
        """Of the angle between the ends of a span, which the RTL's scan conversion does not give."""
        return self.path == "normals" and self.variant in ("V1", "V2")

    @property
    def reading(self) -> Reading:
        """How the mesh is read."""
        return Reading(self.subdivide, self.crease, self.flip, self.two_sided, self.up)

    def load(self) -> Mesh:
        """The mesh."""
        return load_mesh(self.mesh, self.subdivide, self.reading)

    @property
    def lights(self) -> tuple[tuple[float, float, float], ...]:
        """All of them."""
        return (self.light, *self.more_lights)

    @property
    def form(self) -> str:
        """paper or refined, of the RTL as of the material."""
        return self.material.form

    @property
    def parameters(self) -> dict[str, int]:
        """Of ``shade_core``."""
        chosen = {"LANES": self.lanes, "EVALUATOR": EVALUATORS[self.evaluator], "FORM": FORMS[self.form]}
        return chosen | LIGHT_UNITS[self.light_unit]

    @property
    def registers(self) -> dict[str, int]:
        """What is written into the core's registers, by the names of ``golden.registers``."""
        return {
            **registers(self.material, self.light),
            **planner_registers(self.material),
            "path": PATHS[self.path] or 0,
            "fixed_degree": self.degree if self.form == "paper" else 0,
            "variant": VARIANTS[self.variant],
            "threshold": int(quantize(self.threshold)),
        }


@dataclass(frozen=True)
class Frame:
    """A rendered frame: intensities of every pixel, from the RTL and from float64, and the report."""

    settings: Settings
    visible: NDArray[np.int64]  # (size * size,) index of the pixel in stream order, -1: background
    intensity: NDArray[np.float64]  # (P, 2) diffuse and specular of every pixel in stream order
    exact: NDArray[np.float64]  # the same in float64
    report: dict

    def image(self) -> Image.Image:
        """What the RTL draws, with colours as ``shade_colour`` makes them and levels as ``shade_scene_level`` does."""

        def levels(some: slice) -> NDArray[np.uint8]:
            light = np.rint(self.intensity[some] * ONE).astype(np.int64)
            return level(painted(light, self.settings.material)).astype(np.uint8)

        return self._image(levels, BACKGROUND)

    def picture(self, intensity: NDArray[np.float64]) -> Image.Image:
        """The intensities as a picture: ambient, diffuse and specular light in the material's colours."""
        surface = self.settings.material

        def levels(some: slice) -> NDArray[np.uint8]:
            diffuse, specular = np.moveaxis(intensity[some], -1, 0)[..., None]
            matt = (surface.ambient + surface.diffuse * diffuse) * surface.colour
            return _levels(matt + surface.specular * specular * surface.highlight)

        return self._image(levels, BACKGROUND)

    def difference(self) -> Image.Image:
        """|RTL - float64| times DIFFERENCE_GAIN: diffuse in green, specular in red."""

        def levels(some: slice) -> NDArray[np.uint8]:
            error = np.abs(self.intensity[some] - self.exact[some])
            return _levels(DIFFERENCE_GAIN * np.insert(error[:, ::-1], 2, 0, axis=-1))

        return self._image(levels, np.zeros(3))

    def _image(self, levels: Callable[[slice], NDArray[np.uint8]], background: NDArray[np.float64]) -> Image.Image:
        """The visible ones of the pixels, whose colours of 8 bits ``levels`` gives for some of them: (pixels, 3)."""
        size = self.settings.camera.size
        every = np.empty((len(self.intensity) + 1, 3), np.uint8)
        for at in range(0, len(self.intensity), BLOCK):
            every[at : at + BLOCK][: len(self.intensity) - at] = levels(slice(at, at + BLOCK))
        every[-1] = _levels(background)
        return Image.fromarray(every[self.visible].reshape(size, size, 3))  # -1 is the last

    def save(self, folder: Path) -> None:
        """image.png, reference.png, difference.png and report.json, all or none."""
        pictures = {
            "image.png": self.image(),
            "reference.png": self.picture(self.exact),
            "difference.png": self.difference(),
        }
        save(folder, pictures, self.report)


def _levels(colour: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Of 8 bits."""
    return np.rint(255 * colour.clip(0, 1)).astype(np.uint8)


PICTURES = ["image.png", "reference.png", "difference.png"]


def check_folder(folder: Path, names: list[str]) -> None:
    """Raise UserError, before any work is done, when the folder cannot be made or written; leaves it as it was."""
    made = [part for part in (folder, *folder.parents) if not os.path.lexists(part)]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".polyshade-", dir=folder):
            _refuse_folders(folder, names)
    except OSError as error:
        raise UserError(f"--out {folder}: cannot be written ({error.strerror})") from error
    finally:
        for part in made:
            with contextlib.suppress(OSError):
                part.rmdir()


def _refuse_folders(folder: Path, names: list[str]) -> None:
    if taken := [name for name in [*names, "report.json"] if (folder / name).is_dir()]:
        raise UserError(f"--out {folder}: {taken[0]} in it is a folder, allowed a file or nothing")


def save(folder: Path, pictures: dict[str, Image.Image], report: dict, **options) -> None:
    """Pictures by name, with Pillow's ``options``, and report.json, all or none."""
    names = [*pictures, "report.json"]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".polyshade-", dir=folder) as scratch:
            for name, image in pictures.items():
                image.save(Path(scratch, name), **options)
            Path(scratch, names[-1]).write_text(json.dumps(report, indent=2) + "\n")
            _refuse_folders(folder, list(pictures))
            for name in names:
                os.replace(Path(scratch, name), folder / name)
    except OSError as error:
        raise UserError(f"--out {folder}: cannot be written ({error.strerror})") from error


def normals(spans: Spans, size: int) -> NDArray[np.float64]:
    """(P, 3): the interpolated normal of every pixel, in stream order."""
    every = expand(spans, size)
    return spans.normal[every.span] + every.step[:, None] * spans.gradient[every.span]


def reference(spans: Spans, size: int, surface: Material, light: tuple[float, float, float], **how) -> np.ndarray:
    """(P, 2): diffuse and specular light in float64 of every pixel, in stream order."""
    made = np.empty((spans.pixels, 2))
    for part, first in portions(spans.count):
        some = surface.channels(normals(spans[part], size), light, **how)
        np.clip(some, 0, 1, out=made[first : first + len(some)])
    return made


def flat(corners: NDArray[np.float64], threshold: float, form: int) -> NDArray[np.bool_]:
    """(F,): triangles whose unit normals (F, 3, 3) pass P2's criterion: eta up to the threshold.

    >>> flat(np.array([[[0, 0, 1], [0, 0, 1], [0, 0.6, 0.8]]]), 0.1, contract.FORM_REFINED)  # eta = 2 (1 - 0.9487)
    array([False])
    """
    cosines = (quantize(dot(corners[:, i], corners[:, i - 1])) for i in range(3))
    _, curved, _, _ = criterion(*cosines, round(threshold * (1 << contract.ETA_F)), form)
    return curved == 0


def render(settings: Settings, mesh: Mesh | None = None) -> Frame:
    """Render a frame through the RTL and compare it with the golden model and with float64.

    ``mesh``: what the settings load, where it is there already. ``report["mismatches"]`` counts the
    pixels whose value, tag or end-of-span mark differs from the golden model's, ``report["first_mismatch"]`` tells the
    first of them; ``report["counter_mismatches"]`` counters and bits of STATUS that differ.
    """
    began = time.perf_counter()
    with tqdm(total=6, desc="load", disable=None, delay=2, leave=False) as bar:

        def stage(name: str) -> None:
            bar.update()
            bar.set_description(name)

        camera, surface = settings.camera, settings.material
        mesh = mesh or settings.load()
        stage("scan")
        screen = camera.project(mesh)
        spans = scan_convert(screen, mesh.faces, camera.size)
        hints = list(mesh.hints)
        if not len(spans) and not faces_viewer(screen, mesh.faces):
            hints.append(f"none of {len(mesh.faces)} triangles faces the viewer: --two-sided shows their backs")
        visible = resolve(spans, camera.size)
        passed = np.zeros(len(mesh.faces), bool)
        shown = np.unique(spans.triangle)
        passed[shown] = flat(screen.normals[mesh.faces[shown]], settings.criterion, FORMS[settings.form])
        rtl = settings.scan == "rtl" or (not settings.scan and not settings.needs_cosines and fits(screen, mesh.faces))
        scan_report = {"coverage_mismatches": 0, "depth_mismatches": 0}
        if rtl:
            stage("set up and scan in the RTL")
            module = "shade_surfaces" if settings.path in SURFACE_MODELS else "shade_spans"
            scanned = scan(screen, mesh.faces, camera.size, spans, passed, module)
            visible, scan_report = scanned.visible, scanned.report
        if settings.path in SURFACE_MODELS:
            sent = triangles(scanned.golden) if rtl else Triangles.of(spans, passed)
            if settings.path == "patch":
                drawn = patch.draw(sent, surface, settings.lights, stage, settings.lanes)
            else:
                drawn = direct.draw(sent, surface, settings.light, stage)
        else:
            lines = scanned.lines if rtl else core.Lines.of(spans, passed)
            if settings.path == "vector":
                built = vector.SMALL if surface.model in FOLDED_MODELS else {}
                drawn = vector.draw(lines, settings.registers, stage, **built)
            else:
                drawn = core.draw(lines, settings.registers, stage, **settings.parameters)
        intensity = drawn.pixels / ONE
        stage("reference")
        exact = reference(spans, camera.size, surface, settings.light)
        for light in settings.more_lights:
            np.clip(exact + reference(spans, camera.size, surface, light), 0, 1, out=exact)
        told = errors(intensity, exact, visible)
        if settings.form == "paper":
            lobe = reference(spans, camera.size, surface, settings.light, fitted=True)
            told |= {f"{name}_paper_lobe": errors(intensity, lobe, visible)[name] for name in ("nmse", "nmse_specular")}

    pixels, clocks, evaluations = spans.pixels, drawn.clocks, drawn.evaluations
    if settings.path == "line":
        degree = settings.degree if settings.form == "paper" else None  # refined: the planner's
        more = {"evaluator": settings.evaluator, "degree": degree, "records": drawn.records}
        more |= {"criterion": settings.criterion, "flat_spans": int(lines.flat.sum())}
    elif settings.path in ("direct", "vector"):
        more = {}
    elif settings.path == "patch":
        more = {"boxes": drawn.golden.boxes, "direct_boxes": drawn.golden.direct}
        more |= {"lights": [_plain(light) for light in settings.lights]}
    else:
        more = {"variant": settings.variant, "threshold": settings.threshold}
    found = {"first_mismatch": drawn.first_mismatch, "counter_mismatches": drawn.counter_mismatches}
    report = {
        "mesh": settings.mesh,
        **vars(settings.reading),
        "size": camera.size,
        "projection": camera.projection,
        "yaw": camera.yaw,
        "pitch": camera.pitch,
        "zoom": camera.zoom,
        "field_of_view": camera.field_of_view,
        "form": settings.form,
        "path": settings.path,
        "lanes": settings.lanes,
        "light_unit": settings.light_unit,
        **{name: _plain(value) for name, value in vars(surface).items() if name != "form"},
        "light": _plain(settings.light),
        "triangles": len(mesh.faces),
        "repairs": mesh.repairs,
        **({"hints": hints} if hints else {}),
        "spans": len(spans),
        "pixels": pixels,
        "visible_pixels": int((visible >= 0).sum()),
        **more,
        "scan": "rtl" if rtl else "host",
        **scan_report,
        "mismatches": drawn.mismatches,
        **{name: value for name, value in found.items() if value},
        "cycles": clocks,
        "pixels_per_cycle": pixels / clocks if clocks else None,
        "light_evaluations": evaluations,
        "light_evaluations_per_pixel": evaluations / pixels if pixels else None,
        "counters": drawn.counters,
        "status": " ".join(drawn.status),
        **told,
        "simulated_pixels_per_second": pixels / drawn.seconds,
        "wall_seconds": time.perf_counter() - began,
        "versions": tools.versions(),
    }
    return Frame(settings, visible, intensity, exact, report)


def _plain(value: float | str | tuple[float, ...]) -> float | str:
    """As it stands in a report."""
    return " ".join(f"{part:g}" for part in value) if isinstance(value, tuple) else value


def errors(intensity, exact, visible) -> dict[str, float | None]:
    """NMSE = sum (I - Iref)^2 / sum Iref^2 over the visible pixels, of both channels and of each; PSNR for peak 1."""
    seen = visible[visible >= 0]
    error, signal, worst = np.zeros(2), np.zeros(2), 0.0
    for at in range(0, len(seen), BLOCK):
        some = seen[at : at + BLOCK]
        square = (intensity[some] - exact[some]) ** 2
        error, worst = error + square.sum(axis=0), max(worst, square.max())
        signal += (exact[some] ** 2).sum(axis=0)

    def ratio(numerator: float, denominator: float) -> float | None:
        return float(numerator / denominator) if denominator else None

    mean = error.sum() / (2 * len(seen)) if len(seen) else 0
    return {
        "nmse": ratio(error.sum(), signal.sum()),
        "nmse_diffuse": ratio(error[0], signal[0]),
        "nmse_specular": ratio(error[1], signal[1]),
        "psnr_db": float(-10 * np.log10(mean)) if mean else None,
        "max_error": float(np.sqrt(worst)),
    }
