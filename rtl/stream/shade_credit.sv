// SPDX-License-Identifier: Apache-2.0
// shade_credit: counts the places that are free in a FIFO behind a pipeline: credit = 2^LOG2 - taken + given back.
//
//   take_i   a place is taken in this clock: only where there was one
//   give_i   a place becomes free; the credit can be taken in the next clock
//   some_o   there is one in this clock, from a register
//   soon_o   there is one in the next clock; follows take_i and give_i
//
// 2^LOG2 credits are there after reset. Latency 1 clock. Simulation stops at a take without a credit, and at one given too many.
// Example, LOG2 = 1: two takes, and some_o = 0 until the clock behind a give.
module shade_credit #(
  parameter int LOG2 = shade_pkg::FIFO_LOG2
) (
  input  logic clk_i,
  input  logic rst_i,
  input  logic take_i,
  input  logic give_i,
  output logic some_o,
  output logic soon_o
);
  if (LOG2 < 1) begin : g_check
    $error("shade_credit: LOG2 must be at least 1");
  end

  localparam int W = LOG2 + 1;
  localparam logic [W-1:0] ALL = W'(1 << LOG2);
  logic [W-1:0] credit_q, credit_d;
  assign credit_d = credit_q + W'(give_i) - W'(take_i);
  assign soon_o   = credit_d != '0;
  always_ff @(posedge clk_i) begin
    credit_q <= rst_i ? ALL : credit_d;
    some_o   <= rst_i || soon_o;
  end

  shade_assert u_underflow (.clk_i, .rst_i, .holds_i(!take_i || credit_q != '0));
  shade_assert u_overflow (.clk_i, .rst_i, .holds_i(!give_i || take_i || credit_q != ALL));
endmodule
