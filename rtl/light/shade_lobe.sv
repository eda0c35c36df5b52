// shade_lobe: max(0, 1 - k1 x + k2 x^2)^(2^power), the highlight of every model, over x = 1 - c, the versine of an angle.
//
//   x_i      dd.ffff f         U2.20   1 - c; beyond 1 (c < 0) the lobe is 0
//   shift_i  0 .. 6                    X = min(x 2^shift, xmax), U1.16, is what k1 and k2 belong to:
//   k1_i      d.ffff f         U1.20   k1 / 2^shift
//   k2_i      s.ffff           S0.17   k2 / 4^shift; 0 is the form of P1 and P3
//   xmax_i    d.ffff           U1.16   where a parabola that opens upwards has its vertex, k1 / (2 k2)
//   shift_i  7 (LOBE_FINE)             X = min(x, xmax), k1_i and k2_i are 4 k1 and 4 k2, below 2 and 1
//   power_i  0 .. POWER                squarings; more count as POWER
//   lobe_o    d.ffff           U1.16   in [0, 1]
//
//   s = k1 - k2 X      U1.17, limited
//   y = s X            U1.22, limited to 1: 1 - base; then power times y <- 1 - (1 - y)^2:
//   z = y or 1 - y     whichever is below 1/2, 17 fraction bits and the middle of what is cut; 1 - y as ones' complement
//   y = 2 y - z^2, from 1/2 on 1 - z^2; a stage that is not needed takes y - 0, in the same clocks
//
// Near the peak of the lobe y is small, and so is its error, which the power multiplies by 2^power. Roundings to
// nearest, ties up; within 1.6 ulp of the formula with k1 and k2 before they became registers, 1.25 for refined fits.
// n = 1 .. 1024, with POWER, the stages that are built, less than 4 up to 96 2^POWER.
//
// k1_i, k2_i, xmax_i, shift_i, power_i must stay as they are while values are in flight.
//
// FOLD = 1: a value a clock; four 18 x 18 multipliers, and a shade_square_fabric for every squaring behind the second.
//           Latency LATENCY_LOBE = 31 clocks, 6 fewer for each POWER less than 4; ready_o is 1.
// FOLD = 6: one multiplier, a loop of five clocks a product; values start six clocks apart and never meet in it. ready_o
//           is 1 in every sixth clock. Latency LATENCY_LOBE_FOLDED = 33 clocks, 5 fewer for each POWER less than 4.
// The bits are the same. Example: n = 32, power 4, k1 = 2, k2 = 1 (shift 1: 1, 1/4), x = 1/8 -> (7/8)^32 = 0.01395.
// Source: P1, section III (D4, D8, D16), P3.
module shade_lobe #(
  parameter int POWER = 4,
  parameter int FOLD  = 1
) (
  input  logic                                      clk_i,
  input  logic                                      rst_i,
  input  logic                                      valid_i,
  output logic                                      ready_o,
  input  logic        [   shade_pkg::VERSINE_W-1:0] x_i,
  input  logic        [   shade_pkg::LOBE_K1_W-1:0] k1_i,
  input  logic signed [   shade_pkg::LOBE_K2_W-1:0] k2_i,
  input  logic        [shade_pkg::LOBE_SHIFT_W-1:0] shift_i,
  input  logic        [      shade_pkg::LOBE_X_F:0] xmax_i,
  input  logic        [shade_pkg::LOBE_POWER_W-1:0] power_i,
  output logic                                      valid_o,
  output logic        [   shade_pkg::INTENSITY_F:0] lobe_o
);
  if (POWER < 2 || POWER > 4 || (FOLD != 1 && FOLD != 6)) begin : g_check
    $error("shade_lobe: POWER must be in 2 .. 4 and FOLD 1 or 6");
  end

  localparam int MUL = shade_pkg::LATENCY_MUL;
  localparam int X_W = shade_pkg::LOBE_X_F + 1;
  localparam int W = 18;  // operands of a multiplier
  localparam int P_W = 2 * W;
  localparam int Y_F = shade_pkg::LOBE_F;
  localparam int Y_W = Y_F + 2;  // s X < 4
  localparam int A_W = Y_F + 1;

  // ---- X ---------------------------------------------------------------------------------------------------------
  localparam int WIDE_W = shade_pkg::VERSINE_W + shade_pkg::LOBE_FINE - 1;
  localparam int X_DROP = shade_pkg::VERSINE_F - shade_pkg::LOBE_X_F;
  localparam int ROUND_W = WIDE_W - X_DROP + 1;
  logic fine, dark_q1, dark_q2, dark_q3;  // dark: c < 0
  logic [WIDE_W-1:0] wide_q1;
  logic [ROUND_W-1:0] round_q2;
  logic [X_W-1:0] x_q3;
  assign fine = shift_i == shade_pkg::LOBE_SHIFT_W'(shade_pkg::LOBE_FINE);
  always_ff @(posedge clk_i) begin
    wide_q1  <= WIDE_W'(x_i) << (fine ? '0 : shift_i);
    round_q2 <= ROUND_W'(wide_q1 >> X_DROP) + ROUND_W'(wide_q1[X_DROP-1]);
    dark_q1  <= x_i[shade_pkg::VERSINE_W-1] || (x_i[shade_pkg::VERSINE_F] && |x_i[shade_pkg::VERSINE_F-1:0]);
    dark_q2  <= dark_q1;
  end

  // ---- what stands behind the products -----------------------------------------------------------------------------
  // k1 - p for p = k2 X, to nearest: half an ulp is in k1
  localparam int S_F = shade_pkg::LOBE_S_F;
  localparam int S_W = S_F + 3;  // in (-2, 4)
  localparam int SUM_F = shade_pkg::LOBE_K2_F + shade_pkg::LOBE_X_F;
  localparam int SUM_W = SUM_F + 3;
  localparam int K1_F = shade_pkg::LOBE_K1_F;
  localparam int K1_W = shade_pkg::LOBE_K1_W + 1;
  logic [K1_W-1:0] k1_q;
  always_ff @(posedge clk_i) k1_q <= K1_W'(k1_i) + K1_W'(1 << (K1_F - S_F - 1));

  function automatic logic [S_W-1:0] slope(input logic signed [P_W-1:0] p);
    logic signed [SUM_W-1:0] sum;
    sum   = (SUM_W'($signed({1'b0, k1_q})) <<< (SUM_F - K1_F)) - SUM_W'(p);
    slope = S_W'(sum >>> (SUM_F - S_F));
  endfunction

  // s - 1, which a signed multiplier takes, of s limited to [0, 2)
  function automatic logic [W-1:0] offset(input logic [S_W-1:0] s);
    logic negative, above;
    negative = s[S_W-1];
    above    = s[S_W-2];
    offset   = {negative || !(above || s[S_F]), s[S_F-1:0] & {S_F{!negative}} | {S_F{above && !negative}}};
  endfunction

  // y = s X = p + X for p = (s - 1) X, to nearest; a dark one is 1
  localparam int BASE_F = S_F + shade_pkg::LOBE_X_F;
  function automatic logic [Y_W-1:0] base(input logic signed [P_W-1:0] p, input logic [X_W-1:0] x, input logic dark);
    logic signed [P_W:0] sum;
    logic [Y_W-1:0] y;
    sum  = (P_W + 1)'(p) + $signed((P_W + 1)'({x, {S_F{1'b0}}}) | (P_W + 1)'(1 << (BASE_F - Y_F - 1)));
    y    = Y_W'(sum >>> (BASE_F - Y_F));
    base = dark ? Y_W'(1) << Y_F : fine ? y >> shade_pkg::LOBE_FINE_F : y;
  endfunction

  // z, and what z^2 is taken from: 2 y or 1; without squaring z is its last bit, too small to count, and y stays
  localparam int Z_F = shade_pkg::LOBE_Z_F;
  localparam int Z_W = Z_F - 1;
  function automatic logic [Z_W-1:0] low(input logic [Y_W-1:0] y, input logic squared);
    logic one, high;
    one  = |y[Y_W-1:Y_F];
    high = one || y[Y_F-1];
    low  = {(y[Y_F-2-:Z_W-1] ^ {(Z_W - 1) {high}}) & {(Z_W - 1) {squared && !one}}, 1'b1};
  endfunction

  function automatic logic [A_W-1:0] minuend(input logic [Y_W-1:0] y, input logic squared);
    logic one;
    one     = |y[Y_W-1:Y_F] || (squared && y[Y_F-1]);
    minuend = {one, (squared ? {y[Y_F-2:0], 1'b0} : y[Y_F-1:0]) & {Y_F{!one}}};
  endfunction

  // a - z^2, to nearest; z^2 is odd, so that there are no ties and its first dropped bit does it
  localparam int DROP = 2 * Z_F - Y_F;
  function automatic logic [A_W-1:0] less(input logic [A_W-1:0] a, input logic [2*Z_W-1:0] q);
    logic [A_W:0] difference;
    difference = {a, 1'b0} - (A_W + 1)'(q >> (DROP - 1));
    less       = A_W'(difference >> 1);
  endfunction

  // 1 - y, to nearest
  localparam int OUT_W = shade_pkg::INTENSITY_F + 1;
  localparam int OUT_DROP = Y_F - shade_pkg::INTENSITY_F;
  function automatic logic [OUT_W-1:0] result(input logic [A_W-1:0] y);
    logic [A_W-1:0] difference;
    difference = (A_W'(1) << Y_F) + (A_W'(1) << (OUT_DROP - 1)) - y;
    result     = OUT_W'(difference >> OUT_DROP);
  endfunction

  if (FOLD == 1) begin : g_parallel
    logic [X_W-1:0] x_q7, x_q9;
    logic signed [P_W-1:0] p_q5, p_q9;
    logic dark_q9;
    logic [S_W-1:0] s_q6;
    logic [W-1:0] t_q7;
    logic [Y_W-1:0] y_q10;
    assign ready_o = 1'b1;
    always_ff @(posedge clk_i) begin
      x_q3    <= round_q2 > ROUND_W'(xmax_i) ? xmax_i : X_W'(round_q2);
      dark_q3 <= dark_q2;
      s_q6    <= slope(p_q5);
      t_q7    <= offset(s_q6);
      y_q10   <= base(p_q9, x_q9, dark_q9);
    end
    shade_mul #(.A_W(W), .B_W(W)) u_slope (.clk_i, .a_i(k2_i), .b_i({1'b0, x_q3}), .p_o(p_q5));
    shade_mul #(.A_W(W), .B_W(W)) u_base (.clk_i, .a_i(t_q7), .b_i({1'b0, x_q7}), .p_o(p_q9));
    shade_delay #(.WIDTH(X_W), .DEPTH(MUL + 2)) u_x7 (.clk_i, .d_i(x_q3), .q_o(x_q7));
    shade_delay #(.WIDTH(X_W), .DEPTH(MUL)) u_x9 (.clk_i, .d_i(x_q7), .q_o(x_q9));
    shade_delay #(.WIDTH(1), .DEPTH(2 * MUL + 2)) u_dark (.clk_i, .d_i(dark_q3), .q_o(dark_q9));

    for (genvar i = 0; i < POWER; i++) begin : g_power
      localparam bit FABRIC = i > 1;  // at most four DSP blocks
      localparam int SQUARE = FABRIC ? shade_pkg::LATENCY_SQUARE_FABRIC : MUL;
      logic squared;
      logic [Y_W-1:0] y;
      logic [Z_W-1:0] z_q;
      logic [A_W-1:0] a_q, a_late, y_q;
      logic [2*Z_W-1:0] square;
      assign squared = power_i > shade_pkg::LOBE_POWER_W'(i);
      if (i == 0) begin : g_first
        assign y = y_q10;
      end else begin : g_next
        assign y = {1'b0, g_power[i-1].y_q};
      end
      always_ff @(posedge clk_i) begin
        z_q <= low(y, squared);
        a_q <= minuend(y, squared);
        y_q <= less(a_late, square);
      end
      shade_delay #(.WIDTH(A_W), .DEPTH(SQUARE)) u_a (.clk_i, .d_i(a_q), .q_o(a_late));
      if (FABRIC) begin : g_fabric
        shade_square_fabric #(.WIDTH(Z_W)) u_square (.clk_i, .x_i(z_q), .y_o(square));
      end else begin : g_dsp
        logic [2*Z_W:0] product;
        shade_square #(.WIDTH(Z_W + 1)) u_square (.clk_i, .x_i({1'b0, z_q}), .y_o(product));
        assign square = product[2*Z_W-1:0];
        logic unused_top;
        assign unused_top = &{1'b0, product[2*Z_W]};
      end
    end
    always_ff @(posedge clk_i) lobe_o <= result(g_power[POWER-1].y_q);

    localparam int LATENCY = shade_pkg::LATENCY_LOBE - (4 - POWER) * (shade_pkg::LATENCY_SQUARE_FABRIC + 2);
    shade_valid #(.DEPTH(LATENCY)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);
  end else begin : g_folded
    // turn r of a value begins 5 r clocks after its first: 6 k + 5 r is different for all values k and turns r < 6
    logic [2:0] phase_q;
    assign ready_o = phase_q == 3'd0;
    always_ff @(posedge clk_i) begin
      phase_q <= phase_q == 3'd5 ? 3'd0 : phase_q + 3'd1;
      if (rst_i) phase_q <= 3'd0;
    end

    // X and what it knows of c wait for two turns
    always_ff @(posedge clk_i) begin
      if (phase_q == 3'd2) begin
        x_q3    <= round_q2 > ROUND_W'(xmax_i) ? xmax_i : X_W'(round_q2);
        dark_q3 <= dark_q2;
      end
    end

    logic [W-1:0] a_q, b_q, next_q;  // operands; t or z of the next turn
    logic [A_W:0] with_q, with_late, minuend_q;  // what is added to the product: dark and X, or the minuend
    logic signed [P_W-1:0] p;
    logic [Y_W-1:0] sum_q;
    // stage 0 is chosen in phase 0, stage i, 5 i clocks later, in phase 6 - i
    logic squared;
    assign squared = power_i > (phase_q == 3'd0 ? 3'd0 : 3'd6 - phase_q);
    always_ff @(posedge clk_i) begin
      a_q    <= phase_q == 3'd3 ? k2_i : next_q;
      b_q    <= phase_q == 3'd3 || phase_q == 3'd2 ? {1'b0, x_q3} : next_q;
      with_q <= phase_q == 3'd2 ? {dark_q3, A_W'(x_q3)} : minuend_q;

      if (phase_q == 3'd0) sum_q <= Y_W'(slope(p));
      else if (phase_q == 3'd5) sum_q <= base(p, with_late[X_W-1:0], with_late[A_W]);
      else sum_q <= {1'b0, less(with_late[A_W-1:0], p[2*Z_W-1:0])};

      next_q    <= phase_q == 3'd1 ? offset(sum_q[S_W-1:0]) : {1'b0, low(sum_q, squared)};
      minuend_q <= {1'b0, minuend(sum_q, squared)};
      lobe_o    <= result(sum_q[A_W-1:0]);
    end
    shade_mul #(.A_W(W), .B_W(W)) u_mul (.clk_i, .a_i(a_q), .b_i(b_q), .p_o(p));
    shade_delay #(.WIDTH(A_W + 1), .DEPTH(MUL)) u_with (.clk_i, .d_i(with_q), .q_o(with_late));

    localparam int LATENCY = shade_pkg::LATENCY_LOBE_FOLDED - (4 - POWER) * (MUL + 3);
    shade_valid #(.DEPTH(LATENCY)) u_valid (.clk_i, .rst_i, .valid_i(valid_i && ready_o), .valid_o);
  end
endmodule
