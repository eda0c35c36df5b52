// SPDX-License-Identifier: Apache-2.0
// shade_patch_room: is there room in a FIFO for what is on its way to it.
//
// put_i, taken_i: a word is written, is read. room_o is 1 while at most LIMIT words are inside; a clock late.
// Latency 1 clock. Example: LIMIT = 1, two words put -> room_o = 0 from the clock behind the second on.
module shade_patch_room #(
  parameter int LIMIT = 1 << (shade_pkg::PATCH_FIFO_LOG2 - 1)
) (
  input  logic clk_i,
  input  logic rst_i,
  input  logic put_i,
  input  logic taken_i,
  output logic room_o
);
  if (LIMIT < 1) begin : g_check
    $error("shade_patch_room: LIMIT must be at least 1");
  end

  localparam int W = $clog2(LIMIT) + 2;
  logic [W-1:0] used_q, used;
  assign used = used_q + W'(put_i) - W'(taken_i);
  always_ff @(posedge clk_i) begin
    used_q <= used;
    room_o <= used <= W'(LIMIT);
    if (rst_i) begin
      used_q <= '0;
      room_o <= 1'b0;
    end
  end
endmodule
