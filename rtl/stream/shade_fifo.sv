// SPDX-License-Identifier: Apache-2.0
// shade_fifo: first in, first out: 2^LOG2 words of memory and an output register.
//
// valid_i writes; the writer keeps a credit for every word, so that a full FIFO is never written (no ready_o, hence no
// path from ready_i to the writer). valid_o and data_o come from registers and hold until ready_i takes them;
// a word taken frees one credit: taken_o, a clock later.
// BLOCK = 1, for what is deep or wide: the memory may be a block RAM, whose own register is slow, with another behind it.
// Simulation stops when a full one is written. Capacity 2^LOG2 words. Latency when empty LATENCY_FIFO = 2 clocks, BLOCK = 1: LATENCY_FIFO_BLOCK = 3; one word a clock.
// Example (ready_i = 1): words 5, 6 written in clocks 0, 1 stand at data_o in clocks 2, 3.
module shade_fifo #(
  parameter int WIDTH = 32,
  parameter int LOG2  = shade_pkg::FIFO_LOG2,
  parameter int BLOCK = 0
) (
  input  logic             clk_i,
  input  logic             rst_i,
  input  logic             valid_i,
  input  logic [WIDTH-1:0] data_i,
  output logic             valid_o,
  input  logic             ready_i,
  output logic [WIDTH-1:0] data_o,
  output logic             taken_o
);
  if (WIDTH < 1 || LOG2 < 1 || BLOCK < 0 || BLOCK > 1) begin : g_check
    $error("shade_fifo: WIDTH and LOG2 must be at least 1 and BLOCK 0 or 1");
  end

  localparam int DEPTH = 1 << LOG2;
  (* ram_style = BLOCK == 1 ? "block" : "auto" *)
  logic [WIDTH-1:0] memory[0:DEPTH-1];
  // equal means empty: of 2^LOG2 words one stands in a register, so that the memory is never full
  logic [LOG2-1:0] write_q, read_q;
  logic read, room, first_valid_q;  // the first register behind the memory
  logic [WIDTH-1:0] first_q;
  assign read = write_q != read_q && room;

  always_ff @(posedge clk_i) begin
    if (valid_i) memory[write_q] <= data_i;
    if (read) first_q <= memory[read_q];
  end

  always_ff @(posedge clk_i) begin
    if (valid_i) write_q <= write_q + 1'b1;
    if (read) read_q <= read_q + 1'b1;
    if (read) first_valid_q <= 1'b1;
    else if (room) first_valid_q <= 1'b0;
    taken_o <= valid_o && ready_i;
    if (rst_i) begin
      write_q       <= '0;
      read_q        <= '0;
      first_valid_q <= 1'b0;
      taken_o       <= 1'b0;
    end
  end

  if (BLOCK == 0) begin : g_one
    assign room    = !valid_o || ready_i;
    assign valid_o = first_valid_q;
    assign data_o  = first_q;
  end else begin : g_two
    logic move;
    assign move = !valid_o || ready_i;
    assign room = !first_valid_q || move;
    always_ff @(posedge clk_i) begin
      if (move) data_o <= first_q;
      if (move) valid_o <= first_valid_q;
      if (rst_i) valid_o <= 1'b0;
    end
  end

  shade_assert u_overflow (.clk_i, .rst_i, .holds_i(!valid_i || read || write_q + 1'b1 != read_q));
  shade_stable #(.WIDTH(WIDTH)) u_stable (.clk_i, .rst_i, .valid_i(valid_o), .ready_i, .data_i(data_o));
endmodule
