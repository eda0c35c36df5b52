// SPDX-License-Identifier: Apache-2.0
// formal_tokens: shade_patch_tokens gives what was kept, in order and unaltered, and nothing of what was taken back.
//
// A free input marks a word; what lies ahead of it is counted. Words are a bit wide.
module formal_tokens #(
  parameter int LOG2 = 5
) (
  input logic clk_i,
  input logic rst_i,
  input logic valid_i,
  input logic data_i,
  input logic keep_i,
  input logic drop_i,
  input logic empty_i,
  input logic mark_i,
  input logic ready_i
);
  localparam int N_W = LOG2 + 2;
  logic room, valid, data, out;
  shade_patch_tokens #(.WIDTH(1), .LOG2(LOG2)) u_dut (
    .clk_i, .rst_i, .valid_i, .data_i, .keep_i, .drop_i, .empty_i, .room_o(room), .valid_o(valid), .ready_i,
    .data_o(data)
  );

  logic started_q = 1'b0;
  logic held_q, shown_q;
  logic [N_W-1:0] kept_q, open_q, tail_q;  // words kept and inside; written since; empty ones at their end
  logic [N_W-1:0] ahead_q;
  logic marked_q, sure_q, idle_q, bit_q;  // sure: kept. idle: no word that is not empty came since
  logic [2:0] there_q;
  assign out = valid && ready_i;
  always_ff @(posedge clk_i) begin
    started_q <= 1'b1;
    held_q    <= valid && !ready_i;
    shown_q   <= data;
    there_q   <= {there_q[1:0], kept_q != '0};
    kept_q    <= kept_q - N_W'(out);
    if (valid_i) begin
      open_q <= open_q + N_W'(1);
      tail_q <= empty_i ? tail_q + N_W'(1) : '0;
      idle_q <= idle_q && empty_i;
      if (drop_i) {open_q, tail_q} <= '0;
      else if (keep_i) begin
        kept_q           <= kept_q - N_W'(out) + open_q + N_W'(1) - (empty_i ? tail_q + N_W'(1) : '0);
        {open_q, tail_q} <= '0;
      end
    end
    if (marked_q && out) begin
      ahead_q <= ahead_q - N_W'(1);
      if (ahead_q == '0) {marked_q, sure_q} <= '0;
    end
    if (marked_q && !sure_q && valid_i) begin
      if (drop_i || (keep_i && idle_q && empty_i)) marked_q <= 1'b0;
      else if (keep_i) sure_q <= 1'b1;
    end
    if (mark_i && !marked_q && valid_i && !drop_i) begin
      marked_q <= !(keep_i && empty_i);
      sure_q   <= keep_i;
      idle_q   <= empty_i;
      bit_q    <= data_i;
      ahead_q  <= kept_q + open_q - N_W'(out);
    end
    if (rst_i) {kept_q, open_q, tail_q, marked_q, sure_q, held_q, there_q} <= '0;
  end

  always_ff @(posedge clk_i) begin
    // The first clock is one of reset, from any state.
    if (!started_q) reset_first : assume (rst_i);
    if (started_q) begin
      // A writer stops in time: there is a place for every word.
      writer_stops : assume (!valid_i || kept_q + open_q < N_W'((1 << LOG2) - 1));
      // What is taken back is not kept.
      one_of_both : assume (!(keep_i && drop_i));
      // What comes out was kept and did not come before.
      // mutant: assign read = kept_q != read_q && room; => assign read = write_q != read_q && room;
      was_kept : assert (!valid || kept_q != '0);
      // The marked word comes out unaltered when nothing lies ahead of it, and only if it was kept.
      // mutant: write_q <= drop_i ? kept_q : keep_i ? full : next; => write_q <= drop_i ? full_q : keep_i ? full : next;
      unaltered : assert (!(valid && marked_q && ahead_q == '0) || (sure_q && data == bit_q));
      // A word stays until it is taken.
      // mutant: assign move = !valid_o || ready_i; => assign move = 1'b1;
      stays : assert (!held_q || (valid && data == shown_q));
      // Three clocks after it was kept, a word is offered.
      // mutant: if (keep_i) kept_q <= full; => if (keep_i && !ready_i) kept_q <= full;
      comes : assert (!(&there_q && kept_q != '0) || valid);
    end
  end
endmodule
