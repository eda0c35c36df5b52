// SPDX-License-Identifier: Apache-2.0
// shade_pixel_normals: a line of interpolated normals in, its unit normals out, one a clock, by P4's method.
//
//   pixel 0, 2, 4, ... and the last one  E: interpolated and normalized exactly
//   the others                           M = (E left + E right) s: no root; no error accumulates
//
//   variant_i          s
//   VARIANT_REFINED    InvC, anchored            VARIANT_V1, _V2   InvC1, InvC2 where d1a < threshold, else 1/2
//   VARIANT_V3, _V6    1/2, the mean             VARIANT_V4, _V5   InvC1, InvC2 where d2 < threshold, else 1/2
//   VARIANT_EXACT      every pixel normalized
//
// c of d2 and InvC is the cosine of the two neighbours; c of d1a that of the line's ends, given with the line.
// An odd pixel steps two increments and normalizes its right neighbour; the next pixel, even, has it already. So the
// normalizer works on every other clock, and the right neighbour is there whatever the gaps.
//
//   s_axis_line    normal and increment, S2.29; pixels at SPAN_COUNT_LSB, 1 .. 4096; tag; cosine of the ends, S1.16
//   m_axis_normal  tdata = x, y, z, S1.16, at bit 0, 18, 36; tuser = tag; tlast = last of the line
//   variant_i, threshold_i  taken with each line; the threshold is S1.16 in [0, 1]
//
//   line ─▶ shade_walk ─▶ shade_increment ─▶ shade_normalize ─▶ E ─┬─▶ shade_factor ─▶ s ─┐
//                                                                   └────▶ shade_bisect ◀──┴─▶ shade_fifo
//
// An even pixel goes the same way: (E + E) / 2 = E. Latency line -> first normal LATENCY_PIXEL_NORMALS clocks; the pipeline
// never stalls (credits), no combinational path leads from an input to an output.
// Example: (0, 0, 1), increment 0, 2 pixels -> (0, 0, 1), (0, 0, 1). Source: P4, results, Fig. 2, Table 1.
module shade_pixel_normals (
  input  logic                                     clk_i,
  input  logic                                     rst_i,
  input  logic        [  shade_pkg::VARIANT_W-1:0] variant_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] threshold_i,
  input  logic                                     s_axis_line_tvalid,
  output logic                                     s_axis_line_tready,
  input  logic        [shade_pkg::SPAN_DATA_W-1:0] s_axis_line_tdata,
  output logic                                     m_axis_normal_tvalid,
  input  logic                                     m_axis_normal_tready,
  output logic        [shade_pkg::NORMAL_DATA_W-1:0] m_axis_normal_tdata,
  output logic        [      shade_pkg::TAG_W-1:0] m_axis_normal_tuser,
  output logic                                     m_axis_normal_tlast
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int VARIANT_W = shade_pkg::VARIANT_W;
  localparam int TO_UNIT = shade_pkg::LATENCY_INCREMENT + shade_pkg::LATENCY_NORMALIZE;
  localparam int TO_PAIR = TO_UNIT + 1;
  localparam int TO_END = TO_PAIR + shade_pkg::LATENCY_MIDDLE;

  // ---- lines ---------------------------------------------------------------------------------------------------
  shade_pkg::span_t line, line_q1, line_q2;
  logic load, issue, first, last, credit, odd_q1, exact;
  logic [VARIANT_W-1:0] variant_q1, variant_q2;
  logic signed [W-1:0] threshold_q1, threshold_q2;
  assign line = s_axis_line_tdata;
  shade_walk #(.CREDIT_LOG2(shade_pkg::NORMAL_FIFO_LOG2)) u_walk (
    .clk_i, .rst_i, .valid_i(s_axis_line_tvalid), .ready_o(s_axis_line_tready), .count_i(line.count),
    .credit_i(credit), .load_o(load), .issue_o(issue), .first_o(first), .last_o(last)
  );
  assign exact = variant_q1 == VARIANT_W'(shade_pkg::VARIANT_EXACT);
  always_ff @(posedge clk_i) begin
    if (load) begin
      line_q1      <= line;
      variant_q1   <= variant_i;
      threshold_q1 <= threshold_i;
      odd_q1       <= 1'b0;
    end else if (issue) begin
      odd_q1 <= !odd_q1;
    end
  end

  // ---- pixels: the normalizer works for the fresh ones ---------------------------------------------------------------
  logic valid_q2, first_q2, last_q2, middle_q2, fresh_q2, single_q2;
  logic [COUNT_W-1:0] sectors_q2;
  always_ff @(posedge clk_i) begin
    valid_q2     <= !rst_i && issue;
    fresh_q2     <= !rst_i && issue && (first || odd_q1 || exact);
    first_q2     <= first;
    last_q2      <= last;
    middle_q2    <= odd_q1 && !last && !exact;
    single_q2    <= last || exact;
    line_q2      <= line_q1;
    variant_q2   <= variant_q1;
    threshold_q2 <= threshold_q1;
    sectors_q2   <= line_q1.count - COUNT_W'(1);
  end

  // two increments to the right neighbour, one to the pixel itself
  shade_pkg::step_t step;
  shade_pkg::vec_t n, e;
  logic fresh_e, unused_zero;
  assign step.x = single_q2 ? line_q2.increment.x : line_q2.increment.x <<< 1;
  assign step.y = single_q2 ? line_q2.increment.y : line_q2.increment.y <<< 1;
  assign step.z = single_q2 ? line_q2.increment.z : line_q2.increment.z <<< 1;
  shade_increment u_increment (
    .clk_i, .valid_i(fresh_q2), .first_i(first_q2), .line_i(1'b0), .n_i(line_q2.normal), .g_i(step), .l_i('0), .n_o(n)
  );
  shade_normalize u_normalize (.clk_i, .rst_i, .v_i(n), .n_o(e), .zero_o(unused_zero));
  shade_valid #(.DEPTH(TO_UNIT)) u_fresh_e (.clk_i, .rst_i, .valid_i(fresh_q2), .valid_o(fresh_e));

  // ---- the two neighbours of every pixel -----------------------------------------------------------------------
  logic valid_e, middle_e, valid_m, middle_m;
  shade_pkg::vec_t held_q, a_m, b_m;
  shade_valid #(.DEPTH(TO_UNIT)) u_valid_e (.clk_i, .rst_i, .valid_i(valid_q2), .valid_o(valid_e));
  shade_delay #(.WIDTH(1), .DEPTH(TO_UNIT)) u_middle_e (.clk_i, .d_i(middle_q2), .q_o(middle_e));
  always_ff @(posedge clk_i) begin
    if (fresh_e) held_q <= e;
    a_m      <= middle_e || !fresh_e ? held_q : e;
    b_m      <= fresh_e ? e : held_q;
    middle_m <= middle_e;
    valid_m  <= !rst_i && valid_e;
  end

  // ---- the factor: d1a belongs to the line, d2 to the pixel ----------------------------------------------------------
  shade_pkg::metric_t metric;
  shade_pkg::choice_t choice_m;
  logic [shade_pkg::INVC_F-1:0] factor;
  shade_metric u_metric (
    .clk_i, .c_i(line_q2.cosine), .m_i(sectors_q2), .threshold_i(threshold_q2), .metric_o(metric)
  );
  shade_delay #(.WIDTH(1), .DEPTH(TO_PAIR - shade_pkg::LATENCY_METRIC)) u_needs_d1 (
    .clk_i, .d_i(metric.needs_d1), .q_o(choice_m.needs_d1)
  );
  shade_ring #(.WIDTH(VARIANT_W + W), .DEPTH(TO_PAIR)) u_choice (
    .clk_i, .rst_i, .d_i({variant_q2, threshold_q2}), .q_o({choice_m.variant, choice_m.threshold})
  );
  assign choice_m.middle = middle_m;
  shade_factor u_factor (.clk_i, .rst_i, .a_i(a_m), .b_i(b_m), .choice_i(choice_m), .factor_o(factor));

  // ---- out -----------------------------------------------------------------------------------------------------
  logic valid_p, last_p;
  logic [shade_pkg::TAG_W-1:0] tag_p;
  shade_pkg::vec_t normal_p, normal;
  shade_bisect #(.WAIT(shade_pkg::LATENCY_FACTOR_S)) u_bisect (
    .clk_i, .rst_i, .a_i(a_m), .b_i(b_m), .invc_i(factor), .n_o(normal_p)
  );
  shade_valid #(.DEPTH(shade_pkg::LATENCY_MIDDLE)) u_valid_p (.clk_i, .rst_i, .valid_i(valid_m), .valid_o(valid_p));
  shade_ring #(.WIDTH(1 + $bits(tag_p)), .DEPTH(TO_END)) u_token_p (
    .clk_i, .rst_i, .d_i({last_q2, line_q2.tag}), .q_o({last_p, tag_p})
  );
  shade_fifo #(.WIDTH(1 + $bits(tag_p) + $bits(normal_p)), .LOG2(shade_pkg::NORMAL_FIFO_LOG2)) u_fifo (
    .clk_i, .rst_i, .valid_i(valid_p), .data_i({last_p, tag_p, normal_p}),
    .valid_o(m_axis_normal_tvalid), .ready_i(m_axis_normal_tready),
    .data_o({m_axis_normal_tlast, m_axis_normal_tuser, normal}), .taken_o(credit)
  );
  assign m_axis_normal_tdata = shade_pkg::NORMAL_DATA_W'(normal);

  logic unused_bits;
  assign unused_bits = &{1'b0, line_q2, metric};
endmodule
