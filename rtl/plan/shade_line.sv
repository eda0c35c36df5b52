// SPDX-License-Identifier: Apache-2.0
// shade_line: spans in, unit normals at the nodes of their records out: the line form's producer of points.
//
//   span ─┬─▶ shade_planner ─▶ plans ─┐
//         └─▶ shade_fifo ─── jobs ────┴▶ shade_node_walk ─┬─▶ shade_unit ─▶ unit_o
//                                                         └─▶ place_o
//
//   span_i       1 .. 4096 pixels; its flat bit counts with Lambert's light alone (P2)
//   room_o       there is a place for a span; ready_o: it is taken in this clock
//   draw_i       settings; must not change while a span is inside
//   place_o      a node's place in its record, with place_valid_o, LATENCY_UNIT(_FOLDED) clocks before its normal
//   unit_o       the normal, S1.16, with valid_o; see shade_unit
//   credit_i     gives one credit back; 2^RECORD_FIFO_LOG2 are there after reset, a record costs one
//
// A span in 4 clocks, LOG2_MAX > 5: in LOG2_MAX - 1, see shade_planner: as short as four pixels they keep up with one pixel a
// clock. FOLD = 2 .. 8: a node in FOLD clocks, with fewer multipliers in shade_unit; phase_i counts 0 .. FOLD - 1. No path leads
// from an input to an output.
// Latency from a span to its first normal: LATENCY_LINE = 57 clocks, FOLD > 2: LATENCY_LINE_FOLDED = 66, and FOLD - 1 more at
// most. One node a clock. Source: P1, P4. Example: 5 pixels, degree 3: the normals of pixels 0, 1, 2, 4 in slots 0 to 3 of one record.
module shade_line #(
  parameter int FOLD     = 1,
  parameter int LOG2_MAX = shade_pkg::RECORD_LOG2
) (
  input  logic              clk_i,
  input  logic              rst_i,
  input  logic [shade_pkg::PHASE_W-1:0] phase_i,
  input  shade_pkg::draw_t  draw_i,
  input  logic              valid_i,
  output logic              ready_o,
  output logic              room_o,
  input  shade_pkg::span_t  span_i,
  input  logic              credit_i,
  output logic              place_valid_o,
  output shade_pkg::place_t place_o,
  output logic              valid_o,
  output shade_pkg::unit_t  unit_o
);
  if (FOLD < 1 || FOLD > shade_pkg::FOLD_MAX) begin : g_check
    $error("shade_line: FOLD must be in 1 .. 8");
  end

  localparam int LOG2 = shade_pkg::SPAN_FIFO_LOG2;

  // ---- spans, beside their plans: a plan comes later than its span -------------------------------------------------
  logic take, taken, under_way, job_valid, job_taken, planned, plan_valid, plan_taken, soon, open_d, unused_taken;
  shade_pkg::job_t job, job_next;
  shade_pkg::plan_t plan, plan_next;
  // the planner's own phase: it stays at 0 while no span is under way
  localparam int PACE = LOG2_MAX > 5 ? LOG2_MAX - 1 : 4;
  localparam int LATENCY = shade_pkg::LATENCY_WEIGHT + 1 + 3 * PACE;
  logic [shade_pkg::LOG2_W-1:0] pace_q;
  logic [LATENCY-1:0] plans_q;  // spans under way, the latest in bit 0
  assign under_way     = take || plans_q != '0;
  assign planned       = plans_q[LATENCY-1];
  // ready_o = room_o && pace_q == 0, from a register: it leads through the door to the credits in one clock
  assign open_d        = !under_way || pace_q == shade_pkg::LOG2_W'(PACE - 1);
  always_ff @(posedge clk_i) begin
    plans_q <= LATENCY'({plans_q, take});
    pace_q  <= open_d ? '0 : pace_q + shade_pkg::LOG2_W'(1);
    ready_o <= rst_i || (soon && open_d);
    if (rst_i) {plans_q, pace_q} <= '0;
  end
  assign take          = valid_i && ready_o;
  assign job.normal    = span_i.normal;
  assign job.increment = span_i.increment;
  assign job.flat      = span_i.flat && draw_i.material.model == shade_pkg::MODEL_W'(shade_pkg::MODEL_LAMBERT);
  assign job.tag       = span_i.tag;
  shade_credit #(.LOG2(LOG2)) u_room (.clk_i, .rst_i, .take_i(take), .give_i(taken), .some_o(room_o), .soon_o(soon));
  shade_fifo #(.WIDTH($bits(job)), .LOG2(LOG2), .BLOCK(1)) u_jobs (
    .clk_i, .rst_i, .valid_i(take), .data_i(job), .valid_o(job_valid), .ready_i(job_taken), .data_o(job_next),
    .taken_o(taken)
  );

  shade_planner #(.LOG2_MAX(LOG2_MAX)) u_planner (
    .clk_i, .phase_i(pace_q), .normal_i(span_i.normal), .increment_i(span_i.increment),
    .count_i(span_i.count), .flat_i(job.flat),
    .planner_i(draw_i.planner), .h_i(draw_i.light.h), .fixed_degree_i(draw_i.control.fixed_degree), .plan_o(plan)
  );
  shade_fifo #(.WIDTH($bits(plan)), .LOG2(LOG2), .BLOCK(1)) u_plans (
    .clk_i, .rst_i, .valid_i(planned), .data_i(plan), .valid_o(plan_valid), .ready_i(plan_taken), .data_o(plan_next),
    .taken_o(unused_taken)
  );
  shade_assert u_job (.clk_i, .rst_i, .holds_i(job_valid || (!plan_valid && !job_taken)));

  // ---- nodes -----------------------------------------------------------------------------------------------------
  shade_pkg::node_t node;
  shade_node_walk #(.FOLD(FOLD), .LOG2_MAX(LOG2_MAX)) u_walk (
    .clk_i, .rst_i, .phase_i, .valid_i(plan_valid), .ready_o(plan_taken), .plan_i(plan_next), .job_i(job_next),
    .job_taken_o(job_taken), .credit_i, .valid_o(place_valid_o), .node_o(node)
  );
  assign place_o = node.place;
  localparam int TO_UNIT = FOLD < 3 ? shade_pkg::LATENCY_UNIT : shade_pkg::LATENCY_UNIT_FOLDED;
  shade_unit #(.FOLD(FOLD)) u_unit (.clk_i, .rst_i, .phase_i, .bypass_i(node.flat), .v_i(node.normal), .unit_o);
  shade_valid #(.DEPTH(TO_UNIT)) u_valid (.clk_i, .rst_i, .valid_i(place_valid_o), .valid_o);

  logic unused_bits;
  assign unused_bits = &{1'b0, span_i, draw_i, job_valid};
endmodule
