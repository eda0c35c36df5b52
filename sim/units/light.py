# SPDX-License-Identifier: Apache-2.0
"""Light at a node: angles, directions, highlights, Fresnel's factor, colours."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import light, material
from polyshade.sim.units.case import FORMS, ONE, Arrays, Case, Real, every, in_forms, mixed, signed_range
from polyshade.sim.units.normal import arcs

LIMITS = signed_range(k.INTENSITY_W)
FEW = 6_250  # vectors of a run, of which each has settings of its own
SHIFTS = range(k.LOBE_FINE + 1)


def half_a_place(shift: int) -> float:
    """Half a last place of a versine for a lobe of this shift, in ulp."""
    return 2.0 ** (k.VERSINE_CUT - 1 - (0 if shift == k.LOBE_FINE else shift))


def directions(names: str) -> Callable[[np.random.Generator, int], Arrays]:
    """Two vectors of :func:`arcs` as ports: with "nl", n_i and l_i."""

    def make(rng: np.random.Generator, rows: int) -> Arrays:
        components = list(arcs(rng, rows).values())[:6]
        return dict(zip((f"{name}_i.{c}" for name in names for c in "xyz"), components, strict=True))

    return make


def _two(i: Arrays) -> tuple[np.ndarray, np.ndarray]:
    """The two vectors (3, rows) that the inputs begin with, as numbers."""
    v = np.stack(list(i.values())[:6]).astype(Real) / ONE
    return v[:3], v[3:]


def _versine(form: str) -> Iterator[Case]:
    """1 - cos of an angle; ideal: of the true angle, where that is acute, of unit vectors but for their rounding."""

    def vectors(rng: np.random.Generator, rows: int) -> Arrays:
        return directions("ab")(rng, rows) | {"shift_i": np.full(rows, rng.choice(SHIFTS))}

    def golden(i: Arrays) -> Arrays:
        return dict(zip(("x_o", "range_o"), light.versine(*i.values(), form=FORMS[form]), strict=True))

    def exact(i: Arrays) -> Arrays:
        a, b = _two(i)
        low, high = LIMITS
        chord = (((a - b) * ONE).clip(low, high) / ONE) ** 2
        x = chord.sum(axis=0) / 2 if form == "refined" else 1 - (a * b).sum(axis=0)
        return golden(i) | {"x_o": np.ldexp(x.clip(0, 2), k.VERSINE_F)}

    def ideal(i: Arrays) -> Arrays:
        a, b = _two(i)
        lengths = [np.sqrt((v * v).sum(axis=0)) for v in (a, b)]
        unit = np.all([np.abs(length - 1) < 1 / ONE for length in lengths], axis=0)
        a, b = (v / np.where(unit, length, 1) for v, length in zip((a, b), lengths, strict=True))
        x = ((a - b) ** 2).sum(axis=0) / 2
        values = exact(i)
        return values | {"x_o": np.where(unit & (x <= 1), np.ldexp(x, k.VERSINE_F), values["x_o"])}

    def tolerance(i: Arrays) -> Arrays:
        return {"x_o": half_a_place(int(i["shift_i"][0]))}

    yield Case(
        "shade_versine", form, {"FORM": FORMS[form]}, golden, exact, ideal, vectors, None, k.LATENCY_VERSINE,
        unit_f=k.VERSINE_F, chunk=FEW, bound=half_a_place(k.LOBE_FINE), tolerance=tolerance,
    )  # fmt: skip


def _directions(form: str) -> Iterator[Case]:
    """Where a mirror sends light, and the direction halfway between light and viewer."""

    def reflected(i: Arrays) -> Arrays:
        return dict(zip(("r_o.x", "r_o.y", "r_o.z"), light.reflect(*i.values()), strict=True))

    def mirror(i: Arrays) -> Arrays:
        n, l = _two(i)  # noqa: E741
        twice = 2 * (n * l).sum(axis=0)
        r = (twice.clip(-LIMITS[1] / ONE, 2) * n - l) * ONE
        return dict(zip(("r_o.x", "r_o.y", "r_o.z"), r.clip(*LIMITS), strict=True))

    yield Case(
        "shade_reflect", form, {}, reflected, mirror, mirror, directions("nl"), None, k.LATENCY_REFLECT,
        bound=1.5,  # 1/2, and m's half ulp times a component of N: of a unit normal at most 1
    )  # fmt: skip

    names = ("h_o.x", "h_o.y", "h_o.z", "vh_o")

    def golden(i: Arrays) -> Arrays:
        return dict(zip(names, light.halfway(*i.values()), strict=True))

    def halfway(i: Arrays) -> Arrays:
        l, v = _two(i)  # noqa: E741
        s = ((l + v) * ONE).clip(*LIMITS)
        length = np.sqrt((s * s).sum(axis=0))
        h = s / np.where(length == 0, 1, length)
        values = (*(h * ONE), ((v * h).sum(axis=0) * ONE).clip(0, ONE))
        return dict(zip(names, values, strict=True))

    yield Case(
        "shade_halfway", form, {}, golden, halfway, halfway, directions("lv"), None, k.LATENCY_HALFWAY,
        bound=4.25,  # 1/2, and H's 5/8 times the sum of V's components; of unit vectors at most 1.6
    )  # fmt: skip


Highlight = tuple[str, float, float]  # model, n, m


@cache
def _highlights(form: str, stages: int) -> dict[tuple[int, ...], Highlight]:
    """Highlights from the broadest to the sharpest that these squarings allow (k1 of about 96), by their registers."""
    sharpest = min(1024, 96 << stages)
    everything = [("blinn", n, 1) for n in np.geomspace(1, sharpest, 21).tolist()]
    for m in np.linspace(max(0.05, 1.5 / sharpest**0.5), 0.7, 10).tolist():
        everything += [("cook-torrance", 1, m), ("ward", 1, m)]
    fits = [material.fit(*highlight, form, stages) for highlight in everything]
    return {
        tuple(material.lobe_registers(*fit).values()): highlight
        for fit, highlight in zip(fits, everything, strict=True)
    }


def lobe_latency(stages: int, fold: int) -> int:
    """Clocks of ``shade_lobe``."""
    if fold == 1:
        return k.LATENCY_LOBE - (4 - stages) * k.LATENCY_LOBE_POWER
    turn = k.LATENCY_MUL + 3 + (fold == 5)
    return 3 + (2 + stages) * turn - (fold == 5)


def exact_lobe(x, k1: int, k2: int, shift: int, xmax: int, power: int) -> np.ndarray:
    """The lobe as a number from its arguments as they are, of x U2.20, by its formula alone."""
    fine = shift == k.LOBE_FINE
    x = np.ldexp(np.asarray(x, Real), -k.VERSINE_F)
    scaled = np.minimum(np.ldexp(x, 0 if fine else shift), Real(xmax) / (1 << k.LOBE_X_F))
    slope = Real(k1) / (1 << k.LOBE_K1_F) - Real(k2) / (1 << k.LOBE_K2_F) * scaled
    base = 1 - slope * scaled / (1 << k.LOBE_FINE_F if fine else 1)
    base = np.where(x > 1, 0, base.clip(0, 1))
    for _ in range(power):
        base = base * base
    return base


def _lobe(form: str) -> Iterator[Case]:
    """Highlights from the broadest to the sharpest, and any registers that ``lobe_registers`` gives.

    Registers stay as they are while values are in flight, so each run has its own. Of every stage and fold values of
    every size for each highlight; with all stages and unfolded every versine of 20 fraction bits for some of them.
    """
    one, most = 1 << k.VERSINE_F, 2 << k.VERSINE_F

    def inputs(x: np.ndarray, registers: tuple[int, ...]) -> Arrays:
        named = zip(light.LOBE, registers, strict=True)
        return {"x_i": x} | {f"lobe_i.{name}": np.full_like(x, value) for name, value in named}

    def some(rng: np.random.Generator, rows: int) -> np.ndarray:
        """Versines of every size, all the smallest ones, and around 1 and 2."""
        x = rng.integers(0, most, rows, endpoint=True) >> np.maximum(rng.integers(-2, 25, rows), 0)
        x[:96] = np.r_[np.arange(64), one + (np.arange(-8, 8) << 3), most - np.arange(16)][:rows]
        return x

    def case(stages: int, fold: int, note: str, vectors: Callable, more: Callable | None = None) -> Case:
        def registers(i: Arrays) -> tuple[int, ...]:
            return tuple(int(i[f"lobe_i.{name}"][0]) for name in light.LOBE)

        def golden(i: Arrays) -> Arrays:
            return {"lobe_o": light.lobe(i["x_i"], *registers(i), stages)}

        def exact(i: Arrays) -> Arrays:
            k1, k2, shift, xmax, power = registers(i)
            unused = int(2 * half_a_place(shift)) - 1
            x, edge = i["x_i"] & ~unused, one + (1 << k.VERSINE_CUT)
            x = np.where((x > one) & (x < edge), one, x)  # cut to 20 fraction bits it is not beyond 1
            return {"lobe_o": exact_lobe(x, k1, k2, shift, xmax, min(power, stages)) * ONE}

        def ideal(i: Arrays) -> Arrays:
            """The highlight that the registers stand for."""
            model, n, m = _highlights(form, stages)[registers(i)]
            x = np.ldexp(np.minimum(i["x_i"], one).astype(float), -k.VERSINE_F)
            return {"lobe_o": material.shape(model, x, n, m) * ONE}

        point = {"POWER": stages, "FOLD": fold} | ({"TAKE": fold // 2} if fold > 1 else {})
        return Case(
            "shade_lobe", form, point, golden, exact, ideal if more is None else exact, more,
            vectors, lobe_latency(stages, fold), fold, chunk=1 << 12, note=note,
            bound=1.5,  # 1/2, and 2^power times what s, y and z lack near the peak
        )  # fmt: skip

    def of(stages: int, step: int, make: Callable[[np.random.Generator], np.ndarray]) -> Callable:
        """A run for every ``step``-th highlight."""

        def vectors() -> Iterator[Arrays]:
            rng = np.random.default_rng(1)
            for registers in list(_highlights(form, stages))[::step]:
                yield inputs(make(rng), registers)

        return vectors

    def wild(rng: np.random.Generator, rows: int) -> Arrays:
        """Registers of any bits, as no material has them: only RTL and golden model are compared."""
        low, high = signed_range(k.LOBE_K2_W)
        k2 = int(np.clip(rng.normal(0, high / 2), low, high))
        widths = {"k1": k.LOBE_K1_W, "shift": k.LOBE_SHIFT_W, "xmax": k.LOBE_X_F + 1, "power": k.LOBE_POWER_W}
        words = {name: int(rng.integers(0, 1 << width)) for name, width in widths.items()} | {"k2": k2}
        return inputs(some(rng, rows), tuple(words[name] for name in light.LOBE))

    def any_registers(rng: np.random.Generator, rows: int) -> Arrays:
        """k2 of no, either and the greatest amount; xmax at the vertex."""
        while True:
            k1 = 2 ** rng.uniform(-7, 6.9) * rng.integers(0, 8).clip(0, 1)
            k2 = (0, k1 * k1 / 2 * rng.uniform(0, 1.2), -(2 ** rng.uniform(-6, 11)))[rng.integers(0, 3)]
            xmax = min(1, k1 / 2 / k2) if k2 > 0 else 1
            try:
                words = material.lobe_registers(k1, k2, xmax, int(rng.choice([4, 4, 4, 0, 1, 2, 3, 7])))
            except ValueError:
                continue
            steep = int(one * min(1, 4 / (16 * k1 + 1)))  # where the lobe falls
            x = some(rng, rows)
            return inputs(np.where(rng.random(rows) < 0.5, rng.integers(0, steep + 1, rows), x), tuple(words.values()))

    if form == "refined":
        yield case(4, 1, "every versine", of(4, 8, lambda rng: np.arange(0, most + 1, 1 << k.VERSINE_CUT)))
        yield case(4, 1, "any registers", None, any_registers)
        unmeasured = case(4, 1, "wild registers", None, wild)
        yield replace(unmeasured, exact=unmeasured.golden, ideal=unmeasured.golden)
    folds = (6, 2, 3, 4, 5, 7, 8)
    for stages, fold in ((4, 1), *((4, fold) for fold in folds), (3, 1), (2, 1), (3, 6), (2, 6), (3, 3), (2, 5)):
        yield case(stages, fold, "", of(stages, 1, lambda rng, f=fold: some(rng, (1 << 15) // f)))


def _lobe_folded(form: str) -> Iterator[Case]:
    """The lobe behind its X: every X of few bits and random ones, registers of any kind."""
    high = (2 << k.LOBE_SCALED_F) - 1
    few = [name for name in light.LOBE if name not in ("xmax", "shift")]

    def vectors(rng: np.random.Generator, rows: int) -> Arrays:
        x = rng.integers(0, high, rows, endpoint=True) >> rng.integers(0, 20, rows)
        ranges = {"k1": (0, (1 << k.LOBE_K1_W) - 1), "k2": signed_range(k.LOBE_K2_W), "power": (0, 4)}
        settings = {name: int(rng.integers(*limits, endpoint=True)) for name, limits in ranges.items()}
        settings |= {"shift": int(rng.choice([0, 6, k.LOBE_FINE])), "xmax": 0}
        named = {f"lobe_i.{name}": np.full(rows, settings[name]) for name in light.LOBE}
        return {"x_i": x, "dark_i": rng.integers(0, 16, rows) // 15} | named

    def arguments(i: Arrays) -> tuple[int, ...]:
        k1, k2, power = (int(i[f"lobe_i.{name}"][0]) for name in few)
        return k1, k2, int(i["lobe_i.shift"][0] == k.LOBE_FINE), power

    for stages, fold in ((4, 6), *((4, fold) for fold in (2, 3, 4, 5, 7, 8)), (2, 5)):

        def golden(i: Arrays, stages: int = stages) -> Arrays:
            return {"lobe_o": light.lobe_scaled(i["x_i"], i["dark_i"], *arguments(i), stages)}

        yield Case(
            "shade_lobe_folded", form, {"POWER": stages, "FOLD": fold}, golden, golden, golden, vectors, None,
            lobe_latency(stages, fold) - 2, fold, chunk=FEW,
        )  # fmt: skip


def _fresnel(form: str) -> Iterator[Case]:
    """Fresnel's factor: any pair, and every cosine for sixteen materials."""

    def golden(i: Arrays) -> Arrays:
        return {"f_o": light.fresnel(i["c_i"], i["f0_i"])}

    def exact(i: Arrays) -> Arrays:
        c, f0 = (np.minimum(i[name].astype(Real) / ONE, 1) for name in ("c_i", "f0_i"))
        return {"f_o": (f0 + (1 - f0) * (1 - c) ** 5) * ONE}

    def materials() -> Iterator[Arrays]:
        for inputs in every({"c_i": (0, 2 * ONE - 1), "f0_i": (0, 15)})():
            yield inputs | {"f0_i": inputs["f0_i"] ** 4 * ONE // 15**4}

    ranges = dict.fromkeys(("c_i", "f0_i"), (0, ONE + 16))
    for vectors, everything in ((mixed(ranges, ONE - 1, ONE, ONE + 1), None), (None, materials)):
        yield Case("shade_fresnel", form, {}, golden, exact, exact, vectors, everything, k.LATENCY_FRESNEL, bound=1)


def _colour(form: str) -> Iterator[Case]:
    """Weighted light of a pixel."""
    names = [f"colour_i.{name}.{c}" for name in ("ambient", "kd", "ks") for c in "rgb"]
    lit = ("light_i.diffuse", "light_i.specular")
    pixel = ("pixel_o.red", "pixel_o.green", "pixel_o.blue")

    def terms(i: Arrays) -> list[np.ndarray]:
        return [*(i[name] for name in lit), *np.stack([i[name] for name in names]).reshape(3, 3, -1)]

    def golden(i: Arrays) -> Arrays:
        return dict(zip(pixel, light.colour(*terms(i)), strict=True))

    def exact(i: Arrays) -> Arrays:
        diffuse, specular, *weights = terms(i)
        ambient, kd, ks = (weight.astype(Real) / ONE for weight in weights)
        sums = ambient * ONE + kd * diffuse.clip(0) + ks * specular.clip(0)
        return dict(zip(pixel, sums.clip(0, ONE - 1), strict=True))

    def vectors(rng: np.random.Generator, rows: int) -> Arrays:
        lights = mixed(dict.fromkeys(lit, LIMITS), ONE, -ONE)(rng, rows)
        weights = mixed(dict.fromkeys(names, (0, 2 * ONE - 1)), ONE)(rng, rows)
        darker = rng.integers(0, 4, rows)  # fewer sums that saturate
        return lights | {name: value >> darker for name, value in weights.items()}

    yield Case("shade_colour", form, {}, golden, exact, exact, vectors, None, k.LATENCY_COLOUR, unit_f=k.PIXEL_W)


def cases() -> Iterator[Case]:
    """All cases of ``rtl/light``."""
    yield from in_forms(_versine)
    yield from in_forms(_directions, only="refined")
    yield from in_forms(_lobe)
    yield from in_forms(_lobe_folded, _fresnel, _colour, only="refined")
