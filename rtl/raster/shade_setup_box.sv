// SPDX-License-Identifier: Apache-2.0
// shade_setup_box: what of a triangle's box lies in the frame.
//
//   box_i, load_i              least and greatest column and line, see shade_vertices, S16
//   columns_i, lines_i         the frame
//   left_o, right_o, bottom_o  its first column, the one behind its last, the line behind its last
//   outside_o                  none of its pixels is in the frame; nothing else counts then
//
// Latency 1 clock; all hold. Example: columns -3 .. 9 of a frame of 8 -> left 0, right 8.
module shade_setup_box (
  input  logic                               clk_i,
  input  logic                               load_i,
  input  logic [3:0][ shade_pkg::LINE_W-1:0] box_i,
  input  logic [     shade_pkg::COUNT_W-1:0] columns_i,
  input  logic [     shade_pkg::COUNT_W-1:0] lines_i,
  output logic [     shade_pkg::COUNT_W-1:0] left_o,
  output logic [     shade_pkg::COUNT_W-1:0] right_o,
  output logic [     shade_pkg::COUNT_W-1:0] bottom_o,
  output logic                               outside_o
);
  localparam int L_W = shade_pkg::LINE_W;
  localparam int C_W = shade_pkg::COUNT_W;
  logic [1:0][C_W-1:0] low_q, high_q;
  logic [1:0] none_q, before_q;  // no pixel beside the frame's columns or lines; all of them before the first one
  for (genvar i = 0; i < 2; i++) begin : g_axis
    logic [L_W-1:0] low, high, limit;
    assign {low, high} = {box_i[2*i+1], box_i[2*i]};
    assign limit       = L_W'(i == 0 ? columns_i : lines_i);
    always_ff @(posedge clk_i) begin
      if (load_i) begin
        low_q[i]    <= low[L_W-1] ? '0 : low[C_W-1:0];
        high_q[i]   <= $signed(high) < $signed(limit) ? high[C_W-1:0] : limit[C_W-1:0];
        before_q[i] <= high[L_W-1];
        none_q[i]   <= !low[L_W-1] && low[L_W-2:C_W] != '0;
      end
    end
  end
  assign outside_o = before_q != '0 || none_q != '0 || high_q[0] <= low_q[0] || high_q[1] <= low_q[1];
  assign {bottom_o, right_o, left_o} = {high_q, low_q[0]};
  logic unused_top;
  assign unused_top = ^low_q[1];
endmodule
