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
    outputs = {"c0_o": c0 + half, "c1_o": c1, "c2_o": c2}
    await bench.pipeline({"i_i": np.arange(len(c0))}, outputs, 0)
