// SPDX-License-Identifier: Apache-2.0
// shade_limit: y = min(max(x, -2^(OUT_W-1)), 2^(OUT_W-1) - 1): a signed number into fewer bits.
//
// Combinational. Same weight of the last bit on both sides; exact inside the range of y.
// Examples (OUT_W = 4): -9 -> -8, -8 -> -8, 7 -> 7, 8 -> 7.
module shade_limit #(
  parameter int WIDTH = 21,
  parameter int OUT_W = shade_pkg::INTENSITY_W
) (
  input  logic signed [WIDTH-1:0] x_i,
  output logic signed [OUT_W-1:0] y_o
);
  if (OUT_W < 2 || OUT_W >= WIDTH) begin : g_check
    $error("shade_limit: OUT_W must be in 2 .. WIDTH - 1");
  end

  logic negative, fits;
  logic signed [OUT_W-1:0] low;
  assign negative = x_i[WIDTH-1];
  assign low      = OUT_W'(x_i);
  assign fits     = x_i == WIDTH'(low);
  assign y_o      = fits ? low : {negative, {(OUT_W - 1) {!negative}}};
endmodule
