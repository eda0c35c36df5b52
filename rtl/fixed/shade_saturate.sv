// SPDX-License-Identifier: Apache-2.0
// shade_saturate: y = min(max(x, 0), 2^OUT_W - 1): clamp a signed number into an unsigned one of fewer bits.
//
// Combinational. Same weight of the last bit on both sides; exact inside [0, 2^OUT_W - 1].
// Examples (OUT_W = 4): -1 -> 0, 7 -> 7, 15 -> 15, 16 -> 15.
module shade_saturate #(
  parameter int WIDTH = 27,
  parameter int OUT_W = 16
) (
  input  logic signed [WIDTH-1:0] x_i,
  output logic        [OUT_W-1:0] y_o
);
  if (OUT_W < 1 || OUT_W > WIDTH - 2) begin : g_check
    $error("shade_saturate: OUT_W must be in 1 .. WIDTH - 2");
  end

  logic negative, too_large;
  assign negative  = x_i[WIDTH-1];
  assign too_large = |(x_i >> OUT_W);  // or negative
  assign y_o       = negative ? '0 : OUT_W'(x_i) | {OUT_W{too_large}};
endmodule
