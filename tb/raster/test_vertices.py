# SPDX-License-Identifier: Apache-2.0
"""shade_vertices: three beats to a triangle, differences and box; faults of numbers and packets; gaps and stalls."""

import numpy as np
import pytest
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import raster as golden

from tb.raster.vectors import mixture, triangles
from tb.runner import SEED


@pytest.mark.parametrize("flat", [0, 1])
@pytest.mark.parametrize(("in_gap", "out_stall"), [(0.0, 0.0), (0.5, 0.5)])
def test_triangles(flat: int, in_gap: float, out_stall: float) -> None:
    """Every number of every triangle; bad ones leave no trace."""
    rng = np.random.default_rng(SEED)
    v = mixture(rng, 500)
    bad = rng.random(len(v)) < 0.2
    v.x[bad, rng.integers(0, 3, bad.sum())] = 1 << k.COORDINATE_W - 1
    run = sim.load("shade_vertices").run(**golden.beats(v), flat_i=flat, in_gap=in_gap, out_stall=out_stall, seed=SEED)
    v = golden.take(v, np.flatnonzero(~bad))
    out, mask = run.outputs, (1 << k.COORDINATE_W + 1) - 1
    for name, value in (("x", v.x), ("y", v.y)):
        assert np.array_equal(unpacked(out[f"{name}_o"], k.COORDINATE_W + 1, 1)[:, 0], value[:, 0] + 127)
        step = value[:, 1:] - value[:, :1] & mask
        assert np.array_equal(out[f"d{name}_o"], step[:, 0] | step[:, 1] << k.COORDINATE_W + 1)
        assert np.array_equal(out[f"corner_o.{name}"], value[:, 0] + 127)
    assert np.array_equal(out["corner_o.depth"], v.depth[:, 0])
    assert np.array_equal(out["corner_o.tag"], v.tag)
    assert np.array_equal(out["corner_o.flat"], v.flat)
    assert np.array_equal(out["corner_o.normal.z"], v.normal[:, 0, 2])
    ddepth = v.depth[:, 1:] - v.depth[:, :1]
    assert np.array_equal(unpacked(out["ddepth_o"], k.DEPTH_F + 1, 2), ddepth)
    dnormal = (v.normal[:, 1:] - v.normal[:, :1]).reshape(-1, 6) * (1 - flat)
    assert np.array_equal(unpacked(out["dnormal_o"], k.VERTEX_W + 1, 6), dnormal)
    corners = [golden.line_of(a) for a in (v.x.max(axis=1), v.x.min(axis=1), v.y.max(axis=1), v.y.min(axis=1))]
    assert np.array_equal(unpacked(out["box_o"], k.LINE_W, 4), np.stack(corners, axis=-1))
    if not in_gap:
        assert run.clocks <= 5 * len(bad) + 10


def test_faults_leave_no_triangle() -> None:
    """Depth and place out of range, a normal of length 0, a packet of four and one without an end."""
    v = triangles(np.random.default_rng(SEED), "small", 8)
    v.depth[1, 2] = 1 << k.DEPTH_F
    v.normal[2, 1] = 0
    v.normal[3, 0], v.y[3, 1] = 0, -(1 << k.COORDINATE_W)
    beats = golden.beats(v)
    beats["s_axis_vertex_tlast"] = np.r_[beats["s_axis_vertex_tlast"][:-2], 1, 0]
    beats["s_axis_vertex_tlast"][-4] = 0
    run = sim.load("shade_vertices").run(**beats, flat_i=0, seed=SEED)
    assert run.outputs["corner_o.tag"].tolist() == v.tag[[0, 4, 5]].tolist()


def unpacked(words: np.ndarray, width: int, count: int) -> np.ndarray:
    """Signed numbers side by side in a port."""
    rows = words.astype(np.uint64).reshape(len(words), -1)
    step = 32 if rows.shape[1] > 1 else 64
    whole = [sum(int(word) << step * i for i, word in enumerate(row)) for row in rows]
    parts = [[row >> width * i & (1 << width) - 1 for i in range(count)] for row in whole]
    values = np.array(parts, np.int64)
    return values - (values >> width - 1 << width)
