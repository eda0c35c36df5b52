# SPDX-License-Identifier: Apache-2.0
"""Compile a module of the RTL into a shared library, once; ``build/sim`` keeps it, or POLYSHADE_CACHE.

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
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path

from polyshade.golden.types import Field
from polyshade.sim import tools
from polyshade.sim.errors import UserError
from polyshade.sim.sources import BUILD, label, modules, sources, yardsticks

HERE = Path(__file__).resolve().parent
CACHE = Path(os.environ.get("POLYSHADE_CACHE") or BUILD / "sim").absolute()
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
CXX_FLAGS = ["-std=c++17", "-O1", "-fPIC", "-w", "-DVL_USER_STOP", "-DVL_USER_FATAL"]  # harness.cpp says what they do
COVERAGE = "POLYSHADE_COVERAGE"  # in the environment: the folder for the counts of every run


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
    """The packages and sources of a module and of all that it instantiates, in the order of the file list."""
    allowed = modules() | yardsticks()
    if module not in allowed:
        raise UserError(f"{module}: no such module, allowed {', '.join(allowed)}")
    files = {path.stem: path for path in sources()} | allowed  # with the packages
    names, todo = {"shade_pkg"}, {module}
    while todo:
        name = todo.pop()
        names.add(name)
        text = re.sub(r"//.*", "", files[name].read_text())
        todo |= {word for word in re.findall(r"\bshade_\w+", text) if word in files} - names
    listed = [*sources(), *yardsticks().values()]
    return [path for path in listed if path.stem in names]


def run(command: list[str | Path], directory: Path) -> None:
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
def once(path: Path) -> Iterator[Path | None]:
    """A scratch folder that becomes ``path`` when the block ends well; None if it is there already. Process-safe."""
    if path.exists():  # also where nothing can be written
        yield None
        return
    with _lock(path.with_suffix(".lock")):
        if path.exists():
            yield None
            return
        scratch = Path(tempfile.mkdtemp(dir=path.parent, prefix=path.name + "."))
        try:
            yield scratch
            os.replace(scratch, path)
        finally:
            shutil.rmtree(scratch, ignore_errors=True)


@contextlib.contextmanager
def _lock(path: Path) -> Iterator[None]:
    """A file that one process at a time holds."""
    with contextlib.ExitStack() as stack:
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            lock = stack.enter_context(open(path, "w"))
        except OSError as error:
            told = f"cannot be written ({error.strerror}), choose another folder by POLYSHADE_CACHE"
            raise UserError(f"{path.parent}: {told}") from error
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def key_of(*parts: object) -> str:
    return hashlib.sha256(repr(parts).encode()).hexdigest()[:16]


def include(root: Path) -> list[str]:
    return [f"-I{root / 'include'}", f"-I{root / 'include' / 'vltstd'}"]


RUNTIME = ["_vpi", "", "_cov", "_vcd_c", "_threads"]  # what takes longest first
# What the C++ of every model begins with; compiled once, it is three quarters of a small model's compilation.
PRECOMPILED = """\
#include <cstdint>
#include <cstdio>
#include <vector>
#include "verilated.h"
#include "verilated_sym_props.h"
"""


def runtime() -> Path:
    """Verilator's own C++, compiled: a folder of object files, and model.h with its precompiled form."""
    verilator = tools.verilator()
    path = CACHE / f"runtime-{key_of(str(verilator.root), verilator.version, CXX_FLAGS, PRECOMPILED)}"
    with once(path) as scratch:
        if scratch:
            (scratch / "model.h").write_text(PRECOMPILED)
            command = ["g++", *CXX_FLAGS, *include(verilator.root)]
            units = [["-c", verilator.root / "include" / f"verilated{part}.cpp"] for part in RUNTIME]
            with ThreadPoolExecutor(os.cpu_count()) as pool:  # every other compilation waits for it
                list(pool.map(lambda unit: run([*command, *unit], scratch), [*units, ["-x", "c++-header", "model.h"]]))
    return path


def _cause(module: str, log: str) -> str:
    """Why Verilator refused: what the module's own check says, or another module's, or else the first error."""
    for pattern in (rf"-USERERROR: \S+ {module}: (.*)", r"-USERERROR: \S+ (.*)", r"^%Error[^:]*: (.*)"):
        if found := re.search(pattern, log, re.MULTILINE):
            return found[1]
    return log.strip().splitlines()[-1]


def ports(module: str, parameters: dict[str, int], scratch: Path) -> tuple[list[Port], list[str]]:
    """The ports of a module at a parameter point, in the order of its header, and the names of its parameters.

    Raises UserError with the cause when the module refuses its parameters or does not elaborate.
    """
    tree = scratch / "tree.json"
    arguments = [*(f"-G{name}={value}" for name, value in parameters.items()), "--top-module", module]
    try:
        run(
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
    variables = [item for item in top["stmtsp"] if item["type"] == "VAR"]
    for item in variables:
        if item.get("varType") == "PORT":
            dtype = types[item["dtypep"]]
            fields = tuple(_fields(item["name"], 0, dtype, types)) if _struct(dtype, types) else ()
            signed = bool(dtype.get("signed"))
            found.append(Port(item["name"], item["direction"].lower(), _bits(dtype, types), signed, fields))
    return found, [item["name"] for item in variables if item.get("varType") == "GPARAM"]


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
    if "declRange" in dtype:  # a packed array
        high, low = map(int, dtype["declRange"].strip("[]").split(":"))
        return (high - low + 1) * _bits(types[dtype["refDTypep"]], types)
    if "refDTypep" in dtype:  # an enumeration
        return _bits(types[dtype["refDTypep"]], types)
    high, low = map(int, dtype.get("range", "0:0").split(":"))
    return high - low + 1


def _public(module: str, ports: list[Port], names: Sequence[str]) -> str:
    """Verilator's configuration that shows ports and other signals to cocotb."""
    ways = {"input": "rw", "output": "rd"}
    shown = [(port.name, ways[port.direction]) for port in ports] + [(name, "rw") for name in names]
    lines = [f'public_flat_{way} -module "{module}" -var "{name}"' for name, way in shown]
    return "\n".join(["`verilator_config", *lines, ""])


def build(
    module: str, parameters: dict[str, int], glue, *, waves: bool = False, public: Sequence[str] | None = None,
    netlist: Path | None = None,
) -> tuple[Path, list[Port]]:  # fmt: skip
    """The shared library of a module and its ports. ``glue(ports)`` gives the C++ that knows their names.

    ``public``: cocotb can drive the model, too: its ports and parameters, and inner signals of these names (``*_q``).
    That makes small models up to a sixth slower. ``netlist``: Verilog of the module at these parameters, compiled in
    place of its sources; where it has an input ``mutant_i``, that chooses a fault. With POLYSHADE_COVERAGE in the
    environment lines, branches and toggles are counted.
    """
    verilator, coverage = tools.verilator(), bool(os.environ.get(COVERAGE)) and not netlist
    files = [netlist] if netlist else reached(module)
    own = [(HERE / "harness.cpp").read_bytes(), (HERE / "model.py").read_bytes(), Path(__file__).read_bytes()]
    key = key_of(parameters, [path.read_bytes() for path in files], own, verilator.version, waves, public, coverage)
    path = CACHE / f"{module}-{key}"
    with once(path) as scratch:
        if scratch:
            found, names = ports(module, parameters, scratch)
            (scratch / "ports.json").write_text(json.dumps([asdict(port) for port in found]))
            flags = [*VERILATOR_FLAGS, *(["--trace"] if waves else [])]
            flags += ["--coverage-line", "--coverage-toggle"] if coverage else []
            text = netlist.read_text() if netlist else ""
            faulty = re.search(r"input (\[[\d:]+\] )?mutant_i;", text)
            flags += ["-Wno-fatal"] if netlist else []  # widths as they are; a fault may make a loop of logic
            if public is not None:
                flags += ["--vpi", "public.vlt"]
                (scratch / "public.vlt").write_text(
                    _public(module, found, [name for name in [*names, *public] if shown(name, text)])
                )
            run(
                [verilator.program, *flags, "--top-module", module, "--Mdir", scratch,
                 *(f"-G{name}={value}" for name, value in parameters.items() if not netlist), *files],
                scratch,
            )  # fmt: skip
            units = "".join(f'#include "{unit.name}"\n' for unit in sorted(scratch.glob("Vdut*.cpp")))
            harness = f'#include "{HERE / "harness.cpp"}"\n'
            chosen = "t.mutant_i = v;" if faulty else ""
            macros = f'#define WAVES {int(waves)}\n#define COVERAGE {int(coverage)}\n#define MODEL_KEY "{path.name}"\n'
            mutant = f"void set_mutant(DUT& t, uint64_t v) {{ (void)t; (void)v; {chosen} }}\n"
            (scratch / "all.cpp").write_text(f"{macros}{units}{glue(found)}{mutant}{harness}")
            common = runtime()
            run(
                ["g++", *CXX_FLAGS, *include(verilator.root), "-include", common / "model.h", "-shared",
                 "-o", "model.so", "all.cpp", *sorted(common.glob("*.o")), "-pthread"],
                scratch,
            )  # fmt: skip
    return path / "model.so", known_ports(path / "model.so")


def shown(name: str, netlist: str) -> bool:
    """Is an inner name there to be shown? A netlist may have lost it, and has parameters only if they were put back."""
    return not netlist or "*" in name or f"parameter {name} =" in netlist


def known_ports(library: Path) -> list[Port]:
    """The ports of the module in a library that was built."""
    found = json.loads(library.with_name("ports.json").read_text())
    return [Port(**port | {"fields": tuple(Field(**field) for field in port["fields"])}) for port in found]
