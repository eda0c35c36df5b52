// SPDX-License-Identifier: Apache-2.0
// shade_lobe: max(0, 1 - k1 x + k2 x^2)^(2^power), the highlight of every model, over x = 1 - c, the versine of an angle.
//
//   x_i      dd.ffff f         U2.20   1 - c; beyond 1 (c < 0) the lobe is 0
//   shift_i  0 .. 6                    X = min(x 2^shift, xmax), U1.20, is what k1 and k2 belong to:
//   k1_i      d.ffff f         U1.20   k1 / 2^shift
//   k2_i      s.ffff           S0.17   k2 / 4^shift; 0 is the form of P1 and P3
//   xmax_i    d.ffff           U1.16   where a parabola that opens upwards has its vertex, k1 / (2 k2)
//   shift_i  7 (LOBE_FINE)             X = min(x, xmax), k1_i and k2_i are 4 k1 and 4 k2, below 2 and 1
//   power_i  0 .. POWER                squarings; more count as POWER
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
// vertex) within 1.5 ulp of the formula of the inputs for every x, within 1.2 ulp for k2 >= 0, which all fits with power 4
// have but for the broadest. n = 1 .. 1024, with POWER, the stages that are built, less than 4 up to 96 2^POWER.
//
// k1_i .. power_i must stay as they are while values are in flight.
//
// FOLD = 1: a value a clock; four 18 x 18 multipliers, and a shade_square_fabric for every squaring behind the second.
//           Latency LATENCY_LOBE = 31 clocks, 6 fewer for each POWER less than 4.
// FOLD = 2 .. 8: a value in FOLD clocks, taken when phase_i is TAKE; phase_i counts 0 .. FOLD - 1. The 2 + POWER products
//           share as many multipliers as that takes, six of them 3, 2, 2, 2, 1, 1, 1. A product is a turn of five clocks
//           (FOLD = 5: six), so that those of one multiplier never meet.
//           Latency LATENCY_LOBE_FOLDED = 33 clocks (FOLD = 5: 38), 5 (6) fewer for each POWER less than 4.
// The bits are the same. Example: n = 32, power 4, k1 = 2, k2 = 1 (shift 1: 1, 1/4), x = 1/8 -> (7/8)^32 = 0.01395.
// Source: P1, section III (D4, D8, D16), P3.
module shade_lobe #(
  parameter int POWER = 4,
  parameter int FOLD  = 1,
  parameter int TAKE  = 0
) (
  input  logic                                      clk_i,
  input  logic        [     shade_pkg::PHASE_W-1:0] phase_i,
  input  logic        [   shade_pkg::VERSINE_W-1:0] x_i,
  input  logic        [   shade_pkg::LOBE_K1_W-1:0] k1_i,
  input  logic signed [   shade_pkg::LOBE_K2_W-1:0] k2_i,
  input  logic        [shade_pkg::LOBE_SHIFT_W-1:0] shift_i,
  input  logic        [      shade_pkg::LOBE_X_F:0] xmax_i,
  input  logic        [ shade_pkg::LOBE_POWER_W-1:0] power_i,
  output logic        [   shade_pkg::INTENSITY_F:0] lobe_o
);
  if (POWER < 2 || POWER > 4 || FOLD < 1 || FOLD > shade_pkg::FOLD_MAX || TAKE < 0 || TAKE >= FOLD) begin : g_check
    $error("shade_lobe: POWER must be in 2 .. 4, FOLD in 1 .. 8 and TAKE below FOLD");
  end

  localparam int MUL = shade_pkg::LATENCY_MUL;
  localparam int W = 18;  // operands of a multiplier
  localparam int P_W = 2 * W;
  localparam int Y_F = shade_pkg::LOBE_F;
  localparam int Y_W = Y_F + 2;  // s X < 4
  localparam int A_W = Y_F + 1;

  // ---- X: the least of x 2^shift and xmax ------------------------------------------------------------------------
  localparam int X_F = shade_pkg::VERSINE_F;
  localparam int X_W = X_F + 1;
  localparam int LAST = X_F - shade_pkg::LOBE_X_F;
  localparam int WIDE_W = shade_pkg::VERSINE_W + shade_pkg::LOBE_FINE - 1;
  logic fine, over_q2, dark_q1, dark_q2, dark_q3;  // dark: c < 0
  logic [WIDE_W-1:0] wide_q1;
  logic [X_W-1:0] x_q2, x_q3;
  logic take3;
  assign fine = shift_i == shade_pkg::LOBE_SHIFT_W'(shade_pkg::LOBE_FINE);
  always_ff @(posedge clk_i) begin
    wide_q1 <= WIDE_W'(x_i) << (fine ? '0 : shift_i);
    x_q2    <= wide_q1[X_W-1:0];
    over_q2 <= wide_q1[WIDE_W-1:LAST] >= (WIDE_W - LAST)'(xmax_i);
    dark_q1 <= x_i[shade_pkg::VERSINE_W-1] || (x_i[X_F] && |x_i[X_F-1:0]);
    dark_q2 <= dark_q1;
    if (take3) begin
      x_q3    <= over_q2 ? {xmax_i, {LAST{1'b0}}} : x_q2;
      dark_q3 <= dark_q2;
    end
  end

  // ---- s ---------------------------------------------------------------------------------------------------------
  // X - 1, which a signed multiplier takes: s = k1 - k2 - k2 (X - 1); the middle of what is cut of X, 2^-18, belongs to k2
  localparam int SLOPE_F = shade_pkg::LOBE_SLOPE_F;
  function automatic logic [W-1:0] below(input logic [X_W-1:0] x);
    below = {!x[X_W-1], x[X_W-2-:SLOPE_F]};
  endfunction

  // k1 - k2 and half an ulp of s, 21 fraction bits
  localparam int S_F = shade_pkg::LOBE_S_F;
  localparam int S_W = S_F + 3;  // in (-2, 4)
  localparam int K1_F = shade_pkg::LOBE_K1_F + 1;
  localparam int K1_W = K1_F + 3;
  localparam int K2_F = shade_pkg::LOBE_K2_F;
  localparam int SUM_F = K2_F + SLOPE_F;
  localparam int SUM_W = SUM_F + 3;
  // k2 and its middle stand side by side, but for the sign: 8 for every 16
  localparam int MIDDLE_W = K1_F - K2_F;
  logic signed [K1_W-1:0] k1_q, k_q;
  always_ff @(posedge clk_i) begin
    k1_q <= $signed({2'b00, k1_i, 1'b0}) + K1_W'((1 << (K1_F - S_F - 1)) + (1 << (MIDDLE_W - 1)));
    k_q  <= k1_q - K1_W'($signed({k2_i, !k2_i[K2_F], k2_i[K2_F-1-:MIDDLE_W-1]}));
  end

  function automatic logic [S_W-1:0] slope(input logic signed [P_W-1:0] p);
    logic signed [SUM_W-1:0] sum;
    sum   = (SUM_W'(k_q) <<< (SUM_F - K1_F)) - SUM_W'(p);
    slope = S_W'(sum >>> (SUM_F - S_F));
  endfunction

  // s - 1, which a signed multiplier takes, of s limited to [0, 2), above the last bit of s
  function automatic logic [W:0] offset(input logic [S_W-1:0] s);
    logic negative, above;
    negative = s[S_W-1];
    above    = s[S_W-2];
    offset   = {negative || !(above || s[S_F]), s[S_F-1:0] & {S_F{!negative}} | {S_F{above && !negative}}};
  endfunction

  // ---- y ---------------------------------------------------------------------------------------------------------
  // two of the four rows of s times the last bits of X: 8 bits of s each
  localparam int ROW_W = shade_pkg::LOBE_ROW_F + 1;
  function automatic logic [ROW_W+1:0] rows(input logic [W-1:0] t, input logic [1:0] x);
    logic [ROW_W-1:0] s;
    s    = {!t[W-1], t[W-2-:ROW_W-1]};
    rows = (ROW_W + 2)'(s & {ROW_W{x[0]}}) + {1'b0, s & {ROW_W{x[1]}}, 1'b0};
  endfunction

  // X', the last bit of s times X', and half an ulp of y, side by side
  localparam int BIT_W = shade_pkg::LOBE_BIT_F + 1;
  localparam int D_F = X_F + shade_pkg::LOBE_ROW_F;
  localparam int D_W = D_F + 2;
  function automatic logic [D_W-1:0] beside(input logic [X_W-LAST-1:0] x, input logic odd);
    beside = {1'b0, x, 1'b0, x[X_W-LAST-1-:BIT_W] & {BIT_W{odd}}, 1'b1, {(D_F - Y_F - 1) {1'b0}}};
  endfunction

  // y = p + d for p = (s' - 1) X' and d all the rest; a dark one is 1
  localparam int BASE_F = S_F - 1 + shade_pkg::LOBE_X_F;
  function automatic logic [Y_W-1:0] base(input logic signed [P_W-1:0] p, input logic [D_W-1:0] d, input logic dark);
    logic signed [P_W:0] sum;
    logic [Y_W-1:0] y;
    sum  = (P_W + 1)'(p) + $signed((P_W + 1)'({d, {(BASE_F - D_F) {1'b0}}}));
    y    = Y_W'(sum >>> (BASE_F - Y_F));
    base = dark ? Y_W'(1) << Y_F : fine ? y >> shade_pkg::LOBE_FINE_F : y;
  endfunction

  // ---- squarings -------------------------------------------------------------------------------------------------
  // z, and what z^2 is taken from: 2 y or 1; without squaring z is its last bit, too small to count, and y stays
  localparam int Z_F = shade_pkg::LOBE_Z_F;
  localparam int Z_W = Z_F - 1;
  function automatic logic [Z_W-1:0] low(input logic [Y_W-1:0] y, input logic squared);
    logic one, high;
    one  = |y[Y_W-1:Y_F];
    high = one || y[Y_F-1];
    low  = {(y[Y_F-2-:Z_W-1] ^ {(Z_W - 1) {high}}) & {(Z_W - 1) {squared && !one}}, 1'b1};
  endfunction

  function automatic logic [A_W-1:0] minuend(input logic [Y_W-1:0] y, input logic squared);
    logic one;
    one     = |y[Y_W-1:Y_F] || (squared && y[Y_F-1]);
    minuend = {one, (squared ? {y[Y_F-2:0], 1'b0} : y[Y_F-1:0]) & {Y_F{!one}}};
  endfunction

  // a - z^2, to nearest; z^2 is odd, so that there are no ties and its first dropped bit does it
  localparam int DROP = 2 * Z_F - Y_F;
  function automatic logic [A_W-1:0] less(input logic [A_W-1:0] a, input logic [2*Z_W-1:0] q);
    logic [A_W:0] difference;
    difference = {a, 1'b0} - (A_W + 1)'(q >> (DROP - 1));
    less       = A_W'(difference >> 1);
  endfunction

  // 1 - y, to nearest
  localparam int OUT_W = shade_pkg::INTENSITY_F + 1;
  localparam int OUT_DROP = Y_F - shade_pkg::INTENSITY_F;
  function automatic logic [OUT_W-1:0] result(input logic [A_W-1:0] y);
    logic [A_W-1:0] difference;
    difference = (A_W'(1) << Y_F) + (A_W'(1) << (OUT_DROP - 1)) - y;
    result     = OUT_W'(difference >> OUT_DROP);
  endfunction

  localparam int X1_W = X_W - LAST;  // X'
  if (FOLD <= 1) begin : g_parallel
    logic [X_W-1:0] x_q7;
    logic signed [P_W-1:0] p_q5, p_q9;
    logic dark_q9, last_q7;
    logic [S_W-1:0] s_q6;
    logic [W-1:0] t_q7;
    logic [ROW_W+1:0] upper_q8, lower_q8;
    logic [D_W-1:0] d_q8, d_q9;
    logic [Y_W-1:0] y_q10;
    assign take3 = 1'b1;
    always_ff @(posedge clk_i) begin
      s_q6            <= slope(p_q5);
      {t_q7, last_q7} <= offset(s_q6);
      upper_q8        <= rows(t_q7, x_q7[LAST-1-:2]);
      lower_q8        <= rows(t_q7, x_q7[1:0]);
      d_q8            <= beside(x_q7[LAST+:X1_W], last_q7);
      d_q9            <= d_q8 + D_W'({upper_q8, 2'b00}) + D_W'(lower_q8);
      y_q10           <= base(p_q9, d_q9, dark_q9);
    end
    shade_mul #(.A_W(W), .B_W(W)) u_slope (.clk_i, .a_i(k2_i), .b_i(below(x_q3)), .p_o(p_q5));
    shade_mul #(.A_W(W), .B_W(W)) u_base (.clk_i, .a_i(t_q7), .b_i({1'b0, x_q7[LAST+:X1_W]}), .p_o(p_q9));
    shade_delay #(.WIDTH(X_W), .DEPTH(MUL + 2)) u_x7 (.clk_i, .d_i(x_q3), .q_o(x_q7));
    shade_delay #(.WIDTH(1), .DEPTH(2 * MUL + 2)) u_dark (.clk_i, .d_i(dark_q3), .q_o(dark_q9));

    for (genvar i = 0; i < POWER; i++) begin : g_power
      localparam bit FABRIC = i > 1;  // at most four DSP blocks
      localparam int SQUARE = FABRIC ? shade_pkg::LATENCY_SQUARE_FABRIC : MUL;
      logic squared;
      logic [Y_W-1:0] y;
      logic [Z_W-1:0] z_q;
      logic [A_W-1:0] a_q, a_late, y_q;
      logic [2*Z_W-1:0] square;
      assign squared = power_i > shade_pkg::LOBE_POWER_W'(i);
      if (i == 0) begin : g_first
        assign y = y_q10;
      end else begin : g_next
        assign y = {1'b0, g_power[i-1].y_q};
      end
      always_ff @(posedge clk_i) begin
        z_q <= low(y, squared);
        a_q <= minuend(y, squared);
        y_q <= less(a_late, square);
      end
      shade_delay #(.WIDTH(A_W), .DEPTH(SQUARE)) u_a (.clk_i, .d_i(a_q), .q_o(a_late));
      if (FABRIC) begin : g_fabric
        shade_square_fabric #(.WIDTH(Z_W)) u_square (.clk_i, .x_i(z_q), .y_o(square));
      end else begin : g_dsp
        logic [2*Z_W:0] product;
        shade_square #(.WIDTH(Z_W + 1)) u_square (.clk_i, .x_i({1'b0, z_q}), .y_o(product));
        assign square = product[2*Z_W-1:0];
        logic unused_top;
        assign unused_top = &{1'b0, product[2*Z_W]};
      end
    end
    always_ff @(posedge clk_i) lobe_o <= result(g_power[POWER-1].y_q);
    logic unused_phase;
    assign unused_phase = &{1'b0, phase_i};
  end else begin : g_folded
    // product r, 0: k2 (X - 1), 1: (s' - 1) X', then squares: operands are chosen in clock 3 + TURN r of a value, stand at
    // the multiplier a clock later, the product is there 3 clocks later, what follows from it 5 clocks later
    localparam int PRODUCTS = 2 + POWER;
    localparam int MULS = (PRODUCTS + FOLD - 1) / FOLD;
    localparam int TURNS = (PRODUCTS + MULS - 1) / MULS;  // of a multiplier
    localparam int TURN = FOLD == 5 ? 6 : 5;

    // is it clock c of a value, after product r?
    function automatic logic at(input int c, input int r);
      at = phase_i == shade_pkg::PHASE_W'((TAKE + c + TURN * r) % FOLD);
    endfunction

    logic [X_W-1:0] x_late;
    logic dark_late;
    assign take3 = at(2, 0);
    shade_hold #(.WIDTH(X_W + 1), .DEPTH(TURN), .FOLD(FOLD)) u_x (
      .clk_i, .load_i(take3), .d_i({dark_q3, x_q3}), .q_o({dark_late, x_late})
    );

    for (genvar m = 0; m < MULS; m++) begin : g_mul
      localparam int FIRST = m * TURNS;
      logic [W-1:0] a_q, b_q, next_q, next;  // operands; those of the next turn
      logic [A_W-1:0] minuend_q, minuend_next, with_q, with_late;
      logic signed [P_W-1:0] p;
      logic [Y_W-1:0] sum_q;
      logic squared;
      always_comb begin
        squared = 1'b0;
        for (int r = FIRST; r < FIRST + TURNS; r++) begin
          if (r > 0 && at(3 + MUL + 2, r)) squared = power_i > shade_pkg::LOBE_POWER_W'(r - 1);
        end
      end
      shade_mul #(.A_W(W), .B_W(W)) u_mul (.clk_i, .a_i(a_q), .b_i(b_q), .p_o(p));
      shade_delay #(.WIDTH(A_W), .DEPTH(MUL)) u_with (.clk_i, .d_i(with_q), .q_o(with_late));
      shade_delay #(.WIDTH(W + A_W), .DEPTH(TURN - MUL - 3)) u_next (
        .clk_i, .d_i({next_q, minuend_q}), .q_o({next, minuend_next})
      );
      always_ff @(posedge clk_i) minuend_q <= minuend(sum_q, squared);

      if (m == 0) begin : g_base
        logic [ROW_W+1:0] upper_q, lower_q;
        logic [D_W-1:0] beside_q, d_q;
        logic [LAST-1:0] x_q;
        logic last_q, last, dark_q, dark_d;
        shade_delay #(.WIDTH(1), .DEPTH(TURN - MUL - 2)) u_last (.clk_i, .d_i(last_q), .q_o(last));
        shade_delay #(.WIDTH(1), .DEPTH(MUL)) u_dark (.clk_i, .d_i(dark_q), .q_o(dark_d));
        always_ff @(posedge clk_i) begin
          a_q           <= at(3, 0) ? k2_i : next;
          b_q           <= at(3, 0) ? below(x_q3) : at(3, 1) ? {1'b0, x_late[LAST+:X1_W]} : next;
          with_q        <= minuend_next;
          {dark_q, x_q} <= {dark_late, x_late[LAST-1:0]};
          upper_q       <= rows(a_q, x_q[LAST-1-:2]);
          lower_q       <= rows(a_q, x_q[1:0]);
          beside_q      <= beside(b_q[X1_W-1:0], last);
          d_q           <= beside_q + D_W'({upper_q, 2'b00}) + D_W'(lower_q);

          if (at(3 + MUL + 1, 0)) sum_q <= Y_W'(slope(p));
          else if (at(3 + MUL + 1, 1)) sum_q <= base(p, d_q, dark_d);
          else sum_q <= {1'b0, less(with_late, p[2*Z_W-1:0])};
          if (at(3 + MUL + 2, 0)) {next_q, last_q} <= offset(sum_q[S_W-1:0]);
          else next_q <= {1'b0, low(sum_q, squared)};
        end
      end else begin : g_power
        always_ff @(posedge clk_i) begin
          a_q    <= at(3, FIRST) ? g_mul[m-1].next : next;
          b_q    <= at(3, FIRST) ? g_mul[m-1].next : next;
          with_q <= at(3, FIRST) ? g_mul[m-1].minuend_next : minuend_next;
          sum_q  <= {1'b0, less(with_late, p[2*Z_W-1:0])};
          next_q <= {1'b0, low(sum_q, squared)};
        end
        logic unused_top;
        assign unused_top = &{1'b0, p[P_W-1:2*Z_W]};
      end
    end
    always_ff @(posedge clk_i) lobe_o <= result(g_mul[MULS-1].sum_q[A_W-1:0]);
  end
endmodule
