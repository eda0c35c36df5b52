// shade_poly_span: a span's node intensities in, its shaded pixels out, one a clock, no bubble between spans.
//
//   span ─▶ shade_span_walk ─ tokens ─▶ shade_coef ─ A, B, C, D ─▶ evaluator ─▶ clamp ─▶ shade_fifo ─▶ pixels
//             ▲                          (for each of the two channels: diffuse, specular)       │
//             └──────────────────────────────── credits ◀────────────────────────────────────────┘
//
//   s_axis_span   AXI4-Stream, one beat a span: nodes of both channels, degree, pixel count, tag (see shade_span_walk)
//   m_axis_pixel  AXI4-Stream, one beat a pixel: tdata = {specular, diffuse}, U0.16 each; tuser = tag; tlast = last pixel
//                 (of the last beat, where a span comes as several: SPAN_MORE)
//   error_o, error_count_o  see shade_span_walk; a faulty span is dropped and costs one clock
//
// Unclamped inside, so that a terminator puts no kink into a polynomial; clamped to [0, 1 - 2^-16] at the end.
// EVALUATOR_HORNER: six multipliers a channel. EVALUATOR_FDIFF: none. Spans of at most 2^LOG2_MAX pixels.
// Refined, a pixel is off the polynomial through its nodes by the evaluator's 11/16 or 1/2 ulp and 2/(9 sqrt 3) = 0.13 ulp
// of the coefficients: 3 divides 3 A + 3 C, so their roundings are opposite and leave (t - t^3)/3 at most.
// The pipeline never stalls: a pixel is started only with a credit for its place in the FIFO; no combinational path
// leads from an input to an output. Latency span -> first pixel LATENCY_POLY_SPAN_HORNER / _FDIFF.
// Example: degree 1, 3 pixels, nodes 0 and 1/2 (diffuse), 1/4 and 1/4 (specular) -> (0, 1/4), (1/4, 1/4), (1/2, 1/4).
// Source: P1, section IV.
module shade_poly_span #(
  parameter int EVALUATOR = shade_pkg::EVALUATOR_HORNER,
  parameter int NODES     = shade_pkg::NODES_LEFT,
  parameter int FORM      = shade_pkg::FORM_REFINED,
  parameter int LOG2_MAX  = shade_pkg::LOG2_MAX
) (
  input  logic                               clk_i,
  input  logic                               rst_i,
  input  logic                               s_axis_span_tvalid,
  output logic                               s_axis_span_tready,
  input  logic [ shade_pkg::SPAN_DATA_W-1:0] s_axis_span_tdata,
  output logic                               m_axis_pixel_tvalid,
  input  logic                               m_axis_pixel_tready,
  output logic [shade_pkg::PIXEL_DATA_W-1:0] m_axis_pixel_tdata,
  output logic [       shade_pkg::TAG_W-1:0] m_axis_pixel_tuser,
  output logic                               m_axis_pixel_tlast,
  output logic [     shade_pkg::ERROR_W-1:0] error_o,
  output logic [                       15:0] error_count_o
);
  if (EVALUATOR != shade_pkg::EVALUATOR_HORNER && EVALUATOR != shade_pkg::EVALUATOR_FDIFF) begin : g_check
    $error("shade_poly_span: EVALUATOR must be EVALUATOR_HORNER or EVALUATOR_FDIFF");
  end

  localparam bit HORNER = EVALUATOR == shade_pkg::EVALUATOR_HORNER;
  localparam int NODE_W = shade_pkg::INTENSITY_W;
  localparam int CHANNEL_W = shade_pkg::NODE_COUNT * NODE_W;
  localparam int LATENCY_EVALUATOR = HORNER ? shade_pkg::LATENCY_HORNER_PIPE : shade_pkg::LATENCY_FDIFF;
  localparam int LATENCY_TOKEN = shade_pkg::LATENCY_COEF + LATENCY_EVALUATOR + 1;

  // ---- tokens ------------------------------------------------------------------------------------------------
  logic valid, first, last, credit;
  logic [shade_pkg::SPAN_COUNT_LSB-1:0] nodes;
  logic [shade_pkg::DEGREE_W-1:0] degree;
  logic [shade_pkg::T_F:0] t;
  logic [3:0] log2;
  logic [shade_pkg::TAG_W-1:0] tag;
  shade_span_walk #(.LOG2_MAX(LOG2_MAX)) u_walk (
    .clk_i, .rst_i, .s_axis_span_tvalid, .s_axis_span_tready, .s_axis_span_tdata,
    .credit_i(credit), .valid_o(valid), .first_o(first), .last_o(last), .nodes_o(nodes), .degree_o(degree), .t_o(t),
    .log2_o(log2), .tag_o(tag), .error_o, .error_count_o
  );

  // what the evaluator needs beside the coefficients
  logic valid_e, first_e;
  logic [shade_pkg::T_F:0] t_e;
  logic [3:0] log2_e;
  shade_valid #(.DEPTH(shade_pkg::LATENCY_COEF)) u_valid_e (.clk_i, .rst_i, .valid_i(valid), .valid_o(valid_e));
  shade_ring #(.WIDTH(shade_pkg::T_F + 6), .DEPTH(shade_pkg::LATENCY_COEF)) u_token_e (
    .clk_i, .rst_i, .d_i({first, log2, t}), .q_o({first_e, log2_e, t_e})
  );

  // ---- the two channels --------------------------------------------------------------------------------------
  logic [shade_pkg::PIXEL_DATA_W-1:0] pixel;
  for (genvar c = 0; c < shade_pkg::CHANNELS; c++) begin : g_channel
    localparam int LSB = c * CHANNEL_W;
    localparam int PIXEL_LSB = c * shade_pkg::PIXEL_W;
    logic signed [shade_pkg::COEF_W-1:0] ca, cb, cc;
    logic signed [NODE_W-1:0] cd;
    logic signed [shade_pkg::VALUE_W-1:0] value;
    logic [shade_pkg::PIXEL_W-1:0] clamped;

    shade_coef #(.NODES(NODES), .FORM(FORM)) u_coef (
      .clk_i, .rst_i, .valid_i(1'b0), .degree_i(degree),
      .i1_i(nodes[LSB+:NODE_W]), .i2_i(nodes[LSB+NODE_W+:NODE_W]),
      .i3_i(nodes[LSB+NODE_W+NODE_W+:NODE_W]), .i4_i(nodes[LSB+CHANNEL_W-1-:NODE_W]),
      .valid_o(), .a_o(ca), .b_o(cb), .c_o(cc), .d_o(cd)
    );

    if (HORNER) begin : g_horner
      shade_horner_pipe u_horner (
        .clk_i, .rst_i, .valid_i(1'b0), .a_i(ca), .b_i(cb), .c_i(cc), .d_i(cd), .t_i(t_e), .valid_o(), .y_o(value)
      );
    end else begin : g_fdiff
      shade_fdiff #(.LOG2_MAX(LOG2_MAX)) u_fdiff (
        .clk_i, .rst_i, .valid_i(valid_e), .first_i(first_e), .a_i(ca), .b_i(cb), .c_i(cc), .d_i(cd), .log2_i(log2_e),
        .valid_o(), .y_o(value)
      );
    end

    shade_saturate #(.WIDTH(shade_pkg::VALUE_W), .OUT_W(shade_pkg::PIXEL_W)) u_clamp (.x_i(value), .y_o(clamped));
    always_ff @(posedge clk_i) pixel[PIXEL_LSB+:shade_pkg::PIXEL_W] <= clamped;
  end

  // ---- out ---------------------------------------------------------------------------------------------------
  logic valid_p, last_p;
  logic [shade_pkg::TAG_W-1:0] tag_p;
  shade_valid #(.DEPTH(LATENCY_EVALUATOR + 1)) u_valid_p (.clk_i, .rst_i, .valid_i(valid_e), .valid_o(valid_p));
  shade_ring #(.WIDTH(shade_pkg::TAG_W + 1), .DEPTH(LATENCY_TOKEN)) u_token_p (
    .clk_i, .rst_i, .d_i({last, tag}), .q_o({last_p, tag_p})
  );
  shade_fifo #(.WIDTH(shade_pkg::PIXEL_DATA_W + shade_pkg::TAG_W + 1)) u_fifo (
    .clk_i, .rst_i, .valid_i(valid_p), .data_i({last_p, tag_p, pixel}),
    .valid_o(m_axis_pixel_tvalid), .ready_i(m_axis_pixel_tready),
    .data_o({m_axis_pixel_tlast, m_axis_pixel_tuser, m_axis_pixel_tdata}), .taken_o(credit)
  );

  logic unused_side;  // of what the other evaluator needs
  assign unused_side = &{1'b0, first_e, log2_e, t_e};
endmodule
