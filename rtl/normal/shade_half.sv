// SPDX-License-Identifier: Apache-2.0
// shade_half: h = cos(psi/2), the cosine of half an angle, from c = cos psi.
//
//   FORM_REFINED  h = 1 - u/4 - 17 u^2/512 - 5 u^4/512      u = 1 - c
//   FORM_PAPER    h = 0.25 c + 0.75, where c <= cos(pi/4) 0.305 c + 0.712: P4's d2, within 0.7 %
//
// Refined: exactly 1 for c = 1, within 7.1e-5 for c >= 1/2, 1.8e-4 below.
//
//   c_i      U1.16 in [0, 1]
//   uu_i, uuuu_i  U1.18, u^2 and u^4, taken one clock after c_i; not used by the paper's form
//   half_o   S1.16, to nearest, ties up: error at most 0.53 ulp of the formula
//
// Shifts and adds only. Latency LATENCY_HALF = 5 clocks, one value a clock.
// Example: c = 1/2, u^2 = 1/4, u^4 = 1/16 -> h = 0.8661 (refined), 0.8645 (paper); cos 30 degrees is 0.8660.
// Source: P4, section 2.
module shade_half #(
  parameter int FORM = shade_pkg::FORM_REFINED
) (
  input  logic                                     clk_i,
  input  logic        [  shade_pkg::INTENSITY_F:0] c_i,
  input  logic        [     shade_pkg::SQUARE_F:0] uu_i,
  input  logic        [     shade_pkg::SQUARE_F:0] uuuu_i,
  output logic signed [shade_pkg::INTENSITY_W-1:0] half_o
);
  if (FORM != shade_pkg::FORM_PAPER && FORM != shade_pkg::FORM_REFINED) begin : g_check_form
    $error("shade_half: FORM must be FORM_PAPER or FORM_REFINED");
  end

  localparam int F = shade_pkg::SQUARE_F;
  localparam int WIDTH = F + 2;
  localparam int ALIGN = F - shade_pkg::INTENSITY_F;
  localparam bit REFINED = FORM == shade_pkg::FORM_REFINED;
  localparam logic [shade_pkg::INTENSITY_F:0] LIMIT = (shade_pkg::INTENSITY_F + 1)'(shade_pkg::D2_LIMIT);

  // both forms: 3/4 + c/4 and a correction: the powers of u or, where c <= LIMIT, the difference of two lines
  logic signed [WIDTH-1:0] c_q1, y, z;
  always_ff @(posedge clk_i) c_q1 <= $signed({1'b0, c_i, {ALIGN{1'b0}}});

  if (REFINED) begin : g_refined
    assign y = $signed({1'b0, uu_i});
    assign z = $signed({1'b0, uuuu_i});
  end else begin : g_paper
    logic far_q1;
    logic [shade_pkg::INTENSITY_F:0] far_c_q1;
    always_ff @(posedge clk_i) begin
      far_q1   <= c_i <= LIMIT;
      far_c_q1 <= c_i <= LIMIT ? c_i : '0;
    end
    assign y = $signed({1'b0, far_c_q1, {ALIGN{1'b0}}});
    assign z = $signed({1'b0, far_q1, {F{1'b0}}});
    logic unused_powers;
    assign unused_powers = &{1'b0, uu_i, uuuu_i};
  end

  shade_weigh #(
    .WIDTH(WIDTH), .F(F),
    .K0(shade_pkg::D2_NEAR_0),
    .KX(shade_pkg::D2_NEAR_C),
    .KY(REFINED ? shade_pkg::HALF_UU : shade_pkg::D2_FAR_C - shade_pkg::D2_NEAR_C),
    .KZ(REFINED ? shade_pkg::HALF_UUUU : shade_pkg::D2_FAR_0 - shade_pkg::D2_NEAR_0)
  ) u_weigh (.clk_i, .x_i(c_q1), .y_i(y), .z_i(z), .w_o(half_o));
endmodule
