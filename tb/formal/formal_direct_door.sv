// SPDX-License-Identifier: Apache-2.0
// formal_direct_door: shade_direct_door hands out every beat of a packet once, as what it is, and never a run without a credit.
module formal_direct_door #(
  parameter int LOG2 = 2
) (
  input logic                                 clk_i,
  input logic                                 rst_i,
  input logic                                 valid_i,
  input logic                                 last_i,
  input logic [shade_pkg::SURFACE_DATA_W-1:0] data_i,
  input logic                                 vector_ready_i,
  input logic                                 credit_i,
  input logic                                 idle_i
);
  localparam int N_W = LOG2 + 1;
  logic ready, vector, wide, tall, cut, run, write, error;
  logic [1:0] kind;
  logic [shade_pkg::CHORD_INDEX_W-1:0] address;
  logic [shade_pkg::CHORD_SHIFT_W-1:0] shift;
  logic signed [shade_pkg::EXCESS_W-1:0] excess;
  shade_pkg::growth_t growth;
  shade_pkg::waiting_t waiting;
  shade_pkg::chord_t chord;
  shade_direct_door #(.LOG2(LOG2)) u_dut (
    .clk_i, .rst_i, .s_axis_surface_tvalid(valid_i), .s_axis_surface_tready(ready), .s_axis_surface_tdata(data_i),
    .s_axis_surface_tlast(last_i), .vector_valid_o(vector), .vector_ready_i, .vector_o(growth), .kind_o(kind),
    .wide_o(wide), .tall_o(tall), .cut_o(cut), .run_valid_o(run), .run_o(waiting), .credit_i, .idle_i,
    .write_o(write), .address_o(address), .chord_o(chord), .shift_o(shift), .excess_o(excess), .error_o(error)
  );

  // the packet at hand: no beat yet, beat 1 to 3 (the vectors) or a later one of a triangle; a table
  logic started_q = 1'b0;
  logic [2:0] beat_q;
  logic table_q, short_q, take;
  logic [N_W-1:0] spent_q;
  logic [shade_pkg::CHORD_INDEX_W-1:0] entry_q;
  shade_pkg::lobe_t head;
  assign head = data_i;
  assign take = valid_i && ready;
  always_ff @(posedge clk_i) begin
    started_q <= 1'b1;
    spent_q   <= spent_q + N_W'(run) - N_W'(credit_i);
    short_q   <= take && last_i && !table_q && beat_q < 3'd4 && !(beat_q == 3'd0 && head.lobe);
    if (take) begin
      beat_q  <= last_i ? 3'd0 : beat_q == 3'd4 ? 3'd4 : beat_q + 3'd1;
      table_q <= !last_i && (table_q || (beat_q == 3'd0 && head.lobe));
      entry_q <= table_q ? entry_q + 1'b1 : '0;
    end
    if (rst_i) {beat_q, table_q, spent_q, short_q} <= '0;
  end

  always_ff @(posedge clk_i) begin
    // The first clock is one of reset, from any state.
    if (!started_q) reset_first : assume (rst_i);
    if (started_q) begin
      // Only credits that were spent come back.
      gives_what_was_taken : assume (!credit_i || spent_q != '0);
      // A run is handed out for every beat behind the vectors of a triangle, and for no other.
      // mutant: take && state_q == RUNS => take && state_q == RUNS && !s_axis_surface_tlast
      run_is_a_run : assert (run == (take && !table_q && beat_q == 3'd4));
      // No run without a credit.
      // mutant: (LOG2 + 1)'(credit_i) - => (LOG2 + 1)'(1) -
      credit : assert (spent_q <= N_W'(1 << LOG2));
      // Beats 1 to 3 of a triangle that goes on are vectors, told by their number.
      // mutant: s_axis_surface_tvalid && vector && !s_axis_surface_tlast => s_axis_surface_tvalid && vector
      vector_is_a_vector : assert (!(vector && vector_ready_i) || (take && !table_q && !last_i && 3'(kind) + 3'd1 == beat_q));
      // A beat behind the head of a table is an entry, at the place of its number.
      // mutant: else if (write_o) address_o <= address_o + 1'b1 => else if (write_o) address_o <= address_o
      entry : assert (write == (take && table_q) && (!write || address == entry_q));
      // A triangle without a run is told as an error, a clock later, and no other packet is.
      // mutant: error_o       <= cut_o || => error_o       <=
      error_told : assert (error == short_q);
      // With all credits and an idle machine every beat is taken, but for the clock behind the head of a table.
      // mutant: some_credit_q <= credit_d != '0 => some_credit_q <= credit_d > 1
      progress : assert (!(vector_ready_i && spent_q < N_W'(1 << LOG2)) || ready || table_q || beat_q == 3'd0);
    end
  end
endmodule
