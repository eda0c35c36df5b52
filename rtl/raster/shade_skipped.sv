// SPDX-License-Identifier: Apache-2.0
// shade_skipped: counts triangles and packets that were skipped, each kind on its own, since reset.
//
// told_i: a bit a kind, for one clock each; skipped_o: numbers that stay at 2^16 - 1. outside and between count as empty.
// Latency 1 clock. Example: culled in three clocks -> skipped_o.culled = 3.
module shade_skipped (
  input  logic                clk_i,
  input  logic                rst_i,
  input  shade_pkg::fate_t    told_i,
  output shade_pkg::skipped_t skipped_o
);
  localparam int KINDS = $bits(skipped_o) / 16;
  logic [KINDS-1:0][15:0] count_q;
  logic [KINDS-1:0][1:0] more;
  assign more = {
    {1'b0, told_i.outside} + {1'b0, told_i.between}, {1'b0, told_i.culled}, {1'b0, told_i.area},
    {1'b0, told_i.normal}, {1'b0, told_i.range}, {1'b0, told_i.packet}
  };
  always_ff @(posedge clk_i) begin
    for (int i = 0; i < KINDS; i++) begin
      if (count_q[i] >= 16'hfffe && more[i] != '0) count_q[i] <= '1;
      else count_q[i] <= count_q[i] + 16'(more[i]);
    end
    if (rst_i) count_q <= '0;
  end
  assign skipped_o = count_q;
endmodule
