// SPDX-License-Identifier: Apache-2.0
// shade_patch_walk: the scalars N.L, N.H, N.N in the middle of a triangle's boxes, from box to box by additions.
//
//   slot_*      words of shade_patch_setup, of shade_patch_slots;   place_* {tag, line, column} of the corner of a triangle's box
//   box_*       of shade_patch_clip: boxes of a row to the right or to the left, rows downwards; the triangle's end
//   valid_o     it stands in a box: everything until place_o, and what is below for two clocks more, take_i lets it go on
//   a_o, h_o    N.L S1.17, N.H S1.24 of each light, p_o N.N U1.25; *_column_o, *_line_o: growth by a quarter of a box;
//               p_columns_o, p_lines_o half of what that grows by, p_both_o: along the other way
//   place_o     {direct, deep, pixels, kx, ky, column, line, tag}, in the frame
//
//   a box on, in two clocks, of 4 quarters:  a += 2 a_c;  p_c += 4 p_cc;  p_l += 2 p_cl, twice; p += 4 p_c with the second
//
// so that p moves by the slope half way, which is exact. To the left the same subtracted. 4 clocks a box that is next to the one before, 2
// more for each step, 7 more a triangle. No multiplier. Source: P4's constant increment.
// Example: a = 0, a_c = 1, boxes 0 and 1 of row 0 -> a = 0, 4.
module shade_patch_walk #(
  parameter int LIGHTS = 1
) (
  input  logic                                              clk_i,
  input  logic                                              rst_i,
  input  logic                                              slot_valid_i,
  output logic                                              slot_ready_o,
  input  logic [(2*LIGHTS+2)*shade_pkg::PATCH_SCALAR_W-1:0] slot_i,
  input  logic                                              place_valid_i,
  output logic                                              place_ready_o,
  input  logic [              shade_pkg::PATCH_PLACE_W-1:0] place_i,
  input  logic                                              box_valid_i,
  output logic                                              box_ready_o,
  input  logic [                shade_pkg::PATCH_BOX_W-1:0] box_i,
  output logic                                              valid_o,
  input  logic                                              take_i,
  output logic [LIGHTS*(shade_pkg::DIRECT_DIFFUSE_F+2)-1:0] a_o,
  output logic [LIGHTS*(shade_pkg::DIRECT_DIFFUSE_F+2)-1:0] a_column_o,
  output logic [LIGHTS*(shade_pkg::DIRECT_DIFFUSE_F+2)-1:0] a_line_o,
  output logic [LIGHTS*(shade_pkg::DIRECT_X_F+2)-1:0]       h_o,
  output logic [LIGHTS*(shade_pkg::DIRECT_X_F+2)-1:0]       h_column_o,
  output logic [LIGHTS*(shade_pkg::DIRECT_X_F+2)-1:0]       h_line_o,
  output logic [               shade_pkg::DIRECT_P_OUT_F:0] p_o,
  output logic [               shade_pkg::DIRECT_P_OUT_F:0] p_column_o,
  output logic [               shade_pkg::DIRECT_P_OUT_F:0] p_line_o,
  output logic [               shade_pkg::DIRECT_P_OUT_F:0] p_columns_o,
  output logic [               shade_pkg::DIRECT_P_OUT_F:0] p_lines_o,
  output logic [               shade_pkg::DIRECT_P_OUT_F:0] p_both_o,
  output logic [  shade_pkg::PATCH_META_W+16-1:0]           place_o
);
  localparam int A_W = shade_pkg::DIRECT_A_W;
  localparam int H_W = shade_pkg::DIRECT_H_W;
  localparam int P_W = shade_pkg::DIRECT_P_W;
  localparam int IN_W = shade_pkg::PATCH_SCALAR_W;
  localparam int PLACE_W = shade_pkg::PLACE_W;
  localparam int AT_W = shade_pkg::PATCH_AT_W;
  localparam int LOG2 = shade_pkg::PATCH_LOG2_MAX;

  // ---- a triangle: four words of each memory ---------------------------------------------------------------------------------
  typedef enum logic [2:0] {LOAD, BOX, FIRST, SECOND, HERE, HOLD} state_t;
  state_t state_q, next;
  logic [1:0] word_q;
  logic loads, ends, down_q, left_q;
  logic [3:0] put;  // which word
  logic [IN_W-1:0] even, odd;
  assign slot_ready_o = state_q == LOAD && place_valid_i;
  assign loads        = slot_ready_o && slot_valid_i;
  assign put          = loads ? 4'd1 << word_q : '0;
  assign {odd, even}  = slot_i[2*IN_W-1:0];
  always_ff @(posedge clk_i) begin
    if (loads) word_q <= word_q + 2'd1;
    if (rst_i) word_q <= '0;
  end

  // ---- where it stands, which box is next ---------------------------------------------------------------------------------------
  logic direct, here;
  logic [LOG2-1:0] deep;
  logic [15:0] pixels;
  logic [AT_W-1:0] row, column, row_q, column_q;
  logic [2:0] kx_q, ky_q;
  logic [PLACE_W-1:0] left, top;
  logic [shade_pkg::TAG_W-1:0] tag;
  assign {ends, direct, deep, pixels, row, column} = box_i;
  assign {tag, top, left} = place_i;
  assign here          = row == row_q && column == column_q;
  assign next          = !box_valid_i ? BOX : ends ? LOAD : here ? HERE : FIRST;
  assign valid_o       = state_q == HERE;
  assign box_ready_o   = (state_q == HERE && take_i) || place_ready_o;
  assign place_ready_o = box_valid_i && ends && (state_q == BOX || state_q == SECOND || state_q == HOLD);
  assign place_o = {direct, deep, pixels, kx_q, ky_q, left + (PLACE_W'(column) << kx_q), top + (PLACE_W'(row) << ky_q), tag};
  always_ff @(posedge clk_i) begin
    case (state_q)
      LOAD:  if (put[3]) state_q <= BOX;
      FIRST: state_q <= SECOND;
      HERE:  if (take_i) state_q <= HOLD;
      default: begin  // BOX, SECOND, HOLD
        state_q <= next;
        down_q  <= row != row_q;
        left_q  <= row == row_q && column < column_q;
      end
    endcase
    if (put[1]) {column_q, kx_q, ky_q} <= even[AT_W+5:0];
    else if (state_q == FIRST && !down_q) column_q <= left_q ? column_q - AT_W'(1) : column_q + AT_W'(1);
    if (state_q == LOAD) row_q <= '0;
    else if (state_q == FIRST && down_q) row_q <= row_q + AT_W'(1);
    if (rst_i) state_q <= LOAD;
  end

  // ---- the scalars ----------------------------------------------------------------------------------------------------------------
  logic moves;
  assign moves = state_q == FIRST || state_q == SECOND;
  logic [P_W-1:0] p_q, pc_q, pl_q, cc_q, ll_q, cl_q, p_by, pc_by, pl_by, p_sum, pc_sum, pl_sum;
  logic [2:0] low;
  assign p_by  = ((down_q ? pl_q : pc_q) << 2) ^ {P_W{left_q}};
  assign pc_by = (down_q ? cl_q << 1 : cc_q << 2) ^ {P_W{left_q}};
  assign pl_by = (down_q ? ll_q << 2 : cl_q << 1) ^ {P_W{left_q}};
  // the carry in is one more bit at the bottom
  assign {p_sum, low[0]}  = {p_q, 1'b1} + {p_by, left_q};
  assign {pc_sum, low[1]} = {pc_q, 1'b1} + {pc_by, left_q};
  assign {pl_sum, low[2]} = {pl_q, 1'b1} + {pl_by, left_q};
  always_ff @(posedge clk_i) begin
    if (moves) {pc_q, pl_q} <= {pc_sum, pl_sum};
    if (state_q == SECOND) p_q <= p_sum;
    if (put[0]) {p_q, pc_q} <= {even[P_W-1:0], odd[P_W-1:0]};
    if (put[1]) pl_q <= odd[P_W-1:0];
    if (put[2]) {cc_q, cl_q} <= {even[P_W-1:0], odd[P_W-1:0]};
    if (put[3]) ll_q <= even[P_W-1:0];
  end
  localparam int P_OUT_W = shade_pkg::DIRECT_P_OUT_F + 1;
  assign p_o         = p_q[P_W-1-:P_OUT_W];
  assign p_column_o  = pc_q[P_W-1-:P_OUT_W];
  assign p_line_o    = pl_q[P_W-1-:P_OUT_W];
  assign p_columns_o = cc_q[P_W-1-:P_OUT_W];
  assign p_lines_o   = ll_q[P_W-1-:P_OUT_W];
  assign p_both_o    = cl_q[P_W-1-:P_OUT_W];

  localparam int A_OUT_W = shade_pkg::DIRECT_DIFFUSE_F + 2;
  localparam int H_OUT_W = shade_pkg::DIRECT_X_F + 2;
  for (genvar i = 0; i < LIGHTS; i++) begin : g_light
    logic [A_W-1:0] a_q, ac_q, al_q, a_by, a_sum;
    logic [H_W-1:0] h_q, hc_q, hl_q, h_by, h_sum;
    logic [1:0] below;
    logic [IN_W-1:0] of_l, of_h;
    assign {of_h, of_l} = slot_i[(2*i+2)*IN_W+:2*IN_W];
    assign a_by = ((down_q ? al_q : ac_q) << 1) ^ {A_W{left_q}};
    assign h_by = ((down_q ? hl_q : hc_q) << 1) ^ {H_W{left_q}};
    assign {a_sum, below[0]} = {a_q, 1'b1} + {a_by, left_q};
    assign {h_sum, below[1]} = {h_q, 1'b1} + {h_by, left_q};
    always_ff @(posedge clk_i) begin
      if (moves) {a_q, h_q} <= {a_sum, h_sum};
      if (put[0]) {a_q, h_q} <= {of_l[IN_W-1-:A_W], of_h[IN_W-1-:H_W]};
      if (put[2]) {ac_q, hc_q} <= {of_l[IN_W-1-:A_W], of_h[IN_W-1-:H_W]};
      if (put[3]) {al_q, hl_q} <= {of_l[IN_W-1-:A_W], of_h[IN_W-1-:H_W]};
    end
    assign a_o[i*A_OUT_W+:A_OUT_W]        = a_q[A_W-1-:A_OUT_W];
    assign a_column_o[i*A_OUT_W+:A_OUT_W] = ac_q[A_W-1-:A_OUT_W];
    assign a_line_o[i*A_OUT_W+:A_OUT_W]   = al_q[A_W-1-:A_OUT_W];
    assign h_o[i*H_OUT_W+:H_OUT_W]        = h_q[H_W-1-:H_OUT_W];
    assign h_column_o[i*H_OUT_W+:H_OUT_W] = hc_q[H_W-1-:H_OUT_W];
    assign h_line_o[i*H_OUT_W+:H_OUT_W]   = hl_q[H_W-1-:H_OUT_W];
    logic unused_below;
    assign unused_below = &{1'b0, below, of_l, of_h};
  end
  logic unused_low;
  assign unused_low = &{1'b0, low, even, odd};
endmodule
