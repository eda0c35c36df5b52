// SPDX-License-Identifier: Apache-2.0
// shade_bisect: n = (Na + Nb) InvC, the unit normal in the middle of two, InvC given.
//
//   ax_i .. bz_i   sd.ffff          S1.16
//   Na + Nb       sdd.ffff          saturated to S1.16; of unit normals only +2 is met, and (2 - 2^-16)/2 rounds to 1
//   invc_i         0.ffff ff        U0.18, taken WAIT clocks after the normals
//   x_o, y_o, z_o  sd.ffff          S1.16, to nearest, ties up: error at most 1/2 ulp, 1 ulp where the sum is +2
//
// Three 18 x 18 multipliers. Latency WAIT + LATENCY_SCALE3 clocks (4 by default), one vector a clock.
// Source: P4, section 2. Example: Na = (1, 0, 0), Nb = (0, 1, 0), InvC = 0.7071 -> n = (0.7071, 0.7071, 0).
module shade_bisect #(
  parameter int WAIT = 1
) (
  input  logic                                     clk_i,
  input  logic                                     rst_i,
  input  logic                                     valid_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] ax_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] ay_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] az_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] bx_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] by_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] bz_i,
  input  logic        [     shade_pkg::INVC_F-1:0] invc_i,
  output logic                                     valid_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] x_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] y_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] z_o
);
  if (WAIT < 1) begin : g_check
    $error("shade_bisect: WAIT must be at least 1");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  logic [3*W-1:0] a, b, sum_q1, sum_q;
  assign a = {az_i, ay_i, ax_i};
  assign b = {bz_i, by_i, bx_i};
  for (genvar c = 0; c < 3; c++) begin : g_component
    logic [W:0] sum;
    assign sum = {a[c*W+W-1], a[c*W+:W]} + {b[c*W+W-1], b[c*W+:W]};
    always_ff @(posedge clk_i) sum_q1[c*W+:W] <= sum[W] == sum[W-1] ? sum[W-1:0] : {sum[W], {(W - 1) {~sum[W]}}};
  end
  shade_ring #(.WIDTH(3 * W), .DEPTH(WAIT - 1)) u_sum (.clk_i, .rst_i, .d_i(sum_q1), .q_o(sum_q));

  shade_scale3 u_scale (
    .clk_i, .rst_i, .valid_i(1'b0), .ready_o(), .x_i(sum_q[0+:W]), .y_i(sum_q[W+:W]), .z_i(sum_q[2*W+:W]),
    .s_i(invc_i), .valid_o(), .x_o, .y_o, .z_o
  );
  shade_valid #(.DEPTH(WAIT + shade_pkg::LATENCY_SCALE3)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);
endmodule
