# SPDX-License-Identifier: Apache-2.0
"""Flow: what a handshake lets through, step by step. Mirrors ``rtl/stream``."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .fixed import Int, integers


def walk(count: ArrayLike) -> tuple[Int, Int]:
    """The steps of a sequence of items of ``count`` (S,) steps each: (index of the item, step in it) (``shade_walk``).

    >>> [v.tolist() for v in walk([2, 0, 1])]
    [[0, 0, 2], [0, 1, 0]]
    """
    (count,) = integers(count)
    item = np.repeat(np.arange(count.size), count)
    return item, np.arange(item.size) - np.repeat(np.cumsum(count) - count, count)
