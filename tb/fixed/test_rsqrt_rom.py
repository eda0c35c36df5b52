"""shade_rsqrt_rom: every row of golden.fixed.rsqrt_rom, with the half ulp that rounds the result."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.fixed import rsqrt_rom

from tb.bench import Bench, checked
from tb.runner import simulate


def test_cocotb():
    simulate("shade_rsqrt_rom", {})


@checked()
async def rows(bench: Bench) -> None:
    """All of them."""
    i = np.arange(1 << k.RSQRT_INDEX_W)
    await bench.pipeline({"i_i": i}, {"row_o": rsqrt_rom(i)}, 1)
