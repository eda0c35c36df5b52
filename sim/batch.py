# SPDX-License-Identifier: Apache-2.0
"""Many frames at once: one a process, on the cores of this machine or on a cluster, by Dask.

A frame is the same wherever it is made. What a worker that dies had to do is done again by another one.
"""

from __future__ import annotations

import contextlib
import logging
import os
import signal
import time
import warnings
from collections.abc import Iterator, Sequence
from concurrent.futures import CancelledError
from dataclasses import replace
from multiprocessing import resource_tracker
from pathlib import Path
from typing import NamedTuple

import dask
import distributed
import numpy as np
from distributed.comm import CommClosedError
from numpy.typing import NDArray
from PIL import Image
from polyshade.sim import frame
from polyshade.sim.errors import UserError
from polyshade.sim.frame import Settings
from polyshade.sim.scene.mesh import Mesh
from tqdm import tqdm

FRAMES_MAX = 3600
MILLISECONDS = 80  # that a frame of an animation is shown
# A worker keeps its memory. Dask's default, to give every large array back at once, takes half as much time again.
ENVIRONMENT = {
    "distributed.nanny.pre-spawn-environ.MALLOC_TRIM_THRESHOLD_": 1 << 30,
    "distributed.nanny.pre-spawn-environ.MALLOC_MMAP_THRESHOLD_": 1 << 25,
}
PATIENCE = 10  # seconds for a scheduler to answer, and for its first worker


class Shot(NamedTuple):
    """A frame's picture, (size, size, 3) levels, and its report."""

    picture: NDArray[np.uint8]
    report: dict


class Shots(NamedTuple):
    """Frames in their order, and in how many seconds all of them were made."""

    frames: list[Shot]
    seconds: float

    @property
    def report(self) -> dict:
        """Sums, and under ``frames`` the report of each."""
        reports = [shot.report for shot in self.frames]
        pixels, cycles, mismatches = (sum(each[key] for each in reports) for key in ("pixels", "cycles", "mismatches"))
        return {
            "pixels": pixels,
            "mismatches": mismatches,
            "cycles": cycles,
            "pixels_per_cycle": pixels / cycles if cycles else None,
            "wall_seconds": self.seconds,
            "frames": reports,
        }

    def save(self, folder: Path) -> None:
        """animation.png and report.json, both or none."""
        first, *others = (Image.fromarray(shot.picture) for shot in self.frames)
        shown = {"save_all": True, "append_images": others, "duration": MILLISECONDS, "loop": 0}
        frame.save(folder, {"animation.png": first}, self.report, **shown)


def shoot(settings: Settings, mesh: Mesh) -> Shot:
    """Render a frame."""
    made = frame.render(settings, mesh)
    return Shot(np.asarray(made.picture(made.intensity)), made.report)


def shoot_all(frames: Sequence[Settings], scheduler: str | None = None) -> Shots:
    """Render frames of one mesh, in their order; ``scheduler``: address of a Dask scheduler, None: on this machine.

    Raises UserError for a mesh that cannot be read, a scheduler that cannot be reached or goes away, and a frame whose
    workers died again and again.
    """
    began = time.perf_counter()
    mesh = frames[0].load()
    with client(scheduler, len(frames)) as dask_client:
        futures = dask_client.map(shoot, frames, mesh=mesh, pure=False)
        done = distributed.as_completed(futures)
        bar = tqdm(done, desc="frames", total=len(frames), disable=None, delay=2, leave=False)
        shots = {future.key: future.result() for future in bar}
    return Shots([shots[future.key] for future in futures], time.perf_counter() - began)


def turntable(settings: Settings, frames: int) -> list[Settings]:
    """The views of a whole turn, evenly spaced; the first is as it was.

    >>> [view.camera.yaw for view in turntable(Settings(), 4)]
    [30.0, 120.0, 210.0, 300.0]
    """
    turns = [settings.camera.yaw + 360 * i / frames for i in range(frames)]
    yaws = [yaw if yaw <= 360 else yaw - 360 for yaw in turns]
    return [replace(settings, camera=replace(settings.camera, yaw=yaw)) for yaw in yaws]


@contextlib.contextmanager
def client(scheduler: str | None, tasks: int) -> Iterator[distributed.Client]:
    """A client of a scheduler, or of one with a process for each of this machine's cores."""
    warnings.filterwarnings("ignore", "Sending large graph", UserWarning)  # a large mesh
    where = "--frames" if scheduler is None else f"--scheduler {scheduler!r}"
    with contextlib.ExitStack() as stack:
        logging.disable()  # what Dask says of a scheduler that went away fills a screen
        stack.callback(logging.disable, logging.NOTSET)
        try:
            if scheduler is None:
                stack.enter_context(dask.config.set(ENVIRONMENT))
                # Its processes never hear control-C. The tracker starts first: it ends by unblocking the signal.
                resource_tracker.ensure_running()
                heard = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
                stack.callback(signal.pthread_sigmask, signal.SIG_SETMASK, heard)
                scheduler = stack.enter_context(
                    distributed.LocalCluster(
                        n_workers=min(len(os.sched_getaffinity(0)), tasks),
                        threads_per_worker=1,
                        memory_limit=0,
                        dashboard_address=None,
                        silence_logs=logging.CRITICAL,
                    )
                )
                signal.pthread_sigmask(signal.SIG_SETMASK, heard)
                stack.callback(signal.pthread_sigmask, signal.SIG_BLOCK, [signal.SIGINT])  # nor does the clearing up
            made = stack.enter_context(distributed.Client(scheduler, timeout=PATIENCE))
            made.wait_for_workers(1, timeout=PATIENCE)
        except (OSError, ValueError, RuntimeError) as error:
            raise UserError(f"{where}: no worker answers, allowed the address of a running scheduler") from error
        try:
            yield made
        except distributed.KilledWorker as error:
            raise UserError(f"{where}: a frame's workers died, one after another") from error
        except (CommClosedError, CancelledError) as error:
            raise UserError(f"{where}: the scheduler went away") from error
