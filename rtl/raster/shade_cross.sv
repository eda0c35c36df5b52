// SPDX-License-Identifier: Apache-2.0
// shade_cross: sums of products of wide numbers, a product a clock.
//
//   p_i        S24.0
//   q_i        S18.0, or a part of a wider number: q = qh 2^17 + ql, ql unsigned; first all products with qh, then with ql
//   first_i    a new sum; else the product is added to what is there, shift_i: moved up by 17 bits before
//   minus_i    the product is subtracted
//   sum_o      S51.0
//
// p q - s t takes two products, with wide q and t four. One 25 x 18 multiplier (two blocks). Exact.
// Latency LATENCY_CROSS = 4 clocks. Example: 3 5, first, then 2 4, minus -> 7; then 1 1, shift -> 7 2^17 + 1.
module shade_cross (
  input  logic                                   clk_i,
  input  logic                                   first_i,
  input  logic                                   shift_i,
  input  logic                                   minus_i,
  input  logic signed [shade_pkg::COORDINATE_W:0] p_i,
  input  logic signed [                    17:0] q_i,
  output logic signed [     shade_pkg::AREA_W:0] sum_o
);
  localparam int P_W = shade_pkg::COORDINATE_W + 1;
  localparam int SUM_W = shade_pkg::AREA_W + 1;
  localparam int LOW = 17;
  logic signed [P_W+17:0] product;
  logic first, shift, minus;
  shade_mul #(.A_W(P_W), .B_W(18), .STAGES(shade_pkg::LATENCY_MUL_IN)) u_mul (
    .clk_i, .a_i(p_i), .b_i(q_i), .p_o(product)
  );
  shade_delay #(.WIDTH(3), .DEPTH(shade_pkg::LATENCY_MUL_IN)) u_control (
    .clk_i, .d_i({first_i, shift_i, minus_i}), .q_o({first, shift, minus})
  );

  logic [SUM_W-1:0] base;
  assign base = first ? '0 : shift ? {sum_o[SUM_W-LOW-1:0], {LOW{1'b0}}} : sum_o;
  always_ff @(posedge clk_i) sum_o <= base + (SUM_W'(product) ^ {SUM_W{minus}}) + SUM_W'(minus);
endmodule
