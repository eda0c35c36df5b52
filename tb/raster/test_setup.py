# SPDX-License-Identifier: Apache-2.0
"""shade_setup: edges, increments, box and vertex 0 of every triangle that is drawn; the others are told."""

from __future__ import annotations

import random
from collections import Counter

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import raster as golden

from tb.bench import PRESSURE, Bench, Sink, Watch, checked, scramble
from tb.raster.streams import fields, word
from tb.raster.vectors import edges, mixture
from tb.runner import points, simulate

SIZE = 50


@points({})
def test_cocotb(point):
    simulate("shade_setup", point)


def side_by_side(values: np.ndarray, width: int) -> int:
    """Numbers in a packed array, the first at the bottom."""
    return sum((int(value) & (1 << width) - 1) << width * i for i, value in enumerate(values))


def corner(v: golden.Vertices, i: int) -> dict[str, int]:
    """Vertex 0 by the names of ``corner_t``."""
    normal = {f"normal.{axis}": v.normal[i, 0, c] for c, axis in enumerate("xyz")}
    return normal | {
        "x": v.x[i, 0] + 127,
        "y": v.y[i, 0] + 127,
        "depth": v.depth[i, 0],
        "tag": v.tag[i],
        "flat": v.flat[i],
    }


def checked_triangle(v: golden.Vertices, i: int) -> tuple[int, ...]:
    """A triangle as shade_vertices gives it."""
    x, y, depth, normal = v.x[i], v.y[i], v.depth[i], v.normal[i]
    box = [golden.line_of(a) for a in (x.max(), x.min(), y.max(), y.min())]
    return (
        side_by_side(x[1:] - x[0], k.COORDINATE_W + 1),
        side_by_side(y[1:] - y[0], k.COORDINATE_W + 1),
        side_by_side(depth[1:] - depth[0], k.DEPTH_F + 1),
        side_by_side((normal[1:] - normal[0]).ravel(), k.VERTEX_W + 1),
        word("corner_t", **corner(v, i)),
        side_by_side(np.array(box), k.LINE_W),
    )


PORTS = ("dx_i", "dy_i", "ddepth_i", "dnormal_i", "corner_i", "box_i")


async def send(bench: Bench, v: golden.Vertices, gap: float) -> None:
    """Triangles as shade_vertices gives them, the places of vertices 1 and 2 in the two clocks behind their own."""
    dut, mask = bench.dut, (2 << k.COORDINATE_W) - 1
    for i in range(len(v)):
        while random.random() < gap:
            await bench.tick()
        for name, bits in zip(PORTS, checked_triangle(v, i), strict=True):
            getattr(dut, name).value = bits
        dut.valid_i.value = 1
        for j in range(3):
            dut.x_i.value, dut.y_i.value = int(v.x[i, j] + 127) & mask, int(v.y[i, j] + 127) & mask
            await bench.tick()
            while j == 0 and not int(dut.ready_o.value):
                await bench.tick()
            dut.valid_i.value = 0
            for name in PORTS:
                scramble(getattr(dut, name))
        await bench.tick()


@checked(**PRESSURE, cull=[k.CULL_NONE, k.CULL_BACK])
async def triangles(bench: Bench, gap: float, stall: float, cull: int) -> None:
    """Small and wide ones, of both orientations, without area, outside."""
    dut = bench.dut
    dut.columns_i.value = dut.lines_i.value = SIZE
    dut.cull_i.value = cull
    heads = Sink(bench, "head_valid_o", "head_ready_i", ["head_o"], stall)
    shapes, pairs = Watch(bench, "edge_valid_o", ["edge_o"]), Watch(bench, "pair_valid_o", ["pair_o"])
    told: Counter[str] = Counter()

    async def count() -> None:
        while True:
            await bench.tick()
            told.update(name for name, bit in fields("fate_t", int(dut.told_o.value)).items() if bit)

    cocotb.start_soon(count())
    v = mixture(bench.rng, 12, SIZE)
    v.x[::7], v.y[::7] = v.x[::7, :1], v.y[::7, :1]
    cocotb.start_soon(send(bench, v, gap))

    area = golden.twice_area(v)
    low, high = (golden.line_of(np.stack([a.min(axis=1), a.max(axis=1)])) for a in (v.x, v.y))
    inside = (np.maximum(low[0], 0) < np.minimum(low[1], SIZE)) & (np.maximum(high[0], 0) < np.minimum(high[1], SIZE))
    back = (area > 0) & (cull == k.CULL_BACK)
    drawn = golden.take(v, np.flatnonzero((area != 0) & ~back & inside))
    await bench.until(lambda: len(heads.words) >= len(drawn), 20_000, "all triangles")
    await bench.tick(100)
    counts = [(area == 0).sum(), ((area != 0) & back).sum(), ((area != 0) & ~back & ~inside).sum()]
    for name, number in zip(("area", "culled", "outside"), counts, strict=True):
        bench.equal(told[name], int(number), name)
    bench.equal(len(shapes.words), 3 * len(drawn), "edges")
    bench.equal(len(pairs.words), 4 * len(drawn), "pairs")
    column, line, steep = golden.setup(drawn)
    for i in range(len(drawn)):
        for j, wanted in enumerate(edges(drawn, i)):
            edge = fields("edge_t", shapes.words[3 * i + j][0])
            shown = edge if wanted["lines"] else {"lines": edge["lines"]}  # of a level edge nothing else counts
            bench.equal(shown == {name: int(wanted[name]) for name in shown}, True, f"edge {j} of {i}")
        for c in range(golden.COMPONENTS):
            pair = fields("pair_t", pairs.words[4 * i + c][0])
            wanted = (column[i, c], line[i, c], steep[i, c])
            bench.equal((pair["column"], pair["line"], pair["steep"]) == wanted, True, f"pair {c} of {i}")
        head = fields("sized_t", heads.words[i][0])
        wanted = {f"corner.{name}": int(value) for name, value in corner(drawn, i).items()}
        bench.equal(all(head[name] == value for name, value in wanted.items()), True, f"vertex 0 of {i}")
