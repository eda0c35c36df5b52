# SPDX-License-Identifier: Apache-2.0
"""Paper P1, section IV, the arithmetic: a third by shifts and adds, the coefficients, the evaluator (Figs. 7, 8, 9)."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden.reference import poly as reference
from polyshade.scripts.drawings import waves
from polyshade.scripts.studies.papers import figures
from polyshade.scripts.studies.papers.claims import Claim, check
from polyshade.sim import verilate

p1 = partial(check, paper="P1")
ONE = 1 << k.INTENSITY_F
VECTORS = 1 << 17

# The factors of I1 .. I4 as P1 prints them, common powers of two left out, and whether a division by three follows.
PRINTED = {
    k.NODES_LEFT: (
        ((0, 8, 0, 1), True),
        ((1, 0, 2, 0), False),
        ((7, 16, 10, 1), False),
        ((0, 32, 0, 1), True),
        ((7, 0, 4, 0), False),
    ),
    k.NODES_RIGHT: (
        ((1, 0, 8, 0), True),
        ((0, 2, 0, 1), False),
        ((3, 14, 16, 5), False),
        ((13, 0, 32, 0), True),
        ((0, 12, 0, 3), False),
    ),
}
PRINTED_COEFFICIENTS = 3  # A, B, C: the parts of a coefficient are joined, D costs nothing


def thirds(folder: Path, size: int) -> Iterator[Claim]:
    """x/3, Fig. 7."""
    wide = np.arange(-(1 << 17), 1 << 17) << 7  # seven zeros below: 43 x / 128 is whole, so its rounding does not show
    paper = sim.load("shade_third", WIDTH=26, FORM=k.FORM_PAPER).run(x_i=wide).y_o
    nonzero = wide != 0
    error = np.abs(3 * paper[nonzero] / wide[nonzero] - 1).max()
    yield p1(
        "Fig. 7: relative error of x/2 - x/8 - x/32 - x/128 for x/3",
        "<= 0.79",
        100 * error,
        unit="%",
        figure="p1_third.png",
        note=f"RTL, {len(wide)} inputs",
    )
    lacking = {adders: 1 - 3 * float(reference.third_log(1, adders)) for adders in (1, 2, 3, 4)}
    for adders, claimed in ((3, "= 1.5e-5"), (4, "= 2.3e-10")):
        yield p1(
            f"x/4 (1 + 1/4)(1 + 1/16)...: relative error with {adders} adders",
            claimed,
            lacking[adders],
            kind="repair",
            figure="p1_third.png",
        )
    yield p1("three adders: times more exact than P1's three subtractions", "= 512", error / lacking[3], kind="repair")

    every = np.arange(-(1 << 19), 1 << 19)
    refined = sim.load("shade_third", WIDTH=20, FORM=k.FORM_REFINED).run(x_i=every).y_o
    yield p1(
        "refined x/3 is faithful: worst error over all 20-bit inputs",
        "<= 1",
        np.abs(refined - every / 3).max(),
        unit="ulp",
        kind="repair",
        note="RTL, all 2^20 inputs; 1/3 ulp: always the nearest integer",
    )

    x = np.unique(np.geomspace(1, (1 << 19) - 1, 400).astype(int))
    with figures.drawing(folder / "p1_third.png", 7, 4) as (axes,):
        axes.plot(x, np.full(len(x), error), color=figures.PAPER, label="P1: x/2 − x/8 − x/32 − x/128")
        for adders, value in lacking.items():
            shade = figures.SHADES[adders - 1]
            axes.plot(
                x, np.full(len(x), value), color=shade, label=f"log-depth form, {adders} adder{'s'[: adders > 1]}"
            )
        measured = np.abs(3 * refined[x + (1 << 19)] / x - 1)
        axes.plot(
            x[measured > 0], measured[measured > 0], ".", color=figures.THIRD, ms=2.5, label="RTL refined, rounded"
        )
        axes.set(xscale="log", yscale="log", xlabel="x in units of the last bit", ylabel="relative error of x/3")
        axes.set(title="A third by shifts and adds", ylim=(1e-11, 1))
        axes.legend(loc="lower left", bbox_to_anchor=(0.01, 0.14))


def coefficients(folder: Path, size: int) -> Iterator[Claim]:
    """The two node sets and the units for A, B, C (Fig. 8)."""
    rng = np.random.default_rng(1)
    cubic = rng.integers(-(1 << 8), 1 << 8, (VECTORS, 4)) << 6  # whole at t = 1/4, 1/2, 3/4 as well
    for nodes, name in ((k.NODES_LEFT, "{0, 1/4, 1/2, 1}"), (k.NODES_RIGHT, "{0, 1/2, 3/4, 1}")):
        t = np.array(reference.NODES[nodes][3])
        found = run_coef(reference.horner(tuple(cubic.T[:, :, None]), t).astype(int), nodes)
        yield p1(
            f"A, B, C, D of nodes {name} solve the system: worst error on random cubics",
            "<= 0",
            np.abs(found - cubic).max(),
            unit="ulp",
            note=f"RTL, refined form, {VECTORS} cubics",
        )

    digits = {nodes: [[signed_digits(f) for f in factors] for factors, _ in PRINTED[nodes]] for nodes in PRINTED}
    yield p1(
        "first node set: every factor is a sum of so few powers of two (10 = 8 + 2)",
        "<= 2",
        max(map(max, digits[0])),
        note=f"second set: {max(map(max, digits[1]))} (13 = 16 - 4 + 1)",
    )
    adders = {}
    for nodes, parts in PRINTED.items():
        terms = sum(map(sum, digits[nodes]))
        adders[nodes] = terms - PRINTED_COEFFICIENTS + 3 * sum(divided for _, divided in parts)
    yield p1(
        "the first node set is the more convenient one: adders of A, B, C, against those of the second",
        f"<= {adders[k.NODES_RIGHT]}",
        adders[k.NODES_LEFT],
        note="formulas as printed, factors in their fewest signed powers of two, three adders a third",
    )
    yield p1(
        "Fig. 8: coefficients need neither multiplication nor division: multipliers in the unit",
        "<= 0",
        multipliers("shade_coef"),
        note="instances of shade_mul, the one module with a *, below shade_coef",
    )

    ones = np.full((1, 4), ONE)
    constant = run_coef(ones, form=k.FORM_PAPER)
    a, _, c, _ = constant[0] / ONE
    at_one = run_horner("shade_horner_pipe", constant, np.array([ONE])).y_o[0] / ONE
    about = partial(p1, kind="defect", figure="p1_line.png")
    yield about("constant intensity 1 with the x/3 of Fig. 7: A, which should be 0", "= 0.1875", a, note="RTL")
    yield about("constant intensity 1 with the x/3 of Fig. 7: C, which should be 0", "= 0.0859", c, note="RTL")
    yield about(
        "constant intensity 1 with the x/3 of Fig. 7: I(1), which should be 1", "= 1.273", at_one, note="RTL, unclamped"
    )
    corner = np.array([[0, ONE, 0, ONE]])
    amplified = (run_coef(corner, form=k.FORM_PAPER) - run_coef(corner))[0, 0] / ONE
    yield about(
        "the 0.78 % of x/3 enter A as an error of the intensity, times up to",
        "= 72",
        amplified / (1 / 128),
        note="RTL, I2 = I4 = 1: what P1 divides is 72, a third of it 24, so A is wrong by 24/128 of the intensity",
    )
    refined = run_coef(ones)
    at_one = run_horner("shade_horner_pipe", refined, np.array([ONE])).y_o[0] / ONE
    yield p1(
        "difference form on a constant intensity 1: error of I(1)", "<= 0", abs(at_one - 1), kind="repair", note="RTL"
    )


def evaluator(folder: Path, size: int) -> Iterator[Claim]:
    """The evaluator of Fig. 9, and what stands beside it."""
    rng = np.random.default_rng(2)
    coefficient = np.concatenate(
        [rng.integers(-(1 << 24), 1 << 24, (VECTORS, 3)), rng.integers(-(1 << 17), 1 << 17, (VECTORS, 1))], axis=1
    )
    t = rng.integers(0, ONE, VECTORS, endpoint=True)
    sequential = run_horner("shade_horner_seq", coefficient, t)
    exact = reference.horner(tuple(coefficient.T), t / ONE)
    fig9 = partial(p1, note=f"RTL, {VECTORS} random values")
    yield fig9("Fig. 9: one multiplier", "<= 1", multipliers("shade_horner_seq"), note="instances of shade_mul")
    yield fig9("Fig. 9: load and five steps: clocks a value", "= 6", np.diff(sequential.taken).mean(), unit="clocks")
    yield fig9("Fig. 9: worst error of I(t)", "<= 1", np.abs(sequential.y_o - exact).max(), unit="ulp")
    few = 64
    run, wave = record_seq(coefficient[:few], t[:few])
    steps = wave["rg_q"][run.taken[:, None] + np.arange(1, 7)] / (1 << k.HORNER_GUARD)
    (a, b, c, d), x = coefficient[:few].T, t[:few] / ONE
    expected = np.stack([b, a * x + b, (a * x + b) * x, (a * x + b) * x + c, ((a * x + b) * x + c) * x, exact[:few]], 1)
    yield fig9(
        "Fig. 9: RG holds B, A t + B, (A t + B) t, ... after each clock: worst distance",
        "<= 1",
        np.abs(steps - expected).max(),
        unit="ulp",
        note=f"RTL, register read from the waveform of {few} values",
    )
    piped = run_horner("shade_horner_pipe", coefficient, t)
    yield p1(
        "pipelined evaluator: clocks a value",
        "= 1",
        np.diff(piped.given).mean(),
        unit="clocks",
        kind="repair",
        note=f"RTL, {np.count_nonzero(piped.y_o != sequential.y_o)} of {VECTORS} values differ from those of Fig. 9",
    )

    pixels = np.arange(k.PIXELS_MAX + 1)
    a, b, c, d = coefficient[0]
    run = sim.load("shade_fdiff").run(first_i=pixels == 0, a_i=a, b_i=b, c_i=c, d_i=d, log2_i=k.LOG2_MAX)
    numerator = (int(a) * pixels.astype(object) + (int(b) << 12)) * pixels
    numerator = (numerator + (int(c) << 24)) * pixels + (int(d) << 36)  # exact, in units of 2^-36 ulp
    error = np.abs(((run.y_o.astype(object) << 36) - numerator).astype(float)) / 2.0**36
    yield p1(
        "forward differences: multipliers",
        "<= 0",
        multipliers("shade_fdiff"),
        kind="repair",
        note="instances of shade_mul",
    )
    yield p1(
        "forward differences: worst error over the longest segment, 4096 pixels",
        "<= 0.5",
        error.max(),
        unit="ulp",
        kind="repair",
        note="RTL: its state keeps every fraction bit",
    )
    d3 = np.zeros(k.PIXELS_MAX + 1, int)
    d3[1:] = 1  # an error of one unit in d3; d2, d1 and I sum it up
    grown = np.cumsum(np.r_[0, np.cumsum(np.r_[0, np.cumsum(d3[1:])])])[k.PIXELS_MAX - 2]
    yield p1(
        "forward differences: an error of d3 grows to n^3/6 of itself: ratio at n = 4096",
        "= 1.00",
        grown / (k.PIXELS_MAX**3 / 6),
        kind="repair",
        note="why the state has 36 more fraction bits",
    )


def run_coef(intensity: np.ndarray, nodes: int = k.NODES_LEFT, form: int = k.FORM_REFINED) -> np.ndarray:
    """(R, 4): A, B, C, D of ``shade_coef`` for the cubics through intensities (R, 4)."""
    i1, i2, i3, i4 = intensity.T
    unit = sim.load("shade_coef", NODES=nodes, FORM=form)
    run = unit.run(degree_i=k.DEGREE_CUBIC, i1_i=i1, i2_i=i2, i3_i=i3, i4_i=i4)
    return np.stack([run.a_o, run.b_o, run.c_o, run.d_o], axis=1)


def run_horner(module: str, coefficients: np.ndarray, t: np.ndarray) -> sim.Run:
    """An evaluator on coefficients (R, 4) and t (R,)."""
    a, b, c, d = coefficients.T
    return sim.load(module).run(a_i=a, b_i=b, c_i=c, d_i=d, t_i=t)


def record_seq(coefficients: np.ndarray, t: np.ndarray) -> tuple[sim.Run, dict[str, np.ndarray]]:
    """``shade_horner_seq`` on coefficients (R, 4) and t (R,), and its signals by P1's names for them."""
    a, b, c, d = coefficients.T
    names = ("step_q", "valid_i", "ready_o", "valid_o", "mx1", "mul", "bk", "mx2", "rg_q")
    return waves.record("shade_horner_seq", names, signed=names[4:], a_i=a, b_i=b, c_i=c, d_i=d, t_i=t)


def signed_digits(factor: int) -> int:
    """The fewest signed powers of two of which a factor is the sum: 7 = 8 - 1 has two.

    >>> [signed_digits(f) for f in (0, 8, 7, 10, 13)]
    [0, 1, 2, 2, 3]
    """
    return (factor ^ 3 * factor).bit_count()


def multipliers(module: str) -> int:
    """How many instances of ``shade_mul`` stand in the sources that a module reaches."""
    return sum(len(re.findall(r"^\s*shade_mul\b", path.read_text(), re.M)) for path in verilate.reached(module))


STEPS = [thirds, coefficients, evaluator]
