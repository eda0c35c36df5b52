// SPDX-License-Identifier: Apache-2.0
// shade_door: packets of an AXI4-Stream in, good spans out to the next free lane: what is faulty stays outside.
//
//   s_axis_span_*    one beat a packet (tlast = 1, all of tkeep), see span_t; BURST = 1: each beat is a span, whatever its tlast
//   draw_i           settings; hold_i: no span is taken, as they may be others in the next clock
//   span_o           a good span; valid_o: to which lane. room_i, ready_i: which lanes could take one, and do in this clock
//   given_i          a lane gives a pixel
//   busy_o           a span was taken, waits, or is inside a lane
//   told_o           a packet was good, one span, or bad, and its errors; 2 clocks after its first beat
//
// A span goes to the lane that has the fewest pixels to draw, of those that have room for it: of those that are as they were two
// clocks ago, the first one of several. It is offered only to a lane that takes it.
//
// A faulty packet costs a clock a beat: 0 pixels or more than 4096, cut short or too long. metric and threshold are told of
// good spans where CONTROL.path asks for pixel normals: shade_pixel_normals clamps what they are about.
// Latency 1 clock, one span a clock. No path leads from an input to an output, but from ready_i and hold_i.
// Example, two lanes: spans of 64 pixels go to lane 0 while lane 1 draws sixteen spans of 4.
module shade_door #(
  parameter int LANES        = 1,
  parameter int PATH_NORMALS = 1,
  parameter int BURST        = 0
) (
  input  logic                                clk_i,
  input  logic                                rst_i,
  input  logic                                s_axis_span_tvalid,
  output logic                                s_axis_span_tready,
  input  logic [  shade_pkg::SPAN_DATA_W-1:0] s_axis_span_tdata,
  input  logic [shade_pkg::SPAN_DATA_W/8-1:0] s_axis_span_tkeep,
  input  logic                                s_axis_span_tlast,
  input  shade_pkg::draw_t                    draw_i,
  input  logic                                hold_i,
  output logic [                   LANES-1:0] valid_o,
  input  logic [                   LANES-1:0] room_i,
  input  logic [                   LANES-1:0] ready_i,
  input  logic [                   LANES-1:0] given_i,
  output shade_pkg::span_t                    span_o,
  output logic                                busy_o,
  output shade_pkg::told_t                    told_o
);
  if (LANES < 1 || LANES > 8) begin : g_check
    $error("shade_door: LANES must be in 1 .. 8");
  end
  if (BURST < 0 || BURST > 1) begin : g_check_burst
    $error("shade_door: BURST must be 0 or 1");
  end

  localparam int COUNT_W = shade_pkg::COUNT_W;

  // ---- a beat ----------------------------------------------------------------------------------------------------
  shade_pkg::span_t span;
  logic inside_q, last, whole, empty, too_long, good, take, pixels, counts;
  assign span     = s_axis_span_tdata;
  assign take     = s_axis_span_tvalid && s_axis_span_tready;
  assign last     = BURST == 1 || s_axis_span_tlast;
  assign whole    = last && !inside_q && &s_axis_span_tkeep;
  assign empty    = span.count == '0;
  assign too_long = span.count > COUNT_W'(shade_pkg::PIXELS_MAX);
  assign good     = whole && !empty && !too_long;
  assign pixels   = PATH_NORMALS == 1 && draw_i.control.path == 1'(shade_pkg::PATH_NORMALS);
  assign counts   = draw_i.control.variant == shade_pkg::VARIANT_W'(shade_pkg::VARIANT_V1) ||
                    draw_i.control.variant == shade_pkg::VARIANT_W'(shade_pkg::VARIANT_V2);

  // its faults, in two steps: tdata comes late in its clock
  logic first_q, good_q;
  shade_pkg::errors_t seen_q;
  always_ff @(posedge clk_i) begin
    if (take) inside_q <= !last;
    first_q          <= take && !inside_q;
    good_q           <= take && good;
    seen_q.empty     <= whole && empty;
    seen_q.too_long  <= whole && too_long;
    seen_q.packet    <= !whole;
    seen_q.metric    <= good && pixels && counts && (span.count <= COUNT_W'(shade_pkg::METRIC_M_MIN) ||
                                                     span.count > COUNT_W'(shade_pkg::METRIC_M_MAX + 1));
    seen_q.threshold <= good && pixels && (draw_i.planner.threshold < 0 || draw_i.planner.threshold > 18'sd65536);
    told_o.good      <= good_q;
    told_o.bad       <= first_q && !good_q;
    told_o.error     <= first_q ? seen_q : '0;
    if (rst_i) begin
      {inside_q, first_q, good_q} <= '0;
      told_o                      <= '0;
    end
  end

  // ---- a span waits for a lane -----------------------------------------------------------------------------------
  localparam int LEFT_W = 20;  // pixels inside of a lane: all that its FIFOs of spans and records hold
  logic full_q, leave, comes;
  logic [LANES-1:0] best, best_q, drawing;  // best: one bit
  logic [LANES-1:0][LEFT_W-1:0] left_q;
  assign valid_o            = full_q ? best_q & ready_i : '0;
  assign leave              = valid_o != '0;
  assign s_axis_span_tready = (!full_q || leave) && !hold_i;
  // a good span, taken where there is a place for it: told without leave, which comes late from ready_i
  assign comes              = s_axis_span_tvalid && !hold_i && good;
  assign busy_o             = full_q || comes || drawing != '0;
  for (genvar i = 0; i < LANES; i++) begin : g_lane
    assign drawing[i] = left_q[i] != '0;
    always_ff @(posedge clk_i) begin
      left_q[i] <= left_q[i] + (valid_o[i] ? LEFT_W'(span_o.count) : '0) - LEFT_W'(given_i[i]);
      if (rst_i) left_q[i] <= '0;
    end
  end
  always_comb begin
    logic [LEFT_W:0] least;
    least = '1;
    best  = '0;
    for (int i = LANES - 1; i >= 0; i--) begin
      if ({!room_i[i], left_q[i]} <= least) begin
        least = {!room_i[i], left_q[i]};
        best  = LANES'(1) << i;
      end
    end
  end
  always_ff @(posedge clk_i) begin
    if (!full_q || leave) begin
      span_o <= span;
      full_q <= comes;
    end
    best_q <= best;
    if (rst_i) begin
      full_q <= 1'b0;
      best_q <= LANES'(1);
    end
  end
  shade_stable #(.WIDTH($bits(span) + $bits(s_axis_span_tkeep) + 1)) u_stable (
    .clk_i, .rst_i, .valid_i(s_axis_span_tvalid), .ready_i(s_axis_span_tready),
    .data_i({s_axis_span_tlast, s_axis_span_tkeep, s_axis_span_tdata})
  );
  shade_assert u_given (.clk_i, .rst_i, .holds_i((given_i & ~drawing) == '0));

  logic unused_bits;
  assign unused_bits = &{1'b0, draw_i, span};
endmodule
