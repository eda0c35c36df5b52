# SPDX-License-Identifier: Apache-2.0
"""shade_door: good spans to the lane with least to draw; every fault told once, and nothing of it comes in."""

import random

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.types import TOLD
from polyshade.sim.units.spans import spans

from tb.bench import Bench, Source, checked, no_path
from tb.core.vectors import set_draw
from tb.runner import points, simulate

SPAN = "s_axis_span_"
WHOLE = (1 << k.SPAN_DATA_W // 8) - 1
V1 = {"path": k.PATH_NORMALS, "variant": k.VARIANT_V1}


@points({}, {"LANES": 4})
def test_cocotb(point):
    simulate("shade_door", point)


class Lanes:
    """Ready lanes at random; ``given``: the spans and their lanes; ``told``: told_o, counted."""

    def __init__(self, bench: Bench, ready: float = 1.0):
        self.bench, self.ready, self.lanes = bench, ready, bench.parameter("LANES")
        self.given: list[tuple[int, int]] = []
        self.clocks: list[int] = []
        self.told = dict.fromkeys((leaf.name.removeprefix("error.") for leaf in TOLD.leaves()), 0)
        bench.dut.hold_i.value = 0
        cocotb.start_soon(self._run())

    async def _run(self) -> None:
        dut, best, left = self.bench.dut, 0, [0] * self.lanes
        while True:
            room, ready = (sum((random.random() < self.ready) << lane for lane in range(self.lanes)) for _ in "rr")
            ready &= room
            given = sum((n > 0 and random.random() < self.ready) << lane for lane, n in enumerate(left))
            dut.room_i.value, dut.ready_i.value, dut.given_i.value = room, ready, given
            await self.bench.tick()
            if int(dut.rst_i.value):
                best, left = 0, [0] * self.lanes
                continue
            valid, loads = int(dut.valid_o.value), [(not room >> lane & 1, n) for lane, n in enumerate(left)]
            self.bench.equal(
                valid in (0, (1 << best) & ready), True, "a span for the lane with least to draw, if ready"
            )
            left = [n - (given >> lane & 1) for lane, n in enumerate(left)]
            if valid:
                self.given.append((int(dut.span_o.value), best))
                self.clocks.append(self.bench.clock)
                left[best] += self.given[-1][0] >> k.SPAN_COUNT_LSB & (1 << k.COUNT_W) - 1
            best = loads.index(min(loads))
            told = int(dut.told_o.value)
            for leaf in TOLD.leaves():
                self.told[leaf.name.removeprefix("error.")] += told >> leaf.lsb & 1


def setup(bench: Bench, ready: float = 1.0, **draw: int) -> tuple[Source, Lanes]:
    """Something that sends beats, and lanes."""
    set_draw(bench, draw)
    return Source(bench, SPAN + "tvalid", SPAN + "tready", [SPAN + n for n in ("tdata", "tkeep", "tlast")]), Lanes(
        bench, ready
    )


@checked(gap=[0.0, 0.5], ready=[1.0, 0.5, 0.1])
async def traffic(bench: Bench, gap: float, ready: float) -> None:
    """Spans of all lengths, torn ones among them: what is good goes on unaltered, in order."""
    source, lanes = setup(bench, ready, **V1, threshold=-1)
    count = bench.rng.choice([0, 1, 3, 4, 13, 14, k.PIXELS_MAX, k.PIXELS_MAX + 1, (1 << k.COUNT_W) - 1], 150)
    sent, told = spans(bench.rng, count), dict.fromkeys(lanes.told, 0)
    beats, good = [], []
    kinds = bench.rng.choice(4, 150, p=[0.7, 0.1, 0.1, 0.1]).tolist()
    for (data,), n, how in zip(sent.words(), count.tolist(), kinds, strict=True):
        more = [(random.getrandbits(k.SPAN_DATA_W), WHOLE, i == 2) for i in range(3)] if how == 1 else []
        beats += [(data, WHOLE ^ (how == 2) << random.randrange(32), int(not more)), *more]
        whole, long = how in (0, 3), n > k.PIXELS_MAX
        if whole and n and not long:
            good.append(data)
        told["packet"] += not whole
        told["empty"] += whole and not n
        told["too_long"] += whole and long
        told["metric"] += whole and 0 < n <= k.PIXELS_MAX and not 4 <= n <= 13
        told["threshold"] += whole and 0 < n <= k.PIXELS_MAX
    told |= {"good": len(good), "bad": len(count) - len(good)}
    await source.send(beats, gap)
    await bench.until(lambda: len(lanes.given) >= len(good), 1000, "all spans")
    await bench.tick(5)
    bench.equal(lanes.given and [data for data, _ in lanes.given], good, "spans that came in")
    bench.equal(lanes.told, told, "what was told")
    bench.equal(int(bench.dut.busy_o.value), 1, "busy_o while pixels are to be drawn")
    if ready == 1.0 and not gap:
        bench.equal(source.clocks[-1] - source.clocks[0] + 1, len(beats), "a beat a clock")


@checked()
async def balance(bench: Bench) -> None:
    """Long spans among short ones: no lane gets much more to draw than another; busy_o until all is drawn."""
    source, lanes = setup(bench)
    sent = spans(bench.rng, [64, 4, 4, 4] * 40)
    await source.send([(data, WHOLE, 1) for (data,) in sent.words()])
    await bench.tick(3)
    drawn = [0] * lanes.lanes
    for data, lane in lanes.given:
        drawn[lane] += data >> k.SPAN_COUNT_LSB & (1 << k.COUNT_W) - 1
    bench.equal(sum(drawn), sent.count.sum(), "pixels of all lanes")
    bench.equal(max(drawn) - min(drawn) <= 3 * 64, True, f"pixels of each lane, {drawn}, are about the same")
    await bench.until(lambda: not int(bench.dut.busy_o.value), 5000, "busy_o falls")


@checked()
async def quiet(bench: Bench) -> None:
    """On the path of polynomials, and of variants that ask for no metric, that is told of nothing."""
    source, lanes = setup(bench)
    normals, wanted = bench.parameter("PATH_NORMALS"), {"metric": 0, "threshold": 0}
    for draw, metric, threshold in (
        ({"path": k.PATH_POLY, "variant": k.VARIANT_V1, "threshold": -1}, 0, 0),
        ({"path": k.PATH_NORMALS, "variant": k.VARIANT_V4}, 0, 0), (V1, 1, 0),
        (V1 | {"threshold": 1 << k.INTENSITY_F}, 1, 0), (V1 | {"threshold": (1 << k.INTENSITY_F) + 1}, 1, 1),
    ):  # fmt: skip
        set_draw(bench, draw)
        await source.send([(data, WHOLE, 1) for (data,) in spans(bench.rng, [3]).words()])
        await bench.tick(5)
        wanted["metric"] += metric * normals
        wanted["threshold"] += threshold * normals
        bench.equal({name: lanes.told[name] for name in wanted}, wanted, f"what was told, {draw}")


@checked()
async def holds(bench: Bench) -> None:
    """While hold_i is 1 nothing is taken; what is in goes on."""
    source, lanes = setup(bench)
    beats = [(data, WHOLE, 1) for (data,) in spans(bench.rng, [5, 6, 7]).words()]
    await source.send(beats[:1])
    bench.dut.hold_i.value = 1
    sending = cocotb.start_soon(source.send(beats[1:]))
    await bench.tick(10)
    bench.equal(len(lanes.given), 1, "spans while hold_i")
    bench.dut.hold_i.value = 0
    await sending
    await bench.tick(3)
    bench.equal([data for data, _ in lanes.given], [data for data, _, _ in beats], "spans")


@checked()
async def reset(bench: Bench) -> None:
    """A reset of one clock with a span at the door, or in the middle of a packet: the next one is whole."""
    source, lanes = setup(bench)
    for last in (0, 1):
        lanes.ready = 0.0
        await bench.tick()
        task = cocotb.start_soon(source.send([(random.getrandbits(k.SPAN_DATA_W), WHOLE, last)]))
        await bench.tick(4)
        task.cancel()
        source.withdraw()
        await bench.reset(clocks=1)
        bench.equal(int(bench.dut.valid_o.value), 0, "valid_o behind a reset")
        lanes.ready = 1.0
        await bench.tick()
        lanes.given.clear()
        beats = [(data, WHOLE, 1) for (data,) in spans(bench.rng, [5, 6]).words()]
        await source.send(beats)
        await bench.tick(3)
        bench.equal([data for data, _ in lanes.given], [data for data, _, _ in beats], "spans")


@checked()
async def paths(bench: Bench) -> None:
    """s_axis_span_tready follows no input of its stream, nor does what the lanes see."""
    source, lanes = setup(bench, 0.5)
    inputs = [SPAN + name for name in ("tvalid", "tdata", "tkeep", "tlast")]
    cocotb.start_soon(no_path(bench, inputs, [SPAN + "tready", "valid_o", "span_o", "told_o"]))
    beats = [(data, WHOLE, 1) for (data,) in spans(bench.rng, np.arange(1, 30)).words()]
    await source.send(beats, 0.3)
    await bench.until(lambda: len(lanes.given) == len(beats), 200, "all spans")
