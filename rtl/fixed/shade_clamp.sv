// SPDX-License-Identifier: Apache-2.0
// shade_clamp: y = min(max(x, 0), 1), and whether that changed x: a cosine, a share or a threshold into its range.
//
//   x_i        sd.ffff     WIDTH bits, F of them below the point
//   y_o         d.ffff     U1.F in [0, 1]
//   clamped_o              x was outside [0, 1]
//
// Combinational, exact inside [0, 1]. Examples (F = 16): -1 -> 0, told; 65536 -> 65536; 65537 -> 65536, told.
module shade_clamp #(
  parameter int WIDTH = shade_pkg::INTENSITY_W,
  parameter int F     = shade_pkg::INTENSITY_F
) (
  input  logic signed [WIDTH-1:0] x_i,
  output logic        [      F:0] y_o,
  output logic                    clamped_o
);
  if (F < 1 || WIDTH < F + 2) begin : g_check
    $error("shade_clamp: F must be at least 1 and WIDTH at least F + 2");
  end

  localparam logic signed [WIDTH-1:0] ONE = WIDTH'(1) <<< F;

  logic negative, above;
  assign negative  = x_i[WIDTH-1];
  assign above     = x_i > ONE;
  assign y_o       = negative ? '0 : (F + 1)'(above ? ONE : x_i);
  assign clamped_o = negative || above;
endmodule
