# SPDX-License-Identifier: Apache-2.0
"""The packets of the streams as data: the one source for ``docs/interface.md``; their fields are those of ``types``.

One packet is one beat of an AXI4-Stream, but for a triangle, which is four, followed by its runs. ``types.pack`` makes
beats, ``golden.normal.pack_spans`` and ``golden.poly.pack_records`` for spans and records.
"""

from __future__ import annotations

from dataclasses import dataclass

from . import contract as k
from .types import COLOURED, PIXEL, RECORD, RUN, SPAN, TRIANGLE, VEC, VERTEX, Field, Struct


@dataclass(frozen=True)
class Packet:
    """A beat: the stream's name, its width in bits and its fields; bits without one are ignored."""

    stream: str
    width: int
    struct: Struct

    @property
    def meaning(self) -> str:
        """What it is."""
        return self.struct.meaning

    @property
    def fields(self) -> tuple[Field, ...]:
        """The fields that hold numbers, lowest bits first."""
        return tuple(self.struct.leaves())


PACKETS = {
    "SPAN": Packet("s_axis_span of shade_core, s_axis_line of shade_pixel_normals", k.SPAN_DATA_W, SPAN),
    "RECORD": Packet("s_axis_span of shade_poly_span", k.RECORD_DATA_W, RECORD),
    "VERTEX": Packet(
        "s_axis_vertex of shade_spans, shade_surfaces, shade_scene; three a triangle, tlast with the third",
        k.VERTEX_DATA_W,
        VERTEX,
    ),
    "TRIANGLE": Packet(
        "s_axis_surface of shade_direct and of the patches, first four beats",
        k.TRIANGLE_DATA_W,
        TRIANGLE,
    ),
    "RUN": Packet("the same stream, all other beats of a packet; tlast comes with the last run", k.SURFACE_DATA_W, RUN),
    "PIXEL": Packet(
        "m_axis_pixel of shade_core (COLOUR = 0 or CONTROL.colour = 0), shade_phong, shade_poly_span; tuser is the "
        "span's tag, tlast its last pixel",
        k.PIXEL_DATA_W,
        PIXEL,
    ),
    "COLOURED": Packet(
        "m_axis_pixel of shade_core (COLOUR = 1 and CONTROL.colour = 1); tuser is the span's tag, tlast its last pixel",
        k.COLOUR_DATA_W,
        COLOURED,
    ),
    "NORMAL": Packet(
        "m_axis_normal of shade_pixel_normals; tuser is the line's tag, tlast its last normal", k.NORMAL_DATA_W, VEC
    ),
}
