// SPDX-License-Identifier: Apache-2.0
// shade_rsqrt: 1 / sqrt(z) = y 2^-e for every integer z in [1, 2^36): range reduction, a table of parabolas.
//
//   z_i      U36.0                     such as a sum of three squares of S1.16 numbers (U4.32)
//   y_o, e_o U1.20 in (1/2, 1], 0..17  1 / sqrt(z) = y 2^-e; for z in U4.32: 1 / sqrt(z 2^-32) = y 2^(16-e)
//   zero_o   z = 0, y = 0, e = 0
//
//   z = m 2^(2 e)     m  mm.fffff dddddddddddddddddd ...      first seven bits: segment; next 18: d, from its middle
//   1/sqrt(m) = (c2 d + c1) d + c0
//
// c2 d is rounded to the format of c1, the result to y, to nearest, ties up; error below 1 ulp of y (measured: 0.85).
// Reciprocals come as 1 / z = rsqrt(z)^2. Two 18 x 18 multipliers, a table of 6,528 bits.
// Latency LATENCY_RSQRT = 10 clocks, one value a clock. Example: z = 2^32 -> y = 1, e = 16.
// Source: P4 and P2 need it for normalizing, P1 for Ward's root.
module shade_rsqrt (
  input  logic                          clk_i,
  input  logic [shade_pkg::RSQRT_W-1:0] z_i,
  output logic [  shade_pkg::RSQRT_F:0] y_o,
  output logic [                   4:0] e_o,
  output logic                          zero_o
);
  localparam int Z_W = shade_pkg::RSQRT_W;
  localparam int INDEX_W = shade_pkg::RSQRT_INDEX_W;
  localparam int D_W = 18;
  localparam int C0_F = shade_pkg::RSQRT_C0_F;
  localparam int C1_F = shade_pkg::RSQRT_C1_F;
  localparam int C2_F = shade_pkg::RSQRT_C2_F;
  localparam int D_F = shade_pkg::RSQRT_D_F;
  localparam int MUL = shade_pkg::LATENCY_MUL;

  // ---- m: shift z left by an even number until one of the first two bits is set: in steps of 8, then of 2 ----------
  logic [2:0] eights, eights_q1;
  logic [1:0] twos;
  logic [Z_W-1:0] m_q1, m_q2;
  logic [4:0] e_q2;
  always_comb begin
    eights = 3'd4;
    twos   = 2'd3;
    for (int i = 3; i >= 0; i--) if (z_i[Z_W-8*(i+1)+:8] != '0) eights = 3'(i);
    for (int i = 2; i >= 0; i--) if (m_q1[Z_W-2*(i+1)+:2] != '0) twos = 2'(i);
  end
  always_ff @(posedge clk_i) begin
    m_q1      <= z_i << {eights, 3'b000};
    eights_q1 <= eights;
    m_q2      <= m_q1 << {twos, 1'b0};
    // 17 - (4 eights + twos); z = 0 ends at 17 - 19, which zero_o covers
    e_q2      <= 5'd17 - {eights_q1, twos};
  end

  // ---- the parabola of the segment -----------------------------------------------------------------------------
  localparam int C2_W = shade_pkg::RSQRT_C2_W;
  localparam int ROW_W = C0_F + C1_F + C2_W;
  logic [ROW_W-1:0] row_q3;
  logic [C0_F-1:0] c0_q4, c0_q9;
  logic signed [C1_F-1:0] c1_q4, c1_q6;
  logic [C2_W-1:0] c2_q4;
  logic signed [D_W-1:0] d_q3, d_q4, d_q7;
  logic [4:0] e_q9;
  logic zero_q9;
  shade_rsqrt_rom u_rom (.clk_i, .i_i(INDEX_W'(m_q2 >> (Z_W - INDEX_W))), .row_o(row_q3));
  // two registers: a block RAM's own is slow
  always_ff @(posedge clk_i) begin
    {c0_q4, c1_q4, c2_q4} <= row_q3;
    // less half a segment: the first bit turned over is the sign
    d_q3                  <= D_W'(m_q2 >> (Z_W - INDEX_W - D_W)) ^ (D_W'(1) << (D_W - 1));
    d_q4                  <= d_q3;
  end
  shade_delay #(.WIDTH(C0_F), .DEPTH(MUL + 1 + MUL)) u_c0 (.clk_i, .d_i(c0_q4), .q_o(c0_q9));
  shade_delay #(.WIDTH(C1_F), .DEPTH(MUL)) u_c1 (.clk_i, .d_i(c1_q4), .q_o(c1_q6));
  shade_delay #(.WIDTH(D_W), .DEPTH(MUL + 1)) u_d (.clk_i, .d_i(d_q4), .q_o(d_q7));
  shade_delay #(.WIDTH(6), .DEPTH(2 + MUL + 1 + MUL)) u_e (
    .clk_i, .d_i({m_q2 == '0, e_q2}), .q_o({zero_q9, e_q9})
  );

  // c2 d + c1: the product has C2_F + D_F fraction bits, the sum C1_F; half an ulp stands below the last bit of c1
  localparam int DROP1 = C2_F + D_F - C1_F;
  localparam int P1_W = C2_W + 1 + D_W;
  localparam int S_W = C1_F + DROP1;
  logic signed [P1_W-1:0] c2d_q6;
  logic signed [S_W-1:0] sum1;
  logic signed [C1_F-1:0] s_q7;
  shade_mul #(.A_W(C2_W + 1), .B_W(D_W)) u_c2d (.clk_i, .a_i({1'b0, c2_q4}), .b_i(d_q4), .p_o(c2d_q6));
  assign sum1 = S_W'(c2d_q6) + $signed({c1_q6, 1'b1, {(DROP1 - 1) {1'b0}}});
  always_ff @(posedge clk_i) s_q7 <= C1_F'(sum1 >>> DROP1);

  // (c2 d + c1) d + c0
  localparam int INNER_F = C1_F + D_F;
  localparam int DROP2 = INNER_F - shade_pkg::RSQRT_F;
  localparam int P2_W = C1_F + D_W;
  localparam int Y_W = INNER_F + 2;
  logic signed [P2_W-1:0] sd_q9;
  logic signed [Y_W-1:0] sum2;
  shade_mul #(.A_W(C1_F), .B_W(D_W)) u_sd (.clk_i, .a_i(s_q7), .b_i(d_q7), .p_o(sd_q9));
  assign sum2 = Y_W'(sd_q9) + (Y_W'($signed({1'b0, c0_q9})) <<< (INNER_F - C0_F));  // the half ulp is in c0
  always_ff @(posedge clk_i) begin
    y_o    <= (shade_pkg::RSQRT_F + 1)'(sum2 >>> DROP2);
    e_o    <= zero_q9 ? '0 : e_q9;
    zero_o <= zero_q9;
  end
endmodule
