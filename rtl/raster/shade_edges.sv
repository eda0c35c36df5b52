// SPDX-License-Identifier: Apache-2.0
// shade_edges: the three edges of a triangle as a raster walks them, the two from the top vertex first.
//
// load_i takes vertices 0, 1, 2 (x_i, y_i, S15.8). With some_o an edge stands at the outputs; step_i goes on to the next.
// Of an edge from its upper vertex (x, y) down by dy >= 0 and across by dx:
//
//   line_o, lines_o  first line whose centre is not above y, and on how many the edge lies; 0: on none
//   column_o         the column before the first whose centre is not left of x
//   u_o              (x + 127) mod 256, that is 256 column + 383 - x turned over
//   t_o              256 line + 128 - y, in [0, 256)
//   right_o          it bounds the triangle on its right hand when its area is positive, else on its left
//
// On that line the first column whose centre is not left of the edge is column - floor(r / dy), with
// r = floor(-((u + 1) dy + t dx) / 256), exact; every line below has dx less in r (shade_raster).
// Latency: 4, 6 or 8 clocks from load_i to the first edge, an edge a clock.
// Example: x = 128, y = 0, dx = 2560, dy = 2560: column -1, u 255, t 128; r = -3840, -3840 / 2560 -> -2, column 1.
module shade_edges (
  input  logic                                    clk_i,
  input  logic                                    rst_i,
  input  logic                                    load_i,
  input  logic [2:0][shade_pkg::COORDINATE_W-1:0] x_i,
  input  logic [2:0][shade_pkg::COORDINATE_W-1:0] y_i,
  output logic                                    some_o,
  input  logic                                    step_i,
  output logic signed [shade_pkg::COORDINATE_W:0] dx_o,
  output logic signed [shade_pkg::COORDINATE_W:0] dy_o,
  output logic [          shade_pkg::LINE_W-1:0]  line_o,
  output logic [          shade_pkg::LINE_W-1:0]  lines_o,
  output logic [          shade_pkg::LINE_W-1:0]  column_o,
  output logic [      shade_pkg::SUBPIXEL_F-1:0]  u_o,
  output logic [      shade_pkg::SUBPIXEL_F-1:0]  t_o,
  output logic                                    right_o
);
  localparam int W = shade_pkg::COORDINATE_W;
  localparam int F = shade_pkg::SUBPIXEL_F;
  localparam int HALF = 1 << (F - 1);

  // ---- the vertices in a ring that is turned until the second one is the top; the edge goes from the first to the second
  logic [2:0][W-1:0] x_q, y_q;
  logic above_q, below_q;  // the second lies above the first, the third above the second
  logic compare_q, look_q, top_q, top, turn, next, below;
  assign below = $signed(y_q[2]) < $signed(y_q[1]);
  assign top   = above_q && !below_q;
  assign next  = (top_q && !some_o) || step_i;
  assign turn  = next || (look_q && !top);
  always_ff @(posedge clk_i) begin
    if (load_i) begin
      x_q <= {x_i[1], x_i[0], x_i[2]};
      y_q <= {y_i[1], y_i[0], y_i[2]};
    end else if (turn) begin
      x_q <= {x_q[0], x_q[2:1]};
      y_q <= {y_q[0], y_q[2:1]};
    end
    above_q   <= $signed(y_q[1]) < $signed(y_q[0]);
    below_q   <= below;
    compare_q <= load_i || (look_q && !top);
    look_q    <= compare_q && !load_i;
    top_q     <= !load_i && (top_q || (look_q && top));
    some_o    <= !load_i && (some_o || top_q);
    if (rst_i) {compare_q, look_q, top_q, some_o} <= '0;
  end

  // ---- from the upper to the lower vertex: of the first edge the second one, of the second the first --------------------
  logic up_q, second_q;
  logic signed [W-1:0] x_top, x_end, y_top, y_end;
  logic [W:0] x_near, y_near, y_last;
  assign {x_top, x_end} = up_q ? {x_q[1], x_q[0]} : {x_q[0], x_q[1]};
  assign {y_top, y_end} = up_q ? {y_q[1], y_q[0]} : {y_q[0], y_q[1]};
  assign x_near = (W + 1)'(x_top) + (W + 1)'(HALF - 1 - 2 * HALF);
  assign y_near = (W + 1)'(y_top) + (W + 1)'(HALF - 1);
  assign y_last = (W + 1)'(y_end) + (W + 1)'(HALF - 1);
  always_ff @(posedge clk_i) begin
    if (!top_q) {up_q, second_q} <= 2'b10;
    else if (next) {up_q, second_q} <= {second_q && below, 1'b1};
    if (next) begin
      dx_o     <= (W + 1)'(x_end) - (W + 1)'(x_top);
      dy_o     <= (W + 1)'(y_end) - (W + 1)'(y_top);
      column_o <= x_near[W:F];
      line_o   <= y_near[W:F];
      lines_o  <= y_last[W:F] - y_near[W:F];
      u_o      <= x_near[F-1:0];
      t_o      <= ~y_near[F-1:0];
      right_o  <= !up_q;
    end
  end
  logic unused_last;
  assign unused_last = ^y_last[F-1:0];
endmodule
