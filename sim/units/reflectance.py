# SPDX-License-Identifier: Apache-2.0
"""Light at a node in six models: its angles, quotients and gain, and the whole.

Settings hold for a run: each has a material of its own, so that half a million vectors see twenty of each model.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import light, material, normal
from polyshade.golden.reference.light import ROWS
from polyshade.sim.units.case import FORMS, ONE, Arrays, Case, Real, in_forms, mixed, signed_range
from polyshade.sim.units.exact_light import (
    CODES,
    LIMITS,
    allowed,
    cosine,
    exact_light,
    ideal_light,
    in_units,
    outputs,
    quotients,
    reflection_error,
    total,
)
from polyshade.sim.units.light import FEW, SHIFTS, half_a_place
from polyshade.sim.units.normal import unit_vectors

CHUNK = 25_000
NAMES = {code: name for name, code in material.MODELS.items()}
COSINE = (0, ONE)
TWO = {"REFLECT": 0, "DIVIDE": 0}  # Lambert and Blinn
FOLDS = (6, *range(2, 6), 8, 7)  # the first and the last in the default run


def registers(rng: np.random.Generator, code: int, form: str, direction=None) -> dict[str, int]:
    """Register values of a random material of a model; reserved codes have those of Blinn's."""
    name = NAMES.get(code, "blinn")
    rows = ["none", *(row for row in ROWS if row.partition("-")[0] == name)]
    shininess, roughness, f0 = 2 ** rng.uniform(0, 10), rng.uniform(0.05, 0.7), rng.uniform(0, 1)
    surface = material.Material(name, shininess, roughness, f0, rng.choice(rows), form=form)
    return material.registers(surface, direction) | {"model": code}


def normals(rng: np.random.Generator, rows: int, *towards: np.ndarray) -> np.ndarray:
    """(3, rows) unit vectors: all directions, close to those named and these themselves; and any components."""
    kind = rng.integers(0, 16, rows)
    aim = np.stack(np.broadcast_arrays(*(np.reshape(v, (3, -1)) for v in towards), np.zeros((3, rows)))[:-1])
    aim = aim[rng.integers(0, len(towards), rows), :, np.arange(rows)].T
    bent = aim + rng.standard_normal((3, rows)) * np.ldexp(float(ONE), -rng.integers(0, 12, rows))
    close = np.rint(bent / np.linalg.norm(bent, axis=0) * ONE)
    anything = rng.integers(*LIMITS, (3, rows), endpoint=True)
    return np.select([kind == 0, kind == 1, kind < 8], [anything, aim, close], unit_vectors(rng, rows)).astype(np.int64)


def ports(rows: int, **values) -> Arrays:
    """Values by name as inputs of so many rows: numbers, vectors (3, rows), structures by the names of their fields."""
    named = {}
    for name, value in values.items():
        parts = dict(zip("xyz", value, strict=True)) if np.ndim(value) > 1 else value
        if isinstance(parts, dict):
            named |= {f"{name}_i.{part}": np.broadcast_to(number, rows) for part, number in parts.items()}
        else:
            named[f"{name}_i"] = np.broadcast_to(value, rows)
    return named


def leaf(name: str) -> str:
    """Where a setting of the material stands in ``material_t``."""
    return f"lobe.{name}" if name in light.LOBE else name


def of_material(settings: dict[str, int]) -> dict[str, int]:
    """The fields of ``material_t``; 0 for those that are not given."""
    return {leaf(name): settings.get(name, 0) for name in (*light.MATERIAL, "f0")}


def of_light(settings: dict[str, int]) -> dict[str, int]:
    """The fields of ``light_t``."""
    return {f"{v}.{c}": settings[v + c] for v in "lh" for c in "xyz"} | {"vh": settings["vh"]}


def words(i: Arrays) -> dict[str, int]:
    """The settings of the material by name: numbers."""
    return {name: int(i[f"material_i.{leaf(name)}"][0]) for name in (*light.MATERIAL, "f0")}


def vector(i: Arrays, name: str) -> np.ndarray:
    """The vector (3, rows) of a port."""
    return np.stack([i[f"{name}_i.{c}"] for c in "xyz"])


# ---- vectors of the gain ---------------------------------------------------------------------------------------


def to_the_brim(
    rng: np.random.Generator, rows: int, mantissa: int, exponent: int, above: np.ndarray | None = None
) -> Arrays:
    """Arguments of ``shade_gain`` whose product is 2, less up to an ulp, and those beside them; one in eight any.

    ``above``: the power of two that is left for lobe, num and gain, 1 to 3.
    """
    lobe, (low, high) = rng.integers(ONE // 2, ONE, rows, endpoint=True), signed_range(k.FACTOR_EXP_W)
    above = rng.integers(1, 4, rows) if above is None else above  # 2^above (lobe num gain) is to be 2
    target = ((2 << 2 * k.INTENSITY_F + k.GAIN_F) - (1 << 2 * k.GAIN_F)) >> above
    num = -(-target // (lobe * mantissa)) + rng.integers(-1, 1, rows, endpoint=True)
    e = np.where(rng.random(rows) < 1 / 8, rng.integers(low, high, rows, endpoint=True), above - exponent)
    values = {"lobe": lobe, "num": num.clip(0, ONE), "fresnel": ONE, "w": 0, "e": e.clip(low, high)}
    found = {f"{name}_i": np.broadcast_to(value, rows).copy() for name, value in values.items()}
    ones = ((ONE, ONE, ONE, 0, power) for power in range(low, high + 1))  # a single bit, at every place
    for row, numbers in enumerate([(10572, 17019, ONE, 0, 5), *ones][:rows]):
        for values, number in zip(found.values(), numbers, strict=True):
            values[row] = number
    return found


# ---- the units ---------------------------------------------------------------------------------------------------


def _angles(form: str) -> Iterator[Case]:
    names = [
        f"angles_o.{name}" for name in ("diffuse", "nl", "nv", "x", "saturated", "nl_range", "nv_range", "x_range")
    ]

    def vectors(rng: np.random.Generator, rows: int, local: int, reflect: int) -> Arrays:
        l, v = unit_vectors(rng, 2 * rows).reshape(3, 2, rows).swapaxes(0, 1) if local else unit_vectors(rng, 2).T  # noqa: E741
        h = light.halfway(*l, *v)[:3]
        named = {name: np.reshape(u, (3, -1)) for name, u in zip("lvh", (l, v, h), strict=True)}
        settings = {"mirror": int(rng.integers(0, 2)) & reflect, "shift": int(rng.choice(SHIFTS))}
        return ports(rows, **settings, n=normals(rng, rows, l, v, h), **named)

    def golden(i: Arrays) -> Arrays:
        values = light.angles(i["mirror_i"], *(vector(i, name) for name in "nlvh"), i["shift_i"], FORMS[form])
        return dict(zip(names, values, strict=True))

    def exact(i: Arrays) -> Arrays:
        n, l, v, h = (vector(i, name).astype(Real) for name in "nlvh")  # noqa: E741
        a, b = n, h
        if i["mirror_i"][0]:
            a, b = ((2 * total(n, l) / ONE).clip(-LIMITS[1], 2 * ONE) * n / ONE - l).clip(*LIMITS), v
        chord = ((a - b).clip(*LIMITS) ** 2).sum(axis=0) / 2
        x = chord if form == "refined" else Real(ONE) ** 2 - total(a, b)
        cosines = [cosine(n, l) * ONE, *((total(n, other) / ONE).clip(0, ONE) for other in (l, v))]
        x = np.ldexp(x, k.VERSINE_F - 2 * k.INTENSITY_F).clip(0, 2 << k.VERSINE_F)
        return golden(i) | dict(zip(names, (*cosines, x), strict=False))

    def tolerance(i: Arrays) -> Arrays:
        """Half a last place; of R, V what R's rounding makes."""
        n, l, v = (vector(i, name).astype(Real) / ONE for name in "nlv")  # noqa: E741
        along = (2 * total(n, l)).clip(-LIMITS[1] / ONE, 2) * n - l - (v if form == "refined" else 0)
        of_r = reflection_error(n, along.clip(-2, 2) if form == "refined" else v)
        more = np.where(i["mirror_i"], np.ldexp(of_r * (1 + 2.0**-10), k.VERSINE_F - k.INTENSITY_F), 0)
        return dict.fromkeys(names[:3], 1 / 2) | {"angles_o.x": half_a_place(int(i["shift_i"][0])) + more}

    def without_r(i: Arrays) -> Arrays:
        return dict.fromkeys(("nl_o", *names[:3]), 1 / 2) | dict.fromkeys(
            ("angles_o.x", "x_o"), half_a_place(int(i["shift_i"][0]))
        )

    places = dict.fromkeys(("angles_o.x", "x_o"), k.VERSINE_F)
    half = half_a_place(k.LOBE_FINE)
    for reflect, local in ((1, 0), (0, 0), (1, 1), (0, 1)):
        latency = k.LATENCY_ANGLES - (not reflect) * k.LATENCY_REFLECT
        yield Case(
            "shade_angles", form, {"FORM": FORMS[form], "REFLECT": reflect, "LOCAL": local}, golden, exact, exact,
            lambda rng, rows, local=local, reflect=reflect: vectors(rng, rows, local, reflect), None,
            k.LATENCY_HALFWAY + 1 + k.LATENCY_VERSINE if local else latency,
            late={"h_i": k.LATENCY_HALFWAY} if local else {}, more_f=places, chunk=CHUNK, tolerance=tolerance,
            bound=np.inf if reflect else half,
        )  # fmt: skip

    def without_nv(of: Callable[[Arrays], Arrays]) -> Callable[[Arrays], Arrays]:
        return lambda i: of(i) | dict.fromkeys(("angles_o.nv", "angles_o.nv_range"), np.zeros_like(i["n_i.x"]))

    def of_h(rng: np.random.Generator, rows: int) -> Arrays:
        return {name: value for name, value in vectors(rng, rows, 0, 0).items() if name[0] in "nlhs"}

    def folded(of: Callable[[Arrays], Arrays]) -> Callable[[Arrays], Arrays]:
        """N.L before it is limited."""

        def value(i: Arrays) -> Arrays:
            n, l = vector(i, "n"), vector(i, "l")  # noqa: E741
            nl = normal.dot3(*n, *l) if of is golden else total(n.astype(Real), l) / ONE
            still = {"mirror_i": np.zeros(1, np.int64)} | {f"v_i.{c}": np.zeros(1, np.int64) for c in "xyz"}
            values = of(i | still)
            return {"nl_o": nl, "x_o": values["angles_o.x"], "range_o": values["angles_o.x_range"]}

        return value

    for fold in FOLDS:
        point = {"FORM": FORMS[form], "FOLD": fold, "TAKE": fold // 2}
        yield Case(
            "shade_angles", form, point | {"REFLECT": 0}, without_nv(golden), without_nv(exact), without_nv(exact),
            lambda rng, rows: vectors(rng, rows, 0, 0), None, k.LATENCY_ANGLES_FOLDED, fold,
            more_f=places, chunk=CHUNK, bound=half, tolerance=without_r,
        )  # fmt: skip
        yield Case(
            "shade_angles_folded", form, point, folded(golden), folded(exact), folded(exact), of_h, None,
            k.LATENCY_ANGLES_FOLDED, fold, more_f=places, chunk=CHUNK, bound=half, tolerance=without_r,
        )  # fmt: skip


def _factors(form: str) -> Iterator[Case]:
    """What the lobe is multiplied by; and the product."""

    def sized(rng: np.random.Generator, rows: int, *names: str, top: int = ONE) -> Arrays:
        values = mixed(dict.fromkeys((f"{name}_i" for name in names), (0, top)), top)(rng, rows)
        return {name: value >> np.maximum(rng.integers(-12, 18, rows), 0) for name, value in values.items()}

    def cosines(rng: np.random.Generator, rows: int) -> Arrays:
        code = int(rng.integers(0, len(CODES)))
        settings = registers(rng, code, form)
        given = sized(rng, rows, "x", top=2 << k.VERSINE_F) | sized(rng, rows, "nl", "nv", "vh")
        others = ("diffuse", "saturated", "nl_range", "nv_range", "x_range")
        angles = {name: given[f"{name}_i"] for name in ("x", "nl", "nv")} | dict.fromkeys(others, 0)
        return ports(rows, material=of_material(settings), angles=angles, vh=given["vh_i"])

    def arguments(i: Arrays) -> list[np.ndarray]:
        return [*(i[f"angles_i.{name}"] for name in ("x", "nl", "nv")), i["vh_i"]]

    def geometry(i: Arrays) -> Arrays:
        settings = words(i)
        named = {name: settings[name] for name in ("cosine", "inv_n", "inv_n_exp")}
        values = light.geometry(settings["model"], *arguments(i), **named)
        shape = i["vh_i"].shape
        return {
            f"factor_o.{name}": np.broadcast_to(v, shape)
            for name, v in zip(("num", "w", "e", "zero"), values, strict=True)
        }

    def divided(i: Arrays) -> Arrays:
        """num such that num (1 + w) 2^e is the exact g; the other outputs as they are."""
        golden = geometry(i)
        settings = words(i)
        x, *cosines = arguments(i)
        shift = min(settings["inv_n_exp"], k.VERSINE_CUT) if settings["model"] == k.MODEL_SCHLICK else 0
        x = x & -int(2 * half_a_place(shift))
        numbers = (np.ldexp(x.astype(Real), -k.VERSINE_F), *(c.astype(Real) / ONE for c in cosines))
        g = quotients(settings["model"], *numbers, *(settings[name] for name in ("cosine", "inv_n", "inv_n_exp")))
        w, e, zero = (golden[f"factor_o.{name}"] for name in ("w", "e", "zero"))
        scale = np.ldexp(1 + np.ldexp(w.astype(Real), -k.FACTOR_F), e)
        return golden | {"factor_o.num": np.where(zero, 0, g / scale * ONE)}

    yield Case(
        "shade_geometry", form, {}, geometry, divided, divided, cosines, None, k.LATENCY_GEOMETRY,
        more_f={"factor_o.w": k.FACTOR_F}, chunk=FEW,
        bound=1.8,  # of num (1 + w) 2^e: num's 1/2; w's 2.6, of two bits more, where 1 + w is at least 1/2
    )  # fmt: skip

    def factors(rng: np.random.Generator, rows: int) -> Arrays:
        exponent = int(rng.integers(*signed_range(k.GAIN_EXP_W), endpoint=True))
        low, high = signed_range(k.FACTOR_EXP_W)
        near = (rng.integers(-8, 20, rows) - exponent).clip(low, high)
        e = np.where(rng.random(rows) < 0.25, rng.integers(low, high, rows, endpoint=True), near)
        w = mixed({"w_i": (-(1 << k.FACTOR_F - 1), 0)})(rng, rows)
        gain = int(rng.integers(1 << k.GAIN_F, 2 << k.GAIN_F))
        given = sized(rng, rows, "lobe", "num", "fresnel") | w | {"e_i": e}
        return of_gain(rows, gain, exponent, given)

    def of_gain(rows: int, mantissa: int, exponent: int, given: Arrays) -> Arrays:
        factor = {name: given[f"{name}_i"] for name in ("num", "w", "e")} | {"zero": 0}
        material_ = of_material({"gain": mantissa, "gain_exp": exponent})
        return ports(rows, material=material_, factor=factor, lobe=given["lobe_i"], fresnel=given["fresnel_i"])

    def brim(rng: np.random.Generator, rows: int) -> Arrays:
        """Light that rounds up to 2, or just does not; the ends of every exponent."""
        low, high = signed_range(k.GAIN_EXP_W)
        exponent = int(rng.choice([low, high, 0, rng.integers(low, high)]))
        mantissa = int(rng.choice([97775, ONE, 2 * ONE - 1, rng.integers(ONE, 2 * ONE)]))
        return of_gain(rows, mantissa, exponent, to_the_brim(rng, rows, mantissa, exponent))

    def operands(i: Arrays) -> list[np.ndarray]:
        factor = [i[f"factor_i.{name}"] for name in ("num", "w", "e")]
        return [i["lobe_i"], *factor, i["fresnel_i"], *(i[f"material_i.{name}"] for name in ("gain", "gain_exp"))]

    def gain(i: Arrays) -> Arrays:
        values = light.gain(*operands(i))
        return dict(zip(("s_o", "saturated_o"), values, strict=True))

    def product(i: Arrays) -> Arrays:
        """In units of the last bit, or of 2^-32 of lobe num fresnel, where what is below is cut, if that is more."""
        lobe, num, w, e, fresnel, mantissa, gain_exp = operands(i)
        golden, exponent = gain(i), np.minimum(e + gain_exp, 31)
        shape = lobe.astype(Real) * num * fresnel
        factor = (1 + np.ldexp(w.astype(Real), -k.FACTOR_F)) * mantissa
        value = np.ldexp(shape * factor, exponent - 3 * k.INTENSITY_F).clip(0, LIMITS[1])
        unit = np.ldexp(Real(1), np.maximum(exponent - k.INTENSITY_F, 0))
        return golden | {"s_o": in_units(golden["s_o"], value, unit)}

    for vectors, note in ((factors, ""), (brim, "brim")):
        yield Case(
            "shade_gain", form, {}, gain, product, product, vectors, None, k.LATENCY_GAIN, chunk=FEW, note=note,
            bound=3.5,  # 1/2, 1 for what is cut, the rounding of a factor of at least 1/2 in light of at most 2
        )  # fmt: skip

    def plain(rng: np.random.Generator, rows: int) -> Arrays:
        """What the folded one computes: the rest is at rest."""
        still = {"factor_i.w": 0, "factor_i.e": 0, "fresnel_i": ONE}
        return factors(rng, rows) | {name: np.full(rows, value) for name, value in still.items()}

    def plain_brim(rng: np.random.Generator, rows: int) -> Arrays:
        """Light that rounds up to 2, or just does not, of a gain that alone decides on the exponent."""
        exponent, mantissa = int(rng.integers(1, 4)), int(rng.integers(ONE, 2 * ONE))
        given = to_the_brim(rng, rows, mantissa, exponent, np.full(rows, exponent))
        return of_gain(rows, mantissa, exponent, given | {"e_i": np.zeros(rows, np.int64)})

    for fold in FOLDS:
        for vectors, note in ((plain, ""), (plain_brim, "brim")):
            yield Case(
                "shade_gain", form, {"FOLD": fold, "TAKE": fold // 2}, gain, product, product, vectors, None,
                k.LATENCY_GAIN, fold, chunk=FEW, note=note, bound=1.5,  # 1/2, 1 for what is cut
            )  # fmt: skip


def _nodes(form: str) -> Iterator[Case]:
    """Whole nodes: each model by itself where light is directional, all in turn where it is not."""

    def case(
        module: str, vectors: Callable, inner: Callable, latency: int, chunk: int, note: str = "", clocks: int = 1,
        late: dict[str, int] | None = None, given: Callable | None = None, **point: int,
    ) -> Case:  # fmt: skip
        """``inner`` gives the vectors n, l, v, h, vh and Fresnel's factor of the inputs; ``given`` those of the
        formula, where H is computed. What is left out at the ``point`` has no formula: there RTL and golden model are
        compared, and no more."""
        built = [point.get(name, 1) for name in ("REFLECT", "DIVIDE")]
        missing = [k.MODEL_PHONG] * (not built[0])
        missing += [k.MODEL_SCHLICK, k.MODEL_COOK_TORRANCE, k.MODEL_WARD] * (not built[1])
        given = given or inner

        def golden(i: Arrays) -> Arrays:
            return outputs(*light.reflectance(*inner(i), words(i), FORMS[form], *built))

        def formula(of: Callable) -> Callable[[Arrays], Arrays]:
            def value(i: Arrays) -> Arrays:
                code = int(i["material_i.model"][0])
                return golden(i) if code in missing else of(code, words(i), golden(i), *given(i), form)

            return value

        def tolerance(i: Arrays) -> Arrays:
            code = int(i["material_i.model"][0])
            f0 = None if given is inner else words(i)["f0"]
            specular = 0 if code in missing else allowed(code, words(i), *given(i), form, f0)
            return {"light_o.diffuse": 1 / 2, "light_o.specular": specular}

        return Case(
            module, form, {"FORM": FORMS[form]} | point, golden, formula(exact_light), formula(ideal_light), vectors,
            None, latency, clocks, chunk=chunk, note=note, late=late or {}, tolerance=tolerance,
            bound=44 if note in ("lambert", "blinn") else np.inf,  # 2.75 times the gain, 16 at most
        )  # fmt: skip

    for code, name in NAMES.items():

        def directional(rng: np.random.Generator, rows: int, code: int = code) -> Arrays:
            direction = rng.standard_normal(3)
            settings = registers(rng, code, form, direction)
            l, h = ([settings[u + c] for c in "xyz"] for u in "lh")  # noqa: E741
            n = normals(rng, rows, l, h, [0, 0, ONE])
            return ports(rows, n=n, material=of_material(settings), light=of_light(settings))

        def settled(i: Arrays) -> tuple:
            l, h = (np.reshape([int(i[f"light_i.{u}.{c}"][0]) for c in "xyz"], (3, 1)) for u in "lh")  # noqa: E741
            return vector(i, "n"), l, np.reshape([0, 0, ONE], (3, 1)), h, int(i["light_i.vh"][0]), ONE

        yield case("shade_light", directional, settled, k.LATENCY_LIGHT, CHUNK, name)
        folds = FOLDS if code in (k.MODEL_LAMBERT, k.MODEL_BLINN) else FOLDS[:1]
        for fold in (folds[0], 1, *folds[1:]):
            point = TWO | ({"FOLD": fold, "TAKE": fold // 2} if fold > 1 else {})
            latency = k.LATENCY_LIGHT_FOLDED + 5 * (fold == 5) if fold > 1 else k.LATENCY_LIGHT - k.LATENCY_REFLECT
            if form == "refined" or fold > 1:
                yield case("shade_light", directional, settled, latency, CHUNK, name, fold, **point)

    def local(rng: np.random.Generator, rows: int) -> Arrays:
        l, v = unit_vectors(rng, rows), unit_vectors(rng, rows)  # noqa: E741
        v[:, ::64] = -l[:, ::64]
        h = np.stack(light.halfway(*l, *v)[:3])
        settings = registers(rng, int(rng.integers(0, len(CODES))), form)
        n = normals(rng, rows, l, v, np.where(h.any(axis=0), h, l))
        return ports(rows, n=n, l=l, v=v, material=of_material(settings))

    def between(i: Arrays) -> tuple:
        n, l, v = (vector(i, name) for name in "nlv")  # noqa: E741
        *h, vh = light.halfway(*l, *v)
        return n, l, v, np.stack(h), vh, light.fresnel(vh, words(i)["f0"])

    def exactly(i: Arrays) -> tuple:
        """H, V.H and Fresnel's factor as numbers, in ulp."""
        n, l, v = (vector(i, name) for name in "nlv")  # noqa: E741
        s = np.asarray(l + v, Real).clip(*LIMITS)
        length = np.sqrt((s * s).sum(axis=0))
        h = s / np.where(length == 0, 1, length) * ONE
        vh = ((v * h).sum(axis=0) / ONE).clip(0, ONE)
        f0 = min(words(i)["f0"], ONE)
        return n, l, v, h, vh, f0 + (ONE - f0) * (1 - vh / ONE) ** 5

    for point in ({}, TWO):
        yield case("shade_light_local", local, between, k.LATENCY_LIGHT_LOCAL, FEW, given=exactly, **point)

    def packed(rng: np.random.Generator, rows: int, several: bool) -> Arrays:
        size = rows if several else 1
        l, v = unit_vectors(rng, 2 * size).reshape(3, 2, size).swapaxes(0, 1)  # noqa: E741
        *h, vh = light.halfway(*l, *v)
        settings = of_material(registers(rng, int(rng.integers(0, len(CODES))), form))
        fresnel = rng.integers(*COSINE, size, endpoint=True)
        n = normals(rng, rows, l, v, h)
        return ports(rows, n=n, l=l, v=v, h=np.stack(h), vh=vh, fresnel=fresnel, material=settings)

    def given(i: Arrays) -> tuple:
        return *(vector(i, name) for name in "nlvh"), i["vh_i"], i["fresnel_i"]

    late = {"h_i": k.LATENCY_HALFWAY, "vh_i": k.LATENCY_HALFWAY, "fresnel_i": k.LATENCY_HALFWAY + k.LATENCY_FRESNEL}
    for local, divide in ((0, 1), (0, 0), (1, 1), (1, 0)):
        latency = k.LATENCY_LIGHT_LOCAL if local else k.LATENCY_LIGHT - (not divide) * k.LATENCY_REFLECT
        yield case(
            "shade_reflectance", lambda rng, rows, several=bool(local): packed(rng, rows, several), given, latency,
            FEW, late=late if local else {}, REFLECT=divide, DIVIDE=divide, LOCAL=local,
        )  # fmt: skip


def cases() -> Iterator[Case]:
    """The cases of light in six models."""
    yield from in_forms(_angles)
    yield from in_forms(_factors, only="refined")
    yield from in_forms(_nodes)
