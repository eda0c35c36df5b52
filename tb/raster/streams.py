# SPDX-License-Identifier: Apache-2.0
"""Structures at ports."""

from __future__ import annotations

from polyshade.golden.types import STRUCTS, numbers


def word(name: str, **values: int) -> int:
    """A structure as bits; what is not named is 0. ``normal__x`` stands for ``normal.x``."""
    leaves = {leaf.name: leaf for leaf in STRUCTS[name].leaves()}
    return sum(
        (int(value) & (1 << leaves[part].width) - 1) << leaves[part].lsb
        for part, value in ((key.replace("__", "."), value) for key, value in values.items())
    )


def fields(name: str, bits: int) -> dict[str, int]:
    """The numbers in a structure."""
    leaves = list(STRUCTS[name].leaves())
    beats = [bits >> 32 * i & 0xFFFFFFFF for i in range(-(-STRUCTS[name].width // 32))]
    return {leaf.name: int(value) for leaf, value in zip(leaves, numbers(leaves, beats), strict=True)}
