// SPDX-License-Identifier: Apache-2.0
// shade_halfway: H = (L + V) / |L + V|, halfway between light and viewer, and the cosine V.H = L.H.
//
//   lx_i .. vz_i   sd.ffff     S1.16
//   L + V         sdd.ffff     saturated to S1.16; of unit vectors only +2 is met, which alters no direction
//   hx_o .. hz_o   sd.ffff     S1.16, each component within 5/8 ulp: shade_normalize
//   vh_o            d.ffff     U1.16, clamped to [0, 1]; of unit vectors within 1.6 ulp: shade_dot3
//   zero_o                     L = -V: H = 0, vh = 0
//
// 14 18 x 18 multipliers. Latency LATENCY_HALFWAY = 25 clocks, one vector a clock. Source: P1, Blinn's N.H.
// Example: L = (1, 0, 0), V = (0, 0, 1) -> H = (0.7071, 0, 0.7071), vh = 0.7071.
module shade_halfway (
  input  logic                                     clk_i,
  input  logic                                     rst_i,
  input  logic                                     valid_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] lx_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] ly_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] lz_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] vx_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] vy_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] vz_i,
  output logic                                     valid_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] hx_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] hy_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] hz_o,
  output logic        [  shade_pkg::INTENSITY_F:0] vh_o,
  output logic                                     zero_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int TO_H = 1 + shade_pkg::LATENCY_NORMALIZE;

  logic [3*W-1:0] l, v, v_q20, s_q1;
  assign l = {lz_i, ly_i, lx_i};
  assign v = {vz_i, vy_i, vx_i};
  for (genvar c = 0; c < 3; c++) begin : g_component
    logic signed [W:0] sum;
    logic signed [W-1:0] limited;
    assign sum = (W + 1)'($signed(l[c*W+:W])) + (W + 1)'($signed(v[c*W+:W]));
    shade_limit #(.WIDTH(W + 1), .OUT_W(W)) u_limit (.x_i(sum), .y_o(limited));
    always_ff @(posedge clk_i) s_q1[c*W+:W] <= limited;
  end

  logic [3*W-1:0] h_q20;
  logic zero_q20;
  shade_normalize u_normalize (.clk_i, .rst_i, .v_i(s_q1), .n_o(h_q20), .zero_o(zero_q20));

  logic signed [shade_pkg::DOT_W-1:0] dot_q24;
  logic [shade_pkg::INTENSITY_F:0] vh;
  shade_ring #(.WIDTH(3 * W), .DEPTH(TO_H)) u_v (.clk_i, .rst_i, .d_i(v), .q_o(v_q20));
  shade_dot3 u_dot (.clk_i, .a_i(v_q20), .b_i(h_q20), .d_o(dot_q24));
  shade_clamp #(.WIDTH(shade_pkg::DOT_W)) u_vh (.x_i(dot_q24), .y_o(vh), .clamped_o());
  always_ff @(posedge clk_i) vh_o <= vh;

  shade_delay #(.WIDTH(3 * W + 1), .DEPTH(shade_pkg::LATENCY_DOT3 + 1)) u_h (
    .clk_i, .d_i({zero_q20, h_q20}), .q_o({zero_o, hz_o, hy_o, hx_o})
  );
  shade_valid #(.DEPTH(shade_pkg::LATENCY_HALFWAY)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);
endmodule
