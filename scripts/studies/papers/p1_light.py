# SPDX-License-Identifier: Apache-2.0
"""Paper P1, section III: the lobes of Cook-Torrance and Ward as one 4th, 8th or 16th power (Figs. 2 to 5)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from math import e, floor, log2
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import material, registers
from polyshade.golden.reference import light as reference
from polyshade.scripts.flow import synth
from polyshade.scripts.studies.papers import figures
from polyshade.scripts.studies.papers.claims import Claim, check, nmse
from polyshade.scripts.studies.papers.lobe import COSINES, C, rtl_lobe
from polyshade.scripts.studies.papers.view import view
from polyshade.sim import frame
from polyshade.sim.scene.raster import expand

p1 = partial(check, paper="P1")
ONE = 1 << k.INTENSITY_F
ROUGHNESS = (0.2, 0.3, 0.4, 0.5, 0.6)  # m, P1's range
ANGLES = np.linspace(0, np.pi / 2, 9001)
NAMES = {"cook-torrance": "Cook-Torrance D", "ward": "Ward"}
BOUNDS = {"cook-torrance": (0.05, 0.05, 0.3, 1, 2.5), "ward": (0.1, 0.1, 0.15, 0.4, 0.7)}
"""What the refined lobe promises: largest error in per cent of the peak by roughness."""
POWERS = (4, 8, 16)  # of D4, D8, D16
DRAWN = 0.3  # roughness in Figs. 2 to 5, which do not tell theirs


def distributions(folder: Path, size: int) -> Iterator[Claim]:
    """P1's approximations as printed: Figs. 2 to 5, and its 1.3 %."""
    c = np.cos(ANGLES)
    on = partial(p1, unit="% of the peak", figure="p1_roughness.png")
    for model, name in NAMES.items():
        cosine = {m: 100 * printed_errors(model, m)["cosine"] for m in ROUGHNESS}
        errors = {(m, g): 100 * rtl_error(model, m, "paper", int(log2(g))) for m in ROUGHNESS for g in POWERS}
        yield on(
            f"Figs. 2, 3: {name}, a power of the cosine for the exponential: largest error, m = 0.2",
            "<= 1.3",
            cosine[0.2],
            note="float64; by m: " + ", ".join(f"{value:.3g} % at {m}" for m, value in cosine.items()),
        )
        for m in ROUGHNESS:
            high = shape(model, c, m) >= 0.1
            pointwise = np.abs(printed(model, c, m, 16)[high] / shape(model, c, m)[high] - 1).max()
            yield on(
                f"{name}, 16th power as printed: largest error, m = {m}",
                "<= 1.3",
                errors[m, 16],
                note=f"RTL, every 17-bit cosine; of the value, where above a tenth of the peak: {100 * pointwise:.3g} %"
                + "; P1 gives its 1.3 % for Ward, of D16 it says high accuracy" * (model == "cook-torrance"),
            )
        yield p1(
            f"{name}: of the powers 4, 8, 16 the last is the most exact: roughnesses of 0.2, 0.3 .. 0.6 where it is",
            ">= 5",
            sum(errors[m, 16] < min(errors[m, 4], errors[m, 8]) for m in ROUGHNESS),
            figure="p1_lobes.png",
            note="RTL; errors of powers 4, 8, 16 in %: "
            + "; ".join(f"m = {m}: " + ", ".join(f"{errors[m, g]:.3g}" for g in POWERS) for m in ROUGHNESS),
        )
    slope = material.fit("cook-torrance", roughness=0.2, form="paper")[0]
    yield p1(
        "D16 as printed, without a clamp at 0: value at 90 degrees over the peak, m = 0.2",
        ">= 1",
        (1 - slope) ** 16,
        kind="defect",
        note="P3 cuts the lobe, P1 does not",
    )
    draw_lobes(folder / "p1_lobes.png")


def refined(folder: Path, size: int) -> Iterator[Claim]:
    """The refined lobe out of the RTL against the original expressions."""
    errors = {}
    for model, name in NAMES.items():
        for m, bound in zip(ROUGHNESS, BOUNDS[model], strict=True):
            errors[model, m] = rtl_error(model, m)
            yield p1(
                f"{name}, shade_lobe, refined: largest error, m = {m}",
                f"<= {bound}",
                100 * errors[model, m],
                unit="% of the peak",
                kind="repair",
                figure="p1_roughness.png",
                note="RTL, every 17-bit cosine",
            )
    draw_roughness(folder / "p1_roughness.png", errors)


def gains(folder: Path, size: int) -> Iterator[Claim]:
    """What a 16th power saves: as counted operations, and as area and clocks of the RTL."""
    for name, direct, power, claimed in (
        ("D16 against D", "D", "D16", "= 4.34"),
        ("Ward", "Ward", "Ward, 16th power", ">= 2"),
    ):
        yield p1(
            f"gain, {name}: counted in multiplications, a division as 3.5, an exponential as 15",
            claimed,
            counted(direct, FLOATING) / counted(power, FLOATING),
            note=f"{COUNTS[direct]} against {COUNTS[power]}; a division after P4's clocks, 14 to 4; an exponential in "
            "double precision: 3 for the range, a polynomial of degree 12; P1 does not tell its prices",
        )
        yield p1(
            f"gain, {name}: counted in 18 x 18 products, a division as 3, an exponential as 2",
            f">= {claimed.split()[1]}",
            counted(direct, FIXED) / counted(power, FIXED),
            note="16 bits in hardware: 1/x = rsqrt(x)^2, table and parabola",
        )

    lobe = Cost.of("shade_lobe")
    for ward, name, claimed, ulp in ((0, "D16 against D", 4.34, 2.5), (1, "Ward", 2, 1.25)):
        direct = Cost.of("yardstick_beckmann", **({"WARD": 1} if ward else {}))
        model = "ward" if ward else "cook-torrance"
        worst = {m: np.abs(run_direct(m, ward).y_o - ONE * shape(model, C, m)).max() for m in ROUGHNESS}
        yield p1(
            f"{NAMES[model]}, evaluated directly by the yardstick: largest error, m = 0.2 .. 0.6",
            f"<= {ulp}",
            max(worst.values()),
            unit="ulp",
            kind="repair",
            note="RTL, every 17-bit cosine, against float64",
        )
        against = partial(p1, note=f"{direct}; {lobe}, two of its six products in LUTs; ECP5, one value a clock")
        yield against(f"gain, {name}, RTL: DSP blocks", f">= {claimed}", direct.dsp / lobe.dsp)
        yield against(f"gain, {name}, RTL: LUTs", ">= 1", direct.lut / lobe.lut, kind="repair")
        yield against(f"gain, {name}, RTL: latency", ">= 1", direct.clocks / lobe.clocks, kind="repair")
        if direct.fmax and lobe.fmax:
            yield against(f"gain, {name}, RTL: clock rate", ">= 1", lobe.fmax / direct.fmax, kind="repair")


def faces(folder: Path, size: int) -> Iterator[Claim]:
    """The head in both models, every pixel lit by the RTL: Fig. 6."""
    scene = view(size, 1)
    pixels = expand(scene.spans, size)
    normal = reference.unit(scene.spans.normal[pixels.span] + pixels.step[:, None] * scene.spans.gradient[pixels.span])
    seen = scene.visible >= 0
    normal = normal[scene.visible[seen]]
    shown = {}
    for model, name in NAMES.items():
        for form, told, claimed, kind in (
            ("paper", "as P1 prints it", "<= 1e-4", "paper"),
            ("refined", "refined", "<= 1e-5", "repair"),
        ):
            skin = material.Material(model=model, roughness=DRAWN, form=form)
            exact = skin.channels(normal, scene.settings.light)
            lit = rtl_light(skin, normal, scene.settings.light)
            error = nmse(lit[:, 1], exact[:, 1])
            yield p1(
                f"Fig. 6: {name}, {told}, m = {DRAWN}: NMSE, specular",
                claimed,
                error,
                kind=kind,
                figure="p1_faces.png",
                note=f"RTL, shade_light at every pixel, head, {size} x {size}, against the original model in float64; "
                f"diffuse {nmse(lit[:, 0], exact[:, 0]):.1e}",
            )
            shown[f"{name}, {told}"] = skin, lit, error
        shown[f"{name}, original"] = skin, exact, 0
    draw_faces(folder / "p1_faces.png", seen.reshape(size, size), shown)


# ---- lobes -------------------------------------------------------------------------------------------------------


def shape(model: str, c: NDArray[np.float64], m: float) -> NDArray[np.float64]:
    """The original expression over its peak."""
    return material.shape(model, 1 - c, 1, m)


def exponent(model: str, m: float) -> float:
    """Of the cosine that P1 puts in the place of the exponential."""
    return 2 / m**2 - (4 if model == "cook-torrance" else 0)


def printed(model: str, c: NDArray[np.float64], m: float, g: int) -> NDArray[np.float64]:
    """P1's D4, D8, D16 over their peak, clamped at 0; the same for Ward."""
    return reference.lobe(c, exponent(model, m) / g, power=int(log2(g)))


def printed_errors(model: str, m: float) -> dict[str | int, float]:
    """Largest errors, relative to the peak, of the cosine's power and of the 4th, 8th, 16th power."""
    c = np.cos(ANGLES)
    exact = shape(model, c, m)
    values = {"cosine": c ** exponent(model, m)} | {g: printed(model, c, m, g) for g in POWERS}
    return {name: float(np.abs(value - exact).max()) for name, value in values.items()}


def rtl_error(model: str, m: float, form: str = "refined", power: int = 4) -> float:
    """Largest error of ``shade_lobe``, relative to the peak, over every 17-bit cosine."""
    return float(np.abs(rtl_lobe(model, roughness=m, form=form, stages=power) - shape(model, C, m)).max())


# ---- gains -------------------------------------------------------------------------------------------------------


class Count(NamedTuple):
    """Operations of an expression of c = N.H; what depends on m alone is ready. Additions are left out."""

    multiplications: int
    divisions: int = 0
    exponentials: int = 0

    def __str__(self) -> str:
        there = [
            (count, name.removesuffix("s") if count == 1 else name) for name, count in self._asdict().items() if count
        ]
        return ", ".join(f"{count} {name}" for count, name in there)


COUNTS = {
    "D": Count(4, 2, 1),  # c^2, m^2 c^2, (c^2 - 1)/(m^2 c^2), exp, c^4, 4 m^2 c^4, exp/(4 m^2 c^4)
    "D16": Count(6),  # kappa (c - 1), four squarings, 1/(4 m^2)
    "Ward": Count(2, 1, 1),  # c^2, m^2 c^2, (c^2 - 1)/(m^2 c^2), exp
    "Ward, 16th power": Count(5),  # kappa (c - 1), four squarings
}
FLOATING = (1, 3.5, 15)
FIXED = (1, 3, 2)
"""Prices of a multiplication, a division and an exponential, in multiplications."""


def counted(name: str, prices: tuple[float, ...]) -> float:
    """Multiplications that an expression is worth."""
    return float(np.dot(COUNTS[name], prices))


@dataclass(frozen=True)
class Cost:
    """LUTs, DSP blocks on an ECP5, latency; the clock rate in MHz, if ``make synth`` left it."""

    design: str
    lut: int
    dsp: int
    clocks: int
    fmax: float | None

    def __str__(self) -> str:
        rate = f", {self.fmax} MHz" if self.fmax else ""
        return f"{self.design}: {self.dsp} DSP, {self.lut} LUT, {self.clocks} clocks{rate}"

    @classmethod
    def of(cls, module: str, **point: int) -> Cost:
        """Synthesize a module at a parameter point and measure its latency."""
        design = next(each for each in synth.designs([module]) if each.point == point)
        netlist = synth.elaborate(design)
        area = synth.synthesize(design, "ecp5")
        placed = synth.kept(design, "ecp5", netlist)
        model = sim.load(module, **point)
        run = model.run(**{port.name: 0 for port in model.interface.into.data})
        fmax = placed["fmax_mhz"] if placed else None
        return cls(design.name, area["lut"], area["dsp"], int(run.given[0] - run.taken[0]), fmax)


def direct_registers(m: float) -> dict[str, int]:
    """k and shift of the yardstick: log2(e)/m^2 = k 2^shift.

    >>> direct_registers(0.3)
    {'k_i': 65659, 'shift_i': 4}
    """
    steepness = log2(e) / m**2
    shift = floor(log2(steepness))
    return {"k_i": round(steepness / 2**shift * ONE), "shift_i": shift}


def run_direct(m: float, ward: int) -> sim.Run:
    """The yardstick at every cosine ``C``."""
    return sim.load("yardstick_beckmann", **({"WARD": 1} if ward else {})).run(c_i=COSINES, **direct_registers(m))


# ---- faces -------------------------------------------------------------------------------------------------------


def rtl_light(skin: material.Material, normal: NDArray[np.float64], light: tuple[float, ...]) -> NDArray[np.float64]:
    """(P, 2): diffuse, unclamped, and specular light of ``shade_light`` at unit normals (P, 3)."""
    words = registers.draw(material.registers(skin, light))
    named = [(*path.split(".", 1), value) for path, value in words.items()]
    settings = {f"{part}_i.{name}": value for part, name, value in named if part in ("material", "light")}
    run = sim.load("shade_light").run(n_i=frame.quantize(normal), **settings)
    return np.stack([run.light_o["diffuse"], run.light_o["specular"]], axis=1) / ONE


# ---- figures -----------------------------------------------------------------------------------------------------


def draw_lobes(path: Path) -> None:
    """P1's Figs. 2 to 5 with the refined lobe beside."""
    m, c, degrees = DRAWN, np.cos(ANGLES), np.degrees(ANGLES)
    exact = shape("cook-torrance", c, m)
    cosine = c ** exponent("cook-torrance", m)
    ours = reference.lobe(c, *material.fit("cook-torrance", roughness=m))
    high = exact > 1e-3

    def relative(axes: Axes, value: NDArray[np.float64], colour: str, label: str) -> None:
        axes.plot(degrees[high], 100 * (value[high] / exact[high] - 1), color=colour, label=label)

    with figures.drawing(path, 10, 7.2, 2, 2, sharex=True) as (fig2, fig3, fig4, fig5):
        for axes in (fig2, fig4):
            axes.plot(degrees, exact, color=figures.EXACT, lw=5, alpha=0.25, label="D")
            axes.set(ylabel="relative to the peak", ylim=(-0.03, 1.05))
        fig2.plot(degrees, cosine, color=figures.PAPER, label="power of the cosine")
        relative(fig3, cosine, figures.PAPER, "power of the cosine")
        for g, colour in zip(POWERS, (figures.THIRD, "#8a5a83", figures.PAPER), strict=True):
            fig4.plot(degrees, printed("cook-torrance", c, m, g), color=colour, label=f"D{g}, clamped at 0")
            relative(fig5, printed("cook-torrance", c, m, g), colour, f"D{g}")
        fig4.plot(degrees, ours, "--", color=figures.REFINED, label="refined")
        relative(fig5, ours, figures.REFINED, "refined")
        fig2.set(title=f"Fig. 2: Cook and Torrance's D, m = {m}", xlim=(0, 45))
        fig3.set(title="Fig. 3: its relative error", ylabel="%", ylim=(-105, 105))
        fig4.set(title="Fig. 4: one power of 4, 8, 16", xlabel="angle, degrees")
        fig5.set(title="Fig. 5: relative error", ylabel="%", xlabel="angle, degrees", ylim=(-105, 105))
        for axes in (fig2, fig3, fig4, fig5):
            axes.legend()


def draw_roughness(path: Path, errors: dict[tuple[str, float], float]) -> None:
    """Largest error over the roughness: as printed, refined, and the RTL."""
    ms = np.linspace(0.1, 0.7, 61)
    with figures.drawing(path, 10, 4, 1, 2, sharey=True) as axes:
        for plot, (model, name) in zip(axes, NAMES.items(), strict=True):
            by_m = [printed_errors(model, m) for m in ms]
            for key, label, colour in (
                ("cosine", "power of the cosine", figures.SHADES[0]),
                (4, "4th power", figures.THIRD),
                (8, "8th power", "#8a5a83"),
                (16, "16th power", figures.PAPER),
            ):
                plot.plot(ms, [100 * each[key] for each in by_m], color=colour, label=label)
            ours = [
                100 * np.abs(reference.lobe(C, *material.fit(model, roughness=m)) - shape(model, C, m)).max()
                for m in ms
            ]
            plot.plot(ms, ours, color=figures.REFINED, label="refined lobe")
            found = [100 * errors[model, m] for m in ROUGHNESS]
            plot.plot(ROUGHNESS, found, "o", color=figures.REFINED, label="RTL, refined")
            plot.axhline(1.3, color=figures.PAPER, ls=":", lw=1)
            plot.text(0.1, 1.45, "P1: 1.3 %", color=figures.PAPER, fontsize=8)
            plot.set(title=name, xlabel="roughness m", yscale="log", ylim=(1e-3, 100))
        axes[0].set_ylabel("largest error, % of the peak")
        axes[1].legend(loc="lower right")


def draw_faces(path: Path, seen: NDArray[np.bool_], shown: dict[str, tuple]) -> None:
    """Pictures (material, light of the seen pixels, NMSE) by title: as printed, refined, original."""
    rows, columns = (slice(index.min(), index.max() + 1) for index in np.nonzero(seen))
    with figures.drawing(path, 9, 8.4, len(NAMES), 3) as axes:
        for plot, (title, (skin, lit, error)) in zip(axes, shown.items(), strict=True):
            picture = np.ones((*seen.shape, 3))
            matt = skin.ambient + skin.diffuse * lit[:, :1].clip(0)
            picture[seen] = matt * skin.colour + skin.specular * lit[:, 1:] * skin.highlight
            plot.imshow(picture.clip(0, 1)[rows, columns], interpolation="lanczos")
            plot.set_title(f"{title}\nNMSE of the highlight {error:.1e}" if error else f"{title}\n")
            plot.axis("off")


STEPS = [distributions, refined, gains, faces]
