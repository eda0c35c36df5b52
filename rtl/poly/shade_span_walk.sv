// shade_span_walk: walks along a span: one span in, one pixel token out a clock, as long as there are credits.
//
// The n pixels of a span lie at t = 0, h, 2 h, ... with h = 2^-k, k = ceil(log2(n - 1)): every node of the polynomial
// falls on a pixel, no division is needed, and with n = 2^k + 1 the last pixel is the last node. A span of degree 0
// (direct) gives up to four pixels, pixel j being node j + 1: its tokens carry that node in first place.
//
//   s_axis_span_tdata  node i (0 .. 3) of channel c (0 .. 1), S1.16, at bit 18 (4 c + i); pixels at SPAN_COUNT_LSB;
//                      degree at SPAN_DEGREE_LSB; tag at SPAN_TAG_LSB; SPAN_MORE: this is a record of a span that goes
//                      on in the next one; other bits ignored
//   nodes_o            the same nodes in the same order
//   t_o                U1.16; log2_o = k; first_o, last_o frame the span (no last_o with SPAN_MORE); tag_o is the span's
//   credit_i           gives one credit back; 2^CREDIT_LOG2 are there after reset, a token costs one
//   error_o            sticky, bits ERROR_*: an empty span, one of more than 2^LOG2_MAX pixels, a direct one of more than 4
//   error_count_o      such spans, saturating. They are dropped: they cost one clock and no token.
//
// A token follows its span by 2 clocks; tokens of consecutive spans follow each other without a bubble.
// Example: n = 5, degree 3 -> k = 2, t = 0, 1/4, 1/2, 3/4, 1. Source: P1, section IV (t along the raster line).
module shade_span_walk #(
  parameter int LOG2_MAX    = shade_pkg::LOG2_MAX,
  parameter int CREDIT_LOG2 = shade_pkg::FIFO_LOG2
) (
  input  logic                                   clk_i,
  input  logic                                   rst_i,
  input  logic                                   s_axis_span_tvalid,
  output logic                                   s_axis_span_tready,
  input  logic [     shade_pkg::SPAN_DATA_W-1:0] s_axis_span_tdata,
  input  logic                                   credit_i,
  output logic                                   valid_o,
  output logic                                   first_o,
  output logic                                   last_o,
  output logic [shade_pkg::SPAN_COUNT_LSB-1:0]   nodes_o,
  output logic [        shade_pkg::DEGREE_W-1:0] degree_o,
  output logic [               shade_pkg::T_F:0] t_o,
  output logic [                            3:0] log2_o,
  output logic [           shade_pkg::TAG_W-1:0] tag_o,
  output logic [         shade_pkg::ERROR_W-1:0] error_o,
  output logic [                           15:0] error_count_o
);
  if (LOG2_MAX < 2 || LOG2_MAX > shade_pkg::LOG2_MAX || CREDIT_LOG2 < 1) begin : g_check
    $error("shade_span_walk: LOG2_MAX must be in 2 .. 12 and CREDIT_LOG2 at least 1");
  end

  localparam int NODE_W = shade_pkg::INTENSITY_W;
  localparam int CHANNEL_W = shade_pkg::NODE_COUNT * NODE_W;
  localparam int NODES_W = shade_pkg::SPAN_COUNT_LSB;
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int T_F = shade_pkg::T_F;

  // ---- the span at the door ----------------------------------------------------------------------------------
  logic [COUNT_W-1:0] in_count, in_steps;
  logic [shade_pkg::DEGREE_W-1:0] in_degree;
  logic [3:0] in_log2;
  logic in_direct;
  logic [shade_pkg::ERROR_W-1:0] in_error;
  assign in_count  = s_axis_span_tdata[shade_pkg::SPAN_COUNT_LSB+:COUNT_W];
  assign in_degree = s_axis_span_tdata[shade_pkg::SPAN_DEGREE_LSB+:shade_pkg::DEGREE_W];
  assign in_direct = in_degree == shade_pkg::DEGREE_W'(shade_pkg::DEGREE_DIRECT);

  // k = bits of n - 2: the smallest with n - 1 <= 2^k; 0 for n <= 2
  assign in_steps = in_count < COUNT_W'(2) ? '0 : in_count - COUNT_W'(2);
  always_comb begin
    in_log2 = '0;
    for (int i = 0; i < LOG2_MAX; i++) if (in_steps[i]) in_log2 = 4'(i + 1);
  end

  always_comb begin
    in_error = '0;
    in_error[shade_pkg::ERROR_EMPTY] = in_count == '0;
    in_error[shade_pkg::ERROR_LONG] = in_count > COUNT_W'(1 << LOG2_MAX);
    in_error[shade_pkg::ERROR_DIRECT] = in_direct && in_count > COUNT_W'(shade_pkg::DIRECT_MAX);
  end

  // ---- the span in work --------------------------------------------------------------------------------------
  logic load, issue, first, last;
  shade_walk #(.CREDIT_LOG2(CREDIT_LOG2)) u_walk (
    .clk_i, .rst_i, .valid_i(s_axis_span_tvalid), .ready_o(s_axis_span_tready), .count_i(in_count), .error_i(in_error),
    .credit_i, .load_o(load), .issue_o(issue), .first_o(first), .last_o(last), .error_o, .error_count_o
  );

  logic [NODES_W-1:0] nodes_q, nodes_next;
  logic [shade_pkg::DEGREE_W-1:0] degree_q;
  logic [T_F:0] t_q;
  logic [3:0] log2_q;
  logic [shade_pkg::TAG_W-1:0] tag_q;
  logic more_q, direct;
  assign direct = degree_q == shade_pkg::DEGREE_W'(shade_pkg::DEGREE_DIRECT);

  // direct: the next pixel is the next node of each channel
  for (genvar c = 0; c < shade_pkg::CHANNELS; c++) begin : g_next
    localparam int LSB = c * CHANNEL_W;
    assign nodes_next[LSB+:CHANNEL_W] = CHANNEL_W'(nodes_q[LSB+:CHANNEL_W] >> NODE_W);
  end

  always_ff @(posedge clk_i) begin
    if (load) begin
      nodes_q  <= s_axis_span_tdata[NODES_W-1:0];
      degree_q <= in_degree;
      tag_q    <= s_axis_span_tdata[shade_pkg::SPAN_TAG_LSB+:shade_pkg::TAG_W];
      more_q   <= s_axis_span_tdata[shade_pkg::SPAN_MORE];
      log2_q   <= in_log2;
      t_q      <= '0;
    end else if (issue) begin
      if (direct) nodes_q <= nodes_next;
      t_q <= t_q + ((T_F + 1)'(1 << T_F) >> log2_q);
    end

    // tokens; a direct pixel is a segment of its own
    first_o  <= first || direct;
    last_o   <= last && !more_q;
    nodes_o  <= nodes_q;
    degree_o <= degree_q;
    t_o      <= t_q;
    log2_o   <= log2_q;
    tag_o    <= tag_q;
    valid_o  <= issue;
    if (rst_i) valid_o <= 1'b0;
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, in_steps, s_axis_span_tdata};
endmodule
