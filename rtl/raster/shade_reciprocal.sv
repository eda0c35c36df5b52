// SPDX-License-Identifier: Apache-2.0
// shade_reciprocal: 1/a = r 2^-17 2^-e for an integer a, 1 <= a < 2^51: range reduction, then a division bit by bit.
//
//   a_i  U51.0         with start_i, at most every 19 clocks
//   e_o  U6            place of the highest bit of a, LATENCY_EXPONENT = 4 clocks after start_i; holds
//   r_o  U0.17         LATENCY_RECIPROCAL = 24 clocks after start_i; holds until the next one
//
//   m = a 2^-e         U1.19, cut            r = 1/m to nearest, ties up, at most 1 - 2^-17
//
// Relative error between -2^-17 and 2^-17 + 2^-19. No multiplier: a bit of the quotient a clock.
// Example: a = 3 -> e = 1, m = 1.5, r = 0.66667 (87381).
module shade_reciprocal (
  input  logic                                clk_i,
  input  logic                                start_i,
  input  logic [     shade_pkg::AREA_W-1:0]   a_i,
  output logic [                       5:0]   e_o,
  output logic [shade_pkg::RECIPROCAL_F-1:0]  r_o
);
  localparam int A_W = shade_pkg::AREA_W;
  localparam int M_W = shade_pkg::RECIPROCAL_M_W;
  localparam int R_F = shade_pkg::RECIPROCAL_F;

  // ---- m: shifted left by 32, 16, 8 and 4, 2 and 1, as long as the highest bits are 0 -----------------------------------
  logic [A_W-1:0] a_q1;
  logic [M_W+14:0] a_q2;
  logic [M_W+2:0] a_q3;
  logic [M_W-1:0] m_q4;
  logic [5:0] shift_q;  // {32, 16, 8, 4, 2, 1}, each a clock later than what it moves
  logic [M_W+6:0] by8;
  logic [M_W:0] by2;
  logic is32, is16, is8, is4, is2, is1;
  assign is32 = a_i[A_W-1-:32] == '0;
  assign is16 = a_q1[A_W-1-:16] == '0;
  assign is8  = a_q2[M_W+14-:8] == '0;
  assign by8  = is8 ? a_q2[M_W+6:0] : a_q2[M_W+14:8];
  assign is4  = by8[M_W+6-:4] == '0;
  assign is2  = a_q3[M_W+2-:2] == '0;
  assign by2  = is2 ? a_q3[M_W:0] : a_q3[M_W+2:2];
  assign is1  = !by2[M_W];
  logic [2:0] start_q;
  logic load_q;
  always_ff @(posedge clk_i) begin
    a_q1    <= is32 ? {a_i[A_W-33:0], 32'd0} : a_i;
    a_q2    <= is16 ? a_q1[A_W-17-:M_W+15] : a_q1[A_W-1-:M_W+15];
    a_q3    <= is4 ? by8[M_W+2:0] : by8[M_W+6:4];
    {load_q, start_q} <= {start_q, start_i};
    if (start_i) shift_q[5] <= is32;
    if (start_q[0]) shift_q[4] <= is16;
    if (start_q[1]) shift_q[3:2] <= {is8, is4};
    if (start_q[2]) begin
      shift_q[1:0] <= {is2, is1};
      m_q4         <= is1 ? by2[M_W-1:0] : by2[M_W:1];
    end
  end
  assign e_o = 6'(A_W - 1) - shift_q;

  // ---- 1/m: remainders of 2^(M_W-1) / m, a bit of the quotient a clock, one more than r has ------------------------------
  logic [M_W-1:0] rest_q;
  logic [M_W:0] twice;
  logic [M_W+1:0] less;  // with a borrow
  logic [R_F:0] quotient_q, rounded;
  logic [4:0] left_q;
  assign twice   = {rest_q, 1'b0};
  assign less    = {1'b0, twice} - {2'b00, m_q4};
  assign rounded = {1'b0, quotient_q[R_F:1]} + (R_F + 1)'(quotient_q[0]);
  always_ff @(posedge clk_i) begin
    if (load_q) rest_q <= M_W'(1) << (M_W - 1);
    else rest_q <= less[M_W+1] ? twice[M_W-1:0] : less[M_W-1:0];
    quotient_q <= {quotient_q[R_F-1:0], !less[M_W+1]};
    left_q     <= load_q ? 5'(R_F + 2) : left_q - 5'(left_q != 5'd0);
    if (left_q == 5'd1) r_o <= rounded[R_F] ? '1 : rounded[R_F-1:0];
  end
  logic unused_less;
  assign unused_less = less[M_W];
endmodule
