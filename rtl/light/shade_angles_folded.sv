// SPDX-License-Identifier: Apache-2.0
// shade_angles_folded: N.L and the versine of N, H with multipliers that their six products share.
//
//   n_i            S1.16         unit vector, taken when phase_i is TAKE
//   l_i, h_i       S1.16         unit vectors, settings; shift_i: see shade_versine
//   nl_o           S4.16         N.L, rounded once, to nearest, ties up
//   x_o, range_o                 as of shade_versine
//
// phase_i counts 0 .. FOLD - 1. FOLD = 2: three multipliers, one for each component of both. FOLD = 3 .. 5: two, one for
// each sum. FOLD = 6 .. 8: one. Operands are chosen a clock before they stand at a multiplier, the differences of the chord
// a clock before these. Latency LATENCY_ANGLES_FOLDED = 11 clocks, a node in FOLD clocks.
// Source: P1, section II. Example: N = L = H -> nl = 1, x = 0.
module shade_angles_folded #(
  parameter int FORM = shade_pkg::FORM_REFINED,
  parameter int FOLD = 6,
  parameter int TAKE = 0
) (
  input  logic                                   clk_i,
  input  logic        [  shade_pkg::PHASE_W-1:0] phase_i,
  input  logic        [shade_pkg::LOBE_SHIFT_W-1:0] shift_i,
  input  shade_pkg::vec_t                        n_i,
  input  shade_pkg::vec_t                        l_i,
  input  shade_pkg::vec_t                        h_i,
  output logic signed [    shade_pkg::DOT_W-1:0] nl_o,
  output logic        [shade_pkg::VERSINE_W-1:0] x_o,
  output logic                                   range_o
);
  if (FOLD < 2 || FOLD > shade_pkg::FOLD_MAX || TAKE < 0 || TAKE >= FOLD) begin : g_check
    $error("shade_angles_folded: FOLD must be in 2 .. 8 and TAKE below FOLD");
  end

  localparam bit REFINED = FORM == shade_pkg::FORM_REFINED;
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int F = shade_pkg::INTENSITY_F;
  localparam int P_W = 2 * W;
  localparam int SUM_W = P_W + 3;
  localparam int DOT_W = shade_pkg::DOT_W;
  localparam int DROP = 2 * F + (REFINED ? 1 : 0) - shade_pkg::VERSINE_F;
  localparam int X_W = SUM_W - DROP;
  localparam int CUT = shade_pkg::VERSINE_CUT;
  localparam int X_F = shade_pkg::VERSINE_F - CUT;
  localparam logic signed [SUM_W-1:0] HALF_NL = SUM_W'(1) <<< (F - 1);
  localparam logic [shade_pkg::LOBE_SHIFT_W-1:0] FINE = shade_pkg::LOBE_SHIFT_W'(shade_pkg::LOBE_FINE);

  // clocks of a node in which its first product of the versine has its operands chosen, and in which the sums are there
  localparam int X_AT = FOLD == 2 ? 1 : FOLD < 6 ? 2 : 3;
  localparam int NL_DONE = FOLD == 2 ? 4 : 6;
  localparam int X_DONE = X_AT + NL_DONE;
  localparam int LATENCY = shade_pkg::LATENCY_ANGLES_FOLDED;

  // is it clock c of a node?
  function automatic logic at(input int c);
    at = phase_i == shade_pkg::PHASE_W'((TAKE + c) % FOLD);
  endfunction

  logic signed [SUM_W-1:0] nl_sum, x_sum, first_x;
  assign first_x = ((SUM_W'(1) <<< (DROP + CUT - 1)) >>> (shift_i == FINE ? '0 : shift_i)) |
                   (REFINED ? '0 : SUM_W'(1) <<< (2 * F));
  if (FOLD == 2) begin : g_components
    logic signed [SUM_W-1:0] xy_q, z_q, z;
    localparam int V_W = shade_pkg::VEC_BITS;
    logic [V_W-1:0] n_all, l_all, h_all;
    logic minus, minus_q;
    assign {n_all, l_all, h_all} = {n_i, l_i, h_i};
    assign minus     = !REFINED && at(X_AT + 3);
    for (genvar c = 0; c < 3; c++) begin : g_component
      logic signed [W:0] difference;
      logic signed [W-1:0] n, l, h, limited, left_q, right_q, a_q, b_q;
      logic signed [P_W-1:0] p;
      assign n          = W'(n_all >> (c * W));
      assign l          = W'(l_all >> (c * W));
      assign h          = W'(h_all >> (c * W));
      assign difference = (W + 1)'(n) - (W + 1)'(h);
      shade_limit #(.WIDTH(W + 1), .OUT_W(W)) u_limit (.x_i(difference), .y_o(limited));
      always_ff @(posedge clk_i) begin
        {left_q, right_q} <= REFINED ? {limited, limited} : {n, h};
        {a_q, b_q}        <= at(0) ? {n, l} : {left_q, right_q};
      end
      shade_mul #(.A_W(W), .B_W(W)) u_mul (.clk_i, .a_i(a_q), .b_i(b_q), .p_o(p));
    end
    always_ff @(posedge clk_i) begin
      xy_q    <= SUM_W'(g_component[0].p) + SUM_W'(g_component[1].p);
      z_q     <= (at(3) ? HALF_NL : first_x) + (minus ? -z : z);
      minus_q <= minus;
    end
    assign z      = SUM_W'(g_component[2].p);
    assign nl_sum = minus_q ? z_q - xy_q : z_q + xy_q;
    assign x_sum  = nl_sum;
  end else begin : g_sums
    localparam int SUMS = FOLD < 6 ? 2 : 1;  // with a multiplier each
    shade_pkg::vec_t n_q;
    logic signed [W-1:0] n, h, limited, left_q, right_q;
    logic signed [W:0] difference;
    always_comb begin
      {n, h} = {n_q.z, h_i.z};
      if (at(X_AT - 1)) {n, h} = {n_q.x, h_i.x};
      else if (at(X_AT)) {n, h} = {n_q.y, h_i.y};
    end
    assign difference = (W + 1)'(n) - (W + 1)'(h);
    shade_limit #(.WIDTH(W + 1), .OUT_W(W)) u_limit (.x_i(difference), .y_o(limited));
    always_ff @(posedge clk_i) begin
      if (at(0)) n_q <= n_i;
      {left_q, right_q} <= REFINED ? {limited, limited} : {n, h};
    end
    for (genvar m = 0; m < SUMS; m++) begin : g_sum
      localparam bit NL = m == 0;
      localparam bit X = m == SUMS - 1;
      logic signed [W-1:0] a_q, b_q;
      logic signed [P_W-1:0] p;
      logic signed [SUM_W-1:0] first, term, sum_q;
      logic starts, minus;
      always_ff @(posedge clk_i) begin
        if (NL && at(0)) {a_q, b_q} <= {n_i.x, l_i.x};
        else if (NL && at(1)) {a_q, b_q} <= {n_q.y, l_i.y};
        else if (NL && (!X || at(2))) {a_q, b_q} <= {n_q.z, l_i.z};
        else {a_q, b_q} <= {left_q, right_q};
      end
      shade_mul #(.A_W(W), .B_W(W)) u_mul (.clk_i, .a_i(a_q), .b_i(b_q), .p_o(p));
      assign starts = (NL && at(3)) || (X && at(X_AT + 3));
      assign first  = NL && (!X || at(3)) ? HALF_NL : first_x;
      assign minus  = !REFINED && X && (at(X_AT + 3) || at(X_AT + 4) || at(X_AT + 5));
      assign term   = minus ? -(SUM_W'(p)) : SUM_W'(p);
      always_ff @(posedge clk_i) sum_q <= (starts ? first : sum_q) + term;
    end
    assign nl_sum = g_sum[0].sum_q;
    assign x_sum  = g_sum[SUMS-1].sum_q;
  end

  // ---- N.L; x into its range -------------------------------------------------------------------------------------
  logic signed [DOT_W-1:0] nl_q;
  logic signed [X_W-1:0] far_q;
  logic [X_F+1:0] clamped;
  logic [CUT-1:0] last, kept;
  logic [shade_pkg::VERSINE_W-1:0] x_q;
  logic range, range_q;
  assign last = CUT'(far_q);
  assign kept = shift_i == FINE ? '0 : ~({CUT{1'b1}} >> shift_i);
  shade_clamp #(.WIDTH(X_W - CUT), .F(X_F + 1)) u_clamp (
    .x_i((X_W - CUT)'(far_q >>> CUT)), .y_o(clamped), .clamped_o(range)
  );
  always_ff @(posedge clk_i) begin
    if (at(NL_DONE)) nl_q <= DOT_W'(nl_sum >>> F);
    if (at(X_DONE)) far_q <= X_W'(x_sum >>> DROP);
    if (at(X_DONE + 1)) {range_q, x_q} <= {range, clamped, range || clamped[X_F+1] ? '0 : last & kept};
  end
  shade_hold #(.WIDTH(DOT_W), .DEPTH(LATENCY - NL_DONE - 1), .FOLD(FOLD)) u_nl (
    .clk_i, .load_i(at(NL_DONE)), .d_i(nl_q), .q_o(nl_o)
  );
  shade_hold #(.WIDTH($bits(x_o) + 1), .DEPTH(LATENCY - X_DONE - 2), .FOLD(FOLD)) u_x (
    .clk_i, .load_i(at(X_DONE + 1)), .d_i({range_q, x_q}), .q_o({range_o, x_o})
  );
endmodule
