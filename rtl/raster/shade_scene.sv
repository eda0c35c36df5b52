// SPDX-License-Identifier: Apache-2.0
// shade_scene: triangles of three vertices to pictures: scan conversion, depth test, light at every pixel, frame buffer.
//
//   vertices ─▶ scan ─▶ depth ─▶ starts ─▶ packets ─▶ direct ─▶ colour ─▶ level ─▶ frame ─▶ m_axis_frame
//                         └──────────────── depths ────────────────────────────────┘
//
//   s_axis_vertex  see shade_scan. tuser bit 0, with a last vertex: the picture is complete, and shown as soon as it is drawn.
//                  tuser bit 1: a beat of the table of the lobe, tdata[63:0], see shade_direct; it waits until all is drawn
//   m_axis_frame   rows of pixels of 8 bits a channel, see shade_frame
//   view_i, l_i, h_i, colour_i, background_i   settings, see shade_scan, shade_direct, shade_colour, shade_frame: they must
//                  not change while a triangle is inside
//   skipped_o, error_o   what was left out since reset; what shade_direct tells
//
// Hidden pixels cost a clock each, and no light. A pixel a clock; about 150 clocks from a vertex to its first pixel in the frame.
// Example: golden.scene.scene.
module shade_scene #(
  parameter int COLUMNS_LOG2 = 8,
  parameter int LINES_LOG2   = 8,
  parameter int DOUBLE       = 0
) (
  input  logic                                 clk_i,
  input  logic                                 rst_i,
  input  shade_pkg::view_t                     view_i,
  input  shade_pkg::vec_t                      l_i,
  input  shade_pkg::vec_t                      h_i,
  input  shade_pkg::colour_t                   colour_i,
  input  shade_pkg::rgb8_t                     background_i,
  input  logic                                 s_axis_vertex_tvalid,
  output logic                                 s_axis_vertex_tready,
  input  logic [ shade_pkg::VERTEX_DATA_W-1:0] s_axis_vertex_tdata,
  input  logic [                          1:0] s_axis_vertex_tuser,
  input  logic                                 s_axis_vertex_tlast,
  output logic                                 m_axis_frame_tvalid,
  input  logic                                 m_axis_frame_tready,
  output shade_pkg::rgb8_t                     m_axis_frame_tdata,
  output logic                                 m_axis_frame_tuser,
  output logic                                 m_axis_frame_tlast,
  output shade_pkg::skipped_t                  skipped_o,
  output logic [shade_pkg::DIRECT_ERROR_W-1:0] error_o
);
  localparam int DATA_W = shade_pkg::SURFACE_DATA_W;
  localparam int W = shade_pkg::INTENSITY_W;

  // ---- what comes in: triangles, and beats of the table, between pictures -----------------------------------------------------
  logic vertex_ready, table_beat, table_ready, idle, complete_q, frame_ready, show_ready, take;
  assign table_beat = s_axis_vertex_tuser[1];
  assign take       = s_axis_vertex_tvalid && s_axis_vertex_tready && !table_beat && s_axis_vertex_tlast;
  assign s_axis_vertex_tready = !complete_q && (table_beat ? idle && table_ready : vertex_ready);
  always_ff @(posedge clk_i) begin
    complete_q <= !rst_i && ((take && s_axis_vertex_tuser[0]) || (complete_q && !(idle && show_ready)));
  end

  // ---- runs of pixels that are seen ---------------------------------------------------------------------------------------------
  logic surface_valid, surface_ready, run_valid, run_ready, seen_valid, seen_ready, seen_run_valid, seen_run_ready;
  logic ask, answer, write, ended, begun_valid, begun_ready;
  shade_pkg::surface_t surface, seen;
  shade_pkg::walked_t run, seen_run;
  shade_pkg::begun_t begun;
  shade_pkg::site_t asked;
  shade_pkg::deep_t deep;
  shade_pkg::fate_t told;
  logic [shade_pkg::DEPTH_F-1:0] known;
  shade_scan u_scan (
    .clk_i, .rst_i, .view_i, .s_axis_vertex_tvalid(s_axis_vertex_tvalid && !table_beat && !complete_q),
    .s_axis_vertex_tready(vertex_ready), .s_axis_vertex_tdata, .s_axis_vertex_tlast,
    .surface_valid_o(surface_valid), .surface_ready_i(surface_ready), .surface_o(surface), .run_valid_o(run_valid),
    .run_ready_i(run_ready), .run_o(run), .told_o(told)
  );
  shade_depth u_depth (
    .clk_i, .rst_i, .surface_valid_i(surface_valid), .surface_ready_o(surface_ready), .surface_i(surface),
    .run_valid_i(run_valid), .run_ready_o(run_ready), .run_i(run), .request_valid_o(ask), .request_ready_i(frame_ready),
    .request_o(asked), .answer_valid_i(answer), .answer_i(known), .write_valid_o(write), .write_o(deep),
    .surface_valid_o(seen_valid), .surface_ready_i(seen_ready), .surface_o(seen), .run_valid_o(seen_run_valid),
    .run_ready_i(seen_run_ready), .run_o(seen_run), .end_o(ended)
  );
  shade_starts u_starts (
    .clk_i, .rst_i, .surface_valid_i(seen_valid), .surface_ready_o(seen_ready), .surface_i(seen),
    .run_valid_i(seen_run_valid), .run_ready_o(seen_run_ready), .run_i(seen_run), .valid_o(begun_valid),
    .ready_i(begun_ready), .begun_o(begun)
  );

  // ---- light at every pixel ------------------------------------------------------------------------------------------------------
  logic packet_valid, packet_last, packet_run, direct_ready, lit, lit_last, unused_busy;
  logic [DATA_W-1:0] packet;
  logic [15:0] unused_count;
  logic [shade_pkg::TAG_W-1:0] unused_tag;
  shade_pkg::pixel_t light;
  shade_packets u_packets (
    .clk_i, .rst_i, .valid_i(begun_valid), .ready_o(begun_ready), .begun_i(begun), .m_axis_surface_tvalid(packet_valid),
    .m_axis_surface_tready(direct_ready), .m_axis_surface_tdata(packet), .m_axis_surface_tlast(packet_last),
    .run_o(packet_run)
  );
  logic from_table;
  assign from_table  = s_axis_vertex_tvalid && table_beat && idle && !complete_q;
  assign table_ready = direct_ready;
  shade_direct u_direct (
    .clk_i, .rst_i, .l_i, .h_i, .s_axis_surface_tvalid(packet_valid || from_table), .s_axis_surface_tready(direct_ready),
    .s_axis_surface_tdata(from_table ? s_axis_vertex_tdata[DATA_W-1:0] : packet),
    .s_axis_surface_tlast(from_table ? s_axis_vertex_tlast : packet_last), .m_axis_pixel_tvalid(lit),
    .m_axis_pixel_tready(1'b1), .m_axis_pixel_tdata(light), .m_axis_pixel_tuser(unused_tag),
    .m_axis_pixel_tlast(lit_last), .busy_o(unused_busy), .error_o, .error_count_o(unused_count)
  );

  // ---- colour, place, frame ------------------------------------------------------------------------------------------------------
  shade_pkg::site_t begun_site, lit_site, site;
  shade_pkg::intensity_t shown;
  shade_pkg::coloured_t colour;
  shade_pkg::rgb8_t pixel;
  logic coloured;
  shade_scene_sites u_sites (
    .clk_i, .rst_i, .run_valid_i(packet_valid && direct_ready && packet_run), .site_i(begun_site), .step_i(lit),
    .last_i(lit_last), .site_o(lit_site)
  );
  assign begun_site = {begun.run.line, begun.run.column};
  shade_delay #(.WIDTH($bits(site)), .DEPTH(shade_pkg::LATENCY_COLOUR)) u_site (.clk_i, .d_i(lit_site), .q_o(site));
  assign shown.diffuse  = W'(light.diffuse);
  assign shown.specular = W'(light.specular);
  shade_colour u_colour (.clk_i, .light_i(shown), .colour_i, .pixel_o(colour));
  shade_valid #(.DEPTH(shade_pkg::LATENCY_COLOUR)) u_coloured (.clk_i, .rst_i, .valid_i(lit), .valid_o(coloured));
  shade_scene_level u_level (.colour_i(colour), .pixel_o(pixel));
  shade_frame #(
    .COLUMNS_LOG2(COLUMNS_LOG2), .LINES_LOG2(LINES_LOG2), .DATA_W($bits(pixel)), .DOUBLE(DOUBLE)
  ) u_frame (
    .clk_i, .rst_i, .view_i, .background_i, .ready_o(frame_ready), .request_valid_i(ask && frame_ready), .request_i(asked),
    .answer_valid_o(answer), .answer_o(known), .write_valid_i(write), .write_i(deep), .pixel_valid_i(coloured),
    .site_i(site), .pixel_i(pixel), .show_i(complete_q && idle), .show_ready_o(show_ready), .m_axis_frame_tvalid,
    .m_axis_frame_tready, .m_axis_frame_tdata, .m_axis_frame_tuser, .m_axis_frame_tlast
  );

  // ---- is anything inside: triangles on their way to the depth test, pixels behind it -------------------------------------------------
  shade_scene_idle u_idle (
    .clk_i, .rst_i, .take_i(take), .told_i(told), .end_i(ended),
    .run_valid_i(seen_run_valid && seen_run_ready && !seen_run.none), .count_i(seen_run.count), .pixel_i(coloured),
    .busy_i(seen_run_valid || begun_valid), .idle_o(idle)
  );
  shade_skipped u_skipped (.clk_i, .rst_i, .told_i(told), .skipped_o);
endmodule
