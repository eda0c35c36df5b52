// SPDX-License-Identifier: Apache-2.0
// board_picture: light of the frame buffer as colours, a pixel a clock: skin under white light, or the background.
//
//   colour = ambient + kd diffuse + ks specular, diffuse {d, d, d[6:5]}, specular {s, s, s, s} of the buffer's 7 and 4 bits: see
//   shade_colour; the upper 8 bits of each channel
//
// Latency LATENCY_COLOUR. Example: light_i = 0 -> the background, 28, 31, 36.
module board_picture (
  input  logic        clk_i,
  input  logic        rst_i,
  input  logic [11:0] light_i,
  output logic [23:0] rgb_o
);
  localparam int AMBIENT_R = 6095, AMBIENT_G = 4588, AMBIENT_B = 3801;  // 0.10 of 0.93, 0.70, 0.58
  localparam int KD_R = 48759, KD_G = 36700, KD_B = 30409;  // 0.80 of it
  localparam int KS = 22938;  // 0.35
  logic [15:0] r, g, b;
  logic some;
  shade_colour u_colour (
    .clk_i, .rst_i, .valid_i(light_i[11]), .diffuse_i({2'b00, light_i[6:0], light_i[6:0], light_i[6:5]}),
    .specular_i({2'b00, {4{light_i[10:7]}}}), .ambient_r_i(17'(AMBIENT_R)), .ambient_g_i(17'(AMBIENT_G)),
    .ambient_b_i(17'(AMBIENT_B)), .kd_r_i(17'(KD_R)), .kd_g_i(17'(KD_G)), .kd_b_i(17'(KD_B)), .ks_r_i(17'(KS)),
    .ks_g_i(17'(KS)), .ks_b_i(17'(KS)), .valid_o(some), .r_o(r), .g_o(g), .b_o(b)
  );
  assign rgb_o = some ? {r[15:8], g[15:8], b[15:8]} : {8'd28, 8'd31, 8'd36};
  logic unused_bits;
  assign unused_bits = &{1'b0, r[7:0], g[7:0], b[7:0]};
endmodule
