"""Fixed-point steps that every unit shares: round, saturate, multiply, a third.

Mirrors ``rtl/fixed``. All arguments and results are ``int64`` arrays of any shape (or Python integers); x with f
fraction bits stands for x / 2^f.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from golden.contract import FORM_PAPER, FORM_REFINED

Int = NDArray[np.int64]


def integers(*values: ArrayLike) -> tuple[Int, ...]:
    """The arguments as int64 arrays of one shape. TypeError for anything that is not an integer."""
    arrays = [np.asarray(value) for value in values]
    for array in arrays:
        if array.dtype.kind not in "iub":
            raise TypeError(f"integers expected, not {array.dtype}")
    return tuple(np.broadcast_arrays(*(array.astype(np.int64) for array in arrays)))


def round(x: ArrayLike, drop: int) -> Int:
    """floor(x / 2^drop + 1/2): drop fraction bits, to nearest, ties towards plus infinity (``shade_round``).

    >>> [int(round(x, 2)) for x in (5, 6, -6, -7)]
    [1, 2, -1, -2]
    """
    (x,) = integers(x)
    return (x + (1 << drop >> 1)) >> drop


def saturate(x: ArrayLike, out_w: int) -> Int:
    """min(max(x, 0), 2^out_w - 1) (``shade_saturate``).

    >>> [int(saturate(x, 4)) for x in (-1, 7, 15, 16)]
    [0, 7, 15, 15]
    """
    (x,) = integers(x)
    return np.clip(x, 0, (1 << out_w) - 1)


def mul(a: ArrayLike, b: ArrayLike) -> Int:
    """a b, exact (``shade_mul``).

    >>> int(mul(-3, 5))
    -15
    """
    a, b = integers(a, b)
    return a * b


def third(x: ArrayLike, form: int = FORM_REFINED) -> Int:
    """x / 3 in the format of x (``shade_third``).

    Refined: the integer nearest to x / 3; there are no ties. Paper: x/2 - x/8 - x/32 - x/128 = 43 x / 128 (P1,
    Fig. 7), rounded once to nearest, ties up.

    >>> int(third(100)), int(third(-100)), int(third(100, FORM_PAPER)), int(third(-100, FORM_PAPER))
    (33, -33, 34, -34)
    """
    (x,) = integers(x)
    if form == FORM_PAPER:
        return round(64 * x - 16 * x - 4 * x - x, 7)
    return (2 * x + 3) // 6
