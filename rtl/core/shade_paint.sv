// SPDX-License-Identifier: Apache-2.0
// shade_paint: pixels of diffuse and specular light in, coloured pixels out, one a clock.
//
//   drawn_i     diffuse and specular light, U0.16; tag; last
//   painted_o   CONTROL.colour = 1: red, green, blue, U0.16, see shade_colour; 0: diffuse, specular, 0; tag, last
//   draw_i      weights ambient, kd, ks, U1.16; must not change while a pixel is inside
//
// Six multipliers. The pipeline never stalls: a pixel is taken with a credit for its place in the FIFO behind; no
// combinational path leads from an input to an output. Latency LATENCY_PAINT clocks.
// Example: diffuse 1/2, ambient_r = 0.1, kd_r = 1 -> red 0.6. Source: P1, section II.
module shade_paint #(
  parameter int FIFO_LOG2 = shade_pkg::FIFO_LOG2
) (
  input  logic                clk_i,
  input  logic                rst_i,
  input  shade_pkg::draw_t    draw_i,
  input  logic                valid_i,
  output logic                ready_o,
  input  shade_pkg::drawn_t   drawn_i,
  output logic                valid_o,
  input  logic                ready_i,
  output shade_pkg::painted_t painted_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int PIXEL_W = shade_pkg::PIXEL_W;

  logic take, taken, coloured, unused_soon;
  shade_pkg::drawn_t plain;
  shade_pkg::painted_t next;
  shade_pkg::coloured_t colour;
  shade_pkg::intensity_t light;
  assign take = valid_i && ready_o;
  shade_credit #(.LOG2(FIFO_LOG2)) u_credit (
    .clk_i, .rst_i, .take_i(take), .give_i(taken), .some_o(ready_o), .soon_o(unused_soon)
  );
  assign light.diffuse  = W'(drawn_i.pixel.diffuse);
  assign light.specular = W'(drawn_i.pixel.specular);
  shade_colour u_colour (.clk_i, .light_i(light), .colour_i(draw_i.colour), .pixel_o(colour));
  shade_valid #(.DEPTH(shade_pkg::LATENCY_COLOUR)) u_valid (.clk_i, .rst_i, .valid_i(take), .valid_o(coloured));
  shade_delay #(.WIDTH($bits(plain)), .DEPTH(shade_pkg::LATENCY_COLOUR)) u_plain (
    .clk_i, .d_i(drawn_i), .q_o(plain)
  );
  assign next.pixel = draw_i.control.colour ? colour : {PIXEL_W'(0), plain.pixel};
  assign next.tag   = plain.tag;
  assign next.last  = plain.last;
  shade_fifo #(.WIDTH($bits(next)), .LOG2(FIFO_LOG2)) u_fifo (
    .clk_i, .rst_i, .valid_i(coloured), .data_i(next), .valid_o, .ready_i, .data_o(painted_o), .taken_o(taken)
  );

  logic unused_settings;
  assign unused_settings = &{1'b0, draw_i};
endmodule
