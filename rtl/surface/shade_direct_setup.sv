// SPDX-License-Identifier: Apache-2.0
// shade_direct_setup: the coefficients of a triangle's scalars a = N.L, h = N.H, P = N.N.
//
//   vectors n, c, l (normal, increments per column and line, divided by 2^exp) -> 12 dot products, exact, then shifted:
//   n.L, c.L, l.L;  n.H, c.H, l.H;  n.n, 2 n.c + c.c, 2 n.l + l.l, c.c, l.l, 2 c.l
//
// Three multipliers make a dot product a clock: 3 clocks for n, 4 for c, 5 for l; 1 for an increment that is none (wide_i,
// tall_i = 0). ready_o does not depend on valid_i. Results stand in two banks, so that a triangle can be made while one
// waits: coefficients_o with valid_o, until ready_i takes them. cut_i: what came since the last normal counts for nothing.
// What is shifted out is cut; formats: coefficients_t. Latency 7 clocks from the last product of l; a triangle in 12 clocks.
// Example: n = L = H = (0, 0, 1), no increments -> a = 1, h = 1, p = 1.
module shade_direct_setup (
  input  logic                        clk_i,
  input  logic                        rst_i,
  input  shade_pkg::vec_t             l_i,
  input  shade_pkg::vec_t             h_i,
  input  logic                        valid_i,
  output logic                        ready_o,
  input  shade_pkg::growth_t          vector_i,
  input  logic                  [1:0] kind_i,
  input  logic                        wide_i,
  input  logic                        tall_i,
  input  logic                        cut_i,
  output logic                        valid_o,
  input  logic                        ready_i,
  output shade_pkg::coefficients_t    coefficients_o
);
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int EXP_W = shade_pkg::TRIANGLE_EXP_W;
  localparam int P_W = shade_pkg::DIRECT_P_W;
  localparam int H_W = shade_pkg::DIRECT_H_W;
  localparam int A_W = shade_pkg::DIRECT_A_W;
  localparam logic [1:0] NORMAL = 2'd0;
  localparam logic [1:0] LINE = 2'd2;

  // ---- vectors, and which product is made -------------------------------------------------------------------------
  shade_pkg::vec_t now_q, n_q, c_q;
  logic [EXP_W-1:0] exp_q, exp_c_q;
  logic [1:0] kind_q;
  logic [2:0] step_q, left_q;
  logic busy_q, skip_q, last_q, skip, last, load, room;
  logic [2:0] steps;  // of the vector that comes, less 1
  assign steps = skip ? 3'd0 : kind_i == NORMAL ? 3'd2 : kind_i == LINE && wide_i ? 3'd4 : 3'd3;
  assign skip  = (kind_i == 2'd1 && !wide_i) || (kind_i == LINE && !tall_i);
  assign last  = !busy_q || last_q;
  assign ready_o = last && (kind_i != NORMAL || room);
  assign load  = valid_i && ready_o;
  always_ff @(posedge clk_i) begin
    step_q <= step_q + 3'd1;
    left_q <= left_q - 3'd1;
    last_q <= left_q == 3'd1;
    if (load) begin
      now_q  <= vector_i.mantissa;
      exp_q  <= kind_i == NORMAL ? '0 : vector_i.exp;
      kind_q <= kind_i;
      step_q <= 3'd0;
      left_q <= steps;
      last_q <= skip;
      skip_q <= skip;
      if (kind_i == 2'd1) n_q <= now_q;
      if (kind_i == LINE) c_q <= now_q;
      if (kind_i == LINE) exp_c_q <= exp_q;
    end
    busy_q <= load || (busy_q && !last);
    if (rst_i) busy_q <= 1'b0;
  end

  // a triangle is at hand from its normal on until ready_i takes it; there is room for two
  logic [1:0] inside_q;
  assign room = !inside_q[1];
  always_ff @(posedge clk_i) begin
    inside_q <= inside_q + 2'(load && kind_i == NORMAL) - 2'(cut_i && kind_i != NORMAL) - 2'(valid_o && ready_i);
    if (rst_i) inside_q <= 2'd0;
  end

  // ---- products with L and of two vectors ----------------------------------------------------------------------------
  // steps: with L; with H; with n (of n: with itself); with itself; with c
  shade_pkg::vec_t other;
  logic [4:0] shift;
  always_comb begin
    case (step_q)
      3'd0: other = l_i;
      3'd1: other = h_i;
      3'd2: other = kind_q == NORMAL ? now_q : n_q;
      3'd3: other = now_q;
      default: other = c_q;
    endcase
    case (step_q)
      3'd0, 3'd1: shift = 5'(exp_q) + 5'd1;
      3'd2: shift = kind_q == NORMAL ? 5'd1 : 5'(exp_q);
      3'd3: shift = {exp_q, 1'b1};
      default: shift = 5'(exp_q) + 5'(exp_c_q);
    endcase
  end
  localparam int RESULT_W = shade_pkg::PATCH_SCALAR_W;
  logic signed [2*W-1:0] unused_x, unused_y, unused_z;
  logic signed [RESULT_W-1:0] result_q;
  shade_dot_scaled u_dot (
    .clk_i, .a_i(now_q), .b_i(other), .shift_i(shift), .product_x_o(unused_x), .product_y_o(unused_y),
    .product_z_o(unused_z), .d_o(result_q)
  );

  // where a product goes, beside it
  typedef struct packed {
    logic       valid;
    logic       skip;
    logic [1:0] kind;
    logic [2:0] step;
  } job_t;
  job_t job, job_q;
  assign job = {busy_q, skip_q, kind_q, step_q};
  localparam int LATENCY = shade_pkg::LATENCY_DOT_SCALED;
  shade_delay #(.WIDTH($bits(job)), .DEPTH(LATENCY)) u_job (.clk_i, .d_i(job), .q_o(job_q));
  logic complete;
  shade_valid #(.DEPTH(LATENCY)) u_complete (
    .clk_i, .rst_i, .valid_i(busy_q && kind_q == LINE && last), .valid_o(complete)
  );

  // ---- banks --------------------------------------------------------------------------------------------------------
  // P's growth to the next pixel is 2 n.c + c.c, two results that follow each other
  shade_pkg::coefficients_t made_q;
  logic signed [RESULT_W-1:0] before_q;
  logic [P_W-1:0] result, both;
  logic [A_W-1:0] a;
  logic [H_W-1:0] h;
  logic full_q, ready, clear_c, clear_l;
  assign result  = result_q[P_W-1:0];
  assign both    = result + before_q[P_W-1:0];
  assign a       = result_q[RESULT_W-1-:A_W];
  assign h       = result_q[RESULT_W-1-:H_W];
  assign ready   = !valid_o || ready_i;
  assign clear_c = job_q.valid && job_q.skip && job_q.kind == 2'd1;
  assign clear_l = job_q.valid && job_q.skip && job_q.kind == LINE;
  logic [3:0] step;
  assign step = job_q.valid && !job_q.skip ? {1'b1, job_q.step} : 4'd0;
  always_ff @(posedge clk_i) begin
    before_q <= result_q;
    case ({job_q.kind, step})
      {2'd0, 4'd8}: made_q.a <= a;
      {2'd0, 4'd9}: made_q.h <= h;
      {2'd0, 4'd10}: made_q.p <= result;
      {2'd1, 4'd8}: made_q.a_column <= a;
      {2'd1, 4'd9}: made_q.h_column <= h;
      {2'd1, 4'd11}: begin
        made_q.p_column  <= both;
        made_q.p_columns <= result;
      end
      {2'd2, 4'd8}: made_q.a_line <= a;
      {2'd2, 4'd9}: made_q.h_line <= h;
      {2'd2, 4'd11}: begin
        made_q.p_line  <= both;
        made_q.p_lines <= result;
      end
      {2'd2, 4'd12}: made_q.p_both <= result;
      default: ;
    endcase
    if (clear_c) begin
      made_q.a_column  <= '0;
      made_q.h_column  <= '0;
      made_q.p_column  <= '0;
      made_q.p_columns <= '0;
      made_q.p_both    <= '0;
    end
    if (clear_l) begin
      made_q.a_line  <= '0;
      made_q.h_line  <= '0;
      made_q.p_line  <= '0;
      made_q.p_lines <= '0;
      made_q.p_both  <= '0;
    end
    if (ready) coefficients_o <= made_q;
    if (ready) valid_o <= full_q;
    if (complete) full_q <= 1'b1;
    else if (ready) full_q <= 1'b0;
    if (rst_i) begin
      full_q  <= 1'b0;
      valid_o <= 1'b0;
    end
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, vector_i, before_q};
endmodule
