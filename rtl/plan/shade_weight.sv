// SPDX-License-Identifier: Apache-2.0
// shade_weight: how many times kappa may be halved because the highlight is far: light that is dark needs no fine steps.
//
//   x = 1 - N.H of a span's first normal      w = floor((x 2^exponent - kappa / 2^18) / 8), in 0 .. limit
//
// On an arc whose ends are apart by u, x does not fall below x/2 - u (the triangle inequality of chords), and cos^n is
// e^(-n x) there; w is a part of it that leaves the error of the highlight as it is: (n x / 2 - n u) / 4, n as a power of two.
//
//   normal_i      S2.29, of which S2.15 count     h_i  S1.16, constant while spans are under way
//   kappa_i       U11.20, of the arc: taken 16 clocks later
//   planner_i     sharpness_exp; weight: the limit; 0: no weight, as in the paper
//   weight_o      until the next one comes
//   N.H rounded to 16 fraction bits, ties up; x cut to [0, 2 - 2^-16]
//
// One component a clock; an 18 x 18 multiplier. A span in PACE clocks, at least 4, taken when phase_i is 0; phase_i counts
// 0 .. PACE - 1. Latency LATENCY_WEIGHT = 17 clocks.
// Example: N.H = 0.9, exponent 9 (n = 512), kappa = 2 -> (51.2 - 8) / 8 -> 5. Source: P1, section V (degrees by region).
module shade_weight #(
  parameter int PACE = 4
) (
  input  logic                           clk_i,
  input  logic [  shade_pkg::LOG2_W-1:0] phase_i,
  input  shade_pkg::step_t               normal_i,
  input  shade_pkg::vec_t                h_i,
  input  logic [ shade_pkg::KAPPA_W-1:0] kappa_i,
  input  shade_pkg::planner_t            planner_i,
  output logic [shade_pkg::WEIGHT_W-1:0] weight_o
);
  if (PACE < 4 || PACE > shade_pkg::LOG2_MAX) begin : g_check
    $error("shade_weight: PACE must be in 4 .. 12");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int F = shade_pkg::INTENSITY_F;
  localparam int CUT = shade_pkg::STEP_W - W;
  localparam int SUM_W = 2 * W + 2;
  localparam int DROP = shade_pkg::NODE_F;
  localparam int DOT_W = SUM_W - DROP;
  shade_pkg::vec_t n;
  assign n.x = normal_i.x[CUT+:W];
  assign n.y = normal_i.y[CUT+:W];
  assign n.z = normal_i.z[CUT+:W];

  // is it clock c of a span?
  function automatic logic at(input int c);
    at = phase_i == shade_pkg::LOG2_W'(c % PACE);
  endfunction

  // ---- N.H: factors stand at the multiplier in clocks 1, 2, 3, their sum is there in clock 6 -------------------------------
  logic signed [SUM_W-1:0] sum_q;  // rounded by what it begins with
  localparam logic signed [SUM_W-1:0] HALF = SUM_W'(1) <<< (DROP - 1);
  logic signed [W-1:0] y_q, z_q, a_q, b_q;
  logic signed [2*W-1:0] product;
  always_ff @(posedge clk_i) begin
    if (at(0)) {y_q, z_q} <= {n.y, n.z};
    a_q   <= at(0) ? n.x : at(1) ? y_q : z_q;
    b_q   <= at(0) ? h_i.x : at(1) ? h_i.y : h_i.z;
    sum_q <= at(2) ? HALF : sum_q + SUM_W'(product);
  end
  shade_mul #(.A_W(W), .B_W(W)) u_mul (.clk_i, .a_i(a_q), .b_i(b_q), .p_o(product));

  // ---- x 2^exponent, the span's own until kappa comes -----------------------------------------------------------------
  localparam int X_W = F + 1;
  localparam int N_W = 14;  // below 2^13
  logic signed [DOT_W-1:0] rest_q7;
  logic [X_W-1:0] x_q8, x_q9;
  logic [N_W-1:0] far_q10, far_q14;
  always_ff @(posedge clk_i) begin
    if (at(6)) rest_q7 <= DOT_W'(1 << F) - DOT_W'(sum_q >>> DROP);
    x_q8    <= rest_q7 < 0 ? '0 : rest_q7 >= DOT_W'(2 << F) ? '1 : X_W'(rest_q7);
    x_q9    <= x_q8 >> (~planner_i.sharpness_exp & 4'b1100);
    far_q10 <= N_W'({1'b0, x_q9} >> 1 >> (~planner_i.sharpness_exp & 4'b0011));
    if (at(13)) far_q14 <= far_q10;
  end

  // ---- what is left of it, in eighths ----------------------------------------------------------------------------------
  localparam int WEIGHT_W = shade_pkg::WEIGHT_W;
  localparam int LOW = shade_pkg::KAPPA_F - 2;
  logic signed [N_W:0] left;
  logic [N_W-4:0] eighths;
  assign left    = $signed({1'b0, far_q14}) - $signed((N_W + 1)'(kappa_i >> LOW));
  assign eighths = left[N_W] ? '0 : left[N_W-1:3];
  always_ff @(posedge clk_i) begin
    weight_o <= eighths > (N_W - 3)'(planner_i.weight) ? planner_i.weight : WEIGHT_W'(eighths);
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, normal_i, planner_i, sum_q, left};
endmodule
