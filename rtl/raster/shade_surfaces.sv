// SPDX-License-Identifier: Apache-2.0
// shade_surfaces: triangles of three vertices to packets TRIANGLE and RUN: a scan converter in front of shade_direct, shade_patch.
//
// s_axis_vertex: see shade_scan; m_axis_surface: see shade_packets. skipped_o: triangles without a packet, since reset.
// About 70 clocks from a third vertex to its packet. Example: golden.raster.scan, .packets.
module shade_surfaces (
  input  logic                                 clk_i,
  input  logic                                 rst_i,
  input  shade_pkg::view_t                     view_i,
  input  logic                                 s_axis_vertex_tvalid,
  output logic                                 s_axis_vertex_tready,
  input  logic [ shade_pkg::VERTEX_DATA_W-1:0] s_axis_vertex_tdata,
  input  logic                                 s_axis_vertex_tlast,
  output logic                                 m_axis_surface_tvalid,
  input  logic                                 m_axis_surface_tready,
  output logic [shade_pkg::SURFACE_DATA_W-1:0] m_axis_surface_tdata,
  output logic                                 m_axis_surface_tlast,
  output shade_pkg::skipped_t                  skipped_o
);
  logic surface_valid, surface_ready, run_valid, run_ready, begun_valid, begun_ready, unused_run;
  shade_pkg::surface_t surface;
  shade_pkg::walked_t run;
  shade_pkg::begun_t begun;
  shade_pkg::fate_t told;
  shade_scan u_scan (
    .clk_i, .rst_i, .view_i, .s_axis_vertex_tvalid, .s_axis_vertex_tready, .s_axis_vertex_tdata, .s_axis_vertex_tlast,
    .surface_valid_o(surface_valid), .surface_ready_i(surface_ready), .surface_o(surface), .run_valid_o(run_valid),
    .run_ready_i(run_ready), .run_o(run), .told_o(told)
  );
  shade_starts u_starts (
    .clk_i, .rst_i, .surface_valid_i(surface_valid), .surface_ready_o(surface_ready), .surface_i(surface),
    .run_valid_i(run_valid), .run_ready_o(run_ready), .run_i(run), .valid_o(begun_valid), .ready_i(begun_ready),
    .begun_o(begun)
  );
  shade_packets u_packets (
    .clk_i, .rst_i, .valid_i(begun_valid), .ready_o(begun_ready), .begun_i(begun), .m_axis_surface_tvalid,
    .m_axis_surface_tready, .m_axis_surface_tdata, .m_axis_surface_tlast, .run_o(unused_run)
  );
  shade_skipped u_skipped (.clk_i, .rst_i, .told_i(told), .skipped_o);
endmodule
