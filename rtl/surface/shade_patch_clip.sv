// SPDX-License-Identifier: Apache-2.0
// shade_patch_clip: cuts a row of boxes out of its runs: box by box, line by line, which of the box's pixels are there.
//
//   row_*, line_o, first_i, end_i   of shade_patch_rows
//   token_o   {first, count}        of every line of a box: the first pixel and how many, 0 .. 16;
//             token_keep_o          with a box's last one: the box is drawn from its tokens; token_drop_o: forget them
//   box_o     {end, direct, deep, pixels, row, column}   a box that has pixels, the last of them in line deep. direct: they are lit one by one, because of
//             direct_i or as a box of 4 x 4 with at most PATCH_SMALL of them; pixels: which, line by line, in a box of 4 x 4
//             end: no box, the triangle is done
//   room_i    stops the walk; up to five tokens and boxes still come
//
// A line of a box a clock, one more for each row, two for a triangle. Latency 3 clocks.
// Example: kx = ky = 2, a line 3 .. 5 -> boxes 0: token {3, 1}, and 1: {0, 2}; both direct.
module shade_patch_clip (
  input  logic                               clk_i,
  input  logic                               rst_i,
  input  logic                               row_valid_i,
  output logic                               row_take_o,
  input  logic [  shade_pkg::PATCH_AT_W-1:0] row_i,
  input  logic [                       15:0] mask_i,
  input  logic [shade_pkg::PATCH_LOG2_MAX-1:0] deep_i,
  input  logic [     shade_pkg::PLACE_W-1:0] least_i,
  input  logic [     shade_pkg::COUNT_W-1:0] past_i,
  input  logic                               last_i,
  input  logic [                        2:0] kx_i,
  input  logic [                        2:0] ky_i,
  input  logic                               direct_i,
  output logic [shade_pkg::PATCH_LOG2_MAX-1:0] line_o,
  input  logic [     shade_pkg::PLACE_W-1:0] first_i,
  input  logic [     shade_pkg::COUNT_W-1:0] end_i,
  input  logic                               room_i,
  output logic                               token_valid_o,
  output logic [shade_pkg::PATCH_TOKEN_W-1:0] token_o,
  output logic                               token_keep_o,
  output logic                               token_drop_o,
  output logic                               box_valid_o,
  output logic [shade_pkg::PATCH_BOX_W-1:0]  box_o
);
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int AT_W = shade_pkg::PATCH_AT_W;
  localparam int LOG2 = shade_pkg::PATCH_LOG2_MAX;
  localparam int REL_W = COUNT_W + 1;

  // ---- the walk ----------------------------------------------------------------------------------------------------------
  logic active_q, end_q, step, box_end, row_end;
  logic [AT_W-1:0] column_q, final_q;
  logic [LOG2-1:0] line_q;
  logic [COUNT_W-1:0] most;
  assign most     = past_i - COUNT_W'(1);
  assign line_o     = line_q;
  assign step       = active_q && room_i;
  assign box_end    = line_q == deep_i;
  assign row_end    = box_end && column_q == final_q;
  assign row_take_o = end_q || (step && row_end && !last_i);
  always_ff @(posedge clk_i) begin
    if (!active_q) begin
      column_q <= AT_W'(least_i >> kx_i);
      final_q  <= AT_W'(most >> kx_i);
      line_q   <= '0;
    end else if (step) begin
      line_q <= box_end ? '0 : line_q + LOG2'(1);
      if (box_end) column_q <= column_q + AT_W'(1);
    end
    if (!active_q) active_q <= row_valid_i && !end_q && mask_i != '0;
    else if (step && row_end) active_q <= 1'b0;
    end_q <= !end_q && last_i && (active_q ? step && row_end : row_valid_i && mask_i == '0 && room_i);
    if (rst_i) begin
      active_q <= 1'b0;
      end_q    <= 1'b0;
    end
  end

  // ---- a line: its run, relative to the box --------------------------------------------------------------------------------
  logic valid_q1, start_q1, ends_q1, done_q1, small_q1, direct_q1;
  logic [2:0] kx_q1;
  logic signed [REL_W-1:0] from_q1, to_q1;
  logic [AT_W-1:0] row_q1, column_q1;
  logic [LOG2-1:0] line_q1;
  logic [COUNT_W-1:0] base;
  assign base = COUNT_W'(column_q) << kx_i;
  always_ff @(posedge clk_i) begin
    valid_q1  <= step;
    done_q1   <= end_q;
    start_q1  <= line_q == '0;
    ends_q1   <= box_end;
    kx_q1     <= kx_i;
    small_q1  <= kx_i == 3'd2 && ky_i == 3'd2;
    direct_q1 <= direct_i;
    from_q1   <= REL_W'(first_i) - REL_W'(base);
    // a line without a run ends where the box begins
    to_q1     <= mask_i[line_q] ? REL_W'(end_i) - REL_W'(base) : '0;
    row_q1    <= row_i;
    column_q1 <= column_q;
    line_q1   <= line_q;
    if (rst_i) {valid_q1, done_q1} <= 2'b00;
  end

  // first and end, limited to the box
  logic [LOG2:0] width, from_q2, to_q2, count;
  logic [3:0] here;
  logic valid_q2, start_q2, ends_q2, done_q2, small_q2, direct_q2;
  logic [AT_W-1:0] row_q2, column_q2;
  logic [LOG2-1:0] line_q2;
  assign width = (LOG2 + 1)'(1) << kx_q1;
  assign count = to_q2 > from_q2 ? to_q2 - from_q2 : '0;
  always_ff @(posedge clk_i) begin
    from_q2 <= from_q1[REL_W-1] ? '0 : from_q1 > $signed(REL_W'(width)) ? width : from_q1[LOG2:0];
    to_q2   <= to_q1[REL_W-1] ? '0 : to_q1 > $signed(REL_W'(width)) ? width : to_q1[LOG2:0];
    {valid_q2, done_q2} <= rst_i ? 2'b00 : {valid_q1, done_q1};
    {start_q2, ends_q2, small_q2, direct_q2} <= {start_q1, ends_q1, small_q1, direct_q1};
    {row_q2, column_q2, line_q2} <= {row_q1, column_q1, line_q1};
  end
  always_comb begin
    for (int i = 0; i < 4; i++) here[i] = (LOG2 + 1)'(i) >= from_q2 && (LOG2 + 1)'(i) < to_q2;
  end

  // ---- a box: its pixels ---------------------------------------------------------------------------------------------------
  localparam int SUM_W = LOG2 + 2;
  localparam int LIMIT = 1 << (SUM_W - 1);  // as good as more
  logic [SUM_W-1:0] sum_q, sum;
  logic [15:4] pixels_q;
  logic [15:0] pixels;
  logic direct;
  logic [LOG2-1:0] deep_q, deep;  // the last line that has pixels
  assign deep   = start_q2 || count != '0 ? line_q2 : deep_q;
  assign sum    = (start_q2 ? '0 : sum_q[SUM_W-1] ? SUM_W'(LIMIT) : sum_q) + SUM_W'(count);
  assign pixels = {here, start_q2 ? 12'd0 : pixels_q};
  assign direct = direct_q2 || (small_q2 && sum <= SUM_W'(shade_pkg::PATCH_SMALL));
  always_ff @(posedge clk_i) begin
    if (valid_q2) begin
      sum_q    <= sum;
      deep_q   <= deep;
      pixels_q <= pixels[15:4];
    end
    token_valid_o <= valid_q2;
    token_o       <= {from_q2[LOG2-1:0], count};
    token_keep_o  <= valid_q2 && ends_q2 && !direct && sum != '0;
    token_drop_o  <= valid_q2 && ends_q2 && (direct || sum == '0);
    box_valid_o   <= done_q2 || (valid_q2 && ends_q2 && sum != '0);
    // the first line at the bottom: lines that are not there are empty
    box_o         <= {done_q2, direct, deep, pixels >> {~line_q2[1:0], 2'b00}, row_q2, column_q2};
    if (rst_i) {token_valid_o, box_valid_o} <= 2'b00;
  end
endmodule
