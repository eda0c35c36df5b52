// shade_lane: spans of interpolated normals in, shaded pixels out, one a clock: the whole way of the data, without a bus.
//
//   span ─┬─▶ shade_planner ─▶ plans ─┐
//         └─▶ shade_fifo ── spans ────┴▶ shade_node_walk ─▶ shade_unit ─┐
//                                                                       ├─▶ shade_light ─▶ shade_collect ─▶ shade_fifo ─┐
//         or, path normals: shade_pixel_normals ────────────────────────┘                                               │
//                                                      m_axis_pixel ◀── shade_poly_span ◀── records ────────────────────┘
//
//   s_axis_span    LINE packet: normal and increment, S2.29; 1 .. 4096 pixels (the caller's duty); tag; P2's flat bit
//   m_axis_pixel   tdata = {specular, diffuse}, U0.16; tuser = tag; tlast = last pixel of the span
//   draw_i         settings of the draw call, see docs/registers.md; must not change while a span is inside
//   lit_o          light of a node, or of a pixel, is done; flags_o: bits LIGHT_*, LANE_* of it
//
// Nodes are prepared while earlier pixels are drawn. Every pipeline keeps going: what enters one has a credit for its place
// in the FIFO behind it. No combinational path leads from an input to an output.
// PATH_NORMALS = 0 leaves out shade_pixel_normals; EVALUATOR, FORM, REFLECT, DIVIDE: see shade_poly_span, shade_light.
// FOLD = 6: planner, normals and light with one multiplier each for what takes three or more otherwise: a span and a node in
// six clocks; REFLECT, DIVIDE and PATH_NORMALS must be 0. The same pixels.
// Latency, an empty lane: LATENCY_LANE clocks from a span of 1 pixel to its pixel (EVALUATOR_FDIFF, REFLECT = 1).
// One pixel a clock where a span has no more nodes than pixels. Source: P1, P4.
// Example: normal (0, 0, 1), increment 0, 5 pixels, light from the viewer -> five pixels of full intensity.
module shade_lane #(
  parameter int EVALUATOR    = shade_pkg::EVALUATOR_FDIFF,
  parameter int FORM         = shade_pkg::FORM_REFINED,
  parameter int REFLECT      = 1,
  parameter int DIVIDE       = 1,
  parameter int PATH_NORMALS = 1,
  parameter int FOLD         = 1
) (
  input  logic                               clk_i,
  input  logic                               rst_i,
  input  shade_pkg::draw_t                   draw_i,
  input  logic                               s_axis_span_tvalid,
  output logic                               s_axis_span_tready,
  input  logic [ shade_pkg::LINE_DATA_W-1:0] s_axis_span_tdata,
  output logic                               m_axis_pixel_tvalid,
  input  logic                               m_axis_pixel_tready,
  output logic [shade_pkg::PIXEL_DATA_W-1:0] m_axis_pixel_tdata,
  output logic [       shade_pkg::TAG_W-1:0] m_axis_pixel_tuser,
  output logic                               m_axis_pixel_tlast,
  output logic                               lit_o,
  output logic [shade_pkg::LANE_FLAGS_W-1:0] flags_o
);
  if (PATH_NORMALS < 0 || PATH_NORMALS > 1) begin : g_check
    $error("shade_lane: PATH_NORMALS must be 0 or 1");
  end
  if (FOLD != 1 && (FOLD != 6 || REFLECT != 0 || DIVIDE != 0 || PATH_NORMALS != 0)) begin : g_check_fold
    $error("shade_lane: FOLD must be 1, or 6 with REFLECT, DIVIDE and PATH_NORMALS 0");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int STEP_W = shade_pkg::STEP_W;
  localparam int STEPS_W = 3 * STEP_W;
  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int DEGREE_W = shade_pkg::DEGREE_W;
  localparam int TAG_W = shade_pkg::TAG_W;
  localparam int LOG2_W = shade_pkg::LOG2_W;
  localparam int SPAN_LOG2 = shade_pkg::SPAN_FIFO_LOG2;
  localparam int RECORD_LOG2 = shade_pkg::RECORD_FIFO_LOG2;

  // ---- spans, beside their plans -------------------------------------------------------------------------------
  logic normals, accept, some_place_q, plan_ready;
  logic [SPAN_LOG2:0] place_q, place_d;
  logic span_taken;
  assign normals = PATH_NORMALS == 1 && draw_i.control.path == 1'(shade_pkg::PATH_NORMALS);
  assign accept  = s_axis_span_tvalid && some_place_q && plan_ready && !normals;
  assign place_d = place_q + (SPAN_LOG2 + 1)'(span_taken) - (SPAN_LOG2 + 1)'(accept);
  always_ff @(posedge clk_i) begin
    place_q      <= place_d;
    some_place_q <= place_d != '0;
    if (rst_i) begin
      place_q      <= (SPAN_LOG2 + 1)'(1 << SPAN_LOG2);
      some_place_q <= 1'b1;
    end
  end

  logic [COUNT_W-1:0] count;
  logic flat;
  assign count = s_axis_span_tdata[shade_pkg::LINE_COUNT_LSB+:COUNT_W];
  // P2: only diffuse light can do without unit normals
  assign flat  = s_axis_span_tdata[shade_pkg::LINE_FLAT] && draw_i.material.model == '0;

  localparam int SPAN_W = STEPS_W + STEPS_W + 1 + TAG_W;
  logic span_valid, plan_valid, walk_ready, pop;
  logic [SPAN_W-1:0] span;
  assign pop = walk_ready && plan_valid;  // a plan comes later than its span
  shade_fifo #(.WIDTH(SPAN_W), .LOG2(SPAN_LOG2), .BLOCK(1)) u_spans (
    .clk_i, .rst_i, .valid_i(accept),
    .data_i({s_axis_span_tdata[2*STEPS_W-1:0], flat, s_axis_span_tdata[shade_pkg::LINE_TAG_LSB+:TAG_W]}),
    .valid_o(span_valid), .ready_i(pop), .data_o(span), .taken_o(span_taken)
  );

  localparam int PLAN_W = 1 + COUNT_W + LOG2_W + DEGREE_W + COUNT_W + LOG2_W + DEGREE_W;
  logic planned, split;
  logic [COUNT_W-1:0] main, last_count;
  logic [LOG2_W-1:0] log2, last_log2;
  logic [DEGREE_W-1:0] degree, last_degree;
  logic [PLAN_W-1:0] plan;
  shade_planner #(.FOLD(FOLD)) u_planner (
    .clk_i, .rst_i, .valid_i(accept), .ready_o(plan_ready), .gx_i(s_axis_span_tdata[STEPS_W+:STEP_W]),
    .gy_i(s_axis_span_tdata[STEPS_W+STEP_W+:STEP_W]), .gz_i(s_axis_span_tdata[STEPS_W+2*STEP_W+:STEP_W]),
    .count_i(count), .flat_i(flat),
    .t1_i(draw_i.planner.t1), .t2_i(draw_i.planner.t2), .t3_i(draw_i.planner.t3), .mantissa_i(draw_i.planner.sharpness),
    .exponent_i(draw_i.planner.sharpness_exp), .fixed_degree_i(draw_i.control.fixed_degree), .valid_o(planned), .main_o(main),
    .log2_o(log2), .degree_o(degree), .last_count_o(last_count), .last_log2_o(last_log2), .last_degree_o(last_degree)
  );
  assign split = main != '0;
  shade_fifo #(.WIDTH(PLAN_W), .LOG2(SPAN_LOG2), .BLOCK(1)) u_plans (
    .clk_i, .rst_i, .valid_i(planned), .data_i({split, main, log2, degree, last_count, last_log2, last_degree}),
    .valid_o(plan_valid), .ready_i(pop), .data_o(plan), .taken_o()
  );

  // ---- nodes -------------------------------------------------------------------------------------------------
  localparam int META_W = 2 + 1 + 1 + COUNT_W + DEGREE_W + 1 + TAG_W;
  logic node_valid, node_flat, shared, last, more, record_taken;
  logic [1:0] slot;
  logic [COUNT_W-1:0] node_count;
  logic [DEGREE_W-1:0] node_degree;
  logic [TAG_W-1:0] node_tag;
  logic signed [W-1:0] vx, vy, vz;
  shade_node_walk #(.CREDIT_LOG2(RECORD_LOG2), .PACE(FOLD)) u_walk (
    .clk_i, .rst_i, .valid_i(span_valid && plan_valid), .ready_o(walk_ready), .g_i(span[TAG_W+1+STEPS_W+:STEPS_W]),
    .n_i(span[TAG_W+1+:STEPS_W]), .split_i(plan[PLAN_W-1]), .main_i(plan[PLAN_W-2-:COUNT_W]),
    .log2_i(plan[COUNT_W+LOG2_W+2*DEGREE_W+:LOG2_W]), .degree_i(plan[COUNT_W+LOG2_W+DEGREE_W+:DEGREE_W]),
    .last_count_i(plan[LOG2_W+DEGREE_W+:COUNT_W]), .last_log2_i(plan[DEGREE_W+:LOG2_W]),
    .last_degree_i(plan[DEGREE_W-1:0]), .flat_i(span[TAG_W]), .tag_i(span[TAG_W-1:0]),
    .credit_i(record_taken && !normals), .valid_o(node_valid), .x_o(vx), .y_o(vy), .z_o(vz), .slot_o(slot), .first_o(),
    .shared_o(shared), .last_o(last), .count_o(node_count), .degree_o(node_degree), .more_o(more), .flat_o(node_flat),
    .tag_o(node_tag)
  );

  logic unit_valid, zero, short_v;
  logic signed [W-1:0] ux, uy, uz;
  shade_unit #(.FOLD(FOLD)) u_unit (
    .clk_i, .rst_i, .valid_i(node_valid), .ready_o(), .bypass_i(node_flat), .x_i(vx), .y_i(vy), .z_i(vz),
    .valid_o(unit_valid), .x_o(ux), .y_o(uy), .z_o(uz), .zero_o(zero), .short_o(short_v)
  );

  // ---- or the normal of every pixel: each a record of its own -----------------------------------------------------
  logic pixel_valid, pixel_ready, pixel_last, line_ready;
  logic [3*W-1:0] pixel;
  logic [TAG_W-1:0] pixel_tag;
  if (PATH_NORMALS == 1) begin : g_normals
    logic [RECORD_LOG2:0] credit_q, credit_d;
    logic [shade_pkg::NORMAL_DATA_W-1:0] data;
    assign pixel    = data[3*W-1:0];
    assign credit_d = credit_q + (RECORD_LOG2 + 1)'(record_taken && normals)
                    - (RECORD_LOG2 + 1)'(pixel_valid && pixel_ready);
    always_ff @(posedge clk_i) begin
      credit_q    <= credit_d;
      pixel_ready <= credit_d != '0;
      if (rst_i) begin
        credit_q    <= (RECORD_LOG2 + 1)'(1 << RECORD_LOG2);
        pixel_ready <= 1'b0;
      end
    end
    shade_pixel_normals u_normals (
      .clk_i, .rst_i, .variant_i(draw_i.control.variant), .threshold_i(draw_i.planner.threshold),
      .s_axis_line_tvalid(s_axis_span_tvalid && normals), .s_axis_line_tready(line_ready),
      .s_axis_line_tdata(s_axis_span_tdata), .m_axis_normal_tvalid(pixel_valid), .m_axis_normal_tready(pixel_ready),
      .m_axis_normal_tdata(data), .m_axis_normal_tuser(pixel_tag), .m_axis_normal_tlast(pixel_last),
      .error_o(), .error_count_o()
    );
    logic unused_data;
    assign unused_data = &{1'b0, data};
  end else begin : g_nodes_only
    assign pixel_valid = 1'b0;
    assign pixel_ready = 1'b0;
    assign pixel_last  = 1'b0;
    assign line_ready  = 1'b0;
    assign pixel       = (3 * W)'(0);
    assign pixel_tag   = TAG_W'(0);
  end
  assign s_axis_span_tready = normals ? line_ready : some_place_q && plan_ready;

  // ---- light -------------------------------------------------------------------------------------------------
  logic dark_valid;  // a unit normal, without its light yet
  logic [3*W-1:0] normal;
  logic [1:0] fault_q, fault;
  always_ff @(posedge clk_i) begin
    normal     <= normals ? pixel : {uz, uy, ux};
    fault_q    <= normals ? 2'b00 : {short_v, zero};
    dark_valid <= normals ? pixel_valid && pixel_ready : unit_valid;
    if (rst_i) dark_valid <= 1'b0;
  end

  logic signed [W-1:0] diffuse, specular;
  logic [shade_pkg::LIGHT_FLAGS_W-1:0] light_flags;
  if (FOLD == 1) begin : g_light
    shade_light #(.FORM(FORM), .REFLECT(REFLECT), .DIVIDE(DIVIDE)) u_light (
      .clk_i, .rst_i, .model_i(draw_i.material.model), .cosine_i(draw_i.material.cosine), .k1_i(draw_i.material.k1), .k2_i(draw_i.material.k2),
      .shift_i(draw_i.material.shift), .xmax_i(draw_i.material.xmax), .power_i(draw_i.material.power), .inv_n_i(draw_i.material.inv_n),
      .inv_n_exp_i(draw_i.material.inv_n_exp), .gain_i(draw_i.material.gain), .gain_exp_i(draw_i.material.gain_exp),
      .lx_i(draw_i.light.l.x), .ly_i(draw_i.light.l.y), .lz_i(draw_i.light.l.z), .hx_i(draw_i.light.h.x), .hy_i(draw_i.light.h.y), .hz_i(draw_i.light.h.z),
      .vh_i(draw_i.light.vh), .valid_i(dark_valid), .nx_i(normal[0+:W]), .ny_i(normal[W+:W]), .nz_i(normal[2*W+:W]),
      .valid_o(lit_o), .diffuse_o(diffuse), .specular_o(specular), .flags_o(light_flags)
    );
    localparam int LATENCY = shade_pkg::LATENCY_LIGHT - (REFLECT == 1 ? 0 : shade_pkg::LATENCY_REFLECT);
    shade_ring #(.WIDTH(2), .DEPTH(LATENCY)) u_fault (.clk_i, .rst_i, .d_i(fault_q), .q_o(fault));
  end else begin : g_folded
    // the normal comes LATENCY_UNIT_FOLDED + 1 clocks behind a phase 0 and waits for the next one
    localparam int TURN = (shade_pkg::LATENCY_UNIT_FOLDED + 1) % FOLD;
    localparam int WAIT = TURN == 0 ? 0 : FOLD - TURN;
    logic valid;
    logic [3*W-1:0] n;
    shade_delay #(.WIDTH(3 * W), .DEPTH(WAIT)) u_wait (.clk_i, .d_i(normal), .q_o(n));
    if (WAIT == 0) begin : g_now
      assign valid = dark_valid;
    end else begin : g_later
      shade_valid #(.DEPTH(WAIT)) u_valid (.clk_i, .rst_i, .valid_i(dark_valid), .valid_o(valid));
    end
    shade_light_folded #(.FORM(FORM)) u_light (
      .clk_i, .rst_i, .model_i(draw_i.material.model), .cosine_i(draw_i.material.cosine), .k1_i(draw_i.material.k1), .k2_i(draw_i.material.k2),
      .shift_i(draw_i.material.shift), .xmax_i(draw_i.material.xmax), .power_i(draw_i.material.power), .gain_i(draw_i.material.gain),
      .gain_exp_i(draw_i.material.gain_exp),
      .lx_i(draw_i.light.l.x), .ly_i(draw_i.light.l.y), .lz_i(draw_i.light.l.z), .hx_i(draw_i.light.h.x), .hy_i(draw_i.light.h.y), .hz_i(draw_i.light.h.z),
      .valid_i(valid), .ready_o(), .nx_i(n[0+:W]), .ny_i(n[W+:W]), .nz_i(n[2*W+:W]),
      .valid_o(lit_o), .diffuse_o(diffuse), .specular_o(specular), .flags_o(light_flags)
    );
    shade_delay #(.WIDTH(2), .DEPTH(WAIT + shade_pkg::LATENCY_LIGHT_FOLDED)) u_fault (
      .clk_i, .d_i(fault_q), .q_o(fault)
    );
  end
  assign flags_o = {fault, light_flags};

  // what a node is to its record waits in a FIFO: cheaper than a register for every clock of the way
  logic meta_valid;
  logic [META_W-1:0] meta, meta_in;
  assign meta_in = normals
    ? {2'd0, 1'b0, 1'b1, COUNT_W'(1), DEGREE_W'(shade_pkg::DEGREE_DIRECT), !pixel_last, pixel_tag}
    : {slot, shared, last, node_count, node_degree, more, node_tag};
  shade_fifo #(.WIDTH(META_W), .LOG2(RECORD_LOG2), .BLOCK(1)) u_meta (
    .clk_i, .rst_i, .valid_i(normals ? pixel_valid && pixel_ready : node_valid), .data_i(meta_in),
    .valid_o(meta_valid), .ready_i(lit_o), .data_o(meta), .taken_o()
  );

  // ---- records and their pixels --------------------------------------------------------------------------------
  logic record_valid, waiting, record_ready;
  logic [shade_pkg::SPAN_DATA_W-1:0] record, next;
  shade_collect u_collect (
    .clk_i, .rst_i, .valid_i(lit_o), .diffuse_i(diffuse), .specular_i(specular),
    .slot_i(meta[META_W-1-:2]), .shared_i(meta[META_W-3]), .last_i(meta[META_W-4]),
    .count_i(meta[TAG_W+1+DEGREE_W+:COUNT_W]), .degree_i(meta[TAG_W+1+:DEGREE_W]), .more_i(meta[TAG_W]),
    .tag_i(meta[TAG_W-1:0]), .valid_o(record_valid), .record_o(record)
  );
  shade_fifo #(.WIDTH(shade_pkg::SPAN_DATA_W), .LOG2(RECORD_LOG2), .BLOCK(1)) u_records (
    .clk_i, .rst_i, .valid_i(record_valid), .data_i(record), .valid_o(waiting), .ready_i(record_ready),
    .data_o(next), .taken_o(record_taken)
  );
  shade_poly_span #(.EVALUATOR(EVALUATOR), .FORM(FORM)) u_poly (
    .clk_i, .rst_i, .s_axis_span_tvalid(waiting), .s_axis_span_tready(record_ready), .s_axis_span_tdata(next),
    .m_axis_pixel_tvalid, .m_axis_pixel_tready, .m_axis_pixel_tdata, .m_axis_pixel_tuser, .m_axis_pixel_tlast,
    .error_o(), .error_count_o()
  );

  logic unused_rest;  // of the settings those of shade_paint
  assign unused_rest = &{1'b0, meta_valid, draw_i};
endmodule
