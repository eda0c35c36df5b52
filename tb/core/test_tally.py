# SPDX-License-Identifier: Apache-2.0
"""shade_tally: sums over lanes, clock by clock, against counting by hand."""

import random

from polyshade.golden.types import NODE_FLAGS

from tb.bench import Bench, checked
from tb.runner import points, simulate


@points({}, {"LANES": 4})
def test_cocotb(point):
    simulate("shade_tally", point)


@checked()
async def sums(bench: Bench) -> None:
    """Anything may happen in any lane; resets in the middle."""
    dut, lanes = bench.dut, bench.parameter("LANES")
    bits, lights, came = NODE_FLAGS.width, (0, 0), [(0, 0), (0, 0)]
    for _ in range(2000):
        valid, ready, lit = (random.getrandbits(lanes) for _ in range(3))
        told = [random.getrandbits(bits) for _ in range(lanes)]
        in_reset = random.random() < 0.01
        for name, value in {"valid": valid, "ready": ready, "lit": lit}.items():
            getattr(dut, f"{name}_i").value = value
        dut.flags_i.value = sum(word << bits * lane for lane, word in enumerate(told))
        dut.rst_i.value = in_reset
        await bench.tick()
        bench.equal(int(dut.given_o.value), valid & ready, "given_o")
        bench.equal((int(dut.evaluations_o.value), int(dut.flags_o.value)), lights, "evaluations_o, flags_o")
        bench.equal((int(dut.pixels_o.value), int(dut.stalls_o.value)), came[0], "pixels_o, stalls_o")
        came = [came[1], ((valid & ready).bit_count(), (valid & ~ready).bit_count())]
        flags = 0
        for lane, word in enumerate(told):
            flags |= word * (lit >> lane & 1)
        lights = lit.bit_count(), flags
        if in_reset:
            lights, came = (0, 0), [(0, 0), (0, 0)]
