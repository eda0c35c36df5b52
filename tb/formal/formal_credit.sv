// SPDX-License-Identifier: Apache-2.0
// formal_credit: shade_credit knows in every clock whether a place is free, and in every clock whether one will be.
module formal_credit #(
  parameter int LOG2 = 2
) (
  input logic clk_i,
  input logic rst_i,
  input logic take_i,
  input logic give_i
);
  localparam int N_W = LOG2 + 1;
  localparam logic [N_W-1:0] ALL = N_W'(1 << LOG2);
  logic some, soon;
  shade_credit #(.LOG2(LOG2)) u_dut (.clk_i, .rst_i, .take_i, .give_i, .some_o(some), .soon_o(soon));

  logic started_q = 1'b0;
  logic soon_q;
  logic [N_W-1:0] spent_q;
  always_ff @(posedge clk_i) begin
    started_q <= 1'b1;
    spent_q   <= rst_i ? '0 : spent_q + N_W'(take_i) - N_W'(give_i);
    soon_q    <= rst_i || soon;
  end

  always_ff @(posedge clk_i) begin
    // The first clock is one of reset, from any state.
    if (!started_q) reset_first : assume (rst_i);
    if (started_q) begin
      // A place is taken only if there is one.
      takes_what_there_is : assume (!take_i || some);
      // Only what was taken is given back.
      gives_what_was_taken : assume (!give_i || spent_q != '0);
      // There is a credit if and only if not all are spent.
      // mutant: credit_q + W'(give_i) - W'(take_i) => credit_q + W'(give_i && !take_i) - W'(take_i)
      some_left : assert (some == (spent_q < ALL));
      // What is told of the next clock is true in it.
      // mutant: some_o   <= rst_i || soon_o => some_o   <= rst_i || credit_q != '0
      soon_is_some : assert (some == soon_q);
      // Never more than there are.
      // mutant: credit_q <= rst_i ? ALL : credit_d => credit_q <= rst_i ? ALL + 1'b1 : credit_d
      bounded : assert (spent_q <= ALL);
    end
  end
endmodule
