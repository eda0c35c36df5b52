// SPDX-License-Identifier: Apache-2.0
// shade_setup_factors: what is multiplied for a triangle's area, for its edges and for its increments.
//
//   face_i          the area: dx1 dy2 - dx2 dy1 of the triangle that waits, face_dx_i, face_dy_i
//   edge_i          an edge: -(u + 1) dy - t dx, side_i
//   line_i, comp_i  an increment: v1 dx2 - v2 dx1, else v1 dy2 - v2 dy1; component 0 to 3 of dn_i, dz_i; dx_i, dy_i
//   second_i        the second one of these two products
//   low_i, wide_i   the part of the second factor below bit 17, unsigned with wide_i, when there is one above; else that one
//   p_o, q_o        the factors, see shade_cross
//
// Latency 1 clock. Example: face_i, low_i -> p, q = dx1, dy2; with second_i -> dx2, dy1.
module shade_setup_factors (
  input  logic                                   clk_i,
  input  logic                                   face_i,
  input  logic                                   edge_i,
  input  logic                                   line_i,
  input  logic [1:0]                             comp_i,
  input  logic                                   second_i,
  input  logic                                   low_i,
  input  logic                                   wide_i,
  input  logic [1:0][shade_pkg::COORDINATE_W:0]  face_dx_i,
  input  logic [1:0][shade_pkg::COORDINATE_W:0]  face_dy_i,
  input  logic [1:0][shade_pkg::COORDINATE_W:0]  dx_i,
  input  logic [1:0][shade_pkg::COORDINATE_W:0]  dy_i,
  input  logic [1:0][shade_pkg::DEPTH_F:0]       dz_i,
  input  logic [1:0][2:0][shade_pkg::VERTEX_W:0] dn_i,
  input  shade_pkg::side_t                       side_i,
  output logic [shade_pkg::COORDINATE_W:0]       p_o,
  output logic [17:0]                            q_o
);
  localparam int W = shade_pkg::COORDINATE_W;
  localparam int F = shade_pkg::SUBPIXEL_F;
  localparam int N_W = shade_pkg::VERTEX_W + 1;

  function automatic logic [W:0] long(input logic [N_W-1:0] x);
    long = {{(W + 1 - N_W) {x[N_W-1]}}, x};
  endfunction

  // both of each pair, the one whose turn it is
  logic [W:0] v, w, s, f, g, g_q;
  logic [W:0] face_dx, face_dy, dx, dy, z;
  logic [2:0][N_W-1:0] n;
  logic low_q, wide_q;
  assign face_dx = second_i ? face_dx_i[1] : face_dx_i[0];
  assign face_dy = second_i ? face_dy_i[0] : face_dy_i[1];
  assign dx      = second_i ? dx_i[0] : dx_i[1];
  assign dy      = second_i ? dy_i[0] : dy_i[1];
  assign z       = second_i ? dz_i[1] : dz_i[0];
  assign n       = second_i ? dn_i[1] : dn_i[0];
  assign v = comp_i[1] ? (comp_i[0] ? z : long(n[2])) : long(comp_i[0] ? n[1] : n[0]);
  assign w = {{(W + 1 - F) {!second_i}}, second_i ? side_i.t : ~side_i.u};
  assign s = second_i ? side_i.dx : {1'b0, side_i.dy};
  assign f = face_i ? face_dx : edge_i ? w : v;
  assign g = face_i ? face_dy : edge_i ? s : line_i ? dx : dy;
  always_ff @(posedge clk_i) {p_o, g_q, low_q, wide_q} <= {f, g, low_i, wide_i};
  assign q_o = low_q ? {g_q[17] && !wide_q, g_q[16:0]} : {{(35 - W) {g_q[W]}}, g_q[W-1:17]};

  logic unused_side;
  assign unused_side = &{1'b0, side_i};
endmodule
