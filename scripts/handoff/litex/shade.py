# SPDX-License-Identifier: Apache-2.0
"""``shade_core`` for LiteX: registers on the bus of the SoC, spans and pixels as streams.

    self.shade = Shade(platform, bundle)
    self.bus.add_slave("shade", self.shade.bus, SoCRegion(origin=0x90000000, size=0x1000, cached=False))

``spans`` takes 256 bits a span, ``pixels`` gives data and tag; one lane.
"""

from pathlib import Path

from litex.gen import ClockSignal, Instance, LiteXModule, ResetSignal, Signal
from litex.soc.interconnect import axi, stream

CHANNELS = {
    "aw": ("valid", "ready", "addr", "prot"), "w": ("valid", "ready", "data", "strb"), "b": ("valid", "ready", "resp"),
    "ar": ("valid", "ready", "addr", "prot"), "r": ("valid", "ready", "data", "resp"),
}  # fmt: skip
FROM_CORE = {
    "aw": ("ready",),
    "w": ("ready",),
    "b": ("valid", "resp"),
    "ar": ("ready",),
    "r": ("valid", "data", "resp"),
}


class Shade(LiteXModule):
    """``bundle``: the folder that holds lists/core.f; ``point``: parameters, such as REFLECT=0."""

    def __init__(self, platform, bundle, **point):
        self.bus = axi.AXILiteInterface(data_width=32, address_width=32)
        self.spans = stream.Endpoint([("data", 256)])
        self.pixels = stream.Endpoint([("data", 32), ("tag", 16)])
        self.idle, self.irq = Signal(), Signal()
        ports = {
            "i_clk_i": ClockSignal(), "i_rst_i": ResetSignal(), "o_idle_o": self.idle, "o_irq_o": self.irq,
            "i_s_axis_span_tvalid": self.spans.valid, "o_s_axis_span_tready": self.spans.ready,
            "i_s_axis_span_tdata": self.spans.data, "i_s_axis_span_tkeep": 2**32 - 1, "i_s_axis_span_tlast": 1,
            "o_m_axis_pixel_tvalid": self.pixels.valid, "i_m_axis_pixel_tready": self.pixels.ready,
            "o_m_axis_pixel_tdata": self.pixels.data, "o_m_axis_pixel_tuser": self.pixels.tag,
            "o_m_axis_pixel_tlast": self.pixels.last,
        }  # fmt: skip
        for channel, names in CHANNELS.items():
            for name in names:
                way = "o" if name in FROM_CORE[channel] else "i"
                signal = 0 if name == "prot" else getattr(getattr(self.bus, channel), name)
                ports[f"{way}_s_axil_{channel}{name}"] = signal[:12] if name == "addr" else signal
        self.specials += Instance("shade_core", **{f"p_{name}": value for name, value in point.items()}, **ports)
        lists = Path(bundle) / "lists"
        for name in (lists / "core.f").read_text().split():
            platform.add_source(str((lists / name).resolve()))
