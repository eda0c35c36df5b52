/* SPDX-License-Identifier: Apache-2.0
 * Driver of shade_core: register words from physical parameters, packets, access to the registers.
 *
 * C99. shade_material.c is a port of golden/material.py: the same words, bit for bit (tb/driver); it needs libm, and is
 * not reentrant: the fit of a highlight keeps 64 KiB of static scratch. It takes some 10^5 calls of pow: a table of
 * words, made once on a host, is the better choice on a processor without floating point. shade.c has the rest.
 */
#ifndef SHADE_H
#define SHADE_H

#include <stdint.h>

#include "shade_registers.h"

#ifdef __cplusplus
extern "C" {
#endif

enum shade_energy {                 /* rows of an energy-conserving scale; each belongs to one model */
    SHADE_ENERGY_NONE,
    SHADE_ENERGY_PHONG,
    SHADE_ENERGY_PHONG_MODIFIED,
    SHADE_ENERGY_BLINN,
    SHADE_ENERGY_BLINN_MODIFIED,
    SHADE_ENERGY_BLINN_NDF,
    SHADE_ENERGY_BLINN_HEIGHT
};

#define SHADE_EXPOSURE_AUTO 0.0     /* in place of a factor: the peak of the highlight is 1, or 1/2 */

struct shade_material {
    int model;                      /* SHADE_MODEL_* */
    int paper;                      /* 0: the refined fit of the highlight, 1: what the papers print */
    int energy;                     /* enum shade_energy */
    double shininess;               /* n, 1 to 1024: phong, blinn, schlick */
    double roughness;               /* m, 0.05 to 0.7: cook-torrance, ward */
    double f0;                      /* reflectance at normal incidence, 0 to 1: cook-torrance */
    double exposure;                /* factor on specular light, 1e-6 to 1e6, or SHADE_EXPOSURE_AUTO */
    double ambient, diffuse, specular;      /* weights, 0 to 1 */
    double colour[3], highlight[3]; /* of ambient and diffuse, of specular light: 0 to 1 */
};

struct shade_word {
    uint16_t offset;                /* byte offset of the register */
    uint32_t word;
};

#define SHADE_WORDS 24              /* that shade_words gives */

struct shade_vector {
    int32_t x, y, z;                /* S2.29 */
};

struct shade_span {                 /* pixels of a triangle on one raster line */
    struct shade_vector normal;     /* of the first pixel: interpolated, not normalized */
    struct shade_vector increment;  /* what it grows by from pixel to pixel */
    unsigned count;                 /* pixels, 1 to 4096 */
    unsigned tag;                   /* 16 bits, given back with every pixel */
    int32_t cosine;                 /* S1.16, of the angle between the end normals; for V1 and V2 alone */
    int flat;                       /* diffuse light without normalizing */
};

struct shade_counters {
    uint32_t pixels, spans, clocks, stalls, evaluations, errors;
};

/* ---- shade_material.c ---- */

/* The material that fields not set by the user should have: Blinn-Phong, n = 32. */
struct shade_material shade_material_default(void);

/* NULL, or one line: the parameter, the cause, what is allowed. light: a direction of any length. */
const char *shade_check(const struct shade_material *material, const double light[3]);

/* The words of a material under a directional light; the viewer is at (0, 0, 1), infinitely far.
 * Returns their number, SHADE_WORDS, or 0 where shade_check finds a fault. */
int shade_words(const struct shade_material *material, const double light[3], struct shade_word words[SHADE_WORDS]);

/* ---- shade.c ---- */

/* A span as a beat of s_axis_span, the lowest 32 bits first. */
void shade_pack(const struct shade_span *span, uint32_t beat[SHADE_SPAN_WORDS]);

/* Registers behind a pointer to their first word: memory-mapped, or mapped by UIO. */

/* 0, or -1 where ID is not "PSHD" or the major version is another one. */
int shade_probe(const volatile uint32_t *base);

/* Writes words. -1 while spans are inside (nothing is written then), else 0. */
int shade_write(volatile uint32_t *base, const struct shade_word *words, int count);

/* Sets counters and STATUS to 0; settings and spans stay as they are. Safe at any time. */
void shade_clear(volatile uint32_t *base);

/* Are spans inside? */
int shade_busy(const volatile uint32_t *base);

struct shade_counters shade_count(const volatile uint32_t *base);

#ifdef __cplusplus
}
#endif

#endif
