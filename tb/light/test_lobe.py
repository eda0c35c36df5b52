# SPDX-License-Identifier: Apache-2.0
"""shade_lobe: a limited parabola under a power of 2, to the bit of golden.light.lobe, with every fold."""

import random

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.light import lobe
from polyshade.golden.material import fit, lobe_registers
from polyshade.sim.units.light import lobe_latency

from tb.bench import Bench, checked
from tb.runner import points, simulate


@points({}, {"POWER": 3}, {"POWER": 2}, *({"FOLD": fold, "TAKE": fold // 2} for fold in range(2, 9)),
        {"POWER": 3, "FOLD": 3}, {"POWER": 2, "FOLD": 5}, {"POWER": 2, "FOLD": 6})  # fmt: skip
def test_cocotb(point):
    simulate("shade_lobe", point)


@checked(gap=[0.0, 0.5])
async def stream(bench: Bench, gap: float) -> None:
    """Highlights of materials and any other registers, with every power; versines around 0 and 1, beyond, random ones.

    A value is taken in phase TAKE; what the other clocks offer is ignored.
    """
    dut, rows = bench.dut, 150
    fold, stages, take = (bench.parameter(name) for name in ("FOLD", "POWER", "TAKE"))
    latency = lobe_latency(stages, fold)
    materials = [(n, form) for n in (1, 20, 300) for form in ("paper", "refined")]
    sets = [lobe_registers(*fit("blinn", n, form=form, stages=stages)) for n, form in materials]
    steepest = {"k1": (1 << k.LOBE_K1_W) - 1, "k2": -1 << k.LOBE_K2_W - 1, "shift": 6, "xmax": (2 << k.LOBE_X_F) - 1}
    sets += [steepest | {"power": power} for power in (0, 4)]
    sets += [any_registers(bench) | {"power": power} for power in range(1 << k.LOBE_POWER_W)]
    for registers in sets:
        one = 1 << k.VERSINE_F
        x = bench.rng.integers(0, 2 * one, rows, endpoint=True) >> bench.rng.integers(0, 13, rows)
        x[::7] = bench.rng.choice([0, 1, 8, one - 1, one, one + 1, 2 * one, 2 * one - 1], len(x[::7]))
        wanted = lobe(x, **registers, stages=stages).tolist()
        for name, value in registers.items():
            getattr(dut, f"{name}_i").value = value & (1 << bench.bits(f"{name}_i")) - 1
        row, due, clock = 0, {}, 0  # the next row; rows by the clock in which they leave
        while row < rows or due:
            phase = clock % fold
            taken = phase == take and row < rows and random.random() >= gap
            dut.phase_i.value = phase
            dut.x_i.value = int(x[row]) if taken else random.getrandbits(k.VERSINE_W)
            await bench.tick()
            if taken:
                due[clock + latency] = row
                row += 1
            if (done := due.pop(clock, None)) is not None:
                bench.equal(int(dut.lobe_o.value), wanted[done], f"row {done}: x = {x[done]}, {registers}: lobe_o")
            clock += 1


def any_registers(bench: Bench) -> dict[str, int]:
    """Registers of any kind."""
    low, high = -(1 << k.LOBE_K2_W - 1), (1 << k.LOBE_K2_W - 1) - 1
    k1, shift, xmax = (
        int(bench.rng.integers(0, 1 << width)) for width in (k.LOBE_K1_W, k.LOBE_SHIFT_W, k.LOBE_X_F + 1)
    )
    k2 = int(np.clip(bench.rng.normal(0, 1 << k.LOBE_K2_W - 2), low, high))
    return {"k1": k1, "k2": k2, "shift": shift, "xmax": xmax}
