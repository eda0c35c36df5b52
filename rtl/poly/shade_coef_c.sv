// SPDX-License-Identifier: Apache-2.0
// shade_coef_c: coefficient C of I(t) = A t^3 + B t^2 + C t + D through the node intensities of a span.
//
//   degree 3, NODES_LEFT  {0, 1/4, 1/2, 1}   FORM_PAPER    (32 I2 + I4)/3 - 7 I1 - 4 I3
//                                            FORM_REFINED  (32 d2 - 12 d3 + d4)/3           dk = Ik - I1
//   degree 3, NODES_RIGHT {0, 1/2, 3/4, 1}   FORM_PAPER    3 (4 I2 + I4) - (13 I1 + 32 I3)/3
//                                            FORM_REFINED  (36 d2 - 32 d3 + 9 d4)/3
//   degree 2, nodes {0, 1/2, 1}              4 I2 - 3 I1 - I3 = 4 d2 - d3
//   degree 1, nodes {0, 1}                   I2 - I1 = d2
//   degree 0                                 0
//
// Shifts and adds only; why the refined form is a sum of differences: see shade_coef_a. Refined: the integer nearest
// to C; degrees 2 and 1 are exact in both forms.
//
//   i1_i .. i4_i  sd.ffff          WIDTH bits, S1.16 by default
//   c_o      sdddddddd.ffff        WIDTH + 7 bits; |C| <= 30 max|I| (paper: 30.2), overflow is impossible
//
// Latency LATENCY_COEF = 9 clocks, one set of nodes a clock. Source: P1, section IV.
// Example (left, refined): the nodes of t, I = 0, 1/4, 1/2, 1 -> C = 1.
module shade_coef_c #(
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
  output logic signed [WIDTH+shade_pkg::COEF_GROWTH-1:0] c_o
);
  if (WIDTH < 3 || WIDTH > 20) begin : g_check
    $error("shade_coef_c: WIDTH must be in 3 .. 20");
  end
  if (NODES != shade_pkg::NODES_LEFT && NODES != shade_pkg::NODES_RIGHT) begin : g_check_nodes
    $error("shade_coef_c: NODES must be NODES_LEFT or NODES_RIGHT");
  end
  if (FORM != shade_pkg::FORM_PAPER && FORM != shade_pkg::FORM_REFINED) begin : g_check_form
    $error("shade_coef_c: FORM must be FORM_PAPER or FORM_REFINED");
  end

  localparam bit REFINED = FORM == shade_pkg::FORM_REFINED;
  localparam bit LEFT = NODES == shade_pkg::NODES_LEFT;
  localparam int OUT_W = WIDTH + shade_pkg::COEF_GROWTH;
  localparam int SUM_W = OUT_W;  // 3 C: |36 I2 + 9 I4| + |13 I1 + 32 I3| <= 90 max|I|

  logic [shade_pkg::DEGREE_W-1:0] degree_q2;
  shade_delay #(.WIDTH(shade_pkg::DEGREE_W), .DEPTH(2)) u_degree (.clk_i, .d_i(degree_i), .q_o(degree_q2));

  logic signed [WIDTH:0] d2_q1, d3_q1, d2_q2;
  logic signed [SUM_W-1:0] d2, d3, square_q2;
  assign d2 = SUM_W'(d2_q1);
  assign d3 = SUM_W'(d3_q1);
  always_ff @(posedge clk_i) begin
    d2_q1     <= i2_i - i1_i;
    d3_q1     <= i3_i - i1_i;
    d2_q2     <= d2_q1;
    square_q2 <= (d2 <<< 2) - d3;
  end

  // C = divided / 3 + exact
  logic signed [SUM_W-1:0] divided, divided_q3, exact, exact_q3, exact_q8;
  if (REFINED) begin : g_refined
    logic signed [WIDTH:0] d4_q1;
    logic signed [SUM_W-1:0] d24_q2, d3_q2;
    always_ff @(posedge clk_i) begin
      d4_q1  <= i4_i - i1_i;
      d24_q2 <= (d2 <<< (LEFT ? 5 : 2)) + SUM_W'(d4_q1);
      d3_q2  <= LEFT ? (d3 <<< 3) + (d3 <<< 2) : d3 <<< 5;
    end
    assign divided = LEFT ? d24_q2 - d3_q2 : (d24_q2 <<< 3) + d24_q2 - d3_q2;
    assign exact   = '0;
  end else begin : g_paper
    logic signed [SUM_W-1:0] i1, i3, i24_q1, i13_q1, more_q1, i24_q2, i13_q2;
    assign i1 = SUM_W'(i1_i);
    assign i3 = SUM_W'(i3_i);
    always_ff @(posedge clk_i) begin
      i24_q1  <= (SUM_W'(i2_i) <<< (LEFT ? 5 : 2)) + SUM_W'(i4_i);
      i13_q1  <= LEFT ? (i1 <<< 3) - i1 : (i1 <<< 3) + (i1 <<< 2);
      more_q1 <= LEFT ? i3 <<< 2 : (i3 <<< 5) + i1;
      i24_q2  <= LEFT ? i24_q1 : (i24_q1 <<< 1) + i24_q1;
      i13_q2  <= i13_q1 + more_q1;
    end
    assign divided = LEFT ? i24_q2 : -i13_q2;
    assign exact   = LEFT ? -i13_q2 : i24_q2;
  end

  always_ff @(posedge clk_i) begin
    divided_q3 <= '0;
    case (degree_q2)
      shade_pkg::DEGREE_W'(shade_pkg::DEGREE_CUBIC): begin
        divided_q3 <= divided;
        exact_q3   <= exact;
      end
      shade_pkg::DEGREE_W'(shade_pkg::DEGREE_QUADRATIC): exact_q3 <= square_q2;
      shade_pkg::DEGREE_W'(shade_pkg::DEGREE_LINEAR):    exact_q3 <= SUM_W'(d2_q2);
      default:                                           exact_q3 <= '0;
    endcase
  end

  logic signed [SUM_W-2:0] third_q8;
  shade_third #(.WIDTH(SUM_W), .FORM(FORM)) u_third (
    .clk_i, .x_i(divided_q3), .y_o(third_q8)
  );
  shade_delay #(.WIDTH(SUM_W), .DEPTH(shade_pkg::LATENCY_THIRD)) u_exact (.clk_i, .d_i(exact_q3), .q_o(exact_q8));
  always_ff @(posedge clk_i) c_o <= OUT_W'(third_q8) + exact_q8;
endmodule
