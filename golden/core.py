"""The shading core: spans of interpolated normals in, shaded pixels out. Mirrors ``rtl/core``.

The stages of ``golden`` in the order of the data's way; nothing is computed here that is not one of theirs.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from golden import contract as k
from golden.fixed import Int, integers, saturate
from golden.light import light
from golden.normal import pixel_normals, unit
from golden.plan import Nodes, node_walk, planner
from golden.poly import poly_span
from golden.registers import after_reset


class Drawn(NamedTuple):
    """What a core makes of its spans: ``pixels`` (P, 2) U0.16, diffuse and specular; ``span`` (P,) of every pixel.

    ``flags`` (T,): bits LIGHT_* and LANE_* of every place where light was computed, T in number; ``records``: their
    number.
    """

    pixels: Int
    span: Int
    flags: Int
    records: int


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
    divide: int = 1,
) -> Drawn:  # fmt: skip
    """The pixels of spans of 1 .. 4096 pixels: ``n``, ``g`` (S, 3) S2.29, normal and increment (``shade_lane``).

    ``draw``: settings by the names of ``golden.registers``, others as reset leaves them. ``flat``: the triangle passed P2's criterion: with Lambert's
    light alone a line without normalizing. ``cosine``: of the span's ends, S1.16, for V1 and V2 of path normals.

    >>> from golden.material import Material, planner_registers, registers
    >>> surface = Material("lambert")
    >>> draw = registers(surface, (0, 0, 1)) | planner_registers(surface)
    >>> lane([[0, 0, 1 << 29]], [[0, 0, 0]], [2], draw).pixels.tolist()
    [[65535, 0], [65535, 0]]
    """
    n, g = integers(n, g)
    count, flat, cosine = integers(count, flat, cosine)
    draw = after_reset() | dict(draw)
    if draw["path"] == k.PATH_NORMALS:
        normal, span = pixel_normals(n, g, count, cosine, draw["variant"], draw["threshold"])
        diffuse, specular, flags = light(*normal.T, draw, form, reflect, divide)
        return Drawn(saturate(np.stack([diffuse, specular], -1), k.PIXEL_W), span, flags, len(span))

    flat = flat & (draw["model"] == k.MODEL_LAMBERT)
    thresholds = tuple(draw[name] for name in ("t1", "t2", "t3"))
    sharpness = draw["sharpness"], draw["sharpness_exp"]
    planned = planner(*g.T, count, *sharpness, thresholds, draw["fixed_degree"], flat)
    nodes = node_walk(n, g, *planned)
    owner = nodes.span[nodes.record]
    *normal, zero, short = unit(*nodes.vector.T, flat[owner])
    diffuse, specular, flags = light(*normal, draw, form, reflect, divide)
    flags = flags | zero << k.LANE_NORMAL_ZERO | short << k.LANE_NORMAL_SHORT
    records = collect(nodes, np.stack([diffuse, specular], -1))
    pixels, record = poly_span(records, nodes.degree, nodes.count, evaluator=evaluator, form=form)
    return Drawn(pixels, nodes.span[record], flags, len(nodes.span))
