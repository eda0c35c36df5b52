# SPDX-License-Identifier: Apache-2.0
"""shade_fifo: words come out in the order in which they went in, none lost, doubled or altered."""

import random

import cocotb

from tb.bench import PRESSURE, Bench, Sink, checked, no_path, scramble
from tb.runner import points, simulate


@points({}, {"LOG2": 1, "WIDTH": 8}, {"BLOCK": 1}, {"LOG2": 1, "BLOCK": 1})
def test_cocotb(point):
    simulate("shade_fifo", point)


class Writer:
    """Writes as long as it has a credit for every word, as the pipeline in front of the FIFO does."""

    def __init__(self, bench: Bench):
        self.bench, self.dut = bench, bench.dut
        self.credits = self.capacity = 1 << bench.parameter("LOG2")
        self.clocks: list[int] = []
        cocotb.start_soon(self._run())

    async def _run(self) -> None:
        """Collect the credits and check that each comes one clock after its word was taken, and no other."""
        taken = False
        while True:
            await self.bench.tick()
            self.bench.equal(int(self.dut.taken_o.value), taken, "taken_o")
            self.credits += taken
            in_reset = int(self.dut.rst_i.value)
            taken = int(self.dut.valid_o.value) and int(self.dut.ready_i.value) and not in_reset
            if in_reset:
                self.credits = self.capacity

    async def write(self, words: list[int], gap: float = 0.0) -> None:
        """Write words, with that probability of a clock without one."""
        for word in words:
            while not self.credits or random.random() < gap:
                await self.bench.tick()
            self.credits -= 1
            self.dut.valid_i.value = 1
            self.dut.data_i.value = word
            await self.bench.tick()
            self.clocks.append(self.bench.clock)
            self.dut.valid_i.value = 0
            scramble(self.dut.data_i)


def setup(bench: Bench, stall: float) -> tuple[Writer, Sink]:
    """A writer and a reader."""
    return Writer(bench), Sink(bench, "valid_o", "ready_i", ["data_o"], stall)


def some_words(bench: Bench, count: int) -> list[int]:
    """Random words."""
    return bench.rng.integers(0, 1 << bench.bits("data_i"), count).tolist()


async def read_back(bench: Bench, sink: Sink, words: list[int]) -> None:
    """Wait for the words and compare them; nothing may follow."""
    await bench.until(lambda: len(sink.words) >= len(words), 20 * len(words) + 100, f"{len(words)} words")
    await bench.tick(20)
    bench.equal(len(sink.words), len(words), "number of words")
    for index, (word, (read,)) in enumerate(zip(words, sink.words, strict=True)):
        bench.equal(read, word, f"word {index}", bench.bits("data_o"))


@checked(**PRESSURE)
async def traffic(bench: Bench, gap: float, stall: float) -> None:
    """Source and sink with gaps and without."""
    writer, sink = setup(bench, stall)
    words = some_words(bench, 1000)
    await writer.write(words, gap)
    await read_back(bench, sink, words)


@checked()
async def full(bench: Bench) -> None:
    """It holds 2^LOG2 words while nothing is taken, then gives one a clock, from every position of its pointers."""
    writer, sink = setup(bench, 1.0)
    words: list[int] = []
    for _ in range(2 * writer.capacity + 1):
        sink.stall = 1.0
        more = some_words(bench, writer.capacity)
        words += more
        await writer.write(more)
        await bench.tick(5)
        bench.equal(len(sink.words), len(words) - len(more), "words taken while stalled")
        sink.stall = 0.0
        await bench.until(lambda: len(sink.words) == len(words), writer.capacity + 2, "all words")  # noqa: B023
        bench.equal(sink.clocks[-1] - sink.clocks[-len(more)], len(more) - 1, "clocks from the first word to the last")
        words += (one := some_words(bench, 1))
        await writer.write(one)
        await bench.tick(8)
    await read_back(bench, sink, words)


@checked()
async def reset(bench: Bench) -> None:
    """A reset empties it, whatever it holds."""
    writer, sink = setup(bench, 1.0)
    for held in range(writer.capacity + 1):
        await writer.write(some_words(bench, held))
        await bench.reset(clocks=1)
        for _ in range(4):
            await bench.tick()
            bench.equal(int(bench.dut.valid_o.value), 0, f"valid_o after a reset with {held} words")
    sink.stall = 0.0
    words = some_words(bench, 100)
    await writer.write(words)
    await read_back(bench, sink, words)


@checked()
async def reset_while_taking(bench: Bench) -> None:
    """A reset of one clock while words are written and taken: none comes behind it, nor the credit of the last one."""
    writer, sink = setup(bench, 0.0)
    for clocks in range(1, 12):
        writing = cocotb.start_soon(writer.write(some_words(bench, 30)))
        await bench.tick(clocks)
        writing.cancel()
        bench.dut.valid_i.value = 0
        await bench.reset(clocks=1)
        await bench.tick(4)  # the writer looks at taken_o
        sink.forget()
    words = some_words(bench, 100)
    await writer.write(words)
    await read_back(bench, sink, words)


@checked()
async def registered(bench: Bench) -> None:
    """No input reaches an output in the same clock."""
    cocotb.start_soon(no_path(bench, ["valid_i", "data_i", "ready_i"], ["valid_o", "data_o", "taken_o"]))
    writer, sink = setup(bench, 0.5)
    words = some_words(bench, 200)
    await writer.write(words, 0.5)
    await read_back(bench, sink, words)
