// SPDX-License-Identifier: Apache-2.0
// shade_angles: from the directions at a node to its cosines: N.L, N.V, and the versine of R, V or of N, H.
//
//   n_i, l_i, v_i, h_i  x, y, z, S1.16, at bit 0, 18, 36     unit vectors; R = 2 (N.L) N - L
//   diffuse_o           S1.16         N.L, saturated; saturated_o tells
//   nl_o, nv_o          U1.16         N.L, N.V clamped to [0, 1]; nl_range_o, nv_range_o: beyond [-1, 1]
//   x_o                 U2.20         mirror_i: 1 - R.V, else 1 - N.H (shade_versine); x_range_o: cosine beyond [-1, 1]
//                                     error 1/2 ulp; of R, V 41 ulp were measured, because R is rounded to S1.16
//   lost_o                            H = 0: there is none, because L = -V
//
// LOCAL = 0: L, V, H are settings; 1: of every node, and H is taken LATENCY_HALFWAY clocks after N, L, V. Settings and
// mirror_i must not change while nodes are inside. REFLECT = 0: without R, mirror_i must be 0.
// 15 18 x 18 multipliers, without R 9. Latency LATENCY_ANGLES = 17 clocks, without R fewer by LATENCY_REFLECT; LOCAL:
// LATENCY_HALFWAY + 1 + LATENCY_VERSINE = 32. One node a clock. Source: P1, section II.
// Example: N = L = V = H -> diffuse = nl = nv = 1, x = 0.
module shade_angles #(
  parameter int FORM    = shade_pkg::FORM_REFINED,
  parameter int REFLECT = 1,
  parameter int LOCAL   = 0
) (
  input  logic                                       clk_i,
  input  logic                                       rst_i,
  input  logic                                       valid_i,
  input  logic                                       mirror_i,
  input  logic        [3*shade_pkg::INTENSITY_W-1:0] n_i,
  input  logic        [3*shade_pkg::INTENSITY_W-1:0] l_i,
  input  logic        [3*shade_pkg::INTENSITY_W-1:0] v_i,
  input  logic        [3*shade_pkg::INTENSITY_W-1:0] h_i,
  output logic                                       valid_o,
  output logic signed [  shade_pkg::INTENSITY_W-1:0] diffuse_o,
  output logic        [    shade_pkg::INTENSITY_F:0] nl_o,
  output logic        [    shade_pkg::INTENSITY_F:0] nv_o,
  output logic        [    shade_pkg::VERSINE_W-1:0] x_o,
  output logic                                       saturated_o,
  output logic                                       nl_range_o,
  output logic                                       nv_range_o,
  output logic                                       x_range_o,
  output logic                                       lost_o
);
  if (REFLECT < 0 || REFLECT > 1 || LOCAL < 0 || LOCAL > 1) begin : g_check
    $error("shade_angles: REFLECT and LOCAL must be 0 or 1");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int F = shade_pkg::INTENSITY_F;
  localparam int DOT_W = shade_pkg::DOT_W;
  localparam int DOT = shade_pkg::LATENCY_DOT3;
  localparam int VERSINE = shade_pkg::LATENCY_VERSINE;
  localparam int TO_R = REFLECT != 0 ? shade_pkg::LATENCY_REFLECT : 0;
  localparam int TO_H = LOCAL != 0 ? shade_pkg::LATENCY_HALFWAY : TO_R;
  localparam int TO_END = TO_H + 1 + VERSINE;

  // ---- N.L, N.V --------------------------------------------------------------------------------------------------
  logic signed [DOT_W-1:0] nl_q4, nv_q4;
  logic signed [W-1:0] nl_limited, nl_q5, nl_last;
  logic [F:0] nl, nv, nv_q5;
  logic nl_range, nv_range, saturated, nl_range_q5, nv_range_q5, saturated_q5;
  shade_dot3 u_nl (.clk_i, .a_i(n_i), .b_i(l_i), .d_o(nl_q4));
  shade_dot3 u_nv (.clk_i, .a_i(n_i), .b_i(v_i), .d_o(nv_q4));
  localparam logic signed [DOT_W-1:0] ONE = DOT_W'(1) <<< F;
  assign nl_range  = nl_q4 > ONE || nl_q4 < -ONE;
  assign nv_range  = nv_q4 > ONE || nv_q4 < -ONE;
  assign saturated = nl_q4[DOT_W-1:W-1] != {(DOT_W - W + 1) {nl_q4[DOT_W-1]}};
  shade_limit #(.WIDTH(DOT_W), .OUT_W(W)) u_limit (.x_i(nl_q4), .y_o(nl_limited));
  shade_clamp #(.WIDTH(DOT_W)) u_nv_clamp (.x_i(nv_q4), .y_o(nv), .clamped_o());
  shade_clamp u_nl_clamp (.x_i(nl_last), .y_o(nl), .clamped_o());
  always_ff @(posedge clk_i) begin
    {nl_range_q5, nv_range_q5, saturated_q5} <= {nl_range, nv_range, saturated};
    nl_q5     <= nl_limited;
    nv_q5     <= nv;
    diffuse_o <= nl_last;
    nl_o      <= nl;
  end
  shade_ring #(.WIDTH(W), .DEPTH(TO_END - DOT - 2)) u_wait_nl (.clk_i, .rst_i, .d_i(nl_q5), .q_o(nl_last));
  shade_ring #(.WIDTH(F + 4), .DEPTH(TO_END - DOT - 1)) u_wait_nv (
    .clk_i, .rst_i, .d_i({nl_range_q5, nv_range_q5, saturated_q5, nv_q5}), .q_o({nl_range_o, nv_range_o, saturated_o, nv_o})
  );

  // ---- the angle that the lobe is a function of ------------------------------------------------------------------
  logic [3*W-1:0] n_at_r, r, v_at_h, a, a_q, b_q;
  shade_ring #(.WIDTH(3 * W), .DEPTH(TO_R)) u_n (.clk_i, .rst_i, .d_i(n_i), .q_o(n_at_r));
  shade_ring #(.WIDTH(3 * W), .DEPTH(LOCAL != 0 ? TO_H : 0)) u_v (.clk_i, .rst_i, .d_i(v_i), .q_o(v_at_h));
  if (REFLECT != 0) begin : g_reflect
    shade_reflect u_reflect (
      .clk_i, .rst_i, .valid_i(1'b0), .nx_i(n_i[0+:W]), .ny_i(n_i[W+:W]), .nz_i(n_i[2*W+:W]),
      .lx_i(l_i[0+:W]), .ly_i(l_i[W+:W]), .lz_i(l_i[2*W+:W]), .valid_o(),
      .x_o(r[0+:W]), .y_o(r[W+:W]), .z_o(r[2*W+:W])
    );
  end else begin : g_none
    assign r = n_at_r;
  end
  logic none;
  assign none = h_i == '0;
  always_ff @(posedge clk_i) begin
    a   <= mirror_i ? r : n_at_r;
    b_q <= mirror_i ? v_at_h : h_i;
  end
  shade_ring #(.WIDTH(3 * W), .DEPTH(TO_H - TO_R)) u_a (.clk_i, .rst_i, .d_i(a), .q_o(a_q));
  shade_versine #(.FORM(FORM)) u_versine (
    .clk_i, .rst_i, .valid_i(1'b0), .ax_i(a_q[0+:W]), .ay_i(a_q[W+:W]), .az_i(a_q[2*W+:W]),
    .bx_i(b_q[0+:W]), .by_i(b_q[W+:W]), .bz_i(b_q[2*W+:W]), .valid_o(), .x_o, .range_o(x_range_o)
  );
  shade_delay #(.WIDTH(1), .DEPTH(1 + VERSINE)) u_lost (.clk_i, .d_i(none), .q_o(lost_o));

  shade_valid #(.DEPTH(TO_END)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);
endmodule
