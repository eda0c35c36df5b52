"""shade_delay: every word again, DEPTH clocks later."""

from tb.bench import Bench, checked
from tb.runner import points, simulate


@points({}, {"WIDTH": 33, "DEPTH": 5}, {"WIDTH": 1, "DEPTH": 0}, {"DEPTH": 47})
def test_cocotb(point):
    simulate("shade_delay", point)


@checked()
async def stream(bench: Bench) -> None:
    """A word on every clock."""
    words = bench.rng.integers(0, 1 << bench.bits("d_i"), 500)
    await bench.pipeline({"d_i": words}, {"q_o": words}, bench.parameter("DEPTH"))
