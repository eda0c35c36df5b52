// SPDX-License-Identifier: Apache-2.0
// shade_patch_door: takes packets of s_axis_surface apart: a triangle, four beats, and its runs; words of the table.
//
//   s_axis_surface   packets TRIANGLE and RUN of docs/interface.md; a beat with tuser = 1 is no part of them: it writes
//                    word tdata[31:0] of the lobe's table at tdata[40:32], while no pixel is inside
//   triangle_o       stays until pass_i and until its last run; put_o with its place, the upper left corner of its box, behind
//                    its first run
//   run_valid_o      a run, places relative to the triangle's box: {last, empty, line, first, end}, end exclusive
//   run_room_i       as long as it is 1, two more runs may come
//   error_o          for one clock: ERROR_EMPTY, a triangle without a box: it is dropped; ERROR_LONG, a run that is empty but
//                    not the last, beyond the box, or not below the one before it: it is dropped; ERROR_DIRECT, a packet
//                    that ends among the first four beats
//
// A beat a clock. Latency: a run 2 clocks, a triangle 1 clock behind its fourth beat.
// Example: 4 columns, 1 line, left 0, run (10, 20, 4), tlast -> place (10, 20), run {1, 0, 0, 0, 4}.
module shade_patch_door (
  input  logic                                        clk_i,
  input  logic                                        rst_i,
  input  logic                                        s_axis_surface_tvalid,
  output logic                                        s_axis_surface_tready,
  input  logic [        shade_pkg::SURFACE_DATA_W-1:0] s_axis_surface_tdata,
  input  logic                                        s_axis_surface_tuser,
  input  logic                                        s_axis_surface_tlast,
  output logic                                        triangle_valid_o,
  output shade_pkg::triangle_t                        triangle_o,
  input  logic                                        pass_i,
  output logic                                        put_o,
  output logic [2*shade_pkg::PLACE_W-1:0]             place_o,  // {line, column}
  output logic                                        run_valid_o,
  output logic [shade_pkg::PATCH_RUN_W-1:0]           run_o,
  input  logic                                        run_room_i,
  output logic                                        table_write_o,
  output logic [shade_pkg::PATCH_TABLE_LOG2-1:0]      table_at_o,
  output logic [                               31:0]  table_o,
  output logic [         shade_pkg::ERROR_W-1:0]      error_o
);
  localparam int DATA_W = shade_pkg::SURFACE_DATA_W;
  localparam int BEATS = shade_pkg::TRIANGLE_BEATS;
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int PLACE_W = shade_pkg::PLACE_W;

  // ---- beats ---------------------------------------------------------------------------------------------------------
  logic [2:0] beat_q;  // BEATS: runs
  logic [DATA_W*BEATS-1:0] head_q;
  logic head, take, packet, bad_q, ready_q;
  assign triangle_o = head_q;
  assign head       = beat_q != 3'(BEATS);
  assign take       = s_axis_surface_tvalid && s_axis_surface_tready;
  assign packet     = take && !s_axis_surface_tuser;
  assign s_axis_surface_tready = ready_q && (!triangle_valid_o || !head) && (head || run_room_i);

  function automatic logic none(input logic [COUNT_W-1:0] n);  // a side that is no side: 0, or more than 4096
    none = n == '0 || n > COUNT_W'(shade_pkg::PIXELS_MAX);
  endfunction
  shade_pkg::triangle_t last_beat;  // as it will stand in head_q
  logic no_box;
  assign last_beat = {s_axis_surface_tdata, head_q[DATA_W*(BEATS-1)-1:0]};
  assign no_box    = none(last_beat.columns) || none(last_beat.lines);

  for (genvar i = 0; i < BEATS; i++) begin : g_head
    always_ff @(posedge clk_i) if (packet && beat_q == 3'(i)) head_q[DATA_W*i+:DATA_W] <= s_axis_surface_tdata;
  end
  always_ff @(posedge clk_i) begin
    ready_q <= 1'b1;
    if (pass_i) triangle_valid_o <= 1'b0;
    if (packet) begin
      if (head) begin
        beat_q <= s_axis_surface_tlast ? 3'd0 : beat_q + 3'd1;
        if (beat_q == 3'(BEATS - 1) && !s_axis_surface_tlast) begin
          triangle_valid_o <= !no_box;
          bad_q            <= no_box;
        end
      end else if (s_axis_surface_tlast) beat_q <= 3'd0;
    end
    if (rst_i) begin
      ready_q          <= 1'b0;
      beat_q           <= 3'd0;
      triangle_valid_o <= 1'b0;
    end
  end

  // ---- runs, relative to the box ---------------------------------------------------------------------------------------
  shade_pkg::run_t run;
  logic valid_q1, last_q1, empty_q1, first_q, first_q1, seen_q;  // seen: a run of this triangle
  logic [PLACE_W:0] x_q1, y_q1, before_q;  // with a borrow
  logic [PLACE_W-1:0] edge_q, top_q, left, top;
  logic [COUNT_W-1:0] count_q1, columns_q1, lines_q1;
  logic [COUNT_W:0] end_x;
  logic beyond, drop;
  assign run    = s_axis_surface_tdata;
  assign left   = first_q ? run.column - triangle_o.left : edge_q;
  assign top    = first_q ? run.line : top_q;
  assign end_x  = (COUNT_W + 1)'(x_q1) + (COUNT_W + 1)'(count_q1);
  assign beyond = x_q1[PLACE_W] || y_q1[PLACE_W] || end_x > (COUNT_W + 1)'(columns_q1) || y_q1 >= lines_q1 ||
                  (seen_q && !first_q1 && y_q1 <= before_q);
  assign drop   = empty_q1 ? !last_q1 : beyond;
  always_ff @(posedge clk_i) begin
    valid_q1   <= packet && !head && !bad_q;
    last_q1    <= s_axis_surface_tlast;
    empty_q1   <= run.count == '0;
    // of the first run the place in the box is given
    x_q1       <= first_q ? (PLACE_W + 1)'(triangle_o.left) : (PLACE_W + 1)'(run.column) - (PLACE_W + 1)'(edge_q);
    y_q1       <= first_q ? '0 : (PLACE_W + 1)'(run.line) - (PLACE_W + 1)'(top_q);
    if (packet && !head) begin
      edge_q <= left;
      top_q  <= top;
    end
    put_o      <= packet && !head && !bad_q && first_q && !rst_i;
    place_o    <= {top, left};
    count_q1   <= run.count;
    columns_q1 <= triangle_o.columns;
    lines_q1   <= triangle_o.lines;
    first_q1   <= first_q;
    if (packet) first_q <= head;
    if (valid_q1) begin
      seen_q <= (seen_q && !first_q1) || (!drop && !empty_q1);
      if (!drop && !empty_q1) before_q <= y_q1;
    end
    run_o       <= {last_q1, empty_q1 || drop, y_q1[PLACE_W-1:0], x_q1[PLACE_W-1:0], end_x[COUNT_W-1:0]};
    run_valid_o <= valid_q1 && (!drop || last_q1);

    error_o                          <= '0;
    error_o[shade_pkg::ERROR_EMPTY]  <= packet && head && beat_q == 3'(BEATS - 1) && !s_axis_surface_tlast && no_box;
    error_o[shade_pkg::ERROR_LONG]   <= valid_q1 && drop;
    error_o[shade_pkg::ERROR_DIRECT] <= packet && head && s_axis_surface_tlast;
    if (rst_i) begin
      valid_q1    <= 1'b0;
      run_valid_o <= 1'b0;
      error_o     <= '0;
    end
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, last_beat, run};

  always_ff @(posedge clk_i) begin
    table_at_o    <= s_axis_surface_tdata[32+:shade_pkg::PATCH_TABLE_LOG2];
    table_o       <= s_axis_surface_tdata[31:0];
    table_write_o <= take && s_axis_surface_tuser;
  end
endmodule
