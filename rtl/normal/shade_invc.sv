// SPDX-License-Identifier: Apache-2.0
// shade_invc: InvC = 1/sqrt(2 (1 + c)) and h = cos(psi/2) for c = cos psi: what the middle of two unit normals needs.
//
//   FORM_REFINED            InvC = 1/2 + u/8 + (3390 u^2 + 1988 u^4)/2^16    h = 1 - u/4 - 17 u^2/512 - 5 u^4/512
//   FORM_PAPER, DEGREE = 1  InvC1 = 0.683 - 0.191 c                          h = d2(c), see shade_half
//   FORM_PAPER, DEGREE = 2  InvC2 = 0.703 - 0.3 c + 0.098 c^2                h = d2(c)
//
// with u = 1 - c. Refined, both come from the same powers, are exact for c = 1 (equal normals) and have the true slope
// there, which a high shininess needs; within 1.6e-4 (relative) and 1.8e-4. h is the c of the interval's halves.
//
//   c_i        S1.16, clamped to [0, 1]; clamped tells, with the result
//   powers     18 fraction bits, the rest is cut (u^2 to 16 before it is squared)
//   invc_o     invc U0.18 in [0.49, 0.71], half S1.16; both to nearest, ties up: error at most 0.82 ulp of the formula
//              with the constants as they are here; with those that P4 prints 1.65 ulp (InvC1), 2.3 ulp (InvC2)
//
// Constants of 16 fraction bits, by shifts and adds; two 18 x 18 multipliers (one in FORM_PAPER, none in DEGREE 1).
// Latency LATENCY_INVC = 9 clocks, one value a clock. Source: P4, section 2.
// Example: c = 1/2 -> InvC = 0.57733, h = 0.86609 (refined; the functions: 0.57735, 0.86603).
module shade_invc #(
  parameter int FORM   = shade_pkg::FORM_REFINED,
  parameter int DEGREE = 2
) (
  input  logic                                     clk_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] c_i,
  output shade_pkg::invc_t                         invc_o
);
  if (FORM != shade_pkg::FORM_PAPER && FORM != shade_pkg::FORM_REFINED) begin : g_check_form
    $error("shade_invc: FORM must be FORM_PAPER or FORM_REFINED");
  end
  if (DEGREE != 2 && (DEGREE != 1 || FORM == shade_pkg::FORM_REFINED)) begin : g_check_degree
    $error("shade_invc: DEGREE must be 2, or 1 in FORM_PAPER");
  end

  localparam int C_W = shade_pkg::INTENSITY_F + 1;
  localparam int F = shade_pkg::SQUARE_F;
  localparam int WIDTH = F + 2;
  localparam int ALIGN = F - shade_pkg::INTENSITY_F;
  localparam int CUT = 2 * shade_pkg::INTENSITY_F - F;
  localparam bit REFINED = FORM == shade_pkg::FORM_REFINED;
  localparam int MUL = shade_pkg::LATENCY_MUL;

  logic [C_W-1:0] c, c_q4, c_q5, v_q1;  // v: what is squared, u or c
  logic clamped, clamped_q1;
  shade_clamp u_clamp (.x_i(c_i), .y_o(c), .clamped_o(clamped));
  always_ff @(posedge clk_i) begin
    v_q1       <= REFINED ? (C_W'(1) << shade_pkg::INTENSITY_F) - c : c;
    clamped_q1 <= clamped;
    c_q5       <= c_q4;
  end
  shade_delay #(.WIDTH(C_W), .DEPTH(2 * MUL)) u_c (.clk_i, .d_i(c), .q_o(c_q4));

  logic [2*C_W:0] square_q3;
  logic [F:0] vv_q5, vvvv_q5;
  shade_square #(.WIDTH(C_W + 1)) u_square (.clk_i, .x_i($signed({1'b0, v_q1})), .y_o(square_q3));
  shade_delay #(.WIDTH(F + 1), .DEPTH(MUL)) u_vv (.clk_i, .d_i((F + 1)'(square_q3 >> CUT)), .q_o(vv_q5));
  if (REFINED) begin : g_fourth
    logic [2*C_W:0] fourth_q5;
    logic signed [C_W:0] square;
    assign square = (C_W + 1)'(square_q3 >> shade_pkg::INTENSITY_F);  // at most 1
    shade_square #(.WIDTH(C_W + 1)) u_fourth (.clk_i, .x_i(square), .y_o(fourth_q5));
    assign vvvv_q5 = (F + 1)'(fourth_q5 >> CUT);
    logic unused_fourth;
    assign unused_fourth = &{1'b0, fourth_q5};
  end else begin : g_none
    assign vvvv_q5 = '0;
  end
  logic unused_square;
  assign unused_square = &{1'b0, square_q3};

  localparam bit LINEAR = DEGREE == 1;
  logic signed [WIDTH-1:0] x, y, z;
  logic signed [shade_pkg::INVC_F:0] invc;
  assign x = $signed({1'b0, c_q5, {ALIGN{1'b0}}});
  assign y = $signed({1'b0, vv_q5});
  assign z = $signed({1'b0, vvvv_q5});
  shade_weigh #(
    .WIDTH(WIDTH), .F(F), .OUT_W(shade_pkg::INVC_F + 1), .OUT_F(shade_pkg::INVC_F),
    .K0(REFINED ? shade_pkg::INVC_0 : LINEAR ? shade_pkg::INVC1_0 : shade_pkg::INVC2_0),
    .KX(REFINED ? shade_pkg::INVC_C : LINEAR ? shade_pkg::INVC1_C : shade_pkg::INVC2_C),
    .KY(REFINED ? shade_pkg::INVC_UU : LINEAR ? 0 : shade_pkg::INVC2_CC),
    .KZ(REFINED ? shade_pkg::INVC_UUUU : 0)
  ) u_invc (.clk_i, .x_i(x), .y_i(y), .z_i(z), .w_o(invc));
  assign invc_o.invc = shade_pkg::INVC_F'(invc);
  logic unused_sign;
  assign unused_sign = &{1'b0, invc[shade_pkg::INVC_F]};

  shade_half #(.FORM(FORM)) u_half (.clk_i, .c_i(c_q4), .uu_i(vv_q5), .uuuu_i(vvvv_q5), .half_o(invc_o.half));
  shade_delay #(.WIDTH(1), .DEPTH(shade_pkg::LATENCY_INVC - 1)) u_clamped (
    .clk_i, .d_i(clamped_q1), .q_o(invc_o.clamped)
  );
endmodule
