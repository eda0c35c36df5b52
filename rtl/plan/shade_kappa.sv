// SPDX-License-Identifier: Apache-2.0
// shade_kappa: kappa = n (1 - c) of an arc of 2^k pixels, from the increment of its normals: what the planner goes by.
//
//   kappa = n |g|^2 4^k / 2       1 - c = |2^k g|^2 / 2 between unit normals
//
//   g_i               S2.29       increment per pixel
//   log2_i            k           taken 4 clocks after g: shade_planner needs as long to find it
//   planner_i         sharpness U1.16, sharpness_exp 0 .. 12: n = mantissa 2^exponent, mantissa in [1, 2); constant while
//                     arcs are under way
//   kappa_o           U11.20      saturated; stays for PACE clocks
//
//   d = g 2^s           s: how many bits repeat the sign in all three components; d: the first 18 bits, the rest is cut
//   E = |d|^2           exact, 36 bits, of which the first 17 are kept
//   kappa = 2 E n 2^-r  r = 9 + 2 s - exponent - 2 k, cut; r < 0: does not fit
//
// Within 2^-12 of the exact value, relative, and 1 ulp.
// One component a clock; two 18 x 18 multipliers. An arc in PACE clocks, at least 4, taken when phase_i is 0; phase_i counts
// 0 .. PACE - 1. Latency LATENCY_KAPPA = 15 clocks.
// Example: g = (1/128, 0, 0), k = 5, n = 32 -> 32 (1/4)^2 / 2 = 1.
// Source: P1 chooses the degree by hand, region by region; kappa alone decides the error of interpolating cos^n.
module shade_kappa #(
  parameter int PACE = 4
) (
  input  logic                           clk_i,
  input  logic [  shade_pkg::LOG2_W-1:0] phase_i,
  input  shade_pkg::step_t               g_i,
  input  logic [  shade_pkg::LOG2_W-1:0] log2_i,
  input  shade_pkg::planner_t            planner_i,
  output logic [ shade_pkg::KAPPA_W-1:0] kappa_o
);
  if (PACE < 4 || PACE > shade_pkg::LOG2_MAX) begin : g_check
    $error("shade_kappa: PACE must be in 4 .. 12");
  end

  localparam int W = shade_pkg::STEP_W;
  localparam int D_W = 18;

  // is it clock c of an arc?
  function automatic logic at(input int c);
    at = phase_i == shade_pkg::LOG2_W'(c % PACE);
  endfunction

  // ---- s, in steps of 8, 2 and 1: the first bit that differs from its component's sign goes to the front -----------
  localparam int W2 = D_W + 7;  // of g: what the next steps can still bring to the front
  localparam int W3 = D_W + 1;
  logic [2:0][W-1:0] g, g_q1, changes;
  logic [W-1:0] differs_q1, chosen, eighth;
  logic [7:0] differs_q2;
  logic [3:0][7:0] bytes;
  logic [3:0][1:0] pairs;
  logic [1:0] eights, eights_q2, eights_q3, twos, twos_q3;
  logic front_q3;
  logic [4:0] s_q4;
  assign g     = g_i;
  assign bytes = differs_q1;
  assign pairs = differs_q2;
  for (genvar c = 0; c < 3; c++) begin : g_change
    assign changes[c] = g[c] ^ (g[c] << 1);
  end
  always_comb begin
    eights = 2'd3;
    twos   = 2'd3;
    for (int i = 2; i >= 0; i--) begin
      if (bytes[3-i] != '0) eights = 2'(i);
      if (pairs[3-i] != '0) twos = 2'(i);
    end
  end
  always_ff @(posedge clk_i) begin
    if (at(0)) begin
      g_q1       <= g_i;
      differs_q1 <= (changes[0] | changes[1] | changes[2]) & {{(W - 1) {1'b1}}, 1'b0};
    end
    differs_q2 <= 8'((differs_q1 << {eights, 3'b000}) >> (W - 8));
    front_q3   <= differs_q2[{~twos, 1'b1}];
    eights_q2  <= eights;
    eights_q3  <= eights_q2;
    twos_q3    <= twos;
    s_q4       <= {eights_q3, twos_q3, !front_q3};
  end

  // ---- d, a component a clock, and E: of x, y, z in clocks 1, 2, 3, the sum in clock 9 ------------------------------------
  localparam int E_W = 2 * D_W;  // at most 3 * 2^34
  logic [W2-1:0] g_q2, half;
  logic [W3-1:0] g_q3;
  logic signed [D_W-1:0] d_q;
  logic [E_W-1:0] square, e_q;
  assign chosen = at(1) ? g_q1[0] : at(2) ? g_q1[1] : g_q1[2];
  assign eighth = chosen << {eights, 3'b000};
  assign half   = g_q2 << {twos, 1'b0};
  always_ff @(posedge clk_i) begin
    g_q2 <= W2'(eighth >> (W - W2));
    g_q3 <= W3'(half >> (W2 - W3));
    d_q  <= D_W'(front_q3 ? g_q3 >> 1 : g_q3);
    e_q  <= at(5) ? '0 : e_q + square;
  end
  shade_mul #(.A_W(D_W), .B_W(D_W)) u_square (.clk_i, .a_i(d_q), .b_i(d_q), .p_o(square));

  // ---- its product with the mantissa, in clock 11 ----------------------------------------------------------------------
  localparam int KEPT_W = 17;
  localparam int M_W = shade_pkg::SHARPNESS_F + 2;
  localparam int P_W = KEPT_W + M_W;  // of twice the product
  logic [E_W-1:0] product;
  logic [KEPT_W:0] kept;  // unsigned
  assign kept = (KEPT_W + 1)'(e_q >> (E_W - KEPT_W));
  shade_mul #(.A_W(KEPT_W + 1), .B_W(M_W)) u_product (
    .clk_i, .a_i(kept), .b_i({1'b0, planner_i.sharpness}), .p_o(product)
  );

  // ---- shifted by r, in steps of 16, 4 and 1 -----------------------------------------------------------------------
  localparam int R_W = 8;  // -32 .. 71
  localparam int KAPPA_W = shade_pkg::KAPPA_W;
  logic signed [R_W-1:0] rest_q5, r_q6, r_q9;
  logic [1:0] sixteens, fours, ones, fours_q12, ones_q12, ones_q13;
  logic [P_W-1:0] p_q12, p_q13, p_q14;
  logic over, none, over_q12, over_q13, over_q14;
  assign {over, none, sixteens, fours, ones} = r_q9;
  always_ff @(posedge clk_i) begin
    if (at(4)) rest_q5 <= R_W'(9) - $signed(R_W'(planner_i.sharpness_exp)) - $signed(R_W'({log2_i, 1'b0}));
    r_q6 <= rest_q5 + $signed(R_W'({s_q4, 1'b0}));
    if (at(8)) r_q9 <= r_q6;

    {over_q12, fours_q12, ones_q12} <= {over, fours, ones};
    p_q12                           <= none ? '0 : P_W'({product, 1'b0}) >> {sixteens, 4'b0000};
    {over_q13, ones_q13}            <= {over_q12, ones_q12};
    p_q13                           <= p_q12 >> {fours_q12, 2'b00};
    over_q14                        <= over_q13;
    p_q14                           <= p_q13 >> ones_q13;
    if (at(14)) kappa_o <= KAPPA_W'(p_q14) | {KAPPA_W{over_q14 || p_q14 >> KAPPA_W != '0}};
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, product, e_q, planner_i, eighth, half};
endmodule
