# SPDX-License-Identifier: Apache-2.0
"""shade_registers: every field, strobe, response and counter as golden.core.RegisterFile, whatever the bus does."""

import itertools
import random
from collections.abc import Iterable

import cocotb
from cocotbext.axi import AxiResp
from polyshade.golden import registers
from polyshade.golden.core import RegisterFile
from polyshade.golden.types import COUNTS, DRAW, whole

from tb.bench import PRESSURE, Bench, Mismatch, Sink, Source, checked, no_path
from tb.runner import points, simulate

ALL = list(registers.every())
OFFSETS = {register.name: register.offset for register in ALL}
CLEAR = 1 << 31
COUNTERS = {"pixels": 3, "spans": 3, "stalls": 3, "evaluations": 3, "errors": 3}  # bits of their inputs
LATENCY = 5  # from an address, or the data if later, to the response


@points({}, {"DIVIDE": 0, "PATH_NORMALS": 0, "COLOUR": 0})
def test_cocotb(point):
    simulate("shade_registers", point)


def built(bench: Bench) -> RegisterFile:
    """The registers that are there."""
    return RegisterFile(**{name.lower(): bench.parameter(name) for name in ("DIVIDE", "PATH_NORMALS", "COLOUR")})


def quiet(bench: Bench, busy: int = 0) -> None:
    """Nothing happens in the core."""
    bench.dut.busy_i.value = busy
    bench.dut.events_i.value = bench.dut.counts_i.value = 0


class Bus:
    """The five channels, each with its own gaps or stalls."""

    def __init__(self, bench: Bench, gap: float = 0.0, stall: float = 0.0):
        self.bench, self.gap = bench, gap
        self.aw, self.w, self.ar = (
            Source(bench, f"s_axil_{name}valid", f"s_axil_{name}ready", [f"s_axil_{field}" for field in fields])
            for name, fields in {
                "aw": ("awaddr", "awprot"),
                "w": ("wdata", "wstrb"),
                "ar": ("araddr", "arprot"),
            }.items()
        )
        for source in (self.aw, self.w, self.ar):
            source.withdraw()
        self.b = Sink(bench, "s_axil_bvalid", "s_axil_bready", ["s_axil_bresp"], stall)
        self.r = Sink(bench, "s_axil_rvalid", "s_axil_rready", ["s_axil_rresp", "s_axil_rdata"], stall)

    async def write(self, accesses: Iterable[tuple[int, int, int]]) -> list[bool]:
        """Offset, word, strobe each, addresses and data on their own ways; True: OKAY, False: SLVERR."""
        accesses = list(accesses)
        self.b.forget()
        cocotb.start_soon(self.aw.send([(offset, random.getrandbits(3)) for offset, _, _ in accesses], self.gap))
        await self.w.send([access[1:] for access in accesses], self.gap)
        await self._answers(self.b, len(accesses))
        return [self._okay(response) for (response,) in self.b.words]

    async def read(self, offsets: Iterable[int]) -> list[tuple[int, bool]]:
        """Words, and True: OKAY, False: SLVERR."""
        offsets = list(offsets)
        self.r.forget()
        await self.ar.send([(offset, random.getrandbits(3)) for offset in offsets], self.gap)
        await self._answers(self.r, len(offsets))
        return [(word, self._okay(response)) for response, word in self.r.words]

    async def _answers(self, sink: Sink, count: int) -> None:
        await self.bench.until(lambda: len(sink.words) >= count, 1000, f"{count} answers")
        await self.bench.tick(10)
        self.bench.equal(len(sink.words), count, "number of answers")

    def _okay(self, response: int) -> bool:
        if response not in (AxiResp.OKAY, AxiResp.SLVERR):
            raise Mismatch(f"response {response} (clock {self.bench.clock})")
        return response == AxiResp.OKAY


async def compare(bench: Bench, bus: Bus, file: RegisterFile) -> None:
    """Every register as it is read, and every setting as it stands at the output."""
    for register, (word, okay) in zip(ALL, await bus.read(OFFSETS.values()), strict=True):
        bench.equal(okay, True, f"{register.name}: okay")
        bench.equal(word, file.read(register.offset)[0], register.name, 32)
    settings(bench, file)


async def told(bench: Bench) -> None:
    """Settings change right behind ``change_o``, and at no other time."""
    draw = int(bench.dut.draw_o.value)
    while True:
        change = int(bench.dut.change_o.value)
        await bench.tick()
        before, draw = draw, int(bench.dut.draw_o.value)
        if draw != before and not change:
            raise Mismatch(f"settings changed without change_o (clock {bench.clock})")


def settings(bench: Bench, file: RegisterFile) -> None:
    """``draw_o``, field by field."""
    values: dict[str, int] = {}
    for register in ALL:
        values |= registers.unpack(register.offset, file.words[register.name])
    draw = int(bench.dut.draw_o.value)
    for field in registers.settings():
        actual, mask = draw >> DRAW.leaf(field.path).lsb, (1 << field.width) - 1
        bench.equal(actual & mask, values[field.name] & mask, field.name, field.width)


def somewhere() -> int:
    """An offset: of a register, next to one, or anywhere."""
    return random.choice(
        [*OFFSETS.values(), *(offset + 3 for offset in OFFSETS.values()), *random.sample(range(4096), 9)]
    )


# ---- values --------------------------------------------------------------------------------------------------------


@checked(pause=[0.0, 0.6])
async def every_field(bench: Bench, pause: float) -> None:
    """Reset values; then all ones, all zeros and random words into every register. A library's master: test_core."""
    quiet(bench)
    bus, file = Bus(bench, pause, pause), built(bench)
    await bench.reset()
    await compare(bench, bus, file)
    for word in (0xFFFFFFFF & ~CLEAR, 0, random.getrandbits(31)):
        for register in ALL:
            okay = await bus.write([(register.offset, word, 0xF)])
            bench.equal(okay, [file.write(register.offset, word)], f"write {register.name}")
        await compare(bench, bus, file)


@checked(pause=[0.0, 0.6])
async def no_register(bench: Bench, pause: float) -> None:
    """Offsets without a register, all of them: an error, 0, and nothing changes."""
    quiet(bench)
    bus, file = Bus(bench, pause, pause), built(bench)
    await bench.reset()
    empty = [offset for offset in range(0, 4096, 4) if offset not in OFFSETS.values()]
    for word, okay in await bus.read(random.sample(empty, 200) if pause else empty):
        bench.equal((word, okay), (0, False), "a read of nothing")
    for okay in await bus.write((offset, random.getrandbits(32), 0xF) for offset in random.sample(empty, 200)):
        bench.equal(okay, False, "a write to nothing")
    await compare(bench, bus, file)


# ---- the channels on their own -------------------------------------------------------------------------------------


@checked(**PRESSURE)
async def random_writes(bench: Bench, gap: float, stall: float) -> None:
    """Any strobes, addresses and data in any order, while other registers are read; busy or not."""
    bus, file = Bus(bench, gap, stall), built(bench)
    quiet(bench)
    await bench.reset()
    cocotb.start_soon(told(bench))
    for busy in (0, 0, 1, 1, 0, 0, 1, 0):
        quiet(bench, busy)
        accesses = [(somewhere(), random.getrandbits(32), random.getrandbits(4)) for _ in range(60)]
        constant = [random.choice([OFFSETS["ID"], OFFSETS["VERSION"], 0x010]) for _ in range(60)]
        reading = cocotb.start_soon(bus.read(constant))
        answers = await bus.write(accesses)
        for access, okay in zip(accesses, answers, strict=True):
            bench.equal(okay, file.write(*access, bool(busy)), f"write {access} busy {busy}: okay")
        for offset, (word, okay) in zip(constant, await reading, strict=True):
            bench.equal((word, okay), file.read(offset), f"read {offset:#x}")
        settings(bench, file)
        quiet(bench)
        await bus.write([(OFFSETS["CONTROL"], CLEAR, 0b1000)])  # CLOCKS has counted
        await compare(bench, bus, file)


@checked(order=["address", "data"])
async def address_and_data(bench: Bench, order: str) -> None:
    """One long before the other: the write waits for both; then takes as many clocks as a read."""
    bus = Bus(bench)
    quiet(bench)
    await bench.reset()
    first, second = (bus.aw, bus.w) if order == "address" else (bus.w, bus.aw)
    beats = {bus.aw: (OFFSETS["T1"], 0), bus.w: (1234, 0xF)}
    await first.send([beats[first]])
    await bench.tick(20)
    bench.equal(len(bus.b.words), 0, "answers before the write is there")
    await second.send([beats[second]])
    await bench.tick(10)
    bench.equal(bus.b.clocks[0] - second.clocks[0], LATENCY, "clocks of a write")
    bench.equal((await bus.read([OFFSETS["T1"]]))[0], (1234, True), "T1")
    bench.equal(bus.r.clocks[0] - bus.ar.clocks[0], LATENCY, "clocks of a read")


@checked()
async def turns(bench: Bench) -> None:
    """Both directions without a pause: none waits for more than one access of the other."""
    bus = Bus(bench)
    quiet(bench)
    await bench.reset()
    reading = cocotb.start_soon(bus.read([0] * 100))
    await bus.write((OFFSETS["T2"], i, 0xF) for i in range(100))
    await reading
    for sink in (bus.b, bus.r):
        gaps = [later - sooner for sooner, later in itertools.pairwise(sink.clocks)]
        bench.equal(max(gaps) <= 8, True, f"8 clocks at most from answer to answer, {max(gaps)} were needed")


# ---- status and counters -----------------------------------------------------------------------------------------


class Core:
    """What happens in the core, at random, and what it adds up to: ``file``, clock by clock."""

    def __init__(self, bench: Bench, file: RegisterFile):
        self.bench, self.file = bench, file
        self.active = False
        quiet(bench)
        cocotb.start_soon(self._run())

    async def _run(self) -> None:
        dut = self.bench.dut
        while True:
            events, busy, increments = 0, 0, dict.fromkeys(COUNTERS, 0)
            if self.active:
                events = random.getrandbits(11) if random.random() < 0.02 else 0
                busy = random.getrandbits(1)
                increments = {name: random.getrandbits(bits) for name, bits in COUNTERS.items()}
            dut.events_i.value, dut.busy_i.value = events, busy
            dut.counts_i.value = whole(COUNTS, increments)[0]
            await self.bench.tick()
            if int(dut.clear_o.value):
                self.file.clear()
            self.file.count(events, clocks=busy, **increments)


@checked()
async def counters(bench: Bench) -> None:
    """Several a clock, up to the last clock; CONTROL.clear in the middle loses nothing."""
    bus, file = Bus(bench), built(bench)
    quiet(bench)
    await bench.reset()
    core = Core(bench, file)
    for clear in (False, True, False, True):
        core.active = True
        await bench.tick(random.randrange(100, 300))
        if clear:
            bench.equal(await bus.write([(OFFSETS["CONTROL"], CLEAR, 0b1000)]), [True], "clear")
            await bench.tick(random.randrange(30))
        core.active = False
        await bench.tick(2)
        bench.equal(all(file.words[name.upper()] for name in COUNTERS), True, "something was counted")
        await compare(bench, bus, file)


@checked()
async def every_fault(bench: Bench) -> None:
    """A pulse of one clock sets its bit, and that bit alone, until it is cleared."""
    bus, file = Bus(bench), built(bench)
    quiet(bench)
    await bench.reset()
    for bit, fault in enumerate(registers.faults()):
        bench.dut.events_i.value = 1 << bit
        await bench.tick()
        quiet(bench)
        file.count(1 << bit)
        for _ in range(2):
            bench.equal((await bus.read([OFFSETS["STATUS"]]))[0][0], 1 << fault.lsb, fault.name, 32)
        bench.dut.events_i.value = 1 << bit
        clearing = cocotb.start_soon(bus.write([(OFFSETS["CONTROL"], CLEAR, 0xF)]))
        await bench.until(lambda: int(bench.dut.clear_o.value), 20, "clear")
        quiet(bench)
        await clearing
        bench.equal((await bus.read([OFFSETS["STATUS"]]))[0][0], 1 << fault.lsb, f"{fault.name} while clearing", 32)
        await bus.write([(OFFSETS["CONTROL"], CLEAR, 0xF)])
        bench.equal((await bus.read([OFFSETS["STATUS"]]))[0][0], 0, "STATUS", 32)


@checked()
async def busy(bench: Bench) -> None:
    """A draw call cannot be torn: settings stay as they are; CONTROL.clear works if nothing else is asked for."""
    bus, file = Bus(bench), built(bench)
    quiet(bench)
    await bench.reset()
    control = registers.pack({"fixed_degree": 2})[OFFSETS["CONTROL"]]
    await bus.write([(OFFSETS["CONTROL"], control, 0xF)])
    file.write(OFFSETS["CONTROL"], control)
    quiet(bench, busy=1)
    bench.equal((await bus.read([OFFSETS["STATUS"]]))[0], (1, True), "STATUS.busy")
    for register in ALL:
        okay = await bus.write([(register.offset, random.getrandbits(31), 0xF)])
        bench.equal(okay, [register.access == "ro"], f"write to {register.name} while busy")
    settings(bench, file)
    for word, strobe, okay in (
        (control | CLEAR, 0xF, True),
        (CLEAR, 0b1000, True),
        (control, 0xF, False),
        (control ^ 0x100 | CLEAR, 0xF, False),
        (control | 1 << 20 | CLEAR, 0xF, False),
        (CLEAR, 0b0111, False),
        (0, 0, False),
    ):
        before = (await bus.read([OFFSETS["CLOCKS"]]))[0][0]
        bench.equal(await bus.write([(OFFSETS["CONTROL"], word, strobe)]), [okay], f"{word:#x} {strobe:04b} while busy")
        after = (await bus.read([OFFSETS["CLOCKS"]]))[0][0]
        bench.equal(after < before, okay, f"{word:#x} {strobe:04b} cleared CLOCKS, {before} to {after}")
        settings(bench, file)
    quiet(bench)
    await bus.write([(OFFSETS["CONTROL"], CLEAR, 0b1000)])
    await compare(bench, bus, file)


# ---- resets and paths ----------------------------------------------------------------------------------------------


@checked()
async def resets(bench: Bench) -> None:
    """In the middle of accesses: all is as after power-up, and no answer comes to what was lost."""
    bus = Bus(bench, 0.3, 0.3)
    quiet(bench)
    for _ in range(40):
        tasks = [
            cocotb.start_soon(bus.aw.send([(OFFSETS["K1"], 0)] * 20, 0.3)),
            cocotb.start_soon(bus.w.send([(random.getrandbits(31), 0xF)] * 20, 0.3)),
            cocotb.start_soon(bus.ar.send([(OFFSETS["K1"], 0)] * 20, 0.3)),
        ]
        await bench.tick(random.randrange(1, 60))
        for task in tasks:
            task.cancel()
        for source in (bus.aw, bus.w, bus.ar):
            source.withdraw()
        await bench.reset()
        for sink in (bus.b, bus.r):
            sink.forget()
        await bench.tick(10)
        bench.equal(len(bus.b.words) + len(bus.r.words), 0, "answers after a reset")
        await compare(bench, bus, built(bench))


@checked()
async def paths(bench: Bench) -> None:
    """No input reaches an output between two edges."""
    bus = Bus(bench, 0.5, 0.5)
    quiet(bench)
    await bench.reset()
    into = [p._name for p in bench.dut if p._name.endswith(("valid", "addr", "prot", "data", "strb", "ready", "_i"))]
    out = ["s_axil_awready", "s_axil_wready", "s_axil_bvalid", "s_axil_bresp", "s_axil_arready", "s_axil_rvalid",
           "s_axil_rdata", "s_axil_rresp", "draw_o", "change_o", "clear_o"]  # fmt: skip
    cocotb.start_soon(no_path(bench, [name for name in into if name not in (*out, "clk_i")], out))
    reading = cocotb.start_soon(bus.read(random.choices(list(OFFSETS.values()), k=50)))
    await bus.write((OFFSETS["GAIN"], random.getrandbits(31), 0xF) for _ in range(50))
    await reading
