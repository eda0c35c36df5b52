// SPDX-License-Identifier: Apache-2.0
// shade_patch_rows: gathers the runs of a triangle that lie in one row of its boxes, line by line, in one of two banks.
//
//   triangle_valid_i, plan_i   {direct, kx, ky} of the triangle whose runs come next: triangle_take_o
//   run_i   {last, empty, line, first, end} of shade_patch_door, taken with run_ready_o
//   row_valid_o   a row is complete: its number row_o, the lines mask_o that have a run, the deepest pair of them, the least and
//                 the largest column of a box, whether it is the triangle's last (mask_o may then be 0); row_take_i frees it
//   pair_i -> even_o, odd_o   the runs of lines 2 pair_i and 2 pair_i + 1 of that row, in the same clock: {last box, last pixel in
//                 it, first box, first pixel in it}
//
// A run a clock, one more for each row, two for a triangle. Latency of a row: 2 clocks behind the run that ends it.
// Example: ky = 2, runs in lines 3, 4 -> rows 0, mask 1000, and 1, mask 0001.
module shade_patch_rows (
  input  logic                                 clk_i,
  input  logic                                 rst_i,
  input  logic                                 triangle_valid_i,
  output logic                                 triangle_take_o,
  input  logic [  shade_pkg::PATCH_PLAN_W-1:0] plan_i,
  input  logic                                 run_valid_i,
  output logic                                 run_ready_o,
  input  logic [   shade_pkg::PATCH_RUN_W-1:0] run_i,
  output logic                                 row_valid_o,
  input  logic                                 row_take_i,
  output logic [    shade_pkg::PATCH_AT_W-1:0] row_o,
  output logic [                         15:0] mask_o,
  output logic [shade_pkg::PATCH_LOG2_MAX-2:0] deep_o,
  output logic [    shade_pkg::PATCH_AT_W-1:0] least_o,
  output logic [    shade_pkg::PATCH_AT_W-1:0] most_o,
  output logic                                 last_o,
  output logic [  shade_pkg::PATCH_PLAN_W-1:0] plan_o,
  input  logic [shade_pkg::PATCH_LOG2_MAX-2:0] pair_i,
  output logic [  shade_pkg::PATCH_LINE_W-1:0] even_o,
  output logic [  shade_pkg::PATCH_LINE_W-1:0] odd_o
);
  localparam int PLACE_W = shade_pkg::PLACE_W;
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int AT_W = shade_pkg::PATCH_AT_W;
  localparam int LINE_W = shade_pkg::PATCH_LINE_W;
  localparam int LOG2 = shade_pkg::PATCH_LOG2_MAX;
  localparam int LINES = 1 << LOG2;

  // ---- a run, split into boxes and pixels in them; is it in another row than the one before -----------------------------------------
  logic last, empty, busy_q, valid_q, last_q, empty_q, other_q, put, load;
  logic [PLACE_W-1:0] line, first, end_in;
  logic [COUNT_W-1:0] run_end;
  logic [shade_pkg::PATCH_PLAN_W-1:0] plan_q;
  logic [2:0] kx, ky;
  logic [LOG2-1:0] slot_q, first_pixel_q, last_pixel_q;
  logic [AT_W-1:0] row_q, row, first_box_q, last_box_q;
  assign {last, empty, line, first, run_end} = run_i;
  assign {kx, ky}        = plan_q[5:0];
  assign end_in          = PLACE_W'(run_end - COUNT_W'(1));
  assign row             = AT_W'(line >> ky);
  assign load            = busy_q && run_valid_i && (!valid_q || (put && !last_q));
  assign run_ready_o     = load;
  assign triangle_take_o = triangle_valid_i && !busy_q;
  always_ff @(posedge clk_i) begin
    if (load) begin
      {last_q, empty_q} <= {last, empty};
      other_q           <= row != row_q;
      row_q             <= row;
      slot_q            <= LOG2'(line) & ~(LOG2'('1) << ky);
      first_box_q       <= AT_W'(first >> kx);
      last_box_q        <= AT_W'(end_in >> kx);
      first_pixel_q     <= LOG2'(first) & ~(LOG2'('1) << kx);
      last_pixel_q      <= LOG2'(end_in) & ~(LOG2'('1) << kx);
    end
    if (triangle_take_o) plan_q <= plan_i;
    if (triangle_take_o) busy_q <= 1'b1;
    else if (put && last_q) busy_q <= 1'b0;
    if (load) valid_q <= 1'b1;
    else if (put) valid_q <= 1'b0;
    if (rst_i) {busy_q, valid_q} <= 2'b00;
  end

  // ---- where it goes: into the row that is open, or into a new one ----------------------------------------------------------------
  logic open_q, bank_q, full_q, other, close, add;  // full: the other bank
  logic [LOG2-2:0] deep_q;
  logic [AT_W-1:0] number_q, least_q, least, most_q, most;
  logic [LINES-1:0] mask_q, mask;
  assign other       = open_q && !empty_q && other_q;
  assign put         = valid_q && !other && !(full_q && last_q);
  assign close       = valid_q && !full_q && (other || last_q);
  assign add         = put && !empty_q;
  assign row_valid_o = full_q;
  assign mask        = (open_q ? mask_q : '0) | (add ? LINES'(1) << slot_q : '0);
  assign least       = add && (!open_q || first_box_q < least_q) ? first_box_q : least_q;
  assign most        = add && (!open_q || last_box_q > most_q) ? last_box_q : most_q;

  logic [LINE_W-1:0] even[0:LINES-1];
  logic [LINE_W-1:0] odd[0:LINES-1];
  logic [LINE_W-1:0] line_new;
  assign line_new = {last_box_q, last_pixel_q, first_box_q, first_pixel_q};
  always_ff @(posedge clk_i) begin
    if (add && !slot_q[0]) even[{bank_q, slot_q[LOG2-1:1]}] <= line_new;
  end
  always_ff @(posedge clk_i) begin
    if (add && slot_q[0]) odd[{bank_q, slot_q[LOG2-1:1]}] <= line_new;
  end
  assign even_o = even[{!bank_q, pair_i}];
  assign odd_o  = odd[{!bank_q, pair_i}];

  always_ff @(posedge clk_i) begin
    {mask_q, least_q, most_q} <= {mask, least, most};
    if (add) {number_q, deep_q} <= {row_q, slot_q[LOG2-1:1]};
    if (close) begin
      row_o    <= add ? row_q : number_q;
      deep_o   <= add ? slot_q[LOG2-1:1] : deep_q;
      {mask_o, least_o, most_o} <= {mask, least, most};
      last_o   <= put && last_q;
      plan_o   <= plan_q;
      bank_q   <= !bank_q;
    end
    if (close) open_q <= 1'b0;
    else if (add) open_q <= 1'b1;
    if (close) full_q <= 1'b1;
    else if (row_take_i) full_q <= 1'b0;
    if (rst_i) {open_q, full_q, bank_q} <= 3'b000;
  end
endmodule
