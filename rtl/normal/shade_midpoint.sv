// SPDX-License-Identifier: Apache-2.0
// shade_midpoint: n = (Na + Nb) InvC(c), the unit normal in the middle of two with c = Na . Nb, without a root.
//
//   ax_i .. bz_i, x_o, y_o, z_o  S1.16     components; rounding and saturation: shade_bisect
//   c_i                          S1.16     cosine of their angle, clamped to [0, 1]; clamped_o tells, with the result
//   half_o                       S1.16     cos(psi/2): the cosine of either to n
//
// FORM and DEGREE: see shade_invc. Refined: the length of n is 1 within 2 ulp for equal unit normals, within 1.7e-4 for
// others; paper: 0.2 % wrong for equal ones (DEGREE 2), 1.6 % (DEGREE 1).
// Five 18 x 18 multipliers (four in FORM_PAPER, three in DEGREE 1). Latency LATENCY_MIDPOINT = 12 clocks, one vector a
// clock. Source: P4, section 2.
// Example: Na = (0, 0.5, 0.866), Nb = (0, -0.5, 0.866), c = 0.5 -> n = (0, 0, 0.99997), refined.
module shade_midpoint #(
  parameter int FORM   = shade_pkg::FORM_REFINED,
  parameter int DEGREE = 2
) (
  input  logic                                     clk_i,
  input  logic                                     rst_i,
  input  logic                                     valid_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] ax_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] ay_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] az_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] bx_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] by_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] bz_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] c_i,
  output logic                                     valid_o,
  output logic                                     clamped_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] x_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] y_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] z_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] half_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  logic clamped;
  logic [shade_pkg::INVC_F-1:0] invc;
  logic signed [W-1:0] half;
  shade_invc #(.FORM(FORM), .DEGREE(DEGREE)) u_invc (
    .clk_i, .rst_i, .valid_i(1'b0), .c_i, .valid_o(), .clamped_o(clamped), .invc_o(invc), .half_o(half)
  );
  shade_bisect #(.WAIT(shade_pkg::LATENCY_INVC)) u_bisect (
    .clk_i, .rst_i, .valid_i, .ax_i, .ay_i, .az_i, .bx_i, .by_i, .bz_i, .invc_i(invc), .valid_o, .x_o, .y_o, .z_o
  );
  shade_delay #(.WIDTH(W + 1), .DEPTH(shade_pkg::LATENCY_SCALE3)) u_half (
    .clk_i, .d_i({clamped, half}), .q_o({clamped_o, half_o})
  );
endmodule
