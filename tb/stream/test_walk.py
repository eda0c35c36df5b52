# SPDX-License-Identifier: Apache-2.0
"""shade_walk: items in, so many steps out, a credit each, no bubble."""

import random

import cocotb
import numpy as np

from tb.bench import Bench, Mismatch, Source, checked, no_path
from tb.runner import points, simulate


@points({}, {"COUNT_W": 4, "CREDIT_LOG2": 1})
def test_cocotb(point):
    simulate("shade_walk", point)


class Steps:
    """Reads the steps and gives the credits back, but not in a clock of the probability ``thrift``."""

    def __init__(self, bench: Bench, thrift: float = 0.0):
        self.bench, self.thrift = bench, thrift
        self.capacity = 1 << bench.parameter("CREDIT_LOG2")
        self.spent = 0
        self.steps: list[tuple[int, int]] = []  # first, last
        self.clocks: list[int] = []
        cocotb.start_soon(self._run())

    async def _run(self) -> None:
        dut = self.bench.dut
        while True:
            credit = self.spent > 0 and random.random() >= self.thrift
            dut.credit_i.value = credit
            await self.bench.tick()
            self.spent -= credit
            if int(dut.issue_o.value) and not int(dut.rst_i.value):
                self.steps.append((int(dut.first_o.value), int(dut.last_o.value)))
                self.clocks.append(self.bench.clock)
                self.spent += 1
            if int(dut.rst_i.value):
                self.spent = 0
            if self.spent > self.capacity:
                raise Mismatch(f"a step without a credit (clock {self.bench.clock})")


def setup(bench: Bench, thrift: float = 0.0) -> tuple[Source, Steps]:
    """Something that sends items, and something that reads steps."""
    return Source(bench, "valid_i", "ready_o", ["count_i"]), Steps(bench, thrift)


def items(bench: Bench, rows: int) -> list[tuple[int]]:
    """Counts, most of them small."""
    counts = np.minimum(bench.rng.geometric(0.3, rows), (1 << bench.bits("count_i")) - 1)
    return [(count,) for count in counts.tolist()]


async def compare(bench: Bench, sent: list[tuple[int]], steps: Steps) -> None:
    """Wait for all steps of the items; no more may come."""
    expected = [(int(i == 0), int(i == n - 1)) for (n,) in sent for i in range(n)]
    await bench.until(lambda: len(steps.steps) >= len(expected), 20 * len(expected) + 100, f"{len(expected)} steps")
    await bench.tick(10)
    bench.equal(len(steps.steps), len(expected), "number of steps")
    for index, (actual, wanted) in enumerate(zip(steps.steps, expected, strict=True)):
        bench.equal(actual[0], wanted[0], f"step {index}: first_o")
        bench.equal(actual[1], wanted[1], f"step {index}: last_o")


@checked(gap=[0.0, 0.5], thrift=[0.0, 0.7])
async def walk(bench: Bench, gap: float, thrift: float) -> None:
    """Items of all lengths; credits that come back at once or late."""
    sent = items(bench, 200)
    source, steps = setup(bench, thrift)
    await source.send(sent, gap)
    await compare(bench, sent, steps)


@checked()
async def timing(bench: Bench) -> None:
    """With credits, a step a clock and no bubble between items."""
    if bench.parameter("CREDIT_LOG2") < 2:  # a credit needs two clocks to come back
        bench.checks += 1
        return
    sent = [(1,), (1,), (2,), (1,), (3,), (1,), (2,)]
    source, steps = setup(bench)
    await source.send(sent)
    await compare(bench, sent, steps)
    first = source.clocks[0]
    wanted = list(range(1, 12))
    bench.equal([clock - first for clock in steps.clocks] == wanted, True, f"clocks of the steps are {wanted}")


@checked()
async def credits(bench: Bench) -> None:
    """As many steps as there are credits, and one more for each that comes back."""
    capacity = 1 << bench.parameter("CREDIT_LOG2")
    source, steps = setup(bench, thrift=1.0)
    cocotb.start_soon(source.send([(3,)] * capacity))
    await bench.tick(3 * capacity + 10)
    bench.equal(len(steps.steps), capacity, "steps without a credit back")
    steps.thrift = 0.0
    await bench.tick(2)
    steps.thrift = 1.0
    await bench.tick(10)
    bench.equal(len(steps.steps) - capacity in (1, 2, 3), True, "a step for each credit")
    bench.equal(steps.spent, capacity, "credits out")


@checked()
async def reset(bench: Bench) -> None:
    """Reset in the middle of an item: nothing of it remains, the credits are back."""
    source, steps = setup(bench, thrift=1.0)
    cocotb.start_soon(source.send([(1,), ((1 << bench.bits("count_i")) - 1,)]))
    await bench.tick(8)
    await bench.reset()
    steps.steps.clear()
    await bench.tick(10)
    bench.equal(len(steps.steps), 0, "steps after reset")
    steps.thrift = 0.0
    sent = items(bench, 20)
    await source.send(sent)
    await compare(bench, sent, steps)


@checked()
async def paths(bench: Bench) -> None:
    """No output that a neighbour waits for follows an input within a clock."""
    source, steps = setup(bench, thrift=0.5)
    cocotb.start_soon(no_path(bench, ["count_i", "credit_i"], ["ready_o", "issue_o", "first_o", "last_o"]))
    sent = items(bench, 50)
    await source.send(sent, 0.3)
    await compare(bench, sent, steps)
