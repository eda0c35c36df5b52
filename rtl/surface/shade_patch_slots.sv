// SPDX-License-Identifier: Apache-2.0
// shade_patch_slots: the words of triangles that wait for shade_patch_walk: written in any order, read four after each other.
//
//   start_i    a triangle will be written, room_o was 1; at most one in two clocks
//   valid_i    word at_i of memory which_i, one beside the other; last_i with the last one
//   valid_o    word 0, 1, 2, 3 of every memory, memory 0 in the lowest bits, until ready_i takes it
//
// MEMORIES block RAMs of 2^LOG2 words, with a register behind their own; the first two are WIDTH wide, of others the SHORT_W upper bits are
// kept. Latency 3 clocks from last_i to valid_o. Example: start, words 3, 0 (last) -> words 0, 1, 2, 3, of which 1 and 2 are any.
module shade_patch_slots #(
  parameter int MEMORIES = 4,
  parameter int WIDTH    = shade_pkg::PATCH_SCALAR_W,
  parameter int SHORT_W  = shade_pkg::DIRECT_H_W,
  parameter int LOG2     = shade_pkg::PATCH_FIFO_LOG2
) (
  input  logic                      clk_i,
  input  logic                      rst_i,
  input  logic                      start_i,
  output logic                      room_o,
  input  logic                      valid_i,
  input  logic                      last_i,
  input  logic [               3:0] which_i,
  input  logic [               1:0] at_i,
  input  logic [         WIDTH-1:0] value_i,
  output logic                      valid_o,
  input  logic                      ready_i,
  output logic [MEMORIES*WIDTH-1:0] value_o
);
  if (MEMORIES < 1 || MEMORIES > 16 || WIDTH < SHORT_W || SHORT_W < 1 || LOG2 < 4) begin : g_check
    $error("shade_patch_slots: MEMORIES must be in 1 .. 16, SHORT_W in 1 .. WIDTH and LOG2 at least 4");
  end

  localparam int W = LOG2 - 2;
  logic [W-1:0] started_q, written_q, used;
  logic [LOG2-1:0] read_q;
  logic read, move, room, first_valid_q;
  assign used = started_q - read_q[LOG2-1:2];
  assign move = !valid_o || ready_i;
  assign room = !first_valid_q || move;
  assign read = {written_q, 2'd0} != read_q && room;
  for (genvar i = 0; i < MEMORIES; i++) begin : g_memory
    localparam int KEPT = i < 2 ? WIDTH : SHORT_W;
    logic [KEPT-1:0] memory[0:(1<<LOG2)-1];
    logic [KEPT-1:0] first_q, value_q;
    always_ff @(posedge clk_i) begin
      if (valid_i && which_i == 4'(i)) memory[{written_q, at_i}] <= value_i[WIDTH-1-:KEPT];
      if (read) first_q <= memory[read_q];
      if (move) value_q <= first_q;
    end
    assign value_o[i*WIDTH+:WIDTH] = WIDTH'(value_q) << (WIDTH - KEPT);
  end
  always_ff @(posedge clk_i) begin
    started_q <= started_q + W'(start_i);
    written_q <= written_q + W'(valid_i && last_i);
    if (read) read_q <= read_q + LOG2'(1);
    if (read) first_valid_q <= 1'b1;
    else if (room) first_valid_q <= 1'b0;
    if (move) valid_o <= first_valid_q;
    room_o <= used < W'((1 << W) - 2);
    if (rst_i) begin
      started_q     <= '0;
      written_q     <= '0;
      read_q        <= '0;
      first_valid_q <= 1'b0;
      valid_o       <= 1'b0;
      room_o        <= 1'b0;
    end
  end
endmodule
