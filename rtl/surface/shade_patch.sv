// SPDX-License-Identifier: Apache-2.0
// shade_patch: triangles and their runs in, pixels out: light at six nodes of a box, a polynomial of two variables between them.
//
//   surface ─▶ boxes ─┬─▶ lights ─┬─ pixels ──────────┐
//                     └─ tokens ──┴─▶ pieces ─▶ deal ─▶ lanes ─▶ pixels
//
//   s_axis_surface   packets TRIANGLE and RUN of docs/interface.md, or LOBE and CHORD while no pixel is inside
//   l_i .. reach_i   settings of the draw call, see golden.patch.registers, of LIGHTS directional lights: must not change while
//                    a triangle is inside; the excess of a LOBE counts for nothing
//   m_axis_pixel     a stream for each lane. tdata = {specular, diffuse}, U0.16; tuser = {line, column, tag}; tlast: the last pixel
//                    of a piece: pixels of one line of one box, from left to right; a pixel that is lit directly is a piece
//   error_o          what came in and was dropped: see shade_patch_door, since reset; error_count_o how often
//   flags_o          bits PATCH_LIGHT_* since reset: light that is not exact
//
// Order: boxes of a triangle row by row, in a box line by line; a piece waits for one half of the lanes, where less wait, and goes to
// the first of them that is free, a pixel that is lit directly to the last one, so the order depends on the consumers; each pixel
// tells its place.
// Full back-pressure: every stage stops for want of room in the FIFO behind it; no path leads from an input to an output.
// LANES pixels a clock as long as pieces are long enough: at most a piece made and two dealt, a node, two lines of a box a clock. Latency from a
// small triangle's first beat to its first pixel: about 110 clocks.
// Source: P1 in two dimensions, P4's constant increment. Example: a triangle with N = L = H everywhere -> all pixels full light.
module shade_patch #(
  parameter int LANES  = 1,
  parameter int LIGHTS = 1
) (
  input  logic                                       clk_i,
  input  logic                                       rst_i,
  input  logic [LIGHTS*3*shade_pkg::INTENSITY_W-1:0] l_i,
  input  logic [LIGHTS*3*shade_pkg::INTENSITY_W-1:0] h_i,
  input  logic [     LIGHTS*shade_pkg::EXCESS_W-1:0] excess_i,
  input  logic [         shade_pkg::INTENSITY_F-1:0] radius_i,
  input  logic [       shade_pkg::PATCH_REACH_W-1:0] reach_i,
  input  logic                                       s_axis_surface_tvalid,
  output logic                                       s_axis_surface_tready,
  input  logic [      shade_pkg::SURFACE_DATA_W-1:0] s_axis_surface_tdata,
  input  logic                                       s_axis_surface_tlast,
  output logic [                          LANES-1:0] m_axis_pixel_tvalid,
  input  logic [                          LANES-1:0] m_axis_pixel_tready,
  output logic [  LANES*shade_pkg::PIXEL_DATA_W-1:0] m_axis_pixel_tdata,
  output logic [  LANES*shade_pkg::PATCH_USER_W-1:0] m_axis_pixel_tuser,
  output logic [                          LANES-1:0] m_axis_pixel_tlast,
  output logic [             shade_pkg::ERROR_W-1:0] error_o,
  output logic [                               15:0] error_count_o,
  output logic [       shade_pkg::PATCH_FLAGS_W-1:0] flags_o
);
  if (LANES != 1 && LANES != 2 && LANES != 4 && LANES != 8) begin : g_check
    $error("shade_patch: LANES must be 1, 2, 4 or 8");
  end

  localparam int PIXEL_W = shade_pkg::PIXEL_DATA_W;
  localparam int USER_W = shade_pkg::PATCH_USER_W;

  // ---- boxes and the light in them -----------------------------------------------------------------------------------------------
  logic beat_valid, beat_ready, plan_valid, plan_ready, done, place_valid, place_ready, box_valid, box_ready, token_valid, token_ready;
  logic light_valid, light_ready, meta_valid, meta_ready, single_valid, single_ready, table_write;
  logic [shade_pkg::SURFACE_DATA_W-1:0] beat;
  logic [5:0] plan;
  logic [shade_pkg::PATCH_PLACE_W-1:0] place;
  logic [shade_pkg::PATCH_BOX_W-1:0] box;
  logic [2*shade_pkg::PATCH_TOKEN_W-1:0] token;
  logic [shade_pkg::CHORD_INDEX_W-1:0] table_at;
  shade_pkg::chord_t chord;
  logic [shade_pkg::CHORD_SHIFT_W-1:0] shift;
  logic [2*shade_pkg::INTENSITY_W-1:0] light;
  logic [shade_pkg::PATCH_META_W-2:0] meta;
  logic [USER_W+PIXEL_W-1:0] single;
  logic [shade_pkg::ERROR_W-1:0] error;
  logic [shade_pkg::PATCH_FLAGS_W-1:0] flags;
  shade_patch_boxes #(.LIGHTS(LIGHTS)) u_boxes (
    .clk_i, .rst_i, .h_i, .radius_i, .reach_i, .s_axis_surface_tvalid, .s_axis_surface_tready, .s_axis_surface_tdata,
    .s_axis_surface_tlast, .beat_valid_o(beat_valid), .beat_ready_i(beat_ready), .beat_o(beat), .plan_valid_o(plan_valid),
    .plan_ready_i(plan_ready), .plan_o(plan), .done_i(done), .place_valid_o(place_valid), .place_ready_i(place_ready),
    .place_o(place), .box_valid_o(box_valid), .box_ready_i(box_ready), .box_o(box), .token_valid_o(token_valid),
    .token_ready_i(token_ready), .token_o(token), .table_write_o(table_write), .table_at_o(table_at), .table_o(chord),
    .shift_o(shift), .error_o(error)
  );
  shade_patch_lights #(.LIGHTS(LIGHTS)) u_lights (
    .clk_i, .rst_i, .l_i, .h_i, .excess_i, .shift_i(shift), .table_write_i(table_write), .table_at_i(table_at),
    .table_i(chord), .beat_valid_i(beat_valid), .beat_ready_o(beat_ready), .beat_i(beat), .plan_valid_i(plan_valid),
    .plan_ready_o(plan_ready), .plan_i(plan), .done_o(done), .place_valid_i(place_valid), .place_ready_o(place_ready),
    .place_i(place), .box_valid_i(box_valid), .box_ready_o(box_ready), .box_i(box), .light_valid_o(light_valid),
    .light_ready_i(light_ready), .light_o(light), .meta_valid_o(meta_valid), .meta_ready_i(meta_ready), .meta_o(meta),
    .pixel_valid_o(single_valid), .pixel_ready_i(single_ready), .pixel_o(single), .flags_o(flags)
  );

  // ---- pieces -----------------------------------------------------------------------------------------------------------------------
  localparam int VALUES_W = 6 * shade_pkg::PATCH_VALUE_W;
  localparam int AREA_W = shade_pkg::PATCH_AREA_W;
  localparam int GROUPS = LANES > 1 ? 2 : 1;  // each of which has a FIFO, and deals a piece a clock
  localparam int EACH = LANES / GROUPS;
  localparam int DEEP = shade_pkg::PATCH_PIECES_LOG2;
  logic piece_room, area_put, value_put, group_area, group_value;
  logic [1:0] piece_taken;
  logic [AREA_W-1:0] area_new;
  logic [VALUES_W-1:0] value_new;
  logic [LANES-1:0] single_taken;
  shade_patch_pieces u_pieces (
    .clk_i, .rst_i, .meta_valid_i(meta_valid), .meta_ready_o(meta_ready), .meta_i(meta), .light_valid_i(light_valid),
    .light_ready_o(light_ready), .light_i(light), .token_valid_i(token_valid), .token_ready_o(token_ready),
    .token_i(token), .room_i(piece_room), .place_valid_o(area_put), .place_o(area_new), .value_valid_o(value_put),
    .value_o(value_new)
  );
  if (GROUPS == 1) begin : g_one
    shade_patch_room #(.LIMIT((1 << DEEP) - 64)) u_room (
      .clk_i, .rst_i, .put_i(area_put), .taken_i(piece_taken[0]), .room_o(piece_room)
    );
    assign {group_area, group_value, piece_taken[1]} = 3'b000;
  end else begin : g_deal
    shade_patch_deal #(.LIMIT((1 << DEEP) - 64)) u_deal (
      .clk_i, .rst_i, .put_i(area_put), .taken_i(piece_taken), .group_o(group_area), .room_o(piece_room)
    );
    // a value comes behind its area
    shade_delay #(.WIDTH(1), .DEPTH(shade_pkg::LATENCY_PATCH_LINES - 1)) u_group (
      .clk_i, .d_i(group_area), .q_o(group_value)
    );
  end

  // ---- lanes, those of a group one behind the other ---------------------------------------------------------------------
  for (genvar g = 0; g < GROUPS; g++) begin : g_group
    logic area_valid, value_valid, unused_areas, piece_ready, unused_valid;
    logic [AREA_W-1:0] area;
    logic [VALUES_W-1:0] value;
    logic [EACH-1:0] lane_ready;
    shade_fifo #(.WIDTH(VALUES_W), .LOG2(DEEP), .BLOCK(1)) u_values (
      .clk_i, .rst_i, .valid_i(value_put && group_value == 1'(g)), .data_i(value_new), .valid_o(value_valid),
      .ready_i(piece_ready), .data_o(value), .taken_o(piece_taken[g])
    );
    // written before the values, read with them
    shade_fifo #(.WIDTH(AREA_W), .LOG2(DEEP), .BLOCK(1)) u_areas (
      .clk_i, .rst_i, .valid_i(area_put && group_area == 1'(g)), .data_i(area_new), .valid_o(area_valid),
      .ready_i(value_valid && piece_ready), .data_o(area), .taken_o(unused_areas)
    );
    assign piece_ready  = |lane_ready;
    assign unused_valid = area_valid;  // as value_valid
    for (genvar n = 0; n < EACH; n++) begin : g_lane
      localparam int I = g * EACH + n;
      logic earlier;  // a lane with a lower number takes the piece
      if (n == 0) begin : g_first
        assign earlier = 1'b0;
      end else begin : g_other
        assign earlier = |lane_ready[n-1:0];
      end
      shade_patch_lane u_lane (
        .clk_i, .rst_i, .valid_i(value_valid && !earlier), .ready_o(lane_ready[n]), .piece_i({value, area}),
        .single_valid_i(I == LANES - 1 && single_valid), .single_ready_o(single_taken[I]), .single_i(single),
        .m_axis_pixel_tvalid(m_axis_pixel_tvalid[I]), .m_axis_pixel_tready(m_axis_pixel_tready[I]),
        .m_axis_pixel_tdata(m_axis_pixel_tdata[I*PIXEL_W+:PIXEL_W]),
        .m_axis_pixel_tuser(m_axis_pixel_tuser[I*USER_W+:USER_W]), .m_axis_pixel_tlast(m_axis_pixel_tlast[I])
      );
    end
  end
  assign single_ready = single_taken[LANES-1];
  logic unused_taken;
  assign unused_taken = &{1'b0, single_taken, piece_taken};
  always_ff @(posedge clk_i) begin
    error_o <= error_o | error;
    if (error != '0 && !(&error_count_o)) error_count_o <= error_count_o + 16'd1;
    flags_o <= flags_o | flags;
    if (rst_i) begin
      error_o       <= '0;
      error_count_o <= '0;
      flags_o       <= '0;
    end
  end
endmodule
