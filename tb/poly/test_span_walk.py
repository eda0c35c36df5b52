"""shade_span_walk: spans in, pixel tokens out, as golden.poly.span_walk orders them; a credit each."""

import random

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.poly import span_log2, span_walk

from tb.bench import Bench, Mismatch, Source, checked, no_path
from tb.poly.vectors import Spans, mixed_spans, spans
from tb.runner import points, simulate


@points({}, {"LOG2_MAX": 6, "CREDIT_LOG2": 2})
def test_cocotb(point):
    simulate("shade_span_walk", point)


LATENCY = 2  # clocks from a span to its first token


class Tokens:
    """Reads the tokens, on whatever clock they come, and gives the credits back.

    ``thrift``: probability of a clock in which no credit is given back, though one is due; ``given``: the clocks in
    which one was. A token for which there was no credit raises Mismatch.
    """

    PORTS = ("first_o", "last_o", "degree_o", "t_o", "log2_o", "tag_o", "nodes_o")

    def __init__(self, bench: Bench, thrift: float = 0.0):
        self.bench, self.thrift = bench, thrift
        self.capacity = 1 << bench.parameter("CREDIT_LOG2")
        self.spent = 0
        self.tokens: list[dict[str, int]] = []
        self.clocks: list[int] = []
        self.given: list[int] = []
        cocotb.start_soon(self._run())

    def forget(self) -> None:
        """Start again with no tokens."""
        self.tokens.clear()
        self.clocks.clear()

    async def _run(self) -> None:
        dut = self.bench.dut
        while True:
            credit = self.spent > 0 and random.random() >= self.thrift
            dut.credit_i.value = credit
            await self.bench.tick()
            if credit:
                self.spent -= 1
                self.given.append(self.bench.clock)
            if int(dut.valid_o.value):
                self.tokens.append({name: int(getattr(dut, name).value) for name in self.PORTS})
                self.clocks.append(self.bench.clock)
                self.spent += 1
            if int(dut.rst_i.value):
                self.spent = 0
            if self.spent > self.capacity:
                raise Mismatch(f"a token without a credit (clock {self.bench.clock})")


def setup(bench: Bench, thrift: float = 0.0) -> tuple[Source, Tokens]:
    """Something that sends spans, and something that reads tokens."""
    source = Source(bench, "s_axis_span_tvalid", "s_axis_span_tready", ["s_axis_span_tdata"])
    return source, Tokens(bench, thrift)


def node(packed: int, channel: int, index: int) -> int:
    """The bits of a node."""
    return packed >> k.INTENSITY_W * (k.NODE_COUNT * channel + index) & (1 << k.INTENSITY_W) - 1


async def compare(bench: Bench, sent: Spans, tokens: Tokens) -> None:
    """Wait for all tokens of the spans and compare them; no more may come. Compare the errors as well."""
    log2_max = bench.parameter("LOG2_MAX")
    of, j = span_walk(sent.degree, sent.count, log2_max=log2_max)
    await bench.until(lambda: len(tokens.tokens) >= of.size, 20 * of.size + 200, f"{of.size} tokens")
    await bench.tick(20)
    bench.equal(len(tokens.tokens), of.size, "number of tokens")
    direct = sent.degree[of] == k.DEGREE_DIRECT
    log2 = span_log2(sent.count)[of]
    expected = {
        "first_o": (j == 0) | direct,
        "last_o": (j == sent.count[of] - 1) & ~sent.more[of],
        "degree_o": sent.degree[of],
        "t_o": j << k.T_F - log2,
        "log2_o": log2,
        "tag_o": sent.tag[of],
    }
    texts = sent.texts()
    for index, token in enumerate(tokens.tokens):
        what = f"pixel {j[index]} of {texts[of[index]]}"
        for name, values in expected.items():
            bench.equal(token[name], int(values[index]), f"{what}: {name}", bench.bits(name))
        for channel in range(k.CHANNELS):
            for place in range(1 if direct[index] else k.NODE_COUNT):  # a direct pixel has one node, in first place
                wanted = int(sent.nodes[of[index], channel, j[index] if direct[index] else place])
                wanted &= (1 << k.INTENSITY_W) - 1
                actual = node(token["nodes_o"], channel, place)
                bench.equal(actual, wanted, f"{what}: node {place + 1} of channel {channel}", k.INTENSITY_W)
    errors = sent.errors(bench)
    bench.equal(int(bench.dut.error_o.value), int(np.bitwise_or.reduce(errors)), "error_o", k.ERROR_W)
    bench.equal(int(bench.dut.error_count_o.value), np.count_nonzero(errors), "error_count_o")


@checked(gap=[0.0, 0.5], thrift=[0.0, 0.7])
async def walk(bench: Bench, gap: float, thrift: float) -> None:
    """Spans of all degrees and lengths, faulty ones among them; credits that come back at once or late."""
    sent = mixed_spans(bench, 200, faults=0.2)
    source, tokens = setup(bench, thrift)
    await source.send(sent.beats(), gap)
    await compare(bench, sent, tokens)


@checked(gap=[0.0, 0.3])
async def timing(bench: Bench, gap: float) -> None:
    """With credits, a token a clock and no bubble, not between spans of any length; a refused span costs one clock."""
    sent = mixed_spans(bench, 200, faults=0.2)
    source, tokens = setup(bench)
    await source.send(sent.beats(), gap)
    await compare(bench, sent, tokens)
    of, j = span_walk(sent.degree, sent.count, log2_max=bench.parameter("LOG2_MAX"))
    for index, clock in enumerate(tokens.clocks):
        bench.equal(clock - source.clocks[of[index]], LATENCY + int(j[index]), f"latency of token {index}")
    if not gap:
        span = int(sent.clocks(bench)[:-1].sum())
        bench.equal(source.clocks[-1] - source.clocks[0], span, "clocks from the first span to the last")


@checked()
async def lengths(bench: Bench) -> None:
    """The longest spans that are allowed, and those around the powers of two."""
    limit = 1 << bench.parameter("LOG2_MAX")
    count = np.array([limit, limit - 1, *(1 + (1 << np.arange(6))), *(2 + (1 << np.arange(6)))])
    sent = spans(bench, np.arange(count.size) % 3 + 1, np.minimum(count, limit))
    source, tokens = setup(bench)
    await source.send(sent.beats())
    await compare(bench, sent, tokens)


@checked()
async def starved(bench: Bench) -> None:
    """Without credits it stops after as many tokens as there were; then each credit releases one, 2 clocks later."""
    source, tokens = setup(bench, thrift=1.0)
    await source.send(spans(bench, k.DEGREE_CUBIC, [tokens.capacity + 20]).beats())
    await bench.tick(2 * tokens.capacity + 10)
    bench.equal(len(tokens.tokens), tokens.capacity, "tokens without a credit given back")
    bench.equal(int(bench.dut.s_axis_span_tready.value), 0, "s_axis_span_tready")
    tokens.thrift = 0.8
    await bench.until(lambda: len(tokens.tokens) == tokens.capacity + 20, 1000, "all tokens")
    for given, clock in zip(tokens.given[:20], tokens.clocks[tokens.capacity :], strict=True):
        bench.equal(clock - given, 2, "clocks from a credit to its token")


@checked()
async def errors(bench: Bench) -> None:
    """Every fault sets its own bit, which stays; the counter counts it; the span behind is unharmed."""
    source, tokens = setup(bench)
    limit = 1 << bench.parameter("LOG2_MAX")
    faults = [(degree, count) for degree in range(4) for count in (0, limit + 1, (1 << k.COUNT_W) - 1)]
    faults += [(k.DEGREE_DIRECT, count) for count in (5, 8, limit)]
    for degree, count in faults:
        sent = spans(bench, [degree, k.DEGREE_LINEAR], [count, 3])
        tokens.forget()
        await bench.reset()
        await source.send(sent.beats())
        await compare(bench, sent, tokens)


@checked()
async def counter(bench: Bench) -> None:
    """The counter of refused spans stops at its largest value."""
    dut, largest = bench.dut, (1 << 16) - 1
    dut.s_axis_span_tdata.value = spans(bench, k.DEGREE_CUBIC, [0]).beats()[0][0]
    dut.s_axis_span_tvalid.value = 1
    await bench.tick()
    for clocks in (100, largest - 101, 1, 1, 1, 50):
        before = int(dut.error_count_o.value)
        await bench.tick(clocks)
        bench.equal(int(dut.error_count_o.value), min(before + clocks, largest), "error_count_o")


@checked()
async def reset(bench: Bench) -> None:
    """A reset in the middle of a span: no token follows, errors are forgotten, all credits are there again."""
    source, tokens = setup(bench, thrift=0.5)
    for _ in range(20):
        sending = cocotb.start_soon(source.send(mixed_spans(bench, 50, faults=0.3).beats()))
        await bench.tick(random.randrange(5, 60))
        sending.cancel()
        source.withdraw()
        await bench.reset(clocks=1)
        await bench.tick()
        bench.equal(int(bench.dut.valid_o.value), 0, "valid_o")
        bench.equal(int(bench.dut.s_axis_span_tready.value), 1, "s_axis_span_tready")
        tokens.forget()
        sent = mixed_spans(bench, 5)
        await source.send(sent.beats())
        await compare(bench, sent, tokens)


@checked()
async def registered(bench: Bench) -> None:
    """No input reaches an output in the same clock."""
    inputs = ["s_axis_span_tvalid", "s_axis_span_tdata", "credit_i"]
    outputs = ["s_axis_span_tready", "valid_o", "error_o", "error_count_o", *Tokens.PORTS]
    cocotb.start_soon(no_path(bench, inputs, outputs))
    sent = mixed_spans(bench, 40, faults=0.2)
    source, tokens = setup(bench, thrift=0.3)
    await source.send(sent.beats(), 0.3)
    await compare(bench, sent, tokens)
