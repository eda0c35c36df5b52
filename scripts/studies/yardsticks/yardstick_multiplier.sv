// SPDX-License-Identifier: Apache-2.0
// yardstick_multiplier: p = a b, 18 x 18 bits signed, operands and product registered: the fastest that the flow makes
// of a multiplication. The clock rate of an evaluator is measured against it.
module yardstick_multiplier (
  input  logic               clk_i,
  input  logic signed [17:0] a_i,
  input  logic signed [17:0] b_i,
  output logic signed [35:0] p_o
);
  logic signed [17:0] a_q, b_q;
  always_ff @(posedge clk_i) begin
    a_q <= a_i;
    b_q <= b_i;
    p_o <= a_q * b_q;
  end
endmodule
