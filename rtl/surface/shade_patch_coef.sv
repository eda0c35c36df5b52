// SPDX-License-Identifier: Apache-2.0
// shade_patch_coef: from the light at six nodes, one after the other, to what a box's lines start from, in one channel.
//
//   light_i   S1.16, node 0 .. 5 (B, A, G, F, C, E of golden.patch) in node_i, with valid_i
//   load_i    a clock after the last node; what follows stays until the next box's node 5:
//   b_o       s - 8 q             s = (A + B - F - G) / 4, t = (A + F - B - G) / 4, q = (A - B - F + G) / 16,
//   q_o                           p = (4 (E - C) - 4 s) / 16, r = (A + B - 2 E) / 8, floor
//   p_o, r_o
//   u_o       t - 16 r            the growth of the lines
//   a_o       4 C - 8 t + 64 r    and half an ulp of a pixel
//
// Units of 2^-18; a_o, b_o, u_o modulo 2^PATCH_VALUE_W, widths for nodes in [-2, 2). Shifts and adders alone: an adder for each.
// Latency: q_o 1 clock behind the last node, b_o, p_o, r_o 2, a_o, u_o 3. A box in 6 clocks. Example: all nodes 1 -> a = 4, others 0.
module shade_patch_coef (
  input  logic                                       clk_i,
  input  logic                                       valid_i,
  input  logic        [                         2:0] node_i,
  input  logic signed [  shade_pkg::INTENSITY_W-1:0] light_i,
  input  logic                                       load_i,
  output logic signed [shade_pkg::PATCH_VALUE_W-1:0] a_o,
  output logic signed [shade_pkg::PATCH_VALUE_W-1:0] b_o,
  output logic signed [shade_pkg::PATCH_VALUE_W-1:0] u_o,
  output logic signed [  shade_pkg::INTENSITY_W-1:0] p_o,
  output logic signed [  shade_pkg::INTENSITY_W-3:0] q_o,
  output logic signed [  shade_pkg::INTENSITY_W-2:0] r_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int VALUE_W = shade_pkg::PATCH_VALUE_W;
  localparam int F = shade_pkg::PATCH_VALUE_F;
  localparam int TWICE_W = W + 1;
  localparam int SUM_W = W + 2;
  localparam int P_W = W + 4;

  // nodes in pairs: sum and difference
  logic signed [W-1:0] before_q;
  logic signed [TWICE_W-1:0] both_q, less_q, both_ab_q, less_ab_q;
  always_ff @(posedge clk_i) begin
    if (valid_i) before_q <= light_i;
    if (valid_i && node_i[0]) begin
      both_q <= TWICE_W'(before_q) + TWICE_W'(light_i);
      less_q <= TWICE_W'(light_i) - TWICE_W'(before_q);
    end
    if (valid_i && node_i == 3'd3) {both_ab_q, less_ab_q} <= {both_q, less_q};
  end

  // what G and F are less or more than B and A, with the last node, E; then less_q = E - C
  logic signed [SUM_W-1:0] s4, t4, q16, r8, s4_q;
  logic signed [SUM_W-3:0] t_q;
  logic signed [VALUE_W-1:0] a_q;
  logic signed [P_W-1:0] p16;
  logic load_q;
  assign s4  = SUM_W'(both_ab_q) - SUM_W'(both_q);
  assign t4  = SUM_W'(less_ab_q) + SUM_W'(less_q);
  assign q16 = SUM_W'(less_ab_q) - SUM_W'(less_q);
  assign p16 = (P_W'(less_q) <<< 2) - P_W'(s4_q);
  assign r8  = SUM_W'(both_ab_q) - (SUM_W'(before_q) <<< 1);
  always_ff @(posedge clk_i) begin
    if (valid_i && node_i == 3'd5) begin
      s4_q <= s4;
      t_q  <= t4[SUM_W-1:2];
      q_o  <= q16[SUM_W-1:4];
      a_q  <= (VALUE_W'(before_q) <<< F) - (VALUE_W'(t4 >>> 2) <<< 3);
    end
    if (load_i) begin
      b_o <= VALUE_W'(s4_q >>> 2) - (VALUE_W'(q_o) <<< 3);
      p_o <= p16[P_W-1:4];
      r_o <= r8[SUM_W-1:3];
    end
    load_q <= load_i;
    if (load_q) begin
      u_o <= VALUE_W'(t_q) - (VALUE_W'(r_o) <<< 4);
      a_o <= a_q + (VALUE_W'(r_o) <<< 6) + (VALUE_W'(1) <<< (F - 1));
    end
  end
  logic unused_bits;
  assign unused_bits = &{1'b0, p16[3:0], q16[3:0], r8[2:0]};
endmodule
