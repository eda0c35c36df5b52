// SPDX-License-Identifier: Apache-2.0
// shade_walk: control of a walk: an item of n steps in, n steps out, one a clock, as long as there are credits.
//
// load_o: an item is taken in this clock; issue_o: a step is made, first_o and last_o frame the item's. A new item is
// taken together with the last step of the old one, so that steps follow each other without a bubble.
//
//   count_i   n >= 1, with the item
//   credit_i  gives a credit back, for a step 1 clock later; 2^CREDIT_LOG2 are there after reset, a step costs one
//
// No path leads from an input to ready_o, issue_o, first_o or last_o. Latency of a first step: 1 clock behind its item.
// Example: items of 2 and 1 steps in clocks 0 and 1 -> load 0, 2; issue 1 (first), 2 (last), 3 (first, last).
module shade_walk #(
  parameter int COUNT_W     = shade_pkg::COUNT_W,
  parameter int CREDIT_LOG2 = shade_pkg::FIFO_LOG2
) (
  input  logic               clk_i,
  input  logic               rst_i,
  input  logic               valid_i,
  output logic               ready_o,
  input  logic [COUNT_W-1:0] count_i,
  input  logic               credit_i,
  output logic               load_o,
  output logic               issue_o,
  output logic               first_o,
  output logic               last_o
);
  if (COUNT_W < 1 || CREDIT_LOG2 < 1) begin : g_check
    $error("shade_walk: COUNT_W and CREDIT_LOG2 must be at least 1");
  end

  logic busy_q, some, unused_soon;
  logic [COUNT_W-1:0] left_q;  // steps behind the one at hand

  assign issue_o = busy_q && some;
  assign ready_o = !busy_q || (issue_o && last_o);
  assign load_o  = valid_i && ready_o;
  shade_credit #(.LOG2(CREDIT_LOG2)) u_credit (
    .clk_i, .rst_i, .take_i(issue_o), .give_i(credit_i), .some_o(some), .soon_o(unused_soon)
  );

  always_ff @(posedge clk_i) begin
    if (load_o) begin
      first_o <= 1'b1;
      last_o  <= count_i == COUNT_W'(1);
      left_q  <= count_i - COUNT_W'(1);
    end else if (issue_o) begin
      first_o <= 1'b0;
      last_o  <= left_q == COUNT_W'(1);
      left_q  <= left_q - COUNT_W'(1);
    end

    if (load_o) busy_q <= 1'b1;
    else if (issue_o && last_o) busy_q <= 1'b0;
    if (rst_i) busy_q <= 1'b0;
  end

  shade_assert u_empty (.clk_i, .rst_i, .holds_i(!load_o || count_i != '0));
endmodule
