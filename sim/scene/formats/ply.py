"""PLY: a header that describes rows of numbers, then the rows, as text or binary."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from polyshade.sim.scene.formats.common import Checked, Damage, decode, numbers

_TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4"}
_TYPES |= {"int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4"}
_TYPES |= {"float": "f4", "float32": "f4", "double": "f8", "float64": "f8"}

_FORMATS = {"ascii": "ascii", "binary_little_endian": "<", "binary_big_endian": ">"}

_CORNERS = ("vertex_indices", "vertex_index")


@dataclass(frozen=True)
class _Property:
    name: str
    kind: str
    length: str = ""  # the type of a list's length, empty for a single number


@dataclass(frozen=True)
class _Element:
    name: str
    count: int
    properties: list[_Property]


def check(data: bytes, path: Path) -> Checked:
    """Read the header, and walk the rows to see that they are whole; the faces' sizes are met on the way."""
    head = re.match(rb"ply[ \t]*\r?\n(.*?\n)??end_header[ \t]*\r?\n", data, re.DOTALL)
    if not head:
        raise Damage("has no PLY header, or one without an end")
    header, body = decode(head.group()), data[head.end() :]
    form, elements = _header(header.split("\n")[1:-2])
    singles = {p.name for e in elements if e.name == "vertex" for p in e.properties if not p.length and e.count}
    if not {"x", "y", "z"} <= singles:
        raise Damage("has no vertices with x, y and z")
    lists = [p.name for e in elements if e.name == "face" for p in e.properties if p.length and e.count]
    corners = next((name for name in _CORNERS if name in lists), None)
    if corners is None:
        raise Damage("has no faces")
    if form == "ascii":
        rows = decode(body)
        lengths, body = _text_rows(elements, rows), rows.encode()
    else:
        lengths = _binary_rows(elements, body, form)
    sizes = lengths["face", corners]
    if sizes.min() < 3:
        raise Damage(f"face {sizes.argmin()} has {sizes.min()} corners, three are needed")
    cuts = int((sizes - 3).sum())
    return Checked(len(sizes) + cuts, cuts, header.encode() + body)


def _header(lines: list[str]) -> tuple[str, list[_Element]]:
    """The format (``ascii``, or the byte order ``<`` or ``>``) and the elements in their order."""
    form = ""
    elements: list[_Element] = []
    for line in lines:
        match line.split():
            case ["format", name, "1.0"] if name in _FORMATS:
                form = _FORMATS[name]
            case ["element", name, count] if count.isdecimal() and name not in {e.name for e in elements}:
                elements.append(_Element(name, int(count), []))
            case ["property", kind, name] if elements and kind in _TYPES:
                elements[-1].properties.append(_Property(name, _TYPES[kind]))
            case ["property", "list", length, kind, name] if elements and {length, kind} <= _TYPES.keys():
                elements[-1].properties.append(_Property(name, _TYPES[kind], _TYPES[length]))
            case ["comment" | "obj_info", *_]:
                pass
            case _:
                raise Damage(f"header line {line!r} cannot be understood")
    if not form:
        raise Damage("its header names no format")
    return form, elements


_Lengths = dict[tuple[str, str], NDArray[np.int64]]
"""The lengths of all lists of an element's property, by the names of both."""


def _text_rows(elements: list[_Element], body: str) -> _Lengths:
    lines = body.rstrip().split("\n")
    claimed = sum(element.count for element in elements)
    if claimed > len(lines):
        raise Damage(f"truncated, its header claims {claimed} lines, {len(lines)} follow")
    lengths: dict[tuple[str, str], list[int]] = {}
    remaining = iter(lines)
    for element in elements:
        for row in range(element.count):
            where = f"{element.name} {row}"
            values = numbers(next(remaining).split(), where)
            needed = 0
            for item in element.properties:
                if item.length and needed < len(values):
                    length = int(values[needed])
                    entries = values[needed + 1 : needed + 1 + length]
                    if item.kind[0] in "iu" and not all(entry.is_integer() for entry in entries):
                        raise Damage(f"{where}: {item.name} are no integers, {entries}")
                    lengths.setdefault((element.name, item.name), []).append(length)
                    needed += length
                needed += 1
            if needed != len(values):
                raise Damage(f"{where} has {len(values)} numbers, its properties need {needed}")
    return {key: np.array(value) for key, value in lengths.items()}


def _binary_rows(elements: list[_Element], body: bytes, order: str) -> _Lengths:
    """A list's first row gives the length for all: that is what the reader can read."""
    lengths: _Lengths = {}
    start = 0
    for element in elements:
        fields: list[tuple[str, str, tuple[int, ...]]] = []
        for item in element.properties:
            if item.length:
                at = start + np.dtype(fields).itemsize
                first = np.frombuffer(body[at : at + np.dtype(item.length).itemsize], order + item.length)
                fields.append((f"length of {item.name}", order + item.length, ()))
                fields.append((item.name, order + item.kind, (int(first.sum()),)))
            else:
                fields.append((item.name, order + item.kind, ()))
        row = np.dtype(fields)
        rows = np.frombuffer(body, row, min(element.count, (len(body) - start) // max(row.itemsize, 1)), start)
        for item in element.properties:
            if item.length:
                own = rows[f"length of {item.name}"].astype(np.int64)
                if len(own) and own.min() < own.max():
                    raise Damage(f"{element.name} lists of different lengths are only supported in ASCII files")
                lengths[element.name, item.name] = own
        if len(rows) < element.count:
            raise Damage(f"truncated, its header claims {element.count} of {element.name}, {len(rows)} follow")
        start += element.count * row.itemsize
    if start < len(body):
        raise Damage(f"its header claims {start} bytes, {len(body)} follow")
    return lengths
