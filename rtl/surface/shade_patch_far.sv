// SPDX-License-Identifier: Apache-2.0
// shade_patch_far: how far a triangle's normal goes, and how far away the highlight is: what shade_patch_plan decides by.
//
//   beat_i      the first four beats of a packet, see triangle_t, taken one after the other with beat_ready_o
//   h_i         S1.16, H of each light
//   valid_o     the following are there, until take_i
//   a_o, b_o    U0.14, saturated: length of the increment per column, per line, times 2: from the middle of 4 pixels
//   away_o      U7.16, length of (N + (columns / 2 - left) Gx + lines / 2 Gy) - H, the least of all lights
//   half_o      U7.16, half of the way across the box: columns / 2 a + lines / 2 b
//
//   length = (largest + sum) / 2 of the absolute components: never short, at most 22 % long
//
// Gx and Gy are mantissas times 2^-exp; a number of half pixels times 2^-exp, S2.15, is what they are multiplied by. One
// multiplier; x, y and z one after the other. A triangle in 8 + 3 LIGHTS clocks. Source: P4's constant increment.
// Example: N = H, Gx = Gy = 0 -> 0, 0, 0, 0.
module shade_patch_far #(
  parameter int LIGHTS = 1
) (
  input  logic                                          clk_i,
  input  logic                                          rst_i,
  input  logic        [LIGHTS*3*shade_pkg::INTENSITY_W-1:0] h_i,
  input  logic                                          beat_valid_i,
  output logic                                          beat_ready_o,
  input  logic        [  shade_pkg::SURFACE_DATA_W-1:0] beat_i,
  output logic                                          valid_o,
  input  logic                                          take_i,
  output logic        [    shade_pkg::PATCH_PLAN_F-1:0] a_o,
  output logic        [    shade_pkg::PATCH_PLAN_F-1:0] b_o,
  output logic        [   shade_pkg::PATCH_AWAY_W-1:0] away_o,
  output logic        [   shade_pkg::PATCH_AWAY_W-1:0] half_o,
  output logic        [         shade_pkg::COUNT_W-1:0] columns_o,
  output logic        [         shade_pkg::COUNT_W-1:0] lines_o,
  output logic        [  shade_pkg::TRIANGLE_EXP_W-1:0] column_exp_o,
  output logic        [  shade_pkg::TRIANGLE_EXP_W-1:0] line_exp_o
);
  if (LIGHTS < 1 || LIGHTS > shade_pkg::PATCH_LIGHTS_MAX) begin : g_check
    $error("shade_patch_far: LIGHTS must be in 1 .. PATCH_LIGHTS_MAX");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int PLAN_F = shade_pkg::PATCH_PLAN_F;
  localparam int CUT = shade_pkg::INTENSITY_F - PLAN_F;
  localparam int PART_F = shade_pkg::PATCH_PART_F;
  localparam int AWAY_W = shade_pkg::PATCH_AWAY_W;
  localparam int MID_W = W + 4;

  // ---- the beats: box 0, normal 1 .. 3, column 4 .. 6, line 7 .. 9; behind them, beside the next triangle's box and normal, the tail:
  // products 0, 1, then lengths to each H, 2 .. 4; the normal that is lit leaves its registers as the next one enters
  localparam logic [2:0] NONE = 3'd7;
  logic [3:0] step_q;
  logic [2:0] tail_q;
  logic [1:0] light_q;
  logic go, last_light, of_column, of_line, of_light, second, third;
  assign last_light   = light_q == 2'(LIGHTS - 1);
  assign of_column    = step_q >= 4'd4 && step_q <= 4'd6;
  assign of_line      = step_q >= 4'd7;
  assign of_light     = tail_q >= 3'd2 && tail_q != NONE;
  assign second       = step_q == 4'd2 || step_q == 4'd5 || step_q == 4'd8;
  assign third        = step_q == 4'd3 || step_q == 4'd6 || step_q == 4'd9;
  assign beat_ready_o = go && (step_q == 4'd0 || third);
  always_comb begin
    go = beat_valid_i;
    if (step_q == 4'd1 && tail_q != NONE && !(tail_q == 3'd2 && last_light)) go = 1'b0;
    if (step_q == 4'd7 && valid_o) go = 1'b0;
  end
  shade_pkg::growth_t beat;
  logic [shade_pkg::PLACE_W-1:0] left;
  assign beat = beat_i;
  assign left = beat_i[32+:shade_pkg::PLACE_W];
  logic signed [COUNT_W:0] across_q;  // twice as far as the middle is from the reference pixel
  logic [COUNT_W-1:0] columns_q, lines_q;
  logic [shade_pkg::TRIANGLE_EXP_W-1:0] column_exp_q;
  always_ff @(posedge clk_i) begin
    if (go) step_q <= step_q == 4'd9 ? 4'd0 : step_q + 4'd1;
    if (go && step_q == 4'd9) tail_q <= '0;
    else if (tail_q == 3'd4) tail_q <= last_light ? NONE : 3'd2;
    else if (tail_q != NONE) tail_q <= tail_q + 3'd1;
    if (!of_light) light_q <= '0;
    else if (tail_q == 3'd4) light_q <= light_q + 2'd1;
    if (step_q == 4'd0) begin
      across_q <= (COUNT_W + 1)'(beat_i[0+:COUNT_W]) - (COUNT_W + 1)'({left, 1'b0});
      {columns_q, lines_q} <= {beat_i[0+:COUNT_W], beat_i[16+:COUNT_W]};
    end
    if (of_column) column_exp_q <= beat.exp;
    // those before have been taken
    if (go && of_line) {columns_o, lines_o, column_exp_o, line_exp_o} <= {columns_q, lines_q, column_exp_q, beat.exp};
    if (rst_i) begin
      step_q <= '0;
      tail_q <= NONE;
    end
  end

  // ---- products: the increments by the way to the middle, lengths a, b by the half of a side and by 2 pixels -------------------
  logic signed [W-1:0] part_of, by, factor;
  logic signed [COUNT_W:0] halves;
  logic [3:0] exp;
  logic signed [COUNT_W+PART_F-1:0] shifted;
  logic signed [2*W-1:0] product;
  logic [2:0] kind, kind_q1, kind_q2;  // 1: of a vector; 2, 3: a; 4, 5: b
  logic [W:0] norm_q;
  always_comb begin
    halves = of_column ? across_q : (COUNT_W + 1)'(lines_q);
    exp    = beat.exp;
    kind   = go && (of_column || of_line) ? 3'd1 : 3'd0;
    case (tail_q)
      3'd0: {halves, exp, kind} = {(COUNT_W + 1)'(columns_o), column_exp_o, 3'd2};
      3'd1: {halves, exp, kind} = {(COUNT_W + 1)'(4), column_exp_o, 3'd3};
      3'd2: {halves, exp, kind} = {(COUNT_W + 1)'(lines_o), line_exp_o, light_q == '0 ? 3'd4 : 3'd0};
      3'd3: {halves, exp, kind} = {(COUNT_W + 1)'(4), line_exp_o, light_q == '0 ? 3'd5 : 3'd0};
      default: ;
    endcase
    part_of = third ? beat.mantissa.z : second ? beat.mantissa.y : beat.mantissa.x;
  end
  assign shifted = $signed({halves, (PART_F - 1)'(0)}) >>> exp;
  assign by      = tail_q == NONE ? part_of : $signed({1'b0, norm_q[W:CUT]});
  assign factor  = shifted[W-1:0];
  shade_mul #(.A_W(W), .B_W(W)) u_mul (.clk_i, .a_i(by), .b_i(factor), .p_o(product));
  localparam int A_W = 2 * W - PART_F;
  logic [A_W-1:0] size;
  assign size = product[2*W-1:PART_F];
  always_ff @(posedge clk_i) begin
    kind_q1 <= rst_i ? '0 : kind;
    kind_q2 <= rst_i ? '0 : kind_q1;
    if (kind_q2 == 3'd2) half_o <= AWAY_W'(product >>> (PART_F - CUT));
    if (kind_q2 == 3'd4) half_o <= half_o + AWAY_W'(product >>> (PART_F - CUT));
    if (kind_q2 == 3'd3) a_o <= |size[A_W-1:PLAN_F] ? '1 : size[PLAN_F-1:0];
    if (kind_q2 == 3'd5) b_o <= |size[A_W-1:PLAN_F] ? '1 : size[PLAN_F-1:0];
  end

  // ---- the normal in the middle, x, y and z in turn -----------------------------------------------------------------------------
  logic signed [MID_W-1:0] x_q, y_q, z_q, turned, value;
  logic normal;
  assign normal = step_q != '0 && step_q < 4'd4;
  assign turned = normal && go ? MID_W'(part_of) : of_light ? x_q : x_q + MID_W'(product >>> PART_F);
  always_ff @(posedge clk_i) begin
    if ((normal && go) || of_light || kind_q2 == 3'd1) {x_q, y_q, z_q} <= {y_q, z_q, turned};
  end
  logic signed [W-1:0] h;
  always_comb begin
    h = '0;
    for (int i = 0; i < LIGHTS; i++) begin
      for (int c = 0; c < 3; c++) h = h | (h_i[(3*i+c)*W+:W] & {W{light_q == 2'(i) && tail_q == 3'(c + 2)}});
    end
  end
  assign value = of_light ? x_q - MID_W'(h) : MID_W'(part_of);

  // ---- lengths --------------------------------------------------------------------------------------------------------------
  logic [MID_W-1:0] abs_q, most_q;
  logic [MID_W+1:0] sum_q;
  logic [AWAY_W-1:0] norm;
  logic counts, first_q1, counts_q1, last_q1, last_q2, light_q1, light_q2, none_q1, none_q2, end_q1, end_q2;
  assign counts = (go && (of_column || of_line)) || of_light;
  assign norm   = AWAY_W'(((AWAY_W + 1)'(sum_q) + (AWAY_W + 1)'(most_q)) >> 1);
  always_ff @(posedge clk_i) begin
    abs_q     <= value[MID_W-1] ? -value : value;
    first_q1  <= of_light ? tail_q == 3'd2 : !second && !third;
    counts_q1 <= counts;
    last_q1   <= of_light ? tail_q == 3'd4 : counts && third;
    light_q1  <= of_light;
    none_q1   <= light_q == '0;
    end_q1    <= tail_q == 3'd4 && last_light;
    if (counts_q1) begin
      sum_q  <= first_q1 ? (MID_W + 2)'(abs_q) : sum_q + (MID_W + 2)'(abs_q);
      most_q <= first_q1 || abs_q > most_q ? abs_q : most_q;
    end
    {last_q2, light_q2, none_q2, end_q2} <= {last_q1, light_q1, none_q1, end_q1};
    if (last_q2 && !light_q2) norm_q <= norm[W:0];
    if (last_q2 && light_q2 && (none_q2 || norm < away_o)) away_o <= norm;
    valid_o <= (last_q2 && end_q2) || (valid_o && !take_i);
    if (rst_i) begin
      counts_q1 <= 1'b0;
      last_q1   <= 1'b0;
      last_q2   <= 1'b0;
      valid_o   <= 1'b0;
    end
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, beat, shifted, norm_q[CUT-1:0]};
endmodule
