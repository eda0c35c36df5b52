# SPDX-License-Identifier: Apache-2.0
"""Whole pictures from the RTL: vertices in, the rows of ``shade_scene``'s frame buffer out, compared with golden."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import direct
from polyshade.golden import raster as golden
from polyshade.golden.light import colour
from polyshade.golden.material import Material, chords, colour_registers, light_registers
from polyshade.golden.scene import scene

Ints = NDArray[np.int64]
TABLE, COMPLETE = 2, 1  # bits of tuser


@dataclass(frozen=True)
class Drawn:
    """Pictures (N, lines, columns, 3) of 8 bits, as they were read from the block RAM, and how they came about."""

    pictures: Ints
    expected: Ints
    pixels: int  # drawn and hidden ones
    clocks: int
    seconds: float
    skipped: int

    @property
    def mismatches(self) -> int:
        """Pixels that differ from the golden model's."""
        return int(np.any(self.pictures != self.expected, axis=-1).sum())


def weights(material: Material) -> dict[str, list[int]]:
    """ambient, kd, ks of red, green and blue, U1.16."""
    words = colour_registers(material)
    return {name: [words[f"{name}_{channel}"] for channel in "rgb"] for name in ("ambient", "kd", "ks")}


def painted(light: ArrayLike, material: Material) -> Ints:
    """Diffuse and specular light (..., 2) U0.16 to red, green and blue (..., 3), as ``shade_colour`` makes them."""
    diffuse, specular = np.moveaxis(np.asarray(light), -1, 0)[..., None]
    return colour(diffuse, specular, **weights(material))


def draw(
    frames: list[golden.Vertices], view: golden.View, material: Material, light, background: ArrayLike, bits: int = 8,
    double: int = 0, **options: float,
) -> Drawn:  # fmt: skip
    """Draw triangles by ``shade_scene``, a frame each, and compare. ``bits``: log2 of the buffer's sides."""
    table, words = chords(material, light), light_registers(light)
    vectors = {name: [words[f"{name}{axis}"] for axis in "xyz"] for name in "lh"}
    ports = {f"{n}_i.{axis}": v for n, parts in vectors.items() for axis, v in zip("xyz", parts, strict=True)}
    for name, parts in weights(material).items():
        ports |= {f"colour_i.{name}.{channel}": part for channel, part in zip("rgb", parts, strict=True)}
    ports |= {f"background_i.{n}": int(v) for n, v in zip(("red", "green", "blue"), background, strict=True)}

    lobe = direct.lobe_packet(table)
    entries = np.zeros((len(lobe["s_axis_surface_tdata"]), k.VERTEX_DATA_W // 32), np.uint32)
    entries[:, :2] = lobe["s_axis_surface_tdata"].view(np.uint32).reshape(-1, 2)
    data, last = [entries], [lobe["s_axis_surface_tlast"]]
    user = [np.full(len(entries), TABLE)]
    for v in frames:
        beats = golden.beats(v)
        data.append(beats["s_axis_vertex_tdata"])
        last.append(beats["s_axis_vertex_tlast"])
        user.append(np.where(np.arange(len(last[-1])) == len(last[-1]) - 1, COMPLETE, 0))
    stream = {"tdata": data, "tlast": last, "tuser": user}
    sent = {f"s_axis_vertex_{name}": np.concatenate(parts) for name, parts in stream.items()}

    scanned = [golden.scan(v, view) for v in frames]
    model = sim.load("shade_scene", COLUMNS_LOG2=bits, LINES_LOG2=bits, DOUBLE=double)
    began = time.perf_counter()
    patience = 1 << 19
    run = model.run(**sent, **view.ports, **ports, drain=1 << 12, patience=patience, **options)
    seconds = time.perf_counter() - began

    def shade(packets: dict[str, NDArray]) -> Ints:
        return painted(direct.direct(*packets.values(), vectors["l"], vectors["h"], table).pixels, material)

    expected = np.stack([scene(s, view, shade, background) for s in scanned])
    rows = np.stack([run.outputs[f"m_axis_frame_tdata.{name}"] for name in ("red", "green", "blue")], axis=-1)
    if rows.size != expected.size:
        raise sim.SimulationError(f"{model!r}: {len(rows)} pixels came, expected {expected.size // 3}")
    clocks = int(run.given[-1] - run.taken[len(entries)] + 1)
    pixels = sum(int(s.count.sum()) for s in scanned)
    return Drawn(rows.reshape(expected.shape), expected, pixels, clocks, seconds, run.status["skipped_o"])
