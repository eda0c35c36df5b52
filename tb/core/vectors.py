# SPDX-License-Identifier: Apache-2.0
"""Spans and settings that several benches of rtl/core share."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from polyshade.golden import contract as k
from polyshade.golden import types
from polyshade.golden.fixed import ONE
from polyshade.golden.material import MODELS, Material, colour_registers, planner_registers
from polyshade.golden.material import registers as material_registers
from polyshade.golden.normal import pack_spans
from polyshade.golden.registers import draw as named

from tb.bench import Bench

CODES = range(1 << k.MODEL_W)  # reserved ones too
NAMES = {code: name for name, code in MODELS.items()}


@dataclass
class Spans:
    """Spans of interpolated normals: arrays (S, 3), S2.29, and (S,)."""

    normal: np.ndarray
    step: np.ndarray
    count: np.ndarray
    tag: np.ndarray
    cosine: np.ndarray
    flat: np.ndarray

    def words(self) -> list[tuple[int]]:
        """What a source sends as ``s_axis_span_tdata``."""
        beats = pack_spans(self.normal, self.step, self.count, self.cosine, self.tag, self.flat)
        return [(number(beat),) for beat in beats]

    @property
    def faulty(self) -> np.ndarray:
        """(S,) of which length there are none."""
        return (self.count == 0) | (self.count > k.PIXELS_MAX)


def spans(bench: Bench, count: ArrayLike) -> Spans:
    """Spans of so many pixels between unit normals, most of them close; one in eight has any 32 bits, one a zero."""
    rng, count = bench.rng, np.asarray(count)
    rows = count.size
    first, other = rng.standard_normal((2, rows, 3))
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    last = first + other * rng.choice([0.02, 0.2, 1.0], (rows, 1))
    step = (last - first) / np.maximum(count - 1, 1)[:, None]
    normal, step = (np.rint(part * (1 << k.STEP_F)).astype(int) for part in (first, step))
    kind = rng.integers(0, 8, (rows, 1))
    free = rng.integers(-(1 << k.STEP_W - 1), 1 << k.STEP_W - 1, (2, rows, 3))
    normal, step = (
        np.select([kind == 0, kind == 1], [part, 0], v) for part, v in zip(free, (normal, step), strict=True)
    )
    tag, cosine, flat = (
        rng.permutation(1 << k.TAG_W)[:rows],
        bench.signed(k.INTENSITY_W, rows),
        rng.integers(0, 2, rows),
    )
    return Spans(normal, step, count, tag, cosine, flat)


def registers(bench: Bench, code: int, light: ArrayLike) -> dict[str, int]:
    """Register values of a random material of a model, or of a reserved code."""
    shininess, roughness = 2.0 ** bench.rng.uniform(0, 10), bench.rng.uniform(0.05, 0.7)
    words = material_registers(Material(NAMES.get(code, "blinn"), shininess, roughness), light)
    return words | {"model": code, "cosine": int(bench.rng.integers(0, 2))}


def settings(bench: Bench, code: int) -> dict[str, int]:
    """A draw call: a random material of a model, or of a reserved code, lit from anywhere, in any colours."""
    surface = Material(NAMES.get(code, "blinn"))
    colours = {name: int(bench.rng.integers(0, ONE, endpoint=True)) for name in colour_registers(surface)}
    return planner_registers(surface) | registers(bench, code, bench.rng.standard_normal(3)) | colours


def set_draw(bench: Bench, draw: dict[str, int]) -> None:
    """Drive ``draw_i``."""
    bench.dut.draw_i.value = types.whole(types.DRAW, named(draw))[0]


def number(words: np.ndarray) -> int:
    """Words of 32 bits, least significant first, as one number."""
    return int.from_bytes(words.astype("<u4").tobytes(), "little")
