// SPDX-License-Identifier: Apache-2.0
// shade_square: y = x^2, exact.
//
//   x_i     sddd dddd             WIDTH bits
//   y_o     ddd dddd dddd dddd    2 WIDTH - 1 bits, unsigned: at most 2^(2 WIDTH - 2), overflow is impossible
//
// One 18 x 18 multiplier. Latency LATENCY_MUL = 2 clocks, one value a clock. Example: x = -3 -> y = 9.
module shade_square #(
  parameter int WIDTH = shade_pkg::INTENSITY_W
) (
  input  logic                    clk_i,
  input  logic signed [WIDTH-1:0] x_i,
  output logic        [2*WIDTH-2:0] y_o
);
  if (WIDTH < 2 || WIDTH > 18) begin : g_check
    $error("shade_square: WIDTH must be in 2 .. 18");
  end

  logic signed [2*WIDTH-1:0] product;
  shade_mul #(.A_W(WIDTH), .B_W(WIDTH)) u_mul (.clk_i, .a_i(x_i), .b_i(x_i), .p_o(product));
  assign y_o = (2 * WIDTH - 1)'(product);
  logic unused_sign;
  assign unused_sign = &{1'b0, product};
endmodule
