// SPDX-License-Identifier: Apache-2.0
// shade_patch_clip: cuts a row of boxes out of its runs: box by box, two lines at a time, which of the box's pixels are
// there. Rows of an odd number go from right to left, so that the next one begins where one ends.
//
//   row_*, pair_o, even_i, odd_i   of shade_patch_rows
//   token_o   {first, count} of an odd line, {first, count} of the even one above it: the first pixel and how many, 0 .. 16;
//             token_keep_o          with a box's last ones: the box is drawn from its tokens; token_drop_o: forget them
//   box_o     {end, direct, deep, pixels, row, column}   a box that has pixels, the last of them in line deep. direct: they are
//             lit one by one, because of the plan or as a box of 4 x 4 with at most PATCH_SMALL of them; pixels: which, line
//             by line, in a box of 4 x 4. end: no box, the triangle is done
//   room_i    stops the walk; up to five tokens and boxes still come
//
// Two lines of a box a clock, one more for each row, two for a triangle. Latency 3 clocks.
// Example: kx = ky = 2, a line 3 .. 5 -> boxes 0: token {3, 1}, and 1: {0, 2}; both direct.
module shade_patch_clip (
  input  logic                                 clk_i,
  input  logic                                 rst_i,
  input  logic                                 row_valid_i,
  output logic                                 row_take_o,
  input  logic [    shade_pkg::PATCH_AT_W-1:0] row_i,
  input  logic [                         15:0] mask_i,
  input  logic [shade_pkg::PATCH_LOG2_MAX-2:0] deep_i,
  input  logic [    shade_pkg::PATCH_AT_W-1:0] least_i,
  input  logic [    shade_pkg::PATCH_AT_W-1:0] most_i,
  input  logic                                 last_i,
  input  logic [  shade_pkg::PATCH_PLAN_W-1:0] plan_i,
  output logic [shade_pkg::PATCH_LOG2_MAX-2:0] pair_o,
  input  logic [  shade_pkg::PATCH_LINE_W-1:0] even_i,
  input  logic [  shade_pkg::PATCH_LINE_W-1:0] odd_i,
  input  logic                                 room_i,
  output logic                                 token_valid_o,
  output logic [2*shade_pkg::PATCH_TOKEN_W-1:0] token_o,
  output logic                                 token_keep_o,
  output logic                                 token_drop_o,
  output logic                                 box_valid_o,
  output logic [   shade_pkg::PATCH_BOX_W-1:0] box_o
);
  localparam int AT_W = shade_pkg::PATCH_AT_W;
  localparam int LOG2 = shade_pkg::PATCH_LOG2_MAX;

  // ---- the walk ----------------------------------------------------------------------------------------------------------
  logic active_q, end_q, step, box_end, row_end;
  logic [AT_W-1:0] column_q;
  logic [LOG2-2:0] pair_q;
  assign pair_o     = pair_q;
  assign step       = active_q && room_i;
  assign box_end    = pair_q == deep_i;
  assign row_end    = box_end && column_q == (row_i[0] ? least_i : most_i);
  assign row_take_o = end_q || (step && row_end && !last_i);
  always_ff @(posedge clk_i) begin
    if (!active_q) begin
      column_q <= row_i[0] ? most_i : least_i;
      pair_q   <= '0;
    end else if (step) begin
      pair_q <= box_end ? '0 : pair_q + (LOG2 - 1)'(1);
      if (box_end) column_q <= row_i[0] ? column_q - AT_W'(1) : column_q + AT_W'(1);
    end
    if (!active_q) active_q <= row_valid_i && !end_q && mask_i != '0;
    else if (step && row_end) active_q <= 1'b0;
    end_q <= !end_q && last_i && (active_q ? step && row_end : row_valid_i && mask_i == '0 && room_i);
    if (rst_i) begin
      active_q <= 1'b0;
      end_q    <= 1'b0;
    end
  end
  logic valid_q1, start_q1, ends_q1, done_q1, valid_q2, start_q2, ends_q2, done_q2;
  logic [shade_pkg::PATCH_PLAN_W-1:0] plan_q1;
  logic direct_q2, small_q2;
  logic [AT_W-1:0] row_q1, column_q1, row_q2, column_q2;
  logic [LOG2-2:0] pair_q1, pair_q2;
  always_ff @(posedge clk_i) begin
    {valid_q1, done_q1} <= rst_i ? 2'b00 : {step, end_q};
    {valid_q2, done_q2} <= rst_i ? 2'b00 : {valid_q1, done_q1};
    {start_q1, ends_q1, plan_q1, row_q1, column_q1, pair_q1} <= {pair_q == '0, box_end, plan_i, row_i, column_q, pair_q};
    {start_q2, ends_q2, row_q2, column_q2, pair_q2} <= {start_q1, ends_q1, row_q1, column_q1, pair_q1};
    direct_q2 <= plan_q1[6];
    small_q2  <= plan_q1[5:0] == {2{3'(shade_pkg::PATCH_LOG2_MIN)}};
  end

  // ---- a line's run in the box: all of it, from its first pixel, to its last one -------------------------------------------------
  logic [1:0][LOG2:0] count;
  logic [1:0][LOG2-1:0] from;
  logic [1:0][3:0] here;
  for (genvar i = 0; i < 2; i++) begin : g_line
    logic [AT_W-1:0] first_box, last_box;
    logic [LOG2-1:0] first, last, first_q1, last_q1, from_q2, last_q2;
    logic inside_q1, first_here_q1, last_here_q1, inside_q2;
    assign {last_box, last, first_box, first} = i == 0 ? even_i : odd_i;
    always_ff @(posedge clk_i) begin
      inside_q1         <= mask_i[{pair_q, i == 1}] && first_box <= column_q && last_box >= column_q;
      first_here_q1     <= first_box == column_q;
      last_here_q1      <= last_box == column_q;
      {first_q1, last_q1} <= {first, last};
      inside_q2         <= inside_q1;
      from_q2           <= first_here_q1 && inside_q1 ? first_q1 : '0;
      last_q2           <= last_here_q1 ? last_q1 : ~(LOG2'('1) << plan_q1[5:3]);
    end
    assign from[i]  = from_q2;
    assign count[i] = inside_q2 ? (LOG2 + 1)'(last_q2) - (LOG2 + 1)'(from_q2) + (LOG2 + 1)'(1) : '0;
    assign here[i]  = inside_q2 ? (4'hF << from_q2) & ~(4'hE << last_q2) : '0;
  end

  // ---- a box: its pixels ---------------------------------------------------------------------------------------------------
  localparam int SUM_W = LOG2 + 3;
  localparam int LIMIT = 1 << (SUM_W - 1);  // as good as more
  logic [SUM_W-1:0] sum_q, sum;
  logic [15:8] pixels_q;
  logic [15:0] pixels;
  logic direct;
  logic [LOG2-1:0] deep_q, deep;  // the last line that has pixels
  assign deep   = count[1] != '0 ? {pair_q2, 1'b1} : start_q2 || count[0] != '0 ? {pair_q2, 1'b0} : deep_q;
  assign sum    = (start_q2 ? '0 : sum_q[SUM_W-1] ? SUM_W'(LIMIT) : sum_q) + (SUM_W'(count[0]) + SUM_W'(count[1]));
  assign pixels = {here, start_q2 ? 8'd0 : pixels_q};
  assign direct = direct_q2 || (small_q2 && sum <= SUM_W'(shade_pkg::PATCH_SMALL));
  always_ff @(posedge clk_i) begin
    if (valid_q2) begin
      sum_q    <= sum;
      deep_q   <= deep;
      pixels_q <= pixels[15:8];
    end
    token_valid_o <= valid_q2;
    token_o       <= {from[1], count[1], from[0], count[0]};
    token_keep_o  <= valid_q2 && ends_q2 && !direct && sum != '0;
    token_drop_o  <= valid_q2 && ends_q2 && (direct || sum == '0);
    box_valid_o   <= done_q2 || (valid_q2 && ends_q2 && sum != '0);
    // the first line at the bottom: lines that are not there are empty
    box_o         <= {done_q2, direct, deep, pair_q2[0] ? pixels : pixels >> 8, row_q2, column_q2};
    if (rst_i) {token_valid_o, box_valid_o} <= 2'b00;
  end
endmodule
