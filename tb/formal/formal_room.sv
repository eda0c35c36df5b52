// SPDX-License-Identifier: Apache-2.0
// formal_room: shade_patch_room counts what is inside, whatever comes and goes, and tells a clock late.
module formal_room #(
  parameter int LIMIT = 4
) (
  input logic clk_i,
  input logic rst_i,
  input logic put_i,
  input logic taken_i
);
  localparam int N_W = 8;
  localparam logic [N_W-1:0] MOST = N_W'(2 * LIMIT - 1);
  logic room;
  shade_patch_room #(.LIMIT(LIMIT)) u_dut (.clk_i, .rst_i, .put_i, .taken_i, .room_o(room));

  logic started_q = 1'b0;
  logic reset_q;
  logic [N_W-1:0] inside_q, inside;
  assign inside = inside_q + N_W'(put_i) - N_W'(taken_i);
  always_ff @(posedge clk_i) begin
    started_q <= 1'b1;
    reset_q   <= rst_i;
    inside_q  <= rst_i ? '0 : inside;
  end

  always_ff @(posedge clk_i) begin
    // The first clock is one of reset, from any state.
    if (!started_q) reset_first : assume (rst_i);
    if (started_q) begin
      // Only what is inside is taken.
      takes_what_is_there : assume (!taken_i || inside_q != '0);
      // A writer stops soon: no more than LIMIT - 1 words come once there is no room.
      writer_stops : assume (inside <= MOST);
      // There is room if and only if at most LIMIT words were inside in the clock before.
      // mutant: used <= W'(LIMIT) => used < W'(LIMIT)
      room_told : assert (reset_q ? !room : room == (inside_q <= N_W'(LIMIT)));
    end
  end
endmodule
