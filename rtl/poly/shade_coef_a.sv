// SPDX-License-Identifier: Apache-2.0
// shade_coef_a: coefficient A of the cubic I(t) = A t^3 + B t^2 + C t + D through four node intensities.
//
//   NODES_LEFT  {0, 1/4, 1/2, 1}   FORM_PAPER    8 (8 I2 + I4)/3 - 8 (I1 + 2 I3)
//                                  FORM_REFINED  8 (8 d2 - 6 d3 + d4)/3           dk = Ik - I1
//   NODES_RIGHT {0, 1/2, 3/4, 1}   FORM_PAPER    8 (2 I2 + I4) - 8 (I1 + 8 I3)/3
//                                  FORM_REFINED  8 (6 d2 - 8 d3 + 3 d4)/3
//
// The paper's two parts nearly cancel, so that the error of its x/3 hits the intensity itself; the difference form
// divides once, and a constant intensity gives exactly 0. Shifts and adds only. Refined: the integer nearest to A.
// Of a degree below 3, A is 0.
//
//   i1_i .. i4_i  sd.ffff          WIDTH bits, S1.16 by default
//   a_o      sdddddddd.ffff        WIDTH + 7 bits; |A| <= 48 max|I| (paper: 48.2), overflow is impossible
//
// Latency LATENCY_COEF = 9 clocks, one set of nodes a clock. Source: P1, section IV.
// Example (left, refined): the nodes of t^3, I = 0, 1/64, 1/8, 1 -> A = 1.
module shade_coef_a #(
  parameter int WIDTH = shade_pkg::INTENSITY_W,
  parameter int NODES = shade_pkg::NODES_LEFT,
  parameter int FORM  = shade_pkg::FORM_REFINED
) (
  input  logic                                          clk_i,
  input  logic        [        shade_pkg::DEGREE_W-1:0] degree_i,
  input  logic signed [                      WIDTH-1:0] i1_i,
  input  logic signed [                      WIDTH-1:0] i2_i,
  input  logic signed [                      WIDTH-1:0] i3_i,
  input  logic signed [                      WIDTH-1:0] i4_i,
  output logic signed [WIDTH+shade_pkg::COEF_GROWTH-1:0] a_o
);
  if (WIDTH < 3 || WIDTH > 20) begin : g_check
    $error("shade_coef_a: WIDTH must be in 3 .. 20");
  end
  if (NODES != shade_pkg::NODES_LEFT && NODES != shade_pkg::NODES_RIGHT) begin : g_check_nodes
    $error("shade_coef_a: NODES must be NODES_LEFT or NODES_RIGHT");
  end
  if (FORM != shade_pkg::FORM_PAPER && FORM != shade_pkg::FORM_REFINED) begin : g_check_form
    $error("shade_coef_a: FORM must be FORM_PAPER or FORM_REFINED");
  end

  localparam bit REFINED = FORM == shade_pkg::FORM_REFINED;
  localparam bit LEFT = NODES == shade_pkg::NODES_LEFT;
  localparam int OUT_W = WIDTH + shade_pkg::COEF_GROWTH;
  localparam int SUM_W = WIDTH + 5;  // A / 8 before the division: |8 I2 + I4| + |3 I1 + 6 I3| <= 18 max|I|

  logic cubic_q2;
  shade_delay #(.WIDTH(1), .DEPTH(2)) u_cubic (
    .clk_i, .d_i(degree_i == shade_pkg::DEGREE_W'(shade_pkg::DEGREE_CUBIC)), .q_o(cubic_q2)
  );

  // A / 8 = divided / 3 + exact
  logic signed [SUM_W-1:0] divided, divided_q3, exact, exact_q3, exact_q8;
  if (REFINED) begin : g_refined
    logic signed [WIDTH:0] d2_q1, d3_q1, d4_q1;
    logic signed [SUM_W-1:0] d24_q2, d3_q2;
    always_ff @(posedge clk_i) begin
      d2_q1  <= i2_i - i1_i;
      d3_q1  <= i3_i - i1_i;
      d4_q1  <= i4_i - i1_i;
      d24_q2 <= (SUM_W'(d2_q1) <<< (LEFT ? 3 : 1)) + SUM_W'(d4_q1);
      d3_q2  <= LEFT ? (SUM_W'(d3_q1) <<< 2) + (SUM_W'(d3_q1) <<< 1) : SUM_W'(d3_q1) <<< 3;
    end
    assign divided = LEFT ? d24_q2 - d3_q2 : (d24_q2 <<< 1) + d24_q2 - d3_q2;
    assign exact   = '0;
  end else begin : g_paper
    logic signed [SUM_W-1:0] i24_q1, i13_q1, i24_q2, i13_q2;
    always_ff @(posedge clk_i) begin
      i24_q1 <= (SUM_W'(i2_i) <<< (LEFT ? 3 : 1)) + SUM_W'(i4_i);
      i13_q1 <= (SUM_W'(i3_i) <<< (LEFT ? 1 : 3)) + SUM_W'(i1_i);
      i24_q2 <= i24_q1;
      i13_q2 <= i13_q1;
    end
    assign divided = LEFT ? i24_q2 : -i13_q2;
    assign exact   = LEFT ? -i13_q2 : i24_q2;
  end

  always_ff @(posedge clk_i) begin
    divided_q3 <= cubic_q2 ? divided : '0;
    exact_q3   <= cubic_q2 ? exact : '0;
  end

  logic signed [OUT_W-1:0] third_q8;
  shade_third #(.WIDTH(OUT_W + 1), .FORM(FORM)) u_third (
    .clk_i, .x_i({divided_q3, 3'b000}), .y_o(third_q8)
  );
  shade_delay #(.WIDTH(SUM_W), .DEPTH(shade_pkg::LATENCY_THIRD)) u_exact (.clk_i, .d_i(exact_q3), .q_o(exact_q8));
  always_ff @(posedge clk_i) a_o <= third_q8 + (OUT_W'(exact_q8) <<< 3);
endmodule
