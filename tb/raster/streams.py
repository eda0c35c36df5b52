# SPDX-License-Identifier: Apache-2.0
"""Structures at ports, and outputs that only have a valid bit."""

from __future__ import annotations

import random
from collections.abc import Sequence

import cocotb
from polyshade.golden.types import STRUCTS, numbers

from tb.bench import Bench


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


class Watch:
    """Collects what ports hold in clocks with a valid bit; gives a credit back for each, sooner or later."""

    def __init__(self, bench: Bench, valid: str, ports: Sequence[str], credit: str = "", thrift: float = 0.0):
        self.bench, self.thrift, self.words = bench, thrift, []
        self._valid, self._ports = getattr(bench.dut, valid), [getattr(bench.dut, port) for port in ports]
        self._credit = getattr(bench.dut, credit) if credit else None
        cocotb.start_soon(self._run())

    async def _run(self) -> None:
        owed = 0
        while True:
            pay = owed > 0 and random.random() >= self.thrift
            if self._credit is not None:
                self._credit.value = pay
            await self.bench.tick()
            owed -= pay
            if int(self._valid.value) and not int(self.bench.dut.rst_i.value):
                self.words.append(tuple(int(port.value) for port in self._ports))
                owed += 1
