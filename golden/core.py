# SPDX-License-Identifier: Apache-2.0
"""The shading core: spans of interpolated normals in, shaded pixels out. Mirrors ``rtl/core``.

The stages of ``golden`` in the order of the data's way; nothing is computed here that is not one of theirs.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import contract as k
from . import registers
from .fixed import Int, integers, saturate
from .light import colour, light
from .normal import line_errors, pixel_normals
from .plan import Nodes, line
from .poly import poly_span
from .types import NODE_FLAGS


class Drawn(NamedTuple):
    """What a core makes of its spans: ``pixels`` (P, 2) U0.16, diffuse and specular; ``span`` (P,) of every pixel.

    ``flags`` (T,): bits of ``node_flags_t`` of every place where light was computed, T in number; ``records``: their
    number.
    """

    pixels: Int
    span: Int
    flags: Int
    records: int


class Told(NamedTuple):
    """What a core gives and tells: ``pixels`` (P, 2), or coloured (P, 3), U0.16; ``span`` (P,) of each.

    ``counters`` and ``status``: by the names of ``golden.registers``, what does not depend on the clock.
    """

    pixels: Int
    span: Int
    counters: dict[str, int]
    status: dict[str, int]


def collect(nodes: Nodes, intensity: ArrayLike) -> Int:
    """Intensities (R, 2, 4) at the nodes of every record from those (T, 2) of all nodes, in order (``shade_collect``).

    A shared node is the one that came last; slots that a record does not use are 0.
    """
    (intensity,) = integers(intensity)
    records = np.zeros((len(nodes.span), k.CHANNELS, k.NODE_COUNT), np.int64)
    records[nodes.record, :, nodes.slot] = intensity
    at = np.flatnonzero(nodes.shared)
    records[nodes.record[at], :, 0] = intensity[at - 1]
    return records


def lane(
    n: ArrayLike, g: ArrayLike, count: ArrayLike, draw: Mapping[str, int], *, flat: ArrayLike = 0,
    cosine: ArrayLike = 0, evaluator: int = k.EVALUATOR_FDIFF, form: int = k.FORM_REFINED, reflect: int = 1,
    divide: int = 1, path_normals: int = 1, log2_max: int = k.RECORD_LOG2,
) -> Drawn:  # fmt: skip
    """The pixels of spans of 1 .. 4096 pixels: ``n``, ``g`` (S, 3) S2.29, normal and increment (``shade_lane``).

    ``draw``: settings by the names of ``golden.registers``, others as reset leaves them. ``flat``: the triangle passed
    P2's criterion: with Lambert's light alone a line without normalizing. ``cosine``: of the span's ends, S1.16, for V1
    and V2 of path normals, which ``path_normals`` = 0 leaves out.

    >>> from polyshade.golden.material import Material, planner_registers, registers
    >>> surface = Material("lambert")
    >>> draw = registers(surface, (0, 0, 1)) | planner_registers(surface)
    >>> lane([[0, 0, 1 << 29]], [[0, 0, 0]], [2], draw).pixels.tolist()
    [[65535, 0], [65535, 0]]
    """
    n, g = integers(n, g)
    count, flat, cosine = integers(count, flat, cosine)
    draw = registers.after_reset() | dict(draw)
    if path_normals and draw["path"] == k.PATH_NORMALS:
        normal, span = pixel_normals(n, g, count, cosine, draw["variant"], draw["threshold"])
        diffuse, specular, flags = light(*normal.T, draw, form, reflect, divide)
        return Drawn(saturate(np.stack([diffuse, specular], -1), k.PIXEL_W), span, flags, len(span))

    nodes, normal, zero, short = line(n, g, count, draw, flat, log2_max)
    diffuse, specular, flags = light(*normal.T, draw, form, reflect, divide)
    flags = flags | zero << NODE_FLAGS.leaf("normal_zero").lsb | short << NODE_FLAGS.leaf("normal_short").lsb
    records = collect(nodes, np.stack([diffuse, specular], -1))
    pixels, record = poly_span(records, nodes.degree, nodes.count, evaluator=evaluator, form=form)
    return Drawn(pixels, nodes.span[record], flags, len(nodes.span))


def counted(drawn: Drawn) -> tuple[dict[str, int], dict[str, int]]:
    """Counters, and bits of STATUS that tell of points, by the names of ``golden.registers``, when all is drawn."""
    flags = int(np.bitwise_or.reduce(drawn.flags, initial=0))
    counters = {"pixels": len(drawn.pixels), "spans": len(np.unique(drawn.span)), "evaluations": len(drawn.flags)}
    told = (field for field in registers.faults() if field.path.startswith("node."))
    return counters, {field.name: flags >> bit & 1 for bit, field in enumerate(told)}


def core(
    n: ArrayLike, g: ArrayLike, count: ArrayLike, draw: Mapping[str, int], *, torn: ArrayLike = 0,
    flat: ArrayLike = 0, cosine: ArrayLike = 0, colour: int = 0, path_normals: int = 1, **built: int,
) -> Told:  # fmt: skip
    """Spans as packets, of any length (``shade_core``). Which lane draws a span depends on which of them has room.

    ``torn`` (S,): packets cut short or too long. Of these, of spans of 0 pixels and of more than 4096 nothing comes.
    ``colour``: pixels are coloured. Others as in ``lane``.

    >>> told = core([[0, 0, 1 << 29]] * 3, [[0, 0, 0]] * 3, [1, 0, 1], {})
    >>> told.span.tolist(), told.counters["errors"], told.status["error_empty"]
    ([0, 2], 1, 1)
    """
    n, g = integers(n, g)
    count, torn, flat, cosine = np.broadcast_arrays(*integers(count, torn, flat, cosine))
    draw = registers.after_reset() | dict(draw)
    empty, long = count == 0, count > k.PIXELS_MAX
    good = np.flatnonzero(~(empty | long | (torn > 0)))
    drawn = lane(
        n[good], g[good], count[good], draw, flat=flat[good], cosine=cosine[good], path_normals=path_normals, **built
    )
    counters, status = counted(drawn)
    normals = path_normals and draw["path"] == k.PATH_NORMALS
    metric, threshold = (np.any(bits) for bits in line_errors(count[good], draw["variant"], draw["threshold"]))
    status |= {
        "error_empty": np.any(empty & (torn == 0)),
        "error_long": np.any(long & (torn == 0)),
        "error_packet": np.any(torn),
        "error_metric": normals and metric,
        "error_threshold": normals and threshold,
    }
    return Told(
        paint(drawn.pixels, draw) if colour else drawn.pixels, good[drawn.span],
        counters | {"errors": len(count) - len(good)}, {name: int(bit) for name, bit in status.items()},
    )  # fmt: skip


def paint(pixels: ArrayLike, draw: Mapping[str, int]) -> Int:
    """Coloured pixels (P, 3), U0.16, from diffuse and specular light (P, 2), U0.16 (``shade_paint``).

    With ``colour`` set in ``draw`` red, green, blue; else the light as it is, and 0.

    >>> paint([[32768, 0]], {"colour": 1, "ambient_r": 6554}).tolist()
    [[39322, 32768, 32768]]
    """
    (pixels,) = integers(pixels)
    draw = registers.after_reset() | dict(draw)
    if not draw["colour"]:
        return np.pad(pixels, ((0, 0), (0, 1)))
    weights = ([draw[f"{name}_{channel}"] for channel in "rgb"] for name in ("ambient", "kd", "ks"))
    return colour(pixels[:, :1], pixels[:, 1:], *weights)


def phong(
    n: ArrayLike, g: ArrayLike, count: ArrayLike, draw: Mapping[str, int], *, form: int = k.FORM_REFINED,
    reflect: int = 1, divide: int = 1,
) -> tuple[Int, Int]:  # fmt: skip
    """A unit normal and light at every pixel (``shade_phong``): (pixels (P, 2) U0.16, index of their span (P,)).

    Spans as in ``lane``.

    >>> phong([[0, 0, 1 << 29]], [[0, 0, 0]], [2], {})[0].tolist()  # Lambert's light from the viewer
    [[65535, 0], [65535, 0]]
    """
    normal, span = pixel_normals(n, g, count, 0, k.VARIANT_EXACT, k.METRIC_THRESHOLD)
    diffuse, specular, _ = light(*normal.T, registers.after_reset() | dict(draw), form, reflect, divide)
    return saturate(np.stack([diffuse, specular], -1), k.PIXEL_W), span


def products(
    g: ArrayLike, drawn: Drawn, *, evaluator: int = k.EVALUATOR_FDIFF, reflect: int = 1, divide: int = 1
) -> int:
    """How many products of two 18-bit numbers ``shade_lane`` executes for what it has drawn on the path of polynomials.

    kappa's of every span whose increment is not that of the span before, its weight's of every span, those of a normal
    and of its light at every node, Horner's at every pixel. A wide multiplication counts as the two that it is cut
    into.

    >>> products([[0, 0, 0]], lane([[0, 0, 1 << 29]], [[0, 0, 0]], [2], {}), reflect=0, divide=0)  # 4 + 3 + 2 (8 + 15)
    53
    """
    (g,) = integers(g)
    increments = len(g[:1]) + int(np.count_nonzero(np.any(g[1:] != g[:-1], axis=-1)))
    evaluation = k.CHANNELS * k.PRODUCTS_HORNER if evaluator == k.EVALUATOR_HORNER else 0
    return (
        k.PRODUCTS_KAPPA * increments
        + k.PRODUCTS_WEIGHT * len(g)
        + (k.PRODUCTS_UNIT + _light_products(reflect, divide)) * len(drawn.flags)
        + evaluation * len(drawn.pixels)
    )


def phong_products(pixels: int, *, reflect: int = 1, divide: int = 1) -> int:
    """How many of them ``shade_phong`` executes for so many pixels.

    >>> phong_products(2, reflect=0, divide=0)  # 2 (11 + 15)
    52
    """
    return (k.PRODUCTS_NORMALIZE + _light_products(reflect, divide)) * pixels


def _light_products(reflect: int, divide: int) -> int:
    return k.PRODUCTS_LIGHT + k.PRODUCTS_REFLECT * reflect + k.PRODUCTS_DIVIDE * divide


class RegisterFile:
    """The registers as a bus sees them (``shade_registers``): ``words`` by name, without STATUS.busy.

    ``built``: parameters of ``registers.built``.
    Two lowest bits of an offset do not count. Accesses tell by False that they are answered with an error.

    >>> file = RegisterFile()
    >>> file.write(0x94, 98304), file.read(0x94), file.write(0, 1), file.read(0), file.read(16)
    (True, (98304, True), True, (1347635268, True), (0, False))
    """

    def __init__(self, **built: int) -> None:
        self.at = {register.offset: register for register in registers.every()}
        there = {field.name for field in registers.built(**built)}
        self.kept = {
            register.name: [field for field in register.fields if register.access == "ro" or field.name in there]
            for register in self.at.values()
        }
        self.words = {name: sum(field.reset << field.lsb for field in fields) for name, fields in self.kept.items()}

    def read(self, offset: int, busy: bool = False) -> tuple[int, bool]:
        """The word at a byte offset, 0 and an error where there is no register."""
        register = self.at.get(offset & ~3)
        if not register:
            return 0, False
        return self.words[register.name] | (busy and register.name == "STATUS"), True

    def write(self, offset: int, word: int, strobe: int = 0b1111, busy: bool = False) -> bool:
        """Write the bytes of a word that ``strobe`` names; an error changes nothing."""
        register = self.at.get(offset & ~3)
        if not register or register.access == "ro":
            return register is not None
        before = self.words[register.name]
        chosen = sum(0xFF << 8 * i for i in range(4) if strobe >> i & 1)
        word = word & chosen | before & ~chosen
        clears = register.name == "CONTROL" and word >> 31 == 1
        absent = (f for f in register.fields if f not in self.kept[register.name] and f.name != "clear")
        absent = sum((1 << field.width) - 1 << field.lsb for field in absent)
        if busy and not (clears and (word ^ before) & ~absent == 1 << 31):
            return False
        if clears:
            self.clear()
        kept = sum((1 << field.width) - 1 << field.lsb for field in self.kept[register.name])
        self.words[register.name] = word & kept
        return True

    def clear(self) -> None:
        """What CONTROL.clear does: counters and STATUS become 0."""
        self.words |= dict.fromkeys(("STATUS", *(register.name for register in registers.GROUPS["Counters"])), 0)

    def count(self, events: int = 0, **increments: int) -> None:
        """What a clock adds: bits ``events`` of STATUS by the order of ``registers.faults``, counters by name."""
        for bit, fault in enumerate(registers.faults()):
            self.words["STATUS"] |= (events >> bit & 1) << fault.lsb
        for name, increment in increments.items():
            self.words[name.upper()] = self.words[name.upper()] + increment & 0xFFFFFFFF
