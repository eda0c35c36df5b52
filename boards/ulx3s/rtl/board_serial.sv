// SPDX-License-Identifier: Apache-2.0
// board_serial: symbols of ten bits, a pixel clock each, as pairs of bits at five times that clock; bit 0 goes first.
//
// Both clocks come from one PLL. A bit that toggles with the pixel clock tells in the fast one when a symbol has come: it is taken
// two fast clocks later, in the middle of its time. Latency 4 fast clocks. Example: 0000011111 -> 11, 11, 01, 00, 00.
module board_serial (
  input  logic       clk_i,
  input  logic       fast_i,
  input  logic [9:0] symbol_i,
  output logic [1:0] pair_o
);
  logic toggle_q;
  logic [9:0] symbol_q, shift_q;
  logic [2:0] seen_q;
  always_ff @(posedge clk_i) begin
    toggle_q <= !toggle_q;
    symbol_q <= symbol_i;
  end
  always_ff @(posedge fast_i) begin
    seen_q  <= {seen_q[1:0], toggle_q};
    shift_q <= seen_q[2] != seen_q[1] ? symbol_q : {2'b00, shift_q[9:2]};
    pair_o  <= shift_q[1:0];
  end
endmodule
