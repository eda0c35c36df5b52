// SPDX-License-Identifier: Apache-2.0
// board_memory: a memory of 11 or 12 bits a word, one write and one read a clock, cut so that it takes few blocks of RAM.
//
// A block of the ECP5 holds 2048 words of 9 bits, 8192 of 2 or 16384 of 1: words of 9 + 2 + 1 bits leave less of it empty than 3 x 4
// or 12 x 1 bits. Latency 1 clock; a word that is written in the clock in which it is read: the old one.
// Example: 76800 words of 12 bits: 38 + 10 + 5 = 53 blocks instead of 57.
module board_memory #(
  parameter int WIDTH = 12,
  parameter int DEPTH = 76800
) (
  input  logic             clk_i,
  input  logic             write_i,
  input  logic [     16:0] to_i,
  input  logic [WIDTH-1:0] data_i,
  input  logic [     16:0] at_i,
  output logic [WIDTH-1:0] data_o
);
  logic [8:0] nines[0:DEPTH-1];
  logic [1:0] twos[0:DEPTH-1];
  always_ff @(posedge clk_i) begin
    if (write_i) nines[to_i] <= data_i[8:0];
    data_o[8:0] <= nines[at_i];
  end
  always_ff @(posedge clk_i) begin
    if (write_i) twos[to_i] <= data_i[10:9];
    data_o[10:9] <= twos[at_i];
  end
  if (WIDTH == 12) begin : g_one
    logic ones[0:DEPTH-1];
    always_ff @(posedge clk_i) begin
      if (write_i) ones[to_i] <= data_i[11];
      data_o[11] <= ones[at_i];
    end
  end
endmodule
