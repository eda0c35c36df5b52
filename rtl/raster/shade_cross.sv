// SPDX-License-Identifier: Apache-2.0
// shade_cross: sums of two products, +-(p q - s t), of wide numbers in several passes.
//
//   p_i, q_i, s_i, t_i  S18.0: numbers, or parts of wider ones: x = xh 2^17 + xl, xl unsigned
//   first_i             a new sum; else shift_i: what is there moves up by 17 bits before this pass is added
//   minus_i             the sign of the whole, the same in every pass
//   sum_o               S52.0
//
// (ph 2^17 + pl) q takes two passes, the product of two wide numbers four: hh, hl (shift), lh, ll (shift).
// Two 18 x 18 multipliers. Exact. Latency LATENCY_CROSS = 4 clocks, a pass a clock.
// Example: p = 3, q = 5, s = 2, t = 4, first -> 7; then p = 1, q = 1, s = t = 0, shift -> 7 2^17 + 1.
module shade_cross (
  input  logic                                clk_i,
  input  logic                                first_i,
  input  logic                                shift_i,
  input  logic                                minus_i,
  input  logic signed [                 17:0] p_i,
  input  logic signed [                 17:0] q_i,
  input  logic signed [                 17:0] s_i,
  input  logic signed [                 17:0] t_i,
  output logic signed [shade_pkg::AREA_W:0]   sum_o
);
  localparam int SUM_W = shade_pkg::AREA_W + 1;
  localparam int LOW = 17;
  logic signed [35:0] pq_q2, st_q2;
  logic signed [36:0] difference_q3;
  logic [2:0] control_q2, control_q3;
  logic first_q3, shift_q3, minus_q3;
  shade_mul #(.A_W(18), .B_W(18)) u_pq (.clk_i, .a_i(p_i), .b_i(q_i), .p_o(pq_q2));
  shade_mul #(.A_W(18), .B_W(18)) u_st (.clk_i, .a_i(s_i), .b_i(t_i), .p_o(st_q2));
  shade_delay #(.WIDTH(3), .DEPTH(shade_pkg::LATENCY_MUL)) u_control (
    .clk_i, .d_i({first_i, shift_i, minus_i}), .q_o(control_q2)
  );
  assign {first_q3, shift_q3, minus_q3} = control_q3;

  logic signed [SUM_W-1:0] base;
  assign base = first_q3 ? '0 : shift_q3 ? {sum_o[SUM_W-LOW-1:0], {LOW{1'b0}}} : sum_o;
  always_ff @(posedge clk_i) begin
    difference_q3 <= 37'(pq_q2) - 37'(st_q2);
    control_q3    <= control_q2;
    sum_o         <= base + (SUM_W'(difference_q3) ^ {SUM_W{minus_q3}}) + SUM_W'(minus_q3);
  end
endmodule
