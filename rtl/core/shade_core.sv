// SPDX-License-Identifier: Apache-2.0
// shade_core: the shading core: spans of interpolated normals in, shaded pixels out, settings and counters on AXI4-Lite.
//
//                           ┌─▶ shade_lane 0 ─▶ (shade_paint) ─▶ m_axis_pixel 0
//   s_axis_span ─▶ shade_door ─▶ shade_lane 1 ─▶ (shade_paint) ─▶ m_axis_pixel 1 ...
//                                   ▲      └─▶ shade_tally ─┐
//   s_axil ─▶ shade_registers ◀─────┴───────────────────────┘
//
//   s_axis_span   one beat a packet (tlast = 1, all of tkeep): SPAN packet, see rtl/README.md. BURST = 1: each beat is a span,
//                 whatever its tlast, as from a DMA that sets it at the end of a transfer
//   idle_o        no span is inside. irq_o: it became idle, or a span was faulty; high until CONTROL.clear is written
//   m_axis_pixel  LANES AXI4-Streams side by side, slice i of every port is stream i: tdata {specular, diffuse} U0.16,
//                 COLOUR = 1: {blue, green, red} or {0, specular, diffuse} by CONTROL.colour; tuser = tag; tlast = span's last
//   s_axil        AXI4-Lite, see docs/registers.md; settings can be written while no span is inside, and none enters
//                 while they change. CONTROL.clear, at any time, sets counters and STATUS to 0 and does nothing else
//
// A span goes to the lane that has least to draw: see shade_door. A lane gives its spans in order; the tag tells which they are. The door passes one span a clock to all lanes together.
// A faulty span (0 or more than 4096 pixels, a packet cut short or too long) is dropped: it sets a bit of STATUS, counts in
// ERRORS and costs a clock a beat; the next span is unharmed. Without faults every span gives its pixels in order.
// EVALUATOR: EVALUATOR_FDIFF (no multiplier at a pixel) or EVALUATOR_HORNER. FORM: FORM_REFINED or FORM_PAPER (of the
// coefficients, the third and the versine). REFLECT = 0, DIVIDE = 0, PATH_NORMALS = 0 leave models and a path out;
// FOLD = 2 .. 8 then shares multipliers, see shade_lane. LOG2_MAX: of records, see shade_planner.
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
  parameter int LOG2_MAX     = shade_pkg::RECORD_LOG2,
  parameter int COLOUR       = 0,
  parameter int BURST        = 0,
  parameter int DATA_W       = COLOUR == 1 ? shade_pkg::COLOUR_DATA_W : shade_pkg::PIXEL_DATA_W
) (
  input  logic                                clk_i,
  input  logic                                rst_i,
  input  logic                                s_axis_span_tvalid,
  output logic                                s_axis_span_tready,
  input  logic [  shade_pkg::SPAN_DATA_W-1:0] s_axis_span_tdata,
  input  logic [shade_pkg::SPAN_DATA_W/8-1:0] s_axis_span_tkeep,
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
  output logic [                         1:0] s_axil_rresp,
  output logic                                idle_o,
  output logic                                irq_o
);
  if (LANES != 1 && LANES != 2 && LANES != 4) begin : g_check_lanes
    $error("shade_core: LANES must be 1, 2 or 4");
  end
  if (COLOUR < 0 || COLOUR > 1 || DATA_W != (COLOUR == 1 ? shade_pkg::COLOUR_DATA_W : shade_pkg::PIXEL_DATA_W))
  begin : g_check_colour
    $error("shade_core: COLOUR must be 0 or 1, DATA_W is not to be set");
  end

  localparam int TAG_W = shade_pkg::TAG_W;
  shade_pkg::draw_t draw;
  shade_pkg::span_t span;
  shade_pkg::told_t told;
  shade_pkg::status_t events;
  shade_pkg::counts_t counts;
  logic change, busy, busy_q, clear;
  logic [LANES-1:0] enter, room, ready, given, lit;
  logic [LANES-1:0][shade_pkg::NODE_FLAGS_BITS-1:0] flags;

  shade_door #(.LANES(LANES), .PATH_NORMALS(PATH_NORMALS), .BURST(BURST)) u_door (
    .clk_i, .rst_i, .s_axis_span_tvalid, .s_axis_span_tready, .s_axis_span_tdata, .s_axis_span_tkeep,
    .s_axis_span_tlast, .draw_i(draw), .hold_i(change), .valid_o(enter), .room_i(room), .ready_i(ready),
    .given_i(given), .span_o(span), .busy_o(busy), .told_o(told)
  );

  // all lanes count together: what is folded takes an input in phase 0
  localparam int PHASE_W = shade_pkg::PHASE_W;
  logic [PHASE_W-1:0] phase_q;
  always_ff @(posedge clk_i) phase_q <= rst_i || phase_q == PHASE_W'(FOLD - 1) ? '0 : phase_q + PHASE_W'(1);

  for (genvar i = 0; i < LANES; i++) begin : g_lane
    // with several lanes a copy of the settings each, near where they are needed; no span enters sooner
    shade_pkg::draw_t own;
    if (LANES == 1) begin : g_same
      assign own = draw;
    end else begin : g_copy
      always_ff @(posedge clk_i) own <= draw;
    end

    logic valid, taken;
    shade_pkg::drawn_t drawn;
    shade_lane #(
      .EVALUATOR(EVALUATOR), .FORM(FORM), .REFLECT(REFLECT), .DIVIDE(DIVIDE), .PATH_NORMALS(PATH_NORMALS),
      .FOLD(FOLD), .LOG2_MAX(LOG2_MAX)
    ) u_lane (
      .clk_i, .rst_i, .phase_i(phase_q), .draw_i(own), .valid_i(enter[i]), .ready_o(ready[i]), .room_o(room[i]),
      .span_i(span), .valid_o(valid), .ready_i(taken), .drawn_o(drawn), .lit_o(lit[i]), .flags_o(flags[i])
    );
    if (COLOUR == 1) begin : g_paint
      shade_pkg::painted_t painted;
      shade_paint u_paint (
        .clk_i, .rst_i, .draw_i(own), .valid_i(valid), .ready_o(taken), .drawn_i(drawn),
        .valid_o(m_axis_pixel_tvalid[i]), .ready_i(m_axis_pixel_tready[i]), .painted_o(painted)
      );
      assign m_axis_pixel_tdata[i*DATA_W+:DATA_W] = painted.pixel;
      assign m_axis_pixel_tuser[i*TAG_W+:TAG_W]   = painted.tag;
      assign m_axis_pixel_tlast[i]                = painted.last;
    end else begin : g_plain
      assign taken                                = m_axis_pixel_tready[i];
      assign m_axis_pixel_tvalid[i]               = valid;
      assign m_axis_pixel_tdata[i*DATA_W+:DATA_W] = drawn.pixel;
      assign m_axis_pixel_tuser[i*TAG_W+:TAG_W]   = drawn.tag;
      assign m_axis_pixel_tlast[i]                = drawn.last;
    end
  end

  assign given = m_axis_pixel_tvalid & m_axis_pixel_tready;
  shade_tally #(.LANES(LANES)) u_tally (
    .clk_i, .rst_i, .given_i(given), .held_i(m_axis_pixel_tvalid & ~m_axis_pixel_tready), .lit_i(lit), .flags_i(flags),
    .told_i(told), .counts_o(counts), .events_o(events)
  );
  always_ff @(posedge clk_i) begin
    busy_q <= !rst_i && busy;  // a span is at the door or inside
    irq_o  <= !rst_i && ((irq_o && !clear) || (busy_q && !busy) || told.bad);
  end
  assign idle_o = !busy_q;

  shade_registers #(.DIVIDE(DIVIDE), .PATH_NORMALS(PATH_NORMALS), .COLOUR(COLOUR)) u_registers (
    .clk_i, .rst_i, .s_axil_awvalid, .s_axil_awready, .s_axil_awaddr, .s_axil_awprot, .s_axil_wvalid, .s_axil_wready,
    .s_axil_wdata, .s_axil_wstrb, .s_axil_bvalid, .s_axil_bready, .s_axil_bresp, .s_axil_arvalid, .s_axil_arready,
    .s_axil_araddr, .s_axil_arprot, .s_axil_rvalid, .s_axil_rready, .s_axil_rdata, .s_axil_rresp,
    .draw_o(draw), .change_o(change), .clear_o(clear), .busy_i(busy_q), .events_i(events), .counts_i(counts)
  );
endmodule
