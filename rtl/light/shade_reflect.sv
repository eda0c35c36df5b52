// SPDX-License-Identifier: Apache-2.0
// shade_reflect: R = 2 (N.L) N - L, the direction in which a mirror with normal N sends light that comes from L.
//
//   nx_i .. lz_i   sd.ffff             S1.16
//   N.L         sdddd.ffff f           S4.17, the exact sum rounded once
//   m              sd.ffff             -2 N.L, saturated to S1.16: exactly -2 where N = L
//   R           sdddd.ffff ffff        -(m N) - L
//   x_o .. z_o     sd.ffff             S1.16, to nearest, ties up, saturated
//
// For |N| <= 1 error at most 1 ulp of the formula with N.L limited to [-1, 1] (m: 1/2 ulp times N, and 1/2).
// Six 18 x 18 multipliers. Latency LATENCY_REFLECT = 10 clocks, one vector a clock. Source: P1, R of Phong's R.V.
// Example: N = (0, 0, 1), L = (0.6, 0, 0.8) -> R = (-0.6, 0, 0.8).
module shade_reflect (
  input  logic                                     clk_i,
  input  logic                                     rst_i,
  input  logic                                     valid_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] nx_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] ny_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] nz_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] lx_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] ly_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] lz_i,
  output logic                                     valid_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] x_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] y_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] z_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int F = shade_pkg::INTENSITY_F;
  localparam int DOT_W = shade_pkg::DOT_W + 1;
  localparam int TO_M = shade_pkg::LATENCY_DOT3 + 2;

  logic signed [DOT_W-1:0] d_q4, d_q5;
  logic signed [W-1:0] m, m_q6;
  shade_dot3 #(.OUT_F(F + 1)) u_dot (
    .clk_i, .a_i({nz_i, ny_i, nx_i}), .b_i({lz_i, ly_i, lx_i}), .d_o(d_q4)
  );
  shade_limit #(.WIDTH(DOT_W), .OUT_W(W)) u_m (.x_i(d_q5), .y_o(m));
  always_ff @(posedge clk_i) begin
    d_q5 <= -d_q4;
    m_q6 <= m;
  end

  logic [3*W-1:0] n_q6, l_q6, r;
  shade_delay #(.WIDTH(6 * W), .DEPTH(TO_M)) u_wait (
    .clk_i, .d_i({nz_i, ny_i, nx_i, lz_i, ly_i, lx_i}), .q_o({n_q6, l_q6})
  );
  for (genvar c = 0; c < 3; c++) begin : g_component
    localparam int P_W = 2 * W;
    localparam int R_W = P_W + 1 - F;
    logic signed [P_W-1:0] product_q8;
    logic signed [P_W:0] offset_q7, offset_q8, difference;  // half an ulp less L
    logic signed [R_W-1:0] r_q9;
    logic signed [W-1:0] limited, r_q10;
    shade_mul #(.A_W(W), .B_W(W)) u_mul (.clk_i, .a_i(m_q6), .b_i(n_q6[c*W+:W]), .p_o(product_q8));
    shade_limit #(.WIDTH(R_W), .OUT_W(W)) u_limit (.x_i(r_q9), .y_o(limited));
    assign difference = offset_q8 - (P_W + 1)'(product_q8);
    always_ff @(posedge clk_i) begin
      offset_q7 <= ((P_W + 1)'(1) <<< (F - 1)) - ((P_W + 1)'($signed(l_q6[c*W+:W])) <<< F);
      offset_q8 <= offset_q7;
      r_q9      <= R_W'(difference >>> F);
      r_q10     <= limited;
    end
    assign r[c*W+:W] = r_q10;
  end
  assign {z_o, y_o, x_o} = r;

  shade_valid #(.DEPTH(shade_pkg::LATENCY_REFLECT)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);
endmodule
