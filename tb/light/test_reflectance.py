"""shade_reflectance: light at a node in every model, to the bit of golden.light.reflectance, on every clock."""

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden.light import reflectance

from tb.bench import TRAFFIC, Bench, checked
from tb.light.vectors import CODES, nodes, pack, registers, setting, unit_numbers
from tb.runner import points, simulate


@points({}, {"REFLECT": 0, "DIVIDE": 0}, {"LOCAL": 1}, {"LOCAL": 1, "DIVIDE": 0, "FORM": k.FORM_PAPER})
def test_cocotb(point):
    simulate("shade_reflectance", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Every model and reserved code; equal, opposite, close and any vectors; H = 0."""
    form, reflect, divide, local = (bench.parameter(name) for name in ("FORM", "REFLECT", "DIVIDE", "LOCAL"))
    latency = k.LATENCY_LIGHT_LOCAL if local else k.LATENCY_LIGHT - (not reflect) * k.LATENCY_REFLECT
    for code in CODES:
        words = registers(bench, code)
        vectors = [*nodes(bench, 100), nodes(bench, 100)[1]]
        vectors[3][:, ::7] = 0
        vh, fresnel = unit_numbers(bench, 100), unit_numbers(bench, 100)
        if not local:
            vectors[1:] = [np.broadcast_to(vector[:, :1], vectors[0].shape) for vector in vectors[1:]]
            vh, fresnel = vh[:1], fresnel[:1]
        values = reflectance(*vectors, vh, fresnel, words, form, reflect, divide)
        outputs = dict(zip(("diffuse_o", "specular_o", "flags_o"), values, strict=True))

        inputs = {f"{name}_i": pack(vector) for name, vector in zip("nlvh", vectors, strict=True)}
        inputs |= {"vh_i": vh, "fresnel_i": fresnel}
        fixed = [] if local else [name for name in inputs if name != "n_i"]
        setting(bench, **words, **{name[:-2]: int(inputs.pop(name)[0]) for name in fixed})
        late = {"h_i": k.LATENCY_HALFWAY, "vh_i": k.LATENCY_HALFWAY, "fresnel_i": k.LATENCY_HALFWAY + k.LATENCY_FRESNEL}
        await bench.pipeline(inputs, outputs, latency, gap=gap, reset=reset, late=late if local else {})
