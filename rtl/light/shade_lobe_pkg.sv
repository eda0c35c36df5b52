// SPDX-License-Identifier: Apache-2.0
// shade_lobe_pkg: the steps of shade_lobe, which it does one behind the other and shade_lobe_folded in turns.
//
// Combinational. X is the scaled x, U1.20, X' its first 16 fraction bits, s = k1 - k2 X, y = s X. See shade_lobe.
// Example: the lobe of y = 1/4 after one squaring: minuend 1/2, z = 1/4, 1/2 - 1/16 = 7/16.
package shade_lobe_pkg;
  // Yosys' own reader finds no package in another one: shade_lobe checks that these are the constants of shade_pkg.
  localparam int X_F = 20;  // LOBE_SCALED_F
  localparam int FIRST_F = 16;  // LOBE_X_F
  localparam int SLOPE_F = 17;
  localparam int K1_W = 21;
  localparam int K2_F = 17;
  localparam int S_F = 18;
  localparam int ROW_W = 8;  // LOBE_ROW_F + 1
  localparam int BIT_W = 5;  // LOBE_BIT_F + 1
  localparam int Y_F = 22;  // LOBE_F
  localparam int Z_F = 18;
  localparam int FINE_F = 2;
  localparam int OUT_F = 16;  // INTENSITY_F

  localparam int W = 18;  // operands of a multiplier
  localparam int P_W = 2 * W;
  localparam int X_W = X_F + 1;
  localparam int FIRST_W = FIRST_F + 1;  // X'
  localparam int K_F = K1_W;  // k1 - k2 and half an ulp of s
  localparam int K_W = K_F + 3;
  localparam int MIDDLE_W = K_F - K2_F;
  localparam int SUM_F = K2_F + SLOPE_F;  // s before its rounding
  localparam int SUM_W = SUM_F + 3;
  localparam int S_W = S_F + 3;  // s in (-2, 4)
  localparam int D_F = X_F + ROW_W - 1;  // what is added to s' X'
  localparam int D_W = D_F + 2;
  localparam int BASE_F = S_F - 1 + FIRST_F;  // y before its rounding
  localparam int Y_W = Y_F + 2;  // s X < 4
  localparam int A_W = Y_F + 1;
  localparam int Z_W = Z_F - 1;
  localparam int DROP = 2 * Z_F - Y_F;  // of z^2
  localparam int OUT_W = OUT_F + 1;
  localparam int OUT_DROP = Y_F - OUT_F;  // of 1 - y

  // ---- s -------------------------------------------------------------------------------------------------------
  // A signed multiplier takes X - 1: s = k1 - k2 - k2 (X - 1); the middle of what is cut of X, 2^-18, belongs to k2.
  function automatic logic [W-1:0] below(input logic [X_W-1:0] x);
    below = {!x[X_W-1], x[X_W-2:X_F-SLOPE_F]};
  endfunction

  // k1 with half an ulp of s and of the middle
  function automatic logic signed [K_W-1:0] raised(input logic [K1_W-1:0] k1);
    raised = $signed({2'b00, k1, 1'b0}) + K_W'((1 << (K_F - S_F - 1)) + (1 << (MIDDLE_W - 1)));
  endfunction

  // k2 and its middle, which stand side by side but for the sign: 8 for every 16
  function automatic logic signed [K_W-1:0] doubled(input logic signed [K2_F:0] k2);
    doubled = K_W'($signed({k2, !k2[K2_F], k2[K2_F-1:K2_F-MIDDLE_W+1]}));
  endfunction

  function automatic logic [S_W-1:0] slope(input logic signed [K_W-1:0] k, input logic signed [P_W-1:0] p);
    logic signed [SUM_W-1:0] sum;
    sum   = (SUM_W'(k) <<< (SUM_F - K_F)) - SUM_W'(p);
    slope = S_W'(sum >>> (SUM_F - S_F));
  endfunction

  // s - 1, which a signed multiplier takes, of s limited to [0, 2), above the last bit of s
  function automatic logic [W:0] offset(input logic [S_W-1:0] s);
    logic negative, above;
    negative = s[S_W-1];
    above    = s[S_W-2];
    offset   = {negative || !(above || s[S_F]), s[S_F-1:0] & {S_F{!negative}} | {S_F{above && !negative}}};
  endfunction

  // ---- y -------------------------------------------------------------------------------------------------------
  // two of the four rows of s times the last bits of X: 8 bits of s each
  function automatic logic [ROW_W+1:0] rows(input logic [W-1:0] t, input logic [1:0] x);
    logic [ROW_W-1:0] s;
    s    = {!t[W-1], t[W-2:W-ROW_W]};
    rows = (ROW_W + 2)'(s & {ROW_W{x[0]}}) + {1'b0, s & {ROW_W{x[1]}}, 1'b0};
  endfunction

  // X', the last bit of s times X', and half an ulp of y, side by side
  function automatic logic [D_W-1:0] beside(input logic [FIRST_W-1:0] x, input logic odd);
    beside = {1'b0, x, 1'b0, x[FIRST_W-1:FIRST_W-BIT_W] & {BIT_W{odd}}, 1'b1, {(D_F - Y_F - 1) {1'b0}}};
  endfunction

  // y = p + d for p = (s' - 1) X' and d all the rest; a dark one is 1
  function automatic logic [Y_W-1:0] base(
    input logic signed [P_W-1:0] p, input logic [D_W-1:0] d, input logic dark, input logic fine
  );
    logic signed [P_W:0] sum;
    logic [Y_W-1:0] y;
    sum  = (P_W + 1)'(p) + $signed((P_W + 1)'({d, {(BASE_F - D_F) {1'b0}}}));
    y    = Y_W'(sum >>> (BASE_F - Y_F));
    base = dark ? Y_W'(1) << Y_F : fine ? y >> FINE_F : y;
  endfunction

  // ---- squarings -----------------------------------------------------------------------------------------------
  // z, and what z^2 is taken from: 2 y or 1; without squaring z is its last bit, too small to count, and y stays
  function automatic logic [Z_W-1:0] low(input logic [Y_W-1:0] y, input logic squared);
    logic one, high;
    one  = |y[Y_W-1:Y_F];
    high = one || y[Y_F-1];
    low  = {(y[Y_F-2:Y_F-Z_W] ^ {(Z_W - 1) {high}}) & {(Z_W - 1) {squared && !one}}, 1'b1};
  endfunction

  function automatic logic [A_W-1:0] minuend(input logic [Y_W-1:0] y, input logic squared);
    logic one;
    one     = |y[Y_W-1:Y_F] || (squared && y[Y_F-1]);
    minuend = {one, (squared ? {y[Y_F-2:0], 1'b0} : y[Y_F-1:0]) & {Y_F{!one}}};
  endfunction

  // a - z^2, to nearest; z^2 is odd, so that there are no ties and its first dropped bit does it
  function automatic logic [A_W-1:0] less(input logic [A_W-1:0] a, input logic [2*Z_W-1:0] q);
    logic [A_W:0] difference;
    difference = {a, 1'b0} - (A_W + 1)'(q >> (DROP - 1));
    less       = A_W'(difference >> 1);
  endfunction

  // 1 - y, to nearest
  function automatic logic [OUT_W-1:0] result(input logic [A_W-1:0] y);
    logic [A_W-1:0] difference;
    difference = (A_W'(1) << Y_F) + (A_W'(1) << (OUT_DROP - 1)) - y;
    result     = OUT_W'(difference >> OUT_DROP);
  endfunction
endpackage
