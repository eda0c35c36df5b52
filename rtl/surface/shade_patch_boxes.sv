// SPDX-License-Identifier: Apache-2.0
// shade_patch_boxes: packets in, boxes out: the first half of shade_patch.
//
//   door ─┬─▶ beats ─▶ far ─▶ plan ─┬─▶ plans ─▶ (setup)
//         ├─▶ beats ────────────────┼─────────▶ (setup)
//         ├─▶ places ───────────────┼─────────▶ (walk)
//         └─▶ runs ──▶ rows ◀─ plans┘─▶ clip ─┬▶ boxes ─▶ (walk)
//                                             └▶ tokens ▶ (pieces)
//
//   s_axis_surface, table_*, shift_o, error_o   see shade_patch_door;   h_i, radius_i, reach_i: see shade_patch_far and _plan
//   beat_*, plan_*, done_i   of shade_patch_setup;   place_*, box_* of shade_patch_walk;   token_* of shade_patch_pieces
//
// Streams of FIFOs: valid_o and data from registers until ready_i. Latency of a triangle: some 40 clocks. Example: a triangle of 4 x 4 pixels and its runs -> four beats, a plan, a place, a box and
// the triangle's end.
module shade_patch_boxes #(
  parameter int LIGHTS = 1
) (
  input  logic                                          clk_i,
  input  logic                                          rst_i,
  input  logic [LIGHTS*3*shade_pkg::INTENSITY_W-1:0]    h_i,
  input  logic [             shade_pkg::INTENSITY_F-1:0] radius_i,
  input  logic [           shade_pkg::PATCH_REACH_W-1:0] reach_i,
  input  logic                                          s_axis_surface_tvalid,
  output logic                                          s_axis_surface_tready,
  input  logic [         shade_pkg::SURFACE_DATA_W-1:0] s_axis_surface_tdata,
  input  logic                                          s_axis_surface_tlast,
  output logic                                          beat_valid_o,
  input  logic                                          beat_ready_i,
  output logic [         shade_pkg::SURFACE_DATA_W-1:0] beat_o,
  output logic                                          plan_valid_o,
  input  logic                                          plan_ready_i,
  output logic [                                   5:0] plan_o,
  input  logic                                          done_i,
  output logic                                          place_valid_o,
  input  logic                                          place_ready_i,
  output logic [          shade_pkg::PATCH_PLACE_W-1:0] place_o,
  output logic                                          box_valid_o,
  input  logic                                          box_ready_i,
  output logic [            shade_pkg::PATCH_BOX_W-1:0] box_o,
  output logic                                          token_valid_o,
  input  logic                                          token_ready_i,
  output logic [        2*shade_pkg::PATCH_TOKEN_W-1:0] token_o,
  output logic                                          table_write_o,
  output logic [          shade_pkg::CHORD_INDEX_W-1:0] table_at_o,
  output shade_pkg::chord_t                             table_o,
  output logic [          shade_pkg::CHORD_SHIFT_W-1:0] shift_o,
  output logic [                shade_pkg::ERROR_W-1:0] error_o
);
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int AT_W = shade_pkg::PATCH_AT_W;
  localparam int LOG2 = shade_pkg::PATCH_LOG2_MAX;
  localparam int FIFO = shade_pkg::PATCH_FIFO_LOG2;
  localparam int RUNS = shade_pkg::PATCH_RUNS_LOG2;
  localparam int DATA_W = shade_pkg::SURFACE_DATA_W;

  // ---- triangles and runs: of no more triangles than there is room for their beats ---------------------------------------------
  logic beat_put, place_put, run_put, run_room, run_valid, run_ready, run_taken;
  logic [DATA_W-1:0] beat_new;
  logic [shade_pkg::PATCH_PLACE_W-1:0] place_new;
  logic [shade_pkg::PATCH_RUN_W-1:0] run_new, run;
  shade_patch_door u_door (
    .clk_i, .rst_i, .s_axis_surface_tvalid, .s_axis_surface_tready, .s_axis_surface_tdata, .s_axis_surface_tlast,
    .beat_valid_o(beat_put), .beat_o(beat_new), .done_i, .place_valid_o(place_put), .place_o(place_new),
    .run_valid_o(run_put), .run_o(run_new), .run_room_i(run_room), .table_write_o, .table_at_o, .table_o, .shift_o, .error_o
  );
  logic unused_beats;
  shade_fifo #(.WIDTH(DATA_W), .LOG2(FIFO), .BLOCK(1)) u_beats (
    .clk_i, .rst_i, .valid_i(beat_put), .data_i(beat_new), .valid_o(beat_valid_o), .ready_i(beat_ready_i), .data_o(beat_o),
    .taken_o(unused_beats)
  );
  logic unused_places;
  shade_fifo #(.WIDTH(shade_pkg::PATCH_PLACE_W), .LOG2(FIFO), .BLOCK(1)) u_places (
    .clk_i, .rst_i, .valid_i(place_put), .data_i(place_new), .valid_o(place_valid_o), .ready_i(place_ready_i),
    .data_o(place_o), .taken_o(unused_places)
  );
  shade_fifo #(.WIDTH(shade_pkg::PATCH_RUN_W), .LOG2(RUNS), .BLOCK(1)) u_runs (
    .clk_i, .rst_i, .valid_i(run_put), .data_i(run_new), .valid_o(run_valid), .ready_i(run_ready), .data_o(run),
    .taken_o(run_taken)
  );
  shade_patch_room #(.LIMIT((1 << RUNS) - 8)) u_run_room (.clk_i, .rst_i, .put_i(run_put), .taken_i(run_taken), .room_o(run_room));

  // ---- plans ---------------------------------------------------------------------------------------------------------------------
  logic far_beat_valid, far_beat_ready, far_valid, far_take, planned, row_plan_valid, rows_take;
  logic [DATA_W-1:0] far_beat;
  logic [shade_pkg::PATCH_PLAN_F-1:0] a, b;
  logic [shade_pkg::PATCH_AWAY_W-1:0] away, half;
  logic [COUNT_W-1:0] columns, lines;
  logic [shade_pkg::TRIANGLE_EXP_W-1:0] column_exp, line_exp;
  logic [shade_pkg::PATCH_PLAN_W-1:0] plan, row_plan;
  logic unused_far_beats;
  shade_fifo #(.WIDTH(DATA_W), .LOG2(FIFO), .BLOCK(1)) u_far_beats (
    .clk_i, .rst_i, .valid_i(beat_put), .data_i(beat_new), .valid_o(far_beat_valid), .ready_i(far_beat_ready),
    .data_o(far_beat), .taken_o(unused_far_beats)
  );
  shade_patch_far #(.LIGHTS(LIGHTS)) u_far (
    .clk_i, .rst_i, .h_i, .beat_valid_i(far_beat_valid), .beat_ready_o(far_beat_ready), .beat_i(far_beat),
    .valid_o(far_valid), .take_i(far_take), .a_o(a), .b_o(b), .away_o(away), .half_o(half), .columns_o(columns),
    .lines_o(lines), .column_exp_o(column_exp), .line_exp_o(line_exp)
  );
  shade_patch_plan u_plan (
    .clk_i, .rst_i, .radius_i, .reach_i, .valid_i(far_valid), .take_o(far_take), .a_i(a), .b_i(b), .away_i(away),
    .half_i(half), .columns_i(columns), .lines_i(lines), .column_exp_i(column_exp), .line_exp_i(line_exp),
    .valid_o(planned), .plan_o(plan)
  );
  logic unused_plans;
  shade_fifo #(.WIDTH(6), .LOG2(FIFO), .BLOCK(1)) u_plans (
    .clk_i, .rst_i, .valid_i(planned), .data_i(plan[5:0]), .valid_o(plan_valid_o), .ready_i(plan_ready_i), .data_o(plan_o),
    .taken_o(unused_plans)
  );
  logic unused_row_plans;
  shade_fifo #(.WIDTH(shade_pkg::PATCH_PLAN_W), .LOG2(FIFO), .BLOCK(1)) u_row_plans (
    .clk_i, .rst_i, .valid_i(planned), .data_i(plan), .valid_o(row_plan_valid), .ready_i(rows_take), .data_o(row_plan),
    .taken_o(unused_row_plans)
  );

  // ---- boxes ---------------------------------------------------------------------------------------------------------------------
  logic row_valid, row_take, row_last, clip_room_q, token_room, token_put, token_keep, token_drop, box_put, box_room, box_taken;
  logic [AT_W-1:0] row, least, most;
  logic [15:0] mask;
  logic [LOG2-2:0] deep, pair;
  logic [shade_pkg::PATCH_PLAN_W-1:0] clip_plan;
  logic [shade_pkg::PATCH_LINE_W-1:0] even, odd;
  logic [2*shade_pkg::PATCH_TOKEN_W-1:0] token_new;
  logic [shade_pkg::PATCH_BOX_W-1:0] box_new;
  shade_patch_rows u_rows (
    .clk_i, .rst_i, .triangle_valid_i(row_plan_valid), .triangle_take_o(rows_take), .plan_i(row_plan),
    .run_valid_i(run_valid), .run_ready_o(run_ready), .run_i(run), .row_valid_o(row_valid), .row_take_i(row_take),
    .row_o(row), .mask_o(mask), .deep_o(deep), .least_o(least), .most_o(most), .last_o(row_last), .plan_o(clip_plan),
    .pair_i(pair), .even_o(even), .odd_o(odd)
  );
  shade_patch_clip u_clip (
    .clk_i, .rst_i, .row_valid_i(row_valid), .row_take_o(row_take), .row_i(row), .mask_i(mask), .deep_i(deep),
    .least_i(least), .most_i(most), .last_i(row_last), .plan_i(clip_plan), .pair_o(pair), .even_i(even), .odd_i(odd),
    .room_i(clip_room_q), .token_valid_o(token_put), .token_o(token_new), .token_keep_o(token_keep),
    .token_drop_o(token_drop), .box_valid_o(box_put), .box_o(box_new)
  );
  always_ff @(posedge clk_i) clip_room_q <= token_room && box_room && !rst_i;
  shade_patch_tokens u_tokens (
    .clk_i, .rst_i, .valid_i(token_put), .data_i(token_new), .keep_i(token_keep), .drop_i(token_drop),
    .empty_i(token_new[LOG2:0] == '0 && token_new[shade_pkg::PATCH_TOKEN_W+:LOG2+1] == '0), .room_o(token_room),
    .valid_o(token_valid_o), .ready_i(token_ready_i), .data_o(token_o)
  );
  shade_fifo #(.WIDTH(shade_pkg::PATCH_BOX_W), .LOG2(FIFO), .BLOCK(1)) u_boxes (
    .clk_i, .rst_i, .valid_i(box_put), .data_i(box_new), .valid_o(box_valid_o), .ready_i(box_ready_i), .data_o(box_o),
    .taken_o(box_taken)
  );
  shade_patch_room #(.LIMIT((1 << FIFO) - 32)) u_box_room (.clk_i, .rst_i, .put_i(box_put), .taken_i(box_taken), .room_o(box_room));
endmodule
