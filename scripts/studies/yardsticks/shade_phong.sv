// SPDX-License-Identifier: Apache-2.0
// shade_phong: the yardstick: a unit normal and light at every pixel, exactly, without any of the papers' ideas.
//
//   span ─▶ shade_walk ─▶ shade_increment ─▶ shade_normalize ─▶ shade_light ─▶ clamp ─▶ shade_fifo ─▶ m_axis_pixel
//
//   s_axis_span    SPAN packet: normal and increment, S2.29; 1 .. 4096 pixels; tag
//   m_axis_pixel   tdata = {specular, diffuse}, U0.16; tuser = tag; tlast = last pixel of the span
//   draw_i         settings of the draw call, material and light, see docs/registers.md; must not change while a span is
//                  inside
//
// What shade_lane is measured against: the same packets, and the pixels that it comes close to. FORM, REFLECT, DIVIDE: see
// shade_light. The pipeline never stalls: a pixel starts with a credit for its place in the FIFO; no combinational path leads
// from an input to an output. One pixel a clock, no bubble between spans. Latency LATENCY_PHONG = 86 clocks from a span to
// its first pixel, REFLECT = 0: fewer by LATENCY_REFLECT.
// Example: normal (0, 0, 1), increment 0, 5 pixels, light from the viewer -> five pixels of full intensity.
module shade_phong #(
  parameter int FORM    = shade_pkg::FORM_REFINED,
  parameter int REFLECT = 1,
  parameter int DIVIDE  = 1
) (
  input  logic                               clk_i,
  input  logic                               rst_i,
  input  shade_pkg::draw_t                   draw_i,
  input  logic                               s_axis_span_tvalid,
  output logic                               s_axis_span_tready,
  input  logic [ shade_pkg::SPAN_DATA_W-1:0] s_axis_span_tdata,
  output logic                               m_axis_pixel_tvalid,
  input  logic                               m_axis_pixel_tready,
  output logic [shade_pkg::PIXEL_DATA_W-1:0] m_axis_pixel_tdata,
  output logic [       shade_pkg::TAG_W-1:0] m_axis_pixel_tuser,
  output logic                               m_axis_pixel_tlast
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int FIFO_LOG2 = shade_pkg::PHONG_FIFO_LOG2;

  // ---- spans ---------------------------------------------------------------------------------------------------
  shade_pkg::span_t span, span_q;
  logic load, issue, first, last, credit;
  assign span = s_axis_span_tdata;
  shade_walk #(.CREDIT_LOG2(FIFO_LOG2)) u_walk (
    .clk_i, .rst_i, .valid_i(s_axis_span_tvalid), .ready_o(s_axis_span_tready), .count_i(span.count),
    .credit_i(credit), .load_o(load), .issue_o(issue), .first_o(first), .last_o(last)
  );

  always_ff @(posedge clk_i) if (load) span_q <= span;

  // ---- normals and light of the pixels ---------------------------------------------------------------------------
  logic valid_e, valid_l, unused_zero;
  shade_pkg::vec_t n, e;
  shade_pkg::intensity_t light;
  shade_pkg::flags_t unused_flags;
  shade_increment u_increment (
    .clk_i, .valid_i(issue), .first_i(first), .line_i(1'b0), .n_i(span_q.normal), .g_i(span_q.increment), .l_i('0),
    .n_o(n)
  );
  shade_normalize u_normalize (.clk_i, .rst_i, .v_i(n), .n_o(e), .zero_o(unused_zero));
  shade_valid #(.DEPTH(shade_pkg::LATENCY_INCREMENT + shade_pkg::LATENCY_NORMALIZE)) u_valid_e (
    .clk_i, .rst_i, .valid_i(issue), .valid_o(valid_e)
  );
  shade_light #(.FORM(FORM), .REFLECT(REFLECT), .DIVIDE(DIVIDE)) u_light (
    .clk_i, .rst_i, .phase_i(shade_pkg::PHASE_W'(0)), .material_i(draw_i.material), .light_i(draw_i.light),
    .valid_i(valid_e), .n_i(e), .valid_o(valid_l), .light_o(light), .flags_o(unused_flags)
  );

  // ---- pixels ----------------------------------------------------------------------------------------------------
  localparam int PIXEL_W = shade_pkg::PIXEL_W;
  logic valid_q, unused_there, unused_taken;
  shade_pkg::pixel_t pixel, pixel_q;
  shade_saturate #(.WIDTH(W), .OUT_W(PIXEL_W)) u_diffuse (.x_i(light.diffuse), .y_o(pixel.diffuse));
  shade_saturate #(.WIDTH(W), .OUT_W(PIXEL_W)) u_specular (.x_i(light.specular), .y_o(pixel.specular));
  always_ff @(posedge clk_i) begin
    pixel_q <= pixel;
    valid_q <= valid_l;
    if (rst_i) valid_q <= 1'b0;
  end
  shade_fifo #(.WIDTH($bits(pixel)), .LOG2(FIFO_LOG2)) u_pixels (
    .clk_i, .rst_i, .valid_i(valid_q), .data_i(pixel_q), .valid_o(m_axis_pixel_tvalid), .ready_i(m_axis_pixel_tready),
    .data_o(m_axis_pixel_tdata), .taken_o(credit)
  );
  // what needs no computing is there long before its pixel, and leaves with it
  shade_fifo #(.WIDTH(1 + $bits(span.tag)), .LOG2(FIFO_LOG2)) u_tags (
    .clk_i, .rst_i, .valid_i(issue), .data_i({last, span_q.tag}), .valid_o(unused_there),
    .ready_i(m_axis_pixel_tvalid && m_axis_pixel_tready), .data_o({m_axis_pixel_tlast, m_axis_pixel_tuser}),
    .taken_o(unused_taken)
  );

  logic unused_bits;
  assign unused_bits = &{1'b0, span_q, draw_i};
endmodule
