// SPDX-License-Identifier: Apache-2.0
// shade_dot_scaled: 2 (a . b) / 2^shift, a dot product of two vectors divided by a power of two.
//
//   a_i, b_i      S1.16, with shift_i 0 .. 31
//   product_*_o   a_x b_x, a_y b_y, a_z b_z, S3.32, exact, LATENCY_MUL clocks behind them
//   d_o           S1.36, modulo 4; what is shifted out is cut: error below 1 ulp
//
// Three 18 x 18 multipliers, their sum, a shifter of two levels, by 8 and by 1. Latency LATENCY_DOT_SCALED = 5 clocks, one dot
// product a clock. Source: P4's constant increment, whose scalars it makes. Example: a = b = (0, 0, 1), shift 1 -> d = 1.
module shade_dot_scaled (
  input  logic                                        clk_i,
  input  shade_pkg::vec_t                             a_i,
  input  shade_pkg::vec_t                             b_i,
  input  logic                                  [4:0] shift_i,
  output logic signed [2*shade_pkg::INTENSITY_W-1:0]  product_x_o,
  output logic signed [2*shade_pkg::INTENSITY_W-1:0]  product_y_o,
  output logic signed [2*shade_pkg::INTENSITY_W-1:0]  product_z_o,
  output logic signed [  shade_pkg::PATCH_SCALAR_W-1:0] d_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int DOT_W = 2 * W + 1;  // three products S1.16: S4.32
  localparam int UP = shade_pkg::DIRECT_P_F - 2 * shade_pkg::INTENSITY_F + 1;
  localparam int OUT_W = shade_pkg::PATCH_SCALAR_W;

  shade_mul #(.A_W(W), .B_W(W)) u_x (.clk_i, .a_i(a_i.x), .b_i(b_i.x), .p_o(product_x_o));
  shade_mul #(.A_W(W), .B_W(W)) u_y (.clk_i, .a_i(a_i.y), .b_i(b_i.y), .p_o(product_y_o));
  shade_mul #(.A_W(W), .B_W(W)) u_z (.clk_i, .a_i(a_i.z), .b_i(b_i.z), .p_o(product_z_o));

  logic [4:0] shift;
  logic [2:0] fine_q;
  logic signed [DOT_W-1:0] dot_q;
  logic signed [DOT_W+UP-1:0] coarse_q;
  shade_delay #(.WIDTH(5), .DEPTH(shade_pkg::LATENCY_MUL + 1)) u_shift (.clk_i, .d_i(shift_i), .q_o(shift));
  always_ff @(posedge clk_i) begin
    dot_q    <= DOT_W'(product_x_o) + DOT_W'(product_y_o) + DOT_W'(product_z_o);
    coarse_q <= $signed({dot_q, UP'(0)}) >>> {shift[4:3], 3'd0};
    fine_q   <= shift[2:0];
    d_o      <= OUT_W'(coarse_q >>> fine_q);
  end
endmodule
