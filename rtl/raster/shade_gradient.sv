// SPDX-License-Identifier: Apache-2.0
// shade_gradient: increments of a component per column and line, 256 sum / A, of exact sums and the reciprocal of A.
//
//   sum_i       S52.0     v1 dy2 - v2 dy1, then with line_i v2 dx1 - v1 dx2, the sign of A taken out
//   down_i, r_i  1/A = r 2^-17 2^-e; down = e, of a depth e + 7, with sum_i, r_i 3 clocks later
//   pair_o      column, line: S2.29 of a normal's component, S1.30 of a depth; both 0 and steep if one does not fit
//
//   aligned = sum 2^(23-down)  35 bits, 19 more than the result, cut
//   result  = aligned r / 2^19, to nearest, ties up: error at most 3/4 ulp beside that of r
//
// One 35 x 18 multiplier (two blocks). Latency LATENCY_GRADIENT = 8 clocks from the second sum, a sum a clock.
// Example: sum = 2^20, e = 24, r = 1 - 2^-17 -> 2^-12 - 2^-29.
// Source: P4, the constant increment of an interpolated normal.
module shade_gradient (
  input  logic                              clk_i,
  input  logic                              rst_i,
  input  logic                              valid_i,
  input  logic                              line_i,
  input  logic signed [shade_pkg::AREA_W:0] sum_i,
  input  logic [                     5:0]   down_i,
  input  logic [shade_pkg::RECIPROCAL_F-1:0] r_i,
  output logic                              valid_o,
  output shade_pkg::pair_t                  pair_o
);
  localparam int SUM_W = shade_pkg::AREA_W + 1;
  localparam int UP = 23;  // moved up as far as e = 0 demands; e moves it down
  localparam int IN_W = shade_pkg::STEP_W + 3;
  localparam int DROP = 19;

  // ---- down by e in steps of 16, 4 and 1; wide: more than a sign above what is kept -----------------------------------------
  localparam int W_1 = IN_W + 15;
  localparam int W_2 = IN_W + 3;
  logic signed [SUM_W+UP-1:0] all;
  logic signed [W_1-1:0] x_q1;
  logic signed [W_2-1:0] x_q2;
  logic signed [IN_W-1:0] x_q3;
  logic [3:0] down_q1;
  logic [1:0] down_q2;
  logic wide_q1, wide_q2, wide_q3;
  assign all  = $signed({sum_i, {UP{1'b0}}});

  // more than the sign from bit `from` on upwards
  function automatic logic more(input logic [SUM_W+UP-1:0] x, input int from);
    more = 1'b0;
    for (int i = 0; i < SUM_W + UP; i++) if (i >= from && x[i] != x[SUM_W+UP-1]) more = 1'b1;
  endfunction

  always_ff @(posedge clk_i) begin
    x_q1    <= W_1'(all >>> {down_i[5:4], 4'd0});
    wide_q1 <= (down_i[5:4] == 2'd0 && more(all, W_1 - 1)) || (down_i[5:4] == 2'd1 && more(all, W_1 + 15));
    down_q1 <= down_i[3:0];
    x_q2    <= W_2'(x_q1 >>> {down_q1[3:2], 2'd0});
    wide_q2 <= wide_q1 || more((SUM_W + UP)'(x_q1), W_2 - 1 + int'({down_q1[3:2], 2'b00}));
    down_q2 <= down_q1[1:0];
    x_q3    <= IN_W'(x_q2 >>> down_q2);
    wide_q3 <= wide_q2 || more((SUM_W + UP)'(x_q2), IN_W - 1 + int'(down_q2));
  end

  // ---- times r, rounded ------------------------------------------------------------------------------------------------
  localparam int P_W = IN_W + 18;
  localparam int G_W = P_W - DROP;
  logic signed [P_W-1:0] p_q5, half_up_q6;
  logic signed [shade_pkg::STEP_W-1:0] g_q7;
  logic wide_q5, wide_q6, wide_q7;
  logic [G_W-shade_pkg::STEP_W:0] above;
  shade_mul #(.A_W(IN_W), .B_W(18)) u_mul (.clk_i, .a_i(x_q3), .b_i({1'b0, r_i}), .p_o(p_q5));
  shade_delay #(.WIDTH(1), .DEPTH(shade_pkg::LATENCY_MUL)) u_wide (.clk_i, .d_i(wide_q3), .q_o(wide_q5));
  logic unused_low;
  assign unused_low = ^half_up_q6[DROP-1:0];
  assign above      = half_up_q6[P_W-1-:G_W-shade_pkg::STEP_W+1];
  always_ff @(posedge clk_i) begin
    half_up_q6 <= p_q5 + (P_W'(1) << (DROP - 1));
    wide_q6    <= wide_q5;
    g_q7       <= half_up_q6[DROP+:shade_pkg::STEP_W];
    wide_q7    <= wide_q6 || (above != '0 && above != '1);
  end

  // ---- the pair ---------------------------------------------------------------------------------------------------------
  logic signed [shade_pkg::STEP_W-1:0] column_q;
  logic line_q7, wide_q, none;
  shade_delay #(.WIDTH(1), .DEPTH(shade_pkg::LATENCY_GRADIENT - 1)) u_line (.clk_i, .d_i(line_i), .q_o(line_q7));
  assign none = wide_q || wide_q7;
  always_ff @(posedge clk_i) begin
    if (!line_q7) {wide_q, column_q} <= {wide_q7, g_q7};
    pair_o <= {none, none ? (2 * shade_pkg::STEP_W)'(0) : {g_q7, column_q}};
  end
  shade_valid #(.DEPTH(shade_pkg::LATENCY_GRADIENT)) u_valid (.clk_i, .rst_i, .valid_i(valid_i && line_i), .valid_o);
endmodule
