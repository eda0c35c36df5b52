// SPDX-License-Identifier: Apache-2.0
// shade_scene_level: a colour of 16 bits a channel to the 8 bits of a picture: floor(255 c / 2^16 + 1/2).
//
// Combinational, two adders a channel. Example: 32768, that is 1/2 -> 128.
module shade_scene_level (
  input  shade_pkg::coloured_t colour_i,
  output shade_pkg::rgb8_t     pixel_o
);
  function automatic logic [7:0] level(input logic [shade_pkg::PIXEL_W-1:0] c);
    level = 8'(({c, 8'd0} - 24'(c) + 24'(1 << (shade_pkg::PIXEL_W - 1))) >> shade_pkg::PIXEL_W);
  endfunction
  assign pixel_o.red   = level(colour_i.red);
  assign pixel_o.green = level(colour_i.green);
  assign pixel_o.blue  = level(colour_i.blue);
endmodule
