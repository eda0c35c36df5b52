// SPDX-License-Identifier: Apache-2.0
// shade_patch_tokens: a FIFO whose writer may take back what it wrote: shade_patch_clip learns with a box's last line whether the
// box is drawn from its tokens.
//
// valid_i writes; with keep_i all written so far can be read, but for the last ones with empty_i = 1, which are forgotten; with
// drop_i all written since then is forgotten. room_o is 0 when
// less than PATCH_SPARE words are free. valid_o and data_o come from registers and hold until ready_i takes them.
// Latency 3 clocks behind keep_i; one word a clock. Example: words 5, 6 with keep, 7 with drop, 8 with keep -> 5, 6, 8.
module shade_patch_tokens #(
  parameter int WIDTH = 2 * shade_pkg::PATCH_TOKEN_W,
  parameter int LOG2  = shade_pkg::PATCH_WAIT_LOG2
) (
  input  logic             clk_i,
  input  logic             rst_i,
  input  logic             valid_i,
  input  logic [WIDTH-1:0] data_i,
  input  logic             keep_i,
  input  logic             drop_i,
  input  logic             empty_i,
  output logic             room_o,
  output logic             valid_o,
  input  logic             ready_i,
  output logic [WIDTH-1:0] data_o
);
  if (WIDTH < 1 || 1 << LOG2 < 2 * shade_pkg::PATCH_SPARE) begin : g_check
    $error("shade_patch_tokens: WIDTH must be at least 1 and 2^LOG2 at least 2 PATCH_SPARE");
  end

  localparam int SPARE = shade_pkg::PATCH_SPARE;
  logic [WIDTH-1:0] memory[0:(1<<LOG2)-1];
  logic [LOG2-1:0] write_q, full_q, full, kept_q, read_q, next, used;  // full: behind the last one that is not empty
  logic read, move, room, first_valid_q;
  logic [WIDTH-1:0] first_q;
  assign next = write_q + LOG2'(1);
  assign full = empty_i ? full_q : next;
  assign used = write_q - read_q;
  assign move = !valid_o || ready_i;
  assign room = !first_valid_q || move;
  assign read = kept_q != read_q && room;
  always_ff @(posedge clk_i) begin
    if (valid_i) memory[write_q] <= data_i;
    if (read) first_q <= memory[read_q];
    if (move) data_o <= first_q;
  end
  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      write_q <= drop_i ? kept_q : keep_i ? full : next;
      full_q  <= drop_i ? kept_q : full;
      if (keep_i) kept_q <= full;
    end
    if (read) read_q <= read_q + LOG2'(1);
    if (read) first_valid_q <= 1'b1;
    else if (room) first_valid_q <= 1'b0;
    if (move) valid_o <= first_valid_q;
    room_o <= used < LOG2'((1 << LOG2) - SPARE);
    if (rst_i) begin
      write_q       <= '0;
      full_q        <= '0;
      kept_q        <= '0;
      read_q        <= '0;
      first_valid_q <= 1'b0;
      valid_o       <= 1'b0;
      room_o        <= 1'b0;
    end
  end
endmodule
