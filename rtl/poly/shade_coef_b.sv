// SPDX-License-Identifier: Apache-2.0
// shade_coef_b: coefficient B of I(t) = A t^3 + B t^2 + C t + D through the node intensities of a span.
//
//   degree 3, NODES_LEFT  {0, 1/4, 1/2, 1}   2 (7 I1 - 16 I2 + 10 I3 - I4)  = 2 (10 d3 - 16 d2 - d4)     dk = Ik - I1
//   degree 3, NODES_RIGHT {0, 1/2, 3/4, 1}   2 (3 I1 - 14 I2 + 16 I3 - 5 I4) = 2 (16 d3 - 14 d2 - 5 d4)
//   degree 2, nodes {0, 1/2, 1}              2 (I1 - 2 I2 + I3)             = 2 (d3 - 2 d2)
//   degree 1 and 0                           0
//
// Exact (nothing is divided), so that the paper's form and the refined one are the same. Shifts and adds only:
// 10 = 8 + 2, 14 = 16 - 2, 5 = 4 + 1 (P1, Fig. 8).
//
//   i1_i .. i4_i  sd.ffff          WIDTH bits, S1.16 by default
//   b_o      sdddddddd.ffff        WIDTH + 7 bits; |B| <= 76 max|I|, overflow is impossible
//
// Latency LATENCY_COEF = 9 clocks, one set of nodes a clock. Source: P1, section IV.
// Example (left): the nodes of t^2, I = 0, 1/16, 1/4, 1 -> B = 1.
module shade_coef_b #(
  parameter int WIDTH = shade_pkg::INTENSITY_W,
  parameter int NODES = shade_pkg::NODES_LEFT
) (
  input  logic                                          clk_i,
  input  logic        [        shade_pkg::DEGREE_W-1:0] degree_i,
  input  logic signed [                      WIDTH-1:0] i1_i,
  input  logic signed [                      WIDTH-1:0] i2_i,
  input  logic signed [                      WIDTH-1:0] i3_i,
  input  logic signed [                      WIDTH-1:0] i4_i,
  output logic signed [WIDTH+shade_pkg::COEF_GROWTH-1:0] b_o
);
  if (WIDTH < 3 || WIDTH > 20) begin : g_check
    $error("shade_coef_b: WIDTH must be in 3 .. 20");
  end
  if (NODES != shade_pkg::NODES_LEFT && NODES != shade_pkg::NODES_RIGHT) begin : g_check_nodes
    $error("shade_coef_b: NODES must be NODES_LEFT or NODES_RIGHT");
  end

  localparam bit LEFT = NODES == shade_pkg::NODES_LEFT;
  localparam int SUM_W = WIDTH + shade_pkg::COEF_GROWTH - 1;  // B / 2

  logic [shade_pkg::DEGREE_W-1:0] degree_q1, degree_q2;
  logic signed [WIDTH:0] d2_q1, d3_q1, d4_q1;
  logic signed [SUM_W-1:0] d2, d3, d4, plus_q2, minus_q2, square_q2, half_q3;
  assign d2 = SUM_W'(d2_q1);
  assign d3 = SUM_W'(d3_q1);
  assign d4 = SUM_W'(d4_q1);

  always_ff @(posedge clk_i) begin
    degree_q1 <= degree_i;
    degree_q2 <= degree_q1;

    d2_q1     <= i2_i - i1_i;
    d3_q1     <= i3_i - i1_i;
    d4_q1     <= i4_i - i1_i;

    // 10 d3 - (16 d2 + d4), or (16 d3 + 2 d2) - (16 d2 + 5 d4) with 16 (d3 - d2) in one sum
    plus_q2   <= LEFT ? (d3 <<< 3) + (d3 <<< 1) : ((d3 - d2) <<< 4) + (d2 <<< 1);
    minus_q2  <= LEFT ? (d2 <<< 4) + d4 : (d4 <<< 2) + d4;
    square_q2 <= d3 - (d2 <<< 1);

    case (degree_q2)
      shade_pkg::DEGREE_W'(shade_pkg::DEGREE_CUBIC):     half_q3 <= plus_q2 - minus_q2;
      shade_pkg::DEGREE_W'(shade_pkg::DEGREE_QUADRATIC): half_q3 <= square_q2;
      default:                                           half_q3 <= '0;
    endcase
  end

  // A and C take longer, because of their division by three
  logic signed [SUM_W-1:0] half_q9;
  shade_delay #(.WIDTH(SUM_W), .DEPTH(shade_pkg::LATENCY_COEF - 3)) u_align (.clk_i, .d_i(half_q3), .q_o(half_q9));
  assign b_o = {half_q9, 1'b0};
endmodule
