# SPDX-License-Identifier: Apache-2.0
"""The proofs that take seconds, and that every property of theirs can fail; all of them: ``make formal``."""

import re

import pytest
from polyshade.scripts.flow import formal
from polyshade.sim.errors import UserError

QUICK = [proof for proof in formal.ALL if proof.quick]
FIRST = {proof.name: proof for proof in reversed(QUICK)}


@pytest.mark.parametrize("proof", QUICK, ids=lambda proof: proof.title)
def test_proven(proof: formal.Proof) -> None:
    """Every property of every quick proof."""
    rows = formal.check(proof)
    assert {row["property"] for row in rows} >= set(proof.labels("assert"))
    assert {row["property"]: row["result"] for row in rows if row["result"] != "proven"} == {}


@pytest.mark.parametrize(
    ("proof", "name"), [(proof, name) for proof in FIRST.values() for name in proof.labels("assert")],
    ids=lambda value: value if isinstance(value, str) else value.name,
)  # fmt: skip
def test_can_fail(proof: formal.Proof, name: str) -> None:
    """The property is found to be false on its mutant."""
    assert formal.killed(proof, name)


@pytest.mark.parametrize("proof", {proof.name: proof for proof in formal.ALL}.values(), ids=lambda proof: proof.name)
def test_every_property_is_told(proof: formal.Proof) -> None:
    """It has a meaning, and a mutant that fits the RTL; every assumption has a meaning."""
    assert all(proof.labels("assert").values()) and all(proof.labels("assume").values())
    assert proof.mutants.keys() == proof.labels("assert").keys()
    for name in proof.mutants:
        formal.mutated(proof, name)


def test_window_needs_a_pipeline() -> None:
    """A module with a loop through registers is not proven by a window."""
    walk = formal.Proof("walk", ("shade_walk",), window=3)
    with pytest.raises(UserError, match="not a pipeline without feedback"):
        formal.check(walk)


def test_a_bound_is_no_proof(monkeypatch, tmp_path) -> None:
    """Where pdr does not end, what holds for some clocks is bounded; without a depth it is failed."""
    real = formal.abc
    monkeypatch.setattr(formal, "abc", lambda commands, *rest: "" if "pdr" in commands else real(commands, *rest))
    monkeypatch.setattr(formal, "WORK", tmp_path)
    rows = formal.check(formal.Proof("walk", ("shade_walk",), depth=5))
    assert {(row["engine"], row["depth"], row["result"]) for row in rows} == {("bmc", 5, "bounded")}
    rows = formal.check(formal.Proof("walk", ("shade_walk",)))
    assert {row["result"] for row in rows} == {"failed"}


def test_bad_input(monkeypatch, tmp_path) -> None:
    """A proof that is none, a missing tool: one line each."""
    with pytest.raises(UserError, match=r"^nothing: is no proof, allowed are fifo, "):
        formal.main(["nothing"])
    monkeypatch.setattr("pyosys.__file__", str(tmp_path / "__init__.py"))
    with pytest.raises(UserError, match=re.escape("yosys-abc: missing, a part of the package pyosys, install with: ")):
        formal.abc("pdr", tmp_path, 1)
