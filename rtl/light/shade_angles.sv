// SPDX-License-Identifier: Apache-2.0
// shade_angles: from the directions at a node to its cosines: N.L, N.V, and the versine of R, V or of N, H.
//
//   n_i, l_i, v_i, h_i  S1.16         unit vectors; R = 2 (N.L) N - L
//   angles_o.diffuse    S1.16         N.L, saturated; .saturated tells
//   angles_o.nl, .nv    U1.16         N.L, N.V clamped to [0, 1]; .nl_range, .nv_range: beyond [-1, 1]
//   angles_o.x          U2.26         mirror_i: 1 - R.V, else 1 - N.H; .x_range: cosine beyond [-1, 1]; shift_i: which bits
//                                     count, see shade_versine. Of R, V the rounding of R to S1.16 adds to the error
//
// LOCAL = 0: L, V, H are settings; 1: of every node, and H is taken LATENCY_HALFWAY clocks after N, L, V. Settings and
// mirror_i must not change while nodes are inside. REFLECT = 0: without R, mirror_i must be 0.
//
// FOLD = 1: 15 18 x 18 multipliers, without R 9; a node a clock. Latency LATENCY_ANGLES = 17 clocks, without R fewer by
//           LATENCY_REFLECT; LOCAL: LATENCY_HALFWAY + 1 + LATENCY_VERSINE = 32.
// FOLD = 2 .. 8: shade_angles_folded: a node in FOLD clocks, taken when phase_i is TAKE; N.V is 0; REFLECT and LOCAL must
//           be 0. Latency LATENCY_ANGLES_FOLDED = 11 clocks.
// Source: P1, section II. Example: N = L = V = H -> diffuse = nl = nv = 1, x = 0.
module shade_angles #(
  parameter int FORM    = shade_pkg::FORM_REFINED,
  parameter int REFLECT = 1,
  parameter int LOCAL   = 0,
  parameter int FOLD    = 1,
  parameter int TAKE    = 0
) (
  input  logic                          clk_i,
  input  logic                          rst_i,
  input  logic [shade_pkg::PHASE_W-1:0] phase_i,
  input  logic                          mirror_i,
  input  logic [shade_pkg::LOBE_SHIFT_W-1:0] shift_i,
  input  shade_pkg::vec_t               n_i,
  input  shade_pkg::vec_t               l_i,
  input  shade_pkg::vec_t               v_i,
  input  shade_pkg::vec_t               h_i,
  output shade_pkg::angles_t            angles_o
);
  if (REFLECT < 0 || REFLECT > 1 || LOCAL < 0 || LOCAL > 1) begin : g_check
    $error("shade_angles: REFLECT and LOCAL must be 0 or 1");
  end
  if (FOLD < 1 || FOLD > shade_pkg::FOLD_MAX || TAKE < 0 || TAKE >= FOLD || (FOLD > 1 && REFLECT + LOCAL > 0)) begin : g_fold
    $error("shade_angles: FOLD must be in 1 .. 8, beyond 1 with REFLECT and LOCAL 0, and TAKE below FOLD");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int F = shade_pkg::INTENSITY_F;
  localparam int DOT_W = shade_pkg::DOT_W;
  localparam int DOT = shade_pkg::LATENCY_DOT3;
  localparam int VERSINE = shade_pkg::LATENCY_VERSINE;
  localparam int TO_R = REFLECT != 0 ? shade_pkg::LATENCY_REFLECT : 0;
  localparam int TO_H = LOCAL != 0 ? shade_pkg::LATENCY_HALFWAY : TO_R;
  localparam int TO_END = TO_H + 1 + VERSINE;
  localparam logic signed [DOT_W-1:0] ONE = DOT_W'(1) <<< F;

  // ---- N.L -------------------------------------------------------------------------------------------------------
  logic signed [DOT_W-1:0] nl;
  logic signed [W-1:0] diffuse;
  logic saturated, nl_range;
  assign nl_range  = nl > ONE || nl < -ONE;
  assign saturated = nl != DOT_W'(diffuse);
  shade_limit #(.WIDTH(DOT_W), .OUT_W(W)) u_limit (.x_i(nl), .y_o(diffuse));

  if (FOLD > 1) begin : g_folded
    logic [F:0] cosine;
    logic unused_clamp;
    shade_clamp u_clamp (.x_i(diffuse), .y_o(cosine), .clamped_o(unused_clamp));
    shade_angles_folded #(.FORM(FORM), .FOLD(FOLD), .TAKE(TAKE)) u_folded (
      .clk_i, .phase_i, .shift_i, .n_i, .l_i, .h_i, .nl_o(nl), .x_o(angles_o.x), .range_o(angles_o.x_range)
    );
    assign angles_o.diffuse   = diffuse;
    assign angles_o.nl        = cosine;
    assign angles_o.nv        = '0;
    assign angles_o.saturated = saturated;
    assign angles_o.nl_range  = nl_range;
    assign angles_o.nv_range  = 1'b0;
    logic unused;
    assign unused = &{1'b0, rst_i, mirror_i, v_i};
  end else begin : g_parallel
    logic signed [DOT_W-1:0] nv;
    logic signed [W-1:0] diffuse_q5, diffuse_last;
    logic [F:0] cosine_l, cosine_v, nv_q5;
    logic nv_range, nl_range_q5, nv_range_q5, saturated_q5;
    shade_dot3 u_nl (.clk_i, .a_i(n_i), .b_i(l_i), .d_o(nl));
    shade_dot3 u_nv (.clk_i, .a_i(n_i), .b_i(v_i), .d_o(nv));
    assign nv_range = nv > ONE || nv < -ONE;
    logic unused_nv_clamp;
    shade_clamp #(.WIDTH(DOT_W)) u_nv_clamp (.x_i(nv), .y_o(cosine_v), .clamped_o(unused_nv_clamp));
    logic unused_nl_clamp;
    shade_clamp u_nl_clamp (.x_i(diffuse_last), .y_o(cosine_l), .clamped_o(unused_nl_clamp));
    always_ff @(posedge clk_i) begin
      {nl_range_q5, nv_range_q5, saturated_q5} <= {nl_range, nv_range, saturated};
      diffuse_q5       <= diffuse;
      nv_q5            <= cosine_v;
      angles_o.diffuse <= diffuse_last;
      angles_o.nl      <= cosine_l;
    end
    shade_ring #(.WIDTH(W), .DEPTH(TO_END - DOT - 2)) u_wait_nl (.clk_i, .rst_i, .d_i(diffuse_q5), .q_o(diffuse_last));
    shade_ring #(.WIDTH(F + 4), .DEPTH(TO_END - DOT - 1)) u_wait_nv (
      .clk_i, .rst_i, .d_i({nl_range_q5, nv_range_q5, saturated_q5, nv_q5}),
      .q_o({angles_o.nl_range, angles_o.nv_range, angles_o.saturated, angles_o.nv})
    );

    // ---- the angle that the lobe is a function of ----------------------------------------------------------------
    shade_pkg::vec_t n_at_r, r, v_at_h, a, a_q, b_q;
    shade_ring #(.WIDTH($bits(n_i)), .DEPTH(TO_R)) u_n (.clk_i, .rst_i, .d_i(n_i), .q_o(n_at_r));
    shade_ring #(.WIDTH($bits(v_i)), .DEPTH(LOCAL != 0 ? TO_H : 0)) u_v (.clk_i, .rst_i, .d_i(v_i), .q_o(v_at_h));
    if (REFLECT != 0) begin : g_reflect
      shade_reflect u_reflect (.clk_i, .n_i, .l_i, .r_o(r));
    end else begin : g_none
      assign r = n_at_r;
    end
    always_ff @(posedge clk_i) begin
      a   <= mirror_i ? r : n_at_r;
      b_q <= mirror_i ? v_at_h : h_i;
    end
    shade_ring #(.WIDTH($bits(a)), .DEPTH(TO_H - TO_R)) u_a (.clk_i, .rst_i, .d_i(a), .q_o(a_q));
    shade_versine #(.FORM(FORM)) u_versine (
      .clk_i, .shift_i, .a_i(a_q), .b_i(b_q), .x_o(angles_o.x), .range_o(angles_o.x_range)
    );
    logic unused_phase;
    assign unused_phase = &{1'b0, phase_i};
  end
endmodule
