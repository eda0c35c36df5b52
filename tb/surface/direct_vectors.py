# SPDX-License-Identifier: Apache-2.0
"""Lobes, lights, triangles and packets for the direct form."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.direct import Lobe
from polyshade.golden.types import RUN, TRIANGLE, pack

ONE = 1 << k.INTENSITY_F


def lobe(n: float = 32.0, shift: int = 1, excess: int = 0) -> Lobe:
    """cos^n as a table."""
    x = np.arange(1025) / 1024 * 2.0**-shift
    exact = np.maximum(1 - x, 0) ** n
    value = np.rint(exact[:-1] * ONE).astype(np.int64)
    slope = np.rint(exact[1:] * (1 << k.CHORD_SLOPE_F)).astype(np.int64) - (value << k.CHORD_SLOPE_F - k.INTENSITY_F)
    return Lobe(value, slope.clip(-(1 << k.CHORD_SLOPE_W - 1), (1 << k.CHORD_SLOPE_W - 1) - 1), shift, excess)


def direction(rng: np.random.Generator) -> np.ndarray:
    """A unit vector S1.16."""
    v = rng.standard_normal(3)
    return np.rint(v / np.linalg.norm(v) * ONE).astype(np.int64)


def packets(rng: np.random.Generator, triangles: int, faults: float = 0.0) -> dict[str, np.ndarray]:
    """Triangles of all sizes with runs in every direction; some packets cut short, some runs empty, long, not below."""
    data, last = [], []
    for _ in range(triangles):
        lines, columns = rng.integers(1, 9, 2)
        normal = np.clip(direction(rng) * rng.choice([1.0, 0.9, 0.4]), -ONE, ONE).astype(np.int64)
        grows = [rng.integers(-(1 << 17), 1 << 17, 3) for _ in "cl"]
        values = {f"normal.{axis}": normal[i] for i, axis in enumerate("xyz")}
        for name, grow in zip(("dcolumn", "dline"), grows, strict=True):
            values |= {f"{name}.mantissa.{axis}": grow[i] for i, axis in enumerate("xyz")}
            values[f"{name}.exp"] = rng.integers(0, 16)
        head = pack(TRIANGLE, values | {
            "columns": columns, "lines": lines, "left": 0, "flat": 0, "tag": rng.integers(0, 1 << 16)
        })  # fmt: skip
        count = rng.geometric(0.2, lines)
        line = np.cumsum(rng.integers(1, 3, lines)) + rng.integers(0, 4000)
        column = (rng.integers(0, 4000) + rng.integers(-9, 9, lines)).clip(0, 4095)
        wrong = rng.random(lines) < faults
        count = np.where(wrong & (rng.random(lines) < 0.5), rng.choice([0, k.PIXELS_MAX + 1], lines), count)
        line = np.where(wrong & (rng.random(lines) < 0.5), np.maximum(line - rng.integers(0, 5, lines), 0), line)
        runs = pack(RUN, {"column": column, "line": line, "count": count})
        beats = np.r_[head.view(np.uint64), runs.view(np.uint64)[:, 0]]
        if rng.random() < faults / 2:
            beats = beats[: rng.integers(1, k.TRIANGLE_BEATS + 1)]
        data.append(beats)
        last.append(np.arange(len(beats)) == len(beats) - 1)
    return {"s_axis_surface_tdata": np.concatenate(data), "s_axis_surface_tlast": np.concatenate(last).astype(np.int64)}


def vector(name: str, v: np.ndarray) -> dict[str, int]:
    """A vector as the leaves of a port."""
    return {f"{name}.{axis}": int(part) for axis, part in zip("xyz", v, strict=True)}


ENTRIES = 1 << k.CHORD_INDEX_W


def filled(table: Lobe, **inputs: np.ndarray) -> dict[str, np.ndarray]:
    """Inputs behind those that fill the table."""
    rows = len(next(iter(inputs.values())))
    zeros = np.zeros(rows, np.int64)
    return {name: np.r_[np.zeros(ENTRIES, np.int64), value] for name, value in inputs.items()} | {
        "write_i": np.r_[np.ones(ENTRIES, np.int64), zeros], "address_i": np.r_[np.arange(ENTRIES), zeros],
        "chord_i.value": np.r_[table.value, zeros], "chord_i.slope": np.r_[table.slope, zeros], "shift_i": table.shift,
    }  # fmt: skip
