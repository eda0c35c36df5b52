// SPDX-License-Identifier: Apache-2.0
// shade_unit: n = v / |v| of an interpolated normal, which is not far from unit length; or v as it is.
//
//   x_i, y_i, z_i  sdd.ffff        S2.15, |v| >= 1/8
//   bypass_i                       no normalization (P2): n = v, saturated to S1.16
//   x_o, y_o, z_o  sd.ffff         S1.16, to nearest, ties up: within 0.88 ulp for |v| < 2, 1.64 ulp for longer ones
//   zero_o, short_o                v = 0: n = 0; |v| < 1/8: n is too short. Both are about v, bypassed or not.
//
//   z = x^2 + y^2 + z^2            exact, U6.30
//   1/|v| = r 2^(15-e)             shade_rsqrt
//   v' = v 2^(15-e)                17 bits, rounded where e > 15: 2^15 <= |v'| < 2^16, but for |v| < 1/8, shifted by 3 only
//   n = v' s / 2^17                s = r to 18 fraction bits, below 1
//
// FOLD = 1: eight 18 x 18 multipliers, a vector a clock, latency LATENCY_UNIT = 19 clocks, ready_o is 1.
// FOLD = 6: three, of which one makes the six products of v: a vector in 6 clocks, latency LATENCY_UNIT_FOLDED = 30 clocks;
//           ready_o is 1 in every sixth clock.
// shade_normalize, for vectors of every length, takes eleven. Example: v = (0.3, 0, 0.4) -> n = (0.6, 0, 0.8).
// Source: P4, section 2 (interpolated normals); P2 (those that need no normalizing).
module shade_unit #(
  parameter int FOLD = 1
) (
  input  logic                                     clk_i,
  input  logic                                     rst_i,
  input  logic                                     valid_i,
  output logic                                     ready_o,
  input  logic                                     bypass_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] x_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] y_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] z_i,
  output logic                                     valid_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] x_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] y_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] z_o,
  output logic                                     zero_o,
  output logic                                     short_o
);
  if (FOLD != 1 && FOLD != 6) begin : g_check
    $error("shade_unit: FOLD must be 1 or 6");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int V_W = W + W + W;
  localparam int U_W = W + 3;  // v shifted left by 0 .. 5: v' with two fraction bits; twice v, which is to be saturated
  localparam int F = shade_pkg::INVC_F;
  localparam int R_F = shade_pkg::RSQRT_F;
  localparam int MUL = shade_pkg::LATENCY_MUL;

  logic [shade_pkg::RSQRT_W-1:0] square;
  logic [R_F:0] r;
  logic [4:0] e;
  logic zero, short_v;
  shade_rsqrt u_rsqrt (.clk_i, .rst_i, .valid_i(1'b0), .z_i(square), .valid_o(), .y_o(r), .e_o(e), .zero_o(zero));
  assign short_v = e < 5'd12;

  // s, a clock behind r and a clock later; 1/2 for v' = 2 v, as it is
  logic [F:0] near_q;
  logic [F-1:0] s;
  logic bypass_s;
  always_ff @(posedge clk_i) near_q <= r[R_F:R_F-F] + (F + 1)'(r[R_F-F-1]);
  assign s = bypass_s ? F'(1) << (F - 1) : near_q[F-1:0] | {F{near_q[F]}};

  // how far v is shifted: 2 + 15 - e
  function automatic logic [2:0] shift(input logic bypass, input logic too_short, input logic [4:0] exponent);
    shift = bypass ? 3'd3 : too_short ? 3'd5 : 3'(5'd17 - exponent);
  endfunction

  // v', to nearest; only twice v can be too large, and has no fraction bits
  function automatic logic [W-1:0] nearest(input logic [U_W-1:0] u);
    if (u[U_W-1] != u[U_W-2]) nearest = {u[U_W-1], {(W - 1) {!u[U_W-1]}}};
    else nearest = u[2+:W] + W'(u[1]);
  endfunction

  if (FOLD == 1) begin : g_parallel
    logic [shade_pkg::RSQRT_W-1:0] xx_q2, yy_q2, zz_q2, zz_q3, xy_q3, square_q4;
    shade_mul #(.A_W(W), .B_W(W)) u_xx (.clk_i, .a_i(x_i), .b_i(x_i), .p_o(xx_q2));
    shade_mul #(.A_W(W), .B_W(W)) u_yy (.clk_i, .a_i(y_i), .b_i(y_i), .p_o(yy_q2));
    shade_mul #(.A_W(W), .B_W(W)) u_zz (.clk_i, .a_i(z_i), .b_i(z_i), .p_o(zz_q2));
    always_ff @(posedge clk_i) begin
      xy_q3     <= xx_q2 + yy_q2;
      zz_q3     <= zz_q2;
      square_q4 <= xy_q3 + zz_q3;
    end
    assign square = square_q4;

    logic [V_W-1:0] v_q14, v_q16;
    logic bypass_q14, bypass_q15;
    logic [2:0] shift_q14;
    logic [F-1:0] s_q16;
    shade_ring #(.WIDTH(V_W + 1), .DEPTH(MUL + 2 + shade_pkg::LATENCY_RSQRT)) u_v (
      .clk_i, .rst_i, .d_i({bypass_i, z_i, y_i, x_i}), .q_o({bypass_q14, v_q14})
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
        u_q15         <= U_W'($signed(v_q14[c*W+:W])) << shift_q14;
        v_q16[c*W+:W] <= nearest(u_q15);
      end
    end
    shade_scale3 #(.GAIN(1)) u_scale (
      .clk_i, .rst_i, .valid_i(1'b0), .ready_o(), .x_i(v_q16[0+:W]), .y_i(v_q16[W+:W]), .z_i(v_q16[2*W+:W]),
      .s_i(s_q16), .valid_o(), .x_o, .y_o, .z_o
    );
    shade_delay #(.WIDTH(2), .DEPTH(2 + shade_pkg::LATENCY_SCALE3)) u_flags (
      .clk_i, .d_i({zero, short_v}), .q_o({zero_o, short_o})
    );
    assign ready_o = 1'b1;
    shade_valid #(.DEPTH(shade_pkg::LATENCY_UNIT)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);
  end else begin : g_folded
    // phase        0     1     2     3     4     5     0     1     2     3     4     5     0
    // taken        v
    // factors                  x     y     z                                              square: from phase 1 of the
    // square                               x2    y2    z2    all (till phase 4)           next turn; r 10 clocks later
    // third turn:  v_q3 ...          shift x y     z     v' as factor from phase 5, n from phase 2 of the fifth turn on
    logic [2:0] phase_q;
    assign ready_o = phase_q == 3'd0;
    always_ff @(posedge clk_i) begin
      phase_q <= phase_q == 3'd5 ? 3'd0 : phase_q + 3'd1;
      if (rst_i) phase_q <= 3'd0;
    end

    // a vector moves on every sixth clock; its square is made of the first place, v' of the last
    logic [4*(V_W+1)-1:0] v_q;
    logic [V_W-1:0] first, last;
    assign first    = v_q[0+:V_W];
    assign last     = v_q[3*(V_W+1)+:V_W];
    assign bypass_s = v_q[4*(V_W+1)-1];
    always_ff @(posedge clk_i) if (ready_o) v_q <= {v_q[3*(V_W+1)-1:0], bypass_i, z_i, y_i, x_i};

    // squares enter in phases 1, 2, 3, v' and s in 4, 5, 0
    logic squares;
    logic [W-1:0] x_first, x_last, a_q1, a_q2, a_q3;
    logic [F-1:0] b_q1, s_q;
    logic [2:0] shift_q;
    logic [1:0] flags_q;
    logic [U_W-1:0] u_q;
    logic signed [2*W-1:0] p_q3;
    assign squares = phase_q == 3'd1 || phase_q == 3'd2 || phase_q == 3'd3;
    assign x_first = phase_q == 3'd1 ? first[0+:W] : phase_q == 3'd2 ? first[W+:W] : first[2*W+:W];
    assign x_last  = phase_q == 3'd3 ? last[0+:W] : phase_q == 3'd4 ? last[W+:W] : last[2*W+:W];
    always_ff @(posedge clk_i) begin
      u_q  <= U_W'($signed(x_last)) << shift_q;
      a_q1 <= squares ? x_first : nearest(u_q);
      b_q1 <= squares ? x_first : {!s_q[F-1], s_q[F-2:0]};  // v' s = v' (s - 1/2) + v'/2
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
      if (phase_q == 3'd4) square_q <= p_q3;
      else if (phase_q == 3'd5 || phase_q == 3'd0) square_q <= square_q + p_q3;
      if (phase_q == 3'd2) begin
        shift_q           <= shift(bypass_s, short_v, e);
        flags_q           <= {zero, short_v};
        {zero_o, short_o} <= flags_q;
      end
      if (phase_q == 3'd3) s_q <= s;
      if (phase_q == 3'd1) x_o <= W'(sum >>> N_F);
      if (phase_q == 3'd2) y_o <= W'(sum >>> N_F);
      if (phase_q == 3'd3) z_o <= W'(sum >>> N_F);
    end
    shade_valid #(.DEPTH(shade_pkg::LATENCY_UNIT_FOLDED)) u_valid (
      .clk_i, .rst_i, .valid_i(valid_i && ready_o), .valid_o
    );
  end
endmodule
