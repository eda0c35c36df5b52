// SPDX-License-Identifier: Apache-2.0
// shade_reflect: R = 2 (N.L) N - L, the direction in which a mirror with normal N sends light that comes from L.
//
//   n_i, l_i       sd.ffff             S1.16
//   N.L         sdddd.ffff f           S4.17, the exact sum rounded once
//   m              sd.ffff             -2 N.L, saturated to S1.16: exactly -2 where N = L
//   R           sdddd.ffff ffff        -(m N) - L
//   r_o            sd.ffff             S1.16, to nearest, ties up, saturated
//
// For |N| <= 1 error at most 1 ulp of the formula with N.L limited to [-1, 1] (m: 1/2 ulp times N, and 1/2).
// Six 18 x 18 multipliers. Latency LATENCY_REFLECT = 10 clocks, one vector a clock. Source: P1, R of Phong's R.V.
// Example: N = (0, 0, 1), L = (0.6, 0, 0.8) -> R = (-0.6, 0, 0.8).
module shade_reflect (
  input  logic            clk_i,
  input  shade_pkg::vec_t n_i,
  input  shade_pkg::vec_t l_i,
  output shade_pkg::vec_t r_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int F = shade_pkg::INTENSITY_F;
  localparam int DOT_W = shade_pkg::DOT_W + 1;

  logic signed [DOT_W-1:0] d_q4, d_q5;
  logic signed [W-1:0] m, m_q6;
  shade_dot3 #(.OUT_F(F + 1)) u_dot (.clk_i, .a_i(n_i), .b_i(l_i), .d_o(d_q4));
  shade_limit #(.WIDTH(DOT_W), .OUT_W(W)) u_m (.x_i(d_q5), .y_o(m));
  always_ff @(posedge clk_i) begin
    d_q5 <= -d_q4;
    m_q6 <= m;
  end

  logic [2:0][W-1:0] n_q6, l_q6, r_q10;
  shade_delay #(.WIDTH($bits(n_i) + $bits(l_i)), .DEPTH(shade_pkg::LATENCY_DOT3 + 2)) u_wait (
    .clk_i, .d_i({n_i, l_i}), .q_o({n_q6, l_q6})
  );
  for (genvar c = 0; c < 3; c++) begin : g_component
    localparam int P_W = 2 * W;
    localparam int R_W = P_W + 1 - F;
    logic signed [P_W-1:0] product_q8;
    logic signed [P_W:0] offset_q7, offset_q8, difference;  // half an ulp less L
    logic signed [R_W-1:0] r_q9;
    logic signed [W-1:0] limited;
    shade_mul #(.A_W(W), .B_W(W)) u_mul (.clk_i, .a_i(m_q6), .b_i(n_q6[c]), .p_o(product_q8));
    shade_limit #(.WIDTH(R_W), .OUT_W(W)) u_limit (.x_i(r_q9), .y_o(limited));
    assign difference = offset_q8 - (P_W + 1)'(product_q8);
    always_ff @(posedge clk_i) begin
      offset_q7 <= ((P_W + 1)'(1) <<< (F - 1)) - ((P_W + 1)'($signed(l_q6[c])) <<< F);
      offset_q8 <= offset_q7;
      r_q9      <= R_W'(difference >>> F);
      r_q10[c]  <= limited;
    end
  end
  assign r_o = r_q10;
endmodule
