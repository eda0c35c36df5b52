"""shade_unit: interpolated normals to unit length, to the bit of golden.normal.unit; folded, a vector in 6 clocks."""

import random

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.normal import unit

from tb.bench import TRAFFIC, Bench, checked, patterns
from tb.runner import points, simulate

OUTPUTS = ("x_o", "y_o", "z_o", "zero_o", "short_o")


@points({}, {"FOLD": 6})
def test_cocotb(point):
    simulate("shade_unit", point)


def vectors(bench: Bench, rows: int) -> dict[str, np.ndarray]:
    """Vectors of every length, extremes, 0 and its neighbours, lengths around 1/8 and around powers of two."""
    v = np.stack([bench.signed(k.INTENSITY_W, rows) for _ in "xyz"]) >> bench.rng.integers(0, 8, rows)
    v[:, :27] = np.stack(np.meshgrid(*[[-1, 0, 1]] * 3)).reshape(3, -1)
    axis = np.array([(1 << bits) + d for bits in range(11, 17) for d in (-1, 0, 1)])
    v[:, 27 : 27 + len(axis)] = np.stack([axis, 0 * axis, 0 * axis])
    return {f"{c}_i": v[i] for i, c in enumerate("xyz")} | {"bypass_i": bench.rng.random(rows) < 0.2}


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Normalized and bypassed; folded, those that are not taken are ignored."""
    inputs = vectors(bench, 600)
    outputs = dict(zip(OUTPUTS, unit(*inputs.values()), strict=True))
    if bench.parameter("FOLD") == 1:
        await bench.pipeline(inputs, outputs, k.LATENCY_UNIT, gap=gap, reset=reset)
    else:
        await folded(bench, inputs, outputs, gap, reset)


async def folded(bench: Bench, inputs: dict, outputs: dict, gap: float, reset: float) -> None:
    """A row is taken in every sixth clock since the reset, if one is offered; the result stays for that clock."""
    dut, fold, latency = bench.dut, 6, k.LATENCY_UNIT_FOLDED
    rows = len(inputs["x_i"])
    given = {name: patterns(getattr(dut, name), column) for name, column in inputs.items()}
    wanted = {name: patterns(getattr(dut, name), column) for name, column in outputs.items()}
    await bench.reset()

    row, clocks = 0, 0  # the next row; clocks since the reset
    taken: list[int | None] = [None] * (latency + 1)  # the row of every clock so far
    while row < rows or any(done is not None for done in taken[-latency - 1 :]):
        offer = row < rows and random.random() >= gap
        in_reset = row < rows and random.random() < reset
        for name, column in given.items():
            getattr(dut, name).value = column[row] if offer else random.getrandbits(len(getattr(dut, name)))
        dut.valid_i.value, dut.rst_i.value = offer, in_reset
        await bench.tick()

        ready = clocks % fold == 0
        bench.equal(int(dut.ready_o.value), ready, f"row {row}: ready_o")
        taken.append(row if offer and ready else None)
        done = taken[-1 - latency]
        bench.equal(int(dut.valid_o.value), done is not None, f"row {done}: valid_o")
        if done is not None:
            for name, column in wanted.items():
                bench.equal(int(getattr(dut, name).value), column[done], f"row {done}: {name}", bench.bits(name))
        row += offer and ready
        clocks += 1
        if in_reset:
            taken, clocks = [None] * len(taken), 0
