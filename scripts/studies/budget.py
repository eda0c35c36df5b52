# SPDX-License-Identifier: Apache-2.0
"""``make budget``: the error of every stage against an oracle, and how the errors add up; docs/error-budget.md.

The oracle (``ORACLES``) computes a stage's formula, as the papers have it, with 40 decimal digits from the stage's
inputs alone: it knows formats, registers and the printed constants, and nothing of the golden model. Every
stage's vectors, as ``make units`` drives them, are searched for the largest errors in extended precision; the rows with
the largest ones, and random rows, go to the oracle. So the worst case of the document is the oracle's word, and
``disagreement`` tells by how much the search's own exact value differs from it, at most.

``build/budget.json``: {"<stage>": {bound, worst, input, ulp, disagreement, rows, vectors}, "light": {"<n>": ..}}.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from mpmath import mp, mpf
from polyshade.golden import contract as k
from polyshade.golden import material
from polyshade.scripts.report import save
from polyshade.sim.errors import UserError
from polyshade.sim.sources import BUILD, ROOT
from polyshade.sim.units import Case, cases
from tqdm import tqdm

mp.dps = 40
OUT = BUILD / "budget.json"
DOCUMENT = ROOT / "docs" / "error-budget.md"
VECTORS = 400_000
LARGEST, RANDOM = 8, 24  # rows of a chunk that the oracle sees
SHININESS = (8, 32, 128, 512, 1024)
ONE = 1 << k.INTENSITY_F
LOW, HIGH = -(1 << k.INTENSITY_W - 1), (1 << k.INTENSITY_W - 1) - 1
LEBESGUE = 1.6312  # of interpolation at four evenly spaced nodes: by so much an error of the nodes may grow

Row = dict[str, int]


def _clamp(value, low, high):
    return min(max(value, low), high)


def flat(name: str) -> str:
    """Fields of structures as ports of their own: ``a_i.x`` is ax_i, ``material_i.lobe.k1`` k1_i, ``n_o.x`` nx_o,
    ``colour_i.kd.r`` kd_r_i."""
    port, *path = name.split(".")
    if not path:
        return name
    base, way = port[:-2], port[-2:]
    before = [base, *path][-2]
    return {"x": before, "y": before, "z": before}.get(path[-1], f"{before}_" * (path[-1] in "rgb")) + path[-1] + way


def _vector(row: Row, name: str) -> list:
    return [mpf(row[f"{name}{axis}_i"]) for axis in "xyz"]


def _dot(a: list, b: list):
    return sum(x * y for x, y in zip(a, b, strict=True))


def _third(row: Row, case: Case) -> dict:
    return {"y_o": mpf(row["x_i"]) / 3 if case.form == "refined" else mpf(row["x_i"]) * 43 / 128}


def _rsqrt(row: Row, case: Case) -> dict:
    """y 2^-e is 1/sqrt(z), with y in (1/2, 1]."""
    z = row["z_i"]
    if not z:
        return {"y_o": mpf(0)}
    return {"y_o": mp.ldexp(1 / mp.sqrt(z), (z.bit_length() - 1) // 2 + k.RSQRT_F)}


def _coef(row: Row, case: Case) -> dict:
    """Newton's form through I1 .. I4 at 0, 1/4, 1/2, 1 (left) or 0, 1/2, 3/4, 1: coefficients of the polynomial."""
    values = [mpf(row[f"i{n}_i"]) for n in range(1, 5)]
    left = case.parameters.get("NODES", k.NODES_LEFT) == k.NODES_LEFT
    places = [mpf(0), mpf(1) / 4 if left else mpf(1) / 2, mpf(1) / 2 if left else mpf(3) / 4, mpf(1)]
    degree = row["degree_i"]
    if degree == 0:
        return {"a_o": mpf(0), "b_o": mpf(0), "c_o": mpf(0), "d_o": values[0]}
    if degree < 3:
        places = [mpf(n) / degree for n in range(degree + 1)]
        values = values[: degree + 1]
    a, b, c, d = [mpf(0)] * (4 - len(places)) + _polynomial(places, values)
    return {"a_o": a, "b_o": b, "c_o": c, "d_o": d}


def _polynomial(places: list, values: list) -> list:
    """Coefficients, the highest first, of the polynomial through points: Lagrange's basis, multiplied out."""
    total = [mpf(0)] * len(places)
    for i, value in enumerate(values):
        basis, scale = [mpf(1)], mpf(1)
        for j, place in enumerate(places):
            if j != i:
                basis = [p - place * q for p, q in zip([*basis, mpf(0)], [mpf(0), *basis], strict=True)]
                scale *= places[i] - place
        total = [t + value * b / scale for t, b in zip(total, basis, strict=True)]
    return total


def _horner(row: Row, case: Case) -> dict:
    t = mpf(row["t_i"]) / (1 << case.parameters["T_F"])
    return {"y_o": sum(row[f"{name}_i"] * t**power for name, power in zip("abcd", (3, 2, 1, 0), strict=True))}


def _normalize(row: Row, case: Case) -> dict:
    v = _vector(row, "v")
    length = mp.sqrt(_dot(v, v))
    return {f"n{axis}_o": x * ONE / length if length else mpf(0) for axis, x in zip("xyz", v, strict=True)}


def _unit(row: Row, case: Case) -> dict:
    """v / |v|; of a vector shorter than 1/4 the factor stops growing with powers of two."""
    v = _vector(row, "v")
    if row["bypass_i"]:
        return {f"normal{axis}_o": _clamp(2 * x, LOW, HIGH) for axis, x in zip("xyz", v, strict=True)}
    length = mp.sqrt(_dot(v, v))
    if not length:
        return {f"normal{axis}_o": mpf(0) for axis in "xyz"}
    exponent = mp.frexp(length)[1]
    lack = max(0, k.NODE_F - 2 - exponent)
    return {f"normal{axis}_o": mp.ldexp(x * ONE / length, -lack) for axis, x in zip("xyz", v, strict=True)}


def _dot3(row: Row, case: Case) -> dict:
    return {"d_o": mp.ldexp(_dot(_vector(row, "a"), _vector(row, "b")), case.parameters["OUT_F"] - 2 * k.INTENSITY_F)}


def _versine(row: Row, case: Case) -> dict:
    a, b = ([x / ONE for x in _vector(row, name)] for name in "ab")
    if case.form == "refined":
        chord = [_clamp((x - y) * ONE, LOW, HIGH) / ONE for x, y in zip(a, b, strict=True)]
        x = _dot(chord, chord) / 2
    else:
        x = 1 - _dot(a, b)
    return {"x_o": mp.ldexp(_clamp(x, 0, 2), k.VERSINE_F)}


def _reflect(row: Row, case: Case) -> dict:
    n, l = ([x / ONE for x in _vector(row, name)] for name in "nl")  # noqa: E741
    twice = _clamp(2 * _dot(n, l), -mpf(HIGH) / ONE, 2)
    mirror = [_clamp((twice * x - y) * ONE, LOW, HIGH) for x, y in zip(n, l, strict=True)]
    return dict(zip(("rx_o", "ry_o", "rz_o"), mirror, strict=True))


def _halfway(row: Row, case: Case) -> dict:
    l, v = _vector(row, "l"), _vector(row, "v")  # noqa: E741
    s = [_clamp(x + y, LOW, HIGH) for x, y in zip(l, v, strict=True)]
    length = mp.sqrt(_dot(s, s))
    h = [x / length if length else mpf(0) for x in s]
    return dict(zip(("hx_o", "hy_o", "hz_o", "vh_o"), [*(x * ONE for x in h), _clamp(_dot(v, h), 0, ONE)], strict=True))


def _lobe(row: Row, case: Case) -> dict:
    """Of x as far as it counts: 20 fraction bits and as many as the lobe scales it up; 1 as long as 20 bits say so."""
    drop = k.VERSINE_CUT - (0 if row["shift_i"] == k.LOBE_FINE else row["shift_i"])
    x, one = row["x_i"] >> drop << drop, 1 << k.VERSINE_F
    x = one if one < x < one + (1 << k.VERSINE_CUT) else x
    return {"lobe_o": _clamped_power(mpf(x) / one, row, case.parameters["POWER"]) * ONE}


def _clamped_power(x, registers: Row, stages: int = 4):
    """max(0, 1 - k1 s + k2 s^2)^(2^power) of s, which is x, scaled and limited; 0 beyond x = 1."""
    if x > 1:
        return mpf(0)
    fine = registers["shift_i"] == k.LOBE_FINE
    s = min(x if fine else mp.ldexp(x, registers["shift_i"]), mpf(registers["xmax_i"]) / (1 << k.LOBE_X_F))
    k1, k2 = mpf(registers["k1_i"]) / (1 << k.LOBE_K1_F), mpf(registers["k2_i"]) / (1 << k.LOBE_K2_F)
    base = 1 - (k1 * s - k2 * s * s) / (1 << k.LOBE_FINE_F if fine else 1)
    return _clamp(base, 0, 1) ** (1 << min(registers["power_i"], stages))


def _fresnel(row: Row, case: Case) -> dict:
    c, f0 = (min(mpf(row[name]) / ONE, 1) for name in ("c_i", "f0_i"))
    return {"f_o": (f0 + (1 - f0) * (1 - c) ** 5) * ONE}


def _colour(row: Row, case: Case) -> dict:
    made = {}
    for c in ("red", "green", "blue"):
        ambient, kd, ks = (mpf(row[f"{name}_{c[0]}_i"]) / ONE for name in ("ambient", "kd", "ks"))
        light = ambient * ONE + kd * max(row["diffuse_i"], 0) + ks * max(row["specular_i"], 0)
        made[f"{c}_o"] = _clamp(light, 0, ONE - 1)
    return made


def _light(row: Row, case: Case) -> dict:
    """Lambert and Blinn-Phong: N.L, and the lobe of 1 - N.H times the gain, of vectors and registers as they are."""
    n, l, h = ([x / ONE for x in _vector(row, name)] for name in "nlh")  # noqa: E741
    made = {"diffuse_o": _clamp(_dot(n, l) * ONE, LOW, HIGH)}
    if row["model_i"] == k.MODEL_BLINN:
        chord = [_clamp((x - y) * ONE, LOW, HIGH) / ONE for x, y in zip(n, h, strict=True)]
        x = _clamp(_dot(chord, chord) / 2 if case.form == "refined" else 1 - _dot(n, h), 0, 2)
        gain = mp.ldexp(mpf(row["gain_i"]), row["gain_exp_i"] - k.GAIN_F)
        shade = _clamp(_dot(n, l), 0, 1) if row["cosine_i"] else 1
        made["specular_o"] = _clamp(_clamped_power(x, row) * shade * gain * ONE, 0, HIGH)
    return made


ORACLES: dict[str, tuple[Callable[[Row, Case], dict], str]] = {
    "shade_normalize": (_normalize, "v / \\|v\\|"),
    "shade_unit": (_unit, "v / \\|v\\| of a vector of length 1/4 to 4"),
    "shade_rsqrt": (_rsqrt, "1 / sqrt(z), mantissa"),
    "shade_dot3": (_dot3, "a . b"),
    "shade_reflect": (_reflect, "2 (N.L) N - L"),
    "shade_halfway": (_halfway, "(L + V) / \\|L + V\\|, V.H"),
    "shade_versine": (_versine, "1 - cos: \\|a - b\\|^2 / 2; paper form: 1 - a.b"),
    "shade_lobe": (_lobe, "max(0, 1 - k1 x + k2 x^2)^16"),
    "shade_fresnel": (_fresnel, "f0 + (1 - f0) (1 - c)^5"),
    "shade_light": (_light, "N.L, lobe(1 - N.H) gain: Lambert, Blinn-Phong"),
    "shade_third": (_third, "x / 3; paper form: 43 x / 128"),
    "shade_coef": (_coef, "the polynomial through four nodes"),
    "shade_horner_pipe": (_horner, "((a t + b) t + c) t + d"),
    "shade_colour": (_colour, "ambient + kd N.L + ks specular"),
}


def fits(case: Case) -> bool:
    """Does the oracle know the case's formula? Of light only that of two models, of coefficients not the 43/128."""
    if case.module == "shade_light":
        return case.note in ("lambert", "blinn") and "REFLECT" not in case.parameters
    measured = case.exact is not case.golden  # else only the equality of RTL and golden model is looked at
    return measured and case.module in ORACLES and not (case.module == "shade_coef" and case.form == "paper")


def judge(case: Case, vectors: int, seed: int) -> dict:
    """The worst row of a case by the oracle."""
    oracle, _ = ORACLES[case.module]
    rng = np.random.default_rng(seed)
    found = {"worst": 0.0, "input": {}, "disagreement": 0.0, "rows": 0, "vectors": 0}
    for inputs in case.stream(vectors, seed):
        golden, exact = case.golden(inputs), case.exact(inputs)
        count = len(next(iter(inputs.values())))
        found["vectors"] += count
        names = [name for name in golden if flat(name) in oracle({flat(n): int(v[0]) for n, v in inputs.items()}, case)]
        total = np.max([np.abs(golden[name] - exact[name]).astype(float) for name in names], axis=0)
        chosen = np.r_[np.argsort(total)[-LARGEST:], rng.integers(0, count, RANDOM)]
        for index in chosen:
            row = {flat(name): int(value[index]) for name, value in inputs.items()}
            true = oracle(row, case)
            for name in names:
                error = abs(int(golden[name][index]) - true[flat(name)])
                apart = abs(mpf(str(exact[name][index])) - true[flat(name)]) if np.ndim(exact[name]) else mpf(0)
                found["disagreement"] = max(found["disagreement"], float(apart))
                if error > found["worst"]:
                    found["worst"], found["input"] = float(error), row | {"output": flat(name)}
        found["rows"] += len(chosen)
    return found


def light_by_shininess(seed: int) -> dict[str, float]:
    """Of Blinn-Phong with gain 1: the worst error in ulp by the oracle, N around H."""
    case = next(case for case in cases() if case.module == "shade_light" and case.note == "blinn" and fits(case))
    rng, worst = np.random.default_rng(seed), {}
    for n in SHININESS:
        surface = material.Material("blinn", float(n), exposure=1.0)
        words = material.registers(surface, (0.3, 0.6, 0.8)) | {"model": k.MODEL_BLINN}
        rows = 100_000
        h = np.reshape([words[f"h{axis}"] for axis in "xyz"], (3, 1))
        bent = h + rng.standard_normal((3, rows)) * ONE * rng.uniform(0, 2, rows) / n**0.5
        normal = np.rint(bent / np.linalg.norm(bent, axis=0) * ONE).astype(np.int64)
        inputs = {f"{name}_i": np.full(rows, value) for name, value in words.items()}
        inputs |= {f"n{axis}_i": part for axis, part in zip("xyz", normal, strict=True)}
        inputs = {name: inputs[flat(name)] for name in next(case.stream(1, 1))}
        golden, exact = (of(inputs)["light_o.specular"] for of in (case.golden, case.exact))
        error = mpf(0)
        for index in np.argsort(np.abs(golden - exact).astype(float))[-LARGEST:]:
            row = {flat(name): int(value[index]) for name, value in inputs.items()}
            error = max(error, abs(int(golden[index]) - _light(row, case)["specular_o"]))
        worst[str(n)] = float(error)
    return worst


def document(report: dict) -> str:
    """docs/error-budget.md."""
    stages = {name: row for name, row in report.items() if name != "light"}
    table = "\n".join(
        f"| `{name}` | {row['formula']} | {row['bound']:.2f} | {row['worst']:.4f} | {row['ulp']} "
        f"| {_shown(row['input'])} |"
        for name, row in stages.items()
    )
    tail = 2 / (9 * 3**0.5) + 11 / 16
    sums = "\n".join(
        f"| {n} | {error:.2f} | {LEBESGUE * error:.2f} | {pixel:.2f} | {pixel / ONE:.1e} |"
        for n, error in report["light"].items()
        for pixel in [LEBESGUE * error + tail]
    )
    checked, searched = (sum(row[key] for row in stages.values()) for key in ("rows", "vectors"))
    return f"""# Error budget

Generated by `make budget`. Every stage's result is compared with its formula, computed with {mp.dps} decimal digits
from the stage's own inputs by an oracle that knows the papers' formulas, formats and registers and nothing of the
golden model (`scripts/studies/budget.py`). The rows that it saw are those with the largest errors among
{searched:,} vectors, and random ones: {checked:,} in all. RTL and golden model are equal to the bit, so these are the
hardware's errors as well.

## The stages

One ulp is the last bit of the stage's output. A stage is judged on its inputs as they are: what the stages before it
did is theirs.

| stage | formula | bound | worst | ulp | input of the worst case |
| --- | --- | ---: | ---: | --- | --- |
{table}

## How they add up

A pixel of the polynomial path takes light at its nodes, coefficients, and an evaluation:

1. *Light at a node* is off by an amount that grows with the shininess n: light falls by n times what x = 1 - N.H lacks
   of its {k.VERSINE_F} fraction bits. The table has the oracle's word on Blinn-Phong with gain 1, for 100,000 normals
   around H for each n, of which those with the largest errors were looked at.
2. *Interpolation* through four nodes lets an error of the nodes grow by at most {LEBESGUE}, the Lebesgue constant of
   evenly spaced nodes.
3. *Coefficients* add at most 2/(9 √3) = 0.128 ulp (a third each of A and C, never in the same direction), *evaluation*
   1/2 ulp, by Horner's rule 3/16 more.

| n | light at a node, worst, ulp | times {LEBESGUE} | pixel, at most, ulp | as intensity |
| ---: | ---: | ---: | ---: | ---: |
{sums}

What is left is the *method's* error, of a cubic between nodes in place of the light itself: the planner keeps it within
the thresholds of κ = n (1 − c) ([papers](papers.md)). `nmse_specular` and `max_error` of a frame's report have both
together.
"""


def _shown(row: Row) -> str:
    return ", ".join(f"{name.removesuffix('_i')} {value}" for name, value in row.items())


def main(vectors: int = VECTORS, seed: int = 1) -> int:
    """Measure, write the report and the document; 1 when a bound is broken or the oracle contradicts the search."""
    if not 1 <= vectors <= 100_000_000:
        raise UserError(f"--vectors: {vectors} is out of range, allowed is 1 to 100000000")
    groups: dict[str, list[Case]] = {}
    for module in ORACLES:
        for case in cases():
            if case.module == module and fits(case):
                groups.setdefault(f"{module}/{case.form}", []).append(case)
    report: dict[str, dict] = {}
    for name, group in tqdm(groups.items(), "budget", disable=None):
        found = [judge(case, vectors, seed) for case in group]
        worst = max(found, key=lambda row: row["worst"])
        report[name] = worst | {
            "formula": ORACLES[group[0].module][1],
            "bound": max(case.limit for case in group),
            "ulp": f"2^-{group[0].unit_f}",
            "disagreement": max(row["disagreement"] for row in found),
            "rows": sum(row["rows"] for row in found),
            "vectors": sum(row["vectors"] for row in found),
        }
    report["light"] = light_by_shininess(seed)
    save(OUT, report)
    DOCUMENT.write_text(document(report))
    wrong = []
    for name, row in report.items():
        if name == "light":
            continue
        print(f"{name:28} bound {row['bound']:8.3f} worst {row['worst']:9.4f} disagreement {row['disagreement']:.1e}")
        if row["worst"] > row["bound"] + 1e-9:
            wrong.append(f"{name}: error {row['worst']} beyond its bound {row['bound']}: {row['input']}")
        if row["disagreement"] > 1e-3:
            wrong.append(f"{name}: the exact value in sim/units differs from the oracle's by {row['disagreement']} ulp")
    print("\n".join(wrong or ["every error is within its bound"]))
    return int(bool(wrong))
