// SPDX-License-Identifier: Apache-2.0
// shade_setup_area: what becomes of a triangle: its area tells the side that is seen, and its reciprocal the increments.
//
//   sum_i           twice the area, S51.0, with valid_i; outside_i: no pixel of the frame is in the box
//   drop_o          it is left out, and why: told_o (area, culled, outside), a clock later
//   good_o          it goes on: minus_o, the area was negative, from the next clock on; e_o, r_o: see shade_reciprocal
//
// Latency 1 clock; of e_o 5, of r_o 25 clocks. Example: sum = -3, nothing culled -> minus 1, e 1, r 0.66667.
module shade_setup_area (
  input  logic                               clk_i,
  input  logic                               rst_i,
  input  logic [shade_pkg::CULL_W-1:0]       cull_i,
  input  logic                               valid_i,
  input  logic signed [shade_pkg::AREA_W:0]  sum_i,
  input  logic                               outside_i,
  output logic                               good_o,
  output logic                               drop_o,
  output shade_pkg::fate_t                   told_o,
  output logic                               minus_o,
  output logic [5:0]                         e_o,
  output logic [shade_pkg::RECIPROCAL_F-1:0] r_o
);
  localparam int A_W = shade_pkg::AREA_W;
  logic valid_q, zero_q, back_q, outside_q, negative_q;
  logic [A_W-1:0] area_q;
  assign good_o = valid_q && !zero_q && !back_q && !outside_q;
  assign drop_o = valid_q && (zero_q || back_q || outside_q);
  always_ff @(posedge clk_i) begin
    valid_q    <= valid_i && !rst_i;
    zero_q     <= sum_i == '0;
    back_q     <= cull_i == (sum_i[A_W] ? shade_pkg::CULL_W'(shade_pkg::CULL_FRONT)
                                        : shade_pkg::CULL_W'(shade_pkg::CULL_BACK));
    outside_q  <= outside_i;
    negative_q <= sum_i[A_W];
    area_q     <= sum_i[A_W] ? -sum_i[A_W-1:0] : sum_i[A_W-1:0];
    if (valid_q) minus_o <= negative_q;
    told_o         <= '0;
    told_o.area    <= valid_q && zero_q && !rst_i;
    told_o.culled  <= valid_q && !zero_q && back_q && !rst_i;
    told_o.outside <= valid_q && !zero_q && !back_q && outside_q && !rst_i;
  end
  shade_reciprocal u_reciprocal (.clk_i, .start_i(good_o), .a_i(area_q), .e_o, .r_o);
endmodule
