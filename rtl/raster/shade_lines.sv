// SPDX-License-Identifier: Apache-2.0
// shade_lines: surfaces and their runs to spans, the packet that shade_core, shade_pixel_normals and shade_phong take.
//
// m_axis_span: packet SPAN: the run's normal and its increment, S2.29, pixels, tag, flat; the cosine is 1, as variants V1
// and V2 of P4, which alone need it, are drawn from spans that have it. tuser: {depth and its increment, S1.30 modulo 4, line, column} of the first
// pixel. Of a run of one pixel the normal's increment is 0. Latency 8 clocks, a run a clock. Example: golden.raster.lines.
module shade_lines (
  input  logic                              clk_i,
  input  logic                              rst_i,
  input  logic                              surface_valid_i,
  output logic                              surface_ready_o,
  input  shade_pkg::surface_t               surface_i,
  input  logic                              run_valid_i,
  output logic                              run_ready_o,
  input  shade_pkg::walked_t                run_i,
  output logic                              m_axis_span_tvalid,
  input  logic                              m_axis_span_tready,
  output logic [shade_pkg::SPAN_DATA_W-1:0] m_axis_span_tdata,
  output shade_pkg::spot_t                  m_axis_span_tuser
);
  localparam int CREDIT_LOG2 = 4;
  logic valid, first, taken;
  shade_pkg::walked_t run;
  shade_pkg::plane_t start;
  shade_pkg::surface_t surface;
  shade_starts #(.CREDIT_LOG2(CREDIT_LOG2)) u_starts (
    .clk_i, .rst_i, .surface_valid_i, .surface_ready_o, .surface_i, .run_valid_i, .run_ready_o, .run_i, .valid_o(valid),
    .first_o(first), .run_o(run), .start_o(start), .surface_o(surface), .credit_i(taken)
  );
  logic unused;
  assign unused = ^{first, run.last, run.none, surface};

  shade_pkg::span_t span;
  logic single;
  assign single         = run.count == shade_pkg::COUNT_W'(1);
  assign span.normal    = start.normal;
  assign span.increment = single ? '0 : surface.dcolumn.normal;
  assign span.count     = run.count;
  assign span.tag       = surface.tag;
  assign span.cosine    = shade_pkg::INTENSITY_W'(1 << shade_pkg::INTENSITY_F);
  assign span.flat      = surface.flat;
  assign {span.unused_205, span.unused_243} = '0;
  shade_pkg::spot_t spot;
  assign spot.column   = run.column;
  assign spot.line     = run.line;
  assign spot.depth    = start.depth;
  assign spot.increase = surface.dcolumn.depth;
  shade_fifo #(.WIDTH(shade_pkg::SPAN_DATA_W + $bits(spot)), .LOG2(CREDIT_LOG2)) u_fifo (
    .clk_i, .rst_i, .valid_i(valid), .data_i({spot, span}), .valid_o(m_axis_span_tvalid),
    .ready_i(m_axis_span_tready), .data_o({m_axis_span_tuser, m_axis_span_tdata}), .taken_o(taken)
  );
endmodule
