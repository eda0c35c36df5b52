"""Compile a module of the RTL into a shared library, once; ``build/sim`` keeps it.

The key of a library is everything that goes into it: the sources that the module reaches, its parameters, this
package's C++, the version of Verilator and the flags. What Verilator itself brings is compiled once and linked to all.
"""

from __future__ import annotations

import contextlib
import fcntl
import hashlib
import json
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

from polyshade.golden.types import Field
from polyshade.sim import tools
from polyshade.sim.errors import UserError
from polyshade.sim.sources import BUILD, label, modules, sources, yardsticks

HERE = Path(__file__).resolve().parent
CACHE = BUILD / "sim"
VERILATOR_FLAGS = [
    "--cc",
    "-O3",
    "--x-assign",
    "unique",
    "--x-initial",
    "unique",
    "--no-timing",
    "--prefix",
    "Vdut",
]
CXX_FLAGS = ["-std=c++17", "-O2", "-fPIC", "-w"]


@dataclass(frozen=True)
class Port:
    """A port of a module: its name, direction ``input`` or ``output``, width in bits and signedness.

    ``fields``: of a packed structure those that hold numbers, lowest bits first; their names begin with the port's.
    """

    name: str
    direction: str
    width: int
    signed: bool
    fields: tuple[Field, ...] = ()


def reached(module: str) -> list[Path]:
    """The package and the sources of a module and of everything that it instantiates, in the order of the file list."""
    files = modules() | yardsticks()
    if module not in files:
        raise UserError(f"{module}: no such module, allowed {', '.join(files)}")
    names, todo = set(), {module}
    while todo:
        name = todo.pop()
        names.add(name)
        text = re.sub(r"//.*", "", files[name].read_text())
        todo |= {word for word in re.findall(r"\bshade_\w+", text) if word in files} - names
    listed = [*sources(), *yardsticks().values()]
    return [path for path in listed if path.stem in names or path.stem.endswith("_pkg")]


def _run(command: list[str | Path], directory: Path) -> None:
    done = subprocess.run(
        command,
        cwd=directory,
        env=tools.environment(),
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    if done.returncode:
        raise RuntimeError(f"{' '.join(map(str, command))}\n{done.stdout}")


@contextlib.contextmanager
def _once(path: Path) -> Iterator[Path | None]:
    """A scratch folder that becomes ``path`` when the block ends well; None if it is there already. Process-safe."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path.with_suffix(".lock"), "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if path.exists():
            yield None
            return
        scratch = Path(tempfile.mkdtemp(dir=path.parent, prefix=path.name + "."))
        try:
            yield scratch
            os.replace(scratch, path)
        finally:
            shutil.rmtree(scratch, ignore_errors=True)


def _key(*parts: object) -> str:
    return hashlib.sha256(repr(parts).encode()).hexdigest()[:16]


def _include(root: Path) -> list[str]:
    return [f"-I{root / 'include'}", f"-I{root / 'include' / 'vltstd'}"]


def _runtime(waves: bool) -> Path:
    """Verilator's own C++, compiled: a folder of object files."""
    verilator = tools.verilator()
    path = CACHE / f"runtime-{_key(str(verilator.root), verilator.version, CXX_FLAGS, waves)}"
    with _once(path) as scratch:
        if scratch:
            names = ["verilated", "verilated_threads", *(["verilated_vcd_c"] if waves else [])]
            units = [verilator.root / "include" / f"{name}.cpp" for name in names]
            _run(["g++", *CXX_FLAGS, *_include(verilator.root), "-c", *units], scratch)
    return path


def _cause(module: str, log: str) -> str:
    """Why Verilator refused: what the module's own check says, or another module's, or else the first error."""
    for pattern in (rf"-USERERROR: \S+ {module}: (.*)", r"-USERERROR: \S+ (.*)", r"^%Error[^:]*: (.*)"):
        if found := re.search(pattern, log, re.MULTILINE):
            return found[1]
    return log.strip().splitlines()[-1]


def ports(module: str, parameters: dict[str, int], scratch: Path) -> list[Port]:
    """The ports of a module at a parameter point, in the order of its header, from Verilator's syntax tree.

    Raises UserError with the cause when the module refuses its parameters or does not elaborate.
    """
    tree = scratch / "tree.json"
    arguments = [*(f"-G{name}={value}" for name, value in parameters.items()), "--top-module", module]
    try:
        _run(
            [tools.verilator().program, "--json-only", "--json-only-output", tree, "--json-only-meta-output",
             scratch / "meta.json", "--no-timing", *arguments, *reached(module)],
            scratch,
        )  # fmt: skip
    except RuntimeError as error:
        raise UserError(f"{label(module, parameters)}: {_cause(module, str(error))}") from error
    netlist = json.loads(tree.read_text())
    types = {t["addr"]: t for t in netlist["miscsp"][0]["typesp"]}
    top = next(m for m in netlist["modulesp"] if m["name"] == module)
    found = []
    for item in top["stmtsp"]:
        if item["type"] == "VAR" and item.get("varType") == "PORT":
            dtype = types[item["dtypep"]]
            fields = tuple(_fields(item["name"], 0, dtype, types)) if _struct(dtype, types) else ()
            signed = bool(dtype.get("signed"))
            found.append(Port(item["name"], item["direction"].lower(), _bits(dtype, types), signed, fields))
    return found


def _struct(dtype: dict, types: dict[str, dict]) -> list[dict]:
    """The members of a packed structure of Verilator's syntax tree, the highest bits first; none of another type."""
    if dtype["type"] == "REFDTYPE":
        return _struct(types[dtype["refDTypep"]], types)
    return dtype["membersp"] if dtype["type"] == "STRUCTDTYPE" else []


def _fields(name: str, lsb: int, dtype: dict, types: dict[str, dict]) -> Iterator[Field]:
    """The numbers in a type: itself, or those of its members, but for unused bits."""
    if dtype["type"] == "REFDTYPE":
        yield from _fields(name, lsb, types[dtype["refDTypep"]], types)
    elif members := _struct(dtype, types):
        for member in reversed(members):
            kind = types[member["dtypep"]]
            if not member["name"].startswith("unused_"):
                yield from _fields(f"{name}.{member['name']}", lsb, kind, types)
            lsb += _bits(kind, types)
    else:
        yield Field(name, _bits(dtype, types), "", "S" if dtype.get("signed") else "", lsb)


def _bits(dtype: dict, types: dict[str, dict]) -> int:
    """Bits of a type of Verilator's syntax tree: a vector's, or of a packed structure those of its members."""
    if dtype["type"] == "REFDTYPE":
        return _bits(types[dtype["refDTypep"]], types)
    if members := _struct(dtype, types):
        return sum(_bits(types[member["dtypep"]], types) for member in members)
    high, low = map(int, dtype.get("range", "0:0").split(":"))
    return high - low + 1


def build(module: str, parameters: dict[str, int], glue, *, waves: bool = False) -> tuple[Path, list[Port]]:
    """The shared library of a module and its ports. ``glue(ports)`` gives the C++ that knows their names."""
    verilator = tools.verilator()
    files = reached(module)
    own = [(HERE / "harness.cpp").read_bytes(), (HERE / "model.py").read_bytes(), Path(__file__).read_bytes()]
    key = _key(parameters, [path.read_bytes() for path in files], own, verilator.version, waves)
    path = CACHE / f"{module}-{key}"
    with _once(path) as scratch:
        if scratch:
            found = ports(module, parameters, scratch)
            (scratch / "ports.json").write_text(json.dumps([asdict(port) for port in found]))
            flags = [*VERILATOR_FLAGS, *(["--trace"] if waves else [])]
            _run(
                [verilator.program, *flags, "--top-module", module, "--Mdir", scratch,
                 *(f"-G{name}={value}" for name, value in parameters.items()), *files],
                scratch,
            )  # fmt: skip
            units = "".join(f'#include "{unit.name}"\n' for unit in sorted(scratch.glob("Vdut*.cpp")))
            harness = f'#include "{HERE / "harness.cpp"}"\n'
            (scratch / "all.cpp").write_text(f"#define WAVES {int(waves)}\n{units}{glue(found)}{harness}")
            objects = sorted(_runtime(waves).glob("*.o"))
            _run(
                ["g++", *CXX_FLAGS, *_include(verilator.root), "-shared", "-o", "model.so", "all.cpp", *objects,
                 "-pthread"],
                scratch,
            )  # fmt: skip
    found = json.loads((path / "ports.json").read_text())
    return path / "model.so", [
        Port(**port | {"fields": tuple(Field(**field) for field in port["fields"])}) for port in found
    ]
