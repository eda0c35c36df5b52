# SPDX-License-Identifier: Apache-2.0
"""The register map of the core: the one source for its AXI4-Lite slave, for drivers and for ``docs/registers.md``.

Registers of 32 bits, by byte offset. Fields of material and light bear the names that ``golden.material`` gives to
their values, so that ``pack(registers(material, light))`` is what a driver has to write. ``make generate``
takes offsets, positions and resets into ``rtl/shade_pkg.sv``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from . import contract as k
from .plan import THRESHOLDS
from .types import DRAW, ERRORS, FLAGS, STATUS, Field, Struct

VERSION = (0, 1, 0)
ID = int.from_bytes(b"PSHD", "big")


@dataclass(frozen=True)
class Register:
    """A word of the map. ``access``: rw, or ro: writing changes nothing."""

    name: str
    offset: int
    access: str
    fields: tuple[Field, ...]

    @property
    def reset(self) -> int:
        """The word after reset."""
        return sum(field.reset << field.lsb for field in self.fields)


def _group(offset: int, access: str, **registers: Field | tuple[Field, ...]) -> tuple[Register, ...]:
    """Registers one after another, each of one field or of several."""
    return tuple(
        Register(name, offset + 4 * i, access, fields if isinstance(fields, tuple) else (fields,))
        for i, (name, fields) in enumerate(registers.items())
    )


def _codes(prefix: str) -> str:
    """The contract's codes of this name: "0: lambert, 1: phong"."""
    names = {name.removeprefix(f"{prefix}_"): code for name, code in k.constants().items() if name.startswith(prefix)}
    return ", ".join(f"{code}: {name.lower().replace('_', '-')}" for name, code in names.items() if name != "W")


def _names(struct: Struct) -> list[str]:
    return [field.name for field in struct.leaves()]


def _put(path: str, lsb: int = 0, reset: int = 0, name: str = "", meaning: str = "") -> Field:
    """A setting, or a bit of STATUS, at a place in its register: a leaf of ``draw_t`` or ``status_t``."""
    leaf = (STATUS if path.startswith(("error.", "node.")) else DRAW).leaf(path)
    name = name or leaf.name.rpartition(".")[2]
    return replace(leaf, name=name, meaning=meaning or leaf.meaning, lsb=lsb, reset=reset, path=path)


def _vector(letter: str, meaning: str) -> dict[str, Field]:
    return {
        f"{letter}{axis}".upper(): _put(
            f"light.{letter}.{axis}", 0, _ONE if axis == "z" else 0, f"{letter}{axis}", f"{meaning}, {axis}"
        )
        for axis in "xyz"
    }


def _colour(name: str, meaning: str, reset: int) -> dict[str, Field]:
    return {
        f"{name}_{channel}".upper(): _put(
            f"colour.{name}.{channel}", 0, reset, f"{name}_{channel}", f"{meaning}, {word}"
        )
        for channel, word in {"r": "red", "g": "green", "b": "blue"}.items()
    }


_ONE = 1 << k.INTENSITY_F

GROUPS: dict[str, tuple[Register, ...]] = {
    "Core": (
        *_group(
            0x00,
            "ro",
            ID=Field("id", 32, '"PSHD"', reset=ID),
            VERSION=(
                Field("patch", 16, "version of these registers and of the packets", reset=VERSION[2]),
                Field("minor", 8, "compatible additions", lsb=16, reset=VERSION[1]),
                Field("major", 8, "incompatible changes", lsb=24, reset=VERSION[0]),
            ),
        ),
        *_group(
            0x08,
            "rw",
            CONTROL=(
                _put("control.path"),
                _put("control.colour", 1),
                _put("control.variant", 4, meaning=f"of path 1, {_codes('VARIANT')}"),
                _put("control.fixed_degree", 8),
                Field(
                    "clear",
                    1,
                    "writing 1: counters and STATUS become 0, also while busy; spans are not touched",
                    lsb=31,
                ),
            ),
        ),
        *_group(
            0x0C,
            "ro",
            STATUS=(
                Field("busy", 1, "spans are inside; the other bits stay until they are cleared"),
                *(
                    _put(f"error.{name}", 8 + i, name=f"error_{name.removeprefix('too_')}")
                    for i, name in enumerate(_names(ERRORS))
                ),
                *(_put(f"node.light.{name}", 16 + i, name=f"light_{name}") for i, name in enumerate(_names(FLAGS))),
                _put("node.normal_zero", 24),
                _put("node.normal_short", 25),
            ),
        ),
    ),
    "Counters": _group(
        0x20,
        "ro",
        PIXELS=Field("pixels", 32, "pixels given out, modulo 2^32, as are all counters"),
        SPANS=Field("spans", 32, "spans taken"),
        CLOCKS=Field("clocks", 32, "clocks with spans inside"),
        STALLS=Field("stalls", 32, "clocks in which a pixel waited to be taken"),
        EVALUATIONS=Field("evaluations", 32, "nodes or pixels at which light was computed"),
        ERRORS=Field("errors", 32, "faulty spans"),
    ),
    "Planner": _group(
        0x40,
        "rw",
        SHARPNESS=(
            _put("planner.sharpness", 0, _ONE),
            _put("planner.sharpness_exp", 24, 1),
            _put("planner.weight", 28),
        ),
        T1=_put("planner.t1", 0, THRESHOLDS[0]),
        T2=_put("planner.t2", 0, THRESHOLDS[1]),
        T3=_put("planner.t3", 0, THRESHOLDS[2]),
        THRESHOLD=_put("planner.threshold", 0, k.METRIC_THRESHOLD),
    ),
    "Material": _group(
        0x80,
        "rw",
        MODEL=(_put("material.model", meaning=_codes("MODEL")), _put("material.cosine", 8)),
        K1=_put("material.lobe.k1"),
        K2=_put("material.lobe.k2"),
        XMAX=(_put("material.lobe.xmax"), _put("material.lobe.shift", 24), _put("material.lobe.power", 28, 4)),
        INV_N=(_put("material.inv_n"), _put("material.inv_n_exp", 24)),
        GAIN=(_put("material.gain"), _put("material.gain_exp", 24)),
        F0=_put("material.f0"),
    ),
    "Light": _group(
        0xC0,
        "rw",
        **_vector("l", "direction to the light"),
        **_vector("h", "half way between it and the viewer's"),
        VH=_put("light.vh", 0, _ONE),
    ),
    "Colour": _group(
        0x100,
        "rw",
        **_colour("ambient", "ambient light", 0),
        **_colour("kd", "weight of diffuse light", _ONE),
        **_colour("ks", "weight of specular light", _ONE),
    ),
}
"""After reset: Lambert's light from the viewer on a white surface."""


def every() -> Iterator[Register]:
    """All of the map, by rising offset."""
    for group in GROUPS.values():
        yield from group


def settings() -> Iterator[Field]:
    """The fields that hold what was written: a draw call's settings."""
    for register in every():
        if register.access == "rw":
            yield from (field for field in register.fields if field.name != "clear")


def built(divide: int = 1, path_normals: int = 1, colour: int = 1) -> Iterator[Field]:
    """The settings that a core with these parameters has; others read 0, and writing them does nothing.

    >>> sorted({field.name for field in settings()} - {field.name for field in built(divide=0)})
    ['f0', 'inv_n', 'inv_n_exp', 'vh']
    """
    out: set[str] = set()
    if not divide:
        out |= {"material.inv_n", "material.inv_n_exp", "material.f0", "light.vh"}
    if not path_normals:
        out |= {"control.path", "control.variant", "planner.threshold"}
    if not colour:
        out |= {field.path for field in settings() if "colour" in field.path}
    yield from (field for field in settings() if field.path not in out)


def faults() -> Iterator[Field]:
    """The bits of STATUS that stay until they are cleared: all but ``busy``."""
    for register in every():
        if register.name == "STATUS":
            yield from register.fields[1:]


def after_reset() -> dict[str, int]:
    """The settings by name as reset leaves them."""
    return {field.name: field.reset for field in settings()}


def constants() -> dict[str, tuple[int, str]]:
    """Value and comment of REG_<register>, of _<FIELD>_LSB where it is not 0, of _RESET where the word is not 0."""
    found: dict[str, tuple[int, str]] = {}
    for register in every():
        name = f"REG_{register.name}"
        found[name] = register.offset, f"{register.offset:#05x}, {register.access}"
        found |= {f"{name}_{field.name.upper()}_LSB": (field.lsb, "") for field in register.fields if field.lsb}
        if register.reset:
            found[f"{name}_RESET"] = register.reset, f"{register.reset:#010x}"
    return found


def pack(values: Mapping[str, int]) -> dict[int, int]:
    """Words by byte offset from values of fields by name; fields that are not named have their reset values.

    ValueError for an unknown field, one that is read only, and a value that its bits cannot hold.

    >>> pack({"gain": 98304, "gain_exp": -1})  # 1.5 / 2
    {148: 1057062912}
    """
    words = {}
    left = dict(values)
    for register in every():
        if register.access == "rw" and left.keys() & {field.name for field in register.fields}:
            words[register.offset] = sum(_bits(field, left.pop(field.name, field.reset)) for field in register.fields)
    if left:
        raise ValueError(f"{next(iter(left))}: no field to write, allowed are those of docs/registers.md")
    return words


def draw(values: Mapping[str, int]) -> dict[str, int]:
    """All settings by their names in ``shade_pkg::draw_t``, for a port of that type.

    Settings that are not named are as reset leaves them. ValueError as in ``pack``.

    >>> draw({"ks_b": 5})["colour.ks.b"], draw({})["material.lobe.power"]
    (5, 4)
    """
    if unknown := values.keys() - after_reset().keys():
        raise ValueError(f"{min(unknown)}: no field to write, allowed are those of docs/registers.md")
    for field in settings():
        _bits(field, values.get(field.name, field.reset))
    return {field.path: values.get(field.name, field.reset) for field in settings()}


def unpack(offset: int, word: int) -> dict[str, int]:
    """Values of fields by name from the word at a byte offset. ValueError where there is no register.

    >>> unpack(148, 1057062912)
    {'gain': 98304, 'gain_exp': -1}
    """
    for register in every():
        if register.offset == offset:
            return {field.name: _value(field, word) for field in register.fields}
    raise ValueError(f"{offset:#x}: no register, allowed are those of docs/registers.md")


def _bits(field: Field, value: int) -> int:
    low, high = field.range
    if not low <= value <= high:
        raise ValueError(f"{field.name}: {value} is out of range, allowed is {low} to {high}")
    return (value & (1 << field.width) - 1) << field.lsb


def _value(field: Field, word: int) -> int:
    value = word >> field.lsb & (1 << field.width) - 1
    return value - (1 << field.width) if value > field.range[1] else value
