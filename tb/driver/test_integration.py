# SPDX-License-Identifier: Apache-2.0
"""The worked example of docs/integration.md: what it shows is what packers and golden model give."""

from __future__ import annotations

import re

import numpy as np
from polyshade.golden import core
from polyshade.golden.material import Material, planner_registers, registers
from polyshade.golden.normal import pack_spans
from polyshade.golden.registers import pack
from polyshade.sim.sources import ROOT

NORMAL, INCREMENT, COUNT, TAG = [[0, 0, 1 << 29]], [[1 << 22, 0, 0]], [5], [0x0123]
SURFACE = Material("blinn", 64)
LIGHT = (0.0, 0.0, 1.0)


def expected() -> dict[str, str]:
    """The text of every example, by name."""
    (beat,) = pack_spans(NORMAL, INCREMENT, COUNT, 0, TAG)
    values = registers(SURFACE, LIGHT) | planner_registers(SURFACE)

    def pixels(draw: dict[str, int]) -> str:
        told = core.core(NORMAL, INCREMENT, COUNT, draw)
        return " ".join(f"{int(s) << 16 | int(d):08x}" for d, s in told.pixels)

    words = [f"{offset:03x}:{word:08x}" for offset, word in pack(values).items()]
    return {
        "span": " ".join(f"{word:08x}" for word in beat),
        "beat": f"{sum(int(w) << 32 * i for i, w in enumerate(np.asarray(beat))):064x}",
        "lambert": pixels({}),
        "blinn": pixels(values),
        "words": "\n".join(" ".join(words[i : i + 5]) for i in range(0, len(words), 5)),
    }


def test_examples() -> None:
    text = (ROOT / "docs" / "integration.md").read_text()
    shown = dict(re.findall(r"<!-- example: (\w+) -->\n```\n(.*?)\n?```", text, re.DOTALL))
    assert shown == expected()
