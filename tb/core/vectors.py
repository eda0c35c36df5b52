# SPDX-License-Identifier: Apache-2.0
"""What several benches of rtl/core share."""

import numpy as np
from polyshade.golden import types
from polyshade.golden.registers import draw as named

from tb.bench import Bench


def set_draw(bench: Bench, draw: dict[str, int]) -> None:
    """Drive ``draw_i``."""
    bench.dut.draw_i.value = types.whole(types.DRAW, named(draw))[0]


def number(words: np.ndarray) -> int:
    """Words of 32 bits, least significant first, as one number."""
    return int.from_bytes(words.astype("<u4").tobytes(), "little")
