// SPDX-License-Identifier: Apache-2.0
// shade_coef_d: coefficient D = I1 of I(t) = A t^3 + B t^2 + C t + D: the intensity where t = 0, for every degree.
//
// Nothing to compute: it waits for A, B and C. Latency LATENCY_COEF = 9 clocks, one value a clock, exact.
// Example: I1 = 0.5 -> D = 0.5 nine clocks later. Source: P1, section IV.
module shade_coef_d #(
  parameter int WIDTH = shade_pkg::INTENSITY_W
) (
  input  logic                    clk_i,
  input  logic signed [WIDTH-1:0] i1_i,
  output logic signed [WIDTH-1:0] d_o
);
  if (WIDTH < 1) begin : g_check
    $error("shade_coef_d: WIDTH must be at least 1");
  end

  shade_delay #(.WIDTH(WIDTH), .DEPTH(shade_pkg::LATENCY_COEF)) u_align (.clk_i, .d_i(i1_i), .q_o(d_o));
endmodule
