// SPDX-License-Identifier: Apache-2.0
// shade_criterion: how much too dark a triangle gets when its normals are not normalized, and whether that is too much.
//
//   eta = delta(cAB) + delta(cBC) + delta(cCA)      delta(c) = 1 - sqrt((1 + c)/2)      c: cosine of an edge's normals
//
//   FORM_REFINED             delta = u/4 + 35 u^2/1024 + 9 u^4/1024       u = 1 - c: exactly 0 for c = 1, within 1.3e-4
//   FORM_PAPER, DEGREE = 1   delta = 0.28546 - 0.29073 c                  within 7.5e-3
//   FORM_PAPER, DEGREE = 2   delta = 0.29223 - 0.34122 c + 0.04942 c^2    within 6.7e-4
//
//   cosines_i         S1.16, clamped to [0, 1]: clamped
//   threshold_i       S1.18, clamped to [0, 1]: threshold_error
//   u^2, c^2, u^4     18 fraction bits, the rest is cut (u^2 has 16 of them before it is squared)
//   criterion_o.eta   S1.18, to nearest, ties up: error below 1 ulp of the formula; with P2's constants to eight
//                     digits 4.1 ulp (DEGREE 1), 9.0 ulp (DEGREE 2). The paper's can be negative.
//   .normalize        eta > threshold: the triangle's normals must be normalized
//
// The three edges are added before they are weighed, so that every constant, of 16 fraction bits, is met once. Shifts
// and adds; six 18 x 18 multipliers (paper: three, none in DEGREE 1). All flags come with the result.
// Latency LATENCY_CRITERION = 12 clocks, one triangle a clock. Source: P2 (its coefficients recomputed by interpolation
// at the Chebyshev nodes). Example: three cosines of 0.98 (11.5 degrees) -> eta = 0.01504.
module shade_criterion #(
  parameter int FORM   = shade_pkg::FORM_REFINED,
  parameter int DEGREE = 2
) (
  input  logic                               clk_i,
  input  logic                               rst_i,
  input  shade_pkg::cosines_t                cosines_i,
  input  logic signed [shade_pkg::ETA_W-1:0] threshold_i,
  output shade_pkg::criterion_t              criterion_o
);
  if (FORM != shade_pkg::FORM_PAPER && FORM != shade_pkg::FORM_REFINED) begin : g_check_form
    $error("shade_criterion: FORM must be FORM_PAPER or FORM_REFINED");
  end
  if (DEGREE != 2 && (DEGREE != 1 || FORM == shade_pkg::FORM_REFINED)) begin : g_check_degree
    $error("shade_criterion: DEGREE must be 2, or 1 in FORM_PAPER");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int C_F = shade_pkg::INTENSITY_F;
  localparam int F = shade_pkg::SQUARE_F;
  localparam int V_W = F + 1;  // u or c, and its powers: U1.18
  localparam int SUM_W = V_W + 3;  // of three, signed
  localparam int LATENCY = shade_pkg::LATENCY_CRITERION;
  localparam bit REFINED = FORM == shade_pkg::FORM_REFINED;
  localparam bit LINEAR = DEGREE == 1;

  // ---- the powers of each edge: v (u or c) after 1 clock, v^2 after 3, v^4 after 5 -------------------------------
  logic [2:0][W-1:0] edges;
  logic [2:0][V_W-1:0] v_q1, vv_q3, vvvv_q5;
  logic [2:0] clamped;
  assign edges = cosines_i;
  for (genvar e = 0; e < 3; e++) begin : g_edge
    logic [C_F:0] c, c_q1;
    logic [2*W-2:0] square_q3;
    shade_clamp u_clamp (.x_i(edges[e]), .y_o(c), .clamped_o(clamped[e]));
    always_ff @(posedge clk_i) c_q1 <= REFINED ? (C_F + 1)'(1 << C_F) - c : c;
    assign v_q1[e] = {c_q1, {(F - C_F) {1'b0}}};

    shade_square u_square (.clk_i, .x_i({1'b0, c_q1}), .y_o(square_q3));
    assign vv_q3[e] = V_W'(square_q3 >> (2 * C_F - F));
    logic unused_square;
    assign unused_square = &{1'b0, square_q3};

    if (REFINED) begin : g_refined
      logic [2*W-2:0] fourth_q5;
      logic signed [W-1:0] square;
      assign square = W'(square_q3 >> C_F);  // at most 1
      shade_square u_fourth (.clk_i, .x_i(square), .y_o(fourth_q5));
      assign vvvv_q5[e] = V_W'(fourth_q5 >> (2 * C_F - F));
      logic unused_fourth;
      assign unused_fourth = &{1'b0, fourth_q5};
    end else begin : g_paper
      assign vvvv_q5[e] = '0;
    end
  end

  // ---- every power summed over the edges, all at clock 7 ----------------------------------------------------------
  logic [2:0][2:0][V_W-1:0] powers;
  logic [2:0][SUM_W-1:0] sums_q7;
  assign powers = {vvvv_q5, vv_q3, v_q1};
  for (genvar p = 0; p < 3; p++) begin : g_power
    logic [SUM_W-1:0] two_q, third_q, sum_q;
    always_ff @(posedge clk_i) begin
      two_q   <= SUM_W'(powers[p][0]) + SUM_W'(powers[p][1]);
      third_q <= SUM_W'(powers[p][2]);
      sum_q   <= two_q + third_q;
    end
    shade_ring #(.WIDTH(SUM_W), .DEPTH(4 - 2 * p)) u_wait (.clk_i, .rst_i, .d_i(sum_q), .q_o(sums_q7[p]));
  end

  logic signed [shade_pkg::ETA_W-1:0] eta_q11;
  shade_weigh #(
    .WIDTH(SUM_W), .F(F), .OUT_W(shade_pkg::ETA_W), .OUT_F(shade_pkg::ETA_F),
    .K0(REFINED ? 0 : 3 * (LINEAR ? shade_pkg::ETA1_0 : shade_pkg::ETA2_0)),
    .KX(REFINED ? shade_pkg::ETA_U : LINEAR ? shade_pkg::ETA1_C : shade_pkg::ETA2_C),
    .KY(REFINED ? shade_pkg::ETA_UU : LINEAR ? 0 : shade_pkg::ETA2_CC),
    .KZ(REFINED ? shade_pkg::ETA_UUUU : 0)
  ) u_weigh (.clk_i, .x_i(sums_q7[0]), .y_i(sums_q7[1]), .z_i(sums_q7[2]), .w_o(eta_q11));

  // ---- the decision ----------------------------------------------------------------------------------------------
  logic [shade_pkg::ETA_F:0] threshold, threshold_q1, threshold_q11;
  logic threshold_error;
  logic [1:0] flags_q1;
  shade_clamp #(.WIDTH(shade_pkg::ETA_W), .F(shade_pkg::ETA_F)) u_threshold (
    .x_i(threshold_i), .y_o(threshold), .clamped_o(threshold_error)
  );
  always_ff @(posedge clk_i) begin
    threshold_q1          <= threshold;
    flags_q1              <= {|clamped, threshold_error};
    criterion_o.eta       <= eta_q11;
    criterion_o.normalize <= eta_q11 > $signed({1'b0, threshold_q11});
  end
  shade_delay #(.WIDTH(shade_pkg::ETA_F + 1), .DEPTH(LATENCY - 2)) u_wait (
    .clk_i, .d_i(threshold_q1), .q_o(threshold_q11)
  );
  shade_delay #(.WIDTH(2), .DEPTH(LATENCY - 1)) u_flags (
    .clk_i, .d_i(flags_q1), .q_o({criterion_o.clamped, criterion_o.threshold_error})
  );
endmodule
