# SPDX-License-Identifier: Apache-2.0
"""The worked example of docs/integration.md: its hexadecimal is what packers and golden give, its C runs."""

from __future__ import annotations

import re
import subprocess

import numpy as np
import pytest
from polyshade.golden import core
from polyshade.golden.material import Material, planner_registers, registers
from polyshade.golden.normal import pack_spans
from polyshade.golden.registers import pack
from polyshade.sim.sources import ROOT

NORMAL, INCREMENT, COUNT, TAG = [[0, 0, 1 << 29]], [[1 << 22, 0, 0]], [5], [0x0123]
SURFACE = Material("blinn", 64)
LIGHT = (0.0, 0.0, 1.0)


def expected() -> dict[str, str]:
    """The text of every example, by name."""
    (beat,) = pack_spans(NORMAL, INCREMENT, COUNT, 0, TAG)
    values = registers(SURFACE, LIGHT) | planner_registers(SURFACE)

    def pixels(draw: dict[str, int]) -> str:
        told = core.core(NORMAL, INCREMENT, COUNT, draw)
        return " ".join(f"{int(s) << 16 | int(d):08x}" for d, s in told.pixels)

    words = [f"{offset:03x}:{word:08x}" for offset, word in pack(values).items()]
    return {
        "span": " ".join(f"{word:08x}" for word in beat),
        "beat": f"{sum(int(w) << 32 * i for i, w in enumerate(np.asarray(beat))):064x}",
        "lambert": pixels({}),
        "blinn": pixels(values),
        "words": "\n".join(" ".join(words[i : i + 5]) for i in range(0, len(words), 5)),
    }


def test_examples() -> None:
    text = (ROOT / "docs" / "integration.md").read_text()
    shown = dict(re.findall(r"<!-- example: (\w+) -->\n```\n(.*?)\n?```", text, re.DOTALL))
    assert shown == expected()


DRIVER = ROOT / "scripts" / "handoff" / "driver"
# the core as words in memory; what is sent and written is printed
HARNESS = """
#include <stdio.h>
static uint32_t memory[1024];
static void send(const uint32_t *beat) {
    for (int i = 0; i < 8; i++) printf("%08x%s", (unsigned)beat[i], i < 7 ? " " : "\\n");
}
int draw(volatile uint32_t *shade);
int main(void) {
    int failed = draw(memory) != -1;
    memory[0] = SHADE_ID_RESET;
    memory[1] = SHADE_VERSION_RESET;
    failed |= draw(memory);
    for (int i = 0x40 / 4; i < 1024; i++) if (memory[i]) printf("%03x:%08x\\n", 4 * i, (unsigned)memory[i]);
    return failed;
}
"""


def example(name: str) -> str:
    """The first block of C in a document."""
    return re.search(r"```c\n(.*?)```", (ROOT / name).read_text(), re.DOTALL)[1]


@pytest.mark.parametrize("name", ["docs/integration.md", "scripts/handoff/driver/README.md"])
def test_example_in_c(name: str, tmp_path) -> None:
    """It is compiled without a warning; a wrong ID is told; beat and words are those of the examples above it."""
    head, _, body = example(name).partition("\n\n")
    source = tmp_path / "example.c"
    source.write_text("\n".join([head, HARNESS, body]))
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-Wno-unused-function", "-pedantic", "-I", DRIVER]
    program = tmp_path / "example"
    subprocess.run(["gcc", *flags, "-o", program, source, *sorted(DRIVER.glob("*.c")), "-lm"], check=True)
    told = subprocess.run([program], capture_output=True, text=True, check=True).stdout.split("\n")
    light = (0.3, 0.6, 0.8) if "driver" in name else LIGHT
    words = pack(registers(SURFACE, light) | planner_registers(SURFACE))
    assert {f"{offset:03x}:{word:08x}" for offset, word in words.items() if word} <= set(told)
    assert (expected()["span"] in told) == ("driver" not in name)
