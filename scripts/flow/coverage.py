# SPDX-License-Identifier: Apache-2.0
"""``make coverage``: what the tests reach in the RTL; left in ``build/coverage.json``.

    {"<module>": {line, branch, toggle, holes: [..]}, "functional": {"<cross>": {per_cent, holes: [..]}}}

In per cent. The tests that simulate are run with counters that Verilator puts into the models: of every line, of every
way of a branch, and of every bit of a signal that rises and that falls. What any instance in any model at any parameter
point reaches is reached. ``holes`` names the rest: ``line 43``, ``branch 44 else``, ``toggle credit_q[3]:1->0``.

``tb/holes.json`` says of holes why they cannot be reached: {"<module>": {"<hole>": why}}; they are left out of the
per cent, and one that is reached after all is an error.

Functional coverage is that of random work (``scripts/flow/soak.py``, seeds 0 to ``SEEDS`` - 1) over crosses of models,
forms, paths, lanes, gaps, stalls, resets and faults, collected by cocotb-coverage.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import time
from collections import defaultdict
from collections.abc import Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from importlib.util import find_spec
from pathlib import Path

from polyshade.golden.material import DIRECT_MODELS, MODELS
from polyshade.scripts.flow import soak
from polyshade.scripts.report import save
from polyshade.sim.errors import UserError
from polyshade.sim.sources import BUILD, ROOT, modules
from polyshade.sim.verilate import COVERAGE
from tqdm import tqdm

OUT = BUILD / "coverage.json"
DATA = BUILD / "coverage"
HOLES = ROOT / "tb" / "holes.json"
TESTS = [f"tb/{name}" for name in ("test_units.py", "core", "fixed", "light", "normal", "plan", "poly", "raster", "sim",
                                   "stream", "surface")]  # fmt: skip
SEEDS = 700
FIELD = re.compile(r"\x01(\w+)\x02([^\x01']*)")
KINDS = ("line", "branch", "toggle")

Counts = dict[tuple[str, str], int]  # of a module and a point


@cache
def point(key: str) -> tuple[str, str]:
    """Module and point of an entry's key in a file of Verilator's counts."""
    found = dict(FIELD.findall(key))
    kind = found["page"].partition("/")[0].removeprefix("v_")
    place = f" {found['l']}" * (kind != "toggle")
    what = re.sub(r"\s+", " ", found["o"])
    what = "" if kind == "line" and what in ("block", "") else f" {what}"
    return Path(found["f"]).stem, f"{kind}{place}{what}"


def gather(folder: Path, counts: Counts, age: float = 0.0) -> None:
    """Add the counts of all files and remove the files, but those of the last ``age`` seconds, perhaps unfinished."""
    for path in folder.glob("*.dat"):
        if time.time() - path.stat().st_mtime < age:
            continue
        for line in path.read_text(errors="replace").splitlines():
            if line.startswith("C '"):
                key, _, count = line.rpartition("' ")
                counts[point(key)] += int(count)
        path.unlink()


def summary(counts: Counts, known: dict[str, dict[str, str]]) -> tuple[dict[str, dict], list[str]]:
    """The report of every module, and the holes said to be out of reach that were reached."""
    report, wrong = {}, []
    for module in modules():
        own = {point: count for (name, point), count in counts.items() if name == module}
        excused = known.get(module, {})
        wrong += [f"{module}: {point}: reached, though said not to be" for point in excused if own.get(point)]
        row: dict[str, object] = {}
        for kind in KINDS:
            chosen = [point for point in own if point.startswith(f"{kind} ") and point not in excused]
            row[kind] = round(100 * sum(own[point] > 0 for point in chosen) / len(chosen), 2) if chosen else None
        row["holes"] = sorted((p for p, count in own.items() if not count and p not in excused), key=_place)
        report[module] = row
    return report, wrong


def _place(point: str) -> tuple[str, int, str]:
    kind, _, rest = point.partition(" ")
    number = re.match(r"\d+", rest)
    return kind, int(number[0]) if number else 0, rest


# ---- functional ----------------------------------------------------------------------------------------------------


def functional(outcomes: Iterable[soak.Outcome]) -> dict[str, dict]:
    """The crosses of what random work was, by cocotb-coverage; only work that agreed counts."""
    from cocotb_coverage.coverage import CoverCross, CoverPoint, coverage_db

    coverage_db.clear()
    both = [False, True]
    cores = {"model": [*MODELS], "form": ["refined", "paper"], "path": ["line", "normals"], "lanes": [1, 2, 4],
             "gap": both, "stall": both, "reset": both, "fault": ["none", "light"]}  # fmt: skip
    surfaces = {"model": [*DIRECT_MODELS], "lanes": [1, 2, 4, 8], "gap": both, "stall": both, "reset": both}
    crosses = {
        "core": (cores, [("model", "form", "path"), ("form", "lanes", "path", "gap", "stall"),
                         ("path", "reset", "stall"), ("model", "fault")]),
        "patch": (surfaces, [("model", "lanes"), ("lanes", "gap", "stall"), ("lanes", "reset")]),
        "direct": (surfaces | {"lanes": [1]}, [("model", "gap", "stall"), ("reset", "stall")]),
        "scan": ({"cull": [0, 1, 2], "gap": both, "stall": both, "reset": both},
                 [("cull", "gap", "stall"), ("reset", "stall")]),
        "spans": ({"form": ["refined", "paper"], "evaluator": [0, 1], "gap": both, "stall": both},
                  [("form", "evaluator", "gap", "stall")]),
        "normals": ({"gap": both, "stall": both}, [("gap", "stall")]),
    }  # fmt: skip

    def sampler(kind: str):
        def sample(bins: dict) -> None:
            """What the decorators look at."""

        values, products = crosses[kind]
        # the library wants points made before their crosses, and sampled before them
        own = [
            CoverPoint(f"{kind}.{name}", xf=lambda bins, n=name: bins[n], bins=bins) for name, bins in values.items()
        ]
        both = [CoverCross(f"{kind}.{' x '.join(cross)}", items=[f"{kind}.{n}" for n in cross]) for cross in products]
        for decorate in [*both, *own]:
            sample = decorate(sample)
        return sample

    samplers = {kind: sampler(kind) for kind in crosses}
    for made in outcomes:
        if made.kind in samplers and not made.mismatches:
            samplers[made.kind](made.bins)
    report = {}
    for kind, (_, products) in crosses.items():
        for cross in products:
            name = f"{kind}.{' x '.join(cross)}"
            hits = coverage_db[name].detailed_coverage
            missing = [
                ", ".join(f"{n}={v}" for n, v in zip(cross, bins, strict=True)) for bins, n in hits.items() if not n
            ]
            report[name] = {"per_cent": round(100 * (1 - len(missing) / len(hits)), 2), "holes": missing}
    return report


# ---- the whole -----------------------------------------------------------------------------------------------------


def main(tests: Sequence[str] = (), seeds: int = SEEDS) -> int:
    """Run the tests, or those named, and as many items of random work; 1 when a test fails or a hole is no hole."""
    for name in ("pytest", "cocotb_coverage"):
        if find_spec(name) is None:
            raise UserError(f"{name}: missing, install with: make distclean setup")
    if not 0 <= seeds <= 1_000_000:
        raise UserError(f"--seeds: {seeds} is out of range, allowed is 0 to 1000000")
    for test in tests:
        if not (ROOT / test.partition("::")[0]).exists():
            raise UserError(f"{test}: no such test, allowed {', '.join(TESTS)} or a part of them")
    shutil.rmtree(DATA, ignore_errors=True)
    DATA.mkdir(parents=True)
    environment = os.environ | {COVERAGE: str(DATA)}
    jobs = os.environ.get("JOBS") or "auto"
    command = [sys.executable, "-m", "pytest", "-q", "-n", jobs, "--dist", "worksteal", *(tests or TESTS)]
    counts: Counts = defaultdict(int)
    with subprocess.Popen(command, cwd=ROOT, env=environment) as running:
        while running.poll() is None:  # a file a run of a model: together they would fill a disk
            gather(DATA, counts, 10.0)
            time.sleep(2)
        failed = running.returncode
    gather(DATA, counts)
    report, wrong = summary(counts, json.loads(HOLES.read_text()) if HOLES.exists() else {})
    with ProcessPoolExecutor(int(os.environ.get("JOBS") or os.cpu_count())) as pool:
        done = list(tqdm(pool.map(soak.item, range(seeds)), "functional", seeds, disable=None))
    crosses = functional(done)
    if not tests:
        save(OUT, {**report, "functional": crosses})
    for module, row in report.items():
        shown = " ".join(f"{kind} {'-' if row[kind] is None else row[kind]:>6}" for kind in KINDS)
        if any(row[kind] is not None for kind in KINDS):
            print(f"{module:24} {shown} holes {len(row['holes'])}: {', '.join(row['holes'][:4])}")
    for name, row in crosses.items():
        print(f"{name}: {row['per_cent']} %, holes {len(row['holes'])}: {'; '.join(row['holes'][:4])}")
    wrong += [f"{made.kind}, seed {made.seed}: {made.first}" for made in done if made.mismatches]
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if failed or wrong else 0
