// SPDX-License-Identifier: Apache-2.0
// shade_poly_start: nodes of one channel of a record in, its first forward differences out.
//
//   A, B, C of shade_coef (node set left, form refined), with dk = Ik - I1, Q = d3 - 2 d2, X = d4 - 2 d3 - 4 Q:
//     degree 3   A = 8 X / 3, to nearest     B = 2 (4 Q - X)     C = d4 - B - A
//     degree 2   A = 0                       B = 2 Q             C = d3 - B
//     degree 1   A = 0                       B = 0               C = d2
//   (X / 3 is rounded once: 8 X + 3 C is a whole number of 3, so that C is the integer nearest to its value as well)
//
//   d1 = A h^3 + B h^2 + C h,  d2 = 6 A h^3 + 2 B h^2,  d3 = 6 A h^3      h = 2^-log2, as of shade_fdiff
//
//   nodes_i     S1.16         degree_i, log2_i: with them; log2 1 .. LOG2_MAX for degree 1, 2 .. LOG2_MAX for 2 and 3
//   d1_o ..     WIDTH bits: S3.16 with 3 LOG2_MAX more fraction bits, modulo 2^WIDTH: I itself is in range, |I| <= 6.2;
//               degree 0: anything
//
// Exact but for the rounding of A. Latency LATENCY_POLY_START = 13 clocks, one channel a clock, no multiplier.
// Example: degree 1, log2 = 1, I = 0, 1/2 -> d1 = 1/4. Source: P1, section IV; forward differences.
module shade_poly_start #(
  parameter int LOG2_MAX = shade_pkg::RECORD_LOG2,
  parameter int WIDTH    = shade_pkg::INTENSITY_W + 2 + 3 * LOG2_MAX
) (
  input  logic                                  clk_i,
  input  logic        [shade_pkg::DEGREE_W-1:0] degree_i,
  input  logic        [  shade_pkg::LOG2_W-1:0] log2_i,
  input  shade_pkg::channel_t                   nodes_i,
  output logic signed [              WIDTH-1:0] d1_o,
  output logic signed [              WIDTH-1:0] d2_o,
  output logic signed [              WIDTH-1:0] d3_o
);
  if (LOG2_MAX < 2 || LOG2_MAX > shade_pkg::LOG2_MAX || WIDTH != shade_pkg::INTENSITY_W + 2 + 3 * LOG2_MAX)
  begin : g_check
    $error("shade_poly_start: LOG2_MAX must be in 2 .. 12, WIDTH is not to be set");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int COEF_W = shade_pkg::COEF_W;
  localparam int X_W = W + 5;  // |X| <= 18 max|I|
  localparam int HALF_W = COEF_W - 1;  // B / 2
  localparam logic [shade_pkg::DEGREE_W-1:0] QUADRATIC = shade_pkg::DEGREE_W'(shade_pkg::DEGREE_QUADRATIC);
  localparam logic [shade_pkg::DEGREE_W-1:0] CUBIC = shade_pkg::DEGREE_W'(shade_pkg::DEGREE_CUBIC);

  // ---- A, B, C -----------------------------------------------------------------------------------------------------
  logic signed [W-1:0] i1, i2, i3, i4;
  logic signed [W:0] d2_q1, d3_q1, d4_q1, end_q2, end_q3, end_q4;
  logic signed [W+2:0] bend_q2, bend_q3, rest_q2;  // Q; d4 - 2 d3
  logic signed [X_W-1:0] x_q3;
  logic signed [HALF_W-1:0] half_q4, half_q5, half_q8, half_q9;
  logic signed [COEF_W-1:0] ac_q5, ac_q8, a_q8, a_q9, c_q9;
  logic [shade_pkg::DEGREE_W-1:0] degree_q1, degree_q2;
  logic cubic_q3;
  assign i1 = nodes_i.n0;
  assign i2 = nodes_i.n1;
  assign i3 = nodes_i.n2;
  assign i4 = nodes_i.n3;
  always_ff @(posedge clk_i) begin
    degree_q1 <= degree_i;
    d2_q1     <= i2 - i1;
    d3_q1     <= i3 - i1;
    d4_q1     <= i4 - i1;

    degree_q2 <= degree_q1;
    bend_q2   <= (W + 3)'(d3_q1) - ((W + 3)'(d2_q1) <<< 1);
    rest_q2   <= (W + 3)'(d4_q1) - ((W + 3)'(d3_q1) <<< 1);
    case (degree_q1)
      CUBIC:     end_q2 <= d4_q1;
      QUADRATIC: end_q2 <= d3_q1;
      default:   end_q2 <= d2_q1;
    endcase

    cubic_q3 <= degree_q2 == CUBIC;
    x_q3     <= degree_q2 == CUBIC ? X_W'(rest_q2) - (X_W'(bend_q2) <<< 2) : '0;
    bend_q3  <= degree_q2 >= QUADRATIC ? bend_q2 : '0;
    end_q3   <= end_q2;

    half_q4  <= (cubic_q3 ? HALF_W'(bend_q3) <<< 2 : HALF_W'(bend_q3)) - HALF_W'(x_q3);
    end_q4   <= end_q3;

    half_q5  <= half_q4;
    ac_q5    <= COEF_W'(end_q4) - {half_q4, 1'b0};  // A + C

    half_q9  <= half_q8;
    a_q9     <= a_q8;
    c_q9     <= ac_q8 - a_q8;
  end
  shade_third #(.WIDTH(COEF_W + 1)) u_third (.clk_i, .x_i({x_q3, 3'b000}), .y_o(a_q8));
  shade_delay #(.WIDTH(HALF_W + COEF_W), .DEPTH(3)) u_wait (.clk_i, .d_i({half_q5, ac_q5}), .q_o({half_q8, ac_q8}));

  // ---- differences, in units of 2^-(3 LOG2_MAX) ulp: A 2^(3 e), B 2^(2 e + LOG2_MAX), C 2^(e + 2 LOG2_MAX), e = LOG2_MAX - log2
  // e = 4 coarse + fine. Where LOG2_MAX <= 5 only a line can have e = 4, of which A and B are 0.
  localparam int COARSE = LOG2_MAX > 5 ? 4 : 0;
  logic [1:0] coarse, fine, coarse_q9, fine_q9, coarse_q10;
  logic signed [WIDTH-1:0] a_q10, b_q10, c_q10, a_q11, b_q11, c_q11, ab_q12, six_q12, b_q12, c_q12;
  assign {coarse, fine} = 4'(LOG2_MAX) - log2_i;
  shade_delay #(.WIDTH(4), .DEPTH(9)) u_e (.clk_i, .d_i({coarse, fine}), .q_o({coarse_q9, fine_q9}));
  always_ff @(posedge clk_i) begin
    coarse_q10 <= coarse_q9;
    case (fine_q9)
      2'd0: {a_q10, b_q10, c_q10} <= {WIDTH'(a_q9),       WIDTH'(half_q9),       WIDTH'(c_q9)};
      2'd1: {a_q10, b_q10, c_q10} <= {WIDTH'(a_q9) <<< 3, WIDTH'(half_q9) <<< 2, WIDTH'(c_q9) <<< 1};
      2'd2: {a_q10, b_q10, c_q10} <= {WIDTH'(a_q9) <<< 6, WIDTH'(half_q9) <<< 4, WIDTH'(c_q9) <<< 2};
      2'd3: {a_q10, b_q10, c_q10} <= {WIDTH'(a_q9) <<< 9, WIDTH'(half_q9) <<< 6, WIDTH'(c_q9) <<< 3};
    endcase

    a_q11 <= a_q10;
    b_q11 <= b_q10;
    c_q11 <= coarse_q10[0] ? c_q10 <<< 4 : c_q10;
    if (COARSE != 0) begin
      case (coarse_q10)
        2'd0: {a_q11, b_q11, c_q11} <= {a_q10,                b_q10,               c_q10};
        2'd1: {a_q11, b_q11, c_q11} <= {a_q10 <<< 3 * COARSE, b_q10 <<< 2 * COARSE, c_q10 <<< COARSE};
        2'd2: {a_q11, b_q11, c_q11} <= {a_q10 <<< 6 * COARSE, b_q10 <<< 4 * COARSE, c_q10 <<< 2 * COARSE};
        2'd3: {a_q11, b_q11, c_q11} <= {a_q10 <<< 9 * COARSE, b_q10 <<< 6 * COARSE, c_q10 <<< 3 * COARSE};
      endcase
    end

    six_q12 <= (a_q11 <<< 2) + (a_q11 <<< 1);
    ab_q12  <= a_q11 + (b_q11 <<< (LOG2_MAX + 1));
    b_q12   <= b_q11;
    c_q12   <= c_q11;

    d1_o    <= ab_q12 + (c_q12 <<< (LOG2_MAX + LOG2_MAX));
    d2_o    <= six_q12 + (b_q12 <<< (LOG2_MAX + 2));
    d3_o    <= six_q12;
  end
endmodule
