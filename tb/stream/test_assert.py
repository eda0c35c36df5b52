# SPDX-License-Identifier: Apache-2.0
"""Assertions in the RTL: each stops the simulation when its rule is broken, and its name is told."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden.types import PLAN, RECORD, SPAN, VIEW
from polyshade.sim import model, verilate
from polyshade.sim.model import SimulationError
from polyshade.sim.sources import modules, sources

from tb.bench import Bench, checked
from tb.runner import simulate

PLANNED = [leaf.name for leaf in PLAN.leaves()]
EMPTY = dict.fromkeys((leaf.name for leaf in RECORD.leaves()), 0)


def test_cocotb():
    simulate("shade_assert", {})


@checked()
async def holds(bench: Bench) -> None:
    """Nothing happens as long as it holds, or in a reset."""
    for rst, ok in [(0, 1), (1, 0), (1, 1), (0, 1)] * 10:
        bench.dut.rst_i.value, bench.dut.holds_i.value = rst, ok
        await bench.tick()
        bench.checks += 1


def text(module: str) -> str:
    """Its source, without comments."""
    return re.sub(r"//.*", "", modules()[module].read_text())


def instances() -> set[str]:
    """All assertions of the RTL: module and instance."""
    pattern = r"\bshade_(?:assert|stable)\b\s*(?:#\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\))?\s*(u_\w+)"
    return {f"{module}.{name}" for module in modules() for name in re.findall(pattern, text(module))}


RECORD_OF = {name: EMPTY | {"head.count": n, "head.degree": d} for name, n, d in (("none", 0, 3), ("long", 5, 0))}
NOTHING = dict.fromkeys(PLANNED, 0) | {"last_count": 1}
QUIET = {"events_i": 0, "counts_i": 0, "busy_i": [0] * 9}
JOBS = {"normal": dict.fromkeys("xyz", 0), "increment": dict.fromkeys("xyz", 0), "flat": 0, "tag": range(40)}
EMPTY_SPAN = dict.fromkeys((leaf.name for leaf in SPAN.leaves()), 0)
JAM = {"data_i": np.arange(9), "out_stall": 1.0, "patience": 50}
DOOR = {"s_axis_span_tkeep": (1 << k.SPAN_DATA_W // 8) - 1, "s_axis_span_tlast": 1, "draw_i": 0, "hold_i": 0}
DOOR |= {"room_i": 0, "s_axis_span_tdata": np.ones((9, 8), np.uint32)}
IDLE = dict.fromkeys(("take_i", "told_i", "end_i", "run_valid_i", "count_i", "pixel_i", "busy_i"), 0)
NO_RUN = dict.fromkeys(("surface_valid_i", "surface_i", "run_valid_i", "run_i", "request_ready_i", "answer_i"), 0)
NO_RUN |= dict.fromkeys(("surface_ready_i", "run_ready_i"), 0)
FRAME = dict.fromkeys(("background_i", "request_valid_i", "request_i", "pixel_valid_i", "site_i", "pixel_i"), 0)
FRAME |= {
    "view_i": dict.fromkeys((leaf.name for leaf in VIEW.leaves()), 1),
    "write_i": 0,
    "write_valid_i": [1] * 30,
    "show_i": 0,
}
NARROW = {"REFLECT": 0, "DIVIDE": 0, "PATH_NORMALS": 0}

CASES = {
    # instance: module, parameters, inputs by which it fires; or the fault of the RTL, old and new text, that it finds
    "shade_stable.u_stable": ("shade_stable", {}, {"data_i": np.arange(40), "out_stall": 0.5, "patience": 50}, ()),
    "shade_credit.u_underflow": ("shade_credit", {"LOG2": 1}, {"take_i": [1] * 3, "give_i": 0}, ()),
    "shade_credit.u_overflow": ("shade_credit", {"LOG2": 1}, {"take_i": [1, 0, 0], "give_i": [0, 1, 1]}, ()),
    "shade_fifo.u_overflow": ("shade_fifo", {"LOG2": 1}, JAM, ()),
    "shade_fifo.u_overflow, of blocks": ("shade_fifo", {"LOG2": 2, "BLOCK": 1}, JAM, ()),
    "shade_fifo.u_stable": (
        "shade_fifo", {}, {"data_i": np.arange(99), "out_stall": 0.5}, ("= !valid_o || ready_i;", "= 1'b1;"),
    ),
    "shade_widen.u_stable": (
        "shade_widen", {"IN_W": 8, "OUT_W": 16},
        {"s_axis_word_tdata": np.arange(99), "s_axis_word_tlast": 0, "out_stall": 0.5, "patience": 50},
        ("m_axis_beat_tvalid <= m_axis_beat_tvalid ? !m_axis_beat_tready : ends;", "m_axis_beat_tvalid <= ends;"),
    ),
    "shade_walk.u_empty": ("shade_walk", {}, {"count_i": [1, 0], "credit_i": 0}, ()),
    "shade_credit.u_overflow, in a walk": ("shade_walk", {}, {"count_i": 1, "credit_i": 1}, ()),
    "shade_walk.u_empty, of a record": ("shade_span_walk", {}, {"record_i": RECORD_OF["none"], "credit_i": 0}, ()),
    "shade_span_walk.u_long": ("shade_span_walk", {}, {"record_i": RECORD_OF["long"], "credit_i": 0}, ()),
    "shade_node_walk.u_phase": (
        "shade_node_walk", {"FOLD": 6}, {"pace": 5, "job_i": 0, "plan_i": NOTHING, "credit_i": 0}, ()
    ),
    "shade_stretch.u_stable": (
        "shade_stretch", {}, {"job_i": JOBS, "plan_i": NOTHING, "out_stall": 0.5, "patience": 50},
        ("chosen_valid_q && (!valid_o || ready_i)", "chosen_valid_q"),
    ),
    "shade_stretch.u_log2": (
        "shade_stretch", {}, {"job_i": JOBS, "plan_i": NOTHING | {"last_degree": 1, "last_log2": 6}}, ()
    ),
    "shade_poly_line.u_legal": (
        "shade_poly_line", {}, {"s_axis_span_tdata": np.zeros((9, k.RECORD_DATA_W // 32), np.uint32)}, ()
    ),
    "shade_line.u_job": (
        "shade_line", {"FOLD": 6}, {"pace": 6, "span_i": EMPTY_SPAN | {"count": [1] * 9}, "draw_i": 0, "credit_i": 0},
        ("u_jobs ( .clk_i, .rst_i, .valid_i(take)", "u_jobs (.clk_i, .rst_i, .valid_i(1'b0)"),
    ),
    "shade_lane.u_place": (
        "shade_lane", NARROW, {"span_i": EMPTY_SPAN | {"count": [1] * 9}, "draw_i": 0},
        ("dark_q <= !rst_i &&", "dark_q <= !rst_i ||"),
    ),
    "shade_door.u_given": ("shade_door", {}, DOOR | {"given_i": 1, "patience": 50}, ()),
    "shade_scene_idle.u_triangles": ("shade_scene_idle", {}, IDLE | {"end_i": [1] * 9}, ()),
    "shade_scene_idle.u_pixels": ("shade_scene_idle", {}, IDLE | {"pixel_i": [1] * 9}, ()),
    "shade_scene_sites.u_run": (
        "shade_scene_sites", {}, {"run_valid_i": 0, "site_i": 0, "step_i": [1] * 9, "last_i": 0}, ()
    ),
    "shade_depth.u_answer": ("shade_depth", {}, NO_RUN | {"answer_valid_i": [1] * 9}, ()),
    "shade_frame.u_clear_alone": ("shade_frame", {"COLUMNS_LOG2": 2, "LINES_LOG2": 2}, FRAME, ()),
    "shade_registers.u_write": (
        "shade_registers", {}, QUIET | {"writes": {0x40: 0}},
        ("if (s_axil_bready) s_axil_bvalid <= 1'b0;", "if (!s_axil_bready) s_axil_bresp <= ~s_axil_bresp;"),
    ),
    "shade_registers.u_read": (
        "shade_registers", {}, QUIET | {"writes": {0x40: 0}},
        ("if (read) {s_axil_arready, s_axil_rvalid} <= 2'b11;",
         "if (write) s_axil_rvalid <= 1'b1; if (idle) s_axil_rdata <= ~s_axil_rdata;"),
    ),
}  # fmt: skip


def test_every_assertion_has_its_test() -> None:
    """A new one needs a case here: what cannot be provoked guards nothing."""
    assert instances() == {name.partition(",")[0] for name in CASES} | {"shade_door.u_stable"}


@pytest.mark.parametrize("case", CASES)
def test_it_fires(
    capfd: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, case: str
) -> None:
    """By what comes in where that is enough; by a fault of the RTL where only one can break the rule."""
    module, point, run, fault = CASES[case]
    if fault:
        old = r"\s*".join(map(re.escape, fault[0].split()))
        found, times = re.subn(old, lambda _: fault[1], text(module))
        assert times, f"{module}: no '{fault[0]}'"
        changed = tmp_path / f"{module}.sv"
        changed.write_text(found)
        known = [changed if path.stem == module else path for path in sources()]
        monkeypatch.setattr(verilate, "sources", lambda: known)
        monkeypatch.setattr(verilate, "modules", lambda: {path.stem: path for path in known})
        monkeypatch.setattr(model, "_loaded", {})
    with pytest.raises(SimulationError, match="an assertion failed"):
        sim.load(module, public=(), **point).run(**run)
    path = re.search(r"TOP\S*?(?=:)", capfd.readouterr().out)[0]
    assert case.partition(",")[0].partition(".")[2] in path.split("."), path


def test_a_sender_that_withdraws() -> None:
    """shade_door.u_stable, by a packet that does not wait until it is taken."""
    with pytest.raises(pytest.fail.Exception) as told:
        simulate("shade_door", {"PATH_NORMALS": 0}, "tb.core.rude_bench")
    assert "shade_door.u_stable" in Path(re.search(r"log: (.*)", str(told.value))[1]).read_text()
