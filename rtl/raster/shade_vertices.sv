// SPDX-License-Identifier: Apache-2.0
// shade_vertices: packets of three vertices to triangles, with every number checked.
//
// s_axis_vertex: packet VERTEX, one vertex a beat, tlast with the third. Words of 32 bits: x, y S15.8, depth U0.24,
// normal x, y, z S0.16, {flat, tag}. A packet of
// fewer or more than three beats, with a number out of its range or a normal of length 0 is told in one clock, told_o, and gives
// no triangle; the next packet is unharmed.
//
// A triangle: x_o, y_o of vertex 0, and in the two clocks behind its transfer of 1 and 2, each plus 127, so that its integer part is the first column or line whose centre is not
// left of it or above; corner_o, vertex 0, likewise; of vertices 2 and 1 the differences to it: dx_o, dy_o, ddepth_o S.25,
// dnormal_o S1.16 (z, y, x of 2, then of 1), 0 with flat_i. box_o: the
// least and greatest of first columns and lines at or behind a vertex, {low line, high line, low column, high column}.
// Latency 3 clocks from the third beat; a triangle in 5 clocks. No path from ready_i to tready.
// Example: vertices (128, 128), (2688, 128), (128, 2688): columns 0 .. 10, dx_o = {0, 2560}.
module shade_vertices (
  input  logic                                clk_i,
  input  logic                                rst_i,
  input  logic                                flat_i,
  input  logic                                s_axis_vertex_tvalid,
  output logic                                s_axis_vertex_tready,
  input  logic [shade_pkg::VERTEX_DATA_W-1:0] s_axis_vertex_tdata,
  input  logic                                s_axis_vertex_tlast,
  output logic                                valid_o,
  input  logic                                ready_i,
  output logic [  shade_pkg::COORDINATE_W:0]  x_o,
  output logic [  shade_pkg::COORDINATE_W:0]  y_o,
  output logic [                       1:0][  shade_pkg::COORDINATE_W:0] dx_o,
  output logic [                       1:0][  shade_pkg::COORDINATE_W:0] dy_o,
  output logic [                       1:0][       shade_pkg::DEPTH_F:0] ddepth_o,
  output logic [                       1:0][ 3*shade_pkg::VERTEX_W+2:0] dnormal_o,
  output shade_pkg::corner_t                  corner_o,
  output logic [                       3:0][   shade_pkg::LINE_W-1:0] box_o,
  output shade_pkg::fate_t                    told_o
);
  localparam int W = shade_pkg::COORDINATE_W;
  localparam int N_W = shade_pkg::VERTEX_W;
  localparam int Z_W = shade_pkg::DEPTH_F;
  localparam int L_W = shade_pkg::LINE_W;
  localparam int HALF = (1 << shade_pkg::SUBPIXEL_F) / 2;

  // ---- a beat: what is used of it, and what is wrong with it --------------------------------------------------------
  logic beat_q, last_q, range_q, zero_q, take, move;
  logic [W:0] x_q, y_q;
  logic [Z_W-1:0] z_q;
  logic [2:0][N_W-1:0] n_q;
  logic [shade_pkg::TAG_W:0] tag_q;
  logic [7:0][31:0] word;
  logic [2:0] odd;  // normals out of range
  assign word = s_axis_vertex_tdata;
  assign take = s_axis_vertex_tvalid && s_axis_vertex_tready;
  for (genvar i = 0; i < 3; i++) begin : g_odd
    assign odd[i] = word[3+i][31:N_W-1] != {(33 - N_W) {word[3+i][31]}};
  end
  logic unused_word;
  assign unused_word = ^{word[7], word[6][31:shade_pkg::TAG_W+1]};
  always_ff @(posedge clk_i) begin
    if (take) begin
      x_q        <= {word[0][W-1], word[0][W-1:0]} + (W + 1)'(HALF - 1);
      y_q        <= {word[1][W-1], word[1][W-1:0]} + (W + 1)'(HALF - 1);
      z_q        <= word[2][Z_W-1:0];
      n_q        <= {word[5][N_W-1:0], word[4][N_W-1:0], word[3][N_W-1:0]};
      tag_q      <= word[6][shade_pkg::TAG_W:0];
      last_q     <= s_axis_vertex_tlast;
      range_q    <= |odd || word[2][31:Z_W] != '0 || word[0][31:W-1] != {(33 - W) {word[0][31]}}
                    || word[1][31:W-1] != {(33 - W) {word[1][31]}};
      zero_q     <= {word[5], word[4], word[3]} == '0;
    end
    beat_q <= !rst_i && (take || (beat_q && !move));
  end

  // ---- the triangle: which vertex is at hand, what is wrong so far ---------------------------------------------------
  logic [1:0] index_q;  // 3: of a packet that is too long
  logic bad_range_q, bad_zero_q, bad_range, bad_zero, full_q, end_beat, whole;
  assign move       = beat_q && !full_q;
  assign whole      = index_q == 2'd2 && last_q;
  assign end_beat   = move && last_q;
  assign bad_range  = range_q || (bad_range_q && index_q != 2'd0);
  assign bad_zero   = zero_q || (bad_zero_q && index_q != 2'd0);
  assign valid_o    = full_q;
  assign s_axis_vertex_tready = !full_q && !(beat_q && whole);
  always_ff @(posedge clk_i) begin
    if (move) begin
      index_q     <= last_q ? 2'd0 : index_q == 2'd3 ? 2'd3 : index_q + 2'd1;
      bad_range_q <= bad_range;
      bad_zero_q  <= bad_zero;
    end
    full_q         <= full_q ? !ready_i : end_beat && whole && !bad_range && !bad_zero;
    told_o        <= '0;
    told_o.packet <= end_beat && !whole;
    told_o.range  <= end_beat && whole && bad_range;
    told_o.normal <= end_beat && whole && !bad_range && bad_zero;
    if (rst_i) begin
      index_q <= 2'd0;
      full_q  <= 1'b0;
      told_o  <= '0;
    end
  end

  // ---- vertex 0, and the differences to it -----------------------------------------------------------------------------
  logic [2:0][W:0] x, y;
  logic [W:0] dx, dy;
  logic given_q;
  logic [Z_W:0] dz;
  logic [2:0][N_W:0] dn;
  logic [2:0][N_W-1:0] base;
  assign base = corner_o.normal;
  assign dx   = x_q - corner_o.x;
  assign dy   = y_q - corner_o.y;
  assign {y_o, x_o} = {y[0], x[0]};
  assign dz   = {1'b0, z_q} - {1'b0, corner_o.depth};
  for (genvar i = 0; i < 3; i++) begin : g_dn
    assign dn[i] = {n_q[i][N_W-1], n_q[i]} - {base[i][N_W-1], base[i]};
  end
  always_ff @(posedge clk_i) begin
    given_q <= valid_o && ready_i;
    if (move || given_q || (valid_o && ready_i)) begin
      x <= {x_q, x[2:1]};
      y <= {y_q, y[2:1]};
    end
    if (move && index_q == 2'd0) begin
      corner_o         <= {tag_q, z_q, n_q, y_q, x_q};
    end
    for (int i = 0; i < 2; i++) begin
      if (move && index_q == 2'(i + 1)) begin
        {dy_o[i], dx_o[i]}   <= {dy, dx};
        ddepth_o[i]          <= dz;
        dnormal_o[i]         <= flat_i ? '0 : dn;
      end
    end
  end

  // ---- the box of all pixels that may be covered: a column or line whose centre is at or behind a vertex ----------------
  logic [L_W-1:0] column_q, line_q;
  assign column_q = x_q[W-:L_W];
  assign line_q   = y_q[W-:L_W];
  always_ff @(posedge clk_i) begin
    if (move && (index_q == 2'd0 || $signed(line_q) < $signed(box_o[3]))) box_o[3] <= line_q;
    if (move && (index_q == 2'd0 || $signed(line_q) > $signed(box_o[2]))) box_o[2] <= line_q;
    if (move && (index_q == 2'd0 || $signed(column_q) < $signed(box_o[1]))) box_o[1] <= column_q;
    if (move && (index_q == 2'd0 || $signed(column_q) > $signed(box_o[0]))) box_o[0] <= column_q;
  end
endmodule
