// SPDX-License-Identifier: Apache-2.0
// shade_patch_norm: about the length of a vector: (largest + sum) / 2 of the absolute values of its components.
//
//   x_i, y_i, z_i   signed, WIDTH bits
//   y_o             WIDTH bits, unsigned, floor: never below the length - 1 ulp, at most 22.5 % above it (of (2, 1, 1))
//
// No multiplier. Latency LATENCY_PATCH_NORM = 3 clocks, one vector a clock. Example: (0, -100, 0) -> 100.
module shade_patch_norm #(
  parameter int WIDTH = 28
) (
  input  logic                    clk_i,
  input  logic signed [WIDTH-1:0] x_i,
  input  logic signed [WIDTH-1:0] y_i,
  input  logic signed [WIDTH-1:0] z_i,
  output logic        [WIDTH-1:0] y_o
);
  if (WIDTH < 2) begin : g_check
    $error("shade_patch_norm: WIDTH must be at least 2");
  end

  // |x| needs all WIDTH bits, unsigned, for the most negative number
  logic [WIDTH-1:0] x_q1, y_q1, z_q1, most_q2;
  logic [WIDTH+1:0] sum_q2;
  logic [WIDTH+2:0] twice;
  logic [WIDTH-1:0] xy;
  assign xy    = x_q1 > y_q1 ? x_q1 : y_q1;
  assign twice = (WIDTH + 3)'(sum_q2) + (WIDTH + 3)'(most_q2);
  logic unused_half;
  assign unused_half = twice[0];
  always_ff @(posedge clk_i) begin
    x_q1    <= x_i[WIDTH-1] ? -x_i : x_i;
    y_q1    <= y_i[WIDTH-1] ? -y_i : y_i;
    z_q1    <= z_i[WIDTH-1] ? -z_i : z_i;
    sum_q2  <= (WIDTH + 2)'(x_q1) + (WIDTH + 2)'(y_q1) + (WIDTH + 2)'(z_q1);
    most_q2 <= xy > z_q1 ? xy : z_q1;
    y_o     <= |twice[WIDTH+2:WIDTH+1] ? '1 : twice[WIDTH:1];
  end
endmodule
