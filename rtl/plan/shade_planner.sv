// SPDX-License-Identifier: Apache-2.0
// shade_planner: how a span is cut into records: length and degree by kappa, from increment and pixel count.
//
//   whole = min(LOG2_MAX, ceil(log2(count - 1)))   an arc of the span has 2^whole pixels, and shade_kappa its kappa
//   kappa(k) = kappa 2^-w 4^(k - whole)  of 2^k pixels; w by shade_weight: where the highlight is far
//   k = largest with kappa(k) <= t3;  degree 1 where kappa(k) <= t1, 2 where <= t2, else 3
//
//   normal_i         S2.29: the normal of the first pixel; increment_i: its increment per pixel; h_i: where the highlight is
//   count_i          pixels, 1 .. 4096; any other count gives some plan
//   flat_i           kappa counts as 0: one record of degree 1
//   planner_i        t1, t2, t3, sharpness, weight: see docs/registers.md; fixed_degree_i  0: adaptive; 1, 2, 3: records of that
//                    degree, as long as they may be; LOG2_MAX = 12: one a span, as in the paper. Both are constant while
//                    spans are under way.
//   plan_o           main records of 2^log2 pixels and degree, and a last one of last_count pixels, which lies on the arc of
//                    2^last_log2, with last_degree
//
// Where kappa(2) > t3, all records are direct (degree 0, each pixel lit), of 4 pixels. The last record is direct if it has
// no more pixels than its polynomial has nodes; in the paper's form, up to 4. The others share nodes with their neighbours.
// The halvings of kappa until it is at most t3 are found by steps of 8, 4, 2, 1. Multipliers: those of shade_kappa.
// FOLD = 1: one span a clock. Latency LATENCY_PLANNER = 29 clocks. FOLD = 2 .. 8: one span in FOLD clocks, taken when phase_i
// is 0; phase_i counts 0 .. FOLD - 1. From FOLD = 3 on the latency is longer by FOLD, as that of shade_kappa.
// Example: 33 pixels, g = (1/128, 0, 0), n = 128: kappa = 4 -> 1 record of 16 pixels, one of 17, both of degree 3.
// Source: P1, section V (degrees by region), by a measure instead of by hand.
module shade_planner #(
  parameter int FOLD     = 1,
  parameter int LOG2_MAX = shade_pkg::RECORD_LOG2
) (
  input  logic                            clk_i,
  input  logic                            rst_i,
  input  logic [  shade_pkg::PHASE_W-1:0] phase_i,
  input  shade_pkg::step_t                normal_i,
  input  shade_pkg::step_t                increment_i,
  input  logic [  shade_pkg::COUNT_W-1:0] count_i,
  input  logic                            flat_i,
  input  shade_pkg::planner_t             planner_i,
  input  shade_pkg::vec_t                 h_i,
  input  logic [ shade_pkg::DEGREE_W-1:0] fixed_degree_i,
  output shade_pkg::plan_t                plan_o
);
  if (FOLD < 1 || FOLD > shade_pkg::FOLD_MAX) begin : g_check
    $error("shade_planner: FOLD must be in 1 .. 8");
  end
  if (LOG2_MAX < 4 || LOG2_MAX > shade_pkg::LOG2_MAX) begin : g_check_log2
    $error("shade_planner: LOG2_MAX must be in 4 .. 12");
  end

  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int KAPPA_W = shade_pkg::KAPPA_W;
  localparam int LOG2_W = shade_pkg::LOG2_W;
  localparam int DEGREE_W = shade_pkg::DEGREE_W;
  localparam int ARC_W = $clog2(LOG2_MAX + 1);
  localparam logic [ARC_W-1:0] LOG2_MIN = ARC_W'(shade_pkg::LOG2_MIN);

  // bits of a number: the smallest k with value < 2^k
  function automatic logic [LOG2_W-1:0] bits(input logic [COUNT_W-1:0] value);
    bits = '0;
    for (int i = 0; i < COUNT_W; i++) if (value[i]) bits = LOG2_W'(i + 1);
  endfunction

  // ---- the arc and its kappa -------------------------------------------------------------------------------------
  logic [COUNT_W-1:0] steps_q1, count_q20, count_q22;
  logic [LOG2_W-1:0] whole;
  logic [ARC_W-1:0] whole_q2, whole_q19;
  logic [KAPPA_W-1:0] arc, arc_q, kappa_q14, kappa_q15;
  logic [shade_pkg::WEIGHT_W-1:0] weight_q;
  logic flat_q14, flat_q27;
  always_ff @(posedge clk_i) begin
    steps_q1  <= count_i < COUNT_W'(2) ? '0 : count_i - COUNT_W'(2);
    whole_q2  <= whole > LOG2_W'(LOG2_MAX) ? ARC_W'(LOG2_MAX) : ARC_W'(whole);
    kappa_q15 <= flat_q14 || fixed_degree_i != '0 ? '0 : kappa_q14;
  end
  assign whole = bits(steps_q1);
  assign kappa_q14 = arc_q >> weight_q;
  always_ff @(posedge clk_i) arc_q <= arc;
  localparam int WAIT = FOLD < 3 ? 1 : FOLD + 1;  // for the weight, and where the units are folded
  shade_kappa #(.FOLD(FOLD)) u_kappa (
    .clk_i, .rst_i, .phase_i, .g_i(increment_i), .log2_i(LOG2_W'(whole_q2)), .planner_i, .kappa_o(arc)
  );
  shade_weight #(.FOLD(FOLD)) u_weight (
    .clk_i, .rst_i, .phase_i, .normal_i, .h_i, .kappa_i(arc), .planner_i, .weight_o(weight_q)
  );
  shade_ring #(.WIDTH(COUNT_W), .DEPTH(20 + WAIT)) u_count (.clk_i, .rst_i, .d_i(count_i), .q_o(count_q20));
  shade_delay #(.WIDTH(COUNT_W), .DEPTH(2)) u_count2 (.clk_i, .d_i(count_q20), .q_o(count_q22));
  shade_ring #(.WIDTH(ARC_W), .DEPTH(17 + WAIT)) u_whole (.clk_i, .rst_i, .d_i(whole_q2), .q_o(whole_q19));
  shade_delay #(.WIDTH(1), .DEPTH(14 + WAIT)) u_flat (.clk_i, .d_i(flat_i), .q_o(flat_q14));
  shade_delay #(.WIDTH(1), .DEPTH(13)) u_flat2 (.clk_i, .d_i(flat_q14), .q_o(flat_q27));

  // ---- halvings until kappa <= t3: 8, 4, 2, 1 more, where one less than these is not enough --------------------------
  logic [KAPPA_W-1:0] kappa_q19, kappa_q24;
  logic [3:0] halvings_q19;
  logic [4:0][KAPPA_W-1:0] ladder;
  assign ladder[0] = kappa_q15;
  assign kappa_q19 = ladder[4];
  for (genvar i = 0; i < 4; i++) begin : g_halve
    localparam int TIMES = 8 >> i;
    localparam bit NEEDED = TIMES <= LOG2_MAX - shade_pkg::LOG2_MIN + 1;  // one more than there is room for: direct
    logic [KAPPA_W-1:0] kappa, kappa_q;
    logic over, over_q;
    assign kappa = ladder[i];
    assign over  = NEEDED && kappa >> 2 * (TIMES - 1) > planner_i.t3;
    always_ff @(posedge clk_i) begin
      kappa_q <= over ? kappa >> 2 * TIMES : kappa;
      over_q  <= over;
    end
    assign ladder[i+1] = kappa_q;
    shade_delay #(.WIDTH(1), .DEPTH(3 - i)) u_over (.clk_i, .d_i(over_q), .q_o(halvings_q19[3-i]));
  end

  // ---- length and degree of the main records ---------------------------------------------------------------------
  logic [ARC_W-1:0] room, log2_q20, log2_q21, log2_q22, log2_q23;
  logic [DEGREE_W-1:0] degree_q21, degree_q27, degree_q28;
  logic direct_q20, direct_q21, direct_q22, direct_q27, linear_q20, quadratic_q20;
  assign room = whole_q19 > LOG2_MIN ? whole_q19 - LOG2_MIN : '0;
  always_ff @(posedge clk_i) begin
    direct_q20    <= halvings_q19 > 4'(room);
    log2_q20      <= whole_q19 - ARC_W'(halvings_q19);
    linear_q20    <= kappa_q19 <= planner_i.t1;
    quadratic_q20 <= kappa_q19 <= planner_i.t2;

    direct_q21 <= direct_q20;
    log2_q21   <= direct_q20 ? LOG2_MIN : log2_q20;
    if (direct_q20) degree_q21 <= DEGREE_W'(shade_pkg::DEGREE_DIRECT);
    else if (linear_q20) degree_q21 <= DEGREE_W'(shade_pkg::DEGREE_LINEAR);
    else if (quadratic_q20) degree_q21 <= DEGREE_W'(shade_pkg::DEGREE_QUADRATIC);
    else degree_q21 <= DEGREE_W'(shade_pkg::DEGREE_CUBIC);
  end

  // ---- how many there are, and what is left: a curved record may end on a pixel more, its last node ------------------
  // count - 1 = before + low for direct ones, count - 2 for others: the last arc has bits(low - 1) or bits(low)
  logic [COUNT_W-1:0] ends, before_q21, before_q22, low, low_q22, main_q22, main_q23, last_count_q23;
  logic [ARC_W-1:0] last_log2_q23;
  logic [ARC_W-3:0] fours_q21;
  logic [1:0] ones_q21, ones_q22, low2_q22;
  assign {fours_q21, ones_q21} = log2_q21;
  assign low2_q22 = 2'(low_q22);
  assign ends = COUNT_W'(direct_q20 ? 1 : 2);
  assign low  = before_q21 & ~({COUNT_W{1'b1}} << log2_q21);  // less than 2^LOG2_MAX
  always_ff @(posedge clk_i) begin
    before_q21 <= count_q20 < ends ? '0 : count_q20 - ends;

    before_q22 <= before_q21 & ~low;
    low_q22    <= low;
    main_q22   <= before_q21 >> {fours_q21, 2'b00};
    ones_q22   <= ones_q21;
    log2_q22   <= log2_q21;
    direct_q22 <= direct_q21;

    main_q23       <= main_q22 >> ones_q22;
    last_count_q23 <= count_q22 - before_q22;
    last_log2_q23  <= ARC_W'(bits(direct_q22 ? COUNT_W'({low2_q22 == 2'd3, low2_q22 == 2'd2}) : low_q22));
    log2_q23       <= log2_q22;
  end

  // ---- degree of the last record ---------------------------------------------------------------------------------
  logic [ARC_W-3:0] fours_q24;  // how many times shorter it is
  logic [1:0] ones_q24, ones_q25;
  logic [KAPPA_W-1:0] kappa_q25, kappa_q26;
  logic linear_q27, quadratic_q27;
  logic [DEGREE_W-1:0] last_degree_q28;
  logic [2:0] few_q24, few_q27;  // at most 4, 3, 2 pixels
  shade_delay #(.WIDTH(KAPPA_W), .DEPTH(5)) u_ladder (.clk_i, .d_i(kappa_q19), .q_o(kappa_q24));
  shade_delay #(.WIDTH(1), .DEPTH(5)) u_direct (.clk_i, .d_i(direct_q22), .q_o(direct_q27));
  shade_delay #(.WIDTH(3), .DEPTH(3)) u_few (.clk_i, .d_i(few_q24), .q_o(few_q27));
  always_ff @(posedge clk_i) begin
    {fours_q24, ones_q24} <= log2_q23 - last_log2_q23;
    for (int i = 0; i < 3; i++) few_q24[i] <= last_count_q23 <= COUNT_W'(i + 2);
    ones_q25      <= ones_q24;
    kappa_q25     <= kappa_q24 >> {fours_q24, 3'b000};
    kappa_q26     <= kappa_q25 >> {ones_q25, 1'b0};
    linear_q27    <= kappa_q26 <= planner_i.t1;
    quadratic_q27 <= kappa_q26 <= planner_i.t2;

    if (fixed_degree_i != '0 && !flat_q27) last_degree_q28 <= few_q27[2] ? '0 : fixed_degree_i;
    else if (direct_q27) last_degree_q28 <= '0;
    else if (linear_q27) last_degree_q28 <= few_q27[0] ? '0 : DEGREE_W'(shade_pkg::DEGREE_LINEAR);
    else if (quadratic_q27) last_degree_q28 <= few_q27[1] ? '0 : DEGREE_W'(shade_pkg::DEGREE_QUADRATIC);
    else last_degree_q28 <= few_q27[2] ? '0 : DEGREE_W'(shade_pkg::DEGREE_CUBIC);
  end

  logic [COUNT_W-1:0] main;
  localparam int REST_W = COUNT_W + ARC_W + COUNT_W + ARC_W;
  logic [ARC_W-1:0] log2, last_log2;
  shade_delay #(.WIDTH(REST_W), .DEPTH(5)) u_plan (
    .clk_i, .d_i({main_q23, log2_q23, last_count_q23, last_log2_q23}),
    .q_o({main, log2, plan_o.last_count, last_log2})
  );
  shade_delay #(.WIDTH(DEGREE_W), .DEPTH(6)) u_degree (.clk_i, .d_i(degree_q21), .q_o(degree_q27));
  always_ff @(posedge clk_i) degree_q28 <= fixed_degree_i != '0 && !flat_q27 ? fixed_degree_i : degree_q27;
  assign plan_o.degree      = degree_q28;
  assign plan_o.log2        = LOG2_W'(log2);
  assign plan_o.last_log2   = LOG2_W'(last_log2);
  assign plan_o.main        = main;
  assign plan_o.split       = main != '0;
  assign plan_o.last_degree = last_degree_q28;

  logic unused_threshold;
  assign unused_threshold = &{1'b0, planner_i};
endmodule
