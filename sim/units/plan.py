# SPDX-License-Identifier: Apache-2.0
"""The planner, its measure kappa, and P2's criterion: whether a triangle is flat enough to go without normalizing."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import plan
from polyshade.golden.types import CRITERION
from polyshade.sim.units.case import FORMS, ONE, Arrays, Case, Real, in_forms, mixed, signed_range, thresholds
from polyshade.sim.units.normal import DEGREES, cosine, true_invc, unit_vectors

EDGES = ("cosines_i.ab", "cosines_i.bc", "cosines_i.ca")


def _criterion(form: str) -> Iterator[Case]:
    """P2's criterion at every cosine, and over triangles of every flatness."""
    low, high = signed_range(k.INTENSITY_W)

    def exact_eta(i: Arrays, degree: int) -> np.ndarray:
        c = [cosine(i[edge]) for edge in EDGES]
        if form == "refined":
            return sum(k.ETA_U * (1 - x) + k.ETA_UU * (1 - x) ** 2 + k.ETA_UUUU * (1 - x) ** 4 for x in c)
        k0, k1, k2 = (k.ETA2_0, k.ETA2_C, k.ETA2_CC) if degree == 2 else (k.ETA1_0, k.ETA1_C, 0)
        return sum(k0 + k1 * x + k2 * x * x for x in c)

    def every_cosine() -> Iterator[Arrays]:
        """Every c at one edge, the others flat, and at all three."""
        rng = np.random.default_rng(1)
        c = np.arange(low, high + 1)
        flat = np.full(len(c), ONE)
        for ab, bc, ca in ((c, flat, flat), (flat, c, flat), (flat, flat, c), (c, c, c)):
            threshold = thresholds(rng, len(c), 26214, k.ETA_W)
            yield dict(zip(EDGES, (ab, bc, ca), strict=True)) | {"threshold_i": threshold}

    def random(rng: np.random.Generator, rows: int) -> Arrays:
        """Triangles of every flatness, down to one ulp of a cosine."""
        rest = np.ldexp(rng.random((3, rows)), rng.integers(0, 18, rows))
        dense = {edge: (ONE - u).astype(np.int64) for edge, u in zip(EDGES, rest, strict=True)}
        free = mixed(dict.fromkeys(dense, (low, high)) | {"threshold_i": signed_range(k.ETA_W)}, ONE)(rng, rows)
        chosen = rng.random(rows) < 0.75
        return free | {name: np.where(chosen, value, free[name]) for name, value in dense.items()}

    def beside(degree: int) -> Callable[[np.random.Generator, int], Arrays]:
        """Half of the thresholds are eta, or next to it."""

        def make(rng: np.random.Generator, rows: int) -> Arrays:
            i = random(rng, rows)
            eta = plan.criterion(*(i[edge] for edge in EDGES), 0, FORMS[form], degree)[0]
            near = (eta + rng.integers(-1, 2, rows)).clip(*signed_range(k.ETA_W))
            return i | {"threshold_i": np.where(rng.random(rows) < 0.5, near, i["threshold_i"])}

        return make

    for degree in DEGREES[form]:

        def eta(i: Arrays, degree: int = degree) -> Arrays:
            values = plan.criterion(*(i[edge] for edge in EDGES), i["threshold_i"], FORMS[form], degree)
            return dict(zip((f"criterion_o.{field.name}" for field in CRITERION.fields), values, strict=True))

        def exact(i: Arrays, eta=eta, degree: int = degree) -> Arrays:
            return eta(i) | {"criterion_o.eta": exact_eta(i, degree) * (1 << k.ETA_F - k.CONSTANT_F)}

        def ideal(i: Arrays, eta=eta) -> Arrays:
            true = sum(1 - true_invc(cosine(i[edge]))[1] for edge in EDGES)
            return eta(i) | {"criterion_o.eta": true * (1 << k.ETA_F)}

        for vectors, all_of in ((None, every_cosine), (beside(degree), None)):
            yield Case(
                "shade_criterion", form, {"FORM": FORMS[form], "DEGREE": degree}, eta, exact, ideal, vectors, all_of,
                k.LATENCY_CRITERION, bound=0.85, unit_f=k.ETA_F,
            )  # fmt: skip


def increments(port: str, rng: np.random.Generator, rows: int) -> Arrays:
    """Increments of normals of every length, one component in four shorter than the others."""
    g = mixed({f"{port}.{c}": signed_range(k.STEP_W) for c in "xyz"})(rng, rows)
    length = rng.integers(0, k.STEP_W, rows)
    return {name: value >> length >> rng.integers(0, 8, rows) * rng.integers(0, 2, rows) for name, value in g.items()}


def sharpness(rng: np.random.Generator, rows: int) -> Arrays:
    """A sharpness for all rows."""
    one = 1 << k.SHARPNESS_F
    mantissa = rng.choice([one, 2 * one - 1, rng.integers(one, 2 * one)])
    exponent = rng.integers(13)
    return {"planner_i.sharpness": np.full(rows, mantissa), "planner_i.sharpness_exp": np.full(rows, exponent)}


def _kappa(form: str) -> Iterator[Case]:
    """kappa of increments of every length. Exact: of the bits that are kept; ideal: of all."""
    names = ("g_i.x", "g_i.y", "g_i.z")

    unused = {f"planner_i.{name}": 0 for name in ("t1", "t2", "t3", "threshold", "weight")}

    def vectors(rng: np.random.Generator, rows: int) -> Arrays:
        others = {name: np.full(rows, value) for name, value in unused.items()}
        return increments("g_i", rng, rows) | {"log2_i": rng.integers(0, 14, rows)} | sharpness(rng, rows) | others

    def golden(i: Arrays) -> Arrays:
        g = (i[name] for name in names)
        return {"kappa_o": plan.kappa(*g, i["log2_i"], i["planner_i.sharpness"], i["planner_i.sharpness_exp"])}

    def value(i: Arrays, energy: np.ndarray) -> Arrays:
        """kappa for |g|^2, g in units of its last bit."""
        shift = 2 * i["log2_i"] + i["planner_i.sharpness_exp"] - 2 * k.STEP_F - k.SHARPNESS_F - 1 + k.KAPPA_F
        return {"kappa_o": np.minimum(np.ldexp(energy * i["planner_i.sharpness"], shift), plan.KAPPA_MAX)}

    def exact(i: Arrays) -> Arrays:
        g = np.stack([i[name] for name in names])
        bits = np.frexp(np.maximum(g, ~g).max(axis=0).astype(float))[1]  # of the longest component, without its sign
        drop = bits - 17
        kept = np.floor(np.ldexp(g.astype(Real), -drop))
        energy = np.floor(np.ldexp((kept**2).sum(axis=0), -19))
        return value(i, np.ldexp(energy, 19 + 2 * drop))

    def ideal(i: Arrays) -> Arrays:
        return value(i, sum(i[name].astype(Real) ** 2 for name in names))

    yield Case(
        "shade_kappa", form, {}, golden, exact, ideal, vectors, None, k.LATENCY_KAPPA, 4, unit_f=k.KAPPA_F,
        chunk=1 << 13, late={"log2_i": 4},
        bound=1,  # cut, behind the cuts of its factors; those make 2^-12 of it at most, see tb/golden/test_plan.py
    )  # fmt: skip


def _weight(form: str) -> Iterator[Case]:
    """How far a highlight is; normals of about unit length, and any."""

    def golden(i: Arrays) -> Arrays:
        n, h = (np.stack([i[f"{name}.{axis}"] for axis in "xyz"], -1) for name in ("normal_i", "h_i"))
        limits = i["planner_i.sharpness_exp"], i["kappa_i"], i["planner_i.weight"]
        return {"weight_o": plan.weight(n, h, *limits)}

    def vectors(rng: np.random.Generator, rows: int) -> Arrays:
        unit = {
            f"normal_i.{axis}": v << k.STEP_F - k.INTENSITY_F
            for axis, v in zip("xyz", unit_vectors(rng, rows), strict=True)
        }
        free = mixed({name: signed_range(k.STEP_W) for name in unit})(rng, rows)
        n = {name: np.where(rng.random(rows) < 0.8, v, free[name]) for name, v in unit.items()}
        h = {f"h_i.{axis}": np.full(rows, v[0]) for axis, v in zip("xyz", unit_vectors(rng, 1), strict=True)}
        kappa = rng.integers(0, 1 << k.KAPPA_W, rows) >> rng.integers(0, k.KAPPA_W, rows)
        unused = {f"planner_i.{name}": np.zeros(rows, np.int64) for name in ("t1", "t2", "t3", "threshold")}
        static = unused | {"planner_i.weight": np.full(rows, rng.integers(1 << k.WEIGHT_W))}
        return n | h | {"kappa_i": kappa} | sharpness(rng, rows) | static

    yield Case(
        "shade_weight", form, {}, golden, golden, golden, vectors, None, k.LATENCY_WEIGHT, 4, bound=0, unit_f=0,
        chunk=1 << 13, late={"kappa_i": 16},
    )  # fmt: skip


def _planner(form: str) -> Iterator[Case]:
    """Plans of spans of all lengths and of counts that are none, adaptive, flat and of a fixed degree."""

    def vectors(rng: np.random.Generator, rows: int) -> Arrays:
        limits = (
            plan.THRESHOLDS if rng.integers(2) else np.sort(rng.integers(0, 1 << rng.integers(1, k.KAPPA_W + 1, 3)))
        )
        static = dict(zip((f"planner_i.{name}" for name in ("t1", "t2", "t3")), limits, strict=True)) | {
            "fixed_degree_i": rng.integers(1, 4) if rng.integers(4) == 0 else 0, "planner_i.threshold": 0,
            "planner_i.weight": rng.integers(1 << k.WEIGHT_W),
        }  # fmt: skip
        static |= {f"h_i.{axis}": v for axis, v in zip("xyz", rng.integers(-ONE, ONE + 1, 3), strict=True)}
        low, high = signed_range(k.STEP_W)
        near_one = 1 << k.STEP_F >> rng.integers(0, 3, rows)
        normal = {
            f"normal_i.{axis}": np.where(
                rng.random(rows) < 0.5, rng.integers(low, high, rows), rng.integers(-near_one, near_one + 1)
            )
            for axis in "xyz"
        }
        near = (1 << rng.integers(0, k.COUNT_W, rows)) + rng.integers(-2, 3, rows)
        count = np.choose(rng.integers(0, 3, rows), [near, rng.integers(0, 20, rows), rng.integers(0, 8192, rows)])
        return (
            normal
            | increments("increment_i", rng, rows)
            | {"count_i": count.clip(0, (1 << k.COUNT_W) - 1), "flat_i": (rng.random(rows) < 0.1).astype(np.int64)}
            | sharpness(rng, rows)
            | {name: np.full(rows, value) for name, value in static.items()}
        )

    def golden(i: Arrays, log2_max: int = k.RECORD_LOG2) -> Arrays:
        n, h = (np.stack([i[f"{name}.{axis}"] for axis in "xyz"], -1) for name in ("normal_i", "h_i"))
        far = lambda arc: plan.weight(n, h, i["planner_i.sharpness_exp"], arc, i["planner_i.weight"])  # noqa: E731
        planned = plan.planner(
            *(i[f"increment_i.{axis}"] for axis in "xyz"), i["count_i"], i["planner_i.sharpness"],
            i["planner_i.sharpness_exp"], tuple(i[f"planner_i.{name}"] for name in ("t1", "t2", "t3")),
            int(i["fixed_degree_i"][0]), i["flat_i"], log2_max, far,
        )  # fmt: skip
        split = (planned.main != 0).astype(np.int64)
        return {f"plan_o.{name}": value for name, value in (planned._asdict() | {"split": split}).items()}

    for log2_max in (k.RECORD_LOG2, 4, k.LOG2_MAX):
        made = partial(golden, log2_max=log2_max)
        yield Case(
            "shade_planner", form, {"LOG2_MAX": log2_max}, made, made, made, vectors, None,
            k.planner_latency(log2_max), k.planner_pace(log2_max), bound=0, unit_f=0, chunk=1 << 13,
        )  # fmt: skip


def cases() -> Iterator[Case]:
    """All cases of ``rtl/plan``."""
    yield from in_forms(_criterion)
    yield from in_forms(_kappa, _weight, _planner, only="refined")
