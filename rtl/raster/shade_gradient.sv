// SPDX-License-Identifier: Apache-2.0
// shade_gradient: increments of a component per column and line, 256 sum / A, of exact sums and the reciprocal of A.
//
//   take_i, sum_i  S51.0  v1 dy2 - v2 dy1, then with line_i v2 dx1 - v1 dx2, the sign of A taken out
//   down_i, r_i  1/A = r 2^-17 2^-e; down = e, of a depth e + 7, with sum_i, r_i 4 clocks later, for two clocks
//   made_o, pair_o  column, line: S10.29 of a normal's component modulo 2^11, S9.30 of a depth modulo 2^10; steep: one of
//               them is not in S2.29, S1.30
//
//   aligned = sum 2^(23-down), cut, modulo 2^59     19 bits more than the result
//   result  = aligned r / 2^19, to nearest, ties up, modulo 2^40: error at most 3/4 ulp beside that of r
//
// A triangle's edge may be any steepness: at a pixel's centre, up to 8 fraction bits from vertex 0, what is lost by
// the modulus is a multiple of 8 (4 of a depth), and the value lies between those of the vertices.
//
// aligned takes two turns of one 33 x 18 multiplier (two blocks): its lower 32 bits, then the others.
// Latency LATENCY_GRADIENT = 9 clocks from the second sum, a sum every two clocks or later.
// Example: sum = 2^20, e = 24, r = 1 - 2^-17 -> 2^-12 - 2^-29.
// Source: P4, the constant increment of an interpolated normal.
module shade_gradient (
  input  logic                              clk_i,
  input  logic                              rst_i,
  input  logic                              take_i,
  input  logic                              line_i,
  input  logic signed [shade_pkg::AREA_W:0] sum_i,
  input  logic [                     5:0]   down_i,
  input  logic [shade_pkg::RECIPROCAL_F-1:0] r_i,
  output logic                              made_o,
  output shade_pkg::pair_t                  pair_o
);
  localparam int SUM_W = shade_pkg::AREA_W + 1;
  localparam int G_W = shade_pkg::GROWTH_W;
  localparam int UP = 23;  // moved up as far as e = 0 demands; e moves it down
  localparam int LOW = 32;  // bits of the first turn
  localparam int IN_W = LOW + 15;  // what comes of the first level of shifters: in the second turn all that is left
  localparam int DROP = 19;
  localparam int P_W = LOW + 1 + 18;

  // ---- two turns: when which of them is where ---------------------------------------------------------------------------------
  logic [8:1] turn_q;  // bit n: the sum came n clocks before
  always_ff @(posedge clk_i) turn_q <= {turn_q[7:1], take_i};

  // ---- down by e in steps of 16, 4 and 1, in the second turn by 32 more ------------------------------------------------------
  logic signed [SUM_W-1:0] sum_q;
  logic signed [SUM_W+UP-1:0] all;
  logic signed [IN_W-1:0] x_q2, x_q3, x_q4;
  logic [5:0] down_q;
  logic [2:0] blocks;
  logic [3:0] down_q2;
  logic [1:0] down_q3;
  assign all    = $signed({sum_q, {UP{1'b0}}});
  assign blocks = {1'b0, down_q[5:4]} + {1'b0, turn_q[2], 1'b0};
  always_ff @(posedge clk_i) begin
    if (take_i) {sum_q, down_q} <= {sum_i, down_i};
    x_q2    <= IN_W'(all >>> {blocks, 4'd0});
    down_q2 <= down_q[3:0];
    x_q3    <= x_q2 >>> {down_q2[3:2], 2'd0};
    down_q3 <= down_q2[1:0];
    x_q4    <= x_q3 >>> down_q3;
  end

  // ---- times r, rounded ------------------------------------------------------------------------------------------------
  logic signed [P_W-1:0] product, sum_q7;
  logic signed [LOW:0] factor;
  logic [G_W-1:0] g;
  logic [LOW-DROP-1:0] low_q8;
  logic far, far_q8, line_q8, steep;
  assign factor = $signed({turn_q[5] && x_q4[LOW], x_q4[LOW-1:0]});
  shade_mul #(.A_W(LOW + 1), .B_W(18)) u_mul (.clk_i, .a_i(factor), .b_i({1'b0, r_i}), .p_o(product));
  always_ff @(posedge clk_i) begin
    sum_q7 <= product + (turn_q[7] ? sum_q7 >>> LOW : P_W'(1) << (DROP - 1));
    low_q8 <= sum_q7[LOW-1:DROP];
  end
  assign g = {sum_q7[G_W-(LOW-DROP)-1:0], low_q8};

  // ---- the pair ---------------------------------------------------------------------------------------------------------
  logic [G_W-1:0] column_q;
  logic steep_q;
  assign far = x_q4[IN_W-1:2] != '0 && x_q4[IN_W-1:2] != '1;  // in the second turn: more than 34 bits and a sign
  shade_delay #(.WIDTH(1), .DEPTH(3)) u_far (.clk_i, .d_i(far), .q_o(far_q8));
  shade_delay #(.WIDTH(1), .DEPTH(shade_pkg::LATENCY_GRADIENT - 1)) u_line (.clk_i, .d_i(line_i), .q_o(line_q8));
  localparam int S_W = shade_pkg::STEP_W;
  assign steep = far_q8 || (g[G_W-1:S_W-1] != '0 && g[G_W-1:S_W-1] != '1);
  always_ff @(posedge clk_i) begin
    if (turn_q[8] && !line_q8) {steep_q, column_q} <= {steep, g};
    pair_o <= {steep_q || steep, g, column_q};
  end
  shade_valid #(.DEPTH(shade_pkg::LATENCY_GRADIENT)) u_valid (.clk_i, .rst_i, .valid_i(take_i && line_i), .valid_o(made_o));

  logic unused_sum;
  assign unused_sum = ^sum_q7[P_W-1:LOW];
endmodule
