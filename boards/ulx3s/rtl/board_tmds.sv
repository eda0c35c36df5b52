// SPDX-License-Identifier: Apache-2.0
// board_tmds: a byte, or two control bits, as a symbol of ten bits: DVI 1.0, section 3.2.
//
// First the nine bits with the fewest changes: a running XOR, or XNOR where the byte has more than four ones, or four and bit 0
// is 0. Then they are inverted or not, so that ones and zeros stay balanced. Control bits have four symbols of their own.
// Latency 2 clocks, a symbol a clock. Example: shown_i = 0, control_i = 0 -> 1101010100.
module board_tmds (
  input  logic       clk_i,
  input  logic       shown_i,
  input  logic [7:0] data_i,
  input  logic [1:0] control_i,
  output logic [9:0] symbol_o
);
  function automatic logic [3:0] ones(input logic [7:0] bits);
    ones = 4'd0;
    for (int i = 0; i < 8; i++) ones = ones + 4'(bits[i]);
  endfunction

  logic [8:0] chain, chain_q;
  logic invert, bit_, shown_q;
  logic [1:0] control_q;
  logic [3:0] ones_q;
  assign invert = ones(data_i) > 4'd4 || (ones(data_i) == 4'd4 && !data_i[0]);
  always_comb begin
    bit_  = data_i[0];
    chain = {!invert, 7'd0, bit_};
    for (int i = 1; i < 8; i++) begin
      bit_     = bit_ ^ data_i[i] ^ invert;
      chain[i] = bit_;
    end
  end
  always_ff @(posedge clk_i) begin
    chain_q   <= chain;
    ones_q    <= ones(chain[7:0]);
    shown_q   <= shown_i;
    control_q <= control_i;
  end

  // what there were more ones than zeros
  logic signed [4:0] more_q, excess;
  logic even, flip;
  assign excess = $signed({ones_q, 1'b0}) - 5'sd8;
  assign even   = more_q == 5'sd0 || excess == 5'sd0;
  assign flip   = even ? !chain_q[8] : more_q[4] == excess[4];
  always_ff @(posedge clk_i) begin
    if (shown_q) begin
      symbol_o <= {flip, chain_q[8], chain_q[7:0] ^ {8{flip}}};
      if (even) more_q <= chain_q[8] ? more_q + excess : more_q - excess;
      else if (flip) more_q <= more_q + $signed({3'b000, chain_q[8], 1'b0}) - excess;
      else more_q <= more_q - $signed({3'b000, !chain_q[8], 1'b0}) + excess;
    end else begin
      more_q <= 5'sd0;
      case (control_q)
        2'b00:   symbol_o <= 10'b1101010100;
        2'b01:   symbol_o <= 10'b0010101011;
        2'b10:   symbol_o <= 10'b0101010100;
        default: symbol_o <= 10'b1010101011;
      endcase
    end
  end
endmodule
