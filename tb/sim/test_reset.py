# SPDX-License-Identifier: Apache-2.0
"""Streams do not depend on what registers hold at the start, nor on what was before a reset of one clock."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import normal, patch, poly, raster
from polyshade.golden.direct import lobe_packet
from polyshade.golden.material import Material, chords, light_registers, planner_registers, registers
from polyshade.golden.registers import pack
from polyshade.scripts.flow import soak
from polyshade.sim import core
from polyshade.sim import patch as patches
from polyshade.sim.units import unit_vectors

from tb.raster.vectors import mixture
from tb.runner import FULL, SEED

LIGHT = (0.3, 0.6, 0.8)
ONE = 1 << k.INTENSITY_F


def fifo(rng: np.random.Generator) -> tuple[sim.Model, dict]:
    return sim.load("shade_fifo", BLOCK=1), {"data_i": rng.integers(0, 1 << 32, 20)}


def poly_span(rng: np.random.Generator) -> tuple[sim.Model, dict]:
    degree = rng.integers(0, 4, 40)
    count = np.where(degree == k.DEGREE_DIRECT, rng.integers(1, 5, 40), rng.geometric(0.08, 40))
    nodes = rng.integers(-ONE, ONE, (40, k.CHANNELS, k.NODE_COUNT))
    beats = poly.pack_records(nodes, degree, count, rng.integers(0, 9, 40), rng.integers(0, 2, 40))
    model = sim.load("shade_poly_span", EVALUATOR=k.EVALUATOR_FDIFF, FORM=k.FORM_REFINED)
    return model, {"s_axis_span_tdata": beats}


def pixel_normals(rng: np.random.Generator) -> tuple[sim.Model, dict]:
    first = unit_vectors(rng, 40).T << k.STEP_F - k.INTENSITY_F
    steps, count = rng.integers(-(1 << 20), 1 << 20, (40, 3)), rng.geometric(0.1, 40)
    beats = normal.pack_spans(first, steps, count, rng.integers(0, ONE, 40), rng.integers(0, 9, 40))
    named = {"variant_i": rng.integers(0, 8, 40), "threshold_i": k.METRIC_THRESHOLD}
    return sim.load("shade_pixel_normals"), {"s_axis_line_tdata": beats} | named


def of_core(path: int) -> Callable[[np.random.Generator], tuple[sim.Model, dict]]:
    def shade_core(rng: np.random.Generator) -> tuple[sim.Model, dict]:
        point = {"LANES": 2, "EVALUATOR": k.EVALUATOR_FDIFF, "FORM": k.FORM_REFINED}
        surface = Material("cook-torrance", roughness=0.3)
        words = registers(surface, LIGHT) | planner_registers(surface) | {"path": path}
        sent = soak.lines(rng, 60).beats
        return sim.load("shade_core", **point), {"s_axis_span_tdata": sent, **core.WHOLE, "writes": pack(words)}

    return shade_core


def shade_patch(rng: np.random.Generator) -> tuple[sim.Model, dict]:
    words, table = patch.registers(Material("blinn", 60), LIGHT)
    beats = patches.beats(soak.triangles(rng, 40), table)
    return sim.load("shade_patch", LANES=2), beats | patches.settings(words)


def shade_direct(rng: np.random.Generator) -> tuple[sim.Model, dict]:
    surface = Material("blinn", 60)
    words, packets, before = (
        light_registers(LIGHT),
        soak.triangles(rng, 40).stream(),
        lobe_packet(chords(surface, LIGHT)),
    )
    ports = {f"{name}_i.{axis}": words[f"{name}{axis}"] for name in "lh" for axis in "xyz"}
    return sim.load("shade_direct"), {name: np.r_[before[name], packets[name]] for name in packets} | ports


def shade_spans(rng: np.random.Generator) -> tuple[sim.Model, dict]:
    view = raster.View(64, 64, k.CULL_NONE)
    waits = {"drain": 1 << 15, "patience": 1 << 15}
    return sim.load("shade_spans"), raster.beats(mixture(rng, 12, 64)) | view.ports | waits


STREAMS = {
    "shade_fifo": fifo,
    "shade_poly_span": poly_span,
    "shade_pixel_normals": pixel_normals,
    "shade_core": of_core(k.PATH_POLY),
    "shade_core by normals": of_core(k.PATH_NORMALS),
    "shade_patch": shade_patch,
    "shade_direct": shade_direct,
    "shade_spans": shade_spans,
}


def same(one: sim.Run, two: sim.Run, model: sim.Model) -> None:
    """Every bit of every output that is valid, every clock of a transfer, the status."""
    module, lanes = model.module, model.parameters.get("LANES", 1)
    assert np.array_equal(one.given, two.given)
    assert np.array_equal(one.taken, two.taken)
    if lanes > 1:
        split = {"shade_patch": patches.streams}.get(module, core.streams)
        first, second = (split(run.outputs, lanes) for run in (one, two))
        assert all(np.array_equal(a, b) for a, b in zip(first, second, strict=True))
    else:
        assert all(np.array_equal(values, two.outputs[name]) for name, values in one.outputs.items())
    assert one.status == two.status


@pytest.mark.parametrize("name", STREAMS)
def test_state_and_reset(name: str) -> None:
    """Three contents of registers give the same run to the clock, and so does any run behind a reset of one clock, in
    whatever clock of the traffic it came, while source and sink go on."""
    model, inputs = STREAMS[name](np.random.default_rng(SEED))
    traffic = {"in_gap": 0.2, "seed": SEED} | ({"out_stall": 0.2} if model.interface.out.ready else {})
    calm = {**traffic, "in_gap": 0.0} | ({"out_stall": 0.0} if model.interface.out.ready else {})
    one = model.run(**inputs, **traffic, state=1)
    assert len(one.given) >= 20
    for state in (2, 3):
        same(one, model.run(**inputs, **traffic, state=state), model)
    one = model.run(**inputs, **calm, state=1)
    busy = np.r_[
        np.arange(1, 6), np.random.default_rng([SEED, 1]).integers(6, one.clocks, 200 if FULL else 25), one.clocks
    ]
    for state, clock in enumerate(busy.tolist()):
        same(one, model.run(**inputs, **calm, state=state, reset_at=clock), model)


def test_a_reset_that_leaves_something_is_seen() -> None:
    """Behind the reset all rows come again, and only what follows is given back."""
    model, inputs = fifo(np.random.default_rng(1))
    whole, late = (model.run(**inputs, reset_at=clock) for clock in (None, 15))
    assert late.simulated == whole.simulated
    assert np.array_equal(late.data_o, inputs["data_i"])
