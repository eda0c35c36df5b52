# SPDX-License-Identifier: Apache-2.0
"""The register map: no overlaps, resets that fit, words there and back, the page and the package from one source."""

from __future__ import annotations

import re
import tomllib

import pytest
from polyshade.golden import material, registers
from polyshade.golden.material import MODELS, Material
from polyshade.golden.plan import THRESHOLDS
from polyshade.golden.types import DRAW, STATUS, pack, unpack
from polyshade.scripts.flow import generate
from polyshade.sim.sources import ROOT

ALL = list(registers.every())


def test_offsets_rise() -> None:
    """Multiples of 4, none twice."""
    offsets = [register.offset for register in ALL]
    assert all(offset % 4 == 0 for offset in offsets)
    assert offsets == sorted(set(offsets))


def test_fields() -> None:
    """Inside of 32 bits, none over another, names of their own."""
    names = [field.name for register in ALL for field in register.fields]
    assert len(names) == len(set(names))
    assert len({register.name for register in ALL}) == len(ALL)
    for register in ALL:
        bits = [bit for field in register.fields for bit in range(field.lsb, field.lsb + field.width)]
        assert len(bits) == len(set(bits)) and max(bits) < 32
        assert all(field.range[0] <= field.reset <= field.range[1] for field in register.fields)


def test_identification() -> None:
    """ "PSHD", most significant letter first, and the version of the package."""
    assert registers.ID.to_bytes(4, "big") == b"PSHD"
    assert tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"] == "{}.{}.{}".format(
        *registers.VERSION
    )
    assert registers.unpack(4, ALL[1].reset) == dict(zip(("major", "minor", "patch"), registers.VERSION, strict=True))


def test_after_reset() -> None:
    """Lambert's light from the viewer, and the planner's own thresholds."""
    reset = {field.name: field.reset for register in ALL for field in register.fields}
    surface = Material("lambert")
    facing = material.registers(surface, (0, 0, 1)) | material.planner_registers(surface)
    used = {"model", "cosine", "gain", "sharpness", "sharpness_exp", *material.light_registers((0, 0, 1))}
    assert all(reset[name] == facing[name] for name in used)
    assert (reset["t1"], reset["t2"], reset["t3"]) == THRESHOLDS


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("n", [1, 33.3, 1024])
@pytest.mark.parametrize("m", [0.05, 0.3, 0.7])
@pytest.mark.parametrize("form", ["paper", "refined"])
def test_there_and_back(model: str, n: float, m: float, form: str) -> None:
    """Whatever the material: every value has a field that holds it."""
    surface = Material(model, n, m, form=form)
    values = material.registers(surface, (-0.5, 0.2, -0.7)) | material.colour_registers(surface)
    values |= material.planner_registers(surface)
    words = registers.pack(values)
    assert all(0 <= word < 1 << 32 for word in words.values())
    back: dict[str, int] = {}
    for offset, word in words.items():
        back |= registers.unpack(offset, word)
    assert back == values


def test_all_that_a_driver_writes() -> None:
    """Control and the thresholds of planner and normals are all that does not come from a material."""
    surface = Material()
    values = material.registers(surface, (0, 0, 1)) | material.colour_registers(surface)
    values |= material.planner_registers(surface)
    fields = {field.name for register in ALL if register.access == "rw" for field in register.fields}
    control = {"path", "colour", "variant", "fixed_degree", "clear"}
    assert fields - values.keys() == control | {"t1", "t2", "t3", "threshold"}
    assert values.keys() <= fields


def test_fields_that_are_not_named_keep_their_reset() -> None:
    assert registers.pack({"sharpness_exp": 3}) == {0x40: 3 << 24 | 1 << 16}


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"k2": 1 << 17}, "k2: 131072 is out of range, allowed is -131072 to 131071"),
        ({"gain": -1}, "gain: -1 is out of range, allowed is 0 to 131071"),
        ({"pixels": 1}, "pixels: no field to write, allowed are those of docs/registers.md"),
        ({"gain": 1, "brightness": 1}, "brightness: no field to write, allowed are those of docs/registers.md"),
    ],
)
def test_refusals(values: dict, message: str) -> None:
    with pytest.raises(ValueError) as raised:
        registers.pack(values)
    assert str(raised.value) == message


def test_no_register() -> None:
    with pytest.raises(ValueError, match=r"0x3fc: no register, allowed are those of docs/registers\.md"):
        registers.unpack(0x3FC, 0)


# ---- what is generated -------------------------------------------------------------------------------------------


def test_the_page_has_every_field() -> None:
    page = generate.register_map()
    for register in ALL:
        assert f"| `{register.offset:#05x}` | `{register.name}` | {register.access} |" in page
        assert all(f"| {field.bits} | `{field.name}` | {field.format} |" in page for field in register.fields)


def test_the_example_of_the_page() -> None:
    (block,) = re.findall(r"```python\n(.*?)```", generate.register_map(), re.DOTALL)
    names: dict[str, dict] = {}
    exec(block, names)
    assert names["words"][0x80] == MODELS["cook-torrance"]


def test_the_structure_of_settings() -> None:
    """What was given, the rest as after reset, by the names of the structure; refusals are pack's."""
    given = {"path": 1, "gain_exp": -3, "k2": -5, "lx": -65536, "ks_b": 77}
    draw = registers.draw(given)
    assert draw.keys() == {leaf.name for leaf in DRAW.leaves()}
    back = unpack(DRAW, pack(DRAW, draw))
    for field in registers.settings():
        assert int(back[field.path]) == given.get(field.name, field.reset), field.name
    for values, message in (({"clear": 1}, "clear: no field to write"), ({"path": 2}, "path: 2 is out of range")):
        with pytest.raises(ValueError, match=message):
            registers.draw(values)


def test_settings_and_faults_are_structures() -> None:
    """Every leaf of draw_t has a register, every leaf of status_t a bit of STATUS, in its order."""
    assert sorted(field.path for field in registers.settings()) == sorted(leaf.name for leaf in DRAW.leaves())
    assert [field.path for field in registers.faults()] == [leaf.name for leaf in STATUS.leaves()]
