# SPDX-License-Identifier: Apache-2.0
"""``make gate``: a unit's vectors run through its netlist, and a netlist that is wrong is found."""

import pytest
from polyshade.scripts.flow import gate
from polyshade.sim.errors import UserError
from polyshade.sim.units import Case, cases


def small() -> Case:
    """A case with a multiplier, over all its inputs."""
    return next(case for case in cases() if case.module == "shade_mul" and case.all_vectors)


@pytest.mark.parametrize(("family", "block"), [("ecp5", "MULT18X18D"), ("ice40", "SB_MAC16")])
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


def test_bad_input() -> None:
    with pytest.raises(UserError, match="shade_none: no such unit, allowed shade_"):
        gate.main(["shade_none"])
