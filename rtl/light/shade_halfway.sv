// SPDX-License-Identifier: Apache-2.0
// shade_halfway: H = (L + V) / |L + V|, halfway between light and viewer, and the cosine V.H = L.H.
//
//   l_i, v_i       sd.ffff     S1.16
//   L + V         sdd.ffff     saturated to S1.16; of unit vectors only +2 is met, which alters no direction
//   h_o            sd.ffff     S1.16, 0 where L = -V; each component within 5/8 ulp: shade_normalize
//   vh_o            d.ffff     U1.16, clamped to [0, 1]; of unit vectors within 1.6 ulp: shade_dot3
//
// 14 18 x 18 multipliers. Latency LATENCY_HALFWAY = 25 clocks, one vector a clock. Source: P1, Blinn's N.H.
// Example: L = (1, 0, 0), V = (0, 0, 1) -> H = (0.7071, 0, 0.7071), vh = 0.7071.
module shade_halfway (
  input  logic                            clk_i,
  input  logic                            rst_i,
  input  shade_pkg::vec_t                 l_i,
  input  shade_pkg::vec_t                 v_i,
  output shade_pkg::vec_t                 h_o,
  output logic [shade_pkg::INTENSITY_F:0] vh_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int DOT_W = shade_pkg::DOT_W;

  logic [2:0][W-1:0] l, v, s_q1;
  assign {l, v} = {l_i, v_i};
  for (genvar c = 0; c < 3; c++) begin : g_component
    logic signed [W:0] sum;
    logic signed [W-1:0] limited;
    assign sum = (W + 1)'($signed(l[c])) + (W + 1)'($signed(v[c]));
    shade_limit #(.WIDTH(W + 1), .OUT_W(W)) u_limit (.x_i(sum), .y_o(limited));
    always_ff @(posedge clk_i) s_q1[c] <= limited;
  end

  shade_pkg::vec_t h_q20, v_q20;
  logic zero;
  logic signed [DOT_W-1:0] dot_q24;
  logic [shade_pkg::INTENSITY_F:0] vh;
  shade_normalize u_normalize (.clk_i, .rst_i, .v_i(s_q1), .n_o(h_q20), .zero_o(zero));
  shade_ring #(.WIDTH($bits(v_i)), .DEPTH(1 + shade_pkg::LATENCY_NORMALIZE)) u_v (
    .clk_i, .rst_i, .d_i(v_i), .q_o(v_q20)
  );
  shade_dot3 u_dot (.clk_i, .a_i(v_q20), .b_i(h_q20), .d_o(dot_q24));
  logic unused_vh;
  shade_clamp #(.WIDTH(DOT_W)) u_vh (.x_i(dot_q24), .y_o(vh), .clamped_o(unused_vh));
  always_ff @(posedge clk_i) vh_o <= vh;
  shade_delay #(.WIDTH($bits(h_o)), .DEPTH(shade_pkg::LATENCY_DOT3 + 1)) u_h (.clk_i, .d_i(h_q20), .q_o(h_o));
  logic unused_zero;  // H tells
  assign unused_zero = zero;
endmodule
