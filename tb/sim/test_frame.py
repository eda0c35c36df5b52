# SPDX-License-Identifier: Apache-2.0
"""A frame's parts by hand-computed numbers, and faults of the RTL from its outputs into report and picture."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest
from polyshade import sim
from polyshade.golden.material import Material
from polyshade.sim import core, frame
from polyshade.sim.errors import UserError
from polyshade.sim.scene.camera import Camera

# ---- numbers -----------------------------------------------------------------------------------------------------


def test_errors() -> None:
    """NMSE, PSNR and largest error of two visible pixels, computed by hand; hidden ones do not count."""
    exact = np.array([[0.5, 0.0], [9.0, 9.0], [1.0, 0.25]])
    intensity = exact + np.array([[0.1, 0.0], [5.0, 5.0], [-0.2, 0.05]])
    visible = np.array([-1, 2, -1, 0])
    told = frame.errors(intensity, exact, visible)
    assert told["nmse_diffuse"] == pytest.approx((0.01 + 0.04) / (0.25 + 1))
    assert told["nmse_specular"] == pytest.approx(0.0025 / 0.0625)
    assert told["nmse"] == pytest.approx(0.0525 / 1.3125)
    assert told["max_error"] == pytest.approx(0.2)
    assert told["psnr_db"] == pytest.approx(-10 * np.log10(0.0525 / 4))
    assert all(type(value) is float for value in told.values())


@pytest.mark.parametrize(
    ("intensity", "visible", "expected"),
    [
        ([], [-1, -1], {"nmse": None, "nmse_diffuse": None, "nmse_specular": None, "psnr_db": None, "max_error": 0.0}),
        # without light a ratio has no value; without an error a PSNR has none
        ([[0, 0]], [0], {"nmse": None, "nmse_diffuse": None, "nmse_specular": None, "psnr_db": None, "max_error": 0.0}),
        ([[0.5, 0]], [0], {"nmse": 0.0, "nmse_diffuse": 0.0, "nmse_specular": None, "psnr_db": None, "max_error": 0.0}),
    ],
)
def test_errors_of_nothing(intensity: list, visible: list[int], expected: dict) -> None:
    exact = np.array(intensity, float).reshape(-1, 2)
    assert frame.errors(exact, exact, np.array(visible)) == expected


def test_pictures() -> None:
    """By hand: background where nothing is, three kinds of light in the material's colours, 256 times the error."""
    visible = np.array([0, -1, -1, 1, 2, *[-1] * 251])
    intensity = np.array([[0.0, 0.0], [0.5, 0.0], [1.0, 1.0]])
    exact = intensity + np.array([[0.0, 0.0], [1 / 512, -1 / 1024], [-1.0, 0.0]])
    surface = Material(ambient=0.2, diffuse=0.6, specular=0.3, colour=(1, 0.5, 0), highlight=(0.5, 1, 0.5))
    shown = frame.Frame(frame.Settings(camera=Camera(16), material=surface), visible, intensity, exact, {})

    def levels(colour: list[float]) -> list[int]:
        return [round(255 * part) for part in colour]

    picture = np.array(shown.picture(intensity))
    assert picture.shape == (16, 16, 3)
    assert picture[0, :5].tolist() == [
        levels([0.2, 0.1, 0]), levels(frame.BACKGROUND), levels(frame.BACKGROUND), levels([0.5, 0.25, 0]),
        levels([0.95, 0.7, 0.15]),
    ]  # fmt: skip
    # specular in red, diffuse in green: 256/1024, 256/512, clipped at 1
    black = [0, 0, 0]
    assert np.array(shown.difference())[0, :6].tolist() == [black, black, black, [64, 128, 0], [0, 255, 0], black]


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"path": "Poly"}, "--path: 'Poly' is none of line, normals"),
        ({"evaluator": ""}, "--evaluator: '' is none of horner, fdiff"),
        ({"lanes": 3}, "--lanes: 3 is none of 1, 2, 4"),
        ({"variant": "V7"}, "--variant: 'V7' is none of V1, V2"),
        ({"threshold": float("nan")}, "--threshold: nan is out of range, allowed is 0.0 to 1.0"),
        ({"light_unit": "half"}, "--light-unit: 'half' is none of full, folded"),
        ({"light_unit": "folded", "path": "normals"}, "--light-unit: folded is allowed with --path line and --model"),
        ({"criterion": -0.1}, "--criterion: -0.1 is out of range, allowed is 0.0 to 1.0"),
        ({"degree": 4}, "--degree: 4 is out of range, allowed is 1 to 3"),
        ({"light": (0.0, 0.0, 0.0)}, "--light: (0.0, 0.0, 0.0) is no direction"),
        ({"more_lights": ((0.0, 0.0, 0.0),)}, "--light: (0.0, 0.0, 0.0) is no direction"),
        ({"more_lights": ((1.0, 0.0, 0.0),)}, "--light: 2 are given, 1 is allowed, with --path patch up to 4"),
        ({"path": "patch", "more_lights": 4 * ((1.0, 0.0, 0.0),)}, "--light: 5 are given"),
        ({"path": "vector", "lanes": 2}, "--lanes: 1 is allowed with --path vector"),
        ({"light": (1e308, 1e308, 0.0)}, "is no direction"),
        ({"light": (1.0, float("nan"), 0.0)}, "is no direction"),
    ],
)
def test_settings(options: dict, told: str) -> None:
    with pytest.raises(UserError) as error:
        frame.Settings(**options)
    assert str(error.value).startswith("--")
    assert told in str(error.value)


def test_registers() -> None:
    """What is written: material, light and planner; the degree of every span in form paper only."""
    words = frame.Settings(path="normals", variant="V5", threshold=0.25, degree=2).registers
    told = {name: words[name] for name in ("path", "fixed_degree", "variant", "threshold", "model", "sharpness_exp")}
    assert told == {"path": 1, "fixed_degree": 0, "variant": 5, "threshold": 16384, "model": 2, "sharpness_exp": 5}
    assert frame.Settings(material=Material(form="paper"), degree=2).registers["fixed_degree"] == 2


# ---- whole frames ------------------------------------------------------------------------------------------------


def test_flat_triangles() -> None:
    """P2's criterion saves evaluations of Lambert's light on what is nearly flat, and costs accuracy beyond that."""
    matt = frame.Settings(camera=Camera(256), material=Material("lambert"))
    none, some, every = (frame.render(replace(matt, criterion=eta)).report for eta in (0.0, 0.005, 1.0))
    assert [report["mismatches"] for report in (none, some, every)] == [0, 0, 0]
    assert none["flat_spans"] < 0.01 * some["flat_spans"] < 0.01 * every["flat_spans"] == 0.01 * every["spans"]
    assert none["light_evaluations"] >= some["light_evaluations"] > every["light_evaluations"]
    assert some["nmse_diffuse"] < 1.2 * none["nmse_diffuse"]
    assert every["nmse_diffuse"] > 10 * none["nmse_diffuse"]


def test_folded_light_draws_the_same() -> None:
    """With fewer multipliers, in more clocks."""
    full, folded = (
        frame.render(frame.Settings(mesh="head", camera=Camera(64), light_unit=unit)) for unit in frame.LIGHT_UNITS
    )
    assert folded.report["mismatches"] == 0
    assert np.array_equal(full.intensity, folded.intensity)
    assert full.report["cycles"] < folded.report["cycles"] < 6.5 * full.report["cycles"]


@pytest.mark.parametrize("lanes", frame.CORE_LANES)
def test_more_spans_than_tags(lanes: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Tags come round again in a frame of more than 2^16 spans; here, with fewer tags, much earlier.

    Not so few that a lane lies idle while all of them pass: the tag tells which span of a lane is which.
    """
    monkeypatch.setattr(core, "TAGS", 64)
    report = frame.render(frame.Settings(mesh="sphere", camera=Camera(size=40), lanes=lanes)).report
    assert report["mismatches"] == 0
    assert "counter_mismatches" not in report


def test_a_fault_of_the_rtl_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    """From the model's outputs into report, error and picture."""
    settings = frame.Settings(mesh="sphere", camera=Camera(size=40), scan="host")
    sound = frame.render(settings)
    run = sim.Model.run

    def faulty(self: sim.Model, **inputs: np.ndarray) -> sim.Run:
        result = run(self, **inputs)
        result.outputs["m_axis_pixel_tdata"][100] ^= 0x8000
        return result

    monkeypatch.setattr(sim.Model, "run", faulty)
    broken = frame.render(settings)
    assert broken.report["mismatches"] == 1
    assert broken.report["first_mismatch"]["pixel"] == 100
    assert broken.report["max_error"] > 0.4 > sound.report["max_error"]
    assert np.count_nonzero(broken.intensity != sound.intensity) == 1
    assert list(itertools.compress(range(1600), sound.visible == 100)) != []  # and it is one that is seen
    before, after = (np.array(f.picture(f.intensity)).reshape(-1, 3) for f in (sound, broken))
    assert np.flatnonzero((before != after).any(axis=1)).tolist() == np.flatnonzero(sound.visible == 100).tolist()
