# SPDX-License-Identifier: Apache-2.0
"""Light at a node in exact numbers: its formulas, of vectors and registers as they are, and of true unit vectors.

:func:`allowed` is what the integer model may be away from them, vector by vector: each rounding times what the
formula makes of it.
"""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import light, material
from polyshade.sim.units.case import ONE, Arrays, Real, signed_range
from polyshade.sim.units.light import exact_lobe

CODES = range(1 << k.MODEL_W)  # reserved ones too
DARK = (k.MODEL_LAMBERT, *CODES[k.MODEL_WARD + 1 :])  # without specular light
PHYSICAL = (k.MODEL_COOK_TORRANCE, k.MODEL_WARD)
LIMITS = signed_range(k.INTENSITY_W)
SAFE = ONE >> 4  # N.L and N.V from which on quotients are compared: they grow without limit towards 0


def quotients(code: int, x, nl, nv, vh, cosine: int, inv_n: int, inv_n_exp: int) -> np.ndarray:
    """g of ``golden.light.geometry`` from numbers, by the models' formulas; 0 where a denominator is 0."""
    nh, n = np.maximum(1 - x, 0), np.ldexp(Real(ONE), inv_n_exp) / max(inv_n, 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        if code == k.MODEL_SCHLICK:
            g = nh / (n * np.minimum(x, 2) + nh)
        elif code == k.MODEL_COOK_TORRANCE:
            shares = [np.where(vh > 0, 2 * nh * c / vh, 1) for c in (nl, nv)]
            g = np.minimum(1, np.minimum(*shares)) / (nl * nv)
        elif code == k.MODEL_WARD:
            g = 1 / np.sqrt(nl * nv)
        elif code in (k.MODEL_PHONG, k.MODEL_BLINN):
            g = nl if cosine else np.ones_like(x)
        else:
            g = np.zeros_like(x)
    return np.where(np.isfinite(g), g, 0)


def outputs(diffuse, specular, flags) -> Arrays:
    """Light and flags by port."""
    told = {f"flags_o.{name}": flags >> bit & 1 for bit, name in enumerate(("model", "range", "zero", "saturated"))}
    return {"light_o.diffuse": diffuse, "light_o.specular": specular} | told


def in_units(value: np.ndarray, exact: np.ndarray, unit: np.ndarray) -> np.ndarray:
    """What stands for the exact value where an error counts in so many ulp."""
    return value + (exact - value) / unit


def exact_light(code: int, material_: dict[str, int], golden: Arrays, n, l, v, h, vh, fresnel, form: str) -> Arrays:  # noqa: E741
    """The formulas of the vectors and registers as they are; flags of the golden model.

    The quotients of Cook-Torrance and Ward turn a last bit of N.L and N.V into any number of them where these are near
    0: what is below 1/16 does not count, nor what the golden model tells to have no light.
    """
    diffuse = {"light_o.diffuse": cosine(n, l) * ONE}
    if code in DARK:
        return golden | diffuse | {"light_o.specular": np.zeros(golden["light_o.specular"].shape)}
    t = _terms(code, material_, n, l, v, h, vh, fresnel, form)
    value = (t.shape * t.g * t.gain * ONE).clip(0, LIMITS[1])
    return golden | diffuse | {"light_o.specular": np.where(_clear(code, golden, t), value, golden["light_o.specular"])}


def _clear(code: int, golden: Arrays, t: SimpleNamespace) -> np.ndarray:
    clear = golden["flags_o.zero"] == 0
    return clear & (t.nl >= SAFE / ONE) & (t.nv >= SAFE / ONE) if code in PHYSICAL else clear


def _terms(code: int, material_: dict[str, int], n, l, v, h, vh, fresnel, form: str) -> SimpleNamespace:  # noqa: E741
    """The parts of the formula, as numbers: light = shape g gain, and what x is the versine of."""
    n, l, v, h = (np.asarray(u, Real) / ONE for u in (n, l, v, h))  # noqa: E741
    nl, nv = total(n, l), total(n, v)
    a, b = n, h
    if code == k.MODEL_PHONG:
        lowest, highest = (limit / ONE for limit in LIMITS)
        a, b = ((2 * nl).clip(-highest, 2) * n - l).clip(lowest, highest), v
    chord = ((a - b) * ONE).clip(*LIMITS) / ONE
    x = (total(chord, chord) / 2 if form == "refined" else 1 - total(a, b)).clip(0, 2)
    nl, nv, vh = nl.clip(0, 1), nv.clip(0, 1), np.asarray(vh, Real) / ONE
    g = quotients(code, x, nl, nv, vh, *(material_[name] for name in ("cosine", "inv_n", "inv_n_exp")))
    shape = np.ones_like(x) if code == k.MODEL_SCHLICK else _lobe(x, material_)
    gain = np.ldexp(Real(material_["gain"]), material_["gain_exp"] - k.GAIN_F) * np.asarray(fresnel, Real) / ONE
    return SimpleNamespace(n=n, nl=nl, nv=nv, vh=vh, a=a, b=b, chord=chord, x=x, shape=shape, g=g, gain=gain)


def _lobe(x: np.ndarray, material_: dict[str, int]) -> np.ndarray:
    words = {name: material_[name] for name in light.LOBE}
    return exact_lobe(np.ldexp(x, k.VERSINE_F), **words | {"power": min(words["power"], material.STAGES)})


def _slope(x: np.ndarray, material_: dict[str, int]) -> np.ndarray:
    """How fast the lobe falls at x, as a number."""
    scale = {k.LOBE_FINE: (1, 1 / 4, 1 / 4)}.get(material_["shift"], [2 ** (i * material_["shift"]) for i in (1, 1, 2)])
    power = min(material_["power"], material.STAGES)
    limit = Real(material_["xmax"]) / (1 << k.LOBE_X_F) / scale[0]
    k1, k2 = (Real(material_[f"k{i}"]) / (1 << f) * scale[i] for i, f in ((1, k.LOBE_K1_F), (2, k.LOBE_K2_F)))
    base = (1 - k1 * x + k2 * x * x).clip(0, 1)
    slope = 2**power * base ** (2**power - 1) * np.maximum(k1 - 2 * k2 * x, 0)
    return np.where((x > limit) | (x > 1), 0, slope)


def reflection_error(n: np.ndarray, along: np.ndarray) -> np.ndarray:
    """How far R's rounding can take R . along, in ulp: m's half ulp times N, and a half in each component."""
    return (np.abs(total(n, along)) + np.abs(along).sum(axis=0)) / 2


def allowed(
    code: int, material_: dict[str, int], n, l, v, h, vh, fresnel, form: str, f0: int | None = None,  # noqa: E741
) -> np.ndarray:  # fmt: skip
    """What specular light may be wrong by, in ulp. ``f0``: H, V.H and Fresnel's factor were computed of L and V.

    x is rounded once, by half a last place of the X that the lobe takes. Each component of R has
    m's half ulp times N's and a half ulp of its own, those of H 5/8. The lobe is within 1.5 ulp, num (1 + w) within 1.8
    ulp of num, N.L and N.V within half an ulp; the gain's factor is rounded where w is not 0.
    """
    if code in DARK:
        return np.zeros(())
    t = _terms(code, material_, n, l, v, h, vh, fresnel, form)
    refined, local = form == "refined", f0 is not None

    shift = 0 if material_["shift"] == k.LOBE_FINE else material_["shift"]
    if code == k.MODEL_SCHLICK:
        shift = material_["inv_n_exp"]
    dx = np.ldexp(1.0, k.INTENSITY_F - 1 - min(k.LOBE_SCALED_F + shift, k.VERSINE_F))
    if code == k.MODEL_PHONG:
        along = t.chord if refined else t.b
        dx = dx + reflection_error(t.n, along)
    elif local:
        dx = dx + 5 / 8 * np.abs(t.chord if refined else t.n).sum(axis=0)
    nearer = (t.x - dx / ONE).clip(0)

    with np.errstate(divide="ignore", invalid="ignore"):
        dvh = 1.6 * np.sqrt(total(*[np.asarray(v, Real) / ONE] * 2)) if local else 0
        each = 1 / t.nl + 1 / t.nv
        dg, num = {
            k.MODEL_COOK_TORRANCE: (t.g * (each / 2 + dvh / t.vh + dx / (1 - t.x)), 1),
            k.MODEL_WARD: (t.g * each / 4, 1),
        }.get(code, (material_["cosine"] / 2, None))
        if code == k.MODEL_SCHLICK:
            inv_n = np.ldexp(Real(material_["inv_n"]) / ONE, -material_["inv_n_exp"])
            dg, num = inv_n * dx / (nearer + (1 - nearer) * inv_n) ** 2, (1 - t.x) * material_["inv_n"] / ONE
        elif code == k.MODEL_COOK_TORRANCE:
            small = np.minimum(t.nl, t.nv)
            num = np.where(2 * (1 - t.x) * small < t.vh, 1 - t.x, 1)  # masked
        dg = np.where(t.g > 0, dg + (0 if num is None else 1.8 * t.g / num), 0)
        lobe = (
            0 if code == k.MODEL_SCHLICK else 1.5 + dx * np.maximum(_slope(nearer, material_), _slope(t.x, material_))
        )
    error = t.gain * (t.g * lobe + t.shape * dg)
    if local:  # Fresnel's factor within 1 ulp of that of V.H
        factor = t.gain / (np.asarray(fresnel, Real) / ONE)
        error = error + factor * t.g * t.shape * (1 + 5 * (1 - f0 / ONE) * dvh)
    edge = np.abs(t.x - 1) <= (dx + 1 / 16) / ONE  # the lobe ends there, at whatever it has
    error = error + np.where(edge, t.gain * t.g * _lobe(np.ones_like(t.x), material_) * ONE, 0)
    # light of 2 or more is 2: there is no error beyond
    light_ = (t.shape * t.g * t.gain).clip(0, 2)
    return error * (1 + 2.0**-10) + 1 / 2 + 1 / 64 + (0 if num is None else light_)


def ideal_light(code: int, material_: dict[str, int], golden: Arrays, n, l, v, h, vh, fresnel, form: str) -> Arrays:  # noqa: E741
    """The formulas of the *true* unit vectors, with the lobe that the registers stand for.

    Where N is no unit vector, or N.L or N.V is below 1/16, those of :func:`exact_light`.
    """
    rounded = exact_light(code, material_, golden, n, l, v, h, vh, fresnel, form)
    if code in DARK:
        return rounded
    lengths = [np.sqrt(np.sum(np.square(np.asarray(vector, Real)), axis=0)) for vector in (n, l, v, h)]
    clear = np.abs(lengths[0] / ONE - 1) < 2 / ONE
    n, l, v, h = (np.asarray(u, Real) / np.maximum(length, 1) for u, length in zip((n, l, v, h), lengths, strict=True))  # noqa: E741
    nl, nv, nh, vh = total(n, l), total(n, v), total(n, h), total(v, h)
    clear = clear & (nl >= SAFE / ONE) & (nv >= SAFE / ONE) & (vh > 0)
    nl, nv, vh = (np.where(clear, c, 1) for c in (nl, nv, vh))
    x = 1 - (2 * nl * total(n, v) - total(l, v) if code == k.MODEL_PHONG else nh)
    g = {
        k.MODEL_COOK_TORRANCE: lambda: np.minimum(1, 2 * nh.clip(0) * np.minimum(nl, nv) / vh) / (nl * nv),
        k.MODEL_WARD: lambda: 1 / np.sqrt(nl * nv),
    }.get(code, lambda: np.where(material_["cosine"], nl, 1))()
    if code == k.MODEL_SCHLICK:
        shape = nh.clip(0) / (x / (material_["inv_n"] / ONE) * 2.0 ** material_["inv_n_exp"] + nh.clip(0))
    else:
        shape = _lobe(x, material_)
    value = shape * g * fresnel * np.ldexp(Real(material_["gain"]), material_["gain_exp"] - k.GAIN_F)
    specular = np.where(clear, value.clip(0, LIMITS[1]), rounded["light_o.specular"])
    return rounded | {"light_o.specular": specular}


def total(a, b) -> np.ndarray:
    """The dot product."""
    return np.sum(np.asarray(a) * np.asarray(b), axis=0)


def cosine(a, b) -> np.ndarray:
    """The dot product of two vectors S1.16, limited to what S1.16 holds, as a number."""
    return (total(np.asarray(a, Real), b) / ONE).clip(*LIMITS) / ONE
