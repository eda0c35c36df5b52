// SPDX-License-Identifier: Apache-2.0
// shade_scene_sites: where the pixels of runs stand, for a path that gives them in order, without their places.
//
// run_valid_i: a run goes in, site_i its first pixel; step_i: a pixel is here, with last_i the last of its run; site_o its
// place, in the same clock. Up to 2^LOG2 runs may be under way. A run must be in 3 clocks before its first pixel.
// Example: runs at column 5 and column 9, pixels of 2 (last) and 1 (last) -> columns 5, 6, 9.
module shade_scene_sites #(
  parameter int LOG2 = 8
) (
  input  logic             clk_i,
  input  logic             rst_i,
  input  logic             run_valid_i,
  input  shade_pkg::site_t site_i,
  input  logic             step_i,
  input  logic             last_i,
  output shade_pkg::site_t site_o
);
  logic waits, unused_taken;
  shade_pkg::site_t first;
  logic [shade_pkg::PLACE_W-1:0] offset_q;
  shade_fifo #(.WIDTH($bits(first)), .LOG2(LOG2), .BLOCK(1)) u_runs (
    .clk_i, .rst_i, .valid_i(run_valid_i), .data_i(site_i), .valid_o(waits), .ready_i(step_i && last_i), .data_o(first),
    .taken_o(unused_taken)
  );
  assign site_o.line   = first.line;
  assign site_o.column = first.column + offset_q;
  always_ff @(posedge clk_i) begin
    if (step_i) offset_q <= last_i ? '0 : offset_q + 1'b1;
    if (rst_i) offset_q <= '0;
  end
  shade_assert u_run (.clk_i, .rst_i, .holds_i(!step_i || waits));
endmodule
