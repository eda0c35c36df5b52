// SPDX-License-Identifier: Apache-2.0
// shade_third: y = x / 3 by shifts and adds, in the format of x. |y| needs one bit less.
//
//   FORM_REFINED  x/3 = x/4 (1 + 1/4)(1 + 1/16)(1 + 1/256)(1 + 1/65536)...: the number of correct bits doubles with
//                 every adder. Three guard bits and one rounding give the integer nearest to x/3 for *every* x: the
//                 value before the rounding lacks less than 3.1/32 + 2^(WIDTH-34) < 1/6 ulp, and x/3 is never nearer
//                 than 1/6 ulp to the middle of two integers. (No ties exist.) Error below 1/3 ulp + 1e-3.
//   FORM_PAPER    x/3 ~ x/2 - x/8 - x/32 - x/128 = 43 x / 128 (P1, Fig. 7), its exact value rounded once to nearest,
//                 ties up; 0.78 % too large.
//
// Latency LATENCY_THIRD = 5 clocks, one value a clock; no overflow.
// Examples: x = 100 -> 33 (refined), 34 (paper: 33.59); x = -100 -> -33, -34. Source: P1, section IV.
module shade_third #(
  parameter int WIDTH = 26,
  parameter int FORM  = shade_pkg::FORM_REFINED
) (
  input  logic                    clk_i,
  input  logic signed [WIDTH-1:0] x_i,
  output logic signed [WIDTH-2:0] y_o
);
  if (WIDTH < 4 || WIDTH > 28) begin : g_check
    $error("shade_third: WIDTH must be in 4 .. 28");
  end
  if (FORM != shade_pkg::FORM_PAPER && FORM != shade_pkg::FORM_REFINED) begin : g_check_form
    $error("shade_third: FORM must be FORM_PAPER or FORM_REFINED");
  end

  localparam bit REFINED = FORM == shade_pkg::FORM_REFINED;
  // x        sddd dddd
  // refined  sddd dddd dggg   4/3 of x with three guard bits: four bits more
  // paper    sddd dddd ffff ff   43 x: six bits more
  localparam int GUARD = 3;
  localparam int SUM_W = REFINED ? WIDTH + GUARD + 1 : WIDTH + 6;
  localparam int DROP = REFINED ? GUARD + 2 : 7;
  // a narrow sum has fewer bits than the shift is long: all that is left of it is its sign
  localparam int BY_8 = SUM_W > 8 ? 8 : SUM_W - 1;
  localparam int BY_16 = SUM_W > 16 ? 16 : SUM_W - 1;

  logic signed [SUM_W-1:0] x, sum_q1, sum_q2, sum_q3, sum_q4;
  assign x = SUM_W'(x_i);

  if (REFINED) begin : g_refined
    always_ff @(posedge clk_i) begin
      sum_q1 <= (x <<< GUARD) + (x <<< (GUARD - 2));
      sum_q2 <= sum_q1 + (sum_q1 >>> 4);
      sum_q3 <= sum_q2 + (sum_q2 >>> BY_8);
      sum_q4 <= sum_q3 + (sum_q3 >>> BY_16);
    end
  end else begin : g_paper
    logic signed [WIDTH-1:0] x_q1, x_q2;
    always_ff @(posedge clk_i) begin
      x_q1   <= x_i;
      x_q2   <= x_q1;
      sum_q1 <= (x <<< 6) - (x <<< 4);
      sum_q2 <= sum_q1 - (SUM_W'(x_q1) <<< 2);
      sum_q3 <= sum_q2 - SUM_W'(x_q2);
      sum_q4 <= sum_q3;
    end
  end

  // |x/3| and |43 x/128| are at most 0.34 2^(WIDTH-1): WIDTH - 1 bits hold them, rounded or not
  logic signed [WIDTH-2:0] rounded;
  shade_round #(.WIDTH(SUM_W), .DROP(DROP), .OUT_W(WIDTH - 1)) u_round (.x_i(sum_q4), .y_o(rounded));
  always_ff @(posedge clk_i) y_o <= rounded;
endmodule
