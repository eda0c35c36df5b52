# SPDX-License-Identifier: Apache-2.0
"""shade_surfaces: vertices to packets of triangles, every beat; what is skipped; gaps and stalls; meshes."""

from __future__ import annotations

import numpy as np
import pytest
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import raster as golden
from polyshade.sim import frame
from polyshade.sim.scene.camera import Camera

from tb.raster.test_spans import REACH, skipped
from tb.raster.vectors import mixture
from tb.runner import SEED


@pytest.mark.parametrize(("in_gap", "out_stall"), [(0.0, 0.0), (0.6, 0.0), (0.0, 0.6)])
def test_packets(in_gap: float, out_stall: float) -> None:
    """4,000 triangles of all kinds, slivers among them."""
    v, view = mixture(np.random.default_rng(SEED), 800), golden.View(128, 101, k.CULL_NONE)
    run = sim.load("shade_surfaces").run(
        **golden.beats(v), **view.ports, seed=SEED, drain=REACH, patience=REACH, in_gap=in_gap, out_stall=out_stall
    )
    wanted = golden.scan(v, view)
    for name, values in golden.packets(wanted).items():
        assert np.array_equal(run.outputs[name.replace("s_", "m_", 1)].astype(values.dtype), values), name
    assert run.status["skipped_o"] == skipped(wanted)
    assert (wanted.narrow == 0).any()


@pytest.mark.parametrize(("path", "bound"), [("line", 2e-8), ("direct", 1e-5), ("patch", 1e-5)])
def test_a_frame_by_vertices(path: str, bound: float) -> None:
    """Every path draws what the RTL scanned: 0 mismatches, the reference's coverage and depth."""
    told = frame.render(frame.Settings(camera=Camera(size=96), path=path)).report
    assert (told["scan"], told["mismatches"], told["coverage_mismatches"], told["depth_mismatches"]) == ("rtl", 0, 0, 0)
    assert told["nmse"] < bound
