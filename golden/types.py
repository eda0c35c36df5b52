# SPDX-License-Identifier: Apache-2.0
"""Packed structures: what travels together on wires, in FIFOs and in packets; the one source for RTL and Python.

``make generate`` writes them into ``rtl/shade_pkg.sv`` as ``typedef struct packed``; :func:`pack` and :func:`unpack`
make the same bits from arrays. The first field stands at the bottom: x below y below z. A field may be a structure
itself; its parts are named with dots, ``span.normal.x``, here as in SystemVerilog.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import contract as k
from .fixed import Int


@dataclass(frozen=True)
class Field:
    """Bits of a register, a packet or a structure. ``format``: S and U numbers, or "" for a code or a count.

    ``lsb``: the lowest of its bits. ``struct``: what it consists of. ``path``: the leaf of ``draw_t`` or ``status_t``
    that a register's field is.
    """

    name: str
    width: int
    meaning: str
    format: str = ""
    lsb: int = 0
    reset: int = 0
    struct: Struct | None = None
    path: str = ""

    @property
    def range(self) -> tuple[int, int]:
        """The least and the largest value that the bits can hold."""
        half = 1 << self.width - 1
        return (-half, half - 1) if self.format.startswith("S") else (0, 2 * half - 1)

    @property
    def bits(self) -> str:
        """As in documentation: "16:0", or "3" for a single one."""
        return f"{self.lsb + self.width - 1}:{self.lsb}" if self.width > 1 else f"{self.lsb}"


@dataclass(frozen=True)
class Struct:
    """A packed structure, ``shade_pkg::<name>``; its fields from the lowest bits up.

    A field without a name is unused.
    """

    name: str
    meaning: str
    fields: tuple[Field, ...]

    @property
    def width(self) -> int:
        """Bits of all fields."""
        return sum(field.width for field in self.fields)

    def placed(self) -> tuple[Field, ...]:
        """The fields with ``lsb`` as it is in this structure."""
        lsb, found = 0, []
        for field in self.fields:
            found.append(replace(field, lsb=lsb))
            lsb += field.width
        return tuple(found)

    def leaves(self) -> Iterator[Field]:
        """The fields that hold numbers, from the lowest bits up, with names such as ``normal.x``.

        >>> [(field.name, field.lsb) for field in RECORD.leaves()][3:6]
        [('diffuse.n3', 54), ('specular.n0', 72), ('specular.n1', 90)]
        """
        for field in self.placed():
            if field.struct:
                for leaf in field.struct.leaves():
                    meaning = leaf.meaning or f"{field.meaning}, {leaf.name}"
                    yield replace(leaf, name=f"{field.name}.{leaf.name}", lsb=field.lsb + leaf.lsb, meaning=meaning)
            elif field.name:
                yield field

    def leaf(self, name: str) -> Field:
        """One of them by name."""
        return next(field for field in self.leaves() if field.name == name)


def pack(struct: Struct, values: Mapping[str, ArrayLike]) -> NDArray[np.uint32]:
    """Structures as words of 32 bits (..., words), least significant first: a beat of a stream.

    ``values``: a number or an array (...) for every leaf, by name. ValueError for a leaf that is missing or unknown,
    and for a value that its bits cannot hold.

    >>> pack(VEC, {"x": [1, -1], "y": 0, "z": 0}).tolist()
    [[1, 0], [262143, 0]]
    """
    leaves = list(struct.leaves())
    if wrong := values.keys() ^ {field.name for field in leaves}:
        raise ValueError(f"{struct.name}: {min(wrong)}, needed {', '.join(field.name for field in leaves)}")
    for field in leaves:
        array, (low, high) = np.asarray(values[field.name]), field.range
        if array.size and (array.min() < low or array.max() > high):
            raise ValueError(
                f"{struct.name}: {field.name}: {array.min()} .. {array.max()} given, allowed {low} .. {high}"
            )
    return words(leaves, [values[field.name] for field in leaves], struct.width)


def unpack(struct: Struct, beats: ArrayLike) -> dict[str, Int]:
    """The leaves by name, arrays (...), from words (..., words).

    >>> int(unpack(VEC, [262143, 0])["x"])
    -1
    """
    return dict(zip((field.name for field in struct.leaves()), numbers(struct.leaves(), beats), strict=True))


def whole(struct: Struct, values: Mapping[str, ArrayLike]) -> list[int]:
    """As :func:`pack`, each structure as one integer of Python, for test benches.

    >>> whole(VEC, {"x": [1], "y": [0], "z": [-1]})[0] == 1 + (2**18 - 1 << 36)
    True
    """
    beats = np.atleast_2d(pack(struct, values))
    return [int.from_bytes(beat.astype("<u4").tobytes(), "little") for beat in beats]


def words(fields: Iterator[Field] | list[Field], values: list[ArrayLike], width: int) -> NDArray[np.uint32]:
    """Numbers at ``field.lsb`` of a vector of ``width`` bits, as words (..., words); a field has at most 62 bits."""
    arrays = np.broadcast_arrays(*(np.asarray(value, np.int64) for value in values))
    count = -(-width // 32)
    found = np.zeros((count + 2, *arrays[0].shape), np.uint64)
    for field, value in zip(fields, arrays, strict=True):
        word, shift = divmod(field.lsb, 32)
        bits = value.view(np.uint64) & np.uint64((1 << field.width) - 1)
        for i, part in enumerate((bits & np.uint64(0xFFFFFFFF), bits >> np.uint64(32))):
            part = part << np.uint64(shift)
            found[word + i] |= part & np.uint64(0xFFFFFFFF)
            found[word + i + 1] |= part >> np.uint64(32)
    return np.ascontiguousarray(np.moveaxis(found[:count], 0, -1), np.uint32)


def numbers(fields: Iterator[Field] | list[Field], beats: ArrayLike) -> Iterator[Int]:
    """The other way round."""
    beats = np.asarray(beats).astype(np.uint64)
    beats = np.concatenate([beats, np.zeros((*beats.shape[:-1], 2), np.uint64)], -1)
    for field in fields:
        word, shift = divmod(field.lsb, 32)
        value = beats[..., word] >> np.uint64(shift) | beats[..., word + 1] << np.uint64(32 - shift)
        if shift:
            value = value | beats[..., word + 2] << np.uint64(64 - shift)
        rest = 64 - field.width
        value = np.asarray(value << np.uint64(rest)).view(np.int64) >> rest
        yield value if field.format.startswith("S") else value & (1 << field.width) - 1


# ---- the table ---------------------------------------------------------------------------------------------------


def _part(name: str, struct: Struct, meaning: str = "") -> Field:
    return Field(name, struct.width, meaning or struct.meaning, struct=struct)


def _unused(width: int) -> Field:
    return Field("", width, "ignored")


def _vector(name: str, meaning: str, width: int, format: str, names: Iterable[str] = "xyz") -> Struct:
    return Struct(name, meaning, tuple(Field(part, width, "", format) for part in names))


VEC = _vector("vec_t", "a vector; of a node, before it is normalized, S2.15", k.INTENSITY_W, "S1.16")
STEP = _vector("step_t", "an interpolated normal, or what it grows by", k.STEP_W, "S2.29")
RGB = _vector("rgb_t", "weights of red, green and blue", k.PIXEL_W + 1, "U1.16", "rgb")

# ---- packets

SPAN = Struct(
    "span_t",
    "a span: a triangle's pixels on one raster line, as scan conversion finds them",
    (
        _part("normal", STEP, "interpolated normal of the first pixel"),
        _part("increment", STEP, "its increment per pixel, the same for all spans of a triangle (P4)"),
        Field("count", k.COUNT_W, f"pixels, 1 to {k.PIXELS_MAX}"),
        _unused(16 - k.COUNT_W),
        Field("tag", k.TAG_W, "given back with every pixel"),
        Field("cosine", k.INTENSITY_W, "of the angle between the end normals, for V1 and V2", "S1.16"),
        Field("flat", 1, "the triangle passed P2's criterion: no normalizing in diffuse light"),
        _unused(31 - k.INTENSITY_W),
    ),
)
HEAD = Struct(
    "head_t",
    "a record, without the light at its nodes",
    (
        Field("count", k.COUNT_W, f"pixels, 1 to {k.PIXELS_MAX}"),
        Field("more", 1, "the span goes on in the next record: no tlast after this one"),
        Field("degree", k.DEGREE_W, "DEGREE_*"),
        Field("tag", k.TAG_W, "given back with every pixel"),
        Field("log2", k.LOG2_W, "log2 of the arc in pixels: the least with count - 1 <= 2^log2"),
    ),
)
CHANNEL = Struct(
    "channel_t",
    "light of one channel at the nodes of a record",
    tuple(Field(f"n{i}", k.INTENSITY_W, "", "S1.16") for i in range(k.NODE_COUNT)),
)
RECORD = Struct(
    "record_t",
    "a record: the light at the nodes of one polynomial",
    (
        _part("diffuse", CHANNEL, "diffuse light at its nodes"),
        _part("specular", CHANNEL, "specular light at its nodes"),
        _part("head", HEAD),
        _unused(12),
    ),
)
GROWTH = Struct(
    "growth_t",
    "what an interpolated normal grows by from pixel to pixel, or from line to line",
    (
        _part("mantissa", VEC, "increment times 2^exp"),
        Field("exp", k.TRIANGLE_EXP_W, "as wide as it fits, so that no bit is lost"),
        _unused(10 - k.TRIANGLE_EXP_W),
    ),
)
TRIANGLE = Struct(
    "triangle_t",
    "a triangle: its interpolated normal is a linear function of column and line; its runs follow in the same packet",
    (
        Field("columns", k.COUNT_W, "of the box of all pixels, 1 to 4096"),
        _unused(16 - k.COUNT_W),
        Field("lines", k.COUNT_W, "of the box of all pixels, 1 to 4096"),
        _unused(16 - k.COUNT_W),
        Field("left", k.PLACE_W, "columns of the box on the left of the reference pixel"),
        Field("flat", 1, "the triangle passed P2's criterion: no normalizing in diffuse light"),
        _unused(15 - k.PLACE_W),
        Field("tag", k.TAG_W, "given back with every pixel"),
        _part("normal", VEC, "interpolated normal at the reference pixel: the first one of the first run"),
        _unused(10),
        _part("dcolumn", GROWTH, "its increment per column (P4)"),
        _part("dline", GROWTH, "its increment per line"),
    ),
)
"""A sliver is sent as one triangle for each run where an increment, times the largest power of two below the size of
the box (at least 1), is not within [-2, 2): far pixels would be wrong. With one column ``dcolumn`` is 0, with one line
``dline``."""
RUN = Struct(
    "run_t",
    "a run: pixels of the triangle on one raster line; runs come line by line, downwards, at least one a triangle",
    (
        Field("column", k.PLACE_W, "its first pixel"),
        _unused(16 - k.PLACE_W),
        Field("line", k.PLACE_W, "its raster line"),
        _unused(16 - k.PLACE_W),
        Field(
            "count",
            k.COUNT_W,
            "pixels, at least 1; also 0 in a triangle's last run, and in its first, whose place counts",
        ),
        _unused(32 - k.COUNT_W),
    ),
)
OUTWARD = _vector("outward_t", "a normal of any length but 0, components in [-1, 1)", 32, "S15.16")
VERTEX = Struct(
    "vertex_t",
    "a vertex of a triangle, after projection; of tag and flat those of the first one count",
    (
        Field("x", 32, "column in 1/256 pixel, -32768 to 32768 pixels; column 0 has its centre at 128", "S23.8"),
        Field("y", 32, "line in 1/256 pixel, downwards", "S23.8"),
        Field("depth", 32, "0 to 1 - 2^-24, less is nearer", "U8.24"),
        _part("normal", OUTWARD),
        Field("tag", k.TAG_W, "given back with every pixel"),
        Field("flat", 1, "the triangle passed P2's criterion: no normalizing in diffuse light"),
        _unused(47),
    ),
)

# ---- from vertices to triangles

SHORT = _vector("short_t", "a normal", k.VERTEX_W, "S0.16")
CORNER = Struct(
    "corner_t",
    "what a triangle has of its vertex 0",
    (
        Field("x", k.COORDINATE_W + 1, "plus 127", "S16.8"),
        Field("y", k.COORDINATE_W + 1, "plus 127", "S16.8"),
        _part("normal", SHORT),
        Field("depth", k.DEPTH_F, "", "U0.24"),
        Field("tag", k.TAG_W, ""),
        Field("flat", 1, ""),
    ),
)
SIZED = Struct(
    "sized_t",
    "a triangle without its increments",
    (
        _part("corner", CORNER),
        Field("left", k.COUNT_W, "first column of the box"),
        Field("right", k.COUNT_W, "the one behind its last"),
        Field("bottom", k.COUNT_W, "the line behind its last"),
        Field("wide", 1, "its differences of x and y are wider than 17 bits"),
    ),
)
SIDE = Struct(
    "side_t",
    "an edge of a triangle, see shade_edges",
    (
        Field("dx", k.COORDINATE_W + 1, "", "S16.8"),
        Field("dy", k.COORDINATE_W, "", "U16.8"),
        Field("column", k.LINE_W, "", "S17"),
        Field("line", k.LINE_W, "", "S17"),
        Field("lines", k.LINE_W, ""),
        Field("u", k.SUBPIXEL_F, ""),
        Field("t", k.SUBPIXEL_F, ""),
        Field("right", 1, ""),
    ),
)
EDGE = Struct(
    "edge_t",
    "an edge, from its first line on, see shade_edges",
    (
        Field("rest", k.REST_W, "", "S26"),
        Field("dx", k.COORDINATE_W + 1, "", "S16.8"),
        Field("dy", k.COORDINATE_W, "", "U16.8"),
        Field("column", k.LINE_W, "", "S17"),
        Field("line", k.LINE_W, "", "S17"),
        Field("lines", k.LINE_W, ""),
        Field("right", 1, ""),
    ),
)
WALKED = Struct(
    "walked_t",
    "a run as shade_raster gives it",
    (
        Field("column", k.PLACE_W, ""),
        Field("line", k.PLACE_W, ""),
        Field("count", k.COUNT_W, ""),
        Field("last", 1, "of its triangle"),
        Field("none", 1, "no run: it stands for the end of a triangle"),
    ),
)
SITE = Struct(
    "site_t",
    "a pixel of the frame",
    (Field("column", k.PLACE_W, ""), Field("line", k.PLACE_W, "")),
)
PAIR = Struct(
    "pair_t",
    "increments of a component: S10.29 of a normal, S9.30 of a depth, modulo their widths",
    (
        Field("column", k.GROWTH_W, "", "S10.29"),
        Field("line", k.GROWTH_W, "", "S10.29"),
        Field("steep", 1, "one of them is not in S2.29, S1.30"),
    ),
)
PLANE = Struct(
    "plane_t",
    "normal and depth, or what they grow by, modulo 4",
    (_part("normal", STEP), Field("depth", k.STEP_W, "", "S1.30")),
)
SPOT = Struct(
    "spot_t",
    "where a span begins: its first pixel, and depth there and per pixel, modulo 4",
    (
        Field("column", k.PLACE_W, ""),
        Field("line", k.PLACE_W, ""),
        Field("depth", k.STEP_W, "", "S1.30"),
        Field("increase", k.STEP_W, "", "S1.30"),
    ),
)
SURFACE = Struct(
    "surface_t",
    "a triangle whose runs follow on a stream of their own",
    (
        _part("value", PLANE, "at the first pixel of the first run"),
        _part("dcolumn", PLANE),
        _part("dline", PLANE),
        _part("site", SITE, "that pixel"),
        Field("columns", k.COUNT_W, "of a box that holds all pixels"),
        Field("lines", k.COUNT_W, ""),
        Field("left", k.PLACE_W, "columns of the box on the left of the first pixel"),
        Field("tag", k.TAG_W, ""),
        Field("flat", 1, ""),
        Field("steep", 1, "an increment of its normal is not in S2.29: what stands here is it modulo 8"),
    ),
)
BEGUN = Struct(
    "begun_t",
    "a run, and what its triangle's normal and depth are where it begins",
    (
        _part("surface", SURFACE),
        _part("value", PLANE, "at the first pixel of the run"),
        _part("run", WALKED),
        Field("first", 1, "of its triangle"),
    ),
)
DEEP = Struct(
    "deep_t",
    "the depth of a pixel",
    (_part("site", SITE), Field("depth", k.DEPTH_F, "", "U0.24")),
)
TESTED = Struct(
    "tested_t",
    "a pixel whose depth is compared",
    (
        _part("deep", DEEP),
        Field("ends", 1, "the last pixel of its run"),
        Field("last", 1, "of its triangle"),
    ),
)
VIEW = Struct(
    "view_t",
    "the frame, and what of a triangle is drawn in it; to be changed between frames only",
    (
        Field("columns", k.COUNT_W, "1 to 4096"),
        Field("lines", k.COUNT_W, "1 to 4096"),
        Field("cull", k.CULL_W, "CULL_*"),
        Field("flat", 1, "all of a triangle has the normal of vertex 0"),
    ),
)
FATE = Struct(
    "fate_t",
    "what became of a triangle, or of a packet that gives none",
    (
        Field("packet", 1, "skipped: other than three vertices"),
        Field("range", 1, "skipped: a number out of its range"),
        Field("normal", 1, "skipped: a normal of length 0"),
        Field("area", 1, "skipped: no area"),
        Field("culled", 1, "left out: seen from the side that is culled"),
        Field("outside", 1, "left out: outside of the frame"),
        Field("between", 1, "left out: between the centres of pixels"),
    ),
)
SKIPPED = Struct(
    "skipped_t",
    "how many triangles and packets were skipped since reset, each saturating",
    tuple(
        Field(name, 16, meaning)
        for name, meaning in (
            ("packet", "packets of other than three vertices"),
            ("range", "a number out of its range"),
            ("normal", "a normal of length 0"),
            ("area", "no area"),
            ("culled", "seen from the side that is culled"),
            ("empty", "without a pixel in the frame"),
        )
    ),
)
RGB8 = _vector("rgb8_t", "a pixel of a picture", 8, "U0.8", ("red", "green", "blue"))
LOBE = Struct(
    "lobe_t",
    "the head of a packet that fills the table of the lobe; entries follow, a beat each, from the first one on",
    (
        Field("shift", k.CHORD_SHIFT_W, "the table covers x = 1 - cos from 0 to 2^-shift"),
        _unused(16 - k.CHORD_SHIFT_W),
        Field("excess", k.EXCESS_W, "|H| - 1 of the quantized H", "S-15.24"),
        _unused(47 - 16 - k.EXCESS_W),
        Field("lobe", 1, "1; of a triangle 0"),
        _unused(16),
    ),
)
CHORD = Struct(
    "chord_t",
    "an entry of the table of the lobe",
    (
        Field("value", k.INTENSITY_F + 1, "specular light at its x", "U1.16"),
        Field("slope", k.CHORD_SLOPE_W, "what it grows by to the next entry", "S-6.20"),
    ),
)
SCALARS = Struct(
    "scalars_t",
    "the scalars of a pixel, from which its light is computed",
    (
        Field("a", k.DIRECT_A_W, "N.L", "S1.24"),
        Field("h", k.DIRECT_H_W, "N.H", "S1.28"),
        Field("p", k.DIRECT_P_W, "N.N", "U1.36"),
    ),
)
COEFFICIENTS = Struct(
    "coefficients_t",
    "the scalars of a triangle as polynomials of column and line",
    (
        *(Field(f"a{part}", k.DIRECT_A_W, "N.L", "S1.24") for part in ("", "_column", "_line")),
        *(Field(f"h{part}", k.DIRECT_H_W, "N.H", "S1.28") for part in ("", "_column", "_line")),
        Field("p", k.DIRECT_P_W, "N.N", "U1.36"),
        Field("p_column", k.DIRECT_P_W, "what it grows by to the next column", "U1.36"),
        Field("p_line", k.DIRECT_P_W, "what it grows by to the next line", "U1.36"),
        Field("p_columns", k.DIRECT_P_W, "half of what p_column grows by per column", "U1.36"),
        Field("p_lines", k.DIRECT_P_W, "half of what p_line grows by per line", "U1.36"),
        Field("p_both", k.DIRECT_P_W, "what p_column grows by per line", "U1.36"),
    ),
)
START = Struct(
    "start_t",
    "a run that is ready to be stepped",
    (
        _part("at", SCALARS, "the scalars at its first pixel"),
        Field("p_column", k.DIRECT_P_W, "what p grows by to the next pixel", "U1.36"),
        Field("a_column", k.DIRECT_A_W, "what a grows by per pixel", "S1.24"),
        Field("h_column", k.DIRECT_H_W, "what h grows by per pixel", "S1.28"),
        Field("p_columns", k.DIRECT_P_W, "half of what p_column grows by per pixel", "U1.36"),
        Field("count", k.COUNT_W, f"pixels, 1 to {k.PIXELS_MAX}"),
        Field("tag", k.TAG_W, "the triangle's"),
    ),
)
MOVES = Struct(
    "moves_t",
    "how a run's first pixel is reached from that of the run before",
    (
        Field("lines", k.COUNT_W, "lines down, beside the one that every start makes"),
        Field("columns", k.COUNT_W, "columns to the right, negative: to the left", "S12.0"),
        Field("good", 1, "the run is drawn"),
        Field("first", 1, "the triangle's first run: no moves"),
        Field("last", 1, "the triangle's last run"),
        Field("count", k.COUNT_W, "its pixels"),
        Field("tag", k.TAG_W, "the triangle's"),
    ),
)
WAITING = Struct(
    "waiting_t",
    "a run that waits for its triangle's coefficients",
    (
        Field("column", k.PLACE_W, "its first pixel"),
        Field("line", k.PLACE_W, "its raster line"),
        Field("count", k.COUNT_W, "its pixels"),
        Field("first", 1, "the triangle's first run"),
        Field("last", 1, "the triangle's last run"),
        Field("tag", k.TAG_W, "the triangle's"),
    ),
)
PIXEL = _vector("pixel_t", "a pixel", k.PIXEL_W, "U0.16", ("diffuse", "specular"))
COLOURED = _vector("coloured_t", "a coloured pixel", k.PIXEL_W, "U0.16", ("red", "green", "blue"))

# ---- normals

UNIT = Struct(
    "unit_t",
    "a unit normal",
    (
        _part("normal", VEC),
        Field("zero", 1, "made of a vector of length 0"),
        Field("too_short", 1, "made of a vector shorter than 1/8: not of unit length"),
    ),
)
INVC = Struct(
    "invc_t",
    "what the middle of two unit normals needs",
    (
        Field("invc", k.INVC_F, "what their sum is multiplied by", "U0.18"),
        Field("half", k.INTENSITY_W, "cosine of half their angle", "S1.16"),
        Field("clamped", 1, "their cosine was not in [0, 1]"),
    ),
)
METRIC = Struct(
    "metric_t",
    "how long the middle of two unit normals is, by P4's estimates",
    (
        Field("d1a", k.INTENSITY_W, "by the ends of their line", "S1.16"),
        Field("d2", k.INTENSITY_W, "by the two", "S1.16"),
        Field("needs_d1", 1, "d1a is below the threshold"),
        Field("needs_d2", 1, "d2 is below the threshold"),
        Field("clamped", 1, "the cosine was not in [0, 1]"),
        Field("m_error", 1, "m was not in 3 .. 12"),
        Field("threshold_error", 1, "the threshold was not in [0, 1]"),
    ),
)
CHOICE = Struct(
    "choice_t",
    "how the middle of two unit normals is made",
    (
        Field("middle", 1, "0: it is the first of both"),
        Field("variant", k.VARIANT_W, "VARIANT_*"),
        Field("needs_d1", 1, "d1a is below the threshold"),
        Field("threshold", k.INTENSITY_W, "of d2", "S1.16"),
    ),
)
MIDDLE = Struct(
    "middle_t",
    "the unit normal in the middle of two",
    (
        _part("normal", VEC),
        Field("half", k.INTENSITY_W, "cosine of half their angle", "S1.16"),
        Field("clamped", 1, "their cosine was not in [0, 1]"),
    ),
)
ARC = Struct(
    "arc_t",
    "unit normals along an arc",
    (
        *(_part(f"n{i}", VEC, f"at {i}/4") for i in range(5)),
        Field("clamped", 1, "the cosine of its ends was not in [0, 1]"),
    ),
)

COSINES = _vector(
    "cosines_t", "of the angles between the normals of a triangle", k.INTENSITY_W, "S1.16", ("ab", "bc", "ca")
)
CRITERION = Struct(
    "criterion_t",
    "whether a triangle's normals must be normalized, by P2",
    (
        Field("eta", k.ETA_W, "how much too dark it gets otherwise", "S1.18"),
        Field("normalize", 1, "eta is above the threshold"),
        Field("clamped", 1, "a cosine was not in [0, 1]"),
        Field("threshold_error", 1, "the threshold was not in [0, 1]"),
    ),
)

# ---- from a span to its pixels

JOB = Struct(
    "job_t",
    "a span on its way to its nodes",
    (
        _part("normal", STEP, "interpolated normal of the first pixel"),
        _part("increment", STEP, "its increment per pixel"),
        Field("flat", 1, "its normals need no normalizing"),
        Field("tag", k.TAG_W, "given back with every pixel"),
    ),
)
STRETCH = Struct(
    "stretch_t",
    "records of one kind, one after the other",
    (
        _part("normal", STEP, "of its first pixel"),
        _part("step", STEP, "increment of a normal from node to node"),
        Field("tag", k.TAG_W, "of the span"),
        Field("flat", 1, "its normals need no normalizing"),
        Field("degree", k.DEGREE_W, "of its records"),
        Field("log2", k.LOG2_W, "of the arc of a record"),
        Field("count", k.COUNT_W, "pixels of a record"),
        Field("records", k.COUNT_W, "their number"),
        Field("single", 1, "it is 1"),
        Field("more", 1, "the span goes on behind it"),
        Field("shared", 1, "its first node is the last one before"),
        Field("fresh", 1, "the first of a span"),
    ),
)
PLAN = Struct(
    "plan_t",
    "how a span is cut into records",
    (
        Field("main", k.COUNT_W, "records before the last one"),
        Field("log2", k.LOG2_W, "log2 of their pixels"),
        Field("degree", k.DEGREE_W, "their degree"),
        Field("last_count", k.COUNT_W, "pixels of the last record"),
        Field("last_log2", k.LOG2_W, "log2 of the arc that it lies on"),
        Field("last_degree", k.DEGREE_W, "its degree"),
        Field("split", 1, "main is not 0"),
    ),
)
TOKEN = Struct(
    "token_t",
    "a pixel before it is computed: the record's nodes and where on its arc it lies",
    (
        _part("diffuse", CHANNEL),
        _part("specular", CHANNEL),
        Field("degree", k.DEGREE_W, "of the record"),
        Field("first", 1, "a segment starts"),
        Field("last", 1, "the last pixel of a span"),
        Field("t", k.T_F + 1, "place on the arc", "U1.16"),
        Field("log2", k.LOG2_W, "of the arc"),
        Field("tag", k.TAG_W, "of the span"),
    ),
)
DRAWN = Struct(
    "drawn_t",
    "a pixel on its way out",
    (
        _part("pixel", PIXEL),
        Field("tag", k.TAG_W, "of its span"),
        Field("last", 1, "the last pixel of the span"),
    ),
)
PLACE = Struct(
    "place_t",
    "where a node stands in its record",
    (
        Field("slot", 2, "number of the node"),
        Field("shared", 1, "first node of a record whose slot 0 is the node before"),
        Field("last", 1, "the record is complete"),
        _part("head", HEAD, "the record, taken with its last node"),
    ),
)
NODE = Struct(
    "node_t",
    "a point where light is computed",
    (
        _part("normal", VEC, "its normal"),
        Field("flat", 1, "the normal needs no normalizing"),
        _part("place", PLACE),
    ),
)
INTENSITY = _vector("intensity_t", "light at a point", k.INTENSITY_W, "S1.16", ("diffuse", "specular"))
FLAGS = Struct(
    "flags_t",
    "what can be said of the light at a point",
    (
        Field("model", 1, "a reserved model, or one that was not built in"),
        Field("range", 1, "a cosine outside [-1, 1]"),
        Field("zero", 1, "a denominator of 0: no specular light"),
        Field("saturated", 1, "light beyond its format"),
    ),
)
ANGLES = Struct(
    "angles_t",
    "the cosines at a point",
    (
        Field("diffuse", k.INTENSITY_W, "N.L, saturated", "S1.16"),
        Field("nl", k.INTENSITY_F + 1, "N.L in [0, 1]", "U1.16"),
        Field("nv", k.INTENSITY_F + 1, "N.V in [0, 1]", "U1.16"),
        Field("x", k.VERSINE_W, "1 less the cosine that the lobe is a function of", "U2.26"),
        Field("saturated", 1, "N.L was beyond its format"),
        Field("nl_range", 1, "N.L was outside [-1, 1]"),
        Field("nv_range", 1, "N.V was outside [-1, 1]"),
        Field("x_range", 1, "x was outside [0, 2]"),
    ),
)
FACTOR = Struct(
    "factor_t",
    "what a lobe is multiplied by: num (1 + w) 2^e",
    (
        Field("num", k.INTENSITY_F + 1, "", "U1.16"),
        Field("w", k.FACTOR_F, "", "S0.18"),
        Field("e", k.FACTOR_EXP_W, "", "S6.0"),
        Field("zero", 1, "there is none: a denominator of 0"),
    ),
)
COEF = Struct(
    "coef_t",
    "A t^3 + B t^2 + C t + D",
    (
        Field("d", k.INTENSITY_W, "", "S1.16"),
        *(Field(name, k.COEF_W, "", f"S{k.COEF_W - k.INTENSITY_F - 1}.16") for name in "cba"),
    ),
)

# ---- settings and status

CONTROL = Struct(
    "control_t",
    "the way through the core",
    (
        Field("path", 1, "0: polynomials, 1: a unit normal at every pixel"),
        Field("colour", 1, "pixels are 0: diffuse and specular light, 1: weighted red, green, blue"),
        Field("variant", k.VARIANT_W, "of path 1, VARIANT_*"),
        Field("fixed_degree", k.DEGREE_W, "0: adaptive, 1 to 3: of every span, as in P1"),
    ),
)
PLANNER = Struct(
    "planner_t",
    "what the planner goes by",
    (
        Field("sharpness", k.SHARPNESS_F + 1, "n of the cos^n that turns as fast as the highlight, mantissa", "U1.16"),
        Field("sharpness_exp", k.SHARPNESS_EXP_W, "and exponent, 0 to 12"),
        Field("weight", k.WEIGHT_W, "how many times kappa is halved at most where the highlight is far; 0: not at all"),
        Field("t1", k.KAPPA_W, "kappa up to which a line is enough", "U11.20"),
        Field("t2", k.KAPPA_W, "kappa up to which a parabola is enough", "U11.20"),
        Field("t3", k.KAPPA_W, "kappa up to which a cubic is enough", "U11.20"),
        Field("threshold", k.INTENSITY_W, "V1, V2, V4, V5: a shorter middle is normalized", "S1.16"),
    ),
)
HIGHLIGHT = Struct(
    "highlight_t",
    "the lobe of a material",
    (
        Field("k1", k.LOBE_K1_W, "of the lobe, for the scaled x", "U1.20"),
        Field("k2", k.LOBE_K2_W, "of the lobe, for the scaled x", "S0.17"),
        Field("xmax", k.LOBE_X_F + 1, "limit of the scaled x", "U1.16"),
        Field(
            "shift",
            k.LOBE_SHIFT_W,
            f"x is scaled by 2^shift; {k.LOBE_FINE}: not, but k1 and k2 are by {1 << k.LOBE_FINE_F}",
        ),
        Field("power", k.LOBE_POWER_W, "squarings of the lobe, 0 to 4; more count as 4"),
    ),
)
MATERIAL = Struct(
    "material_t",
    "a material",
    (
        Field("model", k.MODEL_W, "MODEL_*"),
        Field("cosine", 1, "specular light is multiplied by N.L"),
        _part("lobe", HIGHLIGHT),
        Field("inv_n", k.INTENSITY_F + 1, "Schlick: 1/n, mantissa", "U1.16"),
        Field("inv_n_exp", k.INV_EXP_W, "and negative exponent"),
        Field("gain", k.GAIN_F + 1, "of specular light, mantissa", "U1.16"),
        Field("gain_exp", k.GAIN_EXP_W, "and exponent", "S5.0"),
        Field("f0", k.INTENSITY_F + 1, "Fresnel's factor at V.H = 1, where it is computed at every node", "U1.16"),
    ),
)  # fmt: skip
LIGHT = Struct(
    "light_t",
    "a directional light",
    (
        _part("l", VEC, "direction to the light"),
        _part("h", VEC, "half way between it and the viewer's"),
        Field("vh", k.INTENSITY_F + 1, "V.H", "U1.16"),
    ),
)
COLOUR = Struct(
    "colour_t",
    "the colours of surface and light",
    (
        _part("ambient", RGB, "ambient light"),
        _part("kd", RGB, "weight of diffuse light"),
        _part("ks", RGB, "weight of specular light"),
    ),
)
DRAW = Struct(
    "draw_t",
    "the settings of a draw call: what can be written, docs/registers.md",
    (
        _part("control", CONTROL),
        _part("planner", PLANNER),
        _part("material", MATERIAL),
        _part("light", LIGHT),
        _part("colour", COLOUR),
    ),
)
COUNTS = Struct(
    "counts_t",
    "by how much the counters rise in a clock",
    tuple(Field(name, 3, "") for name in ("pixels", "spans", "stalls", "evaluations", "errors")),
)
PAINTED = Struct(
    "painted_t",
    "a coloured pixel on its way out",
    (
        _part("pixel", COLOURED),
        Field("tag", k.TAG_W, "of its span"),
        Field("last", 1, "the last pixel of the span"),
    ),
)
NODE_FLAGS = Struct(
    "node_flags_t",
    "what can be said of a point: its light and its normal",
    (
        _part("light", FLAGS),
        Field("normal_zero", 1, "a normal of length 0"),
        Field("normal_short", 1, "a normal too short to be brought to length 1"),
    ),
)
ERRORS = Struct(
    "errors_t",
    "faults of a span",
    (
        Field("empty", 1, "a span of 0 pixels"),
        Field("too_long", 1, f"a span of more than {k.PIXELS_MAX} pixels"),
        Field("packet", 1, "a packet cut short or too long"),
        Field("metric", 1, "V1, V2: fewer than 3 sectors or more than 12"),
        Field("threshold", 1, "threshold outside [0, 1]"),
    ),
)
TOLD = Struct(
    "told_t",
    "what is told of a packet of spans, once for each",
    (
        Field("good", 1, "it was a span"),
        Field("bad", 1, "it was none"),
        _part("error", ERRORS),
    ),
)
STATUS = Struct(
    "status_t", "what STATUS remembers", (_part("error", ERRORS), _part("node", NODE_FLAGS)),
)  # fmt: skip

STRUCTS: dict[str, Struct] = {part.name: part for part in list(globals().values()) if isinstance(part, Struct)}


def constants() -> dict[str, int]:
    """Bits of every structure, VEC_BITS of ``vec_t``: for widths of ports, where there is no signal to ask."""
    return {f"{name.removesuffix('_t').upper()}_BITS": struct.width for name, struct in STRUCTS.items()}
