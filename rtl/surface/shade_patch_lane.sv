// SPDX-License-Identifier: Apache-2.0
// shade_patch_lane: the pixels of a piece of a line, two additions a channel each.
//
//   piece_i     {specular d2, d1, I, diffuse d2, d1, I, count - 1, column, line, tag}: I S5.22, its step and the step's step
//   ready_o     the piece is taken, with the last pixel of the one before at the earliest
//   m_axis_*    tdata = {specular, diffuse}, U0.16; tuser = {line, column, tag}; tlast = the piece's last pixel
//
//   pixel = I, floor, clamped to [0, 1 - 2^-16]: half an ulp is in I;   I += d1, d1 += d2        modulo 2^PATCH_VALUE_W
//
// A pixel a clock, no bubble between pieces, as long as the consumer keeps up: 2^9 pixels wait for it, in
// block RAM. Latency 6 clocks.
// Example: I = 1/4, d1 = 1/4, d2 = 0, 3 pixels -> 1/4, 1/2, 3/4.
module shade_patch_lane (
  input  logic                                 clk_i,
  input  logic                                 rst_i,
  input  logic                                 valid_i,
  output logic                                 ready_o,
  input  logic [shade_pkg::PATCH_PIECE_W-1:0]  piece_i,
  output logic                                 m_axis_pixel_tvalid,
  input  logic                                 m_axis_pixel_tready,
  output logic [ shade_pkg::PIXEL_DATA_W-1:0]  m_axis_pixel_tdata,
  output logic [shade_pkg::PATCH_USER_W-1:0]   m_axis_pixel_tuser,
  output logic                                 m_axis_pixel_tlast
);
  localparam int VALUE_W = shade_pkg::PATCH_VALUE_W;
  localparam int PIXEL_W = shade_pkg::PIXEL_W;
  localparam int PLACE_W = shade_pkg::PLACE_W;
  localparam int TAG_W = shade_pkg::TAG_W;
  localparam int LOG2 = shade_pkg::PATCH_LOG2_MAX;
  localparam int FIFO_LOG2 = shade_pkg::PATCH_FIFO_LOG2;

  // ---- the piece at hand ---------------------------------------------------------------------------------------------------------
  logic load, issue, first_q, last_q, credit;
  logic [LOG2-1:0] more;
  logic [PLACE_W-1:0] column, line, line_q, column_q;
  logic [TAG_W-1:0] tag, tag_q;
  logic [2*3*VALUE_W-1:0] values;
  assign {values, more, column, line, tag} = piece_i;
  shade_walk #(.COUNT_W(LOG2 + 1), .CREDIT_LOG2(FIFO_LOG2)) u_walk (
    .clk_i, .rst_i, .valid_i, .ready_o, .count_i((LOG2 + 1)'(more) + (LOG2 + 1)'(1)),
    .credit_i(credit), .load_o(load), .issue_o(issue), .first_o(first_q), .last_o(last_q)
  );

  // ---- two additions a channel ---------------------------------------------------------------------------------------------------
  logic [2*PIXEL_W-1:0] pixel, pixel_q;
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
  logic [shade_pkg::PATCH_USER_W:0] user_q;
  always_ff @(posedge clk_i) begin
    if (load) {line_q, column_q, tag_q} <= {line, column, tag};
    else if (issue) column_q <= column_q + PLACE_W'(1);
    pixel_q <= pixel;
    user_q  <= {last_q, line_q, column_q, tag_q};
    valid_q <= issue && !rst_i;
  end
  shade_fifo #(.WIDTH(2 * PIXEL_W + shade_pkg::PATCH_USER_W + 1), .LOG2(FIFO_LOG2), .BLOCK(1)) u_pixels (
    .clk_i, .rst_i, .valid_i(valid_q), .data_i({user_q, pixel_q}), .valid_o(m_axis_pixel_tvalid),
    .ready_i(m_axis_pixel_tready), .data_o({m_axis_pixel_tlast, m_axis_pixel_tuser, m_axis_pixel_tdata}), .taken_o(credit)
  );
  logic unused_first;
  assign unused_first = &{1'b0, first_q};
endmodule
