# SPDX-License-Identifier: Apache-2.0
"""shade_direct: packets in, pixels out, to the bit of golden.direct.direct; faults, stalls, frames, their error."""

import numpy as np
import pytest
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden.direct import Lobe, direct, lobe_packet
from polyshade.golden.material import Material, chords, light_registers
from polyshade.sim.scene.camera import Camera
from polyshade.sim.scene.mesh import load_mesh
from polyshade.sim.scene.raster import expand, resolve, scan_convert
from polyshade.sim.scene.triangles import Triangles

from tb.runner import SEED
from tb.surface.direct_vectors import direction, lobe, packets, vector

LIGHT = (0.3, 0.6, 0.8)


def drawn(stream: dict[str, np.ndarray], l: np.ndarray, h: np.ndarray, table: Lobe, **options) -> sim.Run:  # noqa: E741
    """Run the packets behind the table's; compare every pixel, tag, end of run and fault."""
    head = lobe_packet(table)
    beats = {name: np.concatenate([head[name], stream[name]]) for name in stream}
    run = sim.load("shade_direct").run(**beats, **vector("l_i", l), **vector("h_i", h), seed=SEED, **options)
    wanted = direct(*stream.values(), l, h, table)
    assert len(run.given) == len(wanted.pixels)
    assert np.array_equal(run.m_axis_pixel_tdata, wanted.pixels[:, 0] | wanted.pixels[:, 1] << k.PIXEL_W)
    assert np.array_equal(run.m_axis_pixel_tuser, wanted.tag)
    assert np.array_equal(run.m_axis_pixel_tlast, wanted.last)
    assert run.status == {"busy_o": 0, "error_o": wanted.errors, "error_count_o": wanted.dropped}
    return run


@pytest.mark.parametrize(("in_gap", "out_stall"), [(0, 0), (0.5, 0), (0, 0.9), (0.3, 0.3)])
@pytest.mark.parametrize("faults", [0.0, 0.3])
def test_packets(faults: float, in_gap: float, out_stall: float) -> None:
    """Triangles of any kind, steep, short, of no length; the next one is unharmed by one that is at fault."""
    rng = np.random.default_rng([SEED, 1])
    for shift in (0, 3, 7):
        l, h = direction(rng), direction(rng)  # noqa: E741
        table = lobe(32.0, shift, int(rng.integers(-222, 222)))
        drawn(packets(rng, 400, faults), l, h, table, in_gap=in_gap, out_stall=out_stall)


def test_another_lobe_waits_for_the_pixels_before_it() -> None:
    rng = np.random.default_rng([SEED, 2])
    z = np.array([0, 0, 65536])
    first, other = lobe(8.0, 0, 5), lobe(128.0, 3, -7)
    streams = [packets(rng, 30) for _ in range(2)]
    parts = [lobe_packet(first), streams[0], lobe_packet(other), streams[1]]
    beats = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    run = sim.load("shade_direct").run(**beats, **vector("l_i", z), **vector("h_i", z))
    wanted = [
        direct(*stream.values(), z, z, table).pixels for stream, table in zip(streams, (first, other), strict=True)
    ]
    pixels = np.concatenate(wanted)
    assert np.array_equal(run.m_axis_pixel_tdata, pixels[:, 0] | pixels[:, 1] << k.PIXEL_W)


@pytest.mark.parametrize("size, pixels_per_clock", [(256, 0.6), (512, 0.9)])
def test_head(size: int, pixels_per_clock: float) -> None:
    """Every pixel of the head; at 512 at least 0.9 a clock; NMSE at most 1e-7 for every shininess."""
    mesh = load_mesh("head")
    spans = scan_convert(Camera(size=size, yaw=30.0).project(mesh), mesh.faces, size)
    triangles = Triangles.of(spans)
    stream, words = triangles.stream(), light_registers(LIGHT)
    l, h = (np.array([words[f"{name}{axis}"] for axis in "xyz"]) for name in "lh")  # noqa: E741
    run = drawn(stream, l, h, chords(Material(shininess=32.0), LIGHT))
    began = run.taken[1025]
    assert len(run.given) / (run.given[-1] - began + 1) >= pixels_per_clock

    visible = resolve(spans, size)
    seen = visible[visible >= 0]
    every = expand(spans, size)
    normal = (spans.normal[every.span] + every.step[:, None] * spans.gradient[every.span])[seen]
    for shininess in (8.0, 32.0, 128.0, 512.0):
        material = Material(shininess=shininess)
        pixels = direct(*stream.values(), l, h, chords(material, LIGHT)).pixels[seen] / 65536
        exact = material.channels(normal, LIGHT).clip(0, 1)
        assert np.all(((pixels - exact) ** 2).sum(axis=0) <= 1e-7 * (exact**2).sum(axis=0)), shininess
