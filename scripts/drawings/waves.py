# SPDX-License-Identifier: Apache-2.0
"""Signals of a module as arrays, one value a clock, read from the waveform of a run."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np
from polyshade import sim
from polyshade.sim.sources import BUILD

RESET_CLOCKS = 3  # that sim spends before clock 0
SAMPLES_PER_CLOCK = 2  # before and behind the rising edge


def record(module: str, names: Iterable[str], *, signed: Iterable[str] = (), **run) -> tuple[sim.Run, dict]:
    """Run a module at its default parameters as ``polyshade.sim.load(module).run(**run)`` and record signals of it.

    ``names`` as seen from the module, ``"u_walk.busy_q"``. The run and ``{name: (clocks,)}``: value i is what the
    rising edge at the end of clock i sees, clocks counted as in ``run.taken``; Python integers where a signal is wide.
    """
    done = sim.load(module, waves=True).run(**run)
    return done, read(BUILD / "waves" / f"{module}.vcd", names, signed)


def read(path: Path, names: Iterable[str], signed: Iterable[str] = ()) -> dict[str, np.ndarray]:
    """Signals of a VCD file that a run has left, as :func:`record` gives them. KeyError for one that is not in it."""
    lines = iter(path.read_text().splitlines())
    codes, widths, scope = {}, {}, []
    for line in lines:
        match line.split():
            case ["$scope", _, name, "$end"]:
                scope.append(name)
            case ["$upscope", *_]:
                scope.pop()
            case ["$var", _, width, code, name, *_]:
                codes[".".join([*scope[2:], name])] = code  # below TOP.<module>
                widths[code] = int(width)
            case ["$enddefinitions", *_]:
                break
    wanted = {name: codes[name] for name in names}
    value = dict.fromkeys(wanted.values(), 0)
    rows: list[list[int]] = []
    for line in lines:
        if line.startswith("#"):
            rows.append(list(value.values()))  # what stood until now
        elif line:
            bits, code = line[1:].split() if line[0] == "b" else (line[0], line[1:])
            if code in value:
                value[code] = int(bits, 2)
    rows.append(list(value.values()))
    rows = rows[1 + SAMPLES_PER_CLOCK * RESET_CLOCKS :: SAMPLES_PER_CLOCK]
    columns = dict(zip(value, zip(*rows, strict=True), strict=True))

    def column(name: str) -> np.ndarray:
        width = widths[wanted[name]]
        half = 1 << width - 1
        values = columns[wanted[name]]
        return np.array([(v ^ half) - half for v in values] if name in signed else values)

    return {name: column(name) for name in wanted}
