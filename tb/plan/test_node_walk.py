# SPDX-License-Identifier: Apache-2.0
"""shade_node_walk: planned spans in, the normals at their nodes out, as golden.plan.node_walk has them; credits."""

import random
from collections import deque

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.plan import node_walk
from polyshade.golden.poly import span_log2
from polyshade.golden.types import JOB, NODE, PLAN, whole

from tb.bench import Bench, Mismatch, Source, checked, no_path, scramble
from tb.runner import points, simulate


@points({}, {"CREDIT_LOG2": 1}, {"FOLD": 6})
def test_cocotb(point):
    simulate("shade_node_walk", point)


PLANNED = ("main", "log2", "degree", "last_count", "last_log2", "last_degree")


class Spans(Source):
    """Sends plans, and offers the span of the oldest one until it is taken."""

    def __init__(self, bench: Bench):
        super().__init__(bench, "valid_i", "ready_o", ["plan_i"])
        self.jobs: deque[int] = deque()
        cocotb.start_soon(self._run())

    async def send(self, words: list[tuple[int, int]], gap: float = 0.0) -> None:
        """Jobs and plans."""
        self.jobs.extend(job for job, _ in words)
        await super().send([(plan,) for _, plan in words], gap)

    async def _run(self) -> None:
        dut = self.bench.dut
        while True:
            if self.jobs:
                dut.job_i.value = self.jobs[0]
            else:
                scramble(dut.job_i)
            await self.bench.tick()
            if int(dut.rst_i.value):
                self.jobs.clear()
            elif int(dut.job_taken_o.value):
                self.jobs.popleft()


class Nodes:
    """Reads the nodes and gives a record's credit back, but not in a clock of the probability ``thrift``."""

    def __init__(self, bench: Bench, thrift: float = 0.0):
        self.bench, self.thrift = bench, thrift
        self.capacity = 1 << bench.parameter("CREDIT_LOG2")
        self.spent, self.first = 0, 1  # first: the next node begins a record
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
                node = int(dut.node_o.value)
                node = {f.name: node >> f.lsb & (1 << f.width) - 1 for f in NODE.leaves()}
                self.spent += self.first
                self.first = node["place.last"]
                self.nodes.append(node)
                self.clocks.append(self.bench.clock)
            if int(dut.rst_i.value):
                self.spent, self.first = 0, 1
            if self.spent > self.capacity:
                raise Mismatch(f"a record without a credit (clock {self.bench.clock})")


def setup(bench: Bench, thrift: float = 0.0) -> tuple[Spans, Nodes]:
    """Something that sends planned spans, and something that reads nodes."""
    if bench.parameter("FOLD") > 1:
        cocotb.start_soon(phases(bench))
    return Spans(bench), Nodes(bench, thrift)


async def phases(bench: Bench) -> None:
    """Count the phases, from 0 behind a reset."""
    phase, fold = 0, bench.parameter("FOLD")
    while True:
        bench.dut.phase_i.value = phase
        await bench.tick()
        phase = 0 if int(bench.dut.rst_i.value) else (phase + 1) % fold


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


def words(sent: dict[str, np.ndarray]) -> list[tuple[int, int]]:
    """The bits of every span at the ports: job and plan."""
    vectors = {
        f"{name}.{axis}": sent[name[0].replace("i", "g")][:, i]
        for name in ("normal", "increment") for i, axis in enumerate("xyz")
    }  # fmt: skip
    jobs = whole(JOB, vectors | {name: sent[name] for name in ("flat", "tag")})
    plans = whole(PLAN, {name: sent[name] for name in PLANNED} | {"split": sent["main"] != 0})
    return list(zip(jobs, plans, strict=True))


async def compare(bench: Bench, sent: dict[str, np.ndarray], nodes: Nodes) -> None:
    """Wait for all nodes of the spans and compare them; no more may come."""
    walked = node_walk(*(sent[name] for name in list(sent)[:8]))
    total, record = len(walked.slot), walked.record
    patience = 20 * total * bench.parameter("FOLD") + 100
    await bench.until(lambda: len(nodes.nodes) >= total, patience, f"{total} nodes")
    await bench.tick(10)
    bench.equal(len(nodes.nodes), total, "number of nodes")
    last = np.append(np.diff(record), 1) != 0
    span = walked.span[record]
    head = {
        "count": walked.count[record], "more": walked.more[record], "degree": walked.degree[record],
        "tag": sent["tag"][span], "log2": walked.log2[record],
    }  # fmt: skip
    place = {"slot": walked.slot, "shared": walked.shared, "last": last}
    expected = {f"normal.{axis}": walked.vector[:, i] & (1 << k.INTENSITY_W) - 1 for i, axis in enumerate("xyz")}
    expected |= {"flat": sent["flat"][span]} | {f"place.{name}": value for name, value in place.items()}
    expected |= {f"place.head.{name}": value for name, value in head.items()}
    for index, node in enumerate(nodes.nodes):
        what = f"node {index} (span {span[index]}, record {record[index]})"
        for name, values in expected.items():
            bench.equal(node[name], int(values[index]), f"{what}: {name}")


@checked(gap=[0.0, 0.5], thrift=[0.0, 0.7])
async def walk(bench: Bench, gap: float, thrift: float) -> None:
    """Spans of all kinds; credits that come back at once or late."""
    sent = spans(bench, 150)
    source, nodes = setup(bench, thrift)
    await source.send(words(sent), gap)
    await compare(bench, sent, nodes)


@checked()
async def limits(bench: Bench) -> None:
    """Normals at the ends of S2.29 and around the last one that is not saturated."""
    most, half = 1 << k.STEP_W - 1, 1 << k.STEP_F - k.NODE_F - 1
    ends = [most - 1, most - half, most - half - 1, most - 2 * half, -most, -most + half, -most + half - 1, 0]
    sent = spans(bench, 8 * len(ends))
    sent["main"][:], sent["last_degree"][:], sent["last_count"][:] = 0, k.DEGREE_DIRECT, 1
    sent["last_log2"] = span_log2(sent["last_count"])
    for axis in range(3):
        sent["n"][:, axis] = bench.rng.permutation(np.repeat(ends, 8))
    source, nodes = setup(bench)
    await source.send(words(sent))
    await compare(bench, sent, nodes)


@checked()
async def timing(bench: Bench) -> None:
    """A node in FOLD clocks, no bubble between records nor between spans, LATENCY_NODE_WALK after the span."""
    if bench.parameter("CREDIT_LOG2") < 3:  # records of one node take a credit a clock
        bench.checks += 1
        return
    sent = spans(bench, 60)
    sent["main"][:20], sent["last_degree"][:20], sent["last_count"][:20] = 0, k.DEGREE_DIRECT, 1
    source, nodes = setup(bench)
    await source.send(words(sent))
    await compare(bench, sent, nodes)
    pace, wait = bench.parameter("FOLD"), nodes.clocks[0] - source.clocks[0] - k.LATENCY_NODE_WALK
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
    await bench.tick(8 * capacity * bench.parameter("FOLD") + 20)
    bench.equal(nodes.spent, capacity, "records without a credit back")
    nodes.thrift = 0.0
    await compare(bench, sent, nodes)


@checked()
async def reset(bench: Bench) -> None:
    """Reset in the middle of a span: nothing of it remains, the credits are back."""
    source, nodes = setup(bench, thrift=1.0)
    sent = spans(bench, 10)
    sent["main"][0] = 9
    task = cocotb.start_soon(source.send(words(sent)))
    await bench.tick(8 + bench.parameter("FOLD"))
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
    """No node follows an input within a clock; ready_o may follow plan_i, which stands behind a FIFO's register."""
    source, nodes = setup(bench, thrift=0.5)
    cocotb.start_soon(no_path(bench, ["job_i", "credit_i"], ["ready_o", "job_taken_o", "valid_o", "node_o"]))
    sent = spans(bench, 40)
    await source.send(words(sent), 0.3)
    await compare(bench, sent, nodes)
