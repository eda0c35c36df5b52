// SPDX-License-Identifier: Apache-2.0
// shade_assert: simulation stops when a condition does not hold: at every rising edge outside of a reset, holds_i = 1.
//
// The only module with an assertion: the name of its instance tells what went wrong. Nothing is left of it in synthesis
// (macro SYNTHESIS, which every synthesis tool sets; Yosys does not with -formal).
// No output, no latency. Example: u_overflow in shade_fifo: a word is written only where there is room.
module shade_assert (
  input logic clk_i,
  input logic rst_i,
  input logic holds_i
);
`ifdef SYNTHESIS
  logic unused_bits;
  assign unused_bits = &{1'b0, clk_i, rst_i, holds_i};
`else
  always_ff @(posedge clk_i) if (!rst_i) assert (holds_i);
`endif
endmodule
