# SPDX-License-Identifier: Apache-2.0
"""``sim.load``: what it accepts, what it measures, what it tells when something is wrong, and what it compiles."""

from __future__ import annotations

import copy
import doctest
import pickle
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from polyshade import sim
from polyshade.golden import contract as k
from polyshade.golden import fixed, poly, registers
from polyshade.sim import SimulationError, model, verilate
from polyshade.sim.errors import UserError
from polyshade.sim.sources import ROOT
from polyshade.sim.verilate import Port

from tb.runner import HANGS, SEED

RNG = np.random.default_rng(SEED)

# takes `TAKES` values and then no more; gives each back at once
STUCK = """
module shade_stuck #(parameter int TAKES = 3) (
  input logic clk_i, input logic rst_i, input logic valid_i, output logic ready_o, input logic [7:0] x_i,
  output logic valid_o, output logic [7:0] y_o
);
  logic [7:0] taken_q;
  assign ready_o = taken_q < 8'(TAKES);
  assign valid_o = valid_i && ready_o;
  assign y_o = x_i;
  always_ff @(posedge clk_i) begin
    if (valid_o) taken_q <= taken_q + 8'd1;
    if (rst_i) taken_q <= '0;
  end
endmodule
"""
# ports of every kind, through a register that is not reset
ECHO = """
module shade_echo #(parameter int WIDE = 70) (
  input logic clk_i, input logic rst_i, input logic valid_i, output logic valid_o,
  input logic [WIDE-1:0] wide_i, input logic one_i, input logic signed [4:0] small_i,
  input logic [63:0] word_i, input logic signed [63:0] long_i,
  output logic [WIDE-1:0] wide_o, output logic one_o, output logic signed [4:0] small_o,
  output logic [63:0] word_o, output logic signed [63:0] long_o
);
  always_ff @(posedge clk_i) begin
    {wide_o, one_o, small_o, word_o, long_o} <= {wide_i, one_i, small_i, word_i, long_i};
    valid_o <= valid_i && !rst_i;
  end
endmodule
"""
# without a clock
ADDER = """
module shade_adder (input logic signed [7:0] a_i, input logic [7:0] b_i, output logic signed [9:0] sum_o);
  assign sum_o = 10'(a_i) + $signed({2'b0, b_i});
endmodule
"""
# a register that nothing ever writes
DREAM = """
module shade_dream (input logic clk_i, input logic x_i, output logic [31:0] y_o);
  logic [31:0] dream_q;
  always_ff @(posedge clk_i) if (x_i) dream_q <= dream_q + 32'd1;
  assign y_o = dream_q;
endmodule
"""
# gives every value twice and counts, in a status output, what it took
TWICE = """
module shade_twice (
  input logic clk_i, input logic rst_i,
  input logic s_axis_in_tvalid, output logic s_axis_in_tready, input logic [15:0] s_axis_in_tdata,
  output logic m_axis_out_tvalid, input logic m_axis_out_tready, output logic [15:0] m_axis_out_tdata,
  output logic m_axis_out_tlast, output logic [7:0] taken_o
);
  logic [15:0] data_q;
  logic full_q, second_q;
  assign s_axis_in_tready = !full_q;
  assign {m_axis_out_tvalid, m_axis_out_tdata, m_axis_out_tlast} = {full_q, data_q, second_q};
  always_ff @(posedge clk_i) begin
    if (s_axis_in_tvalid && s_axis_in_tready) begin
      {full_q, second_q, data_q} <= {2'b10, s_axis_in_tdata};
      taken_o <= taken_o + 8'd1;
    end else if (m_axis_out_tvalid && m_axis_out_tready) {full_q, second_q} <= {!second_q, 1'b1};
    if (rst_i) {full_q, second_q, taken_o} <= '0;
  end
endmodule
"""
# two streams side by side: stream 1 gives its value one clock after stream 0, or waits with it
ABREAST = """
module shade_abreast (
  input logic clk_i, input logic rst_i,
  input logic s_axis_in_tvalid, output logic s_axis_in_tready, input logic [15:0] s_axis_in_tdata,
  output logic [1:0] m_axis_out_tvalid, input logic [1:0] m_axis_out_tready, output logic [31:0] m_axis_out_tdata
);
  assign s_axis_in_tready = m_axis_out_tvalid == 2'b00;
  always_ff @(posedge clk_i) begin
    m_axis_out_tvalid <= m_axis_out_tvalid & ~m_axis_out_tready;
    if (m_axis_out_tvalid == 2'b01 && m_axis_out_tready[0]) m_axis_out_tvalid <= 2'b10;
    if (s_axis_in_tvalid && s_axis_in_tready) begin
      m_axis_out_tvalid <= s_axis_in_tdata[0] ? 2'b01 : 2'b11;
      m_axis_out_tdata  <= {~s_axis_in_tdata, s_axis_in_tdata};
    end
    if (rst_i) m_axis_out_tvalid <= 2'b00;
  end
endmodule
"""
# registers that never answer
DEAF = """
module shade_deaf (
  input logic clk_i, input logic rst_i, input logic x_i, output logic y_o,
  input logic s_axil_awvalid, output logic s_axil_awready,
  input logic [11:0] s_axil_awaddr, input logic [2:0] s_axil_awprot,
  input logic s_axil_wvalid, output logic s_axil_wready, input logic [31:0] s_axil_wdata,
  input logic [3:0] s_axil_wstrb, output logic s_axil_bvalid, input logic s_axil_bready,
  output logic [1:0] s_axil_bresp, input logic s_axil_arvalid, output logic s_axil_arready,
  input logic [11:0] s_axil_araddr, input logic [2:0] s_axil_arprot,
  output logic s_axil_rvalid, input logic s_axil_rready,
  output logic [31:0] s_axil_rdata, output logic [1:0] s_axil_rresp
);
  assign {s_axil_awready, s_axil_wready, s_axil_bvalid, s_axil_bresp} = '0;
  assign {s_axil_arready, s_axil_rvalid, s_axil_rdata, s_axil_rresp} = '0;
  always_ff @(posedge clk_i) y_o <= x_i && !rst_i;
endmodule
"""


@pytest.fixture
def third() -> sim.Model:
    return sim.load("shade_third", WIDTH=18)


@pytest.fixture
def span() -> sim.Model:
    return sim.load("shade_poly_span", EVALUATOR=k.EVALUATOR_HORNER, FORM=k.FORM_REFINED)


def spans(count: int = 200) -> tuple[np.ndarray, np.ndarray]:
    """Beats of random spans, and the pixels that they make."""
    nodes = RNG.integers(0, 1 << k.INTENSITY_F, (count, k.CHANNELS, k.NODE_COUNT))
    degree, pixels = RNG.integers(1, 4, count), RNG.integers(1, 20, count)
    golden, _ = poly.poly_span(nodes, degree, pixels)
    return poly.pack_records(nodes, degree, pixels), golden[:, 0] | golden[:, 1] << k.PIXEL_W


def test_doctest() -> None:
    """The example of the module's docstring is true."""
    result = doctest.testmod(model, extraglobs={"sim": sim, "np": np})
    assert result.attempted
    assert not result.failed


# ---- values ------------------------------------------------------------------------------------------------------


def test_kinds_of_ports(toy: Callable) -> None:
    """One bit, negative numbers, 64 bits, more than 64 bits: each value comes back as it went in."""
    toy("shade_echo", ECHO)
    echo = sim.load("shade_echo", WIDE=70)
    given = {
        "wide_i": np.array([[0, 0, 0], [2**32 - 1, 2**32 - 1, 63], [1, 2, 3]], np.uint32),
        "one_i": np.array([0, 1, 1]),
        "small_i": np.array([-16, 15, -1]),
        "word_i": np.array([0, 2**64 - 1, 1 << 63], np.uint64),
        "long_i": np.array([-(1 << 63), (1 << 63) - 1, -1]),
    }
    run = echo.run(**given)
    for name, value in given.items():
        actual = run.outputs[name.replace("_i", "_o")]
        assert actual.shape == value.shape
        assert np.array_equal(actual.astype(value.dtype), value), name
    assert run.small_o.tolist() == [-16, 15, -1]
    assert run.long_o.min() == -(1 << 63)
    assert run.given.tolist() == [1, 2, 3]


def test_lists_numbers_and_booleans(toy: Callable) -> None:
    """Whatever NumPy takes for integers; a single value goes with every row."""
    toy("shade_echo", ECHO)
    echo = sim.load("shade_echo", WIDE=96)
    run = echo.run(wide_i=[7, 8, 9], one_i=[True, False], small_i=-3, word_i=np.uint8([4]), long_i=(5, 6))
    assert run.wide_o.tolist() == [[7, 8, 9]] * 2
    assert run.one_o.tolist() == [1, 0]
    assert run.small_o.tolist() == [-3, -3]
    assert run.word_o.tolist() == [4, 4]
    assert run.long_o.tolist() == [5, 6]


def test_strided_arrays(third: sim.Model) -> None:
    """Slices and reversed arrays are read by value, and inputs are left alone."""
    x = RNG.integers(-(1 << 17), 1 << 17, 300)
    kept = x.copy()
    for view in (x[::3], x[::-1], np.stack([x, x], axis=1)[:, 1], x.astype(np.int32), x.astype(">i4")):
        assert np.array_equal(third.run(x_i=view).y_o, fixed.third(view))
    assert np.array_equal(x, kept)


def test_no_rows(third: sim.Model, span: sim.Model) -> None:
    """Nothing in, nothing out, no clock."""
    run = third.run(x_i=np.zeros(0, np.int64))
    assert (run.y_o.shape, run.taken.shape, run.given.shape, run.clocks) == ((0,), (0,), (0,), 0)
    run = span.run(s_axis_span_tdata=np.zeros((0, 6), np.uint32))
    assert (run.m_axis_pixel_tdata.shape, run.clocks) == ((0,), 0)
    assert run.status == {}


def test_without_a_clock(toy: Callable) -> None:
    """A combinational module answers every row at once."""
    toy("shade_adder", ADDER)
    run = sim.load("shade_adder").run(a_i=[-128, 127, -1], b_i=[0, 255, 1])
    assert run.sum_o.tolist() == [-128, 382, 0]
    assert run.taken.tolist() == run.given.tolist() == [0, 1, 2]
    assert run.clocks == run.simulated == 3


def test_without_valid() -> None:
    """A module that tells nothing gives each row `latency` clocks later."""
    run = sim.load("shade_delay", WIDTH=9, DEPTH=3).run(d_i=np.arange(500), latency=3)
    assert np.array_equal(run.q_o, np.arange(500))
    assert set(run.given - run.taken) == {3}


def test_registers_without_reset_are_random(toy: Callable) -> None:
    """They hold what the seed says: not 0, not the same for another seed."""
    toy("shade_dream", DREAM)
    dream = sim.load("shade_dream")
    values = [int(dream.run(x_i=0, seed=seed).y_o[0]) for seed in (1, 1, 2, 3)]
    assert values[0] == values[1]
    assert len(set(values)) == 3
    assert 0 not in values


def test_more_outputs_than_inputs(toy: Callable) -> None:
    """Streams need not keep step: what comes out is counted on its own, status outputs are read at the end."""
    toy("shade_twice", TWICE)
    twice = sim.load("shade_twice")
    for in_gap, out_stall in ((0, 0), (0.5, 0.5)):
        run = twice.run(s_axis_in_tdata=np.arange(100), in_gap=in_gap, out_stall=out_stall)
        assert np.array_equal(run.m_axis_out_tdata, np.repeat(np.arange(100), 2))
        assert np.array_equal(run.m_axis_out_tlast, np.tile([0, 1], 100))
        assert (len(run.taken), len(run.given)) == (100, 200)
        assert run.status == {"taken_o": 100}


PAIR = """
module shade_pair (
  input  logic            clk_i,
  input  shade_pkg::vec_t n_i,
  input  shade_pkg::plan_t plan_i,
  output shade_pkg::node_t node_o,
  output shade_pkg::vec_t n_o
);
  always_ff @(posedge clk_i) begin
    n_o                         <= {n_i.x, n_i.y, n_i.z};
    node_o                      <= '0;
    node_o.normal               <= n_i;
    node_o.place.head.count     <= plan_i.main;
    node_o.place.last           <= plan_i.split;
  end
endmodule
"""


def test_structures(toy: Callable) -> None:
    """Every field by its name, or in a row, lowest bits first; nested fields by their path."""
    toy("shade_pair", PAIR)
    pair = sim.load("shade_pair")
    n = np.array([[1, -2, 131071], [-131072, 0, 5]])
    plan = {"main": [4096, 1], "split": [1, 0]} | dict.fromkeys(
        ("log2", "degree", "last_count", "last_log2", "last_degree"), 0
    )
    for given in (n, tuple(n.T), dict(zip("xyz", n.T, strict=True))):
        run = pair.run(n_i=given, plan_i=plan, latency=1)
        assert np.array_equal(np.stack([run.n_o[axis] for axis in "zyx"], -1), n)
        assert np.array_equal(run.outputs["node_o.normal.z"], n[:, 2])
        assert run.node_o["place.head.count"].tolist() == [4096, 1]
        assert run.outputs["node_o.place.last"].tolist() == [1, 0]
    dotted = {f"n_i.{axis}": column for axis, column in zip("xyz", n.T, strict=True)}
    again = pair.run(**dotted, plan_i=0, latency=1)
    assert np.array_equal(again.n_o["x"], n[:, 2]) and not again.node_o["place.head.count"].any()
    for wrong, message in (
        ((1, 2), "n_i: 2 fields given, needed 3: n_i.x, n_i.y, n_i.z"),
        ((1, 2, 1 << 17), r"shade_pair.n_i.z: 131072 .. 131072 given, allowed -131072 .. 131071"),
        ({"x": 0, "w": 0}, "needed n_i.x, n_i.y, n_i.z"),
    ):
        with pytest.raises(UserError, match=message):
            pair.run(n_i=wrong, plan_i=0, latency=1)


@pytest.mark.parametrize(("in_gap", "out_stall"), [(0, 0), (0.5, 0.5)])
def test_streams_side_by_side(toy: Callable, in_gap: float, out_stall: float) -> None:
    """A row in every clock in which one of them gives something; tvalid tells which."""
    toy("shade_abreast", ABREAST)
    run = sim.load("shade_abreast").run(s_axis_in_tdata=np.arange(100), in_gap=in_gap, out_stall=out_stall)
    valid, data = run.m_axis_out_tvalid, run.m_axis_out_tdata
    assert valid.tolist() == [3, 1, 2] * 50
    assert (data[valid & 1 > 0] & 0xFFFF).tolist() == list(range(100))
    assert (data[valid & 2 > 0] >> 16).tolist() == [0xFFFF - x for x in range(100)]


# ---- registers ---------------------------------------------------------------------------------------------------

IDLE = dict.fromkeys(("busy_i", "events_i", "counts_i"), 0)  # inputs of shade_registers


def test_registers() -> None:
    """Written before the first row, read after the last one, in the order given; a structure is its fields."""
    file = sim.load("shade_registers")
    words = registers.pack({"gain": 98304, "gain_exp": -1, "ks_b": 5})
    run = file.run(
        **IDLE | {"counts_i": dict.fromkeys(("spans", "stalls", "evaluations", "errors"), 0) | {"pixels": [3, 1]}},
        writes=words,
        reads=[0x20, *words, 0],
        drain=0,
        latency=1,
    )
    assert list(run.registers) == [0x20, *words, 0]
    assert run.registers[0x20] >= 4
    assert {offset: run.registers[offset] for offset in words} == words
    assert run.registers[0] == registers.ID
    draw = registers.draw({"gain": 98304, "gain_exp": -1, "ks_b": 5})
    assert {name: value[0] for name, value in run.draw_o.items()} == draw
    assert run.taken.tolist() == [0, 1]
    assert run.simulated > 5 * len(words) + run.clocks
    assert file.run(**IDLE).registers == {}


def test_an_error_response() -> None:
    """It is told, with its register; what comes after it is not done."""
    file = sim.load("shade_registers")
    told = r"shade_registers\(\): {} register 0x010: error response"
    with pytest.raises(SimulationError, match=told.format("write to")):
        file.run(**IDLE, writes={0x40: 1, 0x10: 2}, reads=[0x10])
    with pytest.raises(SimulationError, match=told.format("read of")):
        file.run(**IDLE, writes={0x40: 1}, reads=[0, 0x10])
    with pytest.raises(SimulationError, match="write to register 0x040: error"):
        file.run(**IDLE | {"busy_i": 1}, writes={0x40: 1})


def test_no_answer(toy: Callable) -> None:
    toy("shade_deaf", DEAF)
    deaf = sim.load("shade_deaf")
    assert deaf.run(x_i=1, latency=1).y_o.tolist() == [1]
    with pytest.raises(SimulationError, match=r"shade_deaf\(\): write to register 0x004: no answer for 100 clocks"):
        deaf.run(x_i=1, writes={4: 0}, patience=100)
    with pytest.raises(SimulationError, match="read of register 0x008: no answer"):
        deaf.run(x_i=1, reads=[8], patience=100)


def test_again_with_registers() -> None:
    """The command to paste writes them too."""
    file = sim.load("shade_registers")
    assert file.again(busy_i=0, writes={0x40: 65536}).endswith("run(busy_i=0x0, writes={0x40: 0x10000}).outputs)'")


# ---- clocks ------------------------------------------------------------------------------------------------------


def test_clocks(third: sim.Model, span: sim.Model) -> None:
    """They are those of the simulated clock: rows and latency of a pipeline, 6 a value of the sequential unit."""
    run = third.run(x_i=np.arange(1000))
    assert np.array_equal(run.taken, np.arange(1000))
    assert np.array_equal(run.given, np.arange(1000) + k.LATENCY_THIRD)
    assert run.clocks == 1000 + k.LATENCY_THIRD
    assert run.simulated >= run.clocks

    run = sim.load("shade_horner_seq").run(a_i=1, b_i=2, c_i=3, d_i=4, t_i=np.arange(50))
    assert set(np.diff(run.taken)) == set(run.given - run.taken) == {k.LATENCY_HORNER_SEQ}

    beats, pixels = spans()
    run = span.run(s_axis_span_tdata=beats)
    assert run.given[0] - run.taken[0] == k.LATENCY_POLY_SPAN_HORNER
    assert np.array_equal(run.given, run.given[0] + np.arange(len(pixels)))
    assert run.clocks == run.given[-1] + 1


@pytest.mark.parametrize(("in_gap", "out_stall"), [(0.5, 0), (0, 0.5), (0.5, 0.5), (0.95, 0), (0, 0.99)])
def test_gaps_and_stalls(span: sim.Model, in_gap: float, out_stall: float) -> None:
    """They change when, never what; and a seed repeats them."""
    beats, pixels = spans()
    options = {"in_gap": in_gap, "out_stall": out_stall}
    run = span.run(s_axis_span_tdata=beats, seed=SEED, **options)
    assert np.array_equal(run.m_axis_pixel_tdata, pixels)
    assert (np.diff(run.given) > 0).all()
    if out_stall:
        assert run.clocks == pytest.approx(len(pixels) / (1 - out_stall), rel=0.1)
    again, other = (span.run(s_axis_span_tdata=beats, seed=seed, **options) for seed in (SEED, SEED + 1))
    assert np.array_equal(run.given, again.given)
    assert not np.array_equal(run.given, other.given)


@pytest.mark.parametrize("in_gap", [0, 0.25, 0.5, 0.95])
def test_gaps_of_a_pipeline(third: sim.Model, in_gap: float) -> None:
    """As often as asked for; each value has the same latency."""
    x = np.arange(4000)
    run = third.run(x_i=x, in_gap=in_gap, seed=SEED)
    assert np.array_equal(run.y_o, fixed.third(x))
    assert set(run.given - run.taken) == {k.LATENCY_THIRD}
    assert len(x) / (run.taken[-1] + 1) == pytest.approx(1 - in_gap, rel=0.15)


# ---- what is refused ---------------------------------------------------------------------------------------------


def refused(call: Callable[[], object], told: str) -> None:
    with pytest.raises(UserError) as error:
        call()
    assert told in str(error.value)
    assert "\n" not in str(error.value)


THIRD, SPAN, FILE = ("shade_third", {"WIDTH": 18}), ("shade_poly_span", {}), ("shade_registers", {})
COEF = ("shade_coef_b", {})
NODES = {"degree_i": 3, "i1_i": 0, "i2_i": [1], "i3_i": [1, 2]}
NO_FILE = "shade_third: writes or reads given, but it has no registers on s_axil_*"
RUNS = [
    *((THIRD, {"x_i": value}, told) for value, told in (
        (1 << 17, "shade_third.x_i: 131072 .. 131072 given, allowed -131072 .. 131071"),
        (-(1 << 17) - 1, "-131073 .. -131073 given"), ([0, 1 << 40], "0 .. 1099511627776 given"),
        (np.uint64(2**64 - 1), "18446744073709551615 given"), (1 << 70, "object given, allowed integers"),
        (1.0, "float64 given, allowed integers"), ([float("nan")], "float64 given"), ([], "float64 given"),
        ("1", "<U1 given"), (None, "object given"),
        ([[1], [2]], "shade_third.x_i: array of shape (2, 1) given, allowed (rows) or a number"),
    )),
    *((SPAN, {"s_axis_span_tdata": value}, told) for value, told in (
        (0, "array of shape () given, allowed (rows, 6) or (6,)"), (np.zeros(5, int), "shape (5,)"),
        (np.zeros((3, 1), int), "shape (3, 1)"), (np.zeros((3, 7), int), "shape (3, 7)"),
        (np.zeros((2, 3, 6), int), "shape (2, 3, 6)"), (np.full(6, -1), "-1 .. -1 given, allowed 0 .. 4294967295"),
        (np.full(6, 1 << 32), "allowed 0 .. 4294967295"), (np.zeros(6), "float64 given"),
    )),
    (THIRD, {}, "shade_third: inputs given, needed x_i"),
    (THIRD, {"y_i": 1}, "shade_third: inputs y_i given, needed x_i"),
    (THIRD, {"x_i": 1, "valid_i": 1}, "inputs valid_i, x_i given, needed x_i"),
    (THIRD, {"x_i": 1, "clk_i": 1}, "needed x_i"),
    (COEF, NODES | {"i4_i": [1, 2, 3]}, "rows differ, degree_i 1, i1_i 1, i2_i 1, i3_i 2, i4_i 3"),
    (COEF, NODES | {"i4_i": np.zeros(0, int)}, "rows differ"),
    *((THIRD, {"x_i": 1, option: chance}, f"{option}: {chance} is out of range, allowed is 0")
      for option in ("in_gap", "out_stall") for chance in (-0.1, 1.01, float("nan"), float("inf"))),
    (THIRD, {"x_i": 1, "out_stall": 0.5}, "out_stall: 0.5 is out of range, allowed is 0, shade_third cannot wait"),
    (THIRD, {"x_i": 1, "writes": {0: 1}}, NO_FILE),
    (THIRD, {"x_i": 1, "reads": [0]}, NO_FILE),
    (FILE, IDLE | {"writes": {0x40: 1 << 32}}, "word 0x100000000 at offset 0x40, allowed 0 .. 0xffffffff at 0 .. 0xf"),
    (FILE, IDLE | {"writes": {0x40: -1}}, "shade_registers: word -0x1 at offset 0x40"),
    (FILE, IDLE | {"writes": {0x1000: 1}}, "word 0x1 at offset 0x1000"),
    (FILE, IDLE | {"reads": [-4]}, "word 0x0 at offset -0x4"),
]  # fmt: skip


@pytest.mark.parametrize(("of", "run", "told"), RUNS)
def test_what_run_refuses(of: tuple[str, dict], run: dict, told: str) -> None:
    refused(lambda: sim.load(of[0], **of[1]).run(**run), told)


def test_last_word_of_wide_ports(toy: Callable) -> None:
    """Bits above the port's width are no part of a value."""
    toy("shade_echo", ECHO)
    rest = {"one_i": 0, "small_i": 0, "word_i": 0, "long_i": 0}
    for wide, bits in ((70, 6), (96, 32)):
        echo = sim.load("shade_echo", WIDE=wide)
        most = [2**32 - 1, 2**32 - 1, (1 << bits) - 1]
        assert echo.run(wide_i=most, **rest).wide_o.tolist() == [most]
    echo = sim.load("shade_echo", WIDE=70)
    refused(
        lambda: echo.run(wide_i=[0, 0, 64], **rest), "shade_echo.wide_i: the last word of a row has more than 6 bits"
    )


def test_a_pipeline_takes_whatever_is_offered() -> None:
    """Without a valid input, with gaps."""
    run = sim.load("shade_delay", WIDTH=9, DEPTH=3).run(d_i=np.arange(99), latency=3, in_gap=0.5)
    assert run.q_o.tolist() == list(range(99)) and set(run.given - run.taken) == {3} and run.clocks > 120


@pytest.mark.parametrize(
    ("module", "parameters", "told"),
    [
        ("shade_nosuch", {}, "shade_nosuch: no such module, allowed shade_delay, "),
        ("", {}, "no such module"),
        ("shade_pkg", {}, "no such module"),
        ("../rtl/fixed/shade_third", {}, "no such module"),
        ("shade_third", {"NOSUCH": 1}, "shade_third[NOSUCH=1]: "),
        ("shade_third", {"NOSUCH": 1}, "NOSUCH"),
        ("shade_third", {"WIDTH": 1}, "shade_third[WIDTH=1]: WIDTH must be in 4 .. 28"),  # its parts complain as well
        ("shade_third", {"WIDTH": 29}, "shade_third[WIDTH=29]: WIDTH must be in 4 .. 28"),
        ("shade_third", {"WIDTH": -8}, "WIDTH must be in 4 .. 28"),
        ("shade_third", {"WIDTH": 1 << 40}, "WIDTH must be in 4 .. 28"),
        ("shade_third", {"WIDTH": 8.0}, "shade_third: WIDTH=8.0, allowed integers"),
        ("shade_third", {"WIDTH": "8 --help"}, "WIDTH='8 --help', allowed integers"),
        ("shade_third", {"WIDTH": None}, "WIDTH=None, allowed integers"),
        ("shade_poly_span", {"EVALUATOR": 7}, "shade_poly_span[EVALUATOR=7]: EVALUATOR must be"),
        ("shade_mul", {"A_W": 99, "STAGES": 0}, "shade_mul[A_W=99,STAGES=0]: A_W must be in 2 .. 35"),
    ],
)
def test_modules_and_parameters(module: str, parameters: dict, told: str) -> None:
    """In one line, in the words of the module's own check."""
    refused(lambda: sim.load(module, **parameters), told)


def test_parameters_of_any_integer_type(span: sim.Model) -> None:
    """The same numbers are the same model, in any order."""
    assert sim.load("shade_poly_span", FORM=np.uint8(k.FORM_REFINED), EVALUATOR=k.EVALUATOR_HORNER) is span
    assert sim.load("shade_poly_span", EVALUATOR=bool(k.EVALUATOR_HORNER), FORM=np.int64(k.FORM_REFINED)) is span


def test_unknown_outputs(third: sim.Model) -> None:
    run = third.run(x_i=1)
    with pytest.raises(AttributeError, match="no output z_o, there are y_o"):
        _ = run.z_o
    assert not hasattr(run, "x_i")


@pytest.mark.parametrize("duplicate", [copy.copy, copy.deepcopy, lambda run: pickle.loads(pickle.dumps(run))])
def test_results_can_be_copied(third: sim.Model, duplicate: Callable) -> None:
    run = third.run(x_i=[3, 6])
    assert duplicate(run).y_o.tolist() == [1, 2]
    assert duplicate(run).clocks == run.clocks


# ---- modules that stop -------------------------------------------------------------------------------------------


@pytest.mark.timeout(HANGS, method="thread")  # a run that does not end cannot be interrupted
def test_a_consumer_that_never_takes(span: sim.Model) -> None:
    """The run ends, though the module offers a pixel all the time."""
    beats, _ = spans()
    told = r"shade_poly_span\(EVALUATOR=0, FORM=1\) stopped: \d+ of 200 inputs taken, 0 outputs given, nothing for 500"
    with pytest.raises(SimulationError, match=told):
        span.run(s_axis_span_tdata=beats, out_stall=1, patience=500)


def test_a_producer_that_never_offers(third: sim.Model) -> None:
    with pytest.raises(SimulationError, match="0 of 7 inputs taken, 0 outputs given, nothing for 500 clocks"):
        third.run(x_i=np.arange(7), in_gap=1, patience=500)


def test_a_module_that_stops_taking(toy: Callable) -> None:
    toy("shade_stuck", STUCK)
    stuck = sim.load("shade_stuck", TAKES=3)
    assert stuck.run(x_i=[1, 2, 3]).y_o.tolist() == [1, 2, 3]
    with pytest.raises(SimulationError, match="3 of 4 inputs taken, 3 outputs given, nothing for 1000 clocks"):
        stuck.run(x_i=[1, 2, 3, 4], patience=1000)
    assert stuck.run(x_i=[1, 2, 3]).y_o.tolist() == [1, 2, 3]  # every run starts from reset


def test_a_rare_consumer_loses_nothing(span: sim.Model) -> None:
    """Waits much longer than the run drains are no end of the run."""
    beats, pixels = spans(5)
    run = span.run(s_axis_span_tdata=beats, out_stall=0.995, drain=30)
    assert np.array_equal(run.m_axis_pixel_tdata, pixels)


# ---- the ports ---------------------------------------------------------------------------------------------------


def test_ports(span: sim.Model) -> None:
    """Names, directions, widths and signs are those of the header."""
    ports = {port.name: port for port in sim.load("shade_coef_b").ports}
    assert ports["clk_i"] == Port("clk_i", "input", 1, False)
    assert ports["i4_i"] == Port("i4_i", "input", k.INTENSITY_W, True)
    assert ports["b_o"] == Port("b_o", "output", k.COEF_W, True)
    widths = {port.name: port.width for port in span.ports}
    assert widths["s_axis_span_tdata"] == k.RECORD_DATA_W
    assert widths["m_axis_pixel_tdata"] == k.PIXEL_DATA_W


def test_interface() -> None:
    """Roles are told by names; streams come before plain handshakes."""

    def ports(inputs: str, outputs: str) -> list[Port]:
        return [
            Port(n, way, 1, False) for way, names in (("input", inputs), ("output", outputs)) for n in names.split()
        ]

    plain = model.interface(ports("clk_i rst_i valid_i a_i ready_i b_i", "valid_o ready_o y_o"))
    assert plain.clock and plain.reset
    assert [p.name for p in plain.into.data] == ["a_i", "b_i"]
    assert (plain.into.valid, plain.into.ready) == ("valid_i", "ready_o")
    assert [p.name for p in plain.out.data] == ["y_o"]
    assert (plain.out.valid, plain.out.ready) == ("valid_o", "ready_i")
    assert plain.status == []

    bare = model.interface(ports("x_i", "y_o"))
    assert not bare.clock and not bare.reset
    assert bare.into.valid is bare.into.ready is bare.out.valid is bare.out.ready is None

    inputs = "clk_i rst_i s_axis_q_tvalid s_axis_q_tdata m_axis_p_tready"
    outputs = "s_axis_q_tready m_axis_p_tvalid m_axis_p_tdata m_axis_p_tlast error_o"
    stream = model.interface(ports(inputs, outputs))
    assert (stream.into.valid, stream.into.ready) == ("s_axis_q_tvalid", "s_axis_q_tready")
    assert [p.name for p in stream.into.data] == ["s_axis_q_tdata"]
    assert [p.name for p in stream.out.data] == ["m_axis_p_tdata", "m_axis_p_tlast"]
    assert [p.name for p in stream.status] == ["error_o"]


PACED = """
module shade_paced (input logic clk_i, input logic [1:0] phase_i, input logic [1:0][8:0] x_i, output logic [17:0] y_o);
  logic [17:0] one_q, two_q;
  always_ff @(posedge clk_i) begin
    if (phase_i == 2'd0) one_q <= x_i;
    two_q <= one_q;
  end
  assign y_o = two_q;
endmodule
"""


def test_phase(toy: Callable) -> None:
    """A row in every third clock, in phase 0; its result in one clock, fixed latency. A packed array is one number."""
    toy("shade_paced", PACED)
    x = RNG.integers(0, 1 << 18, 50)
    run = sim.load("shade_paced").run(x_i=x, latency=2, pace=3)
    assert np.array_equal(run.y_o, x)
    assert np.array_equal(run.taken, 3 * np.arange(50))
    assert np.array_equal(run.given, run.taken + 2)


# ---- compiling ---------------------------------------------------------------------------------------------------


def test_compiled_once(fresh: Path, toy: Callable, compiled: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """A model is compiled for a module, its sources and its parameters; never again for the same."""
    source = toy("shade_adder", ADDER)
    other = toy("shade_dream", DREAM)

    def load() -> list[str]:
        """The programs that loading runs in a new process."""
        monkeypatch.setattr(model, "_loaded", {})
        compiled.clear()
        assert sim.load("shade_adder").run(a_i=1, b_i=2).sum_o.tolist() == [3]
        return compiled[:]

    assert load() == ["verilator_bin", "verilator_bin", "g++"]
    assert load() == []
    assert sim.load("shade_adder") is sim.load("shade_adder")
    other.write_text(other.read_text() + "\n")
    assert load() == []  # it has no part in the module
    source.write_text("// another comment\n" + source.read_text())
    assert load() == ["verilator_bin", "verilator_bin", "g++"]
    kept = [path.name for path in fresh.iterdir() if path.is_dir()]
    assert len(kept) == 2
    assert all(name.startswith("shade_adder-") for name in kept)


def test_what_fails_to_compile_leaves_nothing(fresh: Path, toy: Callable, monkeypatch: pytest.MonkeyPatch) -> None:
    """A module that does not elaborate, or C++ that does not compile: the cause is told and no folder stays."""
    refused(lambda: sim.load("shade_third", WIDTH=1), "WIDTH must be")
    toy("shade_wrong", "module shade_wrong (input logic x_i, output logic y_o);\n  assign y_o = z_i;\nendmodule\n")
    refused(lambda: sim.load("shade_wrong"), "shade_wrong.sv:2:")
    toy("shade_adder", ADDER)
    monkeypatch.setattr(model, "glue", lambda ports: "#error no glue\n")
    with pytest.raises(RuntimeError, match="no glue"):
        sim.load("shade_adder")
    assert [path for path in fresh.iterdir() if path.is_dir()] == []
    monkeypatch.undo()


TWO = """
import sys
from pathlib import Path
from polyshade.sim import model, verilate

runs, run = [], verilate.run
runtime = verilate.runtime()
verilate.runtime = lambda: runtime
verilate.CACHE = Path(sys.argv[1])
verilate.run = lambda *given: runs.append(given) or run(*given)
third = model.load("shade_third", WIDTH=5)
print(len(runs), third.run(x_i=range(-16, 16)).y_o.tolist())
"""


def test_two_processes_at_once(tmp_path: Path) -> None:
    """One compiles, the other waits and takes what is there."""
    sim.load("shade_third", WIDTH=18)  # Verilator's own part is compiled
    command = [sys.executable, "-c", TWO, str(tmp_path)]
    both = [subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True) for _ in range(2)]
    told = sorted(process.communicate(timeout=HANGS)[0].strip() for process in both)
    values = fixed.third(np.arange(-16, 16)).tolist()
    assert told == [f"{count} {values}" for count in (0, 3)]
    assert len([path for path in tmp_path.iterdir() if path.is_dir()]) == 1


def test_waves(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A run with waves leaves a waveform with the module's signals, two steps a clock."""
    monkeypatch.setattr(model, "BUILD", tmp_path)
    traced = sim.load("shade_third", waves=True, WIDTH=18)
    run = traced.run(x_i=[-3, 300])
    assert run.y_o.tolist() == [-1, 100]
    text = (tmp_path / "waves" / "shade_third.vcd").read_text()
    names = {line.split()[4] for line in text.splitlines() if line.strip().startswith("$var")}
    assert {"clk_i", "x_i", "y_o", "sum_q1"} <= names
    steps = [line for line in text.splitlines() if line.startswith("#")]
    assert len(steps) >= 2 * run.clocks
    assert f"b{300:018b} " in text
    assert sim.load("shade_third", waves=False, WIDTH=18) is not traced


@pytest.mark.parametrize(("value", "expected"), [(None, False), ("", False), ("0", False), ("1", True)])
def test_waves_of_the_environment(value: str | None, expected: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("WAVES", raising=False)
    if value is not None:
        monkeypatch.setenv("WAVES", value)
    assert sim.load("shade_third", WIDTH=18).waves is expected


def test_reached() -> None:
    """A model is made of the package, the module, and what it instantiates; in the order of the file list."""
    names = [path.stem for path in verilate.reached("shade_horner_step")]
    assert names[0] == "shade_pkg"
    assert names[-1] == "shade_horner_step"
    assert "shade_mul" in names  # its only multiplier
    assert not {"shade_horner_pipe", "shade_poly_span"} & set(names)
