# SPDX-License-Identifier: Apache-2.0
"""What the cocotb benches share: clock, reset, scoreboard; pipelines of fixed latency; streams with gaps and stalls.

Time is counted in clocks; a clock ends with a rising edge. What a bench reads after ``await bench.tick()`` are the
values at the end of the clock that is over; what it writes then holds through the next one. So an input written for
clock n shows at an output of latency L when clock n + L is over.
"""

import functools
import os
import random
import re
import resource
from collections import deque
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import cocotb
import numpy as np
from cocotb.clock import Clock
from cocotb.handle import HierarchyObject, ValueObjectBase
from cocotb.simtime import get_sim_time
from cocotb.triggers import FallingEdge, RisingEdge, Timer
from numpy.typing import ArrayLike
from polyshade.sim.verilate import known_ports

PERIOD = 10  # of the clock, in ns
PATIENCE = 200_000  # clocks after which a test is over

MUTANT = int(os.environ.get("MUTANT", "0"))  # the fault that a netlist with faults has, see scripts/flow/mutants.py
if MUTANT:  # it may make the bench wait for ever
    resource.setrlimit(resource.RLIMIT_CPU, (60, 60))

TRAFFIC = {"gap": [0.0, 0.5], "reset": [0.0, 0.02]}
"""What a pipeline must stand: rows on every clock or with gaps, resets in the middle."""
PRESSURE = {"gap": [0.0, 0.5], "stall": [0.0, 0.5]}
"""What a stream must stand: a source that pauses or not, a sink that does or not."""


class Mismatch(AssertionError):
    """The module does something else than expected."""


def checked(**options: Sequence) -> Callable:
    """A cocotb test for every combination of the options; it fails if it compared nothing.

    The coroutine gets a :class:`Bench` after reset instead of the bare module:

    >>> @checked(gap=[0.0, 0.5])
    ... async def stream(bench, gap): ...
    """

    def decorate(coroutine: Callable) -> object:
        @functools.wraps(coroutine)
        async def test(dut: HierarchyObject, **chosen: object) -> None:
            bench = Bench(dut)
            await bench.start()
            try:
                await coroutine(bench, **chosen)
            except BaseException:  # a time limit is a cancellation
                if MUTANT:  # one failure is enough
                    os._exit(1)
                raise
            if not bench.checks:
                raise Mismatch("nothing was checked")

        return cocotb.test(timeout_time=PATIENCE * PERIOD, timeout_unit="ns")(cocotb.parametrize(**options)(test))

    return decorate


@dataclass(eq=False)
class Column:
    """Bits of a port, row by row; ``mask``: those that have a meaning."""

    port: ValueObjectBase
    rows: list[int]
    mask: int


class Bench:
    """A module under test. ``rng`` is NumPy's generator, seeded for this test, as ``random`` is by cocotb."""

    def __init__(self, dut: HierarchyObject):
        self.dut = dut
        self.rng = np.random.default_rng(cocotb.RANDOM_SEED)
        self.checks = 0
        self.ports = {port.name: port for port in known_ports(Path(os.environ["MODEL"]))}

    @property
    def clock(self) -> int:
        """Number of the clock that is over."""
        return int(get_sim_time("ns")) // PERIOD

    def parameter(self, name: str) -> int:
        """A parameter of the module."""
        return int(getattr(self.dut, name).value)

    def bits(self, name: str) -> int:
        """Width of a port."""
        return len(getattr(self.dut, name))

    def signed(self, bits: int, rows: int) -> np.ndarray:
        """Signed numbers (rows,): one in four is extreme, 0, or next to one of these; the others are random."""
        low, high = -(1 << bits - 1), (1 << bits - 1) - 1
        corners = self.rng.choice([low, low + 1, -1, 0, 1, high - 1, high], rows)
        return np.where(self.rng.random(rows) < 0.25, corners, self.rng.integers(low, high, rows, endpoint=True))

    async def start(self) -> None:
        """Start the clock and reset the module, with random bits at its inputs and nothing offered."""
        for port in self.dut:
            if port._name == "rst_i":  # from the first edge on, as registers start with random bits
                port.value = 1
            elif re.search("^(valid|ready)_i$|^s_axis_.*_tvalid$|^m_axis_.*_tready$", port._name):
                port.value = 0
            elif re.search("(?<!clk)_i$|^s_axis_.*_tdata$", port._name):
                scramble(port)
        if hasattr(self.dut, "clk_i"):
            Clock(self.dut.clk_i, PERIOD, "ns").start()
        await self.tick()  # the clock's first edge comes at once
        await self.reset()

    async def reset(self, clocks: int = 2) -> None:
        """Hold the module in reset, if it has one, for so many clocks."""
        if hasattr(self.dut, "rst_i"):
            self.dut.rst_i.value = 1
            await self.tick(clocks)
            self.dut.rst_i.value = 0

    async def tick(self, clocks: int = 1) -> None:
        """Wait until this clock is over, or so many."""
        for _ in range(clocks):
            await (RisingEdge(self.dut.clk_i) if hasattr(self.dut, "clk_i") else Timer(PERIOD, "ns"))

    async def until(self, condition: Callable[[], bool], clocks: int, what: str) -> None:
        """Wait until a condition holds; raise Mismatch when it does not within so many clocks."""
        for _ in range(clocks):
            if condition():
                return
            await self.tick()
        raise Mismatch(f"{what}: not within {clocks} clocks (clock {self.clock})")

    def equal(self, actual: int, expected: int, what: str, bits: int = 0) -> None:
        """Count a comparison; raise Mismatch unless equal. Patterns of so many ``bits`` are shown in hex."""
        self.checks += 1
        if actual != expected:
            shown, wanted = (f"0x{n & (1 << bits) - 1:0{-(-bits // 4)}x}" if bits else n for n in (actual, expected))
            raise Mismatch(f"{what} is {shown}, expected {wanted} (clock {self.clock})")

    def columns(self, values: Mapping[str, ArrayLike]) -> list[Column]:
        """Rows of numbers as bits of ports, by the names of ports, of structures by those of fields: ``n_i.x``."""
        found: dict[str, Column] = {}
        for name, numbers in values.items():
            port, part, _ = name.partition(".")
            handle = getattr(self.dut, port)
            field = next((f for f in self.ports[port].fields if f.name == name), None)
            lsb, width = (field.lsb, field.width) if part else (0, len(handle))
            bits = _bits(name, numbers, width)
            column = found.setdefault(port, Column(handle, [0] * len(bits), 0))
            column.rows = [old | new << lsb for old, new in zip(column.rows, bits, strict=True)]
            column.mask |= (1 << width) - 1 << lsb
        return list(found.values())

    async def pipeline(
        self,
        inputs: Mapping[str, ArrayLike],
        outputs: Mapping[str, ArrayLike],
        latency: int,
        *,
        gap: float = 0.0,
        reset: float = 0.0,
        late: Mapping[str, int] | None = None,
        pace: int = 1,
    ) -> None:
        """Send rows through a pipeline of fixed latency and check all outputs on every clock.

        ``inputs``, ``outputs``: as :meth:`columns` takes them; an input that is the same in all rows is a setting, at
        rest throughout. ``gap``: probability of a clock without a row, with random bits at the inputs; ``reset``: of a
        clock in reset, which loses what is in the pipeline. ``late``: inputs that are taken so many clocks after the
        others. ``pace``: clocks a row, where it is more than one: the module takes a row when ``ready_o``, or when
        ``phase_i``, which counts its clocks, is TAKE, or 0. ``valid_i``, ``valid_o``, ``rst_i`` are served if there.
        """
        dut, late = self.dut, late or {}
        entries, exits = self.columns(inputs), self.columns(outputs)
        valid, resettable, phased = (hasattr(dut, name) for name in ("valid_i", "rst_i", "phase_i"))
        ready = dut.ready_o if hasattr(dut, "ready_o") else None
        total = len(entries[0].rows)
        settings = [column for column in entries if total > 1 and len(set(column.rows)) == 1]
        moving = [(column, late.get(column.port._name, 0)) for column in entries if column not in settings]
        for column in settings:
            column.port.value = column.rows[0]

        take_at = self.parameter("TAKE") if hasattr(dut, "TAKE") else 0
        waiting = deque(range(total))
        taken: list[int | None] = [None] * (latency + 1 + max(late.values(), default=0))  # the row of every clock
        clocks, since, offered = 0, pace, 0  # since the last row was taken; in which the next one has been offered
        while waiting or any(row is not None for row in taken[-latency - 3 :]):
            offer = waiting[0] if waiting and (offered or random.random() >= gap) else None
            in_reset = resettable and bool(waiting) and random.random() < reset
            phase = clocks % pace
            for column, behind in moving:
                row = taken[-behind] if behind else offer
                column.port.value = random.getrandbits(len(column.port)) if row is None else column.rows[row]
            if valid:
                dut.valid_i.value = offer is not None
            if resettable:
                dut.rst_i.value = in_reset
            if phased:
                dut.phase_i.value = (phase + take_at) % pace
            await self.tick()
            clocks += 1
            since += 1

            take = offer is not None and (int(ready.value) if ready is not None else not (phased and phase))
            if ready is not None and offer is not None:
                self.equal(offered < pace and (not take or since >= pace), True, f"row {offer}: a row in {pace} clocks")
            offered = 0 if take or offer is None else offered + 1
            if take:
                waiting.popleft()
                since = 0
            taken.append(offer if take else None)
            row = taken[-1 - latency]
            if hasattr(dut, "valid_o"):
                self.equal(int(dut.valid_o.value), row is not None, f"row {row}: valid_o")
            if row is not None:
                for column in exits:
                    actual = int(column.port.value) & column.mask
                    if actual != column.rows[row]:
                        given = ", ".join(f"{c.port._name} = {c.rows[row]:#x}" for c in entries)
                        self.equal(
                            actual, column.rows[row], f"row {row} ({given}): {column.port._name}", len(column.port)
                        )
                self.checks += len(exits)
            if in_reset:
                taken, since, offered = [None] * len(taken), pace, 0


class Source:
    """Sends words into a valid/ready channel of a module; ``clocks`` tells when each was taken.

    ``payload``: the names of the data ports; a word is a tuple of their bits.
    """

    def __init__(self, bench: Bench, valid: str, ready: str, payload: Sequence[str]):
        self.bench = bench
        self.clocks: list[int] = []
        self._valid, self._ready = getattr(bench.dut, valid), getattr(bench.dut, ready)
        self._payload = [getattr(bench.dut, name) for name in payload]

    async def send(self, words: Iterable[Sequence[int]], gap: float = 0.0) -> None:
        """Offer words one after the other, each until it is taken, with that probability of a clock without one."""
        for word in words:
            while random.random() < gap:
                await self.bench.tick()
            for port, bits in zip(self._payload, word, strict=True):
                port.value = bits
            self._valid.value = 1
            await self.bench.tick()
            while not int(self._ready.value):
                await self.bench.tick()
            self.clocks.append(self.bench.clock)
            self.withdraw()

    def withdraw(self) -> None:
        """Offer nothing, with random bits beside it."""
        self._valid.value = 0
        for port in self._payload:
            scramble(port)


class Sink:
    """Takes the words of a valid/ready channel from now on: ``words``, and the ``clocks`` when they were taken.

    ``stall``: probability of a clock that is not ready; may be changed at any time. A word that waits must stay as it
    is, else Mismatch is raised.
    """

    def __init__(self, bench: Bench, valid: str, ready: str, payload: Sequence[str], stall: float = 0.0):
        self.bench, self.stall = bench, stall
        self.words: list[tuple[int, ...]] = []
        self.clocks: list[int] = []
        self._valid, self._ready = getattr(bench.dut, valid), getattr(bench.dut, ready)
        self._payload = [getattr(bench.dut, name) for name in payload]
        cocotb.start_soon(self._run())

    async def _run(self) -> None:
        waiting = None
        while True:
            ready = random.random() >= self.stall
            self._ready.value = ready
            await self.bench.tick()
            word = tuple(int(port.value) for port in self._payload) if int(self._valid.value) else None
            if waiting not in (None, word):
                raise Mismatch(f"{self._valid._name}: a waiting word has changed (clock {self.bench.clock})")
            if word is not None and ready:
                self.words.append(word)
                self.clocks.append(self.bench.clock)
            waiting = None if ready or int(self.bench.dut.rst_i.value) else word

    def forget(self) -> None:
        """Start again with no words."""
        self.words.clear()
        self.clocks.clear()


class Watch:
    """Collects the words of outputs that only have a valid bit, and gives a credit back for each; as :class:`Sink`.

    ``stall``: probability of a clock in which no credit is given back, though one is due. ``credits``: there are
    so many; of a word without one Mismatch is raised. ``pays(word)``: it ends what a credit pays for. ``given``: the
    clocks of credits.
    """

    def __init__(
        self, bench: Bench, valid: str, payload: Sequence[str], credit: str = "", stall: float = 0.0, credits: int = 0,
        pays: Callable[[tuple[int, ...]], bool] = lambda word: True,
    ):  # fmt: skip
        self.bench, self.stall, self.credits, self.pays = bench, stall, credits, pays
        self.words: list[tuple[int, ...]] = []
        self.clocks: list[int] = []
        self.given: list[int] = []
        self.spent = 0
        self._valid, self._payload = getattr(bench.dut, valid), [getattr(bench.dut, name) for name in payload]
        self._credit = getattr(bench.dut, credit) if credit else None
        cocotb.start_soon(self._run())

    async def _run(self) -> None:
        begins = True  # the next word is the first that a credit pays for
        while True:
            give = self.spent > 0 and random.random() >= self.stall
            if self._credit is not None:
                self._credit.value = give
            await self.bench.tick()
            if give:
                self.spent -= 1
                self.given.append(self.bench.clock)
            in_reset = int(self.bench.dut.rst_i.value)
            if int(self._valid.value) and not in_reset:
                word = tuple(int(port.value) for port in self._payload)
                self.words.append(word)
                self.clocks.append(self.bench.clock)
                self.spent += begins
                begins = self.pays(word)
            if in_reset:
                self.spent, begins = 0, True
            if self._credit is not None and self.credits and self.spent > self.credits:
                raise Mismatch(f"{self._valid._name}: a word without a credit (clock {self.bench.clock})")

    forget = Sink.forget


async def phases(bench: Bench) -> None:
    """Count the phases, from 0 behind a reset."""
    phase, fold = 0, bench.parameter("FOLD")
    while True:
        bench.dut.phase_i.value = phase
        await bench.tick()
        phase = 0 if int(bench.dut.rst_i.value) else (phase + 1) % fold


async def no_path(bench: Bench, inputs: Sequence[str], outputs: Sequence[str]) -> None:
    """Change inputs in the middle of every clock and back again: no output may follow. Runs until the test ends."""
    into, out = ([getattr(bench.dut, name) for name in names] for names in (inputs, outputs))
    while True:
        await FallingEdge(bench.dut.clk_i)
        driven, before = ([(port, int(port.value)) for port in ports] for ports in (into, out))
        for port, bits in driven:
            port.value = bits ^ (random.getrandbits(len(port)) | 1)
        await Timer(1, "ns")
        for port, bits in before:
            bench.equal(int(port.value), bits, f"{port._name} between two edges", len(port))
        for port, bits in driven:
            port.value = bits


def scramble(port: ValueObjectBase) -> None:
    """Random bits at a port."""
    port.value = random.getrandbits(len(port))


def patterns(port: ValueObjectBase, values: ArrayLike) -> list[int]:
    """Numbers as bits of a port, which counts as signed if one of them is negative. ValueError if they do not fit."""
    return _bits(port._name, values, len(port))


def _bits(name: str, values: ArrayLike, width: int) -> list[int]:
    """Numbers, or rows of words of 32 bits, as so many bits."""
    if isinstance(values, list) and all(type(value) is int for value in values):
        return values  # bits of a structure
    values = np.asarray(values)
    if values.ndim > 1:
        return [int.from_bytes(row.astype("<u4").tobytes(), "little") for row in values]
    low, high = (-(1 << width - 1), (1 << width - 1) - 1) if values.min() < 0 else (0, (1 << width) - 1)
    if values.min() < low or values.max() > high:
        raise ValueError(f"{name}: {values.min()} .. {values.max()} do not fit {width} bits")
    return [value & (1 << width) - 1 for value in values.tolist()]
