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

  // Gates with a bit of choice for each number, and a sum of them: smaller than multiplexers of so many.
  function automatic logic [W:0] only(input logic chosen, input logic [W:0] x);
    only = {(W + 1) {chosen}} & x;
  endfunction

  logic [W:0] f, g, g_q;
  logic [N_W-1:0] n;
  logic main, low_q, wide_q;
  logic [1:0] turn;  // of the first product, of the second
  assign turn = {second_i, !second_i};
  assign main = !face_i && !edge_i;
  always_comb begin
    n = '0;
    f = only(!face_i && edge_i, {{(W + 1 - F) {!second_i}}, second_i ? side_i.t : ~side_i.u});
    g = only(!face_i && edge_i, second_i ? side_i.dx : {1'b0, side_i.dy});
    for (int i = 0; i < 2; i++) begin
      for (int c = 0; c < 3; c++) n = n | ({N_W{main && turn[i] && comp_i == 2'(c)}} & dn_i[i][c]);
      f = f | only(face_i && turn[i], face_dx_i[i]) | only(main && turn[i] && comp_i == 2'd3, dz_i[i]);
      g = g | only(face_i && turn[1-i], face_dy_i[i]) | only(main && turn[1-i] && line_i, dx_i[i])
            | only(main && turn[1-i] && !line_i, dy_i[i]);
    end
    f = f | {{(W + 1 - N_W) {n[N_W-1]}}, n};
  end
  always_ff @(posedge clk_i) {p_o, g_q, low_q, wide_q} <= {f, g, low_i, wide_i};
  assign q_o = low_q ? {g_q[17] && !wide_q, g_q[16:0]} : {{(35 - W) {g_q[W]}}, g_q[W-1:17]};

  logic unused_side;
  assign unused_side = &{1'b0, side_i};
endmodule
