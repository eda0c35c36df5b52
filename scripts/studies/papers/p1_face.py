# SPDX-License-Identifier: Apache-2.0
"""Paper P1, section IV, the adaptive method on a face: error, cost, and where which degree is used (Figs. 10, 11)."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.patches import Patch
from numpy.typing import NDArray
from polyshade.golden import contract as k
from polyshade.golden import plan, poly
from polyshade.golden.material import Material
from polyshade.scripts.studies.papers import figures
from polyshade.scripts.studies.papers.claims import Claim, check, nmse
from polyshade.scripts.studies.papers.view import View, view
from polyshade.sim import frame
from polyshade.sim.scene.camera import Camera

p1 = partial(check, paper="P1")
POWERS = (8, 16, 32, 64, 128, 256, 512)

# What the design promises for a head of about 9,000 triangles at 1024 x 1024:
# n, (T1, T2, T3), NMSE diffuse, NMSE specular, light evaluations a pixel
PROMISED = (
    (32, (0.01, 0.15, 1.5), "<= 1.3e-6", "<= 8e-6", "<= 0.38"),
    (32, (0.003, 0.05, 0.5), "<= 1.2e-6", "<= 4.5e-6", "<= 0.44"),
    (128, (0.003, 0.05, 0.5), "<= 1.2e-6", "<= 7.2e-6", "<= 0.55"),
    (512, (0.003, 0.05, 0.5), "<= 1.2e-6", "<= 7.9e-6", "<= 0.72"),
)

# Long operations as P1 calls them, (multiplications; square roots and divisions), of
DOT = np.array([3, 0])  # N.L, N.H, Na.Nb
NORMALIZE = np.array([6, 2])  # N.N, its root, a reciprocal, three products
GAINS = ("roots and divisions", "multiplications, forward differences", "multiplications, Horner")


def face(folder: Path, size: int) -> Iterator[Claim]:
    """The head through the RTL, both forms, over the exponent of the highlight."""
    frames = {
        (form, n): frame.render(frame.Settings(camera=Camera(size), material=Material(form=form, shininess=n)))
        for form in frame.FORMS
        for n in POWERS
    }
    reports = {key: made.report for key, made in frames.items()}
    on_face = partial(p1, figure="p1_nmse.png", note=f"RTL, head, {size} x {size}, against float64 Phong shading")
    for n in (32, 128):
        for channel in ("diffuse", "specular"):
            yield on_face(
                f"adaptive method, refined: NMSE, {channel}, n = {n}",
                "<= 1e-4",
                reports["refined", n][f"nmse_{channel}"],
            )
    yield on_face(
        "adaptive method, refined: worst NMSE of either channel, n = 8 .. 512",
        "<= 1e-4",
        max(max(reports["refined", n]["nmse_diffuse"], reports["refined", n]["nmse_specular"]) for n in POWERS),
    )
    for channel in ("diffuse", "specular"):
        yield on_face(
            f"cubics with the x/3 of Fig. 7, as printed: NMSE, {channel}, n = 32",
            "<= 1e-4",
            reports["paper", 32][f"nmse_{channel}"],
        )
    for degree in (2, 3):
        for n, channel in ((32, "diffuse"), (32, "specular"), (128, "specular")):
            scene = view(size, n)
            errors, _ = scene.shade(plan.plan_fixed(scene.spans.count, degree))
            yield on_face(
                f"degree {degree} on every raster line, thirds repaired: NMSE, {channel}, n = {n}",
                "<= 1e-4",
                errors[f"nmse_{channel}"],
            )
    steps = {form: picture_steps(frames[form, 32]) for form in frame.FORMS}
    yield on_face(
        "visually indistinguishable from Phong's method: largest difference in an 8-bit picture, n = 32",
        "<= 1",
        steps["refined"],
        unit="steps",
        note=f"RTL, refined, head, {size} x {size}; {steps['paper']} steps in the form as printed",
    )
    eight_bits = np.rint(255 * frames["refined", 32].exact) / 255
    yield p1(
        "a quantization to 8 bits alone costs an NMSE of",
        "= 5e-6",
        nmse(eight_bits, frames["refined", 32].exact),
        kind="repair",
        note="why comparisons are made at 16 bits",
    )
    yield p1(
        f"pixels of {len(reports)} frames, both forms, that differ from the golden model",
        "<= 0",
        sum(report["mismatches"] for report in reports.values()),
        unit="pixels",
        kind="repair",
        note=f"RTL, {sum(report['pixels'] for report in reports.values())} pixels, every bit compared",
    )
    draw_forms(folder / "p1_forms.png", frames["paper", 32], frames["refined", 32])
    with figures.drawing(folder / "p1_nmse.png", 9.5, 4.4, 1, 2) as (left, right):
        for form, colour in (("paper", figures.PAPER), ("refined", figures.REFINED)):
            name = {"paper": "P1's form, cubics", "refined": "refined, planned by κ"}[form]
            for channel, style in (("diffuse", "o--"), ("specular", "o-")):
                values = [reports[form, n][f"nmse_{channel}"] for n in POWERS]
                left.plot(POWERS, values, style, color=colour, label=f"{name}, {channel}")
            values = [reports[form, n]["light_evaluations_per_pixel"] for n in POWERS]
            right.plot(POWERS, values, "o-", color=colour, label=name)
        left.axhline(1e-4, color=figures.EXACT, ls=":", lw=1)
        left.text(POWERS[0], 1.5e-4, "P1's bar, 1e-4", fontsize=8)
        left.set(yscale="log", ylabel="NMSE", ylim=(1e-12, 1), title=f"Error on the head, {size} × {size}")
        right.set(ylim=(0, 1.2), ylabel="light evaluations a pixel", title="Cost")
        right.axhline(1, color=figures.EXACT, ls=":", lw=1)
        right.text(POWERS[0], 1.02, "Phong: one a pixel", fontsize=8)
        for axes in (left, right):
            axes.set(xscale="log", xlabel="exponent n of the highlight")
            axes.set_xticks(POWERS, POWERS)
            axes.minorticks_off()
            axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=2)


def ladder(folder: Path, size: int) -> Iterator[Claim]:
    """The design's figures for its ladder, at twice the size, and the default ladder beside them."""
    on_head = partial(p1, kind="repair", note=f"RTL, head, {2 * size} x {2 * size}")
    default = tuple(threshold / (1 << plan.KAPPA_F) for threshold in plan.THRESHOLDS)
    for n, thresholds, *claimed in (
        *PROMISED,
        *((n, default, *claimed) for n, _, *claimed in PROMISED[:1] + PROMISED[2:]),
    ):
        scene = view(2 * size, n)
        steps = tuple(int(step) for step in plan.quantize_kappa(thresholds))
        errors, evaluations = scene.shade(plan.plan(scene.spans.count, scene.kappa, steps))
        name = f"{'default ladder' if thresholds == default else 'ladder'} {', '.join(f'{t:g}' for t in thresholds)}"
        yield on_head(f"{name}, n = {n}: NMSE diffuse", claimed[0], errors["nmse_diffuse"])
        yield on_head(f"{name}, n = {n}: NMSE specular", claimed[1], errors["nmse_specular"])
        yield on_head(f"{name}, n = {n}: light evaluations a pixel", claimed[2], evaluations)
    scene = view(2 * size, 128)
    errors, _ = scene.shade(plan.plan_fixed(scene.spans.count, k.DEGREE_CUBIC))
    yield on_head(
        "one cubic a raster line, without segments, n = 128: NMSE specular",
        "= 1.3e-3",
        errors["nmse_specular"],
        kind="defect",
        note=f"{on_head.keywords['note']}; a line's cubic reaches to the next power of two of pixels",
    )


def gain(folder: Path, size: int) -> Iterator[Claim]:
    """Long operations a pixel: Phong's method against polynomials planned by kappa."""
    sizes = [size // 2, size, 2 * size, 4 * size]
    by_size = np.array([gains(view(each, 32)) for each in sizes])
    by_power = np.array([gains(view(2 * size, n)) for n in POWERS])
    counted = partial(
        p1,
        figure="p1_gain.png",
        note="head, n = 32; a light evaluation is 17 multiplications, a root, a division; planning is included",
    )
    for i, each in enumerate(sizes[2:], 2):
        for j, name in enumerate(GAINS):
            yield counted(
                f"up to 3 times Phong's productivity: times fewer {name}, {each} x {each}", ">= 3", by_size[i, j]
            )
    with figures.drawing(folder / "p1_gain.png", 9.5, 3.8, 1, 2, sharey=True) as axes:
        colours = (figures.EXACT, figures.REFINED, figures.THIRD)
        for j, (name, colour) in enumerate(zip(GAINS, colours, strict=True)):
            axes[0].plot(sizes, by_size[:, j], "o-", color=colour, label=name)
            axes[1].plot(POWERS, by_power[:, j], "o-", color=colour, label=name)
        for each in axes:
            each.axhline(3, color=figures.PAPER, ls=":", lw=1.2)
            each.set(xscale="log", ylim=(0, None))
            each.minorticks_off()
        axes[0].set_xticks(sizes, sizes)
        axes[1].set_xticks(POWERS, POWERS)
        axes[0].set(title="n = 32", xlabel="width of the frame, pixels", ylabel="times fewer than Phong's method")
        axes[1].set(title=f"{2 * size} × {2 * size}", xlabel="exponent n of the highlight")
        axes[0].text(sizes[0], 3.06, "P1: up to 3 times", fontsize=8, color=figures.PAPER)
        axes[0].legend(loc="lower right")


def degrees(folder: Path, size: int) -> Iterator[Claim]:
    """Which degree serves which part of the face: P1's Figs. 10 and 11."""
    share = draw_degrees(folder / "p1_degrees.png", 2 * size, (32, 128))[0]
    parts = ", ".join(f"{figures.DEGREE_NAMES[degree]} {100 * part:.0f} %" for degree, part in enumerate(share))
    yield p1(
        "Fig. 10: parts of the face need degree 3, for others 2 is enough: share of degree 2 or 1, n = 32",
        ">= 1",
        100 * share[1:3].sum(),
        unit="%",
        figure="p1_degrees.png",
        note=f"head, {2 * size} x {2 * size}: {parts}",
    )


def gains(scene: View) -> tuple[float, float, float]:
    """How many times fewer long operations (``GAINS``) than Phong's method, planning included."""
    spans = scene.spans
    records = plan.plan(spans.count, scene.kappa)
    _, evaluations = scene.node_light(records)
    light = NORMALIZE + 2 * DOT + np.array([np.log2(scene.shininess), 0])  # the power by squarings

    # Up to two pixels are lit as they are. Of longer spans the planner needs the unit normal at the far end of the arc,
    # which often is a node's.
    planned = spans.count > 2
    first = np.searchsorted(records.span, np.arange(len(spans)))
    far = np.maximum.reduceat(records.nodes.max(axis=1), first)
    extra = planned & (far < 1 << poly.span_log2(spans.count))
    nodes = evaluations * light + planned.sum() * DOT + extra.sum() * NORMALIZE

    horner = k.CHANNELS * (records.degree * records.count).sum()
    multiplications, roots = spans.pixels * light
    return roots / nodes[1], multiplications / nodes[0], multiplications / (nodes[0] + horner)


def draw_degrees(path: Path, size: int, powers: tuple[int, ...]) -> NDArray[np.float64]:
    """Draw the degree of every pixel of the head; (len(powers), 4) shares of the seen pixels."""
    shares = np.zeros((len(powers), 4))
    with figures.drawing(path, 4.6 * len(powers), 5.2, 1, len(powers)) as axes:
        for row, (n, plot) in enumerate(zip(powers, axes, strict=True)):
            scene = view(size, n)
            records = plan.plan(scene.spans.count, scene.kappa)
            seen = scene.visible >= 0
            pixel = scene.visible[seen]
            degree = np.repeat(records.degree, records.count)[pixel]
            shares[row] = np.bincount(degree, minlength=4) / len(degree)
            colours = np.array([to_rgb(figures.DEGREES[d]) for d in range(4)])
            picture = np.ones((size * size, 3))
            picture[seen] = colours[degree] * (0.45 + 0.55 * scene.exact[pixel, :1])
            plot.imshow(picture.reshape(size, size, 3), interpolation="lanczos")
            plot.set_title(f"n = {n}")
            plot.axis("off")
            patches = [
                Patch(color=figures.DEGREES[d], label=f"{figures.DEGREE_NAMES[d]}, {100 * part:.0f} %")
                for d, part in enumerate(shares[row])
            ]
            plot.legend(handles=patches, ncols=2, loc="upper center", bbox_to_anchor=(0.5, 0))
    return shares


def picture_steps(made: frame.Frame) -> int:
    """Largest difference of a frame's picture from that of its float64 reference, in steps of 8 bits."""
    pictures = (np.asarray(made.picture(light), int) for light in (made.intensity, made.exact))
    return int(np.abs(np.subtract(*pictures)).max())


def draw_forms(path: Path, paper: frame.Frame, refined: frame.Frame, white: float = 1 / 16) -> None:
    """Draw two frames and their distance from float64, of the worse channel, as heat: ``white`` and more is white."""
    size = paper.settings.camera.size
    crop = (slice(None), slice(size * 2 // 11, size * 9 // 11))  # the head is higher than wide
    with figures.drawing(path, 10.4, 4.35, 1, 4) as axes:
        for name, made, (picture, heat) in (
            ("P1's form, as printed", paper, axes[:2]),
            ("refined form", refined, axes[2:]),
        ):
            error = np.zeros(size * size)
            seen = made.visible >= 0
            error[seen] = np.abs(made.intensity - made.exact).max(axis=1)[made.visible[seen]]
            picture.imshow(np.asarray(made.picture(made.intensity))[crop])
            picture.set_title(name)
            heat.imshow(error.reshape(size, size)[crop], cmap="inferno", vmin=0, vmax=white)
            heat.set_title(f"its error, NMSE {made.report['nmse']:.1e}")
            heat.text(0.97, 0.02, f"white: {Fraction(white)}", color="white", ha="right", transform=heat.transAxes)
        for plot in axes:
            plot.axis("off")


STEPS = [face, ladder, gain, degrees]
