# SPDX-License-Identifier: Apache-2.0
"""Paper P3: the 16th power for cos^n (Figs. 3, 4), and the scales with which a lobe conserves energy (Table 1)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache, partial
from math import pi
from pathlib import Path

import numpy as np
from matplotlib.colors import TwoSlopeNorm
from numpy.typing import ArrayLike, NDArray
from polyshade.golden import contract as k
from polyshade.golden import light, material
from polyshade.golden.reference import light as reference
from polyshade.scripts.studies.papers import figures
from polyshade.scripts.studies.papers.claims import Claim, check
from polyshade.scripts.studies.papers.lobe import VERSINES, C, rtl_lobe

p3 = partial(check, paper="P3")
EXPONENTS = np.arange(16, 1025)  # n for which P3 gives its scales
TESTED = (16, 17, 20, 32, 64, 100, 128, 256, 512, 1000, 1024)
ANGLES = np.linspace(0, pi / 2, 20001)
PUBLISHED = 20, 1.41e-3  # a published piecewise linear unit: n, its largest error
RESIDUALS = {
    "phong": "= 4.7e-4",
    "phong-modified": "= 1.3e-3",
    "blinn": "= 1.5e-3",
    "blinn-modified": "= 9.5e-3",
    "blinn-ndf": "= 4.7e-4",
    "blinn-height": "= 1.3e-3",
}
"""What P3 states of |2 pi coef(n) Int(n) - 1| by row; it refers the last two to the first two."""
REFITTED = ("blinn", "blinn-modified")
HEMISPHERE = {("paper", "blinn"): "= 5.2e-3", ("paper", "blinn-modified"): "= 5.6e-2",
              ("refit", "blinn"): "= 2.1e-3", ("refit", "blinn-modified"): "= 9.6e-3"}  # fmt: skip
LOST = {"blinn-modified": "; 9.5e-3 is what a better scale leaves, (1.0593 n + 5.330)/(8 pi); the printed one cannot"}
COLOURS = dict(zip(RESIDUALS, ("#22303c", "#577590", "#d1495b", "#e09f3e"), strict=False))


def powers(folder: Path, size: int) -> Iterator[Claim]:
    """cos^n and the lobe in its place: Figs. 3 and 4, and the refined lobe."""
    n = np.geomspace(16, 1024, 97)
    delta = np.stack([reference.cosine_power(np.cos(ANGLES), each) - cut_lobe(each) for each in n])
    on = partial(p3, figure="p3_power.png", note="float64, 0 .. 90 degrees, 97 values of n in 16 .. 1024")
    yield on("Fig. 4: cos^n less its 16th power, n = 16 .. 1024: largest", "= 1.7e-2", delta.max())
    yield on(
        "Fig. 4: cos^n less its 16th power, n = 16 .. 1024: least",
        "= -9.7e-3",
        delta.min() if delta.min() < -1e-9 else 0,
        note=f"{on.keywords['note']}; (1 - x)^(n/16) >= 1 - n x / 16, so it is never negative; n = 10.4 gives -9.7e-3",
    )
    exact = np.stack([reference.lobe(np.cos(ANGLES), each / 16) for each in n])
    cut = np.stack([cut_lobe(each) for each in n])
    yield on("cut at 6/sqrt(n) instead of arccos(1 - 16/n): largest change", "<= 1e-14", np.abs(cut - exact).max())
    yield on(
        "outside of its interval the 16th power grows fast, which is why it must be cut: value at 90 degrees, n = 1024",
        ">= 1",
        uncut_lobe(1024)[-1],
        note="float64",
    )

    worst = {form: np.array([worst_error(form, each) for each in SHOWN]) for form in material.FORMS}
    rtl = partial(p3, kind="repair", figure="p3_power.png", note="RTL, every 17-bit cosine; exponents ")
    for form, low, high, claimed in (
        ("paper", 16, 1024, "<= 0.0175"),
        ("refined", 8, 1024, "<= 5e-4"),
        ("refined", 4, 8, "<= 4e-3"),
        ("refined", 1, 4, "<= 0.06"),
    ):
        within = (low <= SHOWN) & (high >= SHOWN)
        yield rtl(
            f"shade_lobe, {form}: largest distance from cos^n, n = {low} .. {high}",
            claimed,
            worst[form][within].max(),
            kind="paper" if form == "paper" else "repair",
            note=f"{rtl.keywords['note']}{', '.join(f'{each:g}' for each in SHOWN[within])}; in float64 "
            f"{np.abs(reference.lobe(C, *material.fit('blinn', low, form=form)) - C**low).max():.2e} at n = {low}",
        )
    at, bar = PUBLISHED
    yield rtl(
        f"shade_lobe, refined: largest distance from cos^{at}, against a published piecewise linear unit",
        f"<= {bar}",
        worst["refined"][at == SHOWN][0],
        note="RTL, every 17-bit cosine",
    )
    schlick = max(np.abs(reference.schlick_lobe(C, each) - reference.cosine_power(C, each)).max() for each in TESTED)
    yield p3(
        "Schlick's c/(n - n c + c), which needs a division: largest distance from cos^n, n = 16 .. 1024",
        ">= 0.1",
        schlick,
        figure="p3_power.png",
        note="float64; a highlight of another shape, with a wide skirt",
    )
    draw_powers(folder / "p3_power.png", n, delta, worst)


def scales(folder: Path, size: int) -> Iterator[Claim]:
    """Table 1: every scale times its integral, as P3 integrates and over the whole hemisphere."""
    drawn = partial(p3, figure="p3_energy.png")
    note = f"float64, every n in 16 .. 1024, Gauss' rule of {GAUSS} points"
    for row, claimed in RESIDUALS.items():
        yield drawn(
            f"Table 1, {row}: |2 pi coef Int - 1|, angle up to 6/sqrt(n)",
            claimed,
            np.abs(residual(row, "paper", whole=False)).max(),
            note=note + LOST.get(row, ""),
        )
    exact = 17 / 16 * EXPONENTS * integral("phong", EXPONENTS)
    yield p3("integral of the 16th power: 16/(17 n), largest relative error", "<= 1e-12", np.abs(exact - 1).max())
    for (table, row), claimed in HEMISPHERE.items():
        reach = "the lobe of half the angle reaches 12/sqrt(n), not 6/sqrt(n)"
        yield drawn(
            f"Table 1, {row}, {'as printed' if table == 'paper' else 'refit'}: |2 pi coef Int - 1|, whole hemisphere",
            claimed,
            np.abs(residual(row, table)).max(),
            kind="defect" if table == "paper" else "repair",
            note=f"{note}; {reach}" if table == "paper" else note,
        )
    yield drawn(
        "energy is at most 1: largest 2 pi coef Int of Table 1, as printed, whole hemisphere",
        "<= 1",
        1 + max(residual(row, "paper").max() for row in RESIDUALS),
        note="a fit of the scale by least squares lies on both sides; largest: "
        + ", ".join(f"{row} {residual(row, 'paper').max():+.1e}" for row in RESIDUALS),
    )

    for row in RESIDUALS:
        n = EXPONENTS.astype(float)
        worst = np.abs(2 * pi * reference.energy_scale(row, n) * classic_integral(row, n) - 1)
        yield p3(
            f"Table 1, {row}, classic scale for cos^n: |2 pi coef Int - 1|",
            "<= 1e-12",
            worst.max(),
            note=f"{note}; {CLASSIC.get(row, 'as printed')}",
        )
    n = np.linspace(0, 1024, 4097)
    for row, low, high in (("blinn", 2, 4), ("blinn-modified", 6, 8)):
        offset = np.round(8 * pi * reference.energy_scale(row, n) - n, 9)
        between = partial(p3, note="float64, n = 0 .. 1024; the numerators in Table 1 are guessed from what is left")
        yield between(f"{row}: classic scale at least (n + {low})/(8 pi): 8 pi coef - n", f">= {low}", offset.min())
        yield between(f"{row}: classic scale at most (n + {high})/(8 pi): 8 pi coef - n", f"<= {high}", offset.max())

    energy = {row: np.array([quantized_energy(row, n) for n in TESTED]) for row in RESIDUALS}
    every = np.stack(list(energy.values()))
    quantized = partial(drawn, kind="repair", note=f"golden model of lobe and gain, n = {', '.join(map(str, TESTED))}")
    rows = "six rows, refined, lobe and gain as quantized"
    yield quantized(f"energy over the hemisphere, {rows}: least", ">= 0.98", every.min())
    yield quantized(f"energy over the hemisphere, {rows}: largest", "<= 1", every.max())
    draw_scales(folder / "p3_energy.png", energy)


# ---- the lobe ----------------------------------------------------------------------------------------------------

SHOWN = np.array([1, 1.5, 2, 3, 4, 6, 8, 10, 12, 16, 17, 20, 24, 32, 48, 64, 100, 128, 256, 512, 1000, 1024])


def uncut_lobe(n: float) -> NDArray[np.float64]:
    """(n (cos t - 1)/16 + 1)^16 at ``ANGLES``."""
    return (n / 16 * (np.cos(ANGLES) - 1) + 1) ** 16


def cut_lobe(n: float) -> NDArray[np.float64]:
    """P3's equation (1) at ``ANGLES``: 0 from 6/sqrt(n) on."""
    return np.where(6 / np.sqrt(n) > ANGLES, uncut_lobe(n), 0)


@cache
def worst_error(form: str, n: float) -> float:
    """Largest |shade_lobe - cos^n| over every 17-bit cosine."""
    return float(np.abs(rtl_lobe("blinn", n, form=form) - reference.cosine_power(C, n)).max())


# ---- energy ------------------------------------------------------------------------------------------------------

Lobe = Callable[[NDArray[np.float64], NDArray[np.float64]], NDArray[np.float64]]
GAUSS = 96
NODES, WEIGHTS = np.polynomial.legendre.leggauss(GAUSS)
CLASSIC = {
    "blinn": "derived: Int = 4 (1 - 2^(-n/2-1))/(n + 2), coef = 1/(2 pi Int)",
    "blinn-modified": "derived: Int = 4 (n + 2^(-n/2))/((n + 2)(n + 4)), coef = 1/(2 pi Int)",
}


def over_angle(row: str, n: ArrayLike, upper: ArrayLike, lobe: Lobe) -> NDArray[np.float64]:
    """Integrals of a row over t = 0 .. upper <= pi/2; ``lobe(c, n)``, c the cosine of t, or of t/2 in Blinn's rows."""
    half, weighted = reference.ROWS[row]
    n, upper = (np.asarray(each, float)[..., None] for each in (n, np.minimum(upper, pi / 2)))
    t = upper / 2 * (1 + NODES)
    value = lobe(np.cos(t / 2 if half else t), n) * np.sin(t) * (np.cos(t) if weighted else 1)
    return (upper / 2 * value) @ WEIGHTS


def integral(row: str, n: ArrayLike, *, whole: bool = True) -> NDArray[np.float64]:
    """Integrals of the 16th power: up to where it or the hemisphere ends, or, as in P3, up to 6/sqrt(n)."""
    n = np.asarray(n, float)
    end = np.arccos(1 - 16 / n) * (2 if reference.ROWS[row][0] else 1) if whole else 6 / np.sqrt(n)
    return over_angle(row, n, end, lambda c, n: (1 + n / 16 * (c - 1)) ** 16)


def classic_integral(row: str, n: ArrayLike) -> NDArray[np.float64]:
    """Integrals of cos^n over the hemisphere; up to sqrt(800/n), where the power of half the angle is exp(-100)."""
    n = np.asarray(n, float)
    return over_angle(row, n, np.sqrt(800 / n), np.power)


@cache
def residual(row: str, table: str, *, whole: bool = True) -> NDArray[np.float64]:
    """2 pi coef(n) Int(n) - 1 for every n in 16 .. 1024."""
    return 2 * pi * reference.energy_scale(row, EXPONENTS, table) * integral(row, EXPONENTS, whole=whole) - 1


def quantized_energy(row: str, n: float) -> float:
    """Energy of the refined lobe, its gain as quantized for exposure 1, over the hemisphere."""
    given = material.Material(model=row.partition("-")[0], shininess=n, energy=row, exposure=1.0)
    words = material.registers(given)
    gain = words["gain"] / (1 << k.GAIN_F) * 2.0 ** words["gain_exp"]
    lobe = light.lobe(VERSINES, *(words[name] for name in light.LOBE))
    return gain * reference.hemisphere(row, C, lobe / (1 << k.INTENSITY_F))


# ---- figures -----------------------------------------------------------------------------------------------------


def draw_powers(path: Path, n: NDArray, delta: NDArray, worst: dict[str, NDArray]) -> None:
    """Figs. 3 and 4, and the largest error over n."""
    degrees = np.degrees(ANGLES)
    near = degrees <= 30
    with figures.drawing(path, 13, 4, 1, 3) as (left, middle, right):
        exact = reference.cosine_power(np.cos(ANGLES), 128)
        left.plot(degrees[near], exact[near], color=figures.EXACT, lw=5, alpha=0.25, label="cos¹²⁸")
        left.plot(degrees[near], cut_lobe(128)[near], color=figures.PAPER, label="P3, 16th power")
        refined = rtl_lobe("blinn", 128)
        seen = np.cos(np.radians(30)) <= C
        left.plot(np.degrees(np.arccos(C[seen])), refined[seen], color=figures.REFINED, ls="--", label="RTL, refined")
        left.set(title="Fig. 3: n = 128", xlabel="angle, degrees", ylabel="intensity")
        left.legend()
        shown = delta[:, near][:, ::10]
        mesh = middle.pcolormesh(
            degrees[near][::10], n, shown, cmap="RdBu_r", norm=TwoSlopeNorm(0, -0.018, 0.018), rasterized=True
        )
        middle.figure.colorbar(mesh, ax=middle, label="cosⁿ − lobe")
        middle.set(title="Fig. 4: error of the 16th power", xlabel="angle, degrees", ylabel="n", yscale="log")
        middle.set_yticks([16, 64, 256, 1024], [16, 64, 256, 1024])
        right.plot(SHOWN, worst["paper"], "o-", color=figures.PAPER, label="RTL, P3's form")
        right.plot(SHOWN, worst["refined"], "o-", color=figures.REFINED, label="RTL, refined")
        right.plot(*PUBLISHED, "D", color=figures.THIRD, ms=7, label="published, piecewise linear")
        right.axhline(1.7e-2, color=figures.PAPER, ls=":", lw=1)
        right.text(100, 2.1e-2, "P3: 1.7e-2", color=figures.PAPER, fontsize=8)
        right.set(title="Largest error", xlabel="n", xscale="log", yscale="log", ylim=(1e-6, 1))
        right.set_xticks([1, 4, 16, 64, 256, 1024], [1, 4, 16, 64, 256, 1024])
        right.legend(loc="lower left")


def draw_scales(path: Path, energy: dict[str, NDArray]) -> None:
    """|res(n)| as P3 integrates it and over the hemisphere, and what the quantized refined lobe lacks to energy 1."""
    with figures.drawing(path, 13, 4.8, 1, 3) as (left, middle, right):
        for row, colour in COLOURS.items():
            left.plot(EXPONENTS, np.abs(residual(row, "paper", whole=False)), color=colour, label=row)
            left.axhline(float(RESIDUALS[row].split()[1]), color=colour, ls=":", lw=1)
            middle.plot(EXPONENTS, np.abs(residual(row, "paper")), color=colour, label=f"{row}, as printed")
            if row in REFITTED:
                middle.plot(EXPONENTS, np.abs(residual(row, "refit")), "--", color=colour, label=f"{row}, refit")
        for (row, values), colour in zip(energy.items(), (*COLOURS.values(), "#8a5a83", "#2a9d8f"), strict=True):
            right.plot(TESTED, 1 - values, "o-", color=colour, label=row)
        left.set(title="Table 1, angle up to 6/√n; dotted: P3", ylabel="|2π coef Int − 1|")
        middle.set(title="Table 1, whole hemisphere")
        right.set(title="Refined, lobe and gain as quantized", ylabel="1 − energy")
        right.axhspan(1e-5, 0.02, color=figures.REFINED, alpha=0.08, lw=0)
        for axes in (left, middle, right):
            axes.set(xscale="log", yscale="log", xlabel="n", ylim=(1e-5, 0.1))
            axes.set_xticks([16, 64, 256, 1024], [16, 64, 256, 1024])
            axes.minorticks_off()
            axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=2)


STEPS = [powers, scales]
