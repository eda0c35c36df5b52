"""shade_rsqrt_rom: every row of golden.fixed.rsqrt_table, with the half ulp that rounds the result."""

import numpy as np

from golden import contract as k
from golden.fixed import rsqrt_table
from tb.bench import Bench, checked
from tb.runner import simulate


def test_cocotb():
    simulate("shade_rsqrt_rom", {})


@checked()
async def rows(bench: Bench) -> None:
    """All of them."""
    c0, c1, c2 = rsqrt_table().T
    half = np.where(c0 > 0, 1 << k.RSQRT_C0_F - k.RSQRT_F - 1, 0)
    c1 = c1 & (1 << k.RSQRT_C1_F) - 1
    row = ((c0 + half) << k.RSQRT_C1_F | c1) << k.RSQRT_C2_W | c2
    await bench.pipeline({"i_i": np.arange(len(row))}, {"row_o": row}, 1)
