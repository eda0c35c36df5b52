// SPDX-License-Identifier: Apache-2.0
// shade_patch_walk: the normals in the middle of a triangle's boxes, found by adding increments.
//
//   triangle_i, corner_i, kx_i, ky_i   of a triangle, taken with triangle_take_o: {Gy, Gx, tag, line, column of its box}, Gx and
//                            Gy as {exp, z, y, x}; S3.18, the normal in the box's corner
//   box_i                    of shade_patch_clip, taken with box_ready_o: boxes of a row from left to right, rows downwards
//   n_o         S1.16        corner + (2^kx column + 2^(kx-1)) Gx + (2^ky row + 2^(ky-1)) Gy, x at bit 0, rounded once,
//                            saturated; Gx and Gy are cut to 28 fraction bits of a quarter of a box
//   dx_o, dy_o  S1.16        Gx 2^(kx-2), Gy 2^(ky-2), floor: a quarter of a box
//   place_o                  {first, direct, deep, pixels, column, line, tag, kx, ky}: first of its triangle; place in the frame
//   range_o                  for one clock: a component is saturated, this box's light is wrong
//
// Three clocks a triangle and up to eight of a shift by 4 + exp - k, one clock for each row or column of boxes that is stepped over, one for each box. Latency 1 clock.
// Source: P4's constant increment. Example: N0 = (0, 0, 1), Gx = Gy = 0 -> n = (0, 0, 1), dx = dy = 0.
module shade_patch_walk (
  input  logic                                 clk_i,
  input  logic                                 rst_i,
  input  logic                                 triangle_valid_i,
  output logic                                 triangle_take_o,
  input  logic [shade_pkg::PATCH_TRIANGLE_W-1:0] triangle_i,
  input  logic [3*shade_pkg::PATCH_CORNER_W-1:0] corner_i,
  input  logic [                          2:0] kx_i,
  input  logic [                          2:0] ky_i,
  input  logic                                 box_valid_i,
  output logic                                 box_ready_o,
  input  logic [shade_pkg::PATCH_BOX_W-1:0]    box_i,
  output logic                                 valid_o,
  input  logic                                 ready_i,
  output logic [3*shade_pkg::INTENSITY_W-1:0]  n_o,
  output logic [3*shade_pkg::INTENSITY_W-1:0]  dx_o,
  output logic [3*shade_pkg::INTENSITY_W-1:0]  dy_o,
  output logic [shade_pkg::PATCH_PLACE_W-1:0]  place_o,
  output logic                                 range_o
);
  localparam int STEP_W = shade_pkg::PATCH_STEP_W;
  localparam int CORNER_W = shade_pkg::PATCH_CORNER_W;
  localparam int EXP_W = shade_pkg::TRIANGLE_EXP_W;
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int AT_W = shade_pkg::PATCH_AT_W;
  localparam int LOG2 = shade_pkg::PATCH_LOG2_MAX;
  localparam int PLACE_W = shade_pkg::PLACE_W;
  localparam int TAG_W = shade_pkg::TAG_W;
  localparam int DROP = shade_pkg::PATCH_STEP_F - shade_pkg::INTENSITY_F;

  logic ends, direct;
  logic [LOG2-1:0] deep;
  logic [15:0] pixels;
  logic [AT_W-1:0] row, column;
  assign {ends, direct, deep, pixels, row, column} = box_i;

  // ---- where the walk is ---------------------------------------------------------------------------------------------------
  typedef enum logic [2:0] {IDLE, SHIFT, RIGHT, DOWN, BOXES} state_t;
  state_t state_q;
  logic [AT_W-1:0] row_q, column_q;
  logic first_q, boxes, next_row, next_column, here, give;
  assign boxes           = state_q == BOXES && box_valid_i && !ends;
  assign next_row        = boxes && row != row_q;
  assign next_column     = boxes && !next_row && column != column_q;
  assign here            = boxes && row == row_q && column == column_q;
  assign give            = here && (!valid_o || ready_i);
  assign box_ready_o     = give || (state_q == BOXES && box_valid_i && ends);
  assign triangle_take_o = state_q == IDLE && triangle_valid_i;
  logic [2:0] kx_q, ky_q;
  logic [PLACE_W-1:0] left_q, top_q;
  logic [TAG_W-1:0] tag_q, tag;
  logic [PLACE_W-1:0] left, top;
  logic [3*W-1:0] gx0, gy0;
  logic [EXP_W-1:0] x_exp, y_exp;
  logic [EXP_W:0] x_q, y_q;  // halvings to come
  assign {y_exp, gy0, x_exp, gx0, tag, top, left} = triangle_i;
  always_ff @(posedge clk_i) begin
    case (state_q)
      IDLE:    if (triangle_valid_i) state_q <= SHIFT;
      SHIFT:   if (x_q == '0 && y_q == '0) state_q <= RIGHT;
      RIGHT:   state_q <= DOWN;
      DOWN:    state_q <= BOXES;
      default: if (box_valid_i && ends) state_q <= IDLE;
    endcase
    if (state_q == IDLE) begin
      {kx_q, ky_q, left_q, top_q, tag_q} <= {kx_i, ky_i, left, top, tag};
      {row_q, column_q} <= '0;
      first_q           <= 1'b1;
    end
    if (state_q == IDLE) begin
      x_q <= (EXP_W + 1)'(x_exp) + (EXP_W + 1)'(4) - (EXP_W + 1)'(kx_i);
      y_q <= (EXP_W + 1)'(y_exp) + (EXP_W + 1)'(4) - (EXP_W + 1)'(ky_i);
    end else begin
      x_q <= x_q > (EXP_W + 1)'(3) ? x_q - (EXP_W + 1)'(4) : x_q - (EXP_W + 1)'(x_q != '0);
      y_q <= y_q > (EXP_W + 1)'(3) ? y_q - (EXP_W + 1)'(4) : y_q - (EXP_W + 1)'(y_q != '0);
    end
    if (next_row) begin
      row_q    <= row_q + AT_W'(1);
      column_q <= '0;
    end
    if (next_column) column_q <= column_q + AT_W'(1);
    if (give) begin
      first_q <= 1'b0;
      place_o <= {first_q, direct, deep, pixels, left_q + (PLACE_W'(column) << kx_q), top_q + (PLACE_W'(row) << ky_q),
                  tag_q, kx_q, ky_q};
    end
    valid_o <= give || (valid_o && !ready_i);
    if (rst_i) begin
      state_q <= IDLE;
      valid_o <= 1'b0;
    end
  end

  // ---- normals ---------------------------------------------------------------------------------------------------------------
  logic [2:0] wide_q;  // n does not fit
  for (genvar c = 0; c < 3; c++) begin : g_component
    logic signed [W-1:0] gx, gy;
    logic signed [CORNER_W-1:0] corner;
    logic signed [STEP_W-1:0] qx_q, qy_q, at_q, row_at_q, from, step, at;
    assign gx     = gx0[c*W+:W];
    assign gy     = gy0[c*W+:W];
    assign corner = corner_i[c*CORNER_W+:CORNER_W];
    assign from   = next_row ? row_at_q : at_q;
    assign step   = state_q == RIGHT ? qx_q <<< 1 : state_q == DOWN ? qy_q <<< 1 : next_row ? qy_q <<< 2 : qx_q <<< 2;
    assign at     = from + step;
    always_ff @(posedge clk_i) begin
      if (state_q == IDLE) begin
        // a quarter of the largest box
        qx_q <= STEP_W'(gx) <<< (DROP + shade_pkg::PATCH_LOG2_MAX - 2);
        qy_q <= STEP_W'(gy) <<< (DROP + shade_pkg::PATCH_LOG2_MAX - 2);
        at_q <= STEP_W'(corner) <<< (shade_pkg::PATCH_STEP_F - shade_pkg::PATCH_PLAN_F);
      end else begin
        if (x_q > (EXP_W + 1)'(3)) qx_q <= qx_q >>> 4;
        else if (x_q != '0) qx_q <= qx_q >>> 1;
        if (y_q > (EXP_W + 1)'(3)) qy_q <= qy_q >>> 4;
        else if (y_q != '0) qy_q <= qy_q >>> 1;
        if (state_q == RIGHT || state_q == DOWN || next_row || next_column) at_q <= at;
      end
      if (state_q == DOWN || next_row) row_at_q <= at;
    end

    localparam int N_W = STEP_W - DROP;
    logic signed [N_W-1:0] n_near, dx, dy;
    logic signed [W-1:0] n_fit;
    assign n_near = at_q[STEP_W-1:DROP];
    assign dx     = qx_q[STEP_W-1:DROP];
    assign dy     = qy_q[STEP_W-1:DROP];
    shade_limit #(.WIDTH(N_W), .OUT_W(W)) u_fit (.x_i(n_near), .y_o(n_fit));
    always_ff @(posedge clk_i) begin
      if (give) begin
        n_o[c*W+:W]  <= n_fit;
        dx_o[c*W+:W] <= dx[W-1:0];  // a quarter of a box is short
        dy_o[c*W+:W] <= dy[W-1:0];
        wide_q[c]    <= n_near != N_W'(n_fit);
      end
    end
    logic unused_sign;
    assign unused_sign = &{1'b0, dx, dy};
  end
  logic give_q;
  always_ff @(posedge clk_i) begin
    give_q  <= give && !rst_i;
    range_o <= give_q && wide_q != '0;
  end
endmodule
