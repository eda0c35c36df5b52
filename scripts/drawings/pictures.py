# SPDX-License-Identifier: Apache-2.0
"""The pictures that the READMEs show, made again from what the RTL does: ``make pictures``.

docs/head.png              the default head, every pixel out of the RTL
docs/forms.png             P1's form and the refined one, and their errors
docs/gallery.png           every model, energy scale and form
docs/degrees.png           which degree the planner gives to which pixel
docs/architecture.svg      every path from vertices to pixels
docs/datapath.svg          shade_core, latencies from the contract
docs/timing_core.svg       its streams, from a waveform
docs/timing_poly_span.svg  the streams of shade_poly_span, from a waveform
docs/timing_horner_seq.svg the evaluator of P1, Fig. 9, step by step, from a waveform
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import partial
from pathlib import Path

import numpy as np
from PIL import Image
from polyshade.golden import contract as k
from polyshade.golden import poly
from polyshade.golden.material import FORMS, Material, planner_registers, registers
from polyshade.golden.normal import pack_spans
from polyshade.golden.registers import pack
from polyshade.scripts.drawings import svg, waves
from polyshade.scripts.studies import gallery
from polyshade.scripts.studies.papers import p1_arithmetic, p1_face
from polyshade.sim import frame
from polyshade.sim.core import WHOLE
from polyshade.sim.scene.camera import Camera
from polyshade.sim.sources import ROOT
from tqdm import tqdm

DOCS = ROOT / "docs"
ONE = 1 << k.INTENSITY_F
GREY = "#5b6670"


def head(path: Path) -> None:
    """The default head, 1024 x 1024."""
    made = frame.render(frame.Settings(camera=Camera(1024)))
    made.picture(made.intensity).save(path, optimize=True)


def forms(path: Path) -> None:
    """The head in both forms, and their errors."""
    made = {form: frame.render(frame.Settings(camera=Camera(768), material=Material(form=form))) for form in FORMS}
    p1_face.draw_forms(path, made["paper"], made["refined"])
    Image.open(path).convert("RGB").save(path, optimize=True)


def every_model(path: Path) -> None:
    """The head in every model, energy scale and form."""
    gallery.sheet(gallery.shoot("head", 256)).save(path, optimize=True)


def degrees(path: Path) -> None:
    """The degree of every pixel, for a soft and for a sharp highlight."""
    p1_face.draw_degrees(path, 1024, (32, 128))
    Image.open(path).convert("RGB").quantize(256).save(path, optimize=True)


def datapath(path: Path) -> None:
    """The way of the data through ``shade_core``."""
    made = svg.Svg(1110, 300)
    made.text(24, 32, "shade_core", 16, "start", font_weight="bold")
    made.text(
        24,
        51,
        "one pixel a clock and lane; pipelines that never stall, FIFOs and credits between",
        12,
        "start",
        fill=GREY,
    )
    top, height, width = 100, 100, 132
    middle, bottom = top + height / 2, top + height
    blocks = {  # x, two lines, clocks
        "planner": (96, "κ = n (1 − c): records", "of degree 1, 2, 3", k.LATENCY_PLANNER),
        "node_walk": (282, "N + j G by adders,", "a node a clock", k.LATENCY_NODE_WALK),
        "unit": (468, "n = v / |v|", "", k.LATENCY_UNIT),
        "light": (654, "N·L, lobe, scale:", "six models", k.LATENCY_LIGHT),
        "poly_span": (868, "A, B, C, D by shifts,", "forward differences", k.LATENCY_POLY_SPAN_FDIFF),
    }
    lefts = [x for x, *_ in blocks.values()]
    for name, (x, *lines, clocks) in blocks.items():
        made.box(x, top, width, height)
        made.text(x + width / 2, top + 22, name, 13, font_weight="bold")
        for i, words in enumerate(lines):
            made.text(x + width / 2, top + 46 + 17 * i, words, 12)
        made.text(x + width / 2, bottom - 10, f"{clocks} clocks", 11, fill=GREY)

    def link(start: float, end: float, *words: str) -> None:
        made.arrow(f"M{start} {middle}H{end}")
        for i, each in enumerate(reversed(words)):
            made.text((start + end) / 2 - 3, middle - 7 - 14 * i, each, 10.5)

    link(14, lefts[0], "spans", "AXI4-Stream")
    link(lefts[0] + width, lefts[1], "plans")
    link(lefts[1] + width, lefts[2], "S2.15")
    link(lefts[2] + width, lefts[3], "S1.16")
    link(lefts[3] + width, lefts[4], "records", "of nodes")
    link(lefts[4] + width, 1096, "pixels", "AXI4-Stream")

    normals, setting = bottom + 36, bottom + 72
    made.arrow(f"M52 {middle}V{normals}H{lefts[3] + 40}V{bottom}")
    words = "or, at every pixel: shade_pixel_normals, unit normals by midpoints (P4)"
    made.text((52 + lefts[3] + 40) / 2, normals - 6, words, 11)
    made.arrow(f"M14 {setting}H{lefts[3] + 92}V{bottom}", dash="5 4")
    made.text((14 + lefts[3] + 92) / 2, setting - 6, "AXI4-Lite: material, light, thresholds; status, counters", 11)
    made.save(path)


PATHS = {  # path: what it takes, its stages: module and what it does
    "line": (
        "spans",
        ("planner", "κ: records"),
        ("node_walk", "normals at nodes"),
        ("unit", "to length 1"),
        ("light", "at nodes"),
        ("collect", "records"),
        ("poly_span", "differences"),
    ),
    "normals": ("spans", ("pixel_normals", "midpoints"), ("light", "at every pixel"), ("poly_span", "hands on")),
    "direct": (
        "surfaces",
        ("direct_setup", "N·L, N·H, N·N"),
        ("direct_line", "start of a run"),
        ("direct_run", "a pixel: 3 sums"),
        ("direct_light", "at every pixel"),
    ),
    "patch": (
        "surfaces",
        ("patch_plan", "size of boxes"),
        ("patch_setup", "N·L, N·H, N·N"),
        ("patch_nodes", "six a box"),
        ("patch_light", "at nodes"),
        ("patch_pieces", "coefficients"),
        ("patch_lane", "differences"),
    ),
    "vector": ("spans", ("increment", "N + j G"), ("normalize", "to length 1"), ("light", "at every pixel")),
}


def architecture(path: Path) -> None:
    """Every path from vertices to pixels."""
    left, top, pitch, width, height, step = 250, 84, 70, 104, 44, 124
    bottom, right = top + pitch * len(PATHS), left + step * 6
    made = svg.Svg(right + 110, bottom + 14)
    made.text(24, 32, "From vertices to pixels", 16, "start", font_weight="bold")
    made.text(
        24, 51, "every arrow between boxes of a row is a stream or a pipeline with credits", 12, "start", fill=GREY
    )
    made.box(24, top, 120, bottom - top - pitch + height)
    for i, words in enumerate(("raster", "edges, top-left rule,", "increments, depth", "or the user's own")):
        made.text(84, top + 24 + 17 * i, words, 13 if i == 0 else 11, font_weight="bold" if i == 0 else "normal")
    made.arrow(f"M84 60V{top}")
    made.text(92, 74, "vertices", 11, "start")
    for row, (name, (packets, *stages)) in enumerate(PATHS.items()):
        y = top + pitch * row
        middle = y + height / 2
        made.arrow(f"M144 {middle}H{left}")
        made.text(197, middle - 7, packets, 11)
        made.text(197, middle + 17, name, 12, font_weight="bold")
        for place, (module, words) in enumerate(stages):
            x = left + step * place
            made.box(x, y, width, height)
            made.text(x + width / 2, y + 18, module, 12, font_weight="bold")
            made.text(x + width / 2, y + 35, words, 11)
            end = right if place == len(stages) - 1 else x + step
            made.arrow(f"M{x + width} {middle}H{end}")
    made.path(f"M{right} {top}V{bottom - pitch + height}", svg.ACCENT, 2.4)
    made.text(right + 10, (top + bottom) / 2 - 22, "pixels", 13, "start", font_weight="bold")
    made.text(right + 10, (top + bottom) / 2 - 5, "diffuse, specular;", 11, "start")
    made.text(right + 10, (top + bottom) / 2 + 10, "depth, colour", 11, "start")
    made.save(path)


Wave = dict[str, list[int]]


def on_bus(wave: Wave, name: str, valid: str, word: Callable[[int], str]) -> list[str]:
    """The words of a signal while it is valid."""
    return [word(value) if used else "" for used, value in zip(wave[valid], wave[name], strict=True)]


def timing_core(path: Path) -> None:
    """Three spans, of 5, 1 and 3 pixels, in and out of the default core; what lies between is left out."""
    surface = Material(shininess=128)
    n, g = np.array([[-0.1, 0, 1], [0.2, 0.3, 0.9], [0.4, 0, 0.9]]), np.array([[0.08, 0, 0]] * 3)
    n, g = (np.rint(part * (1 << k.STEP_F)).astype(int) for part in (n, g))
    beats = pack_spans(n, g, [5, 1, 3], ONE, [7, 8, 9])
    words = registers(surface, (0.3, 0.6, 0.8)) | planner_registers(surface)
    span, pixel = "s_axis_span_t", "m_axis_pixel_t"
    names = [span + name for name in ("valid", "ready", "data")]
    names += [pixel + name for name in ("valid", "ready", "data", "user", "last")]
    run, wave = waves.record("shade_core", names, s_axis_span_tdata=beats, **WHOLE, writes=pack(words))
    first, given, end = run.taken[0], run.given[0], run.given[-1]
    clocks = np.r_[first - 1 : run.taken[-1] + 3, given - 2 : end + 2]
    before = np.argmax(wave[span + "valid"] & wave[span + "ready"]) - first  # clocks of the writes
    wave = {name: values[clocks + before].tolist() for name, values in wave.items()}

    bus = partial(on_bus, wave)
    sent, came = span + "valid", pixel + "valid"
    mask = (1 << k.TAG_W) - 1
    rows = [
        (sent, wave[sent]),
        (span + "ready", wave[span + "ready"]),
        ("span tdata, pixels", bus(span + "data", sent, lambda data: str(data >> k.SPAN_COUNT_LSB & 0x1FFF))),
        ("span tdata, tag", bus(span + "data", sent, lambda data: str(data >> k.SPAN_TAG_LSB & mask))),
        (came, wave[came]),
        (pixel + "ready", wave[pixel + "ready"]),
        ("pixel tdata, diffuse", bus(pixel + "data", came, lambda data: f"{(data & 0xFFFF) / ONE:.2f}")),
        ("pixel tdata, specular", bus(pixel + "data", came, lambda data: f"{(data >> k.PIXEL_W) / ONE:.2f}")),
        ("pixel tuser, tag", bus(pixel + "user", came, str)),
        (pixel + "last", [valid & last for valid, last in zip(wave[came], wave[pixel + "last"], strict=True)]),
    ]
    title = f"shade_core: spans of 5, 1 and 3 pixels leave as {len(run.given)} pixels in {end - given + 1} clocks"
    marks = {f"{given - first} clocks from span to first pixel": tuple(np.searchsorted(clocks, (first, given)))}
    svg.timing(rows, 34, title, marks, (clocks - first).tolist()).save(path)


def timing_poly_span(path: Path) -> None:
    """Three spans, of 5 (cubic), 2 (lit directly) and 3 pixels (parabola), in and out."""
    nodes = np.zeros((3, k.CHANNELS, k.NODE_COUNT))
    nodes[0, 0], nodes[1, 0, :2], nodes[2, 0, :3] = (0.20, 0.32, 0.48, 0.75), (0.90, 0.85), (0.50, 0.70, 0.40)
    count, degree, tag = np.array([5, 2, 3]), np.array([3, 0, 2]), np.array([7, 8, 9])
    beats = poly.pack_records(np.rint(nodes * ONE).astype(int), degree, count, tag)
    span, pixel = "s_axis_span_t", "m_axis_pixel_t"
    names = [span + "valid", span + "ready", span + "data", "valid", "t"]
    names += [pixel + name for name in ("valid", "ready", "data", "user", "last")]
    run, wave = waves.record("shade_poly_span", names, s_axis_span_tdata=beats)
    wave = {name: values[: run.clocks + 1].tolist() for name, values in wave.items()}

    bus, given = partial(on_bus, wave), wave[pixel + "valid"]
    rows = [
        (span + "valid", wave[span + "valid"]),
        (span + "ready", wave[span + "ready"]),
        ("span tdata, tag", bus(span + "data", span + "valid", lambda data: str(data >> k.RECORD_TAG_LSB))),
        ("t of a token", bus("t", "valid", lambda t: str(Fraction(t, 1 << k.T_F)))),
        (pixel + "valid", given),
        (pixel + "ready", wave[pixel + "ready"]),
        ("pixel tdata, diffuse", bus(pixel + "data", pixel + "valid", lambda data: f"{(data & 0xFFFF) / ONE:.2f}")),
        ("pixel tuser, tag", bus(pixel + "user", pixel + "valid", str)),
        (pixel + "last", [valid & last for valid, last in zip(given, wave[pixel + "last"], strict=True)]),
    ]
    latency, busy = run.given[0] - run.taken[0], run.given[-1] - run.given[0] + 1
    title = f"shade_poly_span: spans of 5, 2 and 3 pixels leave as {len(run.given)} pixels in {busy} clocks"
    marks = {f"{latency} clocks from span to first pixel": (run.taken[0], run.given[0])}
    svg.timing(rows, 26, title, marks).save(path)


def timing_horner_seq(path: Path) -> None:
    """Two values through the evaluator of P1, Fig. 9: what its multiplexers pass and what its register holds."""
    coefficients = np.rint(np.array([[0.5, -1, 0.75, 0.25]] * 2) * ONE).astype(int)
    run, wave = p1_arithmetic.record_seq(coefficients, np.array([ONE // 2, ONE // 4]))
    wave = {name: values[: run.clocks] for name, values in wave.items()}
    step, rg = wave["step_q"], wave["rg_q"]
    a, _, c, d = coefficients[0] << k.HORNER_GUARD
    half_ulp = ONE << k.HORNER_GUARD - 1  # that D brings along

    def passed(name: str, used: np.ndarray, **inputs: np.ndarray) -> list[str]:
        """Which input a multiplexer passes, told by the value at its output."""
        words = np.select([wave[name] == value for value in inputs.values()], list(inputs), "?")
        return np.where(used, words, "").tolist()

    multiply = np.isin(step, (1, 2, 4))
    rows = [
        *((name, wave[name].tolist()) for name in ("valid_i", "ready_o")),
        ("step", np.select([step > 0, wave["valid_i"] > 0], [step.astype(str), "load"], "").tolist()),
        ("MX1", passed("mx1", multiply, A=a, RG=rg)),
        ("BK", passed("bk", step > 0, zero=0, **{"pass": rg})),
        ("MX2", passed("mx2", step > 0, MUL=wave["mul"], C=c << k.T_F, D=(d << k.T_F) + half_ulp)),
        ("RG", ["", *(f"{value / (ONE << k.HORNER_GUARD):.4g}".replace("-", "−") for value in rg[1:])]),
        ("valid_o", wave["valid_o"].tolist()),
    ]
    title = "shade_horner_seq: A = 1/2, B = −1, C = 3/4, D = 1/4 at t = 1/2, then at t = 1/4"
    first, second = run.taken
    svg.timing(rows, 62, title, {f"{second - first} clocks a value": (first, second)}).save(path)


def main() -> None:
    """Make all pictures."""
    DOCS.mkdir(exist_ok=True)
    made = {
        "head.png": head,
        "forms.png": forms,
        "gallery.png": every_model,
        "degrees.png": degrees,
        "architecture.svg": architecture,
        "datapath.svg": datapath,
        "timing_core.svg": timing_core,
        "timing_poly_span.svg": timing_poly_span,
        "timing_horner_seq.svg": timing_horner_seq,
    }
    for name, draw in tqdm(made.items(), desc="pictures", disable=None, delay=2, leave=False):
        draw(DOCS / name)
    print(f"{DOCS}: {', '.join(made)}")


if __name__ == "__main__":
    main()
