// SPDX-License-Identifier: Apache-2.0
// shade_node_chain: the unit normals at 0, 1/4, 1/2, 3/4, 1 of an arc, from its ends and the one cosine c = Na . Nb.
//
//   N2 = (Na + Nb) InvC(c)      h = cos(psi/2)      two midpoint steps in a row; h is the c of both halves,
//   N1 = (Na + N2) InvC(h)      N3 = (N2 + Nb) InvC(h)                    so that no other dot product is needed
//
//   a_i, b_i   S1.16        end normals
//   c_i        S1.16        clamped to [0, 1]; arc_o.clamped tells, with the result
//   arc_o      S1.16        n0 .. n4, normals at i/4: N0 = Na, N4 = Nb; rounding and saturation: shade_bisect
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
  input  shade_pkg::vec_t                          a_i,
  input  shade_pkg::vec_t                          b_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] c_i,
  output shade_pkg::arc_t                          arc_o
);
  localparam int INVC = shade_pkg::LATENCY_INVC;
  localparam int STEP = shade_pkg::LATENCY_MIDPOINT;  // the clock of N2; InvC(h) comes at 2 INVC
  localparam int REST = 2 * INVC - STEP;
  localparam int LATENCY = shade_pkg::LATENCY_NODE_CHAIN;

  shade_pkg::invc_t invc_q9, invc_q18;
  shade_invc #(.FORM(FORM), .DEGREE(DEGREE)) u_invc_c (.clk_i, .c_i, .invc_o(invc_q9));
  shade_invc #(.FORM(FORM), .DEGREE(DEGREE)) u_invc_h (.clk_i, .c_i(invc_q9.half), .invc_o(invc_q18));

  shade_pkg::vec_t a_q12, b_q12, n_q12;
  shade_ring #(.WIDTH($bits(a_q12) + $bits(b_q12)), .DEPTH(STEP)) u_ends (
    .clk_i, .rst_i, .d_i({a_i, b_i}), .q_o({a_q12, b_q12})
  );
  shade_bisect #(.WAIT(INVC)) u_n2 (.clk_i, .rst_i, .a_i, .b_i, .invc_i(invc_q9.invc), .n_o(n_q12));
  shade_bisect #(.WAIT(REST)) u_n1 (
    .clk_i, .rst_i, .a_i(a_q12), .b_i(n_q12), .invc_i(invc_q18.invc), .n_o(arc_o.n1)
  );
  shade_bisect #(.WAIT(REST)) u_n3 (
    .clk_i, .rst_i, .a_i(n_q12), .b_i(b_q12), .invc_i(invc_q18.invc), .n_o(arc_o.n3)
  );
  shade_ring #(.WIDTH($bits(a_q12) + $bits(n_q12) + $bits(b_q12)), .DEPTH(LATENCY - STEP)) u_nodes (
    .clk_i, .rst_i, .d_i({a_q12, n_q12, b_q12}), .q_o({arc_o.n0, arc_o.n2, arc_o.n4})
  );
  shade_delay #(.WIDTH(1), .DEPTH(LATENCY - INVC)) u_clamped (.clk_i, .d_i(invc_q9.clamped), .q_o(arc_o.clamped));

  logic unused_bits;
  assign unused_bits = &{1'b0, invc_q18};
endmodule
