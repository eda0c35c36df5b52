// SPDX-License-Identifier: Apache-2.0
// shade_setup: checked triangles to edges, and to increments of normal and depth; culling; what has no area is left out.
//
// A triangle (valid_i, ready_o, see shade_vertices) waits in a first place until the sign of its area is known,
//
//   A = dx1 dy2 - dx2 dy1          told_o: A = 0, culled by cull_i (CULL_*), or its box holds no pixel of the frame
//
// then goes through a second one, from which three edges and eight sums are made, a product a clock:
//
//   edge_valid_o ...   three edges, as shade_raster takes them; rest_o: r of shade_edges, S27.0
//   pair_valid_o ...   increments per column and line of normal x, y, z, S10.29, and depth, S9.30, modulo 2^11, 2^10
//   head_valid_o ...   vertex 0, box, tag, mark: once a triangle, not before its first pair is under way
//
// Pairs and edges go into FIFOs that hold four triangles: with head_ready_i no more are on the way.
// A sum takes two products, four where differences of x or y do not fit 17 bits (256 pixels: wide).
// A triangle in 24 clocks, a wide one in 48, one that is left out in 8. Four multipliers (cross 2, gradient 2).
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
  localparam int N_W = shade_pkg::VERTEX_W + 1;
  localparam int Z_W = shade_pkg::DEPTH_F + 1;
  localparam int C_W = shade_pkg::COUNT_W;
  localparam int SUM = 1 + shade_pkg::LATENCY_CROSS;  // from a product's turn to its sum
  localparam int DIVIDED = 14;  // clocks from a good area until an increment may begin, so that it meets 1/A
  localparam int APART = 10;  // from there until another area may be begun, so that divisions are 19 clocks apart

  // ---- first place: waits for the area ----------------------------------------------------------------------------------
  logic load, first_q, asked_q, young_q, face_taken, release_first, large_i, large_q, outside;
  logic [1:0][W:0] dx_q, dy_q;
  logic [1:0][Z_W-1:0] dz_q;
  logic [1:0][2:0][N_W-1:0] dn_q;
  shade_pkg::corner_t corner_q;
  logic [C_W-1:0] left, right, bottom;
  assign ready_o = !first_q || release_first;
  assign load    = valid_i && ready_o;
  always_comb begin
    large_i = 1'b0;
    for (int i = 0; i < 2; i++) begin
      if (dx_i[i][W:16] != {(W - 15) {dx_i[i][W]}} || dy_i[i][W:16] != {(W - 15) {dy_i[i][W]}}) large_i = 1'b1;
    end
  end
  always_ff @(posedge clk_i) begin
    if (load) begin
      {dx_q, dy_q, dz_q, dn_q} <= {dx_i, dy_i, ddepth_i, dnormal_i};
      corner_q                 <= corner_i;
      large_q                  <= large_i;
    end
    first_q <= !rst_i && (load || (first_q && !release_first));
    asked_q <= face_taken || (asked_q && !load);
  end
  shade_setup_box u_box (
    .clk_i, .load_i(load), .box_i, .columns_i, .lines_i, .left_o(left), .right_o(right), .bottom_o(bottom), .outside_o(outside)
  );
  logic edge_some, edge_step;
  shade_pkg::side_t side;
  shade_edges u_edges (
    .clk_i, .rst_i, .load_i(load), .x_i, .y_i, .some_o(edge_some), .step_i(edge_step), .side_o(side)
  );

  // ---- second place: the steps 0 to 2 are edges, 3 to 10 sums, column and line of each component in turn --------------------
  localparam int EDGES = 3;
  localparam int LAST = 10;
  logic start, second_q, c_minus_q, done, final_step, known_q, minus_q, drop, stop, divided, divided_q;
  logic [3:0] step_q, next_step;
  logic [5:0] e, c_e_q;
  shade_pkg::sized_t c_sized_q;
  logic [1:0][W:0] c_dx_q, c_dy_q;
  logic [1:0][Z_W-1:0] c_dz_q;
  logic [1:0][2:0][N_W-1:0] c_dn_q;
  logic active, face, first, second, low, last, is_edge, is_line, is_depth;
  assign is_edge    = step_q < 4'(EDGES);
  assign is_line    = !step_q[0];
  assign is_depth   = step_q >= 4'(LAST - 1);
  assign final_step = step_q == 4'(LAST);
  assign done       = active && !face && last;
  assign next_step  = step_q + 4'(done);
  assign stop       = (next_step == 4'(LAST) && head_valid_o) || (next_step == 4'(EDGES) && !divided && !divided_q);
  assign start      = known_q && edge_some && (!second_q || (done && final_step));
  assign edge_step  = done && is_edge;
  assign release_first = (edge_step && step_q == 4'(EDGES - 1)) || drop;
  shade_setup_turns u_turns (
    .clk_i, .rst_i, .face_i((load || (first_q && !asked_q)) && !young_q), .face_wide_i(load ? large_i : large_q),
    .main_i(start || (second_q && !(done && final_step) && !stop)), .main_wide_i(start ? large_q : c_sized_q.wide),
    .taken_o(face_taken), .active_o(active), .face_o(face), .first_o(first), .second_o(second), .low_o(low), .last_o(last)
  );
  always_ff @(posedge clk_i) begin
    if (start) begin
      {c_dx_q, c_dy_q, c_dz_q, c_dn_q} <= {dx_q, dy_q, dz_q, dn_q};
      c_minus_q                        <= minus_q;
      c_sized_q                        <= {large_q, bottom, right, left, corner_q};
    end
    if (edge_step) c_e_q <= e;
    step_q   <= start ? 4'd0 : next_step;
    second_q <= !rst_i && (start || (second_q && !(done && final_step)));
  end

  // ---- sums ----------------------------------------------------------------------------------------------------------------
  logic [W:0] p;
  logic [17:0] q;
  logic first_q1, shift_q1, minus_q1;
  logic [1:0] comp;
  logic signed [shade_pkg::AREA_W:0] sum;
  assign comp = step_q[2:1] - 2'd1 - 2'(!step_q[0]);  // 3, 4 -> 0 ... 9, 10 -> 3
  shade_setup_factors u_factors (
    .clk_i, .face_i(face), .edge_i(is_edge), .line_i(is_line), .comp_i(comp), .second_i(second), .low_i(low),
    .wide_i(face ? large_q : c_sized_q.wide), .face_dx_i(dx_q), .face_dy_i(dy_q), .dx_i(c_dx_q), .dy_i(c_dy_q),
    .dz_i(c_dz_q), .dn_i(c_dn_q), .side_i(side), .p_o(p), .q_o(q)
  );
  always_ff @(posedge clk_i) begin
    first_q1 <= first;
    shift_q1 <= low && !second;
    minus_q1 <= second ^ (!face && !is_edge && (c_minus_q ^ is_line));
  end
  shade_cross u_cross (.clk_i, .first_i(first_q1), .shift_i(shift_q1), .minus_i(minus_q1), .p_i(p), .q_i(q), .sum_o(sum));

  // ---- what a sum is, when it is there ---------------------------------------------------------------------------------------
  logic area_now, edge_now, pair_now, line_now, begin_now;
  logic [5:0] e_now;
  shade_valid #(.DEPTH(SUM)) u_area_now (.clk_i, .rst_i, .valid_i(active && face && last), .valid_o(area_now));
  shade_valid #(.DEPTH(SUM)) u_edge (.clk_i, .rst_i, .valid_i(edge_step), .valid_o(edge_now));
  shade_valid #(.DEPTH(SUM)) u_pair (.clk_i, .rst_i, .valid_i(done && !is_edge), .valid_o(pair_now));
  shade_delay #(.WIDTH(2), .DEPTH(SUM)) u_kind (
    .clk_i, .d_i({is_line, done && step_q == 4'(EDGES)}), .q_o({line_now, begin_now})
  );
  shade_delay #(.WIDTH(6), .DEPTH(SUM)) u_e (
    .clk_i, .d_i(is_depth ? c_e_q + 6'(shade_pkg::DEPTH_DOWN) : c_e_q), .q_o(e_now)
  );

  // ---- the area: what becomes of the triangle -------------------------------------------------------------------------
  logic good, apart;
  logic [shade_pkg::RECIPROCAL_F-1:0] r, r_q;
  shade_setup_area u_area (
    .clk_i, .rst_i, .cull_i, .valid_i(area_now), .sum_i(sum), .outside_i(outside), .good_o(good), .drop_o(drop), .told_o,
    .minus_o(minus_q), .e_o(e), .r_o(r)
  );
  shade_valid #(.DEPTH(APART)) u_apart (.clk_i, .rst_i, .valid_i(good), .valid_o(apart));
  shade_valid #(.DEPTH(DIVIDED)) u_divided (.clk_i, .rst_i, .valid_i(good), .valid_o(divided));
  always_ff @(posedge clk_i) begin
    known_q   <= !rst_i && (good || (known_q && !start));
    young_q   <= !rst_i && (good || (young_q && !apart));
    divided_q <= !good && (divided || divided_q);
  end

  // ---- edges and increments -----------------------------------------------------------------------------------------
  localparam int SHAPE_W = $bits(edge_o) - shade_pkg::REST_W;
  logic [SHAPE_W-1:0] shape;
  logic begin_now3;
  shade_delay #(.WIDTH(SHAPE_W), .DEPTH(SUM)) u_shape (
    .clk_i, .d_i({side.right ^ minus_q, side.lines, side.line, side.column, side.dy, side.dx}), .q_o(shape)
  );
  shade_delay #(.WIDTH(1), .DEPTH(3)) u_begin (.clk_i, .d_i(begin_now), .q_o(begin_now3));
  always_ff @(posedge clk_i) begin
    edge_valid_o <= edge_now && !rst_i;
    edge_o       <= {shape, sum[shade_pkg::SUBPIXEL_F+:shade_pkg::REST_W]};
    if (begin_now3) r_q <= r;
  end
  shade_gradient u_gradient (
    .clk_i, .rst_i, .take_i(pair_now), .line_i(line_now), .sum_i(sum), .down_i(e_now), .r_i(r_q),
    .made_o(pair_valid_o), .pair_o
  );

  // ---- the rest -------------------------------------------------------------------------------------------------------
  always_ff @(posedge clk_i) begin
    if (done && final_step) head_o <= c_sized_q;
    head_valid_o <= !rst_i && ((done && final_step) || (head_valid_o && !head_ready_i));
  end
endmodule
