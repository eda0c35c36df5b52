# SPDX-License-Identifier: Apache-2.0
"""shade_core: spans and settings in, pixels out, to the bit of golden.core.core, on buses driven by a library."""

import itertools
import logging
import random
from collections.abc import Callable

import cocotb
import numpy as np
from cocotbext.axi import (
    AxiLiteBus,
    AxiLiteMaster,
    AxiResp,
    AxiStreamBus,
    AxiStreamFrame,
    AxiStreamSink,
    AxiStreamSource,
)
from polyshade.golden import contract as k
from polyshade.golden.core import Told
from polyshade.golden.core import core as golden_core
from polyshade.golden.registers import ID, after_reset, built, every, pack, unpack
from polyshade.sim.units.spans import CODES, Spans, settings, spans

from tb.bench import PRESSURE, Bench, Mismatch, checked, no_path
from tb.runner import points, simulate

OFFSETS = {register.name: register.offset for register in every()}
NAMES = {offset: name for name, offset in OFFSETS.items()}
PAYLOAD = ["tdata", "tuser", "tlast"]
BEAT = k.SPAN_DATA_W // 8  # bytes
SHORT, LONG = 1, 2  # how a packet is torn
SMALL = {"REFLECT": 0, "DIVIDE": 0}


@points({}, {"LANES": 2, "COLOUR": 1, **SMALL}, {"LANES": 4, "PATH_NORMALS": 0, **SMALL})
def test_cocotb(point):
    simulate("shade_core", point)


class Watch:
    """What happens at the core's streams from now on: the pixels of every lane and their clocks, clocks and stalls."""

    def __init__(self, bench: Bench):
        self.bench, self.lanes = bench, bench.parameter("LANES")
        self.inside, self.taken = 0, []
        self._torn = False
        self.forget()
        cocotb.start_soon(self._run())

    def forget(self) -> None:
        """Start again with no pixels; what is inside stays."""
        self.words: list[list[tuple[int, ...]]] = [[] for _ in range(self.lanes)]
        self.clocks: list[list[int]] = [[] for _ in range(self.lanes)]
        self.taken: list[int] = []
        self.counted = {"clocks": 0, "stalls": 0}

    @property
    def pixels(self) -> int:
        """How many there were."""
        return sum(map(len, self.words))

    async def _run(self) -> None:
        dut, waiting = self.bench.dut, [None] * self.lanes
        while True:
            await self.bench.tick()
            if int(dut.rst_i.value):
                self.inside, self._torn, waiting = 0, False, [None] * self.lanes
                continue
            self._enter()
            self.counted["clocks"] += self.inside > 0
            valid, ready = int(dut.m_axis_pixel_tvalid.value), int(dut.m_axis_pixel_tready.value)
            self.counted["stalls"] += (valid & ~ready).bit_count()
            for lane in range(self.lanes):
                word = self._word(lane) if valid >> lane & 1 else None
                if waiting[lane] not in (None, word):
                    raise Mismatch(f"lane {lane}: a waiting pixel has changed (clock {self.bench.clock})")
                waiting[lane] = None
                if word is not None and ready >> lane & 1:
                    self.words[lane].append(word)
                    self.clocks[lane].append(self.bench.clock)
                    self.inside -= word[-1]
                else:
                    waiting[lane] = word

    def _enter(self) -> None:
        dut = self.bench.dut
        if not (int(dut.s_axis_span_tvalid.value) and int(dut.s_axis_span_tready.value)):
            return
        last, keep = int(dut.s_axis_span_tlast.value), int(dut.s_axis_span_tkeep.value)
        count = int(dut.s_axis_span_tdata.value) >> k.SPAN_COUNT_LSB & (1 << k.COUNT_W) - 1
        if last and not self._torn and keep == (1 << BEAT) - 1 and 0 < count <= k.PIXELS_MAX:
            self.inside += 1
        self.taken.append(self.bench.clock)
        self._torn = not last

    def _word(self, lane: int) -> tuple[int, ...]:
        ports = [getattr(self.bench.dut, f"m_axis_pixel_{name}") for name in PAYLOAD]
        widths = [len(port) // self.lanes for port in ports]
        return tuple(
            int(port.value) >> lane * width & (1 << width) - 1 for port, width in zip(ports, widths, strict=True)
        )


class Core:
    """A core, its buses and who watches them. ``stall``: probability of a clock in which a lane's sink is not ready."""

    def __init__(self, bench: Bench, gap: float = 0.0, stall: float = 0.0):
        self.bench, dut = bench, bench.dut
        self.stall = [stall] * bench.parameter("LANES")
        logging.getLogger(f"cocotb.{dut._name}").setLevel(logging.WARNING)
        self.source = AxiStreamSource(AxiStreamBus.from_prefix(dut, "s_axis_span"), dut.clk_i, dut.rst_i)
        self.axil = AxiLiteMaster(AxiLiteBus.from_prefix(dut, "s_axil"), dut.clk_i, dut.rst_i)
        write, read = self.axil.write_if, self.axil.read_if
        channels = [write.aw_channel, write.w_channel, write.b_channel, read.ar_channel, read.r_channel]
        for channel in [self.source, *channels]:
            channel.set_pause_generator(random.random() < gap for _ in itertools.count())
        if len(self.stall) == 1:
            sink = AxiStreamSink(AxiStreamBus.from_prefix(dut, "m_axis_pixel"), dut.clk_i, dut.rst_i, byte_lanes=1)
            sink.set_pause_generator(random.random() < self.stall[0] for _ in itertools.count())
        else:  # streams side by side
            cocotb.start_soon(self._take())
        self.watch = Watch(bench)
        self.draw = after_reset()  # as it is in the core

    async def _take(self) -> None:
        while True:
            ready = sum((random.random() >= stall) << lane for lane, stall in enumerate(self.stall))
            self.bench.dut.m_axis_pixel_tready.value = ready
            await self.bench.tick()

    # ---- registers

    async def read(self, name: str) -> int:
        """The word of a register."""
        answer = await self.axil.read(OFFSETS[name], 4)
        self.bench.equal(answer.resp, AxiResp.OKAY, f"{name}: rresp")
        return int.from_bytes(answer.data, "little")

    async def write(self, offset: int, word: int) -> AxiResp:
        """The answer to a word that is written."""
        return (await self.axil.write(offset, word.to_bytes(4, "little"))).resp

    async def begin(self, draw: dict[str, int]) -> None:
        """The settings of the next draw call; counters and status from 0."""
        before, self.draw = pack(self.draw), after_reset() | draw
        for offset, word in pack(self.draw | {"clear": 1}).items():
            if word != before[offset]:
                self.bench.equal(await self.write(offset, word), AxiResp.OKAY, f"register {offset:#x}: bresp")
        self.watch.forget()

    # ---- spans

    def send(self, sent: Spans, torn: np.ndarray | None = None) -> Told:
        """Send spans, some in torn packets; what is to come of them."""
        torn = np.zeros(len(sent.count), int) if torn is None else torn
        for (beat,), how in zip(sent.words(), torn.tolist(), strict=True):
            data = beat.to_bytes(BEAT, "little")
            if how == SHORT:
                data = data[: random.randrange(1, BEAT)]
            elif how == LONG:
                data += random.randbytes(random.randrange(1, 3 * BEAT))
            self.source.send_nowait(AxiStreamFrame(data))
        return self.golden(sent, torn)

    def golden(self, sent: Spans, torn: np.ndarray | int = 0) -> Told:
        """What is to come of spans."""
        names = ("colour", "evaluator", "form", "reflect", "divide", "path_normals")
        options = {name: self.bench.parameter(name.upper()) for name in names}
        return golden_core(
            sent.normal, sent.step, sent.count, self.draw, torn=torn, flat=sent.flat, cosine=sent.cosine, **options
        )

    async def compare(self, sent: Spans, told: Told, counters: bool = True) -> None:
        """Wait for all pixels and compare every lane's; no more may come. Then counters, if wanted, and status."""
        bench, watch, total = self.bench, self.watch, len(told.span)
        await bench.until(lambda: watch.pixels >= total, 5 * total + 30 * len(sent.count) + 500, f"{total} pixels")
        await self.source.wait()
        await bench.tick(k.LATENCY_LANE + 50)
        widths = np.arange(told.pixels.shape[1]) * k.PIXEL_W
        tdata, tuser = (told.pixels << widths).sum(axis=1), sent.tag[told.span]
        tlast = np.append(np.diff(told.span), 1)[:total] != 0
        start, end = np.searchsorted(told.span, told.span), np.searchsorted(told.span, told.span, "right")
        first = {int(sent.tag[told.span[at]]): at for at in np.unique(start).tolist()}  # pixel by its span's tag
        for lane, words in enumerate(
            watch.words
        ):  # spans of a lane come in order, each from its first pixel to its last
            before = index = stop = -1
            for word in words:
                if index == stop:
                    index = first.get(word[1], -1)
                    bench.equal(index > before, True, f"lane {lane}: the next span has a tag behind those that came")
                    before, stop = index, int(end[index])
                what = f"pixel {index} (span {told.span[index]}, lane {lane})"
                for name, actual, wanted in zip(PAYLOAD, word, (tdata, tuser, tlast), strict=True):
                    bench.equal(actual, int(wanted[index]), f"{what}: {name}", 48)
                index += 1
            bench.equal(index, stop, f"end of the last span of lane {lane}")
        bench.equal(watch.pixels, total, "number of pixels")
        for name, wanted in (told.counters | watch.counted if counters else {}).items():
            bench.equal(await self.read(name.upper()), wanted, name)
        status = unpack(OFFSETS["STATUS"], await self.read("STATUS"))
        for name, wanted in ({"busy": 0} | told.status).items():
            bench.equal(status[name], wanted, f"STATUS.{name}")

    @property
    def latency(self) -> int:
        """Clocks from a span of one pixel to its pixel."""
        parameter, path = self.bench.parameter, self.draw["path"] == k.PATH_NORMALS
        wanted = k.LATENCY_LANE_NORMALS if path and parameter("PATH_NORMALS") else k.LATENCY_LANE
        door = k.LATENCY_CORE - k.LATENCY_LANE
        return door + wanted - (not parameter("REFLECT")) * k.LATENCY_REFLECT + parameter("COLOUR") * k.LATENCY_PAINT


def any_settings(bench: Bench, code: int, path: int) -> dict[str, int]:
    """A draw call: any material of a model, in colour or not, adaptive or of fixed degree."""
    chosen = {"variant": code, "fixed_degree": random.choice([0, 0, 1, 2, 3]), "colour": random.getrandbits(1)}
    return settings(bench.rng, code) | chosen | {"path": path}


def calm(bench: Bench, count: list[int]) -> Spans:
    """Spans of normals that almost look at the viewer, in which nothing is at fault but their length."""
    sent = spans(bench.rng, count)
    sent.normal[:] = bench.rng.integers(-(1 << 24), 1 << 24, sent.normal.shape)
    sent.normal[:, 2] += 1 << k.STEP_F
    sent.step[:] = bench.rng.integers(-(1 << 14), 1 << 14, sent.step.shape)
    sent.flat[:] = 0
    return sent


@checked(**PRESSURE)
async def traffic(bench: Bench, gap: float, stall: float) -> None:
    """Draw calls of any models by either path, faulty spans among them, pauses on every channel or none.

    Meanwhile registers are read, and settings written, in vain.
    """
    core = Core(bench, gap, stall)
    for path, code in enumerate(random.sample(CODES, 4)):
        await core.begin(any_settings(bench, code, path % 2))
        count = bench.rng.choice([0, 1, 2, 3, 4, 5, 9, 30, k.PIXELS_MAX + 1], 30 * core.watch.lanes)
        if path < 2 and not gap and not stall:
            count[-1] = k.PIXELS_MAX
        torn = bench.rng.choice([0, SHORT, LONG], count.size, p=[0.9, 0.05, 0.05])
        sent = spans(bench.rng, count)
        told = core.send(sent, torn)
        await bench.until(lambda: core.watch.inside > 0, 200, "a span taken")
        await meddle(core, lambda told=told: core.watch.pixels < len(told.span) // 4)
        await core.compare(sent, told)
    for offset, word in kept(core).items():
        bench.equal(await core.read(NAMES[offset]), word, f"{NAMES[offset]} behind the draw call", 32)


def kept(core: Core) -> dict[int, int]:
    """What the registers hold of the settings: those that the parameters leave out are 0."""
    there = {
        field.name
        for field in built(**{n.lower(): core.bench.parameter(n) for n in ("DIVIDE", "PATH_NORMALS", "COLOUR")})
    }
    return pack({name: value if name in there else 0 for name, value in core.draw.items()})


async def meddle(core: Core, going_on: Callable[[], bool]) -> None:
    """Read and write any register as long as spans are inside: settings can be read only, clearing changes nothing."""
    settable = list(kept(core).items())
    bench = core.bench
    await bench.tick(3)
    while going_on():
        offset, word = random.choice(settable)
        name, other = NAMES[offset], word ^ random.getrandbits(31)
        bench.equal(await core.read(name), word, f"{name} while busy", 32)
        bench.equal(await core.write(offset, other), AxiResp.SLVERR, f"{name}: bresp while busy")
        bench.equal(await core.read("ID"), ID, "ID")
        bench.equal(await core.read("STATUS") & 1, 1, "STATUS.busy")


@checked()
async def latency(bench: Bench) -> None:
    """From a span to its first pixel."""
    core = Core(bench)
    for path, colour in itertools.product([k.PATH_POLY, k.PATH_NORMALS], [0, 1]):
        await core.begin({"path": path, "colour": colour})
        sent = calm(bench, [1])
        await core.compare(sent, core.send(sent))
        (clock,) = (clock for lane in core.watch.clocks for clock in lane)
        bench.equal(clock - core.watch.taken[0], core.latency, "latency")


@checked()
async def interrupt(bench: Bench) -> None:
    """irq_o: when the last span has left, or one is faulty, until CONTROL.clear; idle_o: nothing is inside."""
    core, dut = Core(bench), bench.dut
    await bench.tick(5)
    bench.equal((int(dut.idle_o.value), int(dut.irq_o.value)), (1, 0), "idle_o, irq_o after reset")
    for count in [4, 1], [0]:
        await core.begin({"model": k.MODEL_LAMBERT})
        await bench.tick(5)
        bench.equal((int(dut.idle_o.value), int(dut.irq_o.value)), (1, 0), "idle_o, irq_o when cleared")
        sent = calm(bench, count)
        told = core.send(sent)
        if count[0]:
            await bench.until(lambda: core.watch.inside > 0, 100, "a span taken")
            await bench.tick(3)
            bench.equal((int(dut.idle_o.value), int(dut.irq_o.value)), (0, 0), "idle_o, irq_o with spans inside")
        await core.compare(sent, told)
        bench.equal((int(dut.idle_o.value), int(dut.irq_o.value)), (1, 1), "idle_o, irq_o at the end")


@checked(path=[k.PATH_POLY, k.PATH_NORMALS])
async def throughput(bench: Bench, path: int) -> None:
    """A pixel a clock and lane."""
    core = Core(bench)
    await core.begin(any_settings(bench, k.MODEL_BLINN, path) | {"fixed_degree": k.DEGREE_CUBIC})
    sent = spans(bench.rng, [8] * 30 * core.watch.lanes)
    await core.compare(sent, core.send(sent))
    clocks = [clock for lane in core.watch.clocks for clock in lane]
    took = max(clocks) - min(clocks) + 1
    bench.equal(240 <= took <= 240 + 3 * 8 * (core.watch.lanes > 1), True, f"{took} clocks of all pixels, enough")


@checked(path=[k.PATH_POLY, k.PATH_NORMALS])
async def blocked(bench: Bench, path: int) -> None:
    """A lane whose sink is not ready for long fills up, and holds up nobody else: spans go to those with less."""
    core = Core(bench)
    lanes = core.watch.lanes
    await core.begin(any_settings(bench, k.MODEL_BLINN, path) | {"fixed_degree": k.DEGREE_CUBIC})
    still = random.randrange(lanes)
    core.stall[still] = 1.0
    sent = spans(bench.rng, [7] * 230 * lanes)
    told = core.send(sent)
    await bench.tick(230 * 7 * lanes + 1000)
    if lanes == 1:
        bench.equal(len(core.watch.taken) < len(sent.count), True, "the core is full")
    else:
        others = core.watch.pixels - len(core.watch.words[still])
        bench.equal(others > 7 * 200 * (lanes - 1), True, f"the others draw on, {others} pixels so far")
    core.stall = [0.0] * lanes
    await core.compare(sent, told)


@checked()
async def fair(bench: Bench) -> None:
    """A long span among short ones keeps its lane busy, not the others: a pixel a clock and lane on the whole."""
    core = Core(bench)
    lanes = core.watch.lanes
    await core.begin({"model": k.MODEL_BLINN, "fixed_degree": k.DEGREE_LINEAR, "t3": 0})
    sent = calm(bench, [64, *[4] * (lanes - 1)] * 120)
    await core.compare(sent, core.send(sent))
    clocks = [clock for lane in core.watch.clocks for clock in lane]
    rate = len(clocks) / (max(clocks) - min(clocks) + 1)
    bench.equal(rate > 0.8 * lanes, True, f"pixels a clock: {rate:.2f} of {lanes} lanes, enough")


@checked()
async def faults(bench: Bench) -> None:
    """Every fault sets its bit of STATUS and no other, counts if it costs the span, and harms no other span."""
    core = Core(bench)
    light = {"model": k.MODEL_BLINN, "gain": 1 << k.GAIN_F}
    v1 = light | {"path": k.PATH_NORMALS, "variant": k.VARIANT_V1}
    kinds = [
        ("error_empty", light, [0], 0), ("error_long", light, [k.PIXELS_MAX + 1], 0),
        ("error_long", light, [(1 << k.COUNT_W) - 1], 0), ("error_packet", light, [5], SHORT),
        ("error_packet", light, [5], LONG), ("error_packet", light, [0], LONG),
        ("light_model", {"model": 6}, [5], 0), ("light_model", {"model": 7}, [5], 0),
        ("light_zero", {"model": k.MODEL_WARD, "lz": 0}, [5], 0),
        ("light_saturated", light | {"gain_exp": 8}, [5], 0),
        ("normal_zero", light, [5], 0), ("normal_short", light, [5], 0),
        ("error_metric", v1, [k.METRIC_M_MIN], 0), ("error_metric", v1, [k.METRIC_M_MAX + 2], 0),
        ("error_threshold", v1 | {"variant": k.VARIANT_V4, "threshold": -1}, [5], 0),
        ("error_threshold", v1 | {"variant": k.VARIANT_V5, "threshold": (1 << k.INTENSITY_F) + 1}, [5], 0),
    ]  # fmt: skip
    for name, draw, count, how in kinds:
        if not bench.parameter("PATH_NORMALS") and "path" in draw:
            continue
        if not bench.parameter("DIVIDE") and draw["model"] == k.MODEL_WARD:
            continue
        await core.begin(draw)
        sent = calm(bench, [6, *count, *count, 7, 8, *count])
        at = np.array([1, 2, 5])
        if name.startswith("normal"):
            sent.normal[at], sent.step[at] = [0, 0, 1 << k.STEP_F - 4 if name == "normal_short" else 0], 0
        torn = np.zeros(6, int)
        torn[at] = how
        told = core.send(sent, torn)
        bits = {name} | ({"normal_short"} if name == "normal_zero" else set())
        bench.equal({bit for bit, value in told.status.items() if value}, bits, "bits of the golden model")
        dropped = name in ("error_empty", "error_long", "error_packet")
        bench.equal(told.counters["errors"], 3 * dropped, "errors of the golden model")
        await core.compare(sent, told)


@checked(stall=[0.0, 0.5, 1.0])
async def reset(bench: Bench, stall: float) -> None:
    """Reset in the middle of a span: nothing of it remains, in no lane and in no register."""
    core = Core(bench, gap=0.2)
    for path in (k.PATH_POLY, k.PATH_NORMALS, k.PATH_POLY):
        core.stall = [stall] * core.watch.lanes
        await core.begin(any_settings(bench, random.choice(CODES), path))
        sent = spans(bench.rng, bench.rng.integers(0, 60, 80))
        core.send(sent, bench.rng.choice([0, LONG], 80, p=[0.8, 0.2]))
        await bench.tick(random.randrange(20, 3 * k.LATENCY_LANE))
        core.source.clear()
        await bench.reset(clocks=1)
        core.stall = [0.0] * core.watch.lanes
        await bench.tick(2 * k.LATENCY_LANE)
        core.watch.forget()
        core.draw = after_reset()
        sent = calm(bench, [0, 7, 2, 30])
        await core.compare(sent, core.send(sent))


@checked(name=["path", "model", "fixed_degree"])
async def settled(bench: Bench, name: str) -> None:
    """A setting is written while a span comes, in any clock: it holds for all of the span, or is refused."""
    core = Core(bench)
    answers = set()
    for wait in range(3, 10):
        await core.begin({"gain": 1 << k.GAIN_F, name: 1})
        ((offset, word),) = pack({name: 0}).items()
        writing = cocotb.start_soon(core.write(offset, word))
        await bench.tick(wait)
        sent = calm(bench, [6, 9])
        core.send(sent)
        answers.add(await writing)
        if await writing == AxiResp.OKAY:
            core.draw |= unpack(offset, word)
        await core.compare(sent, core.golden(sent))
    bench.equal(answers, {AxiResp.OKAY, AxiResp.SLVERR}, "answers")


@checked()
async def cleared(bench: Bench) -> None:
    """CONTROL.clear sets counters and status to 0 while spans are inside, and nothing else."""
    core = Core(bench)
    await core.begin(any_settings(bench, k.MODEL_BLINN, k.PATH_POLY))
    sent = spans(bench.rng, [0, 300, 300])
    told = core.send(sent)
    await bench.until(lambda: core.watch.pixels > 100, 1000, "pixels")
    words = pack(core.draw | {"clear": 1})
    bench.equal(await core.write(OFFSETS["CONTROL"], words[OFFSETS["CONTROL"]]), AxiResp.OKAY, "bresp")
    bench.equal(await core.read("ERRORS"), 0, "ERRORS")
    bench.equal(await core.read("STATUS") >> 8 & 1, 0, "STATUS.error_empty")
    await bench.until(lambda: core.watch.pixels >= len(told.span), 2000, "all pixels")
    bench.equal(await core.read("SPANS"), 0, "SPANS")
    bench.equal(0 < await core.read("PIXELS") < len(told.span), True, "PIXELS count on")


@checked(wait=[0, 3, 17])
async def cleared_with_a_span_at_the_door(bench: Bench, wait: int) -> None:
    """CONTROL.clear while every lane is full and spans wait: none is lost, none comes twice, all count from 0."""
    core = Core(bench)
    await core.begin({"gain": 1 << k.GAIN_F})
    core.stall = [1.0] * core.watch.lanes
    sent = calm(bench, [7] * 230 * core.watch.lanes)
    told = core.send(sent)
    await bench.tick(300 * core.watch.lanes + 1000 + wait)
    bench.equal(int(bench.dut.s_axis_span_tready.value), 0, "s_axis_span_tready of a full core")
    spans_before = await core.read("SPANS")
    word = pack(core.draw | {"clear": 1})[OFFSETS["CONTROL"]]
    bench.equal(await core.write(OFFSETS["CONTROL"], word), AxiResp.OKAY, "bresp")
    bench.equal(await core.read("SPANS"), 0, "SPANS")
    core.stall = [0.0] * core.watch.lanes
    await bench.until(lambda: core.watch.pixels >= len(told.span), 5 * len(told.span), "all pixels")
    bench.equal(await core.read("SPANS"), len(sent.count) - spans_before, "SPANS behind it")
    bench.equal(await core.read("PIXELS"), len(told.span), "PIXELS behind it")
    await core.compare(sent, told, counters=False)


@checked()
async def paths(bench: Bench) -> None:
    """No output follows an input within a clock."""
    core = Core(bench, 0.3, 0.3)
    await core.begin(any_settings(bench, k.MODEL_BLINN, k.PATH_POLY))
    inputs = [f"s_axis_span_{name}" for name in ("tvalid", "tdata", "tkeep", "tlast")] + ["m_axis_pixel_tready"]
    inputs += [f"s_axil_{name}" for name in ("awvalid", "awaddr", "wvalid", "wdata", "wstrb", "bready")]
    inputs += [f"s_axil_{name}" for name in ("arvalid", "araddr", "rready")]
    outputs = ["s_axis_span_tready", *(f"m_axis_pixel_{name}" for name in ("tvalid", *PAYLOAD))]
    outputs += [f"s_axil_{name}" for name in ("awready", "wready", "bvalid", "bresp")]
    outputs += [f"s_axil_{name}" for name in ("arready", "rvalid", "rdata", "rresp")]
    cocotb.start_soon(no_path(bench, inputs, outputs))
    sent = spans(bench.rng, bench.rng.integers(0, 9, 40))
    told = core.send(sent)
    await bench.until(lambda: core.watch.inside > 0, 200, "a span taken")
    await meddle(core, lambda: core.watch.pixels < len(told.span) // 4)
    await core.compare(sent, told)
