// SPDX-License-Identifier: Apache-2.0
// shade_node_walk: a planned span in, the interpolated normals at the nodes of its records out, one a clock.
//
//   N(j) = N + j G        j pixels from the span's start: by adders, as every step is a power of two of pixels
//
// A span is main_i records of 2^log2 pixels and a last one (direct if those are). A record of degree 1, 2, 3 has its nodes at its quarters
// {0, 4}, {0, 2, 4}, {0, 1, 2, 4}; one of degree 0 (direct) has its pixels. A record that follows one of degree >= 1 starts
// where that ends: the node is shared (shared_o) and does not come again.
//
//   plan_i, job_i      a plan and, later, its span: see shade_stretch
//   credit_i           gives one credit back; 2^CREDIT_LOG2 are there after reset, a record costs one
//   node_o             normal: S2.15, to nearest, ties up, saturated, not of unit length; flat: the span's;
//                      place: slot of the node in its record, shared, last; head: of the record
//
// Latency from a span taken to its first node LATENCY_NODE_WALK = 5 clocks, one node a clock. FOLD > 1: for folded units, which
// take one in phase 0 of FOLD: only then a node comes.
// Example: 5 pixels, one record of degree 3: nodes at pixels 0, 1, 2, 4 in slots 0, 1, 2, 3.
// Source: P4 (one increment for all lines of a triangle), P1, section IV (nodes).
module shade_node_walk #(
  parameter int CREDIT_LOG2 = shade_pkg::RECORD_FIFO_LOG2,
  parameter int FOLD        = 1,
  parameter int LOG2_MAX    = shade_pkg::RECORD_LOG2
) (
  input  logic             clk_i,
  input  logic             rst_i,
  input  logic [shade_pkg::PHASE_W-1:0] phase_i,
  input  logic             valid_i,
  output logic             ready_o,
  input  shade_pkg::plan_t plan_i,
  input  shade_pkg::job_t  job_i,
  output logic             job_taken_o,
  input  logic             credit_i,
  output logic             valid_o,
  output shade_pkg::node_t node_o
);
  if (FOLD < 1 || FOLD > shade_pkg::FOLD_MAX) begin : g_check
    $error("shade_node_walk: FOLD must be in 1 .. 8");
  end

  localparam int STEP_W = shade_pkg::STEP_W;
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int DEGREE_W = shade_pkg::DEGREE_W;
  localparam logic [COUNT_W-1:0] ONE = COUNT_W'(1);

  logic next_valid, load;
  shade_pkg::stretch_t next;
  shade_stretch #(.LOG2_MAX(LOG2_MAX)) u_stretch (
    .clk_i, .rst_i, .valid_i, .ready_o, .plan_i, .job_i, .job_taken_o, .valid_o(next_valid), .ready_i(load),
    .stretch_o(next)
  );

  // ---- the stretch in work: whether a node goes and whether it is the last one is known a clock before -----------------
  logic busy_q, first_q, shared_q, last_record_q, go_q, end_record_q, end_run_q, free_q;
  logic busy_d, first_d, shared_d, last_record_d, go_d, end_run_d, end_run, unused_some, credit, pace;
  logic [1:0] slot_q, slot_d, last_slot_q, last_slot_d;
  logic [COUNT_W-1:0] records_q;
  shade_pkg::stretch_t stretch_q;
  assign end_run = go_q && end_run_q;
  assign load    = next_valid && free_q;  // a register: from here a path leads to the FIFOs of spans and plans
  shade_credit #(.LOG2(CREDIT_LOG2)) u_credit (
    .clk_i, .rst_i, .take_i(go_q && first_q), .give_i(credit_i), .some_o(unused_some), .soon_o(credit)
  );
  always_comb begin
    busy_d        = load || (busy_q && !end_run);
    first_d       = first_q;
    shared_d      = shared_q;
    slot_d        = slot_q;
    last_slot_d   = last_slot_q;
    last_record_d = last_record_q;
    if (load) begin
      first_d       = 1'b1;
      shared_d      = next.shared;
      slot_d        = {1'b0, next.shared};
      last_slot_d   = next.degree == '0 ? 2'(next.count - ONE) : next.degree;
      last_record_d = next.single;
    end else if (go_q) begin
      first_d = end_record_q;
      if (end_record_q) begin
        shared_d      = stretch_q.degree != '0;
        slot_d        = {1'b0, stretch_q.degree != '0};
        last_record_d = records_q == COUNT_W'(2);
      end else begin
        slot_d = slot_q + 2'd1;
      end
    end
  end

  // a node that goes in this clock comes out in two: in phase 0
  assign end_run_d = slot_d == last_slot_d && last_record_d;
  assign go_d      = busy_d && (!first_d || credit) && pace;
  assign pace      = FOLD == 1 || phase_i == shade_pkg::PHASE_W'((2 * FOLD - 3) % FOLD);
  always_ff @(posedge clk_i) begin
    first_q       <= first_d;
    shared_q      <= shared_d;
    slot_q        <= slot_d;
    last_slot_q   <= last_slot_d;
    end_record_q  <= slot_d == last_slot_d;
    last_record_q <= last_record_d;
    end_run_q     <= end_run_d;
    busy_q        <= busy_d;
    go_q          <= go_d;
    free_q        <= !busy_d || (go_d && end_run_d);
    if (load) begin
      stretch_q <= next;
      records_q <= next.records;
    end else if (go_q && end_record_q) begin
      records_q <= records_q - ONE;
    end
    if (rst_i) {busy_q, go_q, free_q} <= 3'b001;
  end

  // ---- its node, a clock later; a cubic's third step is half a record --------------------------------------------------
  logic begin_q, step_on_q, far_q, valid_q;
  logic flat_q;
  shade_pkg::place_t place_q;
  logic [2:0][STEP_W-1:0] start, step, at_q;
  assign start = stretch_q.normal;
  assign step  = stretch_q.step;
  always_ff @(posedge clk_i) begin
    begin_q             <= load && next.fresh;
    step_on_q           <= load || (go_q && !end_run);
    far_q               <= !load && stretch_q.degree == DEGREE_W'(shade_pkg::DEGREE_CUBIC) && slot_q == 2'd2;
    flat_q              <= stretch_q.flat;
    place_q.slot        <= slot_q;
    place_q.shared      <= shared_q && first_q;
    place_q.last        <= end_record_q;
    place_q.head.count  <= stretch_q.count;
    place_q.head.more   <= stretch_q.more;
    place_q.head.degree <= stretch_q.degree;
    place_q.head.tag    <= stretch_q.tag;
    place_q.head.log2   <= stretch_q.log2;
    valid_q             <= !rst_i && go_q;
  end

  // ---- a node goes out -----------------------------------------------------------------------------------------
  localparam int DROP = shade_pkg::STEP_F - shade_pkg::NODE_F;
  logic [2:0][W-1:0] rounded;
  for (genvar c = 0; c < 3; c++) begin : g_component
    logic signed [W:0] sum;
    always_ff @(posedge clk_i) begin
      if (begin_q) at_q[c] <= start[c];
      else if (step_on_q) at_q[c] <= at_q[c] + (step[c] << far_q);
    end
    assign sum        = (W + 1)'($signed(at_q[c]) >>> DROP) + (W + 1)'(at_q[c][DROP-1]);
    assign rounded[c] = sum[W] == sum[W-1] ? W'(sum) : {1'b0, {(W - 1) {1'b1}}};  // only upwards
  end
  always_ff @(posedge clk_i) begin
    node_o.flat   <= flat_q;
    node_o.place  <= place_q;
    node_o.normal <= rounded;
    valid_o       <= !rst_i && valid_q;
  end
  shade_assert u_phase (.clk_i, .rst_i, .holds_i(!valid_o || FOLD == 1 || phase_i == '0));

  logic unused_bits;
  assign unused_bits = &{1'b0, phase_i, stretch_q.records, stretch_q.single, stretch_q.shared, stretch_q.fresh};
endmodule
