// SPDX-License-Identifier: Apache-2.0
// shade_stretch: a planned span in, its one or two stretches out: records of one kind, with the step from node to node.
//
//   stretch 0   main records of 2^log2 pixels, if plan_i.split
//   stretch 1   the last record
//   step        increment 2^log2, 2^(log2 - 1), 2^(log2 - 2) of degree 1, 2, 3: a quarter, a half or all of a record;
//               of degree 0 (direct) the increment itself
//
//   plan_i             what shade_planner made of a span; ready_o hangs on plan_i.split, so that must come early
//   job_i              the span itself, from the clock behind its plan on until job_taken_o, which comes with its last stretch
//   stretch_o          shared: it starts at the last node of the stretch before
//   valid_i, ready_o   a plan is taken when both are 1, for its last stretch; valid_o, ready_i likewise
//
// log2 of records: at most LOG2_MAX. Latency 2 clocks, one stretch a clock. Exact; steps wrap at 32 bits.
// Example: main = 2, log2 = 4, degree 3; last_count = 9, last_log2 = 3, last_degree 1 -> 2 records of 16 pixels, step 4 g;
// 1 record of 9 pixels, step 8 g, shared. Source: P1, section IV (nodes).
module shade_stretch #(
  parameter int LOG2_MAX = shade_pkg::RECORD_LOG2
) (
  input  logic                clk_i,
  input  logic                rst_i,
  input  logic                valid_i,
  output logic                ready_o,
  input  shade_pkg::plan_t    plan_i,
  input  shade_pkg::job_t     job_i,
  output logic                job_taken_o,
  output logic                valid_o,
  input  logic                ready_i,
  output shade_pkg::stretch_t stretch_o
);
  if (LOG2_MAX < 4 || LOG2_MAX > shade_pkg::LOG2_MAX) begin : g_check
    $error("shade_stretch: LOG2_MAX must be in 4 .. 12");
  end

  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int LOG2_W = shade_pkg::LOG2_W;
  localparam logic [COUNT_W-1:0] ONE = COUNT_W'(1);

  // ---- which one it is, and how far its nodes are apart; wide as it is, the span waits in its FIFO ---------------------
  logic main, main_done_q, move, take, chosen_valid_q;
  localparam int STEP_W = $clog2(LOG2_MAX + 1);
  logic [LOG2_W-1:0] step_log2;
  logic [STEP_W-1:0] step_log2_q;
  shade_pkg::stretch_t chosen, chosen_q;
  assign main = plan_i.split && !main_done_q;
  assign chosen.normal  = '0;
  assign chosen.step    = '0;
  assign chosen.tag     = '0;
  assign chosen.flat    = 1'b0;
  assign chosen.degree  = main ? plan_i.degree : plan_i.last_degree;
  assign chosen.log2    = main ? plan_i.log2 : plan_i.last_log2;
  assign chosen.count   = main ? ONE << plan_i.log2 : plan_i.last_count;
  assign chosen.records = main ? plan_i.main : ONE;
  assign chosen.single  = !main || plan_i.main == ONE;
  assign chosen.more    = main;
  assign chosen.shared  = main_done_q && plan_i.degree != '0;
  assign chosen.fresh   = !main_done_q;
  always_comb begin
    case (chosen.degree)
      2'd1:    step_log2 = chosen.log2;
      2'd2:    step_log2 = chosen.log2 - LOG2_W'(1);
      2'd3:    step_log2 = chosen.log2 - LOG2_W'(2);
      default: step_log2 = '0;
    endcase
  end
  assign move        = chosen_valid_q && (!valid_o || ready_i);
  assign take        = valid_i && (!chosen_valid_q || move);
  assign ready_o     = !main && (!chosen_valid_q || move);
  assign job_taken_o = move && !chosen_q.more;

  always_ff @(posedge clk_i) begin
    if (take) begin
      chosen_q    <= chosen;
      step_log2_q <= STEP_W'(step_log2);
      main_done_q <= main;
    end
    if (move) begin
      stretch_o        <= chosen_q;
      stretch_o.normal <= job_i.normal;
      stretch_o.step.x <= job_i.increment.x << step_log2_q;
      stretch_o.step.y <= job_i.increment.y << step_log2_q;
      stretch_o.step.z <= job_i.increment.z << step_log2_q;
      stretch_o.tag    <= job_i.tag;
      stretch_o.flat   <= job_i.flat;
    end

    if (take) chosen_valid_q <= 1'b1;
    else if (move) chosen_valid_q <= 1'b0;
    if (move) valid_o <= 1'b1;
    else if (ready_i) valid_o <= 1'b0;
    if (rst_i) {main_done_q, chosen_valid_q, valid_o} <= 3'b000;
  end
  shade_assert u_log2 (.clk_i, .rst_i, .holds_i(!take || step_log2 <= LOG2_W'(LOG2_MAX)));
  shade_stable #(.WIDTH($bits(stretch_o))) u_stable (.clk_i, .rst_i, .valid_i(valid_o), .ready_i, .data_i(stretch_o));
endmodule
