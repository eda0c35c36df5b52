# SPDX-License-Identifier: Apache-2.0
"""Packed structures: there and back, one order, and what does not fit is refused."""

import numpy as np
import pytest
from polyshade.golden import types
from polyshade.golden.types import STRUCTS, Struct


@pytest.mark.parametrize("struct", STRUCTS.values(), ids=STRUCTS)
def test_there_and_back(struct: Struct) -> None:
    """Corners of every field, alone and with all bits of the others set; any rows; as words and as one integer."""
    leaves = list(struct.leaves())
    rng = np.random.default_rng(1)
    values = {f.name: rng.integers(*f.range, (3, 5), endpoint=True) for f in leaves}
    beats = types.pack(struct, values)
    assert beats.shape == (3, 5, -(-struct.width // 32)) and beats.dtype == np.uint32
    back = types.unpack(struct, beats)
    assert all(np.array_equal(back[f.name], values[f.name]) for f in leaves)
    for field in leaves:
        for value in field.range:
            one = types.whole(struct, {f.name: value if f is field else 0 for f in leaves})
            assert one == [(value & (1 << field.width) - 1) << field.lsb]


@pytest.mark.parametrize("struct", STRUCTS.values(), ids=STRUCTS)
def test_bits(struct: Struct) -> None:
    """No bit twice; the first field at the bottom; every part is in the table itself."""
    bits = [bit for f in struct.leaves() for bit in range(f.lsb, f.lsb + f.width)]
    assert bits == sorted(set(bits)) and bits[-1] < struct.width
    assert all(f.struct is None or STRUCTS[f.struct.name] is f.struct for f in struct.fields)
    assert all(f.width <= 62 for f in struct.leaves())


@pytest.mark.parametrize(
    "values, message",
    [
        ({"x": 1 << 17, "y": 0, "z": 0}, "vec_t: x: 131072 .. 131072 given, allowed -131072 .. 131071"),
        ({"x": 0, "y": 0}, "vec_t: z, needed x, y, z"),
        ({"x": 0, "y": 0, "z": 0, "w": 0}, "vec_t: w, needed x, y, z"),
    ],
)
def test_refusals(values: dict, message: str) -> None:
    with pytest.raises(ValueError) as raised:
        types.pack(types.VEC, values)
    assert str(raised.value) == message
