/* SPDX-License-Identifier: Apache-2.0
 * Registers and packets of shade_core.
 *
 * Generated from golden/registers.py and golden/packets.py by `make generate`: change them there.
 * SHADE_<register>: byte offset; _RESET: its word after reset; SHADE_<register>_<field>_LSB, _W: lowest bit and width.
 */
#ifndef SHADE_REGISTERS_H
#define SHADE_REGISTERS_H

/* Core */
#define SHADE_ID                               0x000         /* ro */
#define SHADE_ID_RESET                         0x50534844u
#define SHADE_ID_ID_LSB                        0
#define SHADE_ID_ID_W                          32            /* "PSHD" */
#define SHADE_VERSION                          0x004         /* ro */
#define SHADE_VERSION_RESET                    0x00010000u
#define SHADE_VERSION_PATCH_LSB                0
#define SHADE_VERSION_PATCH_W                  16            /* version of these registers and of the packets */
#define SHADE_VERSION_MINOR_LSB                16
#define SHADE_VERSION_MINOR_W                  8             /* compatible additions */
#define SHADE_VERSION_MAJOR_LSB                24
#define SHADE_VERSION_MAJOR_W                  8             /* incompatible changes */
#define SHADE_CONTROL                          0x008         /* rw */
#define SHADE_CONTROL_PATH_LSB                 0
#define SHADE_CONTROL_PATH_W                   1             /* 0: polynomials, 1: a unit normal at every pixel */
#define SHADE_CONTROL_COLOUR_LSB               1
#define SHADE_CONTROL_COLOUR_W                 1             /* pixels are 0: diffuse and specular light, 1: weighted red, green, blue */
#define SHADE_CONTROL_VARIANT_LSB              4
#define SHADE_CONTROL_VARIANT_W                3             /* of path 1, 0: refined, 1: v1, 2: v2, 3: v3, 4: v4, 5: v5, 6: v6, 7: exact */
#define SHADE_CONTROL_FIXED_DEGREE_LSB         8
#define SHADE_CONTROL_FIXED_DEGREE_W           2             /* 0: adaptive, 1 to 3: of every span, as in P1 */
#define SHADE_CONTROL_CLEAR_LSB                31
#define SHADE_CONTROL_CLEAR_W                  1             /* writing 1: counters and STATUS become 0, also while busy; spans are not touched */
#define SHADE_STATUS                           0x00c         /* ro */
#define SHADE_STATUS_BUSY_LSB                  0
#define SHADE_STATUS_BUSY_W                    1             /* spans are inside; the other bits stay until they are cleared */
#define SHADE_STATUS_ERROR_EMPTY_LSB           8
#define SHADE_STATUS_ERROR_EMPTY_W             1             /* a span of 0 pixels */
#define SHADE_STATUS_ERROR_LONG_LSB            9
#define SHADE_STATUS_ERROR_LONG_W              1             /* a span of more than 4096 pixels */
#define SHADE_STATUS_ERROR_PACKET_LSB          10
#define SHADE_STATUS_ERROR_PACKET_W            1             /* a packet cut short or too long */
#define SHADE_STATUS_ERROR_METRIC_LSB          11
#define SHADE_STATUS_ERROR_METRIC_W            1             /* V1, V2: fewer than 3 sectors or more than 12 */
#define SHADE_STATUS_ERROR_THRESHOLD_LSB       12
#define SHADE_STATUS_ERROR_THRESHOLD_W         1             /* threshold outside [0, 1] */
#define SHADE_STATUS_LIGHT_MODEL_LSB           16
#define SHADE_STATUS_LIGHT_MODEL_W             1             /* a reserved model, or one that was not built in */
#define SHADE_STATUS_LIGHT_RANGE_LSB           17
#define SHADE_STATUS_LIGHT_RANGE_W             1             /* a cosine outside [-1, 1] */
#define SHADE_STATUS_LIGHT_ZERO_LSB            18
#define SHADE_STATUS_LIGHT_ZERO_W              1             /* a denominator of 0: no specular light */
#define SHADE_STATUS_LIGHT_SATURATED_LSB       19
#define SHADE_STATUS_LIGHT_SATURATED_W         1             /* light beyond its format */
#define SHADE_STATUS_NORMAL_ZERO_LSB           24
#define SHADE_STATUS_NORMAL_ZERO_W             1             /* a normal of length 0 */
#define SHADE_STATUS_NORMAL_SHORT_LSB          25
#define SHADE_STATUS_NORMAL_SHORT_W            1             /* a normal too short to be brought to length 1 */

/* Counters */
#define SHADE_PIXELS                           0x020         /* ro */
#define SHADE_PIXELS_PIXELS_LSB                0
#define SHADE_PIXELS_PIXELS_W                  32            /* pixels given out, modulo 2^32, as are all counters */
#define SHADE_SPANS                            0x024         /* ro */
#define SHADE_SPANS_SPANS_LSB                  0
#define SHADE_SPANS_SPANS_W                    32            /* spans taken */
#define SHADE_CLOCKS                           0x028         /* ro */
#define SHADE_CLOCKS_CLOCKS_LSB                0
#define SHADE_CLOCKS_CLOCKS_W                  32            /* clocks with spans inside */
#define SHADE_STALLS                           0x02c         /* ro */
#define SHADE_STALLS_STALLS_LSB                0
#define SHADE_STALLS_STALLS_W                  32            /* clocks in which a pixel waited to be taken */
#define SHADE_EVALUATIONS                      0x030         /* ro */
#define SHADE_EVALUATIONS_EVALUATIONS_LSB      0
#define SHADE_EVALUATIONS_EVALUATIONS_W        32            /* nodes or pixels at which light was computed */
#define SHADE_ERRORS                           0x034         /* ro */
#define SHADE_ERRORS_ERRORS_LSB                0
#define SHADE_ERRORS_ERRORS_W                  32            /* faulty spans */

/* Planner */
#define SHADE_SHARPNESS                        0x040         /* rw */
#define SHADE_SHARPNESS_RESET                  0x01010000u
#define SHADE_SHARPNESS_SHARPNESS_LSB          0
#define SHADE_SHARPNESS_SHARPNESS_W            17            /* U1.16: n of the cos^n that turns as fast as the highlight, mantissa */
#define SHADE_SHARPNESS_SHARPNESS_EXP_LSB      24
#define SHADE_SHARPNESS_SHARPNESS_EXP_W        4             /* and exponent, 0 to 12 */
#define SHADE_SHARPNESS_WEIGHT_LSB             28
#define SHADE_SHARPNESS_WEIGHT_W               3             /* how many times kappa is halved at most where the highlight is far; 0: not at all */
#define SHADE_T1                               0x044         /* rw */
#define SHADE_T1_RESET                         0x0000c000u
#define SHADE_T1_T1_LSB                        0
#define SHADE_T1_T1_W                          31            /* U11.20: kappa up to which a line is enough */
#define SHADE_T2                               0x048         /* rw */
#define SHADE_T2_RESET                         0x00050000u
#define SHADE_T2_T2_LSB                        0
#define SHADE_T2_T2_W                          31            /* U11.20: kappa up to which a parabola is enough */
#define SHADE_T3                               0x04c         /* rw */
#define SHADE_T3_RESET                         0x00100000u
#define SHADE_T3_T3_LSB                        0
#define SHADE_T3_T3_W                          31            /* U11.20: kappa up to which a cubic is enough */
#define SHADE_THRESHOLD                        0x050         /* rw */
#define SHADE_THRESHOLD_RESET                  0x0000e666u
#define SHADE_THRESHOLD_THRESHOLD_LSB          0
#define SHADE_THRESHOLD_THRESHOLD_W            18            /* S1.16: V1, V2, V4, V5: a shorter middle is normalized */

/* Material */
#define SHADE_MODEL                            0x080         /* rw */
#define SHADE_MODEL_MODEL_LSB                  0
#define SHADE_MODEL_MODEL_W                    3             /* 0: lambert, 1: phong, 2: blinn, 3: schlick, 4: cook-torrance, 5: ward */
#define SHADE_MODEL_COSINE_LSB                 8
#define SHADE_MODEL_COSINE_W                   1             /* specular light is multiplied by N.L */
#define SHADE_K1                               0x084         /* rw */
#define SHADE_K1_K1_LSB                        0
#define SHADE_K1_K1_W                          21            /* U1.20: of the lobe, for the scaled x */
#define SHADE_K2                               0x088         /* rw */
#define SHADE_K2_K2_LSB                        0
#define SHADE_K2_K2_W                          18            /* S0.17: of the lobe, for the scaled x */
#define SHADE_XMAX                             0x08c         /* rw */
#define SHADE_XMAX_RESET                       0x40000000u
#define SHADE_XMAX_XMAX_LSB                    0
#define SHADE_XMAX_XMAX_W                      17            /* U1.16: limit of the scaled x */
#define SHADE_XMAX_SHIFT_LSB                   24
#define SHADE_XMAX_SHIFT_W                     3             /* x is scaled by 2^shift; 7: not, but k1 and k2 are by 4 */
#define SHADE_XMAX_POWER_LSB                   28
#define SHADE_XMAX_POWER_W                     3             /* squarings of the lobe, 0 to 4; more count as 4 */
#define SHADE_INV_N                            0x090         /* rw */
#define SHADE_INV_N_INV_N_LSB                  0
#define SHADE_INV_N_INV_N_W                    17            /* U1.16: Schlick: 1/n, mantissa */
#define SHADE_INV_N_INV_N_EXP_LSB              24
#define SHADE_INV_N_INV_N_EXP_W                4             /* and negative exponent */
#define SHADE_GAIN                             0x094         /* rw */
#define SHADE_GAIN_GAIN_LSB                    0
#define SHADE_GAIN_GAIN_W                      17            /* U1.16: of specular light, mantissa */
#define SHADE_GAIN_GAIN_EXP_LSB                24
#define SHADE_GAIN_GAIN_EXP_W                  6             /* S5.0: and exponent */
#define SHADE_F0                               0x098         /* rw */
#define SHADE_F0_F0_LSB                        0
#define SHADE_F0_F0_W                          17            /* U1.16: Fresnel's factor at V.H = 1, where it is computed at every node */

/* Light */
#define SHADE_LX                               0x0c0         /* rw */
#define SHADE_LX_LX_LSB                        0
#define SHADE_LX_LX_W                          18            /* S1.16: direction to the light, x */
#define SHADE_LY                               0x0c4         /* rw */
#define SHADE_LY_LY_LSB                        0
#define SHADE_LY_LY_W                          18            /* S1.16: direction to the light, y */
#define SHADE_LZ                               0x0c8         /* rw */
#define SHADE_LZ_RESET                         0x00010000u
#define SHADE_LZ_LZ_LSB                        0
#define SHADE_LZ_LZ_W                          18            /* S1.16: direction to the light, z */
#define SHADE_HX                               0x0cc         /* rw */
#define SHADE_HX_HX_LSB                        0
#define SHADE_HX_HX_W                          18            /* S1.16: half way between it and the viewer's, x */
#define SHADE_HY                               0x0d0         /* rw */
#define SHADE_HY_HY_LSB                        0
#define SHADE_HY_HY_W                          18            /* S1.16: half way between it and the viewer's, y */
#define SHADE_HZ                               0x0d4         /* rw */
#define SHADE_HZ_RESET                         0x00010000u
#define SHADE_HZ_HZ_LSB                        0
#define SHADE_HZ_HZ_W                          18            /* S1.16: half way between it and the viewer's, z */
#define SHADE_VH                               0x0d8         /* rw */
#define SHADE_VH_RESET                         0x00010000u
#define SHADE_VH_VH_LSB                        0
#define SHADE_VH_VH_W                          17            /* U1.16: V.H */

/* Colour */
#define SHADE_AMBIENT_R                        0x100         /* rw */
#define SHADE_AMBIENT_R_AMBIENT_R_LSB          0
#define SHADE_AMBIENT_R_AMBIENT_R_W            17            /* U1.16: ambient light, red */
#define SHADE_AMBIENT_G                        0x104         /* rw */
#define SHADE_AMBIENT_G_AMBIENT_G_LSB          0
#define SHADE_AMBIENT_G_AMBIENT_G_W            17            /* U1.16: ambient light, green */
#define SHADE_AMBIENT_B                        0x108         /* rw */
#define SHADE_AMBIENT_B_AMBIENT_B_LSB          0
#define SHADE_AMBIENT_B_AMBIENT_B_W            17            /* U1.16: ambient light, blue */
#define SHADE_KD_R                             0x10c         /* rw */
#define SHADE_KD_R_RESET                       0x00010000u
#define SHADE_KD_R_KD_R_LSB                    0
#define SHADE_KD_R_KD_R_W                      17            /* U1.16: weight of diffuse light, red */
#define SHADE_KD_G                             0x110         /* rw */
#define SHADE_KD_G_RESET                       0x00010000u
#define SHADE_KD_G_KD_G_LSB                    0
#define SHADE_KD_G_KD_G_W                      17            /* U1.16: weight of diffuse light, green */
#define SHADE_KD_B                             0x114         /* rw */
#define SHADE_KD_B_RESET                       0x00010000u
#define SHADE_KD_B_KD_B_LSB                    0
#define SHADE_KD_B_KD_B_W                      17            /* U1.16: weight of diffuse light, blue */
#define SHADE_KS_R                             0x118         /* rw */
#define SHADE_KS_R_RESET                       0x00010000u
#define SHADE_KS_R_KS_R_LSB                    0
#define SHADE_KS_R_KS_R_W                      17            /* U1.16: weight of specular light, red */
#define SHADE_KS_G                             0x11c         /* rw */
#define SHADE_KS_G_RESET                       0x00010000u
#define SHADE_KS_G_KS_G_LSB                    0
#define SHADE_KS_G_KS_G_W                      17            /* U1.16: weight of specular light, green */
#define SHADE_KS_B                             0x120         /* rw */
#define SHADE_KS_B_RESET                       0x00010000u
#define SHADE_KS_B_KS_B_LSB                    0
#define SHADE_KS_B_KS_B_W                      17            /* U1.16: weight of specular light, blue */

/* codes */
#define SHADE_PATH_POLY                        0
#define SHADE_PATH_NORMALS                     1
#define SHADE_MODEL_LAMBERT                    0
#define SHADE_MODEL_PHONG                      1
#define SHADE_MODEL_BLINN                      2
#define SHADE_MODEL_SCHLICK                    3
#define SHADE_MODEL_COOK_TORRANCE              4
#define SHADE_MODEL_WARD                       5
#define SHADE_VARIANT_REFINED                  0
#define SHADE_VARIANT_V1                       1
#define SHADE_VARIANT_V2                       2
#define SHADE_VARIANT_V3                       3
#define SHADE_VARIANT_V4                       4
#define SHADE_VARIANT_V5                       5
#define SHADE_VARIANT_V6                       6
#define SHADE_VARIANT_EXACT                    7

/* fraction bits of the lobe and of the sharpness */
#define SHADE_LOBE_K1_F                        20
#define SHADE_LOBE_K2_F                        17
#define SHADE_LOBE_FINE                        7
#define SHADE_LOBE_FINE_F                      2
#define SHADE_SHARPNESS_F                      16

/* SPAN: a span: a triangle's pixels on one raster line, as scan conversion finds them */
#define SHADE_SPAN_WORDS                       8
#define SHADE_SPAN_NORMAL_X_LSB                0
#define SHADE_SPAN_NORMAL_X_W                  32            /* S2.29: interpolated normal of the first pixel, x */
#define SHADE_SPAN_NORMAL_Y_LSB                32
#define SHADE_SPAN_NORMAL_Y_W                  32            /* S2.29: interpolated normal of the first pixel, y */
#define SHADE_SPAN_NORMAL_Z_LSB                64
#define SHADE_SPAN_NORMAL_Z_W                  32            /* S2.29: interpolated normal of the first pixel, z */
#define SHADE_SPAN_INCREMENT_X_LSB             96
#define SHADE_SPAN_INCREMENT_X_W               32            /* S2.29: its increment per pixel, the same for all spans of a triangle (P4), x */
#define SHADE_SPAN_INCREMENT_Y_LSB             128
#define SHADE_SPAN_INCREMENT_Y_W               32            /* S2.29: its increment per pixel, the same for all spans of a triangle (P4), y */
#define SHADE_SPAN_INCREMENT_Z_LSB             160
#define SHADE_SPAN_INCREMENT_Z_W               32            /* S2.29: its increment per pixel, the same for all spans of a triangle (P4), z */
#define SHADE_SPAN_COUNT_LSB                   192
#define SHADE_SPAN_COUNT_W                     13            /* pixels, 1 to 4096 */
#define SHADE_SPAN_TAG_LSB                     208
#define SHADE_SPAN_TAG_W                       16            /* given back with every pixel */
#define SHADE_SPAN_COSINE_LSB                  224
#define SHADE_SPAN_COSINE_W                    18            /* S1.16: of the angle between the end normals, for V1 and V2 */
#define SHADE_SPAN_FLAT_LSB                    242
#define SHADE_SPAN_FLAT_W                      1             /* the triangle passed P2's criterion: no normalizing in diffuse light */

/* PIXEL: a pixel */
#define SHADE_PIXEL_WORDS                      1
#define SHADE_PIXEL_DIFFUSE_LSB                0
#define SHADE_PIXEL_DIFFUSE_W                  16            /* U0.16 */
#define SHADE_PIXEL_SPECULAR_LSB               16
#define SHADE_PIXEL_SPECULAR_W                 16            /* U0.16 */

/* COLOURED: a coloured pixel */
#define SHADE_COLOURED_WORDS                   2
#define SHADE_COLOURED_RED_LSB                 0
#define SHADE_COLOURED_RED_W                   16            /* U0.16 */
#define SHADE_COLOURED_GREEN_LSB               16
#define SHADE_COLOURED_GREEN_W                 16            /* U0.16 */
#define SHADE_COLOURED_BLUE_LSB                32
#define SHADE_COLOURED_BLUE_W                  16            /* U0.16 */

#endif
