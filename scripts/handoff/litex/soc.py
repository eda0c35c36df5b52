# SPDX-License-Identifier: Apache-2.0
"""A simulated SoC of LiteX: a VexRiscv, memory, a UART, ``shade_core``. It draws spans from C and prints the pixels.

    python soc.py BUNDLE OUT [PROGRAM]

writes ``OUT/soc.v``, ``OUT/sources.f`` and ``OUT/csr.h``, the addresses for the program; with PROGRAM, a binary for
address 0, the memory holds it. The UART gives bytes with valid and ready. Nothing of LiteX's software is compiled.
"""

import sys
from pathlib import Path

from litex.build.generic_platform import Pins, Subsignal
from litex.build.sim import SimPlatform
from litex.gen import LiteXModule
from litex.soc.integration.common import get_mem_data
from litex.soc.integration.soc import SoCRegion
from litex.soc.integration.soc_core import SoCCore
from litex.soc.interconnect import stream
from litex.soc.interconnect.csr import CSR, CSRStatus
from migen import ClockDomain
from shade import Shade

SHADE = 0x90000000
PINS = [
    ("clock", 0, Pins(1)),
    ("reset", 0, Pins(1)),
    ("serial", 0, *(Subsignal(f"{way}_{name}", Pins(8 if name == "data" else 1))
                    for way in ("source", "sink") for name in ("valid", "ready", "data"))),
]  # fmt: skip


class Reset(LiteXModule):
    """Clock and reset from the pins."""

    def __init__(self, platform):
        self.cd_sys = ClockDomain()
        self.comb += [self.cd_sys.clk.eq(platform.request("clock")), self.cd_sys.rst.eq(platform.request("reset"))]


class Door(LiteXModule):
    """Spans word by word from the processor, the lowest first; pixels one by one to it, kept in a FIFO."""

    def __init__(self, shade):
        self.word = CSR(32)  # writes append to the span
        self.ready = CSRStatus(1)  # a word may be written
        self.pixel = CSR(32)  # a write of anything takes the pixel that is read here
        self.tag = CSRStatus(16)
        self.valid = CSRStatus(1)
        self.words = words = stream.Converter(32, 256)
        self.fifo = fifo = stream.SyncFIFO(shade.pixels.description, 64)
        self.comb += [
            words.sink.valid.eq(self.word.re), words.sink.data.eq(self.word.r), self.ready.status.eq(words.sink.ready),
            shade.spans.valid.eq(words.source.valid), shade.spans.data.eq(words.source.data),
            words.source.ready.eq(shade.spans.ready),
            shade.pixels.connect(fifo.sink),
            self.pixel.w.eq(fifo.source.data), self.tag.status.eq(fifo.source.tag),
            self.valid.status.eq(fifo.source.valid), fifo.source.ready.eq(self.pixel.re),
        ]  # fmt: skip


class SoC(SoCCore):
    """32 KiB of ROM, 8 KiB of RAM."""

    def __init__(self, platform, bundle):
        self.crg = Reset(platform)
        super().__init__(
            platform, 1_000_000, cpu_type="vexriscv", cpu_variant="minimal", integrated_rom_size=0x8000,
            integrated_sram_size=0x2000, uart_name="sim", ident="Polyshade", with_timer=False,
        )  # fmt: skip
        self.shade = Shade(platform, bundle, REFLECT=0, DIVIDE=0, PATH_NORMALS=0)
        self.bus.add_slave("shade", self.shade.bus, SoCRegion(origin=SHADE, size=0x1000, cached=False))
        self.door = Door(self.shade)


def main(bundle, out, program=None):
    """Write the SoC."""
    out = Path(out)
    platform = SimPlatform("SIM", PINS, name="soc")
    soc = SoC(platform, bundle)
    soc.finalize()
    addresses = {"SHADE_BASE": SHADE, "RAM_BASE": soc.bus.regions["sram"].origin, "RAM_SIZE": 0x2000}
    for name, region in soc.csr.regions.items():
        at = region.origin
        for register in region.obj if isinstance(region.obj, list) else []:
            addresses[f"{name}_{register.name}".upper()] = at
            at += 4 * ((register.size + 31) // 32)
    lines = [f"#define {name} 0x{value:08x}u\n" for name, value in addresses.items()]
    (out / "csr.h").write_text("".join(lines))
    if program:
        soc.init_rom("rom", get_mem_data(program, data_width=32, endianness="little"), auto_size=False)
    platform.get_verilog(soc, name="soc").write(str(out / "soc.v"))
    sources = [str(source[0]) for source in platform.sources]
    (out / "sources.f").write_text("\n".join([*sources, str(out / "soc.v")]) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
