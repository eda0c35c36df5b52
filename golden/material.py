# SPDX-License-Identifier: Apache-2.0
"""Material and light: physical parameters into the register values of ``shade_light`` and ``shade_light_local``.

Parameters out of range raise ValueError with one line: the parameter, the cause, the range.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from math import floor, log2, pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import contract as k
from . import direct
from .fixed import ONE
from .plan import quantize_sharpness
from .reference import light as reference

MODELS = {name: getattr(k, "MODEL_" + name.upper().replace("-", "_")) for name in reference.MODELS}
FORMS = {"paper": k.FORM_PAPER, "refined": k.FORM_REFINED}
RANGES = {
    "shininess": (1.0, 1024.0),
    "roughness": (0.05, 0.7),
    "f0": (0.0, 1.0),
    "exposure": (1e-6, 1e6),
    "ambient": (0.0, 1.0),
    "diffuse": (0.0, 1.0),
    "specular": (0.0, 1.0),
    "colour": (0.0, 1.0),
    "highlight": (0.0, 1.0),
}
DIRECT_MODELS = ("lambert", "blinn", "schlick")  # of the direct form
STAGES = 4  # squarings of the lobe at most
EXACT = 1e-9  # an error of the fit that is none
ENERGY_MARGIN = 1 / 4096  # what quantization may add to a lobe's energy, so that it never exceeds 1
FRESNEL_MIN = 1 / 256  # automatic exposure makes up for no less, nor for a V.H below HALF_MIN
HALF_MIN = 1 / 16


@dataclass(frozen=True)
class Material:
    """What a surface is made of. ValueError for a value out of range or unknown.

    ``shininess`` n: phong, blinn, schlick. ``roughness`` m: cook-torrance, ward. ``f0``: reflectance at normal
    incidence, cook-torrance. ``energy``: "none" or a row of P3's Table 1 that belongs to the model. ``exposure``: a
    factor on the specular light, or "auto": 1 for phong, blinn and schlick without energy row; else such that the
    specular light at N = H is 1 (phong, blinn) or 1/2 (cook-torrance, ward: head room for grazing angles).
    ``ambient``, ``diffuse``, ``specular``: weights; the first two are multiplied by ``colour``, the last by
    ``highlight``.
    """

    model: str = "blinn"
    shininess: float = 32.0
    roughness: float = 0.3
    f0: float = 0.04
    energy: str = "none"
    exposure: float | str = "auto"
    form: str = "refined"
    ambient: float = 0.10
    diffuse: float = 0.80
    specular: float = 0.35
    colour: tuple[float, float, float] = (0.93, 0.70, 0.58)
    highlight: tuple[float, float, float] = (1.0, 1.0, 1.0)

    def __post_init__(self) -> None:
        rows = ["none", *(row for row in reference.ROWS if row.partition("-")[0] == self.model)]
        for name, allowed in {"model": MODELS, "form": FORMS, "energy": rows}.items():
            if getattr(self, name) not in allowed:
                raise ValueError(f"{name}: {getattr(self, name)!r} is none of {', '.join(allowed)}")
        for name, (low, high) in RANGES.items():
            value = getattr(self, name)
            parts = np.ravel(np.asarray(value, object)).tolist()
            count = 3 if name in ("colour", "highlight") else 1
            if len(parts) != count:
                raise ValueError(
                    f"{name}: {value} has {len(parts)} parts, allowed are {count}, each {low:g} to {high:g}"
                )
            numbers = all(isinstance(part, int | float) and low <= part <= high for part in parts)  # refuses NaN
            if not numbers and (name, value) != ("exposure", "auto"):
                raise ValueError(f"{name}: {value} is out of range, allowed is {low:g} to {high:g}")

    @property
    def cosine(self) -> bool:
        """Is specular light multiplied by N.L: the modified rows."""
        return self.energy.endswith("-modified")

    def scale(self, light: ArrayLike | None = None, *, original: bool = False) -> float:
        """Exposure times energy scale, by which shape and Fresnel's factor are multiplied.

        ``light``: direction, for automatic exposure; None: as for a light from the viewer. ``original``: of the
        original model, whatever the form.
        """
        vh = 1 if light is None else max(float(reference.halfway(light)[2]), HALF_MIN)
        if self.model in ("cook-torrance", "ward"):
            if self.exposure != "auto":
                return self.exposure / (4 * pi * self.roughness**2)
            if self.model == "ward":
                return vh / 2
            return vh**2 / 2 / max(float(reference.fresnel(vh, self.f0)), FRESNEL_MIN)
        if self.exposure == "auto":
            return 1 / vh if self.cosine else 1
        if self.energy == "none":
            return self.exposure
        if self.form == "paper" and not original:
            return self.exposure * reference.energy_scale(self.energy, self.shininess, "paper")
        scale = reference.energy_scale(self.energy, self.shininess)
        return self.exposure * (scale if original else scale / _excess(self.energy, self.shininess))

    @property
    def lobe(self) -> tuple[float, float, float, int] | None:
        """(k1, k2, xmax, power) of the lobe that stands for the highlight; None where it is not of that kind."""
        has_lobe = self.model not in ("lambert", "schlick")
        return fit(self.model, self.shininess, self.roughness, self.form) if has_lobe else None

    def channels(
        self,
        normal: ArrayLike,
        light: ArrayLike,
        *,
        view: ArrayLike | None = None,
        as_given: bool = False,
        fitted: bool = False,
    ) -> reference.Floats:
        """(..., 2): diffuse (unclamped) and specular light of the *original* model in float64.

        ``view`` None: viewer at infinity, directional light; else light and viewer of every point, and the exposure of
        ``scale()``. ``fitted``: with the lobe and the energy scale of the form in place of the original ones.
        """
        scale = self.scale(light if view is None else None, original=not fitted)
        lobe = self.lobe if fitted else None
        if self.model in ("cook-torrance", "ward"):  # scale holds what the reference has of its own
            scale *= 4 * pi * self.roughness**2
        return reference.light_channels(
            self.model,
            normal,
            light,
            self.shininess,
            roughness=self.roughness,
            f0=self.f0,
            scale=scale,
            cosine=self.cosine,
            shape=lobe and (lambda c: reference.lobe(c, *lobe)),
            view=reference.VIEW if view is None else view,
            as_given=as_given,
        )


def shape(model: str, x: ArrayLike, shininess: float, roughness: float) -> reference.Floats:
    """The highlight that the lobe stands for, over x = 1 - c, divided by its peak."""
    c = 1 - np.asarray(x, float)
    if model == "cook-torrance":
        return 4 * roughness**2 * reference.beckmann(c, roughness)
    return reference.ward_lobe(c, roughness) if model == "ward" else reference.cosine_power(c, shininess)


@cache
def fit(
    model: str, shininess: float = 1, roughness: float = 0.3, form: str = "refined", stages: int = STAGES
) -> tuple[float, float, float, int]:
    """(k1, k2, xmax, power) of max(0, 1 - k1 x + k2 x^2)^(2^power), x = min(1 - c, xmax), for a model's highlight.

    paper: what P1 and P3 print, k2 = 0, power = ``stages``. refined: the least maximal error over the whole lobe of all
    powers 0 .. ``stages``; of several exact ones the highest. Each by Remez' exchange on a grid: Newton's step to an
    error of equal size and alternating sign at three points, then the extremes of the new error are the points. Beyond
    the vertex of a parabola that opens upwards x stays: xmax = k1 / (2 k2); no limit is 1. k1 stays >= 0.

    >>> fit("blinn", 64, form="paper")
    (4.0, 0.0, 1.0, 4)
    >>> [round(value, 3) for value in fit("blinn", 64)]
    [3.998, 5.768, 0.347, 4]
    """
    exponent = {"cook-torrance": 2 / roughness**2 - 4, "ward": 2 / roughness**2}.get(model, shininess)
    if form == "paper":
        return exponent / 2**stages, 0.0, 1.0, stages
    x = np.linspace(0, min(1, 24 / max(exponent, 1)), 4097)[1:]  # beyond it the lobe is below exp(-24)
    target = shape(model, x, shininess, roughness)
    fits = []
    for power in range(stages + 1):
        error, k1, k2 = _minimax(x, target, 1 << power, [0, 1])
        if k1 < 0:
            error, k1, k2 = _minimax(x, target, 1 << power, [1])
        fits.append((max(error, EXACT), -power, k1, k2))
    _, minus_power, k1, k2 = min(fits)
    return k1, k2, min(1.0, k1 / (2 * k2)) if k2 > 0 else 1.0, -minus_power


def _minimax(x: reference.Floats, target: reference.Floats, p: int, free: list[int]) -> tuple[float, float, float]:
    """The least maximal error of (1 - k1 x + k2 x^2)^p with its k1, k2: those that are ``free``; others 0."""
    at = [int(np.abs(target - value).argmin()) for value in (0.45, 0.05)[: len(free)]]
    k12, best = np.zeros(2), (np.inf, 0.0, 0.0)
    k12[free] = np.linalg.solve(_powers(x[at], k12)[:, free], target[at] ** (1 / p) - 1)  # no error at these points
    for _ in range(20):
        powers = _powers(x, k12)
        base = np.maximum(1 + powers @ k12, 0)
        error = base**p - target
        largest = float(np.abs(error).max())
        best = min(best, (largest, *k12.tolist()))
        runs = np.split(np.arange(len(x)), np.flatnonzero(np.diff(error > 0)) + 1)
        peaks = np.array([run[np.abs(error[run]).argmax()] for run in runs])
        spare = len(peaks) - len(free)
        if largest < EXACT or spare <= 0:
            break
        sizes = np.abs(error[peaks])  # neighbours, the largest of all among them; of several such those of most error
        start = max(
            range(spare), key=lambda i: (sizes[i : i + len(free) + 1].max(), sizes[i : i + len(free) + 1].min())
        )
        at = peaks[start : start + len(free) + 1]
        slopes = p * base[at, None] ** (p - 1) * powers[at][:, free]
        k12[free] += np.linalg.solve(np.column_stack([slopes, -np.sign(error[at])]), -error[at])[:-1]
    return best


def _powers(x: reference.Floats, k12: reference.Floats) -> reference.Floats:
    """(P, 2): what k1 and k2 are multiplied by, -x and x^2, x limited to the vertex."""
    x = np.minimum(x, k12[0] / (2 * k12[1])) if k12[1] > 0 else x
    return np.stack([-x, x**2], axis=-1)


@cache
def _excess(row: str, n: float) -> float:
    """By how much the fitted lobe has more energy than cos^n, at least 1, and the margin for its quantization.

    To 16 fraction bits: what is left beyond the vertex, 3e-6 for n = 1024, would fill the hemisphere with 0.3 %.
    """
    cosines = np.linspace(0, 1, ONE + 1)
    lobe = np.rint(reference.lobe(cosines, *fit(row.partition("-")[0], n)) * ONE) / ONE
    energy = reference.energy_scale(row, n) * reference.hemisphere(row, cosines, lobe)
    return max(energy, 1.0) * (1 + ENERGY_MARGIN)


def lobe_registers(k1: float, k2: float, xmax: float, power: int) -> dict[str, int]:
    """k1, k2, shift, xmax, power of ``shade_lobe``: X = x 2^shift, K1 = k1 / 2^shift, K2 = k2 / 4^shift.

    The first of LOBE_FINE (X = x, K1 = 4 k1, K2 = 4 k2), 0, 1, .. 6 by which K1 < 2, |K2| < 1 and K1 - K2 X < 2 up to
    the largest X, U1.16. ValueError where there is none.

    >>> lobe_registers(2, 1, 1, 4)  # n = 32: K1 = 1, K2 = 1/4, X < 2
    {'k1': 1048576, 'k2': 32768, 'shift': 1, 'xmax': 131071, 'power': 4}
    """
    fine = 2**k.LOBE_FINE_F
    scales = {k.LOBE_FINE: (1, fine, fine)} | {i: (2**i, 2**-i, 4**-i) for i in range(k.LOBE_FINE)}
    for shift, (for_x, for_k1, for_k2) in scales.items():
        largest = min(_fixed(xmax * for_x, k.LOBE_X_F), (2 << k.LOBE_X_F) - 1)
        codes = _fixed(k1 * for_k1, k.LOBE_K1_F), _fixed(k2 * for_k2, k.LOBE_K2_F)
        steepest = codes[0] / 2**k.LOBE_K1_F - min(codes[1], 0) / 2**k.LOBE_K2_F * largest / 2**k.LOBE_X_F
        if steepest < 2 and abs(codes[1]) < 1 << k.LOBE_K2_F:
            return {"k1": codes[0], "k2": codes[1], "shift": shift, "xmax": largest, "power": power}
    raise ValueError(f"k1, k2: {k1:g}, {k2:g} are out of range, allowed is k1 / 64 < 2, |k2| / 4096 < 1")


def registers(material: Material, light: ArrayLike | None = None) -> dict[str, int]:
    """Register values by the names of ``shade_reflectance``'s ports, without ``_i``.

    ``light``: direction of a light; Fresnel's factor of its V.H is then a part of the gain, and ``light_registers`` are
    added (``shade_light``). None: light and viewer of every point (``shade_light_local``).

    >>> words = registers(Material(shininess=64), (0, 0, 1))
    >>> [words[name] for name in ("model", "k1", "k2", "shift", "xmax", "power", "gain", "gain_exp")]
    [2, 1047945, 47254, 2, 90837, 4, 65536, 0]
    """
    inv_n_exp = floor(log2(material.shininess))
    inv_n = _fixed(2**inv_n_exp / material.shininess)
    if inv_n == ONE // 2:
        inv_n, inv_n_exp = ONE, inv_n_exp + 1
    gain = material.scale(light) if material.model != "lambert" else 0.0
    f0 = material.f0 if material.model == "cook-torrance" else 1.0
    words = {
        "model": MODELS[material.model],
        "cosine": int(material.cosine),
        **lobe_registers(*material.lobe or (0, 0, 1, STAGES)),
    }
    words |= {"inv_n": inv_n, "inv_n_exp": inv_n_exp, "f0": _fixed(f0)}
    if light is not None:
        words |= light_registers(light)
        gain *= float(reference.fresnel(reference.halfway(light)[2], f0))
    return words | dict(zip(("gain", "gain_exp"), _floating(gain), strict=True))


def light_registers(light: ArrayLike) -> dict[str, int]:
    """lx, ly, lz of L, hx, hy, hz of H = (L + V)/|L + V|, S1.16 to nearest, and vh = V.H, U1.16, for V = (0, 0, 1).

    H and vh are 0 where L, as quantized, is -V. ValueError for a vector that is no direction.

    >>> light_registers((0, 3, 4))
    {'lx': 0, 'ly': 39322, 'lz': 52429, 'hx': 0, 'hy': 20724, 'hz': 62173, 'vh': 62173}
    """
    vector = np.asarray(light, float)
    if vector.shape != (3,) or not 1e-6 <= np.abs(vector).max() <= 1e6:  # also refuses NaN
        raise ValueError(f"light: {light} is no direction, allowed is 1e-06 to 1e+06 for the longest of three parts")
    towards = [_fixed(part) for part in reference.unit(vector)]
    behind = towards == [0, 0, -ONE]
    half = [0 if behind else _fixed(part) for part in reference.halfway(vector)]
    return dict(zip(("lx", "ly", "lz", "hx", "hy", "hz", "vh"), (*towards, *half, half[2]), strict=True))


def planner_registers(material: Material) -> dict[str, int]:
    """sharpness, U1.16 in [1, 2), sharpness_exp, 0 .. 12, and weight of the planner.

    Blinn-Phong's highlight alone is dark where N.H is small; in the paper's form there is no weight.

    >>> planner_registers(Material("phong", 48))  # 4 n = 192 = 1.5 * 2^7
    {'sharpness': 98304, 'sharpness_exp': 7, 'weight': 0}
    """
    sharpness = reference.sharpness(material.model, material.shininess, material.roughness)
    mantissa, exponent = quantize_sharpness(sharpness)
    weighed = material.model == "blinn" and material.form == "refined"
    return {"sharpness": mantissa, "sharpness_exp": exponent, "weight": k.WEIGHT if weighed else 0}


def colour_registers(material: Material) -> dict[str, int]:
    """Weights of ``shade_colour``, U1.16: ambient_r .. ambient_b, kd_r .. kd_b, ks_r .. ks_b.

    >>> colour_registers(Material(colour=(1, 1, 1), ambient=0.5))["ambient_g"]
    32768
    """
    weights = {
        "ambient": (material.ambient, material.colour),
        "kd": (material.diffuse, material.colour),
        "ks": (material.specular, material.highlight),
    }
    return {
        f"{name}_{letter}": _fixed(weight * part)
        for name, (weight, colour) in weights.items()
        for letter, part in zip("rgb", colour, strict=True)
    }


def _fixed(value: float, f: int = k.INTENSITY_F) -> int:
    """To nearest, ties up."""
    return floor(float(value) * 2**f + 0.5)


def _floating(value: float) -> tuple[int, int]:
    """Mantissa U1.16 in [1, 2) and exponent; (0, 0) for what is too small for the exponent."""
    if value < 2.0 ** -(1 << k.GAIN_EXP_W - 1):
        return 0, 0
    exponent = floor(log2(value))
    mantissa = _fixed(value / 2.0**exponent, k.GAIN_F)
    return (mantissa, exponent) if mantissa < 2 << k.GAIN_F else (1 << k.GAIN_F, exponent + 1)


def chords(material: Material, light: ArrayLike) -> direct.Lobe:
    """The table of the direct form: specular light of lambert, blinn and schlick over x = 1 - N.H, as chords.

    ``shift`` is the largest with which nothing above a quarter of an ulp is left out, and every slope fits. ValueError
    for models whose light is no function of N.H alone.

    >>> table = chords(Material(shininess=32), (0, 0, 1))
    >>> table.shift, table.value[[0, 512]].tolist(), table.excess
    (1, [65536, 7], 0)
    """
    if material.model not in DIRECT_MODELS or material.cosine:
        allowed = ", ".join(DIRECT_MODELS)
        raise ValueError(f"model: {material.model} is no function of N.H alone, allowed are {allowed} without N.L")
    scale = material.scale(light) if material.model != "lambert" else 0.0
    top = (1 << k.CHORD_SLOPE_W - 1) - 1

    def at(x: NDArray) -> NDArray:
        if material.model == "schlick":
            c = 1 - x
            n = material.shininess
            return np.minimum(scale * np.maximum(c, 0) / (n - n * c + c), 1)
        return np.minimum(scale * np.maximum(1 - x, 0) ** material.shininess, 1)

    for shift in range((1 << k.CHORD_SHIFT_W) - 1, -1, -1):
        exact = at(np.arange(1025) / 1024 / 2**shift)
        value = np.rint(exact * ONE).astype(np.int64)
        slope = np.rint(exact[1:] * (1 << k.CHORD_SLOPE_F)).astype(np.int64)
        slope -= value[:-1] << k.CHORD_SLOPE_F - k.INTENSITY_F
        if shift == 0 or (exact[-1] < 2.0**-18 and np.abs(slope).max() <= top):
            break
    words = light_registers(light)
    length = sum(words[f"h{axis}"] ** 2 for axis in "xyz") ** 0.5
    excess = round((length / ONE - 1) * 2**k.DIRECT_X_F) if length else 0
    return direct.Lobe(value[:-1], slope.clip(-top - 1, top), shift, excess)
