// SPDX-License-Identifier: Apache-2.0
// shade_weight: how many times kappa may be halved because the highlight is far: light that is dark needs no fine steps.
//
//   x = 1 - N.H of a span's first normal      w = floor((x 2^exponent - kappa / 2^18) / 8), in 0 .. limit
//
// On an arc whose ends are apart by u, x does not fall below x/2 - u (the triangle inequality of chords), and cos^n is
// e^(-n x) there; w is a part of it that leaves the error of the highlight as it is: (n x / 2 - n u) / 4, n as a power of two.
//
//   normal_i      S2.29, of which S2.15 count     h_i  S1.16, constant while spans are under way
//   kappa_i       U11.20, of the arc: LATENCY_KAPPA clocks later, FOLD = 3 .. 8: by FOLD more
//   planner_i     sharpness_exp; weight: the limit; 0: no weight, as in the paper
//   weight_o      1 clock behind kappa_i
//   N.H rounded to 16 fraction bits, ties up; x cut to [0, 2 - 2^-16]
//
// FOLD = 1, 2: three 18 x 18 multipliers, one span a clock. FOLD = 3 .. 8: one, a span in FOLD clocks, taken when phase_i is 0.
// Latency LATENCY_KAPPA + 1 clocks, FOLD = 3 .. 8: FOLD more.
// Example: N.H = 0.9, exponent 9 (n = 512), kappa = 2 -> (51.2 - 8) / 8 -> 5. Source: P1, section V (degrees by region).
module shade_weight #(
  parameter int FOLD = 1
) (
  input  logic                           clk_i,
  input  logic                           rst_i,
  input  logic [ shade_pkg::PHASE_W-1:0] phase_i,
  input  shade_pkg::step_t               normal_i,
  input  shade_pkg::vec_t                h_i,
  input  logic [ shade_pkg::KAPPA_W-1:0] kappa_i,
  input  shade_pkg::planner_t            planner_i,
  output logic [shade_pkg::WEIGHT_W-1:0] weight_o
);
  if (FOLD < 1 || FOLD > shade_pkg::FOLD_MAX) begin : g_check
    $error("shade_weight: FOLD must be in 1 .. 8");
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

  // ---- N.H ---------------------------------------------------------------------------------------------------------
  logic signed [SUM_W-1:0] sum;  // rounded by what it begins with
  localparam logic signed [SUM_W-1:0] HALF = SUM_W'(1) <<< (DROP - 1);
  localparam int SUMMED = FOLD < 3 ? 4 : 6;
  if (FOLD < 3) begin : g_parallel
    logic signed [2*W-1:0] x_q2, y_q2, z_q2;
    logic signed [SUM_W-1:0] xy_q3, z_q3, sum_q4;
    shade_mul #(.A_W(W), .B_W(W)) u_x (.clk_i, .a_i(n.x), .b_i(h_i.x), .p_o(x_q2));
    shade_mul #(.A_W(W), .B_W(W)) u_y (.clk_i, .a_i(n.y), .b_i(h_i.y), .p_o(y_q2));
    shade_mul #(.A_W(W), .B_W(W)) u_z (.clk_i, .a_i(n.z), .b_i(h_i.z), .p_o(z_q2));
    always_ff @(posedge clk_i) begin
      xy_q3  <= SUM_W'(x_q2) + SUM_W'(y_q2);
      z_q3   <= SUM_W'(z_q2) + HALF;
      sum_q4 <= xy_q3 + z_q3;
    end
    assign sum = sum_q4;
    logic unused_phase;
    assign unused_phase = &{1'b0, phase_i};
  end else begin : g_folded
    // factors of clock c stand at the multiplier in c + 1, their product comes in c + 3
    function automatic logic at(input int c);
      at = phase_i == shade_pkg::PHASE_W'(c % FOLD);
    endfunction
    logic signed [W-1:0] y_q, z_q, a_q, b_q;
    logic signed [2*W-1:0] product;
    logic signed [SUM_W-1:0] sum_q;
    always_ff @(posedge clk_i) begin
      if (at(0)) {y_q, z_q} <= {n.y, n.z};
      a_q   <= at(0) ? n.x : at(1) ? y_q : z_q;
      b_q   <= at(0) ? h_i.x : at(1) ? h_i.y : h_i.z;
      sum_q <= (at(3) ? HALF : sum_q) + SUM_W'(product);
    end
    shade_mul #(.A_W(W), .B_W(W)) u_mul (.clk_i, .a_i(a_q), .b_i(b_q), .p_o(product));
    assign sum = sum_q;  // in clock 6
  end

  // ---- x 2^exponent, the span's own until kappa comes -----------------------------------------------------------------
  localparam int X_W = F + 1;
  localparam int N_W = 14;  // below 2^13
  localparam int LATER = FOLD < 3 ? 0 : FOLD;
  logic signed [DOT_W-1:0] rest_q;
  logic [X_W-1:0] x_q, x_shifted_q;
  logic [N_W-1:0] far_q, far;
  always_ff @(posedge clk_i) begin
    rest_q      <= DOT_W'(1 << F) - DOT_W'(sum >>> DROP);
    x_q         <= rest_q < 0 ? '0 : rest_q >= DOT_W'(2 << F) ? '1 : X_W'(rest_q);
    x_shifted_q <= x_q >> (~planner_i.sharpness_exp & 4'b1100);
    far_q       <= N_W'({1'b0, x_shifted_q} >> 1 >> (~planner_i.sharpness_exp & 4'b0011));
  end
  shade_ring #(.WIDTH(N_W), .DEPTH(shade_pkg::LATENCY_KAPPA + LATER - SUMMED - 4)) u_far (
    .clk_i, .rst_i, .d_i(far_q), .q_o(far)
  );

  // ---- what is left of it, in eighths ----------------------------------------------------------------------------------
  localparam int WEIGHT_W = shade_pkg::WEIGHT_W;
  localparam int LOW = shade_pkg::KAPPA_F - 2;
  logic signed [N_W:0] left;
  logic [N_W-4:0] eighths;
  assign left    = $signed({1'b0, far}) - $signed((N_W + 1)'(kappa_i >> LOW));
  assign eighths = left[N_W] ? '0 : left[N_W-1:3];
  always_ff @(posedge clk_i) begin
    weight_o <= eighths > (N_W - 3)'(planner_i.weight) ? planner_i.weight : WEIGHT_W'(eighths);
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, normal_i, planner_i, sum, left};
endmodule
