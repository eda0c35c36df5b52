// SPDX-License-Identifier: Apache-2.0
// board_timing: 640 x 480 at 60 Hz: where the beam is, a pixel a clock of 25 MHz (25.175 by the standard, 0.7 % more).
//
// A line: 640 pixels, 16 of front porch, 96 of sync, 48 of back porch; 480 lines, 10, 2, 33. Syncs are low active.
// frame_o: the first clock behind the last line that is shown. No latency: all outputs are registers' or decoded from them.
// Example: column 656 .. 751 -> hsync_o = 0.
module board_timing (
  input  logic       clk_i,
  input  logic       rst_i,
  output logic [9:0] column_o,
  output logic [9:0] line_o,
  output logic       shown_o,
  output logic       hsync_o,
  output logic       vsync_o,
  output logic       frame_o
);
  logic last_column, last_line;
  assign last_column = column_o == 10'd799;
  assign last_line   = line_o == 10'd524;
  always_ff @(posedge clk_i) begin
    column_o <= last_column ? 10'd0 : column_o + 10'd1;
    if (last_column) line_o <= last_line ? 10'd0 : line_o + 10'd1;
    if (rst_i) {column_o, line_o} <= '0;
  end
  assign shown_o = column_o < 10'd640 && line_o < 10'd480;
  assign hsync_o = !(column_o >= 10'd656 && column_o < 10'd752);
  assign vsync_o = !(line_o >= 10'd490 && line_o < 10'd492);
  assign frame_o = column_o == 10'd0 && line_o == 10'd480;
endmodule
