// SPDX-License-Identifier: Apache-2.0
// shade_patch_lane: the pixels of a piece of a line, two additions a channel each.
//
//   piece_i     {specular d2, d1, I, diffuse d2, d1, I, count - 1, column, line, tag}: I S1.18, its step and the step's step
//   ready_o     the piece is taken, with the last pixel of the one before at the earliest
//   single_i    {line, column, tag, specular, diffuse}, a pixel that is lit directly: it comes first, single_ready_o takes it
//   m_axis_*    tdata = {specular, diffuse}, U0.16; tuser = {line, column, tag}; tlast = the piece's last pixel
//
//   pixel = I, floor, clamped to [0, 1 - 2^-16]: half an ulp is in I;   I += d1, d1 += d2        modulo 2^PATCH_VALUE_W
//
// A pixel a clock, no bubble between pieces, as long as the consumer keeps up; pixels wait for it in a block RAM.
// Latency 5 clocks. Example: I = 1/4, d1 = 1/4, d2 = 0, 3 pixels -> 1/4, 1/2, 3/4.
module shade_patch_lane (
  input  logic                                 clk_i,
  input  logic                                 rst_i,
  input  logic                                 valid_i,
  output logic                                 ready_o,
  input  logic [shade_pkg::PATCH_PIECE_W-1:0]  piece_i,
  input  logic                                 single_valid_i,
  output logic                                 single_ready_o,
  input  logic [shade_pkg::PATCH_USER_W+shade_pkg::PIXEL_DATA_W-1:0] single_i,
  output logic                                 m_axis_pixel_tvalid,
  input  logic                                 m_axis_pixel_tready,
  output logic [ shade_pkg::PIXEL_DATA_W-1:0]  m_axis_pixel_tdata,
  output logic [shade_pkg::PATCH_USER_W-1:0]   m_axis_pixel_tuser,
  output logic                                 m_axis_pixel_tlast
);
  localparam int VALUE_W = shade_pkg::PATCH_VALUE_W;
  localparam int PIXEL_W = shade_pkg::PIXEL_W;
  localparam int DATA_W = shade_pkg::PIXEL_DATA_W;
  localparam int USER_W = shade_pkg::PATCH_USER_W;
  localparam int PLACE_W = shade_pkg::PLACE_W;
  localparam int TAG_W = shade_pkg::TAG_W;
  localparam int LOG2 = shade_pkg::PATCH_LOG2_MAX;
  localparam int FIFO_LOG2 = shade_pkg::PATCH_PIXELS_LOG2;

  // ---- the piece at hand ---------------------------------------------------------------------------------------------------------
  logic busy_q, last_q, load, issue, put, some, credit;
  logic [LOG2-1:0] more, left_q;
  logic [PLACE_W-1:0] column, line, line_q, column_q;
  logic [TAG_W-1:0] tag, tag_q;
  logic [2*3*VALUE_W-1:0] values;
  assign {values, more, column, line, tag} = piece_i;
  assign single_ready_o = some;
  assign put            = some && (busy_q || single_valid_i);
  assign issue          = some && busy_q && !single_valid_i;
  assign ready_o        = !busy_q || (issue && last_q);
  assign load           = valid_i && ready_o;
  logic unused_credit;
  shade_credit #(.LOG2(FIFO_LOG2)) u_credit (
    .clk_i, .rst_i, .take_i(put), .give_i(credit), .some_o(some), .soon_o(unused_credit)
  );
  always_ff @(posedge clk_i) begin
    if (load) begin
      {line_q, column_q, tag_q, left_q} <= {line, column, tag, more};
      last_q <= more == '0;
    end else if (issue) begin
      column_q <= column_q + PLACE_W'(1);
      left_q   <= left_q - LOG2'(1);
      last_q   <= left_q == LOG2'(1);
    end
    if (load) busy_q <= 1'b1;
    else if (issue && last_q) busy_q <= 1'b0;
    if (rst_i) busy_q <= 1'b0;
  end

  // ---- two additions a channel ---------------------------------------------------------------------------------------------------
  logic [2*PIXEL_W-1:0] pixel;
  for (genvar c = 0; c < 2; c++) begin : g_channel
    localparam int NEAR_W = VALUE_W - shade_pkg::PATCH_VALUE_F;
    logic signed [VALUE_W-1:0] value_q, d1_q, d2_q, value, d1, d2;
    logic signed [NEAR_W-1:0] near;
    assign {d2, d1, value} = values[c*3*VALUE_W+:3*VALUE_W];
    always_ff @(posedge clk_i) begin
      if (load) {value_q, d1_q, d2_q} <= {value, d1, d2};
      else if (issue) begin
        value_q <= value_q + d1_q;
        d1_q    <= d1_q + d2_q;
      end
    end
    assign near = value_q[VALUE_W-1:shade_pkg::PATCH_VALUE_F];
    shade_saturate #(.WIDTH(NEAR_W), .OUT_W(PIXEL_W)) u_pixel (.x_i(near), .y_o(pixel[c*PIXEL_W+:PIXEL_W]));
  end

  logic valid_q;
  logic [USER_W+DATA_W:0] pixel_q;
  always_ff @(posedge clk_i) begin
    pixel_q <= single_valid_i ? {1'b1, single_i} : {last_q, line_q, column_q, tag_q, pixel};
    valid_q <= put && !rst_i;
  end
  shade_fifo #(.WIDTH(DATA_W + USER_W + 1), .LOG2(FIFO_LOG2), .BLOCK(1)) u_pixels (
    .clk_i, .rst_i, .valid_i(valid_q), .data_i(pixel_q), .valid_o(m_axis_pixel_tvalid),
    .ready_i(m_axis_pixel_tready), .data_o({m_axis_pixel_tlast, m_axis_pixel_tuser, m_axis_pixel_tdata}), .taken_o(credit)
  );
endmodule
