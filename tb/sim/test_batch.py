# SPDX-License-Identifier: Apache-2.0
"""Frames in processes of their own are those of this process, to the bit, whatever happens to the processes."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import distributed
import numpy as np
import pytest
from PIL import Image
from polyshade.sim import batch, frame
from polyshade.sim.errors import UserError
from polyshade.sim.scene.camera import Camera
from polyshade.sim.scene.mesh import Mesh

from tb.runner import HANGS

SETTINGS = frame.Settings(camera=Camera(48, yaw=300))
SECONDS = ("simulated_pixels_per_second", "wall_seconds")


@pytest.fixture
def cluster(monkeypatch: pytest.MonkeyPatch) -> Iterator[distributed.LocalCluster]:
    """A scheduler with two workers, for whom a loaded machine may take its time."""
    monkeypatch.setattr(batch, "PATIENCE", HANGS)
    options = {"threads_per_worker": 1, "memory_limit": 0, "dashboard_address": None, "silence_logs": "CRITICAL"}
    with distributed.LocalCluster(n_workers=2, **options) as made:
        yield made


def equal(shots: batch.Shots, frames: list[frame.Settings]) -> None:
    """Pictures and reports as this process makes them."""
    assert len(shots.frames) == len(frames)
    for (picture, report), settings in zip(shots.frames, frames, strict=True):
        made = frame.render(settings)
        assert np.array_equal(picture, made.picture(made.intensity))
        assert report.keys() == made.report.keys()
        assert {k: v for k, v in report.items() if k not in SECONDS} == {
            k: v for k, v in made.report.items() if k not in SECONDS
        }


def test_turntable() -> None:
    """Evenly spaced from where it stands; angles stay in the camera's range."""
    assert [view.camera.yaw for view in batch.turntable(SETTINGS, 4)] == [300, 30, 120, 210]
    assert batch.turntable(SETTINGS, 1) == [SETTINGS]
    below = frame.Settings(camera=Camera(yaw=-360))
    assert [view.camera.yaw for view in batch.turntable(below, 3)] == [-360, -240, -120]


def test_on_this_machine(tmp_path: Path) -> None:
    """Frames in their order; an animation of all, and sums in the report."""
    frames = batch.turntable(SETTINGS, 3)
    shots = batch.shoot_all(frames)
    equal(shots, frames)
    assert shots.report["pixels"] == sum(report["pixels"] for _, report in shots.frames) > 0
    assert (shots.report["mismatches"], len(shots.report["frames"])) == (0, 3)
    shots.save(tmp_path / "turn")
    assert sorted(path.name for path in (tmp_path / "turn").iterdir()) == ["animation.png", "report.json"]
    with Image.open(tmp_path / "turn" / "animation.png") as image:
        assert (image.n_frames, image.size, image.info["loop"]) == (3, (48, 48), 0)
        for place, (picture, _) in enumerate(shots.frames):
            image.seek(place)
            assert np.array_equal(image.convert("RGB"), picture)


def test_a_worker_that_dies(cluster: distributed.LocalCluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its frame is made again."""
    frames, died, shoot = batch.turntable(SETTINGS, 4), tmp_path / "died", batch.shoot

    def once(settings: frame.Settings, mesh: Mesh) -> batch.Shot:
        if settings == frames[1] and not died.exists():
            died.touch()
            os.kill(os.getpid(), signal.SIGKILL)
        return shoot(settings, mesh)

    monkeypatch.setattr(batch, "shoot", once)
    shots = batch.shoot_all(frames, cluster.scheduler_address)
    assert died.exists()
    equal(shots, frames)


@pytest.mark.parametrize("address", ["", "nowhere", "tcp://127.0.0.1:1", "tcp://127.0.0.1:99999", "ftp://x:1"])
def test_no_scheduler(address: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(batch, "PATIENCE", 1)
    with pytest.raises(UserError, match=f"^--scheduler '{address}': no worker answers, allowed"):
        batch.shoot_all([SETTINGS], address)


def test_no_workers(monkeypatch: pytest.MonkeyPatch) -> None:
    """A scheduler with nobody to do the work."""
    monkeypatch.setattr(batch, "PATIENCE", 1)
    with (
        distributed.LocalCluster(n_workers=0, dashboard_address=None, silence_logs="CRITICAL") as empty,
        pytest.raises(UserError, match="no worker answers"),
    ):
        batch.shoot_all([SETTINGS], empty.scheduler_address)


def test_a_scheduler_that_goes_away(
    cluster: distributed.LocalCluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In the middle of the work."""
    begun = tmp_path / "begun"

    def hold(settings: frame.Settings, mesh: Mesh) -> None:
        begun.touch()
        time.sleep(HANGS)

    def close() -> None:
        while not begun.exists():
            time.sleep(0.02)
        cluster.close()

    monkeypatch.setattr(batch, "shoot", hold)
    stop = threading.Thread(target=close, daemon=True)
    stop.start()
    with pytest.raises(UserError, match="the scheduler went away"):
        batch.shoot_all(batch.turntable(SETTINGS, 4), cluster.scheduler_address)
    stop.join()
