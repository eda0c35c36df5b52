# SPDX-License-Identifier: Apache-2.0
"""rtl/tech/ecp5 against rtl/fixed: the same products at the same latencies, registers inside of the DSP blocks."""

from __future__ import annotations

import json
import os
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from polyshade import sim
from polyshade.scripts.flow import gate, tools
from polyshade.scripts.flow.points import POINTS, REFUSED
from polyshade.sim.errors import UserError
from polyshade.sim.sources import ROOT

from tb.runner import FULL, SEED

FILES = [ROOT / "rtl" / name for name in ("shade_pkg.sv", "tech/ecp5/shade_mul_block.sv", "tech/ecp5/shade_mul.sv")]
WIDTHS = [(18, 18), (30, 18), *([(2, 2), (4, 3), (17, 18), (18, 5), (19, 18), (35, 7), (35, 18)] if FULL else [])]
COUNT = 20_000


def read(folder: Path, point: dict[str, int], commands: str) -> None:
    """Run Yosys on the technology files at a parameter point, with the model of the DSP block."""
    (folder / "blocks.v").write_text(gate.blocks_ecp5())
    chosen = "".join(f" -chparam {name} {value}" for name, value in point.items())
    files = " ".join(os.path.relpath(path, folder) for path in FILES)
    tools.yosys(f"read_verilog {'-lib' if 'synth' in commands else ''} blocks.v\nread_verilog -sv {files}\n"
                f"hierarchy -check -top shade_mul{chosen}\n{commands}", folder)  # fmt: skip


@pytest.mark.parametrize(("a_w", "b_w", "stages"), [(*w, s) for w, s in product(WIDTHS, (0, 2, 3))])
def test_products(tmp_path, a_w: int, b_w: int, stages: int) -> None:
    """All pairs of narrow operands; limits and random ones of wide ones: a b, ``STAGES`` clocks later."""
    point = {"A_W": a_w, "B_W": b_w, "STAGES": stages}
    read(tmp_path, point, "proc\nflatten\nopt_clean\nwrite_verilog -noattr netlist.v")
    rng = np.random.default_rng(SEED)

    def values(width: int) -> np.ndarray:
        half = 1 << width - 1
        limits = [-half, 1 - half, -1, 0, 1, half - 1]
        return np.arange(-half, half) if width < 6 else np.concatenate([limits, rng.integers(-half, half, COUNT)])

    a, b = np.broadcast_arrays(values(a_w)[:, None], values(b_w)[None, :64])
    a, b = a.ravel(), b.ravel().copy()
    if a_w >= 6 and b_w >= 6:
        a, b = a[: 64 * COUNT // 10], values(b_w)[rng.integers(0, 6 + COUNT, 64 * COUNT // 10)]
        a[:36], b[:36] = np.repeat(values(a_w)[:6], 6), np.tile(values(b_w)[:6], 6)
    netlist = tmp_path / "netlist.v"
    netlist.write_text("/* verilator lint_off WIDTH */\n" + netlist.read_text())
    with sim.netlists(lambda *_: netlist):
        run = sim.load("shade_mul", **point).run(a_i=a, b_i=b, latency=stages)
    assert np.array_equal(run.p_o, a * b)


@pytest.mark.parametrize("point", [{}, *POINTS["shade_mul"]][: None if FULL else 2], ids=str)
def test_registers_are_in_the_block(tmp_path, point: dict[str, int]) -> None:
    """No register is left in fabric but that of a sum of two products, and none of the blocks is without its own."""
    read(tmp_path, point, "synth_ecp5 -top shade_mul\nwrite_json netlist.json")
    cells = json.loads((tmp_path / "netlist.json").read_text())["modules"]["shade_mul"]["cells"].values()
    blocks = [cell["parameters"] for cell in cells if cell["type"] == "MULT18X18D"]
    flops = sum(cell["type"] == "TRELLIS_FF" for cell in cells)
    wide, stages = point.get("A_W", 30) > 18, point.get("STAGES", 2)
    assert len(blocks) == 1 + wide
    assert {block["REG_OUTPUT_CLK"] for block in blocks} == {"CLK0" if stages else "NONE"}
    assert (flops > 0) == (wide and stages > 0)


@pytest.mark.parametrize("point", REFUSED["shade_mul"], ids=str)
def test_refused_as_the_generic_one(tmp_path, point: dict[str, int]) -> None:
    with pytest.raises(UserError, match="shade_mul: A_W must be"):
        read(tmp_path, point, "")
