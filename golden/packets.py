"""The packets of the streams as data: the one source for ``docs/interface.md``; positions are those of the contract.

One packet is one beat of an AXI4-Stream, but for a triangle, which is six, followed by its runs. :func:`pack` makes
beats from a table; ``golden.normal.pack_lines`` and ``golden.poly.pack_spans`` are older, a test holds them to these.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import contract as k
from .fixed import integers
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
TRIANGLE = Packet(
    "s_axis_surface of shade_direct and of the patches, m_axis_surface of shade_raster, first six beats of a packet",
    k.TRIANGLE_DATA_W,
    "a triangle: its interpolated normal is a linear function of column and line; its runs follow in the same packet",
    (
        *_vector("normal", 0, "interpolated normal at the reference pixel"),
        *_vector("dcolumn", 3 * k.STEP_W, "its increment per column (P4)"),
        *_vector("dline", 6 * k.STEP_W, "its increment per line"),
        Field(
            "column", k.PLACE_W, "of the reference pixel: the first pixel of the first run", lsb=k.TRIANGLE_COLUMN_LSB
        ),
        Field("line", k.PLACE_W, "of the reference pixel: the first line of the box", lsb=k.TRIANGLE_LINE_LSB),
        Field("columns", k.COUNT_W, "of the box of all pixels, 1 to 4096", lsb=k.TRIANGLE_COLUMNS_LSB),
        Field("lines", k.COUNT_W, "of the box of all pixels, 1 to 4096", lsb=k.TRIANGLE_LINES_LSB),
        Field("tag", k.TAG_W, "given back with every pixel", lsb=k.TRIANGLE_TAG_LSB),
        Field("left", k.PLACE_W, "columns of the box on the left of the reference pixel", lsb=k.TRIANGLE_LEFT_LSB),
        Field("flat", 1, "the triangle passed P2's criterion: no normalizing in diffuse light", lsb=k.TRIANGLE_FLAT),
    ),
)
"""``dcolumn`` 2^kx and ``dline`` 2^ky are within [-2, 2), where 2^kx, at least 1, is the largest power of two that is
less than ``columns``, and 2^ky likewise of ``lines``. Slivers that do not fit are sent as one triangle for each run:
``lines`` is then 1 and ``dline`` 0. With one column ``dcolumn`` is 0."""
RUN = Packet(
    "the same stream, all other beats of a packet; tlast comes with the last run",
    k.RUN_DATA_W,
    "a run: pixels of the triangle on one raster line; runs come line by line, downwards, at least one a triangle",
    (
        Field("column", k.PLACE_W, "its first pixel", lsb=k.RUN_COLUMN_LSB),
        Field("line", k.PLACE_W, "its raster line", lsb=k.RUN_LINE_LSB),
        Field("count", k.COUNT_W, "pixels, at least 1; in a triangle's last run also 0", lsb=k.RUN_COUNT_LSB),
    ),
)
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
PACKETS = {
    "LINE": LINE,
    "SPAN": SPAN,
    "TRIANGLE": TRIANGLE,
    "RUN": RUN,
    "PIXEL": PIXEL,
    "COLOURED": COLOURED,
    "NORMAL": NORMAL,
}


def pack(packet: Packet, **values: ArrayLike) -> NDArray[np.uint32]:
    """Beats (S, words) of a packet from its fields by name; those not named are 0, bits beyond a field are cut.

    >>> pack(RUN, column=[5], line=[6], count=[7]).tolist()
    [[393221, 7]]
    """
    unknown = values.keys() - {field.name for field in packet.fields}
    if unknown:
        raise ValueError(f"{min(unknown)}: no field of this packet")
    columns = dict(zip(values, integers(*values.values()), strict=True))
    rows = max((column.size for column in columns.values()), default=1)
    words = np.zeros((rows, packet.width // 32), np.uint32)
    for field in packet.fields:
        value = columns.get(field.name, np.zeros(rows, np.int64)) & (1 << field.width) - 1
        words[:, field.lsb // 32] |= (value << field.lsb % 32).astype(np.uint32)  # no field crosses a word
    return words


def members(packet: Packet) -> tuple[Field, ...]:
    """The fields as a packed structure has them, the one at the top first; between them what is not used."""
    found: list[Field] = []
    end = 0
    for field in (*packet.fields, Field("", 0, "", lsb=packet.width)):
        if field.lsb > end:
            found.append(Field(f"unused_{end}", field.lsb - end, "", lsb=end))
        found += [field] if field.width else []
        end = field.lsb + field.width
    return tuple(found[::-1])
