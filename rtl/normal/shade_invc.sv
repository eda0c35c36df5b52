// shade_invc: InvC = 1/sqrt(2 (1 + c)) and h = cos(psi/2) for c = cos psi: what the middle of two unit normals needs.
//
//   FORM_REFINED            InvC = 1/2 + 125 u/1024 + 265 u^2/4096 + w/32    h = 1 - u/4 - 9 u^2/256 - w/64
//   FORM_PAPER, DEGREE = 1  InvC1 = 0.683 - 0.191 c                          h = d2(c), see shade_half
//   FORM_PAPER, DEGREE = 2  InvC2 = 0.703 - 0.3 c + 0.098 c^2                h = d2(c)
//
// with u = 1 - c, w = max(0, u - 1/2). Refined, both come from one square and are exact for c = 1 (equal normals); for
// c >= 1/2 within 3.2e-4 (relative) and 1.9e-4, below within 0.7 % and 1.9e-3. h is the c of the interval's halves.
//
//   c_i        S1.16, clamped to [0, 1]; clamped_o tells, with the result
//   u^2, c^2   18 fraction bits, the rest is cut
//   invc_o     U0.17 in [0.49, 0.71]; half_o  S1.16; both to nearest, ties up: error at most 0.55 ulp of the formula
//
// Constants of 16 fraction bits, by shifts and adds; one 18 x 18 multiplier (none in DEGREE 1).
// Latency LATENCY_INVC = 7 clocks, one value a clock. Source: P4, section 2.
// Example: c = 1/2 -> InvC = 0.57721, h = 0.86621 (refined; the functions: 0.57735, 0.86603).
module shade_invc #(
  parameter int FORM   = shade_pkg::FORM_REFINED,
  parameter int DEGREE = 2
) (
  input  logic                                     clk_i,
  input  logic                                     rst_i,
  input  logic                                     valid_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] c_i,
  output logic                                     valid_o,
  output logic                                     clamped_o,
  output logic        [     shade_pkg::INVC_F-1:0] invc_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] half_o
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
  localparam logic [C_W-1:0] MIDDLE = C_W'(1) << (shade_pkg::INTENSITY_F - 1);

  logic [C_W-1:0] c, c_q1, c_q2, c_q3, w_q3, v_q1;  // v: what is squared, u or c
  logic clamped, clamped_q1;
  shade_clamp u_clamp (.x_i(c_i), .y_o(c), .clamped_o(clamped));
  always_ff @(posedge clk_i) begin
    c_q1       <= c;
    c_q2       <= c_q1;
    c_q3       <= c_q2;
    w_q3       <= REFINED && c_q2 < MIDDLE ? MIDDLE - c_q2 : '0;
    v_q1       <= REFINED ? (C_W'(1) << shade_pkg::INTENSITY_F) - c : c;
    clamped_q1 <= clamped;
  end

  logic [2*C_W:0] square_q3;
  logic [F:0] vv_q3;
  shade_square #(.WIDTH(C_W + 1)) u_square (.clk_i, .x_i($signed({1'b0, v_q1})), .y_o(square_q3));
  assign vv_q3 = square_q3[CUT+:F+1];
  logic unused_square;
  assign unused_square = &{1'b0, square_q3};

  localparam bit LINEAR = DEGREE == 1;
  logic signed [WIDTH-1:0] x, y, z;
  logic signed [shade_pkg::INVC_F:0] invc;
  assign x = $signed({1'b0, c_q3, {ALIGN{1'b0}}});
  assign y = $signed({1'b0, vv_q3});
  assign z = $signed({1'b0, w_q3, {ALIGN{1'b0}}});
  shade_weigh #(
    .WIDTH(WIDTH), .F(F), .OUT_W(shade_pkg::INVC_F + 1), .OUT_F(shade_pkg::INVC_F),
    .K0(REFINED ? shade_pkg::INVC_0 : LINEAR ? shade_pkg::INVC1_0 : shade_pkg::INVC2_0),
    .KX(REFINED ? shade_pkg::INVC_C : LINEAR ? shade_pkg::INVC1_C : shade_pkg::INVC2_C),
    .KY(REFINED ? shade_pkg::INVC_UU : LINEAR ? 0 : shade_pkg::INVC2_CC),
    .KZ(REFINED ? shade_pkg::INVC_W : 0)
  ) u_invc (.clk_i, .x_i(x), .y_i(y), .z_i(z), .w_o(invc));
  assign invc_o = invc[shade_pkg::INVC_F-1:0];
  logic unused_sign;
  assign unused_sign = &{1'b0, invc[shade_pkg::INVC_F]};

  shade_half #(.FORM(FORM)) u_half (.clk_i, .c_i(c_q2), .uu_i(vv_q3), .half_o);

  localparam int LATENCY = shade_pkg::LATENCY_INVC;
  shade_delay #(.WIDTH(1), .DEPTH(LATENCY - 1)) u_clamped (.clk_i, .d_i(clamped_q1), .q_o(clamped_o));
  shade_valid #(.DEPTH(LATENCY)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);
endmodule
