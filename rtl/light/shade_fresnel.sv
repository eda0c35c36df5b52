// SPDX-License-Identifier: Apache-2.0
// shade_fresnel: F = F0 + (1 - F0) (1 - c)^5, Schlick's form of Fresnel's factor.
//
//   c_i, f0_i     d.ffff        U1.16 in [0, 1]; what is above 1 counts as 1. c = V.H, F0 = F at c = 1
//   u = 1 - c     d.ffff
//   u^2, u^4, u^5  .ffff ff     U0.18, to nearest, ties up; u^2 at most 1 - 2^-18
//   f_o           d.ffff        U1.16 in [F0, 1], to nearest, ties up
//
// Error below 1 ulp (four roundings: 2/8 + 1/8 + 1/8 + 1/2); exact for c = 0 and c = 1. The powers have 18 bits without
// a sign, one more than a signed multiplier takes: p q = p (q - 1/2) + p/2.
// Four 18 x 18 multipliers. Latency LATENCY_FRESNEL = 13 clocks, one value a clock. Source: P1, F of Cook-Torrance.
// Example: F0 = 0.04, c = 1/2 -> F = 0.04 + 0.96 / 32 = 0.07.
module shade_fresnel (
  input  logic                            clk_i,
  input  logic [shade_pkg::INTENSITY_F:0] c_i,
  input  logic [shade_pkg::INTENSITY_F:0] f0_i,
  output logic [shade_pkg::INTENSITY_F:0] f_o
);
  localparam int F = shade_pkg::INTENSITY_F;
  localparam int POWER_F = shade_pkg::FRESNEL_F;
  localparam int MUL = shade_pkg::LATENCY_MUL;
  localparam logic [F:0] ONE = (F + 1)'(1) << F;

  logic [F:0] u_q1, u_q7, u_q9, f0_q1, f0_q7, f0_q9;
  always_ff @(posedge clk_i) begin
    u_q1  <= c_i[F] ? '0 : ONE - c_i;
    f0_q1 <= f0_i[F] ? ONE : f0_i;
  end
  shade_delay #(.WIDTH(2 * F + 2), .DEPTH(2 * MUL + 2)) u_early (.clk_i, .d_i({u_q1, f0_q1}), .q_o({u_q7, f0_q7}));
  shade_delay #(.WIDTH(2 * F + 2), .DEPTH(MUL)) u_late (.clk_i, .d_i({u_q7, f0_q7}), .q_o({u_q9, f0_q9}));

  // u^2
  localparam int DROP2 = 2 * F - POWER_F;
  logic [2*F+2:0] uu_q3;
  logic [POWER_F:0] uu;  // rounded
  logic [POWER_F-1:0] uu_q4;
  shade_square #(.WIDTH(F + 2)) u_uu (.clk_i, .x_i($signed({1'b0, u_q1})), .y_o(uu_q3));
  assign uu = (POWER_F + 1)'(uu_q3 >> DROP2) + (POWER_F + 1)'(uu_q3[DROP2-1]);
  always_ff @(posedge clk_i) uu_q4 <= uu[POWER_F-1:0] | {POWER_F{uu[POWER_F]}};

  // u^4 = (u^2 - 1/2)^2 + u^2 - 1/4
  logic [2*POWER_F-2:0] square_q6;
  logic signed [POWER_F:0] uu_q5, uu_q6;  // u^2 - 1/4
  logic signed [2*POWER_F:0] u4;
  logic [POWER_F-1:0] u4_q7;
  shade_square #(.WIDTH(POWER_F)) u_u4 (.clk_i, .x_i({~uu_q4[POWER_F-1], uu_q4[POWER_F-2:0]}), .y_o(square_q6));
  assign u4 = {uu_q6, 1'b1, {(POWER_F - 1) {1'b0}}} + (2 * POWER_F + 1)'({1'b0, square_q6});
  always_ff @(posedge clk_i) begin
    uu_q5 <= {1'b0, uu_q4} - ((POWER_F + 1)'(1) << (POWER_F - 2));
    uu_q6 <= uu_q5;
    u4_q7 <= POWER_F'(u4 >>> POWER_F);
  end

  // u^5 = u (u^4 - 1/2) + u/2
  localparam int P_W = F + 2 + POWER_F;
  logic signed [P_W-1:0] product_q9, u5;
  logic [POWER_F-1:0] u5_q10;
  shade_mul #(.A_W(F + 2), .B_W(POWER_F)) u_u5 (
    .clk_i, .a_i($signed({1'b0, u_q7})), .b_i({~u4_q7[POWER_F-1], u4_q7[POWER_F-2:0]}), .p_o(product_q9)
  );
  assign u5 = product_q9 + $signed({2'b00, u_q9, 1'b0, 1'b1, {(F - 1) {1'b0}}});
  always_ff @(posedge clk_i) u5_q10 <= POWER_F'(u5 >>> F);

  // F = (1 - F0) (u^5 - 1/2) + (1 + F0)/2; half an ulp makes it (1 + ulp + F0)/2
  logic [F:0] rest_q10, f0_q10;
  logic [F+1:0] half_q11, half_q12;
  logic signed [P_W-1:0] product_q12, sum;
  shade_mul #(.A_W(F + 2), .B_W(POWER_F)) u_blend (
    .clk_i, .a_i($signed({1'b0, rest_q10})), .b_i({~u5_q10[POWER_F-1], u5_q10[POWER_F-2:0]}), .p_o(product_q12)
  );
  assign sum = product_q12 + $signed({1'b0, half_q12, {(POWER_F - 1) {1'b0}}});
  always_ff @(posedge clk_i) begin
    rest_q10 <= ONE - f0_q9;
    f0_q10   <= f0_q9;
    half_q11 <= {1'b0, f0_q10} + {1'b0, ONE | (F + 1)'(1)};
    half_q12 <= half_q11;
    f_o      <= (F + 1)'(sum >>> POWER_F);
  end

endmodule
