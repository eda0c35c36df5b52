# SPDX-License-Identifier: Apache-2.0
"""The C driver against golden.material, word for word, and the register descriptions against the register map."""

from __future__ import annotations

import ctypes
import re
import subprocess
from xml.etree import ElementTree

import numpy as np
import pytest
from peakrdl_ipxact import IPXACTImporter
from polyshade.golden import contract as k
from polyshade.golden import packets, registers, types
from polyshade.golden.material import MODELS, RANGES, Material, colour_registers, planner_registers
from polyshade.golden.material import registers as material_registers
from polyshade.golden.reference.light import ROWS
from polyshade.scripts.handoff import registers as forms
from polyshade.sim.sources import ROOT
from systemrdl import RDLCompiler, RegNode

from tb.runner import FULL, SEED

FOLDER = ROOT / "scripts" / "handoff" / "driver"
COUNT = 10_000 if FULL else 300
ENERGIES = ("none", *ROWS)
LIMITS = {name: limits for name, limits in RANGES.items() if name not in ("colour", "highlight")}


class CMaterial(ctypes.Structure):
    """struct shade_material."""

    _fields_ = [
        *((name, ctypes.c_int) for name in ("model", "paper", "energy")),
        *((name, ctypes.c_double) for name in LIMITS),
        *((name, ctypes.c_double * 3) for name in ("colour", "highlight")),
    ]


class Word(ctypes.Structure):
    """struct shade_word."""

    _fields_ = [("offset", ctypes.c_uint16), ("word", ctypes.c_uint32)]


class Span(ctypes.Structure):
    """struct shade_span."""

    _fields_ = [
        ("normal", ctypes.c_int32 * 3), ("increment", ctypes.c_int32 * 3), ("count", ctypes.c_uint),
        ("tag", ctypes.c_uint), ("cosine", ctypes.c_int32), ("flat", ctypes.c_int),
    ]  # fmt: skip


@pytest.fixture(scope="module")
def driver(tmp_path_factory) -> ctypes.CDLL:
    """The driver as a shared library: C99 without a warning."""
    library = tmp_path_factory.mktemp("driver") / "libshade.so"
    flags = ["-std=c99", "-O2", "-Wall", "-Wextra", "-Werror", "-pedantic", "-shared", "-fPIC"]
    subprocess.run(["gcc", *flags, "-o", library, *sorted(FOLDER.glob("*.c")), "-lm"], check=True)
    loaded = ctypes.CDLL(str(library))
    loaded.shade_check.restype = ctypes.c_char_p
    loaded.shade_material_default.restype = CMaterial
    return loaded


def test_header_is_cpp() -> None:
    flags = ["-std=c++11", "-Wall", "-Wextra", "-Werror", "-pedantic", "-fsyntax-only", "-x", "c++"]
    subprocess.run(["g++", *flags, FOLDER / "shade.h"], check=True)


def in_c(surface: Material) -> CMaterial:
    """The same material for the driver."""
    numbers = {name: getattr(surface, name) for name in LIMITS}
    numbers["exposure"] = 0.0 if surface.exposure == "auto" else surface.exposure
    colours = {name: (ctypes.c_double * 3)(*getattr(surface, name)) for name in ("colour", "highlight")}
    codes = {"model": MODELS[surface.model], "paper": int(surface.form == "paper")}
    return CMaterial(**codes, energy=ENERGIES.index(surface.energy), **numbers, **colours)


def words(driver: ctypes.CDLL, surface: Material, light) -> dict[int, int]:
    """What the driver writes, by offset."""
    found = (Word * 24)()
    count = driver.shade_words(ctypes.byref(in_c(surface)), (ctypes.c_double * 3)(*light), found)
    return {word.offset: word.word for word in found[:count]}


def golden(surface: Material, light) -> dict[int, int]:
    """What golden writes, by offset."""
    values = material_registers(surface, light) | planner_registers(surface) | colour_registers(surface)
    return registers.pack(values)


def drawn(rng: np.random.Generator) -> tuple[Material, tuple[float, ...]]:
    """A random material and light: whole and half shininesses among them, exact limits, all rows, long lights."""
    model = rng.choice(list(MODELS))
    rows = ["none", *(row for row in ROWS if row.partition("-")[0] == model)]
    numbers = {
        name: float(rng.choice([low, high, np.exp(rng.uniform(np.log(low), np.log(high))) if low else rng.uniform()],
                               p=[0.05, 0.05, 0.9]))
        for name, (low, high) in LIMITS.items()
    }  # fmt: skip
    if rng.uniform() < 0.3:
        numbers["shininess"] = float(np.round(2 * numbers["shininess"]) / 2)
    factor = numbers.pop("exposure")
    exposure = factor if rng.uniform() < 0.5 else "auto"
    colours = {name: tuple(rng.uniform(size=3).tolist()) for name in ("colour", "highlight")}
    form = "paper" if rng.uniform() < 0.2 else "refined"
    surface = Material(model, energy=str(rng.choice(rows)), form=form, exposure=exposure, **numbers, **colours)
    light = rng.normal(size=3) * 10.0 ** rng.integers(-4, 4)
    if rng.uniform() < 0.1:
        light = rng.choice([-1.0, 0.0, 1.0], size=3)
        light = light if light.any() else np.array([0.0, 0.0, -1.0])
    return surface, tuple(light.tolist())


def test_words_are_golden(driver) -> None:
    """Word for word; materials that golden cannot put into words the driver refuses as well."""
    rng = np.random.default_rng(SEED)
    compared = 0
    for surface, light in (drawn(rng) for _ in range(COUNT)):
        try:
            expected = golden(surface, light)
        except ValueError:
            expected = {}
        assert words(driver, surface, light) == expected, f"{surface} {light}"
        compared += bool(expected)
    assert compared > 0.9 * COUNT


def test_default_material(driver) -> None:
    found, expected = driver.shade_material_default(), in_c(Material())
    for name, _ in CMaterial._fields_:
        value, golden = getattr(found, name), getattr(expected, name)
        assert value == golden if isinstance(value, int | float) else list(value) == list(golden), name


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("model", 6), ("model", -1), ("energy", 1), ("energy", 7), ("shininess", 0.5), ("shininess", 1025.0),
        ("shininess", np.nan), ("roughness", 0.04), ("f0", 1.5), ("exposure", 1e-7), ("ambient", -0.1),
        ("diffuse", 2.0), ("specular", np.inf),
    ],
)  # fmt: skip
def test_refused_in_words(driver, name: str, value: float) -> None:
    """One line: the parameter, the cause, what is allowed; no words are given."""
    surface = in_c(Material())
    setattr(surface, name, value)
    light = (ctypes.c_double * 3)(0, 0, 1)
    told = driver.shade_check(ctypes.byref(surface), light).decode()
    assert name in told.partition(":")[0] and "allowed" in told and "\n" not in told
    assert driver.shade_words(ctypes.byref(surface), light, (Word * 24)()) == 0


@pytest.mark.parametrize("light", [(0, 0, 0), (1e-7, 0, 0), (2e6, 0, 0), (np.nan, 0, 1)])
def test_light_refused(driver, light) -> None:
    told = driver.shade_check(ctypes.byref(in_c(Material())), (ctypes.c_double * 3)(*light)).decode()
    assert told.startswith("light: ")


def test_spans_are_golden(driver) -> None:
    """Beats as golden packs them, every field at its limits and between."""
    rng = np.random.default_rng(SEED)
    for _ in range(1000):
        values = {f.name: int(rng.choice([*f.range, rng.integers(*f.range)])) for f in types.SPAN.leaves()}
        parts = {name: tuple(values[f"{name}.{axis}"] for axis in "xyz") for name in ("normal", "increment")}
        span = Span(*parts.values(), *(values[name] for name in ("count", "tag", "cosine", "flat")))
        beat = (ctypes.c_uint32 * 8)()
        driver.shade_pack(ctypes.byref(span), beat)
        expected = sum((values[f.name] & (1 << f.width) - 1) << f.lsb for f in types.SPAN.leaves())
        assert sum(word << 32 * i for i, word in enumerate(beat)) == expected


def test_registers_behind_a_pointer(driver) -> None:
    """Probe, write, clear and counters on words in memory."""
    memory = (ctypes.c_uint32 * 1024)()
    assert driver.shade_probe(memory) == -1
    memory[0], memory[1] = registers.ID, 0x00000100
    assert driver.shade_probe(memory) == 0
    entry = (Word * 1)(Word(0x84, 77))
    assert driver.shade_write(memory, entry, 1) == 0
    assert memory[0x84 // 4] == 77
    memory[0x0C // 4] = 1
    assert driver.shade_write(memory, (Word * 1)(Word(0x84, 78)), 1) == -1
    assert memory[0x84 // 4] == 77
    memory[0x08 // 4] = 2
    driver.shade_clear(memory)
    assert memory[0x08 // 4] == 2 | 1 << 31


# ---- descriptions ------------------------------------------------------------------------------------------------


def described(root) -> dict[str, tuple]:
    """Registers of a compiled description: offset and fields with place, reset and software access."""
    return {
        register.inst_name: (
            register.absolute_address,
            {f.inst_name: (f.lsb, f.width, f.get_property("reset"), f.is_sw_readable, f.is_sw_writable)
             for f in register.fields()},
        )
        for register in root.top.descendants() if isinstance(register, RegNode)
    }  # fmt: skip


def expected() -> dict[str, tuple]:
    """The same of golden."""
    return {
        register.name: (
            register.offset,
            {f.name: (f.lsb, f.width, f.reset, f.name != "clear", register.access == "rw") for f in register.fields},
        )
        for register in registers.every()
    }


def test_systemrdl(tmp_path) -> None:
    """The SystemRDL compiler reads it, and finds what golden has."""
    path = tmp_path / "shade.rdl"
    path.write_text(forms.systemrdl())
    compiler = RDLCompiler()
    compiler.compile_file(str(path))
    assert described(compiler.elaborate()) == expected()


def test_ipxact(tmp_path) -> None:
    """An importer of IP-XACT finds the same."""
    component = ElementTree.Element(f"{{{forms.SPIRIT}}}component")
    for name in ("vendor", "library", "name", "version"):
        ElementTree.SubElement(component, f"{{{forms.SPIRIT}}}{name}").text = "shade"
    component.append(forms.memory_map())
    path = tmp_path / "component.xml"
    ElementTree.ElementTree(component).write(path)
    compiler = RDLCompiler()
    IPXACTImporter(compiler).import_file(str(path))
    assert described(compiler.elaborate()) == expected()


def test_header_places() -> None:
    """Every field of registers and spans stands in the header with its place."""
    text = forms.header()
    for register in registers.every():
        for field in register.fields:
            name = f"SHADE_{register.name}_{field.name}".upper()
            assert f"#define {name}_LSB " in text and f"#define {name}_W " in text
    assert (
        sum(f"SHADE_SPAN_{f.name}_LSB".upper().replace(".", "_") in text for f in packets.PACKETS["SPAN"].fields) == 10
    )
    assert re.search(rf"^#define SHADE_MODEL_WARD +{k.MODEL_WARD}$", text, re.MULTILINE)
