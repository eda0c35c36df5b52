// SPDX-License-Identifier: Apache-2.0
// formal_third: refined, y is the integer nearest to x / 3: 6 y <= 2 x + 3 < 6 y + 6; paper, 43 x / 128 to nearest.
module formal_third #(
  parameter int WIDTH = 18,
  parameter int FORM  = 1
) (
  input logic                    clk_i,
  input logic signed [WIDTH-1:0] x_i
);
  localparam int LATENCY = shade_pkg::LATENCY_THIRD;
  localparam int W = WIDTH + 8;
  logic signed [WIDTH-2:0] y;
  shade_third #(.WIDTH(WIDTH), .FORM(FORM)) u_dut (.clk_i, .x_i, .y_o(y));

  logic [3:0] age_q = '0;  // clocks since any state
  logic [LATENCY*WIDTH-1:0] x_q;
  logic signed [W-1:0] x, sum;
  always_ff @(posedge clk_i) begin
    if (age_q != 4'(LATENCY)) age_q <= age_q + 4'd1;
    x_q <= {x_q[(LATENCY-1)*WIDTH-1:0], x_i};
  end
  assign x   = W'($signed(x_q[LATENCY*WIDTH-1-:WIDTH]));
  assign sum = FORM == shade_pkg::FORM_REFINED ? 2 * x + W'(3) - 6 * W'(y) : 43 * x + W'(64) - 128 * W'(y);
  always_ff @(posedge clk_i) begin
    if (age_q == 4'(LATENCY)) begin
      // The nearest integer, LATENCY_THIRD clocks later.
      // mutant: sum_q3 <= sum_q2 + (sum_q2 >>> BY_8) => sum_q3 <= sum_q2 + (sum_q2 >>> 7)
      nearest : assert (sum >= '0 && sum < (FORM == shade_pkg::FORM_REFINED ? W'(6) : W'(128)));
    end
  end
endmodule
