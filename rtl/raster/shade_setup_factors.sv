// SPDX-License-Identifier: Apache-2.0
// shade_setup_factors: what is multiplied for a triangle's area, for its edges and for its increments, part by part.
//
//   face_i          the area: dx1 dy2 - dx2 dy1 of the triangle that waits, face_dx_i, face_dy_i
//   edge_i          an edge: -(u + 1) dy - t dx, side_i
//   line_i, comp_i  an increment: v1 dx2 - v2 dx1, else v1 dy2 - v2 dy1; component 0 to 3 of dn_i, dz_i; dx_i, dy_i
//   now_i           {upper part of the first factor, of the second}: the part of a number above its lowest 17 bits, else these
//   wide_i          likewise: its lowest part is unsigned, as there is an upper one
//   part_o          {t, s, q, p}: p q - s t is this part's share, see shade_cross
//
// Latency 1 clock. Example: face_i, now_i = wide_i = 0 -> p, q, s, t = dx1, dy2, dx2, dy1.
module shade_setup_factors (
  input  logic                                   clk_i,
  input  logic                                   face_i,
  input  logic                                   edge_i,
  input  logic                                   line_i,
  input  logic [1:0]                             comp_i,
  input  logic [1:0]                             now_i,
  input  logic [1:0]                             wide_i,
  input  logic [1:0][shade_pkg::COORDINATE_W:0]  face_dx_i,
  input  logic [1:0][shade_pkg::COORDINATE_W:0]  face_dy_i,
  input  logic [1:0][shade_pkg::COORDINATE_W:0]  dx_i,
  input  logic [1:0][shade_pkg::COORDINATE_W:0]  dy_i,
  input  logic [1:0][shade_pkg::DEPTH_F:0]       dz_i,
  input  logic [1:0][2:0][shade_pkg::VERTEX_W:0] dn_i,
  input  shade_pkg::side_t                       side_i,
  output logic [3:0][17:0]                       part_o
);
  localparam int W = shade_pkg::COORDINATE_W;
  localparam int F = shade_pkg::SUBPIXEL_F;
  localparam int N_W = shade_pkg::VERTEX_W + 1;

  function automatic logic [17:0] part(input logic [W:0] x, input logic upper, input logic wide);
    part = upper ? {{(35 - W) {x[W]}}, x[W-1:17]} : {x[17] && !wide, x[16:0]};
  endfunction

  function automatic logic [W:0] long(input logic [N_W-1:0] x);
    long = {{(W + 1 - N_W) {x[N_W-1]}}, x};
  endfunction

  logic [1:0][W:0] f, g, f_q, g_q;  // of the sum f1 g2 - f2 g1
  logic [1:0] now_q, wide_q, g_from;
  assign g_from = face_i ? 2'd3 : edge_i ? 2'd2 : {1'b0, line_i};
  for (genvar i = 0; i < 2; i++) begin : g_factor
    logic [W:0] v, w, s;
    assign v    = comp_i[1] ? (comp_i[0] ? dz_i[i] : long(dn_i[i][2])) : long(comp_i[0] ? dn_i[i][1] : dn_i[i][0]);
    assign w    = edge_i ? {{(W + 1 - F) {i == 0}}, i == 0 ? ~side_i.u : side_i.t} : v;
    assign s    = i == 0 ? side_i.dx : {1'b0, side_i.dy};
    assign f[i] = face_i ? face_dx_i[i] : w;
    assign g[i] = g_from[1] ? (g_from[0] ? face_dy_i[i] : s) : (g_from[0] ? dx_i[i] : dy_i[i]);
  end
  always_ff @(posedge clk_i) {f_q, g_q, now_q, wide_q} <= {f, g, now_i, wide_i};
  assign part_o = {
    part(g_q[0], now_q[0], wide_q[0]), part(f_q[1], now_q[1], wide_q[1]),
    part(g_q[1], now_q[0], wide_q[0]), part(f_q[0], now_q[1], wide_q[1])
  };

  logic unused_side;
  assign unused_side = &{1'b0, side_i};
endmodule
