// SPDX-License-Identifier: Apache-2.0
// shade_patch_lines: from a box's coefficients to the start of each of its lines, in one channel.
//
//   ct_i .. p_i    of shade_patch_coef; they stay for 2 clocks behind load_i
//   load_i         a box: its first line is X = Y = -8 of what follows, in eighths of half a box
//   step_i         the line at hand goes out, the next one, 2^jy further, is made; with it x_i, the line's first pixel
//   jx_i, jy_i     4 - kx, 4 - ky, 0 .. 2, of the box of step_i
//   first_o        I = 32 + 64 C + 4 (2 s X + 2 t Y) + p X^2 + q X Y + r Y^2
//   d1_o           the step to the next pixel, X + 2^jx;   d2_o  its step
//
//   A(Y) = 64 C + 8 t Y + r Y^2 and B(Y) = 8 s + q Y by differences from line to line; then I = A + X (B + p X) by four
//   additions, two bits of X each. Half an ulp of 2^-16 is added. Units of 2^-22, all sums exact modulo 2^PATCH_VALUE_W. No multiplier.
// Latency LATENCY_PATCH_LINES = 4 clocks from step_i, a line a clock. A's part runs two clocks behind B's.
// Example: ct = 2, others 0 (all nodes 1) -> 1, 0, 0 in every line.
module shade_patch_lines (
  input  logic                                       clk_i,
  input  logic signed [  shade_pkg::INTENSITY_W+1:0] ct_i,
  input  logic signed [  shade_pkg::INTENSITY_W+3:0] r_i,
  input  logic signed [  shade_pkg::INTENSITY_W+5:0] u_i,
  input  logic signed [  shade_pkg::INTENSITY_W+1:0] s_i,
  input  logic signed [  shade_pkg::INTENSITY_W+1:0] q_i,
  input  logic signed [  shade_pkg::INTENSITY_W+4:0] p_i,
  input  logic                                       load_i,
  input  logic                                       load_late_i,  // load_i and step_i of two clocks ago
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

  // ---- lines: B and p, four clocks later A -----------------------------------------------------------------------------------
  logic signed [W-1:0] b_q, db_q, p_q, a_q, da_q, dda_q;
  logic signed [W-1:0] r2;
  logic [W-6:0] both;
  assign both = (W - 5)'(({(W - 5)'(ct_i), 1'b1} + {(W - 5)'(r_i) <<< 1, 1'b1}) >> 1);
  assign r2 = W'(r_i) <<< {jy_late_i, 1'b0};
  always_ff @(posedge clk_i) begin
    if (load_i) begin
      b_q  <= (W'(s_i) <<< 2) - (W'(q_i) <<< 3);
      db_q <= W'(q_i) <<< jy_i;
      p_q  <= W'(p_i);
    end else if (step_i) b_q <= b_q + db_q;
    if (load_late_i) begin
      // 64 C - 32 (2 t) + 64 r, and half an ulp of a pixel
      a_q   <= $signed({both, 5'd0});
      da_q  <= (W'(u_i) <<< (3'd2 + 3'(jy_late_i))) + r2;
      dda_q <= r2 <<< 1;
    end else if (step_late_i) begin
      a_q  <= a_q + da_q;
      da_q <= da_q + dda_q;
    end
  end

  // ---- pixels: V = B + p X, I = A + V X, with X = 4 high + low, low -2 .. 1, high -2 .. 2 ------------------------------------------------
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
  logic [2:0] top, top_q1, top_q2, top_q3;
  logic [1:0] low_q1, low_q2, jx_q1, jx_q2, jx_q3;
  logic signed [W-1:0] b_q1, p_q1, bp_q1, b_q2, p_q2, v_q2, p_q3, v_q3, vu_q3, va_q3, value_q4, d1_q4, d2_q4, p4;
  assign top = {x_i[3], x_i[3:2]} + 3'(x_i[1]);
  assign p4  = p_q3 <<< {jx_q3, 1'b0};
  always_ff @(posedge clk_i) begin
    bp_q1 <= low(b_q, p_q, x_i[1:0]);
    {b_q1, p_q1, top_q1, low_q1, jx_q1} <= {b_q, p_q, top, x_i[1:0], jx_i};

    v_q2 <= high(bp_q1, p_q1, top_q1);
    {b_q2, p_q2, top_q2, low_q2, jx_q2} <= {b_q1, p_q1, top_q1, low_q1, jx_q1};

    va_q3 <= low(a_q, v_q2, low_q2);
    vu_q3 <= (v_q2 <<< 1) - b_q2;  // B + 2 p X
    {v_q3, p_q3, top_q3, jx_q3} <= {v_q2, p_q2, top_q2, jx_q2};

    value_q4 <= high(va_q3, v_q3, top_q3);
    d1_q4    <= (vu_q3 <<< jx_q3) + p4;
    d2_q4    <= p4 <<< 1;
  end
  assign {first_o, d1_o, d2_o} = {value_q4, d1_q4, d2_q4};
endmodule
