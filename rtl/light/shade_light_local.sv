// SPDX-License-Identifier: Apache-2.0
// shade_light_local: light at a node in six models; light and viewer in directions L and V of every node.
//
//   nx_i .. vz_i          S1.16        unit vectors: normal, to the light, to the viewer
//   model_i .. gain_exp_i              settings: the material, see shade_reflectance, shade_lobe and golden.material
//   f0_i                  U1.16        Fresnel's factor at normal incidence, 1 for none: shade_fresnel of V.H
//   diffuse_o, specular_o S1.16        N.L, not clamped at 0; specular light in [0, 2)
//   flags_o                            bits LIGHT_*
//
//   L, V ─▶ shade_halfway ─▶ H, V.H ─▶ shade_fresnel ─▶ F
//   N, L, V ──────────────────▶ shade_reflectance ◀──────┘
//
// Settings must not change while nodes are inside. FORM, REFLECT, DIVIDE, rounding, overflow: see shade_reflectance.
// Latency LATENCY_LIGHT_LOCAL = 76 clocks. One node a clock. Source: P1, sections II, III.
// Example: Blinn, f0 = 1, N = L = V = (0, 0, 1) -> diffuse = 1, specular = gain.
module shade_light_local #(
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
  input  logic        [  shade_pkg::INTENSITY_F:0] f0_i,
  input  logic                                     valid_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] nx_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] ny_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] nz_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] lx_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] ly_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] lz_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] vx_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] vy_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] vz_i,
  output logic                                     valid_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] diffuse_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] specular_o,
  output logic        [shade_pkg::LIGHT_FLAGS_W-1:0] flags_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int F = shade_pkg::INTENSITY_F;

  logic [3*W-1:0] h;
  logic [F:0] vh, fresnel;
  shade_halfway u_halfway (
    .clk_i, .rst_i, .valid_i(1'b0), .lx_i, .ly_i, .lz_i, .vx_i, .vy_i, .vz_i, .valid_o(),
    .hx_o(h[0+:W]), .hy_o(h[W+:W]), .hz_o(h[2*W+:W]), .vh_o(vh), .zero_o()
  );
  shade_fresnel u_fresnel (.clk_i, .rst_i, .valid_i(1'b0), .c_i(vh), .f0_i, .valid_o(), .f_o(fresnel));
  shade_reflectance #(.FORM(FORM), .REFLECT(REFLECT), .DIVIDE(DIVIDE), .LOCAL(1)) u_reflectance (
    .clk_i, .rst_i, .model_i, .cosine_i, .k1_i, .k2_i, .shift_i, .xmax_i, .power_i, .inv_n_i, .inv_n_exp_i, .gain_i,
    .gain_exp_i, .valid_i, .n_i({nz_i, ny_i, nx_i}), .l_i({lz_i, ly_i, lx_i}), .v_i({vz_i, vy_i, vx_i}), .h_i(h),
    .vh_i(vh), .fresnel_i(fresnel), .valid_o, .diffuse_o, .specular_o, .flags_o
  );
endmodule
