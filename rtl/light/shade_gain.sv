// SPDX-License-Identifier: Apache-2.0
// shade_gain: s = lobe num fresnel (1 + w) gain 2^(e + gain_exp): the specular light of every model, saturated.
//
//   lobe_i, num_i, fresnel_i    d.ffff                 U1.16 in [0, 1]
//   product                     d.ffff ffff            U1.32, what is below is cut: far below the lobe's own ulp
//   gain (1 + w)                d.ffff                 U1.16, rounded: 2^-16 (relative); exact for w = 0
//   s                          dd.ffff ffff ffff       U2.48, shifted right by 31 - e - gain_exp, within 0 .. 63
//   s_o                         d.ffff                 S1.16 in [0, 2 - 2^-16], to nearest, ties up, saturated
//
// Error at most 3.5 ulp; where e + gain_exp is above 16, 3.5 times 2^(e + gain_exp - 32), of what is cut of the product.
// Sums of exponents beyond 31 count as 31: what is not below 2^-47 saturates there. Six 18 x 18 multipliers; with
// constant inputs (fresnel = 1, w = 0) fewer. gain_i and gain_exp_i must not change while values are inside.
// Latency LATENCY_GAIN = 12 clocks, one value a clock. Source: P1 and P3, the models' scales.
// Example: lobe = 1, num = 1/2, fresnel = 1, w = 0, e = 0, gain = 1, gain_exp = 1 -> s = 1.
module shade_gain (
  input  logic                                      clk_i,
  input  logic                                      rst_i,
  input  logic                                      valid_i,
  input  logic        [        shade_pkg::GAIN_F:0] gain_i,      // U1.16 in [1, 2), or 0
  input  logic signed [  shade_pkg::GAIN_EXP_W-1:0] gain_exp_i,
  input  logic        [   shade_pkg::INTENSITY_F:0] lobe_i,
  input  logic        [   shade_pkg::INTENSITY_F:0] num_i,
  input  logic        [   shade_pkg::INTENSITY_F:0] fresnel_i,
  input  logic signed [    shade_pkg::FACTOR_F-1:0] w_i,
  input  logic signed [shade_pkg::FACTOR_EXP_W-1:0] e_i,
  output logic                                      valid_o,
  output logic signed [ shade_pkg::INTENSITY_W-1:0] s_o,
  output logic                                      saturated_o
);
  localparam int F = shade_pkg::INTENSITY_F;
  localparam int A_W = F + 2;  // U1.16 as a signed operand
  localparam int B_W = 2 * F + 2;  // U1.32
  localparam int W_F = shade_pkg::FACTOR_F;
  localparam int MUL = shade_pkg::LATENCY_MUL_IN;
  localparam int V_W = 3 * F + 2;  // U2.48

  // ---- the products ----------------------------------------------------------------------------------------------
  logic [2*A_W-1:0] shape_q3;
  logic [A_W+B_W-1:0] product_q6, v_q9;
  logic signed [A_W+W_F-1:0] share_q3;
  logic [F:0] fresnel_q3, factor_q4, factor_q6;
  logic signed [A_W+W_F-1:0] sum;
  shade_mul #(.A_W(A_W), .B_W(A_W), .STAGES(MUL)) u_shape (
    .clk_i, .a_i({1'b0, lobe_i}), .b_i({1'b0, num_i}), .p_o(shape_q3)
  );
  shade_delay #(.WIDTH(F + 1), .DEPTH(MUL)) u_fresnel (.clk_i, .d_i(fresnel_i), .q_o(fresnel_q3));
  shade_mul #(.A_W(B_W), .B_W(A_W), .STAGES(MUL)) u_product (
    .clk_i, .a_i(shape_q3[B_W-1:0]), .b_i({1'b0, fresnel_q3}), .p_o(product_q6)
  );
  shade_mul #(.A_W(A_W), .B_W(W_F), .STAGES(MUL)) u_share (.clk_i, .a_i({1'b0, gain_i}), .b_i(w_i), .p_o(share_q3));
  assign sum = share_q3 + $signed({1'b0, gain_i, 1'b1, {(W_F - 1) {1'b0}}});
  always_ff @(posedge clk_i) factor_q4 <= sum[W_F+:F+1];
  shade_delay #(.WIDTH(F + 1), .DEPTH(2)) u_factor (.clk_i, .d_i(factor_q4), .q_o(factor_q6));
  shade_mul #(.A_W(B_W), .B_W(A_W), .STAGES(MUL)) u_v (
    .clk_i, .a_i(product_q6[F+:B_W]), .b_i({1'b0, factor_q6}), .p_o(v_q9)
  );

  // ---- the exponents: how far to the right, with one bit left for the rounding -----------------------------------
  localparam int E_W = shade_pkg::FACTOR_EXP_W + 1;
  localparam int SHIFT_W = 6;
  logic signed [E_W-1:0] e_q1, right;
  logic [SHIFT_W-1:0] shift_q2, shift_q9;
  logic [3:0] shift_q10;
  assign right = E_W'(31) - e_q1;
  always_ff @(posedge clk_i) begin
    e_q1      <= E_W'(e_i) + E_W'(gain_exp_i);
    shift_q2  <= right[E_W-1] ? '0 : right[SHIFT_W-1:0] | {SHIFT_W{right[SHIFT_W]}};
    shift_q10 <= shift_q9[3:0];
  end
  shade_delay #(.WIDTH(SHIFT_W), .DEPTH(3 * MUL - 2)) u_shift (.clk_i, .d_i(shift_q2), .q_o(shift_q9));

  // ---- S1.16 -----------------------------------------------------------------------------------------------------
  logic [V_W-1:0] v_q10, v_q11;
  logic [F+1:0] rounded;
  logic above;
  assign rounded = {1'b0, v_q11[F+1:1]} + (F + 2)'({1'b0, v_q11[0]});
  assign above   = |v_q11[V_W-1:F+2] || rounded[F+1];
  always_ff @(posedge clk_i) begin
    v_q10       <= v_q9[V_W-1:0] >> {shift_q9[SHIFT_W-1:4], 4'd0};
    v_q11        <= v_q10 >> shift_q10;
    s_o         <= {1'b0, above ? {(F + 1) {1'b1}} : rounded[F:0]};
    saturated_o <= above;
  end

  shade_valid #(.DEPTH(shade_pkg::LATENCY_GAIN)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);
  logic unused;
  assign unused = &{1'b0, shape_q3, product_q6, v_q9, sum};
endmodule
