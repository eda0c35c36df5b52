# SPDX-License-Identifier: Apache-2.0
"""``make gate``: a unit's vectors run through its netlist, and a netlist that is wrong is found."""

import re
import shutil

import pytest
from polyshade.scripts.flow import fourstate, gate, tools
from polyshade.sim.errors import UserError
from polyshade.sim.units import Case, cases
from polyshade.sim.verilate import reached


def small() -> Case:
    """A case with a multiplier, over all its inputs."""
    return next(case for case in cases() if case.module == "shade_mul" and case.all_vectors)


@pytest.mark.parametrize(("family", "block"), [
    ("ecp5", "MULT18X18D"), pytest.param("ice40", "SB_MAC16", marks=pytest.mark.full),
])  # fmt: skip
def test_a_netlist_is_compared(tmp_path, monkeypatch, family: str, block: str) -> None:
    monkeypatch.setattr(gate, "WORK", tmp_path)
    found = gate.check(small(), family, 5000)
    assert found["netlist"].startswith("shade_mul[") and found["family"] == family
    assert found["vectors"] >= 5000 and found["mismatches"] == 0

    path = gate.netlist(family, small().module, small().parameters)
    text = path.read_text()
    assert block in (path.parent / "mapped.il").read_text()
    wrong = text.replace("<= ", "<= ~")  # registers take the opposite
    assert wrong != text
    path.write_text(wrong)
    assert gate.check(small(), family, 5000)["mismatches"] > 0


@pytest.mark.full
@pytest.mark.skipif(not shutil.which("iverilog"), reason="no Icarus Verilog on this machine")
def test_four_states(tmp_path) -> None:
    """A core without a reset of its own for data gives no unknown bit; one without the reset of a FIFO does."""
    files = " ".join(map(str, reached("shade_core")))
    script = f"""
        read_verilog -noassert -sv {files}
        hierarchy -check -top shade_core{tools.chparam(gate.CORE)}
        rename -top shade_core
        proc
        opt
        memory -nomap
        write_verilog -noattr core.v
    """
    tools.yosys(script, tmp_path)
    compared, wrong, first = fourstate.check(tmp_path / "core.v", tmp_path / "run", gate.CORE)
    assert compared > 300 and (wrong, first) == (0, "")
    text = (tmp_path / "core.v").read_text()
    loose = re.sub(r"if \(rst_i\) (write_q <=)", r"if (1'b0) \1", text)
    assert loose != text
    (tmp_path / "core.v").write_text(loose)
    assert fourstate.check(tmp_path / "core.v", tmp_path / "run", gate.CORE)[1] > 0


def test_icarus_is_missing(tmp_path, monkeypatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(UserError, match="iverilog: missing, install with: apt-get install -y iverilog"):
        fourstate.check(tmp_path / "core.v", tmp_path / "run", gate.CORE)


def test_bad_input() -> None:
    with pytest.raises(UserError, match="shade_none: no such unit, allowed shade_"):
        gate.main(["shade_none"])
