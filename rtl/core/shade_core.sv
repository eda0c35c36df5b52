// shade_core: the shading core: spans of interpolated normals in, shaded pixels out, settings and counters on AXI4-Lite.
//
//                    ┌─▶ shade_lane 0 ─▶ (shade_paint) ─▶ m_axis_pixel 0
//   s_axis_span ─ deal ─▶ shade_lane 1 ─▶ (shade_paint) ─▶ m_axis_pixel 1 ...      good span i goes to lane i mod LANES
//                            ▲
//   s_axil ─▶ shade_registers
//
//   s_axis_span   one beat a packet (tlast = 1, all of tkeep): LINE packet, see rtl/README.md
//   m_axis_pixel  LANES AXI4-Streams side by side, slice i of every port is stream i: tdata {specular, diffuse} U0.16,
//                 COLOUR = 1: {blue, green, red} or {0, specular, diffuse} by CONTROL.colour; tuser = tag; tlast = span's last
//   s_axil        AXI4-Lite, see docs/registers.md; settings can be written while no span is inside, and none enters
//                 while they change. CONTROL.clear deals the next span to lane 0
//
// A faulty span (0 or more than 4096 pixels, a packet cut short or too long) is dropped: it sets a bit of STATUS, counts in
// ERRORS and costs a clock a beat; the next span is unharmed. Without faults every span gives its pixels in order.
// EVALUATOR: EVALUATOR_FDIFF (no multiplier at a pixel) or EVALUATOR_HORNER. FORM: FORM_REFINED or FORM_PAPER (of the
// coefficients, the third and the versine). REFLECT = 0, DIVIDE = 0, PATH_NORMALS = 0 leave models and a path out;
// FOLD = 6 then shares multipliers, see shade_lane.
// No combinational path from an input to an output port. One pixel a clock and lane where light keeps up: at most one
// node a clock and lane. Latency of a first pixel: LATENCY_CORE, COLOUR = 1: LATENCY_PAINT more. Source: P1 to P4.
// Example: after reset, normal (0, 0, 1), increment 0, 5 pixels -> five pixels of full diffuse light.
module shade_core #(
  parameter int LANES        = 1,
  parameter int EVALUATOR    = shade_pkg::EVALUATOR_FDIFF,
  parameter int FORM         = shade_pkg::FORM_REFINED,
  parameter int REFLECT      = 1,
  parameter int DIVIDE       = 1,
  parameter int PATH_NORMALS = 1,
  parameter int FOLD         = 1,
  parameter int COLOUR       = 0,
  parameter int DATA_W       = COLOUR == 1 ? shade_pkg::COLOUR_DATA_W : shade_pkg::PIXEL_DATA_W
) (
  input  logic                                clk_i,
  input  logic                                rst_i,
  input  logic                                s_axis_span_tvalid,
  output logic                                s_axis_span_tready,
  input  logic [  shade_pkg::LINE_DATA_W-1:0] s_axis_span_tdata,
  input  logic [shade_pkg::LINE_DATA_W/8-1:0] s_axis_span_tkeep,
  input  logic                                s_axis_span_tlast,
  output logic [                   LANES-1:0] m_axis_pixel_tvalid,
  input  logic [                   LANES-1:0] m_axis_pixel_tready,
  output logic [            LANES*DATA_W-1:0] m_axis_pixel_tdata,
  output logic [  LANES*shade_pkg::TAG_W-1:0] m_axis_pixel_tuser,
  output logic [                   LANES-1:0] m_axis_pixel_tlast,
  input  logic                                s_axil_awvalid,
  output logic                                s_axil_awready,
  input  logic [                        11:0] s_axil_awaddr,
  input  logic [                         2:0] s_axil_awprot,
  input  logic                                s_axil_wvalid,
  output logic                                s_axil_wready,
  input  logic [                        31:0] s_axil_wdata,
  input  logic [                         3:0] s_axil_wstrb,
  output logic                                s_axil_bvalid,
  input  logic                                s_axil_bready,
  output logic [                         1:0] s_axil_bresp,
  input  logic                                s_axil_arvalid,
  output logic                                s_axil_arready,
  input  logic [                        11:0] s_axil_araddr,
  input  logic [                         2:0] s_axil_arprot,
  output logic                                s_axil_rvalid,
  input  logic                                s_axil_rready,
  output logic [                        31:0] s_axil_rdata,
  output logic [                         1:0] s_axil_rresp
);
  if (LANES != 1 && LANES != 2 && LANES != 4) begin : g_check_lanes
    $error("shade_core: LANES must be 1, 2 or 4");
  end
  if (COLOUR < 0 || COLOUR > 1 || DATA_W != (COLOUR == 1 ? shade_pkg::COLOUR_DATA_W : shade_pkg::PIXEL_DATA_W))
  begin : g_check_colour
    $error("shade_core: COLOUR must be 0 or 1, DATA_W is not to be set");
  end

  localparam int COUNT_W = shade_pkg::COUNT_W;
  localparam int TAG_W = shade_pkg::TAG_W;
  localparam int PIXEL_W = shade_pkg::PIXEL_DATA_W;
  localparam int TURN_W = LANES > 2 ? 2 : 1;
  shade_pkg::draw_t draw;

  // ---- the door: what is faulty stays outside ---------------------------------------------------------------------
  logic [COUNT_W-1:0] count;
  logic inside_packet_q, change, clear, hold, take, whole, empty, long_span, good;
  logic door_valid_q, spare_valid_q, leave;
  logic [shade_pkg::LINE_DATA_W-1:0] door_q, spare_q;  // a good span on its way to its lane, and one behind it
  logic [LANES-1:0] ready;
  logic [TURN_W-1:0] turn_q;
  assign count              = s_axis_span_tdata[shade_pkg::LINE_COUNT_LSB+:COUNT_W];
  assign whole              = s_axis_span_tlast && !inside_packet_q && &s_axis_span_tkeep;
  assign empty              = count == '0;
  assign long_span          = count > COUNT_W'(shade_pkg::PIXELS_MAX);
  assign good               = whole && !empty && !long_span;
  assign hold               = change || clear;
  assign s_axis_span_tready = !spare_valid_q && !hold;  // a span sees one set of settings all its way
  assign leave              = ready[turn_q];
  assign take               = s_axis_span_tvalid && s_axis_span_tready;

  // faults of path normals that do not stop a span: see shade_pixel_normals
  logic normals, metric, threshold;
  assign normals   = PATH_NORMALS == 1 && draw.control.path == 1'(shade_pkg::PATH_NORMALS);
  assign metric    = normals && good && (count <= COUNT_W'(shade_pkg::METRIC_M_MIN) ||
                     count > COUNT_W'(shade_pkg::METRIC_M_MAX + 1)) &&
                     (draw.control.variant == shade_pkg::VARIANT_W'(shade_pkg::VARIANT_V1) ||
                      draw.control.variant == shade_pkg::VARIANT_W'(shade_pkg::VARIANT_V2));
  assign threshold = normals && good && (draw.planner.threshold < 0 || draw.planner.threshold > 18'sd65536);

  // what a beat is told by is looked at a clock after it was taken
  logic taken_q, begins_q, whole_q, good_q, few_q, many_q, metric_seen_q, threshold_seen_q;
  logic spans_q, errors_q, empty_q, long_q, packet_q, metric_q, threshold_q;
  always_ff @(posedge clk_i) begin
    if (!door_valid_q || leave) begin
      door_q        <= spare_valid_q ? spare_q : s_axis_span_tdata;
      door_valid_q  <= spare_valid_q || (take && good);
      spare_valid_q <= 1'b0;
    end else if (!spare_valid_q) begin
      spare_q       <= s_axis_span_tdata;
      spare_valid_q <= take && good;
    end
    if (door_valid_q && leave) turn_q <= turn_q == TURN_W'(LANES - 1) ? '0 : turn_q + TURN_W'(1);
    if (take) inside_packet_q <= !s_axis_span_tlast;
    taken_q          <= take;
    begins_q         <= !inside_packet_q;
    whole_q          <= whole;
    good_q           <= good;
    few_q            <= empty;
    many_q           <= long_span;
    metric_seen_q    <= metric;
    threshold_seen_q <= threshold;
    spans_q          <= taken_q && good_q;
    errors_q         <= taken_q && !good_q && begins_q;
    packet_q         <= taken_q && !whole_q && begins_q;
    empty_q          <= taken_q && whole_q && few_q;
    long_q           <= taken_q && whole_q && many_q;
    metric_q         <= taken_q && metric_seen_q;
    threshold_q      <= taken_q && threshold_seen_q;
    if (clear) turn_q <= '0;
    if (rst_i) begin
      door_valid_q    <= 1'b0;
      spare_valid_q   <= 1'b0;
      turn_q          <= '0;
      inside_packet_q <= 1'b0;
      taken_q         <= 1'b0;
      {spans_q, errors_q, packet_q, empty_q, long_q, metric_q, threshold_q} <= '0;
    end
  end

  // ---- lanes -------------------------------------------------------------------------------------------------
  logic [LANES-1:0] lit, out_q, stall_q, occupied;
  logic [LANES*shade_pkg::LANE_FLAGS_W-1:0] flags;
  for (genvar i = 0; i < LANES; i++) begin : g_lane
    logic enter, valid, last, taken;
    logic [PIXEL_W-1:0] pixel;
    logic [TAG_W-1:0] tag;
    assign enter = door_valid_q && turn_q == TURN_W'(i);
    shade_pkg::draw_t draw_q;  // a copy of the settings, near where they are needed; no span enters sooner
    always_ff @(posedge clk_i) draw_q <= draw;
    shade_lane #(
      .EVALUATOR(EVALUATOR), .FORM(FORM), .REFLECT(REFLECT), .DIVIDE(DIVIDE), .PATH_NORMALS(PATH_NORMALS),
      .FOLD(FOLD)
    ) u_lane (
      .clk_i, .rst_i, .draw_i(draw_q), .s_axis_span_tvalid(enter), .s_axis_span_tready(ready[i]),
      .s_axis_span_tdata(door_q),
      .m_axis_pixel_tvalid(valid), .m_axis_pixel_tready(taken), .m_axis_pixel_tdata(pixel),
      .m_axis_pixel_tuser(tag), .m_axis_pixel_tlast(last), .lit_o(lit[i]),
      .flags_o(flags[i*shade_pkg::LANE_FLAGS_W+:shade_pkg::LANE_FLAGS_W])
    );
    if (COLOUR == 1) begin : g_paint
      shade_paint u_paint (
        .clk_i, .rst_i, .draw_i(draw_q), .s_axis_pixel_tvalid(valid), .s_axis_pixel_tready(taken),
        .s_axis_pixel_tdata(pixel), .s_axis_pixel_tuser(tag), .s_axis_pixel_tlast(last),
        .m_axis_pixel_tvalid(m_axis_pixel_tvalid[i]), .m_axis_pixel_tready(m_axis_pixel_tready[i]),
        .m_axis_pixel_tdata(m_axis_pixel_tdata[i*DATA_W+:DATA_W]),
        .m_axis_pixel_tuser(m_axis_pixel_tuser[i*TAG_W+:TAG_W]), .m_axis_pixel_tlast(m_axis_pixel_tlast[i])
      );
    end else begin : g_plain
      assign m_axis_pixel_tvalid[i]                = valid;
      assign m_axis_pixel_tdata[i*DATA_W+:DATA_W]  = pixel;
      assign m_axis_pixel_tuser[i*TAG_W+:TAG_W]    = tag;
      assign m_axis_pixel_tlast[i]                 = last;
      assign taken                                 = m_axis_pixel_tready[i];
    end

    // spans inside, counted at the core's own ports
    logic [15:0] inside_q;
    logic in, out;
    assign occupied[i] = inside_q != '0;
    assign in  = enter && ready[i];
    assign out = m_axis_pixel_tvalid[i] && m_axis_pixel_tready[i];
    always_ff @(posedge clk_i) begin
      inside_q   <= inside_q + 16'(in) - 16'(out && m_axis_pixel_tlast[i]);
      out_q[i]   <= out;
      stall_q[i] <= m_axis_pixel_tvalid[i] && !m_axis_pixel_tready[i];
      if (rst_i) begin
        inside_q   <= '0;
        out_q[i]   <= 1'b0;
        stall_q[i] <= 1'b0;
      end
    end
  end

  // ---- settings, status and counters ---------------------------------------------------------------------------
  logic [shade_pkg::LANE_FLAGS_W-1:0] told_q;
  logic [2:0] pixels_q, stalls_q, evaluations_q;
  logic [shade_pkg::LANE_FLAGS_W-1:0] told;
  logic [2:0] pixels, stalls, evaluations;
  always_comb begin
    told        = '0;
    pixels      = '0;
    stalls      = '0;
    evaluations = '0;
    for (int i = 0; i < LANES; i++) begin
      if (lit[i]) told = told | flags[i*shade_pkg::LANE_FLAGS_W+:shade_pkg::LANE_FLAGS_W];
      pixels      = pixels + 3'(out_q[i]);
      stalls      = stalls + 3'(stall_q[i]);
      evaluations = evaluations + 3'(lit[i]);
    end
  end
  always_ff @(posedge clk_i) begin
    told_q        <= told;
    pixels_q      <= pixels;
    stalls_q      <= stalls;
    evaluations_q <= evaluations;
    if (rst_i) {told_q, pixels_q, stalls_q, evaluations_q} <= '0;
  end

  logic busy_q;  // a span is at the door or inside
  always_ff @(posedge clk_i) busy_q <= !rst_i && (|occupied || door_valid_q || spare_valid_q || (take && good));

  shade_pkg::status_t events;
  assign events.error.empty     = empty_q;
  assign events.error.too_long     = long_q;
  assign events.error.packet    = packet_q;
  assign events.error.metric    = metric_q;
  assign events.error.threshold = threshold_q;
  assign events.node.light.model     = told_q[shade_pkg::LIGHT_MODEL];
  assign events.node.light.range     = told_q[shade_pkg::LIGHT_RANGE];
  assign events.node.light.zero      = told_q[shade_pkg::LIGHT_ZERO];
  assign events.node.light.saturated = told_q[shade_pkg::LIGHT_SATURATED];
  assign events.node.normal_zero     = told_q[shade_pkg::LANE_NORMAL_ZERO];
  assign events.node.normal_short    = told_q[shade_pkg::LANE_NORMAL_SHORT];

  shade_registers u_registers (
    .clk_i, .rst_i, .s_axil_awvalid, .s_axil_awready, .s_axil_awaddr, .s_axil_awprot, .s_axil_wvalid, .s_axil_wready,
    .s_axil_wdata, .s_axil_wstrb, .s_axil_bvalid, .s_axil_bready, .s_axil_bresp, .s_axil_arvalid, .s_axil_arready,
    .s_axil_araddr, .s_axil_arprot, .s_axil_rvalid, .s_axil_rready, .s_axil_rdata, .s_axil_rresp,
    .draw_o(draw), .change_o(change), .clear_o(clear), .busy_i(busy_q),
    .events_i(events),
    .pixels_i(pixels_q), .spans_i({2'b00, spans_q}), .stalls_i(stalls_q), .evaluations_i(evaluations_q),
    .errors_i({2'b00, errors_q})
  );
endmodule
