// SPDX-License-Identifier: Apache-2.0
// shade_pixel_points: spans in, the unit normal of every pixel out, each a record of its own: P4's producer of points.
//
//   span_i       1 .. 4096 pixels, with the cosine of its ends
//   draw_i       variant and threshold; must not change while a span is inside
//   normal_o     S1.16, with place_o: slot 0 of a direct record of one pixel
//   credit_i     gives one credit back; 2^RECORD_FIFO_LOG2 are there after reset, a record costs one
//
// What shade_pixel_normals makes, as shade_line gives its nodes. No path leads from an input to an output.
// Latency LATENCY_PIXEL_NORMALS = 43 clocks, one pixel a clock. Example: 2 pixels -> two points with last = 1, the first one
// with more = 1. Source: P4.
module shade_pixel_points (
  input  logic              clk_i,
  input  logic              rst_i,
  input  shade_pkg::draw_t  draw_i,
  input  logic              valid_i,
  output logic              ready_o,
  input  shade_pkg::span_t  span_i,
  input  logic              credit_i,
  output logic              valid_o,
  output shade_pkg::place_t place_o,
  output shade_pkg::vec_t   normal_o
);
  logic valid, credit, last, unused_soon;
  logic [shade_pkg::NORMAL_DATA_W-1:0] normal;
  shade_credit #(.LOG2(shade_pkg::RECORD_FIFO_LOG2)) u_credit (
    .clk_i, .rst_i, .take_i(valid_o), .give_i(credit_i), .some_o(credit), .soon_o(unused_soon)
  );
  shade_pixel_normals u_normals (
    .clk_i, .rst_i, .variant_i(draw_i.control.variant), .threshold_i(draw_i.planner.threshold),
    .s_axis_line_tvalid(valid_i), .s_axis_line_tready(ready_o), .s_axis_line_tdata(span_i), .m_axis_normal_tvalid(valid),
    .m_axis_normal_tready(credit), .m_axis_normal_tdata(normal), .m_axis_normal_tuser(place_o.head.tag),
    .m_axis_normal_tlast(last)
  );
  assign valid_o             = valid && credit;
  assign normal_o            = shade_pkg::VEC_BITS'(normal);
  assign place_o.slot        = '0;
  assign place_o.shared      = 1'b0;
  assign place_o.last        = 1'b1;
  assign place_o.head.count  = shade_pkg::COUNT_W'(1);
  assign place_o.head.more   = !last;
  assign place_o.head.degree = shade_pkg::DEGREE_W'(shade_pkg::DEGREE_DIRECT);
  assign place_o.head.log2   = '0;

  logic unused_bits;
  assign unused_bits = &{1'b0, draw_i, normal};
endmodule
