// SPDX-License-Identifier: Apache-2.0
// shade_valid: the valid bit that accompanies a pipeline of fixed latency.
//
// valid_o = valid_i of DEPTH clocks ago; reset empties the pipeline. The data beside it are not reset.
// Latency DEPTH clocks (at least 1). Example: DEPTH = 2, valid_i = 1, 0, 1 -> valid_o = 0, 0, 1, 0, 1.
module shade_valid #(
  parameter int DEPTH = 1
) (
  input  logic clk_i,
  input  logic rst_i,
  input  logic valid_i,
  output logic valid_o
);
  if (DEPTH < 1) begin : g_check
    $error("shade_valid: DEPTH must be at least 1");
  end

  logic [DEPTH-1:0] valid_q;
  always_ff @(posedge clk_i) begin
    valid_q <= DEPTH'({valid_q, valid_i});
    if (rst_i) valid_q <= '0;
  end
  assign valid_o = valid_q[DEPTH-1];
endmodule
