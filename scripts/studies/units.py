# SPDX-License-Identifier: Apache-2.0
"""``make units``: every unit, both forms, measured over many vectors; left in ``build/units.json``.

    {"<module>/<form>": {vectors, exhaustive, mismatches, max_error_ulp, max_error_ideal, worst_input, latency,
                         throughput}}

All parameter points of a unit are taken together. ``exhaustive``: no point left a possible input out.
``max_error_ulp``: against the exact value of the unit's formula on its inputs, in its last bit;
``max_error_ideal``: against the function that the formula approximates, as a number.
``latency`` in clocks, ``throughput`` in results a clock.
"""

from __future__ import annotations

import sys

from polyshade.scripts.report import save
from polyshade.sim.errors import UserError
from polyshade.sim.sources import BUILD
from polyshade.sim.units import Case, Result, cases
from polyshade.sim.units.stream import measured
from tqdm import tqdm

OUT = BUILD / "units.json"
ALLOWED = (1, 1_000_000_000)


def row(result: Result, exhaustive: bool) -> dict:
    """A result as a row of the report."""
    names = ("vectors", "mismatches", "max_error_ulp", "max_error_ideal", "worst_input", "latency", "throughput")
    return {"exhaustive": exhaustive} | {name: getattr(result, name) for name in names}


def measure(vectors: int, seed: int) -> tuple[dict[str, dict], list[str]]:
    """The report, and the first mismatch of every unit that has one."""
    groups: dict[str, list[Case]] = {}
    for case in cases():
        groups.setdefault(f"{case.module}/{case.form}", []).append(case)
    report, faults = {}, []
    with tqdm(desc="units", unit="vector", unit_scale=True, disable=None, delay=2, leave=False) as bar:
        for name, group in groups.items():
            bar.set_description(name)
            total = Result()
            for case in group:
                total.add(case.check(vectors, seed, bar.update))
            report[name] = row(total, all(case.all_vectors for case in group))
            faults += [total.first_mismatch] * bool(total.mismatches)

        def stream(name: str, result: Result) -> None:
            bar.set_description(name)
            bar.update(result.vectors)
            report[name] = row(result, False)
            faults.extend([result.first_mismatch] * bool(result.mismatches))

        items = max(64, min(vectors, 10_000_000) // 12)  # they have about so many words
        for name, stream in measured().items():
            bar.set_description(name)
            result = stream.check(items, seed)
            bar.update(result.vectors)
            report[name] = row(result, False)
            faults += [result.first_mismatch] * bool(result.mismatches)
    return report, faults


def main(vectors: int = 1_000_000, seed: int = 1) -> int:
    """Measure, write the report, print a table; 1 if any unit differs from its golden model."""
    if not ALLOWED[0] <= vectors <= ALLOWED[1]:
        raise UserError(f"--vectors: {vectors} is out of range, allowed is {ALLOWED[0]} to {ALLOWED[1]}")
    if not 0 <= seed < 1 << 32:
        raise UserError(f"--seed: {seed} is out of range, allowed is 0 to {(1 << 32) - 1}")
    report, faults = measure(vectors, seed)
    save(OUT, report)
    print(f"{'unit':42} {'vectors':>11} {'mismatches':>10} {'ulp':>9} {'ideal':>11} {'latency':>7} {'per clock':>9}")
    for name, r in report.items():
        print(
            f"{name:42} {r['vectors']:11,} {r['mismatches']:10} {r['max_error_ulp']:9.4f} {r['max_error_ideal']:11.2e} "
            f"{r['latency']:7} {r['throughput']:9.3f}"
        )
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0
