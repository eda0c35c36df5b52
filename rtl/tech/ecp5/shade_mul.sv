// SPDX-License-Identifier: Apache-2.0
// shade_mul: p = a b, signed: rtl/fixed/shade_mul.sv for Lattice's ECP5, with the registers inside of MULT18X18D.
//
// The same ports, parameters, results and latencies; it takes the place of the generic file in a list of sources. An operand
// a of more than 18 bits is cut in the same way, into the products of two blocks:
//
//   a = ah 2^17 + al      ah signed, A_W - 17 bits; al unsigned, 17 bits
//   p = (ah b) 2^17 + al b
//
// STAGES = 2: registers in front of the product and behind it; with a wide a behind the two products and, in fabric, behind
// their sum. STAGES = 3: in front, within and behind; with a wide a in front, behind the products and behind the sum.
// Latency STAGES clocks, one product a clock. Exact, no rounding. Example: a = -3, b = 5 -> p = -15.
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

  // registers in front, behind the products and behind their sum; those of a whole product are all in the block
  localparam int IN = STAGES == 0 || (CUT && STAGES == shade_pkg::LATENCY_MUL) ? 0 : 1;
  localparam int PRODUCT = STAGES == 0 ? 0 : 1;
  localparam int SUM = STAGES - IN - PRODUCT;

  logic [17:0] ah, b;
  logic [35:0] high;
  assign ah = 18'($signed(a_i[A_W-1-:HIGH_W]));
  assign b  = 18'($signed(b_i));
  shade_mul_block #(.IN(IN), .PIPE(CUT ? 0 : SUM), .OUT(PRODUCT)) u_high (.clk_i, .a_i(ah), .b_i(b), .p_o(high));

  if (CUT) begin : g_cut
    logic [17:0] al;
    logic [35:0] low;
    logic [P_W-1:0] sum;
    assign al = {1'b0, a_i[LOW-1:0]};
    shade_mul_block #(.IN(IN), .OUT(PRODUCT)) u_low (.clk_i, .a_i(al), .b_i(b), .p_o(low));
    // the lower 17 bits of al b are those of p: the adder is that much shorter
    assign sum = {(HIGH_W + B_W)'(high) + (HIGH_W + B_W)'($signed(low[35:LOW])), low[LOW-1:0]};
    if (SUM != 0) begin : g_sum
      always_ff @(posedge clk_i) p_o <= sum;
    end else begin : g_no_sum
      assign p_o = sum;
    end
  end else begin : g_whole
    assign p_o = P_W'(high);
  end
endmodule
