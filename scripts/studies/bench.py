# SPDX-License-Identifier: Apache-2.0
"""``make bench``: how fast a frame is simulated, and what the core gains; left in ``build/bench.json``.

    {"<name>": {value, unit, versus, ratio}}

``ratio`` is value / value of ``versus``. Speeds are medians of several runs in one go, all of the same frame: the
default head at 1024 x 1024, Blinn-Phong, n = 32. cocotb gets the first spans of it only, without gaps, stalls or
checks: the least that a bench in Python does. The core's gains over ``shade_phong``: see ``scripts.studies.gains``.
"""

from __future__ import annotations

import json
import os
import statistics
import time
from collections.abc import Callable
from unittest import mock

import numpy as np
from cocotb_tools.runner import get_runner
from polyshade import sim
from polyshade.golden import contract, plan, poly
from polyshade.golden.material import planner_registers, registers
from polyshade.golden.registers import pack
from polyshade.scripts.report import save
from polyshade.scripts.studies import gains
from polyshade.scripts.studies.papers.view import view
from polyshade.sim import frame
from polyshade.sim.core import WHOLE, Lines
from polyshade.sim.sources import BUILD
from polyshade.sim.tools import environment
from polyshade.sim.verilate import reached
from tqdm import tqdm

OUT = BUILD / "bench.json"
WORK = BUILD / "bench"
RUNS = 5
COCOTB_PIXELS = 20_000


def median_seconds(job: Callable[[], object], runs: int = RUNS) -> float:
    """Median wall time of a job, after one run that does not count."""
    job()
    times = []
    for _ in range(runs):
        began = time.perf_counter()
        job()
        times.append(time.perf_counter() - began)
    return statistics.median(times)


def cocotb_seconds(beats: np.ndarray, pixels: int) -> float:
    """Wall time in which a cocotb bench takes spans through shade_poly_span, start-up left out."""
    WORK.mkdir(parents=True, exist_ok=True)
    np.save(WORK / "spans.npy", beats)
    runner = get_runner("verilator")
    with mock.patch.dict(os.environ, {**environment(), "BENCH_PIXELS": str(pixels)}):
        runner.build(
            sources=reached("shade_poly_span"), hdl_toplevel="shade_poly_span", build_dir=WORK,
            timescale=("1ns", "1ps"), build_args=["-O3", "--x-assign", "fast", "-CFLAGS", "-O2"],
            log_file=WORK / "build.log",
        )  # fmt: skip
        runner.test(
            test_module="polyshade.scripts.studies.bench_cocotb", hdl_toplevel="shade_poly_span",
            hdl_toplevel_lang="verilog",
            build_dir=WORK, test_dir=WORK, log_file=WORK / "run.log", results_xml=str(WORK / "results.xml"),
        )  # fmt: skip
    return json.loads((WORK / "cocotb.json").read_text())["seconds"]


def main() -> None:
    """Measure, write the report, print a table."""
    scene = view(1024, 32)
    spans = scene.spans
    records = plan.plan(spans.count, scene.kappa)
    nodes, _ = scene.node_light(records)
    beats = poly.pack_records(nodes, records.degree, records.count)
    pixels = spans.pixels

    def model(evaluator: int) -> Callable[[], object]:
        loaded = sim.load("shade_poly_span", EVALUATOR=evaluator, FORM=contract.FORM_REFINED, waves=False)
        return lambda: loaded.run(s_axis_span_tdata=beats)

    def core() -> Callable[[], object]:
        loaded = sim.load("shade_core", waves=False)
        settings = scene.settings
        words = registers(settings.material, settings.light) | planner_registers(settings.material)
        lines = Lines.of(spans).beats
        return lambda: loaded.run(s_axis_span_tdata=lines, **WHOLE, writes=pack(words))

    def phong() -> np.ndarray:
        return scene.light(frame.normals(spans, 1024))

    rates = {}
    with tqdm(total=12, disable=None, delay=2, leave=False) as bar:

        def rate(name: str, count: int, seconds: float) -> None:
            rates[name] = count / seconds
            bar.set_description(name)
            bar.update()

        rate("rtl_core", pixels, median_seconds(core()))
        rate("rtl_horner", pixels, median_seconds(model(contract.EVALUATOR_HORNER)))
        rate("rtl_fdiff", pixels, median_seconds(model(contract.EVALUATOR_FDIFF)))
        rate("golden_numpy", pixels, median_seconds(lambda: poly.poly_span(nodes, records.degree, records.count)))
        rate("phong_float64_numpy", pixels, median_seconds(phong))
        few = int(np.searchsorted(np.cumsum(records.count), COCOTB_PIXELS)) + 1
        count = int(records.count[:few].sum())
        rate("rtl_horner_cocotb", count, cocotb_seconds(beats[:few], count))

        def step(name: str) -> None:
            bar.set_description(name)
            bar.update()

        gained = dict(gains.main(tick=step))

    versus = dict.fromkeys(rates, "rtl_horner_cocotb") | {"rtl_horner_cocotb": "rtl_horner"}
    report = {
        name: {"value": value, "unit": "pixels/s", "versus": versus[name], "ratio": value / rates[versus[name]]}
        for name, value in rates.items()
    }
    report |= gained
    save(OUT, report)
    print(f"{'name':35} {'value':>12} {'unit':20} {'ratio':>8}  versus")
    for name, row in report.items():
        print(f"{name:35} {row['value']:12,.4g} {row['unit']:20} {row['ratio']:8.3g}  {row['versus']}")
