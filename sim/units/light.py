"""Light at a node: angles, directions, highlights, Fresnel's factor, colours."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import light, material
from polyshade.sim.units.case import FORMS, ONE, Arrays, Case, Real, every, in_forms, mixed, signed_range
from polyshade.sim.units.normal import ends

LIMITS = signed_range(k.INTENSITY_W)


def _two(i: Arrays) -> tuple[np.ndarray, np.ndarray]:
    """The two vectors (3, rows) that the inputs begin with, as numbers."""
    v = np.stack(list(i.values())[:6]).astype(Real) / ONE
    return v[:3], v[3:]


def _versine(form: str) -> Iterator[Case]:
    """1 - cos of an angle; ideal: of the true angle, where that is acute, of unit vectors but for their rounding."""

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

    yield Case(
        "shade_versine", form, {"FORM": FORMS[form]}, golden, exact, ideal, ends(), None, k.LATENCY_VERSINE,
        unit_f=k.VERSINE_F,
    )  # fmt: skip


def _directions(form: str) -> Iterator[Case]:
    """Where a mirror sends light, and the direction halfway between light and viewer."""
    if form != "refined":
        return

    def reflected(i: Arrays) -> Arrays:
        return dict(zip(("x_o", "y_o", "z_o"), light.reflect(*i.values()), strict=True))

    def mirror(i: Arrays) -> Arrays:
        n, l = _two(i)  # noqa: E741
        twice = 2 * (n * l).sum(axis=0)
        r = (twice.clip(-LIMITS[1] / ONE, 2) * n - l) * ONE
        return dict(zip(("x_o", "y_o", "z_o"), r.clip(*LIMITS), strict=True))

    yield Case("shade_reflect", form, {}, reflected, mirror, mirror, ends("nl"), None, k.LATENCY_REFLECT)

    def golden(i: Arrays) -> Arrays:
        return dict(zip(("hx_o", "hy_o", "hz_o", "vh_o", "zero_o"), light.halfway(*i.values()), strict=True))

    def halfway(i: Arrays) -> Arrays:
        l, v = _two(i)  # noqa: E741
        s = ((l + v) * ONE).clip(*LIMITS)
        length = np.sqrt((s * s).sum(axis=0))
        h = s / np.where(length == 0, 1, length)
        values = (*(h * ONE), ((v * h).sum(axis=0) * ONE).clip(0, ONE))
        return golden(i) | dict(zip(("hx_o", "hy_o", "hz_o", "vh_o"), values, strict=True))

    yield Case("shade_halfway", form, {}, golden, halfway, halfway, ends("lv"), None, k.LATENCY_HALFWAY)


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


def _lobe(form: str) -> Iterator[Case]:
    """Every cosine for 41 highlights, one after the other: registers stay as they are while values are in flight."""

    def case(stages: int, fold: int, latency: int) -> Case:
        highlights = _highlights(form, stages)

        def vectors() -> Iterator[Arrays]:
            x = (ONE - np.arange(ONE + 1)) << k.VERSINE_F - k.INTENSITY_F
            for registers in highlights:
                yield {"x_i": x} | {
                    f"{name}_i": np.full_like(x, value) for name, value in zip(light.LOBE, registers, strict=True)
                }

        def golden(i: Arrays) -> Arrays:
            return {"lobe_o": light.lobe(*(i[f"{name}_i"] for name in ("x", *light.LOBE)), stages)}

        def highlight(i: Arrays) -> tuple[np.ndarray, Highlight]:
            registers = tuple(int(i[f"{name}_i"][0]) for name in light.LOBE)
            return np.ldexp(i["x_i"].astype(Real), -k.VERSINE_F), highlights[registers]

        def exact(i: Arrays) -> Arrays:
            x, chosen = highlight(i)
            k1, k2, xmax, power = material.fit(*chosen, form, stages)
            x = np.minimum(x, xmax)
            return {"lobe_o": np.maximum(1 - k1 * x + k2 * x * x, 0) ** (1 << power) * ONE}

        def ideal(i: Arrays) -> Arrays:
            x, (model, n, m) = highlight(i)
            return {"lobe_o": material.shape(model, x, n, m) * ONE}

        return Case(
            "shade_lobe", form, {"POWER": stages, "FOLD": fold}, golden, exact, ideal, None, vectors, latency, fold
        )

    for stages in (4, 3, 2):
        less = 4 - stages
        yield case(stages, 1, k.LATENCY_LOBE - less * (k.LATENCY_SQUARE_FABRIC + 2))
        yield case(stages, 6, k.LATENCY_LOBE_FOLDED - less * (k.LATENCY_MUL + 3))


def _fresnel(form: str) -> Iterator[Case]:
    """Fresnel's factor: any pair, and every cosine for sixteen materials."""
    if form != "refined":
        return

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
        yield Case("shade_fresnel", form, {}, golden, exact, exact, vectors, everything, k.LATENCY_FRESNEL)


def _colour(form: str) -> Iterator[Case]:
    """Weighted light of a pixel."""
    if form != "refined":
        return
    names = [f"{name}_{c}_i" for name in ("ambient", "kd", "ks") for c in "rgb"]

    def terms(i: Arrays) -> list[np.ndarray]:
        return [i["diffuse_i"], i["specular_i"], *np.stack([i[name] for name in names]).reshape(3, 3, -1)]

    def golden(i: Arrays) -> Arrays:
        return dict(zip(("r_o", "g_o", "b_o"), light.colour(*terms(i)), strict=True))

    def exact(i: Arrays) -> Arrays:
        diffuse, specular, *weights = terms(i)
        ambient, kd, ks = (weight.astype(Real) / ONE for weight in weights)
        sums = ambient * ONE + kd * diffuse.clip(0) + ks * specular.clip(0)
        return dict(zip(("r_o", "g_o", "b_o"), sums.clip(0, ONE - 1), strict=True))

    def vectors(rng: np.random.Generator, rows: int) -> Arrays:
        lights = mixed(dict.fromkeys(("diffuse_i", "specular_i"), LIMITS), ONE, -ONE)(rng, rows)
        weights = mixed(dict.fromkeys(names, (0, 2 * ONE - 1)), ONE)(rng, rows)
        darker = rng.integers(0, 4, rows)  # fewer sums that saturate
        return lights | {name: value >> darker for name, value in weights.items()}

    yield Case("shade_colour", form, {}, golden, exact, exact, vectors, None, k.LATENCY_COLOUR, unit_f=k.PIXEL_W)


def cases() -> Iterator[Case]:
    """All cases of ``rtl/light``."""
    return in_forms(_versine, _directions, _lobe, _fresnel, _colour)
