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
  shade_pkg::intensity_t light;
  shade_pkg::colour_t weights;
  shade_pkg::coloured_t pixel;
  logic some;
  always_comb begin
    light.diffuse   = {2'b00, light_i[6:0], light_i[6:0], light_i[6:5]};
    light.specular  = {2'b00, {4{light_i[10:7]}}};
    weights.ambient = {17'(AMBIENT_B), 17'(AMBIENT_G), 17'(AMBIENT_R)};
    weights.kd      = {17'(KD_B), 17'(KD_G), 17'(KD_R)};
    weights.ks      = {3{17'(KS)}};
  end
  shade_colour u_colour (.clk_i, .light_i(light), .colour_i(weights), .pixel_o(pixel));
  shade_valid #(.DEPTH(shade_pkg::LATENCY_COLOUR)) u_some (.clk_i, .rst_i, .valid_i(light_i[11]), .valid_o(some));
  assign rgb_o = some ? {pixel.red[15:8], pixel.green[15:8], pixel.blue[15:8]} : {8'd28, 8'd31, 8'd36};
  logic unused_bits;
  assign unused_bits = &{1'b0, pixel};
endmodule
