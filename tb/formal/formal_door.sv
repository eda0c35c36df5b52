// SPDX-License-Identifier: Apache-2.0
// formal_door: shade_door hands every good span to one lane that is ready, unaltered and in order, and tells of all others.
//
// Spans have a count of 0, 1, 2 or 4097 and two bits of a tag; the rest of a packet is 0, and the door does not look at it.
module formal_door #(
  parameter int LANES = 2
) (
  input logic             clk_i,
  input logic             rst_i,
  input logic             valid_i,
  input logic             last_i,
  input logic             keep_i,
  input logic       [1:0] size_i,
  input logic       [1:0] tag_i,
  input logic             hold_i,
  input logic [LANES-1:0] room_i,
  input logic [LANES-1:0] ready_i,
  input logic [LANES-1:0] given_i
);
  localparam int LEFT_W = 4;
  logic ready, busy, take, whole, wanted;
  logic [LANES-1:0] valid;
  shade_pkg::span_t offered, span;
  shade_pkg::told_t told;
  always_comb begin
    offered     = '0;
    offered.tag = 16'(tag_i);
    case (size_i)
      2'd0:    offered.count = 13'd0;
      2'd1:    offered.count = 13'd1;
      2'd2:    offered.count = 13'd2;
      default: offered.count = 13'd4097;
    endcase
  end
  shade_door #(.LANES(LANES), .PATH_NORMALS(0)) u_dut (
    .clk_i, .rst_i, .s_axis_span_tvalid(valid_i), .s_axis_span_tready(ready), .s_axis_span_tdata(offered),
    .s_axis_span_tkeep({32{keep_i}}), .s_axis_span_tlast(last_i), .draw_i('0), .hold_i, .valid_o(valid), .room_i,
    .ready_i, .given_i, .span_o(span), .busy_o(busy), .told_o(told)
  );

  logic started_q = 1'b0;
  logic inside_q, full_q, held_q;
  logic [5:0] held_word_q;
  logic [1:0] tag_q;
  logic [12:0] count_q;
  logic [1:0] good_q, bad_q;  // what is to be told in two clocks
  logic [LANES-1:0][LEFT_W-1:0] left_q;
  assign take   = valid_i && ready;
  assign whole  = last_i && keep_i && !inside_q;
  assign wanted = whole && (size_i == 2'd1 || size_i == 2'd2);
  always_ff @(posedge clk_i) begin
    started_q   <= 1'b1;
    held_q      <= valid_i && !ready;
    held_word_q <= {last_i, keep_i, size_i, tag_i};
    if (take) inside_q <= !last_i;
    good_q <= {good_q[0], take && wanted};
    bad_q  <= {bad_q[0], take && !inside_q && !wanted};
    if (valid != '0) full_q <= 1'b0;
    if (take && wanted) {full_q, tag_q, count_q} <= {1'b1, tag_i, offered.count};
    for (int i = 0; i < LANES; i++)
      left_q[i] <= left_q[i] + (valid[i] ? LEFT_W'(count_q) : '0) - LEFT_W'(given_i[i]);
    if (rst_i) {inside_q, full_q, held_q, good_q, bad_q, left_q} <= '0;
  end

  logic given_is_there, lanes_fill;
  always_comb begin
    given_is_there = 1'b1;
    lanes_fill     = 1'b1;
    for (int i = 0; i < LANES; i++) begin
      if (given_i[i] && left_q[i] == '0) given_is_there = 1'b0;
      if (ready_i[i] && left_q[i] > LEFT_W'(4)) lanes_fill = 1'b0;
    end
  end
  always_ff @(posedge clk_i) begin
    // The first clock is one of reset, from any state.
    if (!started_q) reset_first : assume (rst_i);
    if (started_q) begin
      // A beat is offered until it is taken, unaltered.
      beat_stays : assume (!held_q || (valid_i && held_word_q == {last_i, keep_i, size_i, tag_i}));
      // A lane gives only pixels that it has.
      gives_what_it_has : assume (given_is_there);
      // A lane is not ready for ever: with more than 4 pixels inside it takes no span.
      lanes_are_finite : assume (lanes_fill);
      // A span goes to one lane, which is ready.
      // mutant: valid_o            = full_q ? best_q & ready_i => valid_o            = full_q ? best_q
      one_ready_lane : assert ((valid & ~ready_i) == '0 && (valid & (valid - 1'b1)) == '0);
      // It is the good span that was taken last, unaltered; each leaves once.
      // mutant: if (!full_q || leave) begin => if (!full_q) begin
      unaltered : assert (valid == '0 || (full_q && span.tag == 16'(tag_q) && span.count == count_q));
      // None is taken while one waits, and none while settings change.
      // mutant: (!full_q || leave) && !hold_i => (!full_q || leave)
      taken : assert (ready == ((!full_q || valid != '0) && !hold_i));
      // It leaves as soon as every lane is ready.
      // mutant: best_q & ready_i : '0 => best_q & ready_i & room_i : '0
      progress : assert (!(full_q && &ready_i) || valid != '0);
      // Every packet is told of once, two clocks after its first beat, as good or bad.
      // mutant: told_o.bad       <= first_q && !good_q => told_o.bad       <= first_q
      packet_told : assert (told.good == good_q[1] && told.bad == bad_q[1]);
      // mutant: seen_q.packet    <= !whole => seen_q.packet    <= !s_axis_span_tlast
      cause : assert (told.bad == (told.error.empty || told.error.too_long || told.error.packet));
      // busy while a span waits or has pixels that are not drawn yet.
      // mutant: drawing != '0; => |drawing[0];
      busy_told : assert (!(full_q || left_q != '0) || busy);
    end
  end
endmodule
