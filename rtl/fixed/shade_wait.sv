// SPDX-License-Identifier: Apache-2.0
// shade_wait: q_o = what d_i was DEPTH clocks ago, of values that come every FOLD clocks.
//
//   load_i   1 in the clock in which d_i holds a value; every FOLD clocks; FOLD = 1: always
//   q_o      the value, DEPTH clocks later; it may come earlier, and stays till the next one's turn
//
// FOLD = 1: a shade_ring. Else a register that takes the value, behind it a shade_hold, or a shade_ring where that has eight
// places or more. rst_i: of the ring. Latency DEPTH clocks, one value in FOLD clocks.
// Example: FOLD = 3, DEPTH = 2, d_i = 5, x, x, 6 -> q_o = x, x, 5, ?, x, 6.
module shade_wait #(
  parameter int WIDTH = 8,
  parameter int DEPTH = 4,
  parameter int FOLD  = 3
) (
  input  logic             clk_i,
  input  logic             rst_i,
  input  logic             load_i,
  input  logic [WIDTH-1:0] d_i,
  output logic [WIDTH-1:0] q_o
);
  if (WIDTH < 1 || DEPTH < 1 || FOLD < 1) begin : g_check
    $error("shade_wait: WIDTH, DEPTH and FOLD must be at least 1");
  end

  if (FOLD == 1) begin : g_ring
    shade_ring #(.WIDTH(WIDTH), .DEPTH(DEPTH)) u_ring (.clk_i, .rst_i, .d_i, .q_o);
    logic unused_load;
    assign unused_load = load_i;
  end else begin : g_taken
    logic [WIDTH-1:0] taken_q;
    always_ff @(posedge clk_i) if (load_i) taken_q <= d_i;
    if ((DEPTH - 1) / FOLD < 8) begin : g_hold
      shade_hold #(.WIDTH(WIDTH), .DEPTH(DEPTH - 1), .FOLD(FOLD)) u_hold (.clk_i, .load_i, .d_i(taken_q), .q_o);
      logic unused_reset;
      assign unused_reset = rst_i;
    end else begin : g_ring
      shade_ring #(.WIDTH(WIDTH), .DEPTH(DEPTH - 1)) u_ring (.clk_i, .rst_i, .d_i(taken_q), .q_o);
    end
  end
endmodule
