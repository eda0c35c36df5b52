"""shade_light_local: light and viewer of every node, every model, to the bit of golden.light.light_local."""

from polyshade.golden import contract as k
from polyshade.golden.light import light_local

from tb.bench import TRAFFIC, Bench, checked
from tb.light.vectors import CODES, components, nodes, registers, setting
from tb.runner import points, simulate


@points({}, {"REFLECT": 0, "DIVIDE": 0}, {"FORM": k.FORM_PAPER})
def test_cocotb(point):
    simulate("shade_light_local", point)


@checked(**TRAFFIC)
async def stream(bench: Bench, gap: float, reset: float) -> None:
    """Every model and reserved code; equal, opposite, close and any vectors; the viewer opposite to the light."""
    form, reflect, divide = (bench.parameter(name) for name in ("FORM", "REFLECT", "DIVIDE"))
    for code in CODES:
        words = registers(bench, code)
        n, l, v = nodes(bench, 150)  # noqa: E741
        setting(bench, **words)
        values = light_local(*n, *l, *v, words, form, reflect, divide)
        outputs = dict(zip(("diffuse_o", "specular_o", "flags_o"), values, strict=True))
        await bench.pipeline(components(n=n, l=l, v=v), outputs, k.LATENCY_LIGHT_LOCAL, gap=gap, reset=reset)
