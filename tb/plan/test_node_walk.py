"""shade_node_walk: planned spans in, the normals at their nodes out, as golden.plan.node_walk has them; credits."""

import random

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.plan import node_walk
from polyshade.golden.poly import span_log2

from tb.bench import Bench, Mismatch, Source, checked, no_path
from tb.runner import points, simulate


@points({}, {"CREDIT_LOG2": 1}, {"PACE": 6})
def test_cocotb(point):
    simulate("shade_node_walk", point)


PLAN = ("main_i", "log2_i", "degree_i", "last_count_i", "last_log2_i", "last_degree_i")
PAYLOAD = ("n_i", "g_i", *PLAN, "flat_i", "tag_i", "split_i")
NODE = ("x_o", "y_o", "z_o", "slot_o", "first_o", "shared_o", "last_o", "flat_o", "tag_o")
RECORD = ("count_o", "degree_o", "more_o")


class Nodes:
    """Reads the nodes and gives a record's credit back, but not in a clock of the probability ``thrift``."""

    def __init__(self, bench: Bench, thrift: float = 0.0):
        self.bench, self.thrift = bench, thrift
        self.capacity = 1 << bench.parameter("CREDIT_LOG2")
        self.spent = 0
        self.nodes: list[dict[str, int]] = []
        self.clocks: list[int] = []
        cocotb.start_soon(self._run())

    async def _run(self) -> None:
        dut = self.bench.dut
        while True:
            credit = self.spent > 0 and random.random() >= self.thrift
            dut.credit_i.value = credit
            await self.bench.tick()
            self.spent -= credit
            if int(dut.valid_o.value):
                self.nodes.append({name: int(getattr(dut, name).value) for name in (*NODE, *RECORD)})
                self.clocks.append(self.bench.clock)
                self.spent += self.nodes[-1]["first_o"]
            if int(dut.rst_i.value):
                self.spent = 0
            if self.spent > self.capacity:
                raise Mismatch(f"a record without a credit (clock {self.bench.clock})")


def setup(bench: Bench, thrift: float = 0.0) -> tuple[Source, Nodes]:
    """Something that sends planned spans, and something that reads nodes."""
    return Source(bench, "valid_i", "ready_o", PAYLOAD), Nodes(bench, thrift)


def spans(bench: Bench, rows: int, longest: int = 60) -> dict[str, np.ndarray]:
    """Planned spans of all kinds: one record or several, of any degree; normals with any 32 bits."""
    rng = bench.rng
    log2 = rng.integers(2, 5, rows)
    degree = rng.integers(0, 4, rows)
    log2[degree == k.DEGREE_DIRECT] = 2
    main = np.where(rng.random(rows) < 0.5, 0, rng.integers(0, max(longest >> 3, 1), rows))
    direct = (main > 0) & (degree == k.DEGREE_DIRECT)  # then all of a span's records are
    last_degree = np.where(direct, k.DEGREE_DIRECT, rng.integers(0, 4, rows))
    first = (main > 0) & (degree != k.DEGREE_DIRECT)  # the last record shares its first node
    low = np.where(last_degree == k.DEGREE_DIRECT, 1 + first, last_degree + 2)
    low = np.where(last_degree == k.DEGREE_CUBIC, 5, low)
    high = np.where(last_degree == k.DEGREE_DIRECT, 4, np.maximum(low, (1 << log2) + 1))
    last_count = rng.integers(low, high, endpoint=True)
    return {
        "n": rng.integers(-(1 << 31), 1 << 31, (rows, 3)),
        "g": rng.integers(-(1 << 31), 1 << 31, (rows, 3)) >> rng.integers(0, 31, (rows, 1)),
        "main": main, "log2": log2, "degree": degree, "last_count": last_count,
        "last_log2": span_log2(last_count), "last_degree": last_degree,
        "flat": rng.integers(0, 2, rows), "tag": rng.integers(0, 1 << k.TAG_W, rows),
    }  # fmt: skip


def words(sent: dict[str, np.ndarray]) -> list[tuple[int, ...]]:
    """The bits of every span at the ports."""
    mask = (1 << k.STEP_W) - 1
    vectors = [
        [sum((component & mask) << k.STEP_W * c for c, component in enumerate(row)) for row in sent[name].tolist()]
        for name in "ng"
    ]
    split = (sent["main"] != 0).tolist()
    return list(zip(*vectors, *(sent[name].tolist() for name in list(sent)[2:]), split, strict=True))


async def compare(bench: Bench, sent: dict[str, np.ndarray], nodes: Nodes) -> None:
    """Wait for all nodes of the spans and compare them; no more may come."""
    walked = node_walk(*(sent[name] for name in list(sent)[:8]))
    total, record = len(walked.slot), walked.record
    patience = 20 * total * bench.parameter("PACE") + 100
    await bench.until(lambda: len(nodes.nodes) >= total, patience, f"{total} nodes")
    await bench.tick(10)
    bench.equal(len(nodes.nodes), total, "number of nodes")
    last = np.append(np.diff(record), 1) != 0
    span = walked.span[record]
    expected = dict(zip(("x_o", "y_o", "z_o"), (walked.vector & (1 << k.INTENSITY_W) - 1).T, strict=True)) | {
        "slot_o": walked.slot, "first_o": np.append(1, last[:-1]), "shared_o": walked.shared, "last_o": last,
        "flat_o": sent["flat"][span], "tag_o": sent["tag"][span],
        "count_o": walked.count[record], "degree_o": walked.degree[record], "more_o": walked.more[record],
    }  # fmt: skip
    for index, node in enumerate(nodes.nodes):
        what = f"node {index} (span {span[index]}, record {record[index]})"
        for name, values in expected.items():
            bench.equal(node[name], int(values[index]), f"{what}: {name}", bench.bits(name))


@checked(gap=[0.0, 0.5], thrift=[0.0, 0.7])
async def walk(bench: Bench, gap: float, thrift: float) -> None:
    """Spans of all kinds; credits that come back at once or late."""
    sent = spans(bench, 150)
    source, nodes = setup(bench, thrift)
    await source.send(words(sent), gap)
    await compare(bench, sent, nodes)


@checked()
async def timing(bench: Bench) -> None:
    """A node in PACE clocks, no bubble between records nor between spans, LATENCY_NODE_WALK after the span."""
    if bench.parameter("CREDIT_LOG2") < 3:  # records of one node take a credit a clock
        bench.checks += 1
        return
    sent = spans(bench, 60)
    sent["main"][:20], sent["last_degree"][:20], sent["last_count"][:20] = 0, k.DEGREE_DIRECT, 1
    source, nodes = setup(bench)
    await source.send(words(sent))
    await compare(bench, sent, nodes)
    pace, wait = bench.parameter("PACE"), nodes.clocks[0] - source.clocks[0] - k.LATENCY_NODE_WALK
    bench.equal(0 <= wait < pace, True, "clocks from a span to its first node, but for those to its turn")
    taken = pace * (len(nodes.clocks) - 1)
    bench.equal(nodes.clocks[-1] - nodes.clocks[0], taken, "clocks from the first node to the last")


@checked()
async def credits(bench: Bench) -> None:
    """As many records as there are credits, and one more for each that comes back."""
    capacity = 1 << bench.parameter("CREDIT_LOG2")
    sent = spans(bench, 2 * capacity)
    source, nodes = setup(bench, thrift=1.0)
    cocotb.start_soon(source.send(words(sent)))
    await bench.tick(8 * capacity * bench.parameter("PACE") + 20)
    bench.equal(sum(node["first_o"] for node in nodes.nodes), capacity, "records without a credit back")
    nodes.thrift = 0.0
    await compare(bench, sent, nodes)


@checked()
async def reset(bench: Bench) -> None:
    """Reset in the middle of a span: nothing of it remains, the credits are back."""
    source, nodes = setup(bench, thrift=1.0)
    sent = spans(bench, 10)
    sent["main"][0] = 9
    task = cocotb.start_soon(source.send(words(sent)))
    await bench.tick(8 + bench.parameter("PACE"))
    task.cancel()
    source.withdraw()
    await bench.reset()
    nodes.nodes.clear()
    await bench.tick(10)
    bench.equal(len(nodes.nodes), 0, "nodes after reset")
    nodes.thrift = 0.0
    sent = spans(bench, 20)
    await source.send(words(sent))
    await compare(bench, sent, nodes)


@checked()
async def paths(bench: Bench) -> None:
    """No node follows an input within a clock; ready_o may follow split_i, which stands behind a FIFO's register."""
    source, nodes = setup(bench, thrift=0.5)
    inputs = ["n_i", "g_i", "tag_i", "flat_i", "main_i", "last_count_i", "credit_i"]
    cocotb.start_soon(no_path(bench, inputs, ["ready_o", "valid_o", *NODE, *RECORD]))
    sent = spans(bench, 40)
    await source.send(words(sent), 0.3)
    await compare(bench, sent, nodes)
