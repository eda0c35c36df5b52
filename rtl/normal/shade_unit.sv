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
// FOLD = 1: eight 18 x 18 multipliers, a vector a clock, latency LATENCY_UNIT = 19 clocks.
// FOLD = 6: three, of which one makes the six products of v: a vector in 6 clocks, taken when phase_i is 0; phase_i counts
//           0 .. 5. Latency LATENCY_UNIT_FOLDED = 30 clocks. Other folds would need another order of the six products.
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
  if (FOLD != 1 && FOLD != 6) begin : g_check
    $error("shade_unit: FOLD must be 1 or 6");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int V_W = shade_pkg::VEC_BITS;
  localparam int U_W = W + 3;  // v shifted left by 0 .. 5: v' with two fraction bits; twice v, which is to be saturated
  localparam int F = shade_pkg::INVC_F;
  localparam int R_F = shade_pkg::RSQRT_F;
  localparam int MUL = shade_pkg::LATENCY_MUL;

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

  if (FOLD == 1) begin : g_parallel
    logic [shade_pkg::RSQRT_W-1:0] xx_q2, yy_q2, zz_q2, zz_q3, xy_q3, square_q4;
    shade_mul #(.A_W(W), .B_W(W)) u_xx (.clk_i, .a_i(v_i.x), .b_i(v_i.x), .p_o(xx_q2));
    shade_mul #(.A_W(W), .B_W(W)) u_yy (.clk_i, .a_i(v_i.y), .b_i(v_i.y), .p_o(yy_q2));
    shade_mul #(.A_W(W), .B_W(W)) u_zz (.clk_i, .a_i(v_i.z), .b_i(v_i.z), .p_o(zz_q2));
    always_ff @(posedge clk_i) begin
      xy_q3     <= xx_q2 + yy_q2;
      zz_q3     <= zz_q2;
      square_q4 <= xy_q3 + zz_q3;
    end
    assign square = square_q4;

    logic [2:0][W-1:0] v_q14, v_q16;
    logic bypass_q14, bypass_q15;
    logic [2:0] shift_q14;
    logic [F-1:0] s_q16;
    shade_ring #(.WIDTH(1 + V_W), .DEPTH(MUL + 2 + shade_pkg::LATENCY_RSQRT)) u_v (
      .clk_i, .rst_i, .d_i({bypass_i, v_i}), .q_o({bypass_q14, v_q14})
    );
    assign shift_q14 = shift(bypass_q14, short_v, e);
    assign bypass_s  = bypass_q15;
    always_ff @(posedge clk_i) begin
      bypass_q15 <= bypass_q14;
      s_q16      <= s;
    end
    for (genvar c = 0; c < 3; c++) begin : g_component
      logic [U_W-1:0] u_q15;
      always_ff @(posedge clk_i) begin
        u_q15    <= U_W'($signed(v_q14[c])) << shift_q14;
        v_q16[c] <= nearest(u_q15);
      end
    end
    shade_scale3 #(.GAIN(1)) u_scale (.clk_i, .v_i(v_q16), .s_i(s_q16), .n_o(unit_o.normal));
    shade_delay #(.WIDTH(2), .DEPTH(2 + shade_pkg::LATENCY_SCALE3)) u_flags (
      .clk_i, .d_i({zero, short_v}), .q_o({unit_o.zero, unit_o.too_short})
    );
    logic unused_phase;
    assign unused_phase = &{1'b0, phase_i};
  end else begin : g_folded
    // phase        0     1     2     3     4     5     0     1     2     3     4     5     0
    // taken        v
    // factors                  x     y     z                                              square: from phase 1 of the
    // square                               x2    y2    z2    all (till phase 4)           next turn; r 10 clocks later
    // third turn:  v_q3 ...          shift x y     z     v' as factor from phase 5, n from phase 2 of the fifth turn on

    // is it clock c of a vector?
    function automatic logic at(input int c);
      at = phase_i == shade_pkg::PHASE_W'(c % FOLD);
    endfunction

    // a vector moves on every sixth clock; its square is made of the first place, v' of the last
    localparam int PLACES = 4;
    localparam int PLACE_W = 1 + V_W;
    logic [PLACES-1:0][PLACE_W-1:0] v_q;
    logic [2:0][W-1:0] first, last;
    assign first    = V_W'(v_q[0]);
    assign last     = V_W'(v_q[PLACES-1]);
    assign bypass_s = v_q[PLACES-1][PLACE_W-1];
    always_ff @(posedge clk_i) if (at(0)) v_q <= (PLACES * PLACE_W)'({v_q, bypass_i, v_i});

    // squares enter in phases 1, 2, 3, v' and s in 4, 5, 0
    logic squares;
    logic [W-1:0] x_first, x_last, a_q1, a_q2, a_q3;
    logic [F-1:0] b_q1, s_q;
    logic [2:0] shift_q;
    logic [1:0] flags_q;
    logic [U_W-1:0] u_q;
    logic signed [2*W-1:0] p_q3;
    assign squares = at(1) || at(2) || at(3);
    assign x_first = at(1) ? first[0] : at(2) ? first[1] : first[2];
    assign x_last  = at(21) ? last[0] : at(22) ? last[1] : last[2];
    always_ff @(posedge clk_i) begin
      u_q  <= U_W'($signed(x_last)) << shift_q;
      a_q1 <= squares ? x_first : nearest(u_q);
      b_q1 <= squares ? x_first : s_q ^ HALF;  // v' s = v' (s - 1/2) + v'/2
      a_q2 <= a_q1;
      a_q3 <= a_q2;
    end
    shade_mul #(.A_W(W), .B_W(F)) u_mul (.clk_i, .a_i(a_q1), .b_i(b_q1), .p_o(p_q3));

    // n, with half an ulp: (p + v' 2^17 + 2^16) / 2^17
    localparam int N_F = F - 1;
    logic [shade_pkg::RSQRT_W-1:0] square_q;
    logic signed [2*W:0] sum;
    assign sum    = (2 * W + 1)'(p_q3) + $signed({a_q3[W-1], a_q3, 1'b1, {(N_F - 1) {1'b0}}});
    assign square = square_q;
    always_ff @(posedge clk_i) begin
      if (at(4)) square_q <= p_q3;
      else if (at(5) || at(6)) square_q <= square_q + p_q3;
      if (at(20)) begin
        shift_q                     <= shift(bypass_s, short_v, e);
        flags_q                     <= {zero, short_v};
        {unit_o.zero, unit_o.too_short} <= flags_q;
      end
      if (at(21)) s_q <= s;
      if (at(25)) unit_o.normal.x <= W'(sum >>> N_F);
      if (at(26)) unit_o.normal.y <= W'(sum >>> N_F);
      if (at(27)) unit_o.normal.z <= W'(sum >>> N_F);
    end
    logic unused_reset;
    assign unused_reset = rst_i;
  end
endmodule
