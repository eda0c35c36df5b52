"""shade_angles: cosines and versines at a node, to the bit of golden.light.angles, on every clock."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.light import angles

from tb.bench import TRAFFIC, Bench, checked
from tb.light.vectors import nodes, pack, setting
from tb.runner import points, simulate

OUTPUTS = ("diffuse", "nl", "nv", "x", "saturated", "nl_range", "nv_range", "x_range", "lost")


@points({}, {"REFLECT": 0}, {"LOCAL": 1}, {"REFLECT": 0, "LOCAL": 1, "FORM": k.FORM_PAPER})
def test_cocotb(point):
    simulate("shade_angles", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Equal, opposite, close and any vectors; H = 0. Where they are settings, L, V, H change between runs."""
    reflect, local = (bench.parameter(name) for name in ("REFLECT", "LOCAL"))
    latency = k.LATENCY_ANGLES - (not reflect) * k.LATENCY_REFLECT
    latency = k.LATENCY_HALFWAY + 1 + k.LATENCY_VERSINE if local else latency
    for run in range(8):
        n, l, v = nodes(bench, 150)  # noqa: E741
        h = nodes(bench, 150)[1]
        h[:, ::7] = 0
        if not local:
            l, v, h = (np.broadcast_to(vector[:, run : run + 1], n.shape) for vector in (l, v, h))  # noqa: E741
        mirror = run % 2 & reflect
        values = angles(mirror, n, l, v, h, bench.parameter("FORM"))
        words = {f"{name}_i": pack(vector) for name, vector in zip("nlvh", (n, l, v, h), strict=True)}
        fixed = [] if local else ["l_i", "v_i", "h_i"]
        setting(bench, mirror=mirror, **{name[:-2]: int(words.pop(name)[0]) for name in fixed})
        outputs = {f"{name}_o": value for name, value in zip(OUTPUTS, values, strict=True)}
        late = {"h_i": k.LATENCY_HALFWAY} if local else {}
        await bench.pipeline(words, outputs, latency, gap=gap, reset=reset, late=late)
