// SPDX-License-Identifier: Apache-2.0
// shade_midpoint: n = (Na + Nb) InvC(c), the unit normal in the middle of two with c = Na . Nb, without a root.
//
//   a_i, b_i    S1.16     Na, Nb
//   c_i         S1.16     cosine of their angle, clamped to [0, 1]; clamped tells, with the result
//   middle_o    S1.16     normal: n, rounding and saturation: shade_bisect; half: cos(psi/2), the cosine of either to n
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
  input  shade_pkg::vec_t                          a_i,
  input  shade_pkg::vec_t                          b_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] c_i,
  output shade_pkg::middle_t                       middle_o
);
  shade_pkg::invc_t invc;
  shade_invc #(.FORM(FORM), .DEGREE(DEGREE)) u_invc (.clk_i, .c_i, .invc_o(invc));
  shade_bisect #(.WAIT(shade_pkg::LATENCY_INVC)) u_bisect (
    .clk_i, .rst_i, .a_i, .b_i, .invc_i(invc.invc), .n_o(middle_o.normal)
  );
  shade_delay #(.WIDTH($bits(invc.half) + 1), .DEPTH(shade_pkg::LATENCY_SCALE3)) u_half (
    .clk_i, .d_i({invc.clamped, invc.half}), .q_o({middle_o.clamped, middle_o.half})
  );
endmodule
