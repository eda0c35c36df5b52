// SPDX-License-Identifier: Apache-2.0
// shade_patch_lights: boxes in, light at their nodes or pixels out: the second part of shade_patch.
//
//   setup ─▶ slots ─▶ walk ─▶ nodes ─▶ light ─▶ lights, metas
//
//   beat_*, plan_*, done_o, place_*, box_*   of shade_patch_boxes;   l_i, h_i, excess_i, shift_i, table_*: settings, see shade_patch_light
//   light_*     {specular, diffuse} at nodes, S1.16 each;   meta_*: see shade_patch_nodes, without direct
//   pixel_*     a pixel that is lit directly: {line, column, tag, specular, diffuse}, U0.16
//   flags_o     for one clock: bits PATCH_LIGHT_*
//
// A light a clock, some 45 clocks behind the plan of a small triangle. They wait in FIFOs deep enough for groups of small triangles, which are slow here, to lend their time to
// large ones, which are slow at the pixels. Example: a box of 4 x 4 with 16 pixels -> six lights, one meta; with 3 pixels -> three pixels.
module shade_patch_lights #(
  parameter int LIGHTS = 1
) (
  input  logic                                          clk_i,
  input  logic                                          rst_i,
  input  logic [LIGHTS*3*shade_pkg::INTENSITY_W-1:0]    l_i,
  input  logic [LIGHTS*3*shade_pkg::INTENSITY_W-1:0]    h_i,
  input  logic [        LIGHTS*shade_pkg::EXCESS_W-1:0] excess_i,
  input  logic [          shade_pkg::CHORD_SHIFT_W-1:0] shift_i,
  input  logic                                          table_write_i,
  input  logic [          shade_pkg::CHORD_INDEX_W-1:0] table_at_i,
  input  shade_pkg::chord_t                             table_i,
  input  logic                                          beat_valid_i,
  output logic                                          beat_ready_o,
  input  logic [         shade_pkg::SURFACE_DATA_W-1:0] beat_i,
  input  logic                                          plan_valid_i,
  output logic                                          plan_ready_o,
  input  logic [                                   5:0] plan_i,
  output logic                                          done_o,
  input  logic                                          place_valid_i,
  output logic                                          place_ready_o,
  input  logic [          shade_pkg::PATCH_PLACE_W-1:0] place_i,
  input  logic                                          box_valid_i,
  output logic                                          box_ready_o,
  input  logic [            shade_pkg::PATCH_BOX_W-1:0] box_i,
  output logic                                          light_valid_o,
  input  logic                                          light_ready_i,
  output logic [          2*shade_pkg::INTENSITY_W-1:0] light_o,
  output logic                                          meta_valid_o,
  input  logic                                          meta_ready_i,
  output logic [           shade_pkg::PATCH_META_W-2:0] meta_o,
  output logic                                          pixel_valid_o,
  input  logic                                          pixel_ready_i,
  output logic [shade_pkg::PATCH_USER_W+shade_pkg::PIXEL_DATA_W-1:0] pixel_o,
  output logic [          shade_pkg::PATCH_FLAGS_W-1:0] flags_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int A_W = shade_pkg::DIRECT_DIFFUSE_F + 2;
  localparam int H_W = shade_pkg::DIRECT_X_F + 2;
  localparam int P_W = shade_pkg::DIRECT_P_OUT_F + 1;
  localparam int WAIT = shade_pkg::PATCH_WAIT_LOG2;
  localparam int SCALAR_W = shade_pkg::PATCH_SCALAR_W;

  // ---- a triangle's scalars --------------------------------------------------------------------------------------------------
  logic slot_start, slot_room, word_put, word_last, slot_valid, slot_ready, range;
  logic [3:0] word_which;
  logic [1:0] word_at;
  logic [SCALAR_W-1:0] word;
  logic [(2*LIGHTS+2)*SCALAR_W-1:0] slot;
  shade_patch_setup #(.LIGHTS(LIGHTS)) u_setup (
    .clk_i, .rst_i, .l_i, .h_i, .beat_valid_i, .beat_ready_o, .beat_i, .plan_valid_i, .plan_ready_o, .plan_i,
    .room_i(slot_room), .start_o(slot_start), .done_o, .valid_o(word_put), .last_o(word_last), .which_o(word_which),
    .at_o(word_at), .value_o(word), .range_o(range)
  );
  shade_patch_slots #(.MEMORIES(2 * LIGHTS + 2)) u_slots (
    .clk_i, .rst_i, .start_i(slot_start), .room_o(slot_room), .valid_i(word_put), .last_i(word_last),
    .which_i(word_which), .at_i(word_at), .value_i(word), .valid_o(slot_valid), .ready_i(slot_ready),
    .value_o(slot)
  );

  // ---- from box to box, from node to node -------------------------------------------------------------------------------------
  logic walk_valid, walk_take, node_put, light_room, light_put, meta_put, short;
  logic [LIGHTS*A_W-1:0] a, ac, al, node_a;
  logic [LIGHTS*H_W-1:0] h, hc, hl, node_h;
  logic [P_W-1:0] p, pc, pl, pcc, pll, pcl, node_p;
  logic [shade_pkg::PATCH_META_W+16-1:0] walk_place;
  logic [shade_pkg::PATCH_META_W-1:0] meta_new;
  logic signed [W-1:0] diffuse, specular;
  shade_patch_walk #(.LIGHTS(LIGHTS)) u_walk (
    .clk_i, .rst_i, .slot_valid_i(slot_valid), .slot_ready_o(slot_ready), .slot_i(slot), .place_valid_i,
    .place_ready_o, .place_i, .box_valid_i, .box_ready_o, .box_i, .valid_o(walk_valid), .take_i(walk_take),
    .a_o(a), .a_column_o(ac), .a_line_o(al), .h_o(h), .h_column_o(hc), .h_line_o(hl), .p_o(p),
    .p_column_o(pc), .p_line_o(pl), .p_columns_o(pcc), .p_lines_o(pll), .p_both_o(pcl), .place_o(walk_place)
  );
  shade_patch_nodes #(.LIGHTS(LIGHTS)) u_nodes (
    .clk_i, .rst_i, .valid_i(walk_valid), .take_o(walk_take), .room_i(light_room), .a_i(a),
    .a_column_i(ac), .a_line_i(al), .h_i(h), .h_column_i(hc), .h_line_i(hl), .p_i(p), .p_column_i(pc), .p_line_i(pl),
    .p_columns_i(pcc), .p_lines_i(pll), .p_both_i(pcl), .place_i(walk_place), .valid_o(node_put), .a_o(node_a),
    .h_o(node_h), .p_o(node_p), .meta_valid_o(meta_put), .meta_o(meta_new)
  );
  shade_patch_light #(.LIGHTS(LIGHTS)) u_light (
    .clk_i, .rst_i, .excess_i, .shift_i, .table_write_i, .table_at_i, .table_i, .valid_i(node_put), .a_i(node_a),
    .h_i(node_h), .p_i(node_p), .valid_o(light_put), .diffuse_o(diffuse), .specular_o(specular), .short_o(short)
  );

  // ---- nodes wait for their lines, pixels for a lane ---------------------------------------------------------------------------
  localparam int USER_W = shade_pkg::PATCH_USER_W;
  localparam int META_W = shade_pkg::PATCH_META_W - 1;
  localparam int LIGHT_DELAY = shade_pkg::LATENCY_PATCH_NODES + shade_pkg::LATENCY_DIRECT_LIGHT + (LIGHTS > 1 ? 1 : 0) - 1;
  logic direct, single, node_taken, pixel_taken, node_room, pixel_room;
  logic [1:0][shade_pkg::PIXEL_W-1:0] lit;
  assign direct = meta_new[META_W];
  shade_delay #(.WIDTH(1), .DEPTH(LIGHT_DELAY)) u_single (.clk_i, .d_i(direct), .q_o(single));
  shade_saturate #(.WIDTH(W), .OUT_W(shade_pkg::PIXEL_W)) u_diffuse (.x_i(diffuse), .y_o(lit[0]));
  shade_saturate #(.WIDTH(W), .OUT_W(shade_pkg::PIXEL_W)) u_specular (.x_i(specular), .y_o(lit[1]));
  shade_fifo #(.WIDTH(2 * W), .LOG2(WAIT), .BLOCK(1)) u_nodes_lit (
    .clk_i, .rst_i, .valid_i(light_put && !single), .data_i({specular, diffuse}), .valid_o(light_valid_o),
    .ready_i(light_ready_i), .data_o(light_o), .taken_o(node_taken)
  );
  shade_fifo #(.WIDTH(2 * shade_pkg::PIXEL_W), .LOG2(WAIT), .BLOCK(1)) u_pixels_lit (
    .clk_i, .rst_i, .valid_i(light_put && single), .data_i(lit), .valid_o(pixel_valid_o), .ready_i(pixel_ready_i),
    .data_o(pixel_o[0+:2*shade_pkg::PIXEL_W]), .taken_o(pixel_taken)
  );
  shade_patch_room #(.LIMIT((1 << WAIT) - 64)) u_node_room (
    .clk_i, .rst_i, .put_i(light_put && !single), .taken_i(node_taken), .room_o(node_room)
  );
  shade_patch_room #(.LIMIT((1 << WAIT) - 64)) u_pixel_room (
    .clk_i, .rst_i, .put_i(light_put && single), .taken_i(pixel_taken), .room_o(pixel_room)
  );
  assign light_room = node_room && pixel_room;
  // no more than the lights, for which there is room; written before them
  logic unused_metas, unused_places, place_there;
  shade_fifo #(.WIDTH(META_W), .LOG2(WAIT), .BLOCK(1)) u_metas (
    .clk_i, .rst_i, .valid_i(meta_put && !direct), .data_i(meta_new[META_W-1:0]), .valid_o(meta_valid_o),
    .ready_i(meta_ready_i), .data_o(meta_o), .taken_o(unused_metas)
  );
  logic [shade_pkg::PLACE_W-1:0] column, line, pixel_column, pixel_line;
  logic [shade_pkg::TAG_W-1:0] tag, pixel_tag;
  assign {column, line, tag} = meta_new[USER_W-1:0];
  shade_fifo #(.WIDTH(USER_W), .LOG2(WAIT), .BLOCK(1)) u_places (
    .clk_i, .rst_i, .valid_i(meta_put && direct), .data_i({line, column, tag}), .valid_o(place_there),
    .ready_i(pixel_valid_o && pixel_ready_i), .data_o({pixel_line, pixel_column, pixel_tag}), .taken_o(unused_places)
  );
  assign pixel_o[2*shade_pkg::PIXEL_W+:USER_W] = {pixel_line, pixel_column, pixel_tag};
  logic unused_there;
  assign unused_there = place_there;
  always_comb begin
    flags_o = '0;
    flags_o[shade_pkg::PATCH_LIGHT_RANGE] = range;
    flags_o[shade_pkg::PATCH_LIGHT_SHORT] = light_put && short;
  end
endmodule
