# SPDX-License-Identifier: Apache-2.0
"""``make mutants``: a sample of fixed seed is killed, survivors are told apart, faults once unseen are seen."""

import json

import pytest
from polyshade.scripts.flow import mutants
from polyshade.sim.errors import UserError
from polyshade.sim.sources import modules

TARGETS = {target.module: target for target in mutants.targets()}


@pytest.fixture(autouse=True)
def work(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(mutants, "WORK", tmp_path / "work")
    (tmp_path / "work").mkdir()


@pytest.mark.parametrize("module", ["shade_weigh", pytest.param("shade_gain", marks=pytest.mark.full)])
def test_sample(module: str) -> None:
    """Twelve mutants by the module's vectors alone: what lives on is equivalent."""
    row = mutants.judge(TARGETS[module], 12, 5, bench=False)
    assert row["generated"] == 12
    assert row["killed"] + row["equivalent"] == 12, row["survived"]


def test_tests_of_a_file() -> None:
    """What a module's own file drives with NumPy kills as well; a fault that it does not see lives on."""
    faults = mutants.netlist(TARGETS["shade_skipped"], 4, 1)
    assert set(mutants.by_file(TARGETS["shade_skipped"], faults, [1, 2, 3, 4])) <= {1, 2, 3, 4}
    assert list(mutants.by_file(TARGETS["shade_skipped"], faults, [0])) == []


def test_an_interrupted_run_goes_on(monkeypatch) -> None:
    """A module is judged once for the same RTL, tests, count and seed."""
    runs = []
    monkeypatch.setattr(mutants, "judge", lambda target, count, seed: runs.append(target.module) or {"seed": seed})
    for module, count, seed in [("shade_third", 4, 1)] * 2 + [("shade_third", 4, 2), ("shade_third", 5, 1)]:
        assert mutants._job(TARGETS[module], count, seed) == {"seed": seed}
    assert runs == ["shade_third"] * 3


def test_a_blind_test_lets_them_live(monkeypatch) -> None:
    """Without vectors nothing is killed, and what differs is told so."""
    monkeypatch.setattr(mutants, "engines", lambda target, bench: [])
    row = mutants.judge(TARGETS["shade_credit"], 4, 1, bench=False)
    assert row["killed"] == 0 and len(row["survived"]) + row["equivalent"] == 4
    assert any(line.endswith(": different") for line in row["survived"])
    assert mutants.share(row) == 0


def test_faults_of_the_text() -> None:
    """Each stands in its module just once; light that rounds up to 2 is looked at."""
    for module, faults in mutants.NAMED.items():
        for what, (old, new) in faults.items():
            assert modules()[module].read_text().count(old) == 1, (module, what)
            assert old != new
    assert mutants.named(TARGETS["shade_gain"], "light that rounds up to 2 becomes 0")


def test_floors(monkeypatch, tmp_path, capsys) -> None:
    """A module below its floor is told, and the command fails; a run raises the floors of its modules, and no other."""
    rows = {"generated": 10, "killed": 9, "equivalent": 0, "undecided": 0, "survived": ["1: x"], "seed": 1, "named": {}}
    monkeypatch.setattr(mutants, "_job", lambda target, count, seed: rows)
    monkeypatch.setattr(mutants, "ProcessPoolExecutor", Pool)
    monkeypatch.setattr(mutants, "FLOORS", tmp_path / "floors.json")
    monkeypatch.setattr(mutants, "OUT", tmp_path / "mutants.json")
    mutants.FLOORS.write_text(json.dumps({"shade_third": 95.0}))
    assert mutants.main(["shade_third"]) == 1
    assert "shade_third: 90.0 % of its mutants killed, 95.0 % needed" in capsys.readouterr().out
    assert not mutants.OUT.exists()
    assert mutants.main(["shade_fifo"], 20) == 0
    assert json.loads(mutants.FLOORS.read_text()) == {"shade_third": 95.0}
    assert mutants.main(["shade_fifo"]) == 0
    assert json.loads(mutants.FLOORS.read_text()) == {"shade_third": 95.0, "shade_fifo": 90.0}
    mutants.FLOORS.write_text(json.dumps({"shade_third": 50.0}))
    assert mutants.main() == 0
    assert json.loads(mutants.FLOORS.read_text()).keys() == TARGETS.keys()
    assert json.loads(mutants.FLOORS.read_text())["shade_third"] == 90.0
    assert mutants.main(seed=2) == 0


def test_bad_input() -> None:
    with pytest.raises(UserError, match="shade_none: no module with mutants, allowed shade_"):
        mutants.main(["shade_none"])
    with pytest.raises(UserError, match="--count: 0 is out of range, allowed is 1 to 10000"):
        mutants.main(["shade_third"], 0)


class Pool:
    """Runs jobs at once, in this process."""

    def __init__(self, workers: int):
        self.workers = workers

    def __enter__(self) -> "Pool":
        return self

    def __exit__(self, *error: object) -> None:
        pass

    def submit(self, function, *arguments: object):
        from concurrent.futures import Future

        done = Future()
        done.set_result(function(*arguments))
        return done
