"""Packets: the functions that pack them put every field where the tables say, and fields do not overlap."""

import numpy as np
import pytest
from polyshade.golden import contract as k
from polyshade.golden.normal import pack_lines
from polyshade.golden.packets import LINE, PACKETS, RUN, SPAN, TRIANGLE, Packet, members
from polyshade.golden.packets import pack as pack_packet
from polyshade.golden.poly import pack_spans
from polyshade.golden.registers import Field


def whole(words: np.ndarray) -> int:
    """One beat as a number."""
    return int.from_bytes(words.astype("<u4").tobytes(), "little")


def line(field: Field, value: int) -> int:
    values = {f.name: value if f is field else 0 for f in LINE.fields}
    vectors = [[[values[f"{name}_{axis}"] for axis in "xyz"]] for name in ("normal", "increment")]
    return whole(pack_lines(*vectors, *([values[name]] for name in ("count", "cosine", "tag", "flat")))[0])


def span(field: Field, value: int) -> int:
    values = {f.name: value if f is field else 0 for f in SPAN.fields}
    nodes = [[[values[f"{c}_{i}"] for i in range(k.NODE_COUNT)] for c in ("diffuse", "specular")]]
    return whole(pack_spans(nodes, *([values[name]] for name in ("degree", "count", "tag", "more")))[0])


def triangle(field: Field, value: int) -> int:
    return whole(pack_packet(TRIANGLE, **{field.name: [value]})[0])


def run(field: Field, value: int) -> int:
    return whole(pack_packet(RUN, **{field.name: [value]})[0])


@pytest.mark.parametrize(
    "pack, packet",
    [(line, LINE), (span, SPAN), (triangle, TRIANGLE), (run, RUN)],
    ids=["LINE", "SPAN", "TRIANGLE", "RUN"],
)
def test_every_field_is_where_the_table_says(pack, packet: Packet) -> None:
    for field in packet.fields:
        for value in {field.range[0], field.range[1], 1}:
            value = max(value, -1) if field.width == 1 else value
            assert pack(field, value) == (value & (1 << field.width) - 1) << field.lsb, field.name


@pytest.mark.parametrize("name", PACKETS)
def test_fields_do_not_overlap(name: str) -> None:
    used = 0
    for field in PACKETS[name].fields:
        bits = (1 << field.width) - 1 << field.lsb
        assert not used & bits and bits < 1 << PACKETS[name].width, field.name
        used |= bits


@pytest.mark.parametrize("packet", [TRIANGLE, RUN], ids=["TRIANGLE", "RUN"])
def test_a_structure_has_every_bit_once(packet: Packet) -> None:
    end = packet.width
    for field in members(packet):
        end -= field.width
        assert field.lsb == end
    assert end == 0


def test_an_unknown_field_is_refused() -> None:
    with pytest.raises(ValueError, match="colour: no field of this packet"):
        pack_packet(RUN, colour=[1])
