// SPDX-License-Identifier: Apache-2.0
// shade_reflectance: light at a node in six models: diffuse N.L, specular gain fresnel lobe(x) g.
//
//   model_i          x          g: shade_geometry
//   Lambert          -          0; so do reserved codes and models that REFLECT = 0 or DIVIDE = 0 leaves out
//   Phong            1 - R.V    1, with cosine_i N.L
//   Blinn            1 - N.H    1, with cosine_i N.L
//   Schlick          1 - N.H    the rational lobe itself, lobe = 1
//   Cook-Torrance    1 - N.H    G / ((N.L) (N.V))
//   Ward             1 - N.H    1 / sqrt((N.L) (N.V))
//
//   diffuse_o    S1.16, saturated; below 0 on the far side: it is to be clamped after the interpolation (P1)
//   specular_o   S1.16 in [0, 2 - 2^-16], saturated
//   flags_o      LIGHT_MODEL: a reserved model or one left out; LIGHT_RANGE: a used cosine was beyond [-1, 1];
//                LIGHT_ZERO: no specular light, N.L, N.V or a denominator is not above 0, or H = 0; LIGHT_SATURATED
//
// Error of the specular light against the formulas of the inputs, in ulp: 1.2 times the gain from the lobe; the half ulp of
// x, U2.20, turned by the slope of the lobe into n / 16 at light of 2 (n = 1000, gain 1: 31 measured); 2.5 from factor and
// gain. Cook-Torrance and Ward: N.L and N.V from 1/16 on; below, their rounding counts, 2^-17 / N.L relative.
//
// FORM: of shade_versine. REFLECT = 0 leaves Phong out, DIVIDE = 0 Schlick, Cook-Torrance and Ward.
// LOCAL = 0: L, V, H, vh, fresnel are settings; 1: of every node; h_i, vh_i are taken LATENCY_HALFWAY clocks after n_i,
// l_i, v_i, and fresnel_i LATENCY_FRESNEL clocks after these. Settings must not change while nodes are inside.
// Latency LATENCY_LIGHT, REFLECT = 0: fewer by LATENCY_REFLECT, LOCAL = 1: LATENCY_LIGHT_LOCAL. One node a clock.
// Source: P1, sections II and III; P3. Example: Blinn, N = L = V = H -> diffuse = 1, x = 0, specular = gain.
module shade_reflectance #(
  parameter int FORM    = shade_pkg::FORM_REFINED,
  parameter int REFLECT = 1,
  parameter int DIVIDE  = 1,
  parameter int LOCAL   = 0
) (
  input  logic                                       clk_i,
  input  logic                                       rst_i,
  input  logic        [      shade_pkg::MODEL_W-1:0] model_i,
  input  logic                                       cosine_i,
  input  logic        [    shade_pkg::LOBE_K1_W-1:0] k1_i,
  input  logic signed [    shade_pkg::LOBE_K2_W-1:0] k2_i,
  input  logic        [ shade_pkg::LOBE_SHIFT_W-1:0] shift_i,
  input  logic        [       shade_pkg::LOBE_X_F:0] xmax_i,
  input  logic        [ shade_pkg::LOBE_POWER_W-1:0] power_i,
  input  logic        [    shade_pkg::INTENSITY_F:0] inv_n_i,
  input  logic        [    shade_pkg::INV_EXP_W-1:0] inv_n_exp_i,
  input  logic        [         shade_pkg::GAIN_F:0] gain_i,
  input  logic signed [   shade_pkg::GAIN_EXP_W-1:0] gain_exp_i,
  input  logic                                       valid_i,
  input  logic        [3*shade_pkg::INTENSITY_W-1:0] n_i,        // x, y, z, S1.16, at bit 0, 18, 36
  input  logic        [3*shade_pkg::INTENSITY_W-1:0] l_i,
  input  logic        [3*shade_pkg::INTENSITY_W-1:0] v_i,
  input  logic        [3*shade_pkg::INTENSITY_W-1:0] h_i,
  input  logic        [    shade_pkg::INTENSITY_F:0] vh_i,       // U1.16
  input  logic        [    shade_pkg::INTENSITY_F:0] fresnel_i,  // U1.16
  output logic                                       valid_o,
  output logic signed [  shade_pkg::INTENSITY_W-1:0] diffuse_o,
  output logic signed [  shade_pkg::INTENSITY_W-1:0] specular_o,
  output logic        [shade_pkg::LIGHT_FLAGS_W-1:0] flags_o
);
  if (DIVIDE < 0 || DIVIDE > 1) begin : g_check
    $error("shade_reflectance: DIVIDE must be 0 or 1");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int C_W = shade_pkg::INTENSITY_F + 1;
  localparam int E_W = shade_pkg::FACTOR_EXP_W;
  localparam int MODEL_W = shade_pkg::MODEL_W;
  localparam int GEOMETRY = shade_pkg::LATENCY_GEOMETRY;
  localparam int LOBE = shade_pkg::LATENCY_LOBE;
  localparam int FACTOR = shade_pkg::LATENCY_FACTOR;  // the longer of both, a lobe chosen
  localparam int GAIN = shade_pkg::LATENCY_GAIN;
  localparam int FROM_H = 1 + shade_pkg::LATENCY_VERSINE;
  localparam logic [C_W-1:0] ONE = C_W'(1) << (C_W - 1);

  // ---- the model -------------------------------------------------------------------------------------------------
  logic [MODEL_W-1:0] model;
  logic phong, schlick, divides, refused, uses_h;
  assign phong   = model_i == MODEL_W'(shade_pkg::MODEL_PHONG);
  assign schlick = model_i == MODEL_W'(shade_pkg::MODEL_SCHLICK);
  assign divides = model_i >= MODEL_W'(shade_pkg::MODEL_SCHLICK) && model_i <= MODEL_W'(shade_pkg::MODEL_WARD);
  assign refused = model_i > MODEL_W'(shade_pkg::MODEL_WARD) || (phong && REFLECT == 0) || (divides && DIVIDE == 0);
  assign model   = refused ? MODEL_W'(shade_pkg::MODEL_LAMBERT) : model_i;
  assign uses_h  = model > MODEL_W'(shade_pkg::MODEL_PHONG);

  // ---- angles ----------------------------------------------------------------------------------------------------
  logic signed [W-1:0] diffuse;
  logic [C_W-1:0] nl, nv, vh;
  logic [shade_pkg::VERSINE_W-1:0] x;
  logic saturated, nl_range, nv_range, x_range, none, lost, outside;
  shade_angles #(.FORM(FORM), .REFLECT(REFLECT), .LOCAL(LOCAL)) u_angles (
    .clk_i, .rst_i, .valid_i(1'b0), .mirror_i(phong && REFLECT != 0), .n_i, .l_i, .v_i, .h_i, .valid_o(),
    .diffuse_o(diffuse), .nl_o(nl), .nv_o(nv), .x_o(x), .saturated_o(saturated),
    .nl_range_o(nl_range), .nv_range_o(nv_range), .x_range_o(x_range), .lost_o(none)
  );
  shade_ring #(.WIDTH(C_W), .DEPTH(LOCAL != 0 ? FROM_H : 0)) u_vh (.clk_i, .rst_i, .d_i(vh_i), .q_o(vh));
  assign lost    = none && uses_h;
  assign outside = nl_range || (x_range && model != '0) || (nv_range && divides && DIVIDE != 0);

  // ---- lobe and factor -------------------------------------------------------------------------------------------
  logic [C_W-1:0] lobe, lobe_late, shape, num, fresnel;
  logic signed [shade_pkg::FACTOR_F-1:0] w;
  logic signed [E_W-1:0] e;
  logic zero, lost_late, lost_q;
  shade_lobe u_lobe (
    .clk_i, .phase_i('0), .k1_i, .k2_i, .shift_i, .xmax_i, .power_i, .x_i(x), .lobe_o(lobe)
  );
  shade_ring #(.WIDTH(C_W), .DEPTH(FACTOR - 1 - LOBE)) u_wait_lobe (.clk_i, .rst_i, .d_i(lobe), .q_o(lobe_late));
  shade_ring #(.WIDTH(1), .DEPTH(FACTOR - 1)) u_lost (.clk_i, .rst_i, .d_i(lost), .q_o(lost_late));
  always_ff @(posedge clk_i) begin
    shape  <= lost_late ? '0 : schlick ? ONE : lobe_late;
    lost_q <= lost_late;
  end
  if (DIVIDE != 0) begin : g_divide
    localparam int WIDTH = C_W + shade_pkg::FACTOR_F + E_W + 1;
    logic [WIDTH-1:0] factor;
    shade_geometry u_geometry (
      .clk_i, .rst_i, .valid_i(1'b0), .model_i(model), .cosine_i, .inv_n_i, .inv_n_exp_i, .x_i(x),
      .nl_i(nl), .nv_i(nv), .vh_i(vh), .valid_o(), .num_o(factor[0+:C_W]),
      .w_o(factor[C_W+:shade_pkg::FACTOR_F]), .e_o(factor[WIDTH-2-:E_W]), .zero_o(factor[WIDTH-1])
    );
    shade_ring #(.WIDTH(WIDTH), .DEPTH(FACTOR - GEOMETRY)) u_wait (.clk_i, .rst_i, .d_i(factor), .q_o({zero, e, w, num}));
  end else begin : g_plain
    logic [C_W-1:0] plain;  // of Phong and Blinn
    assign plain = model == '0 ? '0 : cosine_i ? nl : ONE;
    shade_ring #(.WIDTH(C_W), .DEPTH(FACTOR)) u_wait (.clk_i, .rst_i, .d_i(plain), .q_o(num));
    assign {zero, e, w} = '0;
    logic unused;
    assign unused = &{1'b0, nv, vh, inv_n_i, inv_n_exp_i};
  end

  // ---- specular light, and what has waited for it ----------------------------------------------------------------
  logic specular_saturated;
  shade_ring #(
    .WIDTH(C_W), .DEPTH(LOCAL != 0 ? FROM_H + FACTOR - shade_pkg::LATENCY_FRESNEL : 0)
  ) u_fresnel (.clk_i, .rst_i, .d_i(fresnel_i), .q_o(fresnel));
  shade_gain u_gain (
    .clk_i, .rst_i, .valid_i(1'b0), .gain_i, .gain_exp_i, .lobe_i(shape), .num_i(num), .fresnel_i(fresnel), .w_i(w),
    .e_i(e), .valid_o(), .s_o(specular_o), .saturated_o(specular_saturated)
  );
  logic diffuse_saturated;
  logic [1:0] zero_range;
  shade_ring #(.WIDTH(W + 2), .DEPTH(FACTOR + GAIN)) u_diffuse (
    .clk_i, .rst_i, .d_i({outside, saturated, diffuse}), .q_o({zero_range[0], diffuse_saturated, diffuse_o})
  );
  shade_delay #(.WIDTH(1), .DEPTH(GAIN)) u_zero (.clk_i, .d_i(zero || lost_q), .q_o(zero_range[1]));
  always_comb begin
    flags_o = '0;
    flags_o[shade_pkg::LIGHT_MODEL] = refused;
    flags_o[shade_pkg::LIGHT_RANGE] = zero_range[0];
    flags_o[shade_pkg::LIGHT_ZERO] = zero_range[1];
    flags_o[shade_pkg::LIGHT_SATURATED] = specular_saturated || diffuse_saturated;
  end

  localparam int LATENCY = LOCAL != 0 ? shade_pkg::LATENCY_LIGHT_LOCAL
                         : shade_pkg::LATENCY_LIGHT - (REFLECT != 0 ? 0 : shade_pkg::LATENCY_REFLECT);
  shade_valid #(.DEPTH(LATENCY)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);
endmodule
