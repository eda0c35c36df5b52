"""shade_light_folded: light of the plain models with three multipliers, to the bit of golden.light.light."""

import random

from polyshade.golden import contract as k
from polyshade.golden.light import light

from tb.bench import Bench, checked
from tb.light.vectors import CODES, nodes, registers, setting
from tb.runner import points, simulate

STEP = 6


@points({}, {"FORM": k.FORM_PAPER})
def test_cocotb(point):
    simulate("shade_light_folded", point)


@checked(gap=[0.0, 0.5], reset=[0.0, 0.01])
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Every model and reserved code, light from anywhere, from the viewer and from behind; any normals.

    Every sixth clock takes one; what is offered in the others is ignored. Each comes out after the latency, in its
    clock alone.
    """
    dut, form = bench.dut, bench.parameter("FORM")
    names = ("diffuse_o", "specular_o", "flags_o")
    for code in CODES:
        for direction in (bench.rng.standard_normal(3), (0, 0, 1), (0, 0, -1)):
            words = registers(bench, code, direction)
            setting(bench, **words)
            n = nodes(bench, 40)[0]
            n[:, :2] = [[words["lx"], words["hx"]], [words["ly"], words["hy"]], [words["lz"], words["hz"]]]
            expected = light(*n, words, form, 0, 0)
            await bench.reset()
            waiting, due, ready = list(range(n.shape[1])), {}, 0
            while waiting or due:
                offer = bool(waiting) and random.random() >= gap
                row = waiting[0] if offer else int(bench.rng.integers(n.shape[1]))
                for name, component in zip(("nx_i", "ny_i", "nz_i"), n[:, row], strict=True):
                    getattr(dut, name).value = int(component) & (1 << k.INTENSITY_W) - 1
                dut.valid_i.value = offer
                in_reset = bool(waiting) and random.random() < reset
                dut.rst_i.value = in_reset
                await bench.tick()
                bench.equal(int(dut.ready_o.value), int(ready % STEP == 0), "ready_o")
                row_out = due.pop(bench.clock, None)
                bench.equal(int(dut.valid_o.value), int(row_out is not None), "valid_o")
                if row_out is not None:
                    for name, values in zip(names, expected, strict=True):
                        what = f"node {row_out} of model {code}: {name}"
                        wanted = int(values[row_out]) & (1 << bench.bits(name)) - 1
                        bench.equal(int(getattr(dut, name).value), wanted, what, bench.bits(name))
                if offer and ready % STEP == 0:
                    due[bench.clock + k.LATENCY_LIGHT_FOLDED] = waiting.pop(0)
                ready += 1
                if in_reset:
                    due, ready = {}, 0
