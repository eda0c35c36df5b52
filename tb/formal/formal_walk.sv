// SPDX-License-Identifier: Apache-2.0
// formal_walk: shade_walk makes as many steps as an item asks for, one in every clock in which there is a credit.
//
// The model: the steps that the item at hand still has, and the credits that are spent.
module formal_walk #(
  parameter int COUNT_W     = 3,
  parameter int CREDIT_LOG2 = 1
) (
  input logic               clk_i,
  input logic               rst_i,
  input logic               valid_i,
  input logic [COUNT_W-1:0] count_i,
  input logic               credit_i
);
  localparam int N_W = CREDIT_LOG2 + 2;
  logic ready, load, issue, first, last;
  shade_walk #(.COUNT_W(COUNT_W), .CREDIT_LOG2(CREDIT_LOG2)) u_dut (
    .clk_i, .rst_i, .valid_i, .ready_o(ready), .count_i, .credit_i, .load_o(load), .issue_o(issue), .first_o(first),
    .last_o(last)
  );

  logic started_q = 1'b0;
  logic fresh_q;
  logic [COUNT_W-1:0] left_q;
  logic [N_W-1:0] spent_q;
  always_ff @(posedge clk_i) begin
    started_q <= 1'b1;
    spent_q   <= spent_q + N_W'(issue) - N_W'(credit_i);
    if (load) begin
      left_q  <= count_i;
      fresh_q <= 1'b1;
    end else if (issue) begin
      left_q  <= left_q - COUNT_W'(1);
      fresh_q <= 1'b0;
    end
    if (rst_i) begin
      left_q  <= '0;
      spent_q <= '0;
    end
  end

  always_ff @(posedge clk_i) begin
    // The first clock is one of reset, from any state.
    if (!started_q) reset_first : assume (rst_i);
    if (started_q) begin
      // An item has at least one step.
      some_steps : assume (!valid_i || count_i != '0);
      // The consumer gives back only credits that were spent.
      credits_are_spent : assume (!credit_i || spent_q != '0);
      // A step is made in every clock in which the item has one left and a credit is there, and in no other.
      // mutant: issue_o = busy_q && some => issue_o = busy_q && some && !(first_o && last_o)
      steps : assert (issue == (left_q != '0 && spent_q < N_W'(1 << CREDIT_LOG2)));
      // An item is taken whenever none is at hand, or with the last step of the one that is.
      // mutant: ready_o = !busy_q || (issue_o && last_o) => ready_o = !busy_q
      taken : assert (load == (valid_i && (left_q == '0 || (issue && left_q == COUNT_W'(1)))));
      // mutant: load_o  = valid_i && ready_o => load_o  = valid_i && !busy_q
      ready_is_taken : assert (load == (valid_i && ready));
      // first_o and last_o frame the steps of an item.
      // mutant: last_o  <= left_q == COUNT_W'(1) => last_o  <= left_q == COUNT_W'(2)
      framed : assert (!issue || (first == fresh_q && last == (left_q == COUNT_W'(1))));
      // Never more steps under way than credits.
      // mutant: .take_i(issue_o) => .take_i(issue_o && last_o)
      credits : assert (spent_q <= N_W'(1 << CREDIT_LOG2));
    end
  end
endmodule
