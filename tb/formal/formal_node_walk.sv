// SPDX-License-Identifier: Apache-2.0
// formal_node_walk: the nodes of a span are those that its plan asks for, in order, one in every clock that allows it.
//
// Bit 0 of the tag marks one span; its plan is held, and a model of its records is advanced by every marked node. Control
// does not look at vectors, and at plans only by their fields: vectors are 0, main records 0 .. 3, pixels of a last one 1 .. 15.
module formal_node_walk #(
  parameter int CREDIT_LOG2 = 1
) (
  input logic             clk_i,
  input logic             rst_i,
  input logic             valid_i,
  input logic       [1:0] main_i,
  input logic       [1:0] log2_i,
  input logic       [1:0] degree_i,
  input logic       [3:0] last_count_i,
  input logic       [1:0] last_degree_i,
  input logic             credit_i,
  input logic             mark_i
);
  localparam int N_W = CREDIT_LOG2 + 2;
  localparam logic [N_W-1:0] ALL = N_W'(1 << CREDIT_LOG2);
  logic ready, valid, take, marked, job_taken, waits_q, waits_mark_q;
  shade_pkg::job_t job;
  shade_pkg::plan_t plan;
  shade_pkg::node_t node;
  shade_pkg::head_t head;
  shade_node_walk #(.CREDIT_LOG2(CREDIT_LOG2)) u_dut (
    .clk_i, .rst_i, .phase_i(3'd0), .valid_i, .ready_o(ready), .plan_i(plan), .job_i(job), .job_taken_o(job_taken),
    .credit_i, .valid_o(valid), .node_o(node)
  );
  assign take   = valid_i && ready;
  assign head   = node.place.head;
  assign marked = valid && head.tag[0];

  // the marked span, once: from its first offer on
  logic started_q = 1'b0;
  logic offered_q, token_q, done_q, held_q, held_mark_q;
  shade_pkg::plan_t plan_q, held_plan_q;
  logic mark;
  assign mark = held_q ? held_mark_q : mark_i && !token_q;
  always_comb begin
    job              = '0;
    job.tag[0]       = waits_q ? waits_mark_q : mark;  // of the oldest span that was not taken
    plan             = '0;
    plan.split       = main_i != '0;
    plan.main        = 13'(main_i);
    plan.log2        = {2'b00, log2_i};
    plan.degree      = degree_i;
    plan.last_count  = 13'(last_count_i);
    plan.last_log2   = 4'd4;
    plan.last_degree = last_degree_i;
  end

  // the record that the next marked node belongs to: its number, and the slot that comes
  logic [12:0] record_q;
  logic [1:0] slot_q, last_slot;
  logic first_q, is_last, shared, direct;
  logic [1:0] degree;
  assign is_last   = record_q == plan_q.main;
  assign degree    = is_last ? plan_q.last_degree : plan_q.degree;
  assign direct    = degree == '0;
  assign shared    = record_q != '0 && plan_q.degree != '0;
  assign last_slot = direct ? 2'((is_last ? plan_q.last_count : 13'd1 << plan_q.log2) - 13'd1) : degree;

  // records under way; clocks in which the oldest span could have moved on
  logic [N_W-1:0] spent_q;
  logic [3:0] idle_q;
  logic open_q;  // inside of a record
  always_ff @(posedge clk_i) begin
    started_q   <= 1'b1;
    held_q      <= valid_i && !ready;
    held_mark_q <= mark;
    held_plan_q <= plan;
    waits_q     <= take || (waits_q && !job_taken);
    if (take) waits_mark_q <= mark;
    if (valid_i && mark && !token_q) {token_q, plan_q} <= {1'b1, plan};
    if (marked) begin
      first_q <= node.place.last;
      slot_q  <= node.place.last ? {1'b0, degree != '0 || (record_q + 13'd1 == plan_q.main && plan_q.degree != '0)}
                                 : slot_q + 2'd1;
      if (node.place.last) record_q <= record_q + 13'd1;
      if (node.place.last && is_last) done_q <= 1'b1;
    end
    spent_q <= spent_q + N_W'(valid && open_q) - N_W'(credit_i);
    if (valid) open_q <= node.place.last;
    idle_q <= valid || !token_q || done_q || spent_q != '0 ? 4'd0 : idle_q + 4'd1;
    if (rst_i) begin
      {held_q, waits_q, token_q, done_q, record_q, slot_q, spent_q, idle_q} <= '0;
      {first_q, open_q} <= 2'b11;
    end
  end

  always_ff @(posedge clk_i) begin
    // The first clock is one of reset, from any state.
    if (!started_q) reset_first : assume (rst_i);
    if (started_q) begin
      // A plan as shade_planner makes it: no record is empty; a direct one has at most 4 pixels, a main one exactly 4.
      legal_plan : assume (!valid_i || (last_count_i != '0 && (last_degree_i != '0 || last_count_i <= 4'd4)
        && log2_i >= 2'd2 && (degree_i != '0 || log2_i == 2'd2)
        && (main_i == '0 || degree_i == '0 || last_count_i >= 4'd2)));
      // A span is offered until it is taken, with the same plan.
      plan_stays : assume (!held_q || (valid_i && plan == held_plan_q));
      // The consumer gives back only credits that were spent.
      credits_are_spent : assume (!credit_i || spent_q != '0);
      // Records come whole: a node is the first of its record if and only if the one before was the last of one.
      // mutant: slot_d = slot_q + 2'd1; => slot_d = slot_q + 2'd2;
      slots : assert (!marked || node.place.slot == ((first_q && !shared) ? 2'd0 : first_q ? 2'd1 : slot_q));
      // mutant: slot_d == last_slot_d; => slot_d >= 2'd1;
      last : assert (!marked || node.place.last == (node.place.slot == last_slot));
      // The first node of a record is shared if it follows a curved one of the same span.
      // mutant: place_q.shared      <= shared_q && first_q => place_q.shared      <= shared_q
      share : assert (!marked || node.place.shared == (first_q && shared));
      // A record has the degree and the pixels that the plan tells, and tells whether the span goes on.
      // mutant: place_q.head.more   <= stretch_q.more => place_q.head.more   <= !last_record_q
      fields : assert (!marked || (head.degree == degree && head.more == !is_last
        && head.count == (is_last ? plan_q.last_count : 13'd1 << plan_q.log2)));
      // No more nodes than the plan asks for.
      // mutant: records_q <= records_q - ONE => records_q <= records_q
      complete : assert (!(marked && done_q));
      // Never more records under way than credits.
      // mutant: .take_i(go_q && first_q) => .take_i(go_q && end_run_q)
      credits : assert (spent_q <= ALL);
      // With all credits there, a node comes within the latency.
      // mutant: busy_d && (!first_d || credit) && pace => busy_d && (!first_d || credit) && pace && !valid_i
      in_time : assert (idle_q < 4'(shade_pkg::LATENCY_NODE_WALK + 3));
    end
  end
endmodule
