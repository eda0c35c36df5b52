# SPDX-License-Identifier: Apache-2.0
"""shade_tally: sums over lanes, clock by clock, against counting by hand."""

import random

from polyshade.golden.types import COUNTS, ERRORS, NODE_FLAGS, STATUS, TOLD

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
        given, held, lit = (random.getrandbits(lanes) for _ in range(3))
        told = [random.getrandbits(bits) for _ in range(lanes)]
        packet = random.getrandbits(TOLD.width)
        in_reset = random.random() < 0.01
        for name, value in {"given": given, "held": held, "lit": lit}.items():
            getattr(dut, f"{name}_i").value = value
        dut.flags_i.value = sum(word << bits * lane for lane, word in enumerate(told))
        dut.told_i.value = packet
        dut.rst_i.value = in_reset
        await bench.tick()
        counts, events, door = (
            {leaf.name: int(port.value) >> leaf.lsb & (1 << leaf.width) - 1 for leaf in struct.leaves()}
            for struct, port in ((COUNTS, dut.counts_o), (STATUS, dut.events_o), (TOLD, dut.told_i))
        )
        nodes = int(dut.events_o.value) >> ERRORS.width
        bench.equal((counts["evaluations"], nodes), lights, "evaluations, events of points")
        bench.equal((counts["pixels"], counts["stalls"]), came[0], "pixels, stalls")
        bench.equal((counts["spans"], counts["errors"]), (door["good"], door["bad"]), "spans, errors")
        bench.equal(all(events[leaf] == door[leaf] for leaf in door if "." in leaf), True, "events of packets")
        came = [came[1], (given.bit_count(), held.bit_count())]
        flags = 0
        for lane, word in enumerate(told):
            flags |= word * (lit >> lane & 1)
        lights = lit.bit_count(), flags
        if in_reset:
            lights, came = (0, 0), [(0, 0), (0, 0)]
