// SPDX-License-Identifier: Apache-2.0
// shade_light: light at a node in six models; directional light, viewer at infinity on the z axis, V = (0, 0, 1).
//
//   nx_i .. nz_i          S1.16        unit normal of a node
//   lx_i .. hz_i, vh_i    S1.16        settings: L, H = (L + V)/|L + V|; V.H = hz, U1.16. Fresnel's factor: in the gain
//   model_i .. gain_exp_i              settings: the material, see shade_reflectance, shade_lobe and golden.material
//   diffuse_o, specular_o S1.16        N.L, not clamped at 0; specular light in [0, 2)
//   flags_o                            bits LIGHT_*
//
// Settings must not change while nodes are inside. FORM, REFLECT, DIVIDE, rounding, overflow: see shade_reflectance.
// Latency LATENCY_LIGHT = 61 clocks, REFLECT = 0: fewer by LATENCY_REFLECT. One node a clock. Source: P1, sections II, III.
// Example: Blinn, N = L = (0, 0, 1) -> diffuse = 1, specular = gain.
module shade_light #(
  parameter int FORM    = shade_pkg::FORM_REFINED,
  parameter int REFLECT = 1,
  parameter int DIVIDE  = 1
) (
  input  logic                                     clk_i,
  input  logic                                     rst_i,
  input  logic        [    shade_pkg::MODEL_W-1:0] model_i,      // MODEL_*
  input  logic                                     cosine_i,     // Phong, Blinn: times N.L
  input  logic        [  shade_pkg::LOBE_K1_W-1:0] k1_i,
  input  logic signed [  shade_pkg::LOBE_K2_W-1:0] k2_i,
  input  logic        [shade_pkg::LOBE_SHIFT_W-1:0] shift_i,
  input  logic        [     shade_pkg::LOBE_X_F:0] xmax_i,
  input  logic        [shade_pkg::LOBE_POWER_W-1:0] power_i,
  input  logic        [  shade_pkg::INTENSITY_F:0] inv_n_i,      // Schlick: 1/n = inv_n 2^-inv_n_exp, U1.16 in (1/2, 1]
  input  logic        [  shade_pkg::INV_EXP_W-1:0] inv_n_exp_i,
  input  logic        [       shade_pkg::GAIN_F:0] gain_i,       // U1.16 in [1, 2), or 0
  input  logic signed [ shade_pkg::GAIN_EXP_W-1:0] gain_exp_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] lx_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] ly_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] lz_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] hx_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] hy_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] hz_i,
  input  logic        [  shade_pkg::INTENSITY_F:0] vh_i,
  input  logic                                     valid_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] nx_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] ny_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] nz_i,
  output logic                                     valid_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] diffuse_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] specular_o,
  output logic        [shade_pkg::LIGHT_FLAGS_W-1:0] flags_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int F = shade_pkg::INTENSITY_F;
  localparam logic [F:0] ONE = (F + 1)'(1) << F;
  localparam logic [3*W-1:0] V = {1'b0, ONE, {(2 * W) {1'b0}}};

  shade_reflectance #(.FORM(FORM), .REFLECT(REFLECT), .DIVIDE(DIVIDE)) u_reflectance (
    .clk_i, .rst_i, .model_i, .cosine_i, .k1_i, .k2_i, .shift_i, .xmax_i, .power_i, .inv_n_i, .inv_n_exp_i, .gain_i,
    .gain_exp_i, .valid_i, .n_i({nz_i, ny_i, nx_i}), .l_i({lz_i, ly_i, lx_i}), .v_i(V),
    .h_i({hz_i, hy_i, hx_i}), .vh_i, .fresnel_i(ONE), .valid_o, .diffuse_o, .specular_o, .flags_o
  );
endmodule
