// SPDX-License-Identifier: Apache-2.0
// shade_poly_span: a span's node intensities in, its shaded pixels out, one a clock, no bubble between spans.
//
//   span ─▶ shade_span_walk ─ tokens ─▶ shade_coef ─ A, B, C, D ─▶ evaluator ─▶ clamp ─▶ shade_fifo ─▶ pixels
//             ▲                          (for each of the two channels: diffuse, specular)       │
//             └──────────────────────────────── credits ◀────────────────────────────────────────┘
//
//   s_axis_span   AXI4-Stream, one beat a span: nodes of both channels, degree, pixel count, tag (see shade_span_walk)
//   m_axis_pixel  AXI4-Stream, one beat a pixel: tdata = {specular, diffuse}, U0.16 each; tuser = tag; tlast = last pixel
//                 (of the last beat, where a span comes as several: RECORD_MORE)
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
  input  logic [ shade_pkg::RECORD_DATA_W-1:0] s_axis_span_tdata,
  output logic                               m_axis_pixel_tvalid,
  input  logic                               m_axis_pixel_tready,
  output logic [shade_pkg::PIXEL_DATA_W-1:0] m_axis_pixel_tdata,
  output logic [       shade_pkg::TAG_W-1:0] m_axis_pixel_tuser,
  output logic                               m_axis_pixel_tlast
);
  if (EVALUATOR != shade_pkg::EVALUATOR_HORNER && EVALUATOR != shade_pkg::EVALUATOR_FDIFF) begin : g_check
    $error("shade_poly_span: EVALUATOR must be EVALUATOR_HORNER or EVALUATOR_FDIFF");
  end

  localparam bit HORNER = EVALUATOR == shade_pkg::EVALUATOR_HORNER;
  localparam int LATENCY_EVALUATOR = HORNER ? shade_pkg::LATENCY_HORNER_PIPE : shade_pkg::LATENCY_FDIFF;
  localparam int LATENCY_TOKEN = shade_pkg::LATENCY_COEF + LATENCY_EVALUATOR + 1;

  // ---- tokens ------------------------------------------------------------------------------------------------
  logic valid, valid_e, first_e, credit;
  shade_pkg::record_t record;
  shade_pkg::token_t token;
  assign record = s_axis_span_tdata;
  shade_span_walk #(.LOG2_MAX(LOG2_MAX)) u_walk (
    .clk_i, .rst_i, .valid_i(s_axis_span_tvalid), .ready_o(s_axis_span_tready), .record_i(record), .credit_i(credit),
    .valid_o(valid), .token_o(token)
  );

  // what the evaluator needs beside the coefficients
  logic [shade_pkg::T_F:0] t_e;
  logic [shade_pkg::LOG2_W-1:0] log2_e;
  shade_valid #(.DEPTH(shade_pkg::LATENCY_COEF)) u_valid_e (.clk_i, .rst_i, .valid_i(valid), .valid_o(valid_e));
  shade_ring #(.WIDTH($bits(token.first) + $bits(token.log2) + $bits(token.t)), .DEPTH(shade_pkg::LATENCY_COEF)) u_token_e (
    .clk_i, .rst_i, .d_i({token.first, token.log2, token.t}), .q_o({first_e, log2_e, t_e})
  );

  // ---- the two channels --------------------------------------------------------------------------------------
  shade_pkg::drawn_t drawn, given;
  for (genvar c = 0; c < shade_pkg::CHANNELS; c++) begin : g_channel
    shade_pkg::channel_t nodes;
    shade_pkg::coef_t coef;
    logic signed [shade_pkg::VALUE_W-1:0] value;
    logic [shade_pkg::PIXEL_W-1:0] clamped, clamped_q;
    assign nodes = c == 0 ? token.diffuse : token.specular;

    shade_coef #(.NODES(NODES), .FORM(FORM)) u_coef (
      .clk_i, .degree_i(token.degree), .i1_i(nodes.n0), .i2_i(nodes.n1), .i3_i(nodes.n2), .i4_i(nodes.n3),
      .a_o(coef.a), .b_o(coef.b), .c_o(coef.c), .d_o(coef.d)
    );

    if (HORNER) begin : g_horner
      shade_horner_pipe u_horner (
        .clk_i, .a_i(coef.a), .b_i(coef.b), .c_i(coef.c), .d_i(coef.d), .t_i(t_e), .y_o(value)
      );
    end else begin : g_fdiff
      shade_fdiff #(.LOG2_MAX(LOG2_MAX)) u_fdiff (
        .clk_i, .rst_i, .valid_i(valid_e), .first_i(first_e), .a_i(coef.a), .b_i(coef.b), .c_i(coef.c), .d_i(coef.d),
        .log2_i(log2_e), .y_o(value)
      );
    end

    shade_saturate #(.WIDTH(shade_pkg::VALUE_W), .OUT_W(shade_pkg::PIXEL_W)) u_clamp (.x_i(value), .y_o(clamped));
    always_ff @(posedge clk_i) clamped_q <= clamped;
  end
  assign drawn.pixel = {g_channel[1].clamped_q, g_channel[0].clamped_q};

  // ---- out ---------------------------------------------------------------------------------------------------
  logic valid_p;
  shade_valid #(.DEPTH(LATENCY_EVALUATOR + 1)) u_valid_p (.clk_i, .rst_i, .valid_i(valid_e), .valid_o(valid_p));
  shade_ring #(.WIDTH($bits(token.last) + $bits(token.tag)), .DEPTH(LATENCY_TOKEN)) u_token_p (
    .clk_i, .rst_i, .d_i({token.last, token.tag}), .q_o({drawn.last, drawn.tag})
  );
  shade_fifo #(.WIDTH($bits(drawn))) u_fifo (
    .clk_i, .rst_i, .valid_i(valid_p), .data_i(drawn), .valid_o(m_axis_pixel_tvalid), .ready_i(m_axis_pixel_tready),
    .data_o(given), .taken_o(credit)
  );
  assign m_axis_pixel_tdata = given.pixel;
  assign m_axis_pixel_tuser = given.tag;
  assign m_axis_pixel_tlast = given.last;

  logic unused_side;  // of what the other evaluator needs
  assign unused_side = &{1'b0, first_e, log2_e, t_e};
endmodule
