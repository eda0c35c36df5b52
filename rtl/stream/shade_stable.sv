// SPDX-License-Identifier: Apache-2.0
// shade_stable: asserts a rule of valid/ready streams: a word that waits is offered again, unaltered.
//
// For simulation and proofs: nothing is left of it in synthesis. No output, no latency.
// Example: valid_i = 1, ready_i = 0, data_i = 5; a clock later valid_i = 0, or data_i = 6: simulation stops.
module shade_stable #(
  parameter int WIDTH = 32
) (
  input logic             clk_i,
  input logic             rst_i,
  input logic             valid_i,
  input logic             ready_i,
  input logic [WIDTH-1:0] data_i
);
  if (WIDTH < 1) begin : g_check
    $error("shade_stable: WIDTH must be at least 1");
  end

  logic waits_q;
  logic [WIDTH-1:0] data_q;
  always_ff @(posedge clk_i) begin
    waits_q <= !rst_i && valid_i && !ready_i;
    data_q  <= data_i;
  end
  shade_assert u_stable (.clk_i, .rst_i, .holds_i(!waits_q || (valid_i && data_i == data_q)));
endmodule
