// SPDX-License-Identifier: Apache-2.0
// shade_delay: q_o = d_i of DEPTH clocks ago, in registers.
//
// Aligns data that need no arithmetic with the results of a pipeline beside them. Not reset. DEPTH = 0 is a wire. For many
// clocks a shade_ring is smaller. Latency DEPTH clocks, one value a clock. Example: DEPTH = 2, d_i = 5, 6, 7, 8 -> q_o = x, x, 5, 6.
module shade_delay #(
  parameter int WIDTH = 8,
  parameter int DEPTH = 2
) (
  input  logic             clk_i,
  input  logic [WIDTH-1:0] d_i,
  output logic [WIDTH-1:0] q_o
);
  if (WIDTH < 1 || DEPTH < 0) begin : g_check
    $error("shade_delay: WIDTH must be at least 1 and DEPTH at least 0");
  end

  if (DEPTH == 0) begin : g_wire
    assign q_o = d_i;
    logic unused_clk;
    assign unused_clk = clk_i;
  end else begin : g_shift
    localparam int BITS = WIDTH * DEPTH;
    logic [BITS-1:0] line_q;
    always_ff @(posedge clk_i) line_q <= BITS'({line_q, d_i});
    assign q_o = WIDTH'(line_q >> (BITS - WIDTH));
  end
endmodule
