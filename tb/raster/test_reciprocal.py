# SPDX-License-Identifier: Apache-2.0
"""shade_reciprocal: exponent and mantissa, to the bit and in time; the error that is stated, of every mantissa."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.raster import reciprocal

from tb.bench import Bench, checked
from tb.runner import points, simulate

BITS = k.AREA_W


@points({})
def test_cocotb(point):
    simulate("shade_reciprocal", point)


def test_error_of_every_mantissa() -> None:
    """r a 2^-e against 1, of every m, with all bits behind it 0 or 1: the ends of each interval."""
    top = k.RECIPROCAL_M_W - 1
    m = np.arange(1 << top, 1 << k.RECIPROCAL_M_W, dtype=np.int64)
    for a in (m << BITS - 1 - top, (m + 1 << BITS - 1 - top) - 1, m >> 9 << 3):
        r, e = reciprocal(a)
        error = r.astype(np.longdouble) * a / np.exp2(e.astype(np.longdouble) + k.RECIPROCAL_F) - 1
        assert error.min() >= -(2.0**-17) - 1e-15
        assert error.max() <= 2.0**-17 + 2.0**-19


@checked()
async def values(bench: Bench) -> None:
    """Numbers of every length, back to back and with pauses: e after 4 clocks, r after 14, which hold."""
    lengths = bench.rng.integers(0, BITS, 1200)
    numbers = [int(bench.rng.integers(1 << n, 2 << n)) for n in lengths] + [1, (1 << BITS) - 1, 1 << BITS - 1]
    for a in numbers:
        r, e = (int(v) for v in reciprocal(a))
        bench.dut.start_i.value, bench.dut.a_i.value = 1, a
        await bench.tick()
        bench.dut.start_i.value, bench.dut.a_i.value = 0, int(bench.rng.integers(0, 1 << BITS))
        await bench.tick(k.LATENCY_EXPONENT)
        bench.equal(int(bench.dut.e_o.value), e, f"e of {a}")
        await bench.tick(k.LATENCY_RECIPROCAL - k.LATENCY_EXPONENT)
        bench.equal(int(bench.dut.r_o.value), r, f"r of {a}")
        await bench.tick(int(bench.rng.choice([0, 1, 2, 40], p=[0.5, 0.3, 0.19, 0.01])))
        bench.equal((int(bench.dut.e_o.value), int(bench.dut.r_o.value)) == (e, r), True, "e and r hold")
