"""shade_lobe: a limited parabola under a power of 2, to the bit of golden.light.lobe; folded as well."""

import random

from polyshade.golden import contract as k
from polyshade.golden.light import lobe
from polyshade.golden.material import fit, lobe_registers

from tb.bench import TRAFFIC, Bench, checked, patterns
from tb.runner import points, simulate


@points({}, {"POWER": 3}, {"POWER": 2}, {"FOLD": 6}, {"POWER": 2, "FOLD": 6})
def test_cocotb(point):
    simulate("shade_lobe", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Highlights of materials and any other registers, with every power; versines around 0 and 1, beyond, random ones.

    With FOLD = 6 every sixth clock takes one; what is offered in the others is ignored. Each value comes out after the
    same number of clocks.
    """
    dut, rows, fold, stages = bench.dut, 150, bench.parameter("FOLD"), bench.parameter("POWER")
    step, latency = (6, k.LATENCY_LOBE) if fold == 1 else (5, k.LATENCY_LOBE_FOLDED)
    latency -= step * (4 - stages)
    materials = [(n, form) for n in (1, 20, 300) for form in ("paper", "refined")]
    sets = [lobe_registers(*fit("blinn", n, form=form, stages=stages)) for n, form in materials]
    steepest = {"k1": (1 << k.LOBE_K1_W) - 1, "k2": -1 << k.LOBE_K2_W - 1, "shift": 6, "xmax": (2 << k.LOBE_X_F) - 1}
    sets += [steepest | {"power": power} for power in (0, 4)]
    sets += [any_registers(bench) | {"power": power} for power in range(1 << k.LOBE_POWER_W)]

    for registers in sets:
        one = 1 << k.VERSINE_F
        x = bench.rng.integers(0, 2 * one, rows, endpoint=True) >> bench.rng.integers(0, 13, rows)
        x[::7] = bench.rng.choice([0, 1, 8, one - 1, one, one + 1, 2 * one, 2 * one - 1], len(x[::7]))
        given, wanted = x.tolist(), lobe(x, **registers, stages=stages).tolist()
        for name, value in registers.items():
            port = getattr(dut, f"{name}_i")
            port.value = patterns(port, [value])[0]
        await bench.reset()

        row, phase, clocks = 0, 0, 0  # the next row; clocks since one could be taken
        taken: list[int | None] = [None] * (latency + 1)  # the row of every clock so far
        while row < rows or any(done is not None for done in taken[-latency - 1 :]):
            offer = row < rows and random.random() >= gap
            in_reset = row < rows and random.random() < reset
            dut.x_i.value = given[row] if offer else random.getrandbits(k.VERSINE_W)
            dut.valid_i.value = offer
            dut.rst_i.value = in_reset
            await bench.tick()
            clocks += 1

            bench.equal(int(dut.ready_o.value), phase == 0, f"row {row}: ready_o", 1)
            take = offer and phase == 0
            taken.append(row if take else None)
            done = taken[-1 - latency]
            bench.equal(int(dut.valid_o.value), done is not None, f"row {done}: valid_o", 1)
            if done is not None:
                bench.equal(int(dut.lobe_o.value), wanted[done], f"{registers}, x = {given[done]:#x}: lobe_o")
            row += take
            phase = 0 if in_reset else (phase + 1) % fold
            if in_reset:
                taken = [None] * len(taken)
        if not gap and not reset:
            bench.equal(clocks, fold * (rows - 1) + latency + 2, "clocks for all rows")


def any_registers(bench: Bench) -> dict[str, int]:
    """Registers of any bits, but for the power."""
    unsigned = {name: int(bench.rng.integers(1 << bench.bits(f"{name}_i"))) for name in ("k1", "xmax", "shift")}
    return unsigned | {"k2": int(bench.signed(k.LOBE_K2_W, 1)[0])}
