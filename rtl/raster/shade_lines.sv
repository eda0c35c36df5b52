// SPDX-License-Identifier: Apache-2.0
// shade_lines: runs to spans, the packet that shade_core, shade_pixel_normals and shade_phong take.
//
// begun_i: see shade_starts. m_axis_span: packet SPAN: the run's normal and its increment, S2.29, pixels, tag, flat; the cosine
// is 1, as variants V1 and V2 of P4, which alone need it, are drawn from spans that have it. tuser: {depth and its increment,
// S1.30 modulo 4, line, column} of the first pixel. Of a run of one pixel the normal's increment is 0. What is none gives nothing.
//
// Combinational: ready_o follows tready. Latency 0 clocks, a run a clock. Example: golden.raster.lines.
module shade_lines (
  input  logic                              valid_i,
  output logic                              ready_o,
  input  shade_pkg::begun_t                 begun_i,
  output logic                              m_axis_span_tvalid,
  input  logic                              m_axis_span_tready,
  output logic [shade_pkg::SPAN_DATA_W-1:0] m_axis_span_tdata,
  output shade_pkg::spot_t                  m_axis_span_tuser
);
  shade_pkg::surface_t surface;
  shade_pkg::walked_t run;
  shade_pkg::span_t span;
  shade_pkg::spot_t spot;
  assign surface = begun_i.surface;
  assign run     = begun_i.run;
  assign m_axis_span_tvalid = valid_i && !run.none;
  assign ready_o            = m_axis_span_tready || run.none;
  assign span.normal    = begun_i.value.normal;
  assign span.increment = run.count == shade_pkg::COUNT_W'(1) ? '0 : surface.dcolumn.normal;
  assign span.count     = run.count;
  assign span.tag       = surface.tag;
  assign span.cosine    = shade_pkg::INTENSITY_W'(1 << shade_pkg::INTENSITY_F);
  assign span.flat      = surface.flat;
  assign {span.unused_205, span.unused_243} = '0;
  assign spot.column       = run.column;
  assign spot.line         = run.line;
  assign spot.depth        = begun_i.value.depth;
  assign spot.increase     = surface.dcolumn.depth;
  assign m_axis_span_tdata = span;
  assign m_axis_span_tuser = spot;

  logic unused_begun;
  assign unused_begun = &{1'b0, surface, run, begun_i.first};
endmodule
