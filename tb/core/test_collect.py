# SPDX-License-Identifier: Apache-2.0
"""shade_collect: the light at nodes, one after the other, into records, to the bit of golden.core.collect."""

import random

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.core import collect
from polyshade.golden.plan import node_walk
from polyshade.golden.poly import pack_records
from polyshade.golden.types import INTENSITY, PLACE, whole
from polyshade.sim.units.spans import structure
from polyshade.sim.units.stream import PLANNED, planned, vectors

from tb.bench import TRAFFIC, Bench, checked, patterns
from tb.core.vectors import number
from tb.runner import simulate


def test_cocotb():
    simulate("shade_collect", {})


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Records of planned spans of all kinds, a node a clock or with gaps; each comes a clock behind its last node.

    Behind a reset the next span begins.
    """
    sent = planned(bench.rng, np.ones(150), None)
    cut = structure(sent, "plan_i")
    nodes = node_walk(*vectors(structure(sent, "job_i"), "normal", "increment"), *(cut[name] for name in PLANNED))
    rows, of = len(nodes.slot), nodes.record
    light = np.stack([bench.signed(k.INTENSITY_W, rows) for _ in range(k.CHANNELS)], axis=-1)
    tag = bench.rng.integers(0, 1 << k.TAG_W, len(nodes.span))
    last = np.append(np.diff(of), 1) != 0
    starts = [*np.flatnonzero(np.append(1, np.diff(nodes.span[of]))).tolist(), rows]
    expected = pack_records(collect(nodes, light), nodes.degree, nodes.count, tag, nodes.more)
    used = pack_records(used_slots(nodes.degree, nodes.count), 0, 0)
    beside = (1 << k.RECORD_DATA_W) - (1 << k.RECORD_COUNT_LSB)

    record = {name: getattr(nodes, name)[of] for name in ("count", "more", "degree", "log2")} | {"tag": tag[of]}
    place = {"slot": nodes.slot, "shared": nodes.shared, "last": last}
    inputs = {
        "light_i": whole(INTENSITY, {"diffuse": light[:, 0], "specular": light[:, 1]}),
        "place_i": whole(PLACE, place | {f"head.{name}": value for name, value in record.items()}),
    }
    entries = [(getattr(bench.dut, name), patterns(getattr(bench.dut, name), v)) for name, v in inputs.items()]
    node, due = 0, None
    while node < rows or due is not None:
        sends, in_reset = node < rows and random.random() >= gap, random.random() < reset
        for port, values in entries:
            port.value = values[node] if sends else random.getrandbits(len(port))
        bench.dut.valid_i.value, bench.dut.rst_i.value = sends, in_reset
        await bench.tick()
        bench.equal(int(bench.dut.valid_o.value), due is not None, f"record {due}: valid_o")
        if due is not None:
            mask = number(used[due]) | beside
            shown = int(bench.dut.record_o.value) & mask
            bench.equal(shown, number(expected[due]) & mask, f"record {due}: record_o", k.RECORD_DATA_W)
        due = int(of[node]) if sends and last[node] and not in_reset else None
        node = next(start for start in starts if start >= node + sends) if in_reset else node + sends


def used_slots(degree: np.ndarray, count: np.ndarray) -> np.ndarray:
    """(R, 2, 4): all bits of the slots that records have nodes in."""
    number = np.where(degree == k.DEGREE_DIRECT, count, degree + 1)
    bits = np.where(np.arange(k.NODE_COUNT) < number[:, None], -1, 0)
    return np.stack([bits] * k.CHANNELS, axis=1)
