# SPDX-License-Identifier: Apache-2.0
"""shade_spans: vertices to spans, every bit of every packet; bad input; every pixel of a fan once; gaps and stalls."""

from __future__ import annotations

import numpy as np
import pytest
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import raster as golden
from polyshade.golden.types import SKIPPED, SPAN, pack, whole
from polyshade.sim import frame
from polyshade.sim.errors import UserError
from polyshade.sim.scan import scan
from polyshade.sim.scene.camera import Camera
from polyshade.sim.scene.mesh import load_mesh
from polyshade.sim.scene.raster import scan_convert

from tb.raster.vectors import fan, join, mixture, triangles
from tb.runner import SEED

REACH = 1 << 19  # clocks, more than any triangle takes


def same(v: golden.Vertices, view: golden.View, **traffic: float) -> sim.Run:
    """Run triangles through the RTL and compare everything with the golden model."""
    wanted = golden.scan(v, view)
    run = sim.load("shade_spans").run(
        **golden.beats(v), **view.ports, seed=SEED, drain=REACH, patience=REACH, **traffic
    )
    compare(run, wanted)
    return run


def skipped(wanted: golden.Scanned) -> int:
    """What was left out, as ``skipped_o`` tells it."""
    return whole(SKIPPED, {name: [count] for name, count in golden.skipped(wanted).items()})[0]


def compare(run: sim.Run, wanted: golden.Scanned) -> None:
    """Packets, places and counters."""
    expected = golden.lines(wanted)
    for name in ("column", "line", "depth", "increase"):
        assert np.array_equal(run.outputs[f"m_axis_span_tuser.{name}"], expected.pop(name)), name
    assert np.array_equal(run.outputs["m_axis_span_tdata"], pack(SPAN, expected))
    assert run.status["skipped_o"] == skipped(wanted)


@pytest.mark.parametrize("cull", [k.CULL_NONE, k.CULL_BACK, k.CULL_FRONT])
@pytest.mark.parametrize("flat", [0, 1])
def test_all_kinds(cull: int, flat: int) -> None:
    """20,000 triangles of all kinds; columns and lines of the frame differ."""
    run = same(mixture(np.random.default_rng([SEED, cull, flat]), 4000), golden.View(128, 101, cull, flat))
    assert len(run.given) > 10_000


def test_far_outside() -> None:
    """Vertices anywhere within 32768 pixels: they cover the frame or none of it, and all come to an end."""
    run = same(triangles(np.random.default_rng(SEED), "huge", 100, 64), golden.View(64, 64, k.CULL_NONE))
    assert len(run.given) > 500


@pytest.mark.parametrize(("in_gap", "out_stall"), [(0.7, 0.0), (0.0, 0.7), (0.5, 0.5)])
def test_gaps_and_stalls(in_gap: float, out_stall: float) -> None:
    """A source that pauses, a consumer that stalls."""
    view = golden.View(128, 128, k.CULL_NONE)
    same(mixture(np.random.default_rng(SEED), 800), view, in_gap=in_gap, out_stall=out_stall)


@pytest.mark.parametrize("size", [64, 300])
def test_every_pixel_of_a_fan_once(size: int) -> None:
    """Triangles around a point: no pixel twice, none missing between the first and the last of a line."""
    once(np.random.default_rng([SEED, size]), 200, size)


def once(rng: np.random.Generator, rows: int, size: int) -> None:
    """A closed fan of so many triangles: each of its pixels once."""
    v = fan(rng, rows, size)
    run = same(v, golden.View(size, size, k.CULL_NONE))
    column, line = (run.outputs[f"m_axis_span_tuser.{name}"] for name in ("column", "line"))
    count = run.outputs["m_axis_span_tdata"][:, 6].astype(np.int64) & (1 << k.COUNT_W) - 1
    hits = np.zeros((size, size + 1), np.int64)
    np.add.at(hits, (line, column), 1)
    np.add.at(hits, (line, column + count), -1)
    hits = hits.cumsum(axis=1)[:, :-1]
    assert hits.max() == 1
    assert all(np.all(np.diff(np.flatnonzero(row)) == 1) for row in hits)
    assert hits.sum() > 0.6 * size * size


def test_bad_input() -> None:
    """Numbers out of range, normals of length 0, no area; each told and skipped, the next triangle unharmed."""
    rng = np.random.default_rng(SEED)
    v = triangles(rng, "middle", 600)
    for row in range(0, 600, 3):
        kind, at = rng.integers(0, 7), rng.integers(0, 3)
        if kind == 0:
            v.x[row, at] = rng.choice([1 << 23, -(1 << 23) - 1, (1 << 31) - 1, -(1 << 31)])
        elif kind == 1:
            v.y[row, at] = rng.choice([1 << 23, -(1 << 23) - 1])
        elif kind == 2:
            v.depth[row, at] = 1 << 24
        elif kind == 3:
            v.normal[row, at, rng.integers(0, 3)] = rng.choice([65536, -65537])
        elif kind == 4:
            v.normal[row, at] = 0
        elif kind == 5:
            v.x[row, 2], v.y[row, 2] = v.x[row, 0], v.y[row, 0]
        else:
            v.x[row], v.y[row] = v.x[row, 0] + np.arange(3) * 700, v.y[row, 0] - np.arange(3) * 300
    view = golden.View(128, 128, k.CULL_NONE)
    same(v, view)
    wanted = golden.scan(v, view)
    assert all(wanted.faults[name] > 10 for name in ("range", "normal", "area"))


def test_steep_ones() -> None:
    """Slivers whose increments are beyond S2.29, up to millions a pixel: drawn as right as all others."""
    v, view = triangles(np.random.default_rng(SEED), "sliver", 500), golden.View(128, 128, k.CULL_NONE)
    same(v, view)
    assert golden.scan(v, view).steep.sum() > 20


def test_packets_cut_short_or_too_long() -> None:
    """tlast after one, two, four or more vertices: counted, skipped, the next triangle unharmed."""
    rng = np.random.default_rng(SEED)
    v = triangles(rng, "middle", 300)
    beats = golden.beats(v)
    data, last = beats["s_axis_vertex_tdata"], beats["s_axis_vertex_tlast"]
    rows, ends, bad = [], [], 0
    for i in range(300):
        if rng.random() < 0.4:
            length = int(rng.choice([1, 2, 4, 5, 9]))
            rows += list(data[rng.integers(0, len(data), length)])
            ends += [0] * (length - 1) + [1]
            bad += 1
        rows += list(data[3 * i : 3 * i + 3])
        ends += list(last[3 * i : 3 * i + 3])
    view = golden.View(128, 128, k.CULL_NONE)
    wanted = golden.scan(v, view)
    wanted.faults["packet"] = bad
    run = sim.load("shade_spans").run(
        s_axis_vertex_tdata=np.array(rows), s_axis_vertex_tlast=np.array(ends), **view.ports, drain=REACH
    )
    compare(run, wanted)


@pytest.mark.parametrize("projection", ["orthographic", "perspective"])
@pytest.mark.parametrize(("mesh", "subdivide", "size"), [("head", 0, 256), ("head", 0, 1024), ("sphere", 0, 512)])
def test_meshes(mesh: str, subdivide: int, size: int, projection: str) -> None:
    """Coverage of the float64 reference, pixel for pixel; the same triangle seen at every pixel."""
    whole = load_mesh(mesh, subdivide)
    screen = Camera(size=size, projection=projection).project(whole)
    made = scan(screen, whole.faces, size, scan_convert(screen, whole.faces, size))
    assert (made.mismatches, made.coverage_mismatches, made.depth_mismatches) == (0, 0, 0)


@pytest.mark.parametrize(("size", "rate"), [(1024, 0.95), (512, 0.8)])
def test_rate_on_the_head(size: int, rate: float) -> None:
    """A lane that takes a pixel a clock is kept busy, where spans may wait in front of it."""
    whole = load_mesh("head", 0)
    screen = Camera(size=size).project(whole)
    made = scan(screen, whole.faces, size, scan_convert(screen, whole.faces, size))
    free = 0
    for given, count in zip(made.given.tolist(), made.lines.count.tolist(), strict=True):
        free = max(free, given) + count
    assert made.lines.count.sum() / (free - made.given[0] + 1) >= rate


@pytest.mark.parametrize(("side", "clocks"), [(1, 25), (4, 25), (14, 36), (45, 98)])
def test_clocks_of_a_triangle(side: int, clocks: int) -> None:
    """Right-angled triangles of 1, 10, 105 and 1035 pixels: a clock a line, and one as the long edge moves a column."""
    x = np.tile(np.int64([[128, 128 + 256 * side, 128]]), (500, 1))
    y = np.tile(np.int64([[128, 128, 128 + 256 * side]]), (500, 1))
    shape = np.zeros((500, 3), np.int64)
    v = golden.Vertices(x, y, shape, np.full((500, 3, 3), 9000), np.arange(500), np.arange(500) * 0)
    run = same(v, golden.View(64, 64, k.CULL_NONE))
    assert run.clocks / 500 <= clocks


def test_a_triangle_alone_equals_one_in_a_stream() -> None:
    """What one triangle leaves behind does not change the next."""
    rng = np.random.default_rng(SEED)
    v = mixture(rng, 20)
    view = golden.View(128, 128, k.CULL_NONE)
    same(join([golden.take(v, [row, row]) for row in range(len(v))]), view)


def test_refused_before_the_work() -> None:
    """Vertices out of range, and variants that need a cosine: one line each."""
    with pytest.raises(UserError, match="32768 pixels away or more"):
        frame.render(frame.Settings(camera=Camera(size=4096, zoom=50.0), scan="rtl"))
    with pytest.raises(UserError, match="no cosines"):
        frame.Settings(path="normals", variant="V1", scan="rtl")
