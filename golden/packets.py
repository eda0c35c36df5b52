"""The packets of the streams as data: the one source for ``docs/interface.md``; positions are those of the contract.

One packet is one beat of an AXI4-Stream. ``golden.normal.pack_lines`` and ``golden.poly.pack_spans`` make them; a test
holds them to these tables.
"""

from __future__ import annotations

from dataclasses import dataclass

from . import contract as k
from .registers import Field


@dataclass(frozen=True)
class Packet:
    """A beat: the stream's name, its width in bits, what it is, and its fields; bits without one are ignored."""

    stream: str
    width: int
    meaning: str
    fields: tuple[Field, ...]


def _vector(name: str, lsb: int, meaning: str) -> tuple[Field, ...]:
    return tuple(
        Field(f"{name}_{axis}", k.STEP_W, f"{meaning}, {axis}", "S2.29", lsb + k.STEP_W * i)
        for i, axis in enumerate("xyz")
    )


LINE = Packet(
    "s_axis_span of shade_core, s_axis_line of shade_pixel_normals",
    k.LINE_DATA_W,
    "a span: a triangle's pixels on one raster line, as scan conversion finds them",
    (
        *_vector("normal", 0, "interpolated normal of the first pixel"),
        *_vector("increment", 3 * k.STEP_W, "its increment per pixel, the same for all spans of a triangle (P4)"),
        Field("count", k.COUNT_W, f"pixels, 1 to {k.PIXELS_MAX}", lsb=k.LINE_COUNT_LSB),
        Field("tag", k.TAG_W, "given back with every pixel", lsb=k.LINE_TAG_LSB),
        Field("cosine", k.INTENSITY_W, "of the angle between the end normals, for V1 and V2", "S1.16", k.LINE_COS_LSB),
        Field("flat", 1, "the triangle passed P2's criterion: no normalizing in diffuse light", lsb=k.LINE_FLAT),
    ),
)
SPAN = Packet(
    "s_axis_span of shade_poly_span",
    k.SPAN_DATA_W,
    "a record: the light at the nodes of one polynomial",
    (
        *(
            Field(
                f"{channel}_{i}", k.INTENSITY_W, f"{channel} light at node {i}", "S1.16",
                k.INTENSITY_W * (k.NODE_COUNT * c + i),
            )
            for c, channel in enumerate(("diffuse", "specular"))
            for i in range(k.NODE_COUNT)
        ),
        Field("count", k.COUNT_W, f"pixels, 1 to {k.PIXELS_MAX}", lsb=k.SPAN_COUNT_LSB),
        Field("more", 1, "the span goes on in the next record: no tlast after this one", lsb=k.SPAN_MORE),
        Field("degree", k.DEGREE_W, "DEGREE_*", lsb=k.SPAN_DEGREE_LSB),
        Field("tag", k.TAG_W, "given back with every pixel", lsb=k.SPAN_TAG_LSB),
    ),
)  # fmt: skip
PIXEL = Packet(
    "m_axis_pixel of shade_core (COLOUR = 0 or CONTROL.colour = 0), shade_phong, shade_poly_span",
    k.PIXEL_DATA_W,
    "a pixel; tuser is the span's tag, tlast its last pixel",
    tuple(
        Field(name, k.PIXEL_W, f"{name} light", "U0.16", k.PIXEL_W * i)
        for i, name in enumerate(("diffuse", "specular"))
    ),
)
COLOURED = Packet(
    "m_axis_pixel of shade_core (COLOUR = 1 and CONTROL.colour = 1)",
    k.COLOUR_DATA_W,
    "a coloured pixel; tuser is the span's tag, tlast its last pixel",
    tuple(Field(name, k.PIXEL_W, "", "U0.16", k.PIXEL_W * i) for i, name in enumerate(("red", "green", "blue"))),
)
NORMAL = Packet(
    "m_axis_normal of shade_pixel_normals",
    k.NORMAL_DATA_W,
    "a unit normal; tuser is the line's tag, tlast its last normal",
    tuple(Field(axis, k.INTENSITY_W, "", "S1.16", k.INTENSITY_W * i) for i, axis in enumerate("xyz")),
)
PACKETS = {"LINE": LINE, "SPAN": SPAN, "PIXEL": PIXEL, "COLOURED": COLOURED, "NORMAL": NORMAL}
