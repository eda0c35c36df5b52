// SPDX-License-Identifier: Apache-2.0
// shade_lobe_folded: shade_lobe behind the scaled X, with multipliers that its products share.
//
//   x_i, dark_i   U1.20        X, and 1 where the lobe is 0; taken when phase_i is TAKE
//   lobe_i                     k1, k2, fine, power: see shade_lobe; must stay as it is while values are in flight
//   lobe_o        U1.16        1 - k1 X + k2 X^2, squared power times
//
// phase_i counts 0 .. FOLD - 1, FOLD = 2 .. 8. The 2 + POWER products share as many multipliers as that takes, six of them
// 3, 2, 2, 2, 1, 1, 1. Product r, 0: k2 (X - 1), 1: (s' - 1) X', then squares: operands are chosen in clock 1 + TURN r
// of a value, stand at the multiplier a clock later, the product is there 3 clocks later, what follows from it 5 clocks later.
// A TURN is five clocks, or six for FOLD = 5, so that the products of one multiplier never meet.
// Latency 1 + 5 (2 + POWER) clocks (FOLD = 5: 6 (2 + POWER)), a value in FOLD clocks. Source: P1, section III, P3.
// Example: FOLD = 6, POWER = 4, X = 0 -> 1, 31 clocks later.
module shade_lobe_folded #(
  parameter int POWER = 4,
  parameter int FOLD  = 6,
  parameter int TAKE  = 0
) (
  input  logic                            clk_i,
  input  logic [  shade_pkg::PHASE_W-1:0] phase_i,
  input  logic [shade_pkg::LOBE_SCALED_F:0] x_i,
  input  logic                            dark_i,
  input  shade_pkg::highlight_t           lobe_i,
  output logic [shade_pkg::INTENSITY_F:0] lobe_o
);
  if (POWER < 2 || POWER > 4 || FOLD < 2 || FOLD > shade_pkg::FOLD_MAX || TAKE < 0 || TAKE >= FOLD) begin : g_check
    $error("shade_lobe_folded: POWER must be in 2 .. 4, FOLD in 2 .. 8 and TAKE below FOLD");
  end

  localparam int MUL = shade_pkg::LATENCY_MUL;
  localparam int W = shade_lobe_pkg::W;
  localparam int P_W = 2 * W;
  localparam int LAST_W = shade_lobe_pkg::X_F - shade_lobe_pkg::FIRST_F;
  localparam int FIRST_W = shade_lobe_pkg::FIRST_W;
  localparam int ROW_W = shade_lobe_pkg::ROW_W;
  localparam int Y_W = shade_lobe_pkg::Y_W;
  localparam int Z_W = shade_lobe_pkg::Z_W;
  localparam int A_W = shade_lobe_pkg::A_W;
  localparam int D_W = shade_lobe_pkg::D_W;
  localparam int PRODUCTS = 2 + POWER;
  localparam int MULS = (PRODUCTS + FOLD - 1) / FOLD;
  localparam int TURNS = (PRODUCTS + MULS - 1) / MULS;  // of a multiplier
  localparam int TURN = FOLD == 5 ? 6 : 5;

  // is it clock c of a value, after product r?
  function automatic logic at(input int c, input int r);
    at = phase_i == shade_pkg::PHASE_W'((TAKE + 1 + c + TURN * r) % FOLD);
  endfunction

  logic fine, load, dark_q, dark;
  logic [$bits(x_i)-1:0] x_q;
  logic [LAST_W-1:0] x_last;
  logic [FIRST_W-1:0] x_first;
  logic signed [shade_lobe_pkg::K_W-1:0] k1_q, k_q;
  assign fine = lobe_i.shift == shade_pkg::LOBE_SHIFT_W'(shade_pkg::LOBE_FINE);
  assign load = phase_i == shade_pkg::PHASE_W'(TAKE);
  always_ff @(posedge clk_i) begin
    if (load) {dark_q, x_q} <= {dark_i, x_i};
    k1_q <= shade_lobe_pkg::raised(lobe_i.k1);
    k_q  <= k1_q - shade_lobe_pkg::doubled(lobe_i.k2);
  end
  shade_hold #(.WIDTH($bits(x_i) + 1), .DEPTH(TURN), .FOLD(FOLD)) u_x (
    .clk_i, .load_i(load), .d_i({dark_q, x_q}), .q_o({dark, x_first, x_last})
  );

  for (genvar m = 0; m < MULS; m++) begin : g_mul
    localparam int FIRST = m * TURNS;
    logic [W-1:0] a_q, b_q, next_q, next;  // operands; those of the next turn
    logic [A_W-1:0] minuend_q, minuend_next, with_q, with_late;
    logic signed [P_W-1:0] p;
    logic [Y_W-1:0] sum_q;
    logic squared;
    always_comb begin
      squared = 1'b0;
      for (int r = FIRST; r < FIRST + TURNS; r++) begin
        if (r > 0 && at(MUL + 2, r)) squared = lobe_i.power > shade_pkg::LOBE_POWER_W'(r - 1);
      end
    end
    shade_mul #(.A_W(W), .B_W(W)) u_mul (.clk_i, .a_i(a_q), .b_i(b_q), .p_o(p));
    shade_delay #(.WIDTH(A_W), .DEPTH(MUL)) u_with (.clk_i, .d_i(with_q), .q_o(with_late));
    shade_delay #(.WIDTH(W + A_W), .DEPTH(TURN - MUL - 3)) u_next (
      .clk_i, .d_i({next_q, minuend_q}), .q_o({next, minuend_next})
    );
    always_ff @(posedge clk_i) minuend_q <= shade_lobe_pkg::minuend(sum_q, squared);

    if (m == 0) begin : g_base
      logic [ROW_W+1:0] upper_q, lower_q;
      logic [D_W-1:0] beside_q, d_q;
      logic [LAST_W-1:0] last_q;
      logic odd_q, odd, dark_p, dark_late;
      shade_delay #(.WIDTH(1), .DEPTH(TURN - MUL - 2)) u_odd (.clk_i, .d_i(odd_q), .q_o(odd));
      shade_delay #(.WIDTH(1), .DEPTH(MUL)) u_dark (.clk_i, .d_i(dark_p), .q_o(dark_late));
      always_ff @(posedge clk_i) begin
        a_q              <= at(0, 0) ? lobe_i.k2 : next;
        b_q              <= at(0, 0) ? shade_lobe_pkg::below(x_q) : at(0, 1) ? {1'b0, x_first} : next;
        with_q           <= minuend_next;
        dark_p           <= dark;
        last_q           <= x_last;
        upper_q          <= shade_lobe_pkg::rows(a_q, last_q[3:2]);
        lower_q          <= shade_lobe_pkg::rows(a_q, last_q[1:0]);
        beside_q         <= shade_lobe_pkg::beside(FIRST_W'(b_q), odd);
        d_q              <= beside_q + D_W'({upper_q, 2'b00}) + D_W'(lower_q);

        if (at(MUL + 1, 0)) sum_q <= Y_W'(shade_lobe_pkg::slope(k_q, p));
        else if (at(MUL + 1, 1)) sum_q <= shade_lobe_pkg::base(p, d_q, dark_late, fine);
        else sum_q <= {1'b0, shade_lobe_pkg::less(with_late, (2 * Z_W)'(p))};
        if (at(MUL + 2, 0)) {next_q, odd_q} <= shade_lobe_pkg::offset(shade_lobe_pkg::S_W'(sum_q));
        else next_q <= {1'b0, shade_lobe_pkg::low(sum_q, squared)};
      end
    end else begin : g_power
      always_ff @(posedge clk_i) begin
        a_q    <= at(0, FIRST) ? g_mul[m-1].next : next;
        b_q    <= at(0, FIRST) ? g_mul[m-1].next : next;
        with_q <= at(0, FIRST) ? g_mul[m-1].minuend_next : minuend_next;
        sum_q  <= {1'b0, shade_lobe_pkg::less(with_late, (2 * Z_W)'(p))};
        next_q <= {1'b0, shade_lobe_pkg::low(sum_q, squared)};
      end
      logic unused_top;
      assign unused_top = &{1'b0, p};
    end
  end
  always_ff @(posedge clk_i) lobe_o <= shade_lobe_pkg::result(A_W'(g_mul[MULS-1].sum_q));
  logic unused;
  assign unused = &{1'b0, lobe_i};
endmodule
