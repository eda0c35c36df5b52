// SPDX-License-Identifier: Apache-2.0
// shade_round: y = floor(x / 2^DROP + 1/2): drop fraction bits, to nearest, ties towards plus infinity.
//
//   x_i  sddd ddd.d ffff     WIDTH bits, DROP of them below the point
//   y_o  sddd dddd           OUT_W = WIDTH - DROP + 1 bits: the carry of the rounding fits, overflow is impossible;
//                            fewer where the caller's range allows it (and says why)
//
// Combinational: an adder. Error at most 1/2 ulp of y.
// Examples (DROP = 2): 5 (1.25) -> 1, 6 (1.5) -> 2, -6 (-1.5) -> -1, -7 (-1.75) -> -2.
module shade_round #(
  parameter int WIDTH = 12,
  parameter int DROP  = 4,
  parameter int OUT_W = WIDTH - DROP + 1
) (
  input  logic signed [WIDTH-1:0] x_i,
  output logic signed [OUT_W-1:0] y_o
);
  if (DROP < 1 || DROP >= WIDTH || OUT_W < 1 || OUT_W > WIDTH - DROP + 1) begin : g_check
    $error("shade_round: DROP must be in 1 .. WIDTH - 1 and OUT_W in 1 .. WIDTH - DROP + 1");
  end

  // floor(x + 1/2) = floor(x) + the first dropped bit
  assign y_o = OUT_W'(x_i >>> DROP) + OUT_W'({1'b0, x_i[DROP-1]});
endmodule
