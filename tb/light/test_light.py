"""shade_light: light at a node, directional, in every model, to the bit of golden.light.light, on every clock."""

from polyshade.golden import contract as k
from polyshade.golden.light import light

from tb.bench import TRAFFIC, Bench, checked
from tb.light.vectors import CODES, components, nodes, registers, setting
from tb.runner import points, simulate


@points({}, {"REFLECT": 0, "DIVIDE": 0}, {"FORM": k.FORM_PAPER})
def test_cocotb(point):
    simulate("shade_light", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Every model and reserved code, light from anywhere, from the viewer and from behind; any normals."""
    form, reflect, divide = (bench.parameter(name) for name in ("FORM", "REFLECT", "DIVIDE"))
    latency = k.LATENCY_LIGHT - (not reflect) * k.LATENCY_REFLECT
    for code in CODES:
        for direction in (bench.rng.standard_normal(3), (0, 0, 1), (0, 0, -1)):
            words = registers(bench, code, direction)
            n = nodes(bench, 100)[0]
            n[:, :2] = [[words["lx"], words["hx"]], [words["ly"], words["hy"]], [words["lz"], words["hz"]]]
            setting(bench, **words)
            outputs = dict(
                zip(("diffuse_o", "specular_o", "flags_o"), light(*n, words, form, reflect, divide), strict=True)
            )
            await bench.pipeline(components(n=n), outputs, latency, gap=gap, reset=reset)
