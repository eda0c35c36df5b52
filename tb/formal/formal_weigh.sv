// SPDX-License-Identifier: Apache-2.0
// formal_weigh: w = K0 + KX x + KY y + KZ z, rounded once: the shifts and adds are the multiplications that they stand for.
module formal_weigh #(
  parameter int WIDTH = 6,
  parameter int F     = 4,
  parameter int OUT_F = 2,
  parameter int OUT_W = 12,
  parameter int K0    = 40960,
  parameter int KX    = -8192,
  parameter int KY    = 3390,
  parameter int KZ    = 1988
) (
  input logic                    clk_i,
  input logic signed [WIDTH-1:0] x_i,
  input logic signed [WIDTH-1:0] y_i,
  input logic signed [WIDTH-1:0] z_i
);
  localparam int LATENCY = shade_pkg::LATENCY_WEIGH;
  localparam int DROP = F + shade_pkg::CONSTANT_F - OUT_F;
  localparam int W = OUT_W + DROP;
  logic signed [OUT_W-1:0] w;
  shade_weigh #(
    .WIDTH(WIDTH), .F(F), .OUT_W(OUT_W), .OUT_F(OUT_F), .K0(K0), .KX(KX), .KY(KY), .KZ(KZ)
  ) u_dut (.clk_i, .x_i, .y_i, .z_i, .w_o(w));

  logic [3:0] age_q = '0;  // clocks since any state
  logic [LATENCY*3*WIDTH-1:0] in_q;
  logic signed [WIDTH-1:0] x, y, z;
  logic signed [W-1:0] sum;
  always_ff @(posedge clk_i) begin
    if (age_q != 4'(LATENCY)) age_q <= age_q + 4'd1;
    in_q <= {in_q[(LATENCY-1)*3*WIDTH-1:0], z_i, y_i, x_i};
  end
  assign {z, y, x} = in_q[LATENCY*3*WIDTH-1-:3*WIDTH];
  assign sum = (W'(K0) <<< F) + W'(KX) * W'(x) + W'(KY) * W'(y) + W'(KZ) * W'(z) + (W'(1) <<< (DROP - 1));
  always_ff @(posedge clk_i) begin
    // Bit for bit, LATENCY_WEIGH clocks later.
    // mutant: SUM_W'(operand) << (DIGIT % DIGITS) => SUM_W'(operand) << (DIGIT % DIGITS + DIGIT / 40)
    if (age_q == 4'(LATENCY)) equal : assert (w == sum[W-1:DROP]);
  end
endmodule
