"""Inputs that several benches of rtl/light share, by port."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import material
from polyshade.golden.fixed import ONE

from tb.bench import Bench
from tb.normal.vectors import pairs

CODES = range(1 << k.MODEL_W)  # reserved ones too
NAMES = {code: name for name, code in material.MODELS.items()}


def setting(bench: Bench, **values: int) -> None:
    """Drive ports, by name without _i, that stay as they are while a pipeline works."""
    for name, value in values.items():
        if hasattr(bench.dut, f"{name}_i"):
            port = getattr(bench.dut, f"{name}_i")
            port.value = value & (1 << len(port)) - 1


def registers(bench: Bench, code: int, light=None) -> dict[str, int]:
    """Register values of a random material of a model, or of a reserved code."""
    shininess, roughness = 2.0 ** bench.rng.uniform(0, 10), bench.rng.uniform(0.05, 0.7)
    words = material.registers(material.Material(NAMES.get(code, "blinn"), shininess, roughness), light)
    return words | {"model": code, "cosine": int(bench.rng.integers(0, 2))}


def nodes(bench: Bench, rows: int) -> np.ndarray:
    """Normals, lights, viewers (3, 3, rows): equal, opposite, close and any vectors; a third of V is -L."""
    n, l = np.reshape(list(pairs(bench, rows).values()), (2, 3, rows))  # noqa: E741
    viewers = [-l, l, np.reshape(list(pairs(bench, rows).values()), (2, 3, rows))[0]]
    v = np.choose(np.arange(rows) % 3, viewers)
    return np.stack([n, l, v.clip(*_limits())])


def components(**vectors: np.ndarray) -> dict[str, np.ndarray]:
    """Vectors (3, rows) as ports: n=... gives nx_i, ny_i, nz_i."""
    return {f"{name}{c}_i": part for name, vector in vectors.items() for c, part in zip("xyz", vector, strict=True)}


def pack(vector: np.ndarray) -> np.ndarray:
    """A vector as one word: x, y, z at bit 0, 18, 36."""
    return sum((part & (1 << k.INTENSITY_W) - 1) << k.INTENSITY_W * i for i, part in enumerate(vector))


def unit_numbers(bench: Bench, rows: int) -> np.ndarray:
    """U1.16 in [0, 1]: 0 and 1, small ones of every size, any."""
    value = bench.rng.integers(0, ONE, rows, endpoint=True)
    kind = bench.rng.integers(0, 8, rows)
    return np.select([kind == 0, kind == 1, kind < 5], [0, ONE, value >> bench.rng.integers(0, 17, rows)], value)


def _limits() -> tuple[int, int]:
    return -(1 << k.INTENSITY_W - 1), (1 << k.INTENSITY_W - 1) - 1
