// SPDX-License-Identifier: Apache-2.0
// board_pixels: pixels of spans into the frame buffer, those that are nearer than what is there.
//
//   span_i, spot_i   a span enters the core, and where it begins: kept until its pixels come. room_o: another may enter
//   s_axis_pixel_*   its pixels, {specular, diffuse} U0.16, in order
//   at_o             address of the pixel, 320 line + column; depth_i: what the buffer has there, a clock later
//   write_o          the pixel is nearer: depth_o, U0.11, and light_o = {1, specular U0.4, diffuse U0.7}
//   busy_o           spans are inside
//
// Depth is the span's, value + i increase at its pixel i, S1.30, from 0 to 2046 of U0.11. Three clocks a pixel, so that no pixel is
// read before the one in front of it is written. Example: two pixels of equal depth at one place: the first one stays.
module board_pixels (
  input  logic                               clk_i,
  input  logic                               rst_i,
  input  logic                               span_i,
  input  shade_pkg::spot_t                   spot_i,
  output logic                               room_o,
  input  logic                               s_axis_pixel_tvalid,
  output logic                               s_axis_pixel_tready,
  input  logic [shade_pkg::PIXEL_DATA_W-1:0] s_axis_pixel_tdata,
  input  logic                               s_axis_pixel_tlast,
  output logic [                       16:0] at_o,
  input  logic [                       10:0] depth_i,
  output logic                               write_o,
  output logic [                       10:0] depth_o,
  output logic [                       11:0] light_o,
  output logic                               busy_o
);
  localparam int LOG2 = 6;
  shade_pkg::spot_t spot;
  logic spot_valid, spot_ready, gone, soon, begun_q;
  shade_credit #(.LOG2(LOG2)) u_credit (
    .clk_i, .rst_i, .take_i(span_i), .give_i(gone), .some_o(room_o), .soon_o(soon)
  );
  shade_fifo #(.WIDTH($bits(spot)), .LOG2(LOG2)) u_spots (
    .clk_i, .rst_i, .valid_i(span_i), .data_i(spot_i), .valid_o(spot_valid), .ready_i(spot_ready), .data_o(spot),
    .taken_o(gone)
  );
  assign spot_ready = !begun_q;
  assign busy_o     = begun_q || spot_valid;

  logic [2:0] step_q;  // read, wait, compare: a bit each
  logic signed [31:0] z_q, increase_q;
  logic far;
  assign far     = z_q[30] || z_q[29:19] == 11'h7ff;
  assign depth_o = z_q[31] ? 11'd0 : far ? 11'h7fe : z_q[29:19];
  assign light_o = {1'b1, s_axis_pixel_tdata[31:28], s_axis_pixel_tdata[15:9]};
  assign write_o = step_q[2] && depth_o < depth_i;
  assign s_axis_pixel_tready = step_q[2];
  always_ff @(posedge clk_i) begin
    if (spot_ready && spot_valid) begin
      at_o       <= 17'({spot.line[7:0], 8'd0}) + 17'({spot.line[7:0], 6'd0}) + 17'(spot.column);
      z_q        <= spot.depth;
      increase_q <= spot.increase;
      begun_q    <= 1'b1;
    end
    step_q <= {step_q[1:0], begun_q && s_axis_pixel_tvalid && step_q == 3'b000};
    if (step_q[2]) begin
      at_o <= at_o + 17'd1;
      z_q  <= z_q + increase_q;
      if (s_axis_pixel_tlast) begun_q <= 1'b0;
    end
    if (rst_i) {begun_q, step_q} <= '0;
  end
  logic unused_bits;
  assign unused_bits = &{1'b0, soon, spot, s_axis_pixel_tdata};
endmodule
