"""shade_half: the cosine of half an angle, to the bit of golden.normal.half; the powers come a clock late."""

from polyshade.golden import contract as k
from polyshade.golden.normal import half
from polyshade.scripts.flow.points import grid

from tb.bench import Bench, checked
from tb.normal.vectors import cosines
from tb.runner import points, simulate


@points(*grid(FORM=[k.FORM_PAPER, k.FORM_REFINED]))
def test_cocotb(point):
    simulate("shade_half", point)


@checked()
async def stream(bench: Bench) -> None:
    """Cosines in [0, 1], both sides of cos(pi/4) among them."""
    one = 1 << k.INTENSITY_F
    c = cosines(bench, 1000).clip(0, one)
    cut = 2 * k.INTENSITY_F - k.SQUARE_F
    square = (one - c) ** 2
    inputs = {"c_i": c, "uu_i": square >> cut, "uuuu_i": (square >> k.INTENSITY_F) ** 2 >> cut}
    outputs = {"half_o": half(c, bench.parameter("FORM"))}
    await bench.pipeline(inputs, outputs, k.LATENCY_HALF, late={"uu_i": 1, "uuuu_i": 1})
