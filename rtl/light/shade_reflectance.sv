// SPDX-License-Identifier: Apache-2.0
// shade_reflectance: light at a node in six models: diffuse N.L, specular gain fresnel lobe(x) g.
//
//   material_i.model x         g: shade_geometry
//   Lambert          -          0; so do reserved codes and models that REFLECT = 0 or DIVIDE = 0 leaves out
//   Phong            1 - R.V    1, with cosine_i N.L
//   Blinn            1 - N.H    1, with cosine_i N.L
//   Schlick          1 - N.H    the rational lobe itself, lobe = 1
//   Cook-Torrance    1 - N.H    G / ((N.L) (N.V))
//   Ward             1 - N.H    1 / sqrt((N.L) (N.V))
//
//   n_i, l_i, v_i, h_i  S1.16  unit vectors; vh_i: V.H, fresnel_i: Fresnel's factor, U1.16
//   light_o.diffuse     S1.16, saturated; below 0 on the far side: it is to be clamped after the interpolation (P1)
//   light_o.specular    S1.16 in [0, 2 - 2^-16], saturated
//   flags_o             model: a reserved one or one left out; range: a used cosine was beyond [-1, 1]; saturated;
//                       zero: no specular light, N.L, N.V or a denominator is not above 0, or H = 0
//
// Error of the specular light against the formulas of the inputs, in ulp, up to n = 1024: 1.5 times the gain from the lobe,
// as much at most from x, which is rounded where the lobe cuts it; 1/2 and, of quotients, 4 from factor and gain: Blinn 2.0
// at gain 1 measured, Schlick 2.4. Phong: R's rounding comes to it, an ulp at most times n and, FORM_REFINED, |R - V|: 18
// measured, FORM_PAPER 700. Cook-Torrance and Ward: N.L and N.V from 1/16 on; below, their rounding counts, 2^-17 / N.L
// relative. sim/units/exact_light.py tells what is allowed for each vector.
//
// FORM: of shade_versine. REFLECT = 0 leaves Phong out, DIVIDE = 0 Schlick, Cook-Torrance and Ward.
// LOCAL = 0: L, V, H, vh, fresnel are settings; 1: of every node; h_i, vh_i are taken LATENCY_HALFWAY clocks after n_i,
// l_i, v_i, and fresnel_i LATENCY_FRESNEL clocks after these. Settings must not change while nodes are inside.
//
// FOLD = 1: a node a clock. Latency LATENCY_LIGHT = 57 clocks, REFLECT = 0: fewer by LATENCY_REFLECT, LOCAL = 1:
//           LATENCY_LIGHT_LOCAL.
// FOLD = 2 .. 8: a node in FOLD clocks, taken when phase_i, which counts 0 .. FOLD - 1, is TAKE; multipliers are shared, and
//           REFLECT, DIVIDE, LOCAL must be 0. Latency LATENCY_LIGHT_FOLDED = 56 clocks, FOLD = 5: 61. The same bits.
// Source: P1, sections II and III; P3. Example: Blinn, N = L = V = H -> diffuse = 1, x = 0, specular = gain.
module shade_reflectance #(
  parameter int FORM    = shade_pkg::FORM_REFINED,
  parameter int REFLECT = 1,
  parameter int DIVIDE  = 1,
  parameter int LOCAL   = 0,
  parameter int FOLD    = 1,
  parameter int TAKE    = 0
) (
  input  logic                            clk_i,
  input  logic                            rst_i,
  input  logic [  shade_pkg::PHASE_W-1:0] phase_i,
  input  shade_pkg::material_t            material_i,
  input  shade_pkg::vec_t                 n_i,
  input  shade_pkg::vec_t                 l_i,
  input  shade_pkg::vec_t                 v_i,
  input  shade_pkg::vec_t                 h_i,
  input  logic [shade_pkg::INTENSITY_F:0] vh_i,
  input  logic [shade_pkg::INTENSITY_F:0] fresnel_i,
  output shade_pkg::intensity_t           light_o,
  output shade_pkg::flags_t               flags_o
);
  if (DIVIDE < 0 || DIVIDE > 1) begin : g_check
    $error("shade_reflectance: DIVIDE must be 0 or 1");
  end
  if (FOLD > 1 && REFLECT + DIVIDE + LOCAL > 0) begin : g_fold
    $error("shade_reflectance: FOLD beyond 1 needs REFLECT, DIVIDE and LOCAL 0");
  end

  localparam int C_W = shade_pkg::INTENSITY_F + 1;
  localparam int MODEL_W = shade_pkg::MODEL_W;
  localparam int LOBE_SHIFT_W = shade_pkg::LOBE_SHIFT_W;
  localparam logic [shade_pkg::INV_EXP_W-1:0] CUT = shade_pkg::INV_EXP_W'(shade_pkg::VERSINE_CUT);
  localparam int GEOMETRY = shade_pkg::LATENCY_GEOMETRY;
  localparam int FROM_H = 1 + shade_pkg::LATENCY_VERSINE;
  localparam int ANGLES = shade_pkg::LATENCY_ANGLES_FOLDED;
  localparam int LOBE = FOLD == 1 ? shade_pkg::LATENCY_LOBE : shade_pkg::LATENCY_LOBE_FOLDED + (FOLD == 5 ? 5 : 0);
  localparam int FACTOR = FOLD == 1 ? shade_pkg::LATENCY_FACTOR : LOBE;  // the longer of both, a lobe chosen
  localparam int GAIN = shade_pkg::LATENCY_GAIN;
  localparam logic [C_W-1:0] ONE = C_W'(1) << (C_W - 1);

  // is it clock c of a node?
  function automatic logic at(input int c);
    at = phase_i == shade_pkg::PHASE_W'((TAKE + c) % FOLD);
  endfunction

  // ---- the model -------------------------------------------------------------------------------------------------
  shade_pkg::material_t material;
  logic reserved, phong, schlick, divides, refused, lambert, uses_h;
  assign reserved = material_i.model > MODEL_W'(shade_pkg::MODEL_WARD);
  assign phong    = material_i.model == MODEL_W'(shade_pkg::MODEL_PHONG);
  assign schlick  = material_i.model == MODEL_W'(shade_pkg::MODEL_SCHLICK);
  assign divides  = !reserved && !(material_i.model < MODEL_W'(shade_pkg::MODEL_SCHLICK));
  assign refused  = reserved || (phong && REFLECT == 0) || (divides && DIVIDE == 0);
  assign lambert  = material.model == MODEL_W'(shade_pkg::MODEL_LAMBERT);
  assign uses_h   = material.model > MODEL_W'(shade_pkg::MODEL_PHONG);
  always_comb begin
    material = material_i;
    if (refused) material.model = MODEL_W'(shade_pkg::MODEL_LAMBERT);
  end

  // ---- angles ----------------------------------------------------------------------------------------------------
  shade_pkg::angles_t angles;
  logic [C_W-1:0] vh;
  logic [shade_pkg::LOBE_SHIFT_W-1:0] shift;
  logic lost, lost_late, outside;  // lost: no H
  shade_angles #(.FORM(FORM), .REFLECT(REFLECT), .LOCAL(LOCAL), .FOLD(FOLD), .TAKE(TAKE)) u_angles (
    .clk_i, .rst_i, .phase_i, .mirror_i(phong && REFLECT != 0),
    .shift_i(shift), .n_i, .l_i, .v_i, .h_i, .angles_o(angles)
  );
  always_comb begin  // x is rounded where the lobe cuts it, or Schlick's quotient
    shift = material.lobe.shift;
    if (schlick && DIVIDE != 0) shift = material.inv_n_exp > CUT ? LOBE_SHIFT_W'(CUT) : LOBE_SHIFT_W'(material.inv_n_exp);
  end
  shade_ring #(.WIDTH(C_W), .DEPTH(LOCAL != 0 ? FROM_H : 0)) u_vh (.clk_i, .rst_i, .d_i(vh_i), .q_o(vh));
  assign lost    = uses_h && h_i == '0;
  assign outside = angles.nl_range || (angles.x_range && !lambert) || (angles.nv_range && divides && DIVIDE != 0);
  shade_ring #(.WIDTH(1), .DEPTH(LOCAL != 0 ? FROM_H + FACTOR - 1 : 0)) u_lost (
    .clk_i, .rst_i, .d_i(lost), .q_o(lost_late)
  );

  // ---- lobe and factor; beside them, what the light is told by without them --------------------------------------
  logic [C_W-1:0] lobe, lobe_late, shape, chosen;
  shade_pkg::factor_t factor;
  logic outside_late, saturated_late;
  logic signed [C_W:0] diffuse_late;
  shade_lobe #(.FOLD(FOLD), .TAKE(FOLD == 1 ? 0 : (TAKE + ANGLES) % FOLD)) u_lobe (
    .clk_i, .phase_i, .x_i(angles.x), .lobe_i(material.lobe), .lobe_o(lobe)
  );
  shade_wait #(.WIDTH(C_W + 3), .DEPTH(FACTOR), .FOLD(FOLD)) u_diffuse (
    .clk_i, .rst_i, .load_i(at(ANGLES)), .d_i({outside, angles.saturated, angles.diffuse}),
    .q_o({outside_late, saturated_late, diffuse_late})
  );
  assign chosen = lost_late ? '0 : schlick && DIVIDE != 0 ? ONE : lobe_late;
  if (FOLD == 1) begin : g_lobe
    shade_ring #(.WIDTH(C_W), .DEPTH(FACTOR - 1 - LOBE)) u_wait (.clk_i, .rst_i, .d_i(lobe), .q_o(lobe_late));
    always_ff @(posedge clk_i) shape <= chosen;
  end else begin : g_lobe_folded
    assign lobe_late = lobe;
    assign shape     = chosen;
  end
  if (DIVIDE != 0) begin : g_divide
    shade_pkg::factor_t early;
    shade_geometry u_geometry (.clk_i, .rst_i, .material_i(material), .angles_i(angles), .vh_i(vh), .factor_o(early));
    shade_ring #(.WIDTH($bits(early)), .DEPTH(FACTOR - GEOMETRY)) u_wait (.clk_i, .rst_i, .d_i(early), .q_o(factor));
  end else begin : g_plain
    logic [C_W-1:0] cosine;  // of Phong and Blinn
    logic unused_cosine;
    shade_clamp u_cosine (.x_i(diffuse_late), .y_o(cosine), .clamped_o(unused_cosine));
    assign factor.num  = lambert ? '0 : material.cosine ? cosine : ONE;
    assign factor.w    = '0;
    assign factor.e    = '0;
    assign factor.zero = 1'b0;
    logic unused;
    assign unused = &{1'b0, vh, angles};
  end

  // ---- specular light, and what has waited for it ----------------------------------------------------------------
  logic [C_W-1:0] fresnel;
  logic saturated, bright, zero;
  shade_ring #(
    .WIDTH(C_W), .DEPTH(LOCAL != 0 ? FROM_H + FACTOR - shade_pkg::LATENCY_FRESNEL : 0)
  ) u_fresnel (.clk_i, .rst_i, .d_i(fresnel_i), .q_o(fresnel));
  shade_gain #(.FOLD(FOLD), .TAKE(FOLD == 1 ? 0 : (TAKE + ANGLES + FACTOR) % FOLD)) u_gain (
    .clk_i, .phase_i, .material_i(material), .lobe_i(shape), .factor_i(factor), .fresnel_i(fresnel),
    .s_o(light_o.specular), .saturated_o(bright)
  );
  shade_wait #(.WIDTH(C_W + 3), .DEPTH(GAIN), .FOLD(FOLD)) u_light (
    .clk_i, .rst_i, .load_i(at(ANGLES + FACTOR)), .d_i({outside_late, saturated_late, diffuse_late}),
    .q_o({flags_o.range, saturated, light_o.diffuse})
  );
  logic lost_q;
  shade_delay #(.WIDTH(1), .DEPTH(LOCAL != 0 ? 1 : 0)) u_none (.clk_i, .d_i(lost_late), .q_o(lost_q));
  shade_delay #(.WIDTH(1), .DEPTH(DIVIDE != 0 || LOCAL != 0 ? GAIN : 0)) u_zero (
    .clk_i, .d_i(factor.zero || lost_q), .q_o(zero)
  );
  assign flags_o.model     = refused;
  assign flags_o.zero      = zero;
  assign flags_o.saturated = bright || saturated;
endmodule
