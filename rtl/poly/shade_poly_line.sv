// SPDX-License-Identifier: Apache-2.0
// shade_poly_line: records in, shaded pixels out, one a clock: shade_poly_span with one coefficient unit for both channels.
//
//   record ─┬─ nodes ─▶ shade_poly_start ─ differences ─▶ shade_poly_state (diffuse) ──────┐
//           │             diffuse, then specular       └─▶ shade_poly_state (specular) ────┴─▶ shade_fifo ─▶ pixels
//           └─ I(0), tag ─▶ shade_ring ───────────────────────────▲                               │
//           ▲────────────────────────────────── credits ◀──────────────────────────────────────────┘
//
//   s_axis_span   AXI4-Stream, one record a beat, as of shade_poly_span: node set left, form refined. A record has at most
//                 2^LOG2_MAX + 1 pixels, a direct one 4; one of degree 1 at least 3, of degree 2 or 3 at least 4: so no start
//                 comes within 2 clocks of another, and the specular channel runs a clock behind the diffuse one
//   m_axis_pixel  AXI4-Stream: {specular, diffuse} U0.16; tuser: tag; tlast: the last pixel of a span
//
// Every bit is that of shade_poly_span[EVALUATOR_FDIFF]: see there, and shade_poly_start, shade_poly_state. s_axis_span_tready
// is high in the clock of a record's last pixel alone: nothing of it is copied. It hangs on tdata, on no other input.
// Latency LATENCY_POLY_LINE = 20 clocks from a record to its first pixel, one pixel a clock, no multiplier.
// Example: degree 1, 3 pixels, nodes 0, 1/2 -> 0, 1/4, 1/2. Source: P1, section IV.
module shade_poly_line #(
  parameter int LOG2_MAX = shade_pkg::RECORD_LOG2
) (
  input  logic                               clk_i,
  input  logic                               rst_i,
  input  logic                               s_axis_span_tvalid,
  output logic                               s_axis_span_tready,
  input  logic [ shade_pkg::RECORD_DATA_W-1:0] s_axis_span_tdata,
  output logic                               m_axis_pixel_tvalid,
  input  logic                               m_axis_pixel_tready,
  output logic [shade_pkg::PIXEL_DATA_W-1:0] m_axis_pixel_tdata,
  output logic [       shade_pkg::TAG_W-1:0] m_axis_pixel_tuser,
  output logic                               m_axis_pixel_tlast
);
  if (LOG2_MAX < 2 || LOG2_MAX > shade_pkg::LOG2_MAX) begin : g_check
    $error("shade_poly_line: LOG2_MAX must be in 2 .. 12");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int INDEX_W = LOG2_MAX + 1;
  localparam int START = shade_pkg::LATENCY_POLY_START;

  // ---- the pixel at hand: number next_q - 1 of the record that waits at the input -----------------------------------
  shade_pkg::record_t record;
  logic issue, first, last, direct, some, unused_soon, credit;
  logic [INDEX_W-1:0] next_q;
  assign record             = s_axis_span_tdata;
  assign direct             = record.head.degree == shade_pkg::DEGREE_W'(shade_pkg::DEGREE_DIRECT);
  assign issue              = s_axis_span_tvalid && some;
  assign first              = next_q == INDEX_W'(1);
  assign last               = next_q == INDEX_W'(record.head.count);
  assign s_axis_span_tready = some && last;
  shade_credit u_credit (
    .clk_i, .rst_i, .take_i(issue), .give_i(credit), .some_o(some), .soon_o(unused_soon)
  );
  always_ff @(posedge clk_i) begin
    if (issue) next_q <= last ? INDEX_W'(1) : next_q + INDEX_W'(1);
    if (rst_i) next_q <= INDEX_W'(1);
  end

  // ---- differences: the diffuse ones from the clock of the first pixel on, the specular ones from the next ---------------
  localparam int WIDTH = W + 2 + 3 * LOG2_MAX;
  logic second_q;
  shade_pkg::channel_t nodes;
  logic signed [WIDTH-1:0] d1, d2, d3;
  assign nodes = second_q ? record.specular : record.diffuse;
  always_ff @(posedge clk_i) second_q <= !rst_i && issue && first && !direct;
  shade_poly_start #(.LOG2_MAX(LOG2_MAX)) u_start (
    .clk_i, .degree_i(record.head.degree), .log2_i(record.head.log2), .nodes_i(nodes), .d1_o(d1), .d2_o(d2), .d3_o(d3)
  );

  // ---- beside them: whether a polynomial begins, its first values, and what goes out with a pixel ---------------------
  // a direct pixel is a beginning of its own
  logic [1:0] node;
  logic [1:0][W-1:0] at;
  logic valid, begins, ends, valid_q, begin_q;
  logic signed [W-1:0] at_diffuse, at_specular, specular_q;
  logic [shade_pkg::TAG_W-1:0] tag;
  assign node = next_q[1:0] - 2'd1;
  for (genvar c = 0; c < shade_pkg::CHANNELS; c++) begin : g_node
    logic [W-1:0] low, high;
    shade_pkg::channel_t lit;
    assign lit   = c == 0 ? record.diffuse : record.specular;
    assign low   = direct && node[0] ? lit.n1 : lit.n0;
    assign high  = node[0] ? lit.n3 : lit.n2;
    assign at[c] = direct && node[1] ? high : low;
  end
  shade_valid #(.DEPTH(START)) u_valid (.clk_i, .rst_i, .valid_i(issue), .valid_o(valid));
  shade_ring #(.WIDTH(2 + shade_pkg::TAG_W + 2 * W), .DEPTH(START), .BLOCK(1)) u_beside (
    .clk_i, .rst_i, .d_i({first || direct, last && !record.head.more, record.head.tag, at}),
    .q_o({begins, ends, tag, at_specular, at_diffuse})
  );
  always_ff @(posedge clk_i) begin
    valid_q    <= !rst_i && valid;
    begin_q    <= begins;
    specular_q <= at_specular;
  end

  // ---- pixels: specular light comes a clock behind the diffuse -------------------------------------------------------
  localparam int STATE = shade_pkg::LATENCY_POLY_STATE;
  logic [shade_pkg::PIXEL_W-1:0] pixel, pixel_q;
  shade_pkg::drawn_t drawn, given;
  shade_poly_state #(.LOG2_MAX(LOG2_MAX)) u_diffuse (
    .clk_i, .valid_i(valid), .begin_i(begins), .node_i(at_diffuse), .d1_i(d1), .d2_i(d2), .d3_i(d3), .pixel_o(pixel)
  );
  shade_poly_state #(.LOG2_MAX(LOG2_MAX)) u_specular (
    .clk_i, .valid_i(valid_q), .begin_i(begin_q), .node_i(specular_q), .d1_i(d1), .d2_i(d2), .d3_i(d3),
    .pixel_o(drawn.pixel.specular)
  );
  always_ff @(posedge clk_i) pixel_q <= pixel;
  assign drawn.pixel.diffuse = pixel_q;

  logic drawn_valid;
  shade_valid #(.DEPTH(STATE + 1)) u_drawn (.clk_i, .rst_i, .valid_i(valid), .valid_o(drawn_valid));
  shade_delay #(.WIDTH(1 + shade_pkg::TAG_W), .DEPTH(STATE + 1)) u_tag (
    .clk_i, .d_i({ends, tag}), .q_o({drawn.last, drawn.tag})
  );
  shade_fifo #(.WIDTH($bits(drawn)), .BLOCK(1)) u_fifo (
    .clk_i, .rst_i, .valid_i(drawn_valid), .data_i(drawn), .valid_o(m_axis_pixel_tvalid), .ready_i(m_axis_pixel_tready),
    .data_o(given), .taken_o(credit)
  );
  assign m_axis_pixel_tdata = given.pixel;
  assign m_axis_pixel_tuser = given.tag;
  assign m_axis_pixel_tlast = given.last;

  logic legal;  // the caller's duty
  assign legal = record.head.count != '0 && record.head.count <= shade_pkg::COUNT_W'(direct ? 4 : (1 << LOG2_MAX) + 1) &&
                 (direct || record.head.log2 >= (record.head.degree == 2'd1 ? 4'd1 : 4'd2));
  shade_assert u_legal (.clk_i, .rst_i, .holds_i(!s_axis_span_tvalid || legal));

  logic unused_bits;
  assign unused_bits = &{1'b0, record, legal};
endmodule
