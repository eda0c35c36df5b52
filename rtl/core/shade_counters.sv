// SPDX-License-Identifier: Apache-2.0
// shade_counters: the counters and the status of a core, and the word of the one that is asked for.
//
//   clear_i     all are 0 but for what comes in this clock
//   events_i    STATUS bits to set; they stay until clear_i
//   counts_i    by how much the counters rise in this clock, modulo 2^32; CLOCKS rises while busy_i
//   select_i    a register: own_o at once whether it is one of these, word_o a clock later its word, else 0
//
// ID and VERSION, which never change, are among them. Latency 1 clock. Example: counts_i.pixels = 2 in one clock -> PIXELS is 2.
module shade_counters (
  input  logic               clk_i,
  input  logic               rst_i,
  input  logic               clear_i,
  input  logic               busy_i,
  input  shade_pkg::status_t events_i,
  input  shade_pkg::counts_t counts_i,
  input  shade_pkg::select_t select_i,
  output logic               own_o,
  output logic        [31:0] word_o
);
  logic [31:0] pixels_q, spans_q, clocks_q, stalls_q, evaluations_q, errors_q;
  shade_pkg::status_t status_q;
  // a count that is cleared begins with what comes: its upper bits are those of a register with a reset
  function automatic logic [31:0] counted(input logic clear, input logic [31:0] count, input logic [31:0] more);
    counted = clear ? more : count + more;
  endfunction
  always_ff @(posedge clk_i) begin
    pixels_q      <= counted(clear_i, pixels_q, 32'(counts_i.pixels));
    spans_q       <= counted(clear_i, spans_q, 32'(counts_i.spans));
    clocks_q      <= counted(clear_i, clocks_q, 32'(busy_i));
    stalls_q      <= counted(clear_i, stalls_q, 32'(counts_i.stalls));
    evaluations_q <= counted(clear_i, evaluations_q, 32'(counts_i.evaluations));
    errors_q      <= counted(clear_i, errors_q, 32'(counts_i.errors));
    status_q      <= (clear_i ? '0 : status_q) | events_i;
    if (rst_i) begin
      pixels_q      <= 32'd0;
      spans_q       <= 32'd0;
      clocks_q      <= 32'd0;
      stalls_q      <= 32'd0;
      evaluations_q <= 32'd0;
      errors_q      <= 32'd0;
      status_q      <= '0;
    end
  end

  assign own_o = select_i.id || select_i.version || select_i.status || select_i.pixels || select_i.spans ||
                 select_i.clocks || select_i.stalls || select_i.evaluations || select_i.errors;
  always_ff @(posedge clk_i) begin
    word_o <= ({32{select_i.id}} & 32'(shade_pkg::REG_ID_RESET))
            | ({32{select_i.version}} & 32'(shade_pkg::REG_VERSION_RESET))
            | ({32{select_i.status}} & shade_pkg::status_word(busy_i, status_q))
            | ({32{select_i.pixels}} & pixels_q)
            | ({32{select_i.spans}} & spans_q)
            | ({32{select_i.clocks}} & clocks_q)
            | ({32{select_i.stalls}} & stalls_q)
            | ({32{select_i.evaluations}} & evaluations_q)
            | ({32{select_i.errors}} & errors_q);
  end

  logic unused_select;
  assign unused_select = &{1'b0, select_i};
endmodule
