# SPDX-License-Identifier: Apache-2.0
"""Paper P2: the error of normals left as they are, its polynomials, and triangles whose normals may be left so."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np
from numpy.polynomial.polynomial import polyval
from numpy.typing import NDArray
from polyshade.golden import contract as k
from polyshade.golden import normal, plan
from polyshade.golden.reference import light
from polyshade.golden.reference import normal as reference
from polyshade.scripts.studies.papers import figures
from polyshade.scripts.studies.papers.claims import Claim, check, nmse
from polyshade.scripts.studies.papers.view import view
from polyshade.sim.core import quantize
from polyshade.sim.scene.mesh import Mesh, load_mesh

p2 = partial(check, paper="P2")
ONE = 1 << k.INTENSITY_F
ETA_ONE = 1 << k.ETA_F
ANGLE = 0.2  # radians, P2's example
NMSE_BAR = 1e-4  # above it P1 and P4 call a difference visible
POWERS = (32, 128)
FORMS = {
    "P2, linear": (k.FORM_PAPER, 1, figures.PAPER),
    "P2, quadratic": (k.FORM_PAPER, 2, figures.THIRD),
    "refined": (k.FORM_REFINED, 2, figures.REFINED),
}
"""Forms of the criterion by name: form, degree, colour."""
POLYNOMIALS = (
    (1, False, (0.28546133, -0.29073021), "= 7.43e-3"),
    (1, True, (0.28605913, -0.29181147), "= 6.83e-3"),
    (2, False, (0.29222919, -0.34122087, 0.04942337), "= 6.64e-4"),
    (2, True, (0.29229426, -0.34169246, 0.04988099), "= 5.99e-4"),
)
"""The design's table of Chebyshev polynomials: degree, truncated series?, coefficients, largest error."""
MESHES = (("head", 0), ("head", 1), ("sphere", 0), ("sphere", 2))
THRESHOLDS = np.geomspace(1e-4, 1e-1, 25)
DECADES = slice(None, None, 8)  # 1e-4, 1e-3, 1e-2, 1e-1 of them


def shortening(folder: Path, size: int) -> Iterator[Claim]:
    """What a normal that is not normalized does to diffuse and specular light (Figs. 1, 2, 5)."""
    c = np.cos(ANGLE)
    yield p2(
        f"Fig. 2: largest relative error of diffuse light without normalization, {ANGLE} rad between the normals",
        "<= 0.5",
        100 * reference.shortfall(c),
        unit="%",
        figure="p2_light.png",
    )
    yield p2(f"Fig. 2: {ANGLE} rad are", "= 11.46", np.degrees(ANGLE), unit="degrees", figure="p2_light.png")
    t = np.linspace(0, 1, 1001)
    a, b = (side[0] for side in reference.arcs([ANGLE], 64, np.random.default_rng(5)))
    lengths = np.linalg.norm(a[:, None] + (b - a)[:, None] * t[:, None], axis=-1)
    yield p2(
        "Fig. 1: the interpolated normal is shortest in the middle of an edge: t farthest from 1/2",
        "<= 1e-3",
        np.abs(t[lengths.argmin(axis=1)] - 1 / 2).max(),
        note=f"float64, {len(a)} random edges, steps of 1/1000",
    )
    middle = reference.METHODS["root and division"].middle(a, b)
    short = 1 - light.diffuse((a + b) / 2, middle[0], as_given=True) / light.diffuse(middle, middle[0])
    yield p2(
        "the relative error is 1 - sqrt((1 + c)/2) wherever the light is: worst distance",
        "<= 1e-12",
        np.abs(short - reference.shortfall(c)).max(),
        note="float64",
    )
    for n in POWERS:
        yield p2(
            f"Fig. 5: the specular error grows fast: at {ANGLE} rad, n = {n}, times the diffuse one",
            ">= 10",
            reference.specular_shortfall(c, n) / reference.shortfall(c),
            figure="p2_light.png",
            note=f"{100 * reference.specular_shortfall(c, n):.1f} % of the highlight; P2 gives no number",
        )
    x = np.linspace(0, 1, 201)
    n = np.geomspace(1, 1024, 201)
    with figures.drawing(folder / "p2_light.png", 10, 4, 1, 2) as (left, right):
        left.plot(x, 100 * reference.shortfall(np.cos(x)), color=figures.EXACT)
        left.plot([0, ANGLE, ANGLE], [0.5, 0.5, 0], ":", color=figures.PAPER)
        left.text(0.01, 1.4, "P2: 0.5 % at 0.2 rad", color=figures.PAPER, fontsize=8.5)
        left.set(xlabel="angle between the normals, rad", ylabel="diffuse light too dark by, %")
        left.set(title="Fig. 2: diffuse error", xlim=(0, 1), ylim=(0, None))
        share = 100 * reference.specular_shortfall(np.cos(x[:, None]), n)
        levels = (0.1, 1, 5, 10, 25, 50, 75, 95)
        right.contourf(n, x, share, 32, cmap="Blues")
        lines = right.contour(n, x, share, levels, colors=figures.EXACT, linewidths=0.8)
        right.clabel(lines, fmt="%g %%", fontsize=8)
        right.set(xscale="log", xlabel="exponent n of the highlight", ylabel="angle between the normals, rad")
        right.set(title="Fig. 5: specular error")
        right.grid(False)


def polynomials(folder: Path, size: int) -> Iterator[Claim]:
    """The Chebyshev polynomials instead of three square roots, and the anchored one (Figs. 3, 4)."""
    c = np.arange(ONE + 1) / ONE
    exact = reference.shortfall(c)
    lost = "P2's coefficients are missing from the copy at hand; computed anew"
    for degree, series, coefficients, error in POLYNOMIALS:
        found = reference.chebyshev(reference.shortfall, degree, series=series)
        name = f"{'truncated series' if series else 'Chebyshev nodes'}, degree {degree}"
        in_figure = partial(p2, figure="p2_chebyshev.png", note=lost)
        yield in_figure(f"{name}: largest absolute error", error, np.abs(polyval(c, found) - exact).max())
        yield in_figure(
            f"{name}: distance of its coefficients from the design's", "<= 5e-9", np.abs(found - coefficients).max()
        )
        yield in_figure(
            f"{name}: |eta| of a flat triangle, which should be 0",
            f">= {THRESHOLDS[0]:.0e}",
            3 * abs(found.sum()),
            kind="defect",
            note="more than the lowest threshold; a dense mesh is made of nearly flat triangles",
        )
    found = {name: edge_error(form, degree) for name, (form, degree, _) in FORMS.items()}
    yield p2(
        "refined criterion: |eta| of a flat triangle",
        "<= 0",
        abs(flat_eta(*FORMS["refined"][:2])),
        kind="repair",
        note="golden model",
    )
    yield p2(
        "refined criterion: largest absolute error of an edge",
        "<= 2e-4",
        np.abs(found["refined"]).max(),
        kind="repair",
        figure="p2_chebyshev.png",
        note="golden model, every cosine in [0, 1]; P2's quadratic: "
        + f"{np.abs(found['P2, quadratic']).max():.2e}, linear: {np.abs(found['P2, linear']).max():.2e}",
    )
    edges = c <= np.cos(np.radians(1))
    yield p2(
        "refined criterion: largest relative error of an edge of 1 degree or more",
        "<= 6",
        100 * np.abs(found["refined"] / np.maximum(exact, 1e-9))[edges].max(),
        unit="%",
        kind="repair",
        figure="p2_chebyshev.png",
        note="golden model; P2's quadratic: "
        + f"{100 * np.abs(found['P2, quadratic'] / np.maximum(exact, 1e-9))[edges].max():.0f} %",
    )
    with figures.drawing(folder / "p2_chebyshev.png", 10, 4.6, 1, 2) as (left, right):
        for name, (_, degree, colour) in FORMS.items():
            left.plot(c, np.abs(found[name]), color=colour, label=f"{name}, golden model")
            right.plot(c[:-1], 100 * np.abs(found[name][:-1] / exact[:-1]), color=colour)
            if name != "refined":
                series = reference.chebyshev(reference.shortfall, degree, series=True)
                error = np.abs(polyval(c, series) - exact)
                left.plot(c, error, ":", color=colour, lw=1, label="the same, truncated series")
                right.plot(c[:-1], 100 * error[:-1] / exact[:-1], ":", color=colour, lw=1)
        left.set(title="Figs. 3, 4: absolute error of an edge", ylim=(1e-6, 2e-2))
        right.set(title="Figs. 3, 4: relative error, %", ylim=(1e-2, 1e4))
        for axes in (left, right):
            axes.set(xlabel="c, cosine between the normals", yscale="log", xlim=(0, 1))
        left.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2)


def decisions(folder: Path, size: int) -> Iterator[Claim]:
    """How often each form decides differently from three square roots, on real meshes."""
    differing, where = {}, {}
    for spec, steps in MESHES:
        mesh = load_mesh(spec, steps)
        key = f"{spec}, {len(mesh.faces)} triangles"
        for what, corners in (("triangles", mesh.faces), ("edges", edges_of(mesh))):
            differing[key, what] = decide(mesh, corners)
            where[key, what] = len(corners)
    for (mesh, what), shares in differing.items():
        for name, share in shares.items():
            yield p2(
                f"{mesh}: {what} on which the criterion ({name}) decides otherwise than the exact one",
                "<= 0.5",
                100 * share.max(),
                unit="%",
                kind="repair" if name == "refined" else "paper",
                figure="p2_decisions.png",
                note=f"golden model, S1.16 normals, {where[mesh, what]} {what}, worst of {len(THRESHOLDS)} thresholds; "
                f"{at_decades(100 * share, '%')}; the bar is ours",
            )
    keys = [f"{spec}, {len(load_mesh(spec, steps).faces)} triangles" for spec, steps in MESHES]
    with figures.drawing(folder / "p2_decisions.png", 12, 3.6, 1, len(MESHES), sharey=True) as axes:
        for plot, key in zip(axes, keys, strict=True):
            for name, (_, _, colour) in FORMS.items():
                plot.plot(THRESHOLDS, 100 * differing[key, "triangles"][name], ".-", color=colour, label=name)
                plot.plot(THRESHOLDS, 100 * differing[key, "edges"][name], ":", color=colour, lw=1)
            plot.set(xscale="log", title=key, xlabel="threshold", ylim=(-3, 103))
        axes[0].set_ylabel("decided otherwise, %; dotted: edges")
        axes[0].legend(loc="upper right")


def skipping(folder: Path, size: int) -> Iterator[Claim]:
    """What the skipped normalizations do to a picture: their share against the NMSE."""
    scene = view(size, POWERS[0])
    seen = scene.visible[scene.visible >= 0]
    spans = scene.spans
    last = np.cumsum(spans.count)
    span = np.searchsorted(last, seen, side="right")
    step = seen - (last - spans.count)[span]
    vectors = spans.normal[span] + step[:, None] * spans.gradient[span]
    mesh = load_mesh("head")
    etas = {name: eta(mesh, mesh.faces, form, degree) for name, (form, degree, _) in FORMS.items()}
    etas["exact"] = reference.criterion(*cosines(mesh, mesh.faces))
    lights = {
        f"specular, n = {n}": [light.blinn(vectors, scene.settings.light, n, as_given=given) for given in (False, True)]
        for n in POWERS
    }
    lights["diffuse"] = [
        light.diffuse(vectors, scene.settings.light, as_given=given).clip(0) for given in (False, True)
    ]
    share = {name: np.zeros(len(THRESHOLDS)) for name in etas}
    loss = {(name, what): np.zeros(len(THRESHOLDS)) for name in etas for what in lights}
    for name, value in etas.items():
        at_pixel = value[spans.triangle[span]]
        for i, threshold in enumerate(THRESHOLDS):
            skipped = at_pixel <= threshold
            share[name][i] = skipped.mean()
            for what, (unit, raw) in lights.items():
                loss[name, what][i] = nmse(np.where(skipped, raw, unit), unit)

    on_head = partial(p2, figure="p2_skipping.png")
    note = f"head, {size} x {size}, float64 light of the seen pixels; NMSE {{}}"
    yield on_head(
        "diffuse surfaces of many triangles: normals that need not be normalized at an NMSE of 1e-4",
        ">= 90",
        100 * share["exact"][loss["exact", "diffuse"] <= NMSE_BAR].max(),
        unit="%",
        note=note.format("by threshold: ") + at_decades(loss["exact", "diffuse"], ""),
    )
    for i in range(0, len(THRESHOLDS), 8):
        yield on_head(
            f"refined criterion, threshold {THRESHOLDS[i]:.0e}: skipped normalizations, distance from the exact one's",
            "<= 0.5",
            100 * abs(share["refined"][i] - share["exact"][i]),
            unit="% of the pixels",
            kind="repair",
            note="skipped: "
            + ", ".join(f"{name} {100 * value[i]:.1f} %" for name, value in share.items())
            + f"; diffuse NMSE {loss['refined', 'diffuse'][i]:.1e}",
        )
    hundredth = int(np.argmin(np.abs(THRESHOLDS - 0.01)))
    for n in POWERS:
        yield on_head(
            f"the criterion is of no use for specular surfaces: NMSE of the highlight, n = {n}, threshold 0.01",
            f">= {NMSE_BAR}",
            loss["exact", f"specular, n = {n}"][hundredth],
            note=note.format("by threshold: ") + at_decades(loss["exact", f"specular, n = {n}"], ""),
        )
    with figures.drawing(folder / "p2_skipping.png", 10, 4, 1, 2) as (left, right):
        colours = {name: colour for name, (_, _, colour) in FORMS.items()} | {"exact": figures.EXACT}
        for name in ("exact", *FORMS):
            style = {"lw": 5, "alpha": 0.25} if name == "exact" else {}
            left.plot(THRESHOLDS, 100 * share[name], color=colours[name], label=name, **style)
        for what, style in zip(("diffuse", *(f"specular, n = {n}" for n in POWERS)), ("-", "--", ":"), strict=True):
            value = loss["refined", what]
            right.plot(100 * share["refined"], value.clip(1e-12), style, color=figures.REFINED, label=what)
        left.set(xscale="log", xlabel="threshold", ylabel="pixels whose normal is left as it is, %")
        left.set(title="Skipped normalizations")
        left.legend(loc="upper left")
        right.axhline(NMSE_BAR, color=figures.EXACT, ls=":", lw=1)
        right.set(yscale="log", xlabel="skipped by the refined criterion, %", ylabel="NMSE")
        right.set(title=f"What it costs, head, {size} × {size}")
        right.legend(loc="lower right")


def edge_error(form: int, degree: int) -> NDArray[np.float64]:
    """Error of one edge's share of eta over every cosine in [0, 1], from the golden model."""
    c = np.arange(ONE + 1)
    return plan.criterion(c, c, c, 0, form, degree)[0] / ETA_ONE / 3 - reference.shortfall(c / ONE)


def flat_eta(form: int, degree: int) -> float:
    """eta of three equal normals."""
    return float(plan.criterion(ONE, ONE, ONE, 0, form, degree)[0] / ETA_ONE)


def edges_of(mesh: Mesh) -> NDArray[np.int64]:
    """(E, 2) vertices of every edge, once."""
    faces = mesh.faces.astype(np.int64)
    return np.unique(np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)


def sides(corners: NDArray[np.integer]) -> Iterator[NDArray[np.integer]]:
    """The edges of triangles (F, 3), as pairs of columns; of edges (E, 2) each three times: eta is then 3 delta."""
    for i in range(3):
        yield corners[:, [0, 1]] if corners.shape[1] == 2 else corners[:, [i, (i + 1) % 3]]


def cosines(mesh: Mesh, corners: NDArray[np.integer]) -> list[NDArray[np.float64]]:
    """The three cosines between the unit normals of triangles or edges (:func:`sides`)."""
    return [np.sum(mesh.normals[pair[:, 0]] * mesh.normals[pair[:, 1]], axis=-1) for pair in sides(corners)]


def eta(mesh: Mesh, corners: NDArray[np.integer], form: int, degree: int) -> NDArray[np.float64]:
    """eta from the golden model, with normals in S1.16 and their dot products from ``dot3``."""
    components = quantize(mesh.normals).T
    dots = [normal.dot3(*components[:, pair[:, 0]], *components[:, pair[:, 1]]) for pair in sides(corners)]
    return plan.criterion(*dots, 0, form, degree)[0] / ETA_ONE


def decide(mesh: Mesh, corners: NDArray[np.integer]) -> dict[str, NDArray[np.float64]]:
    """Share of triangles or edges on which each form differs from the exact criterion, by threshold."""
    limits = (3 if corners.shape[1] == 2 else 1) * THRESHOLDS[:, None]
    exact = reference.criterion(*cosines(mesh, corners)) > limits
    steps = np.rint(limits * ETA_ONE) / ETA_ONE
    return {
        name: ((eta(mesh, corners, form, degree) > steps) != exact).mean(axis=1)
        for name, (form, degree, _) in FORMS.items()
    }


def at_decades(values: NDArray[np.float64], unit: str) -> str:
    """Values at thresholds 1e-4, 1e-3, 1e-2, 1e-1, for a note."""
    pairs = zip(THRESHOLDS[DECADES], values[DECADES], strict=True)
    return ", ".join(f"{value:.3g}{' ' * bool(unit)}{unit} at {threshold:.0e}" for threshold, value in pairs)


STEPS = [shortening, polynomials, decisions, skipping]
