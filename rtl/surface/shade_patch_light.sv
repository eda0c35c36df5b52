// SPDX-License-Identifier: Apache-2.0
// shade_patch_light: Lambert's light and a highlight over N.H from scalars of an interpolated normal N that is not normalized.
//
//   node_i       {N.N, N.H, N.L}, S4.22
//   h_length_i   U1.22   |H| as it is quantized;   shift_i: the table holds the lobe of x 2^shift in [0, 1)
//   table_*      word {slope S-3.18, value U1.15} of chord table_at_i, written while no light is inside
//   diffuse_o    S1.16   N.L (1 + rho), 1 + rho = 1 / sqrt(N.N), S0.20 by shade_rsqrt
//   specular_o   S1.16   value + slope d of the chord at x = 1 - cos = |H| - N.H - N.H rho, where nothing cancels; 0 beyond the table
//   flags_o              bits PATCH_LIGHT_SHORT: N.N < 1/4, rho is limited; PATCH_LIGHT_LONG: N.N >= 4
//
// N.L and N.H enter the products as S1.16, rho that of N.L as S0.17; each product is rounded once, to nearest, ties up. Four
// multipliers and the two of shade_rsqrt. Latency LATENCY_PATCH_LIGHT = 24 clocks, one light a clock.
// Example: N = L = H, |N| = 3/4 -> rho = 1/3, diffuse 1, x = 0. Source: Duff 1979, Bishop and Weimer 1986: the scalars.
module shade_patch_light (
  input  logic                                     clk_i,
  input  logic                                     rst_i,
  input  logic [           shade_pkg::PATCH_DOT_F:0] h_length_i,
  input  logic [                              2:0] shift_i,
  input  logic                                     table_write_i,
  input  logic [    shade_pkg::PATCH_TABLE_LOG2-1:0] table_at_i,
  input  logic [                             31:0] table_i,
  input  logic                                     valid_i,
  input  logic [      3*shade_pkg::PATCH_DOT_W-1:0] node_i,
  output logic                                     valid_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] diffuse_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] specular_o,
  output logic [     shade_pkg::PATCH_FLAGS_W-1:0] flags_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int F = shade_pkg::INTENSITY_F;
  localparam int DOT_W = shade_pkg::PATCH_DOT_W;
  localparam int DOT_F = shade_pkg::PATCH_DOT_F;
  localparam int R_F = shade_pkg::RSQRT_F;
  localparam int R_W = R_F + 1;
  localparam int Z_W = shade_pkg::RSQRT_W;
  localparam int MUL = shade_pkg::LATENCY_MUL;
  localparam int RSQRT = shade_pkg::LATENCY_RSQRT;
  localparam int NEAR_W = DOT_W - DOT_F + F + 1;

  // ---- 1 / sqrt(N.N) -------------------------------------------------------------------------------------------------------
  logic signed [DOT_W-1:0] l, h, p;
  logic signed [NEAR_W-1:0] l_near, h_near;
  logic signed [W-1:0] l_fit, h_fit, l_q1, h_q1, l_q13, h_q13;
  logic signed [DOT_W-1:0] y_q1, y_q15;  // |H| - N.H
  logic [Z_W-1:0] z_q1;
  logic valid_q1, valid_q11, short_q1, long_q1, short_q11, long_q11, short_q13, long_q13;
  logic [R_F:0] y;
  logic [4:0] e;
  assign {p, h, l} = node_i;
  shade_round #(.WIDTH(DOT_W), .DROP(DOT_F - F), .OUT_W(NEAR_W)) u_l (.x_i(l), .y_o(l_near));
  shade_round #(.WIDTH(DOT_W), .DROP(DOT_F - F), .OUT_W(NEAR_W)) u_h (.x_i(h), .y_o(h_near));
  shade_limit #(.WIDTH(NEAR_W), .OUT_W(W)) u_l_fit (.x_i(l_near), .y_o(l_fit));
  shade_limit #(.WIDTH(NEAR_W), .OUT_W(W)) u_h_fit (.x_i(h_near), .y_o(h_fit));
  always_ff @(posedge clk_i) begin
    valid_q1 <= valid_i && !rst_i;
    l_q1     <= l_fit;
    h_q1     <= h_fit;
    y_q1     <= $signed(DOT_W'(h_length_i)) - h;
    z_q1     <= p <= 0 ? Z_W'(1) << (Z_W - 4 - DOT_F) : {p[DOT_W-2:0], {(Z_W - 4 - DOT_F) {1'b0}}};
    short_q1 <= p[DOT_W-1] || p[DOT_W-2:DOT_F-2] == '0;
    long_q1  <= !p[DOT_W-1] && p[DOT_W-2:DOT_F+2] != '0;
  end
  shade_rsqrt u_rsqrt (.clk_i, .z_i(z_q1), .y_o(y), .e_o(e), .zero_o());
  shade_valid #(.DEPTH(RSQRT)) u_valid_q11 (.clk_i, .rst_i, .valid_i(valid_q1), .valid_o(valid_q11));
  shade_delay #(.WIDTH(2), .DEPTH(RSQRT)) u_flags (.clk_i, .d_i({short_q1, long_q1}), .q_o({short_q11, long_q11}));
  shade_delay #(.WIDTH(2 * W), .DEPTH(RSQRT + 2)) u_lh (.clk_i, .d_i({h_q1, l_q1}), .q_o({h_q13, l_q13}));
  shade_delay #(.WIDTH(DOT_W), .DEPTH(RSQRT + 2 + MUL)) u_y (.clk_i, .d_i(y_q1), .q_o(y_q15));

  // ---- rho -------------------------------------------------------------------------------------------------------------------
  localparam int LESS = R_F - shade_pkg::PATCH_RHO_F;
  localparam int RHO_W = shade_pkg::PATCH_RHO_F + 1;
  logic [R_W:0] root;  // 1 + rho, U2.20
  logic signed [R_W-1:0] rho_q12, rho_q13;
  logic signed [RHO_W:0] rho_near;
  logic signed [RHO_W-1:0] rho_fit, less_q13;
  assign root = e == 5'd15 ? {y, 1'b0} : e == 5'd16 ? {1'b0, y} : {2'b00, y[R_F:1]};
  shade_round #(.WIDTH(R_W), .DROP(LESS), .OUT_W(RHO_W + 1)) u_rho (.x_i(rho_q12), .y_o(rho_near));
  shade_limit #(.WIDTH(RHO_W + 1), .OUT_W(RHO_W)) u_rho_fit (.x_i(rho_near), .y_o(rho_fit));
  logic short_q12, long_q12;
  always_ff @(posedge clk_i) begin
    // 2 and more: less than 2
    rho_q12  <= short_q11 || root[R_W] ? {1'b0, {R_F{1'b1}}} : {!root[R_F], root[R_F-1:0]};
    {short_q12, long_q12} <= {short_q11, long_q11};
    rho_q13  <= rho_q12;
    less_q13 <= rho_fit;
    {short_q13, long_q13} <= {short_q12, long_q12};
  end

  // ---- N.L (1 + rho), |H| - N.H (1 + rho) --------------------------------------------------------------------------------------
  localparam int L_W = W + RHO_W;
  localparam int X_W = R_W + W;
  localparam int X_DROP = F + R_F - DOT_F;
  logic signed [L_W-1:0] lr_q15;
  logic signed [X_W-1:0] hr_q15;
  logic signed [W-1:0] l_q15;
  logic signed [L_W:0] light_q16;
  logic signed [L_W-RHO_W+1:0] light_near;
  logic signed [W-1:0] light_fit, light_q17;
  logic signed [DOT_W+1:0] x_q16;
  shade_mul #(.A_W(W), .B_W(RHO_W)) u_lr (.clk_i, .a_i(l_q13), .b_i(less_q13), .p_o(lr_q15));
  shade_mul #(.A_W(R_W), .B_W(W)) u_hr (.clk_i, .a_i(rho_q13), .b_i(h_q13), .p_o(hr_q15));
  shade_delay #(.WIDTH(W), .DEPTH(MUL)) u_l15 (.clk_i, .d_i(l_q13), .q_o(l_q15));
  always_ff @(posedge clk_i) begin
    light_q16 <= (L_W + 1)'(lr_q15) + $signed({l_q15[W-1], l_q15, {(RHO_W - 1) {1'b0}}});
    x_q16     <= (DOT_W + 2)'(y_q15) - (DOT_W + 2)'((hr_q15 + $signed(X_W'(1) << (X_DROP - 1))) >>> X_DROP);
    light_q17 <= light_fit;
  end
  shade_round #(.WIDTH(L_W + 1), .DROP(RHO_W - 1), .OUT_W(L_W - RHO_W + 2)) u_light (.x_i(light_q16), .y_o(light_near));
  shade_limit #(.WIDTH(L_W - RHO_W + 2), .OUT_W(W)) u_light_fit (.x_i(light_near), .y_o(light_fit));
  shade_delay #(.WIDTH(W), .DEPTH(7)) u_diffuse (.clk_i, .d_i(light_q17), .q_o(diffuse_o));
  shade_delay #(.WIDTH(2), .DEPTH(11)) u_flags_o (
    .clk_i, .d_i({long_q13, short_q13}), .q_o(flags_o[shade_pkg::PATCH_LIGHT_LONG:shade_pkg::PATCH_LIGHT_SHORT])
  );
  assign flags_o[shade_pkg::PATCH_LIGHT_RANGE] = 1'b0;

  // ---- the lobe ----------------------------------------------------------------------------------------------------------------
  localparam int LOG2 = shade_pkg::PATCH_TABLE_LOG2;
  localparam int REST = DOT_F - LOG2;
  localparam int S_W = 16;
  localparam int P_W = S_W + REST + 1;
  logic [DOT_F:0] x_q17;
  logic [DOT_F+7:0] wide;
  logic [DOT_F-1:0] part_q18;
  logic inside_q18, inside_q22;
  logic [31:0] memory[0:(1<<LOG2)-1];
  logic [31:0] word_q19, word_q20;
  logic [REST-1:0] rest_q20;
  logic [S_W-1:0] value_q22;
  logic signed [P_W-1:0] product_q22;
  logic signed [P_W+3:0] sum_q23;
  logic signed [W:0] near_q;
  logic signed [W-1:0] fit;
  assign wide = (DOT_F + 8)'(x_q17) << shift_i;
  always_ff @(posedge clk_i) begin
    // below 0 by a rounding: 0; beyond the range of the versine: its end
    x_q17      <= x_q16 < 0 ? '0 : |x_q16[DOT_W:DOT_F+1] ? '1 : x_q16[DOT_F:0];
    part_q18   <= wide[DOT_F-1:0];
    inside_q18 <= wide[DOT_F+7:DOT_F] == '0;
  end
  always_ff @(posedge clk_i) begin
    if (table_write_i) memory[table_at_i] <= table_i;
    word_q19 <= memory[part_q18[DOT_F-1-:LOG2]];
    word_q20 <= word_q19;
  end
  shade_delay #(.WIDTH(REST), .DEPTH(2)) u_rest (.clk_i, .d_i(part_q18[REST-1:0]), .q_o(rest_q20));
  shade_delay #(.WIDTH(1), .DEPTH(4)) u_inside (.clk_i, .d_i(inside_q18), .q_o(inside_q22));
  shade_delay #(.WIDTH(S_W), .DEPTH(MUL)) u_value (.clk_i, .d_i(word_q20[S_W-1:0]), .q_o(value_q22));
  shade_mul #(.A_W(S_W), .B_W(REST + 1)) u_slope (
    .clk_i, .a_i(word_q20[31:S_W]), .b_i({1'b0, rest_q20}), .p_o(product_q22)
  );
  localparam int SUM_W = P_W + 4;  // values below 2
  assign near_q = (W + 1)'(sum_q23 >>> (REST + 2));
  shade_limit #(.WIDTH(W + 1), .OUT_W(W)) u_fit (.x_i(near_q), .y_o(fit));
  always_ff @(posedge clk_i) begin
    // the slope has three more fraction bits than the value, the result one more than it
    sum_q23    <= !inside_q22 ? '0 : SUM_W'(product_q22) + $signed(SUM_W'({value_q22, {(REST + 3) {1'b0}}})) +
                  $signed(SUM_W'(1) << (REST + 1));
    specular_o <= fit;
  end

  shade_valid #(.DEPTH(shade_pkg::LATENCY_PATCH_LIGHT - RSQRT - 1)) u_valid (.clk_i, .rst_i, .valid_i(valid_q11), .valid_o);
endmodule
