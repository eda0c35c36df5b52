// SPDX-License-Identifier: Apache-2.0
// shade_weigh: w = K0 + KX x + KY y + KZ z with constants of 16 fraction bits, by shifts and adds, rounded once.
//
//   x_i, y_i, z_i  sddd.ffff          WIDTH bits, F of them below the point
//   inside       sddddd.ffff ffff     F + 16 fraction bits, nothing is cut
//   w_o             sdd.ff            OUT_W bits, OUT_F of them below the point, to nearest, ties up
//
// Every constant is taken in non-adjacent form: digits 1 and -1, no two of them side by side, so a third of its bits as a
// rule. Each digit is a shifted input; a digit -1 is the inverted input (-x = ~x + 1), whose 1 joins K0 and the half ulp
// of the rounding. All of them, at most 16, are added in a tree of four levels.
// OUT_W must hold the result; the adders count modulo 2^OUT_W, so that no inner sum can overflow. |KX|, |KY|, |KZ| < 2^19.
// Error at most 1/2 ulp. Latency LATENCY_WEIGH = 4 clocks, one result a clock.
// Example (F = 18, OUT_F = 16): K0 = 3/4, KX = 1/4, KY = KZ = 0, x = 1/2 -> w = 7/8.
module shade_weigh #(
  parameter int WIDTH = 20,
  parameter int F     = shade_pkg::SQUARE_F,
  parameter int OUT_W = shade_pkg::INTENSITY_W,
  parameter int OUT_F = shade_pkg::INTENSITY_F,
  parameter int K0    = shade_pkg::INVC_0,
  parameter int KX    = shade_pkg::INVC_C,
  parameter int KY    = shade_pkg::INVC_UU,
  parameter int KZ    = 0
) (
  input  logic                    clk_i,
  input  logic signed [WIDTH-1:0] x_i,
  input  logic signed [WIDTH-1:0] y_i,
  input  logic signed [WIDTH-1:0] z_i,
  output logic signed [OUT_W-1:0] w_o
);
  localparam int DROP = F + shade_pkg::CONSTANT_F - OUT_F;
  localparam int SUM_W = OUT_W + DROP;
  localparam int LEAVES = 1 << shade_pkg::LATENCY_WEIGH;
  localparam int DIGITS = 20;  // of a constant

  // the digits of k that are 1 (minus = 0) or -1 (minus = 1)
  function automatic logic [DIGITS-1:0] digits(input int k, input bit minus);
    int size, half;
    size = k < 0 ? -k : k;
    half = size >>> 1;
    digits = DIGITS'(minus == (k < 0) ? (size + half) & ~half : half & ~(size + half));
  endfunction
  localparam logic [3*DIGITS-1:0] MINUS = {digits(KZ, 1'b1), digits(KY, 1'b1), digits(KX, 1'b1)};
  localparam logic [3*DIGITS-1:0] ANY = {digits(KZ, 1'b0), digits(KY, 1'b0), digits(KX, 1'b0)} | MINUS;

  function automatic bit wide(input int k);
    wide = k >= (1 << (DIGITS - 1)) || k <= -(1 << (DIGITS - 1));
  endfunction

  // where the digit of a leaf stands in ANY; 3 DIGITS: there are not so many
  function automatic int digit_of(input int leaf);
    int left;
    left = leaf;
    digit_of = 3 * DIGITS;
    for (int d = 3 * DIGITS - 1; d >= 0; d--) begin
      if (ANY[d]) left = left - 1;
      if (ANY[d] && left == 0) digit_of = d;
    end
  endfunction

  if (WIDTH < 2 || F < 1 || OUT_W < 2 || DROP < 1 || digit_of(LEAVES) != 3 * DIGITS) begin : g_check
    $error("shade_weigh: WIDTH and OUT_W from 2, F from 1, OUT_F below F + 16; at most 15 digits in KX, KY and KZ");
  end
  if (wide(KX) || wide(KY) || wide(KZ)) begin : g_check_weights
    $error("shade_weigh: KX, KY and KZ must be above -2^19 and below 2^19");
  end

  // leaf 0: K0, the half ulp, and 1 for every inverted input, at the weight of its digit
  localparam logic [SUM_W-1:0] CONSTANT = (SUM_W'(K0) << F) + (SUM_W'(1) << (DROP - 1))
      + SUM_W'(DIGITS'(MINUS)) + SUM_W'(DIGITS'(MINUS >> DIGITS)) + SUM_W'(DIGITS'(MINUS >> 2 * DIGITS));

  logic [LEAVES-1:0][SUM_W-1:0] leaf;
  assign leaf[0] = CONSTANT;
  for (genvar n = 1; n < LEAVES; n++) begin : g_leaf
    localparam int DIGIT = digit_of(n);
    if (DIGIT < 3 * DIGITS) begin : g_digit
      logic signed [WIDTH-1:0] value, operand;
      assign value   = DIGIT < DIGITS ? x_i : DIGIT < 2 * DIGITS ? y_i : z_i;
      assign operand = MINUS[DIGIT] ? ~value : value;
      assign leaf[n] = SUM_W'(operand) << (DIGIT % DIGITS);
    end else begin : g_none
      assign leaf[n] = '0;
    end
  end

  // node n adds its children 2 n and 2 n + 1; node 1 is the root
  logic [LEAVES-1:1][SUM_W-1:0] sum_q;
  for (genvar n = 1; n < LEAVES; n++) begin : g_node
    logic [SUM_W-1:0] a, b;
    if (n < LEAVES / 2) begin : g_inner
      assign a = sum_q[2*n];
      assign b = sum_q[2*n+1];
    end else begin : g_outer
      assign a = leaf[2*n-LEAVES];
      assign b = leaf[2*n-LEAVES+1];
    end
    always_ff @(posedge clk_i) sum_q[n] <= a + b;
  end
  assign w_o = OUT_W'(sum_q[1] >> DROP);
  logic unused_fraction;
  assign unused_fraction = &{1'b0, sum_q[1]};
endmodule
