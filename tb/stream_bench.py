# SPDX-License-Identifier: Apache-2.0
"""The one bench of all modules that take items and give words: their streams of ``sim/units`` through cocotb.

Words, their order and their clocks, with pauses on both sides; a taker that stands still; resets of one clock; no path
from an input to an output. ``POINT`` says which stream.
"""

import os
import random
import re
from collections import deque

import cocotb
import numpy as np
from cocotb.handle import ValueObjectBase
from polyshade.sim.model import interface
from polyshade.sim.units.case import Arrays
from polyshade.sim.units.stream import streams

from tb.bench import PRESSURE, Bench, Column, Sink, Source, Watch, checked, no_path, phases, scramble

FOLD = int(next(iter(re.findall(r"FOLD=(\d)", os.environ["POINT"])), 1))
STREAM = next((stream for stream in streams() if str(stream) == os.environ["POINT"]), None)
USUAL = STREAM and (STREAM.usual or STREAM.kinds[:1])


def ports(values: Arrays) -> list[str]:
    """The ports of outputs or inputs, without the settings."""
    return list(dict.fromkeys(port for name in values if (port := name.partition(".")[0]) != "draw_i"))


class Run:
    """A stream with something that sends items and something that takes words."""

    def __init__(self, bench: Bench, stall: float = 0.0):
        self.bench, face = bench, interface(list(bench.ports.values()))
        inputs = STREAM.items(bench.rng, np.array([1]), STREAM.kinds[0])
        given = STREAM.golden(inputs)
        self.names = [name for name in ports(inputs) if name != STREAM.apart[0]]
        self.source = Source(bench, face.into.valid, face.into.ready, self.names)
        self.waiting: deque[int] = deque()
        if STREAM.apart[0]:
            cocotb.start_soon(self._offer(*(getattr(bench.dut, name) for name in STREAM.apart)))
        credit = {"credit": "credit_i", "credits": STREAM.credits, "pays": self._pays} if STREAM.credits else {}
        self.beside = Watch(bench, STREAM.beside, ports(given.beside), **credit) if STREAM.beside else None
        valid, payload = STREAM.valid or face.out.valid, ports(given.words)
        if face.out.ready:
            self.sink = Sink(bench, valid, face.out.ready, payload, stall)
        else:
            self.sink = Watch(bench, valid, payload, **({} if self.beside else credit))
        self.payer = self.beside if self.beside and credit else self.sink  # by whom credits are given back
        self.payer.stall = stall
        if hasattr(bench.dut, "phase_i"):
            cocotb.start_soon(phases(bench))

    async def _offer(self, port: ValueObjectBase, taken: ValueObjectBase) -> None:
        while True:
            if self.waiting:
                port.value = self.waiting[0]
            else:
                scramble(port)
            await self.bench.tick()
            if int(self.bench.dut.rst_i.value):
                self.waiting.clear()
            elif int(taken.value):
                self.waiting.popleft()

    def _pays(self, word: tuple[int, ...]) -> bool:
        if not STREAM.record:
            return True
        port = STREAM.record.partition(".")[0]
        (leaf,) = (field for field in self.bench.ports[port].fields if field.name == STREAM.record)
        return bool(word[0] >> leaf.lsb & 1)

    def begin(self, count: np.ndarray, kind: object) -> list[tuple[int, ...]]:
        """Items of so many words, and what is to come of them; the settings are driven."""
        self.source.clocks.clear()
        for sink in (self.sink, self.beside):
            if sink:
                sink.forget()
        self.inputs = STREAM.items(self.bench.rng, np.asarray(count), kind)
        self.given = STREAM.golden(self.inputs)
        if draw := {name: np.ravel(v)[:1] for name, v in self.inputs.items() if name.startswith("draw_i.")}:
            (column,) = self.bench.columns(draw)
            column.port.value = column.rows[0]
        moving = {name: v for name, v in self.inputs.items() if not name.startswith("draw_i.")}
        rows = {  # bits without a meaning are random
            c.port._name: [bits | random.getrandbits(len(c.port)) & ~c.mask for bits in c.rows]
            for c in self.bench.columns(moving)
        }  # fmt: skip
        self.waiting = deque(rows.get(STREAM.apart[0], ()))
        return list(zip(*(rows[name] for name in self.names), strict=True))

    async def compare(self) -> None:
        """Wait for all words and compare them; no more may come."""
        bench, total = self.bench, len(self.given.owner)
        patience = 20 * FOLD * total + 2000
        await bench.until(lambda: len(self.sink.words) >= total, patience, f"{total} words")
        await bench.tick(60 + 30 * bool(STREAM.beside))
        self._compare(self.sink, self.given.words)
        if self.beside:
            self._compare(self.beside, self.given.beside)

    def _compare(self, sink: Sink | Watch, words: Arrays) -> None:
        columns = self.bench.columns(words)
        self.bench.equal(len(sink.words), len(columns[0].rows), "number of words")
        for place, column in enumerate(columns):
            for index, word in enumerate(sink.words):
                if word[place] & column.mask != column.rows[index]:
                    self._tell(index, column, word[place])
        self.bench.checks += len(sink.words) * len(columns)

    def _tell(self, index: int, column: Column, actual: int) -> None:
        item = int(self.given.owner[min(index, len(self.given.owner) - 1)])
        values = ", ".join(f"{name} {v[item]}" for name, v in self.inputs.items() if np.ndim(v) and len(v) > item)
        what = f"word {index} (of item {item}: {values}): {column.port._name}"
        self.bench.equal(actual & column.mask, column.rows[index], what, len(column.port))

    def compare_clocks(self) -> None:
        """Every word has its clock, where nobody paused."""
        for index, wanted in enumerate(STREAM.clock(self.inputs, self.given).tolist()):
            clocks = self.sink.clocks[index] - self.source.clocks[self.given.owner[index]]
            late = clocks - wanted
            self.bench.equal(
                0 <= late <= STREAM.slack, True, f"clocks from its item to word {index}, {clocks}, are {wanted}"
            )

    def compare_total(self) -> None:
        """Words follow each other without a bubble."""
        took = self.sink.clocks[-1] - self.sink.clocks[0] + 1
        self.bench.equal(took, STREAM.clocks(self.inputs, self.given), "clocks of all words")


def mixture(bench: Bench, rows: int) -> np.ndarray:
    """Lengths of items, none of them long."""
    return np.minimum(STREAM.mixture(bench.rng, rows), 40)


@checked(**PRESSURE)
async def traffic(bench: Bench, gap: float, stall: float) -> None:
    """Items of all kinds, with pauses or without; settings change when nothing is inside."""
    run = Run(bench, stall)
    for kind in STREAM.kinds:
        await run.source.send(run.begin(mixture(bench, max(15, 150 // len(STREAM.kinds))), kind), gap)
        await run.compare()
        if STREAM.steady and not stall:
            run.compare_clocks()


@checked()
async def alone(bench: Bench) -> None:
    """The clocks of an item that finds nothing in front of it."""
    run = Run(bench)
    for kind in STREAM.alone or USUAL:
        for count in STREAM.lengths:
            await run.source.send(run.begin([count], kind))
            await run.compare()
            if STREAM.steady or STREAM.credits:
                run.compare_clocks()
            else:
                wanted = STREAM.clock(run.inputs, run.given)[0]
                clocks = run.sink.clocks[0] - run.source.clocks[0]
                told = f"clocks from an item to its first word, {clocks}, are {wanted}"
                bench.equal(0 <= clocks - wanted <= STREAM.slack, True, told)


@checked()
async def throughput(bench: Bench) -> None:
    """Items of any length follow each other without a bubble."""
    run = Run(bench)
    for kind in USUAL:
        for count in STREAM.lengths if STREAM.brisk else ():
            await run.source.send(run.begin([count] * max(120 // count, 8), kind))
            await run.compare()
            run.compare_total()
    bench.checks += not STREAM.brisk


@checked(stall=[0.0, 0.1])
async def longest(bench: Bench, stall: float) -> None:
    """The longest item between short ones; nothing is lost while the taker pauses."""
    run, most = Run(bench, stall), STREAM.longest
    for kind in USUAL[: 1 if stall else None] if most else ():
        await run.source.send(run.begin([2, most, *([most - 1, most // 2 + 2] if most < 100 else []), 3], kind))
        await run.compare()
        if not stall and STREAM.brisk:
            run.compare_total()
    bench.checks += not most


@checked()
async def blocked(bench: Bench) -> None:
    """A taker that stands still: every place fills, nothing more is taken; all of it comes later, nothing is lost."""
    run = Run(bench)
    for kind in (*USUAL, *USUAL[:1]) if STREAM.held or STREAM.credits else ():
        run.payer.stall = 1.0
        count = max(9, 4 * FOLD)  # light can keep up
        sending = cocotb.start_soon(run.source.send(run.begin([min(count, STREAM.longest or 1)] * 220, kind)))
        await bench.tick(1200 * FOLD)
        if STREAM.credits:
            bench.equal(run.payer.spent, STREAM.credits, "credits that were spent while none came back")
        else:
            bench.equal(len(run.source.clocks), STREAM.held(kind, count), "items taken while the taker stands still")
        spent, known = len(run.sink.words), len(run.payer.given) if STREAM.credits else 0
        run.payer.stall = 0.0
        await sending
        await run.compare()
        if STREAM.wakes:
            first = run.sink.clocks[spent] - run.payer.given[known]
            bench.equal(first, STREAM.wakes, "clocks from a credit to its word")
        elif STREAM.held:
            run.compare_total()
    bench.checks += 1


@checked(stall=[0.0, 0.5, 1.0])
async def reset(bench: Bench, stall: float) -> None:
    """A reset of one clock at any time: nothing of what was inside comes, the next items are whole."""
    run, reach = Run(bench), STREAM.longest > 100
    for trial in range(12):
        kind = USUAL[trial % len(USUAL)]
        run.payer.stall = stall
        sending = cocotb.start_soon(run.source.send(run.begin(mixture(bench, 100), kind), 0.2))
        await bench.tick(random.randrange(2, 300 if reach and trial % 3 == 0 else 60))
        sending.cancel()
        run.source.withdraw()
        await bench.reset(clocks=1)
        await bench.tick()
        run.payer.stall = 0.0
        if trial % 3 == 0:
            run.begin([1], kind)
            await bench.tick(200)
            late = len(run.sink.words) + len(run.beside.words if run.beside else ())
            bench.equal(late, 0, "words behind a reset")
        items = run.begin(mixture(bench, 8), kind)
        await run.source.send(items)
        await run.compare()
        if STREAM.steady:
            run.compare_clocks()


@checked()
async def registered(bench: Bench) -> None:
    """No input reaches an output within a clock."""
    run = Run(bench, 0.4)
    still = {"clk_i", "rst_i", "draw_i", *STREAM.through}
    inputs, outputs = (
        [port.name for port in bench.ports.values() if port.direction == way and port.name not in still]
        for way in ("input", "output")
    )
    if STREAM.valid:  # load_o, which follows valid_i
        outputs.remove("load_o")
    items = run.begin(mixture(bench, 40), USUAL[0])
    cocotb.start_soon(no_path(bench, inputs, outputs))
    await run.source.send(items, 0.3)
    await run.compare()
