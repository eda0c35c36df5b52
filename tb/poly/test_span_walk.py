# SPDX-License-Identifier: Apache-2.0
"""shade_span_walk: spans in, pixel tokens out, as golden.poly.span_walk orders them; a credit each."""

import random

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import types
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

    FIELDS = tuple(types.TOKEN.leaves())

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
                token = int(dut.token_o.value)
                self.tokens.append({f.name: token >> f.lsb & (1 << f.width) - 1 for f in self.FIELDS})
                self.clocks.append(self.bench.clock)
                self.spent += 1
            if int(dut.rst_i.value):
                self.spent = 0
            if self.spent > self.capacity:
                raise Mismatch(f"a token without a credit (clock {self.bench.clock})")


def setup(bench: Bench, thrift: float = 0.0) -> tuple[Source, Tokens]:
    """Something that sends spans, and something that reads tokens."""
    return Source(bench, "valid_i", "ready_o", ["record_i"]), Tokens(bench, thrift)


async def compare(bench: Bench, sent: Spans, tokens: Tokens) -> None:
    """Wait for all tokens of the spans and compare them; no more may come."""
    of, j = span_walk(sent.count)
    await bench.until(lambda: len(tokens.tokens) >= of.size, 20 * of.size + 200, f"{of.size} tokens")
    await bench.tick(20)
    bench.equal(len(tokens.tokens), of.size, "number of tokens")
    direct = sent.degree[of] == k.DEGREE_DIRECT
    log2 = span_log2(sent.count)[of]
    expected = {
        "first": (j == 0) | direct,
        "last": (j == sent.count[of] - 1) & ~sent.more[of],
        "degree": sent.degree[of],
        "t": j << k.T_F - log2,
        "log2": log2,
        "tag": sent.tag[of],
    }
    texts = sent.texts()
    for index, token in enumerate(tokens.tokens):
        what = f"pixel {j[index]} of {texts[of[index]]}"
        for name, values in expected.items():
            bench.equal(token[name], int(values[index]), f"{what}: {name}")
        for channel, kind in enumerate(("diffuse", "specular")):
            for place in range(1 if direct[index] else k.NODE_COUNT):  # a direct pixel has one node, in first place
                wanted = int(sent.nodes[of[index], channel, j[index] if direct[index] else place])
                wanted &= (1 << k.INTENSITY_W) - 1
                bench.equal(token[f"{kind}.n{place}"], wanted, f"{what}: node {place} of {kind} light", k.INTENSITY_W)


@checked(gap=[0.0, 0.5], thrift=[0.0, 0.7])
async def walk(bench: Bench, gap: float, thrift: float) -> None:
    """Spans of all degrees and lengths; credits that come back at once or late."""
    sent = mixed_spans(bench, 200)
    source, tokens = setup(bench, thrift)
    await source.send(sent.beats(), gap)
    await compare(bench, sent, tokens)


@checked(gap=[0.0, 0.3])
async def timing(bench: Bench, gap: float) -> None:
    """With credits, a token a clock and no bubble, not between spans of any length."""
    sent = mixed_spans(bench, 200)
    source, tokens = setup(bench)
    await source.send(sent.beats(), gap)
    await compare(bench, sent, tokens)
    of, j = span_walk(sent.count)
    for index, clock in enumerate(tokens.clocks):
        bench.equal(clock - source.clocks[of[index]], LATENCY + int(j[index]), f"latency of token {index}")
    if not gap:
        span = int(sent.count[:-1].sum())
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
    bench.equal(int(bench.dut.ready_o.value), 0, "ready_o")
    tokens.thrift = 0.8
    await bench.until(lambda: len(tokens.tokens) == tokens.capacity + 20, 1000, "all tokens")
    for given, clock in zip(tokens.given[:20], tokens.clocks[tokens.capacity :], strict=True):
        bench.equal(clock - given, 2, "clocks from a credit to its token")


@checked()
async def reset(bench: Bench) -> None:
    """A reset in the middle of a span: no token follows, all credits are there again."""
    source, tokens = setup(bench, thrift=0.5)
    for _ in range(20):
        sending = cocotb.start_soon(source.send(mixed_spans(bench, 50).beats()))
        await bench.tick(random.randrange(5, 60))
        sending.cancel()
        source.withdraw()
        await bench.reset(clocks=1)
        await bench.tick()
        bench.equal(int(bench.dut.valid_o.value), 0, "valid_o")
        bench.equal(int(bench.dut.ready_o.value), 1, "ready_o")
        tokens.forget()
        sent = mixed_spans(bench, 5)
        await source.send(sent.beats())
        await compare(bench, sent, tokens)


@checked()
async def registered(bench: Bench) -> None:
    """No input reaches an output in the same clock."""
    inputs = ["valid_i", "record_i", "credit_i"]
    outputs = ["ready_o", "valid_o", "token_o"]
    cocotb.start_soon(no_path(bench, inputs, outputs))
    sent = mixed_spans(bench, 40)
    source, tokens = setup(bench, thrift=0.3)
    await source.send(sent.beats(), 0.3)
    await compare(bench, sent, tokens)
