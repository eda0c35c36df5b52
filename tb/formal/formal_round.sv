// SPDX-License-Identifier: Apache-2.0
// formal_round: y = floor(x / 2^DROP + 1/2): 2^DROP y <= x + 2^(DROP-1) < 2^DROP (y + 1).
module formal_round #(
  parameter int WIDTH = 12,
  parameter int DROP  = 4
) (
  input logic                    clk_i,
  input logic signed [WIDTH-1:0] x_i
);
  localparam int W = WIDTH + 2;
  logic signed [WIDTH-DROP:0] y;
  shade_round #(.WIDTH(WIDTH), .DROP(DROP)) u_dut (.x_i, .y_o(y));
  logic signed [W-1:0] sum, low;
  assign sum = W'(x_i) + W'(1 << (DROP - 1));
  assign low = W'(y) * W'(1 << DROP);
  always_ff @(posedge clk_i) begin
    // The nearest multiple, the upper one of two that are as near.
    // mutant: OUT_W'({1'b0, x_i[DROP-1]}) => OUT_W'(0)
    nearest : assert (low <= sum && sum - low < W'(1 << DROP));
  end
endmodule
