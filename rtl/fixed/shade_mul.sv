// SPDX-License-Identifier: Apache-2.0
// shade_mul: p = a b, signed. The only module of Polyshade in which a multiplication stands.
//
// An operand a of more than 18 bits is cut, so that every product fits one 18 x 18 block of any FPGA:
//
//   a = ah 2^17 + al      ah signed, A_W - 17 bits; al unsigned, 17 bits
//   p = (ah b) 2^17 + al b
//
// STAGES = 2: latency LATENCY_MUL = 2 clocks, one product a clock. Registers stand in front of the product and behind it,
// where those of a DSP block are; with a wide a behind the two products and behind their sum.
// STAGES = 3: LATENCY_MUL_IN = 3 clocks, with a wide a registers in front as well. STAGES = 0: combinational, for an
// evaluator whose own register stands behind it.
// Exact, no rounding. Example: a = -3, b = 5 -> p = -15.
module shade_mul #(
  parameter int A_W    = 30,
  parameter int B_W    = 18,
  parameter int STAGES = shade_pkg::LATENCY_MUL
) (
  input  logic                      clk_i,
  input  logic signed [    A_W-1:0] a_i,
  input  logic signed [    B_W-1:0] b_i,
  output logic signed [A_W+B_W-1:0] p_o
);
  if (A_W < 2 || A_W > 35 || B_W < 2 || B_W > 18 || STAGES < 0 || STAGES == 1 || STAGES > 3) begin : g_check
    $error("shade_mul: A_W must be in 2 .. 35, B_W in 2 .. 18 and STAGES 0, LATENCY_MUL or LATENCY_MUL_IN");
  end

  localparam int P_W = A_W + B_W;
  localparam int LOW = 17;
  localparam bit CUT = A_W > 18;
  localparam int HIGH_W = CUT ? A_W - LOW : A_W;

  // registers in front, behind the products and behind their sum
  localparam int IN = STAGES == 0 || (CUT && STAGES == shade_pkg::LATENCY_MUL) ? 0 : 1;
  localparam int PRODUCT = STAGES == 0 ? 0 : 1;
  localparam int SUM = STAGES - IN - PRODUCT;

  // the registers stand in this module, where every tool finds them beside the product
  logic signed [A_W-1:0] a;
  logic signed [B_W-1:0] b;
  logic signed [HIGH_W-1:0] ah;
  logic signed [HIGH_W+B_W-1:0] high, high_p;  // ah b, and behind its register
  logic signed [P_W-1:0] sum;
  if (IN != 0) begin : g_in
    always_ff @(posedge clk_i) {a, b} <= {a_i, b_i};
  end else begin : g_no_in
    assign {a, b} = {a_i, b_i};
  end
  assign ah   = HIGH_W'(a >>> (A_W - HIGH_W));
  assign high = ah * b;
  if (PRODUCT != 0) begin : g_product
    always_ff @(posedge clk_i) high_p <= high;
  end else begin : g_no_product
    assign high_p = high;
  end

  if (CUT) begin : g_cut
    logic signed [LOW:0] al;
    logic signed [LOW+B_W:0] low, low_p;
    assign al  = {1'b0, LOW'(a)};
    assign low = al * b;
    if (PRODUCT != 0) begin : g_product
      always_ff @(posedge clk_i) low_p <= low;
    end else begin : g_no_product
      assign low_p = low;
    end
    // the lower 17 bits of al b are those of p: the adder is that much shorter
    assign sum = {high_p + (HIGH_W + B_W)'(low_p >>> LOW), LOW'(low_p)};
  end else begin : g_whole
    assign sum = high_p;
  end
  if (SUM != 0) begin : g_sum
    always_ff @(posedge clk_i) p_o <= sum;
  end else begin : g_no_sum
    assign p_o = sum;
  end
  if (STAGES == 0) begin : g_combinational
    logic unused_clk;
    assign unused_clk = clk_i;
  end
endmodule
