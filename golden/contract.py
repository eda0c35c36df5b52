# SPDX-License-Identifier: Apache-2.0
"""The contract between the RTL, the golden model and every user: formats, latencies, limits, codes.

This is the one place where they are written down.  ``make generate`` turns it into
``rtl/shade_pkg.sv``; a test fails when the two differ.  ``W`` is a width in bits, ``F`` the number of fraction
bits among them; ``S1.16`` is a signed number with a sign, one integer bit and 16 fraction bits (18 bits).

Everything that a user can observe is part of the contract: ports, parameters, latency and the output to the bit.
"""

# ---- forms of a unit -------------------------------------------------------------------------------------------
FORM_PAPER = 0  # exactly what the paper prints
FORM_REFINED = 1  # the paper's idea with its defects repaired; the default everywhere

# ---- codes -----------------------------------------------------------------------------------------------------
PATH_POLY = 0  # light at nodes, a polynomial between them (P1)
PATH_NORMALS = 1  # a unit normal and light at every pixel (P4)
NODES_LEFT = 0  # cubic nodes {0, 1/4, 1/2, 1} (paper P1, first set)
NODES_RIGHT = 1  # cubic nodes {0, 1/2, 3/4, 1} (paper P1, second set)
EVALUATOR_HORNER = 0
EVALUATOR_FDIFF = 1
DEGREE_DIRECT = 0  # up to four pixels, each given by its own intensity
DEGREE_LINEAR = 1
DEGREE_QUADRATIC = 2
DEGREE_CUBIC = 3

# ---- formats ---------------------------------------------------------------------------------------------------
INTENSITY_W = 18  # S1.16: one signed 18 x 18 multiplier operand on every FPGA
INTENSITY_F = 16
COEF_GROWTH = 7  # |A|, |B|, |C| <= 76 max|I| (node set right, B): seven more bits than an intensity
COEF_W = INTENSITY_W + COEF_GROWTH  # S8.16
T_F = 16  # t is U1.16 in [0, 1], 17 bits
VALUE_GROWTH = 2  # |A t^3 + B t^2 + C t + D| <= 3 * 2^8 + 2 < 2^10: two more bits than a coefficient
VALUE_W = COEF_W + VALUE_GROWTH  # S10.16, the unclamped intensity of a pixel
HORNER_GUARD = 3  # fraction bits that Horner keeps below an ulp; error <= 1/2 + 3/16 ulp
PIXEL_W = 16  # U0.16, clamped to [0, 1 - 2^-16]

# ---- reciprocal square root ------------------------------------------------------------------------------------
RSQRT_W = 36  # the sum of three squares of S1.16 numbers, exact: U4.32
RSQRT_F = 20  # mantissa U1.20 in (1/2, 1]
RSQRT_INDEX_W = 7  # table: 96 segments of 1/32 over [1, 4), addressed by the first seven bits
RSQRT_C0_F = 22  # coefficients of a segment's parabola in d, the distance from its middle
RSQRT_C1_F = 18
RSQRT_C2_F = 12
RSQRT_C2_W = 11  # c2 < 1/2
RSQRT_D_F = 23  # d is S-6.23 in [-1/64, 1/64): 18 bits

# ---- normals ---------------------------------------------------------------------------------------------------
DOT_W = 21  # S4.16, a dot product: at most 3 * 2 * 2 = 12
INVC_F = 18  # U0.18, what the sum of two normals is multiplied by
SQUARE_F = 18  # fraction bits that are kept of a squared cosine
ETA_W = 20  # S1.18, criterion of a triangle and its threshold
ETA_F = 18
CONSTANT_F = 16  # fraction bits of the following constants
INVC_0, INVC_C, INVC_UU, INVC_UUUU = 40960, -8192, 3390, 1988  # 1/2 + u/8 + 0.0517 u^2 + 0.0303 u^4, u = 1 - c
INVC1_0, INVC1_C = 44761, -12517  # 0.683 - 0.191 c
INVC2_0, INVC2_C, INVC2_CC = 46072, -19661, 6423  # 0.703 - 0.3 c + 0.098 c^2
HALF_UU, HALF_UUUU = -2176, -640  # 1 - u/4 - 17 u^2/512 - 5 u^4/512, and 1 - u/4 = 0.75 + 0.25 c
D2_NEAR_0, D2_NEAR_C = 49152, 16384  # 0.75 + 0.25 c
D2_FAR_0, D2_FAR_C = 46662, 19988  # 0.712 + 0.305 c
D2_LIMIT = 46340  # floor(2^16 cos(pi/4)): up to here the second
D1_0, D1_C, D1_M = 58589, 3932, 459  # 0.894 + 0.06 c + 0.007 m
METRIC_M_MIN = 3  # m, the sectors of a line, for which d1a holds
METRIC_M_MAX = 12
METRIC_THRESHOLD = 58982  # 0.9: a shorter middle is normalized
ETA_U, ETA_UU, ETA_UUUU = 16384, 2240, 576  # u/4 + 35 u^2/1024 + 9 u^4/1024
ETA1_0, ETA1_C = 18708, -19053  # 0.28546133 - 0.29073021 c
ETA2_0, ETA2_C, ETA2_CC = 19152, -22362, 3239  # 0.29222919 - 0.34122087 c + 0.04942337 c^2

# ---- light -----------------------------------------------------------------------------------------------------
MODEL_LAMBERT = 0  # diffuse light alone
MODEL_PHONG = 1  # max(0, R.V)^n
MODEL_BLINN = 2  # max(0, N.H)^n
MODEL_SCHLICK = 3  # c / (n - n c + c), c = N.H
MODEL_COOK_TORRANCE = 4  # F G D / (pi (N.L) (N.V))
MODEL_WARD = 5  # D / (4 pi m^2 sqrt((N.L) (N.V)))
MODEL_W = 3
VERSINE_F = 26  # x = 1 - c of two unit vectors, U2.26 in [0, 2]
VERSINE_W = 28
VERSINE_CUT = 6  # its last bits, which count where the lobe scales x up by them
LOBE_K1_F = 20  # k1 of the shifted x, U1.20 in [0, 2)
LOBE_K1_W = 21
LOBE_K2_F = 17  # k2 of the shifted x, S0.17
LOBE_K2_W = 18
LOBE_X_F = 16  # xmax, U1.16, and the part of the shifted x, U1.20, that a multiplier takes
LOBE_SCALED_F = 20  # fraction bits of the scaled x
LOBE_SLOPE_F = 17  # fraction bits of the shifted x that k2 is multiplied by
LOBE_SHIFT_W = 3  # x is shifted left by 0 .. 6
LOBE_POWER_W = 3  # squarings, 0 .. 4; more count as 4
LOBE_FINE = 7  # this shift means: x as it is, k1 and k2 times 4
LOBE_FINE_F = 2  # that 4 is 2^2
LOBE_S_F = 18  # k1 - k2 x of the shifted x, U1.18; a multiplier takes 17 fraction bits
LOBE_ROW_F = 7  # fraction bits of it that the last four bits of the shifted x are multiplied by
LOBE_BIT_F = 4  # fraction bits of the shifted x that its last bit is multiplied by
LOBE_F = 22  # 1 - base and its powers, U1.22
LOBE_Z_F = 18  # what is squared, S-1.18 with the last bit set
GAIN_F = 16  # mantissa of the gain, U1.16 in [1, 2), or 0
GAIN_EXP_W = 6  # exponent of the gain, -32 .. 31
INV_EXP_W = 4  # 1/n = inv_n 2^-e, inv_n U1.16 in (1/2, 1], e 0 .. 10
FACTOR_F = 18  # w, S0.18 in [-1/2, 0]: a factor 1 + w
FACTOR_EXP_W = 7  # its exponent, -15 .. 33
LIGHT_MODEL = 0  # bits of a node's flags: a reserved model, or one that the parameters leave out
LIGHT_RANGE = 1  # a cosine outside [-1, 1]
LIGHT_ZERO = 2  # a denominator of 0
LIGHT_SATURATED = 3  # diffuse or specular light too large
LIGHT_FLAGS_W = 4
FRESNEL_F = 18  # fraction bits of the powers of 1 - c
FOLD_MAX = 8  # clocks an item of units that share multipliers
PHASE_W = 3  # the clock among these

# ---- spans -----------------------------------------------------------------------------------------------------
CHANNELS = 2  # diffuse, specular
NODE_COUNT = 4
LOG2_MAX = 12  # a span has at most 2^12 pixels
RECORD_LOG2 = 5  # a record has at most 2^5, by default: that is how wide the forward differences are
COUNT_W = 13
PLACE_W = 12  # a column or a line of the frame, which has at most 2^12 of each
DEGREE_W = 2
TAG_W = 16
PIXELS_MAX = 1 << LOG2_MAX
DIRECT_MAX = NODE_COUNT  # pixels of a span in direct mode
NORMAL_FIFO_LOG2 = 6  # normals that shade_pixel_normals can hold back: more than its latency
NODE_F = 15  # interpolated normals at the nodes, S2.15: before normalizing they may be longer than 1
SPAN_FIFO_LOG2 = 6  # spans that wait for the walk along their nodes: more than the planner's latency
RECORD_FIFO_LOG2 = 7  # records that wait for shade_poly_span: more than the latency from a node to its light
PHONG_FIFO_LOG2 = 7  # pixels that shade_phong can hold back: more than its latency
FIFO_LOG2 = 5  # pixels that shade_poly_span can hold back for a stalled consumer: 2^5

# ---- planner ---------------------------------------------------------------------------------------------------
KAPPA_F = 20  # kappa and its thresholds, U11.20
KAPPA_W = 31
SHARPNESS_F = 16  # mantissa of the sharpness n, U1.16 in [1, 2)
SHARPNESS_EXP_W = 4  # its exponent, 0 .. 12
WEIGHT_W = 3  # how many times kappa is halved at most where the highlight is far
WEIGHT = 5  # for the highlight of Blinn-Phong
LOG2_W = 4  # the number of an arc's pixels as a power of two
LOG2_MIN = 2  # nodes at a quarter of a record are pixels: 4 pixels at least

# ---- lines of normals ------------------------------------------------------------------------------------------
STEP_F = 29  # S2.29: after 4096 increments, each 1/2 ulp wrong, a component is still right to 1/4 ulp of S1.16
STEP_W = 32
VARIANT_REFINED = 0  # every other normal by the anchored InvC
VARIANT_V1 = 1  # P4: d1a < threshold: InvC1, else the mean
VARIANT_V2 = 2  # d1a < threshold: InvC2, else the mean
VARIANT_V3 = 3  # the mean
VARIANT_V4 = 4  # d2 < threshold: InvC1, else the mean
VARIANT_V5 = 5  # d2 < threshold: InvC2, else the mean
VARIANT_V6 = 6  # the mean
VARIANT_EXACT = 7  # every normal normalized
VARIANT_W = 3

# ---- triangles -------------------------------------------------------------------------------------------------
SUBPIXEL_F = 8  # a vertex stands on a grid of 1/256 pixel
GROWTH_W = (
    STEP_W + SUBPIXEL_F
)  # increments of a normal, S10.29, of a depth, S9.30: a way from a vertex has 8 fraction bits
COORDINATE_W = 24  # S15.8: vertices up to 32768 pixels from the frame's first pixel
DEPTH_F = 24  # depth of a vertex and of a pixel, U0.24 in [0, 1)
VERTEX_F = 16  # components of a vertex' normal, S0.16 in [-1, 1)
VERTEX_W = 17
AREA_W = (
    51  # twice the area of a triangle, and the sums of two products that its increments are made of, in a sign more
)
RECIPROCAL_F = 17  # 1/m of m in [1, 2), U0.17 below 1
RECIPROCAL_M_W = 20  # bits of m that are looked at, U1.19
DEPTH_DOWN = 7  # sums of a depth move down by so much more than those of a normal
PLANE_F = 30  # depth and its increments, S1.30, modulo 4
LINE_W = 17  # a line or column of the plane of vertices, S16
REST_W = 26  # remainder of an edge on its first line
CULL_NONE = 0  # both sides are drawn
CULL_BACK = 1  # triangles that turn clockwise on the screen are left out
CULL_FRONT = 2  # those that turn counter-clockwise
CULL_W = 2
# ---- direct form -----------------------------------------------------------------------------------------------
DIRECT_A_F = 24  # N.L, S1.24
DIRECT_A_W = 26
DIRECT_H_F = 28  # N.H, S1.28
DIRECT_H_W = 30
DIRECT_P_F = 36  # N.N, U1.36, modulo 2: after 64 steps right to 2^-25, after 1024 to 2^-17
DIRECT_P_W = 37
DIRECT_DIFFUSE_F = 17  # fraction bits of N.L, N.N, 1 - N.H that are used at the pixel
DIRECT_P_OUT_F = 25
DIRECT_X_F = 24
DIRECT_RHO_F = 17  # of rho and 1 - N.H in products
RHO_F = 25  # rho = 1/sqrt(P) - 1, S0.25
RHO_INDEX_W = 8  # table: segments of 1/128 of P
RHO_C0_W = 27
RHO_C1_F = 15
RHO_C2_F = 7
RHO_C2_W = 11
RHO_S_DROP = RHO_C2_F + DIRECT_P_OUT_F - RHO_C1_F
CHORD_INDEX_W = 10  # table of the lobe: 1024 chords
CHORD_FRACTION_W = 12  # where on the chord
CHORD_SLOPE_F = 20
CHORD_SLOPE_W = 15
CHORD_SHIFT_W = 3
DIRECT_STARTS_LOG2 = 6  # runs that wait, ready, for the one that is drawn: deep enough for block RAM
DIRECT_RUNS_LOG2 = 6  # runs that wait for their triangle's coefficients
DIRECT_FIFO_LOG2 = 6  # pixels that can be held back: more than the latency
EXCESS_W = 10  # |H| - 1, in units of 2^-24

# ---- packets (AXI4-Stream, one beat each) ----------------------------------------------------------------------
RECORD_DATA_W = 192  # node i (0..3) of channel c (0..1) at bit 18 (4 c + i)
RECORD_COUNT_LSB = 144  # pixels of the span
RECORD_MORE = 157  # the span goes on in the next record: no end of it after this one
RECORD_DEGREE_LSB = 158  # 0 direct, 1 linear, 2 quadratic, 3 cubic
RECORD_TAG_LSB = 160  # given back with every pixel
SPAN_DATA_W = 256  # words of 32 bits: normal x, y, z and increment x, y, z, S2.29 each
SPAN_COUNT_LSB = 192  # normals of the line
SPAN_TAG_LSB = 208
SPAN_COS_LSB = 224  # cosine between the line's end normals, S1.16, for d1a
SPAN_FLAT = 242  # the triangle passed P2's criterion: its normals need no normalizing in diffuse light
SURFACE_DATA_W = 64  # a packet: a triangle in four beats, then its runs, a beat each, tlast with the last
TRIANGLE_BEATS = 4  # box; normal; increment per column; increment per line
TRIANGLE_DATA_W = 256  # the first beat in the lowest bits
TRIANGLE_EXP_W = 4  # of an increment: 2^0 to 2^15
VERTEX_DATA_W = 256  # words of 32 bits; three beats a triangle, tlast with the third
NORMAL_DATA_W = 64  # x, y, z, S1.16, at bit 0, 18, 36
PIXEL_DATA_W = CHANNELS * PIXEL_W  # diffuse in the low half, specular in the high half
COLOUR_DATA_W = 3 * PIXEL_W  # red in the low third, then green, blue

# ---- patches ---------------------------------------------------------------------------------------------------
PATCH_LOG2_MIN = 2  # boxes of 4 .. 16 pixels a side
PATCH_LOG2_MAX = 4
PATCH_SMALL = 6  # a box of 4 x 4 with no more pixels is lit pixel by pixel
PATCH_LIGHTS_MAX = 4
PATCH_PART_F = 15  # S2.15: a part of a triangle's box times 2^-exp, by which an increment is multiplied
PATCH_PLAN_F = 14  # fraction bits of lengths in the planner
PATCH_AWAY_W = 23  # U7.16: a distance of normals
PATCH_RADIUS = 1 << 15  # U0.16: the longest way of the normal from the middle of a box to its corner, 1/2
PATCH_REACH_W = 19  # U3.16
PATCH_VALUE_F = 2  # more fraction bits of a polynomial
PATCH_VALUE_W = 20  # S1.18: of a lane's state, modulo 4
PATCH_FIFO_LOG2 = 9  # the depth of a block RAM
PATCH_WAIT_LOG2 = 11  # lights that wait for their box to be drawn
PATCH_RUNS_LOG2 = 11  # runs that wait for the plan of their triangle
PATCH_PIECES_LOG2 = 11  # pieces that wait for half of the lanes
PATCH_PIXELS_LOG2 = 6  # pixels that wait for a lane's consumer
PATCH_SPARE = 16  # words that shade_patch_tokens keeps free for what is on its way
PATCH_LIGHT_RANGE = 0  # bits of the flags of patches: a normal or an increment that does not fit S1.16
PATCH_LIGHT_SHORT = 1  # a normal shorter than 1/2
PATCH_FLAGS_W = 2
PATCH_AT_W = 10  # a row, a column of boxes
PATCH_LINE_W = 2 * (PATCH_AT_W + PATCH_LOG2_MAX)  # a run: where it begins and ends, box and pixel
PATCH_SCALAR_W = DIRECT_P_W + 1  # S1.36
PATCH_RUN_W = 2 + PLACE_W + PLACE_W + COUNT_W  # between the parts of shade_patch, see there
PATCH_PLAN_W = 7
PATCH_TOKEN_W = 9
PATCH_BOX_W = 2 + 4 + 16 + 2 * PATCH_AT_W
PATCH_PLACE_W = 2 * PLACE_W + TAG_W
PATCH_META_W = 1 + 4 + 6 + 2 * PLACE_W + TAG_W
PATCH_AREA_W = 4 + 2 * PLACE_W + TAG_W
PATCH_PIECE_W = 6 * PATCH_VALUE_W + PATCH_AREA_W
PATCH_USER_W = 2 * PLACE_W + TAG_W  # tuser of shade_patch

# ---- latencies, in clocks from an input taken to the output it causes -------------------------------------------
LATENCY_MUL = 2  # operands, product; of wide operands partial products, their sum
LATENCY_MUL_IN = LATENCY_MUL + 1  # STAGES = 3: the operands in front of them
LATENCY_THIRD = 5  # four adders, one rounding
LATENCY_COEF = 3 + LATENCY_THIRD + 1  # differences, two levels of adders, x/3, sum with what is not divided
LATENCY_HORNER_STEP = LATENCY_MUL + 1  # product, sum with the next coefficient
LATENCY_HORNER_PIPE = 3 * LATENCY_HORNER_STEP
LATENCY_HORNER_SEQ = 6  # clocks a value: load and the five steps of P1, Fig. 9
LATENCY_FDIFF = 6  # two shifter levels, two adder levels, the state, the rounding
LATENCY_FIFO = 2  # memory, output register
LATENCY_FIFO_BLOCK = 3  # one more
LATENCY_CROSS = LATENCY_MUL_IN + 1  # product, sum
LATENCY_EXPONENT = 4  # four shifter levels
LATENCY_RECIPROCAL = LATENCY_EXPONENT + 20  # a bit of the quotient a clock, rounding
LATENCY_GRADIENT = 1 + 3 + LATENCY_MUL + 3  # the sum, three shifter levels, product, two turns of the sum, pair
LATENCY_RSQRT = 2 + 2 + 2 * (LATENCY_MUL + 1)  # two shifter levels, the table, two steps of Horner's scheme
LATENCY_NORMALIZE = LATENCY_MUL + 2 + LATENCY_RSQRT + 2 + LATENCY_MUL + 1  # squares, sums, 1/root, shift, products
LATENCY_UNIT = LATENCY_MUL + 2 + LATENCY_RSQRT + 2 + LATENCY_MUL + 1  # squares, sums, 1/root, shift, products
LATENCY_UNIT_FOLDED = 28  # FOLD = 3 .. 8: turns of a multiplier
LATENCY_WEIGH = 4  # a tree of adders
LATENCY_DOT3 = LATENCY_MUL + 2  # products, two adders
LATENCY_HALF = 1 + LATENCY_WEIGH  # the choice of a straight line
LATENCY_DOT_SCALED = LATENCY_MUL + 3  # products, sum, two shifter levels
LATENCY_INVC = 1 + 2 * LATENCY_MUL + LATENCY_WEIGH  # u = 1 - c, u^2, u^4
LATENCY_SCALE3 = LATENCY_MUL + 1  # products, rounding
LATENCY_MIDPOINT = LATENCY_INVC + LATENCY_SCALE3
LATENCY_NODE_CHAIN = 2 * LATENCY_INVC + LATENCY_SCALE3
LATENCY_METRIC = 1 + LATENCY_HALF + 1  # clamps, decisions
LATENCY_CRITERION = 1 + 2 * LATENCY_MUL + 2 + LATENCY_WEIGH + 1  # u, u^2, u^4, sums of the edges, decision
LATENCY_INCREMENT = 2  # sum, rounding
LATENCY_FACTOR_S = LATENCY_DOT3 + LATENCY_INVC + 1  # cosine, factor, choice
LATENCY_MIDDLE = LATENCY_FACTOR_S + LATENCY_SCALE3  # cosine, factor, choice, scaling
LATENCY_PIXEL_NORMALS = 2 + LATENCY_INCREMENT + LATENCY_NORMALIZE + 1 + LATENCY_MIDDLE + LATENCY_FIFO
LATENCY_VERSINE = 1 + LATENCY_MUL + 3  # differences, squares, two adders, clamp
LATENCY_REFLECT = LATENCY_DOT3 + 2 + LATENCY_MUL + 2  # N.L, its sign and range, products, difference, range
LATENCY_HALFWAY = 1 + LATENCY_NORMALIZE + LATENCY_DOT3 + 1  # sum, H, V.H, clamp
LATENCY_FRESNEL = 1 + 4 * (LATENCY_MUL + 1)  # u = 1 - c, u^2, u^4, u^5, the blend
LATENCY_LOBE_BASE = 3 + 2 * (LATENCY_MUL + 2)  # the shifted x; two products, each with a sum and its range
LATENCY_LOBE_POWER = LATENCY_MUL + 2  # square, difference, choice of the half
LATENCY_LOBE = LATENCY_LOBE_BASE + 4 * LATENCY_LOBE_POWER  # POWER = 4
LATENCY_LOBE_FOLDED = 3 + 6 * (LATENCY_MUL + 3)  # POWER = 4: the shifted x, six turns of the multiplier
LATENCY_GEOMETRY = 1 + 2 * (LATENCY_MUL + 1) + LATENCY_RSQRT + 1 + LATENCY_MUL + 2  # see shade_geometry
LATENCY_GAIN = 3 * LATENCY_MUL_IN + 3  # products, two shifter levels, rounding
LATENCY_FACTOR = max(LATENCY_LOBE + 1, LATENCY_GEOMETRY)  # the lobe or what stands for it; what it is multiplied by
LATENCY_ANGLES = LATENCY_REFLECT + 1 + LATENCY_VERSINE  # R, choice of R, V or N, H
LATENCY_LIGHT = LATENCY_ANGLES + LATENCY_FACTOR + LATENCY_GAIN
LATENCY_ANGLES_FOLDED = LATENCY_MUL + 9  # six products, their sums, clamp
LATENCY_LIGHT_FOLDED = LATENCY_ANGLES_FOLDED + LATENCY_LOBE_FOLDED + LATENCY_GAIN  # FOLD = 5: 5 more, as of the lobe
LATENCY_LIGHT_LOCAL = LATENCY_HALFWAY + 1 + LATENCY_VERSINE + LATENCY_FACTOR + LATENCY_GAIN
LATENCY_COLOUR = 1 + LATENCY_MUL + 3  # negative light, products, two adders, saturation
LATENCY_KAPPA = 4 + LATENCY_MUL + 3 + LATENCY_MUL + 4  # common shift, squares, their sum, product, shift, range
LATENCY_WEIGHT = LATENCY_KAPPA + 2  # what is left of x, its limit
LATENCY_PLANNER = LATENCY_WEIGHT + 1 + 3 * 4  # three places; see planner_latency
LATENCY_COLLECT = 1  # the record
LATENCY_NODE_WALK = 5  # the choice of a run, its step, the run, its node, the rounding


def planner_pace(log2_max: int = RECORD_LOG2) -> int:
    """In how many clocks ``shade_planner`` takes a span."""
    return max(4, log2_max - 1)


def planner_latency(log2_max: int = RECORD_LOG2) -> int:
    """Clocks of ``shade_planner``."""
    return LATENCY_WEIGHT + 1 + 3 * planner_pace(log2_max)


def line_latency(fold: int) -> int:
    """Clocks from a span to its first normal in ``shade_line``, fold - 1 more at most: units take nodes in phase 0."""
    unit = LATENCY_UNIT_FOLDED if fold > 2 else LATENCY_UNIT
    return LATENCY_PLANNER + LATENCY_FIFO_BLOCK + LATENCY_NODE_WALK + unit


LATENCY_LINE = line_latency(1)  # span to its first normal
LATENCY_LINE_FOLDED = line_latency(6)
LATENCY_POLY_SPAN_HORNER = 2 + LATENCY_COEF + LATENCY_HORNER_PIPE + 1 + LATENCY_FIFO  # span in, walk, ..., clamp, FIFO
LATENCY_POLY_SPAN_FDIFF = 2 + LATENCY_COEF + LATENCY_FDIFF + 1 + LATENCY_FIFO
LATENCY_POLY_START = (
    3 + LATENCY_THIRD + 5
)  # differences, two levels of adders, x/3, C, two shifter levels, two of adders
LATENCY_POLY_STATE = 3  # the state, the rounding, the clamp
LATENCY_POLY_LINE = LATENCY_POLY_START + LATENCY_POLY_STATE + 1 + LATENCY_FIFO_BLOCK  # one: the specular channel
LATENCY_RECORD = 1 + LATENCY_LIGHT + LATENCY_COLLECT + LATENCY_FIFO_BLOCK + LATENCY_POLY_LINE  # normal to pixel
LATENCY_LANE = LATENCY_LINE + LATENCY_RECORD
LATENCY_LANE_NORMALS = LATENCY_PIXEL_NORMALS + LATENCY_RECORD  # the path of normals


def lane_latency(fold: int) -> int:
    """Clocks from a span to its first pixel in ``shade_lane``, FOLD = 2 .. 8; those of the lobe are longer with 5."""
    light = LATENCY_LIGHT_FOLDED + (5 if fold == 5 else 0)
    return line_latency(fold) + 1 + light + LATENCY_COLLECT + LATENCY_FIFO_BLOCK + LATENCY_POLY_LINE


LATENCY_LANE_FOLDED = lane_latency(6)
LATENCY_CORE = 1 + LATENCY_LANE  # the door
LATENCY_PAINT = LATENCY_COLOUR + LATENCY_FIFO
LATENCY_PATCH_NODES = 4  # the choice of a node, three sums
PATCH_LINES_LATE = LATENCY_MUL + 1  # clocks between the two parts of shade_patch_lines
LATENCY_PATCH_LINES = LATENCY_MUL + 3  # p X, V, two bits of X each
LATENCY_RHO = 1 + LATENCY_MUL + 1 + LATENCY_MUL + 2  # the table, c2 d, s, s d, its rounding, rho
LATENCY_CHORD = 2 + LATENCY_MUL + 2  # the scaled x, the table, the product, the sum, saturation
LATENCY_DIRECT_LIGHT = LATENCY_RHO + LATENCY_MUL + 1 + LATENCY_CHORD  # rho, products, sums, the lobe
LATENCY_PHONG = 1 + LATENCY_INCREMENT + LATENCY_NORMALIZE + LATENCY_LIGHT + 1 + LATENCY_FIFO  # span, ..., clamp, FIFO

# ---- products of two 18-bit numbers that a unit computes for each result ---------------------------------
PRODUCTS_KAPPA = 4  # for each new increment
PRODUCTS_WEIGHT = 3  # for each span
PRODUCTS_NORMALIZE = 11
PRODUCTS_UNIT = 8
PRODUCTS_LIGHT = 15  # shade_light without the following two
PRODUCTS_REFLECT = 3  # more with REFLECT = 1
PRODUCTS_DIVIDE = 6  # more with DIVIDE = 1
PRODUCTS_HORNER = 6  # of a channel of a pixel; forward differences: none

# ---- error bits of shade_patch --------------------------------------------------------------------------------
ERROR_EMPTY = 0  # a triangle without a box
ERROR_LONG = 1  # a run that is empty, beyond the box or out of order
ERROR_DIRECT = 2  # a packet that ends in its head
ERROR_W = 3

# ---- error bits of shade_direct ----------------------------------------------------------------------------------
DIRECT_EMPTY = 0  # a run of 0 pixels that is not its triangle's last one
DIRECT_LONG = 1  # a run of more than 4096 pixels
DIRECT_PACKET = 2  # a packet that ended before its first run
DIRECT_ORDER = 3  # a run that is not below the last good one of its triangle
DIRECT_SHORT = 4  # a pixel whose normal is shorter than 1/2
DIRECT_LARGE = 5  # a pixel whose normal is longer than 1
DIRECT_ERROR_W = 6


def constants() -> dict[str, int]:
    """All constants of the contract by name, in the order in which they are written above."""
    return {name: value for name, value in globals().items() if name.isupper() and isinstance(value, int)}
