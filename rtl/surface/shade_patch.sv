// SPDX-License-Identifier: Apache-2.0
// shade_patch: triangles and their runs in, pixels out: light at six nodes of a box, a polynomial of two variables between them.
//
//   surface ─▶ door ─▶ front (plan) ─┬─▶ walk ─▶ dots ─▶ nodes ─▶ light ─┐
//                └────▶ rows ─▶ clip ┴────────── tokens ─────────────────┴─▶ pieces ─▶ lanes ─▶ pixels
//
//   s_axis_surface   packets TRIANGLE and RUN of docs/interface.md, and words of the table: see shade_patch_door
//   l_i .. reach_i   settings of the draw call, see golden.patch.registers: must not change while a triangle is inside
//   m_axis_pixel     a stream for each lane. tdata = {specular, diffuse}, U0.16; tuser = {line, column, tag}; tlast: the last pixel
//                    of a piece: pixels of one line of one box, from left to right; a pixel that is lit directly is a piece
//   error_o          what came in and was dropped: see shade_patch_door, since reset; error_count_o how often
//   flags_o          bits PATCH_LIGHT_* since reset: light that is not exact
//
// Order: boxes of a triangle row by row, in a box line by line; a piece goes to the first lane that is free, so the order of
// pieces in a lane, and which lane it is, depend on the consumers; each pixel tells its place.
// Full back-pressure: every stage stops for want of room in the FIFO behind it; no path leads from an input to an output.
// LANES pixels a clock as long as pieces are long enough: at most a piece, a node, a line of a box a clock. Latency from a small
// triangle's first beat to its first pixel: about 120 clocks.
// Source: P1 in two dimensions, P4's constant increment. Example: a triangle with N = L = H everywhere -> all pixels full light.
module shade_patch #(
  parameter int LANES = 1
) (
  input  logic                                      clk_i,
  input  logic                                      rst_i,
  input  logic [   3*shade_pkg::INTENSITY_W-1:0]    l_i,
  input  logic [   3*shade_pkg::INTENSITY_W-1:0]    h_i,
  input  logic [        shade_pkg::PATCH_DOT_F:0]   h_length_i,
  input  logic [                             2:0]   shift_i,
  input  logic [     shade_pkg::INTENSITY_F-1:0]    radius_i,
  input  logic [   shade_pkg::PATCH_REACH_W-1:0]    reach_i,
  input  logic                                      s_axis_surface_tvalid,
  output logic                                      s_axis_surface_tready,
  input  logic [   shade_pkg::SURFACE_DATA_W-1:0]   s_axis_surface_tdata,
  input  logic                                      s_axis_surface_tuser,
  input  logic                                      s_axis_surface_tlast,
  output logic [                       LANES-1:0]   m_axis_pixel_tvalid,
  input  logic [                       LANES-1:0]   m_axis_pixel_tready,
  output logic [LANES*shade_pkg::PIXEL_DATA_W-1:0]  m_axis_pixel_tdata,
  output logic [LANES*shade_pkg::PATCH_USER_W-1:0]  m_axis_pixel_tuser,
  output logic [                       LANES-1:0]   m_axis_pixel_tlast,
  output logic [        shade_pkg::ERROR_W-1:0]     error_o,
  output logic [                            15:0]   error_count_o,
  output logic [  shade_pkg::PATCH_FLAGS_W-1:0]     flags_o
);
  if (LANES != 1 && LANES != 2 && LANES != 4 && LANES != 8) begin : g_check
    $error("shade_patch: LANES must be 1, 2, 4 or 8");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int DOT_W = shade_pkg::PATCH_DOT_W;
  localparam int LOG2 = shade_pkg::PATCH_LOG2_MAX;
  localparam int PLACE_W = shade_pkg::PLACE_W;
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int FIFO = shade_pkg::PATCH_FIFO_LOG2;

  // ---- triangles and runs ------------------------------------------------------------------------------------------------------
  logic door_valid, door_pass, triangle_put, triangle_valid, corner_put, corner_valid, planned, plan_valid, walk_plan_valid, walk_take, rows_take;
  logic run_put, run_valid, run_ready, run_taken, run_room, table_write;
  shade_pkg::triangle_t door_triangle;
  logic [shade_pkg::PATCH_TRIANGLE_W-1:0] triangle;
  logic [3*shade_pkg::PATCH_CORNER_W-1:0] corner_new, corner;
  logic [2*PLACE_W-1:0] door_place;
  logic [shade_pkg::PATCH_PLAN_W-1:0] plan, row_plan;
  logic [5:0] walk_plan;
  logic [shade_pkg::PATCH_RUN_W-1:0] run_new, run;
  logic [shade_pkg::PATCH_TABLE_LOG2-1:0] table_at;
  logic [31:0] table_word;
  logic [shade_pkg::ERROR_W-1:0] error;
  shade_patch_door u_door (
    .clk_i, .rst_i, .s_axis_surface_tvalid, .s_axis_surface_tready, .s_axis_surface_tdata, .s_axis_surface_tuser,
    .s_axis_surface_tlast, .triangle_valid_o(door_valid), .triangle_o(door_triangle), .pass_i(door_pass),
    .put_o(triangle_put), .place_o(door_place),
    .run_valid_o(run_put), .run_o(run_new), .run_room_i(run_room), .table_write_o(table_write), .table_at_o(table_at),
    .table_o(table_word), .error_o(error)
  );
  shade_patch_front u_front (
    .clk_i, .rst_i, .radius_i, .reach_i, .hx_i(h_i[0+:W]), .hy_i(h_i[W+:W]), .hz_i(h_i[2*W+:W]), .valid_i(door_valid),
    .triangle_i(door_triangle), .pass_o(door_pass), .corner_valid_o(corner_put),
    .corner_o(corner_new), .planned_o(planned), .plan_o(plan)
  );
  shade_fifo #(.WIDTH(shade_pkg::PATCH_PLAN_W), .LOG2(FIFO), .BLOCK(1)) u_row_plans (
    .clk_i, .rst_i, .valid_i(planned), .data_i(plan), .valid_o(plan_valid), .ready_i(rows_take), .data_o(row_plan),
    .taken_o()
  );
  // each has a run or an end among the boxes: no more than there is room for of both
  shade_fifo #(.WIDTH(shade_pkg::PATCH_TRIANGLE_W), .LOG2(FIFO), .BLOCK(1)) u_triangles (
    .clk_i, .rst_i, .valid_i(triangle_put),
    .data_i({door_triangle.dline.exp, door_triangle.dline.mantissa, door_triangle.dcolumn.exp,
             door_triangle.dcolumn.mantissa, door_triangle.tag, door_place}),
    .valid_o(triangle_valid), .ready_i(walk_take), .data_o(triangle), .taken_o()
  );
  shade_fifo #(.WIDTH(3 * shade_pkg::PATCH_CORNER_W), .LOG2(FIFO), .BLOCK(1)) u_corners (
    .clk_i, .rst_i, .valid_i(corner_put), .data_i(corner_new), .valid_o(corner_valid), .ready_i(walk_take), .data_o(corner),
    .taken_o()
  );
  shade_fifo #(.WIDTH(6), .LOG2(FIFO), .BLOCK(1)) u_plans (
    .clk_i, .rst_i, .valid_i(planned), .data_i(plan[5:0]), .valid_o(walk_plan_valid), .ready_i(walk_take), .data_o(walk_plan),
    .taken_o()
  );
  shade_fifo #(.WIDTH(shade_pkg::PATCH_RUN_W), .LOG2(FIFO), .BLOCK(1)) u_runs (
    .clk_i, .rst_i, .valid_i(run_put), .data_i(run_new), .valid_o(run_valid), .ready_i(run_ready), .data_o(run),
    .taken_o(run_taken)
  );
  shade_patch_room #(.LIMIT(64)) u_run_room (.clk_i, .rst_i, .put_i(run_put), .taken_i(run_taken), .room_o(run_room));

  // ---- boxes ---------------------------------------------------------------------------------------------------------------------
  logic row_valid, row_take, row_last, row_direct, clip_room_q, token_room, token_put, token_keep, token_drop;
  logic token_valid, token_ready, box_put, box_valid, box_ready, box_taken, box_room;
  logic [shade_pkg::PATCH_AT_W-1:0] row;
  logic [15:0] row_mask;
  logic [LOG2-1:0] row_deep, line;
  logic [PLACE_W-1:0] row_least, line_first;
  logic [COUNT_W-1:0] row_past, line_end;
  logic [2:0] row_kx, row_ky;
  logic [shade_pkg::PATCH_TOKEN_W-1:0] token_new, token;
  logic [shade_pkg::PATCH_BOX_W-1:0] box_new, box;
  shade_patch_rows u_rows (
    .clk_i, .rst_i, .triangle_valid_i(plan_valid), .triangle_take_o(rows_take), .kx_i(row_plan[5:3]), .ky_i(row_plan[2:0]),
    .direct_i(row_plan[6]), .run_valid_i(run_valid), .run_ready_o(run_ready), .run_i(run), .row_valid_o(row_valid),
    .row_take_i(row_take), .row_o(row), .mask_o(row_mask), .deep_o(row_deep), .least_o(row_least), .past_o(row_past),
    .last_o(row_last), .kx_o(row_kx), .ky_o(row_ky), .direct_o(row_direct), .line_i(line), .first_o(line_first),
    .end_o(line_end)
  );
  shade_patch_clip u_clip (
    .clk_i, .rst_i, .row_valid_i(row_valid), .row_take_o(row_take), .row_i(row), .mask_i(row_mask), .deep_i(row_deep),
    .least_i(row_least), .past_i(row_past), .last_i(row_last), .kx_i(row_kx), .ky_i(row_ky), .direct_i(row_direct),
    .line_o(line), .first_i(line_first), .end_i(line_end), .room_i(clip_room_q), .token_valid_o(token_put),
    .token_o(token_new), .token_keep_o(token_keep), .token_drop_o(token_drop), .box_valid_o(box_put), .box_o(box_new)
  );
  always_ff @(posedge clk_i) clip_room_q <= token_room && box_room;
  shade_patch_tokens u_tokens (
    .clk_i, .rst_i, .valid_i(token_put), .data_i(token_new), .keep_i(token_keep), .drop_i(token_drop),
    .empty_i(token_new[LOG2:0] == '0), .room_o(token_room),
    .valid_o(token_valid), .ready_i(token_ready), .data_o(token)
  );
  shade_fifo #(.WIDTH(shade_pkg::PATCH_BOX_W), .LOG2(FIFO), .BLOCK(1)) u_boxes (
    .clk_i, .rst_i, .valid_i(box_put), .data_i(box_new), .valid_o(box_valid), .ready_i(box_ready), .data_o(box),
    .taken_o(box_taken)
  );
  shade_patch_room #(.LIMIT((1 << FIFO) - 160)) u_box_room (.clk_i, .rst_i, .put_i(box_put), .taken_i(box_taken), .room_o(box_room));

  // ---- light at nodes -------------------------------------------------------------------------------------------------------------
  logic walk_valid, walk_ready, dot_put, dot_valid, dot_ready, dot_taken, dot_room, place_valid, place_ready, range;
  logic node_put, light_put, light_valid, light_ready, light_taken, light_room, meta_put, meta_valid, meta_ready;
  logic [3*W-1:0] n, dx, dy;
  logic [shade_pkg::PATCH_PLACE_W-1:0] place_new, place;
  logic [DOT_W-1:0] dot_new, dot;
  logic [3:0] which_new, which;
  logic [3*DOT_W-1:0] node;
  logic [shade_pkg::PATCH_META_W-1:0] meta_new, meta;
  logic signed [W-1:0] diffuse, specular;
  logic [2*W-1:0] light;
  logic [shade_pkg::PATCH_FLAGS_W-1:0] flags;
  shade_patch_walk u_walk (
    .clk_i, .rst_i, .triangle_valid_i(triangle_valid && corner_valid && walk_plan_valid), .triangle_take_o(walk_take), .triangle_i(triangle),
    .corner_i(corner), .kx_i(walk_plan[5:3]), .ky_i(walk_plan[2:0]), .box_valid_i(box_valid), .box_ready_o(box_ready), .box_i(box), .valid_o(walk_valid), .ready_i(walk_ready),
    .n_o(n), .dx_o(dx), .dy_o(dy), .place_o(place_new), .range_o(range)
  );
  shade_patch_dots u_dots (
    .clk_i, .rst_i, .l_i, .h_i, .valid_i(walk_valid), .ready_o(walk_ready), .n_i(n), .dx_i(dx), .dy_i(dy),
    .first_i(place_new[shade_pkg::PATCH_PLACE_W-1]), .room_i(dot_room), .valid_o(dot_put), .which_o(which_new),
    .dot_o(dot_new)
  );
  shade_fifo #(.WIDTH(DOT_W + 4), .LOG2(FIFO), .BLOCK(1)) u_products (
    .clk_i, .rst_i, .valid_i(dot_put), .data_i({which_new, dot_new}), .valid_o(dot_valid), .ready_i(dot_ready),
    .data_o({which, dot}), .taken_o(dot_taken)
  );
  shade_patch_room #(.LIMIT((1 << FIFO) - 64)) u_dot_room (.clk_i, .rst_i, .put_i(dot_put), .taken_i(dot_taken), .room_o(dot_room));
  // at least five products a box: there is room as long as there is for them
  shade_fifo #(.WIDTH(shade_pkg::PATCH_PLACE_W), .LOG2(FIFO), .BLOCK(1)) u_places (
    .clk_i, .rst_i, .valid_i(walk_valid && walk_ready), .data_i(place_new), .valid_o(place_valid), .ready_i(place_ready),
    .data_o(place), .taken_o()
  );
  shade_patch_nodes u_nodes (
    .clk_i, .rst_i, .dot_valid_i(dot_valid), .dot_ready_o(dot_ready), .which_i(which), .dot_i(dot),
    .place_valid_i(place_valid), .place_ready_o(place_ready), .place_i(place), .room_i(light_room), .valid_o(node_put),
    .node_o(node), .meta_valid_o(meta_put), .meta_o(meta_new)
  );
  shade_patch_light u_light (
    .clk_i, .rst_i, .h_length_i, .shift_i, .table_write_i(table_write), .table_at_i(table_at), .table_i(table_word),
    .valid_i(node_put), .node_i(node), .valid_o(light_put), .diffuse_o(diffuse), .specular_o(specular), .flags_o(flags)
  );
  shade_fifo #(.WIDTH(2 * W), .LOG2(FIFO), .BLOCK(1)) u_lights (
    .clk_i, .rst_i, .valid_i(light_put), .data_i({specular, diffuse}), .valid_o(light_valid), .ready_i(light_ready),
    .data_o(light), .taken_o(light_taken)
  );
  shade_patch_room #(.LIMIT((1 << FIFO) - 64)) u_light_room (.clk_i, .rst_i, .put_i(light_put), .taken_i(light_taken), .room_o(light_room));
  // no more than the lights, for which there is room
  shade_fifo #(.WIDTH(shade_pkg::PATCH_META_W), .LOG2(FIFO), .BLOCK(1)) u_metas (
    .clk_i, .rst_i, .valid_i(meta_put), .data_i(meta_new), .valid_o(meta_valid), .ready_i(meta_ready), .data_o(meta),
    .taken_o()
  );

  // ---- pieces -----------------------------------------------------------------------------------------------------------------------
  localparam int VALUES_W = 6 * shade_pkg::PATCH_VALUE_W;
  logic piece_room, area_valid, unused_valid, area_put, value_put, value_valid, piece_ready, piece_taken;
  logic [shade_pkg::PATCH_AREA_W-1:0] area_new, area;
  logic [VALUES_W-1:0] value_new, value;
  shade_patch_pieces u_pieces (
    .clk_i, .rst_i, .meta_valid_i(meta_valid), .meta_ready_o(meta_ready), .meta_i(meta), .light_valid_i(light_valid),
    .light_ready_o(light_ready), .light_i(light), .token_valid_i(token_valid), .token_ready_o(token_ready),
    .token_i(token), .room_i(piece_room), .place_valid_o(area_put), .place_o(area_new), .value_valid_o(value_put),
    .value_o(value_new)
  );
  shade_fifo #(.WIDTH(VALUES_W), .LOG2(FIFO), .BLOCK(1)) u_values (
    .clk_i, .rst_i, .valid_i(value_put), .data_i(value_new), .valid_o(value_valid), .ready_i(piece_ready),
    .data_o(value), .taken_o(piece_taken)
  );
  // written before the values, read with them
  shade_fifo #(.WIDTH(shade_pkg::PATCH_AREA_W), .LOG2(FIFO), .BLOCK(1)) u_areas (
    .clk_i, .rst_i, .valid_i(area_put), .data_i(area_new), .valid_o(area_valid), .ready_i(value_valid && piece_ready),
    .data_o(area), .taken_o()
  );
  shade_patch_room #(.LIMIT((1 << FIFO) - 64)) u_piece_room (.clk_i, .rst_i, .put_i(area_put), .taken_i(piece_taken), .room_o(piece_room));

  assign unused_valid = area_valid;  // as value_valid

  logic [LANES-1:0] lane_ready;
  assign piece_ready = |lane_ready;
  for (genvar i = 0; i < LANES; i++) begin : g_lane
    logic earlier;  // a lane with a lower number takes the piece
    if (i == 0) begin : g_first
      assign earlier = 1'b0;
    end else begin : g_other
      assign earlier = |lane_ready[i-1:0];
    end
    shade_patch_lane u_lane (
      .clk_i, .rst_i, .valid_i(value_valid && !earlier), .ready_o(lane_ready[i]), .piece_i({value, area}),
      .m_axis_pixel_tvalid(m_axis_pixel_tvalid[i]), .m_axis_pixel_tready(m_axis_pixel_tready[i]),
      .m_axis_pixel_tdata(m_axis_pixel_tdata[i*shade_pkg::PIXEL_DATA_W+:shade_pkg::PIXEL_DATA_W]),
      .m_axis_pixel_tuser(m_axis_pixel_tuser[i*shade_pkg::PATCH_USER_W+:shade_pkg::PATCH_USER_W]),
      .m_axis_pixel_tlast(m_axis_pixel_tlast[i])
    );
  end

  always_ff @(posedge clk_i) begin
    error_o <= error_o | error;
    if (error != '0 && !(&error_count_o)) error_count_o <= error_count_o + 16'd1;
    flags_o <= flags_o | (light_put ? flags : '0);
    if (range) flags_o[shade_pkg::PATCH_LIGHT_RANGE] <= 1'b1;
    if (rst_i) begin
      error_o       <= '0;
      error_count_o <= '0;
      flags_o       <= '0;
    end
  end
endmodule
