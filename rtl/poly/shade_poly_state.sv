// SPDX-License-Identifier: Apache-2.0
// shade_poly_state: I, d1, d2, d3 of a channel, stepped by three additions a pixel: I += d1, d1 += d2, d2 += d3.
//
//   valid_i      makes one pixel; begin_i with it: from node_i (S1.16) and the differences, see shade_poly_start
//   pixel_o      U0.16: I, to nearest, ties up, clamped
//
// State modulo 2^WIDTH: S3.16 with 3 LOG2_MAX more fraction bits; nothing is rounded before the pixel.
// Latency LATENCY_POLY_STATE = 3 clocks, one pixel a clock.
// Example: node 0, d1 = 1/4, d2 = d3 = 0 -> 0, 1/4, 1/2. Source: P1, section IV; forward differences.
module shade_poly_state #(
  parameter int LOG2_MAX = shade_pkg::RECORD_LOG2,
  parameter int WIDTH    = shade_pkg::INTENSITY_W + 2 + 3 * LOG2_MAX
) (
  input  logic                                     clk_i,
  input  logic                                     valid_i,
  input  logic                                     begin_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] node_i,
  input  logic signed [                 WIDTH-1:0] d1_i,
  input  logic signed [                 WIDTH-1:0] d2_i,
  input  logic signed [                 WIDTH-1:0] d3_i,
  output logic        [    shade_pkg::PIXEL_W-1:0] pixel_o
);
  if (LOG2_MAX < 2 || LOG2_MAX > shade_pkg::LOG2_MAX || WIDTH != shade_pkg::INTENSITY_W + 2 + 3 * LOG2_MAX)
  begin : g_check
    $error("shade_poly_state: LOG2_MAX must be in 2 .. 12, WIDTH is not to be set");
  end

  localparam int FRACTION = 3 * LOG2_MAX;
  localparam int VALUE_W = WIDTH - FRACTION;
  logic signed [WIDTH-1:0] i_q1, d1_q1, d2_q1, d3_q1;
  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      i_q1  <= begin_i ? WIDTH'(node_i) <<< FRACTION : i_q1 + d1_q1;
      d1_q1 <= begin_i ? d1_i : d1_q1 + d2_q1;
      d2_q1 <= begin_i ? d2_i : d2_q1 + d3_q1;
      if (begin_i) d3_q1 <= d3_i;
    end
  end

  logic signed [VALUE_W-1:0] rounded, value_q2;  // |I| is less than half of the range: rounding cannot overflow
  logic [shade_pkg::PIXEL_W-1:0] clamped;
  shade_round #(.WIDTH(WIDTH), .DROP(FRACTION), .OUT_W(VALUE_W)) u_round (.x_i(i_q1), .y_o(rounded));
  shade_saturate #(.WIDTH(VALUE_W), .OUT_W(shade_pkg::PIXEL_W)) u_clamp (.x_i(value_q2), .y_o(clamped));
  always_ff @(posedge clk_i) begin
    value_q2 <= rounded;
    pixel_o  <= clamped;
  end
endmodule
