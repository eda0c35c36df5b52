# SPDX-License-Identifier: Apache-2.0
"""Normals: dot product, scaled sums, InvC, nodes, P4's metrics, increments."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import normal
from polyshade.golden.types import METRIC
from polyshade.sim.units.case import (
    FORMS,
    ONE,
    Arrays,
    Case,
    Real,
    corners,
    every,
    in_forms,
    mixed,
    shortened,
    signed_range,
    thresholds,
)

# constants of the normals' formulas in fractions of 2^16 (golden.contract), by the form and degree of the unit
INVC = {
    ("refined", 2): (k.INVC_0, k.INVC_C, k.INVC_UU, k.INVC_UUUU),
    ("paper", 2): (k.INVC2_0, k.INVC2_C, k.INVC2_CC, 0),
    ("paper", 1): (k.INVC1_0, k.INVC1_C, 0, 0),
}
DEGREES = {"refined": (2,), "paper": (2, 1)}
AXES = ("x", "y", "z")
NODE_PORTS = (*(f"arc_o.n{n}.{c}" for n in range(5) for c in AXES), "arc_o.clamped")


def _axes(port: str) -> tuple[str, ...]:
    """The components of a vector at a port."""
    return tuple(f"{port}.{axis}" for axis in AXES)


def _named(vector: Iterable[np.ndarray], port: str = "n_o") -> Arrays:
    """A vector at a port."""
    return dict(zip(_axes(port), vector, strict=True))


def unit_vectors(rng: np.random.Generator, rows: int) -> np.ndarray:
    """(3, rows) unit vectors in all directions, S1.16."""
    free = rng.standard_normal((3, rows))
    return np.rint(free / np.linalg.norm(free, axis=0) * ONE).astype(np.int64)


def arcs(rng: np.random.Generator, rows: int) -> Arrays:
    """Pairs of vectors a_i, b_i and c_i, S1.16.

    An eighth each: components from the corners, vectors of a few ulp, equal unit vectors, opposite ones, axes; the rest
    are unit vectors with angles of any size. c is the rounded cosine, in a quarter of the rows any number.
    """
    kind = rng.integers(0, 8, rows)
    axes = np.eye(3, dtype=np.int64)[:, rng.integers(0, 3, (2, rows))] * rng.choice([ONE, -ONE], (2, rows))
    corner = rng.choice(corners(*signed_range(k.INTENSITY_W), ONE, -ONE), (3, 2, rows))
    short = rng.integers(-4, 4, (3, 2, rows), endpoint=True)
    a = unit_vectors(rng, rows)
    bent = a + rng.standard_normal((3, rows)) * np.ldexp(float(ONE), -rng.integers(0, 12, rows))
    b = np.rint(bent / np.linalg.norm(bent, axis=0) * ONE).astype(np.int64)
    first = [kind == n for n in range(5)]
    a = np.select(first, [corner[:, 0], short[:, 0], a, a, axes[:, 0]], a)
    b = np.select(first, [corner[:, 1], short[:, 1], a, -a, axes[:, 1]], b)
    low, high = signed_range(k.INTENSITY_W)
    any_c = mixed({"c_i": (low, high)}, ONE, ONE + 1, ONE - 1)(rng, rows)["c_i"]
    c = np.where(rng.random(rows) < 0.25, any_c, normal.dot3(*a, *b).clip(low, high))
    return dict(zip((*_axes("a_i"), *_axes("b_i"), "c_i"), (*a, *b, c), strict=True))


def ends(names: str = "ab") -> Callable[[np.random.Generator, int], Arrays]:
    """The two vectors of :func:`arcs`, named so: with "nl", ports nx_i .. lz_i."""

    def make(rng: np.random.Generator, rows: int) -> Arrays:
        components = list(arcs(rng, rows).values())[:6]
        return dict(zip((f"{v}{c}_i" for v in names for c in AXES), components, strict=True))

    return make


def _pairs(rng: np.random.Generator, rows: int) -> Arrays:
    """The two vectors of :func:`arcs`."""
    return {name: value for name, value in arcs(rng, rows).items() if name != "c_i"}


def _pairs_and_ties(rng: np.random.Generator, rows: int) -> Arrays:
    """The same; of one in eight the dot product lies within a few steps of a tie."""
    made = _pairs(rng, rows)
    low, high = signed_range(k.INTENSITY_W)
    near = rng.random(rows) < 1 / 8
    small = {"a_i.z": rng.integers(-16, 17, rows), "a_i.y": rng.integers(low, high, rows)}
    small |= {"a_i.x": rng.integers(-16, 17, rows), "b_i.x": 1, "b_i.y": 1 << k.INTENSITY_F - 2, "b_i.z": 1}
    return made | {name: np.where(near, value, made[name]) for name, value in small.items()}


def _ends(i: Arrays) -> list[np.ndarray]:
    return [i[part] for part in (*_axes("a_i"), *_axes("b_i"))]


def _normalize(form: str) -> Iterator[Case]:
    """Exact normalizer: vectors of every length, down to one unit."""

    def unit(i: Arrays) -> Arrays:
        x, y, z = (i[part] for part in _axes("v_i"))
        zero = (x | y | z) == 0
        return _named(normal.normalize(x, y, z)) | {"zero_o": zero.astype(np.int64)}

    def exact(i: Arrays) -> Arrays:
        vector = [i[part].astype(Real) for part in _axes("v_i")]
        length = np.sqrt(sum(c * c for c in vector))
        return unit(i) | _named(v * ONE / np.where(length == 0, 1, length) for v in vector)

    vector = dict.fromkeys(_axes("v_i"), signed_range(k.INTENSITY_W))
    yield Case(
        "shade_normalize", form, {}, unit, exact, exact, shortened(mixed(vector, ONE, -ONE), k.INTENSITY_W), None,
        k.LATENCY_NORMALIZE, bound=5 / 8,
    )  # fmt: skip


def _unit(form: str) -> Iterator[Case]:
    """Interpolated normals, most of length 1/8 to 4; short ones, which stay too short, and bypassed ones."""
    vector = dict.fromkeys(_axes("v_i"), signed_range(k.INTENSITY_W))
    ports = (*_axes("unit_o.normal"), "unit_o.zero", "unit_o.too_short")

    def vectors(rng: np.random.Generator, rows: int) -> Arrays:
        length = np.ldexp(1 + rng.random(rows), rng.integers(k.NODE_F - 3, k.NODE_F + 2, rows))
        usual = np.rint(unit_vectors(rng, rows) * length / ONE).clip(*signed_range(k.INTENSITY_W)).astype(np.int64)
        other = shortened(mixed(vector, ONE // 2, -ONE // 2), k.INTENSITY_W)(rng, rows)
        chosen = rng.random(rows) < 0.75
        mixture = {name: np.where(chosen, v, other[name]) for name, v in zip(vector, usual, strict=True)}
        return mixture | {"bypass_i": (rng.random(rows) < 0.1).astype(np.int64)}

    def golden(i: Arrays) -> Arrays:
        return dict(zip(ports, normal.unit(*i.values()), strict=True))

    def exact(i: Arrays) -> Arrays:
        """v / |v|; a short one by 8 times the mantissa of 1 / |v|."""
        v = np.stack([i[name] for name in vector]).astype(Real)
        mantissa, exponent = np.frexp(np.sqrt((v**2).sum(axis=0)))
        root = 1 / np.where(mantissa == 0, 1, mantissa)
        n = v * root * np.ldexp(Real(ONE), -np.maximum(exponent, k.NODE_F - 2))
        n = np.where(i["bypass_i"], (2 * v).clip(*signed_range(k.INTENSITY_W)), n)
        return golden(i) | dict(zip(ports, n, strict=False))

    for fold in (1, 6, 2, 3, 4, 5, 7, 8):
        latency, pace = (k.LATENCY_UNIT_FOLDED, fold) if fold > 2 else (k.LATENCY_UNIT, 1)
        yield Case(
            "shade_unit", form, {"FOLD": fold}, golden, exact, exact, vectors, None, latency, pace,
            bound=1.65,  # 1/2, 3/8 of s, and of a vector longer than 2 the rounding to 18 bits
        )  # fmt: skip


def _vectors(form: str) -> Iterator[Case]:
    """Dot product, vector times number, and the scaled sum."""
    for out_f in (k.INTENSITY_F, k.INTENSITY_F + 1):

        def dot(i: Arrays, out_f: int = out_f) -> Arrays:
            v = [x.astype(Real) for x in _ends(i)]
            return {"d_o": np.ldexp(sum(a * b for a, b in zip(v[:3], v[3:], strict=True)), out_f - 2 * k.INTENSITY_F)}

        yield Case(
            "shade_dot3", form, {"OUT_F": out_f}, lambda i, f=out_f: {"d_o": normal.dot3(*_ends(i), f=f)}, dot, dot,
            _pairs_and_ties, None, k.LATENCY_DOT3, unit_f=out_f,
        )  # fmt: skip

    factor = (0, (1 << k.INVC_F) - 1)
    scale = dict.fromkeys(_axes("v_i"), signed_range(k.INTENSITY_W)) | {"s_i": factor}
    for gain in (0, 1):

        def golden(i: Arrays, gain: int = gain) -> Arrays:
            return _named(normal.scale3(*(i[part] for part in scale), gain))

        def scaled(i: Arrays, gain: int = gain) -> Arrays:
            return _named(i[part] * (i["s_i"].astype(Real) / (1 << k.INVC_F - gain)) for part in _axes("v_i"))

        # |v s 2^gain| < 2
        vectors = mixed(scale | ({"s_i": (0, 1 << k.INVC_F - 1)} if gain else {}), ONE, -ONE)
        yield Case("shade_scale3", form, {"GAIN": gain}, golden, scaled, scaled, vectors, None, k.LATENCY_SCALE3)

    for wait in (1, 4):

        def golden(i: Arrays) -> Arrays:
            return _named(normal.bisect(*_ends(i), i["invc_i"]))

        def exact(i: Arrays) -> Arrays:
            return _named(_bisected(*_ends(i), i["invc_i"].astype(Real) / (1 << k.INVC_F)))

        yield Case(
            "shade_bisect", form, {"WAIT": wait}, golden, exact, exact,
            lambda rng, rows: _pairs(rng, rows) | mixed({"invc_i": factor}, ONE)(rng, rows), None,
            wait + k.LATENCY_SCALE3, late={"invc_i": wait},
        )  # fmt: skip


def _bisected(ax, ay, az, bx, by, bz, s) -> list[np.ndarray]:
    """(a + b) s, where a + b is limited to what S1.16 holds."""
    low, high = signed_range(k.INTENSITY_W)
    return [(a + b).clip(low, high) * s for a, b in ((ax, bx), (ay, by), (az, bz))]


def _invc(form: str, degree: int, c: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """InvC and cos(psi/2) of a unit as numbers, from c as a number in [0, 1], exactly by its formula."""
    c = np.asarray(c, Real)
    square = (1 - c if form == "refined" else c) ** 2
    k0, k1, k2, k4 = INVC[form, degree]
    value = (k0 + k1 * c + k2 * square + k4 * square**2) / ONE
    if form == "refined":
        return value, (k.D2_NEAR_0 + k.D2_NEAR_C * c + k.HALF_UU * square + k.HALF_UUUU * square**2) / ONE
    far = c * ONE <= k.D2_LIMIT
    return value, np.where(far, k.D2_FAR_0 + k.D2_FAR_C * c, k.D2_NEAR_0 + k.D2_NEAR_C * c) / ONE


def true_invc(c: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """1/sqrt(2 (1 + c)) and sqrt((1 + c)/2)."""
    half = np.sqrt((1 + np.asarray(c, Real)) / 2)
    return 1 / (2 * half), half


def cosine(c: np.ndarray) -> np.ndarray:
    """c in S1.16 as a number, clamped to [0, 1]."""
    return c.clip(0, ONE).astype(Real) / ONE


def _cosines(form: str) -> Iterator[Case]:
    """The functions of one cosine, each over every cosine that 18 bits hold."""
    everything = every({"c_i": signed_range(k.INTENSITY_W)})
    for degree in DEGREES[form]:

        def golden(i: Arrays, degree: int = degree) -> Arrays:
            values = normal.invc(i["c_i"], FORMS[form], degree)
            return dict(zip(("invc_o.invc", "invc_o.half", "invc_o.clamped"), values, strict=True))

        def value(i: Arrays, function: Callable, golden=golden) -> Arrays:
            invc, half = function(cosine(i["c_i"]))
            return golden(i) | {"invc_o.invc": invc * (1 << k.INVC_F), "invc_o.half": half * ONE}

        yield Case(
            "shade_invc", form, {"FORM": FORMS[form], "DEGREE": degree}, golden,
            lambda i, value=value, d=degree: value(i, lambda c: _invc(form, d, c)),
            lambda i, value=value: value(i, true_invc), None, everything, k.LATENCY_INVC,
            more_f={"invc_o.invc": k.INVC_F},
            bound=0.82,  # as half, in ulp of U0.18
        )  # fmt: skip

    def with_powers() -> Iterator[Arrays]:
        """Every c."""
        c = np.arange(ONE + 1)
        cut, square = 2 * k.INTENSITY_F - k.SQUARE_F, (ONE - c) ** 2
        yield {"c_i": c, "uu_i": square >> cut, "uuuu_i": (square >> k.INTENSITY_F) ** 2 >> cut}

    yield Case(
        "shade_half", form, {"FORM": FORMS[form]}, lambda i: {"half_o": normal.half(i["c_i"], FORMS[form])},
        lambda i: {"half_o": _invc(form, 2, cosine(i["c_i"]))[1] * ONE},
        lambda i: {"half_o": true_invc(cosine(i["c_i"]))[1] * ONE}, None, with_powers, k.LATENCY_HALF,
        late={"uu_i": 1, "uuuu_i": 1},
        bound=0.53,  # 1/2, and what the cuts of the powers are worth: of u^4, up to 8 times its last bit
    )  # fmt: skip


def _nodes(form: str) -> Iterator[Case]:
    """Midpoint and node chain; ideal: the same sums, scaled by the true functions of c."""
    for degree in DEGREES[form]:
        point = {"FORM": FORMS[form], "DEGREE": degree}
        outputs = (*_axes("middle_o.normal"), "middle_o.half", "middle_o.clamped")

        def middle(i: Arrays, point=point, outputs=outputs) -> Arrays:
            values = normal.midpoint(*_ends(i), i["c_i"], point["FORM"], point["DEGREE"])
            return dict(zip(outputs, values, strict=True))

        def exact_middle(i: Arrays, function: Callable, outputs=outputs, middle=middle) -> Arrays:
            s, h = function(cosine(i["c_i"]))
            return middle(i) | dict(zip(outputs, (*_bisected(*_ends(i), s), h * ONE), strict=False))

        def chain(i: Arrays, point=point) -> Arrays:
            values = normal.node_chain(*_ends(i), i["c_i"], point["FORM"], point["DEGREE"])
            return dict(zip(NODE_PORTS, values, strict=True))

        def exact_chain(i: Arrays, function: Callable, chain=chain) -> Arrays:
            a, b = _ends(i)[:3], _ends(i)[3:]
            s, h = function(cosine(i["c_i"]))
            m, s = _bisected(*a, *b, s), function(h)[0]
            return chain(i) | dict(
                zip(NODE_PORTS, (*a, *_bisected(*a, *m, s), *m, *_bisected(*m, *b, s), *b), strict=False)
            )

        units = (
            # 1/2, and 0.55 of half an ulp times a sum of at most 2
            ("shade_midpoint", middle, exact_middle, k.LATENCY_MIDPOINT, 1.05),
            ("shade_node_chain", chain, exact_chain, k.LATENCY_NODE_CHAIN, 2),
        )
        for module, golden, exact, latency, bound in units:
            yield Case(
                module, form, point, golden,
                lambda i, exact=exact, d=degree: exact(i, lambda c: _invc(form, d, c)),
                lambda i, exact=exact: exact(i, true_invc), arcs, None, latency, bound=bound,
            )  # fmt: skip


def _metric(form: str) -> Iterator[Case]:
    """P4's metrics: how a line is normalized."""
    ports = [f"metric_o.{field.name}" for field in METRIC.fields]

    def golden(i: Arrays) -> Arrays:
        return dict(zip(ports, normal.metric(i["c_i"], i["m_i"], i["threshold_i"]), strict=True))

    def exact(i: Arrays) -> Arrays:
        c, m = cosine(i["c_i"]), i["m_i"].clip(k.METRIC_M_MIN, k.METRIC_M_MAX)
        d1a, d2 = k.D1_0 + k.D1_C * c + k.D1_M * m, _invc(form, 2, c)[1] * ONE
        return golden(i) | {"metric_o.d1a": d1a, "metric_o.d2": d2}

    def ideal(i: Arrays) -> Arrays:
        c, m = cosine(i["c_i"]), i["m_i"].clip(k.METRIC_M_MIN, k.METRIC_M_MAX)
        d1a, d2 = np.cos(np.arccos(c) / m) * ONE, true_invc(c)[1] * ONE
        return golden(i) | {"metric_o.d1a": d1a, "metric_o.d2": d2}

    def all_of() -> Iterator[Arrays]:
        rng = np.random.default_rng(1)
        low, high = signed_range(k.INTENSITY_W)
        for m in (*range(16), (1 << k.COUNT_W) - 1):
            c = np.arange(low, high + 1)
            threshold = thresholds(rng, len(c), k.METRIC_THRESHOLD, k.INTENSITY_W)
            yield {"c_i": c, "m_i": np.full(len(c), m), "threshold_i": threshold}

    yield Case("shade_metric", form, {}, golden, exact, ideal, None, all_of, k.LATENCY_METRIC)


def _increment(form: str) -> Iterator[Case]:
    """Triangles of normals: starts, pixels, lines. The exact value keeps every bit of the sums."""
    names = [part for kind in "ngl" for part in _axes(f"{kind}_i")]

    def vectors(rng: np.random.Generator, rows: int) -> Arrays:
        unit = 1 << k.STEP_F
        values = mixed(dict.fromkeys(names[:3], (-unit, unit)) | dict.fromkeys(names[3:], (-unit >> 10, unit >> 10)))
        first = (rng.random(rows) < 0.01).astype(np.int64)
        first[0] = 1
        return values(rng, rows) | {"first_i": first, "line_i": (rng.random(rows) < 0.1).astype(np.int64)}

    def golden(i: Arrays) -> Arrays:
        return _named(
            normal.increment(i["first_i"], i["line_i"], *(i[f"{kind}_i.{c}"] for kind in "ngl")) for c in AXES
        )

    def exact(i: Arrays) -> Arrays:
        ulp = 1 << k.STEP_F - k.INTENSITY_F
        sums = (normal.increment_sum(i["first_i"], i["line_i"], *(i[f"{kind}_i.{c}"] for kind in "ngl")) for c in AXES)
        return _named(value.astype(Real) / ulp for value in sums)

    yield Case("shade_increment", form, {}, golden, exact, exact, vectors, None, k.LATENCY_INCREMENT, ordered=True)


def _factor(form: str) -> Iterator[Case]:
    """By what a middle normal is multiplied: every variant, thresholds around the estimates and outside of [0, 1]."""

    def vectors(rng: np.random.Generator, rows: int) -> Arrays:
        a, other = rng.standard_normal((2, 3, rows))
        b = a + other * rng.choice([0, 0.01, 0.3, 2], rows)
        pair = {}
        for name, v in (("a_i", a), ("b_i", b)):
            pair |= dict(zip(_axes(name), np.rint(v / np.linalg.norm(v, axis=0) * ONE).astype(np.int64), strict=True))
        outside = rng.choice([-1, ONE, ONE + 1], rows)
        threshold = np.where(rng.random(rows) < 0.2, outside, rng.integers(0, ONE, rows))
        choice = mixed({"middle": (0, 1), "variant": (0, 7), "needs_d1": (0, 1)})(rng, rows) | {"threshold": threshold}
        return pair | {f"choice_i.{name}": value for name, value in choice.items()}

    def golden(i: Arrays) -> Arrays:
        a, b = (np.stack([i[name] for name in _axes(port)]) for port in ("a_i", "b_i"))
        choice = (i[f"choice_i.{name}"] for name in ("middle", "variant", "needs_d1", "threshold"))
        return {"factor_o": normal.factor(a, b, *choice)}

    yield Case(
        "shade_factor", form, {}, golden, golden, golden, vectors, None, k.LATENCY_FACTOR_S, bound=0, unit_f=k.INVC_F
    )


def cases() -> Iterator[Case]:
    """All cases of ``rtl/normal`` but whole lines, a stream."""
    yield from in_forms(_normalize, _unit, _vectors, only="refined")
    yield from in_forms(_cosines, _nodes)
    yield from in_forms(_metric, _factor, only="paper")
    yield from in_forms(_increment, only="refined")
