// SPDX-License-Identifier: Apache-2.0
// shade_lobe: max(0, 1 - k1 x + k2 x^2)^(2^power), the highlight of every model, over x = 1 - c, the versine of an angle.
//
//   x_i      dd.ffff ff        U2.26   1 - c; beyond 1 (c < 0), cut to U2.20, the lobe is 0
//   lobe_i.shift  0 .. 6               X = min(x 2^shift, xmax), cut to U1.20, is what k1, k2 belong to:
//   lobe_i.k1     d.ffff f     U1.20   k1 / 2^shift
//   lobe_i.k2     s.ffff       S0.17   k2 / 4^shift; 0 is the form of P1 and P3
//   lobe_i.xmax   d.ffff       U1.16   where a parabola that opens upwards has its vertex, k1 / (2 k2)
//   lobe_i.shift  7 (LOBE_FINE)        X = min(x, xmax), k1 and k2 of lobe_i are 4 k1 and 4 k2, below 2 and 1
//   lobe_i.power  0 .. POWER           squarings; more count as POWER
//   lobe_o    d.ffff           U1.16   in [0, 1]
//
//   s = k1 - k2 X      U1.18, limited; of X 17 fraction bits and the middle of the rest
//   y = s X            U1.22, limited to 1: 1 - base; then power times y <- 1 - (1 - y)^2:
//   z = y or 1 - y     whichever is below 1/2, 17 fraction bits and the middle of what is cut; 1 - y as ones' complement
//   y = 2 y - z^2, from 1/2 on 1 - z^2; a stage that is not needed takes y - 0, in the same clocks
//
// s has 19 bits, X 21, an 18 x 18 multiplier takes 18 and 17 of them: s = s' + last bit, X = X' + last four bits. The other
// products are rows of a few bits in logic, added to X', which the multiplier leaves open: s' X' = (s' - 1) X' + X'.
//
// Near the peak of the lobe y is small, and so is its error, which the power multiplies by 2^power. Roundings to
// nearest, ties up. For registers as golden.material.lobe_registers gives them (the least shift; xmax not beyond the
// vertex) within 1.5 ulp of the formula of the inputs for every x of 20 + shift fraction bits, what is below is cut; within
// 1.2 ulp for k2 >= 0, which all fits with power 4 have but for the broadest. n = 1 .. 1024, with POWER, the stages that are
// built, less than 4 up to 96 2^POWER.
//
// lobe_i must stay as it is while values are in flight.
//
// FOLD = 1: a value a clock; 2 + POWER 18 x 18 multipliers. Latency LATENCY_LOBE = 27 clocks, 4 fewer for each POWER less
//           than 4.
// FOLD = 2 .. 8: a value in FOLD clocks, taken when phase_i is TAKE: shade_lobe_folded.
//           Latency LATENCY_LOBE_FOLDED = 33 clocks (FOLD = 5: 38), 5 (6) fewer for each POWER less than 4.
// The bits are the same; the steps stand in shade_lobe_pkg.
// Example: n = 32, power 4, k1 = 2, k2 = 1 (shift 1: 1, 1/4), x = 1/8 -> (7/8)^32 = 0.01395.
// Source: P1, section III (D4, D8, D16), P3.
module shade_lobe #(
  parameter int POWER = 4,
  parameter int FOLD  = 1,
  parameter int TAKE  = 0
) (
  input  logic                            clk_i,
  input  logic [  shade_pkg::PHASE_W-1:0] phase_i,
  input  logic [shade_pkg::VERSINE_W-1:0] x_i,
  input  shade_pkg::highlight_t           lobe_i,
  output logic [  shade_pkg::INTENSITY_F:0] lobe_o
);
  if (POWER < 2 || POWER > 4 || FOLD < 1 || FOLD > shade_pkg::FOLD_MAX || TAKE < 0 || TAKE >= FOLD) begin : g_check
    $error("shade_lobe: POWER must be in 2 .. 4, FOLD in 1 .. 8 and TAKE below FOLD");
  end
  if (shade_lobe_pkg::X_F != shade_pkg::LOBE_SCALED_F || shade_lobe_pkg::FIRST_F != shade_pkg::LOBE_X_F ||
      shade_lobe_pkg::SLOPE_F != shade_pkg::LOBE_SLOPE_F || shade_lobe_pkg::K1_W != shade_pkg::LOBE_K1_W ||
      shade_lobe_pkg::K2_F != shade_pkg::LOBE_K2_F || shade_lobe_pkg::S_F != shade_pkg::LOBE_S_F ||
      shade_lobe_pkg::ROW_W != shade_pkg::LOBE_ROW_F + 1 || shade_lobe_pkg::BIT_W != shade_pkg::LOBE_BIT_F + 1 ||
      shade_lobe_pkg::Y_F != shade_pkg::LOBE_F || shade_lobe_pkg::Z_F != shade_pkg::LOBE_Z_F ||
      shade_lobe_pkg::FINE_F != shade_pkg::LOBE_FINE_F || shade_lobe_pkg::OUT_F != shade_pkg::INTENSITY_F) begin : g_same
    $error("shade_lobe: the constants of shade_lobe_pkg are not those of shade_pkg");
  end

  // ---- X: the least of x 2^shift and xmax ------------------------------------------------------------------------
  localparam int X_F = shade_lobe_pkg::X_F;
  localparam int X_W = shade_lobe_pkg::X_W;
  localparam int LAST_W = shade_lobe_pkg::X_F - shade_lobe_pkg::FIRST_F;
  localparam int CUT = shade_pkg::VERSINE_CUT;
  localparam int WIDE_W = shade_pkg::VERSINE_W + shade_pkg::LOBE_FINE - 1;  // of x 2^shift, CUT more than are needed
  logic fine, over_q2, dark_q1, dark_q2;  // dark: c < 0
  logic [WIDE_W-1:0] wide;
  logic [WIDE_W-CUT-1:0] wide_q1;
  logic [X_W-1:0] x_q2, x;
  assign fine = lobe_i.shift == shade_pkg::LOBE_SHIFT_W'(shade_pkg::LOBE_FINE);
  assign wide = WIDE_W'(x_i) << (fine ? '0 : lobe_i.shift);
  always_ff @(posedge clk_i) begin
    wide_q1 <= (WIDE_W - CUT)'(wide >> CUT);
    x_q2    <= X_W'(wide_q1);
    over_q2 <= (wide_q1 >> LAST_W) >= (WIDE_W - CUT)'(lobe_i.xmax);
    dark_q1 <= x_i >> CUT > shade_pkg::VERSINE_W'(1) << X_F;
    dark_q2 <= dark_q1;
  end
  assign x = over_q2 ? {lobe_i.xmax, {LAST_W{1'b0}}} : x_q2;

  if (FOLD > 1) begin : g_folded
    shade_lobe_folded #(.POWER(POWER), .FOLD(FOLD), .TAKE((TAKE + 2) % FOLD)) u_folded (
      .clk_i, .phase_i, .x_i(x), .dark_i(dark_q2), .lobe_i, .lobe_o
    );
  end else begin : g_parallel
    localparam int MUL = shade_pkg::LATENCY_MUL;
    localparam int W = shade_lobe_pkg::W;
    localparam int P_W = 2 * W;
    localparam int ROW_W = shade_lobe_pkg::ROW_W;
    localparam int Y_W = shade_lobe_pkg::Y_W;
    localparam int Z_W = shade_lobe_pkg::Z_W;
    localparam int A_W = shade_lobe_pkg::A_W;
    localparam int D_W = shade_lobe_pkg::D_W;

    // ---- s and y -------------------------------------------------------------------------------------------------
    logic signed [shade_lobe_pkg::K_W-1:0] k1_q, k_q;
    logic [LAST_W-1:0] last_q7;
    logic [shade_lobe_pkg::FIRST_W-1:0] first_q7;
    logic signed [P_W-1:0] p_q5, p_q9;
    logic [X_W-1:0] x_q3;
    logic dark_q9, odd_q7;
    logic [shade_lobe_pkg::S_W-1:0] s_q6;
    logic [W-1:0] t_q7;
    logic [ROW_W+1:0] upper_q8, lower_q8;
    logic [D_W-1:0] d_q8, d_q9;
    logic [Y_W-1:0] y_q10;
    always_ff @(posedge clk_i) begin
      x_q3           <= x;
      k1_q           <= shade_lobe_pkg::raised(lobe_i.k1);
      k_q            <= k1_q - shade_lobe_pkg::doubled(lobe_i.k2);
      s_q6           <= shade_lobe_pkg::slope(k_q, p_q5);
      {t_q7, odd_q7} <= shade_lobe_pkg::offset(s_q6);
      upper_q8       <= shade_lobe_pkg::rows(t_q7, last_q7[3:2]);
      lower_q8       <= shade_lobe_pkg::rows(t_q7, last_q7[1:0]);
      d_q8           <= shade_lobe_pkg::beside(first_q7, odd_q7);
      d_q9           <= d_q8 + D_W'({upper_q8, 2'b00}) + D_W'(lower_q8);
      y_q10          <= shade_lobe_pkg::base(p_q9, d_q9, dark_q9, fine);
    end
    shade_mul #(.A_W(W), .B_W(W)) u_slope (
      .clk_i, .a_i(lobe_i.k2), .b_i(shade_lobe_pkg::below(x_q3)), .p_o(p_q5)
    );
    shade_mul #(.A_W(W), .B_W(W)) u_base (.clk_i, .a_i(t_q7), .b_i({1'b0, first_q7}), .p_o(p_q9));
    shade_delay #(.WIDTH(X_W), .DEPTH(MUL + 2)) u_x (.clk_i, .d_i(x_q3), .q_o({first_q7, last_q7}));
    shade_delay #(.WIDTH(1), .DEPTH(2 * MUL + 3)) u_dark (.clk_i, .d_i(dark_q2), .q_o(dark_q9));

    // ---- squarings -----------------------------------------------------------------------------------------------
    for (genvar i = 0; i < POWER; i++) begin : g_power
      logic squared, unused_top;
      logic [Y_W-1:0] y;
      logic [Z_W-1:0] z_q;
      logic [A_W-1:0] a_q, a_late, y_q;
      logic [2*Z_W-1:0] square;
      assign squared = lobe_i.power > shade_pkg::LOBE_POWER_W'(i);
      if (i == 0) begin : g_first
        assign y = y_q10;
      end else begin : g_next
        assign y = {1'b0, g_power[i-1].y_q};
      end
      always_ff @(posedge clk_i) begin
        z_q <= shade_lobe_pkg::low(y, squared);
        a_q <= shade_lobe_pkg::minuend(y, squared);
        y_q <= shade_lobe_pkg::less(a_late, square);
      end
      shade_delay #(.WIDTH(A_W), .DEPTH(MUL)) u_a (.clk_i, .d_i(a_q), .q_o(a_late));
      shade_square #(.WIDTH(Z_W + 1)) u_square (.clk_i, .x_i({1'b0, z_q}), .y_o({unused_top, square}));
    end
    always_ff @(posedge clk_i) lobe_o <= shade_lobe_pkg::result(g_power[POWER-1].y_q);
    logic unused_phase;
    assign unused_phase = &{1'b0, phase_i};
  end
endmodule
