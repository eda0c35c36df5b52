// SPDX-License-Identifier: Apache-2.0
// shade_horner_step: one step of Horner's scheme, y = round(s t) + c.
//
//   s_i, c_i, y_o  WIDTH bits, signed, all with the same weight of the last bit
//   t_i            U1.T_F in [0, 1]: T_F + 1 bits
//
// The product is rounded to the format of s, to nearest, ties up. The rounding costs nothing: half an ulp stands below
// the last bit of c in the same addition.
//
//   s t       ssss ssss ssss.pppp pppp      WIDTH + T_F + 2 bits
//   c         cccc cccc cccc.1000 0000
//
// t <= 1 keeps |round(s t)| <= |s|; WIDTH must hold |s| + |c|. c_i is taken LATENCY_MUL = 2 clocks after s_i and t_i.
// Latency LATENCY_HORNER_STEP = 3 clocks, one step a clock. Error at most 1/2 ulp.
// Example (T_F = 4): s = 5, t = 8 (1/2), c = 10 -> 13 (2.5 rounds to 3). Source: P1, section IV.
module shade_horner_step #(
  parameter int WIDTH = shade_pkg::VALUE_W + shade_pkg::HORNER_GUARD,
  parameter int T_F   = shade_pkg::T_F
) (
  input  logic                    clk_i,
  input  logic signed [WIDTH-1:0] s_i,
  input  logic        [    T_F:0] t_i,
  input  logic signed [WIDTH-1:0] c_i,
  output logic signed [WIDTH-1:0] y_o
);
  if (WIDTH < 2 || WIDTH > 35 || T_F < 2 || T_F > 16) begin : g_check
    $error("shade_horner_step: WIDTH must be in 2 .. 35 and T_F in 2 .. 16");
  end

  localparam int PRODUCT_W = WIDTH + T_F + 2;
  logic signed [PRODUCT_W-1:0] product_q2, sum;

  shade_mul #(.A_W(WIDTH), .B_W(T_F + 2)) u_mul (.clk_i, .a_i(s_i), .b_i({1'b0, t_i}), .p_o(product_q2));

  assign sum = product_q2 + PRODUCT_W'($signed({c_i, 1'b1, {(T_F - 1){1'b0}}}));
  always_ff @(posedge clk_i) y_o <= WIDTH'(sum >>> T_F);
endmodule
