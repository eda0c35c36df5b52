// SPDX-License-Identifier: Apache-2.0
// shade_gain: s = lobe num fresnel (1 + w) gain 2^(e + gain_exp): the specular light of every model, saturated.
//
//   lobe_i, fresnel_i           d.ffff                 U1.16 in [0, 1]
//   factor_i                    d.ffff                 num, U1.16 in [0, 1]; w, e: shade_geometry
//   product                     d.ffff ffff            U1.32, what is below is cut: far below the lobe's own ulp
//   gain (1 + w)                d.ffff                 U1.16, rounded: 2^-16 (relative); exact for w = 0
//   s                          dd.ffff ffff ffff       U2.48, shifted right by 31 - e - gain_exp, within 0 .. 63
//   s_o                         d.ffff                 S1.16 in [0, 2 - 2^-16], to nearest, ties up, saturated
//
// Error at most 3.5 ulp; where e + gain_exp is above 16, 3.5 times 2^(e + gain_exp - 32), of what is cut of the product.
// Sums of exponents beyond 31 count as 31: what is not below 2^-47 saturates there. material_i, which holds gain and
// gain_exp, must not change while values are inside.
//
// FOLD = 1: six 18 x 18 multipliers, fewer with constant inputs (fresnel = 1, w = 0). A value a clock.
// FOLD = 2 .. 8: a value in FOLD clocks, taken when phase_i, which counts 0 .. FOLD - 1, is TAKE. lobe num gain has three
//           products, of one multiplier (FOLD = 2: two); fresnel = 1, w = 0, e = 0, whatever the inputs are.
// Latency LATENCY_GAIN = 12 clocks. Source: P1 and P3, the models' scales.
// Example: lobe = 1, num = 1/2, fresnel = 1, w = 0, e = 0, gain = 1, gain_exp = 1 -> s = 1.
module shade_gain #(
  parameter int FOLD = 1,
  parameter int TAKE = 0
) (
  input  logic                                     clk_i,
  input  logic        [    shade_pkg::PHASE_W-1:0] phase_i,
  input  shade_pkg::material_t                     material_i,
  input  logic        [  shade_pkg::INTENSITY_F:0] lobe_i,
  input  shade_pkg::factor_t                       factor_i,
  input  logic        [  shade_pkg::INTENSITY_F:0] fresnel_i,
  output logic signed [shade_pkg::INTENSITY_W-1:0] s_o,
  output logic                                     saturated_o
);
  if (FOLD < 1 || FOLD > shade_pkg::FOLD_MAX || TAKE < 0 || TAKE >= FOLD) begin : g_check
    $error("shade_gain: FOLD must be in 1 .. 8 and TAKE below FOLD");
  end

  localparam int F = shade_pkg::INTENSITY_F;
  localparam int A_W = F + 2;  // U1.16 as a signed operand
  localparam int B_W = 2 * F + 2;  // U1.32
  localparam int V_W = 3 * F + 2;  // U2.48
  localparam int E_W = shade_pkg::FACTOR_EXP_W + 1;
  localparam int SHIFT_W = 6;

  logic [V_W-1:0] v;  // 3 clocks ahead of s_o
  logic [SHIFT_W-1:0] shift;  // of v, with one bit left for the rounding
  logic [3:0] shift_q;

  // how far to the right
  function automatic logic [SHIFT_W-1:0] right(input logic signed [E_W-1:0] e);
    logic signed [E_W-1:0] distance;
    distance = E_W'(31) - e;
    right    = distance[E_W-1] ? '0 : SHIFT_W'(distance) | {SHIFT_W{distance[SHIFT_W]}};
  endfunction

  if (FOLD == 1) begin : g_parallel
    localparam int W_F = shade_pkg::FACTOR_F;
    localparam int MUL = shade_pkg::LATENCY_MUL_IN;
    logic [2*A_W-1:0] shape_q3;
    logic [A_W+B_W-1:0] product_q6, v_q9;
    logic signed [A_W+W_F-1:0] share_q3, sum;
    logic [F:0] fresnel_q3, factor_q4, factor_q6;
    logic signed [E_W-1:0] e_q1;
    logic [SHIFT_W-1:0] shift_q2;
    shade_mul #(.A_W(A_W), .B_W(A_W), .STAGES(MUL)) u_shape (
      .clk_i, .a_i({1'b0, lobe_i}), .b_i({1'b0, factor_i.num}), .p_o(shape_q3)
    );
    shade_delay #(.WIDTH(F + 1), .DEPTH(MUL)) u_fresnel (.clk_i, .d_i(fresnel_i), .q_o(fresnel_q3));
    shade_mul #(.A_W(B_W), .B_W(A_W), .STAGES(MUL)) u_product (
      .clk_i, .a_i(B_W'(shape_q3)), .b_i({1'b0, fresnel_q3}), .p_o(product_q6)
    );
    shade_mul #(.A_W(A_W), .B_W(W_F), .STAGES(MUL)) u_share (
      .clk_i, .a_i({1'b0, material_i.gain}), .b_i(factor_i.w), .p_o(share_q3)
    );
    assign sum = share_q3 + $signed({1'b0, material_i.gain, 1'b1, {(W_F - 1) {1'b0}}});
    shade_delay #(.WIDTH(F + 1), .DEPTH(2)) u_factor (.clk_i, .d_i(factor_q4), .q_o(factor_q6));
    shade_mul #(.A_W(B_W), .B_W(A_W), .STAGES(MUL)) u_v (
      .clk_i, .a_i(B_W'(product_q6 >> F)), .b_i({1'b0, factor_q6}), .p_o(v_q9)
    );
    always_ff @(posedge clk_i) begin
      factor_q4 <= (F + 1)'(sum >>> W_F);
      e_q1      <= E_W'(factor_i.e) + E_W'(material_i.gain_exp);
      shift_q2  <= right(e_q1);
    end
    shade_delay #(.WIDTH(SHIFT_W), .DEPTH(3 * MUL - 2)) u_shift (.clk_i, .d_i(shift_q2), .q_o(shift));
    assign v = V_W'(v_q9);
    logic unused;
    assign unused = &{1'b0, phase_i, factor_i, shape_q3, v_q9};
  end else begin : g_folded
    // operands are chosen in clock 0, HIGH, LOW of a value, stand at the multiplier a clock later, the product 3 later
    localparam int HIGH = FOLD == 2 ? 5 : FOLD == 3 ? 4 : 3;
    localparam int LOW = FOLD < 5 ? 5 : 4;
    logic [F:0] high, low;
    logic [A_W-1:0] a_q, b_q;
    logic [2*A_W-1:0] p, low_p;
    logic [V_W-1:0] v_q;

    // is it clock c of a value?
    function automatic logic at(input int c);
      at = phase_i == shade_pkg::PHASE_W'((TAKE + c) % FOLD);
    endfunction

    shade_mul #(.A_W(A_W), .B_W(A_W)) u_mul (.clk_i, .a_i(a_q), .b_i(b_q), .p_o(p));
    shade_delay #(.WIDTH(F + 1), .DEPTH(HIGH - 3)) u_high (.clk_i, .d_i((F + 1)'(p >> (F + 1))), .q_o(high));
    shade_delay #(.WIDTH(F + 1), .DEPTH(LOW - 3)) u_low (.clk_i, .d_i((F + 1)'(p)), .q_o(low));
    if (FOLD == 2) begin : g_two
      logic [A_W-1:0] low_q;
      shade_mul #(.A_W(A_W), .B_W(A_W)) u_low (.clk_i, .a_i(low_q), .b_i({1'b0, material_i.gain}), .p_o(low_p));
      always_ff @(posedge clk_i) low_q <= {1'b0, low};
    end else begin : g_one
      assign low_p = p;
    end
    always_ff @(posedge clk_i) begin
      a_q <= {1'b0, at(0) ? lobe_i : at(HIGH) ? high : low};
      b_q <= {1'b0, at(0) ? factor_i.num : material_i.gain};
      if (at(HIGH + 3)) v_q <= (V_W'(p) << (F + 1)) + (FOLD == 2 ? V_W'(low_p) : '0);
      else if (at(LOW + 3)) v_q <= v_q + V_W'(low_p);
      shift <= right(E_W'(material_i.gain_exp));
    end
    assign v = v_q;
    logic unused;
    assign unused = &{1'b0, factor_i, fresnel_i};
  end

  // ---- S1.16 -----------------------------------------------------------------------------------------------------
  // shifted in steps of 16, 4 and 1; of what the next steps cannot bring into s_o, one bit tells whether there is any
  localparam int FRACTION_W = F + 2;  // of s_o, and the bit of the rounding
  localparam int FOURS_W = FRACTION_W + 3;
  localparam int COARSE_W = FOURS_W + 12;
  logic [V_W-1:0] sixteens;
  logic [COARSE_W-1:0] coarse_q, fours;
  logic [FOURS_W-1:0] ones;
  logic [FRACTION_W-1:0] fine_q, rounded;
  logic over_q2, over_q1, above;
  assign sixteens = v >> {shift[SHIFT_W-1:4], 4'd0};
  assign fours    = coarse_q >> {shift_q[3:2], 2'd0};
  assign ones     = FOURS_W'(fours) >> shift_q[1:0];
  assign rounded  = {1'b0, fine_q[F+1:1]} + FRACTION_W'(fine_q[0]);
  assign above    = over_q1 || rounded[F+1];
  always_ff @(posedge clk_i) begin
    coarse_q    <= COARSE_W'(sixteens);
    over_q2     <= sixteens >> COARSE_W != '0;
    shift_q     <= shift[3:0];
    fine_q      <= FRACTION_W'(ones);
    over_q1     <= over_q2 || fours >> FOURS_W != '0 || ones >> FRACTION_W != '0;
    s_o         <= {1'b0, above ? {(F + 1) {1'b1}} : rounded[F:0]};
    saturated_o <= above;
  end
  logic unused_material;
  assign unused_material = &{1'b0, material_i};
endmodule
