// SPDX-License-Identifier: Apache-2.0
// shade_node_chain: the unit normals at 0, 1/4, 1/2, 3/4, 1 of an arc, from its ends and the one cosine c = Na . Nb.
//
//   N2 = (Na + Nb) InvC(c)      h = cos(psi/2)      two midpoint steps in a row; h is the c of both halves,
//   N1 = (Na + N2) InvC(h)      N3 = (N2 + Nb) InvC(h)                    so that no other dot product is needed
//
//   ax_i .. bz_i   S1.16        end normals
//   c_i            S1.16        clamped to [0, 1]; clamped_o tells, with the result
//   n0x_o .. n4z_o S1.16        normals at i/4: N0 = Na, N4 = Nb; rounding and saturation: shade_bisect
//
// FORM and DEGREE: see shade_invc. Refined: within 2.5e-4 of the exact points of the arc (slerp) up to 60 degrees.
// Thirteen 18 x 18 multipliers. Latency LATENCY_NODE_CHAIN = 21 clocks, one arc a clock. Source: P4, section 2.
// Example: Na = (1, 0, 0), Nb = (0.5, 0, 0.866), c = 0.5 -> N1 = (0.9660, 0, 0.2588), N2 = (0.8660, 0, 0.5).
module shade_node_chain #(
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
  output logic signed [shade_pkg::INTENSITY_W-1:0] n0x_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] n0y_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] n0z_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] n1x_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] n1y_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] n1z_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] n2x_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] n2y_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] n2z_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] n3x_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] n3y_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] n3z_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] n4x_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] n4y_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] n4z_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int INVC = shade_pkg::LATENCY_INVC;
  localparam int STEP = shade_pkg::LATENCY_MIDPOINT;  // the clock of N2; InvC(h) comes at 2 INVC
  localparam int REST = 2 * INVC - STEP;

  logic clamped_q9;
  logic [shade_pkg::INVC_F-1:0] invc_q9, invc_q18;
  logic signed [W-1:0] half_q9;
  shade_invc #(.FORM(FORM), .DEGREE(DEGREE)) u_invc_c (
    .clk_i, .rst_i, .valid_i(1'b0), .c_i, .valid_o(), .clamped_o(clamped_q9), .invc_o(invc_q9), .half_o(half_q9)
  );
  shade_invc #(.FORM(FORM), .DEGREE(DEGREE)) u_invc_h (
    .clk_i, .rst_i, .valid_i(1'b0), .c_i(half_q9), .valid_o(), .clamped_o(), .invc_o(invc_q18), .half_o()
  );

  logic signed [W-1:0] ax_q12, ay_q12, az_q12, bx_q12, by_q12, bz_q12, x_q12, y_q12, z_q12;
  shade_ring #(.WIDTH(6 * W), .DEPTH(STEP)) u_ends (
    .clk_i, .rst_i, .d_i({ax_i, ay_i, az_i, bx_i, by_i, bz_i}), .q_o({ax_q12, ay_q12, az_q12, bx_q12, by_q12, bz_q12})
  );

  shade_bisect #(.WAIT(INVC)) u_n2 (
    .clk_i, .rst_i, .valid_i(1'b0), .ax_i, .ay_i, .az_i, .bx_i, .by_i, .bz_i, .invc_i(invc_q9),
    .valid_o(), .x_o(x_q12), .y_o(y_q12), .z_o(z_q12)
  );
  shade_bisect #(.WAIT(REST)) u_n1 (
    .clk_i, .rst_i, .valid_i(1'b0), .ax_i(ax_q12), .ay_i(ay_q12), .az_i(az_q12),
    .bx_i(x_q12), .by_i(y_q12), .bz_i(z_q12), .invc_i(invc_q18), .valid_o(), .x_o(n1x_o), .y_o(n1y_o), .z_o(n1z_o)
  );
  shade_bisect #(.WAIT(REST)) u_n3 (
    .clk_i, .rst_i, .valid_i(1'b0), .ax_i(x_q12), .ay_i(y_q12), .az_i(z_q12),
    .bx_i(bx_q12), .by_i(by_q12), .bz_i(bz_q12), .invc_i(invc_q18), .valid_o(), .x_o(n3x_o), .y_o(n3y_o), .z_o(n3z_o)
  );

  localparam int LATENCY = shade_pkg::LATENCY_NODE_CHAIN;
  shade_ring #(.WIDTH(9 * W), .DEPTH(LATENCY - STEP)) u_nodes (
    .clk_i, .rst_i, .d_i({ax_q12, ay_q12, az_q12, x_q12, y_q12, z_q12, bx_q12, by_q12, bz_q12}),
    .q_o({n0x_o, n0y_o, n0z_o, n2x_o, n2y_o, n2z_o, n4x_o, n4y_o, n4z_o})
  );
  shade_delay #(.WIDTH(1), .DEPTH(LATENCY - INVC)) u_clamped (.clk_i, .d_i(clamped_q9), .q_o(clamped_o));
  shade_valid #(.DEPTH(LATENCY)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);
endmodule
