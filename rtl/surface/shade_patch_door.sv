// SPDX-License-Identifier: Apache-2.0
// shade_patch_door: takes packets of s_axis_surface apart: the four beats of a triangle, its runs; the lobe and its table.
//
//   s_axis_surface   packets TRIANGLE and RUN, or LOBE and CHORD, of docs/interface.md; the latter while no pixel is inside
//   beat_valid_o     a beat of a triangle, always four of them;  done_i: all four have been taken, of 2^TRIANGLES_LOG2 triangles
//   place_valid_o    {tag, line, column} of the upper left corner of its box, with its first run
//   run_valid_o      a run, places relative to the triangle's box: {last, empty, line, first, end}, end exclusive
//   run_room_i       as long as it is 1, two more runs may come
//   table_*, shift_o an entry of the table, and the lobe's shift
//   error_o          for one clock: ERROR_EMPTY, a triangle without a box, ERROR_DIRECT, a packet that ends among the first
//                    four beats: of both an empty last run is made; ERROR_LONG, a run that is empty but not the first or last, beyond
//                    the box, or not below the one before it: it is dropped
//
// A beat a clock. Latency: a run 2 clocks. Example: 4 columns, 1 line, left 0, run (10, 20, 4), tlast -> place (10, 20), run
// {1, 0, 0, 0, 4}.
module shade_patch_door #(
  parameter int TRIANGLES_LOG2 = shade_pkg::PATCH_FIFO_LOG2 - 2
) (
  input  logic                                        clk_i,
  input  logic                                        rst_i,
  input  logic                                        s_axis_surface_tvalid,
  output logic                                        s_axis_surface_tready,
  input  logic [       shade_pkg::SURFACE_DATA_W-1:0] s_axis_surface_tdata,
  input  logic                                        s_axis_surface_tlast,
  output logic                                        beat_valid_o,
  output logic [       shade_pkg::SURFACE_DATA_W-1:0] beat_o,
  input  logic                                        done_i,
  output logic                                        place_valid_o,
  output logic [        shade_pkg::PATCH_PLACE_W-1:0] place_o,
  output logic                                        run_valid_o,
  output logic [          shade_pkg::PATCH_RUN_W-1:0] run_o,
  input  logic                                        run_room_i,
  output logic                                        table_write_o,
  output logic [        shade_pkg::CHORD_INDEX_W-1:0] table_at_o,
  output shade_pkg::chord_t                           table_o,
  output logic [        shade_pkg::CHORD_SHIFT_W-1:0] shift_o,
  output logic [              shade_pkg::ERROR_W-1:0] error_o
);
  if (TRIANGLES_LOG2 < 1) begin : g_check
    $error("shade_patch_door: TRIANGLES_LOG2 must be at least 1");
  end
  localparam int DATA_W = shade_pkg::SURFACE_DATA_W;
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int PLACE_W = shade_pkg::PLACE_W;

  // ---- beats: those that a packet cut short lacks are made up, and an empty last run behind them -----------------------------
  typedef enum logic [2:0] {BOX, NORMAL, COLUMN, LINE, RUNS, TABLE} state_t;
  state_t state_q;
  logic cut_q, bad_q, ready_q, some, take, head, beat, lobe, no_box, made_up;
  assign head    = state_q != RUNS && state_q != TABLE;
  assign take    = s_axis_surface_tvalid && s_axis_surface_tready;
  assign lobe    = s_axis_surface_tdata[47];
  assign beat    = head && (cut_q || (take && !(state_q == BOX && lobe)));
  assign made_up = state_q == RUNS && cut_q;
  assign s_axis_surface_tready = ready_q && !cut_q && (state_q == BOX ? some : state_q != RUNS || run_room_i);
  function automatic logic none(input logic [COUNT_W-1:0] n);  // a side that is no side: 0, or more than 4096
    none = n == '0 || n > COUNT_W'(shade_pkg::PIXELS_MAX);
  endfunction
  assign no_box = none(s_axis_surface_tdata[0+:COUNT_W]) || none(s_axis_surface_tdata[16+:COUNT_W]);
  logic unused_credit;
  shade_credit #(.LOG2(TRIANGLES_LOG2)) u_credit (
    .clk_i, .rst_i, .take_i(beat && state_q == BOX), .give_i(done_i), .some_o(some), .soon_o(unused_credit)
  );
  logic [PLACE_W-1:0] from_q;  // columns on the left of the reference pixel
  logic [COUNT_W-1:0] columns_q, lines_q;
  logic [shade_pkg::TAG_W-1:0] tag_q;
  always_ff @(posedge clk_i) begin
    ready_q <= 1'b1;
    beat_o  <= s_axis_surface_tdata;
    beat_valid_o <= beat && !rst_i;
    if (take && state_q == BOX) begin
      {columns_q, lines_q, from_q, tag_q} <= {s_axis_surface_tdata[0+:COUNT_W], s_axis_surface_tdata[16+:COUNT_W],
                                              s_axis_surface_tdata[32+:PLACE_W], s_axis_surface_tdata[48+:16]};
      bad_q <= no_box || s_axis_surface_tlast;
    end
    if (take && head && s_axis_surface_tlast && !(state_q == BOX && lobe)) {cut_q, bad_q} <= 2'b11;
    else if (made_up) cut_q <= 1'b0;
    case (state_q)
      RUNS: if (made_up || (take && s_axis_surface_tlast)) state_q <= BOX;
      TABLE: if (take && s_axis_surface_tlast) state_q <= BOX;
      BOX:
      if (take && lobe) begin
        if (!s_axis_surface_tlast) state_q <= TABLE;
      end else if (beat) state_q <= NORMAL;
      default: if (beat) state_q <= state_t'(state_q + 3'd1);
    endcase
    if (rst_i) begin
      state_q <= BOX;
      cut_q   <= 1'b0;
      ready_q <= 1'b0;
    end
  end

  // ---- the table of the lobe ------------------------------------------------------------------------------------------------
  logic write;
  assign write = take && state_q == TABLE;
  always_ff @(posedge clk_i) begin
    if (take && state_q == BOX && lobe) shift_o <= s_axis_surface_tdata[0+:shade_pkg::CHORD_SHIFT_W];
    if (state_q == BOX) table_at_o <= '1;
    else if (write) table_at_o <= table_at_o + 1'b1;
    table_o       <= s_axis_surface_tdata[$bits(table_o)-1:0];
    table_write_o <= write && !rst_i;
  end

  // ---- runs, relative to the box ---------------------------------------------------------------------------------------
  shade_pkg::run_t run;
  logic go, valid_q1, last_q1, empty_q1, first_q, first_q1, bad_q1, seen_q;  // seen: a run of this triangle
  logic [PLACE_W:0] x_q1, y_q1, before_q;  // with a borrow
  logic [PLACE_W-1:0] edge_q, top_q, left, top;
  logic [COUNT_W-1:0] count_q1, columns_q1, lines_q1;
  logic [COUNT_W:0] end_x;
  logic beyond, drop;
  assign run    = s_axis_surface_tdata;
  assign go     = made_up || (take && state_q == RUNS);
  assign left   = first_q ? run.column - from_q : edge_q;
  assign top    = first_q ? run.line : top_q;
  assign end_x  = (COUNT_W + 1)'(x_q1) + (COUNT_W + 1)'(count_q1);
  assign beyond = x_q1[PLACE_W] || y_q1[PLACE_W] || end_x > (COUNT_W + 1)'(columns_q1) || y_q1 >= lines_q1 ||
                  (seen_q && !first_q1 && y_q1 <= before_q);
  assign drop   = empty_q1 ? !last_q1 : beyond;
  always_ff @(posedge clk_i) begin
    valid_q1   <= go && !rst_i;
    last_q1    <= made_up || s_axis_surface_tlast;
    empty_q1   <= run.count == '0;
    bad_q1     <= bad_q;
    // of the first run the place in the box is given
    x_q1       <= first_q ? (PLACE_W + 1)'(from_q) : (PLACE_W + 1)'(run.column) - (PLACE_W + 1)'(edge_q);
    y_q1       <= first_q ? '0 : (PLACE_W + 1)'(run.line) - (PLACE_W + 1)'(top_q);
    if (go) {edge_q, top_q} <= {left, top};
    place_valid_o <= go && first_q && !rst_i;
    place_o       <= {tag_q, top, left};
    count_q1   <= run.count;
    columns_q1 <= columns_q;
    lines_q1   <= lines_q;
    first_q1   <= first_q;
    if (beat || go) first_q <= beat;
    if (valid_q1) begin
      seen_q <= (seen_q && !first_q1) || (!drop && !empty_q1);
      if (!drop && !empty_q1) before_q <= y_q1;
    end
    run_o       <= {last_q1, empty_q1 || drop || bad_q1, y_q1[PLACE_W-1:0], x_q1[PLACE_W-1:0], end_x[COUNT_W-1:0]};
    run_valid_o <= valid_q1 && (bad_q1 || drop ? last_q1 : 1'b1) && !rst_i;

    error_o                          <= '0;
    error_o[shade_pkg::ERROR_EMPTY]  <= take && state_q == BOX && !lobe && !s_axis_surface_tlast && no_box;
    error_o[shade_pkg::ERROR_LONG]   <= valid_q1 && drop && !bad_q1 && !(empty_q1 && first_q1);
    error_o[shade_pkg::ERROR_DIRECT] <= take && head && s_axis_surface_tlast && !(state_q == BOX && lobe);
    if (rst_i) error_o <= '0;
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, run, 1'(DATA_W)};
endmodule
