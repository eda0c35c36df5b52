# SPDX-License-Identifier: Apache-2.0
"""A test bench of plain Verilog with recorded vectors for every machine: it runs without this repository.

The vectors are a picture of the default head as the project's own comparison draws it: every word of it equals the
golden model. The bench sends them with gaps, takes the answer with stalls, and says PASS or FAIL. It runs on the
SystemVerilog and on the plain Verilog, in any simulator with timing.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from polyshade import sim
from polyshade.scripts.handoff.configurations import Configuration
from polyshade.sim import core, frame
from polyshade.sim.scan import scan
from polyshade.sim.scene.camera import Camera
from polyshade.sim.scene.raster import scan_convert
from polyshade.sim.verilate import Port

SIZE = 24  # of the picture


@dataclass(frozen=True)
class Vectors:
    """What a machine took and gave: register words by offset, rows of all its inputs, rows of its outputs."""

    into: list[Port]
    out: list[Port]
    valid: tuple[str, str]  # prefixes of the handshakes: s_axis_span, m_axis_pixel
    writes: dict[int, int]
    rows: list[int]
    given: list[int]


def record(configuration: Configuration) -> Vectors:
    """Draw the picture through the machine, compare it with the golden model, and keep what went in and out."""
    settings = frame.Settings(camera=Camera(SIZE), path=configuration.path if configuration.path != "scan" else "line")
    with _recording(configuration.top) as found:
        if configuration.path == "line":
            mesh = settings.load()
            spans = scan_convert(settings.camera.project(mesh), mesh.faces, SIZE)
            drawn = core.draw(core.Lines.of(spans), settings.registers, **configuration.point)
            wrong = drawn.mismatches
        elif configuration.path == "scan":
            mesh = settings.load()
            screen = settings.camera.project(mesh)
            wrong = scan(screen, mesh.faces, SIZE, scan_convert(screen, mesh.faces, SIZE)).mismatches
        else:
            wrong = frame.render(settings).report["mismatches"]
    if wrong:
        raise sim.SimulationError(f"{configuration.label}: {wrong} mismatches against the golden model")
    return found[-1]


@contextlib.contextmanager
def _recording(module: str) -> Iterator[list[Vectors]]:
    """Within the block the runs of a module are kept."""
    found: list[Vectors] = []
    plain = sim.Model.run

    def run(model: sim.Model, **options) -> sim.Run:
        done = plain(model, **options)
        if model.module == module:
            face, ports = model.interface, {port.name for port in model.ports}
            inputs = {n: v for n, v in options.items() if n.partition(".")[0] in ports}
            count, arrays = model._inputs(inputs)
            rows = _joined(face.into.data, arrays, count)
            outputs = [_whole(port, done.outputs) for port in face.out.data]
            prefixes = (face.into.valid.removesuffix("_tvalid"), face.out.valid.removesuffix("_tvalid"))
            given = _joined(face.out.data, outputs, len(done.given))
            found.append(Vectors(face.into.data, face.out.data, prefixes, dict(options.get("writes", {})), rows, given))
        return done

    sim.Model.run = run
    try:
        yield found
    finally:
        sim.Model.run = plain


def _whole(port: Port, outputs: dict[str, np.ndarray]) -> np.ndarray:
    """An output as one word a row, of a structure its fields put together."""
    if not port.fields:
        return outputs[port.name]
    parts = [[int(v) & (1 << f.width) - 1 for v in outputs[f.name]] for f in port.fields]
    places = [field.lsb for field in port.fields]
    rows = zip(*parts, strict=True)
    return np.array([sum(v << lsb for v, lsb in zip(row, places, strict=True)) for row in rows], object)


def _joined(ports: list[Port], arrays: list[np.ndarray], rows: int) -> list[int]:
    """A number for every row: the ports side by side, the first one at the bottom."""
    words, lsb = [0] * rows, 0
    for port, array in zip(ports, arrays, strict=True):
        array = np.broadcast_to(array, (rows, *array.shape[1:]))
        for i, value in enumerate(array):
            parts = value.tolist() if getattr(value, "ndim", 0) else [int(value)]
            whole = sum((part & 0xFFFFFFFF) << 32 * n for n, part in enumerate(parts)) if len(parts) > 1 else parts[0]
            words[i] |= (whole & (1 << port.width) - 1) << lsb
        lsb += port.width
    return words


def save(configuration: Configuration, vectors: Vectors, folder: Path) -> None:
    """Leave the bench and its vectors as ``<name>.v`` and ``<name>_*.hex``."""
    folder.mkdir(parents=True, exist_ok=True)
    name = configuration.name
    (folder / f"{name}_in.hex").write_text("".join(f"{row:x}\n" for row in vectors.rows))
    (folder / f"{name}_out.hex").write_text("".join(f"{row:x}\n" for row in vectors.given))
    if vectors.writes:
        text = "".join(f"{offset << 32 | word:011x}\n" for offset, word in vectors.writes.items())
        (folder / f"{name}_registers.hex").write_text(text)
    (folder / f"{name}.v").write_text(bench(configuration, vectors))


def bench(configuration: Configuration, vectors: Vectors) -> str:
    """The text of the bench."""
    name, (source, sink) = configuration.name, vectors.valid
    in_w, out_w = (sum(port.width for port in ports) for ports in (vectors.into, vectors.out))
    pins, lsb = [".clk_i(clk)", ".rst_i(rst)"], 0
    for port in vectors.into:
        pins.append(f".{port.name}(beat[{lsb + port.width - 1}:{lsb}])")
        lsb += port.width
    lsb = 0
    for port in vectors.out:
        pins.append(f".{port.name}(answer[{lsb + port.width - 1}:{lsb}])")
        lsb += port.width
    pins += [f".{source}_tvalid(in_valid)", f".{source}_tready(in_ready)"]
    pins += [f".{sink}_tvalid(out_valid)", f".{sink}_tready(out_ready)"]
    if vectors.writes:
        pins += [
            ".s_axil_awvalid(awvalid)", ".s_axil_awready(awready)", ".s_axil_awaddr(access[43:32])",
            ".s_axil_awprot(3'b000)", ".s_axil_wvalid(wvalid)", ".s_axil_wready(wready)",
            ".s_axil_wdata(access[31:0])", ".s_axil_wstrb(4'b1111)", ".s_axil_bvalid(bvalid)",
            ".s_axil_bready(1'b1)", ".s_axil_bresp(bresp)", ".s_axil_arvalid(1'b0)", ".s_axil_arready()",
            ".s_axil_araddr(12'd0)", ".s_axil_arprot(3'b000)", ".s_axil_rvalid()", ".s_axil_rready(1'b1)",
            ".s_axil_rdata()", ".s_axil_rresp()",
        ]  # fmt: skip
    joined = ",\n    ".join(pins)
    registers = REGISTERS.format(name=name, writes=len(vectors.writes)) if vectors.writes else NO_REGISTERS
    steps = REGISTER_STEPS if vectors.writes else ""
    return BENCH.format(
        name=name, label=configuration.label, top=configuration.top, in_w=in_w - 1, out_w=out_w - 1,
        rows=len(vectors.rows), given=len(vectors.given), pins=joined, registers=registers, steps=steps,
    )  # fmt: skip


REGISTERS = """\
  reg [43:0] accesses [0:{writes} - 1];  // offset, word
  initial $readmemh("smoke/{name}_registers.hex", accesses);
  reg [15:0] access_at;
  reg awvalid, wvalid, waits;
  wire awready, wready, bvalid;
  wire [1:0] bresp;
  wire [43:0] access = accesses[access_at];
  wire configured = access_at == {writes};
"""
NO_REGISTERS = "  wire configured = 1'b1;\n"
REGISTER_STEPS = """\
      if (!configured && !waits) {awvalid, wvalid, waits} <= 3'b111;
      if (awvalid && awready) awvalid <= 1'b0;
      if (wvalid && wready) wvalid <= 1'b0;
      if (bvalid) begin
        waits     <= 1'b0;
        access_at <= access_at + 1;
        if (bresp != 2'b00) begin
          $display("FAIL: write to %h refused", access[43:32]);
          $finish;
        end
      end
      if (rst) {access_at, awvalid, wvalid, waits} <= 0;
"""
BENCH = """\
// SPDX-License-Identifier: Apache-2.0
// Smoke test of {label}: recorded vectors in, answers compared; the last line is PASS or FAIL.
// Run in the bundle's folder, the names of the vectors are relative to it:
//   $ iverilog -g2005 -s smoke -o smoke.vvp smoke/{name}.v verilog/{name}.v && vvp smoke.vvp
//   $ verilator --binary --timing -Wno-fatal --top-module smoke smoke/{name}.v verilog/{name}.v && obj_dir/Vsmoke
`timescale 1ns / 1ps
module smoke;
  localparam ROWS = {rows}, GIVEN = {given}, CLOCKS = 64 * (ROWS + GIVEN) + 100000;
  reg clk, rst;
  initial begin
    clk = 1'b0;
    rst = 1'b1;
    #100 rst = 1'b0;
  end
  always #5 clk = !clk;

  reg [{in_w}:0] rows [0:ROWS - 1];
  reg [{out_w}:0] expected [0:GIVEN - 1];
  initial $readmemh("smoke/{name}_in.hex", rows);
  initial $readmemh("smoke/{name}_out.hex", expected);
{registers}
  reg [31:0] at, got, wrong, clocks, extra;
  reg in_valid, out_ready;
  reg [31:0] random;  // gaps and stalls
  wire in_ready, out_valid;
  wire [{out_w}:0] answer;
  wire [31:0] next = at + (in_valid && in_ready);
  wire [{in_w}:0] beat = rows[at == ROWS ? ROWS - 1 : at];
  always @(posedge clk) begin
    if (rst) begin
      {{at, got, wrong, clocks, extra, in_valid, out_ready}} <= 0;
      random <= 32'h2545f491;
    end else begin
      clocks    <= clocks + 1;
      random    <= {{random[30:0], random[31] ^ random[21] ^ random[1] ^ random[0]}};
      out_ready <= random[7:5] != 3'd0;
      if (!in_valid || in_ready) begin
        at       <= next;
        in_valid <= configured && next != ROWS && random[1:0] != 2'd0;
      end
      if (out_valid && out_ready) begin
        got <= got + 1;
        if (got >= GIVEN || answer !== expected[got]) begin
          wrong <= wrong + 1;
          if (wrong == 0) $display("answer %0d: expected %h, came %h", got, expected[got], answer);
        end
      end
      if (at == ROWS && got >= GIVEN) extra <= extra + 1;  // nothing may come behind the last one
      if (extra == 500 || clocks == CLOCKS) begin
        $display("%0d inputs, %0d of %0d answers, %0d wrong, %0d clocks", at, got, GIVEN, wrong, clocks);
        if (at == ROWS && got == GIVEN && wrong == 0) $display("PASS");
        else $display("FAIL");
        $finish;
      end
    end
{steps}  end

  {top} dut (
    {pins}
  );
endmodule
"""
