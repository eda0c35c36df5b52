// SPDX-License-Identifier: Apache-2.0
// shade_scale3: n = v s 2^GAIN, a vector times a number below 1 (GAIN = 0), or twice that (GAIN = 1).
//
//   x_i, y_i, z_i  sd.ffff               S1.16
//   s_i             0.ffff ff            U0.18
//   products       sd.ffff ffff ffff     34 fraction bits, exact
//   x_o, y_o, z_o  sd.ffff               S1.16, to nearest, ties up: error at most 1/2 ulp; |n| <= |v|: no overflow
//
// s has 18 bits without a sign, one more than a signed multiplier takes: v s = v (s - 1/2) + v/2.
// FOLD = 1: three 18 x 18 multipliers, a vector a clock, latency LATENCY_SCALE3 = 3 clocks, ready_o is 1.
// FOLD = 3: one multiplier, the components in turn: a vector in 3 clocks, latency LATENCY_SCALE3_FOLDED = 6 clocks;
//           ready_o tells that this clock takes one; the result holds for the clock of valid_o.
// Example: v = (1, -1, 1/2), s = 1/2 -> n = (1/2, -1/2, 1/4).
module shade_scale3 #(
  parameter int FOLD = 1,
  parameter int GAIN = 0
) (
  input  logic                                     clk_i,
  input  logic                                     rst_i,
  input  logic                                     valid_i,
  output logic                                     ready_o,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] x_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] y_i,
  input  logic signed [shade_pkg::INTENSITY_W-1:0] z_i,
  input  logic        [     shade_pkg::INVC_F-1:0] s_i,
  output logic                                     valid_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] x_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] y_o,
  output logic signed [shade_pkg::INTENSITY_W-1:0] z_o
);
  if (FOLD != 1 && FOLD != 3) begin : g_check
    $error("shade_scale3: FOLD must be 1 or 3");
  end

  localparam int W = shade_pkg::INTENSITY_W;
  localparam int F = shade_pkg::INVC_F;
  localparam int LANES = 3 / FOLD;

  // a lane: product with s - 1/2 (2 clocks), sum with v/2; the half ulp of the rounding makes it (v + 1)/2
  logic [LANES*W-1:0] v, n_q;
  logic [F-1:0] s;
  logic signed [F-1:0] offset;  // s - 1/2, S-1.18
  assign offset = {~s[F-1], s[F-2:0]};
  for (genvar lane = 0; lane < LANES; lane++) begin : g_lane
    localparam int LSB = lane * W;
    logic signed [W+F-1:0] product_q2;
    logic signed [W+F:0] sum;
    logic signed [W+GAIN:0] next_q1, next_q2;
    shade_mul #(.A_W(W), .B_W(F)) u_mul (.clk_i, .a_i(v[LSB+:W]), .b_i(offset), .p_o(product_q2));
    assign sum = (W + F + 1)'(product_q2) + ((W + F + 1)'(next_q2) <<< (F - 1 - GAIN));
    always_ff @(posedge clk_i) begin
      next_q1     <= ((W + 1 + GAIN)'($signed(v[LSB+:W])) <<< GAIN) + (W + 1 + GAIN)'(1);
      next_q2     <= next_q1;
      n_q[LSB+:W] <= W'(sum >>> (F - GAIN));
    end
  end

  if (FOLD == 1) begin : g_parallel
    assign v               = {z_i, y_i, x_i};
    assign s               = s_i;
    assign {z_o, y_o, x_o} = n_q;
    assign ready_o         = 1'b1;
    shade_valid #(.DEPTH(shade_pkg::LATENCY_SCALE3)) u_valid (.clk_i, .rst_i, .valid_i, .valid_o);
  end else begin : g_folded
    logic [1:0] left_q;  // components that still wait for the multiplier
    logic take;
    assign ready_o = !left_q[1];
    assign take    = valid_i && ready_o;
    always_ff @(posedge clk_i) begin
      if (take) left_q <= 2'd3;
      else if (left_q != 2'd0) left_q <= left_q - 2'd1;
      if (rst_i) left_q <= 2'd0;
    end

    logic [3*W-1:0] v_q;  // the component in turn is the lowest
    logic [F-1:0] s_q;
    always_ff @(posedge clk_i) begin
      v_q <= take ? {z_i, y_i, x_i} : v_q >> W;
      if (take) s_q <= s_i;
    end
    assign v = v_q[W-1:0];
    assign s = s_q;

    logic [2*W-1:0] before_q;  // x and y wait for z
    always_ff @(posedge clk_i) before_q <= {n_q, before_q[W+:W]};
    assign {z_o, y_o, x_o} = {n_q, before_q};

    shade_valid #(.DEPTH(shade_pkg::LATENCY_SCALE3_FOLDED)) u_valid (
      .clk_i, .rst_i, .valid_i(take), .valid_o
    );
  end
endmodule
