"""What the checks of all formats share."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from math import isfinite


class Damage(Exception):
    """What is wrong with a file; the caller adds the file's name."""


@dataclass(frozen=True)
class Checked:
    """What a check found out about a file."""

    triangles: int  # that must come out when the file is read
    cuts: int  # of its polygons: a quad takes one
    data: bytes  # to be read


def decode(data: bytes) -> str:
    """The text of a file, its lines ended by ``\\n`` whatever ended them; raises Damage when it is binary.

    Only comments and names can hold other than ASCII characters, so their encoding does not matter.
    """
    if re.search(rb"[\0-\x08\x0b\x0c\x0e-\x1f]", data):
        raise Damage("holds binary data where text is expected")
    return data.decode("utf-8", errors="replace").replace("\r\n", "\n").replace("\r", "\n")


def numbers(words: Iterable[str], where: str) -> list[float]:
    """The finite numbers that the words spell; raises Damage, telling where, when they do not."""
    try:
        values = [float(word) for word in words]
    except ValueError as error:
        raise Damage(f"{where}: {error}") from None
    if not all(map(isfinite, values)):
        raise Damage(f"{where}: a number is not finite, {values}")
    return values
