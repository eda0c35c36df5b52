# SPDX-License-Identifier: Apache-2.0
"""shade_counters: sums and bits that stay, clock by clock, against counting by hand."""

import random

from polyshade.golden import registers
from polyshade.golden.types import COUNTS, STATUS

from tb.bench import Bench, checked
from tb.runner import points, simulate

OWN = ("ID", "VERSION", "STATUS", "PIXELS", "SPANS", "CLOCKS", "STALLS", "EVALUATIONS", "ERRORS")


@points({})
def test_cocotb(point):
    simulate("shade_counters", point, public=("*_q",))


@checked(wrap=[0, 1])
async def words(bench: Bench, wrap: int) -> None:
    """Anything happens and any register is asked for, over the end of 32 bits; clears and resets in the middle."""
    dut, every = bench.dut, list(registers.every())
    leaves = {leaf.name: leaf for leaf in COUNTS.leaves()}
    places = dict(zip((leaf.name for leaf in STATUS.leaves()), (*range(8, 13), *range(16, 20), 24, 25), strict=True))
    fixed = {register.name: register.reset for register in every if register.name in ("ID", "VERSION")}
    held, status, wanted = dict.fromkeys((*leaves, "clocks"), 0), 0, None
    for clock in range(3000):
        if wrap and clock % 100 == 50:
            for key in held:
                held[key] = (1 << 32) - random.randrange(1, 60)
                getattr(dut, f"{key}_q").value = held[key]
        chosen = random.choice([*every, None])
        counts, events = random.getrandbits(COUNTS.width), random.getrandbits(STATUS.width) & random.getrandbits(11)
        clear, busy, reset = (random.random() < share for share in (0.03, 0.5, 0.01))
        at = len(every) - 1 - every.index(chosen) if chosen else None  # the first register is the highest bit
        dut.select_i.value = 1 << at if chosen else 0
        dut.counts_i.value, dut.events_i.value = counts, events
        dut.clear_i.value, dut.busy_i.value, dut.rst_i.value = clear, busy, reset
        await bench.tick()
        if wanted is not None:
            bench.equal(int(dut.word_o.value), wanted, "word")
        name = chosen.name if chosen else ""
        bench.equal(int(dut.own_o.value), name in OWN, "own")
        bits = busy | sum((status >> i & 1) << place for i, place in enumerate(places.values()))
        known = fixed | {"STATUS": bits} | {key.upper(): value for key, value in held.items()}
        wanted = known.get(name, 0)
        rise = {key: counts >> leaf.lsb & (1 << leaf.width) - 1 for key, leaf in leaves.items()} | {"clocks": busy}
        held = {key: 0 if reset else (0 if clear else value) + rise[key] & (1 << 32) - 1 for key, value in held.items()}
        status = 0 if reset else (0 if clear else status) | events
