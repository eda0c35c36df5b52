// shade_node_walk: a planned span in, the interpolated normals at the nodes of its records out, one a clock.
//
//   N(j) = N + j G        j pixels from the span's start: by adders, as every step is a power of two of pixels
//
// A span is main_i records of 2^log2 pixels and a last one (direct if those are). A record of degree 1, 2, 3 has its nodes at its quarters
// {0, 4}, {0, 2, 4}, {0, 1, 2, 4}; one of degree 0 (direct) has its pixels. A record that follows one of degree >= 1 starts
// where that ends: the node is shared (shared_o) and does not come again.
//
//   n_i, g_i           S2.29 each component (x in the low word): normal of the first pixel, increment per pixel
//   main_i .. last_degree_i  as shade_planner gives them; split_i  main_i is not 0: ready_o hangs on it, so it must come early
//   flat_i             the span's normals need no normalizing
//   valid_i, ready_o   a span is taken when both are 1; its two kinds of records follow each other without a bubble
//   credit_i           gives one credit back; 2^CREDIT_LOG2 are there after reset, a record costs one
//   x_o .. z_o         S2.15, the normal at a node, to nearest, ties up, saturated; not of unit length
//   slot_o             number of the node in its record; first_o, last_o frame the nodes of a record that come
//   count_o, degree_o  of the record; more_o: the span goes on behind it; flat_o, tag_o: the span's
//
// Latency from a span taken to its first node LATENCY_NODE_WALK = 5 clocks, one node a clock. PACE > 1: a node in PACE clocks,
// whenever their number since reset is a multiple of it: for folded units.
// Example: 5 pixels, one record of degree 3: nodes at pixels 0, 1, 2, 4 in slots 0, 1, 2, 3.
// Source: P4 (one increment for all lines of a triangle), P1, section IV (nodes).
module shade_node_walk #(
  parameter int CREDIT_LOG2 = shade_pkg::RECORD_FIFO_LOG2,
  parameter int PACE        = 1
) (
  input  logic                               clk_i,
  input  logic                               rst_i,
  input  logic                               valid_i,
  output logic                               ready_o,
  input  logic [     3*shade_pkg::STEP_W-1:0] n_i,
  input  logic [     3*shade_pkg::STEP_W-1:0] g_i,
  input  logic                               split_i,
  input  logic [      shade_pkg::COUNT_W-1:0] main_i,
  input  logic [                         3:0] log2_i,
  input  logic [     shade_pkg::DEGREE_W-1:0] degree_i,
  input  logic [      shade_pkg::COUNT_W-1:0] last_count_i,
  input  logic [                         3:0] last_log2_i,
  input  logic [     shade_pkg::DEGREE_W-1:0] last_degree_i,
  input  logic                               flat_i,
  input  logic [        shade_pkg::TAG_W-1:0] tag_i,
  input  logic                               credit_i,
  output logic                               valid_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] x_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] y_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] z_o,
  output logic [                         1:0] slot_o,
  output logic                               first_o,
  output logic                               shared_o,
  output logic                               last_o,
  output logic [      shade_pkg::COUNT_W-1:0] count_o,
  output logic [     shade_pkg::DEGREE_W-1:0] degree_o,
  output logic                               more_o,
  output logic                               flat_o,
  output logic [        shade_pkg::TAG_W-1:0] tag_o
);
  if (CREDIT_LOG2 < 1 || PACE < 1 || PACE > 8) begin : g_check
    $error("shade_node_walk: CREDIT_LOG2 must be at least 1 and PACE in 1 .. 8");
  end

  localparam int STEP_W = shade_pkg::STEP_W;
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int W = shade_pkg::INTENSITY_W;
  localparam int DEGREE_W = shade_pkg::DEGREE_W;
  localparam int TAG_W = shade_pkg::TAG_W;
  localparam logic [COUNT_W-1:0] ONE = COUNT_W'(1);

  // ---- the run after next: the main records, or the last one, and its step (a quarter, a half or all of a record) ------
  logic main, take, chosen_valid_q, move, next_valid_q, load;
  logic main_done_q;
  logic [3:0] run_log2, step_log2, step_log2_q;
  logic [DEGREE_W-1:0] run_degree;
  assign main       = split_i && !main_done_q;
  assign run_degree = main ? degree_i : last_degree_i;
  assign run_log2   = main ? log2_i : last_log2_i;
  always_comb begin
    case (run_degree)
      2'd1:    step_log2 = run_log2;
      2'd2:    step_log2 = run_log2 - 4'd1;
      2'd3:    step_log2 = run_log2 - 4'd2;
      default: step_log2 = '0;
    endcase
  end
  assign move    = chosen_valid_q && (!next_valid_q || load);
  assign take    = valid_i && (!chosen_valid_q || move);
  assign ready_o = !main && (!chosen_valid_q || move);

  // what a run keeps from here on, in one word
  localparam int RUN_W = 5 + COUNT_W + COUNT_W + DEGREE_W + TAG_W;
  logic [3*STEP_W-1:0] chosen_n_q, chosen_g_q;
  logic [RUN_W-1:0] chosen_q, next_q;
  always_ff @(posedge clk_i) begin
    if (take) begin
      chosen_n_q  <= n_i;
      chosen_g_q  <= g_i;
      step_log2_q <= step_log2;
      chosen_q    <= {
        !main_done_q, main_done_q && degree_i != '0, main, flat_i, !main || main_i == ONE, main ? main_i : ONE,
        main ? ONE << log2_i : last_count_i, run_degree, tag_i
      };
    end
    if (take) main_done_q <= main;
    if (take) chosen_valid_q <= 1'b1;
    else if (move) chosen_valid_q <= 1'b0;
    if (rst_i) begin
      main_done_q    <= 1'b0;
      chosen_valid_q <= 1'b0;
    end
  end

  // ---- the next run, with its step ---------------------------------------------------------------------------------
  logic next_fresh, next_shared, next_more, next_flat, next_single;
  logic [3*STEP_W-1:0] next_n_q, next_step_q;
  logic [COUNT_W-1:0] next_records, next_count;
  logic [DEGREE_W-1:0] next_degree;
  logic [TAG_W-1:0] next_tag;
  assign {
    next_fresh, next_shared, next_more, next_flat, next_single, next_records, next_count, next_degree, next_tag
  } = next_q;
  always_ff @(posedge clk_i) begin
    if (move) begin
      next_q   <= chosen_q;
      next_n_q <= chosen_n_q;
      for (int c = 0; c < 3; c++) begin
        next_step_q[c*STEP_W+:STEP_W] <= chosen_g_q[c*STEP_W+:STEP_W] << step_log2_q;
      end
    end
    if (move) next_valid_q <= 1'b1;
    else if (load) next_valid_q <= 1'b0;
    if (rst_i) next_valid_q <= 1'b0;
  end

  // ---- the run in work: whether a node goes and whether it is the last one is known a clock before ---------------------
  logic busy_q, first_q, shared_q, more_q, flat_q, last_record_q, go_q, end_record_q, end_run_q;
  logic busy_d, first_d, shared_d, last_record_d;
  logic end_run;
  logic [1:0] slot_q, slot_d, last_slot_q, last_slot_d;
  logic [3*STEP_W-1:0] start_q, step_q;
  logic [COUNT_W-1:0] records_q, count_q;
  logic [DEGREE_W-1:0] degree_q;
  logic [TAG_W-1:0] tag_q;
  logic [CREDIT_LOG2:0] credit_q, credit_d;
  logic pace_d;
  assign end_run  = go_q && end_run_q;
  assign load     = next_valid_q && (!busy_q || end_run);
  assign credit_d = credit_q + (CREDIT_LOG2 + 1)'(credit_i) - (CREDIT_LOG2 + 1)'(go_q && first_q);
  always_comb begin
    busy_d        = load || (busy_q && !end_run);
    first_d       = first_q;
    shared_d      = shared_q;
    slot_d        = slot_q;
    last_slot_d   = last_slot_q;
    last_record_d = last_record_q;
    if (load) begin
      first_d       = 1'b1;
      shared_d      = next_shared;
      slot_d        = {1'b0, next_shared};
      last_slot_d   = next_degree == '0 ? 2'(next_count - ONE) : next_degree;
      last_record_d = next_single;
    end else if (go_q) begin
      first_d = end_record_q;
      if (end_record_q) begin
        shared_d      = degree_q != '0;
        slot_d        = {1'b0, degree_q != '0};
        last_record_d = records_q == COUNT_W'(2);
      end else begin
        slot_d = slot_q + 2'd1;
      end
    end
  end

  if (PACE == 1) begin : g_every_clock
    assign pace_d = 1'b1;
  end else begin : g_pace
    logic [2:0] phase_q, phase_d;  // counts as in the folded units behind, which take a node in phase 0
    assign phase_d = phase_q == 3'(PACE - 1) ? '0 : phase_q + 3'd1;
    assign pace_d  = phase_d == 3'(PACE - 2);
    always_ff @(posedge clk_i) phase_q <= rst_i ? '0 : phase_d;
  end

  always_ff @(posedge clk_i) begin
    first_q       <= first_d;
    shared_q      <= shared_d;
    slot_q        <= slot_d;
    last_slot_q   <= last_slot_d;
    end_record_q  <= slot_d == last_slot_d;
    last_record_q <= last_record_d;
    end_run_q     <= slot_d == last_slot_d && last_record_d;
    busy_q        <= busy_d;
    credit_q      <= credit_d;
    go_q          <= busy_d && (!first_d || credit_d != '0) && pace_d;
    if (load) begin
      records_q <= next_records;
      count_q   <= next_count;
      degree_q  <= next_degree;
      start_q   <= next_n_q;
      step_q    <= next_step_q;
      more_q    <= next_more;
      flat_q    <= next_flat;
      tag_q     <= next_tag;
    end else if (go_q && end_record_q) begin
      records_q <= records_q - ONE;
    end
    if (rst_i) begin
      busy_q   <= 1'b0;
      go_q     <= 1'b0;
      credit_q <= (CREDIT_LOG2 + 1)'(1 << CREDIT_LOG2);
    end
  end

  // ---- its node, a clock later -----------------------------------------------------------------------------------
  localparam int PLACE_W = 2 + 3;  // where a node is: slot, first, shared, last
  localparam int KIND_W = COUNT_W + DEGREE_W + 2 + TAG_W;
  logic begin_q, step_on_q, far_q, valid_q;
  logic [PLACE_W+KIND_W-1:0] about_q;
  always_ff @(posedge clk_i) begin
    begin_q   <= load && next_fresh;
    step_on_q <= load || (go_q && !end_run);
    far_q     <= !load && degree_q == DEGREE_W'(shade_pkg::DEGREE_CUBIC) && slot_q == 2'd2;  // of a cubic: half a record
    valid_q   <= go_q;
    about_q   <= {
      slot_q, first_q, shared_q && first_q, end_record_q, count_q, degree_q, more_q, flat_q, tag_q
    };
    if (rst_i) valid_q <= 1'b0;
  end
  logic [3*STEP_W-1:0] node_q;
  for (genvar c = 0; c < 3; c++) begin : g_component
    logic [STEP_W-1:0] sum;
    assign sum = node_q[c*STEP_W+:STEP_W] + (step_q[c*STEP_W+:STEP_W] << far_q);
    always_ff @(posedge clk_i) begin
      if (begin_q) node_q[c*STEP_W+:STEP_W] <= start_q[c*STEP_W+:STEP_W];
      else if (step_on_q) node_q[c*STEP_W+:STEP_W] <= sum;
    end
  end

  // ---- a node goes out ---------------------------------------------------------------------------------------
  localparam int DROP = shade_pkg::STEP_F - shade_pkg::NODE_F;
  logic [3*W-1:0] rounded;
  for (genvar c = 0; c < 3; c++) begin : g_round
    logic [W:0] sum;
    assign sum = {node_q[c*STEP_W+STEP_W-1], node_q[c*STEP_W+DROP+:W]} + (W + 1)'(node_q[c*STEP_W+DROP-1]);
    assign rounded[c*W+:W] = sum[W] == sum[W-1] ? sum[W-1:0] : {1'b0, {(W - 1) {1'b1}}};  // only upwards
  end
  always_ff @(posedge clk_i) begin
    {z_o, y_o, x_o} <= rounded;
    {slot_o, first_o, shared_o, last_o, count_o, degree_o, more_o, flat_o, tag_o} <= about_q;
    valid_o <= valid_q;
    if (rst_i) valid_o <= 1'b0;
  end
endmodule
