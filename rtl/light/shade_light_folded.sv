// SPDX-License-Identifier: Apache-2.0
// shade_light_folded: Lambert's and Blinn's light, directional, viewer at infinity, with three multipliers in all.
//
//   ports, formats, rounding, flags   as shade_light with REFLECT = 0 and DIVIDE = 0, to the bit
//   ready_o                           1 in every sixth clock: a node is taken then
//
//   first multiplier    nx lx, ny ly, nz lz, then the three squares of n - h (FORM_PAPER: nx hx, ny hy, nz hz)
//   shade_lobe FOLD = 6 the six products of the lobe
//   third               lobe times 1 or N.L, and the two halves of the product with the gain
//
// Each gets a product a clock, or three in six. Latency LATENCY_LIGHT_FOLDED = 56 clocks, one node in six clocks.
// Source: P1, section II. Example: N = L = (0, 0, 1) -> diffuse = 1, specular = gain.
module shade_light_folded #(
  parameter int FORM = shade_pkg::FORM_REFINED
) (
  input  logic                                       clk_i,
  input  logic                                       rst_i,
  input  logic        [      shade_pkg::MODEL_W-1:0] model_i,
  input  logic                                       cosine_i,
  input  logic        [    shade_pkg::LOBE_K1_W-1:0] k1_i,
  input  logic signed [    shade_pkg::LOBE_K2_W-1:0] k2_i,
  input  logic        [ shade_pkg::LOBE_SHIFT_W-1:0] shift_i,
  input  logic        [       shade_pkg::LOBE_X_F:0] xmax_i,
  input  logic        [ shade_pkg::LOBE_POWER_W-1:0] power_i,
  input  logic        [         shade_pkg::GAIN_F:0] gain_i,
  input  logic signed [   shade_pkg::GAIN_EXP_W-1:0] gain_exp_i,
  input  logic signed [  shade_pkg::INTENSITY_W-1:0] lx_i,
  input  logic signed [  shade_pkg::INTENSITY_W-1:0] ly_i,
  input  logic signed [  shade_pkg::INTENSITY_W-1:0] lz_i,
  input  logic signed [  shade_pkg::INTENSITY_W-1:0] hx_i,
  input  logic signed [  shade_pkg::INTENSITY_W-1:0] hy_i,
  input  logic signed [  shade_pkg::INTENSITY_W-1:0] hz_i,
  input  logic                                       valid_i,
  output logic                                       ready_o,
  input  logic signed [  shade_pkg::INTENSITY_W-1:0] nx_i,
  input  logic signed [  shade_pkg::INTENSITY_W-1:0] ny_i,
  input  logic signed [  shade_pkg::INTENSITY_W-1:0] nz_i,
  output logic                                       valid_o,
  output logic signed [  shade_pkg::INTENSITY_W-1:0] diffuse_o,
  output logic signed [  shade_pkg::INTENSITY_W-1:0] specular_o,
  output logic        [shade_pkg::LIGHT_FLAGS_W-1:0] flags_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int F = shade_pkg::INTENSITY_F;
  localparam int C_W = F + 1;
  localparam bit REFINED = FORM == shade_pkg::FORM_REFINED;
  localparam int MODEL_W = shade_pkg::MODEL_W;

  logic [2:0] phase_q;
  assign ready_o = phase_q == 3'd0;
  always_ff @(posedge clk_i) begin
    phase_q <= phase_q == 3'd5 ? 3'd0 : phase_q + 3'd1;
    if (rst_i) phase_q <= 3'd0;
  end

  logic blinn, refused, lost;
  assign blinn   = model_i == MODEL_W'(shade_pkg::MODEL_BLINN);
  assign refused = !blinn && model_i != MODEL_W'(shade_pkg::MODEL_LAMBERT);
  assign lost    = blinn && {hx_i, hy_i, hz_i} == '0;

  // ---- N.L, then the versine: the factors of clock r stand at the multiplier in clock r + 1, the product in r + 3 ------
  localparam int P_W = 2 * W;
  logic signed [W-1:0] ny_q, nz_q, nx_q, a_q, b_q, n_next, h_next, limited, difference_q;
  logic signed [W:0] difference;
  logic signed [P_W-1:0] p;
  always_comb begin
    case (phase_q)
      3'd2:    {n_next, h_next} = {nx_q, hx_i};
      3'd3:    {n_next, h_next} = {ny_q, hy_i};
      default: {n_next, h_next} = {nz_q, hz_i};
    endcase
  end
  assign difference = (W + 1)'(n_next) - (W + 1)'(h_next);
  shade_limit #(.WIDTH(W + 1), .OUT_W(W)) u_limit (.x_i(difference), .y_o(limited));

  logic signed [W-1:0] n_late_q, h_late_q;
  always_ff @(posedge clk_i) begin
    if (ready_o) {nx_q, ny_q, nz_q} <= {nx_i, ny_i, nz_i};
    difference_q <= limited;
    n_late_q     <= n_next;
    h_late_q     <= h_next;
    case (phase_q)
      3'd0:    {a_q, b_q} <= {nx_i, lx_i};
      3'd1:    {a_q, b_q} <= {ny_q, ly_i};
      3'd2:    {a_q, b_q} <= {nz_q, lz_i};
      default: {a_q, b_q} <= REFINED ? {difference_q, difference_q} : {n_late_q, h_late_q};
    endcase
  end
  shade_mul #(.A_W(W), .B_W(W)) u_angle (.clk_i, .a_i(a_q), .b_i(b_q), .p_o(p));

  localparam int SUM_W = P_W + 3;
  localparam int X_DROP = 2 * F + (REFINED ? 1 : 0) - shade_pkg::VERSINE_F;
  localparam int X_W = SUM_W - X_DROP;
  localparam logic signed [SUM_W-1:0] HALF_NL = SUM_W'(1) <<< (F - 1);
  localparam logic signed [SUM_W-1:0] HALF_X = SUM_W'(1) <<< (X_DROP - 1);
  localparam logic signed [SUM_W-1:0] FIRST_X = REFINED ? HALF_X : HALF_X + (SUM_W'(1) <<< (2 * F));
  localparam int DOT_W = shade_pkg::DOT_W;
  logic signed [SUM_W-1:0] sum_q, base, term;
  logic minus;
  logic signed [DOT_W-1:0] nl_q;
  logic signed [X_W-1:0] far_q;
  logic [shade_pkg::VERSINE_W-1:0] x, x_q;
  logic x_range, x_range_q;
  assign minus = !REFINED && (phase_q == 3'd0 || phase_q == 3'd1 || phase_q == 3'd2);
  assign term  = minus ? -(SUM_W'(p)) : SUM_W'(p);
  assign base  = phase_q == 3'd3 ? HALF_NL : phase_q == 3'd0 ? FIRST_X : sum_q;
  shade_clamp #(.WIDTH(X_W), .F(shade_pkg::VERSINE_F + 1)) u_clamp (.x_i(far_q), .y_o(x), .clamped_o(x_range));
  always_ff @(posedge clk_i) begin
    sum_q <= base + term;
    if (phase_q == 3'd0) nl_q <= DOT_W'(sum_q >>> F);
    if (phase_q == 3'd3) far_q <= X_W'(sum_q >>> X_DROP);
    if (phase_q == 3'd4) {x_range_q, x_q} <= {x_range, x};
  end

  // ---- N.L waits for the lobe, a place every six clocks ------------------------------------------------------------
  localparam logic signed [DOT_W-1:0] ONE = DOT_W'(1) <<< F;
  localparam int LINE_W = W + 2;
  localparam int PLACES = 7;
  logic signed [W-1:0] nl_limited, nl;
  logic [PLACES*LINE_W-1:0] line_q;  // the oldest at the top
  logic [C_W-1:0] cosine;
  shade_limit #(.WIDTH(DOT_W), .OUT_W(W)) u_nl (.x_i(nl_q), .y_o(nl_limited));
  assign nl = line_q[(PLACES-1)*LINE_W+:W];
  shade_clamp u_cosine (.x_i(nl), .y_o(cosine), .clamped_o());
  always_ff @(posedge clk_i) begin
    if (phase_q == 3'd1) begin
      line_q <= {
        line_q[(PLACES-1)*LINE_W-1:0], nl_q[DOT_W-1:W-1] != {(DOT_W - W + 1) {nl_q[DOT_W-1]}},
        nl_q > ONE || nl_q < -ONE, nl_limited
      };
    end
  end

  // ---- lobe: taken in clock 12, given in clock 12 + LATENCY_LOBE_FOLDED = 45 -------------------------------------
  logic [C_W-1:0] lobe;
  shade_lobe #(.FOLD(6)) u_lobe (
    .clk_i, .phase_i(phase_q), .x_i(x_q), .k1_i, .k2_i, .shift_i, .xmax_i, .power_i, .lobe_o(lobe)
  );
  logic range_late;
  localparam int RANGE_PLACES = 6;
  logic [RANGE_PLACES-1:0] range_q;  // of x, in step with the lobe
  always_ff @(posedge clk_i) if (phase_q == 3'd5) range_q <= {range_q[RANGE_PLACES-2:0], x_range_q};
  assign range_late = range_q[RANGE_PLACES-1];

  // ---- gain: lobe times share, then its halves times the gain ------------------------------------------------------
  localparam int V_W = 3 * F + 2;
  logic signed [W-1:0] c_q, d_q;
  logic signed [P_W-1:0] product;
  logic [W-2:0] low_q;
  logic [V_W-1:0] v_q, v_coarse_q, v_fine_q;
  logic [5:0] right_q;
  always_ff @(posedge clk_i) begin
    right_q <= 6'd31 - gain_exp_i;  // 0 .. 63: gain_exp is -32 .. 31
    case (phase_q)
      3'd3: begin
        c_q <= blinn && !lost ? {1'b0, lobe} : '0;
        d_q <= cosine_i ? {1'b0, cosine} : W'(1) << F;
      end
      3'd0: begin
        c_q   <= {1'b0, product[2*W-3-:W-1]};
        d_q   <= {1'b0, gain_i};
        low_q <= product[W-2:0];
      end
      default: c_q <= {1'b0, low_q};
    endcase
    if (phase_q == 3'd3) v_q <= {product[V_W-W:0], {(W - 1) {1'b0}}};
    else if (phase_q == 3'd4) v_q <= v_q + V_W'(product);
    v_coarse_q <= v_q >> {right_q[5:4], 4'd0};
    v_fine_q   <= v_coarse_q >> right_q[3:0];
  end
  shade_mul #(.A_W(W), .B_W(W)) u_gain (.clk_i, .a_i(c_q), .b_i(d_q), .p_o(product));

  // ---- the node's results, together --------------------------------------------------------------------------------
  logic [F+1:0] rounded;
  logic above;
  logic [LINE_W:0] beside_q, result_q;  // what goes beside the specular light: range of x, then as in line_q
  assign rounded = {1'b0, v_fine_q[F+1:1]} + (F + 2)'({1'b0, v_fine_q[0]});
  assign above   = |v_fine_q[V_W-1:F+2] || rounded[F+1];
  always_ff @(posedge clk_i) begin
    if (phase_q == 3'd3) begin
      beside_q <= {range_late && blinn, line_q[PLACES*LINE_W-1-:LINE_W]};
      result_q <= beside_q;
    end
    diffuse_o                           <= result_q[W-1:0];
    specular_o                          <= {1'b0, above ? {(F + 1) {1'b1}} : rounded[F:0]};
    flags_o                             <= '0;
    flags_o[shade_pkg::LIGHT_MODEL]     <= refused;
    flags_o[shade_pkg::LIGHT_RANGE]     <= result_q[W] || result_q[LINE_W];
    flags_o[shade_pkg::LIGHT_ZERO]      <= lost;
    flags_o[shade_pkg::LIGHT_SATURATED] <= result_q[W+1] || above;
  end

  shade_valid #(.DEPTH(shade_pkg::LATENCY_LIGHT_FOLDED)) u_valid (
    .clk_i, .rst_i, .valid_i(valid_i && ready_o), .valid_o
  );
endmodule
