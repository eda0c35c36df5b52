// SPDX-License-Identifier: Apache-2.0
// shade_kappa: kappa = n (1 - c) of an arc of 2^k pixels, from the increment of its normals: what the planner goes by.
//
//   kappa = n |g|^2 4^k / 2       1 - c = |2^k g|^2 / 2 between unit normals
//
//   g_i               S2.29       increment per pixel
//   log2_i            k           taken 2 clocks after g: shade_planner needs as long to find it
//   planner_i         sharpness U1.16, sharpness_exp 0 .. 12: n = mantissa 2^exponent, mantissa in [1, 2); constant while
//                     arcs are under way
//   kappa_o           U11.20      saturated
//
//   d = g 2^s           s: how many bits repeat the sign in all three components; d: the first 18 bits, the rest is cut
//   E = |d|^2           exact, 36 bits, of which the first 17 are kept
//   kappa = 2 E n 2^-r  r = 9 + 2 s - exponent - 2 k, cut; r < 0: does not fit
//
// Within 2^-12 of the exact value, relative, and 1 ulp.
// FOLD = 1: four 18 x 18 multipliers, one arc a clock. Latency LATENCY_KAPPA = 14 clocks.
// FOLD = 3 .. 8: one multiplier, FOLD = 3: two; an arc in FOLD clocks, taken when phase_i is 0; phase_i counts
//           0 .. FOLD - 1. Latency LATENCY_KAPPA + FOLD. The same bits.
// FOLD = 2 is as FOLD = 1.
// Example: g = (1/128, 0, 0), k = 5, n = 32 -> 32 (1/4)^2 / 2 = 1.
// Source: P1 chooses the degree by hand, region by region; kappa alone decides the error of interpolating cos^n.
module shade_kappa #(
  parameter int FOLD = 1
) (
  input  logic                                   clk_i,
  input  logic                                   rst_i,
  input  logic [         shade_pkg::PHASE_W-1:0] phase_i,
  input  shade_pkg::step_t                       g_i,
  input  logic [          shade_pkg::LOG2_W-1:0] log2_i,
  input  shade_pkg::planner_t                    planner_i,
  output logic [         shade_pkg::KAPPA_W-1:0] kappa_o
);
  if (FOLD < 1 || FOLD > shade_pkg::FOLD_MAX) begin : g_check
    $error("shade_kappa: FOLD must be in 1 .. 8");
  end

  localparam int W = shade_pkg::STEP_W;
  localparam int D_W = 18;
  localparam int MUL = shade_pkg::LATENCY_MUL;
  localparam int LATER = FOLD < 3 ? 0 : FOLD;

  // ---- s, in steps of 8, 2 and 1: the first bit that differs from its component's sign goes to the front -----------
  localparam int W2 = D_W + 7;  // of g: what the next steps can still bring to the front
  localparam int W3 = D_W + 1;
  logic [2:0][W-1:0] g, g_q1, changes;
  logic [W-1:0] differs_q1;
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
    g_q1       <= g_i;
    differs_q1 <= (changes[0] | changes[1] | changes[2]) & {{(W - 1) {1'b1}}, 1'b0};
    differs_q2 <= 8'((differs_q1 << {eights, 3'b000}) >> (W - 8));
    front_q3   <= differs_q2[{~twos, 1'b1}];
    eights_q2  <= eights;
    eights_q3  <= eights_q2;
    twos_q3    <= twos;
    s_q4       <= {eights_q3, twos_q3, !front_q3};
  end

  localparam int E_W = 2 * D_W;  // at most 3 * 2^34
  logic [2:0][D_W-1:0] d;
  for (genvar c = 0; c < 3; c++) begin : g_component
    logic [W-1:0] eighth;
    logic [W2-1:0] g_q2, half;
    logic [W3-1:0] g_q3;
    logic signed [D_W-1:0] d_q4;
    assign eighth = g_q1[c] << {eights, 3'b000};
    assign half   = g_q2 << {twos, 1'b0};
    always_ff @(posedge clk_i) begin
      g_q2 <= W2'(eighth >> (W - W2));
      g_q3 <= W3'(half >> (W2 - W3));
      d_q4 <= D_W'(front_q3 ? g_q3 >> 1 : g_q3);
    end
    assign d[c] = d_q4;
    logic unused_bits;
    assign unused_bits = &{1'b0, eighth, half};
  end

  // ---- E, and its product with the mantissa ----------------------------------------------------------------------
  localparam int KEPT_W = 17;
  localparam int M_W = shade_pkg::SHARPNESS_F + 2;
  localparam int P_W = KEPT_W + M_W;  // of twice the product
  logic [E_W-1:0] e, product;
  logic [KEPT_W:0] kept;  // unsigned
  assign kept = (KEPT_W + 1)'(e >> (E_W - KEPT_W));
  if (FOLD < 3) begin : g_parallel
    logic [E_W-1:0] xx_q6, yy_q6, zz_q6, two_q7, third_q7, e_q8;
    shade_mul #(.A_W(D_W), .B_W(D_W)) u_xx (.clk_i, .a_i(d[0]), .b_i(d[0]), .p_o(xx_q6));
    shade_mul #(.A_W(D_W), .B_W(D_W)) u_yy (.clk_i, .a_i(d[1]), .b_i(d[1]), .p_o(yy_q6));
    shade_mul #(.A_W(D_W), .B_W(D_W)) u_zz (.clk_i, .a_i(d[2]), .b_i(d[2]), .p_o(zz_q6));
    always_ff @(posedge clk_i) begin
      two_q7   <= xx_q6 + yy_q6;
      third_q7 <= zz_q6;
      e_q8     <= two_q7 + third_q7;
    end
    assign e = e_q8;
    shade_mul #(.A_W(KEPT_W + 1), .B_W(M_W)) u_product (.clk_i, .a_i(kept), .b_i({1'b0, planner_i.sharpness}), .p_o(product));
    logic unused_phase;
    assign unused_phase = &{1'b0, phase_i};
  end else begin : g_folded
    // is it clock c of an arc? d is there in clock 4; factors of clock c stand at a multiplier in c + 1, their product
    // comes in c + 3; E stays from clock 10 to 7 + FOLD
    function automatic logic at(input int c);
      at = phase_i == shade_pkg::PHASE_W'(c % FOLD);
    endfunction
    logic [D_W-1:0] y_q, z_q, next, a_q, b_q;
    logic [E_W-1:0] square, e_q;
    assign next = at(4) ? d[0] : at(5) ? y_q : z_q;
    assign e    = e_q;
    always_ff @(posedge clk_i) begin
      if (at(4)) {y_q, z_q} <= {d[1], d[2]};
      if (at(7)) e_q <= square;
      else if (at(8) || at(9)) e_q <= e_q + square;
    end
    if (FOLD == 3) begin : g_two
      always_ff @(posedge clk_i) {a_q, b_q} <= {next, next};
      shade_mul #(.A_W(D_W), .B_W(D_W)) u_square (.clk_i, .a_i(a_q), .b_i(b_q), .p_o(square));
      logic [D_W-1:0] kept_q;
      always_ff @(posedge clk_i) kept_q <= kept;
      shade_mul #(.A_W(D_W), .B_W(D_W)) u_product (.clk_i, .a_i(kept_q), .b_i({1'b0, planner_i.sharpness}), .p_o(product));
    end else begin : g_one
      always_ff @(posedge clk_i) {a_q, b_q} <= at(7) ? {kept, 1'b0, planner_i.sharpness} : {next, next};
      shade_mul #(.A_W(D_W), .B_W(D_W)) u_mul (.clk_i, .a_i(a_q), .b_i(b_q), .p_o(product));
      assign square = product;
    end
  end

  // ---- shifted by r, in steps of 16, 4 and 1 -----------------------------------------------------------------------
  localparam int R_W = 8;  // -32 .. 71
  localparam int KAPPA_W = shade_pkg::KAPPA_W;
  logic signed [R_W-1:0] rest_q3, rest_q4, r_q5, r_q10;
  logic [1:0] sixteens, fours, ones, fours_q11, ones_q11, ones_q12;
  logic [P_W-1:0] p_q11, p_q12, p_q13;
  logic over, none, over_q11, over_q13;
  assign {over, none, sixteens, fours, ones} = r_q10;
  always_ff @(posedge clk_i) begin
    rest_q3 <= R_W'(9) - $signed(R_W'(planner_i.sharpness_exp)) - $signed(R_W'({log2_i, 1'b0}));
    rest_q4 <= rest_q3;
    r_q5    <= rest_q4 + $signed(R_W'({s_q4, 1'b0}));

    over_q11  <= over;
    fours_q11 <= fours;
    ones_q11  <= ones;
    p_q11     <= none ? '0 : P_W'({product, 1'b0}) >> {sixteens, 4'b0000};
    ones_q12  <= ones_q11;
    p_q12     <= p_q11 >> {fours_q11, 2'b00};
    p_q13     <= p_q12 >> ones_q12;
    kappa_o   <= KAPPA_W'(p_q13) | {KAPPA_W{over_q13 || p_q13 >> KAPPA_W != '0}};
  end
  shade_ring #(.WIDTH(R_W), .DEPTH(2 * MUL + 1 + LATER)) u_r (.clk_i, .rst_i, .d_i(r_q5), .q_o(r_q10));
  shade_delay #(.WIDTH(1), .DEPTH(2)) u_over (.clk_i, .d_i(over_q11), .q_o(over_q13));

  logic unused_bits;
  assign unused_bits = &{1'b0, product, e, planner_i};
endmodule
