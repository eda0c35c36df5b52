# SPDX-License-Identifier: Apache-2.0
"""The machines' report: every key of every machine, figures that fit together; small frames, without synthesis."""

import pytest
from polyshade.scripts.studies import machines

KEYS = {"pixels_per_clock", "products_per_pixel", "evaluations_per_pixel", "nmse_diffuse", "nmse_specular"}


FIRST = {name.partition("/")[0]: name for name in reversed(machines.MACHINES)}  # of each path


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=() if n in FIRST.values() else pytest.mark.full) for n in machines.MACHINES]
)
def test_speed(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """One lane never gives more than a pixel a clock; no machine is far from the original model."""
    monkeypatch.setattr(machines, "SCENES", {"head1024": ("head", 0, 64), "sphere320": ("sphere", 0, 64)})
    found = machines.speed(machines.MACHINES[name])
    lanes = int(name.split("/")[1])
    assert set(found) == KEYS
    assert set(found["pixels_per_clock"]) == set(found["products_per_pixel"]) == {"head1024", "sphere320"}
    assert all(0 < rate <= lanes for rate in found["pixels_per_clock"].values())
    assert set(found["evaluations_per_pixel"]) == set(found["nmse_specular"]) == {"8", "32", "128", "512"}
    assert max(found["nmse_diffuse"].values()) <= 1e-5


def test_names() -> None:
    """<path>/<lanes>/<models>/<lights>."""
    for name in machines.MACHINES:
        path, lanes, models, lights = name.split("/")
        assert path in ("direct", "patch", "line", "vector") and models in ("blinn", "all")
        assert lanes in ("1", "2", "4", "8") and lights in ("1", "4")
