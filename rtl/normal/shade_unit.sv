// shade_unit: n = v / |v| of an interpolated normal, 1/8 <= |v| < 4; or v as it is.
//
//   x_i .. z_i     S2.15
//   z = v.v        U6.30, exact          1/|v| = r 2^(15-e) by shade_rsqrt
//   v'             v 2^(15-e), S2.15, shifted by -2 .. 3: at least as long as 1/2 where |v| >= 1/8
//   x_o .. z_o     S1.16 = v' s, s = r to 18 fraction bits; to nearest, ties up
//   bypass_i       no normalization (P2): v, saturated to S1.16
//   zero_o, short_o  v = 0: the result is 0; |v| < 1/8: it stays too short
//
// Eight 18 x 18 multipliers. Latency LATENCY_UNIT = 19 clocks, one vector a clock. Source: P4 (interpolated normals).
// Example: (0.3, 0, 0.4) -> (0.6, 0, 0.8).
module shade_unit (
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
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int F = shade_pkg::INVC_F;
  localparam int S_W = shade_pkg::RSQRT_W;
  localparam int R_W = shade_pkg::RSQRT_F + 1;
  localparam int MUL = shade_pkg::LATENCY_MUL;

  logic [S_W-1:0] xx_q2, yy_q2, zz_q2, zz_q3, xy_q3, s_q4;
  shade_mul #(.A_W(W), .B_W(W)) u_xx (.clk_i, .a_i(x_i), .b_i(x_i), .p_o(xx_q2));
  shade_mul #(.A_W(W), .B_W(W)) u_yy (.clk_i, .a_i(y_i), .b_i(y_i), .p_o(yy_q2));
  shade_mul #(.A_W(W), .B_W(W)) u_zz (.clk_i, .a_i(z_i), .b_i(z_i), .p_o(zz_q2));
  always_ff @(posedge clk_i) begin
    xy_q3 <= xx_q2 + yy_q2;
    zz_q3 <= zz_q2;
    s_q4  <= xy_q3 + zz_q3;
  end
  logic [R_W-1:0] r_q14;
  logic [4:0] e_q14;
  logic zero_q14;
  shade_rsqrt u_rsqrt (
    .clk_i, .rst_i, .valid_i(1'b0), .z_i(s_q4), .valid_o(), .y_o(r_q14), .e_o(e_q14), .zero_o(zero_q14)
  );

  logic [3*W-1:0] v_q14, v_q16;
  logic bypass_q14;
  logic [2:0] shift;  // 15 - e + 2, in 0 .. 5
  logic [F-1:0] s_q15, s_q16;
  shade_delay #(.WIDTH(3 * W + 1), .DEPTH(MUL + 2 + shade_pkg::LATENCY_RSQRT)) u_v (
    .clk_i, .d_i({bypass_i, z_i, y_i, x_i}), .q_o({bypass_q14, v_q14})
  );
  assign shift   = bypass_q14 ? 3'd3 : e_q14 < 5'd12 ? 3'd5 : 3'(5'd17 - e_q14);
  always_ff @(posedge clk_i) begin
    if (bypass_q14) s_q15 <= F'(1) << (F - 1);
    else if (&r_q14[R_W-2:1] || r_q14[R_W-1]) s_q15 <= '1;
    else s_q15 <= r_q14[R_W-2-:F] + F'(r_q14[R_W-2-F]);
    s_q16 <= s_q15;
  end
  for (genvar c = 0; c < 3; c++) begin : g_shift
    logic signed [W+4:0] v_q15;
    logic signed [W+2:0] near;
    always_ff @(posedge clk_i) begin
      v_q15 <= (W + 5)'($signed(v_q14[c*W+:W])) <<< shift;
      v_q16[c*W+:W] <= near > $signed((W + 3)'((1 << (W - 1)) - 1)) ? {1'b0, {(W - 1) {1'b1}}}
                     : near < -$signed((W + 3)'(1 << (W - 1))) ? {1'b1, {(W - 1) {1'b0}}} : near[W-1:0];
    end
    assign near = v_q15[W+4:2] + (W + 3)'({1'b0, v_q15[1]});
  end
  shade_scale3 #(.GAIN(1)) u_scale (
    .clk_i, .rst_i, .valid_i(1'b0), .ready_o(), .x_i(v_q16[0+:W]), .y_i(v_q16[W+:W]), .z_i(v_q16[2*W+:W]),
    .s_i(s_q16), .valid_o(), .x_o, .y_o, .z_o
  );
  assign ready_o = 1'b1;
  shade_delay #(.WIDTH(2), .DEPTH(2 + shade_pkg::LATENCY_SCALE3)) u_flags (
    .clk_i, .d_i({zero_q14, e_q14 < 5'd12}), .q_o({zero_o, short_o})
  );
  shade_valid #(.DEPTH(shade_pkg::LATENCY_UNIT)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);
endmodule
