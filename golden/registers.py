"""The register map of the core: the one source for its AXI4-Lite slave, for drivers and for ``docs/registers.md``.

Registers of 32 bits, by byte offset. Fields of material and light bear the names that ``golden.material`` gives to
their values, so that ``pack(registers(material, light))`` is what a driver has to write. ``make generate``
takes offsets, positions and resets into ``rtl/shade_pkg.sv``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from . import contract as k
from .plan import THRESHOLDS

VERSION = (0, 1, 0)
ID = int.from_bytes(b"PSHD", "big")


@dataclass(frozen=True)
class Field:
    """Bits of a register. ``format``: S and U numbers, or "" for a code or a count."""

    name: str
    width: int
    meaning: str
    format: str = ""
    lsb: int = 0
    reset: int = 0

    @property
    def range(self) -> tuple[int, int]:
        """The least and the largest value that the bits can hold."""
        half = 1 << self.width - 1
        return (-half, half - 1) if self.format.startswith("S") else (0, 2 * half - 1)

    @property
    def bits(self) -> str:
        """As in documentation: "16:0", or "3" for a single one."""
        return f"{self.lsb + self.width - 1}:{self.lsb}" if self.width > 1 else f"{self.lsb}"


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


def _vector(letter: str, meaning: str, z: int) -> dict[str, Field]:
    return {
        f"{letter}{axis}".upper(): Field(
            f"{letter}{axis}", k.INTENSITY_W, f"{meaning}, {axis}", "S1.16", reset=z if axis == "z" else 0
        )
        for axis in "xyz"
    }


def _colour(name: str, meaning: str, reset: int) -> dict[str, Field]:
    return {
        f"{name}_{channel}".upper(): Field(f"{name}_{channel}", k.PIXEL_W + 1, f"{meaning}, {word}", "U1.16", 0, reset)
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
                Field("path", 1, "0: polynomials, 1: a unit normal at every pixel"),
                Field("colour", 1, "pixels are 0: diffuse and specular light, 1: weighted red, green, blue", lsb=1),
                Field("variant", k.VARIANT_W, f"of path 1, {_codes('VARIANT')}", lsb=4),
                Field("fixed_degree", k.DEGREE_W, "0: adaptive, 1 to 3: of every span, as in P1", lsb=8),
                Field("clear", 1, "writing 1: counters and STATUS become 0, the next span goes to lane 0", lsb=31),
            ),
        ),
        *_group(
            0x0C,
            "ro",
            STATUS=(
                Field("busy", 1, "spans are inside; the other bits stay until they are cleared"),
                Field("error_empty", 1, "a span of 0 pixels", lsb=8),
                Field("error_long", 1, "a span of more than 4096 pixels", lsb=9),
                Field("error_packet", 1, "a packet cut short or too long", lsb=10),
                Field("error_metric", 1, "V1, V2: fewer than 3 sectors or more than 12", lsb=11),
                Field("error_threshold", 1, "threshold outside [0, 1]", lsb=12),
                Field("light_model", 1, "a reserved model, or one that was not built in", lsb=16 + k.LIGHT_MODEL),
                Field("light_range", 1, "a cosine outside [-1, 1]", lsb=16 + k.LIGHT_RANGE),
                Field("light_zero", 1, "a denominator of 0: no specular light", lsb=16 + k.LIGHT_ZERO),
                Field("light_saturated", 1, "light beyond its format", lsb=16 + k.LIGHT_SATURATED),
                Field("normal_zero", 1, "a normal of length 0", lsb=24),
                Field("normal_short", 1, "a normal too short to be brought to length 1", lsb=25),
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
            Field(
                "sharpness",
                k.SHARPNESS_F + 1,
                "n of the cos^n that turns as fast as the highlight, mantissa",
                "U1.16",
                reset=_ONE,
            ),
            Field("sharpness_exp", k.SHARPNESS_EXP_W, "and exponent, 0 to 12", lsb=24, reset=1),
        ),
        T1=Field("t1", k.KAPPA_W, "kappa up to which a line is enough", "U11.20", reset=THRESHOLDS[0]),
        T2=Field("t2", k.KAPPA_W, "kappa up to which a parabola is enough", "U11.20", reset=THRESHOLDS[1]),
        T3=Field("t3", k.KAPPA_W, "kappa up to which a cubic is enough", "U11.20", reset=THRESHOLDS[2]),
        THRESHOLD=Field(
            "threshold",
            k.INTENSITY_W,
            "V1, V2, V4, V5: a shorter middle is normalized",
            "S1.16",
            reset=k.METRIC_THRESHOLD,
        ),
    ),
    "Material": _group(
        0x80,
        "rw",
        MODEL=(
            Field("model", k.MODEL_W, _codes("MODEL")),
            Field("cosine", 1, "specular light is multiplied by N.L", lsb=8),
        ),
        K1=Field("k1", k.LOBE_K1_W, "of the lobe, for the scaled x", "U1.20"),
        K2=Field("k2", k.LOBE_K2_W, "of the lobe, for the scaled x", "S0.17"),
        XMAX=(
            Field("xmax", k.LOBE_X_F + 1, "limit of the scaled x", "U1.16"),
            Field(
                "shift",
                k.LOBE_SHIFT_W,
                f"x is scaled by 2^shift; {k.LOBE_FINE}: not, but k1 and k2 are by {1 << k.LOBE_FINE_F}",
                lsb=24,
            ),
            Field("power", k.LOBE_POWER_W, "squarings of the lobe, 0 to 4; more count as 4", lsb=28, reset=4),
        ),
        INV_N=(
            Field("inv_n", 17, "Schlick: 1/n, mantissa", "U1.16"),
            Field("inv_n_exp", k.INV_EXP_W, "and negative exponent", lsb=24),
        ),
        GAIN=(
            Field("gain", k.GAIN_F + 1, "of specular light, mantissa", "U1.16"),
            Field("gain_exp", k.GAIN_EXP_W, "and exponent", "S5.0", lsb=24),
        ),
        F0=Field("f0", 17, "Fresnel's factor at V.H = 1, where it is computed at every node", "U1.16"),
    ),
    "Light": _group(
        0xC0,
        "rw",
        **_vector("l", "direction to the light", _ONE),
        **_vector("h", "half way between it and the viewer's", _ONE),
        VH=Field("vh", 17, "V.H", "U1.16", reset=_ONE),
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


def pack_draw(values: Mapping[str, int]) -> NDArray[np.uint32]:
    """All settings as the structure ``shade_pkg::draw_t``: words, least significant first; the first one is at the top.

    Settings that are not named are as reset leaves them. ValueError as in ``pack``.

    >>> int(pack_draw({"ks_b": 5})[0])  # the last one
    5
    """
    if unknown := values.keys() - after_reset().keys():
        raise ValueError(f"{min(unknown)}: no field to write, allowed are those of docs/registers.md")
    whole = width = 0
    for field in settings():
        whole = whole << field.width | _bits(field, values.get(field.name, field.reset)) >> field.lsb
        width += field.width
    return np.frombuffer(whole.to_bytes(-(-width // 32) * 4, "little"), "<u4").astype(np.uint32)


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
