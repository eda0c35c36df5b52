// SPDX-License-Identifier: Apache-2.0
// shade_patch_rows: gathers the runs of a triangle that lie in one row of its boxes, line by line, in one of two banks.
//
//   triangle_valid_i, ky_i   a triangle that is taken with its first run: triangle_take_o
//   run_i   {last, empty, line, first, end} of shade_patch_door, taken with run_ready_o
//   row_valid_o   a row is complete: its number row_o, the lines mask_o that have a run, the deepest of them, the least first and
//                 the largest end, whether it is the triangle's last (mask_o may then be 0); row_take_i frees it
//   line_i -> first_o, end_o   the run of a line of that row, in the same clock
//
// A run a clock, one more for each row. Latency of a row: 1 clock behind the run that ends it. Example: ky = 2, runs in lines 3, 4 -> rows 0, mask 1000, and 1, mask 0001.
module shade_patch_rows (
  input  logic                               clk_i,
  input  logic                               rst_i,
  input  logic                               triangle_valid_i,
  output logic                               triangle_take_o,
  input  logic [                        2:0] kx_i,
  input  logic [                        2:0] ky_i,
  input  logic                               direct_i,
  input  logic                               run_valid_i,
  output logic                               run_ready_o,
  input  logic [shade_pkg::PATCH_RUN_W-1:0]  run_i,
  output logic                               row_valid_o,
  input  logic                               row_take_i,
  output logic [  shade_pkg::PATCH_AT_W-1:0] row_o,
  output logic [                       15:0] mask_o,
  output logic [shade_pkg::PATCH_LOG2_MAX-1:0] deep_o,
  output logic [     shade_pkg::PLACE_W-1:0] least_o,
  output logic [     shade_pkg::COUNT_W-1:0] past_o,
  output logic                               last_o,
  output logic [                        2:0] kx_o,
  output logic [                        2:0] ky_o,
  output logic                               direct_o,
  input  logic [shade_pkg::PATCH_LOG2_MAX-1:0] line_i,
  output logic [     shade_pkg::PLACE_W-1:0] first_o,
  output logic [     shade_pkg::COUNT_W-1:0] end_o
);
  localparam int PLACE_W = shade_pkg::PLACE_W;
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int LOG2 = shade_pkg::PATCH_LOG2_MAX;
  localparam int LINES = 1 << LOG2;

  logic last, empty;
  logic [PLACE_W-1:0] line, first;
  logic [COUNT_W-1:0] run_end;
  assign {last, empty, line, first, run_end} = run_i;

  // ---- where a run goes: in the row that is open, or into a new one ------------------------------------------------------
  logic busy_q, open_q, bank_q, full_q, other, put, close;  // full: the other bank
  logic [2:0] kx_q, ky_q;
  logic direct_q;
  logic [PLACE_W-1:0] row;
  logic [LOG2-1:0] slot, deep_q;
  logic [shade_pkg::PATCH_AT_W-1:0] row_q;
  logic [LINES-1:0] mask_q, mask;
  logic [PLACE_W-1:0] least_q, least;
  logic [COUNT_W-1:0] past_q, past;
  assign row   = line >> ky_q;
  assign slot  = LOG2'(line) & ~(LOG2'('1) << ky_q);
  assign other = open_q && !empty && row != PLACE_W'(row_q);  // of the next row
  assign put   = busy_q && run_valid_i && !other && !(full_q && last);
  assign close = busy_q && run_valid_i && !full_q && (other || last);
  assign run_ready_o     = put;
  assign triangle_take_o = triangle_valid_i && !busy_q;
  assign row_valid_o     = full_q;

  logic add;
  assign add   = put && !empty;
  assign mask  = (open_q ? mask_q : '0) | (add ? LINES'(1) << slot : '0);
  assign least = add && (!open_q || first < least_q) ? first : least_q;
  assign past  = add && (!open_q || run_end > past_q) ? run_end : past_q;

  logic [PLACE_W+COUNT_W-1:0] memory[0:2*LINES-1];
  always_ff @(posedge clk_i) begin
    if (add) memory[{bank_q, slot}] <= {first, run_end};
  end
  assign {first_o, end_o} = memory[{!bank_q, line_i}];

  always_ff @(posedge clk_i) begin
    mask_q  <= mask;
    least_q <= least;
    past_q  <= past;
    if (add) begin
      row_q  <= row[shade_pkg::PATCH_AT_W-1:0];
      deep_q <= slot;
    end
    if (close) begin
      row_o    <= add ? row[shade_pkg::PATCH_AT_W-1:0] : row_q;
      deep_o   <= add ? slot : deep_q;
      mask_o   <= mask;
      least_o  <= least;
      past_o   <= past;
      last_o   <= put && last;
      kx_o     <= kx_q;
      ky_o     <= ky_q;
      direct_o <= direct_q;
      bank_q   <= !bank_q;
    end
    if (triangle_take_o) {direct_q, kx_q, ky_q} <= {direct_i, kx_i, ky_i};

    if (close) open_q <= 1'b0;
    else if (add) open_q <= 1'b1;
    if (triangle_take_o) busy_q <= 1'b1;
    else if (put && last) busy_q <= 1'b0;
    if (close) full_q <= 1'b1;
    else if (row_take_i) full_q <= 1'b0;
    if (rst_i) begin
      open_q <= 1'b0;
      busy_q <= 1'b0;
      full_q <= 1'b0;
      bank_q <= 1'b0;
    end
  end
endmodule
