# SPDX-License-Identifier: Apache-2.0
"""PLY: a header that describes rows of numbers, then the rows, as text or binary."""

from __future__ import annotations

import re
import struct
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from polyshade.sim.scene.formats.surface import Damage, Ints, Surface, decode, integers, numbers, without_small

_TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4"}
_TYPES |= {"int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4"}
_TYPES |= {"float": "f4", "float32": "f4", "double": "f8", "float64": "f8"}

_FORMATS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
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


_Columns = dict[str, NDArray]
"""An element's numbers by their property's name; of a list all entries end to end, its lengths under ``#name``."""


def read(data: bytes) -> Surface:
    """Points with their normals, faces, and triangle strips, in which -1 begins a new strip."""
    data = data.removeprefix(b"\xef\xbb\xbf")
    head = re.match(rb"ply[ \t]*\r?\n(.*?\n)??[ \t]*end_header[ \t]*(\r?\n|$)", data, re.DOTALL)
    if not head:
        raise Damage("has no PLY header, or one without an end")
    form, elements = _header(decode(head.group()).decode(errors="replace").split("\n")[1:-1])
    if form:
        tables, repairs = _binary(elements, data, head.end(), form)
    else:
        tables, repairs = _text(elements, decode(data[head.end() :])), {}
    vertex = tables.get("vertex", {})
    if not {"x", "y", "z"} <= vertex.keys() or "#x" in vertex or not len(vertex["x"]):
        raise Damage("has no vertices with x, y and z")
    points = np.stack([vertex[axis].astype(np.float64, copy=False) for axis in "xyz"], axis=1)
    normals = None
    if {"nx", "ny", "nz"} <= vertex.keys():
        normals = np.stack([vertex[f"n{axis}"].astype(np.float64, copy=False) for axis in "xyz"], axis=1)

    corners, sizes = np.empty(0, np.int64), np.empty(0, np.int64)
    face = tables.get("face", {})
    if name := next((name for name in _CORNERS if f"#{name}" in face), None):
        corners, sizes = _whole(face[name], name), face[f"#{name}"]
    strips = tables.get("tristrips", {})
    if name := next((name for name in _CORNERS if f"#{name}" in strips), None):
        cut = np.split(_whole(strips[name], name), np.cumsum(strips[f"#{name}"])[:-1])
        triangles = np.concatenate([_strips(strip) for strip in cut])
        corners = np.concatenate([corners, triangles.reshape(-1)])
        sizes = np.concatenate([sizes, np.full(len(triangles), 3)])
    small, corners, sizes, _ = without_small(corners, sizes)
    return Surface(points, corners, sizes, normals, repairs=repairs | small)


def _whole(values: NDArray, name: str) -> Ints:
    if values.dtype.kind == "f":
        raise Damage(f"{name} are no integers")
    return values


def _strips(entries: Ints) -> Ints:
    """The triangles (T, 3) of strips that -1 separates; every other one is turned, so that all face the same side."""
    breaks = np.flatnonzero(entries == -1).tolist()
    runs = [entries[a + 1 : b] for a, b in pairwise([-1, *breaks, len(entries)])]
    made = []
    for run in runs:
        steps = np.arange(max(len(run) - 2, 0))
        odd = steps % 2
        made.append(np.stack([run[steps + odd], run[steps + 1 - odd], run[steps + 2]], axis=1))
    return np.concatenate(made).astype(np.int64)


def _header(lines: list[str]) -> tuple[str, list[_Element]]:
    """The byte order (``<``, ``>``, empty for text) and the elements in their order."""
    form = None
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
            case ["comment" | "obj_info" | "end_header", *_] | []:
                pass
            case _:
                raise Damage(f"header line {line!r} cannot be understood")
    if form is None:
        raise Damage("its header names no format")
    return form, elements


def _text(elements: list[_Element], body: bytes) -> dict[str, _Columns]:
    lines = [words for line in body.split(b"\n") if (words := line.split())]
    claimed = sum(element.count for element in elements)
    if claimed > len(lines):
        raise Damage(f"truncated, its header claims {claimed} lines, {len(lines)} follow")
    remaining = iter(lines)
    tables: dict[str, _Columns] = {}
    for element in elements:
        single = [item for item in element.properties if not item.length]
        if len(single) == len(element.properties):
            tables[element.name] = _text_table(element, [next(remaining) for _ in range(element.count)])
            continue
        values: dict[str, list[float]] = {item.name: [] for item in element.properties}
        lengths: dict[str, list[int]] = {item.name: [] for item in element.properties if item.length}
        for row in range(element.count):
            words, where, at = next(remaining), f"{element.name} {row}", 0
            for item in element.properties:
                length = 1
                if item.length:
                    length = integers(words[at : at + 1], where)[0] if at < len(words) else 0
                    lengths[item.name].append(length)
                    at += 1
                if length < 0 or at + length > len(words):
                    raise Damage(f"{where} has {len(words)} numbers, its properties need more")
                spell = integers if item.kind[0] in "iu" else numbers
                values[item.name] += spell(words[at : at + length], where)
                at += length
            if at != len(words):
                raise Damage(f"{where} has {len(words)} numbers, its properties need {at}")
        tables[element.name] = {
            name: np.array(entries, np.int64 if item.kind[0] in "iu" else np.float64)
            for item, (name, entries) in zip(element.properties, values.items(), strict=True)
        } | {f"#{name}": np.array(entries, np.int64) for name, entries in lengths.items()}
    return tables


def _text_table(element: _Element, rows: list[list[bytes]]) -> _Columns:
    """Rows of single numbers; only normals may be none."""
    names = [item.name for item in element.properties]
    for row, words in enumerate(rows):
        if len(words) != len(names):
            raise Damage(f"{element.name} {row} has {len(words)} numbers, its properties need {len(names)}")
    columns: _Columns = {}
    for name, column in zip(names, zip(*rows, strict=True), strict=False):
        values = np.array(numbers(column, f"{element.name} {name}", finite=False))
        if element.name == "vertex" and name in ("x", "y", "z") and not np.isfinite(values).all():
            raise Damage(f"vertex {np.argmin(np.isfinite(values))}: {name} is not finite")
        columns[name] = values
    return columns


def _binary(
    elements: list[_Element], data: bytes, start: int, order: str
) -> tuple[dict[str, _Columns], dict[str, int]]:
    tables: dict[str, _Columns] = {}
    for element in elements:
        tables[element.name], start = _rows(element, data, start, order)
    spare = len(data[start:].rstrip())
    return tables, {"trailing_bytes": spare} if spare else {}


def _rows(element: _Element, data: bytes, start: int, order: str) -> tuple[_Columns, int]:
    """An element's columns and where its rows end. Rows of one length are read at once, others where they begin."""
    fields, lists = [], []
    for item in element.properties:
        if item.length:
            at = start + np.dtype([(name, kind, shape) for name, kind, shape in fields]).itemsize
            first = np.frombuffer(data[at : at + np.dtype(item.length).itemsize], order + item.length)
            fields.append((f"#{item.name}", order + item.length, ()))
            fields.append((item.name, order + item.kind, (max(int(first.sum()), 0),)))
            lists.append(item.name)
        else:
            fields.append((item.name, order + item.kind, ()))
    row = np.dtype(fields)
    whole = element.count * row.itemsize <= len(data) - start
    rows = np.frombuffer(data, row, element.count, start) if whole and row.itemsize else np.empty(0, row)
    uniform = whole and all(len(rows) == 0 or (rows[f"#{name}"] == rows[f"#{name}"][0]).all() for name in lists)
    if uniform:
        end = start + element.count * row.itemsize
        columns = {name: np.ascontiguousarray(rows[name]).reshape(-1) for name in row.names or ()}
        native = {n: c.astype(np.int64 if n[0] == "#" else c.dtype.newbyteorder("=")) for n, c in columns.items()}
        return native, end
    if not lists:
        have = (len(data) - start) // row.itemsize
        raise Damage(f"truncated, its header claims {element.count} of {element.name}, {have} follow")
    return _walk(element, data, start, order)


def _walk(element: _Element, data: bytes, start: int, order: str) -> tuple[_Columns, int]:
    """Rows with lists of different lengths: one step from property to property, then all entries of each at once."""
    sizes = [np.dtype(item.kind).itemsize for item in element.properties]
    codes = [struct.Struct(order + np.dtype(item.length).char) if item.length else None for item in element.properties]
    begins: list[list[int]] = [[] for _ in sizes]
    lengths: list[list[int]] = [[] for _ in sizes]
    steps = list(zip(begins, lengths, sizes, codes, strict=True))
    at, length, row = start, 1, 0
    try:
        for row in range(element.count):  # noqa: B007
            for begin, counts, size, code in steps:
                if code:
                    length = int(code.unpack_from(data, at)[0])
                    at += code.size
                    counts.append(length)
                begin.append(at)
                at += size * (length if code else 1)
    except struct.error:
        at = len(data) + 1
    if at > len(data) or any(min(counts, default=0) < 0 for counts in lengths):
        raise Damage(f"truncated, its header claims {element.count} of {element.name}, {row} can be read")
    raw = np.frombuffer(data, np.uint8)
    columns: _Columns = {}
    for item, begin, counts, size, code in zip(element.properties, *zip(*steps, strict=True), strict=True):
        first = np.array(begin, np.int64)
        if code:
            count = columns[f"#{item.name}"] = np.array(counts, np.int64)
            first = np.repeat(first - size * (np.cumsum(count) - count), count)
            first += size * np.arange(len(first))
        entries = np.stack([raw[first + byte] for byte in range(size)], axis=1).reshape(-1).view(order + item.kind)
        columns[item.name] = entries.astype(entries.dtype.newbyteorder("="))
    return columns, at
