/* SPDX-License-Identifier: Apache-2.0 */
#include "shade.h"

/* ---- packets and registers ------------------------------------------------------------------------------------- */

static void put(uint32_t *beat, int lsb, int width, uint32_t value) {
    for (int i = 0; i < width; i++)
        beat[(lsb + i) / 32] |= (value >> i & 1u) << (lsb + i) % 32;
}

#define PUT(name, value) put(beat, SHADE_SPAN_##name##_LSB, SHADE_SPAN_##name##_W, (uint32_t)(value))

void shade_pack(const struct shade_span *span, uint32_t beat[SHADE_SPAN_WORDS]) {
    for (int i = 0; i < SHADE_SPAN_WORDS; i++) beat[i] = 0;
    PUT(NORMAL_X, span->normal.x);
    PUT(NORMAL_Y, span->normal.y);
    PUT(NORMAL_Z, span->normal.z);
    PUT(INCREMENT_X, span->increment.x);
    PUT(INCREMENT_Y, span->increment.y);
    PUT(INCREMENT_Z, span->increment.z);
    PUT(COUNT, span->count);
    PUT(TAG, span->tag);
    PUT(COSINE, span->cosine);
    PUT(FLAT, span->flat != 0);
}

int shade_probe(const volatile uint32_t *base) {
    uint32_t major = base[SHADE_VERSION / 4] >> SHADE_VERSION_MAJOR_LSB;
    return base[SHADE_ID / 4] == SHADE_ID_RESET && major == SHADE_VERSION_RESET >> SHADE_VERSION_MAJOR_LSB ? 0 : -1;
}

int shade_write(volatile uint32_t *base, const struct shade_word *words, int count) {
    if (shade_busy(base)) return -1;
    for (int i = 0; i < count; i++) base[words[i].offset / 4] = words[i].word;
    return 0;
}

void shade_clear(volatile uint32_t *base) {
    base[SHADE_CONTROL / 4] = base[SHADE_CONTROL / 4] | (uint32_t)1 << SHADE_CONTROL_CLEAR_LSB;
}

int shade_busy(const volatile uint32_t *base) { return (int)(base[SHADE_STATUS / 4] & 1u); }

struct shade_counters shade_count(const volatile uint32_t *base) {
    struct shade_counters counters = {
        base[SHADE_PIXELS / 4], base[SHADE_SPANS / 4], base[SHADE_CLOCKS / 4],
        base[SHADE_STALLS / 4], base[SHADE_EVALUATIONS / 4], base[SHADE_ERRORS / 4],
    };
    return counters;
}
