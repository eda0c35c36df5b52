# SPDX-License-Identifier: Apache-2.0
"""``make coverage``: entries are read, holes are named, excuses hold, crosses are those of work that agreed."""

import collections
import itertools

import numpy as np
import pytest
from polyshade.scripts.flow import coverage, soak
from polyshade.sim.errors import UserError


def entry(module: str, kind: str, line: int, what: str, count: int) -> str:
    parts = {"f": "../" + module + ".sv", "l": line, "n": 3, "page": f"v_{kind}/{module}__W8", "o": what, "h": "TOP.u"}
    return "C '" + "".join(f"\x01{name}\x02{value}" for name, value in parts.items()) + f"' {count}"


def test_counts(tmp_path) -> None:
    """Of several files, instances and points: what any reaches is reached."""
    (tmp_path / "a.dat").write_text("# SystemC::Coverage-3\n" + "\n".join([
        entry("shade_fifo", "line", 9, "block", 3), entry("shade_fifo", "branch", 9, "else", 0),
        entry("shade_fifo", "toggle", 4, "full_q[2]:0->1", 0), entry("shade_fifo", "toggle", 4, "full_q[2]:1->0", 0),
    ]))  # fmt: skip
    (tmp_path / "b.dat").write_text(entry("shade_fifo", "toggle", 4, "full_q[2]:0->1", 7))
    counts = collections.defaultdict(int)
    coverage.gather(tmp_path, counts, age=60)
    assert not counts
    coverage.gather(tmp_path, counts)
    assert not [*tmp_path.iterdir()]
    report, wrong = coverage.summary(counts, {})
    holes = ["branch 9 else", "toggle full_q[2]:1->0"]
    assert report["shade_fifo"] == {"line": 100.0, "branch": 0.0, "toggle": 50.0, "holes": holes}
    assert wrong == [] and report["shade_core"]["line"] is None
    report, wrong = coverage.summary(counts, {"shade_fifo": {"branch 9 else": "why", "line 9": "why"}})
    assert report["shade_fifo"]["holes"] == holes[1:] and report["shade_fifo"]["branch"] is None
    assert wrong == ["shade_fifo: line 9: reached, though said not to be"]


def test_crosses() -> None:
    """A hole is a combination that no item had, or only one that differed."""
    bins = [{"gap": gap, "stall": stall} for gap, stall in itertools.product([False, True], repeat=2)]
    made = [soak.Outcome("normals", seed, 1, seed == 3, bins=kind) for seed, kind in enumerate(bins)]
    report = coverage.functional(made)
    assert report["normals.gap x stall"] == {"per_cent": 75.0, "holes": ["gap=True, stall=True"]}
    assert coverage.functional([])["normals.gap x stall"]["per_cent"] == 0


def test_soak(monkeypatch) -> None:
    """An item is told by its seed; a fault in the golden model, as in the RTL, is found and told."""
    first, again = soak.item(11, "spans"), soak.item(11, "spans")
    assert first == again and first.mismatches == 0 and first.compared > 10_000
    monkeypatch.setitem(soak.KINDS, "spans", lambda rng, seed: soak.Outcome("spans", seed, 5, int(rng.integers(2, 3))))
    assert soak.main(seed=4, only="spans") == 1
    drawn = soak.lines(np.random.default_rng(1), 400)
    assert drawn.count.min() >= 1 and (drawn.n == 0).all(axis=1).any()


def test_bad_input() -> None:
    for call, told in (
        (lambda: soak.main(minutes=0), "--minutes: 0 is out of range, allowed is 0.01 to 10080"),
        (lambda: soak.main(seed=-1), "--seed: -1 is out of range, allowed is 0 to 2147483647"),
        (lambda: soak.main(only="x"), "--kind: 'x' is none of unit, spans, normals, core, patch, direct, scan"),
        (lambda: coverage.main(["tb/nothing.py"]), "tb/nothing.py: no such test, allowed tb/test_units.py"),
        (lambda: coverage.main(seeds=-1), "--seeds: -1 is out of range, allowed is 0 to 1000000"),
    ):
        with pytest.raises(UserError) as error:
            call()
        assert str(error.value).startswith(told)
