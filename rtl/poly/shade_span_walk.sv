// SPDX-License-Identifier: Apache-2.0
// shade_span_walk: walks along a record: one record in, one pixel token out a clock, as long as there are credits.
//
// The n pixels of a record lie at t = 0, h, 2 h, ... with h = 2^-log2, n - 1 <= 2^log2: every node of the polynomial
// falls on a pixel, no division is needed, and with n = 2^log2 + 1 the last pixel is the last node. A record of degree 0
// (direct) gives up to four pixels, pixel j being node j: its tokens carry that node in first place.
//
//   record_i   1 .. 2^LOG2_MAX pixels, a direct one at most 4: the caller's duty, simulation stops where it is not so
//   token_o    nodes, degree, log2 and tag of the record; t, U1.16; first, last frame the record (no last with more)
//   credit_i   gives one credit back; 2^CREDIT_LOG2 are there after reset, a token costs one
//
// A token follows its record by 2 clocks; tokens of consecutive records follow each other without a bubble.
// Example: n = 5, degree 3, log2 = 2 -> t = 0, 1/4, 1/2, 3/4, 1. Source: P1, section IV (t along the raster line).
module shade_span_walk #(
  parameter int LOG2_MAX    = shade_pkg::LOG2_MAX,
  parameter int CREDIT_LOG2 = shade_pkg::FIFO_LOG2
) (
  input  logic               clk_i,
  input  logic               rst_i,
  input  logic               valid_i,
  output logic               ready_o,
  input  shade_pkg::record_t record_i,
  input  logic               credit_i,
  output logic               valid_o,
  output shade_pkg::token_t  token_o
);
  if (LOG2_MAX < 2 || LOG2_MAX > shade_pkg::LOG2_MAX) begin : g_check
    $error("shade_span_walk: LOG2_MAX must be in 2 .. 12");
  end

  localparam int T_F = shade_pkg::T_F;
  localparam int COUNT_W = shade_pkg::COUNT_W;

  logic load, issue, first, last;
  shade_walk #(.CREDIT_LOG2(CREDIT_LOG2)) u_walk (
    .clk_i, .rst_i, .valid_i, .ready_o, .count_i(record_i.head.count), .credit_i, .load_o(load), .issue_o(issue),
    .first_o(first), .last_o(last)
  );

  // the record in work; direct: the next pixel is the next node of each channel
  shade_pkg::channel_t diffuse_q, specular_q;
  shade_pkg::head_t head_q;
  logic [T_F:0] t_q;
  logic direct, direct_i;
  assign direct   = head_q.degree == shade_pkg::DEGREE_W'(shade_pkg::DEGREE_DIRECT);
  assign direct_i = record_i.head.degree == shade_pkg::DEGREE_W'(shade_pkg::DEGREE_DIRECT);
  always_ff @(posedge clk_i) begin
    if (load) begin
      diffuse_q  <= record_i.diffuse;
      specular_q <= record_i.specular;
      head_q     <= record_i.head;
      t_q        <= '0;
    end else if (issue) begin
      if (direct) begin
        diffuse_q  <= diffuse_q >> shade_pkg::INTENSITY_W;
        specular_q <= specular_q >> shade_pkg::INTENSITY_W;
      end
      t_q <= t_q + ((T_F + 1)'(1 << T_F) >> head_q.log2);
    end

    token_o.diffuse  <= diffuse_q;
    token_o.specular <= specular_q;
    token_o.degree   <= head_q.degree;
    token_o.first    <= first || direct;  // a direct pixel is a segment of its own
    token_o.last     <= last && !head_q.more;
    token_o.t        <= t_q;
    token_o.log2     <= head_q.log2;
    token_o.tag      <= head_q.tag;
    valid_o          <= issue;
    if (rst_i) valid_o <= 1'b0;
  end

  logic legal;
  assign legal = record_i.head.count <= COUNT_W'(direct_i ? shade_pkg::DIRECT_MAX : 1 << LOG2_MAX);
  shade_assert u_long (.clk_i, .rst_i, .holds_i(!load || legal));

  logic unused_bits;
  assign unused_bits = &{1'b0, record_i, head_q, legal};
endmodule
