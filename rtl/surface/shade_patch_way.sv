// SPDX-License-Identifier: Apache-2.0
// shade_patch_way: how far a triangle's normal goes, and how far away the highlight is: what shade_patch_plan decides by.
//
//   valid_i, triangle_i   of shade_patch_door, until pass_o: it is copied
//   hx_i ..    S1.16      H
//   corner_o   S3.18      N - left Gx, the normal in the corner of the triangle's box, and half an ulp of S1.16, with corner_valid_o
//   done_o     the following are there, until take_i
//   a_o, b_o   U3.18      norm(Gx), norm(Gy)
//   far_o      S7.18      norm(corner + (columns Gx + lines Gy) / 2 - H) - (columns a + lines b) / 2: from the middle of the box
//                         to the highlight, less half of the box
//   columns_o, lines_o    of the triangle
//
// Gx and Gy are mantissas times 2^-exp. Products are cut to 18 fraction bits: a bit of columns, lines, left a clock, exp + 2 of
// them. About 12 clocks and the larger exp, the next one begins 5 clocks earlier. No multiplier. Source: P4's constant increment. Example: N = H, Gx = Gy = 0 -> 0, 0, 0.
module shade_patch_way (
  input  logic                                           clk_i,
  input  logic                                           rst_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0]       hx_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0]       hy_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0]       hz_i,
  input  logic                                           valid_i,
  input  shade_pkg::triangle_t                           triangle_i,
  output logic                                           pass_o,
  output logic                                           corner_valid_o,
  output logic        [3*shade_pkg::PATCH_CORNER_W-1:0]  corner_o,
  input  logic                                           take_i,
  output logic                                           done_o,
  output logic        [shade_pkg::PATCH_WAY_W-1:0]       a_o,
  output logic        [shade_pkg::PATCH_WAY_W-1:0]       b_o,
  output logic signed [shade_pkg::PATCH_FAR_W-1:0]       far_o,
  output logic        [    shade_pkg::COUNT_W-1:0]       columns_o,
  output logic        [    shade_pkg::COUNT_W-1:0]       lines_o
);
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int EXP_W = shade_pkg::TRIANGLE_EXP_W;
  localparam int G_W = shade_pkg::INTENSITY_W;
  localparam int WAY_W = shade_pkg::PATCH_WAY_W;
  localparam int FAR_W = shade_pkg::PATCH_FAR_W;
  localparam int CORNER_W = shade_pkg::PATCH_CORNER_W;
  localparam int UP = shade_pkg::PATCH_PLAN_F - shade_pkg::INTENSITY_F;
  localparam int SUM_W = G_W + UP + 3;  // (sum + mantissa 2^(UP + 2)) / 2 stays below the mantissa
  localparam int W = shade_pkg::PATCH_PLAN_F + 6;

  typedef enum logic [2:0] {IDLE, TIMES, SUM, CORNER, LESS} state_t;
  state_t state_q;
  logic put, ends;
  logic [4:0] tail_q;  // clocks since LESS: the length of the way to H, half of the box
  assign put    = state_q == IDLE && valid_i;
  assign pass_o = put;
  assign corner_valid_o = state_q == CORNER;

  logic [shade_pkg::COUNT_W-1:0] wide_all_q, high_all_q;
  logic [WAY_W-1:0] a_way_q, b_way_q;

  // ---- columns Gx, left Gx, lines Gy: a bit and a halving a clock, exp + 2 times ------------------------------------------------------
  logic [EXP_W:0] x_q, y_q, x_all_q, y_all_q;  // bits to come, of all
  logic [COUNT_W-1:0] columns_q, left_q, lines_q;
  logic x_on, y_on;
  logic [EXP_W:0] x_all, y_all;
  assign x_all = (EXP_W + 1)'(triangle_i.dcolumn.exp) + (EXP_W + 1)'(2);
  assign y_all = (EXP_W + 1)'(triangle_i.dline.exp) + (EXP_W + 1)'(2);
  assign x_on = x_q != '0;
  assign y_on = y_q != '0;
  assign ends = !x_on && !y_on;
  always_ff @(posedge clk_i) begin
    if (put) begin
      {wide_all_q, high_all_q} <= {triangle_i.columns, triangle_i.lines};
      {columns_q, lines_q, left_q} <= {triangle_i.columns, triangle_i.lines, COUNT_W'(triangle_i.left)};
      x_q     <= x_all;
      y_q     <= y_all;
      x_all_q <= x_all;
      y_all_q <= y_all;
    end else begin
      {columns_q, lines_q, left_q} <= {columns_q >> 1, lines_q >> 1, left_q >> 1};
      x_q <= x_q - (EXP_W + 1)'(x_on);
      y_q <= y_q - (EXP_W + 1)'(y_on);
    end
  end

  logic [2:0][W-1:0] s_q;  // Gx, Gy, the way to H
  for (genvar c = 0; c < 3; c++) begin : g_component
    logic signed [G_W-1:0] n, gx, gy, h;
    if (c == 0) begin : g_x
      assign {n, gx, gy, h} = {triangle_i.normal.x, triangle_i.dcolumn.mantissa.x, triangle_i.dline.mantissa.x, hx_i};
    end else if (c == 1) begin : g_y
      assign {n, gx, gy, h} = {triangle_i.normal.y, triangle_i.dcolumn.mantissa.y, triangle_i.dline.mantissa.y, hy_i};
    end else begin : g_z
      assign {n, gx, gy, h} = {triangle_i.normal.z, triangle_i.dcolumn.mantissa.z, triangle_i.dline.mantissa.z, hz_i};
    end
    function automatic logic signed [SUM_W-1:0] add(
      input logic signed [SUM_W-1:0] sum, input logic signed [G_W-1:0] g, input logic one
    );
      logic signed [SUM_W-1:0] total;
      total = sum + ((SUM_W'(g) <<< (UP + 2)) & {SUM_W{one}});
      add   = total >>> 1;
    endfunction
    logic signed [SUM_W-1:0] across_q, less_q, down_q;
    logic signed [G_W-1:0] n_q, gx_q, gy_q;
    always_ff @(posedge clk_i) if (put) {n_q, gx_q, gy_q} <= {n, gx, gy};
    logic signed [W-1:0] one, other, less_h_q;  // -H, a setting
    assign one   = state_q == SUM ? W'(across_q) : state_q == CORNER ? W'($signed(s_q[c]) >>> 1) : $signed(s_q[c]);
    assign other = state_q == SUM ? W'(down_q) : state_q == CORNER ? W'($signed(corner_o[c*CORNER_W+:CORNER_W])) : less_h_q;
    always_ff @(posedge clk_i) less_h_q <= -(W'(h) <<< UP);
    always_ff @(posedge clk_i) begin
      if (state_q == IDLE) {across_q, less_q, down_q} <= '0;
      else begin
        if (x_on) across_q <= add(across_q, gx_q, columns_q[0]);
        if (x_on) less_q <= add(less_q, gx_q, left_q[0]);
        if (y_on) down_q <= add(down_q, gy_q, lines_q[0]);
      end
      case (state_q)
        IDLE:    s_q[c] <= W'(gx);
        TIMES:   s_q[c] <= W'(gy_q);
        default: s_q[c] <= one + other;
      endcase
      if (state_q == SUM) corner_o[c*CORNER_W+:CORNER_W] <= $signed({(CORNER_W - UP)'(n_q), UP'(1 << (UP - 1))}) - CORNER_W'(less_q);
    end
  end

  // ---- lengths, and (columns a + lines b) / 2 --------------------------------------------------------------------------------------
  logic [W-1:0] length, away_q;
  logic [2:0] which_q, which_q1, which_q2, which_q3;  // s_q is Gx, Gy, the way to H
  logic [COUNT_W-1:0] wide_q, high_q;
  logic [EXP_W:0] a_left_q, b_left_q;
  logic [WAY_W+2:0] a_q, b_q, a_sum_q, b_sum_q, sum;
  shade_patch_norm #(.WIDTH(W)) u_norm (.clk_i, .x_i(s_q[0]), .y_i(s_q[1]), .z_i(s_q[2]), .y_o(length));
  assign sum = a_sum_q + b_sum_q;
  always_ff @(posedge clk_i) begin
    which_q  <= {state_q == LESS, which_q[0], put};
    which_q1 <= which_q;
    which_q2 <= which_q1;
    which_q3 <= which_q2;
    if (which_q3[0]) begin
      a_q      <= (WAY_W + 3)'(length) << (UP + 2);
      a_way_q      <= WAY_W'(length) << UP;
      a_sum_q  <= '0;
      wide_q   <= wide_all_q;
      a_left_q <= x_all_q;
    end else if (a_left_q != '0) begin
      if (a_left_q > (EXP_W + 1)'(2)) a_way_q <= a_way_q >> 1;
      a_sum_q  <= (a_sum_q + (wide_q[0] ? a_q : '0)) >> 1;
      wide_q   <= wide_q >> 1;
      a_left_q <= a_left_q - (EXP_W + 1)'(1);
    end
    if (which_q3[1]) begin
      b_q      <= (WAY_W + 3)'(length) << (UP + 2);
      b_way_q      <= WAY_W'(length) << UP;
      b_sum_q  <= '0;
      high_q   <= high_all_q;
      b_left_q <= y_all_q;
    end else if (b_left_q != '0) begin
      if (b_left_q > (EXP_W + 1)'(2)) b_way_q <= b_way_q >> 1;
      b_sum_q  <= (b_sum_q + (high_q[0] ? b_q : '0)) >> 1;
      high_q   <= high_q >> 1;
      b_left_q <= b_left_q - (EXP_W + 1)'(1);
    end
    if (which_q3[2]) away_q <= length;
    if (tail_q[4]) {a_o, b_o} <= {a_way_q, b_way_q};
    if (tail_q[4]) far_o <= $signed(FAR_W'(away_q)) - $signed(FAR_W'(sum >> 1));
  end
  always_ff @(posedge clk_i) begin
    case (state_q)
      IDLE:    if (put) state_q <= TIMES;
      TIMES:   if (ends && !done_o && tail_q == '0) state_q <= SUM;  // the one before has been taken
      LESS:    state_q <= IDLE;
      default: state_q <= state_t'(state_q + 3'd1);
    endcase
    tail_q <= {tail_q[3:0], state_q == LESS};
    if (state_q == LESS) {columns_o, lines_o} <= {wide_all_q, high_all_q};
    done_o <= tail_q[4] || (done_o && !take_i);
    if (rst_i) begin
      state_q <= IDLE;
      tail_q  <= '0;
      done_o  <= 1'b0;
    end
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, triangle_i};
endmodule
