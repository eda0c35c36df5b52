// SPDX-License-Identifier: Apache-2.0
// shade_scan: triangles of three vertices to surfaces and their runs: set-up, culling, scan conversion.
//
// s_axis_vertex: packet VERTEX, three beats a triangle. surface_o, run_o: see shade_plane; the runs of a surface follow
// it, line by line, the last one marked. told_o: what is skipped, a bit for a clock each. view_i: settings, to be changed
// between frames only.
// A triangle in 24 clocks, a line in one and one a column that an edge moves aside. Six multipliers.
// Example: golden.raster.scan.
module shade_scan (
  input  logic                                clk_i,
  input  logic                                rst_i,
  input  shade_pkg::view_t                    view_i,
  input  logic                                s_axis_vertex_tvalid,
  output logic                                s_axis_vertex_tready,
  input  logic [shade_pkg::VERTEX_DATA_W-1:0] s_axis_vertex_tdata,
  input  logic                                s_axis_vertex_tlast,
  output logic                                surface_valid_o,
  input  logic                                surface_ready_i,
  output shade_pkg::surface_t                 surface_o,
  output logic                                run_valid_o,
  input  logic                                run_ready_i,
  output shade_pkg::walked_t                  run_o,
  output shade_pkg::fate_t                    told_o
);
  localparam int W = shade_pkg::COORDINATE_W;
  logic whole_valid, whole_ready;
  logic [W:0] x, y;
  logic [1:0][W:0] dx, dy;
  logic [1:0][shade_pkg::DEPTH_F:0] ddepth;
  logic [1:0][3*shade_pkg::VERTEX_W+2:0] dnormal;
  logic [3:0][shade_pkg::LINE_W-1:0] box;
  shade_pkg::corner_t corner;
  shade_pkg::fate_t vertices_told;
  shade_vertices u_vertices (
    .clk_i, .rst_i, .flat_i(view_i.flat), .s_axis_vertex_tvalid, .s_axis_vertex_tready, .s_axis_vertex_tdata, .s_axis_vertex_tlast,
    .valid_o(whole_valid), .ready_i(whole_ready), .x_o(x), .y_o(y), .dx_o(dx), .dy_o(dy), .ddepth_o(ddepth),
    .dnormal_o(dnormal), .corner_o(corner), .box_o(box), .told_o(vertices_told)
  );

  logic edge_valid, pair_valid, head_valid, head_ready;
  shade_pkg::edge_t edge_made;
  shade_pkg::pair_t pair;
  shade_pkg::sized_t head;
  shade_pkg::fate_t setup_told;
  shade_setup u_setup (
    .clk_i, .rst_i, .cull_i(view_i.cull), .columns_i(view_i.columns), .lines_i(view_i.lines), .valid_i(whole_valid), .ready_o(whole_ready), .x_i(x), .y_i(y),
    .dx_i(dx), .dy_i(dy), .ddepth_i(ddepth), .dnormal_i(dnormal), .corner_i(corner), .box_i(box),
    .edge_valid_o(edge_valid), .edge_o(edge_made), .pair_valid_o(pair_valid), .pair_o(pair),
    .head_valid_o(head_valid), .head_ready_i(head_ready), .head_o(head), .told_o(setup_told)
  );

  shade_pkg::fate_t plane_told;
  logic edge_some, edge_ready, unused_edge, walked_valid, walked_credit;
  shade_pkg::edge_t edge_next;
  shade_pkg::walked_t walked;
  shade_fifo #(.WIDTH($bits(edge_made)), .LOG2(6), .BLOCK(1)) u_edges (
    .clk_i, .rst_i, .valid_i(edge_valid), .data_i(edge_made), .valid_o(edge_some), .ready_i(edge_ready),
    .data_o(edge_next), .taken_o(unused_edge)
  );
  shade_raster u_raster (
    .clk_i, .rst_i, .columns_i(view_i.columns), .lines_i(view_i.lines), .edge_valid_i(edge_some), .edge_ready_o(edge_ready), .edge_i(edge_next),
    .valid_o(walked_valid), .run_o(walked), .credit_i(walked_credit)
  );
  shade_plane u_plane (
    .clk_i, .rst_i, .pair_valid_i(pair_valid), .pair_i(pair), .head_valid_i(head_valid), .head_ready_o(head_ready),
    .head_i(head), .run_valid_i(walked_valid), .run_i(walked), .run_credit_o(walked_credit), .surface_valid_o,
    .surface_ready_i, .surface_o, .run_valid_o, .run_ready_i, .run_o, .told_o(plane_told)
  );
  assign told_o = vertices_told | setup_told | plane_told;
endmodule
