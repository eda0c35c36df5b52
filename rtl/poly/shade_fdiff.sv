// SPDX-License-Identifier: Apache-2.0
// shade_fdiff: I(j h) = A t^3 + B t^2 + C t + D for j = 0, 1, 2, ... by forward differences, h = 2^-k: three additions a
// pixel and no multiplication at all.
//
//   d1 = A h^3 + B h^2 + C h,  d2 = 6 A h^3 + 2 B h^2,  d3 = 6 A h^3;   per pixel  I += d1, d1 += d2, d2 += d3
//
//   a_i, b_i, c_i  sdddddddd.ffff     COEF_W bits, S8.16     taken with first_i; then free until the next first_i
//   d_i                   sd.ffff     D_W bits, S1.16
//   log2_i         k, 0 .. LOG2_MAX
//   inside       sdddddddddd.ffff ... ffff    3 LOG2_MAX more fraction bits: every term is a whole number of them
//   y_o          sdddddddddd.ffff     COEF_W + 2 bits, S10.16, unclamped
//
// Nothing is rounded before y_o, so that no error accumulates: y_o is the value nearest to the exact polynomial (ties
// up), error at most 1/2 ulp, at every pixel of the longest segment, t = 0 .. 1. Differences may leave the range (h = 1,
// or behind the end of the segment); sums are exact modulo 2^STATE_W, and I(t) itself is in range: |I| < 2^10.
//
// valid_i makes one pixel; first_i with it starts a segment. The start is a pipeline of its own, so that segments follow
// each other without a bubble, however short. Latency LATENCY_FDIFF = 6 clocks, one pixel a clock, no multiplier.
// Example: A = B = 0, C = 1, D = 1/4, k = 2 -> I = 0.25, 0.5, 0.75, 1, 1.25. Source: P1, section IV; forward differences.
module shade_fdiff #(
  parameter int COEF_W   = shade_pkg::COEF_W,
  parameter int D_W      = shade_pkg::INTENSITY_W,
  parameter int LOG2_MAX = shade_pkg::LOG2_MAX
) (
  input  logic                                             clk_i,
  input  logic                                             rst_i,
  input  logic                                             valid_i,
  input  logic                                             first_i,
  input  logic signed [                        COEF_W-1:0] a_i,
  input  logic signed [                        COEF_W-1:0] b_i,
  input  logic signed [                        COEF_W-1:0] c_i,
  input  logic signed [                           D_W-1:0] d_i,
  input  logic        [                               3:0] log2_i,
  output logic signed [COEF_W+shade_pkg::VALUE_GROWTH-1:0] y_o
);
  if (COEF_W < 2 || D_W < 2 || D_W > COEF_W || LOG2_MAX < 1 || LOG2_MAX > 12) begin : g_check
    $error("shade_fdiff: COEF_W and D_W must be at least 2, D_W at most COEF_W, LOG2_MAX in 1 .. 12");
  end

  localparam int VALUE_W = COEF_W + shade_pkg::VALUE_GROWTH;
  localparam int FRACTION = 3 * LOG2_MAX;
  // at least one bit more than the longest shift below; what stands above VALUE_W + FRACTION counts for nothing
  localparam int STATE_W = VALUE_W + FRACTION < 37 ? 37 : VALUE_W + FRACTION;

  // Start of a segment. In units of 2^-FRACTION ulp, with e = LOG2_MAX - k:
  //   A h^3 = A 2^(3 e),  B h^2 = B 2^(2 e + LOG2_MAX),  C h = C 2^(e + 2 LOG2_MAX)
  // e = 4 coarse + fine: stage 1 shifts by fine, stage 2 by coarse.
  logic [1:0] coarse, fine, coarse_q1;
  logic signed [STATE_W-1:0] a, b, c, a_q1, b_q1, c_q1, a_q2, b_q2, c_q2;
  logic signed [STATE_W-1:0] six_a_q3, ab_q3, b_q3, c_q3, d1_q4, d2_q4, d3_q4, i_q4;
  assign {coarse, fine} = 4'(LOG2_MAX) - log2_i;
  assign a = STATE_W'(a_i);
  assign b = STATE_W'(b_i);
  assign c = STATE_W'(c_i);

  always_ff @(posedge clk_i) begin
    coarse_q1 <= coarse;
    case (fine)
      2'd0: begin a_q1 <= a;        b_q1 <= b;        c_q1 <= c;        end
      2'd1: begin a_q1 <= a <<< 3;  b_q1 <= b <<< 2;  c_q1 <= c <<< 1;  end
      2'd2: begin a_q1 <= a <<< 6;  b_q1 <= b <<< 4;  c_q1 <= c <<< 2;  end
      2'd3: begin a_q1 <= a <<< 9;  b_q1 <= b <<< 6;  c_q1 <= c <<< 3;  end
    endcase

    case (coarse_q1)
      2'd0: begin a_q2 <= a_q1;        b_q2 <= b_q1;        c_q2 <= c_q1;        end
      2'd1: begin a_q2 <= a_q1 <<< 12; b_q2 <= b_q1 <<< 8;  c_q2 <= c_q1 <<< 4;  end
      2'd2: begin a_q2 <= a_q1 <<< 24; b_q2 <= b_q1 <<< 16; c_q2 <= c_q1 <<< 8;  end
      2'd3: begin a_q2 <= a_q1 <<< 36; b_q2 <= b_q1 <<< 24; c_q2 <= c_q1 <<< 12; end
    endcase

    six_a_q3 <= (a_q2 <<< 2) + (a_q2 <<< 1);
    ab_q3    <= a_q2 + (b_q2 <<< LOG2_MAX);
    b_q3     <= b_q2;
    c_q3     <= c_q2;

    d1_q4    <= ab_q3 + (c_q3 <<< (LOG2_MAX + LOG2_MAX));
    d2_q4    <= six_a_q3 + (b_q3 <<< (LOG2_MAX + 1));
    d3_q4    <= six_a_q3;
  end

  logic signed [D_W-1:0] d_q4;
  logic first_q4, valid_q4;
  shade_delay #(.WIDTH(D_W + 1), .DEPTH(4)) u_first (.clk_i, .d_i({first_i, d_i}), .q_o({first_q4, d_q4}));
  shade_valid #(.DEPTH(4)) u_valid4 (.clk_i, .rst_i, .valid_i, .valid_o(valid_q4));
  assign i_q4 = STATE_W'(d_q4) <<< FRACTION;

  // The state is the pixel at hand: three additions lead to the next one.
  logic signed [STATE_W-1:0] i_q5, d1_q5, d2_q5, d3_q5;
  always_ff @(posedge clk_i) begin
    if (valid_q4) begin
      i_q5  <= first_q4 ? i_q4 : i_q5 + d1_q5;
      d1_q5 <= first_q4 ? d1_q4 : d1_q5 + d2_q5;
      d2_q5 <= first_q4 ? d2_q4 : d2_q5 + d3_q5;
      if (first_q4) d3_q5 <= d3_q4;
    end
  end

  // |I| < 2^10: rounding cannot carry out of VALUE_W bits
  logic signed [VALUE_W-1:0] rounded;
  shade_round #(.WIDTH(STATE_W), .DROP(FRACTION), .OUT_W(VALUE_W)) u_round (.x_i(i_q5), .y_o(rounded));
  always_ff @(posedge clk_i) y_o <= rounded;
endmodule
