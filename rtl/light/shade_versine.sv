// SPDX-License-Identifier: Apache-2.0
// shade_versine: x = 1 - cos of the angle between two unit vectors: what every lobe is a function of.
//
//   FORM_REFINED  x = |a - b|^2 / 2     the chord: an error of the vectors' lengths enters squared or times x
//   FORM_PAPER    x = 1 - a . b         it enters in full, and a shininess n multiplies it
//
//   a_i, b_i       sd.ffff              S1.16
//   a - b         sdd.ffff              saturated to S1.16 (beyond 2 only for vectors longer than 1)
//   products       36 bits, exact       three 18 x 18 multipliers, squares of the differences or a_i b_i
//   shift_i        0 .. 6, LOBE_FINE     the lobe's, which takes 20 + shift fraction bits, 20 for LOBE_FINE
//   x_o            dd.ffff ff           U2.26, rounded once to so many, to nearest, ties up; clamped to [0, 2]
//   range_o                             x cut to U2.20 was outside [0, 2], the cosine outside [-1, 1]
//
// Opposite axes give 2 - 2^-15 + 2^-33 in the refined form, because 2 saturates.
// Latency LATENCY_VERSINE = 6 clocks, one value a clock. Source: P1's and P3's cos, by its complement.
// Example: a = (0, 0, 1), b = (0.6, 0, 0.8) -> x = (0.36 + 0.04) / 2 = 0.2.
module shade_versine #(
  parameter int FORM = shade_pkg::FORM_REFINED
) (
  input  logic                               clk_i,
  input  logic [shade_pkg::LOBE_SHIFT_W-1:0] shift_i,
  input  shade_pkg::vec_t                    a_i,
  input  shade_pkg::vec_t                    b_i,
  output logic [   shade_pkg::VERSINE_W-1:0] x_o,
  output logic                               range_o
);
  if (FORM != shade_pkg::FORM_PAPER && FORM != shade_pkg::FORM_REFINED) begin : g_check
    $error("shade_versine: FORM must be FORM_PAPER or FORM_REFINED");
  end

  localparam bit REFINED = FORM == shade_pkg::FORM_REFINED;
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int P_F = 2 * shade_pkg::INTENSITY_F;
  localparam int P_W = 2 * W;

  logic [2:0][W-1:0] a, b;
  logic [2:0][P_W-1:0] product_q3;
  assign {a, b} = {a_i, b_i};
  for (genvar c = 0; c < 3; c++) begin : g_component
    logic signed [W-1:0] left_q1, right_q1;
    if (REFINED) begin : g_chord
      logic signed [W:0] difference;
      logic signed [W-1:0] limited;
      assign difference = (W + 1)'($signed(a[c])) - (W + 1)'($signed(b[c]));
      shade_limit #(.WIDTH(W + 1), .OUT_W(W)) u_limit (.x_i(difference), .y_o(limited));
      always_ff @(posedge clk_i) left_q1 <= limited;
      assign right_q1 = left_q1;
    end else begin : g_dot
      always_ff @(posedge clk_i) begin
        left_q1  <= a[c];
        right_q1 <= b[c];
      end
    end
    shade_mul #(.A_W(W), .B_W(W)) u_mul (.clk_i, .a_i(left_q1), .b_i(right_q1), .p_o(product_q3[c]));
  end

  // the sum, or 1 less the sum; the refined one is taken as half as large by counting a fraction bit more
  localparam int SUM_W = P_W + 3;
  localparam int DROP = P_F + (REFINED ? 1 : 0) - shade_pkg::VERSINE_F;
  localparam int X_W = SUM_W - DROP;
  localparam int CUT = shade_pkg::VERSINE_CUT;
  localparam int X_F = shade_pkg::VERSINE_F - CUT;
  localparam logic signed [SUM_W-1:0] ONE = SUM_W'(1) <<< P_F;
  localparam logic [shade_pkg::LOBE_SHIFT_W-1:0] FINE = shade_pkg::LOBE_SHIFT_W'(shade_pkg::LOBE_FINE);
  logic signed [SUM_W-1:0] x, y, z, xy_q4, z_q4, sum, half;
  logic signed [X_W-1:0] x_q5;
  logic [X_F+1:0] clamped;
  logic [CUT-1:0] last, kept;
  logic outside;
  assign x   = SUM_W'($signed(product_q3[0]));
  assign y   = SUM_W'($signed(product_q3[1]));
  assign z   = SUM_W'($signed(product_q3[2]));
  assign sum = REFINED ? z_q4 + xy_q4 : z_q4 - xy_q4;
  assign half = (SUM_W'(1) <<< (DROP + CUT - 1)) >>> (shift_i == FINE ? '0 : shift_i);
  assign kept = shift_i == FINE ? '0 : ~({CUT{1'b1}} >> shift_i);
  assign last = CUT'(x_q5);
  shade_clamp #(.WIDTH(X_W - CUT), .F(X_F + 1)) u_clamp (
    .x_i((X_W - CUT)'(x_q5 >>> CUT)), .y_o(clamped), .clamped_o(outside)
  );
  always_ff @(posedge clk_i) begin
    xy_q4   <= x + y;
    z_q4    <= REFINED ? half + z : half + ONE - z;
    x_q5    <= X_W'(sum >>> DROP);
    x_o     <= {clamped, outside || clamped[X_F+1] ? '0 : last & kept};
    range_o <= outside;
  end
endmodule
