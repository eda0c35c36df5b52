// SPDX-License-Identifier: Apache-2.0
// shade_light_local: light at a node in six models; light and viewer in directions L and V of every node.
//
//   n_i, l_i, v_i    S1.16        unit vectors: normal, to the light, to the viewer
//   material_i                    settings: see shade_reflectance, shade_lobe and golden.material; f0: Fresnel's factor at
//                                 normal incidence, 1 for none: shade_fresnel of V.H
//   light_o          S1.16        diffuse: N.L, not clamped at 0; specular light in [0, 2)
//   flags_o                       see shade_reflectance
//
//   L, V ─▶ shade_halfway ─▶ H, V.H ─▶ shade_fresnel ─▶ F
//   N, L, V ──────────────────▶ shade_reflectance ◀──────┘
//
// Settings must not change while nodes are inside. FORM, REFLECT, DIVIDE, rounding, overflow: see shade_reflectance.
// Latency LATENCY_LIGHT_LOCAL = 72 clocks. One node a clock. Source: P1, sections II, III.
// Example: Blinn, f0 = 1, N = L = V = (0, 0, 1) -> diffuse = 1, specular = gain.
module shade_light_local #(
  parameter int FORM    = shade_pkg::FORM_REFINED,
  parameter int REFLECT = 1,
  parameter int DIVIDE  = 1
) (
  input  logic                  clk_i,
  input  logic                  rst_i,
  input  shade_pkg::material_t  material_i,
  input  logic                  valid_i,
  input  shade_pkg::vec_t       n_i,
  input  shade_pkg::vec_t       l_i,
  input  shade_pkg::vec_t       v_i,
  output logic                  valid_o,
  output shade_pkg::intensity_t light_o,
  output shade_pkg::flags_t     flags_o
);
  shade_pkg::vec_t h;
  logic [shade_pkg::INTENSITY_F:0] vh, fresnel;
  shade_halfway u_halfway (.clk_i, .rst_i, .l_i, .v_i, .h_o(h), .vh_o(vh));
  shade_fresnel u_fresnel (.clk_i, .c_i(vh), .f0_i(material_i.f0), .f_o(fresnel));
  shade_reflectance #(.FORM(FORM), .REFLECT(REFLECT), .DIVIDE(DIVIDE), .LOCAL(1)) u_reflectance (
    .clk_i, .rst_i, .phase_i(shade_pkg::PHASE_W'(0)), .material_i, .n_i, .l_i, .v_i, .h_i(h), .vh_i(vh),
    .fresnel_i(fresnel), .light_o, .flags_o
  );
  shade_valid #(.DEPTH(shade_pkg::LATENCY_LIGHT_LOCAL)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);
endmodule
