// SPDX-License-Identifier: Apache-2.0
// shade_patch_setup: the scalars of a triangle, in the middle of one of its boxes, and what they grow by a quarter of a box.
//
//   beat_i      the first four beats of a packet, see triangle_t, taken with beat_ready_o; plan_* {kx, ky} of it, and room_i for it
//   l_i, h_i    S1.16, L and H of each light
//   start_o     for one clock: it needs room; done_o: its beats have been taken
//   valid_o     word at_o of memory which_o of shade_patch_slots, units of 2^-36; last_o with the last one
//
//   M = N + (2^(kx-1) - left mod 2^kx) Gx + 2^(ky-1) Gy      the middle of the reference pixel's box, S1.16, saturated: range_o
//
//   memory 0       M.M; {left / 2^kx, kx, ky}, with the column of that box; c.c; l.l        c = Gx 2^(kx-2), l = Gy 2^(ky-2)
//   1              2 M.c; 2 M.l; 2 c.l
//   2 + 2 i, + 1   of light i: M.L; -; c.L; l.L, and the same with H
//
// Exact products, shifted, what is shifted out is cut. Three multipliers make a dot product a clock: a triangle in 8 + 6 LIGHTS
// clocks. Latency 7 clocks from the last product. Source: P4's constant increment. Example: Gx = Gy = 0, N = L = H -> P = M.L = M.H = 1, others 0.
module shade_patch_setup #(
  parameter int LIGHTS = 1
) (
  input  logic                                         clk_i,
  input  logic                                         rst_i,
  input  logic [LIGHTS*3*shade_pkg::INTENSITY_W-1:0]   l_i,
  input  logic [LIGHTS*3*shade_pkg::INTENSITY_W-1:0]   h_i,
  input  logic                                         beat_valid_i,
  output logic                                         beat_ready_o,
  input  logic [        shade_pkg::SURFACE_DATA_W-1:0] beat_i,
  input  logic                                         plan_valid_i,
  output logic                                         plan_ready_o,
  input  logic [                                  5:0] plan_i,
  input  logic                                         room_i,
  output logic                                         start_o,
  output logic                                         done_o,
  output logic                                         valid_o,
  output logic                                         last_o,
  output logic [                                  3:0] which_o,
  output logic [                                  1:0] at_o,
  output logic [          shade_pkg::PATCH_SCALAR_W-1:0] value_o,
  output logic                                         range_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int PLACE_W = shade_pkg::PLACE_W;
  localparam int PART_F = shade_pkg::PATCH_PART_F;
  localparam logic [3:0] SELF = 4'(2 * LIGHTS + 1);  // step: 0 a part of the way to M, 1 .. 2 LIGHTS with L and H, self, others

  // ---- box and normal are taken while M's products are made; then c, l, M ------------------------------------------------------
  typedef enum logic [1:0] {NONE, COLUMN, LINE, MIDDLE} kind_t;
  kind_t kind_q;
  logic [3:0] step_q, last_step;
  logic box_q, normal_q, last, take_box, take_normal, vector;
  shade_pkg::growth_t beat;
  shade_pkg::vec_t n_q, c_q, l_q, now, middle, other;
  logic [PLACE_W-1:0] left_q, rest;
  logic [2:0] kx_q, ky_q;
  logic [3:0] column_exp_q, line_exp_q, exp;
  assign beat         = beat_i;
  assign vector       = kind_q == COLUMN || kind_q == LINE;
  assign last_step    = kind_q == COLUMN ? SELF : kind_q == LINE ? SELF + 4'd1 : SELF + 4'd2;
  assign last         = step_q == last_step;
  assign take_box     = !vector && !box_q && beat_valid_i && plan_valid_i && room_i;
  assign take_normal  = !vector && box_q && !normal_q && beat_valid_i;
  assign plan_ready_o = take_box;
  assign start_o      = take_box;
  assign done_o       = kind_q == LINE && beat_valid_i && last;
  assign beat_ready_o = take_box || take_normal || (vector && last);
  always_ff @(posedge clk_i) begin
    if (take_box) {left_q, kx_q, ky_q} <= {beat_i[32+:PLACE_W], plan_i};
    if (take_normal) n_q <= beat_i[0+:3*W];
    if (kind_q == COLUMN) {c_q, column_exp_q} <= {beat.mantissa, exp};
    if (kind_q == LINE) {l_q, line_exp_q} <= {beat.mantissa, exp};
    if (take_box) box_q <= 1'b1;
    if (take_normal) normal_q <= 1'b1;
    if (!vector || beat_valid_i) step_q <= last ? (kind_q == LINE ? 4'd1 : 4'd0) : step_q + 4'd1;
    case (kind_q)
      NONE: if (normal_q) kind_q <= COLUMN;
      COLUMN: if (beat_valid_i && last) kind_q <= LINE;
      LINE:
      if (beat_valid_i && last) begin
        kind_q            <= MIDDLE;
        {box_q, normal_q} <= 2'b00;
      end
      default: if (last) kind_q <= normal_q ? COLUMN : NONE;
    endcase
    if (kind_q == NONE) step_q <= '0;
    if (rst_i) begin
      kind_q            <= NONE;
      {box_q, normal_q} <= 2'b00;
    end
  end

  // ---- factors -------------------------------------------------------------------------------------------------------------------
  // in box units kx - 2 less is shifted; a part of the way to M: whole pixels times 2^-exp
  logic signed [PLACE_W-1:0] whole;
  logic signed [PLACE_W+PART_F-1:0] part;
  logic [4:0] shift;
  logic [2*LIGHTS*3*W-1:0] directions;
  for (genvar i = 0; i < LIGHTS; i++) begin : g_light
    assign directions[2*i*3*W+:6*W] = {h_i[i*3*W+:3*W], l_i[i*3*W+:3*W]};
  end
  assign exp   = kind_q == COLUMN ? beat.exp - 4'(kx_q) + 4'd2 : beat.exp - 4'(ky_q) + 4'd2;
  assign rest  = left_q & ~({PLACE_W{1'b1}} << kx_q);
  assign whole = kind_q == COLUMN ? (PLACE_W'(1) << (kx_q - 3'd1)) - rest : PLACE_W'(1) << (ky_q - 3'd1);
  assign part  = $signed({whole, PART_F'(0)}) >>> beat.exp;
  assign now   = vector ? beat.mantissa : middle;
  always_comb begin
    // one of all of them: gates and one sum are less than selectors in a row
    other = {3{part[W-1:0]}} & {3*W{step_q == 4'd0}};
    for (int i = 0; i < 2 * LIGHTS; i++) other = other | (directions[i*3*W+:3*W] & {3*W{step_q == 4'(i + 1)}});
    other = other | (now & {3*W{step_q == SELF}}) | (c_q & {3*W{step_q == SELF + 4'd1}}) |
            (l_q & {3*W{step_q == SELF + 4'd2}});
    case (step_q)
      SELF:        shift = vector ? {exp, 1'b1} : 5'd1;
      SELF + 4'd1: shift = (vector ? 5'(exp) : 5'd0) + 5'(column_exp_q);
      SELF + 4'd2: shift = 5'(line_exp_q);
      default:     shift = vector ? 5'(exp) + 5'd1 : 5'd1;
    endcase
  end
  localparam int RESULT_W = shade_pkg::PATCH_SCALAR_W;
  logic signed [2*W-1:0] px, py, pz;
  logic signed [RESULT_W-1:0] result_q;
  // the factors are chosen in a clock of their own
  shade_pkg::vec_t now_q, other_q;
  logic [4:0] shift_q;
  always_ff @(posedge clk_i) {now_q, other_q, shift_q} <= {now, other, shift};
  shade_dot_scaled u_dot (
    .clk_i, .a_i(now_q), .b_i(other_q), .shift_i(shift_q), .product_x_o(px), .product_y_o(py), .product_z_o(pz), .d_o(result_q)
  );

  // ---- where a product goes, beside it ------------------------------------------------------------------------------------------
  typedef struct packed {
    logic       last;
    logic       head;  // not a product: where the box is
    logic [3:0] which;
    logic [1:0] at;
  } job_t;
  job_t job, job_q;
  logic [1:0] parts, parts_p;  // 1: of c, 2: of l
  logic made, made_q;
  always_comb begin
    parts     = step_q == 4'd0 && beat_valid_i ? {kind_q == LINE, kind_q == COLUMN} : 2'd0;
    made      = vector ? beat_valid_i && (step_q != 4'd0 || kind_q == COLUMN) : kind_q == MIDDLE;
    job.last  = kind_q == MIDDLE && last;
    job.head  = kind_q == COLUMN && step_q == 4'd0;
    job.which = step_q == 4'd0 || step_q == SELF ? 4'd0 : step_q > SELF ? 4'd1 : step_q + 4'd1;
    case (kind_q)
      COLUMN: job.at = job.head ? 2'd1 : 2'd2;
      LINE: job.at = step_q > SELF ? 2'd2 : 2'd3;
      default: job.at = step_q == SELF + 4'd2 ? 2'd1 : 2'd0;
    endcase
  end
  localparam int MUL = shade_pkg::LATENCY_MUL;
  localparam int LATENCY = shade_pkg::LATENCY_DOT_SCALED + 1;
  shade_delay #(.WIDTH($bits(job)), .DEPTH(LATENCY)) u_job (.clk_i, .d_i(job), .q_o(job_q));
  shade_delay #(.WIDTH(2), .DEPTH(MUL + 1)) u_parts (.clk_i, .d_i(parts), .q_o(parts_p));
  shade_valid #(.DEPTH(LATENCY)) u_valid (.clk_i, .rst_i, .valid_i(made), .valid_o(made_q));

  // ---- M -------------------------------------------------------------------------------------------------------------------------
  localparam int M_W = 2 * W - PART_F + 2;
  logic [2:0] wide;
  for (genvar c = 0; c < 3; c++) begin : g_middle
    logic signed [W-1:0] n, fit;
    logic signed [2*W-1:0] p;
    logic signed [M_W-1:0] sum_q;
    assign n = n_q[c*W+:W];
    assign p = c == 0 ? px : c == 1 ? py : pz;
    always_ff @(posedge clk_i) begin
      if (parts_p[0]) sum_q <= M_W'(n) + M_W'(p >>> PART_F);
      if (parts_p[1]) sum_q <= sum_q + M_W'(p >>> PART_F) + M_W'(1);
    end
    shade_limit #(.WIDTH(M_W), .OUT_W(W)) u_fit (.x_i(sum_q), .y_o(fit));
    assign middle[c*W+:W] = fit;
    assign wide[c]        = sum_q != M_W'(fit);
  end
  always_ff @(posedge clk_i) range_o <= kind_q == MIDDLE && wide != '0 && !rst_i;

  always_ff @(posedge clk_i) begin
    valid_o <= made_q && !rst_i;
    last_o  <= job_q.last;
    {which_o, at_o} <= {job_q.which, job_q.at};
    value_o <= job_q.head ? RESULT_W'({shade_pkg::PATCH_AT_W'(left_q >> kx_q), kx_q, ky_q}) : result_q;
  end
  logic unused_bits;
  assign unused_bits = &{1'b0, beat, part};
endmodule
