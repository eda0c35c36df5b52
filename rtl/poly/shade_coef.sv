// SPDX-License-Identifier: Apache-2.0
// shade_coef: the coefficients A, B, C, D of a span from its node intensities, for degree 3, 2, 1 or 0.
//
//   degree 3  cubic through four nodes {0, 1/4, 1/2, 1} (NODES_LEFT) or {0, 1/2, 3/4, 1} (NODES_RIGHT)
//   degree 2  parabola through three nodes {0, 1/2, 1}: i1_i, i2_i, i3_i
//   degree 1  line through two nodes {0, 1}: i1_i, i2_i
//   degree 0  the constant i1_i
//
// All in the frame of the cubic, I(t) = A t^3 + B t^2 + C t + D, so that one evaluator serves every degree; nodes that
// a degree does not use are ignored. Formats, rounding and ranges: shade_coef_a, _b, _c.
// Latency LATENCY_COEF = 9 clocks, one set of nodes a clock. Source: P1, section IV.
// Example (degree 2): I = 1/4, 1/2, 1 -> A = 0, B = 1/2, C = 1/4, D = 1/4.
module shade_coef #(
  parameter int WIDTH = shade_pkg::INTENSITY_W,
  parameter int NODES = shade_pkg::NODES_LEFT,
  parameter int FORM  = shade_pkg::FORM_REFINED
) (
  input  logic                                          clk_i,
  input  logic        [        shade_pkg::DEGREE_W-1:0] degree_i,
  input  logic signed [                      WIDTH-1:0] i1_i,
  input  logic signed [                      WIDTH-1:0] i2_i,
  input  logic signed [                      WIDTH-1:0] i3_i,
  input  logic signed [                      WIDTH-1:0] i4_i,
  output logic signed [WIDTH+shade_pkg::COEF_GROWTH-1:0] a_o,
  output logic signed [WIDTH+shade_pkg::COEF_GROWTH-1:0] b_o,
  output logic signed [WIDTH+shade_pkg::COEF_GROWTH-1:0] c_o,
  output logic signed [                      WIDTH-1:0] d_o
);
  shade_coef_a #(.WIDTH(WIDTH), .NODES(NODES), .FORM(FORM)) u_a (
    .clk_i, .degree_i, .i1_i, .i2_i, .i3_i, .i4_i, .a_o
  );
  shade_coef_b #(.WIDTH(WIDTH), .NODES(NODES)) u_b (
    .clk_i, .degree_i, .i1_i, .i2_i, .i3_i, .i4_i, .b_o
  );
  shade_coef_c #(.WIDTH(WIDTH), .NODES(NODES), .FORM(FORM)) u_c (
    .clk_i, .degree_i, .i1_i, .i2_i, .i3_i, .i4_i, .c_o
  );
  // D is I1, whatever the degree: it waits for the others
  shade_delay #(.WIDTH(WIDTH), .DEPTH(shade_pkg::LATENCY_COEF)) u_d (.clk_i, .d_i(i1_i), .q_o(d_o));
endmodule
