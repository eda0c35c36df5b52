# SPDX-License-Identifier: Apache-2.0
"""shade_edges: the three edges of any triangle, in order, as first columns and lines see them."""

from __future__ import annotations

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import raster as golden

from tb.bench import Bench, checked
from tb.raster.streams import fields
from tb.raster.vectors import mixture, triangles
from tb.runner import points, simulate

W, L_W = k.COORDINATE_W, k.LINE_W


@points({})
def test_cocotb(point):
    simulate("shade_edges", point)


@checked()
async def values(bench: Bench) -> None:
    """Of each edge: the upper vertex, the way to the lower one, lines, side, and the first column of its first line."""
    dut = bench.dut
    dut.load_i.value = dut.step_i.value = 0
    v = mixture(bench.rng, 40)
    v = golden.take(v, np.flatnonzero(golden.twice_area(v) != 0))
    far = triangles(bench.rng, "huge", 20)
    for rows in (v, far):
        for i in range(len(rows)):
            await one(bench, [(int(x), int(y)) for x, y in zip(rows.x[i], rows.y[i], strict=True)])


async def one(bench: Bench, vertex: list[tuple[int, int]]) -> None:
    """A triangle: the two edges from its top vertex and the third one."""
    dut = bench.dut
    dut.load_i.value = 1
    for x, y in vertex:
        dut.x_i.value, dut.y_i.value = x + 127 & (2 << W) - 1, y + 127 & (2 << W) - 1
        await bench.tick()
        dut.load_i.value = 0
    await bench.tick()
    await bench.until(lambda: int(dut.some_o.value) == 1, 10, "an edge")
    found = []
    for _ in range(3):
        side = fields("side_t", int(dut.side_o.value))
        dx, dy, line, column, lines, right = (side[n] for n in ("dx", "dy", "line", "column", "lines", "right"))
        rest = -((side["u"] + 1) * dy + side["t"] * dx) >> k.SUBPIXEL_F
        found.append((line, lines, dx, dy, right, column - 1 - rest // dy if lines else None))
        dut.step_i.value = 1
        await bench.tick()
        dut.step_i.value = 0
        await bench.tick(int(bench.rng.integers(1, 3)))
    wanted = []
    for a, b in ((0, 1), (1, 2), (2, 0)):
        up = vertex[b][1] < vertex[a][1]
        (x, y), (x2, y2) = (vertex[b], vertex[a]) if up else (vertex[a], vertex[b])
        line = int(golden.line_of(y))
        lines = int(golden.line_of(y2)) - line
        first = int(golden.edges(x, y, x2 - x, y2 - y, line)) if lines else None
        wanted.append((line, lines, x2 - x, y2 - y, int(not up), first))
    flat = [edge for edge in wanted if edge[3] == 0]  # of a level edge neither end is the upper one
    level = [edge for edge in found if edge[3] == 0]
    bench.equal(len(level), len(flat), "level edges")
    bench.equal(
        sorted(edge for edge in found if edge[3]) == sorted(edge for edge in wanted if edge[3]),
        True,
        f"edges of {vertex}",
    )
    top = min(line for line, *_ in wanted)
    bench.equal(all(edge[0] == top for edge in found[:2]), True, "the first two begin at the top")
