// SPDX-License-Identifier: Apache-2.0
// yardstick_beckmann: what shade_lobe stands for, evaluated directly: the distribution of Cook and Torrance relative to
// its peak, or, with WARD = 1, Ward's exponential alone.
//
//   WARD = 0   D m^2 4 = exp(-tan^2 g / m^2) / cos^4 g       WARD = 1   exp(-tan^2 g / m^2)
//
//   c_i           U1.16   c = cos g, in [0, 1]
//   k_i, shift_i  U1.16   log2(e) / m^2 = k 2^shift, k in [1, 2), shift 0 .. 9: m in 0.05 .. 0.7; constant while values
//                         are in flight
//   y_o           U1.16   within 2.5 ulp (WARD = 0), 1.25 ulp (WARD = 1) of the formula, for every c
//
// u = 1/c^2 by shade_rsqrt of c^4, b = (1 - c^2) u k 2^shift, 2^-b by a table of 16 rows and a parabola.
// Multipliers of 18 x 18 bits: 11 (WARD = 1: 9). One value a clock, 43 clocks (36).
module yardstick_beckmann #(
  parameter bit WARD = 1'b0
) (
  input  logic        clk_i,
  input  logic        rst_i,
  input  logic        valid_i,
  input  logic [16:0] c_i,
  input  logic [16:0] k_i,
  input  logic [ 3:0] shift_i,
  output logic        valid_o,
  output logic [16:0] y_o
);
  localparam int LATENCY = WARD ? 36 : 43;

  // ---- s = 1 - c^2, to 17 fraction bits for u, shifted to U5.19 for b ----------------------------------------------
  logic [34:0] cc_q2;
  logic [32:0] s_q3;
  logic [17:0] s_near;
  logic [16:0] s_q4;
  logic [41:0] s_shifted_q4;
  logic [23:0] s_b_q5, s_b_q21;
  logic [28:0] s_b;
  shade_square #(.WIDTH(18)) u_cc (.clk_i, .x_i({1'b0, c_i}), .y_o(cc_q2));
  assign s_near = 18'(s_q3[32:15]) + 18'(s_q3[14]);
  assign s_b    = s_shifted_q4[41:13] + 29'(s_shifted_q4[12]);
  always_ff @(posedge clk_i) begin
    s_q3         <= {1'b1, 32'd0} - cc_q2[32:0];
    s_q4         <= s_near[16:0] | {17{s_near[17]}};
    s_shifted_q4 <= 42'(s_q3) << shift_i;
    s_b_q5       <= s_b[23:0] | {24{|s_b[28:24]}};
  end
  shade_delay #(.WIDTH(24), .DEPTH(16)) u_s_b (.clk_i, .d_i(s_b_q5), .q_o(s_b_q21));

  // ---- z = c^4 = (1 - s)^2, u = 1/sqrt(z) = y 2^(17 - e) -----------------------------------------------------------
  logic [34:0] ss_q6, rest_q5, rest_q6, z_q7;
  logic [20:0] y_q17;
  logic [ 4:0] e_q17, e_q23;
  logic [18:0] y18;
  logic [17:0] y18_q18;
  logic [17:0] y17;
  logic [16:0] y17_q18;
  shade_square #(.WIDTH(18)) u_ss (.clk_i, .x_i({1'b0, s_q4}), .y_o(ss_q6));
  always_ff @(posedge clk_i) begin
    rest_q5 <= {1'b1, 34'd0} - {s_q4, 18'd0};
    rest_q6 <= rest_q5;
    z_q7    <= rest_q6 + ss_q6;
    y18_q18 <= y18[17:0] | {18{y18[18]}};
    y17_q18 <= y17[16:0] | {17{y17[17]}};
  end
  assign y18 = y_q17[20:2] + 19'(y_q17[1]);
  assign y17 = y_q17[20:3] + 18'(y_q17[2]);
  shade_rsqrt u_rsqrt (
    .clk_i, .z_i({1'b0, z_q7}), .y_o(y_q17), .e_o(e_q17), .zero_o()
  );
  shade_delay #(.WIDTH(5), .DEPTH(6)) u_e (.clk_i, .d_i(e_q17), .q_o(e_q23));

  // ---- b = s k u, U5.18; 32 and more gives 0 -----------------------------------------------------------------------
  logic signed [35:0] ky_q20;
  logic [16:0] ky_q21;
  logic signed [42:0] b_q23;
  logic [45:0] b_shifted;
  logic [22:0] b_q24;
  logic over_q24;
  shade_mul #(.A_W(18), .B_W(18)) u_ky (
    .clk_i, .a_i($signed({1'b0, k_i})), .b_i($signed({1'b0, y17_q18})), .p_o(ky_q20)
  );
  shade_mul #(.A_W(25), .B_W(18)) u_b (
    .clk_i, .a_i($signed({1'b0, s_b_q21})), .b_i($signed({1'b0, ky_q21})), .p_o(b_q23)
  );
  assign b_shifted = 46'(b_q23[41:0]) << (5'd17 - e_q23);
  always_ff @(posedge clk_i) begin
    ky_q21   <= ky_q20[33:17] + 17'(ky_q20[16]);
    b_q24    <= b_shifted[39:17];
    over_q24 <= e_q23 < 5'd13 || |b_shifted[45:40];
  end

  // ---- 2^-b = 2^-i T (1 + r): T = 2^-((row + 1/2)/16), r = -ln2 d + (ln2 d)^2/2, d from the middle of the row ------
  logic [20:0] t_q25, t_q30, t_q32, e0_q33;
  logic signed [13:0] d_q24, d_q26;
  logic [26:0] dd_q26;
  logic signed [17:0] r_q30;
  logic signed [35:0] tr_q32;
  always_ff @(posedge clk_i) begin
    // registers of its own: Yosys' iCE40 flow fails on a factor that is part register, part inverter
    d_q24 <= {~b_shifted[30], b_shifted[29:17]};
    case (b_q24[17:14])
      4'd0:  t_q25 <= 21'd2052214;
      4'd1:  t_q25 <= 21'd1965207;
      4'd2:  t_q25 <= 21'd1881889;
      4'd3:  t_q25 <= 21'd1802103;
      4'd4:  t_q25 <= 21'd1725700;
      4'd5:  t_q25 <= 21'd1652536;
      4'd6:  t_q25 <= 21'd1582474;
      4'd7:  t_q25 <= 21'd1515382;
      4'd8:  t_q25 <= 21'd1451135;
      4'd9:  t_q25 <= 21'd1389611;
      4'd10: t_q25 <= 21'd1330696;
      4'd11: t_q25 <= 21'd1274279;
      4'd12: t_q25 <= 21'd1220254;
      4'd13: t_q25 <= 21'd1168519;
      4'd14: t_q25 <= 21'd1118978;
      4'd15: t_q25 <= 21'd1071537;
    endcase
    e0_q33 <= t_q32 + 21'(tr_q32 >>> 18) + 21'(tr_q32[17]);
  end
  shade_square #(.WIDTH(14)) u_dd (.clk_i, .x_i(d_q24), .y_o(dd_q26));
  shade_delay #(.WIDTH(14), .DEPTH(2)) u_d (.clk_i, .d_i(d_q24), .q_o(d_q26));
  shade_weigh #(
    .WIDTH(17), .F(20), .OUT_W(18), .OUT_F(22), .K0(0), .KX(-45426), .KY(15743), .KZ(0)
  ) u_r (
    .clk_i, .x_i({d_q26[13], d_q26, 2'b00}), .y_i($signed({6'd0, dd_q26[26:16]})), .z_i(17'sd0), .w_o(r_q30)
  );
  shade_delay #(.WIDTH(21), .DEPTH(5)) u_t30 (.clk_i, .d_i(t_q25), .q_o(t_q30));
  shade_delay #(.WIDTH(21), .DEPTH(2)) u_t32 (.clk_i, .d_i(t_q30), .q_o(t_q32));
  shade_mul #(.A_W(18), .B_W(18)) u_tr (
    .clk_i, .a_i($signed({1'b0, t_q30[20:4]})), .b_i(r_q30), .p_o(tr_q32)
  );

  // ---- Ward: shift and round; Cook-Torrance: times u^2 = y^2 2^(2 (17 - e)) before ---------------------------------
  localparam int AT = LATENCY - 3;
  logic [42:0] wide, shifted_q1, shifted_q2;  // U8.35
  logic [4:0] e_q24;
  logic [5:0] right_q25, right, right_q1;  // shift
  logic [3:0] octaves;
  logic over_q25, over, over_q1, over_q2;
  assign octaves = WARD ? 4'd0 : 4'(5'd17 - e_q24);  // of u
  always_ff @(posedge clk_i) begin
    e_q24     <= e_q23;
    right_q25 <= 6'(b_q24[22:18]) + 6'd8 - {1'b0, octaves, 1'b0};
    over_q25  <= over_q24;
  end
  shade_delay #(.WIDTH(7), .DEPTH(AT - 25)) u_right (.clk_i, .d_i({over_q25, right_q25}), .q_o({over, right}));

  if (WARD) begin : g_ward
    assign wide = {e0_q33, 22'd0};
  end else begin : g_cook_torrance
    // v s = v (s - 1/2) + v/2 for s = y, U0.18: one bit more than a signed multiplier takes
    logic [17:0] y_q34, y_q37, v;
    logic [16:0] v_q34, v_q36, vy_q37, vy_q39;
    logic signed [35:0] offset_q36, offset_q39, sum;
    logic [34:0] vyy_q40;
    shade_delay #(.WIDTH(18), .DEPTH(16)) u_y34 (.clk_i, .d_i(y18_q18), .q_o(y_q34));
    shade_delay #(.WIDTH(18), .DEPTH(3)) u_y37 (.clk_i, .d_i(y_q34), .q_o(y_q37));
    shade_delay #(.WIDTH(17), .DEPTH(2)) u_v (.clk_i, .d_i(v_q34), .q_o(v_q36));
    shade_delay #(.WIDTH(17), .DEPTH(2)) u_vy (.clk_i, .d_i(vy_q37), .q_o(vy_q39));
    shade_mul #(.A_W(18), .B_W(18)) u_first (
      .clk_i, .a_i($signed({1'b0, v_q34})), .b_i($signed({~y_q34[17], y_q34[16:0]})), .p_o(offset_q36)
    );
    shade_mul #(.A_W(18), .B_W(18)) u_second (
      .clk_i, .a_i($signed({1'b0, vy_q37})), .b_i($signed({~y_q37[17], y_q37[16:0]})), .p_o(offset_q39)
    );
    assign v   = 18'(e0_q33[20:4]) + 18'(e0_q33[3]);
    assign sum = offset_q36 + $signed({1'b0, 18'(v_q36) + 18'd1, 17'd0});  // with half an ulp of vy
    always_ff @(posedge clk_i) begin
      v_q34   <= v[16:0] | {17{v[17]}};
      vy_q37  <= sum[34:18];
      vyy_q40 <= offset_q39[34:0] + {1'b0, vy_q39, 17'd0};
    end
    assign wide = {vyy_q40, 8'd0};
  end
  always_ff @(posedge clk_i) begin
    shifted_q1 <= wide >> {right[5:3], 3'd0};
    right_q1   <= right;
    over_q1    <= over;
    shifted_q2 <= shifted_q1 >> right_q1[2:0];
    over_q2    <= over_q1;
    y_o        <= over_q2 ? '0 : shifted_q2[35:19] + 17'(shifted_q2[18]);
  end

  shade_valid #(.DEPTH(LATENCY)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);
endmodule
