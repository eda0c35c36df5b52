# SPDX-License-Identifier: Apache-2.0
"""The lobe out of the RTL, over every 17-bit cosine."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import material
from polyshade.sim.units.light import lobe_latency

COSINES = np.arange((1 << k.INTENSITY_F) + 1)
C = COSINES / (1 << k.INTENSITY_F)
VERSINES = (COSINES[-1] - COSINES) << k.VERSINE_F - k.INTENSITY_F


def rtl_lobe(
    model: str, shininess: float = 1, roughness: float = 0.3, form: str = "refined", stages: int = material.STAGES
) -> NDArray[np.float64]:
    """``shade_lobe``, so many squarings built, as a model's highlight, relative to its peak, at every cosine ``C``."""
    words = material.lobe_registers(*material.fit(model, shininess, roughness, form, stages))
    return sim.load("shade_lobe", POWER=stages).run(
        x_i=VERSINES, lobe_i=words, latency=lobe_latency(stages, 1)
    ).lobe_o / (1 << k.INTENSITY_F)
