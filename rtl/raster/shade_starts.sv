// SPDX-License-Identifier: Apache-2.0
// shade_starts: what a triangle's normal and depth are at the first pixel of each of its runs.
//
//   start_o = value + dcolumn (column - column of the first run) + dline (line - line of the first run), modulo 4
//
// exact, run by run: the value moves down by a line and aside by as many columns as the run begins further on. surface_i
// is taken with its first run, and one run after the other until that with last. valid_o: a run with its start and what its
// triangle has in common (surface_o, value outdated); credit_i gives back one of 2^CREDIT_LOG2 credits, a run costs one.
//
// Eight 18 x 18 blocks, two a component. Latency LATENCY_STARTS = 5 clocks, a run a clock; a line without a run costs one.
// Example: dcolumn = 5, dline = 7; the second run is a line below and 2 columns to the left: value - 10 + 7.
module shade_starts #(
  parameter int CREDIT_LOG2 = 4
) (
  input  logic                clk_i,
  input  logic                rst_i,
  input  logic                surface_valid_i,
  output logic                surface_ready_o,
  input  shade_pkg::surface_t surface_i,
  input  logic                run_valid_i,
  output logic                run_ready_o,
  input  shade_pkg::walked_t  run_i,
  output logic                valid_o,
  output logic                first_o,
  output shade_pkg::walked_t  run_o,
  output shade_pkg::plane_t   start_o,
  output shade_pkg::surface_t surface_o,
  input  logic                credit_i
);
  if (CREDIT_LOG2 < 3) begin : g_check
    $error("shade_starts: CREDIT_LOG2 must be at least 3");
  end

  localparam int S_W = shade_pkg::STEP_W;
  localparam int P_W = shade_pkg::PLACE_W;
  localparam int COMPONENTS = 4;

  // ---- runs, and steps down over lines without one; the first run waits until the triangle before has left -----------------
  logic inside_q, ready, step, arrive, first_step, idle, some_credit_q;
  logic [P_W-1:0] line_q, column_q;
  logic [CREDIT_LOG2:0] credit_q, credit;
  shade_pkg::walked_t run_q;
  logic run_q_valid;
  logic [2:0] busy_q;
  assign run_ready_o     = !run_q_valid || ready;
  assign first_step      = !inside_q && surface_valid_i && idle;
  assign step            = run_q_valid && some_credit_q && (inside_q || first_step);
  assign arrive          = step && (!inside_q || run_q.line == line_q + P_W'(1));
  assign ready           = arrive;
  assign surface_ready_o = step && !inside_q;
  assign idle            = busy_q == '0;
  assign credit          = credit_q + (CREDIT_LOG2 + 1)'(credit_i) - (CREDIT_LOG2 + 1)'(arrive);
  always_ff @(posedge clk_i) begin
    if (run_ready_o) run_q <= run_i;
    run_q_valid <= !rst_i && (run_ready_o ? run_valid_i : 1'b1);
    if (step) line_q <= inside_q ? line_q + P_W'(1) : run_q.line;
    if (arrive) column_q <= run_q.column;
    if (arrive) inside_q <= !run_q.last;
    if (surface_ready_o) surface_o <= surface_i;
    busy_q        <= {busy_q[1:0], step};
    credit_q      <= credit;
    some_credit_q <= credit != '0;
    if (rst_i) begin
      inside_q      <= 1'b0;
      busy_q        <= '0;
      credit_q      <= (CREDIT_LOG2 + 1)'(1 << CREDIT_LOG2);
      some_credit_q <= 1'b1;
    end
  end

  // ---- columns aside, products, sums -----------------------------------------------------------------------------------------
  logic signed [P_W:0] aside_q1;
  logic step_q1, step_q2, step_q3, first_q1, first_q2, first_q3, arrive_q1, arrive_q2, arrive_q3;
  shade_pkg::walked_t run_q1, run_q2, run_q3;
  always_ff @(posedge clk_i) begin
    aside_q1 <= arrive && inside_q ? {1'b0, run_q.column} - {1'b0, column_q} : '0;
    {first_q3, first_q2, first_q1}    <= {first_q2, first_q1, !inside_q};
    {step_q3, step_q2, step_q1}       <= rst_i ? '0 : {step_q2, step_q1, step};
    {arrive_q3, arrive_q2, arrive_q1} <= rst_i ? '0 : {arrive_q2, arrive_q1, arrive};
    {run_q3, run_q2, run_q1}          <= {run_q2, run_q1, run_q};
    valid_o <= arrive_q3 && !rst_i;
    first_o <= first_q3;
    run_o   <= run_q3;
  end
  logic [COMPONENTS-1:0][S_W-1:0] value, dcolumn, dline, start;
  assign value   = surface_o.value;
  assign dcolumn = surface_o.dcolumn;
  assign dline   = surface_o.dline;
  for (genvar i = 0; i < COMPONENTS; i++) begin : g_component
    logic signed [S_W+P_W:0] product_q3;
    logic [S_W-1:0] start_q;
    shade_mul #(.A_W(S_W), .B_W(P_W + 1)) u_mul (
      .clk_i, .a_i(dcolumn[i]), .b_i(aside_q1), .p_o(product_q3)
    );
    always_ff @(posedge clk_i) begin
      if (step_q3) start_q <= first_q3 ? value[i] : start_q + dline[i] + product_q3[S_W-1:0];
    end
    assign start[i] = start_q;
    logic unused_product;
    assign unused_product = ^product_q3[S_W+P_W:S_W];
  end
  assign start_o = start;
endmodule
