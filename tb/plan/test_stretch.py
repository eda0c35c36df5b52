# SPDX-License-Identifier: Apache-2.0
"""shade_stretch: planned spans in, their stretches out, as golden.plan.stretch has them."""

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.plan import stretch
from polyshade.golden.types import STRETCH

from tb.bench import PRESSURE, Bench, Sink, checked
from tb.plan.test_node_walk import PLANNED, Spans, spans, words
from tb.runner import simulate

MASK = (1 << k.STEP_W) - 1


def test_cocotb():
    simulate("shade_stretch", {})


def setup(bench: Bench, stall: float = 0.0) -> tuple[Spans, Sink]:
    """Something that sends planned spans, and something that takes stretches."""
    return Spans(bench), Sink(bench, "valid_o", "ready_i", ["stretch_o"], stall)


async def compare(bench: Bench, sent: dict[str, np.ndarray], sink: Sink) -> None:
    """Wait for all stretches and compare them; no more may come."""
    wanted = stretch(*(sent[name] for name in PLANNED))
    owner, total = wanted.pop("span"), len(wanted["degree"])
    await bench.until(lambda: len(sink.words) >= total, 20 * total + 100, f"{total} stretches")
    await bench.tick(10)
    bench.equal(len(sink.words), total, "number of stretches")
    step = sent["g"][owner] << wanted.pop("step_log2")[:, None]
    first = np.append(1, np.diff(owner)) != 0
    wanted |= {f"normal.{axis}": sent["n"][owner, i] & MASK for i, axis in enumerate("xyz")}
    wanted |= {f"step.{axis}": step[:, i] & MASK for i, axis in enumerate("xyz")}
    wanted |= {"tag": sent["tag"][owner], "flat": sent["flat"][owner], "fresh": first, "more": np.append(~first[1:], 0)}
    wanted |= {"single": wanted["records"] == 1}
    leaves = list(STRETCH.leaves())
    bench.equal({leaf.name for leaf in leaves}, set(wanted), "fields")
    for index, (word,) in enumerate(sink.words):
        for leaf in leaves:
            value = word >> leaf.lsb & (1 << leaf.width) - 1
            bench.equal(value, int(wanted[leaf.name][index]), f"stretch {index}: {leaf.name}")


@checked(**PRESSURE)
async def traffic(bench: Bench, gap: float, stall: float) -> None:
    """Spans of all kinds; without pauses a stretch a clock, 2 clocks behind its span."""
    sent = spans(bench, 200)
    source, sink = setup(bench, stall)
    await source.send(words(sent), gap)
    await compare(bench, sent, sink)
    if not gap and not stall:
        bench.equal(sink.clocks[-1] - sink.clocks[0] + 1, len(sink.clocks), "clocks of all stretches")
        bench.equal(sink.clocks[-1] - source.clocks[-1], 2, "latency of the last one")


@checked()
async def reset(bench: Bench) -> None:
    """Reset between the two stretches of a span: the next span begins anew."""
    source, sink = setup(bench)
    for clocks in range(1, 8):
        sent = spans(bench, 10)
        sent["main"][:] = 2
        task = cocotb.start_soon(source.send(words(sent)))
        await bench.tick(clocks)
        task.cancel()
        source.withdraw()
        await bench.reset(clocks=1)
        await bench.tick()
        sink.forget()
        sent = spans(bench, 10)
        await source.send(words(sent))
        await compare(bench, sent, sink)
