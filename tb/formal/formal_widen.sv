// SPDX-License-Identifier: Apache-2.0
// formal_widen: shade_widen puts words together, in order and unaltered, and ends a beat with a packet.
module formal_widen #(
  parameter int WORDS = 3
) (
  input logic       clk_i,
  input logic       rst_i,
  input logic       valid_i,
  input logic       last_i,
  input logic [7:0] data_i,
  input logic       ready_i
);
  localparam int N_W = 8;
  logic ready, valid, last, take;
  logic [8*WORDS-1:0] data;
  logic [WORDS-1:0] keep;
  shade_widen #(.IN_W(8), .OUT_W(8 * WORDS)) u_dut (
    .clk_i, .rst_i, .s_axis_word_tvalid(valid_i), .s_axis_word_tready(ready), .s_axis_word_tdata(data_i),
    .s_axis_word_tlast(last_i), .m_axis_beat_tvalid(valid), .m_axis_beat_tready(ready_i), .m_axis_beat_tdata(data),
    .m_axis_beat_tkeep(keep), .m_axis_beat_tlast(last)
  );

  logic started_q = 1'b0;
  logic full_q, last_q, held_q;
  logic [N_W-1:0] count_q;  // words of the beat
  logic [WORDS-1:0] keep_q;
  logic [8*WORDS-1:0] data_q, shown_q;
  logic [WORDS:0] other_q;
  assign take = valid_i && ready;
  always_ff @(posedge clk_i) begin
    started_q <= 1'b1;
    held_q    <= valid && !ready_i && !rst_i;
    shown_q   <= data;
    other_q   <= {last, keep};
    if (full_q && ready_i) {full_q, count_q, keep_q, data_q} <= '0;
    if (take && !full_q) begin
      for (int i = 0; i < WORDS; i++) begin
        if (count_q == N_W'(i)) begin
          data_q[8*i+:8] <= data_i;
          keep_q[i]      <= 1'b1;
        end
      end
      last_q  <= last_i;
      count_q <= count_q + N_W'(1);
      full_q  <= last_i || count_q == N_W'(WORDS - 1);
    end
    if (rst_i) {full_q, count_q, keep_q, data_q} <= '0;
  end

  always_ff @(posedge clk_i) begin
    // The first clock is one of reset, from any state.
    if (!started_q) reset_first : assume (rst_i);
    if (started_q) begin
      // A beat comes a clock behind its last word, and only then; words are taken unless one waits.
      // mutant: m_axis_beat_tvalid ? !m_axis_beat_tready : ends => ends
      comes : assert (valid == full_q && ready == !full_q);
      // Its words are those taken, the first one at the bottom; behind the end of a packet it is empty.
      // mutant: if (take && (place_q[0] || place_q[i])) begin => if (take && place_q[i]) begin
      unaltered : assert (!valid || (data == data_q && keep == keep_q && last == last_q));
      // It stays until it is taken.
      // mutant: assign s_axis_word_tready = !m_axis_beat_tvalid; => assign s_axis_word_tready = 1'b1;
      stays : assert (!held_q || (valid && data == shown_q && {last, keep} == other_q));
    end
  end
endmodule
