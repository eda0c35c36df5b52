// SPDX-License-Identifier: Apache-2.0
// shade_light: light at a node in six models; directional light, viewer at infinity on the z axis, V = (0, 0, 1).
//
//   n_i              S1.16        unit normal of a node
//   light_i          S1.16        settings: L, H = (L + V)/|L + V|; V.H = hz, U1.16. Fresnel's factor: in the gain
//   material_i                    settings: see shade_reflectance, shade_lobe and golden.material
//   light_o          S1.16        diffuse: N.L, not clamped at 0; specular light in [0, 2)
//   flags_o                       see shade_reflectance
//
// Settings must not change while nodes are inside. FORM, REFLECT, DIVIDE, rounding, overflow: see shade_reflectance.
// FOLD = 1: a node a clock. Latency LATENCY_LIGHT = 57 clocks, REFLECT = 0: fewer by LATENCY_REFLECT.
// FOLD = 2 .. 8: a node in FOLD clocks, taken when phase_i, which counts 0 .. FOLD - 1, is TAKE; REFLECT and DIVIDE must be
//           0. Multipliers: 8, 5, 5, 5, 3, 3, 3. Latency LATENCY_LIGHT_FOLDED = 56 clocks, FOLD = 5: 61. The same bits.
// Source: P1, sections II, III. Example: Blinn, N = L = (0, 0, 1) -> diffuse = 1, specular = gain.
module shade_light #(
  parameter int FORM    = shade_pkg::FORM_REFINED,
  parameter int REFLECT = 1,
  parameter int DIVIDE  = 1,
  parameter int FOLD    = 1,
  parameter int TAKE    = 0
) (
  input  logic                          clk_i,
  input  logic                          rst_i,
  input  logic [shade_pkg::PHASE_W-1:0] phase_i,
  input  shade_pkg::material_t          material_i,
  input  shade_pkg::light_t             light_i,
  input  logic                          valid_i,
  input  shade_pkg::vec_t               n_i,
  output logic                          valid_o,
  output shade_pkg::intensity_t         light_o,
  output shade_pkg::flags_t             flags_o
);
  if (FOLD < 1 || FOLD > shade_pkg::FOLD_MAX || TAKE < 0 || TAKE >= FOLD || (FOLD > 1 && REFLECT + DIVIDE > 0)) begin : g_check
    $error("shade_light: FOLD must be in 1 .. 8, beyond 1 with REFLECT and DIVIDE 0, and TAKE below FOLD");
  end

  localparam int F = shade_pkg::INTENSITY_F;
  localparam logic [F:0] ONE = (F + 1)'(1) << F;
  localparam logic [shade_pkg::VEC_BITS-1:0] V = shade_pkg::VEC_BITS'(ONE) << (2 * shade_pkg::INTENSITY_W);
  localparam int LATENCY = FOLD == 1 ? shade_pkg::LATENCY_LIGHT - (REFLECT != 0 ? 0 : shade_pkg::LATENCY_REFLECT)
                                     : shade_pkg::LATENCY_LIGHT_FOLDED + (FOLD == 5 ? 5 : 0);

  shade_reflectance #(.FORM(FORM), .REFLECT(REFLECT), .DIVIDE(DIVIDE), .FOLD(FOLD), .TAKE(TAKE)) u_reflectance (
    .clk_i, .rst_i, .phase_i, .material_i, .n_i, .l_i(light_i.l), .v_i(V), .h_i(light_i.h), .vh_i(light_i.vh),
    .fresnel_i(ONE), .light_o, .flags_o
  );
  shade_valid #(.DEPTH(LATENCY)) u_valid (
    .clk_i, .rst_i, .valid_i(valid_i && (FOLD == 1 || phase_i == shade_pkg::PHASE_W'(TAKE))), .valid_o
  );
endmodule
