// SPDX-License-Identifier: Apache-2.0
// shade_lane: spans of interpolated normals in, shaded pixels out, one a clock: the whole way of the data, without a bus.
//
//   span ─▶ shade_line ─────────── normals at nodes ──┐
//   or, CONTROL.path = 1:                             ├─▶ shade_light ─▶ shade_collect ─▶ shade_fifo ─▶ shade_poly_span ─▶ pixel
//   span ─▶ shade_pixel_points ─── of all pixels ─────┘        records of light
//
//   span_i    1 .. 4096 pixels (the caller's duty); taken when valid_i and ready_o are 1; room_o: there is a place for one
//   draw_i    settings of the draw call, see docs/registers.md; must not change while a span is inside
//   drawn_o   pixel, tag and end of its span; given when valid_o and ready_i are 1
//   lit_o     light of a node, or of a pixel, is done; flags_o tells of it
//
// Both producers give the same: a place in a record, early, and a unit normal. A further one needs the same three wires.
// Nodes are prepared while earlier pixels are drawn. Every pipeline keeps going: what enters one has a credit for its place
// in the FIFO behind it. No path leads from an input to an output.
// PATH_NORMALS = 0 leaves out shade_pixel_points; REFLECT, DIVIDE: see shade_light. EVALUATOR_FDIFF in FORM_REFINED:
// shade_poly_line; otherwise shade_poly_span.
// FOLD = 2 .. 8: normals and light share multipliers: a node in FOLD clocks; phase_i counts 0 .. FOLD - 1;
// REFLECT, DIVIDE and PATH_NORMALS must be 0. The same pixels.
// Latency, an empty lane: LATENCY_LANE clocks from a span of 1 pixel to its pixel (EVALUATOR_FDIFF, REFLECT = 1).
// One pixel a clock where a span has no more nodes than pixels. Source: P1, P4.
// Example: normal (0, 0, 1), increment 0, 5 pixels, light from the viewer -> five pixels of full intensity.
module shade_lane #(
  parameter int EVALUATOR    = shade_pkg::EVALUATOR_FDIFF,
  parameter int FORM         = shade_pkg::FORM_REFINED,
  parameter int REFLECT      = 1,
  parameter int DIVIDE       = 1,
  parameter int PATH_NORMALS = 1,
  parameter int FOLD         = 1,
  parameter int LOG2_MAX     = shade_pkg::RECORD_LOG2
) (
  input  logic                   clk_i,
  input  logic                   rst_i,
  input  logic [shade_pkg::PHASE_W-1:0] phase_i,
  input  shade_pkg::draw_t       draw_i,
  input  logic                   valid_i,
  output logic                   ready_o,
  output logic                   room_o,
  input  shade_pkg::span_t       span_i,
  output logic                   valid_o,
  input  logic                   ready_i,
  output shade_pkg::drawn_t      drawn_o,
  output logic                   lit_o,
  output shade_pkg::node_flags_t flags_o
);
  if (PATH_NORMALS < 0 || PATH_NORMALS > 1 || FOLD < 1 || FOLD > 8 || (FOLD > 1 && PATH_NORMALS != 0)) begin : g_check
    $error("shade_lane: PATH_NORMALS must be 0 or 1, FOLD in 1 .. 8, beyond 1 with REFLECT, DIVIDE and PATH_NORMALS 0");
  end

  // ---- points: a place in a record, and a unit normal ---------------------------------------------------------------
  logic pixels, record_taken, line_ready, line_room, node, lined, pixel_ready, pixel;
  shade_pkg::place_t node_place, pixel_place;
  shade_pkg::unit_t unit;
  shade_pkg::vec_t pixel_normal;
  assign pixels  = PATH_NORMALS == 1 && draw_i.control.path == 1'(shade_pkg::PATH_NORMALS);
  assign ready_o = pixels ? pixel_ready : line_ready;
  assign room_o  = pixels ? pixel_ready : line_room;
  shade_line #(.FOLD(FOLD), .LOG2_MAX(LOG2_MAX)) u_line (
    .clk_i, .rst_i, .phase_i, .draw_i, .valid_i(valid_i && !pixels), .ready_o(line_ready),
    .room_o(line_room), .span_i, .credit_i(record_taken && !pixels), .place_valid_o(node), .place_o(node_place), .valid_o(lined),
    .unit_o(unit)
  );
  if (PATH_NORMALS == 1) begin : g_pixels
    shade_pixel_points u_pixels (
      .clk_i, .rst_i, .draw_i, .valid_i(valid_i && pixels), .ready_o(pixel_ready), .span_i,
      .credit_i(record_taken && pixels), .valid_o(pixel), .place_o(pixel_place), .normal_o(pixel_normal)
    );
  end else begin : g_nodes_only
    assign {pixel_ready, pixel} = 2'b00;
    assign pixel_place          = '0;
    assign pixel_normal         = '0;
  end

  // a place waits in a FIFO for the light: cheaper than a register for every clock of the way
  shade_pkg::place_t place;
  logic placed, unused_taken;
  shade_fifo #(.WIDTH($bits(place)), .LOG2(shade_pkg::RECORD_FIFO_LOG2), .BLOCK(1)) u_places (
    .clk_i, .rst_i, .valid_i(pixels ? pixel : node), .data_i(pixels ? pixel_place : node_place), .valid_o(placed),
    .ready_i(lit_o), .data_o(place), .taken_o(unused_taken)
  );

  // ---- light, records, pixels ------------------------------------------------------------------------------------
  logic dark_q;
  shade_pkg::vec_t normal_q;
  logic [1:0] fault_q;
  always_ff @(posedge clk_i) begin
    normal_q <= pixels ? pixel_normal : unit.normal;
    fault_q  <= pixels ? 2'b00 : {unit.too_short, unit.zero};
    dark_q   <= !rst_i && (pixels ? pixel : lined);
  end
  shade_pkg::intensity_t light;
  // a folded light takes normals in the phase in which they come
  localparam int TO_LIGHT = (FOLD < 3 ? shade_pkg::LATENCY_UNIT : shade_pkg::LATENCY_UNIT_FOLDED) + 1;
  localparam int LIGHT = FOLD > 1 ? shade_pkg::LATENCY_LIGHT_FOLDED + (FOLD == 5 ? 5 : 0)
                       : shade_pkg::LATENCY_LIGHT - (REFLECT == 1 ? 0 : shade_pkg::LATENCY_REFLECT);
  shade_light #(.FORM(FORM), .REFLECT(REFLECT), .DIVIDE(DIVIDE), .FOLD(FOLD), .TAKE(TO_LIGHT % FOLD)) u_light (
    .clk_i, .rst_i, .phase_i, .material_i(draw_i.material), .light_i(draw_i.light), .valid_i(dark_q), .n_i(normal_q),
    .valid_o(lit_o), .light_o(light), .flags_o(flags_o.light)
  );
  shade_ring #(.WIDTH(2), .DEPTH(LIGHT)) u_fault (
    .clk_i, .rst_i, .d_i(fault_q), .q_o({flags_o.normal_short, flags_o.normal_zero})
  );

  logic complete, waiting, record_ready;
  shade_pkg::record_t record, next;
  shade_collect u_collect (
    .clk_i, .rst_i, .valid_i(lit_o), .light_i(light), .place_i(place), .valid_o(complete), .record_o(record)
  );
  shade_fifo #(.WIDTH($bits(record)), .LOG2(shade_pkg::RECORD_FIFO_LOG2), .BLOCK(1)) u_records (
    .clk_i, .rst_i, .valid_i(complete), .data_i(record), .valid_o(waiting), .ready_i(record_ready), .data_o(next),
    .taken_o(record_taken)
  );
  if (EVALUATOR == shade_pkg::EVALUATOR_FDIFF && FORM == shade_pkg::FORM_REFINED) begin : g_line
    shade_poly_line #(.LOG2_MAX(LOG2_MAX)) u_poly (
      .clk_i, .rst_i, .s_axis_span_tvalid(waiting), .s_axis_span_tready(record_ready), .s_axis_span_tdata(next),
      .m_axis_pixel_tvalid(valid_o), .m_axis_pixel_tready(ready_i), .m_axis_pixel_tdata(drawn_o.pixel),
      .m_axis_pixel_tuser(drawn_o.tag), .m_axis_pixel_tlast(drawn_o.last)
    );
  end else begin : g_span
    shade_poly_span #(.EVALUATOR(EVALUATOR), .FORM(FORM)) u_poly (
      .clk_i, .rst_i, .s_axis_span_tvalid(waiting), .s_axis_span_tready(record_ready), .s_axis_span_tdata(next),
      .m_axis_pixel_tvalid(valid_o), .m_axis_pixel_tready(ready_i), .m_axis_pixel_tdata(drawn_o.pixel),
      .m_axis_pixel_tuser(drawn_o.tag), .m_axis_pixel_tlast(drawn_o.last)
    );
  end
  shade_assert u_place (.clk_i, .rst_i, .holds_i(!lit_o || placed));

  logic unused_settings;  // those of shade_paint
  assign unused_settings = &{1'b0, draw_i};
endmodule
