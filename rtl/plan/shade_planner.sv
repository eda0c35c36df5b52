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
// A span passes three places, PACE clocks in each: kappa is quartered, a clock each, until it is at most t3; the records are
// counted; kappa is quartered to that of the last one. PACE = LOG2_MAX - 1, at least 4: as often as kappa can be quartered.
// One span in PACE clocks, taken when phase_i is 0; phase_i counts 0 .. PACE - 1. Three multipliers: two of shade_kappa, one of
// shade_weight. Latency LATENCY_PLANNER = 30 clocks, LOG2_MAX > 5: 3 more for each; plan_o stays for PACE clocks.
// Example: 33 pixels, g = (1/128, 0, 0), n = 128: kappa = 4 -> 1 record of 16 pixels, one of 17, both of degree 3.
// Source: P1, section V (degrees by region), by a measure instead of by hand.
module shade_planner #(
  parameter int LOG2_MAX = shade_pkg::RECORD_LOG2
) (
  input  logic                            clk_i,
  input  logic [   shade_pkg::LOG2_W-1:0] phase_i,
  input  shade_pkg::step_t                normal_i,
  input  shade_pkg::step_t                increment_i,
  input  logic [  shade_pkg::COUNT_W-1:0] count_i,
  input  logic                            flat_i,
  input  shade_pkg::planner_t             planner_i,
  input  shade_pkg::vec_t                 h_i,
  input  logic [ shade_pkg::DEGREE_W-1:0] fixed_degree_i,
  output shade_pkg::plan_t                plan_o
);
  if (LOG2_MAX < 4 || LOG2_MAX > shade_pkg::LOG2_MAX) begin : g_check
    $error("shade_planner: LOG2_MAX must be in 4 .. 12");
  end

  localparam int PACE = LOG2_MAX > 5 ? LOG2_MAX - 1 : 4;
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int KAPPA_W = shade_pkg::KAPPA_W;
  localparam int LOG2_W = shade_pkg::LOG2_W;
  localparam int DEGREE_W = shade_pkg::DEGREE_W;
  localparam int ARC_W = $clog2(LOG2_MAX + 1);
  localparam logic [ARC_W-1:0] LOG2_MIN = ARC_W'(shade_pkg::LOG2_MIN);
  localparam logic [ARC_W-1:0] ONE = ARC_W'(1);
  localparam logic [DEGREE_W-1:0] DIRECT = DEGREE_W'(shade_pkg::DEGREE_DIRECT);
  localparam logic [DEGREE_W-1:0] LINEAR = DEGREE_W'(shade_pkg::DEGREE_LINEAR);
  localparam logic [DEGREE_W-1:0] QUADRATIC = DEGREE_W'(shade_pkg::DEGREE_QUADRATIC);
  localparam logic [DEGREE_W-1:0] CUBIC = DEGREE_W'(shade_pkg::DEGREE_CUBIC);

  // bits of a number: the smallest k with value < 2^k
  function automatic logic [LOG2_W-1:0] bits(input logic [COUNT_W-1:0] value);
    bits = '0;
    for (int i = 0; i < COUNT_W; i++) if (value[i]) bits = LOG2_W'(i + 1);
  endfunction

  // ---- the arc and its kappa, weighed; a span comes in clock 0 ---------------------------------------------------------
  localparam int WEIGHED = shade_pkg::LATENCY_WEIGHT;  // the clock in which the weight is there
  logic load, next, flat_q1, flat, fixed;
  logic [COUNT_W-1:0] count_q1, count, steps_q2;
  logic [LOG2_W-1:0] bits_of;
  logic [ARC_W-1:0] whole_q3, whole;
  logic [KAPPA_W-1:0] arc;
  logic [shade_pkg::WEIGHT_W-1:0] weight;
  assign load    = phase_i == '0;
  assign next    = phase_i == LOG2_W'(WEIGHED % PACE);  // a span moves on to the next place
  assign bits_of = bits(steps_q2);
  assign fixed   = fixed_degree_i != '0;
  always_ff @(posedge clk_i) begin
    if (load) {count_q1, flat_q1} <= {count_i, flat_i};
    steps_q2 <= count_q1 < COUNT_W'(2) ? '0 : count_q1 - COUNT_W'(2);
    whole_q3 <= bits_of >= LOG2_W'(LOG2_MAX) ? ARC_W'(LOG2_MAX) : ARC_W'(bits_of);
  end
  shade_kappa #(.PACE(PACE)) u_kappa (
    .clk_i, .phase_i, .g_i(increment_i), .log2_i(LOG2_W'(whole_q3)), .planner_i, .kappa_o(arc)
  );
  shade_weight #(.PACE(PACE)) u_weight (
    .clk_i, .phase_i, .normal_i, .h_i, .kappa_i(arc), .planner_i, .weight_o(weight)
  );
  shade_hold #(.WIDTH(COUNT_W + 1 + ARC_W), .DEPTH(WEIGHED - 1), .FOLD(PACE)) u_span (
    .clk_i, .load_i(load), .d_i({count_q1, flat_q1, whole_q3}), .q_o({count, flat, whole})
  );

  // ---- first place: quartered until it is at most t3 -------------------------------------------------------------------
  logic [KAPPA_W-1:0] kappa_a, kappa_b, kappa_c;
  logic [COUNT_W-1:0] count_a, count_b;
  logic [ARC_W-1:0] log2_a, log2_b, log2_c;
  logic flat_a, flat_b, flat_c, over;
  assign over = planner_i.t3 < kappa_a;
  always_ff @(posedge clk_i) begin
    if (next) begin
      {count_a, flat_a, log2_a} <= {count, flat, whole};
      kappa_a                   <= flat || fixed ? '0 : arc >> weight;
    end else if (over && log2_a > LOG2_MIN) begin
      log2_a  <= log2_a - ONE;
      kappa_a <= kappa_a >> 2;
    end
  end

  // ---- second place: degree of the main records, how many there are, and what is left: a curved record may end on a pixel
  // more, its last node. count - 1 = before + low for direct ones, count - 2 for others: the last arc has bits(low - 1) or
  // bits(low)
  logic direct_b;
  logic [DEGREE_W-1:0] degree_q1;
  logic [COUNT_W-1:0] ends, before_q1, before_q2, low, low_q2, main_q2, main_q3, last_count_q3;
  logic [ARC_W-1:0] last_log2_q3;
  logic [ARC_W-3:0] fours;
  logic [1:0] ones, low2;
  assign ends          = COUNT_W'(direct_b ? 1 : 2);
  assign low           = before_q1 & ~({COUNT_W{1'b1}} << log2_b);  // less than 2^LOG2_MAX
  assign {fours, ones} = log2_b;
  assign low2          = 2'(low_q2);
  always_ff @(posedge clk_i) begin
    if (next) begin
      {kappa_b, count_b, flat_b, direct_b} <= {kappa_a, count_a, flat_a, over};
      log2_b                               <= over ? LOG2_MIN : log2_a;
    end
    if (fixed && !flat_b) degree_q1 <= fixed_degree_i;
    else if (direct_b) degree_q1 <= DIRECT;
    else if (!(planner_i.t1 < kappa_b)) degree_q1 <= LINEAR;
    else if (!(planner_i.t2 < kappa_b)) degree_q1 <= QUADRATIC;
    else degree_q1 <= CUBIC;

    before_q1     <= count_b < ends ? '0 : count_b - ends;
    before_q2     <= before_q1 & ~low;
    low_q2        <= low;
    main_q2       <= before_q1 >> {fours, 2'b00};
    main_q3       <= main_q2 >> ones;
    last_count_q3 <= count_b - before_q2;
    last_log2_q3  <= ARC_W'(bits(direct_b ? COUNT_W'({low2 == 2'd3, low2 == 2'd2}) : low_q2));
  end

  // ---- third place: kappa of the last record, which is so many times shorter, and its degree -----------------------------
  logic direct_c, most;
  logic [2:0] few_c;  // at most 4, 3, 2 pixels
  logic [ARC_W-1:0] shorter, left_c, last_log2_c;
  logic [COUNT_W-1:0] main_c, last_count_c;
  logic [DEGREE_W-1:0] degree_c, last_degree;
  assign shorter = log2_b - last_log2_q3;
  assign most    = shorter >= ARC_W'(PACE);  // a time more than there are clocks
  always_ff @(posedge clk_i) begin
    if (next) begin
      {log2_c, flat_c, direct_c, degree_c}  <= {log2_b, flat_b, direct_b, degree_q1};
      {main_c, last_count_c, last_log2_c}   <= {main_q3, last_count_q3, last_log2_q3};
      kappa_c                               <= most ? kappa_b >> 2 : kappa_b;
      left_c                                <= shorter - ARC_W'(most);
      for (int i = 0; i < 3; i++) few_c[i] <= last_count_q3 < COUNT_W'(i + 3);
    end else if (left_c != '0) begin
      kappa_c <= kappa_c >> 2;
      left_c  <= left_c - ONE;
    end
  end
  always_comb begin
    if (fixed && !flat_c) last_degree = few_c[2] ? DIRECT : fixed_degree_i;
    else if (direct_c) last_degree = DIRECT;
    else if (!(planner_i.t1 < kappa_c)) last_degree = few_c[0] ? DIRECT : LINEAR;
    else if (!(planner_i.t2 < kappa_c)) last_degree = few_c[1] ? DIRECT : QUADRATIC;
    else last_degree = few_c[2] ? DIRECT : CUBIC;
  end

  always_ff @(posedge clk_i) begin
    if (next) begin
      plan_o.main        <= main_c;
      plan_o.split       <= main_c != '0;
      plan_o.log2        <= LOG2_W'(log2_c);
      plan_o.degree      <= degree_c;
      plan_o.last_count  <= last_count_c;
      plan_o.last_log2   <= LOG2_W'(last_log2_c);
      plan_o.last_degree <= last_degree;
    end
  end

  logic unused_threshold;
  assign unused_threshold = &{1'b0, planner_i};
endmodule
