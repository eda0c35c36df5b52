"""shade_weigh: a weighted sum, to the bit of golden.fixed.weigh, for constants of any sign."""

from polyshade.golden import contract as k
from polyshade.golden import fixed

from tb.bench import Bench, checked
from tb.runner import points, simulate


@points(
    {"OUT_W": 24},
    {"WIDTH": 12, "F": 6, "OUT_W": 21, "OUT_F": 12, "K0": -70000, "KX": 43691, "KY": -65535, "KZ": 3},
    {"WIDTH": 8, "F": 4, "OUT_W": 12, "OUT_F": 2, "K0": 0, "KX": 0, "KY": 0, "KZ": -131072},
)
def test_cocotb(point):
    simulate("shade_weigh", point)


def constant(bench: Bench, name: str) -> int:
    """A parameter of the module that may be negative: 32 bits in two's complement."""
    return (bench.parameter(name) + (1 << 31)) % (1 << 32) - (1 << 31)


@checked()
async def stream(bench: Bench) -> None:
    """Corners and random ones; OUT_W holds every sum."""
    inputs = {f"{name}_i": bench.signed(bench.parameter("WIDTH"), 1000) for name in "xyz"}
    k0, *by_input = (constant(bench, f"K{name}") for name in "0XYZ")
    terms = [term for pair in zip(by_input, inputs.values(), strict=True) for term in pair]
    w = fixed.weigh(k0, *terms, f=bench.parameter("F"), out_f=bench.parameter("OUT_F"))
    await bench.pipeline(inputs, {"w_o": w}, k.LATENCY_WEIGH)
