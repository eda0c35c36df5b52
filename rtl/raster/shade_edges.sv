// SPDX-License-Identifier: Apache-2.0
// shade_edges: the three edges of a triangle as a raster walks them, the two from the top vertex first.
//
// load_i takes vertex 0, and the two clocks behind it 1 and 2: x_i and y_i plus 127 (S15.8, see shade_vertices). With some_o an edge stands at the outputs;
// step_i goes on to the next. side_o, of an edge from its upper vertex (x, y) down by dy >= 0 and across by dx:
//
//   line, lines  first line whose centre is not above y, and on how many the edge lies; 0: on none
//   column       first column whose centre is not left of x
//   u            (x + 127) mod 256, that is 256 column + 127 - x turned over
//   t            256 line + 128 - y, in [0, 256)
//   right        it bounds the triangle on its right hand when its area is positive, else on its left
//
// On that line the first column whose centre is not left of the edge is column - 1 - floor(r / dy), with
// r = floor(-((u + 1) dy + t dx) / 256), exact; every line below has dx less in r (shade_raster).
// Latency: 6, 8 or 10 clocks from load_i to the first edge, an edge a clock.
// Example: x = 128, y = 0, dx = 2560, dy = 2560: column 0, u 255, t 128; r = -3840, -3840 / 2560 -> -2, column 1.
module shade_edges (
  input  logic                                    clk_i,
  input  logic                                    rst_i,
  input  logic                                    load_i,
  input  logic [  shade_pkg::COORDINATE_W:0]      x_i,
  input  logic [  shade_pkg::COORDINATE_W:0]      y_i,
  output logic                                    some_o,
  input  logic                                    step_i,
  output shade_pkg::side_t                        side_o
);
  localparam int W = shade_pkg::COORDINATE_W;
  localparam int F = shade_pkg::SUBPIXEL_F;

  // ---- the vertices in a ring that is turned until the second one is the top; the edge goes from the first to the second
  logic [2:0][W:0] x_q, y_q;
  logic above_q, below_q;  // the second lies above the first, the third above the second
  logic [1:0] fill_q;
  logic fill, compare_q, look_q, top_q, top, turn, next, below;
  assign below = $signed(y_q[2]) < $signed(y_q[1]);
  assign top   = above_q && !below_q;
  assign next  = (top_q && !some_o) || step_i;
  assign fill  = load_i || fill_q != '0;
  assign turn  = next || fill || (look_q && !top);
  always_ff @(posedge clk_i) begin
    if (turn) begin
      x_q <= {fill ? x_i : x_q[0], x_q[2:1]};
      y_q <= {fill ? y_i : y_q[0], y_q[2:1]};
    end
    if (turn) above_q <= below;
    below_q   <= below;
    fill_q    <= {fill_q[0], load_i};
    compare_q <= !load_i && (fill_q[1] || (look_q && !top));
    look_q    <= compare_q && !load_i;
    top_q     <= !load_i && (top_q || (look_q && top));
    some_o    <= !load_i && (some_o || top_q);
    if (rst_i) {fill_q, compare_q, look_q, top_q, some_o} <= '0;
  end

  // ---- from the upper to the lower vertex: of the first edge the second one, of the second the first --------------------
  logic up_q, second_q;
  logic [W:0] x_top, x_end, y_top, y_end;
  assign {x_top, x_end} = up_q ? {x_q[1], x_q[0]} : {x_q[0], x_q[1]};
  assign {y_top, y_end} = up_q ? {y_q[1], y_q[0]} : {y_q[0], y_q[1]};
  always_ff @(posedge clk_i) begin
    if (!top_q) {up_q, second_q} <= 2'b10;
    else if (next) {up_q, second_q} <= {second_q && below, 1'b1};
    if (next) begin
      side_o.dx     <= x_end - x_top;
      side_o.dy     <= W'(y_end - y_top);
      side_o.column <= x_top[W:F];
      side_o.line   <= y_top[W:F];
      side_o.lines  <= y_end[W:F] - y_top[W:F];
      side_o.u      <= x_top[F-1:0];
      side_o.t      <= ~y_top[F-1:0];
      side_o.right  <= !up_q;
    end
  end
endmodule
