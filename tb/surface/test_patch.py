# SPDX-License-Identifier: Apache-2.0
"""shade_patch and its parts: triangles in, pixels out, to the bit of golden.patch, however either side pauses."""

from __future__ import annotations

import cocotb
import numpy as np
import pytest
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import patch as golden
from polyshade.golden.material import Material
from polyshade.sim import patch
from polyshade.sim.scene.camera import Camera
from polyshade.sim.scene.mesh import load_mesh
from polyshade.sim.scene.raster import scan_convert
from polyshade.sim.scene.triangles import Triangles

from tb.bench import Bench, Sink, Source, checked, no_path
from tb.runner import SEED, points, simulate
from tb.surface.vectors import LIGHT, model, part, triangles

SURFACE, PIXEL = "s_axis_surface_", "m_axis_pixel_"
PAYLOAD = [PIXEL + name for name in ("tuser", "tdata", "tlast")]


def scene(mesh: str, size: int) -> Triangles:
    shape = load_mesh(mesh)
    return Triangles.of(scan_convert(Camera(size=size).project(shape), shape.faces, size))


# ---- whole frames by the NumPy engine -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("mesh", "size", "shininess", "lanes", "pauses"),
    [
        ("sphere", 256, 32, 1, {}),
        ("head", 128, 512, 2, {"in_gap": 0.3, "out_stall": 0.3}),
        ("head", 256, 32, 4, {"out_stall": 0.6}),
        pytest.param("sphere", 256, 8, 8, {"in_gap": 0.7}, marks=pytest.mark.full),
    ],
)
def test_frames(mesh: str, size: int, shininess: float, lanes: int, pauses: dict[str, float]) -> None:
    drawn = patch.draw(scene(mesh, size), Material("blinn", shininess), LIGHT, lanes=lanes, seed=SEED, **pauses)
    assert (drawn.mismatches, drawn.first_mismatch, drawn.counter_mismatches) == (0, {}, {})


@pytest.mark.parametrize("lanes", [1, 4])
def test_triangles_of_all_kinds(lanes: int) -> None:
    """Slivers, single pixels, triangles as large as the frame, flat and strongly curved ones, without a highlight."""
    for model_, seed in (("blinn", SEED), ("lambert", SEED + 1)):
        given = triangles(np.random.default_rng(seed), 400)
        drawn = patch.draw(given, Material(model_, 100), LIGHT, lanes=lanes, seed=seed, out_stall=0.2)
        assert (drawn.mismatches, drawn.first_mismatch, drawn.counter_mismatches) == (0, {}, {})


@pytest.mark.parametrize(("lights", "lanes"), [pytest.param(2, 1, marks=pytest.mark.full), (4, 4)])
def test_several_lights(lights: int, lanes: int) -> None:
    """Their sum, on the same clocks a pixel as one light."""
    directions = np.array([LIGHT, (-0.8, 0.2, 0.4), (0.1, -0.7, 0.3), (0.5, 0.5, -0.2)])[:lights]
    given = scene("sphere", 256)
    one, drawn = (patch.draw(given, Material("blinn", 32), at, lanes=lanes) for at in (LIGHT, directions))
    assert (drawn.mismatches, drawn.first_mismatch, drawn.counter_mismatches) == (0, {}, {})
    assert drawn.pixels.sum() > 1.2 * one.pixels.sum()
    rng = np.random.default_rng(SEED)
    drawn = patch.draw(triangles(rng, 300), Material("blinn", 100), directions, lanes=lanes, seed=SEED, out_stall=0.2)
    assert (drawn.mismatches, drawn.first_mismatch, drawn.counter_mismatches) == (0, {}, {})


def test_speed() -> None:
    """A large triangle keeps all lanes busy; small ones cost what the input costs."""
    large = triangles(np.random.default_rng(7), 60)
    biggest = int(np.bincount(large.triangle, large.count).argmax())
    one = part(large, np.arange(len(large.tag)) == biggest)
    for lanes, least in ((1, 0.97), (4, 3.4), (8, 6.2)):
        drawn = patch.draw(one, Material("blinn", 32), LIGHT, lanes=lanes)
        assert drawn.mismatches == 0
        assert len(drawn.pixels) / (drawn.clocks - 150) > least, f"{lanes} lanes"


def damaged(case: str) -> tuple[dict, Triangles, int, int]:
    """Packets of which one is wrong; the triangles that are drawn nevertheless, the error's bit and how often."""
    given = triangles(np.random.default_rng(5), 40)
    _, lobe = golden.registers(Material(), LIGHT)
    stream = patch.beats(given, lobe)
    runs = np.bincount(given.triangle)
    victim = int(np.flatnonzero(runs > 4)[1])
    first = patch.LOBE_BEATS + k.TRIANGLE_BEATS * victim + int(runs[:victim].sum())  # its first beat
    run = first + k.TRIANGLE_BEATS
    others = np.arange(len(runs)) != victim
    data, last = stream["s_axis_surface_tdata"], stream["s_axis_surface_tlast"]
    start = int(runs[:victim].sum())

    def without(row: int) -> Triangles:
        """All runs but one of the victim's."""
        kept = np.arange(len(given.count)) != start + row
        fields = {name: getattr(given, name)[kept] for name in ("triangle", "column", "line", "count")}
        return Triangles(**{**vars(given), **fields})

    mask = np.uint64(0xFFFFFFFF)
    if case == "short":  # the packet ends among its first beats
        drop = np.ones(len(data), bool)
        drop[first + 2 : run + runs[victim]] = False
        last[first + 1] = 1
        return {name: values[drop] for name, values in stream.items()}, part(given, others), k.ERROR_DIRECT, 1
    if case == "no columns":
        data[first] &= ~np.uint64(0x1FFF)
        return stream, part(given, others), k.ERROR_EMPTY, 1
    if case == "too many lines":
        data[first] |= np.uint64(0x1FFF << 16)
        return stream, part(given, others), k.ERROR_EMPTY, 1
    if case == "empty run":
        data[run + 2] &= mask
        return stream, without(2), k.ERROR_LONG, 1
    if case == "long run":
        data[run + 2] = (data[run + 2] & mask) | np.uint64(4096 << 32)
        return stream, without(2), k.ERROR_LONG, 1
    if case == "the same line again":
        data[run + 3] = (data[run + 3] & ~np.uint64(0xFFF << 16)) | (data[run + 2] & np.uint64(0xFFF << 16))
        return stream, without(3), k.ERROR_LONG, 1
    assert case == "empty last run"  # which is allowed
    data[run + runs[victim] - 1] &= mask
    return stream, without(runs[victim] - 1), 0, 0


@pytest.mark.parametrize(
    "case",
    ["short", "no columns", "too many lines", "empty run", "long run", "the same line again", "empty last run"],
)
def test_bad_packets(case: str) -> None:
    """What is wrong is dropped, told and counted; all else is drawn to the bit."""
    stream, left, bit, count = damaged(case)
    words, lobe = golden.registers(Material(), LIGHT)
    run = sim.load("shade_patch", LANES=2, LIGHTS=1).run(**stream, **patch.settings(words), seed=SEED, out_stall=0.3)
    wanted = golden.draw(model(left), words, lobe)
    user = (wanted.line << k.PLACE_W | wanted.column) << k.TAG_W | wanted.tag
    expected = np.stack([user, wanted.pixels[:, 0] | wanted.pixels[:, 1] << k.PIXEL_W, wanted.last], axis=-1)
    actual = patch.streams(run.outputs, 2)
    assert (actual[np.lexsort(actual.T)] == expected[np.lexsort(expected.T)]).all()
    assert run.status["error_o"] == (1 << bit if count else 0)
    assert run.status["error_count_o"] == count


# ---- flow control, clock by clock ----------------------------------------------------------------------------------


@points({"LANES": 1})
def test_cocotb(point):
    simulate("shade_patch", point)


def packets(bench: Bench, count: int) -> tuple[list[tuple[int, int, int]], list[tuple[int, int, int]]]:
    """Beats of the table and of triangles, and the pixels of these, sorted; drives the settings."""
    given = triangles(bench.rng, count, 48)
    words, lobe = golden.registers(Material(), LIGHT)
    for name, value in patch.settings(words).items():
        getattr(bench.dut, name).value = int(value)
    stream = patch.beats(given, lobe)
    names = [SURFACE + name for name in ("tdata", "tlast")]
    beats = list(zip(*(stream[name].tolist() for name in names), strict=True))
    wanted = golden.draw(model(given), words, lobe)
    user = (wanted.line << k.PLACE_W | wanted.column) << k.TAG_W | wanted.tag
    pixels = zip(
        user.tolist(), (wanted.pixels[:, 0] | wanted.pixels[:, 1] << k.PIXEL_W).tolist(), wanted.last.tolist(),
        strict=True,
    )  # fmt: skip
    return beats, sorted(pixels)


def setup(bench: Bench, stall: float = 0.0) -> tuple[Source, Sink]:
    source = Source(bench, SURFACE + "tvalid", SURFACE + "tready", [SURFACE + n for n in ("tdata", "tlast")])
    return source, Sink(bench, PIXEL + "tvalid", PIXEL + "tready", PAYLOAD, stall)


async def compare(bench: Bench, sink: Sink, expected: list[tuple[int, int, int]]) -> None:
    await bench.until(lambda: len(sink.words) >= len(expected), 20 * len(expected) + 2000, f"{len(expected)} pixels")
    await bench.tick(200)
    bench.equal(len(sink.words), len(expected), "number of pixels")
    for word, wanted in zip(sorted(sink.words), expected, strict=True):
        for name, actual, value in zip(PAYLOAD, word, wanted, strict=True):
            bench.equal(actual, value, f"pixel {wanted[0]:#x}: {name}", bench.bits(name))


@checked()
async def resets(bench: Bench) -> None:
    """One clock of reset at any moment, with ready at 1 and at 0: the next packets are drawn as if they were first."""
    source, sink = setup(bench)
    beats, expected = packets(bench, 8)
    head = patch.LOBE_BEATS
    for round_ in range(6):
        sink.stall = float(round_ % 2)
        await source.send(beats[: head + int(bench.rng.integers(1, len(beats) - head))], 0.0)
        await bench.tick(int(bench.rng.integers(0, 120)))
        source.withdraw()
        await bench.reset(1)
        sink.stall = 0.0
        await bench.tick()
        sink.forget()
        await source.send(beats)
        await compare(bench, sink, expected)
        sink.forget()


@checked(gap=[0.0, 0.5], stall=[0.0, 0.7])
async def traffic(bench: Bench, gap: float, stall: float) -> None:
    """All pixels come once, whoever pauses; what waits stays as it is; no output follows an input within a clock."""
    source, sink = setup(bench, stall)
    beats, expected = packets(bench, 12)
    inputs = [*(SURFACE + name for name in ("tvalid", "tdata", "tlast")), PIXEL + "tready"]
    cocotb.start_soon(no_path(bench, inputs, [SURFACE + "tready", PIXEL + "tvalid", *PAYLOAD]))
    await source.send(beats, gap)
    await compare(bench, sink, expected)
