// SPDX-License-Identifier: Apache-2.0
// shade_frame: a frame buffer in block RAM: a colour and a depth for every pixel, cleared as it is shown.
//
//   request_i, answer_o, write_i   the memory of shade_depth: an answer 2 clocks behind its request
//   pixel_i, site_i                a pixel's colour
//   show_i                         the picture is complete; taken with show_ready_o
//   m_axis_frame                   the picture in scan order: tuser = its first pixel, tlast = the last one of a line
//   ready_o                        drawing may go on: nothing is cleared; nothing is to be written as long as it is 0
//
// A frame has view_i.columns x view_i.lines, at most 2^COLUMNS_LOG2 x 2^LINES_LOG2 pixels. Colours are cleared to
// background_i, depths to 1 - 2^-24. DOUBLE = 0: one buffer; drawing waits until the picture has been taken. DOUBLE = 1: a
// second buffer of colours; drawing waits a clock a pixel, then goes on beside the picture that is being taken.
// After reset a frame is cleared. Block RAM for 2^COLUMNS_LOG2 2^LINES_LOG2 (DATA_W (1 + DOUBLE) + 24) bits.
// Example: 256 x 256, 24 bits of colour, DOUBLE = 0: 3 Mbit.
module shade_frame #(
  parameter int COLUMNS_LOG2 = 8,
  parameter int LINES_LOG2   = 8,
  parameter int DATA_W       = 24,
  parameter int DOUBLE       = 0
) (
  input  logic                          clk_i,
  input  logic                          rst_i,
  input  shade_pkg::view_t              view_i,
  input  logic [            DATA_W-1:0] background_i,
  output logic                          ready_o,
  input  logic                          request_valid_i,
  input  shade_pkg::site_t              request_i,
  output logic                          answer_valid_o,
  output logic [shade_pkg::DEPTH_F-1:0] answer_o,
  input  logic                          write_valid_i,
  input  shade_pkg::deep_t              write_i,
  input  logic                          pixel_valid_i,
  input  shade_pkg::site_t              site_i,
  input  logic [            DATA_W-1:0] pixel_i,
  input  logic                          show_i,
  output logic                          show_ready_o,
  output logic                          m_axis_frame_tvalid,
  input  logic                          m_axis_frame_tready,
  output logic [            DATA_W-1:0] m_axis_frame_tdata,
  output logic                          m_axis_frame_tuser,
  output logic                          m_axis_frame_tlast
);
  if (COLUMNS_LOG2 < 1 || COLUMNS_LOG2 > shade_pkg::PLACE_W || LINES_LOG2 < 1 || LINES_LOG2 > shade_pkg::PLACE_W
      || DOUBLE < 0 || DOUBLE > 1) begin : g_check
    $error("shade_frame: COLUMNS_LOG2 and LINES_LOG2 must be in 1 .. 12 and DOUBLE 0 or 1");
  end

  localparam int A_W = COLUMNS_LOG2 + LINES_LOG2;
  localparam int Z_W = shade_pkg::DEPTH_F;
  localparam int FIFO_LOG2 = 3;
  function automatic logic [A_W-1:0] address(input shade_pkg::site_t site);
    address = {LINES_LOG2'(site.line), COLUMNS_LOG2'(site.column)};
  endfunction

  // ---- two sweeps: what is read, what is cleared; with one buffer the second follows the first -------------------------------
  logic show, reading, read, read_q, clearing, clear, fresh_q, follow_q, last_column, unused_column, some, taken;
  shade_pkg::site_t read_site, clear_site;
  assign show         = show_i && show_ready_o;
  assign show_ready_o = !reading && !clearing && !fresh_q;
  assign ready_o      = !clearing && !fresh_q;
  assign read         = reading && some;
  assign clear        = clearing && (DOUBLE != 0 || !follow_q || read_q);
  shade_scene_sweep u_read (
    .clk_i, .rst_i, .view_i, .start_i(show), .step_i(read), .busy_o(reading), .site_o(read_site),
    .last_column_o(last_column)
  );
  shade_scene_sweep u_clear (
    .clk_i, .rst_i, .view_i, .start_i(show || fresh_q), .step_i(clear), .busy_o(clearing), .site_o(clear_site),
    .last_column_o(unused_column)
  );
  always_ff @(posedge clk_i) begin
    fresh_q  <= rst_i;  // a frame is cleared after reset
    follow_q <= show || (follow_q && !fresh_q);
    read_q   <= read && !rst_i;
  end

  // ---- depths -----------------------------------------------------------------------------------------------------------------
  logic [Z_W-1:0] depths[0:(1<<A_W)-1];
  logic [Z_W-1:0] depth_q;
  logic asked_q;
  always_ff @(posedge clk_i) begin
    if (clear || write_valid_i) depths[clear ? address(clear_site) : address(write_i.site)] <= clear ? '1 : write_i.depth;
    depth_q <= depths[address(request_i)];
    answer_o       <= depth_q;
    asked_q        <= request_valid_i && !rst_i;
    answer_valid_o <= asked_q && !rst_i;
  end

  // ---- colours ----------------------------------------------------------------------------------------------------------------
  localparam int C_W = A_W + DOUBLE;
  logic [DATA_W-1:0] colours[0:(1<<C_W)-1];
  logic [DATA_W-1:0] colour_q1, colour_q2;
  logic [C_W-1:0] from, to;
  logic [1:0] mark_q1, mark_q2;
  logic read_q2;
  if (DOUBLE != 0) begin : g_double
    logic shown_q;  // the buffer that is shown
    always_ff @(posedge clk_i) if (show || rst_i) shown_q <= rst_i ? 1'b0 : !shown_q;
    assign from = {shown_q, address(read_site)};
    assign to   = {!shown_q, clear ? address(clear_site) : address(site_i)};
  end else begin : g_single
    assign from = address(read_site);
    assign to   = clear ? address(clear_site) : address(site_i);
  end
  always_ff @(posedge clk_i) begin
    if (clear || pixel_valid_i) colours[to] <= clear ? background_i : pixel_i;
    colour_q1 <= colours[from];
    colour_q2 <= colour_q1;
    mark_q1   <= {last_column, read_site == '0};
    mark_q2   <= mark_q1;
    read_q2   <= read_q && !rst_i;
  end
  logic unused_credit;
  shade_credit #(.LOG2(FIFO_LOG2)) u_credit (
    .clk_i, .rst_i, .take_i(read), .give_i(taken), .some_o(some), .soon_o(unused_credit)
  );
  shade_fifo #(.WIDTH(DATA_W + 2), .LOG2(FIFO_LOG2)) u_fifo (
    .clk_i, .rst_i, .valid_i(read_q2), .data_i({mark_q2, colour_q2}), .valid_o(m_axis_frame_tvalid),
    .ready_i(m_axis_frame_tready), .data_o({m_axis_frame_tlast, m_axis_frame_tuser, m_axis_frame_tdata}), .taken_o(taken)
  );
  shade_assert u_clear_alone (.clk_i, .rst_i, .holds_i(!clear || !(write_valid_i || pixel_valid_i)));

  logic unused_bits;
  assign unused_bits = &{1'b0, unused_column, request_i, write_i, site_i, read_site, clear_site};
endmodule
