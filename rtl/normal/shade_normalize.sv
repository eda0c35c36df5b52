// SPDX-License-Identifier: Apache-2.0
// shade_normalize: n = v / |v| for vectors of every length, to the last bit.
//
//   v_i            S1.16              any vector but 0
//   n_o            S1.16              unit vector; each component within 1 ulp of the exact one (bound 5/8)
//   zero_o                            v = 0: the result is 0
//
//   s = x^2 + y^2 + z^2               exact, U4.32
//   1/sqrt(s) = r 2^(16-e)            shade_rsqrt: r is U1.20 within 1 ulp, 2^e <= |v| < 2^(e+1) in ulp
//   w = v 2^(17-e)                    19 bits: |w| < 2^18, whatever the length of v
//   n = w r / 2^21                    rounded once, to nearest, ties up
//
// w is 2 h + b: the multiplier takes the 18 bits of h, b adds r: it is 1 for |v| >= 2 only. Nine 18 x 18 multipliers for the
// vector, two in shade_rsqrt. Latency LATENCY_NORMALIZE = 19 clocks, one vector a clock.
// Example: v = (3, 0, 4) 2^-16 -> n = (0.6, 0, 0.8). Source: P4, section 2; P2.
module shade_normalize (
  input  logic            clk_i,
  input  logic            rst_i,
  input  shade_pkg::vec_t v_i,
  output shade_pkg::vec_t n_o,
  output logic            zero_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int S_W = shade_pkg::RSQRT_W;
  localparam int R_W = shade_pkg::RSQRT_F + 1;
  localparam int MUL = shade_pkg::LATENCY_MUL;
  localparam int TO_ROOT = MUL + 2 + shade_pkg::LATENCY_RSQRT;

  // ---- |v|^2 and its root --------------------------------------------------------------------------------------
  logic [S_W-1:0] xx_q2, yy_q2, zz_q2, zz_q3, xy_q3, s_q4;
  shade_mul #(.A_W(W), .B_W(W)) u_xx (.clk_i, .a_i(v_i.x), .b_i(v_i.x), .p_o(xx_q2));
  shade_mul #(.A_W(W), .B_W(W)) u_yy (.clk_i, .a_i(v_i.y), .b_i(v_i.y), .p_o(yy_q2));
  shade_mul #(.A_W(W), .B_W(W)) u_zz (.clk_i, .a_i(v_i.z), .b_i(v_i.z), .p_o(zz_q2));
  always_ff @(posedge clk_i) begin
    xy_q3 <= xx_q2 + yy_q2;
    zz_q3 <= zz_q2;
    s_q4  <= xy_q3 + zz_q3;  // at most 3 * 2^34 < 2^36
  end

  logic [R_W-1:0] r_q14, r_q15, r_q16;
  logic [4:0] e_q14;
  logic zero_q14;
  shade_rsqrt u_rsqrt (.clk_i, .z_i(s_q4), .y_o(r_q14), .e_o(e_q14), .zero_o(zero_q14));

  // ---- w = v 2^(17-e), in steps of 4, then of 1 ----------------------------------------------------------------
  logic [2:0][W-1:0] v_q14;
  logic [2:0] fours;
  logic [1:0] ones, ones_q15;
  shade_ring #(.WIDTH($bits(v_i)), .DEPTH(TO_ROOT)) u_v (.clk_i, .rst_i, .d_i(v_i), .q_o(v_q14));
  assign {fours, ones} = 5'd17 - e_q14;
  always_ff @(posedge clk_i) begin
    ones_q15 <= ones;
    r_q15    <= r_q14;
    r_q16    <= r_q15;
  end

  // ---- the three components ------------------------------------------------------------------------------------
  logic [2:0][W-1:0] n_q19;
  for (genvar c = 0; c < 3; c++) begin : g_component
    localparam int P_W = R_W + 1 + W;
    logic signed [W:0] w_q15, w_q16;
    logic signed [P_W-1:0] p_q18;
    logic signed [P_W:0] sum;
    logic [R_W:0] addend_q17, addend_q18;  // b r + half an ulp of n

    always_ff @(posedge clk_i) begin
      w_q15      <= (W + 1)'($signed(v_q14[c])) <<< {fours, 2'b00};
      w_q16      <= w_q15 <<< ones_q15;
      addend_q17 <= {1'b0, w_q16[0] ? r_q16 : '0} + ((R_W + 1)'(1) << shade_pkg::RSQRT_F);
      addend_q18 <= addend_q17;
      n_q19[c]   <= W'(sum >>> R_W);
    end
    shade_mul #(.A_W(R_W + 1), .B_W(W)) u_product (.clk_i, .a_i({1'b0, r_q16}), .b_i(W'(w_q16 >>> 1)), .p_o(p_q18));
    assign sum = ((P_W + 1)'(p_q18) <<< 1) + (P_W + 1)'({1'b0, addend_q18});
  end
  assign n_o = n_q19;

  shade_delay #(.WIDTH(1), .DEPTH(2 + MUL + 1)) u_zero (.clk_i, .d_i(zero_q14), .q_o(zero_o));
endmodule
