// SPDX-License-Identifier: Apache-2.0
// formal_fifo: shade_fifo keeps the order and the content of its words, loses none, and gives them on in time.
//
// A free input marks one word; what lies ahead of it is counted until it comes out.
module formal_fifo #(
  parameter int WIDTH = 1,
  parameter int LOG2  = 2,
  parameter int BLOCK = 0
) (
  input logic             clk_i,
  input logic             rst_i,
  input logic             valid_i,
  input logic [WIDTH-1:0] data_i,
  input logic             ready_i,
  input logic             mark_i
);
  localparam int N_W = LOG2 + 2;
  localparam int LATENCY = BLOCK == 0 ? shade_pkg::LATENCY_FIFO : shade_pkg::LATENCY_FIFO_BLOCK;
  localparam logic [N_W-1:0] CAPACITY = N_W'(1 << LOG2);

  logic valid, taken, give;
  logic [WIDTH-1:0] data;
  shade_fifo #(.WIDTH(WIDTH), .LOG2(LOG2), .BLOCK(BLOCK)) u_dut (
    .clk_i, .rst_i, .valid_i, .data_i, .valid_o(valid), .ready_i, .data_o(data), .taken_o(taken)
  );
  assign give = valid && ready_i;

  logic started_q = 1'b0;
  logic held_q, token_q, gave_q;
  logic [1:0] age_q;  // clocks of the token inside, at most LATENCY - 1
  logic [N_W-1:0] credit_q, inside_q, ahead_q, ready_q;  // ready_q: clocks in which the token could have moved
  logic [WIDTH-1:0] held_data_q, token_data_q;
  always_ff @(posedge clk_i) begin
    started_q   <= 1'b1;
    credit_q    <= credit_q - N_W'(valid_i) + N_W'(taken);
    inside_q    <= inside_q + N_W'(valid_i) - N_W'(give);
    held_q      <= valid && !ready_i;
    gave_q      <= give;
    held_data_q <= data;
    if (!token_q && valid_i && mark_i) begin
      token_q      <= 1'b1;
      token_data_q <= data_i;
      ahead_q      <= inside_q - N_W'(give);
      ready_q      <= '0;
      age_q        <= '0;
    end else if (token_q) begin
      if (give) ahead_q <= ahead_q - N_W'(1);
      if (give && ahead_q == '0) token_q <= 1'b0;
      ready_q <= give ? '0 : ready_q + N_W'(ready_i);
      if (age_q != 2'(LATENCY - 1)) age_q <= age_q + 2'd1;
    end
    if (rst_i) begin
      credit_q <= CAPACITY;
      inside_q <= '0;
      held_q   <= 1'b0;
      token_q  <= 1'b0;
    end
  end

  always_ff @(posedge clk_i) begin
    // The first clock is one of reset, from any state.
    if (!started_q) reset_first : assume (rst_i);
    // The writer has a credit for every word: 2^LOG2 after reset, one back for each taken_o.
    if (started_q) writer_has_credit : assume (!valid_i || credit_q != '0);
    if (started_q) begin
      // A word that waits stays as it is.
      // mutant: read = write_q != read_q && room => read = write_q != read_q
      stable : assert (!held_q || (valid && data == held_data_q));
      // The marked word comes out unaltered, behind those that were ahead of it.
      // mutant: first_q <= memory[read_q] => first_q <= memory[read_q ^ LOG2'(1)]
      order : assert (!(token_q && give && ahead_q == '0) || data == token_data_q);
      // Nothing comes out of an empty FIFO.
      // mutant: read = write_q != read_q && room => read = room
      no_underflow : assert (!valid || inside_q != '0);
      // Every word and every credit is in one place: never more than fit.
      // mutant: taken_o <= valid_o && ready_i => taken_o <= ready_i
      capacity : assert (credit_q + inside_q + N_W'(taken) == CAPACITY);
      // A ready consumer waits for no word longer than the latency.
      // mutant: read = write_q != read_q && room => read = write_q != read_q && room && !valid_i
      in_time : assert (!token_q || ready_q < N_W'(LATENCY));
      // Words that have been inside for the latency follow each other without a bubble.
      // mutant: read = write_q != read_q && room => read = write_q != read_q && room && !valid_o
      no_bubble : assert (!(token_q && ahead_q == '0 && gave_q && age_q == 2'(LATENCY - 1)) || valid);
    end
  end
endmodule
