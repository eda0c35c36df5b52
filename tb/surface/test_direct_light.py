# SPDX-License-Identifier: Apache-2.0
"""shade_direct_light: to the bit of golden.direct.light, near exact values, on every clock."""

import numpy as np
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden.direct import light

from tb.runner import FULL, SEED
from tb.surface.direct_vectors import ENTRIES, filled, lobe

ROWS = 2_000_000 if FULL else 300_000


def test_light() -> None:
    """Any scalars; those of real normals near the light that is meant."""
    rng = np.random.default_rng([SEED, 9])
    table = lobe(32.0, 1, 100)
    length = rng.uniform(0.51, 1, ROWS)
    cos, ndl = rng.uniform(-1, 1, (2, ROWS))
    cos[::2] = 1 - cos[::2] ** 2 / 64
    real = {"a": ndl * length, "h": cos * length, "p": length**2}
    wide = {"a": k.DIRECT_A_W, "h": k.DIRECT_H_W, "p": k.DIRECT_P_W}
    f = {"a": k.DIRECT_A_F, "h": k.DIRECT_H_F, "p": k.DIRECT_P_F}
    for exact in (False, True):
        scalars = {
            name: np.rint(real[name] * 2.0 ** f[name]).astype(np.int64) if exact
            else rng.integers(0, 1 << w, ROWS) - (0 if name == "p" else 1 << w - 1)
            for name, w in wide.items()
        }  # fmt: skip
        inputs = filled(table, **{f"scalars_i.{name}": value for name, value in scalars.items()})
        run = sim.load("shade_direct_light").run(**inputs, excess_i=table.excess, latency=k.LATENCY_DIRECT_LIGHT)
        names = "pixel_o.diffuse", "pixel_o.specular", "short_o", "long_o"
        wanted = light(*scalars.values(), table)
        for name, value in zip(names, wanted, strict=True):
            assert np.array_equal(run.outputs[name][ENTRIES:], value), name
        if exact:
            assert np.abs(wanted[0] - (ndl * 65536).clip(0, 65535)).max() <= 2.5
            x = 1 - cos + table.excess / 2**24
            assert np.abs(wanted[1] - np.maximum(1 - np.maximum(x, 0), 0) ** 32 * 65536).max() <= 26
