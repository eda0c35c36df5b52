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
//   s_axis_line    normal and increment, S2.29; pixels at LINE_COUNT_LSB, 1 .. 4096; tag; cosine of the ends, S1.16
//   m_axis_normal  tdata = x, y, z, S1.16, at bit 0, 18, 36; tuser = tag; tlast = last of the line
//   variant_i, threshold_i  taken with each line; the threshold is S1.16 in [0, 1]
//   error_o, error_count_o  ERROR_EMPTY, _LONG: dropped and counted; LINE_ERROR_METRIC, _THRESHOLD: clamped
//
//   line ─▶ shade_walk ─▶ shade_increment ─▶ shade_normalize ─▶ E ─┬─▶ shade_dot3 ─▶ shade_invc ─▶ s ─┐
//                                                                   └────────────▶ shade_bisect ◀──────┴─▶ shade_fifo
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
  input  logic        [shade_pkg::LINE_DATA_W-1:0] s_axis_line_tdata,
  output logic                                     m_axis_normal_tvalid,
  input  logic                                     m_axis_normal_tready,
  output logic        [shade_pkg::NORMAL_DATA_W-1:0] m_axis_normal_tdata,
  output logic        [      shade_pkg::TAG_W-1:0] m_axis_normal_tuser,
  output logic                                     m_axis_normal_tlast,
  output logic        [shade_pkg::LINE_ERROR_W-1:0] error_o,
  output logic        [                      15:0] error_count_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int V_W = W + W + W;
  localparam int STEP_W = shade_pkg::STEP_W;
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int TAG_W = shade_pkg::TAG_W;
  localparam int VARIANT_W = shade_pkg::VARIANT_W;
  localparam int TO_UNIT = shade_pkg::LATENCY_INCREMENT + shade_pkg::LATENCY_NORMALIZE;
  localparam int TO_FACTOR = shade_pkg::LATENCY_DOT3 + shade_pkg::LATENCY_INVC + 1;
  localparam int TO_END = 1 + shade_pkg::LATENCY_MIDDLE;
  localparam int LINE_W = shade_pkg::LINE_COUNT_LSB;

  // ---- lines ---------------------------------------------------------------------------------------------------
  logic [COUNT_W-1:0] in_count;
  logic [1:0] in_error, walk_error;
  logic load, issue, first, last, credit;
  assign in_count = s_axis_line_tdata[shade_pkg::LINE_COUNT_LSB+:COUNT_W];
  always_comb begin
    in_error = '0;
    in_error[shade_pkg::ERROR_EMPTY] = in_count == '0;
    in_error[shade_pkg::ERROR_LONG] = in_count > COUNT_W'(shade_pkg::PIXELS_MAX);
  end
  shade_walk #(.ERROR_W(2), .CREDIT_LOG2(shade_pkg::NORMAL_FIFO_LOG2)) u_walk (
    .clk_i, .rst_i, .valid_i(s_axis_line_tvalid), .ready_o(s_axis_line_tready), .count_i(in_count), .error_i(in_error),
    .credit_i(credit), .load_o(load), .issue_o(issue), .first_o(first), .last_o(last), .error_o(walk_error),
    .error_count_o
  );

  logic [LINE_W-1:0] line_q1;
  logic [TAG_W-1:0] tag_q1;
  logic [VARIANT_W-1:0] variant_q1;
  logic signed [W-1:0] threshold_q1, cos_q1;
  logic [COUNT_W-1:0] sectors_q1;
  logic odd_q1;
  always_ff @(posedge clk_i) begin
    if (load) begin
      line_q1      <= s_axis_line_tdata[LINE_W-1:0];
      tag_q1       <= s_axis_line_tdata[shade_pkg::LINE_TAG_LSB+:TAG_W];
      cos_q1       <= s_axis_line_tdata[shade_pkg::LINE_COS_LSB+:W];
      sectors_q1   <= in_count - COUNT_W'(1);
      variant_q1   <= variant_i;
      threshold_q1 <= threshold_i;
      odd_q1       <= 1'b0;
    end else if (issue) begin
      odd_q1 <= !odd_q1;
    end
  end

  // ---- pixels --------------------------------------------------------------------------------------------------
  // fresh: the normalizer works for this pixel
  logic valid_q2, first_q2, last_q2, odd_q2, fresh_q2, single_q2;
  logic [LINE_W-1:0] line_q2;
  logic [TAG_W-1:0] tag_q2;
  logic [VARIANT_W-1:0] variant_q2;
  logic signed [W-1:0] threshold_q2, cos_q2;
  logic [COUNT_W-1:0] sectors_q2;
  logic exact;
  assign exact = variant_q1 == VARIANT_W'(shade_pkg::VARIANT_EXACT);
  always_ff @(posedge clk_i) begin
    valid_q2     <= issue;
    fresh_q2     <= issue && (first || odd_q1 || exact);
    first_q2     <= first;
    last_q2      <= last;
    odd_q2       <= odd_q1 && !last && !exact;
    single_q2    <= last || exact;
    line_q2      <= line_q1;
    tag_q2       <= tag_q1;
    variant_q2   <= variant_q1;
    threshold_q2 <= threshold_q1;
    cos_q2       <= cos_q1;
    sectors_q2   <= sectors_q1;
    if (rst_i) begin
      valid_q2 <= 1'b0;
      fresh_q2 <= 1'b0;
    end
  end

  // two increments to the right neighbour, one to the pixel itself
  logic signed [STEP_W-1:0] gx, gy, gz;
  logic signed [W-1:0] nx, ny, nz, ex, ey, ez;
  logic fresh_n, fresh_e;
  assign gx = single_q2 ? line_q2[3*STEP_W+:STEP_W] : line_q2[3*STEP_W+:STEP_W] <<< 1;
  assign gy = single_q2 ? line_q2[4*STEP_W+:STEP_W] : line_q2[4*STEP_W+:STEP_W] <<< 1;
  assign gz = single_q2 ? line_q2[5*STEP_W+:STEP_W] : line_q2[5*STEP_W+:STEP_W] <<< 1;
  shade_increment u_increment (
    .clk_i, .rst_i, .valid_i(fresh_q2), .first_i(first_q2), .line_i(1'b0),
    .xn_i(line_q2[0+:STEP_W]), .yn_i(line_q2[STEP_W+:STEP_W]), .zn_i(line_q2[2*STEP_W+:STEP_W]),
    .xg_i(gx), .yg_i(gy), .zg_i(gz), .xl_i('0), .yl_i('0), .zl_i('0),
    .valid_o(fresh_n), .x_o(nx), .y_o(ny), .z_o(nz)
  );
  shade_normalize u_normalize (
    .clk_i, .rst_i, .valid_i(fresh_n), .x_i(nx), .y_i(ny), .z_i(nz), .valid_o(fresh_e), .x_o(ex), .y_o(ey), .z_o(ez),
    .zero_o()
  );

  // ---- the two neighbours of every pixel -----------------------------------------------------------------------
  logic valid_e, odd_e, valid_m;
  logic [VARIANT_W-1:0] variant_e, variant_m;
  logic [V_W-1:0] e, held_q, a_m, b_m;
  logic odd_m;
  shade_valid #(.DEPTH(TO_UNIT)) u_valid_e (.clk_i, .rst_i, .valid_i(valid_q2), .valid_o(valid_e));
  shade_ring #(.WIDTH(1 + VARIANT_W), .DEPTH(TO_UNIT)) u_token_e (
    .clk_i, .rst_i, .d_i({odd_q2, variant_q2}), .q_o({odd_e, variant_e})
  );
  assign e = {ez, ey, ex};
  always_ff @(posedge clk_i) begin
    if (fresh_e) held_q <= e;
    a_m       <= odd_e || !fresh_e ? held_q : e;
    b_m       <= fresh_e ? e : held_q;
    odd_m     <= odd_e;
    variant_m <= variant_e;
    valid_m   <= valid_e;
    if (rst_i) valid_m <= 1'b0;
  end

  // ---- the factor ----------------------------------------------------------------------------------------------
  logic signed [shade_pkg::DOT_W-1:0] dot;
  logic signed [W-1:0] cosine;
  shade_dot3 u_dot (
    .clk_i, .rst_i, .valid_i(1'b0), .ax_i(a_m[0+:W]), .ay_i(a_m[W+:W]), .az_i(a_m[W+W+:W]),
    .bx_i(b_m[0+:W]), .by_i(b_m[W+:W]), .bz_i(b_m[W+W+:W]), .valid_o(), .d_o(dot)
  );
  assign cosine = W'(dot);  // of unit vectors: within 1 + 4 ulp

  logic [shade_pkg::INVC_F-1:0] invc1, invc2, invc, factor_q;
  shade_invc #(.FORM(shade_pkg::FORM_PAPER), .DEGREE(1)) u_invc1 (
    .clk_i, .rst_i, .valid_i(1'b0), .c_i(cosine), .valid_o(), .clamped_o(), .invc_o(invc1), .half_o()
  );
  shade_invc #(.FORM(shade_pkg::FORM_PAPER), .DEGREE(2)) u_invc2 (
    .clk_i, .rst_i, .valid_i(1'b0), .c_i(cosine), .valid_o(), .clamped_o(), .invc_o(invc2), .half_o()
  );
  shade_invc u_invc (
    .clk_i, .rst_i, .valid_i(1'b0), .c_i(cosine), .valid_o(), .clamped_o(), .invc_o(invc), .half_o()
  );

  // d1a belongs to the line, d2 to the pixel
  logic needs_d1, needs_d1_f, needs_d2, needs_d2_f, odd_f, m_error, threshold_error, metric_valid;
  logic signed [W-1:0] threshold_f;
  logic [VARIANT_W-1:0] variant_f, variant_t;
  shade_metric u_metric_line (
    .clk_i, .rst_i, .valid_i(valid_q2 && first_q2), .c_i(cos_q2), .m_i(sectors_q2), .threshold_i(threshold_q2),
    .valid_o(metric_valid), .d1a_o(), .d2_o(), .needs_d1_o(needs_d1), .needs_d2_o(), .clamped_o(), .m_error_o(m_error),
    .threshold_error_o(threshold_error)
  );
  shade_delay #(.WIDTH(VARIANT_W), .DEPTH(shade_pkg::LATENCY_METRIC)) u_variant_t (
    .clk_i, .d_i(variant_q2), .q_o(variant_t)
  );
  shade_delay #(.WIDTH(1), .DEPTH(TO_UNIT + TO_FACTOR - shade_pkg::LATENCY_METRIC)) u_needs_d1 (
    .clk_i, .d_i(needs_d1), .q_o(needs_d1_f)
  );
  shade_ring #(.WIDTH(W), .DEPTH(TO_UNIT + 1 + shade_pkg::LATENCY_DOT3)) u_threshold (
    .clk_i, .rst_i, .d_i(threshold_q2), .q_o(threshold_f)
  );
  shade_metric u_metric_pixel (
    .clk_i, .rst_i, .valid_i(1'b0), .c_i(cosine), .m_i(COUNT_W'(shade_pkg::METRIC_M_MIN)), .threshold_i(threshold_f),
    .valid_o(), .d1a_o(), .d2_o(), .needs_d1_o(), .needs_d2_o(needs_d2), .clamped_o(), .m_error_o(),
    .threshold_error_o()
  );
  shade_delay #(.WIDTH(1), .DEPTH(shade_pkg::LATENCY_INVC - shade_pkg::LATENCY_METRIC)) u_needs_d2 (
    .clk_i, .d_i(needs_d2), .q_o(needs_d2_f)
  );
  shade_ring #(.WIDTH(1 + VARIANT_W), .DEPTH(TO_FACTOR - 1)) u_token_f (
    .clk_i, .rst_i, .d_i({odd_m, variant_m}), .q_o({odd_f, variant_f})
  );
  always_ff @(posedge clk_i) begin
    factor_q <= shade_pkg::INVC_F'(1 << (shade_pkg::INVC_F - 1));
    if (odd_f) begin
      case (variant_f)
        VARIANT_W'(shade_pkg::VARIANT_REFINED): factor_q <= invc;
        VARIANT_W'(shade_pkg::VARIANT_V1):      if (needs_d1_f) factor_q <= invc1;
        VARIANT_W'(shade_pkg::VARIANT_V2):      if (needs_d1_f) factor_q <= invc2;
        VARIANT_W'(shade_pkg::VARIANT_V4):      if (needs_d2_f) factor_q <= invc1;
        VARIANT_W'(shade_pkg::VARIANT_V5):      if (needs_d2_f) factor_q <= invc2;
        default: ;
      endcase
    end
  end

  // ---- out -----------------------------------------------------------------------------------------------------
  logic signed [W-1:0] rx, ry, rz;
  logic valid_p, last_p;
  logic [TAG_W-1:0] tag_p;
  shade_bisect #(.WAIT(TO_FACTOR)) u_bisect (
    .clk_i, .rst_i, .valid_i(valid_m), .ax_i(a_m[0+:W]), .ay_i(a_m[W+:W]), .az_i(a_m[W+W+:W]),
    .bx_i(b_m[0+:W]), .by_i(b_m[W+:W]), .bz_i(b_m[W+W+:W]), .invc_i(factor_q),
    .valid_o(valid_p), .x_o(rx), .y_o(ry), .z_o(rz)
  );
  shade_ring #(.WIDTH(TAG_W + 1), .DEPTH(TO_UNIT + TO_END)) u_token_p (
    .clk_i, .rst_i, .d_i({last_q2, tag_q2}), .q_o({last_p, tag_p})
  );
  logic [V_W-1:0] normal;
  shade_fifo #(.WIDTH(V_W + TAG_W + 1), .LOG2(shade_pkg::NORMAL_FIFO_LOG2)) u_fifo (
    .clk_i, .rst_i, .valid_i(valid_p), .data_i({last_p, tag_p, rz, ry, rx}),
    .valid_o(m_axis_normal_tvalid), .ready_i(m_axis_normal_tready),
    .data_o({m_axis_normal_tlast, m_axis_normal_tuser, normal}), .taken_o(credit)
  );
  assign m_axis_normal_tdata = shade_pkg::NORMAL_DATA_W'(normal);

  logic metric_error_q, threshold_error_q, asks_d1;
  assign asks_d1 = variant_t == VARIANT_W'(shade_pkg::VARIANT_V1) || variant_t == VARIANT_W'(shade_pkg::VARIANT_V2);
  always_ff @(posedge clk_i) begin
    if (metric_valid && m_error && asks_d1) metric_error_q <= 1'b1;
    if (metric_valid && threshold_error) threshold_error_q <= 1'b1;
    if (rst_i) begin
      metric_error_q    <= 1'b0;
      threshold_error_q <= 1'b0;
    end
  end
  assign error_o = {threshold_error_q, metric_error_q, walk_error};

  logic unused_bits;
  assign unused_bits = &{1'b0, s_axis_line_tdata, dot};
endmodule
