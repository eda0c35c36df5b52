// SPDX-License-Identifier: Apache-2.0
// shade_dot3: d = a . b, the dot product of two vectors; of unit vectors, the cosine of their angle.
//
//   a_i, b_i            sd.ffff        S1.16
//   products         sdddd.ffff ffff   S3.32 each, exact
//   d_o              sdddd.ffff        S4.OUT_F: |d| <= 3 * 2 * 2 = 12 < 16, overflow is impossible
//
// Rounded once, to nearest, ties up: error at most 1/2 ulp. Three 18 x 18 multipliers.
// Latency LATENCY_DOT3 = 4 clocks, one dot product a clock.
// Example: a = (0.6, 0, 0.8), b = (0, 0, 1) -> d = 0.8.
module shade_dot3 #(
  parameter int OUT_F = shade_pkg::INTENSITY_F
) (
  input  logic                                                            clk_i,
  input  shade_pkg::vec_t                                                 a_i,
  input  shade_pkg::vec_t                                                 b_i,
  output logic signed [shade_pkg::DOT_W-shade_pkg::INTENSITY_F+OUT_F-1:0] d_o
);
  if (OUT_F < 1 || OUT_F >= 2 * shade_pkg::INTENSITY_F) begin : g_check
    $error("shade_dot3: OUT_F must be in 1 .. 31");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int F = shade_pkg::INTENSITY_F;
  localparam int OUT_W = shade_pkg::DOT_W - F + OUT_F;
  localparam int SUM_W = shade_pkg::DOT_W + F;
  localparam int DROP = 2 * F - OUT_F;

  logic signed [2*W-1:0] x_q2, y_q2, z_q2;
  shade_mul #(.A_W(W), .B_W(W)) u_x (.clk_i, .a_i(a_i.x), .b_i(b_i.x), .p_o(x_q2));
  shade_mul #(.A_W(W), .B_W(W)) u_y (.clk_i, .a_i(a_i.y), .b_i(b_i.y), .p_o(y_q2));
  shade_mul #(.A_W(W), .B_W(W)) u_z (.clk_i, .a_i(a_i.z), .b_i(b_i.z), .p_o(z_q2));

  localparam logic signed [SUM_W-1:0] HALF = SUM_W'(1) <<< (DROP - 1);
  logic signed [SUM_W-1:0] xy_q3, z_q3, sum;
  always_ff @(posedge clk_i) begin
    xy_q3 <= SUM_W'(x_q2) + SUM_W'(y_q2);
    z_q3  <= SUM_W'(z_q2) + HALF;
    d_o   <= OUT_W'(sum >>> DROP);
  end
  assign sum = xy_q3 + z_q3;
endmodule
