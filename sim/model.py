# SPDX-License-Identifier: Apache-2.0
"""Any module of the RTL as a NumPy-callable object: arrays in, arrays and clocks out, at millions of clocks a second.

>>> third = sim.load("shade_third", WIDTH=18)
>>> run = third.run(x_i=np.arange(-4, 5))
>>> run.y_o.tolist(), run.clocks, (run.given - run.taken).tolist()[:3]
([-1, -1, -1, 0, 0, 0, 1, 1, 1], 14, [5, 5, 5])
"""

from __future__ import annotations

import contextlib
import ctypes
import operator
import os
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike
from polyshade.golden import contract as k
from polyshade.golden.types import numbers, words
from polyshade.sim import verilate
from polyshade.sim.errors import UserError
from polyshade.sim.sources import BUILD
from polyshade.sim.verilate import Port

NEVER = (1 << 64) - 1
WORDS_MAX = 64  # bits of a port that travel as one integer; wider ones as rows of uint32, least significant first


class SimulationError(Exception):
    """The module stopped, no input was taken and no output given for too long; an access to a register failed; or an
    assertion in the module did."""


@dataclass(frozen=True)
class Channel:
    """One side of a module: its data ports, and the names of valid and ready (None: there is none).

    ``streams``: so many side by side, with a bit each in valid and ready.
    """

    data: list[Port]
    valid: str | None
    ready: str | None
    streams: int = 1


@dataclass(frozen=True)
class Interface:
    """The roles of a module's ports, told by their names: ``valid_i``, ``s_axis_*_tvalid``, ..."""

    clock: bool
    reset: bool
    phase: bool
    into: Channel
    out: Channel
    status: list[Port]
    address: Port | None  # of registers on s_axil_*


def interface(ports: list[Port]) -> Interface:
    """Sort ports into an input channel, an output channel and status outputs.

    A port ``s_axis_<name>_tvalid`` makes all ports ``s_axis_<name>_*`` the input channel, and settings beside it change
    with its rows; otherwise all inputs but clock, reset and handshakes are, with ``valid_i`` and ``ready_o`` if there.
    Outputs likewise with ``m_axis_<name>_*``, whose other outputs are status, or ``valid_o`` and ``ready_i``; if tvalid
    has several bits, for streams side by side, it is one of the data ports. ``s_axil_*`` are no data ports.
    """
    address = next((port for port in ports if port.name == "s_axil_awaddr"), None)
    ports = [port for port in ports if not port.name.startswith("s_axil_")]
    names = {port.name for port in ports}
    handshakes = {"clk_i", "rst_i", "phase_i", "valid_i", "ready_i", "valid_o", "ready_o"}

    def channel(direction: str, prefix: str, valid: str, ready: str) -> tuple[Channel, list[Port]]:
        own = [port for port in ports if port.direction == direction and port.name not in handshakes]
        axis = next((m[1] for name in names if (m := re.match(rf"({prefix}_axis_\w+)_tvalid$", name))), None)
        if axis:
            (streams,) = (port.width for port in ports if port.name == f"{axis}_tvalid")
            control = (f"{axis}_tready", *([f"{axis}_tvalid"] if streams == 1 else []))
            data = [p for p in own if p.name.startswith(axis) and p.name not in control]
            rest = [p for p in own if p not in data and "_axis_" not in p.name]
            return Channel(data, f"{axis}_tvalid", f"{axis}_tready", streams), rest
        own = [p for p in own if "_axis_" not in p.name]
        return Channel(own, valid if valid in names else None, ready if ready in names else None), []

    into, settings = channel("input", "s", "valid_i", "ready_o")
    into = replace(into, data=into.data + settings)
    out, status = channel("output", "m", "valid_o", "ready_i")
    return Interface("clk_i" in names, "rst_i" in names, "phase_i" in names, into, out, status, address)


def _words(port: Port) -> int:
    """Words of 32 bits that a port's value takes."""
    return -(-port.width // 32)


def _slots(port: Port) -> int:
    """Integers that a status port's value takes."""
    return 1 if port.width <= WORDS_MAX else _words(port)


def _status(ports: list[Port]) -> str:
    """C++ that reads status ports."""
    lines, at = [], 0
    for port in ports:
        if port.width <= WORDS_MAX:
            lines.append(f"  status[{at}] = t.{port.name};")
        else:
            lines += [f"  status[{at + w}] = t.{port.name}[{w}];" for w in range(_words(port))]
        at += _slots(port)
    return "".join(lines)


def glue(ports: list[Port]) -> str:
    """The C++ that knows the names of the ports; what it must define is listed in harness.cpp."""
    face = interface(ports)

    def drive(port: Port, index: int) -> str:
        if port.width <= WORDS_MAX:
            return f"  t.{port.name} = static_cast<const uint64_t*>(in[{index}])[row];\n"
        words = _words(port)
        source = f"static_cast<const uint32_t*>(in[{index}]) + row * {words}"
        return f"  for (int w = 0; w < {words}; w++) t.{port.name}[w] = ({source})[w];\n"

    def collect(port: Port, index: int) -> str:
        if port.width <= WORDS_MAX:
            return f"  out[{index}].push_back(t.{port.name});\n"
        return f"  for (int w = 0; w < {_words(port)}; w++) out[{index}].push_back(t.{port.name}[w]);\n"

    def setter(name: str, port: str | None, bits: int = 1) -> str:
        value = "v" if bits == 1 else f"v ? {(1 << bits) - 1} : 0"
        return f"void {name}(DUT& t, int v) {{ {f't.{port} = {value};' if port else '(void)t; (void)v;'} }}\n"

    def getter(name: str, port: str | None) -> str:
        return f"bool {name}(DUT& t) {{ {f'return t.{port};' if port else '(void)t; return true;'} }}\n"

    return f"""
#define AXIL {int(face.address is not None)}
#include <cstdint>
#include <vector>
using DUT = Vdut;
constexpr bool CLOCKED = {str(face.clock).lower()}, OUT_VALID = {str(face.out.valid is not None).lower()};
constexpr int OUT_PORTS = {len(face.out.data)}, STATUS_PORTS = {sum(map(_slots, face.status))};
namespace {{
{setter("set_clock", "clk_i" if face.clock else None)}{setter("set_reset", "rst_i" if face.reset else None)}\
void set_phase(DUT& t, uint64_t v) {{ {"t.phase_i = v;" if face.phase else "(void)t; (void)v;"} }}
{setter("set_in_valid", face.into.valid)}{getter("in_ready", face.into.ready)}\
{getter("out_valid", face.out.valid)}{setter("set_out_ready", face.out.ready, face.out.streams)}\
inline void drive(DUT& t, const void* const* in, uint64_t row) {{
{"".join(drive(port, i) for i, port in enumerate(face.into.data))}}}
inline void collect(DUT& t, std::vector<std::vector<uint64_t>>& out) {{
{"".join(collect(port, i) for i, port in enumerate(face.out.data))}}}
inline void read_status(DUT& t, uint64_t* status) {{
{_status(face.status)}}}
}}
"""


def _leaves(port: Port) -> list[Port]:
    """The numbers that a port takes: itself, or the fields of a structure, by names such as ``n_i.x``."""
    return [Port(f.name, port.direction, f.width, f.format == "S") for f in port.fields] or [port]


def _parts(name: str, leaves: list[Port], value: object) -> dict[str, ArrayLike]:
    """A structure by the names of its fields: from a mapping, which may be nested, from the fields in a row, or from a
    single number for all of them."""
    if not isinstance(value, Mapping):
        if np.ndim(value) == 0:
            return dict.fromkeys((leaf.name for leaf in leaves), value)
        parts = value if isinstance(value, (tuple, list)) else np.moveaxis(np.asarray(value), -1, 0)
        if len(parts) != len(leaves):
            names = ", ".join(leaf.name for leaf in leaves)
            raise UserError(f"{name}: {len(parts)} fields given, needed {len(leaves)}: {names}")
        return {leaf.name: part for leaf, part in zip(leaves, parts, strict=True)}
    found: dict[str, ArrayLike] = {}
    for part, number in value.items():
        below = [leaf for leaf in leaves if leaf.name.startswith(f"{name}.{part}.")]
        found |= _parts(f"{name}.{part}", below, number) if below else {f"{name}.{part}": number}
    return found


def _bits(port: Port, arrays: dict[str, np.ndarray], rows: int) -> np.ndarray:
    """Rows as harness.cpp reads them: (rows,) uint64, of a wide port (rows, words) uint32."""
    if port.fields:
        array = words(port.fields, [np.broadcast_to(arrays[field.name], rows) for field in port.fields], port.width)
        if port.width > WORDS_MAX:
            return np.ascontiguousarray(array)
        return (array.astype(np.uint64) << np.array([0, 32], np.uint64)[: array.shape[-1]]).sum(-1, np.uint64)
    array = arrays[port.name]
    array = np.broadcast_to(array, (rows, *array.shape[1:]))
    if port.width > WORDS_MAX:
        return np.ascontiguousarray(array, np.uint32)
    return array.astype(np.int64, copy=False).view(np.uint64) & np.uint64((1 << port.width) - 1)


class _Job(ctypes.Structure):
    _fields_ = (
        ("rows", ctypes.c_uint64),
        ("in", ctypes.c_void_p),
        ("in_gap", ctypes.c_uint32),
        ("out_stall", ctypes.c_uint32),
        ("seed", ctypes.c_uint64),
        ("state", ctypes.c_uint64),
        ("reset_at", ctypes.c_uint64),
        ("most", ctypes.c_uint64),
        ("mutant", ctypes.c_uint64),
        ("latency", ctypes.c_uint64),
        ("pace", ctypes.c_uint64),
        ("take", ctypes.c_uint64),
        ("drain", ctypes.c_uint64),
        ("patience", ctypes.c_uint64),
        ("waves", ctypes.c_char_p),
        ("words", ctypes.c_void_p),
        ("writes", ctypes.c_uint64),
        ("reads", ctypes.c_uint64),
        ("given", ctypes.c_uint64),
        ("clocks", ctypes.c_uint64),
        ("simulated", ctypes.c_uint64),
        ("accesses", ctypes.c_uint64),
    )


class Run:
    """What a run gave: every data output as an array attribute of its name, and when.

    ``outputs``: the same arrays by name, of a structure every field, ``outputs["n_o.x"]``; as an attribute ``n_o`` is a
    mapping of these: ``n_o["x"]``.

    ``taken[i]``, ``given[j]``: the clock (0: the first after reset) of input transfer i and of output transfer j;
    ``clocks``: clocks up to and with the last output; ``simulated``: all clocks; ``status``: status outputs at the end;
    ``registers``: words that were read then, by offset.
    """

    def __init__(
        self,
        outputs: dict[str, np.ndarray],
        taken,
        given,
        clocks: int,
        simulated: int,
        status,
        registers: dict[int, int],
    ):
        self.outputs, self.taken, self.given = outputs, taken, given
        self.clocks, self.simulated, self.status, self.registers = clocks, simulated, status, registers

    def __getattr__(self, name: str) -> np.ndarray | dict[str, np.ndarray]:
        outputs = self.__dict__.get("outputs", {})  # an object that is being copied has none yet
        if name in outputs:
            return outputs[name]
        if fields := {path.partition(".")[2]: v for path, v in outputs.items() if path.startswith(f"{name}.")}:
            return fields
        raise AttributeError(f"no output {name}, there are {', '.join(outputs)}")


class Model:
    """A module at a parameter point. Every :meth:`run` starts from reset; what reset leaves alone is random."""

    def __init__(
        self, module: str, parameters: dict[str, int], *, waves: bool, public: tuple[str, ...] | None = None,
        netlist: Path | None = None,
    ):  # fmt: skip
        library, self.ports = verilate.build(module, parameters, glue, waves=waves, public=public, netlist=netlist)
        self.module, self.parameters, self.waves = module, parameters, waves
        self.mutant, self.most = 0, NEVER  # of a netlist with faults: which one; clocks after which a run is given up
        self.interface = interface(self.ports)
        self._library = ctypes.CDLL(str(library))
        for name in ("model_out", "model_taken", "model_given", "model_status"):
            getattr(self._library, name).restype = ctypes.c_void_p
        self._library.model_taken_rows.restype = ctypes.c_uint64

    def __repr__(self) -> str:
        return f"{self.module}({', '.join(f'{name}={value}' for name, value in self.parameters.items())})"

    def again(self, *, writes: Mapping[int, int] | None = None, **inputs: ArrayLike) -> str:
        """A command to paste at the repository's root that runs one row of inputs with a waveform.

        >>> print(sim.load("shade_third", WIDTH=18).again(x_i=100))
        python -c 'from polyshade import sim; print(sim.load("shade_third", waves=True, WIDTH=18).run(x_i=0x64).outputs)'
        """  # noqa: E501

        def shown(value: ArrayLike) -> str:
            parts = np.asarray(value)
            return f"[{', '.join(map(shown, parts))}]" if parts.ndim else f"{int(parts):#x}"

        point = "".join(f", {name}={value}" for name, value in self.parameters.items())
        given = [f"{name}={shown(value)}" for name, value in inputs.items() if "." not in name]
        if dotted := [f'"{name}": {shown(value)}' for name, value in inputs.items() if "." in name]:
            given.append(f"**{{{', '.join(dotted)}}}")
        if writes:
            given.append(f"writes={{{', '.join(f'{offset:#x}: {word:#x}' for offset, word in writes.items())}}}")
        row = ", ".join(given)
        call = f'sim.load("{self.module}", waves=True{point}).run({row})'
        return f"python -c 'from polyshade import sim; print({call}.outputs)'"

    def _inputs(self, inputs: dict[str, ArrayLike]) -> tuple[int, list[np.ndarray]]:
        """The number of rows, and the inputs, checked, in the order of the ports and as harness.cpp reads them."""
        ports = self.interface.into.data
        for port in ports:
            if port.fields and port.name in inputs:
                inputs = inputs | _parts(port.name, _leaves(port), inputs[port.name])
                del inputs[port.name]
        leaves = [leaf for port in ports for leaf in _leaves(port)]
        if set(inputs) != {leaf.name for leaf in leaves}:
            needed = ", ".join(leaf.name for leaf in leaves)
            raise UserError(f"{self.module}: inputs {', '.join(sorted(inputs))} given, needed {needed}")
        arrays = {leaf.name: self._checked(leaf, inputs[leaf.name]) for leaf in leaves}
        try:
            (rows,) = np.broadcast_shapes((1,), *(array.shape[:1] for array in arrays.values()))
        except ValueError:
            counts = ", ".join(f"{name} {len(array)}" for name, array in arrays.items())
            raise UserError(f"{self.module}: numbers of rows differ, {counts}") from None
        return rows, [_bits(port, arrays, rows) for port in ports]

    def _checked(self, port: Port, value: ArrayLike) -> np.ndarray:
        """An input as an array (rows,), for a wide port (rows, words); a single value becomes one row."""
        array, name = np.asarray(value), f"{self.module}.{port.name}"
        shape = (_words(port),) if port.width > WORDS_MAX else ()
        width, signed = (32, False) if shape else (port.width, port.signed)
        low, high = (-(1 << width - 1), (1 << width - 1) - 1) if signed else (0, (1 << width) - 1)
        if array.dtype.kind not in "iub":
            raise UserError(f"{name}: {array.dtype} given, allowed integers")
        if array.shape not in (shape, (*array.shape[:1], *shape)):
            rows = f"({', '.join(map(str, ('rows', *shape)))})"
            raise UserError(f"{name}: array of shape {array.shape} given, allowed {rows} or {shape or 'a number'}")
        if array.size and (array.min() < low or array.max() > high):
            raise UserError(f"{name}: {array.min()} .. {array.max()} given, allowed {low} .. {high}")
        if shape and (array[..., -1] >> (bits := (port.width - 1) % 32 + 1)).any():
            raise UserError(f"{name}: the last word of a row has more than {bits} bits")
        return array.reshape(-1, *shape)

    def _accesses(self, writes: Mapping[int, int], reads: list[int]) -> np.ndarray:
        """Rows of offset and word as harness.cpp takes them: what is written, then what is read."""
        address = self.interface.address
        if (writes or reads) and not address:
            raise UserError(f"{self.module}: writes or reads given, but it has no registers on s_axil_*")
        pairs = [(*map(operator.index, pair),) for pair in (*writes.items(), *((offset, 0) for offset in reads))]
        for offset, word in pairs:
            if not (0 <= offset < 1 << address.width and 0 <= word < 1 << 32):
                raise UserError(
                    f"{self.module}: word {word:#x} at offset {offset:#x}, allowed 0 .. 0xffffffff at "
                    f"0 .. {(1 << address.width) - 1:#x}"
                )
        return np.array(pairs, np.uint32).reshape(-1, 2)

    def run(
        self,
        *,
        in_gap: float = 0.0,
        out_stall: float = 0.0,
        seed: int = 1,
        state: int | None = None,
        reset_at: int | None = None,
        latency: int | None = None,
        pace: int = 1,
        drain: int = 256,
        patience: int = 100_000,
        writes: Mapping[int, int] | None = None,
        reads: Iterable[int] = (),
        **inputs: ArrayLike,
    ) -> Run:
        """Stream arrays through the module, one row a transfer.

        ``inputs``: an array (rows,) or a number for every data input, by name; of ports of more than 64 bits (rows,
        words) or (words,) of 32 bits; of structures one for every field, ``**{"n_i.x": x, ...}``, ``n_i={"x": x, ...}``
        or, lowest bits first, ``n_i=(x, y, z)`` or an array (rows, fields), or a number for all fields.
        ``in_gap``, ``out_stall``: probability of a clock without an offer, of one without a consumer, where the module
        has a clock, a ready input. ``latency``: of a module without ``valid_o``, by default the contract's LATENCY_*.
        ``pace``: clocks a row of a module with ``phase_i``, which counts 0 to ``pace`` - 1; a row is taken in the phase
        that its parameter TAKE tells, by default 0.
        ``seed``: of gaps and stalls, and of the contents of registers without reset, unless ``state`` is given.
        ``reset_at``: in that clock the module is reset amid its traffic; then registers are written and all rows come
        again, and what is returned is what followed. The run ends ``drain`` clocks after the last transfer. Where the
        module has registers on ``s_axil_*``, ``writes``, words by offset, come before the streams, and ``reads``,
        offsets, after them.

        Raises UserError for missing, unknown, misshapen or out-of-range inputs, SimulationError when nothing is taken
        or given for ``patience`` clocks, and when a register answers with an error or not at all.
        """
        face = self.interface
        for option, chance, waits in (("in_gap", in_gap, face.clock), ("out_stall", out_stall, face.out.ready)):
            if not 0 <= chance <= (1 if waits else 0):
                limit = "0 to 1" if waits else f"0, {self.module} cannot wait there"
                raise UserError(f"{option}: {chance} is out of range, allowed is {limit}")
        if latency is None:
            latency = k.constants().get(f"LATENCY_{self.module.removeprefix('shade_').upper()}", 0)
        rows, arrays = self._inputs(inputs)
        writes, reads = dict(writes or {}), list(reads)
        accesses = self._accesses(writes, reads)
        pointers = (ctypes.c_void_p * max(1, len(arrays)))(*(array.ctypes.data for array in arrays))
        waves = BUILD / "waves" / f"{self.module}.vcd"
        if self.waves:
            waves.parent.mkdir(parents=True, exist_ok=True)
        job = _Job(
            rows, ctypes.cast(pointers, ctypes.c_void_p), int(in_gap * 65536), int(out_stall * 65536), seed,
            seed if state is None else state, NEVER if reset_at is None else reset_at, self.most, self.mutant,
            latency, pace, self.parameters.get("TAKE", 0), drain, patience, str(waves).encode(), accesses.ctypes.data,
            len(writes), len(reads),
        )  # fmt: skip
        session = ctypes.c_void_p()
        stopped = self._library.model_run(ctypes.byref(job), ctypes.byref(session))
        try:
            return self._result(job, session, stopped, rows, accesses)
        finally:
            self._library.model_free(session)

    def _result(self, job: _Job, session: ctypes.c_void_p, stopped: int, rows: int, accesses: np.ndarray) -> Run:
        def column(pointer: int | None, count: int) -> np.ndarray:
            if not count:
                return np.zeros(0, np.uint64)
            return np.ctypeslib.as_array(ctypes.cast(pointer, ctypes.POINTER(ctypes.c_uint64)), (count,)).copy()

        taken = column(self._library.model_taken(session), self._library.model_taken_rows(session))
        if stopped == 4:
            raise SimulationError(f"{self!r}: an assertion failed, standard output names it")
        if stopped > 1:
            access = "write to" if job.accesses < job.writes else "read of"
            told = "error response" if stopped == 2 else f"no answer for {job.patience} clocks"
            raise SimulationError(f"{self!r}: {access} register {accesses[job.accesses, 0]:#05x}: {told}")
        if stopped:
            raise SimulationError(
                f"{self!r} stopped: {len(taken)} of {rows} inputs taken, {job.given} outputs given, nothing for "
                f"{job.patience} clocks"
            )
        face = self.interface
        outputs = {}
        for index, port in enumerate(face.out.data):
            count = 1 if port.width <= WORDS_MAX else _words(port)
            value = column(self._library.model_out(session, index), job.given * count)
            if port.fields:
                beats = value.reshape(-1, count) if count > 1 else value[:, None] >> np.array([0, 32], np.uint64)
                beats = beats & np.uint64(0xFFFFFFFF)
                outputs |= zip((field.name for field in port.fields), numbers(port.fields, beats), strict=True)
                continue
            if count > 1:
                value = value.reshape(-1, count).astype(np.uint32)
            else:
                value = value.view(np.int64)
                if port.signed:
                    shift = 64 - port.width
                    value = value << shift >> shift
            outputs[port.name] = value
        given = column(self._library.model_given(session), job.given).view(np.int64)
        status = iter(column(self._library.model_status(session), sum(map(_slots, face.status))).tolist())
        named = {port.name: sum(next(status) << 32 * i for i in range(_slots(port))) for port in face.status}
        read = dict(accesses[job.writes :].tolist())
        return Run(outputs, taken.view(np.int64), given, job.clocks, job.simulated, named, read)


_loaded: dict[object, Model] = {}
_netlist: Callable[[str, dict[str, int]], Path | None] | None = None


def load(module: str, *, waves: bool | None = None, public: tuple[str, ...] | None = None, **parameters: int) -> Model:
    """The Verilated model of a module at a parameter point, compiled when first asked for.

    ``waves`` (default: the environment's ``WAVES=1``) writes ``build/waves/<module>.vcd`` during a run. ``public``: see
    ``sim.verilate.build``; with ``()`` the model is the one that cocotb drives.
    Raises UserError for an unknown module or tool, and in the words of the module for a parameter that it refuses.
    """
    for name, value in parameters.items():
        try:
            parameters[name] = int(operator.index(value))
        except TypeError:
            raise UserError(f"{module}: {name}={value!r}, allowed integers") from None
    waves = os.environ.get("WAVES", "0") not in ("", "0") if waves is None else waves
    netlist = netlist_of(module, parameters)
    public = None if netlist else public
    key = (module, tuple(sorted(parameters.items())), waves, public, netlist and netlist.read_bytes())
    if key not in _loaded:
        _loaded[key] = Model(module, parameters, waves=waves, public=public, netlist=netlist)
    return _loaded[key]


def netlist_of(module: str, parameters: dict[str, int]) -> Path | None:
    """The netlist that is compiled in place of a module's RTL, if any."""
    return _netlist(module, parameters) if _netlist else None


@contextlib.contextmanager
def netlists(netlist: Callable[[str, dict[str, int]], Path | None]) -> Iterator[None]:
    """Within the block :func:`load` compiles ``netlist(module, parameters)``, a Verilog file, in place of the RTL."""
    global _netlist
    before, _netlist = _netlist, netlist
    try:
        yield
    finally:
        _netlist = before
