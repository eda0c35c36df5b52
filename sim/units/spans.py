# SPDX-License-Identifier: Apache-2.0
"""Spans of interpolated normals and settings of draw calls, of all kinds there are."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import ArrayLike
from polyshade.golden import contract as k
from polyshade.golden import registers
from polyshade.golden.fixed import ONE
from polyshade.golden.material import MODELS, Material, colour_registers, planner_registers
from polyshade.golden.material import registers as material_registers
from polyshade.golden.normal import pack_spans
from polyshade.golden.types import SPAN, unpack
from polyshade.sim.units.case import Arrays, corners, signed_range

CODES = range(1 << k.MODEL_W)  # of models, reserved ones too
NAMES = {code: name for name, code in MODELS.items()}
PATHS = (k.PATH_POLY, k.PATH_NORMALS)


@dataclass
class Spans:
    """Spans of interpolated normals: arrays (S, 3), S2.29, and (S,)."""

    normal: np.ndarray
    step: np.ndarray
    count: np.ndarray
    tag: np.ndarray
    cosine: np.ndarray
    flat: np.ndarray

    @classmethod
    def of(cls, inputs: Arrays, port: str) -> Spans:
        """From the beats of a port, or from the fields of one of type ``span_t``."""
        part = unpack(SPAN, inputs[port]) if port in inputs else structure(inputs, port)
        vectors = (np.stack([part[f"{name}.{axis}"] for axis in "xyz"], -1) for name in ("normal", "increment"))
        return cls(*vectors, *(part[name] for name in ("count", "tag", "cosine", "flat")))

    def beats(self) -> np.ndarray:
        """(S, 8) uint32."""
        return pack_spans(self.normal, self.step, self.count, self.cosine, self.tag, self.flat)

    def words(self) -> list[tuple[int]]:
        """The beats, as a source of a bench sends them."""
        return [(int.from_bytes(beat.astype("<u4").tobytes(), "little"),) for beat in self.beats()]

    def leaves(self, port: str) -> Arrays:
        """The fields of a port of type ``span_t``."""
        return {f"{port}.{name}": values for name, values in unpack(SPAN, self.beats()).items()}


def spans(rng: np.random.Generator, count: ArrayLike) -> Spans:
    """Spans of so many pixels between unit normals, most of them close; one in eight has any 32 bits, one a zero."""
    count = np.asarray(count)
    rows = count.size
    first, other = rng.standard_normal((2, rows, 3))
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    last = first + other.clip(-3, 3) * rng.choice([0.02, 0.2, 1.0], (rows, 1))
    step = (last - first) / np.maximum(count - 1, 1)[:, None]
    near = (np.rint(part * (1 << k.STEP_F)).astype(int) for part in (first, step))
    kind, free = rng.integers(0, 8, (rows, 1)), rng.integers(-(1 << k.STEP_W - 1), 1 << k.STEP_W - 1, (2, rows, 3))
    vectors = (np.select([kind == 0, kind == 1], [part, 0], v) for part, v in zip(free, near, strict=True))
    low, high = signed_range(k.INTENSITY_W)
    cosine = np.where(
        rng.random(rows) < 0.25, rng.choice(corners(low, high), rows), rng.integers(low, high, rows, endpoint=True)
    )
    tag = (rng.integers(1 << k.TAG_W) + np.arange(rows) * (2 * rng.integers(1 << k.TAG_W - 1) + 1)) % (1 << k.TAG_W)
    return Spans(*vectors, count, tag, cosine, rng.integers(0, 2, rows))


def settings(rng: np.random.Generator, code: int) -> dict[str, int]:
    """A draw call: a random material of a model, or of a reserved code, lit from anywhere, in any colours."""
    return dict(_settings(code, int(rng.integers(0, 16))))


@cache  # a fit takes longer than a bench's spans
def _settings(code: int, seed: int) -> dict[str, int]:
    rng = np.random.default_rng([code, seed])
    surface = Material(NAMES.get(code, "blinn"), 2.0 ** rng.uniform(0, 10), rng.uniform(0.05, 0.7))
    colours = {name: int(rng.integers(0, ONE, endpoint=True)) for name in colour_registers(surface)}
    words = material_registers(surface, rng.standard_normal(3)) | {"model": code, "cosine": int(rng.integers(0, 2))}
    return planner_registers(Material(surface.model)) | words | colours


def port(draw: dict[str, int]) -> dict[str, int]:
    """Settings by the fields of ``draw_i``."""
    return {f"draw_i.{name}": value for name, value in registers.draw(draw).items()}


def draw_of(inputs: Arrays) -> dict[str, int]:
    """The other way round."""
    return {f.name: int(np.ravel(inputs[f"draw_i.{f.path}"])[0]) for f in registers.settings()}


def structure(inputs: Arrays, port: str) -> Arrays:
    """The fields of a port, without its name."""
    return {name.removeprefix(f"{port}."): v for name, v in inputs.items() if name.startswith(f"{port}.")}
