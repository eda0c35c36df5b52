// SPDX-License-Identifier: Apache-2.0
// shade_spans: triangles of three vertices to spans: a scan converter in front of shade_core.
//
// s_axis_vertex: see shade_scan; m_axis_span: see shade_lines. error_o, culled_o, empty_o count what was skipped since
// reset, each saturating at 2^16 - 1: {area, normal, range, packet}, culled triangles, those without a pixel.
// About 53 clocks from a third vertex to the first span, a triangle in 14, a span a clock. Example: golden.raster.scan, .lines.
module shade_spans (
  input  logic                                clk_i,
  input  logic                                rst_i,
  input  logic [      shade_pkg::CULL_W-1:0]  cull_i,
  input  logic                                flat_i,
  input  logic [     shade_pkg::COUNT_W-1:0]  columns_i,
  input  logic [     shade_pkg::COUNT_W-1:0]  lines_i,
  input  logic                                s_axis_vertex_tvalid,
  output logic                                s_axis_vertex_tready,
  input  logic [shade_pkg::VERTEX_DATA_W-1:0] s_axis_vertex_tdata,
  input  logic                                s_axis_vertex_tlast,
  output logic                                m_axis_span_tvalid,
  input  logic                                m_axis_span_tready,
  output logic [  shade_pkg::SPAN_DATA_W-1:0] m_axis_span_tdata,
  output shade_pkg::spot_t                    m_axis_span_tuser,
  output logic [                        63:0] error_o,
  output logic [                        15:0] culled_o,
  output logic [                        15:0] empty_o
);
  logic surface_valid, surface_ready, run_valid, run_ready, culled;
  logic [3:0] error;
  logic [1:0] empty;
  shade_pkg::surface_t surface;
  shade_pkg::walked_t run;
  shade_scan u_scan (
    .clk_i, .rst_i, .cull_i, .flat_i, .columns_i, .lines_i, .s_axis_vertex_tvalid, .s_axis_vertex_tready,
    .s_axis_vertex_tdata, .s_axis_vertex_tlast, .surface_valid_o(surface_valid), .surface_ready_i(surface_ready),
    .surface_o(surface), .run_valid_o(run_valid), .run_ready_i(run_ready), .run_o(run), .error_o(error),
    .culled_o(culled), .empty_o(empty)
  );
  shade_lines u_lines (
    .clk_i, .rst_i, .surface_valid_i(surface_valid), .surface_ready_o(surface_ready), .surface_i(surface),
    .run_valid_i(run_valid), .run_ready_o(run_ready), .run_i(run), .m_axis_span_tvalid, .m_axis_span_tready,
    .m_axis_span_tdata, .m_axis_span_tuser
  );

  localparam int COUNTERS = 6;
  logic [COUNTERS-1:0][15:0] count_q;
  logic [COUNTERS-1:0][1:0] more;
  always_comb begin
    for (int i = 0; i < 4; i++) more[i] = {1'b0, error[i]};
    more[4] = {1'b0, culled};
    more[5] = {1'b0, empty[0]} + {1'b0, empty[1]};
  end
  always_ff @(posedge clk_i) begin
    for (int i = 0; i < COUNTERS; i++) begin
      if (count_q[i] >= 16'hfffe && more[i] != '0) count_q[i] <= '1;
      else count_q[i] <= count_q[i] + 16'(more[i]);
    end
    if (rst_i) count_q <= '0;
  end
  assign {empty_o, culled_o, error_o} = count_q;
endmodule
