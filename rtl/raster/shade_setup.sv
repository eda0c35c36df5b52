// SPDX-License-Identifier: Apache-2.0
// shade_setup: checked triangles to edges, and to increments of normal and depth; culling; what has no area is left out.
//
// A triangle (valid_i, ready_o, see shade_vertices) waits in a first place until the sign of its area is known,
//
//   A = dx1 dy2 - dx2 dy1          told_o: A = 0, culled by cull_i (CULL_*), or its box holds no pixel of the frame
//
// then goes through a second one, from which three edges and eight sums are made, an edge or a sum a clock:
//
//   edge_valid_o ...   three edges, as shade_raster takes them; rest_o: r of shade_edges, S27.0
//   pair_valid_o ...   increments per column and line of normal x, y, z, S2.29, and depth, S1.30
//   head_valid_o ...   vertex 0, box, tag, mark: once a triangle, not before its first pair is under way
//
// Pairs and edges go into FIFOs that hold four triangles: with head_ready_i no more are on the way.
// Triangles whose differences do not fit 17 bits (256 pixels) take several passes a sum (wide).
// A triangle in 14 clocks, a wide one in 36, one that is left out in 6. Four multipliers (cross 2, gradient 2).
// Example: golden.raster.gradients. Source: P4 (increments).
module shade_setup (
  input  logic                                    clk_i,
  input  logic                                    rst_i,
  input  logic [        shade_pkg::CULL_W-1:0]    cull_i,
  input  logic [       shade_pkg::COUNT_W-1:0]    columns_i,
  input  logic [       shade_pkg::COUNT_W-1:0]    lines_i,
  input  logic                                    valid_i,
  output logic                                    ready_o,
  input  logic [  shade_pkg::COORDINATE_W:0]      x_i,
  input  logic [  shade_pkg::COORDINATE_W:0]      y_i,
  input  logic [1:0][  shade_pkg::COORDINATE_W:0] dx_i,
  input  logic [1:0][  shade_pkg::COORDINATE_W:0] dy_i,
  input  logic [1:0][       shade_pkg::DEPTH_F:0] ddepth_i,
  input  logic [1:0][ 3*shade_pkg::VERTEX_W+2:0]  dnormal_i,
  input  shade_pkg::corner_t                      corner_i,
  input  logic [3:0][   shade_pkg::LINE_W-1:0]    box_i,
  output logic                                    edge_valid_o,
  output shade_pkg::edge_t                        edge_o,
  output logic                                    pair_valid_o,
  output shade_pkg::pair_t                        pair_o,
  output logic                                    head_valid_o,
  input  logic                                    head_ready_i,
  output shade_pkg::sized_t                       head_o,
  output shade_pkg::fate_t                        told_o
);
  localparam int W = shade_pkg::COORDINATE_W;
  localparam int L_W = shade_pkg::LINE_W;
  localparam int N_W = shade_pkg::VERTEX_W + 1;
  localparam int Z_W = shade_pkg::DEPTH_F + 1;
  localparam int CROSS = 1 + shade_pkg::LATENCY_CROSS;
  localparam int PIXEL_W = shade_pkg::COUNT_W;

  // ---- first place: waits for the area ----------------------------------------------------------------------------------
  logic load, first_q, asked_q, release_first, large_i, large_q;
  logic [1:0][W:0] dx_q, dy_q;
  logic [1:0][Z_W-1:0] dz_q;
  logic [1:0][2:0][N_W-1:0] dn_q;
  shade_pkg::corner_t corner_q;
  logic [L_W-1:0] low_q, high_q, top_q, bottom_q;
  assign ready_o = !first_q;
  assign load    = valid_i && ready_o;
  always_comb begin
    large_i = 1'b0;
    for (int i = 0; i < 2; i++) begin
      if (dx_i[i][W:16] != {(W - 15) {dx_i[i][W]}} || dy_i[i][W:16] != {(W - 15) {dy_i[i][W]}}) large_i = 1'b1;
    end
  end
  function automatic logic [L_W-1:0] at_most(input logic [L_W-1:0] x, input logic [shade_pkg::COUNT_W-1:0] limit);
    at_most = $signed(x) < $signed(L_W'(limit)) ? x : L_W'(limit);
  endfunction
  always_ff @(posedge clk_i) begin
    if (load) begin
      {dx_q, dy_q, dz_q, dn_q} <= {dx_i, dy_i, ddepth_i, dnormal_i};
      corner_q                 <= corner_i;
      low_q                    <= box_i[1][L_W-1] ? '0 : box_i[1];
      high_q                   <= at_most(box_i[0], columns_i);
      top_q                    <= box_i[3][L_W-1] ? '0 : box_i[3];
      bottom_q                 <= at_most(box_i[2], lines_i);
      large_q                  <= large_i;
    end
    first_q <= !rst_i && (load || (first_q && !release_first));
  end
  logic edge_some, edge_step;
  shade_pkg::side_t side;
  shade_edges u_edges (
    .clk_i, .rst_i, .load_i(load), .x_i, .y_i, .some_o(edge_some), .step_i(edge_step), .side_o(side)
  );

  // ---- second place: the steps 0 to 2 are edges, 3 to 10 sums, column and line of each component in turn --------------------
  localparam int EDGES = 3;
  localparam int LAST = 10;
  logic start, second_q, c_minus_q, face, main, whole, done, final_step, known_q, minus_q, at_begin, drop;
  logic [3:0] step_q;
  shade_pkg::sized_t c_sized_q;
  logic [1:0][W:0] c_dx_q, c_dy_q;
  logic [1:0][Z_W-1:0] c_dz_q;
  logic [1:0][2:0][N_W-1:0] c_dn_q;
  logic [5:0] e, c_e_q;
  logic is_edge, is_line, is_depth;
  logic [1:0] part_q, face_part_q, parts, now;  // {upper part of the first factor, of the second} that is next
  assign is_edge    = step_q < 4'(EDGES);
  assign is_line    = !step_q[0];
  assign is_depth   = step_q[3] && step_q != 4'd8;
  assign at_begin   = part_q == {is_depth, c_sized_q.wide};
  assign face       = first_q && !asked_q && (!second_q || at_begin);
  assign final_step = step_q == 4'(LAST);
  assign main       = second_q && !face && !(final_step && head_valid_o);
  assign start      = known_q && edge_some && (!second_q || (done && final_step));
  assign parts      = face ? {2{large_q}} : is_edge ? {1'b0, large_q} : {is_depth, c_sized_q.wide};
  assign now        = face ? face_part_q : part_q;
  assign whole      = now == 2'b00;
  assign done       = main && whole;
  assign edge_step  = done && is_edge;
  assign release_first = (edge_step && step_q == 4'(EDGES - 1)) || drop;

  // the parts that come next: both upper ones first; at the end of a step those of the next one
  function automatic logic [1:0] following(input logic [1:0] x, input logic both);
    following = x[0] ? {x[1], 1'b0} : {1'b0, both};
  endfunction
  logic [3:0] next_step;
  logic next_depth;
  assign next_step  = step_q + 4'd1;
  assign next_depth = next_step[3] && next_step != 4'd8;
  always_ff @(posedge clk_i) begin
    if (load) face_part_q <= {2{large_i}};
    else if (face) face_part_q <= following(now, large_q);
    asked_q <= !load && (asked_q || (face && whole));

    if (start) begin
      step_q <= 4'd0;
      part_q <= {1'b0, large_q};
      {c_dx_q, c_dy_q, c_dz_q, c_dn_q} <= {dx_q, dy_q, dz_q, dn_q};
      {c_minus_q, c_e_q}               <= {minus_q, e};
      c_sized_q <= {large_q, bottom_q[PIXEL_W-1:0], high_q[PIXEL_W-1:0], low_q[PIXEL_W-1:0], corner_q};
    end else if (main) begin
      if (whole) step_q <= next_step;
      part_q <= whole ? {next_depth, c_sized_q.wide} : following(now, c_sized_q.wide);
    end
    second_q <= !rst_i && (start || (second_q && !(done && final_step)));
  end

  // ---- sums ----------------------------------------------------------------------------------------------------------------
  logic [3:0][17:0] factor;
  logic [1:0] comp;
  logic sum_first_q, shift_q, minus_sum_q;
  logic signed [shade_pkg::AREA_W:0] sum;
  assign comp = step_q[2:1] - 2'd1 - 2'(!step_q[0]);  // 3, 4 -> 0 ... 9, 10 -> 3
  shade_setup_factors u_factors (
    .clk_i, .face_i(face), .edge_i(is_edge), .line_i(is_line), .comp_i(comp), .now_i(now), .wide_i(parts),
    .face_dx_i(dx_q), .face_dy_i(dy_q), .dx_i(c_dx_q), .dy_i(c_dy_q), .dz_i(c_dz_q), .dn_i(c_dn_q), .side_i(side),
    .part_o(factor)
  );
  always_ff @(posedge clk_i) begin
    sum_first_q <= now == parts;
    shift_q     <= !now[0] && (parts[0] || !now[1]);
    minus_sum_q <= !face && !is_edge && (c_minus_q ^ is_line);
  end
  shade_cross u_cross (
    .clk_i, .first_i(sum_first_q), .shift_i(shift_q), .minus_i(minus_sum_q), .p_i(factor[0]), .q_i(factor[1]),
    .s_i(factor[2]), .t_i(factor[3]), .sum_o(sum)
  );

  // ---- what a sum is, when it is there ---------------------------------------------------------------------------------------
  logic area_now, edge_now, pair_now, line_now, begin_now;
  logic [5:0] e_now;
  shade_valid #(.DEPTH(CROSS)) u_area_now (.clk_i, .rst_i, .valid_i(face && whole), .valid_o(area_now));
  shade_valid #(.DEPTH(CROSS)) u_edge (.clk_i, .rst_i, .valid_i(edge_step), .valid_o(edge_now));
  shade_valid #(.DEPTH(CROSS)) u_pair (.clk_i, .rst_i, .valid_i(done && !is_edge), .valid_o(pair_now));
  shade_delay #(.WIDTH(2), .DEPTH(CROSS)) u_kind (
    .clk_i, .d_i({is_line, step_q == 4'(EDGES)}), .q_o({line_now, begin_now})
  );
  shade_delay #(.WIDTH(6), .DEPTH(CROSS)) u_e (
    .clk_i, .d_i(is_depth ? c_e_q + 6'(shade_pkg::DEPTH_DOWN) : c_e_q), .q_o(e_now)
  );

  // ---- the area: what becomes of the triangle -------------------------------------------------------------------------
  logic good, outside;
  logic [shade_pkg::RECIPROCAL_F-1:0] r, r_q;
  logic [2:0] wait_q;
  assign outside = $signed(high_q) <= $signed(low_q) || $signed(bottom_q) <= $signed(top_q);
  shade_setup_area u_area (
    .clk_i, .rst_i, .cull_i, .valid_i(area_now), .sum_i(sum), .outside_i(outside), .good_o(good), .drop_o(drop), .told_o,
    .minus_o(minus_q), .e_o(e), .r_o(r)
  );
  always_ff @(posedge clk_i) begin
    {known_q, wait_q} <= start ? 4'd0 : {known_q | wait_q[2], wait_q[1:0], good};
    if (rst_i) {known_q, wait_q} <= '0;
  end

  // ---- edges and increments -----------------------------------------------------------------------------------------
  localparam int SHAPE_W = $bits(edge_o) - shade_pkg::REST_W;
  logic [SHAPE_W-1:0] shape;
  logic begin_q1, begin_q2;
  shade_delay #(.WIDTH(SHAPE_W), .DEPTH(CROSS)) u_shape (
    .clk_i, .d_i({side.right ^ minus_q, side.lines, side.line, side.column, side.dy, side.dx}), .q_o(shape)
  );
  always_ff @(posedge clk_i) begin
    edge_valid_o         <= edge_now && !rst_i;
    edge_o               <= {shape, sum[shade_pkg::SUBPIXEL_F+:shade_pkg::REST_W]};
    {begin_q2, begin_q1} <= {begin_q1, begin_now};
    if (begin_q2) r_q <= r;
  end
  shade_gradient u_gradient (
    .clk_i, .rst_i, .valid_i(pair_now), .line_i(line_now), .sum_i(sum), .down_i(e_now), .r_i(r_q),
    .valid_o(pair_valid_o), .pair_o
  );

  // ---- the rest -------------------------------------------------------------------------------------------------------
  always_ff @(posedge clk_i) begin
    if (done && final_step) head_o <= c_sized_q;
    head_valid_o <= !rst_i && ((done && final_step) || (head_valid_o && !head_ready_i));
  end
endmodule
