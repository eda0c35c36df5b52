// SPDX-License-Identifier: Apache-2.0
// shade_bisect: n = (Na + Nb) InvC, the unit normal in the middle of two, InvC given.
//
//   a_i, b_i       sd.ffff          S1.16
//   Na + Nb       sdd.ffff          saturated to S1.16; of unit normals only +2 is met, and (2 - 2^-16)/2 rounds to 1
//   invc_i         0.ffff ff        U0.18, taken WAIT clocks after the normals
//   n_o            sd.ffff          S1.16, to nearest, ties up: error at most 1/2 ulp, 1 ulp where the sum is +2
//
// Three 18 x 18 multipliers. Latency WAIT + LATENCY_SCALE3 clocks (4 by default), one vector a clock.
// Source: P4, section 2. Example: Na = (1, 0, 0), Nb = (0, 1, 0), InvC = 0.7071 -> n = (0.7071, 0.7071, 0).
module shade_bisect #(
  parameter int WAIT = 1
) (
  input  logic                         clk_i,
  input  logic                         rst_i,
  input  shade_pkg::vec_t              a_i,
  input  shade_pkg::vec_t              b_i,
  input  logic [shade_pkg::INVC_F-1:0] invc_i,
  output shade_pkg::vec_t              n_o
);
  if (WAIT < 1) begin : g_check
    $error("shade_bisect: WAIT must be at least 1");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  logic [2:0][W-1:0] a, b, limited, sum_q1;
  shade_pkg::vec_t sum_q;
  assign a = a_i;
  assign b = b_i;
  for (genvar c = 0; c < 3; c++) begin : g_component
    logic signed [W:0] sum;
    assign sum = (W + 1)'($signed(a[c])) + (W + 1)'($signed(b[c]));
    shade_limit #(.WIDTH(W + 1), .OUT_W(W)) u_limit (.x_i(sum), .y_o(limited[c]));
  end
  always_ff @(posedge clk_i) sum_q1 <= limited;
  shade_ring #(.WIDTH($bits(sum_q)), .DEPTH(WAIT - 1)) u_sum (.clk_i, .rst_i, .d_i(sum_q1), .q_o(sum_q));
  shade_scale3 u_scale (.clk_i, .v_i(sum_q), .s_i(invc_i), .n_o);
endmodule
