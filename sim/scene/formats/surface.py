# SPDX-License-Identifier: Apache-2.0
"""What the readers of all formats share: what they return, how they refuse, how text becomes numbers."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.integer]

SMOOTH = 60.0
"""Degrees between two faces up to which the normals that a file lacks run smoothly across their edge."""


class Damage(Exception):
    """What is wrong with a file; the caller adds the file's name."""


@dataclass(frozen=True)
class Surface:
    """A file's faces in the file's own units and axes, polygons as they are.

    ``corners`` are the points of all faces, end to end; ``sizes`` says how many each face has. ``normal_of`` gives the
    row of ``normals`` for each corner, -1 where the file has none. Normals may be of any length, or not finite.
    """

    points: Floats  # (V, 3)
    corners: Ints  # (C,)
    sizes: Ints  # (F,)
    normals: Floats | None = None  # (N, 3)
    normal_of: Ints | None = None  # (C,); None with normals: a point's normal has the point's number
    crease: float = SMOOTH  # what the format wants for absent normals, in degrees
    repairs: dict[str, int] = field(default_factory=dict)  # what had to be passed over


def decode(data: bytes) -> bytes:
    """A text file's bytes, without byte order mark and trailing control-Z, its lines ended by ``\\n``.

    Only comments and names can hold other than ASCII characters, so their encoding does not matter.
    Raises Damage when the file is binary.
    """
    text = data.removeprefix(b"\xef\xbb\xbf").rstrip(b"\x1a\r\n\t ")
    if re.search(rb"[\0-\x08\x0b\x0c\x0e-\x1f]", text):
        raise Damage("holds binary data where text is expected")
    return text.replace(b"\r\n", b"\n").replace(b"\r", b"\n") if b"\r" in text else text


def numbers(words: Iterable[bytes], where: str, finite: bool = True) -> list[float]:
    """The numbers that the words spell; raises Damage, telling where, when they do not, or are not finite."""
    try:
        values = [float(word) for word in words]
    except ValueError as error:
        raise Damage(f"{where}: {error}") from None
    if finite and not all(-np.inf < value < np.inf for value in values):
        raise Damage(f"{where}: a number is not finite, {values}")
    return values


def integers(words: Iterable[bytes], where: str) -> list[int]:
    """The integers that the words spell; raises Damage, telling where, when they do not."""
    words = list(words)
    if not all(word.isdigit() or (word[:1] in b"+-" and word[1:].isdigit()) for word in words):
        raise Damage(f"{where}: {b' '.join(words).decode(errors='replace')!r} are no integers")
    return [int(word) if len(word) < 19 else 1 << 62 for word in words]  # more digits than any index has


def without_small(corners: Ints, sizes: Ints, *along: Ints) -> tuple[dict[str, int], Ints, Ints, list[Ints]]:
    """Leave out faces of fewer than three corners, and count them; ``along``: other arrays with a row a corner."""
    small = sizes < 3
    if not small.any():
        return {}, corners, sizes, list(along)
    keep = np.repeat(~small, sizes)
    return {"dropped_faces": int(small.sum())}, corners[keep], sizes[~small], [each[keep] for each in along]
