# SPDX-License-Identifier: Apache-2.0
"""Paper P4, vectors one by one: increments, metrics, midpoints, and the methods that both P2 and P4 compare with."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from polyshade.golden import contract as k
from polyshade.golden import normal
from polyshade.golden.reference import light
from polyshade.golden.reference import normal as reference
from polyshade.scripts.studies.papers import figures
from polyshade.scripts.studies.papers.claims import Claim, check, nmse
from polyshade.sim.core import quantize

p2 = partial(check, paper="P2")
p4 = partial(check, paper="P4")
ONE = 1 << k.INTENSITY_F
COSINES = np.arange(ONE + 1)
C = COSINES / ONE
SECTORS = np.arange(k.METRIC_M_MIN, k.METRIC_M_MAX + 1)
SHOWN = np.rint(np.cos(np.radians(np.linspace(0, 90, 361))) * ONE).astype(int)  # cosines in figures
UP_TO_60 = C >= 1 / 2
NMSE_BAR = 1e-4
RIGHT_ANGLE = np.pi / 2


def increments(folder: Path, size: int) -> Iterator[Claim]:
    """One increment for all raster lines of a triangle, and what the printed formulas give."""
    rng = np.random.default_rng(6)
    triangles = 1000
    normals = light.unit(rng.normal(size=(3, triangles, 3)))  # of A, B, C
    ab, ac = rng.uniform(10, 100, (2, triangles, 1))  # lengths of the sides
    span = rng.uniform(10, 100, (triangles, 1))  # length of the raster line through B: lines are parallel to it
    part = np.linspace(0.05, 1, 20)[:, None, None]  # of the way from A that a line is

    def step(divisor: NDArray[np.float64]) -> NDArray[np.float64]:
        """(lines, triangles, 3): increment of lines from AB to AC; C's share is divided by ``divisor``."""
        left = (normals[1] - normals[0]) / ab * (part * ab)
        right = (normals[2] - normals[0]) / divisor * (part * ac)
        return (right - left) / (part * span)

    proper, printed = step(ac), step(ab)
    size_of_step = np.linalg.norm(proper, axis=-1)
    yield p4(
        "the increment is the same for every raster line of a triangle: largest relative difference",
        "<= 1e-12",
        (np.linalg.norm(proper - proper[0], axis=-1) / size_of_step).max(),
        note=f"float64, {triangles} random triangles, {len(part)} lines each",
    )
    yield p4(
        "formulas as printed, AB where AC belongs: increment of line MN against that of FG, mean relative difference",
        ">= 0.1",
        (np.linalg.norm(printed - proper, axis=-1) / size_of_step).mean(),
        kind="defect",
        note="N lies on AC, so the proof that follows in P4 needs AC",
    )
    wrong_z = proper + (normals[0, :, 1:2] - normals[0, :, 2:]) / span * [0, 0, 1]  # (Z_NB - Y_NA)/AB AM/MN
    yield p4(
        "formulas as printed, Y_NA where Z_NA belongs: increment of line MN, mean relative difference",
        ">= 0.1",
        (np.linalg.norm(wrong_z - proper, axis=-1) / size_of_step).mean(),
        kind="defect",
    )


def metrics(folder: Path, size: int) -> Iterator[Claim]:
    """d1a and d2, the estimates of the length of a middle (Figs. 3, 4)."""
    c, m = C[:, None], SECTORS
    d1a, d2, *_ = normal.metric(COSINES[:, None], m)
    error = np.abs(d1a / ONE / reference.d1(c, m) - 1)
    worst = np.unravel_index(error.argmax(), error.shape)
    golden = "golden model, every cosine in [0, 1]"
    yield p4(
        "Fig. 3: largest relative error of d1a from d1, m = 3 .. 12",
        "<= 5",
        100 * error.max(),
        unit="%",
        figure="p4_metrics.png",
        note=f"{golden}; at {np.degrees(np.arccos(C[worst[0]])):.0f} degrees, m = {m[worst[1]]}",
    )
    d2 = d2[:, 0] / ONE
    d2_error = np.abs(d2 / reference.d1(C, 2) - 1)
    yield p4(
        "Fig. 4: largest relative error of d2 from cos(x/2)",
        "<= 0.7",
        100 * d2_error.max(),
        unit="%",
        figure="p4_metrics.png",
        note=golden,
    )
    yield p4(
        "V1, V2 are taken where d1a < 0.9, which is never so: least d1a for m >= 3",
        ">= 0.9",
        d1a.min() / ONE,
        kind="defect",
        figure="p4_metrics.png",
        note=f"{golden}; of {d1a.size} pairs (c, m) {int(np.sum(d1a < k.METRIC_THRESHOLD))} are below 0.9",
    )
    for name, edge in (
        ("d1a >= 0.9, m = 3", np.cos(RIGHT_ANGLE / 3 * 2)),
        ("d2 >= 0.9", C[d2 >= k.METRIC_THRESHOLD / ONE].min()),
    ):
        a, b = reference.arcs([np.arccos(edge)], 4096, np.random.default_rng(7))
        exact = reference.METHODS["root and division"].middle(a, b)
        lit = [np.stack([light.diffuse(n, light.VIEW, as_given=True) for n in (a, mid)]).clip(0)
               for mid in ((a + b) / 2, exact)]  # fmt: skip
        yield p4(
            f"where {name}, means need no normalization: diffuse NMSE at the worst angle that it admits",
            f"<= {NMSE_BAR}",
            nmse(*lit),
            note=f"float64, random arcs, neighbours at {np.degrees(np.arccos(edge)):.0f} degrees: every other normal "
            f"is {100 * reference.shortfall(edge):.1f} % too short",
        )
    half = normal.half(COSINES) / ONE / reference.d1(C, 2) - 1
    yield p4(
        "refined cosine of the half angle, largest relative error up to 60 degrees",
        "<= 4e-4",
        np.abs(half[UP_TO_60]).max(),
        kind="repair",
        figure="p4_metrics.png",
        note=f"{golden}; over all of it {np.abs(half).max():.1e}, d2: {d2_error.max():.1e}",
    )
    degrees = np.degrees(np.arccos(C[SHOWN]))
    with figures.drawing(folder / "p4_metrics.png", 10, 4, 1, 2) as (left, right):
        for i, sectors in enumerate(m):
            shade = figures.SHADES[min(i // 3, 3)]
            label = f"m = {sectors}" if i % 3 == 0 else None
            left.plot(degrees, 100 * error[SHOWN, i], color=shade, label=label, lw=2 - i % 3 * 0.6)
        left.axhline(5, color=figures.PAPER, ls=":", lw=1.2)
        left.text(2, 5.1, "P4: at most 5 %", color=figures.PAPER, fontsize=8.5)
        left.set(title="Fig. 3: d1a against cos(x/m)", ylabel="relative error, %", ylim=(0, 6.6))
        left.legend(loc="upper center", ncols=4)
        right.plot(degrees, 100 * d2_error[SHOWN], color=figures.PAPER, label="P4's d2, golden model")
        right.plot(degrees, 100 * np.abs(half[SHOWN]), color=figures.REFINED, label="refined, golden model")
        right.axhline(0.7, color=figures.PAPER, ls=":", lw=1.2)
        right.set(title="Fig. 4: cos(x/2)", ylabel="relative error, %", yscale="log", ylim=(1e-4, 6))
        right.legend(loc="upper left")
        for axes in (left, right):
            axes.set(xlabel="angle x, degrees")


def midpoints(folder: Path, size: int) -> Iterator[Claim]:
    """InvC1, InvC2, and InvC anchored at equal normals (Fig. 5)."""
    exact = reference.invc(C)
    scale = 1 << k.INVC_F
    forms = {
        "InvC1": (normal.invc(COSINES, k.FORM_PAPER, 1)[0] / scale, figures.PAPER),
        "InvC2": (normal.invc(COSINES, k.FORM_PAPER, 2)[0] / scale, figures.THIRD),
        "refined": (normal.invc(COSINES)[0] / scale, figures.REFINED),
    }
    error = {name: np.abs(value / exact - 1) for name, (value, _) in forms.items()}
    on = partial(p4, figure="p4_invc.png", note="golden model, every cosine in [0, 1]")
    yield on("Fig. 5: largest relative error of InvC1", "<= 3", 100 * error["InvC1"].max(), unit="%")
    yield on("Fig. 5: largest relative error of InvC2", "= 0.58", 100 * error["InvC2"].max(), unit="%")
    small = np.interp(np.linspace(0, RIGHT_ANGLE, 10001), np.arccos(C[::-1]), error["InvC2"][::-1]) <= 0.0027
    yield on(
        "Fig. 5: InvC2 within 0.27 % on the bigger part of the interval: share of the angles",
        ">= 50",
        100 * small.mean(),
        unit="%",
    )
    equal = partial(on, kind="defect", note="golden model, c = 1; it should be 0.500, a power n multiplies the error")
    for name, claimed in (("InvC1", "= 0.492"), ("InvC2", "= 0.501")):
        yield equal(f"{name} of two equal normals", claimed, forms[name][0][-1])
    repaired = partial(on, kind="repair")
    yield repaired("refined InvC of two equal normals: distance from 1/2", "<= 0", abs(forms["refined"][0][-1] - 0.5))
    yield repaired("refined InvC: largest relative error up to 60 degrees", "<= 4e-4", error["refined"][UP_TO_60].max())
    yield repaired("refined InvC: largest relative error up to 90 degrees", "<= 7e-3", error["refined"].max())
    u = 1 - C
    for reach, claimed, first, second in ((0.5, "= 2.8e-4", 0.12198, 0.06480), (0.7, "= 5.1e-5", 0.12407, 0.05642)):
        fit = (1 / 2 + first * u + second * u * u) / exact - 1
        yield p4(
            f"1/2 + {first} u + {second} u^2 for c >= {reach}: largest relative error",
            claimed,
            np.abs(fit[reach <= C]).max(),
            kind="repair",
            note="float64; the integer model's constants are dyadic",
        )
    rng = np.random.default_rng(8)
    n = integer_arcs([0], 1 << 16, rng)[0]
    equals = np.stack(normal.midpoint(*n, *n, normal.dot3(*n, *n))[:3])
    yield p4(
        "refined middle of two equal normals: largest distance of its length from theirs",
        "<= 2",
        np.abs(np.linalg.norm(equals, axis=0) - np.linalg.norm(n, axis=0)).max(),
        unit="ulp",
        kind="repair",
        note=f"golden model, {n[0].size} random normals",
    )
    angles = np.radians(np.arange(1, 61))
    a, b = integer_arcs(angles, 2048, rng)
    lengths = {
        form: np.abs(np.linalg.norm(chain(a, b, form), axis=1) / ONE - 1)[1:4].max()
        for form in (k.FORM_REFINED, k.FORM_PAPER)
    }
    points = chain(a, b, k.FORM_REFINED)
    ends = [np.moveaxis(side, 0, -1) / ONE for side in (a, b)]
    places = [np.abs(np.moveaxis(points[i], 0, -1) / ONE - reference.slerp(*ends, i / 4)).max() for i in (1, 2, 3)]
    yield p4(
        "refined chain of two middles: largest error of the nodes at 1/4, 1/2, 3/4 up to 60 degrees",
        "<= 5e-4",
        max(places),
        kind="repair",
        note=f"golden model, {a[0].size} random arcs, against SLERP; lengths within {lengths[k.FORM_REFINED]:.1e}, "
        f"with P4's InvC2 and d2 within {lengths[k.FORM_PAPER]:.1e}",
    )
    degrees = np.degrees(np.arccos(C[SHOWN]))
    with figures.drawing(folder / "p4_invc.png", 10, 4, 1, 2) as (left, right):
        for name, (value, colour) in forms.items():
            left.plot(degrees, 100 * (value / exact - 1)[SHOWN], color=colour, label=f"{name}, golden model")
            right.plot(degrees, 100 * error[name][SHOWN].clip(1e-7), color=colour, label=name)
        left.set(title="Fig. 5: InvC against 1/√(2 (1 + c))", ylabel="relative error, %")
        right.set(title="the same, logarithmic", yscale="log", ylim=(1e-4, 10), ylabel="relative error, %")
        right.axhline(0.27, color=figures.THIRD, ls=":", lw=1)
        left.legend(loc="lower center")
        for axes in (left, right):
            axes.set(xlabel="angle ψ, degrees")


def methods(folder: Path, size: int) -> Iterator[Claim]:
    """Error over the angle and operations of every method of both papers, and of our units."""
    degrees = np.linspace(0, 90, 91)
    rng = np.random.default_rng(9)
    a, b = reference.arcs(np.radians(degrees), 64, rng)
    rounded = reference.fixed(a), reference.fixed(b)
    exactly = {name: worst_length(way.middle(a, b)) for name, way in reference.METHODS.items()}
    integers = {name: worst_length(way.middle(*rounded, q=reference.fixed)) for name, way in reference.METHODS.items()}
    ours = units(*(np.moveaxis((side * ONE).astype(int), -1, 0) for side in rounded))
    notes = {
        name: f"{counted(way.operations)}; with 16 fraction bits {100 * integers[name].max():.2g} %"
        for name, way in reference.METHODS.items()
    }
    for name, claim, claimed in (
        ("Barrera", "Barrera's middle: largest error, up to 90 degrees", "= 12"),
        ("Lyon, as printed", "Lyon's accuracy is not sufficiently high, as printed: largest error", ">= 1"),
        ("Lyon, series", "Lyon's accuracy is not sufficiently high, as the series gives it: largest error", ">= 1"),
        ("Newton-Raphson step", "one Newton-Raphson step has large errors: largest error", ">= 1"),
        ("degree-5 root", "Analog Devices' root of degree 5 has a high accuracy: largest error", "<= 0.1"),
    ):
        paper = p2 if name == "Newton-Raphson step" else p4
        note = f"float64, middle of two normals; {notes[name]}"
        if name == "Barrera":
            note += "; the same vector as one Newton-Raphson step gives"
        yield paper(claim, claimed, 100 * exactly[name].max(), unit="%", figure="p4_methods.png", note=note)
    newton = reference.METHODS["Newton-Raphson step"].operations
    addends = 3  # of a + b, which is no part of the normalization
    of_newton = partial(p2, note="operations traced through the formula; halves are shifts")
    yield of_newton("Newton-Raphson step: multiplications", "= 6", newton.multiplications)
    yield of_newton("Newton-Raphson step: additions", "= 3", newton.additions - addends)
    yield of_newton("Newton-Raphson step: divisions, three, but all by two", "= 3", newton.divisions)
    yield p4("SLERP: trigonometric functions a middle", ">= 1", reference.METHODS["SLERP"].operations.trigonometric)
    yield p4(
        "bisection needs two roots a step",
        "= 2",
        reference.METHODS["bisection"].operations.roots,
        note="z of a step is sqrt(2 + z) of the one before: the other root is at hand already",
    )
    near = degrees <= 60
    for name, bar in (("shade_normalize", "<= 1e-4"), ("shade_midpoint", "<= 4e-4")):
        yield p4(
            f"{name}, refined: largest error of a middle's length up to 60 degrees",
            bar,
            ours[name][near].max(),
            kind="repair",
            figure="p4_methods.png",
            note="golden model; with 16 fraction bits "
            + ", ".join(f"{other}: {integers[other][near].max():.1e}" for other in integers),
        )
    with figures.drawing(folder / "p4_methods.png", 12, 5.2, 1, 2, sharey=True) as (left, right):
        cycle = ("#22303c", "#9b2226", "#e09f3e", "#ca6702", "#94a1b2", "#577590", "#d1495b", "#f4a261", "#8a5a83",
                 "#2a9d8f")  # fmt: skip
        for (name, error), colour in zip(exactly.items(), cycle, strict=True):
            style = "--" if name in ("Newton-Raphson step", "bisection") else "-"
            seen = error > 1e-9  # those that are exact in float64 stand below the frame
            left.plot(degrees[seen], error[seen], style, color=colour)
            right.plot(degrees, integers[name], style, color=colour, lw=1.2, label=name)
        looks = (("-", figures.DEGREES[1]), ("-", figures.REFINED), (":", figures.REFINED))
        for (name, error), (style, colour) in zip(ours.items(), looks, strict=True):
            right.plot(degrees, error.clip(1e-6), style, color=colour, lw=3, alpha=0.75, label=name)
        left.set(title="Float64", ylabel="largest error of the length of a middle", ylim=(3e-7, 0.3))
        right.set(title="16 fraction bits, and our units")
        for axes in (left, right):
            axes.set(xlabel="angle between the normals, degrees", yscale="log")
        right.legend(loc="center left", bbox_to_anchor=(1, 0.5))


def counted(operations: reference.Operations) -> str:
    """6 additions, 1 division: what there is of operations, for a note."""
    there = [(count, name) for name, count in operations._asdict().items() if count]
    return ", ".join(f"{count} {name if count > 1 else name[:-1]}" for count, name in there)


def worst_length(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Largest error of length by angle, of vectors (angles, count, 3)."""
    return reference.length_error(vectors).max(axis=1)


def integer_arcs(angles, count: int, rng: np.random.Generator) -> list[NDArray[np.int64]]:
    """Random pairs of unit normals as two arrays (3, angles, count), S1.16."""
    return [np.moveaxis(quantize(side), -1, 0) for side in reference.arcs(angles, count, rng)]


def chain(a: NDArray[np.int64], b: NDArray[np.int64], form: int) -> NDArray[np.int64]:
    """(5, 3, ...): the normals of ``node_chain``."""
    *components, _ = normal.node_chain(*a, *b, normal.dot3(*a, *b), form)
    return np.reshape(np.stack(components), (5, 3, *a.shape[1:]))


def units(a: NDArray[np.int64], b: NDArray[np.int64]) -> dict[str, NDArray[np.float64]]:
    """Largest error of the length of a middle by angle, by our units (golden models)."""
    c = normal.dot3(*a, *b)
    found = {
        "shade_normalize": normal.normalize(*(np.clip(a + b, -2 * ONE, 2 * ONE - 1))),
        "shade_midpoint": normal.midpoint(*a, *b, c)[:3],
        "shade_midpoint, paper": normal.midpoint(*a, *b, c, k.FORM_PAPER)[:3],
    }
    return {name: worst_length(np.stack(vector, axis=-1) / ONE) for name, vector in found.items()}


STEPS = [increments, metrics, midpoints, methods]
