// SPDX-License-Identifier: Apache-2.0
// shade_horner_pipe: I(t) = ((A t + B) t + C) t + D, a new t (and, if need be, new coefficients) on every clock.
//
//   a_i, b_i, c_i  sdddddddd.ffff         COEF_W bits, S8.16
//   d_i                   sd.ffff         D_W bits, S1.16
//   t_i                     d.ffff        U1.T_F in [0, 1]
//   inside       sdddddddddd.ffffggg      HORNER_GUARD = 3 guard bits
//   y_o          sdddddddddd.ffff         COEF_W + 2 bits, S10.16, unclamped
//
// Every product is rounded to the inner format, the result to y_o, all to nearest, ties up: the error is at most
// 1/2 + 3/16 < 1 ulp. Overflow is impossible: |I| <= 3 * 2^8 + 2 for all inputs.
// Latency LATENCY_HORNER_PIPE = 9 clocks, one value a clock. Six 18 x 18 multipliers (each operand of 30 bits needs two).
// Example: A = B = C = D = 1, t = 1/2 -> I = 1.875. Source: P1, section IV, Fig. 9.
module shade_horner_pipe #(
  parameter int COEF_W = shade_pkg::COEF_W,
  parameter int D_W    = shade_pkg::INTENSITY_W,
  parameter int T_F    = shade_pkg::T_F
) (
  input  logic                                             clk_i,
  input  logic signed [                        COEF_W-1:0] a_i,
  input  logic signed [                        COEF_W-1:0] b_i,
  input  logic signed [                        COEF_W-1:0] c_i,
  input  logic signed [                           D_W-1:0] d_i,
  input  logic        [                             T_F:0] t_i,
  output logic signed [COEF_W+shade_pkg::VALUE_GROWTH-1:0] y_o
);
  if (COEF_W < 2 || COEF_W > 30 || D_W < 2 || D_W > COEF_W || T_F < 2 || T_F > 16) begin : g_check
    $error("shade_horner_pipe: COEF_W must be in 2 .. 30, D_W in 2 .. COEF_W, T_F in 2 .. 16");
  end

  localparam int GUARD = shade_pkg::HORNER_GUARD;
  localparam int WIDTH = COEF_W + shade_pkg::VALUE_GROWTH + GUARD;
  localparam int STEP = shade_pkg::LATENCY_HORNER_STEP;
  localparam int MUL = shade_pkg::LATENCY_MUL;
  localparam int WAIT_C = STEP + MUL;
  localparam int WAIT_D = STEP + STEP + MUL;

  logic [T_F:0] t_q3, t_q6;
  shade_delay #(.WIDTH(T_F + 1), .DEPTH(STEP)) u_t3 (.clk_i, .d_i(t_i), .q_o(t_q3));
  shade_delay #(.WIDTH(T_F + 1), .DEPTH(STEP)) u_t6 (.clk_i, .d_i(t_q3), .q_o(t_q6));

  logic signed [COEF_W-1:0] b_q2, c_q5;
  logic signed [D_W-1:0] d_q8;
  shade_delay #(.WIDTH(COEF_W), .DEPTH(MUL)) u_b (.clk_i, .d_i(b_i), .q_o(b_q2));
  shade_delay #(.WIDTH(COEF_W), .DEPTH(WAIT_C)) u_c (.clk_i, .d_i(c_i), .q_o(c_q5));
  shade_delay #(.WIDTH(D_W), .DEPTH(WAIT_D)) u_d (.clk_i, .d_i(d_i), .q_o(d_q8));

  logic signed [WIDTH-1:0] s_q3, s_q6, s_q9;
  shade_horner_step #(.WIDTH(WIDTH), .T_F(T_F)) u_step1 (
    .clk_i, .s_i(WIDTH'(a_i) <<< GUARD), .t_i(t_i), .c_i(WIDTH'(b_q2) <<< GUARD), .y_o(s_q3)
  );
  shade_horner_step #(.WIDTH(WIDTH), .T_F(T_F)) u_step2 (
    .clk_i, .s_i(s_q3), .t_i(t_q3), .c_i(WIDTH'(c_q5) <<< GUARD), .y_o(s_q6)
  );
  // D brings the half ulp of the final rounding along
  shade_horner_step #(.WIDTH(WIDTH), .T_F(T_F)) u_step3 (
    .clk_i, .s_i(s_q6), .t_i(t_q6), .c_i(WIDTH'($signed({d_q8, 1'b1, {(GUARD - 1){1'b0}}}))), .y_o(s_q9)
  );
  assign y_o = (WIDTH - GUARD)'(s_q9 >>> GUARD);
endmodule
