// SPDX-License-Identifier: Apache-2.0
// formal_saturate: shade_saturate, shade_limit and shade_clamp are min(max(x, low), high).
module formal_saturate #(
  parameter int WIDTH = 20,
  parameter int OUT_W = 16
) (
  input logic                    clk_i,
  input logic signed [WIDTH-1:0] x_i
);
  localparam int F = OUT_W - 1;
  logic [OUT_W-1:0] saturated, limited;
  logic [F:0] clamped;
  logic told;
  shade_saturate #(.WIDTH(WIDTH), .OUT_W(OUT_W)) u_saturate (.x_i, .y_o(saturated));
  shade_limit #(.WIDTH(WIDTH), .OUT_W(OUT_W)) u_limit (.x_i, .y_o(limited));
  shade_clamp #(.WIDTH(WIDTH), .F(F)) u_clamp (.x_i, .y_o(clamped), .clamped_o(told));

  function automatic logic signed [WIDTH-1:0] between(
    input logic signed [WIDTH-1:0] x, input logic signed [WIDTH-1:0] low, input logic signed [WIDTH-1:0] high
  );
    between = x < low ? low : x > high ? high : x;
  endfunction
  localparam logic signed [WIDTH-1:0] HALF = WIDTH'(1) <<< (OUT_W - 1);
  logic signed [WIDTH-1:0] one;
  assign one = between(x_i, '0, WIDTH'(1) <<< F);
  always_ff @(posedge clk_i) begin
    // Into [0, 2^OUT_W - 1].
    // mutant: too_large = |(x_i >> OUT_W) => too_large = x_i[OUT_W]
    saturate : assert (saturated == OUT_W'(between(x_i, '0, (HALF <<< 1) - WIDTH'(1))));
    // Into [-2^(OUT_W-1), 2^(OUT_W-1) - 1].
    // mutant: x_i == WIDTH'(low) => (x_i <<< 1) == (WIDTH'(low) <<< 1)
    limit : assert (limited == OUT_W'(between(x_i, -HALF, HALF - WIDTH'(1))));
    // Into [0, 1], and whether that changed anything.
    // mutant: x_i > ONE => x_i >= ONE
    clamp : assert (clamped == one[F:0] && told == (one != x_i));
  end
endmodule
