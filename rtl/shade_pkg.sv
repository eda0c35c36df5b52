// SPDX-License-Identifier: Apache-2.0
// shade_pkg: formats, latencies, limits and codes of Polyshade.
//
// Generated from golden/contract.py, golden/registers.py and golden/types.py by `make generate`: change them there.
// W: width in bits, F: fraction bits among them. S1.16: sign, 1 integer bit, 16 fraction bits.
// Latencies are in clocks from an input taken to the output that it causes.

/* verilator lint_off UNUSEDPARAM */  // no single module uses every constant
/* verilator lint_off UNUSEDSIGNAL */  // nor has a word of registers a setting in every bit

package shade_pkg;

  // forms of a unit
  localparam int FORM_PAPER = 0;  // exactly what the paper prints
  localparam int FORM_REFINED = 1;  // the paper's idea with its defects repaired; the default everywhere

  // codes
  localparam int PATH_POLY = 0;  // light at nodes, a polynomial between them (P1)
  localparam int PATH_NORMALS = 1;  // a unit normal and light at every pixel (P4)
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
  localparam int RSQRT_C2_W = 11;  // c2 < 1/2
  localparam int RSQRT_D_F = 23;  // d is S-6.23 in [-1/64, 1/64): 18 bits

  // normals
  localparam int DOT_W = 21;  // S4.16, a dot product: at most 3 * 2 * 2 = 12
  localparam int INVC_F = 18;  // U0.18, what the sum of two normals is multiplied by
  localparam int SQUARE_F = 18;  // fraction bits that are kept of a squared cosine
  localparam int ETA_W = 20;  // S1.18, criterion of a triangle and its threshold
  localparam int ETA_F = 18;
  localparam int CONSTANT_F = 16;  // fraction bits of the following constants
  localparam int INVC_0 = 40960;  // 1/2 + u/8 + 0.0517 u^2 + 0.0303 u^4, u = 1 - c
  localparam int INVC_C = -8192;  // 1/2 + u/8 + 0.0517 u^2 + 0.0303 u^4, u = 1 - c
  localparam int INVC_UU = 3390;  // 1/2 + u/8 + 0.0517 u^2 + 0.0303 u^4, u = 1 - c
  localparam int INVC_UUUU = 1988;  // 1/2 + u/8 + 0.0517 u^2 + 0.0303 u^4, u = 1 - c
  localparam int INVC1_0 = 44761;  // 0.683 - 0.191 c
  localparam int INVC1_C = -12517;  // 0.683 - 0.191 c
  localparam int INVC2_0 = 46072;  // 0.703 - 0.3 c + 0.098 c^2
  localparam int INVC2_C = -19661;  // 0.703 - 0.3 c + 0.098 c^2
  localparam int INVC2_CC = 6423;  // 0.703 - 0.3 c + 0.098 c^2
  localparam int HALF_UU = -2176;  // 1 - u/4 - 17 u^2/512 - 5 u^4/512, and 1 - u/4 = 0.75 + 0.25 c
  localparam int HALF_UUUU = -640;  // 1 - u/4 - 17 u^2/512 - 5 u^4/512, and 1 - u/4 = 0.75 + 0.25 c
  localparam int D2_NEAR_0 = 49152;  // 0.75 + 0.25 c
  localparam int D2_NEAR_C = 16384;  // 0.75 + 0.25 c
  localparam int D2_FAR_0 = 46662;  // 0.712 + 0.305 c
  localparam int D2_FAR_C = 19988;  // 0.712 + 0.305 c
  localparam int D2_LIMIT = 46340;  // floor(2^16 cos(pi/4)): up to here the second
  localparam int D1_0 = 58589;  // 0.894 + 0.06 c + 0.007 m
  localparam int D1_C = 3932;  // 0.894 + 0.06 c + 0.007 m
  localparam int D1_M = 459;  // 0.894 + 0.06 c + 0.007 m
  localparam int METRIC_M_MIN = 3;  // m, the sectors of a line, for which d1a holds
  localparam int METRIC_M_MAX = 12;
  localparam int METRIC_THRESHOLD = 58982;  // 0.9: a shorter middle is normalized
  localparam int ETA_U = 16384;  // u/4 + 35 u^2/1024 + 9 u^4/1024
  localparam int ETA_UU = 2240;  // u/4 + 35 u^2/1024 + 9 u^4/1024
  localparam int ETA_UUUU = 576;  // u/4 + 35 u^2/1024 + 9 u^4/1024
  localparam int ETA1_0 = 18708;  // 0.28546133 - 0.29073021 c
  localparam int ETA1_C = -19053;  // 0.28546133 - 0.29073021 c
  localparam int ETA2_0 = 19152;  // 0.29222919 - 0.34122087 c + 0.04942337 c^2
  localparam int ETA2_C = -22362;  // 0.29222919 - 0.34122087 c + 0.04942337 c^2
  localparam int ETA2_CC = 3239;  // 0.29222919 - 0.34122087 c + 0.04942337 c^2

  // light
  localparam int MODEL_LAMBERT = 0;  // diffuse light alone
  localparam int MODEL_PHONG = 1;  // max(0, R.V)^n
  localparam int MODEL_BLINN = 2;  // max(0, N.H)^n
  localparam int MODEL_SCHLICK = 3;  // c / (n - n c + c), c = N.H
  localparam int MODEL_COOK_TORRANCE = 4;  // F G D / (pi (N.L) (N.V))
  localparam int MODEL_WARD = 5;  // D / (4 pi m^2 sqrt((N.L) (N.V)))
  localparam int MODEL_W = 3;
  localparam int VERSINE_F = 26;  // x = 1 - c of two unit vectors, U2.26 in [0, 2]
  localparam int VERSINE_W = 28;
  localparam int VERSINE_CUT = 6;  // its last bits, which count where the lobe scales x up by them
  localparam int LOBE_K1_F = 20;  // k1 of the shifted x, U1.20 in [0, 2)
  localparam int LOBE_K1_W = 21;
  localparam int LOBE_K2_F = 17;  // k2 of the shifted x, S0.17
  localparam int LOBE_K2_W = 18;
  localparam int LOBE_X_F = 16;  // xmax, U1.16, and the part of the shifted x, U1.20, that a multiplier takes
  localparam int LOBE_SCALED_F = 20;  // fraction bits of the scaled x
  localparam int LOBE_SLOPE_F = 17;  // fraction bits of the shifted x that k2 is multiplied by
  localparam int LOBE_SHIFT_W = 3;  // x is shifted left by 0 .. 6
  localparam int LOBE_POWER_W = 3;  // squarings, 0 .. 4; more count as 4
  localparam int LOBE_FINE = 7;  // this shift means: x as it is, k1 and k2 times 4
  localparam int LOBE_FINE_F = 2;  // that 4 is 2^2
  localparam int LOBE_S_F = 18;  // k1 - k2 x of the shifted x, U1.18; a multiplier takes 17 fraction bits
  localparam int LOBE_ROW_F = 7;  // fraction bits of it that the last four bits of the shifted x are multiplied by
  localparam int LOBE_BIT_F = 4;  // fraction bits of the shifted x that its last bit is multiplied by
  localparam int LOBE_F = 22;  // 1 - base and its powers, U1.22
  localparam int LOBE_Z_F = 18;  // what is squared, S-1.18 with the last bit set
  localparam int GAIN_F = 16;  // mantissa of the gain, U1.16 in [1, 2), or 0
  localparam int GAIN_EXP_W = 6;  // exponent of the gain, -32 .. 31
  localparam int INV_EXP_W = 4;  // 1/n = inv_n 2^-e, inv_n U1.16 in (1/2, 1], e 0 .. 10
  localparam int FACTOR_F = 18;  // w, S0.18 in [-1/2, 0]: a factor 1 + w
  localparam int FACTOR_EXP_W = 7;  // its exponent, -15 .. 33
  localparam int LIGHT_MODEL = 0;  // bits of a node's flags: a reserved model, or one that the parameters leave out
  localparam int LIGHT_RANGE = 1;  // a cosine outside [-1, 1]
  localparam int LIGHT_ZERO = 2;  // a denominator of 0
  localparam int LIGHT_SATURATED = 3;  // diffuse or specular light too large
  localparam int LIGHT_FLAGS_W = 4;
  localparam int FRESNEL_F = 18;  // fraction bits of the powers of 1 - c
  localparam int FOLD_MAX = 8;  // clocks an item of units that share multipliers
  localparam int PHASE_W = 3;  // the clock among these

  // spans
  localparam int CHANNELS = 2;  // diffuse, specular
  localparam int NODE_COUNT = 4;
  localparam int LOG2_MAX = 12;  // a span has at most 2^12 pixels
  localparam int RECORD_LOG2 = 5;  // a record has at most 2^5, by default: that is how wide the forward differences are
  localparam int COUNT_W = 13;
  localparam int PLACE_W = 12;  // a column or a line of the frame, which has at most 2^12 of each
  localparam int DEGREE_W = 2;
  localparam int TAG_W = 16;
  localparam int PIXELS_MAX = 4096;
  localparam int DIRECT_MAX = 4;  // pixels of a span in direct mode
  localparam int NORMAL_FIFO_LOG2 = 6;  // normals that shade_pixel_normals can hold back: more than its latency
  localparam int NODE_F = 15;  // interpolated normals at the nodes, S2.15: before normalizing they may be longer than 1
  localparam int SPAN_FIFO_LOG2 = 6;  // spans that wait for the walk along their nodes: more than the planner's latency
  localparam int RECORD_FIFO_LOG2 = 7;  // records that wait for shade_poly_span: more than the latency from a node to its light
  localparam int PHONG_FIFO_LOG2 = 7;  // pixels that shade_phong can hold back: more than its latency
  localparam int FIFO_LOG2 = 5;  // pixels that shade_poly_span can hold back for a stalled consumer: 2^5

  // planner
  localparam int KAPPA_F = 20;  // kappa and its thresholds, U11.20
  localparam int KAPPA_W = 31;
  localparam int SHARPNESS_F = 16;  // mantissa of the sharpness n, U1.16 in [1, 2)
  localparam int SHARPNESS_EXP_W = 4;  // its exponent, 0 .. 12
  localparam int WEIGHT_W = 3;  // how many times kappa is halved at most where the highlight is far
  localparam int WEIGHT = 5;  // for the highlight of Blinn-Phong
  localparam int LOG2_W = 4;  // the number of an arc's pixels as a power of two
  localparam int LOG2_MIN = 2;  // nodes at a quarter of a record are pixels: 4 pixels at least

  // lines of normals
  localparam int STEP_F = 29;  // S2.29: after 4096 increments, each 1/2 ulp wrong, a component is still right to 1/4 ulp of S1.16
  localparam int STEP_W = 32;
  localparam int VARIANT_REFINED = 0;  // every other normal by the anchored InvC
  localparam int VARIANT_V1 = 1;  // P4: d1a < threshold: InvC1, else the mean
  localparam int VARIANT_V2 = 2;  // d1a < threshold: InvC2, else the mean
  localparam int VARIANT_V3 = 3;  // the mean
  localparam int VARIANT_V4 = 4;  // d2 < threshold: InvC1, else the mean
  localparam int VARIANT_V5 = 5;  // d2 < threshold: InvC2, else the mean
  localparam int VARIANT_V6 = 6;  // the mean
  localparam int VARIANT_EXACT = 7;  // every normal normalized
  localparam int VARIANT_W = 3;

  // triangles
  localparam int SUBPIXEL_F = 8;  // a vertex stands on a grid of 1/256 pixel
  localparam int GROWTH_W = 40;
  localparam int COORDINATE_W = 24;  // S15.8: vertices up to 32768 pixels from the frame's first pixel
  localparam int DEPTH_F = 24;  // depth of a vertex and of a pixel, U0.24 in [0, 1)
  localparam int VERTEX_F = 16;  // components of a vertex' normal, S0.16 in [-1, 1)
  localparam int VERTEX_W = 17;
  localparam int AREA_W = 51;
  localparam int RECIPROCAL_F = 17;  // 1/m of m in [1, 2), U0.17 below 1
  localparam int RECIPROCAL_M_W = 20;  // bits of m that are looked at, U1.19
  localparam int DEPTH_DOWN = 7;  // sums of a depth move down by so much more than those of a normal
  localparam int PLANE_F = 30;  // depth and its increments, S1.30, modulo 4
  localparam int LINE_W = 17;  // a line or column of the plane of vertices, S16
  localparam int REST_W = 26;  // remainder of an edge on its first line
  localparam int CULL_NONE = 0;  // both sides are drawn
  localparam int CULL_BACK = 1;  // triangles that turn clockwise on the screen are left out
  localparam int CULL_FRONT = 2;  // those that turn counter-clockwise
  localparam int CULL_W = 2;

  // direct form
  localparam int DIRECT_A_F = 24;  // N.L, S1.24
  localparam int DIRECT_A_W = 26;
  localparam int DIRECT_H_F = 28;  // N.H, S1.28
  localparam int DIRECT_H_W = 30;
  localparam int DIRECT_P_F = 36;  // N.N, U1.36, modulo 2: after 64 steps right to 2^-25, after 1024 to 2^-17
  localparam int DIRECT_P_W = 37;
  localparam int DIRECT_DIFFUSE_F = 17;  // fraction bits of N.L, N.N, 1 - N.H that are used at the pixel
  localparam int DIRECT_P_OUT_F = 25;
  localparam int DIRECT_X_F = 24;
  localparam int DIRECT_RHO_F = 17;  // of rho and 1 - N.H in products
  localparam int RHO_F = 25;  // rho = 1/sqrt(P) - 1, S0.25
  localparam int RHO_INDEX_W = 8;  // table: segments of 1/128 of P
  localparam int RHO_C0_W = 27;
  localparam int RHO_C1_F = 15;
  localparam int RHO_C2_F = 7;
  localparam int RHO_C2_W = 11;
  localparam int RHO_S_DROP = 17;
  localparam int CHORD_INDEX_W = 10;  // table of the lobe: 1024 chords
  localparam int CHORD_FRACTION_W = 12;  // where on the chord
  localparam int CHORD_SLOPE_F = 20;
  localparam int CHORD_SLOPE_W = 15;
  localparam int CHORD_SHIFT_W = 3;
  localparam int DIRECT_STARTS_LOG2 = 6;  // runs that wait, ready, for the one that is drawn: deep enough for block RAM
  localparam int DIRECT_RUNS_LOG2 = 6;  // runs that wait for their triangle's coefficients
  localparam int DIRECT_FIFO_LOG2 = 6;  // pixels that can be held back: more than the latency
  localparam int EXCESS_W = 10;  // |H| - 1, in units of 2^-24

  // packets (AXI4-Stream, one beat each)
  localparam int RECORD_DATA_W = 192;  // node i (0..3) of channel c (0..1) at bit 18 (4 c + i)
  localparam int RECORD_COUNT_LSB = 144;  // pixels of the span
  localparam int RECORD_MORE = 157;  // the span goes on in the next record: no end of it after this one
  localparam int RECORD_DEGREE_LSB = 158;  // 0 direct, 1 linear, 2 quadratic, 3 cubic
  localparam int RECORD_TAG_LSB = 160;  // given back with every pixel
  localparam int SPAN_DATA_W = 256;  // words of 32 bits: normal x, y, z and increment x, y, z, S2.29 each
  localparam int SPAN_COUNT_LSB = 192;  // normals of the line
  localparam int SPAN_TAG_LSB = 208;
  localparam int SPAN_COS_LSB = 224;  // cosine between the line's end normals, S1.16, for d1a
  localparam int SPAN_FLAT = 242;  // the triangle passed P2's criterion: its normals need no normalizing in diffuse light
  localparam int SURFACE_DATA_W = 64;  // a packet: a triangle in four beats, then its runs, a beat each, tlast with the last
  localparam int TRIANGLE_BEATS = 4;  // box; normal; increment per column; increment per line
  localparam int TRIANGLE_DATA_W = 256;  // the first beat in the lowest bits
  localparam int TRIANGLE_EXP_W = 4;  // of an increment: 2^0 to 2^15
  localparam int VERTEX_DATA_W = 256;  // words of 32 bits; three beats a triangle, tlast with the third
  localparam int NORMAL_DATA_W = 64;  // x, y, z, S1.16, at bit 0, 18, 36
  localparam int PIXEL_DATA_W = 32;  // diffuse in the low half, specular in the high half
  localparam int COLOUR_DATA_W = 48;  // red in the low third, then green, blue

  // patches
  localparam int PATCH_LOG2_MIN = 2;  // boxes of 4 .. 16 pixels a side
  localparam int PATCH_LOG2_MAX = 4;
  localparam int PATCH_SMALL = 6;  // a box of 4 x 4 with no more pixels is lit pixel by pixel
  localparam int PATCH_LIGHTS_MAX = 4;
  localparam int PATCH_PART_F = 15;  // S2.15: a part of a triangle's box times 2^-exp, by which an increment is multiplied
  localparam int PATCH_PLAN_F = 14;  // fraction bits of lengths in the planner
  localparam int PATCH_AWAY_W = 23;  // U7.16: a distance of normals
  localparam int PATCH_RADIUS = 32768;  // U0.16: the longest way of the normal from the middle of a box to its corner, 1/2
  localparam int PATCH_REACH_W = 19;  // U3.16
  localparam int PATCH_VALUE_F = 2;  // more fraction bits of a polynomial
  localparam int PATCH_VALUE_W = 20;  // S1.18: of a lane's state, modulo 4
  localparam int PATCH_FIFO_LOG2 = 9;  // the depth of a block RAM
  localparam int PATCH_WAIT_LOG2 = 11;  // lights that wait for their box to be drawn
  localparam int PATCH_RUNS_LOG2 = 11;  // runs that wait for the plan of their triangle
  localparam int PATCH_PIECES_LOG2 = 11;  // pieces that wait for half of the lanes
  localparam int PATCH_PIXELS_LOG2 = 6;  // pixels that wait for a lane's consumer
  localparam int PATCH_SPARE = 16;  // words that shade_patch_tokens keeps free for what is on its way
  localparam int PATCH_LIGHT_RANGE = 0;  // bits of the flags of patches: a normal or an increment that does not fit S1.16
  localparam int PATCH_LIGHT_SHORT = 1;  // a normal shorter than 1/2
  localparam int PATCH_FLAGS_W = 2;
  localparam int PATCH_AT_W = 10;  // a row, a column of boxes
  localparam int PATCH_LINE_W = 28;  // a run: where it begins and ends, box and pixel
  localparam int PATCH_SCALAR_W = 38;  // S1.36
  localparam int PATCH_RUN_W = 39;  // between the parts of shade_patch, see there
  localparam int PATCH_PLAN_W = 7;
  localparam int PATCH_TOKEN_W = 9;
  localparam int PATCH_BOX_W = 42;
  localparam int PATCH_PLACE_W = 40;
  localparam int PATCH_META_W = 51;
  localparam int PATCH_AREA_W = 44;
  localparam int PATCH_PIECE_W = 164;
  localparam int PATCH_USER_W = 40;  // tuser of shade_patch

  // latencies, in clocks from an input taken to the output it causes
  localparam int LATENCY_MUL = 2;  // operands, product; of wide operands partial products, their sum
  localparam int LATENCY_MUL_IN = 3;  // STAGES = 3: the operands in front of them
  localparam int LATENCY_THIRD = 5;  // four adders, one rounding
  localparam int LATENCY_COEF = 9;  // differences, two levels of adders, x/3, sum with what is not divided
  localparam int LATENCY_HORNER_STEP = 3;  // product, sum with the next coefficient
  localparam int LATENCY_HORNER_PIPE = 9;
  localparam int LATENCY_HORNER_SEQ = 6;  // clocks a value: load and the five steps of P1, Fig. 9
  localparam int LATENCY_FDIFF = 6;  // two shifter levels, two adder levels, the state, the rounding
  localparam int LATENCY_FIFO = 2;  // memory, output register
  localparam int LATENCY_FIFO_BLOCK = 3;  // one more
  localparam int LATENCY_CROSS = 4;  // product, sum
  localparam int LATENCY_EXPONENT = 4;  // four shifter levels
  localparam int LATENCY_RECIPROCAL = 24;  // a bit of the quotient a clock, rounding
  localparam int LATENCY_GRADIENT = 9;  // the sum, three shifter levels, product, two turns of the sum, pair
  localparam int LATENCY_RSQRT = 10;  // two shifter levels, the table, two steps of Horner's scheme
  localparam int LATENCY_NORMALIZE = 19;  // squares, sums, 1/root, shift, products
  localparam int LATENCY_UNIT = 19;  // squares, sums, 1/root, shift, products
  localparam int LATENCY_UNIT_FOLDED = 28;  // FOLD = 3 .. 8: turns of a multiplier
  localparam int LATENCY_WEIGH = 4;  // a tree of adders
  localparam int LATENCY_DOT3 = 4;  // products, two adders
  localparam int LATENCY_HALF = 5;  // the choice of a straight line
  localparam int LATENCY_DOT_SCALED = 5;  // products, sum, two shifter levels
  localparam int LATENCY_INVC = 9;  // u = 1 - c, u^2, u^4
  localparam int LATENCY_SCALE3 = 3;  // products, rounding
  localparam int LATENCY_MIDPOINT = 12;
  localparam int LATENCY_NODE_CHAIN = 21;
  localparam int LATENCY_METRIC = 7;  // clamps, decisions
  localparam int LATENCY_CRITERION = 12;  // u, u^2, u^4, sums of the edges, decision
  localparam int LATENCY_INCREMENT = 2;  // sum, rounding
  localparam int LATENCY_FACTOR_S = 14;  // cosine, factor, choice
  localparam int LATENCY_MIDDLE = 17;  // cosine, factor, choice, scaling
  localparam int LATENCY_PIXEL_NORMALS = 43;
  localparam int LATENCY_VERSINE = 6;  // differences, squares, two adders, clamp
  localparam int LATENCY_REFLECT = 10;  // N.L, its sign and range, products, difference, range
  localparam int LATENCY_HALFWAY = 25;  // sum, H, V.H, clamp
  localparam int LATENCY_FRESNEL = 13;  // u = 1 - c, u^2, u^4, u^5, the blend
  localparam int LATENCY_LOBE_BASE = 11;  // the shifted x; two products, each with a sum and its range
  localparam int LATENCY_LOBE_POWER = 4;  // square, difference, choice of the half
  localparam int LATENCY_LOBE = 27;  // POWER = 4
  localparam int LATENCY_LOBE_FOLDED = 33;  // POWER = 4: the shifted x, six turns of the multiplier
  localparam int LATENCY_GEOMETRY = 22;  // see shade_geometry
  localparam int LATENCY_GAIN = 12;  // products, two shifter levels, rounding
  localparam int LATENCY_FACTOR = 28;  // the lobe or what stands for it; what it is multiplied by
  localparam int LATENCY_ANGLES = 17;  // R, choice of R, V or N, H
  localparam int LATENCY_LIGHT = 57;
  localparam int LATENCY_ANGLES_FOLDED = 11;  // six products, their sums, clamp
  localparam int LATENCY_LIGHT_FOLDED = 56;  // FOLD = 5: 5 more, as of the lobe
  localparam int LATENCY_LIGHT_LOCAL = 72;
  localparam int LATENCY_COLOUR = 6;  // negative light, products, two adders, saturation
  localparam int LATENCY_KAPPA = 15;  // common shift, squares, their sum, product, shift, range
  localparam int LATENCY_WEIGHT = 17;  // what is left of x, its limit
  localparam int LATENCY_PLANNER = 30;  // three places; see planner_latency
  localparam int LATENCY_COLLECT = 1;  // the record
  localparam int LATENCY_NODE_WALK = 5;  // the choice of a run, its step, the run, its node, the rounding
  localparam int LATENCY_LINE = 57;  // span to its first normal
  localparam int LATENCY_LINE_FOLDED = 66;
  localparam int LATENCY_POLY_SPAN_HORNER = 23;  // span in, walk, ..., clamp, FIFO
  localparam int LATENCY_POLY_SPAN_FDIFF = 20;
  localparam int LATENCY_POLY_START = 13;
  localparam int LATENCY_POLY_STATE = 3;  // the state, the rounding, the clamp
  localparam int LATENCY_POLY_LINE = 20;  // one: the specular channel
  localparam int LATENCY_RECORD = 82;  // normal to pixel
  localparam int LATENCY_LANE = 139;
  localparam int LATENCY_LANE_NORMALS = 125;  // the path of normals
  localparam int LATENCY_LANE_FOLDED = 147;
  localparam int LATENCY_CORE = 140;  // the door
  localparam int LATENCY_PAINT = 8;
  localparam int LATENCY_PATCH_NODES = 4;  // the choice of a node, three sums
  localparam int PATCH_LINES_LATE = 3;  // clocks between the two parts of shade_patch_lines
  localparam int LATENCY_PATCH_LINES = 5;  // p X, V, two bits of X each
  localparam int LATENCY_RHO = 8;  // the table, c2 d, s, s d, its rounding, rho
  localparam int LATENCY_CHORD = 6;  // the scaled x, the table, the product, the sum, saturation
  localparam int LATENCY_DIRECT_LIGHT = 17;  // rho, products, sums, the lobe
  localparam int LATENCY_PHONG = 82;  // span, ..., clamp, FIFO

  // products of two 18-bit numbers that a unit computes for each result
  localparam int PRODUCTS_KAPPA = 4;  // for each new increment
  localparam int PRODUCTS_WEIGHT = 3;  // for each span
  localparam int PRODUCTS_NORMALIZE = 11;
  localparam int PRODUCTS_UNIT = 8;
  localparam int PRODUCTS_LIGHT = 15;  // shade_light without the following two
  localparam int PRODUCTS_REFLECT = 3;  // more with REFLECT = 1
  localparam int PRODUCTS_DIVIDE = 6;  // more with DIVIDE = 1
  localparam int PRODUCTS_HORNER = 6;  // of a channel of a pixel; forward differences: none

  // error bits of shade_patch
  localparam int ERROR_EMPTY = 0;  // a triangle without a box
  localparam int ERROR_LONG = 1;  // a run that is empty, beyond the box or out of order
  localparam int ERROR_DIRECT = 2;  // a packet that ends in its head
  localparam int ERROR_W = 3;

  // error bits of shade_direct
  localparam int DIRECT_EMPTY = 0;  // a run of 0 pixels that is not its triangle's last one
  localparam int DIRECT_LONG = 1;  // a run of more than 4096 pixels
  localparam int DIRECT_PACKET = 2;  // a packet that ended before its first run
  localparam int DIRECT_ORDER = 3;  // a run that is not below the last good one of its triangle
  localparam int DIRECT_SHORT = 4;  // a pixel whose normal is shorter than 1/2
  localparam int DIRECT_LARGE = 5;  // a pixel whose normal is longer than 1
  localparam int DIRECT_ERROR_W = 6;

  // registers: byte offset, lowest bit of a field, word after reset
  localparam int REG_ID = 0;  // 0x000, ro
  localparam int REG_ID_RESET = 1347635268;  // 0x50534844
  localparam int REG_VERSION = 4;  // 0x004, ro
  localparam int REG_VERSION_MINOR_LSB = 16;
  localparam int REG_VERSION_MAJOR_LSB = 24;
  localparam int REG_VERSION_RESET = 65536;  // 0x00010000
  localparam int REG_CONTROL = 8;  // 0x008, rw
  localparam int REG_CONTROL_COLOUR_LSB = 1;
  localparam int REG_CONTROL_VARIANT_LSB = 4;
  localparam int REG_CONTROL_FIXED_DEGREE_LSB = 8;
  localparam int REG_CONTROL_CLEAR_LSB = 31;
  localparam int REG_STATUS = 12;  // 0x00c, ro
  localparam int REG_STATUS_ERROR_EMPTY_LSB = 8;
  localparam int REG_STATUS_ERROR_LONG_LSB = 9;
  localparam int REG_STATUS_ERROR_PACKET_LSB = 10;
  localparam int REG_STATUS_ERROR_METRIC_LSB = 11;
  localparam int REG_STATUS_ERROR_THRESHOLD_LSB = 12;
  localparam int REG_STATUS_LIGHT_MODEL_LSB = 16;
  localparam int REG_STATUS_LIGHT_RANGE_LSB = 17;
  localparam int REG_STATUS_LIGHT_ZERO_LSB = 18;
  localparam int REG_STATUS_LIGHT_SATURATED_LSB = 19;
  localparam int REG_STATUS_NORMAL_ZERO_LSB = 24;
  localparam int REG_STATUS_NORMAL_SHORT_LSB = 25;
  localparam int REG_PIXELS = 32;  // 0x020, ro
  localparam int REG_SPANS = 36;  // 0x024, ro
  localparam int REG_CLOCKS = 40;  // 0x028, ro
  localparam int REG_STALLS = 44;  // 0x02c, ro
  localparam int REG_EVALUATIONS = 48;  // 0x030, ro
  localparam int REG_ERRORS = 52;  // 0x034, ro
  localparam int REG_SHARPNESS = 64;  // 0x040, rw
  localparam int REG_SHARPNESS_SHARPNESS_EXP_LSB = 24;
  localparam int REG_SHARPNESS_WEIGHT_LSB = 28;
  localparam int REG_SHARPNESS_RESET = 16842752;  // 0x01010000
  localparam int REG_T1 = 68;  // 0x044, rw
  localparam int REG_T1_RESET = 49152;  // 0x0000c000
  localparam int REG_T2 = 72;  // 0x048, rw
  localparam int REG_T2_RESET = 327680;  // 0x00050000
  localparam int REG_T3 = 76;  // 0x04c, rw
  localparam int REG_T3_RESET = 1048576;  // 0x00100000
  localparam int REG_THRESHOLD = 80;  // 0x050, rw
  localparam int REG_THRESHOLD_RESET = 58982;  // 0x0000e666
  localparam int REG_MODEL = 128;  // 0x080, rw
  localparam int REG_MODEL_COSINE_LSB = 8;
  localparam int REG_K1 = 132;  // 0x084, rw
  localparam int REG_K2 = 136;  // 0x088, rw
  localparam int REG_XMAX = 140;  // 0x08c, rw
  localparam int REG_XMAX_SHIFT_LSB = 24;
  localparam int REG_XMAX_POWER_LSB = 28;
  localparam int REG_XMAX_RESET = 1073741824;  // 0x40000000
  localparam int REG_INV_N = 144;  // 0x090, rw
  localparam int REG_INV_N_INV_N_EXP_LSB = 24;
  localparam int REG_GAIN = 148;  // 0x094, rw
  localparam int REG_GAIN_GAIN_EXP_LSB = 24;
  localparam int REG_F0 = 152;  // 0x098, rw
  localparam int REG_LX = 192;  // 0x0c0, rw
  localparam int REG_LY = 196;  // 0x0c4, rw
  localparam int REG_LZ = 200;  // 0x0c8, rw
  localparam int REG_LZ_RESET = 65536;  // 0x00010000
  localparam int REG_HX = 204;  // 0x0cc, rw
  localparam int REG_HY = 208;  // 0x0d0, rw
  localparam int REG_HZ = 212;  // 0x0d4, rw
  localparam int REG_HZ_RESET = 65536;  // 0x00010000
  localparam int REG_VH = 216;  // 0x0d8, rw
  localparam int REG_VH_RESET = 65536;  // 0x00010000
  localparam int REG_AMBIENT_R = 256;  // 0x100, rw
  localparam int REG_AMBIENT_G = 260;  // 0x104, rw
  localparam int REG_AMBIENT_B = 264;  // 0x108, rw
  localparam int REG_KD_R = 268;  // 0x10c, rw
  localparam int REG_KD_R_RESET = 65536;  // 0x00010000
  localparam int REG_KD_G = 272;  // 0x110, rw
  localparam int REG_KD_G_RESET = 65536;  // 0x00010000
  localparam int REG_KD_B = 276;  // 0x114, rw
  localparam int REG_KD_B_RESET = 65536;  // 0x00010000
  localparam int REG_KS_R = 280;  // 0x118, rw
  localparam int REG_KS_R_RESET = 65536;  // 0x00010000
  localparam int REG_KS_G = 284;  // 0x11c, rw
  localparam int REG_KS_G_RESET = 65536;  // 0x00010000
  localparam int REG_KS_B = 288;  // 0x120, rw
  localparam int REG_KS_B_RESET = 65536;  // 0x00010000

  // widths of the structures below
  localparam int VEC_BITS = 54;
  localparam int STEP_BITS = 96;
  localparam int RGB_BITS = 51;
  localparam int SPAN_BITS = 256;
  localparam int HEAD_BITS = 36;
  localparam int CHANNEL_BITS = 72;
  localparam int RECORD_BITS = 192;
  localparam int GROWTH_BITS = 64;
  localparam int TRIANGLE_BITS = 256;
  localparam int RUN_BITS = 64;
  localparam int OUTWARD_BITS = 96;
  localparam int VERTEX_BITS = 256;
  localparam int SHORT_BITS = 51;
  localparam int CORNER_BITS = 142;
  localparam int SIZED_BITS = 182;
  localparam int SIDE_BITS = 117;
  localparam int EDGE_BITS = 127;
  localparam int WALKED_BITS = 39;
  localparam int SITE_BITS = 24;
  localparam int PAIR_BITS = 81;
  localparam int PLANE_BITS = 128;
  localparam int SPOT_BITS = 88;
  localparam int SURFACE_BITS = 464;
  localparam int BEGUN_BITS = 632;
  localparam int DEEP_BITS = 48;
  localparam int TESTED_BITS = 50;
  localparam int VIEW_BITS = 29;
  localparam int FATE_BITS = 7;
  localparam int SKIPPED_BITS = 96;
  localparam int RGB8_BITS = 24;
  localparam int LOBE_BITS = 64;
  localparam int CHORD_BITS = 32;
  localparam int SCALARS_BITS = 93;
  localparam int COEFFICIENTS_BITS = 390;
  localparam int START_BITS = 252;
  localparam int MOVES_BITS = 58;
  localparam int WAITING_BITS = 55;
  localparam int PIXEL_BITS = 32;
  localparam int COLOURED_BITS = 48;
  localparam int UNIT_BITS = 56;
  localparam int INVC_BITS = 37;
  localparam int METRIC_BITS = 41;
  localparam int CHOICE_BITS = 23;
  localparam int MIDDLE_BITS = 73;
  localparam int ARC_BITS = 271;
  localparam int COSINES_BITS = 54;
  localparam int CRITERION_BITS = 23;
  localparam int JOB_BITS = 209;
  localparam int STRETCH_BITS = 245;
  localparam int PLAN_BITS = 39;
  localparam int TOKEN_BITS = 185;
  localparam int DRAWN_BITS = 49;
  localparam int PLACE_BITS = 40;
  localparam int NODE_BITS = 95;
  localparam int INTENSITY_BITS = 36;
  localparam int FLAGS_BITS = 4;
  localparam int ANGLES_BITS = 84;
  localparam int FACTOR_BITS = 43;
  localparam int COEF_BITS = 93;
  localparam int CONTROL_BITS = 7;
  localparam int PLANNER_BITS = 135;
  localparam int HIGHLIGHT_BITS = 62;
  localparam int MATERIAL_BITS = 127;
  localparam int LIGHT_BITS = 125;
  localparam int COLOUR_BITS = 153;
  localparam int DRAW_BITS = 547;
  localparam int COUNTS_BITS = 15;
  localparam int PAINTED_BITS = 65;
  localparam int NODE_FLAGS_BITS = 6;
  localparam int ERRORS_BITS = 5;
  localparam int TOLD_BITS = 7;
  localparam int STATUS_BITS = 11;

  // a vector; of a node, before it is normalized, S2.15
  typedef struct packed {
    logic signed [17:0] z;  // S1.16
    logic signed [17:0] y;  // S1.16
    logic signed [17:0] x;  // S1.16
  } vec_t;

  // an interpolated normal, or what it grows by
  typedef struct packed {
    logic signed [31:0] z;  // S2.29
    logic signed [31:0] y;  // S2.29
    logic signed [31:0] x;  // S2.29
  } step_t;

  // weights of red, green and blue
  typedef struct packed {
    logic [16:0] b;  // U1.16
    logic [16:0] g;  // U1.16
    logic [16:0] r;  // U1.16
  } rgb_t;

  // a span: a triangle's pixels on one raster line, as scan conversion finds them
  typedef struct packed {
    logic [12:0] unused_243;  // ignored
    logic flat;  // the triangle passed P2's criterion: no normalizing in diffuse light
    logic signed [17:0] cosine;  // S1.16: of the angle between the end normals, for V1 and V2
    logic [15:0] tag;  // given back with every pixel
    logic [2:0] unused_205;  // ignored
    logic [12:0] count;  // pixels, 1 to 4096
    step_t increment;  // its increment per pixel, the same for all spans of a triangle (P4)
    step_t normal;  // interpolated normal of the first pixel
  } span_t;

  // a record, without the light at its nodes
  typedef struct packed {
    logic [3:0] log2;  // log2 of the arc in pixels: the least with count - 1 <= 2^log2
    logic [15:0] tag;  // given back with every pixel
    logic [1:0] degree;  // DEGREE_*
    logic more;  // the span goes on in the next record: no tlast after this one
    logic [12:0] count;  // pixels, 1 to 4096
  } head_t;

  // light of one channel at the nodes of a record
  typedef struct packed {
    logic signed [17:0] n3;  // S1.16
    logic signed [17:0] n2;  // S1.16
    logic signed [17:0] n1;  // S1.16
    logic signed [17:0] n0;  // S1.16
  } channel_t;

  // a record: the light at the nodes of one polynomial
  typedef struct packed {
    logic [11:0] unused_180;  // ignored
    head_t head;  // a record, without the light at its nodes
    channel_t specular;  // specular light at its nodes
    channel_t diffuse;  // diffuse light at its nodes
  } record_t;

  // what an interpolated normal grows by from pixel to pixel, or from line to line
  typedef struct packed {
    logic [5:0] unused_58;  // ignored
    logic [3:0] exp;  // as wide as it fits, so that no bit is lost
    vec_t mantissa;  // increment times 2^exp
  } growth_t;

  // a triangle: its interpolated normal is a linear function of column and line; its runs follow in the same packet
  typedef struct packed {
    growth_t dline;  // its increment per line
    growth_t dcolumn;  // its increment per column (P4)
    logic [9:0] unused_118;  // ignored
    vec_t normal;  // interpolated normal at the reference pixel: the first one of the first run
    logic [15:0] tag;  // given back with every pixel
    logic [2:0] unused_45;  // ignored
    logic flat;  // the triangle passed P2's criterion: no normalizing in diffuse light
    logic [11:0] left;  // columns of the box on the left of the reference pixel
    logic [2:0] unused_29;  // ignored
    logic [12:0] lines;  // of the box of all pixels, 1 to 4096
    logic [2:0] unused_13;  // ignored
    logic [12:0] columns;  // of the box of all pixels, 1 to 4096
  } triangle_t;

  // a run: pixels of the triangle on one raster line; runs come line by line, downwards, at least one a triangle
  typedef struct packed {
    logic [18:0] unused_45;  // ignored
    logic [12:0] count;  // pixels, at least 1; also 0 in a triangle's last run, and in its first, whose place counts
    logic [3:0] unused_28;  // ignored
    logic [11:0] line;  // its raster line
    logic [3:0] unused_12;  // ignored
    logic [11:0] column;  // its first pixel
  } run_t;

  // a normal of any length but 0, components in [-1, 1)
  typedef struct packed {
    logic signed [31:0] z;  // S15.16
    logic signed [31:0] y;  // S15.16
    logic signed [31:0] x;  // S15.16
  } outward_t;

  // a vertex of a triangle, after projection; of tag and flat those of the first one count
  typedef struct packed {
    logic [46:0] unused_209;  // ignored
    logic flat;  // the triangle passed P2's criterion: no normalizing in diffuse light
    logic [15:0] tag;  // given back with every pixel
    outward_t normal;  // a normal of any length but 0, components in [-1, 1)
    logic [31:0] depth;  // U8.24: 0 to 1 - 2^-24, less is nearer
    logic signed [31:0] y;  // S23.8: line in 1/256 pixel, downwards
    logic signed [31:0] x;  // S23.8: column in 1/256 pixel, -32768 to 32768 pixels; column 0 has its centre at 128
  } vertex_t;

  // a normal
  typedef struct packed {
    logic signed [16:0] z;  // S0.16
    logic signed [16:0] y;  // S0.16
    logic signed [16:0] x;  // S0.16
  } short_t;

  // what a triangle has of its vertex 0
  typedef struct packed {
    logic flat;
    logic [15:0] tag;
    logic [23:0] depth;  // U0.24
    short_t normal;  // a normal
    logic signed [24:0] y;  // S16.8: plus 127
    logic signed [24:0] x;  // S16.8: plus 127
  } corner_t;

  // a triangle without its increments
  typedef struct packed {
    logic wide;  // its differences of x and y are wider than 17 bits
    logic [12:0] bottom;  // the line behind its last
    logic [12:0] right;  // the one behind its last
    logic [12:0] left;  // first column of the box
    corner_t corner;  // what a triangle has of its vertex 0
  } sized_t;

  // an edge of a triangle, see shade_edges
  typedef struct packed {
    logic right;
    logic [7:0] t;
    logic [7:0] u;
    logic [16:0] lines;
    logic signed [16:0] line;  // S17
    logic signed [16:0] column;  // S17
    logic [23:0] dy;  // U16.8
    logic signed [24:0] dx;  // S16.8
  } side_t;

  // an edge, from its first line on, see shade_edges
  typedef struct packed {
    logic right;
    logic [16:0] lines;
    logic signed [16:0] line;  // S17
    logic signed [16:0] column;  // S17
    logic [23:0] dy;  // U16.8
    logic signed [24:0] dx;  // S16.8
    logic signed [25:0] rest;  // S26
  } edge_t;

  // a run as shade_raster gives it
  typedef struct packed {
    logic none;  // no run: it stands for the end of a triangle
    logic last;  // of its triangle
    logic [12:0] count;
    logic [11:0] line;
    logic [11:0] column;
  } walked_t;

  // a pixel of the frame
  typedef struct packed {
    logic [11:0] line;
    logic [11:0] column;
  } site_t;

  // increments of a component: S10.29 of a normal, S9.30 of a depth, modulo their widths
  typedef struct packed {
    logic steep;  // one of them is not in S2.29, S1.30
    logic signed [39:0] line;  // S10.29
    logic signed [39:0] column;  // S10.29
  } pair_t;

  // normal and depth, or what they grow by, modulo 4
  typedef struct packed {
    logic signed [31:0] depth;  // S1.30
    step_t normal;  // an interpolated normal, or what it grows by
  } plane_t;

  // where a span begins: its first pixel, and depth there and per pixel, modulo 4
  typedef struct packed {
    logic signed [31:0] increase;  // S1.30
    logic signed [31:0] depth;  // S1.30
    logic [11:0] line;
    logic [11:0] column;
  } spot_t;

  // a triangle whose runs follow on a stream of their own
  typedef struct packed {
    logic steep;  // an increment of its normal is not in S2.29: what stands here is it modulo 8
    logic flat;
    logic [15:0] tag;
    logic [11:0] left;  // columns of the box on the left of the first pixel
    logic [12:0] lines;
    logic [12:0] columns;  // of a box that holds all pixels
    site_t site;  // that pixel
    plane_t dline;  // normal and depth, or what they grow by, modulo 4
    plane_t dcolumn;  // normal and depth, or what they grow by, modulo 4
    plane_t value;  // at the first pixel of the first run
  } surface_t;

  // a run, and what its triangle's normal and depth are where it begins
  typedef struct packed {
    logic first;  // of its triangle
    walked_t run;  // a run as shade_raster gives it
    plane_t value;  // at the first pixel of the run
    surface_t surface;  // a triangle whose runs follow on a stream of their own
  } begun_t;

  // the depth of a pixel
  typedef struct packed {
    logic [23:0] depth;  // U0.24
    site_t site;  // a pixel of the frame
  } deep_t;

  // a pixel whose depth is compared
  typedef struct packed {
    logic last;  // of its triangle
    logic ends;  // the last pixel of its run
    deep_t deep;  // the depth of a pixel
  } tested_t;

  // the frame, and what of a triangle is drawn in it; to be changed between frames only
  typedef struct packed {
    logic flat;  // all of a triangle has the normal of vertex 0
    logic [1:0] cull;  // CULL_*
    logic [12:0] lines;  // 1 to 4096
    logic [12:0] columns;  // 1 to 4096
  } view_t;

  // what became of a triangle, or of a packet that gives none
  typedef struct packed {
    logic between;  // left out: between the centres of pixels
    logic outside;  // left out: outside of the frame
    logic culled;  // left out: seen from the side that is culled
    logic area;  // skipped: no area
    logic normal;  // skipped: a normal of length 0
    logic range;  // skipped: a number out of its range
    logic packet;  // skipped: other than three vertices
  } fate_t;

  // how many triangles and packets were skipped since reset, each saturating
  typedef struct packed {
    logic [15:0] empty;  // without a pixel in the frame
    logic [15:0] culled;  // seen from the side that is culled
    logic [15:0] area;  // no area
    logic [15:0] normal;  // a normal of length 0
    logic [15:0] range;  // a number out of its range
    logic [15:0] packet;  // packets of other than three vertices
  } skipped_t;

  // a pixel of a picture
  typedef struct packed {
    logic [7:0] blue;  // U0.8
    logic [7:0] green;  // U0.8
    logic [7:0] red;  // U0.8
  } rgb8_t;

  // the head of a packet that fills the table of the lobe; entries follow, a beat each, from the first one on
  typedef struct packed {
    logic [15:0] unused_48;  // ignored
    logic lobe;  // 1; of a triangle 0
    logic [20:0] unused_26;  // ignored
    logic signed [9:0] excess;  // S-15.24: |H| - 1 of the quantized H
    logic [12:0] unused_3;  // ignored
    logic [2:0] shift;  // the table covers x = 1 - cos from 0 to 2^-shift
  } lobe_t;

  // an entry of the table of the lobe
  typedef struct packed {
    logic signed [14:0] slope;  // S-6.20: what it grows by to the next entry
    logic [16:0] value;  // U1.16: specular light at its x
  } chord_t;

  // the scalars of a pixel, from which its light is computed
  typedef struct packed {
    logic [36:0] p;  // U1.36: N.N
    logic signed [29:0] h;  // S1.28: N.H
    logic signed [25:0] a;  // S1.24: N.L
  } scalars_t;

  // the scalars of a triangle as polynomials of column and line
  typedef struct packed {
    logic [36:0] p_both;  // U1.36: what p_column grows by per line
    logic [36:0] p_lines;  // U1.36: half of what p_line grows by per line
    logic [36:0] p_columns;  // U1.36: half of what p_column grows by per column
    logic [36:0] p_line;  // U1.36: what it grows by to the next line
    logic [36:0] p_column;  // U1.36: what it grows by to the next column
    logic [36:0] p;  // U1.36: N.N
    logic signed [29:0] h_line;  // S1.28: N.H
    logic signed [29:0] h_column;  // S1.28: N.H
    logic signed [29:0] h;  // S1.28: N.H
    logic signed [25:0] a_line;  // S1.24: N.L
    logic signed [25:0] a_column;  // S1.24: N.L
    logic signed [25:0] a;  // S1.24: N.L
  } coefficients_t;

  // a run that is ready to be stepped
  typedef struct packed {
    logic [15:0] tag;  // the triangle's
    logic [12:0] count;  // pixels, 1 to 4096
    logic [36:0] p_columns;  // U1.36: half of what p_column grows by per pixel
    logic signed [29:0] h_column;  // S1.28: what h grows by per pixel
    logic signed [25:0] a_column;  // S1.24: what a grows by per pixel
    logic [36:0] p_column;  // U1.36: what p grows by to the next pixel
    scalars_t at;  // the scalars at its first pixel
  } start_t;

  // how a run's first pixel is reached from that of the run before
  typedef struct packed {
    logic [15:0] tag;  // the triangle's
    logic [12:0] count;  // its pixels
    logic last;  // the triangle's last run
    logic first;  // the triangle's first run: no moves
    logic good;  // the run is drawn
    logic signed [12:0] columns;  // S12.0: columns to the right, negative: to the left
    logic [12:0] lines;  // lines down, beside the one that every start makes
  } moves_t;

  // a run that waits for its triangle's coefficients
  typedef struct packed {
    logic [15:0] tag;  // the triangle's
    logic last;  // the triangle's last run
    logic first;  // the triangle's first run
    logic [12:0] count;  // its pixels
    logic [11:0] line;  // its raster line
    logic [11:0] column;  // its first pixel
  } waiting_t;

  // a pixel
  typedef struct packed {
    logic [15:0] specular;  // U0.16
    logic [15:0] diffuse;  // U0.16
  } pixel_t;

  // a coloured pixel
  typedef struct packed {
    logic [15:0] blue;  // U0.16
    logic [15:0] green;  // U0.16
    logic [15:0] red;  // U0.16
  } coloured_t;

  // a unit normal
  typedef struct packed {
    logic too_short;  // made of a vector shorter than 1/8: not of unit length
    logic zero;  // made of a vector of length 0
    vec_t normal;  // a vector; of a node, before it is normalized, S2.15
  } unit_t;

  // what the middle of two unit normals needs
  typedef struct packed {
    logic clamped;  // their cosine was not in [0, 1]
    logic signed [17:0] half;  // S1.16: cosine of half their angle
    logic [17:0] invc;  // U0.18: what their sum is multiplied by
  } invc_t;

  // how long the middle of two unit normals is, by P4's estimates
  typedef struct packed {
    logic threshold_error;  // the threshold was not in [0, 1]
    logic m_error;  // m was not in 3 .. 12
    logic clamped;  // the cosine was not in [0, 1]
    logic needs_d2;  // d2 is below the threshold
    logic needs_d1;  // d1a is below the threshold
    logic signed [17:0] d2;  // S1.16: by the two
    logic signed [17:0] d1a;  // S1.16: by the ends of their line
  } metric_t;

  // how the middle of two unit normals is made
  typedef struct packed {
    logic signed [17:0] threshold;  // S1.16: of d2
    logic needs_d1;  // d1a is below the threshold
    logic [2:0] variant;  // VARIANT_*
    logic middle;  // 0: it is the first of both
  } choice_t;

  // the unit normal in the middle of two
  typedef struct packed {
    logic clamped;  // their cosine was not in [0, 1]
    logic signed [17:0] half;  // S1.16: cosine of half their angle
    vec_t normal;  // a vector; of a node, before it is normalized, S2.15
  } middle_t;

  // unit normals along an arc
  typedef struct packed {
    logic clamped;  // the cosine of its ends was not in [0, 1]
    vec_t n4;  // at 4/4
    vec_t n3;  // at 3/4
    vec_t n2;  // at 2/4
    vec_t n1;  // at 1/4
    vec_t n0;  // at 0/4
  } arc_t;

  // of the angles between the normals of a triangle
  typedef struct packed {
    logic signed [17:0] ca;  // S1.16
    logic signed [17:0] bc;  // S1.16
    logic signed [17:0] ab;  // S1.16
  } cosines_t;

  // whether a triangle's normals must be normalized, by P2
  typedef struct packed {
    logic threshold_error;  // the threshold was not in [0, 1]
    logic clamped;  // a cosine was not in [0, 1]
    logic normalize;  // eta is above the threshold
    logic signed [19:0] eta;  // S1.18: how much too dark it gets otherwise
  } criterion_t;

  // a span on its way to its nodes
  typedef struct packed {
    logic [15:0] tag;  // given back with every pixel
    logic flat;  // its normals need no normalizing
    step_t increment;  // its increment per pixel
    step_t normal;  // interpolated normal of the first pixel
  } job_t;

  // records of one kind, one after the other
  typedef struct packed {
    logic fresh;  // the first of a span
    logic shared;  // its first node is the last one before
    logic more;  // the span goes on behind it
    logic single;  // it is 1
    logic [12:0] records;  // their number
    logic [12:0] count;  // pixels of a record
    logic [3:0] log2;  // of the arc of a record
    logic [1:0] degree;  // of its records
    logic flat;  // its normals need no normalizing
    logic [15:0] tag;  // of the span
    step_t step;  // increment of a normal from node to node
    step_t normal;  // of its first pixel
  } stretch_t;

  // how a span is cut into records
  typedef struct packed {
    logic split;  // main is not 0
    logic [1:0] last_degree;  // its degree
    logic [3:0] last_log2;  // log2 of the arc that it lies on
    logic [12:0] last_count;  // pixels of the last record
    logic [1:0] degree;  // their degree
    logic [3:0] log2;  // log2 of their pixels
    logic [12:0] main;  // records before the last one
  } plan_t;

  // a pixel before it is computed: the record's nodes and where on its arc it lies
  typedef struct packed {
    logic [15:0] tag;  // of the span
    logic [3:0] log2;  // of the arc
    logic [16:0] t;  // U1.16: place on the arc
    logic last;  // the last pixel of a span
    logic first;  // a segment starts
    logic [1:0] degree;  // of the record
    channel_t specular;  // light of one channel at the nodes of a record
    channel_t diffuse;  // light of one channel at the nodes of a record
  } token_t;

  // a pixel on its way out
  typedef struct packed {
    logic last;  // the last pixel of the span
    logic [15:0] tag;  // of its span
    pixel_t pixel;  // a pixel
  } drawn_t;

  // where a node stands in its record
  typedef struct packed {
    head_t head;  // the record, taken with its last node
    logic last;  // the record is complete
    logic shared;  // first node of a record whose slot 0 is the node before
    logic [1:0] slot;  // number of the node
  } place_t;

  // a point where light is computed
  typedef struct packed {
    place_t place;  // where a node stands in its record
    logic flat;  // the normal needs no normalizing
    vec_t normal;  // its normal
  } node_t;

  // light at a point
  typedef struct packed {
    logic signed [17:0] specular;  // S1.16
    logic signed [17:0] diffuse;  // S1.16
  } intensity_t;

  // what can be said of the light at a point
  typedef struct packed {
    logic saturated;  // light beyond its format
    logic zero;  // a denominator of 0: no specular light
    logic range;  // a cosine outside [-1, 1]
    logic model;  // a reserved model, or one that was not built in
  } flags_t;

  // the cosines at a point
  typedef struct packed {
    logic x_range;  // x was outside [0, 2]
    logic nv_range;  // N.V was outside [-1, 1]
    logic nl_range;  // N.L was outside [-1, 1]
    logic saturated;  // N.L was beyond its format
    logic [27:0] x;  // U2.26: 1 less the cosine that the lobe is a function of
    logic [16:0] nv;  // U1.16: N.V in [0, 1]
    logic [16:0] nl;  // U1.16: N.L in [0, 1]
    logic signed [17:0] diffuse;  // S1.16: N.L, saturated
  } angles_t;

  // what a lobe is multiplied by: num (1 + w) 2^e
  typedef struct packed {
    logic zero;  // there is none: a denominator of 0
    logic signed [6:0] e;  // S6.0
    logic signed [17:0] w;  // S0.18
    logic [16:0] num;  // U1.16
  } factor_t;

  // A t^3 + B t^2 + C t + D
  typedef struct packed {
    logic signed [24:0] a;  // S8.16
    logic signed [24:0] b;  // S8.16
    logic signed [24:0] c;  // S8.16
    logic signed [17:0] d;  // S1.16
  } coef_t;

  // the way through the core
  typedef struct packed {
    logic [1:0] fixed_degree;  // 0: adaptive, 1 to 3: of every span, as in P1
    logic [2:0] variant;  // of path 1, VARIANT_*
    logic colour;  // pixels are 0: diffuse and specular light, 1: weighted red, green, blue
    logic path;  // 0: polynomials, 1: a unit normal at every pixel
  } control_t;

  // what the planner goes by
  typedef struct packed {
    logic signed [17:0] threshold;  // S1.16: V1, V2, V4, V5: a shorter middle is normalized
    logic [30:0] t3;  // U11.20: kappa up to which a cubic is enough
    logic [30:0] t2;  // U11.20: kappa up to which a parabola is enough
    logic [30:0] t1;  // U11.20: kappa up to which a line is enough
    logic [2:0] weight;  // how many times kappa is halved at most where the highlight is far; 0: not at all
    logic [3:0] sharpness_exp;  // and exponent, 0 to 12
    logic [16:0] sharpness;  // U1.16: n of the cos^n that turns as fast as the highlight, mantissa
  } planner_t;

  // the lobe of a material
  typedef struct packed {
    logic [2:0] power;  // squarings of the lobe, 0 to 4; more count as 4
    logic [2:0] shift;  // x is scaled by 2^shift; 7: not, but k1 and k2 are by 4
    logic [16:0] xmax;  // U1.16: limit of the scaled x
    logic signed [17:0] k2;  // S0.17: of the lobe, for the scaled x
    logic [20:0] k1;  // U1.20: of the lobe, for the scaled x
  } highlight_t;

  // a material
  typedef struct packed {
    logic [16:0] f0;  // U1.16: Fresnel's factor at V.H = 1, where it is computed at every node
    logic signed [5:0] gain_exp;  // S5.0: and exponent
    logic [16:0] gain;  // U1.16: of specular light, mantissa
    logic [3:0] inv_n_exp;  // and negative exponent
    logic [16:0] inv_n;  // U1.16: Schlick: 1/n, mantissa
    highlight_t lobe;  // the lobe of a material
    logic cosine;  // specular light is multiplied by N.L
    logic [2:0] model;  // MODEL_*
  } material_t;

  // a directional light
  typedef struct packed {
    logic [16:0] vh;  // U1.16: V.H
    vec_t h;  // half way between it and the viewer's
    vec_t l;  // direction to the light
  } light_t;

  // the colours of surface and light
  typedef struct packed {
    rgb_t ks;  // weight of specular light
    rgb_t kd;  // weight of diffuse light
    rgb_t ambient;  // ambient light
  } colour_t;

  // the settings of a draw call: what can be written, docs/registers.md
  typedef struct packed {
    colour_t colour;  // the colours of surface and light
    light_t light;  // a directional light
    material_t material;  // a material
    planner_t planner;  // what the planner goes by
    control_t control;  // the way through the core
  } draw_t;

  // by how much the counters rise in a clock
  typedef struct packed {
    logic [2:0] errors;
    logic [2:0] evaluations;
    logic [2:0] stalls;
    logic [2:0] spans;
    logic [2:0] pixels;
  } counts_t;

  // a coloured pixel on its way out
  typedef struct packed {
    logic last;  // the last pixel of the span
    logic [15:0] tag;  // of its span
    coloured_t pixel;  // a coloured pixel
  } painted_t;

  // what can be said of a point: its light and its normal
  typedef struct packed {
    logic normal_short;  // a normal too short to be brought to length 1
    logic normal_zero;  // a normal of length 0
    flags_t light;  // what can be said of the light at a point
  } node_flags_t;

  // faults of a span
  typedef struct packed {
    logic threshold;  // threshold outside [0, 1]
    logic metric;  // V1, V2: fewer than 3 sectors or more than 12
    logic packet;  // a packet cut short or too long
    logic too_long;  // a span of more than 4096 pixels
    logic empty;  // a span of 0 pixels
  } errors_t;

  // what is told of a packet of spans, once for each
  typedef struct packed {
    errors_t error;  // faults of a span
    logic bad;  // it was none
    logic good;  // it was a span
  } told_t;

  // what STATUS remembers
  typedef struct packed {
    node_flags_t node;  // what can be said of a point: its light and its normal
    errors_t error;  // faults of a span
  } status_t;

  localparam draw_t DRAW_RESET = {
    17'd65536,  // colour.ks.b
    17'd65536,  // colour.ks.g
    17'd65536,  // colour.ks.r
    17'd65536,  // colour.kd.b
    17'd65536,  // colour.kd.g
    17'd65536,  // colour.kd.r
    17'd0,  // colour.ambient.b
    17'd0,  // colour.ambient.g
    17'd0,  // colour.ambient.r
    17'd65536,  // light.vh
    18'd65536,  // light.h.z
    18'd0,  // light.h.y
    18'd0,  // light.h.x
    18'd65536,  // light.l.z
    18'd0,  // light.l.y
    18'd0,  // light.l.x
    17'd0,  // material.f0
    6'd0,  // material.gain_exp
    17'd0,  // material.gain
    4'd0,  // material.inv_n_exp
    17'd0,  // material.inv_n
    3'd4,  // material.lobe.power
    3'd0,  // material.lobe.shift
    17'd0,  // material.lobe.xmax
    18'd0,  // material.lobe.k2
    21'd0,  // material.lobe.k1
    1'd0,  // material.cosine
    3'd0,  // material.model
    18'd58982,  // planner.threshold
    31'd1048576,  // planner.t3
    31'd327680,  // planner.t2
    31'd49152,  // planner.t1
    3'd0,  // planner.weight
    4'd1,  // planner.sharpness_exp
    17'd65536,  // planner.sharpness
    2'd0,  // control.fixed_degree
    3'd0,  // control.variant
    1'd0,  // control.colour
    1'd0  // control.path
  };

  // one register of all
  typedef struct packed {
    logic id;
    logic version;
    logic control;
    logic status;
    logic pixels;
    logic spans;
    logic clocks;
    logic stalls;
    logic evaluations;
    logic errors;
    logic sharpness;
    logic t1;
    logic t2;
    logic t3;
    logic threshold;
    logic model;
    logic k1;
    logic k2;
    logic xmax;
    logic inv_n;
    logic gain;
    logic f0;
    logic lx;
    logic ly;
    logic lz;
    logic hx;
    logic hy;
    logic hz;
    logic vh;
    logic ambient_r;
    logic ambient_g;
    logic ambient_b;
    logic kd_r;
    logic kd_g;
    logic kd_b;
    logic ks_r;
    logic ks_g;
    logic ks_b;
  } select_t;

  // the register at an offset; nothing where there is none
  function automatic select_t register_at(input logic [11:0] offset);
    register_at = {
      offset == 12'(REG_ID),
      offset == 12'(REG_VERSION),
      offset == 12'(REG_CONTROL),
      offset == 12'(REG_STATUS),
      offset == 12'(REG_PIXELS),
      offset == 12'(REG_SPANS),
      offset == 12'(REG_CLOCKS),
      offset == 12'(REG_STALLS),
      offset == 12'(REG_EVALUATIONS),
      offset == 12'(REG_ERRORS),
      offset == 12'(REG_SHARPNESS),
      offset == 12'(REG_T1),
      offset == 12'(REG_T2),
      offset == 12'(REG_T3),
      offset == 12'(REG_THRESHOLD),
      offset == 12'(REG_MODEL),
      offset == 12'(REG_K1),
      offset == 12'(REG_K2),
      offset == 12'(REG_XMAX),
      offset == 12'(REG_INV_N),
      offset == 12'(REG_GAIN),
      offset == 12'(REG_F0),
      offset == 12'(REG_LX),
      offset == 12'(REG_LY),
      offset == 12'(REG_LZ),
      offset == 12'(REG_HX),
      offset == 12'(REG_HY),
      offset == 12'(REG_HZ),
      offset == 12'(REG_VH),
      offset == 12'(REG_AMBIENT_R),
      offset == 12'(REG_AMBIENT_G),
      offset == 12'(REG_AMBIENT_B),
      offset == 12'(REG_KD_R),
      offset == 12'(REG_KD_G),
      offset == 12'(REG_KD_B),
      offset == 12'(REG_KS_R),
      offset == 12'(REG_KS_G),
      offset == 12'(REG_KS_B)
    };
  endfunction

  // the word of the settings that are selected, else 0
  function automatic logic [31:0] draw_word(input draw_t draw, input select_t select);
    draw_word = 32'd0;
    draw_word[0+:1] |= {1{select[35]}} & draw[0+:1];  // path
    draw_word[1+:1] |= {1{select[35]}} & draw[1+:1];  // colour
    draw_word[4+:3] |= {3{select[35]}} & draw[2+:3];  // variant
    draw_word[8+:2] |= {2{select[35]}} & draw[5+:2];  // fixed_degree
    draw_word[0+:17] |= {17{select[27]}} & draw[7+:17];  // sharpness
    draw_word[24+:4] |= {4{select[27]}} & draw[24+:4];  // sharpness_exp
    draw_word[28+:3] |= {3{select[27]}} & draw[28+:3];  // weight
    draw_word[0+:31] |= {31{select[26]}} & draw[31+:31];  // t1
    draw_word[0+:31] |= {31{select[25]}} & draw[62+:31];  // t2
    draw_word[0+:31] |= {31{select[24]}} & draw[93+:31];  // t3
    draw_word[0+:18] |= {18{select[23]}} & draw[124+:18];  // threshold
    draw_word[0+:3] |= {3{select[22]}} & draw[142+:3];  // model
    draw_word[8+:1] |= {1{select[22]}} & draw[145+:1];  // cosine
    draw_word[0+:21] |= {21{select[21]}} & draw[146+:21];  // k1
    draw_word[0+:18] |= {18{select[20]}} & draw[167+:18];  // k2
    draw_word[0+:17] |= {17{select[19]}} & draw[185+:17];  // xmax
    draw_word[24+:3] |= {3{select[19]}} & draw[202+:3];  // shift
    draw_word[28+:3] |= {3{select[19]}} & draw[205+:3];  // power
    draw_word[0+:17] |= {17{select[18]}} & draw[208+:17];  // inv_n
    draw_word[24+:4] |= {4{select[18]}} & draw[225+:4];  // inv_n_exp
    draw_word[0+:17] |= {17{select[17]}} & draw[229+:17];  // gain
    draw_word[24+:6] |= {6{select[17]}} & draw[246+:6];  // gain_exp
    draw_word[0+:17] |= {17{select[16]}} & draw[252+:17];  // f0
    draw_word[0+:18] |= {18{select[15]}} & draw[269+:18];  // lx
    draw_word[0+:18] |= {18{select[14]}} & draw[287+:18];  // ly
    draw_word[0+:18] |= {18{select[13]}} & draw[305+:18];  // lz
    draw_word[0+:18] |= {18{select[12]}} & draw[323+:18];  // hx
    draw_word[0+:18] |= {18{select[11]}} & draw[341+:18];  // hy
    draw_word[0+:18] |= {18{select[10]}} & draw[359+:18];  // hz
    draw_word[0+:17] |= {17{select[9]}} & draw[377+:17];  // vh
    draw_word[0+:17] |= {17{select[8]}} & draw[394+:17];  // ambient_r
    draw_word[0+:17] |= {17{select[7]}} & draw[411+:17];  // ambient_g
    draw_word[0+:17] |= {17{select[6]}} & draw[428+:17];  // ambient_b
    draw_word[0+:17] |= {17{select[5]}} & draw[445+:17];  // kd_r
    draw_word[0+:17] |= {17{select[4]}} & draw[462+:17];  // kd_g
    draw_word[0+:17] |= {17{select[3]}} & draw[479+:17];  // kd_b
    draw_word[0+:17] |= {17{select[2]}} & draw[496+:17];  // ks_r
    draw_word[0+:17] |= {17{select[1]}} & draw[513+:17];  // ks_g
    draw_word[0+:17] |= {17{select[0]}} & draw[530+:17];  // ks_b
  endfunction

  // the settings after a word was written to those that are selected
  function automatic draw_t draw_written(input draw_t draw, input select_t select, input logic [31:0] word);
    draw_written = draw;
    if (select[35]) draw_written[0+:1] = word[0+:1];  // path
    if (select[35]) draw_written[1+:1] = word[1+:1];  // colour
    if (select[35]) draw_written[2+:3] = word[4+:3];  // variant
    if (select[35]) draw_written[5+:2] = word[8+:2];  // fixed_degree
    if (select[27]) draw_written[7+:17] = word[0+:17];  // sharpness
    if (select[27]) draw_written[24+:4] = word[24+:4];  // sharpness_exp
    if (select[27]) draw_written[28+:3] = word[28+:3];  // weight
    if (select[26]) draw_written[31+:31] = word[0+:31];  // t1
    if (select[25]) draw_written[62+:31] = word[0+:31];  // t2
    if (select[24]) draw_written[93+:31] = word[0+:31];  // t3
    if (select[23]) draw_written[124+:18] = word[0+:18];  // threshold
    if (select[22]) draw_written[142+:3] = word[0+:3];  // model
    if (select[22]) draw_written[145+:1] = word[8+:1];  // cosine
    if (select[21]) draw_written[146+:21] = word[0+:21];  // k1
    if (select[20]) draw_written[167+:18] = word[0+:18];  // k2
    if (select[19]) draw_written[185+:17] = word[0+:17];  // xmax
    if (select[19]) draw_written[202+:3] = word[24+:3];  // shift
    if (select[19]) draw_written[205+:3] = word[28+:3];  // power
    if (select[18]) draw_written[208+:17] = word[0+:17];  // inv_n
    if (select[18]) draw_written[225+:4] = word[24+:4];  // inv_n_exp
    if (select[17]) draw_written[229+:17] = word[0+:17];  // gain
    if (select[17]) draw_written[246+:6] = word[24+:6];  // gain_exp
    if (select[16]) draw_written[252+:17] = word[0+:17];  // f0
    if (select[15]) draw_written[269+:18] = word[0+:18];  // lx
    if (select[14]) draw_written[287+:18] = word[0+:18];  // ly
    if (select[13]) draw_written[305+:18] = word[0+:18];  // lz
    if (select[12]) draw_written[323+:18] = word[0+:18];  // hx
    if (select[11]) draw_written[341+:18] = word[0+:18];  // hy
    if (select[10]) draw_written[359+:18] = word[0+:18];  // hz
    if (select[9]) draw_written[377+:17] = word[0+:17];  // vh
    if (select[8]) draw_written[394+:17] = word[0+:17];  // ambient_r
    if (select[7]) draw_written[411+:17] = word[0+:17];  // ambient_g
    if (select[6]) draw_written[428+:17] = word[0+:17];  // ambient_b
    if (select[5]) draw_written[445+:17] = word[0+:17];  // kd_r
    if (select[4]) draw_written[462+:17] = word[0+:17];  // kd_g
    if (select[3]) draw_written[479+:17] = word[0+:17];  // kd_b
    if (select[2]) draw_written[496+:17] = word[0+:17];  // ks_r
    if (select[1]) draw_written[513+:17] = word[0+:17];  // ks_g
    if (select[0]) draw_written[530+:17] = word[0+:17];  // ks_b
  endfunction

  // the word STATUS
  function automatic logic [31:0] status_word(input logic busy, input status_t status);
    status_word = 32'd0;
    status_word[0] = busy;
    status_word[8] = status[0];  // error_empty
    status_word[9] = status[1];  // error_long
    status_word[10] = status[2];  // error_packet
    status_word[11] = status[3];  // error_metric
    status_word[12] = status[4];  // error_threshold
    status_word[16] = status[5];  // light_model
    status_word[17] = status[6];  // light_range
    status_word[18] = status[7];  // light_zero
    status_word[19] = status[8];  // light_saturated
    status_word[24] = status[9];  // normal_zero
    status_word[25] = status[10];  // normal_short
  endfunction

endpackage
/* verilator lint_on UNUSEDPARAM */
/* verilator lint_on UNUSEDSIGNAL */
