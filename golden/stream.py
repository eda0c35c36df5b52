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


def widen(word: ArrayLike, last: ArrayLike, words: int) -> tuple[Int, Int, Int]:
    """Narrow words (W,) and their tlast as beats: words (B, ``words``), which of them came, tlast (``shade_widen``).

    >>> [v.tolist() for v in widen([7, 8, 9], [0, 0, 1], 2)]
    [[[7, 8], [9, 0]], [[1, 1], [1, 0]], [0, 1]]
    """
    word, last = integers(word, last)
    end = np.flatnonzero(np.r_[last[:-1], 1])  # of packets
    start = np.r_[0, end + 1][: end.size]
    within = np.arange(word.size) - np.repeat(start, end + 1 - start)
    beat = np.cumsum(within % words == 0) - 1
    beats, came, ends = np.zeros((beat[-1] + 1, words), np.int64), np.zeros((beat[-1] + 1, words), np.int64), []
    beats[beat, within % words], came[beat, within % words] = word, 1
    ends = last[np.flatnonzero(np.r_[np.diff(beat), 1])]
    whole = came[:, -1] | ends  # a beat that nothing ends does not leave
    return beats[whole == 1], came[whole == 1], ends[whole == 1]
