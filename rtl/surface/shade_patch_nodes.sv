// SPDX-License-Identifier: Apache-2.0
// shade_patch_nodes: N.L, N.H and N.N where a box is lit: at its six nodes, or at each of its pixels.
//
//   valid_i, take_o   a box of shade_patch_walk, whose outputs come in; they may change two clocks after take_o
//   room_i    stops the walk; up to two nodes still come
//   valid_o   a node: a_o S1.17, h_o S1.24 of each light, p_o U1.25, i, j quarters of a box from its middle, modulo their widths:
//             a + i a_c + j a_l;   p + i p_c + j p_l + i^2 p_cc + i j p_cl + j^2 p_ll
//             i, j of nodes: (1, -1), (1, 1), (-1, -1), (-1, 1), (0, 0), (1, 0); of pixels: column, line - 2
//   meta_valid_o, meta_o   {direct, deep, kx, ky, column, line, tag} once a box, or for every pixel, in time for its first light
//
// No multiplier. A node a clock, no bubble between boxes. Latency LATENCY_PATCH_NODES = 4.
// Example: a = 1, a_c = 1/4, others 0 -> 5/4, 5/4, 3/4, 3/4, 1, 5/4.
module shade_patch_nodes #(
  parameter int LIGHTS = 1
) (
  input  logic                                              clk_i,
  input  logic                                              rst_i,
  input  logic                                              valid_i,
  output logic                                              take_o,
  input  logic                                              room_i,
  input  logic [LIGHTS*(shade_pkg::DIRECT_DIFFUSE_F+2)-1:0] a_i,
  input  logic [LIGHTS*(shade_pkg::DIRECT_DIFFUSE_F+2)-1:0] a_column_i,
  input  logic [LIGHTS*(shade_pkg::DIRECT_DIFFUSE_F+2)-1:0] a_line_i,
  input  logic [LIGHTS*(shade_pkg::DIRECT_X_F+2)-1:0]       h_i,
  input  logic [LIGHTS*(shade_pkg::DIRECT_X_F+2)-1:0]       h_column_i,
  input  logic [LIGHTS*(shade_pkg::DIRECT_X_F+2)-1:0]       h_line_i,
  input  logic [               shade_pkg::DIRECT_P_OUT_F:0] p_i,
  input  logic [               shade_pkg::DIRECT_P_OUT_F:0] p_column_i,
  input  logic [               shade_pkg::DIRECT_P_OUT_F:0] p_line_i,
  input  logic [               shade_pkg::DIRECT_P_OUT_F:0] p_columns_i,
  input  logic [               shade_pkg::DIRECT_P_OUT_F:0] p_lines_i,
  input  logic [               shade_pkg::DIRECT_P_OUT_F:0] p_both_i,
  input  logic [             shade_pkg::PATCH_META_W+16-1:0] place_i,
  output logic                                              valid_o,
  output logic [LIGHTS*(shade_pkg::DIRECT_DIFFUSE_F+2)-1:0] a_o,
  output logic [LIGHTS*(shade_pkg::DIRECT_X_F+2)-1:0]       h_o,
  output logic [               shade_pkg::DIRECT_P_OUT_F:0] p_o,
  output logic                                              meta_valid_o,
  output logic [                shade_pkg::PATCH_META_W-1:0] meta_o
);
  localparam int PLACE_W = shade_pkg::PLACE_W;
  localparam int TAG_W = shade_pkg::TAG_W;
  localparam int LOG2 = shade_pkg::PATCH_LOG2_MAX;

  // ---- the walk: node 0 .. 5, or the pixels that are left ----------------------------------------------------------------------
  logic busy_q, step, last, direct_q, first_q;
  logic [2:0] node_q;
  logic [15:0] left_q, rest_q, coming;  // pixels; those behind the first one of them
  logic [3:0] pixel;
  logic signed [1:0] i, j;
  logic [LOG2+5:0] size_q;  // deep, kx, ky
  logic [PLACE_W-1:0] column_q, line_q;
  logic [TAG_W-1:0] tag_q;
  assign take_o = valid_i && (!busy_q || (step && last));
  assign step   = busy_q && room_i;
  assign coming = !busy_q || last ? place_i[shade_pkg::PATCH_META_W-LOG2-1+:16] : rest_q;
  always_comb begin
    pixel = '0;
    for (int n = 15; n >= 0; n--) if (left_q[n]) pixel = 4'(n);
    last = direct_q ? rest_q == '0 : node_q == 3'd5;
    // -2 .. 1 of a pixel is its place less 2: the upper bit turned over
    if (direct_q) {j, i} = pixel ^ 4'b1010;
    else begin
      i = node_q == 3'd4 ? 2'sd0 : node_q[1] ? -2'sd1 : 2'sd1;
      j = node_q[2] ? 2'sd0 : node_q[0] ? 2'sd1 : -2'sd1;
    end
  end
  always_ff @(posedge clk_i) begin
    if (take_o || step) begin
      left_q <= coming;
      rest_q <= coming & (coming - 16'd1);
    end
    if (take_o) begin
      {direct_q, size_q[LOG2+5:6], left_q, size_q[5:0], column_q, line_q, tag_q} <= place_i;
      first_q <= 1'b1;
      node_q  <= '0;
    end else if (step) begin
      first_q <= 1'b0;
      node_q  <= node_q + 3'd1;
    end
    if (take_o) busy_q <= 1'b1;
    else if (step && last) busy_q <= 1'b0;
    meta_o       <= {direct_q, size_q, column_q + (direct_q ? PLACE_W'(pixel[1:0]) : '0),
                     line_q + (direct_q ? PLACE_W'(pixel[3:2]) : '0), tag_q};
    meta_valid_o <= step && (direct_q || first_q) && !rst_i;
    if (rst_i) busy_q <= 1'b0;
  end

  // ---- a box: what is needed in the first and in the second sum -------------------------------------------------------------
  logic take_q1, take_q2;
  always_ff @(posedge clk_i) {take_q1, take_q2} <= rst_i ? 2'd0 : {take_o, take_q1};

  // ---- sums ----------------------------------------------------------------------------------------------------------------------
  // f times -2 .. 1: the ones' complement where it is negative, for which a carry is due; negative: n[1]
  localparam int P_W = shade_pkg::DIRECT_P_OUT_F + 1;
  function automatic logic [P_W-1:0] times(input logic [P_W-1:0] f, input logic [1:0] n);
    times = n == 2'd0 ? '0 : n == 2'd1 ? f : n == 2'd3 ? ~f : ~(f << 1);
  endfunction
  function automatic logic [P_W-1:0] sum(input logic [P_W-1:0] a, input logic [P_W-1:0] b, input logic carry);
    sum = P_W'(({a, 1'b1} + {b, carry}) >> 1);
  endfunction
  function automatic logic [P_W-1:0] square(input logic [P_W-1:0] f, input logic [1:0] n);
    square = n == 2'd0 ? '0 : n == 2'd2 ? f << 2 : f;
  endfunction
  logic [1:0] i_q1, j_q1, j_q2;
  logic [2:0] pair, pair_q2;  // {negative, size}: 0, 1, 2, 4
  logic [P_W-1:0] both, p_q, pc_q, pl_q, cc_q, ll_q, cl_q, t_q2, v_q2, t_q3, v_q3;
  always_comb begin
    pair = 3'd0;
    if (i_q1 != '0 && j_q1 != '0) pair = {i_q1[1] ^ j_q1[1], 2'd1 + 2'(i_q1 == 2'b10) + 2'(j_q1 == 2'b10)};
    both = (pair_q2[1:0] == 2'd0 ? '0 : pair_q2[1:0] == 2'd1 ? cl_q : pair_q2[1:0] == 2'd2 ? cl_q << 1 : cl_q << 2) ^
           {P_W{pair_q2[2]}};
  end
  always_ff @(posedge clk_i) begin
    if (take_q1) {p_q, pc_q, cc_q, ll_q} <= {p_i, p_column_i, p_columns_i, p_lines_i};
    if (take_q2) {pl_q, cl_q} <= {p_line_i, p_both_i};
    {i_q1, j_q1} <= {i, j};
    j_q2    <= j_q1;
    pair_q2 <= pair;
    t_q2    <= sum(p_q, times(pc_q, i_q1), i_q1[1]);
    v_q2    <= square(cc_q, i_q1) + square(ll_q, j_q1);
    t_q3    <= sum(t_q2, times(pl_q, j_q2), j_q2[1]);
    v_q3    <= sum(v_q2, both, pair_q2[2]);
    p_o     <= t_q3 + v_q3;
  end
  for (genvar n = 0; n < LIGHTS; n++) begin : g_light
    localparam int A_W = shade_pkg::DIRECT_DIFFUSE_F + 2;
    localparam int H_W = shade_pkg::DIRECT_X_F + 2;
    logic [A_W-1:0] a_q, ac_q, al_q, a_q2, a_q3;
    logic [H_W-1:0] h_q, hc_q, hl_q, h_q2, h_q3;
    always_ff @(posedge clk_i) begin
      if (take_q1) {a_q, ac_q} <= {a_i[n*A_W+:A_W], a_column_i[n*A_W+:A_W]};
      if (take_q1) {h_q, hc_q} <= {h_i[n*H_W+:H_W], h_column_i[n*H_W+:H_W]};
      if (take_q2) {al_q, hl_q} <= {a_line_i[n*A_W+:A_W], h_line_i[n*H_W+:H_W]};
      a_q2 <= A_W'(sum(P_W'(a_q), times(P_W'(ac_q), i_q1), i_q1[1]));
      h_q2 <= H_W'(sum(P_W'(h_q), times(P_W'(hc_q), i_q1), i_q1[1]));
      a_q3 <= A_W'(sum(P_W'(a_q2), times(P_W'(al_q), j_q2), j_q2[1]));
      h_q3 <= H_W'(sum(P_W'(h_q2), times(P_W'(hl_q), j_q2), j_q2[1]));
      {a_o[n*A_W+:A_W], h_o[n*H_W+:H_W]} <= {a_q3, h_q3};
    end
  end
  shade_valid #(.DEPTH(shade_pkg::LATENCY_PATCH_NODES)) u_valid (.clk_i, .rst_i, .valid_i(step), .valid_o);
endmodule
