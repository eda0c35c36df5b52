// SPDX-License-Identifier: Apache-2.0
// shade_unit: n = v / |v| of an interpolated normal, which is not far from unit length; or v as it is.
//
//   v_i            sdd.ffff        S2.15, |v| >= 1/8
//   bypass_i                       no normalization (P2): n = v, saturated to S1.16
//   unit_o.normal  sd.ffff         S1.16, to nearest, ties up: within 0.88 ulp for |v| < 2, 1.64 ulp for longer ones
//   unit_o.zero, .too_short            v = 0: n = 0; |v| < 1/8: n is too short. Both are about v, bypassed or not.
//
//   z = x^2 + y^2 + z^2            exact, U6.30
//   1/|v| = r 2^(15-e)             shade_rsqrt
//   v' = v 2^(15-e)                17 bits, rounded where e > 15: 2^15 <= |v'| < 2^16, but for |v| < 1/8, shifted by 3 only
//   n = v' s / 2^17                s = r to 18 fraction bits, below 1
//
// FOLD = 1: eight 18 x 18 multipliers, a vector a clock. Latency LATENCY_UNIT = 19 clocks.
// FOLD = 3 .. 8: a vector in FOLD clocks, taken when phase_i is 0; phase_i counts 0 .. FOLD - 1. The six products of v share
//           one multiplier, FOLD < 6: two; shade_rsqrt has two. Latency LATENCY_UNIT_FOLDED = 28 clocks.
// FOLD = 2 is as FOLD = 1.
// shade_normalize, for vectors of every length, takes eleven. Example: v = (0.3, 0, 0.4) -> n = (0.6, 0, 0.8).
// Source: P4, section 2 (interpolated normals); P2 (those that need no normalizing).
module shade_unit #(
  parameter int FOLD = 1
) (
  input  logic                          clk_i,
  input  logic                          rst_i,
  input  logic [shade_pkg::PHASE_W-1:0] phase_i,
  input  logic                          bypass_i,
  input  shade_pkg::vec_t               v_i,
  output shade_pkg::unit_t              unit_o
);
  if (FOLD < 1 || FOLD > shade_pkg::FOLD_MAX) begin : g_check
    $error("shade_unit: FOLD must be in 1 .. 8");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int V_W = shade_pkg::VEC_BITS;
  localparam int U_W = W + 3;  // v shifted left by 0 .. 5: v' with two fraction bits; twice v, which is to be saturated
  localparam int F = shade_pkg::INVC_F;
  localparam int R_F = shade_pkg::RSQRT_F;

  logic [2:0][W-1:0] v;  // where v' is made
  logic [shade_pkg::RSQRT_W-1:0] square;
  logic [R_F:0] r;
  logic [4:0] e;
  logic zero, short_v;
  shade_rsqrt u_rsqrt (.clk_i, .z_i(square), .y_o(r), .e_o(e), .zero_o(zero));
  assign short_v = e < 5'd12;

  // s, a clock behind r and a clock later; 1/2 for v' = 2 v, as it is
  localparam logic [F-1:0] HALF = F'(1) << (F - 1);
  logic [F:0] near_q;
  logic [F-1:0] s;
  logic bypass_s;
  always_ff @(posedge clk_i) near_q <= (F + 1)'(r >> (R_F - F)) + (F + 1)'(r[R_F-F-1]);
  assign s = bypass_s ? HALF : F'(near_q) | {F{near_q[F]}};

  // how far v is shifted: 2 + 15 - e
  function automatic logic [2:0] shift(input logic bypass, input logic too_short, input logic [4:0] exponent);
    shift = bypass ? 3'd3 : too_short ? 3'd5 : 3'(5'd17 - exponent);
  endfunction

  // v', to nearest; only twice v can be too large, and has no fraction bits
  function automatic logic [W-1:0] nearest(input logic [U_W-1:0] u);
    if (u[U_W-1] != u[U_W-2]) nearest = {u[U_W-1], {(W - 1) {!u[U_W-1]}}};
    else nearest = W'(u >> 2) + W'(u[1]);
  endfunction

  if (FOLD < 3) begin : g_parallel
    logic [shade_pkg::RSQRT_W-1:0] xx_q2, yy_q2, zz_q2, zz_q3, xy_q3;
    shade_mul #(.A_W(W), .B_W(W)) u_xx (.clk_i, .a_i(v_i.x), .b_i(v_i.x), .p_o(xx_q2));
    shade_mul #(.A_W(W), .B_W(W)) u_yy (.clk_i, .a_i(v_i.y), .b_i(v_i.y), .p_o(yy_q2));
    shade_mul #(.A_W(W), .B_W(W)) u_zz (.clk_i, .a_i(v_i.z), .b_i(v_i.z), .p_o(zz_q2));
    always_ff @(posedge clk_i) begin
      xy_q3  <= xx_q2 + yy_q2;
      zz_q3  <= zz_q2;
      square <= xy_q3 + zz_q3;
    end

    logic [V_W-1:0] v_q16;
    logic bypass_q14;
    logic [F-1:0] s_q16;
    shade_ring #(.WIDTH(1 + V_W), .DEPTH(shade_pkg::LATENCY_MUL + 2 + shade_pkg::LATENCY_RSQRT), .BLOCK(1)) u_v (
      .clk_i, .rst_i, .d_i({bypass_i, v_i}), .q_o({bypass_q14, v})
    );
    always_ff @(posedge clk_i) begin
      bypass_s <= bypass_q14;
      s_q16    <= s;
    end
    for (genvar c = 0; c < 3; c++) begin : g_component
      logic [U_W-1:0] u_q15;
      always_ff @(posedge clk_i) begin
        u_q15         <= U_W'($signed(v[c])) << shift(bypass_q14, short_v, e);
        v_q16[c*W+:W] <= nearest(u_q15);
      end
    end
    shade_scale3 #(.GAIN(1)) u_scale (.clk_i, .v_i(v_q16), .s_i(s_q16), .n_o(unit_o.normal));
    shade_delay #(.WIDTH(2), .DEPTH(2 + shade_pkg::LATENCY_SCALE3)) u_flags (
      .clk_i, .d_i({zero, short_v}), .q_o({unit_o.zero, unit_o.too_short})
    );
    logic unused_phase;
    assign unused_phase = &{1'b0, phase_i};
  end else begin : g_folded
    // clock 0 .. 2: v is chosen, a component a clock; its product is there three clocks later; 7: square; 17: r
    // START .. START + 2: v' and s are chosen; three clocks later a component of n is made. s and the shift have one place
    // each, for FOLD clocks, so that START is neither too early nor too late; and one multiplier is free then
    localparam int START = FOLD <= 6 ? 16 + FOLD : 12 + FOLD;
    localparam int EARLY = shade_pkg::LATENCY_UNIT_FOLDED - (START + 3 + FOLD);  // from the last clock in which n is whole

    // is it clock c of a vector?
    function automatic logic at(input int c);
      at = phase_i == shade_pkg::PHASE_W'(c % FOLD);
    endfunction

    // a vector moves on every FOLD clocks: in clock c it stands in place (c - 1) / FOLD
    localparam int AT_SHIFT = (START - 3) / FOLD, AT_X = (START - 2) / FOLD;
    localparam int AT_Y = (START - 1) / FOLD, AT_Z = START / FOLD;
    logic [(AT_Z+1)*V_W-1:0] v_q;
    logic [AT_Z:0] bypass_q;
    shade_pkg::vec_t first;
    always_ff @(posedge clk_i) begin
      if (at(0)) {v_q, bypass_q} <= {((AT_Z + 1) * V_W)'({v_q, v_i}), (AT_Z + 1)'({bypass_q, bypass_i})};
    end
    assign first = V_W'(v_q);
    assign v     = {W'(v_q >> (AT_Z * V_W + 2 * W)), W'(v_q >> (AT_Y * V_W + W)), W'(v_q >> (AT_X * V_W))};

    // factors of a square; v', s - 1/2: v' s = v' (s - 1/2) + v'/2
    logic [W-1:0] x_first, last, scaled_q1, scaled_q2, scaled_q3;
    logic [F-1:0] s_q;
    logic [2:0] shift_q;
    logic [U_W-1:0] u_q;
    logic signed [2*W-1:0] square_p, product_p;
    assign x_first  = at(1) ? first.x : at(2) ? first.y : first.z;
    assign last     = at(START - 1) ? v[0] : at(START) ? v[1] : v[2];
    assign bypass_s = bypass_q[AT_X];
    always_ff @(posedge clk_i) begin
      u_q       <= U_W'($signed(last)) << shift_q;
      scaled_q2 <= scaled_q1;
      scaled_q3 <= scaled_q2;
    end
    if (FOLD < 6) begin : g_two
      logic [W-1:0] x_q1;
      logic [F-1:0] s_q1;
      always_ff @(posedge clk_i) {x_q1, s_q1, scaled_q1} <= {x_first, s_q ^ HALF, nearest(u_q)};
      shade_mul #(.A_W(W), .B_W(W)) u_square (.clk_i, .a_i(x_q1), .b_i(x_q1), .p_o(square_p));
      shade_mul #(.A_W(W), .B_W(F)) u_product (.clk_i, .a_i(scaled_q1), .b_i(s_q1), .p_o(product_p));
    end else begin : g_one
      logic [F-1:0] b_q1;
      always_ff @(posedge clk_i) begin
        {scaled_q1, b_q1} <= at(1) || at(2) || at(3) ? {x_first, x_first} : {nearest(u_q), s_q ^ HALF};
      end
      shade_mul #(.A_W(W), .B_W(F)) u_mul (.clk_i, .a_i(scaled_q1), .b_i(b_q1), .p_o(product_p));
      assign square_p = product_p;
    end

    // n, with half an ulp: (p + v' 2^17 + 2^16) / 2^17
    localparam int N_F = F - 1;
    localparam int LATER = 6 / FOLD;
    logic signed [2*W:0] sum;
    logic [2*LATER+1:0] flags_q;
    shade_pkg::unit_t unit_q;
    assign sum = (2 * W + 1)'(product_p) + $signed({scaled_q3[W-1], scaled_q3, 1'b1, {(N_F - 1) {1'b0}}});
    always_ff @(posedge clk_i) begin
      if (at(4)) square <= square_p;
      else if (at(5) || at(6)) square <= square + square_p;
      if (at(START - 2)) begin
        shift_q <= shift(bypass_q[AT_SHIFT], short_v, e);
        flags_q <= (2 * (LATER + 1))'({flags_q, zero, short_v});
      end
      if (at(START - 1)) s_q <= s;
      if (at(START + 3)) unit_q.normal.x <= W'(sum >>> N_F);
      if (at(START + 4)) unit_q.normal.y <= W'(sum >>> N_F);
      if (at(START + 5)) begin
        unit_q.normal.z                 <= W'(sum >>> N_F);
        {unit_q.zero, unit_q.too_short} <= 2'(flags_q >> (2 * LATER));
      end
    end
    shade_delay #(.WIDTH($bits(unit_q)), .DEPTH(EARLY > 0 ? EARLY : 0)) u_wait (.clk_i, .d_i(unit_q), .q_o(unit_o));
    logic unused_bits;
    assign unused_bits = &{1'b0, rst_i, v_q};
  end
endmodule
