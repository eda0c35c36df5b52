// SPDX-License-Identifier: Apache-2.0
// shade_direct_moves: how a run's first pixel is reached from the first pixel of the run before: lines and columns.
//
//   lines = line - (line of the last good run) - 1, columns = column - column of the last good run: negative to the left
//
// A start makes one line down by itself, which is the -1. A triangle's first run is reached by no move: it is the
// reference pixel, even if it is faulty. Faults, for one clock: empty_o, 0 pixels, but for a triangle's first run, and its last,
// which then only ends it; long_o, more than 4096 pixels; order_o, not below the last good run. Such runs have good = 0 and no moves.
// ready_o does not depend on valid_i. Latency 1 clock, a run a clock.
// Example: runs (column 5, line 2), (column 3, line 3) -> second: lines 0, columns -2.
module shade_direct_moves (
  input  logic                clk_i,
  input  logic                rst_i,
  input  logic                valid_i,
  output logic                ready_o,
  input  shade_pkg::waiting_t run_i,
  output logic                valid_o,
  input  logic                ready_i,
  output shade_pkg::moves_t   moves_o,
  output logic                empty_o,
  output logic                long_o,
  output logic                order_o
);
  localparam int W = shade_pkg::PLACE_W;
  localparam int COUNT_W = shade_pkg::COUNT_W;

  logic take;
  assign ready_o = !valid_o || ready_i;
  assign take    = valid_i && ready_o;

  logic [W-1:0] column_q;
  logic [W:0] next_q;  // the line after that of the last good run
  logic [W+1:0] lines;  // with a sign
  logic signed [W:0] columns;
  logic empty, long, order, good;
  assign lines = {2'd0, run_i.line} - {1'b0, next_q};
  assign columns = {1'b0, run_i.column} - {1'b0, column_q};
  assign empty = run_i.count == '0;
  assign long  = run_i.count > COUNT_W'(shade_pkg::PIXELS_MAX);
  assign order = lines[W+1] && !run_i.first;
  assign good  = !empty && !long && !order;

  logic move;
  assign move = good && !run_i.first;
  always_ff @(posedge clk_i) begin
    if (take) begin
      moves_o.lines   <= move ? lines[W:0] : '0;
      moves_o.columns <= move ? columns : '0;
      moves_o.good    <= good;
      moves_o.first   <= run_i.first;
      moves_o.last    <= run_i.last;
      moves_o.count   <= run_i.count;
      moves_o.tag     <= run_i.tag;
      if (good || run_i.first) column_q <= run_i.column;
      if (good || run_i.first) next_q <= {1'b0, run_i.line} + (W + 1)'(good);
    end
    if (ready_o) valid_o <= valid_i;
    empty_o <= take && empty && !run_i.last && !run_i.first;
    long_o  <= take && long;
    order_o <= take && order && !empty && !long;
    if (rst_i) begin
      valid_o <= 1'b0;
      empty_o <= 1'b0;
      long_o  <= 1'b0;
      order_o <= 1'b0;
    end
  end
endmodule
