// SPDX-License-Identifier: Apache-2.0
// shade_direct_run: steps the scalars along a run, a pixel a clock: four additions, no product.
//
//   a += a_c; h += h_c; p += p_c; p_c += 2 p_cc          modulo their widths, exact
//
// start_i: runs; scalars_o with valid_o: a pixel's scalars; tag_o, last_o with it. credit_i: a place for a pixel is free; there
// are 2^FIFO_LOG2 after reset. No bubble between runs. Latency of the first pixel: 1 clock behind its start.
// Example: p = 1, p_c = 2, p_cc = 1, count 3 -> p = 1, 3, 7.
module shade_direct_run #(
  parameter int FIFO_LOG2 = shade_pkg::DIRECT_FIFO_LOG2
) (
  input  logic                             clk_i,
  input  logic                             rst_i,
  input  logic                             valid_i,
  output logic                             ready_o,
  input  shade_pkg::start_t                start_i,
  input  logic                             credit_i,
  output logic                             valid_o,
  output shade_pkg::scalars_t              scalars_o,
  output logic                             last_o,
  output logic      [shade_pkg::TAG_W-1:0] tag_o
);
  localparam int P_W = shade_pkg::DIRECT_P_W;
  logic load, first;
  shade_walk #(.CREDIT_LOG2(FIFO_LOG2)) u_walk (
    .clk_i, .rst_i, .valid_i(valid_i), .ready_o(ready_o), .count_i(start_i.count), .credit_i,
    .load_o(load), .issue_o(valid_o), .first_o(first), .last_o
  );

  shade_pkg::start_t at_q;
  assign scalars_o = at_q.at;
  assign tag_o     = at_q.tag;
  always_ff @(posedge clk_i) begin
    if (load) at_q <= start_i;
    else if (valid_o) begin
      at_q.at.a     <= at_q.at.a + at_q.a_column;
      at_q.at.h     <= at_q.at.h + at_q.h_column;
      at_q.at.p     <= at_q.at.p + at_q.p_column;
      at_q.p_column <= at_q.p_column + {at_q.p_columns[P_W-2:0], 1'b0};
    end
  end

  logic unused_bits;
  assign unused_bits = &{1'b0, first, at_q};
endmodule
