// SPDX-License-Identifier: Apache-2.0
// shade_hold: q_o = what d_i was DEPTH clocks ago, for a register d_i that is loaded every FOLD clocks.
//
//   d_i      a register with the enable load_i, which comes every FOLD clocks
//   q_o      v + DEPTH clocks after the start, what d_i became v clocks after the start, and some clocks before and after:
//            DEPTH / FOLD loads ago
//
// A place for every FOLD clocks of the delay, where a shade_delay takes one a clock. Not reset. Long ones are a shade_delay,
// which is smaller then, and exact. Latency DEPTH clocks, one value in FOLD clocks.
// Example: FOLD = 3, DEPTH = 4, d_i = 5, 5, 5, 6, 6, 6, 7 -> q_o = x, x, x, 5, 5, 5, 6.
module shade_hold #(
  parameter int WIDTH = 8,
  parameter int DEPTH = 4,
  parameter int FOLD  = 3
) (
  input  logic             clk_i,
  input  logic             load_i,
  input  logic [WIDTH-1:0] d_i,
  output logic [WIDTH-1:0] q_o
);
  if (WIDTH < 1 || DEPTH < 0 || FOLD < 1) begin : g_check
    $error("shade_hold: WIDTH and FOLD must be at least 1 and DEPTH at least 0");
  end

  localparam int PLACES = DEPTH / FOLD;
  if (PLACES == 0) begin : g_wire
    assign q_o = d_i;
    logic unused;
    assign unused = clk_i || load_i;
  end else if (PLACES < 8) begin : g_shift
    localparam int BITS = WIDTH * PLACES;
    logic [BITS-1:0] line_q;
    always_ff @(posedge clk_i) if (load_i) line_q <= BITS'({line_q, d_i});
    assign q_o = WIDTH'(line_q >> (BITS - WIDTH));
  end else begin : g_delay
    shade_delay #(.WIDTH(WIDTH), .DEPTH(DEPTH)) u_delay (.clk_i, .d_i, .q_o);
    logic unused;
    assign unused = load_i;
  end
endmodule
