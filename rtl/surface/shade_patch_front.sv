// SPDX-License-Identifier: Apache-2.0
// shade_patch_front: the sizes of a triangle's boxes: shade_patch_way finds how far its normal goes while the packet comes in,
// shade_patch_plan decides.
//
//   valid_i, triangle_i, pass_o   of shade_patch_door; corner_o see shade_patch_way
//   plan_o, planned_o     {direct, kx, ky}, for one clock
//
// Settings radius_i .. hz_i: see the two. A triangle in about 20 clocks and the larger exp; the next one begins 10 clocks earlier.
// Example: three triangles, no runs -> three plans, one after the other.
module shade_patch_front (
  input  logic                                       clk_i,
  input  logic                                       rst_i,
  input  logic        [ shade_pkg::INTENSITY_F-1:0]  radius_i,
  input  logic        [shade_pkg::PATCH_REACH_W-1:0] reach_i,
  input  logic signed [ shade_pkg::INTENSITY_W-1:0]  hx_i,
  input  logic signed [ shade_pkg::INTENSITY_W-1:0]  hy_i,
  input  logic signed [ shade_pkg::INTENSITY_W-1:0]  hz_i,
  input  logic                                       valid_i,
  input  shade_pkg::triangle_t                       triangle_i,
  output logic                                       pass_o,
  output logic                                       corner_valid_o,
  output logic [3*shade_pkg::PATCH_CORNER_W-1:0]     corner_o,
  output logic                                       planned_o,
  output logic        [ shade_pkg::PATCH_PLAN_W-1:0] plan_o
);
  logic busy_q, start, found;
  logic [shade_pkg::PATCH_WAY_W-1:0] a, b;
  logic signed [shade_pkg::PATCH_FAR_W-1:0] far;
  logic [shade_pkg::COUNT_W-1:0] columns, lines, columns_q, lines_q;
  assign start = found && !busy_q;
  shade_patch_way u_way (
    .clk_i, .rst_i, .hx_i, .hy_i, .hz_i, .valid_i, .triangle_i, .pass_o, .corner_valid_o, .corner_o, .take_i(start), .done_o(found), .a_o(a),
    .b_o(b), .far_o(far), .columns_o(columns), .lines_o(lines)
  );
  shade_patch_plan u_plan (
    .clk_i, .rst_i, .radius_i, .reach_i, .start_i(start), .a_i(a), .b_i(b), .far_i(far), .columns_i(columns_q),
    .lines_i(lines_q), .done_o(planned_o), .kx_o(plan_o[5:3]), .ky_o(plan_o[2:0]), .direct_o(plan_o[6])
  );
  always_ff @(posedge clk_i) begin
    if (start) {columns_q, lines_q} <= {columns, lines};
    busy_q <= (start || (busy_q && !planned_o)) && !rst_i;
  end
endmodule
