// SPDX-License-Identifier: Apache-2.0
// shade_scale3: n = v s 2^GAIN, a vector times a number below 1 (GAIN = 0), or twice that (GAIN = 1).
//
//   v_i            sd.ffff               S1.16
//   s_i             0.ffff ff            U0.18
//   products       sd.ffff ffff ffff     34 fraction bits, exact
//   n_o            sd.ffff               S1.16, to nearest, ties up: error at most 1/2 ulp; |n| <= |v|: no overflow
//
// s has 18 bits without a sign, one more than a signed multiplier takes: v s = v (s - 1/2) + v/2.
// Three 18 x 18 multipliers. Latency LATENCY_SCALE3 = 3 clocks, a vector a clock.
// Example: v = (1, -1, 1/2), s = 1/2 -> n = (1/2, -1/2, 1/4).
module shade_scale3 #(
  parameter int GAIN = 0
) (
  input  logic                         clk_i,
  input  shade_pkg::vec_t              v_i,
  input  logic [shade_pkg::INVC_F-1:0] s_i,
  output shade_pkg::vec_t              n_o
);
  if (GAIN < 0 || GAIN > 1) begin : g_check
    $error("shade_scale3: GAIN must be 0 or 1");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int F = shade_pkg::INVC_F;

  // a component: product with s - 1/2 (2 clocks), sum with v/2; the half ulp of the rounding makes it (v + 1)/2
  logic [2:0][W-1:0] v, n_q;
  logic signed [F-1:0] offset;  // s - 1/2, S-1.18
  assign v      = v_i;
  assign n_o    = n_q;
  assign offset = s_i ^ (F'(1) << (F - 1));
  for (genvar c = 0; c < 3; c++) begin : g_component
    logic signed [W+F-1:0] product_q2;
    logic signed [W+F:0] sum;
    logic signed [W+GAIN:0] next_q1, next_q2;
    shade_mul #(.A_W(W), .B_W(F)) u_mul (.clk_i, .a_i(v[c]), .b_i(offset), .p_o(product_q2));
    assign sum = (W + F + 1)'(product_q2) + ((W + F + 1)'(next_q2) <<< (F - 1 - GAIN));
    always_ff @(posedge clk_i) begin
      next_q1 <= ((W + 1 + GAIN)'($signed(v[c])) <<< GAIN) + (W + 1 + GAIN)'(1);
      next_q2 <= next_q1;
      n_q[c]  <= W'(sum >>> (F - GAIN));
    end
  end
endmodule
