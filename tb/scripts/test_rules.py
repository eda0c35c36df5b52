# SPDX-License-Identifier: Apache-2.0
"""The lint itself: every rule bites on a module that breaks it, and on nothing else."""

import os
import re
import subprocess
from pathlib import Path

import pytest
from polyshade.scripts.flow import lint
from polyshade.sim.sources import ROOT
from polyshade.sim.tools import environment, verilator

GOOD = """\
// shade_toy: y = x + 1.
//
// Latency 1 clock, one value a clock. Example: 1 -> 2.
module shade_toy #(
  parameter int W = 4
) (
  input  logic         clk_i,
  input  logic [W-1:0] x_i,
  output logic [W-1:0] y_o
);
  if (W < 2) begin : g_check
    $error("shade_toy: W must be at least 2");
  end
  localparam int TWO_W = 2 * W;  // arithmetic of constants is no hardware
  logic [TWO_W-1:0] sum_q;
  always_ff @(posedge clk_i) sum_q <= TWO_W'(x_i) + TWO_W'(1);
  assign y_o = sum_q[W-1:0];
  logic unused;
  assign unused = |sum_q[TWO_W-1:W];
endmodule
"""


@pytest.fixture
def toy(tmp_path, monkeypatch) -> Path:
    """A repository of one good module; returns the file."""
    path = tmp_path / "rtl" / "fixed" / "shade_toy.sv"
    path.parent.mkdir(parents=True)
    path.write_text(GOOD)
    (tmp_path / "rtl" / "shade.f").write_text("fixed/shade_toy.sv\n")
    (tmp_path / "rtl" / "README.md").write_text("| [`shade_toy`](fixed/shade_toy.sv) | x + 1 |\n")
    bench = tmp_path / "tb" / "fixed" / "test_toy.py"
    bench.parent.mkdir(parents=True)
    bench.touch()
    monkeypatch.setattr("polyshade.golden.fixed.toy", lambda x: x + 1, raising=False)
    for name, value in {
        "ROOT": tmp_path,
        "RTL": tmp_path / "rtl",
        "CATALOGUE": tmp_path / "rtl" / "README.md",
        "BUILD": tmp_path / "build",
        "sources": lambda: [path],
        "reached": lambda module: [path],
    }.items():
        monkeypatch.setattr(lint, name, value)
    return path


def test_a_good_module_passes(toy: Path) -> None:
    """No rule complains; a point out of range is refused in words."""
    assert lint.mirror("shade_toy", toy) == []
    assert lint.verilator("shade_toy", {}) == []
    assert lint.verilator("shade_toy", {"W": 9}) == []
    assert lint.yosys("shade_toy", {"W": 9}) == []
    assert lint.refused("shade_toy", {"W": 1}) == []


def test_a_point_that_is_accepted_is_told(toy: Path) -> None:
    """A module that forgets its check."""
    assert lint.refused("shade_toy", {"W": 2}) == ["shade_toy[W=2]: accepted, or refused without words"]


def test_a_source_without_licence_is_told(tmp_path: Path, monkeypatch) -> None:
    """Any kind of source; a first line of a script for its interpreter is allowed."""
    monkeypatch.setattr(lint, "ROOT", tmp_path)
    (tmp_path / "good.py").write_text(f"#!/bin/sh\n# {lint.LICENCE}\n")
    (tmp_path / "bad.sv").write_text(f"// shade_bad: y = x.\n//\n// {lint.LICENCE}\n")
    assert lint.licence() == [f"bad.sv: its first lines do not hold '{lint.LICENCE}'"]


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ("<= TWO_W'(x_i) + TWO_W'(1)", "<= TWO_W'(x_i) * TWO_W'(x_i)", "selection is not empty"),
        ("<= TWO_W'(x_i) + TWO_W'(1)", "<= TWO_W'(x_i) / TWO_W'(3)", "selection is not empty"),
        ("always_ff @(posedge clk_i) sum_q <=", "always @* if (x_i[0]) sum_q =", "selection is not empty"),
        ("assign y_o = sum_q[W-1:0]", "assign y_o = y_o ^ sum_q[W-1:0]", "Found 4 problems"),
        ("endmodule", "", "syntax error"),
    ],
    ids=["multiplier", "divider", "latch", "loop", "syntax"],
)
def test_yosys_rules(toy: Path, old: str, new: str, fault: str) -> None:
    """A multiplier, a divider, a latch, a combinational loop and broken text."""
    toy.write_text(GOOD.replace(old, new))
    faults = lint.yosys("shade_toy", {})
    assert len(faults) == 1 and fault in faults[0]


def test_verible_rules(toy: Path) -> None:
    """What the parser does not read: the place is told."""
    assert lint.verible([toy]) == []
    toy.write_text(GOOD.replace("= sum_q[W-1:0]", "= sum_q[W-1:0"))
    (fault, *_) = lint.verible([toy])
    assert "shade_toy.sv:17:" in fault


def test_slang_rules(toy: Path) -> None:
    """What Yosys' own reader lets pass: a width that does not fit."""
    toy.write_text(GOOD.replace("assign y_o = sum_q[W-1:0]", "assign y_o = sum_q"))
    assert any("implicit conversion truncates" in fault for fault in lint.yosys("shade_toy", {}))


def test_icarus_rules(toy: Path, tmp_path: Path, monkeypatch) -> None:
    """It reads the Verilog that Yosys wrote, and what it says is a fault; without it nothing is said."""
    monkeypatch.setenv("PATH", str(tmp_path / "bin"), prepend=os.pathsep)
    assert lint.yosys("shade_toy", {}) == []
    program = tmp_path / "bin" / "iverilog"
    program.parent.mkdir()
    program.write_text('#!/bin/sh\nfor last; do :; done\ngrep -c "^module shade_toy" "$last"\n')
    program.chmod(0o755)
    assert lint.yosys("shade_toy", {}) == ["1"]


@pytest.mark.parametrize(
    ("line", "name"),
    [
        ("assign y_o = x_i[0 +: W];", "indexed part selects"),
        ("assign y_o = x_i[shade_pkg::SPAN_FLAT];", "indexed part selects"),
        ("shade_a u_a (.valid_i(1'b0), .x_i(x_i));", "handshakes"),
        ("shade_a u_a (.x_i(x_i), .valid_o());", "handshakes"),
        ("initial y_q = 1'b0;", "registers with an initial value"),
        ("logic [3:0] y_q = 4'd0;", "registers with an initial value"),
    ],
)
def test_ratchets(line: str, name: str) -> None:
    """One more of it is counted; a comment is not."""
    before, after = (lint.counted([GOOD.replace("  logic unused;", f"  {text}\n")]) for text in (f"// {line}", line))
    (key,) = (key for key in before if key.startswith(name))
    assert (after.pop(key), before.pop(key)) == (1, 0)
    assert after == before


def test_ratchets_are_told(monkeypatch) -> None:
    """The number and the limit."""
    monkeypatch.setattr(lint, "RATCHETS", dict.fromkeys(lint.RATCHETS, 0))
    assert any(fault.startswith("lines of the longest module: ") for fault in lint.ratchets())


def test_the_list_of_sources_from_any_folder(tmp_path: Path) -> None:
    """With -F as it is; with -f as make writes it. No warning."""
    subprocess.run(["make", "-s", "sources"], cwd=ROOT, check=True)
    for option, path in (("-F", ROOT / "rtl" / "shade.f"), ("-f", ROOT / "build" / "shade.f")):
        command = [verilator().program, "--lint-only", "-Wall", "--top-module", "shade_fifo"]
        done = subprocess.run([*command, option, path], cwd=tmp_path, env=environment(), capture_output=True, text=True)
        assert (done.returncode, done.stderr) == (0, "")


def test_verilator_rules(toy: Path) -> None:
    """A width that does not fit, and a signal that nobody reads."""
    toy.write_text(GOOD.replace("assign y_o = sum_q[W-1:0]", "assign y_o = sum_q"))
    assert "WIDTHTRUNC" in "\n".join(lint.verilator("shade_toy", {}))
    toy.write_text(GOOD.replace("  logic unused;\n  assign unused = |sum_q[TWO_W-1:W];\n", ""))
    assert "UNUSEDSIGNAL" in "\n".join(lint.verilator("shade_toy", {}))


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ("module shade_toy", "module shade_other", "must hold the one module shade_toy"),
        ("// shade_toy: y", "// y", "must open with the comment"),
        ("Latency 1 clock", "One step", "no 'latency|combinational|clocks' in its header"),
        ("Example", "As", "no 'example' in its header"),
    ],
)
def test_header_rules(toy: Path, old: str, new: str, fault: str) -> None:
    """Name of the module, first line, latency and example of the header."""
    toy.write_text(GOOD.replace(old, new, 1))
    faults = lint.mirror("shade_toy", toy)
    assert len(faults) == 1 and fault in faults[0]


def test_a_module_without_row_is_told(toy: Path) -> None:
    """The catalogue must link to the file."""
    lint.CATALOGUE.write_text("| [`shade_toy`](elsewhere/shade_toy.sv) | x + 1 |\n")
    fault = "rtl/README.md: no row '| [`shade_toy`](fixed/shade_toy.sv) | ...'"
    assert lint.mirror("shade_toy", toy) == [fault]
    lint.CATALOGUE.unlink()
    assert lint.mirror("shade_toy", toy) == [fault]


def test_a_module_without_twin_is_told(toy: Path, monkeypatch) -> None:
    """A function of the same name, or of the name without its last word; what only carries data needs none."""
    monkeypatch.delattr("polyshade.golden.fixed.toy")
    assert lint.mirror("shade_toy", toy) == ["golden/fixed.py: no function toy, the golden twin of shade_toy"]
    monkeypatch.setattr(lint, "CARRIERS", {"shade_toy"})
    assert lint.mirror("shade_toy", toy) == []
    assert lint._twin(Path("rtl/fixed/shade_third_fast.sv")) == []
    assert lint._twin(Path("rtl/nowhere/shade_toy.sv")) == [
        "golden/nowhere.py: missing, the golden model of rtl/nowhere"
    ]


def test_a_module_without_bench_is_told(toy: Path, monkeypatch) -> None:
    """The place where the bench should be is named; a case will do as well."""
    (toy.parents[2] / "tb" / "fixed" / "test_toy.py").unlink()
    assert lint.mirror("shade_toy", toy) == ["shade_toy: no case in sim/units, and no bench tb/fixed/test_toy.py"]
    monkeypatch.setattr(lint, "tested", lambda: {"shade_toy"})
    assert lint.mirror("shade_toy", toy) == []


def test_file_list_rules(toy: Path, monkeypatch) -> None:
    """Missing, unlisted and doubly listed files, and a package that is not first."""
    assert lint.file_list() == ["rtl/fixed/shade_toy.sv: first, but the package comes first"]
    package, absent = toy.parents[1] / "shade_pkg.sv", toy.with_name("shade_absent.sv")
    package.touch()
    monkeypatch.setattr(lint, "sources", lambda: [package, toy])
    assert lint.file_list() == []
    monkeypatch.setattr(lint, "sources", lambda: [package, absent])
    assert lint.file_list() == ["rtl/fixed/shade_absent.sv: listed, but missing", "rtl/fixed/shade_toy.sv: not listed"]
    monkeypatch.setattr(lint, "sources", lambda: [package, toy, toy])
    assert lint.file_list() == ["rtl/fixed/shade_toy.sv: listed twice"]


@pytest.mark.parametrize(("package", "above"), [("golden", "sim|scripts|tb"), ("sim", "scripts|tb"), ("scripts", "tb")])
def test_imports_go_one_way(package: str, above: str) -> None:
    """tb -> scripts -> sim -> golden: nothing imports what stands above it."""
    imported = re.compile(rf"^\s*(?:from|import) (?:polyshade(?:\.| import ))?(?:{above})\b", re.MULTILINE)
    sources = sorted((ROOT / package).rglob("*.py"))
    assert sources
    assert [str(path) for path in sources if imported.search(path.read_text())] == []
