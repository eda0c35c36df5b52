# SPDX-License-Identifier: Apache-2.0
"""A small core's netlist in four states by Icarus Verilog: after a reset nothing unknown reaches an output.

Verilator knows 0 and 1 alone, and starts registers at random. Icarus starts them unknown, and unknown bits spread: a
register that the design relies on without having set it shows as x at an output. Settings are those that reset leaves;
spans go in with pauses, pixels come out with pauses, and every bit of every pixel is compared with the golden model.
Control outputs must be known in every clock after the reset, data in those in which they are valid.
"""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
from polyshade.golden import contract as k
from polyshade.golden import core as golden
from polyshade.golden import registers
from polyshade.scripts.flow import soak
from polyshade.sim.errors import UserError
from polyshade.sim.sources import Point

SPANS = 40

BENCH = """\
`timescale 1ns/1ps
module bench;
  reg clk = 0, rst = 1;
  reg [{width}-1:0] spans [0:{last}];
  integer sent = 0, clocks = 0, unknown = 0;
  reg offer = 0, ready = 0;
  wire taken, valid, last, awready, wready, bvalid, arready, rvalid, idle, irq;
  wire [31:0] data;
  wire [{tag}-1:0] user;
  wire [31:0] rdata;
  wire [1:0] bresp, rresp;
  shade_core dut (
    .clk_i(clk), .rst_i(rst), .s_axis_span_tvalid(offer), .s_axis_span_tready(taken),
    .s_axis_span_tdata(offer ? spans[sent] : {{{width}{{1'bx}}}}), .s_axis_span_tkeep({{{keep}{{1'b1}}}}),
    .s_axis_span_tlast(1'b1), .m_axis_pixel_tvalid(valid), .m_axis_pixel_tready(ready), .m_axis_pixel_tdata(data),
    .m_axis_pixel_tuser(user), .m_axis_pixel_tlast(last), .s_axil_awvalid(1'b0), .s_axil_awready(awready),
    .s_axil_awaddr(12'bx), .s_axil_awprot(3'bx), .s_axil_wvalid(1'b0), .s_axil_wready(wready), .s_axil_wdata(32'bx),
    .s_axil_wstrb(4'bx), .s_axil_bvalid(bvalid), .s_axil_bready(1'b1), .s_axil_bresp(bresp), .s_axil_arvalid(1'b0),
    .s_axil_arready(arready), .s_axil_araddr(12'bx), .s_axil_arprot(3'bx), .s_axil_rvalid(rvalid),
    .s_axil_rready(1'b1), .s_axil_rdata(rdata), .s_axil_rresp(rresp), .idle_o(idle), .irq_o(irq)
  );
  initial begin
    $readmemh("spans.hex", spans);
    repeat (4) begin #5 clk = 1; #5 clk = 0; end
    rst = 0;
    while (clocks < {clocks}) begin
      offer = offer || (sent <= {last} && $random % 4 != 0);
      ready = $random % 4 != 0;
      #4;
      if (^{{taken, valid, awready, wready, bvalid, arready, rvalid, idle, irq}} === 1'bx) unknown = unknown + 1;
      if (valid === 1'b1 && ready) $display("pixel %h %h %b", data, user, last);
      #1 clk = 1;
      if (offer && taken === 1'b1) begin #1 offer = 0; sent = sent + 1; #4; end else #5;
      clk = 0;
      clocks = clocks + 1;
    end
    $display("unknown %0d sent %0d", unknown, sent);
    $finish;
  end
endmodule
"""


def installed() -> None:
    """Raise UserError where Icarus is missing."""
    if not shutil.which("iverilog"):
        raise UserError("iverilog: missing, install with: apt-get install -y iverilog")


def check(netlist: Path, folder: Path, point: Point, seed: int = 1) -> tuple[int, int, str]:
    """Pixels that were compared, how many differ or are unknown, and the first of these."""
    installed()
    folder.mkdir(parents=True, exist_ok=True)
    lines = soak.lines(np.random.default_rng(seed), SPANS)
    lines.count[:] = np.minimum(lines.count, 40)
    words = ["".join(f"{int(word):08x}" for word in beat[::-1]) for beat in lines.beats]
    (folder / "spans.hex").write_text("\n".join(words) + "\n")
    clocks = 600 + 4 * int(lines.count.sum()) + 20 * SPANS
    sizes = {"width": k.SPAN_DATA_W, "keep": k.SPAN_DATA_W // 8, "tag": k.TAG_W, "last": SPANS - 1, "clocks": clocks}
    (folder / "bench.v").write_text(BENCH.format(**sizes))
    made = subprocess.run(["iverilog", "-g2012", "-o", "bench.vvp", "bench.v", netlist.resolve()], cwd=folder,
                          capture_output=True, text=True)  # fmt: skip
    if made.returncode:
        raise UserError(f"iverilog: {(made.stderr or made.stdout).strip().splitlines()[0]}")
    log = subprocess.run(["vvp", "-n", "bench.vvp"], cwd=folder, capture_output=True, text=True).stdout
    (folder / "vvp.log").write_text(log)
    actual = [tuple(line.split()[1:]) for line in log.splitlines() if line.startswith("pixel ")]
    built = {name.lower(): value for name, value in point.items() if name not in ("LANES", "FOLD")}
    wanted = golden.lane(
        lines.n, lines.g, lines.count, registers.after_reset(), flat=lines.flat, cosine=lines.cosine, **built
    )
    ends = np.r_[wanted.span[1:] != wanted.span[:-1], True]
    data = wanted.pixels[:, 0] | wanted.pixels[:, 1] << k.PIXEL_W
    tags, digits = lines.tag[wanted.span], -(-k.TAG_W // 4)
    expected = [(f"{d:08x}", f"{t:0{digits}x}", f"{e:d}") for d, t, e in zip(data, tags, ends, strict=True)]
    wrong = [
        f"pixel {i}: expected {e} actual {a}" for i, (e, a) in enumerate(zip(expected, actual, strict=False)) if e != a
    ]
    if len(actual) != len(expected):
        wrong.append(f"{len(actual)} pixels, expected {len(expected)}")
    told = log.strip().splitlines()[-1] if log.strip() else "nothing"
    if not told.startswith("unknown 0 "):
        wrong.append(f"clocks with an unknown control output: {told}")
    return len(expected), len(wrong), (wrong or [""])[0]
