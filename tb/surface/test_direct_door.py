# SPDX-License-Identifier: Apache-2.0
"""shade_direct_door: packets taken apart: vectors, runs, entries of the table; packets cut short."""

import cocotb
import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.direct import lobe_packet

from tb.bench import Bench, Source, checked
from tb.runner import simulate
from tb.surface.direct_vectors import lobe, packets


def test_cocotb():
    simulate("shade_direct_door", {})


@checked(gap=[0.0, 0.4], wait=[0.0, 0.6])
async def traffic(bench: Bench, gap: float, wait: float) -> None:
    """Vectors and runs in order, each once; of a packet without runs no run; the table's entries by address."""
    dut = bench.dut
    parts = [packets(bench.rng, 40, 0.5), lobe_packet(lobe(8.0, 0, -5)), packets(bench.rng, 5)]
    data, last = (np.concatenate([part[name] for part in parts]) for name in parts[0])
    dut.vector_ready_i.value, dut.credit_i.value, dut.idle_i.value = 0, 0, 1
    await bench.reset()
    stream = "s_axis_surface_"
    source = Source(bench, stream + "tvalid", stream + "tready", [stream + "tdata", stream + "tlast"])
    sending = cocotb.start_soon(source.send(list(zip(data.tolist(), last.tolist(), strict=True)), gap))
    vectors, runs, entries, cuts, pending = [], [], [], 0, 0
    for _ in range(20 * len(data)):
        ready = bench.rng.random() >= wait
        credit = pending > 0
        dut.vector_ready_i.value, dut.credit_i.value = int(ready), int(credit)
        await cocotb.triggers.ReadOnly()
        if int(dut.vector_valid_o.value) and ready:
            vectors.append((int(dut.kind_o.value), int(dut.vector_o.value)))
        if int(dut.run_valid_o.value):
            runs.append(int(dut.run_o.value) & (1 << 2 * k.PLACE_W) - 1)
        if int(dut.write_o.value):
            entries.append((int(dut.address_o.value), int(dut.chord_o.value)))
        cuts += int(dut.error_o.value)
        pending += int(dut.run_valid_o.value) - credit
        await bench.tick()
        if sending.done():
            break
    await bench.tick(3)
    wanted_vectors, wanted_runs, wanted_cuts, wanted_entries = [], [], 0, []
    for beats in np.split(data, np.flatnonzero(last)[:-1] + 1):
        if int(beats[0]) >> 47 & 1:
            wanted_entries += [(i, int(beat)) for i, beat in enumerate(beats[1:])]
            continue
        whole = len(beats) > k.TRIANGLE_BEATS
        wanted_cuts += not whole
        header = beats[1 : k.TRIANGLE_BEATS] if whole else beats[1:-1]
        wanted_vectors += [(i, int(beat)) for i, beat in enumerate(header)]
        wanted_runs += [int(b) & 0xFFF | (int(b) >> 16 & 0xFFF) << 12 for b in beats[k.TRIANGLE_BEATS :]]
    assert vectors == wanted_vectors
    assert runs == wanted_runs
    assert entries == wanted_entries
    assert abs(cuts - wanted_cuts) <= 1  # the last may be told later
    bench.equal(int(dut.shift_o.value), 0, "shift_o")
