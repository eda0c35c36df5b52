// SPDX-License-Identifier: Apache-2.0
// shade_horner_seq: I(t) = ((A t + B) t + C) t + D with one multiplier, one adder and one register (P1, Fig. 9).
//
//            A   RG            C   D
//            |   |             |   |            step | MX1 | BK   | MX2 | RG after the clock
//           [ MX1 ]   t        |   |            load |  -  |  -   |  -  | B
//              |      |        |   |             1   |  A  | pass | MUL | A t + B
//              [ MUL  ]        |   |             2   |  RG | zero | MUL | (A t + B) t
//                 |            |   |             3   |  -  | pass |  C  | (A t + B) t + C
//     RG        [     MX2          ]             4   |  RG | zero | MUL | ((A t + B) t + C) t
//     |            |                             5   |  -  | pass |  D  | I(t)
//   [ BK ]         |
//      |           |
//      [   Sm      ] --> RG
//
// Formats, rounding, range and every bit of the result: those of shade_horner_pipe; each product is rounded on its way
// into RG, and the half ulps of the roundings enter Sm through unused low bits. RG is the multiplier's register.
// LATENCY_HORNER_SEQ = 6 clocks from a value taken (load) to its result; one value in 6 clocks. ready_o tells that the next
// clock can take a value; valid_o holds for one clock, y_o until the next load. Source: P1, section IV, Fig. 9.
// Example: A = B = C = D = 1, t = 1/2 -> RG = 1, 1.5, 0.75, 1.75, 0.875, 1.875.
module shade_horner_seq #(
  parameter int COEF_W = shade_pkg::COEF_W,
  parameter int D_W    = shade_pkg::INTENSITY_W,
  parameter int T_F    = shade_pkg::T_F
) (
  input  logic                                             clk_i,
  input  logic                                             rst_i,
  input  logic                                             valid_i,
  output logic                                             ready_o,
  input  logic signed [                        COEF_W-1:0] a_i,
  input  logic signed [                        COEF_W-1:0] b_i,
  input  logic signed [                        COEF_W-1:0] c_i,
  input  logic signed [                           D_W-1:0] d_i,
  input  logic        [                             T_F:0] t_i,
  output logic                                             valid_o,
  output logic signed [COEF_W+shade_pkg::VALUE_GROWTH-1:0] y_o
);
  if (COEF_W < 2 || COEF_W > 30 || D_W < 2 || D_W > COEF_W || T_F < 2 || T_F > 16) begin : g_check
    $error("shade_horner_seq: COEF_W must be in 2 .. 30, D_W in 2 .. COEF_W, T_F in 2 .. 16");
  end

  localparam int GUARD = shade_pkg::HORNER_GUARD;
  localparam int WIDTH = COEF_W + shade_pkg::VALUE_GROWTH + GUARD;
  localparam int PRODUCT_W = WIDTH + T_F + 2;

  // the step that the next clock executes; 0: idle, a load is possible
  logic [2:0] step_q;
  logic load;
  assign ready_o = step_q == 3'd0;
  assign load    = valid_i && ready_o;
  always_ff @(posedge clk_i) begin
    if (load) step_q <= 3'd1;
    else if (step_q == 3'd5) step_q <= 3'd0;
    else if (!ready_o) step_q <= step_q + 3'd1;
    valid_o <= step_q == 3'd5;
    if (rst_i) begin
      step_q  <= 3'd0;
      valid_o <= 1'b0;
    end
  end

  // operands of the value in work; B goes straight into RG
  logic signed [COEF_W-1:0] a_q, c_q;
  logic signed [D_W-1:0] d_q;
  logic [T_F:0] t_q;
  always_ff @(posedge clk_i) begin
    if (load) begin
      a_q <= a_i;
      c_q <= c_i;
      d_q <= d_i;
      t_q <= t_i;
    end
  end

  logic multiply;  // steps 1, 2, 4
  assign multiply = step_q == 3'd1 || step_q == 3'd2 || step_q == 3'd4;

  logic signed [WIDTH-1:0] rg_q, mx1, bk;
  logic signed [PRODUCT_W-1:0] mul, mx2, sm;

  assign mx1 = step_q == 3'd1 ? WIDTH'(a_q) <<< GUARD : rg_q;

  shade_mul #(.A_W(WIDTH), .B_W(T_F + 2), .STAGES(0)) u_mul (.clk_i, .a_i(mx1), .b_i({1'b0, t_q}), .p_o(mul));

  always_comb begin
    if (multiply) mx2 = mul;
    else if (step_q == 3'd3) mx2 = PRODUCT_W'(c_q) <<< (GUARD + T_F);
    else mx2 = PRODUCT_W'($signed({d_q, 1'b1, {(GUARD + T_F - 1) {1'b0}}}));  // D and the half ulp of y_o
  end

  assign bk = step_q == 3'd2 || step_q == 3'd4 ? '0 : rg_q;
  assign sm = PRODUCT_W'($signed({bk, 1'b1, {(T_F - 1) {1'b0}}})) + mx2;  // with the half ulp of RG

  always_ff @(posedge clk_i) begin
    if (load) rg_q <= WIDTH'(b_i) <<< GUARD;
    else if (!ready_o) rg_q <= WIDTH'(sm >>> T_F);
  end
  assign y_o = (WIDTH - GUARD)'(rg_q >>> GUARD);
endmodule
