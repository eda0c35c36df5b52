// SPDX-License-Identifier: Apache-2.0
// shade_patch_deal: which of two FIFOs a piece goes to: the one with less inside; and whether there is room in both.
//
//   put_i      a piece is written to the FIFO group_o;   taken_i   a piece is read from FIFO 0, 1
//   room_o     1 while at most LIMIT pieces are inside either; a clock late
//
// Latency 1 clock. Example: two pieces put, none taken -> group_o 0, then 1.
module shade_patch_deal #(
  parameter int LIMIT = 1 << (shade_pkg::PATCH_FIFO_LOG2 - 1)
) (
  input  logic       clk_i,
  input  logic       rst_i,
  input  logic       put_i,
  input  logic [1:0] taken_i,
  output logic       group_o,
  output logic       room_o
);
  if (LIMIT < 1) begin : g_check
    $error("shade_patch_deal: LIMIT must be at least 1");
  end
  localparam int W = $clog2(LIMIT) + 2;
  logic [1:0][W-1:0] used_q;
  assign group_o = used_q[1] < used_q[0];
  always_ff @(posedge clk_i) begin
    used_q[0] <= used_q[0] + W'(put_i && !group_o) - W'(taken_i[0]);
    used_q[1] <= used_q[1] + W'(put_i && group_o) - W'(taken_i[1]);
    room_o    <= used_q[0] < W'(LIMIT) && used_q[1] < W'(LIMIT);
    if (rst_i) begin
      used_q <= '0;
      room_o <= 1'b0;
    end
  end
endmodule
