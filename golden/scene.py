# SPDX-License-Identifier: Apache-2.0
"""Whole pictures: triangles, depth test, light at every pixel, frame buffer. Mirrors ``rtl/raster/shade_scene*``."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import contract as k
from . import raster
from .fixed import Int, integers, round
from .stream import walk


def level(c: ArrayLike) -> Int:
    """A colour U0.16 to the 8 bits of a picture, floor(255 c / 2^16 + 1/2) (``shade_scene_level``).

    >>> level([0, 128, 129, 32768, 65535]).tolist()
    [0, 0, 1, 128, 255]
    """
    (c,) = integers(c)
    return round(255 * c, k.PIXEL_W)


def sites(column: Int, line: Int, count: Int) -> tuple[Int, Int]:
    """(column, line) of the pixels of runs (``shade_scene_sites``)."""
    run, step = walk(count)
    return column[run] + step, line[run]


def scene(
    s: raster.Scanned, view: raster.View, shade: Callable[[dict[str, NDArray]], Int], background: ArrayLike
) -> Int:
    """The picture of scanned triangles (lines, columns, 3), 8 bits a channel (``shade_scene``).

    ``shade``: packets to colours (P, 3) U0.16 of all their pixels.
    """
    size = 1 << k.PLACE_W
    seen, _ = raster.depth(s, np.full((size, size), raster.FARTHEST + 1))
    return raster.frame(
        view, background, *sites(seen.column, seen.line, seen.count), level(shade(raster.packets(seen)))
    )
