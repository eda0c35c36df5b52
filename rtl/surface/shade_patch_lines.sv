// SPDX-License-Identifier: Apache-2.0
// shade_patch_lines: from a box's coefficients to the start of each of its lines, in one channel.
//
//   a_i .. r_i     of shade_patch_coef: b_i, p_i, q_i with load_i, the others with load_late_i
//   load_i         a box: its first line is X = Y = -8 of what follows, in eighths of half a box
//   step_i         the line at hand goes out, the next one, 2^jy further, is made; with it x_i, the line's first pixel
//   jx_i, jy_i     4 - kx, 4 - ky, 0 .. 2, of the box of step_i
//   first_o        I = 4 C + s X + t Y + p X^2 + q X Y + r Y^2
//   d1_o           the step to the next pixel, X + 2^jx;   d2_o  its step
//
//   A(Y) = 4 C + t Y + r Y^2 and B(Y) = s + q Y by differences from line to line; then V = B + p X by a multiplier and
//   I = A + X V by two additions, two bits of X each. Half an ulp of a pixel is in A. Units of 2^-18, sums modulo 2^PATCH_VALUE_W.
// Latency LATENCY_PATCH_LINES = 5 clocks from step_i, a line a clock. A's part runs PATCH_LINES_LATE clocks behind B's.
// Example: a = 4, others 0 (all nodes 2^-16) -> 4, 0, 0 in every line.
module shade_patch_lines (
  input  logic                                       clk_i,
  input  logic signed [shade_pkg::PATCH_VALUE_W-1:0] a_i,
  input  logic signed [shade_pkg::PATCH_VALUE_W-1:0] b_i,
  input  logic signed [shade_pkg::PATCH_VALUE_W-1:0] u_i,
  input  logic signed [  shade_pkg::INTENSITY_W-1:0] p_i,
  input  logic signed [  shade_pkg::INTENSITY_W-3:0] q_i,
  input  logic signed [  shade_pkg::INTENSITY_W-2:0] r_i,
  input  logic                                       load_i,
  input  logic                                       load_late_i,  // load_i and step_i of PATCH_LINES_LATE clocks ago
  input  logic        [                         1:0] jy_i,         // of load_i
  input  logic        [                         1:0] jy_late_i,
  input  logic                                       step_i,
  input  logic                                       step_late_i,
  input  logic signed [                         3:0] x_i,
  input  logic        [                         1:0] jx_i,
  output logic signed [shade_pkg::PATCH_VALUE_W-1:0] first_o,
  output logic signed [shade_pkg::PATCH_VALUE_W-1:0] d1_o,
  output logic signed [shade_pkg::PATCH_VALUE_W-1:0] d2_o
);
  localparam int W = shade_pkg::PATCH_VALUE_W;
  localparam int P_W = shade_pkg::INTENSITY_W;

  // ---- lines: B and p, later A -----------------------------------------------------------------------------------------
  logic signed [W-1:0] b_q, db_q, a_q, da_q, dda_q, r2;
  logic signed [P_W-1:0] p_q, p_late_q;
  assign r2 = W'(r_i) <<< {jy_late_i, 1'b0};
  always_ff @(posedge clk_i) begin
    if (load_i) begin
      b_q  <= b_i;
      db_q <= W'(q_i) <<< jy_i;
      p_q  <= p_i;
    end else if (step_i) b_q <= b_q + db_q;
    if (load_late_i) begin
      a_q      <= a_i;
      da_q     <= (u_i <<< jy_late_i) + r2;
      dda_q    <= r2 <<< 1;
      p_late_q <= p_q;
    end else if (step_late_i) begin
      a_q  <= a_q + da_q;
      da_q <= da_q + dda_q;
    end
  end

  // ---- pixels: V = B + p X; I = A + V X, with X = 4 high + low, low -2 .. 1, high -2 .. 2 --------------------------------------
  // a + v low, a + 4 v high: ones' complement and a carry where it is negative
  function automatic logic signed [W-1:0] low(
    input logic signed [W-1:0] a, input logic signed [W-1:0] v, input logic [1:0] n
  );
    logic [W-1:0] term;
    term = n == 2'd0 ? '0 : n == 2'd1 ? v : n == 2'd3 ? ~v : ~(v << 1);
    low  = $signed(W'(({a, 1'b1} + {term, n[1]}) >> 1));
  endfunction
  function automatic logic signed [W-1:0] high(
    input logic signed [W-1:0] a, input logic signed [W-1:0] v, input logic [2:0] n
  );
    logic [W-1:0] term;
    term = (n[0] ? v << 2 : n[1] ? v << 3 : '0) ^ {W{n[2]}};
    high = $signed(W'(({a, 1'b1} + {term, n[2]}) >> 1));
  endfunction
  localparam int X_W = shade_pkg::PATCH_LOG2_MAX;
  localparam int LATE = shade_pkg::PATCH_LINES_LATE;
  logic signed [P_W+X_W-1:0] px;
  logic signed [W-1:0] b_p, v_q3, b_q3, va_q4, v_q4, turn_q4, p2_q4, value_q5, d1_q5, d2_q5;
  logic signed [X_W-1:0] x_q3;
  logic [2:0] top_q4;
  logic [1:0] jx_q3, jx_q4;
  shade_mul #(.A_W(P_W), .B_W(X_W)) u_px (.clk_i, .a_i(p_q), .b_i(x_i), .p_o(px));
  shade_delay #(.WIDTH(W), .DEPTH(LATE - 1)) u_b (.clk_i, .d_i(b_q), .q_o(b_p));
  shade_delay #(.WIDTH(X_W + 2), .DEPTH(LATE)) u_x (.clk_i, .d_i({x_i, jx_i}), .q_o({x_q3, jx_q3}));
  always_ff @(posedge clk_i) begin
    v_q3 <= b_p + W'(px);
    b_q3 <= b_p;

    va_q4   <= low(a_q, v_q3, x_q3[1:0]);
    turn_q4 <= (v_q3 <<< 1) - b_q3;  // B + 2 p X
    p2_q4   <= W'(p_late_q) <<< {jx_q3, 1'b0};
    v_q4    <= v_q3;
    top_q4  <= {x_q3[3], x_q3[3:2]} + 3'(x_q3[1]);
    jx_q4   <= jx_q3;

    value_q5 <= high(va_q4, v_q4, top_q4);
    d1_q5    <= (turn_q4 <<< jx_q4) + p2_q4;
    d2_q5    <= p2_q4 <<< 1;
  end
  assign {first_o, d1_o, d2_o} = {value_q5, d1_q5, d2_q5};
  logic unused_bits;
  assign unused_bits = &{1'b0, px};
endmodule
