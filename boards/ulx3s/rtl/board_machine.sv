// SPDX-License-Identifier: Apache-2.0
// board_machine: a head that turns, 60 pictures a second of 640 x 480: everything between buttons and symbols of DVI.
//
//   board_rotate ─▶ board_triangles ─▶ shade_spans ─▶ shade_core ─▶ board_pixels ─▶ board_frame ─▶ board_picture ─▶ board_tmds
//                       board_settings ───────────────────▲
//
// A picture: settings are written, the back buffer is cleared, vertices are turned, triangles drawn; when the beam has left the
// picture that is shown, buffers change places and the head turns by one of 256 steps. Buttons count where they are pressed in
// one picture and were not in the one before: model_i the next of four models, level_i the next of four shininesses.
// All in one clock of 25 MHz. Example: after reset Blinn-Phong with n = 32.
module board_machine #(
  parameter int VERTEX_COUNT   = 512,
  parameter int TRIANGLE_COUNT = 1000
) (
  input  logic       clk_i,
  input  logic       rst_i,
  input  logic       model_i,
  input  logic       level_i,
  output logic [9:0] red_o,
  output logic [9:0] green_o,
  output logic [9:0] blue_o,
  output logic [7:0] told_o
);
  localparam int PIXELS = 320 * 240;
  localparam int QUIET = 2047;  // clocks without a span after which none comes: more than any triangle takes on its way

  // ---- the beam ---------------------------------------------------------------------------------------------------
  logic [9:0] column, line;
  logic shown, hsync, vsync, frame;
  board_timing u_timing (
    .clk_i, .rst_i, .column_o(column), .line_o(line), .shown_o(shown), .hsync_o(hsync), .vsync_o(vsync), .frame_o(frame)
  );

  // ---- a picture, step by step ------------------------------------------------------------------------------------
  typedef enum logic [2:0] {SET, CLEAR, TURN, DRAW, DRAIN, SHOW} state_t;
  state_t state_q;
  logic start_q, back_q, model_q, level_q, set_busy, turn_busy, send_busy, draw_busy, span, next;
  logic [7:0] angle_q, drawn_q;
  logic [1:0] models_q, levels_q;
  logic [16:0] clear_q;
  logic [10:0] quiet_q;
  always_comb begin
    case (state_q)
      SET: next = !set_busy;
      CLEAR: next = clear_q == 17'(PIXELS - 1);
      TURN: next = !turn_busy;
      DRAW: next = !send_busy;
      DRAIN: next = quiet_q == 11'(QUIET);
      default: next = frame;
    endcase
  end
  always_ff @(posedge clk_i) begin
    start_q <= next && !start_q;
    if (next && !start_q) state_q <= state_q == SHOW ? SET : state_t'(state_q + 3'd1);
    clear_q <= state_q == CLEAR ? clear_q + 17'd1 : '0;
    quiet_q <= state_q != DRAIN || span || draw_busy ? '0 : quiet_q + 11'd1;
    if (state_q == SHOW && next && !start_q) begin
      back_q   <= !back_q;
      angle_q  <= angle_q + 8'd1;
      drawn_q  <= drawn_q + 8'd1;
      model_q  <= model_i;
      level_q  <= level_i;
      models_q <= models_q + 2'(model_i && !model_q);
      levels_q <= levels_q + 2'(level_i && !level_q);
    end
    if (rst_i) begin
      state_q <= SET;
      start_q <= 1'b1;
      {back_q, angle_q, drawn_q, model_q, level_q} <= '0;
      models_q <= 2'd0;
      levels_q <= 2'd1;
    end
  end
  assign told_o = {models_q, levels_q, drawn_q[3:0]};

  // ---- vertices, triangles, spans ---------------------------------------------------------------------------------
  logic [9:0] read;
  logic [96:0] corner;
  board_rotate #(.COUNT(VERTEX_COUNT)) u_rotate (
    .clk_i, .rst_i, .start_i(start_q && state_q == TURN), .angle_i(angle_q), .busy_o(turn_busy), .read_i(read),
    .corner_o(corner)
  );
  logic vertex_valid, vertex_ready, vertex_last;
  logic [shade_pkg::VERTEX_DATA_W-1:0] vertex;
  board_triangles #(.COUNT(TRIANGLE_COUNT)) u_triangles (
    .clk_i, .rst_i, .start_i(start_q && state_q == DRAW), .busy_o(send_busy), .read_o(read), .corner_i(corner),
    .m_axis_vertex_tvalid(vertex_valid), .m_axis_vertex_tready(vertex_ready), .m_axis_vertex_tdata(vertex),
    .m_axis_vertex_tlast(vertex_last)
  );
  logic span_valid, span_ready, room, core_ready;
  logic [shade_pkg::SPAN_DATA_W-1:0] span_data;
  shade_pkg::spot_t spot;
  shade_pkg::view_t view;
  shade_pkg::skipped_t unused_skipped;
  always_comb begin
    view         = '0;
    view.columns = shade_pkg::COUNT_W'(320);
    view.lines   = shade_pkg::COUNT_W'(240);
    view.cull    = shade_pkg::CULL_W'(shade_pkg::CULL_BACK);
  end
  shade_spans u_spans (
    .clk_i, .rst_i, .view_i(view), .s_axis_vertex_tvalid(vertex_valid), .s_axis_vertex_tready(vertex_ready),
    .s_axis_vertex_tdata(vertex), .s_axis_vertex_tlast(vertex_last), .m_axis_span_tvalid(span_valid),
    .m_axis_span_tready(span_ready), .m_axis_span_tdata(span_data), .m_axis_span_tuser(spot),
    .skipped_o(unused_skipped)
  );
  assign span_ready = core_ready && room;
  assign span       = span_valid && span_ready;

  // ---- light ------------------------------------------------------------------------------------------------------
  logic awvalid, awready, wvalid, wready, bvalid, pixel_valid, pixel_ready, pixel_last, unused_idle, unused_irq;
  logic unused_arready, unused_rvalid;
  logic [11:0] offset;
  logic [31:0] word, unused_rdata;
  logic [1:0] unused_bresp, unused_rresp;
  logic [15:0] unused_tag;
  logic [shade_pkg::PIXEL_DATA_W-1:0] pixel;
  board_settings u_settings (
    .clk_i, .rst_i, .start_i(start_q && state_q == SET), .choice_i({1'b0, models_q, levels_q}), .busy_o(set_busy),
    .awvalid_o(awvalid), .awready_i(awready), .wvalid_o(wvalid), .wready_i(wready), .bvalid_i(bvalid),
    .offset_o(offset), .word_o(word)
  );
  shade_core #(.PATH_NORMALS(0), .BURST(1)) u_core (
    .clk_i, .rst_i, .s_axis_span_tvalid(span_valid && room), .s_axis_span_tready(core_ready),
    .s_axis_span_tdata(span_data), .s_axis_span_tkeep('1), .s_axis_span_tlast(1'b1), .m_axis_pixel_tvalid(pixel_valid),
    .m_axis_pixel_tready(pixel_ready), .m_axis_pixel_tdata(pixel), .m_axis_pixel_tuser(unused_tag),
    .m_axis_pixel_tlast(pixel_last), .s_axil_awvalid(awvalid), .s_axil_awready(awready), .s_axil_awaddr(offset),
    .s_axil_awprot(3'b000), .s_axil_wvalid(wvalid), .s_axil_wready(wready), .s_axil_wdata(word), .s_axil_wstrb(4'b1111),
    .s_axil_bvalid(bvalid), .s_axil_bready(1'b1), .s_axil_bresp(unused_bresp), .s_axil_arvalid(1'b0),
    .s_axil_arready(unused_arready), .s_axil_araddr(12'd0), .s_axil_arprot(3'b000), .s_axil_rvalid(unused_rvalid),
    .s_axil_rready(1'b1), .s_axil_rdata(unused_rdata), .s_axil_rresp(unused_rresp), .idle_o(unused_idle),
    .irq_o(unused_irq)
  );

  // ---- frame buffer -----------------------------------------------------------------------------------------------
  logic [16:0] at, show_q;
  logic [10:0] old, depth;
  logic [11:0] light, shown_light;
  logic write;
  board_pixels u_pixels (
    .clk_i, .rst_i, .span_i(span), .spot_i(spot), .room_o(room), .s_axis_pixel_tvalid(pixel_valid),
    .s_axis_pixel_tready(pixel_ready), .s_axis_pixel_tdata(pixel), .s_axis_pixel_tlast(pixel_last), .at_o(at),
    .depth_i(old), .write_o(write), .depth_o(depth), .light_o(light), .busy_o(draw_busy)
  );
  board_frame #(.PIXELS(PIXELS)) u_frame (
    .clk_i, .back_i(back_q), .at_i(at), .write_i(write), .depth_i(depth), .light_i(light), .clear_i(state_q == CLEAR),
    .clear_at_i(clear_q), .depth_o(old), .show_i(show_q), .light_o(shown_light)
  );

  // ---- colours, symbols: everything that goes beside the pixel is as late as it -------------------------------------
  localparam int LATE = 1 + 2 + shade_pkg::LATENCY_COLOUR;
  logic [23:0] rgb;
  logic unused_bits;
  assign unused_bits = &{1'b0, line[9], line[0], column[0]};
  logic late_shown, late_hsync, late_vsync;
  always_ff @(posedge clk_i) begin
    show_q <= shown ? 17'({line[8:1], 8'd0}) + 17'({line[8:1], 6'd0}) + 17'(column[9:1]) : '0;
  end
  board_picture u_picture (.clk_i, .rst_i, .light_i(shown_light), .rgb_o(rgb));
  shade_delay #(.WIDTH(3), .DEPTH(LATE)) u_late (
    .clk_i, .d_i({shown, hsync, vsync}), .q_o({late_shown, late_hsync, late_vsync})
  );
  board_tmds u_red (.clk_i, .shown_i(late_shown), .data_i(rgb[23:16]), .control_i(2'b00), .symbol_o(red_o));
  board_tmds u_green (.clk_i, .shown_i(late_shown), .data_i(rgb[15:8]), .control_i(2'b00), .symbol_o(green_o));
  board_tmds u_blue (
    .clk_i, .shown_i(late_shown), .data_i(rgb[7:0]), .control_i({late_vsync, late_hsync}), .symbol_o(blue_o)
  );
endmodule
