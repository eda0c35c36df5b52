// SPDX-License-Identifier: Apache-2.0
// board_frame: 320 x 240 pixels in block RAM: two pictures of 12 bits, one shown and one drawn, and depths of 11 bits.
//
// back_i: which one is drawn. write_i: light and depth of a pixel. clear_i: clear_at_i is empty, and as far as can be. depth_o: a
// clock behind at_i; light_o: two clocks behind show_i, of the picture that is not drawn. Address: 320 line + column.
// Example: at_i = 321 -> the second pixel of the second line.
module board_frame #(
  parameter int PIXELS = 76800
) (
  input  logic        clk_i,
  input  logic        back_i,
  input  logic [16:0] at_i,
  input  logic        write_i,
  input  logic [10:0] depth_i,
  input  logic [11:0] light_i,
  input  logic        clear_i,
  input  logic [16:0] clear_at_i,
  output logic [10:0] depth_o,
  input  logic [16:0] show_i,
  output logic [11:0] light_o
);
  logic [16:0] to;
  logic [10:0] depth;
  logic [11:0] light, light_a, light_b;
  logic put;
  assign put   = clear_i || write_i;
  assign to    = clear_i ? clear_at_i : at_i;
  assign depth = clear_i ? 11'h7ff : depth_i;
  assign light = clear_i ? 12'd0 : light_i;
  board_memory #(.WIDTH(11), .DEPTH(PIXELS)) u_depth (
    .clk_i, .write_i(put), .to_i(to), .data_i(depth), .at_i, .data_o(depth_o)
  );
  board_memory #(.WIDTH(12), .DEPTH(PIXELS)) u_light_a (
    .clk_i, .write_i(put && !back_i), .to_i(to), .data_i(light), .at_i(show_i), .data_o(light_a)
  );
  board_memory #(.WIDTH(12), .DEPTH(PIXELS)) u_light_b (
    .clk_i, .write_i(put && back_i), .to_i(to), .data_i(light), .at_i(show_i), .data_o(light_b)
  );
  always_ff @(posedge clk_i) light_o <= back_i ? light_a : light_b;
endmodule
