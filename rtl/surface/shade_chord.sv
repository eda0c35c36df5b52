// SPDX-License-Identifier: Apache-2.0
// shade_chord: specular light from x = 1 - cos by a table of 1024 chords over x 2^shift in [0, 1).
//
//   i = top 10 bits of x 2^shift, f = the 12 below;   specular = value(i) + slope(i) f, rounded to nearest
//
// x_i S1.24: x < 0 counts as 0; from 2^-shift on, and with dark_i, the light is 0. value U1.16, slope S-6.20; specular_o
// U0.16, saturated. The lobe may be of any shape; gain and Fresnel's factor are in the table.
// write_i, address_i, chord_i: an entry, while no pixel is inside; shift_i may change then, too.
// Within 3/4 ulp of the chord. Latency LATENCY_CHORD = 6 clocks, one pixel a clock.
// Example: shift 1, x = 1/4 + 2^-12, value(512) = 0.5, slope(512) = -2^-9 -> 0.5 - 2^-10.
module shade_chord (
  input  logic                                     clk_i,
  input  logic                                     write_i,
  input  logic        [shade_pkg::CHORD_INDEX_W-1:0] address_i,
  input  shade_pkg::chord_t                        chord_i,
  input  logic        [shade_pkg::CHORD_SHIFT_W-1:0] shift_i,
  input  logic signed [shade_pkg::DIRECT_X_F+2:0]  x_i,
  input  logic                                     dark_i,
  output logic        [shade_pkg::PIXEL_W-1:0]     specular_o
);
  localparam int X_F = shade_pkg::DIRECT_X_F;
  localparam int INDEX_W = shade_pkg::CHORD_INDEX_W;
  localparam int FRACTION_W = shade_pkg::CHORD_FRACTION_W;
  localparam int SLOPE_W = shade_pkg::CHORD_SLOPE_W;
  localparam int DROP = shade_pkg::CHORD_SLOPE_F - shade_pkg::INTENSITY_F;

  // x 2^shift, cut to what is needed, a bit of the shift after the other; what leaves at the top is far
  localparam int SCALED_W = INDEX_W + FRACTION_W;
  logic [X_F-1:0] by_1, by_2;
  logic [SCALED_W-1:0] by_4;
  logic below, far_1, far_2, far_4;
  assign below = x_i < 0;
  assign by_1  = shift_i[0] ? {x_i[X_F-2:0], 1'b0} : x_i[X_F-1:0];
  assign far_1 = shift_i[0] && x_i[X_F-1];
  assign by_2  = shift_i[1] ? {by_1[X_F-3:0], 2'b0} : by_1;
  assign far_2 = shift_i[1] && by_1[X_F-1-:2] != '0;
  assign by_4  = shift_i[2] ? {by_2[X_F-5:0], (SCALED_W - X_F + 4)'(0)} : by_2[X_F-1-:SCALED_W];
  assign far_4 = shift_i[2] && by_2[X_F-1-:4] != '0;
  logic far_q;
  logic [SCALED_W-1:0] scaled_q;
  always_ff @(posedge clk_i) begin
    far_q    <= dark_i || (!below && (x_i[X_F+1:X_F] != 2'd0 || far_1 || far_2 || far_4));
    scaled_q <= by_4;
    if (below) scaled_q <= '0;
  end

  // the table, never read for a pixel in a clock in which it is written
  (* no_rw_check *) logic [shade_pkg::INTENSITY_F:0] values[0:(1<<INDEX_W)-1];
  (* no_rw_check *) logic [SLOPE_W-1:0] slopes[0:(1<<INDEX_W)-1];
  shade_pkg::chord_t chord_q;
  always_ff @(posedge clk_i) begin
    if (write_i) values[address_i] <= chord_i.value;
    chord_q.value <= values[scaled_q[FRACTION_W+:INDEX_W]];
  end
  always_ff @(posedge clk_i) begin
    if (write_i) slopes[address_i] <= chord_i.slope;
    chord_q.slope <= slopes[scaled_q[FRACTION_W+:INDEX_W]];
  end
  logic signed [FRACTION_W:0] fraction_q;
  always_ff @(posedge clk_i) fraction_q <= {1'b0, scaled_q[FRACTION_W-1:0]};

  // value + slope f
  logic signed [SLOPE_W+FRACTION_W:0] product;
  logic [shade_pkg::INTENSITY_F:0] value;
  logic far;
  shade_mul #(.A_W(SLOPE_W), .B_W(FRACTION_W + 1)) u_slope (
    .clk_i, .a_i(chord_q.slope), .b_i(fraction_q), .p_o(product)
  );
  shade_delay #(.WIDTH(shade_pkg::INTENSITY_F + 1), .DEPTH(2)) u_value (.clk_i, .d_i(chord_q.value), .q_o(value));
  shade_delay #(.WIDTH(1), .DEPTH(3)) u_far (.clk_i, .d_i(far_q), .q_o(far));
  localparam int SUM_W = shade_pkg::INTENSITY_F + DROP + 3;
  logic signed [SUM_W-1:0] sum_q;
  logic far_sum_q;
  always_ff @(posedge clk_i) begin
    far_sum_q <= far;
    sum_q <= {2'd0, value, DROP'(1 << (DROP - 1))} + SUM_W'(product >>> FRACTION_W);
  end

  always_ff @(posedge clk_i) begin
    specular_o <= sum_q[DROP+:shade_pkg::PIXEL_W];
    if (sum_q[SUM_W-1:DROP+shade_pkg::PIXEL_W] != '0) specular_o <= '1;
    if (far_sum_q || sum_q < 0) specular_o <= '0;
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, sum_q[DROP-1:0], by_2};
endmodule
