// SPDX-License-Identifier: Apache-2.0
// yardstick_coef: the coefficients of shade_coef (node set left, refined formulas, degree 3, 2, 1 or 0) written as in a
// program, with `*` and `/ 3`, in one step between two registers. The area and clock rate of shade_coef are measured
// against it.
//
//   i1_i .. i4_i, d_o  S1.16     a_o, b_o, c_o  S8.16, the quotient cut towards zero
module yardstick_coef (
  input  logic               clk_i,
  input  logic        [ 1:0] degree_i,
  input  logic signed [17:0] i1_i,
  input  logic signed [17:0] i2_i,
  input  logic signed [17:0] i3_i,
  input  logic signed [17:0] i4_i,
  output logic signed [24:0] a_o,
  output logic signed [24:0] b_o,
  output logic signed [24:0] c_o,
  output logic signed [17:0] d_o
);
  logic [1:0] degree;
  // |8 (8 I2 + I4 - 3 I1 - 6 I3)| <= 144 max|I|: 26 bits before the division
  logic signed [25:0] i1, i2, i3, i4, a, b, c;

  always_ff @(posedge clk_i) begin
    degree <= degree_i;
    i1     <= 26'(i1_i);
    i2     <= 26'(i2_i);
    i3     <= 26'(i3_i);
    i4     <= 26'(i4_i);
  end

  always_comb begin
    a = '0;
    b = '0;
    c = '0;
    case (degree)
      2'd3: begin
        a = 26'sd8 * (26'sd8 * i2 + i4 - 26'sd3 * i1 - 26'sd6 * i3) / 26'sd3;
        b = 26'sd2 * (26'sd7 * i1 - 26'sd16 * i2 + 26'sd10 * i3 - i4);
        c = (26'sd32 * i2 + i4 - 26'sd21 * i1 - 26'sd12 * i3) / 26'sd3;
      end
      2'd2: begin
        b = 26'sd2 * (i1 - 26'sd2 * i2 + i3);
        c = 26'sd4 * i2 - 26'sd3 * i1 - i3;
      end
      2'd1: c = i2 - i1;
      default: ;
    endcase
  end

  always_ff @(posedge clk_i) begin
    a_o <= a[24:0];
    b_o <= b[24:0];
    c_o <= c[24:0];
    d_o <= i1[17:0];
  end
endmodule
