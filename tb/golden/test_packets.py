# SPDX-License-Identifier: Apache-2.0
"""Packets: the functions that pack them put every field where the tables say."""

import numpy as np
import pytest
from polyshade.golden import contract as k
from polyshade.golden.normal import pack_spans
from polyshade.golden.packets import PACKETS
from polyshade.golden.poly import pack_records
from polyshade.golden.types import Field


def whole(words: np.ndarray) -> int:
    """One beat as a number."""
    return int.from_bytes(words.astype("<u4").tobytes(), "little")


def span(values: dict[str, int]) -> np.ndarray:
    vectors = [[[values[f"{name}.{axis}"] for axis in "xyz"]] for name in ("normal", "increment")]
    return pack_spans(*vectors, *([values[name]] for name in ("count", "cosine", "tag", "flat")))[0]


def record(values: dict[str, int]) -> np.ndarray:
    nodes = [[[values[f"{c}.n{i}"] for i in range(k.NODE_COUNT)] for c in ("diffuse", "specular")]]
    return pack_records(nodes, *([values[f"head.{name}"]] for name in ("degree", "count", "tag", "more")))[0]


@pytest.mark.parametrize("name, pack", [("SPAN", span), ("RECORD", record)])
def test_every_field_is_where_the_table_says(name: str, pack) -> None:
    log2 = sum((1 << f.width) - 1 << f.lsb for f in PACKETS[name].fields if f.name == "head.log2")
    fields = [f for f in PACKETS[name].fields if f.name != "head.log2"]

    def one(field: Field, value: int) -> int:
        """Without log2 of a span, which follows from its count."""
        return whole(pack({f.name: value if f is field else 0 for f in fields})) & ~log2

    for field in fields:
        for value in {*field.range, 1} if field.width > 1 else {1}:
            assert one(field, value) == (value & (1 << field.width) - 1) << field.lsb, field.name


@pytest.mark.parametrize("name", PACKETS)
def test_widths(name: str) -> None:
    """A packet is as wide as its stream, which may have more bits."""
    assert PACKETS[name].struct.width <= PACKETS[name].width
    assert PACKETS[name].struct.width == PACKETS[name].width or name == "NORMAL"


def test_where_the_constants_say() -> None:
    """Positions of the contract are those of the structures."""
    found = {packet: {f.name: f.lsb for f in PACKETS[packet].fields} for packet in PACKETS}
    assert [found["SPAN"][n] for n in ("count", "tag", "cosine", "flat")] == [
        k.SPAN_COUNT_LSB, k.SPAN_TAG_LSB, k.SPAN_COS_LSB, k.SPAN_FLAT,
    ]  # fmt: skip
    assert [found["RECORD"][f"head.{n}"] for n in ("count", "more", "degree", "tag")] == [
        k.RECORD_COUNT_LSB, k.RECORD_MORE, k.RECORD_DEGREE_LSB, k.RECORD_TAG_LSB,
    ]  # fmt: skip
    beats = {"columns": 0, "normal.x": 1, "dcolumn.mantissa.x": 2, "dline.mantissa.x": 3}
    assert {name: found["TRIANGLE"][name] for name in beats} == {n: 64 * beat for n, beat in beats.items()}
    assert [found["RUN"][n] for n in ("column", "line", "count")] == [0, 16, 32]
