# SPDX-License-Identifier: Apache-2.0
"""Paper P1, section IV, polynomials along a raster line against the light that they stand for."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import numpy as np
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import plan, poly
from polyshade.golden.reference import poly as reference
from polyshade.golden.reference.light import blinn, diffuse, unit
from polyshade.scripts.studies.papers import figures
from polyshade.scripts.studies.papers.claims import Claim, check, nmse

p1 = partial(check, paper="P1")
ONE = 1 << k.INTENSITY_F
LIGHT = np.array([0.0, 0.0, 1.0])  # where the viewer is: N.L = N.H
NMSE_BAR = 1e-4  # what P1 promises of the adaptive method
ARCS = 2048
ARC = 6  # degrees: the root mean square of the default head's raster lines at 1024 x 1024
MIDDLES = (np.arange(64) + 0.5) / 64  # t at which an arc is compared


def line(folder: Path, size: int) -> Iterator[Claim]:
    """Three raster lines through the RTL, both forms: a constant, an arc of diffuse light, a highlight."""
    curves = {
        "constant intensity 1/2": (lambda normal: np.full(len(normal), 0.5), 0, 0),
        "diffuse light, arc of 30°": (partial(diffuse, light=(1.1, 0, 0.6)), 30, 1),
        "highlight, n = 32, arc of 36°": (partial(blinn, light=LIGHT, shininess=32), 36, 32),
    }
    pixels = 65
    t = np.arange(pixels) / (pixels - 1)
    exact, drawn, nodes = [], {k.FORM_PAPER: [], k.FORM_REFINED: []}, []
    for light, degrees, n in curves.values():
        bow = arc(np.radians(degrees) / 2)
        exact.append(light(bow(t)))
        steps = plan.quantize_kappa(n * (1 - np.cos(np.radians(degrees))))
        for form, records in (
            (k.FORM_PAPER, plan.plan_fixed([pixels], k.DEGREE_CUBIC)),
            (k.FORM_REFINED, plan.plan([pixels], steps)),
        ):
            at = records.nodes / (pixels - 1)
            nodes.append((at.ravel(), light(bow(at.ravel()))))
            drawn[form].append(run_records(records, nodes[-1][1].reshape(at.shape), form))
    excess = drawn[k.FORM_PAPER][0][-1] / exact[0][-1] - 1
    yield p1(
        "a constant intensity comes out too bright with the x/3 of Fig. 7, at the line's end by",
        "= 27",
        100 * excess,
        unit="%",
        kind="defect",
        figure="p1_line.png",
        note="RTL, shade_poly_span",
    )
    with figures.drawing(folder / "p1_line.png", 10, 4.6, 2, 3, sharex=True, height_ratios=(3, 2)) as axes:
        for i, name in enumerate(curves):
            above, below = axes[i], axes[i + 3]
            above.plot(t, exact[i], color=figures.EXACT, lw=4, alpha=0.22, label="exact")
            for form, colour, label in (
                (k.FORM_PAPER, figures.PAPER, "P1's form"),
                (k.FORM_REFINED, figures.REFINED, "refined form"),
            ):
                above.plot(t, drawn[form][i], color=colour, label=label)
                above.plot(*nodes[2 * i + form], "o", color=colour, ms=4 if form == k.FORM_REFINED else 6)
                below.plot(t, np.abs(drawn[form][i] - exact[i]).clip(1e-6), color=colour)
            above.set(title=name, ylim=(0, 1.05))
            below.set(yscale="log", ylim=(1e-6, 1), xlabel="t along the raster line")
        axes[0].set_ylabel("intensity; dots: nodes")
        axes[0].legend(loc="lower left")
        axes[3].set_ylabel("absolute error")


def arcs(folder: Path, size: int) -> Iterator[Claim]:
    """Random arcs of diffuse light: the error by degree, form and length."""
    by_43 = partial(interpolate, 3, third=reference.third_paper)
    methods = {
        "degree 1": (figures.DEGREES[1], partial(interpolate, 1)),
        "degree 2": (figures.DEGREES[2], partial(interpolate, 2)),
        "degree 3": (figures.DEGREES[3], partial(interpolate, 3)),
        "degree 3, P1's form with 43/128": (figures.PAPER, by_43),
        "degree 3, difference form with 43/128": (figures.THIRD, partial(by_43, form=k.FORM_REFINED)),
    }
    degrees = np.array([2, 4, ARC, 10, 15, 20, 30, 45, 60, 90])
    found = {name: np.zeros(len(degrees)) for name in methods}
    for i, degree in enumerate(degrees):
        curve = lambert_arcs(np.random.default_rng(3), np.radians(degree))
        exact = curve(MIDDLES)
        for name, (_, method) in methods.items():
            found[name][i] = nmse(method(curve), exact)
    usual = degrees == ARC

    curve = lambert_arcs(np.random.default_rng(4), np.radians(ARC))
    nodes = np.rint(curve(np.array(reference.NODES[k.NODES_LEFT][3])) * ONE).astype(int)

    def by_golden(form: int) -> float:
        coefficients = (v[:, None] for v in poly.coef(k.DEGREE_CUBIC, *nodes.T, form=form))
        return nmse(poly.horner(*coefficients, (MIDDLES * ONE).astype(int)) / ONE, curve(MIDDLES))

    in_arcs = partial(p1, figure="p1_arcs.png")
    yield in_arcs(
        f"random Lambert arcs of {ARC} degrees with the x/3 of Fig. 7: NMSE",
        "= 1.4e-2",
        by_golden(k.FORM_PAPER),
        kind="defect",
        note=f"golden model, {ARCS} arcs; {NMSE_BAR:.0e} is promised",
    )
    difference = found["degree 3, difference form with 43/128"]
    yield in_arcs(
        f"random Lambert arcs of {ARC} degrees, difference form, still with 43/128: NMSE",
        "= 1e-7",
        difference[usual][0],
        kind="repair",
        note=f"float64; it grows with the square of the arc: {difference[degrees == 20][0]:.0e} at 20 degrees",
    )
    yield in_arcs(
        f"random Lambert arcs of {ARC} degrees, difference form and faithful third: NMSE",
        "<= 1e-7",
        by_golden(k.FORM_REFINED),
        kind="repair",
        note="golden model: what is left is the quantization to 16 bits",
    )

    reach = {d: np.interp(np.log(NMSE_BAR), np.log(found[f"degree {d}"]), degrees) for d in (1, 2, 3)}
    reaches = partial(
        in_arcs,
        note="float64; arcs of diffuse light within NMSE 1e-4: "
        + ", ".join(f"degree {d} up to {reach[d]:.0f} degrees" for d in reach),
    )
    yield reaches(
        "quadratic interpolation allows longer intervals than linear: times as long", ">= 1", reach[2] / reach[1]
    )
    yield reaches(
        "a parabola distorts where a cubic does not: intervals of the cubic, times as long", ">= 1", reach[3] / reach[2]
    )
    left, right = (nmse(interpolate(3, curve, nodes=nodes), curve(MIDDLES)) for nodes in (k.NODES_LEFT, k.NODES_RIGHT))
    yield p1(
        "either node set serves: NMSE of the second over that of the first",
        "= 1.0",
        right / left,
        note="float64, exact thirds: mirror images of each other",
    )
    with figures.drawing(folder / "p1_arcs.png", 7, 4.2) as (axes,):
        for name, (colour, _) in methods.items():
            axes.plot(degrees, found[name], ".-", color=colour, label=name)
        axes.axhline(NMSE_BAR, color=figures.EXACT, ls=":", lw=1)
        axes.text(2, NMSE_BAR * 1.5, "P1's bar, 1e-4", fontsize=8)
        axes.set(xscale="log", yscale="log", xlabel="length of the arc, degrees", ylabel="NMSE", ylim=(1e-16, 10))
        axes.set_xticks(degrees, degrees)
        axes.set_title("Diffuse light along random arcs")
        axes.minorticks_off()
        axes.legend(loc="lower right")


def kappa(folder: Path, size: int) -> Iterator[Claim]:
    """The number by which degree and segments are chosen: kappa = n (1 - c)."""
    powers = (16, 64, 256, 1024)
    ladder = np.geomspace(0.003, 6, 34)
    worst = {
        degree: np.array([[highlight_error(degree, n, x) for x in ladder] for n in powers]) for degree in (1, 2, 3)
    }
    usual = ladder <= plan.THRESHOLDS[2] / (1 << plan.KAPPA_F)
    spread = max(np.ptp(error[:, usual], axis=0).max() / error[:, usual].max() for error in worst.values())
    yield p1(
        "the error of cos^n along an arc depends on kappa = n (1 - c) alone: worst spread over n = 16 .. 1024",
        "<= 25",
        100 * spread,
        unit="% of the largest error",
        kind="repair",
        figure="p1_kappa.png",
        note="float64, highlights at every place of the line, kappa up to T3; a step of the ladder is a factor of four",
    )
    with figures.drawing(folder / "p1_kappa.png", 7, 4.2) as (axes,):
        for degree, error in worst.items():
            for n, row, alpha in zip(powers, error, (0.35, 0.55, 0.75, 1), strict=True):
                label = figures.DEGREE_NAMES[degree] if n == powers[-1] else None
                axes.plot(ladder, row, color=figures.DEGREES[degree], alpha=alpha, label=label)
        for i, threshold in enumerate(plan.THRESHOLDS, 1):
            axes.axvline(threshold / (1 << plan.KAPPA_F), color=figures.EXACT, ls=":", lw=1)
            axes.text(threshold / (1 << plan.KAPPA_F) * 1.05, 2e-5, f"T{i}", fontsize=9)
        axes.set(
            xscale="log", yscale="log", xlabel="κ = n (1 − c)", ylabel="largest error of the highlight", ylim=(1e-5, 1)
        )
        axes.set(title="One number tells the error: n = 16, 64, 256, 1024 (light to dark)")
        axes.legend(loc="lower right")


def arc(half_angle: float) -> Callable[[np.ndarray], np.ndarray]:
    """Normals (len(t), 3) at t of an arc around the viewing direction, interpolated linearly, not normalized."""
    side, front = np.sin(half_angle), np.cos(half_angle)
    return lambda t: np.stack([side * (2 * t - 1), np.zeros_like(t), np.full_like(t, front)], axis=-1)


def run_records(records: plan.Records, nodes: np.ndarray, form: int) -> np.ndarray:
    """Intensities that ``shade_poly_span`` gives for records with intensities (R, 4) at their nodes."""
    both = np.rint(np.repeat(nodes[:, None], k.CHANNELS, axis=1) * ONE).astype(int)
    beats = poly.pack_records(both, records.degree, records.count)
    run = sim.load("shade_poly_span", EVALUATOR=k.EVALUATOR_HORNER, FORM=form).run(s_axis_span_tdata=beats)
    return (run.m_axis_pixel_tdata & 0xFFFF) / ONE


def lambert_arcs(rng: np.random.Generator, angle: float) -> Callable[[np.ndarray], np.ndarray]:
    """I(t) (ARCS, len(t)) of diffuse light, unclamped, along random arcs of an angle."""
    first = unit(rng.normal(size=(ARCS, 3)))
    first[:, 2] = np.abs(first[:, 2])
    across = unit(np.cross(first, rng.normal(size=(ARCS, 3))))
    last = first * np.cos(angle) + across * np.sin(angle)
    return lambda t: diffuse(first[:, None] + (last - first)[:, None] * t[:, None], LIGHT)


def interpolate(degree: int, curve: Callable[[np.ndarray], np.ndarray], **options) -> np.ndarray:
    """The polynomial through a curve's nodes at ``MIDDLES``, in float64; ``options``: of ``reference.coef``."""
    at = reference.NODES[options.get("nodes", k.NODES_LEFT)][degree]
    coefficients = reference.coef(degree, curve(np.array(at)), **options)
    return reference.horner(tuple(c[..., None] for c in coefficients), MIDDLES)


def highlight_error(degree: int, n: float, kappa: float) -> float:
    """Largest error of a polynomial for cos^n over arcs of one kappa whose highlight lies anywhere on them or near."""
    half = np.arccos(1 - kappa / n) / 2
    off = np.linspace(0, 1, 41)[:, None] * (half + 2 / np.sqrt(n))  # of the light from the arc's middle

    def curve(t: np.ndarray) -> np.ndarray:
        at = np.arctan(np.tan(half) * (2 * t - 1))
        return np.cos(at - off) ** n

    return np.abs(interpolate(degree, curve) - curve(MIDDLES)).max()


STEPS = [line, arcs, kappa]
