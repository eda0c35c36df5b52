// shade_pkg: formats, latencies, limits and codes of Polyshade.
//
// Generated from golden/contract.py by `python -m scripts.generate`: change them there.
// W: width in bits, F: fraction bits among them. S1.16: sign, 1 integer bit, 16 fraction bits.
// Latencies are in clocks from an input taken to the output that it causes.

/* verilator lint_off UNUSEDPARAM */  // no single module uses every constant

package shade_pkg;

  // forms of a unit
  localparam int FORM_PAPER = 0;  // exactly what the paper prints
  localparam int FORM_REFINED = 1;  // the paper's idea with its defects repaired; the default everywhere

  // codes
  localparam int NODES_LEFT = 0;  // cubic nodes {0, 1/4, 1/2, 1} (paper P1, first set)
  localparam int NODES_RIGHT = 1;  // cubic nodes {0, 1/2, 3/4, 1} (paper P1, second set)
  localparam int EVALUATOR_HORNER = 0;
  localparam int EVALUATOR_FDIFF = 1;
  localparam int DEGREE_DIRECT = 0;  // up to four pixels, each given by its own intensity
  localparam int DEGREE_LINEAR = 1;
  localparam int DEGREE_QUADRATIC = 2;
  localparam int DEGREE_CUBIC = 3;

  // formats
  localparam int INTENSITY_W = 18;  // S1.16: one signed 18 x 18 multiplier operand on every FPGA
  localparam int INTENSITY_F = 16;
  localparam int COEF_GROWTH = 7;  // |A|, |B|, |C| <= 76 max|I| (node set right, B): seven more bits than an intensity
  localparam int COEF_W = 25;  // S8.16
  localparam int T_F = 16;  // t is U1.16 in [0, 1], 17 bits
  localparam int VALUE_GROWTH = 2;  // |A t^3 + B t^2 + C t + D| <= 3 * 2^8 + 2 < 2^10: two more bits than a coefficient
  localparam int VALUE_W = 27;  // S10.16, the unclamped intensity of a pixel
  localparam int HORNER_GUARD = 3;  // fraction bits that Horner keeps below an ulp; error <= 1/2 + 3/16 ulp
  localparam int PIXEL_W = 16;  // U0.16, clamped to [0, 1 - 2^-16]

  // reciprocal square root
  localparam int RSQRT_W = 36;  // the sum of three squares of S1.16 numbers, exact: U4.32
  localparam int RSQRT_F = 20;  // mantissa U1.20 in (1/2, 1]
  localparam int RSQRT_INDEX_W = 7;  // table: 96 segments of 1/32 over [1, 4), addressed by the first seven bits
  localparam int RSQRT_C0_F = 22;  // coefficients of a segment's parabola in d, the distance from its middle
  localparam int RSQRT_C1_F = 18;
  localparam int RSQRT_C2_F = 12;
  localparam int RSQRT_D_F = 23;  // d is S-6.23 in [-1/64, 1/64): 18 bits

  // spans
  localparam int CHANNELS = 2;  // diffuse, specular
  localparam int NODE_COUNT = 4;
  localparam int LOG2_MAX = 12;  // a span has at most 2^12 pixels
  localparam int COUNT_W = 13;
  localparam int DEGREE_W = 2;
  localparam int TAG_W = 16;
  localparam int PIXELS_MAX = 4096;
  localparam int DIRECT_MAX = 4;  // pixels of a span in direct mode
  localparam int FIFO_LOG2 = 5;  // pixels that shade_poly_span can hold back for a stalled consumer: 2^5

  // packets (AXI4-Stream, one beat each)
  localparam int SPAN_DATA_W = 192;  // node i (0..3) of channel c (0..1) at bit 18 (4 c + i)
  localparam int SPAN_COUNT_LSB = 144;  // pixels of the span
  localparam int SPAN_DEGREE_LSB = 158;  // 0 direct, 1 linear, 2 quadratic, 3 cubic
  localparam int SPAN_TAG_LSB = 160;  // given back with every pixel
  localparam int PIXEL_DATA_W = 32;  // diffuse in the low half, specular in the high half

  // latencies, in clocks from an input taken to the output it causes
  localparam int LATENCY_MUL = 2;  // partial products, their sum
  localparam int LATENCY_THIRD = 5;  // four adders, one rounding
  localparam int LATENCY_COEF = 9;  // differences, two levels of adders, x/3, sum with what is not divided
  localparam int LATENCY_HORNER_STEP = 3;  // product, sum with the next coefficient
  localparam int LATENCY_HORNER_PIPE = 9;
  localparam int LATENCY_HORNER_SEQ = 6;  // clocks a value: load and the five steps of P1, Fig. 9
  localparam int LATENCY_FDIFF = 6;  // two shifter levels, two adder levels, the state, the rounding
  localparam int LATENCY_FIFO = 2;  // memory, output register
  localparam int LATENCY_RSQRT = 9;  // two shifter levels, the table, two steps of Horner's scheme
  localparam int LATENCY_NORMALIZE = 18;  // squares, sums, 1/root, shift, products
  localparam int LATENCY_POLY_SPAN_HORNER = 23;  // span in, walk, ..., clamp, FIFO
  localparam int LATENCY_POLY_SPAN_FDIFF = 20;

  // error bits of shade_poly_span
  localparam int ERROR_EMPTY = 0;  // a span of 0 pixels
  localparam int ERROR_LONG = 1;  // more pixels than 2^LOG2_MAX
  localparam int ERROR_DIRECT = 2;  // direct mode with more than four pixels
  localparam int ERROR_W = 3;

endpackage
/* verilator lint_on UNUSEDPARAM */
