# SPDX-License-Identifier: Apache-2.0
"""shade_direct_line: moves and coefficients in, starts out, to the bit of golden.direct.step."""

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.direct import Coefficients, step
from polyshade.golden.types import COEFFICIENTS, MOVES, START, unpack, whole

from tb.bench import Bench, checked
from tb.runner import points, simulate


@points({}, {"LOG2": 1})
def test_cocotb(point):
    simulate("shade_direct_line", point)


def coefficients(bench: Bench, rows: int) -> Coefficients:
    """Of all kinds; p_column and p_line as golden has them, without p_columns and p_lines."""
    fields = {field.name: field for field in COEFFICIENTS.leaves()}
    return Coefficients(*(bench.rng.integers(*fields[name].range, rows) for name in Coefficients._fields))


@checked(thrift=[0.0, 0.7])
async def runs(bench: Bench, thrift: float) -> None:
    """Runs to the right, to the left, farther down; some that are not good; starts are taken when they come."""
    dut, rng, mask, triangles = bench.dut, bench.rng, (1 << k.DIRECT_P_W) - 1, 60
    found = coefficients(bench, triangles)
    given = found._asdict() | {
        "p_column": found.p_column + found.p_columns & mask, "p_line": found.p_line + found.p_lines & mask,
    }  # fmt: skip
    words = whole(COEFFICIENTS, given)
    moves, wanted = [], []
    for t in range(triangles):
        runs = int(rng.integers(1, 6))
        column = line = 0
        for r in range(runs):
            good = rng.random() < 0.9
            right, down = (0, 0) if r == 0 or not good else (int(rng.integers(-5, 6)), int(rng.choice([0, 0, 0, 2])))
            count, tag = int(rng.integers(1, 99)), int(rng.integers(0, 1 << 16))
            moves.append(
                {"lines": down, "columns": right, "good": good, "first": r == 0, "last": r == runs - 1}
                | {"count": count, "tag": tag}
            )
            column, line = column + right, line + down
            if good:
                one = Coefficients(*(part[t] for part in found))
                wanted.append((count, tag, *(int(v) for v in step(one, column, line)), int(one.a_column)))
                line += 1
    packed = whole(MOVES, {name: np.array([int(move[name]) for move in moves]) for name in moves[0]})
    starts, waiting, sent, loaded = [], 0, 0, 0
    dut.full_i.value, dut.valid_i.value, dut.credit_i.value = 0, 0, 0
    await bench.reset()
    for _ in range(40 * len(moves) + 100):
        dut.valid_i.value = sent < len(packed)
        dut.moves_i.value = packed[min(sent, len(packed) - 1)]
        dut.full_i.value = loaded < triangles
        dut.coefficients_i.value = words[min(loaded, triangles - 1)]
        credit = waiting > 0 and rng.random() >= thrift
        dut.credit_i.value = int(credit)
        await cocotb.triggers.ReadOnly()
        taken = int(dut.ready_o.value) and sent < len(packed)
        following = int(dut.next_o.value)
        if int(dut.start_valid_o.value):
            starts.append(int(dut.start_o.value))
            waiting += 1
        await bench.tick()
        waiting -= credit
        sent, loaded = sent + bool(taken), loaded + bool(following)
        if len(starts) == len(wanted) and sent == len(packed):
            break
    bench.equal(len(starts), len(wanted), "starts")
    for i, (start, (count, tag, a, y, p, a_column)) in enumerate(zip(starts, wanted, strict=True)):
        size = -(-START.width // 32)
        v = unpack(START, np.frombuffer(start.to_bytes(4 * size, "little"), "<u4"))
        values = [int(v[name]) for name in ("count", "tag", "at.a", "at.h", "at.p", "a_column")]
        assert values == [count, tag, a, y, p, a_column], i
