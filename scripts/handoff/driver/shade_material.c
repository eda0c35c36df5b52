/* SPDX-License-Identifier: Apache-2.0 */
#include "shade.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

#define ONE 65536.0                 /* 1 in U1.16 */
#define PI 3.141592653589793
#define STAGES 4                    /* squarings of the lobe at most */
#define POINTS 4096                 /* of the grid on which a lobe is fitted */
#define EXACT 1e-9                  /* an error of the fit that is none */
#define WEIGHT 5                    /* of the planner, for Blinn-Phong: how many times kappa is halved at most */
#define MARGIN (1.0 / 4096)         /* what quantization may add to a lobe's energy */
#define FRESNEL_MIN (1.0 / 256)     /* automatic exposure makes up for no less */
#define HALF_MIN (1.0 / 16)         /* nor for a smaller V.H */

struct lobe {                       /* max(0, 1 - k1 x + k2 x^2)^(2^power), x = min(1 - c, xmax) */
    double k1, k2, xmax;
    int power;
};

static double least(double a, double b) { return a < b ? a : b; }
static double most(double a, double b) { return a > b ? a : b; }
static double fixed(double value, double scale) { return floor(value * scale + 0.5); }

static int microfacets(const struct shade_material *m) {
    return m->model == SHADE_MODEL_COOK_TORRANCE || m->model == SHADE_MODEL_WARD;
}

static int modified(int energy) {
    return energy == SHADE_ENERGY_PHONG_MODIFIED || energy == SHADE_ENERGY_BLINN_MODIFIED;
}

/* ---- the fit of a highlight ------------------------------------------------------------------------------------ */

static double grid[POINTS], target[POINTS];

/* The highlight that the lobe stands for, over x = 1 - c, divided by its peak. */
static double shape(const struct shade_material *m, double x) {
    double c = 1 - x;
    if (!microfacets(m)) return pow(most(c, 0), m->shininess);
    if (c <= 0) return 0;
    double square = c * c, m2 = pow(m->roughness, 2), ward = exp((1 - 1 / square) / m2);
    return m->model == SHADE_MODEL_WARD ? ward : 4 * m2 * (ward / (4 * m2 * pow(c, 4)));
}

/* Solves a x = b of n equations, by elimination with the largest pivot; x replaces b. */
static void solve(int n, double a[3][3], double b[3]) {
    for (int i = 0; i < n; i++) {
        int best = i;
        for (int j = i + 1; j < n; j++)
            if (fabs(a[j][i]) > fabs(a[best][i])) best = j;
        for (int k = 0; k < n; k++) {
            double swap = a[i][k];
            a[i][k] = a[best][k];
            a[best][k] = swap;
        }
        double swap = b[i];
        b[i] = b[best];
        b[best] = swap;
        for (int j = i + 1; j < n; j++) {
            double factor = a[j][i] / a[i][i];
            for (int k = i; k < n; k++) a[j][k] -= factor * a[i][k];
            b[j] -= factor * b[i];
        }
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++) b[i] -= a[i][k] * b[k];
        b[i] /= a[i][i];
    }
}

/* What k1 (which = 0) or k2 (1) is multiplied by: -x and x^2, x limited to the vertex. */
static double factor_of(int which, double x, const double k12[2]) {
    if (k12[1] > 0) x = least(x, k12[0] / (2 * k12[1]));
    return which ? x * x : -x;
}

static double base_at(double x, const double k12[2]) {
    return most(1 + (factor_of(0, x, k12) * k12[0] + factor_of(1, x, k12) * k12[1]), 0);
}

static double error_at(int at, int p, const double k12[2]) { return pow(base_at(grid[at], k12), p) - target[at]; }

/* The least maximal error of (1 - k1 x + k2 x^2)^p: Remez' exchange. Free are k1 and k2, or k2 alone. */
static double minimax(int p, int first_free, double best[2]) {
    int count = 2 - first_free;
    double k12[2] = {0, 0}, a[3][3], b[3], least_error = INFINITY;
    const double levels[2] = {0.45, 0.05}, none[2] = {0, 0};
    for (int i = 0; i < count; i++) {  /* begin with no error at these points */
        int at = 0;
        for (int j = 1; j < POINTS; j++)
            if (fabs(target[j] - levels[i]) < fabs(target[at] - levels[i])) at = j;
        for (int k = 0; k < count; k++) a[i][k] = factor_of(first_free + k, grid[at], none);
        b[i] = pow(target[at], 1.0 / p) - 1;
    }
    solve(count, a, b);
    for (int k = 0; k < count; k++) k12[first_free + k] = b[k];
    best[0] = best[1] = 0;

    for (int round = 0; round < 20; round++) {
        /* the largest error of every run of equal sign; of neighbours those with the largest, then of most error */
        int peak[3] = {0, 0, 0}, at[3] = {0, 0, 0}, peaks = 0, above = 0, top = 0;
        double size[3] = {0, 0, 0}, of_top = -1, largest = 0, best_window = -1, best_largest = -1;
        for (int j = 0; j <= POINTS; j++) {
            double error = j < POINTS ? error_at(j, p, k12) : 0;
            if (j == POINTS || (j > 0 && (error > 0) != above)) {  /* a run ends */
                for (int i = 0; i < count; i++) {
                    peak[i] = peak[i + 1];
                    size[i] = size[i + 1];
                }
                peak[count] = top;
                size[count] = of_top;
                peaks++;
                if (peaks > count) {
                    double window = size[0], high = size[0];
                    for (int i = 1; i <= count; i++) {
                        window = least(window, size[i]);
                        high = most(high, size[i]);
                    }
                    if (high > best_largest || (high == best_largest && window > best_window)) {
                        best_largest = high;
                        best_window = window;
                        for (int i = 0; i <= count; i++) at[i] = peak[i];
                    }
                }
                of_top = -1;
            }
            above = error > 0;
            if (fabs(error) > of_top) {
                of_top = fabs(error);
                top = j;
            }
            largest = most(largest, fabs(error));
        }
        if (largest < least_error || (largest == least_error && k12[0] < best[0])) {
            least_error = largest;
            best[0] = k12[0];
            best[1] = k12[1];
        }
        if (largest < EXACT || peaks <= count) break;
        for (int i = 0; i <= count; i++) {
            double x = grid[at[i]], error = error_at(at[i], p, k12);
            double slope = p * pow(base_at(x, k12), p - 1);
            for (int k = 0; k < count; k++) a[i][k] = slope * factor_of(first_free + k, x, k12);
            a[i][count] = error > 0 ? -1 : error < 0 ? 1 : 0;
            b[i] = -error;
        }
        solve(count + 1, a, b);
        for (int k = 0; k < count; k++) k12[first_free + k] += b[k];
    }
    return least_error;
}

static struct lobe fit(const struct shade_material *m) {
    struct lobe found = {0, 0, 1, STAGES};
    if (m->model == SHADE_MODEL_LAMBERT || m->model == SHADE_MODEL_SCHLICK) return found;
    double exponent = m->shininess;
    if (microfacets(m)) exponent = 2 / pow(m->roughness, 2) - (m->model == SHADE_MODEL_COOK_TORRANCE ? 4 : 0);
    if (m->paper) {
        found.k1 = exponent / (1 << STAGES);
        return found;
    }
    double stop = least(1, 24 / most(exponent, 1));  /* beyond it the lobe is below exp(-24) */
    for (int i = 0; i < POINTS; i++) {
        grid[i] = i == POINTS - 1 ? stop : (i + 1) * (stop / POINTS);
        target[i] = shape(m, grid[i]);
    }
    double least_error = INFINITY;
    for (int power = STAGES; power >= 0; power--) {
        double k12[2], error = minimax(1 << power, 0, k12);
        if (k12[0] < 0) error = minimax(1 << power, 1, k12);
        error = most(error, EXACT);
        if (error < least_error) {
            least_error = error;
            found.k1 = k12[0];
            found.k2 = k12[1];
            found.power = power;
        }
    }
    found.xmax = found.k2 > 0 ? least(1, found.k1 / (2 * found.k2)) : 1;
    return found;
}

/* ---- energy ---------------------------------------------------------------------------------------------------- */

static double lobe_value(struct lobe lobe, double c) {
    double x = least(1 - c, lobe.xmax);
    return rint(pow(most(1 - lobe.k1 * x + lobe.k2 * (x * x), 0), 1 << lobe.power) * ONE) / ONE;
}

/* 2 pi times the integral over the hemisphere of the lobe, linear between cosines of 16 fraction bits. */
static double hemisphere(int energy, struct lobe lobe) {
    int half = energy == SHADE_ENERGY_BLINN || energy == SHADE_ENERGY_BLINN_MODIFIED;
    int weighted = modified(energy) || energy == SHADE_ENERGY_BLINN_HEIGHT;
    double sum = 0, u = 0, f = lobe_value(lobe, 0);
    int first = 1;
    if (half) {
        double low = floor(sqrt(0.5) * ONE) / ONE, high = low + 1 / ONE, at_low = lobe_value(lobe, low);
        u = sqrt(0.5);
        f = at_low + (lobe_value(lobe, high) - at_low) / (high - low) * (u - low);
        first = (int)(high * ONE);
    }
    double area = 0, moment = 0;
    for (int i = first - 1; i <= (int)ONE; i++) {
        double to = i < first ? u : i / ONE, u2 = to * to;
        double zeroth = half ? (weighted ? 2 * u2 * u2 - 2 * u2 : 2 * u2) : (weighted ? u2 / 2 : to);
        double of_u = half ? (weighted ? 8.0 / 5 * u2 * u2 * to - 4.0 / 3 * u2 * to : 4.0 / 3 * u2 * to)
                           : (weighted ? u2 * to / 3 : u2 / 2);
        if (i >= first) {
            double value = lobe_value(lobe, to), slope = (value - f) / (to - u);
            sum += (f - slope * u) * (zeroth - area) + slope * (of_u - moment);
            u = to;
            f = value;
        }
        area = zeroth;
        moment = of_u;
    }
    return 2 * PI * sum;
}

/* The factor by which a row's lobe has energy 1: of cos^n, or what the paper fitted to its lobe. */
static double energy_scale(int energy, double n, int paper) {
    int half = energy == SHADE_ENERGY_BLINN || energy == SHADE_ENERGY_BLINN_MODIFIED;
    int weighted = modified(energy) || energy == SHADE_ENERGY_BLINN_HEIGHT;
    if (!paper) {
        if (half && weighted) return (n + 2) * (n + 4) / (8 * PI * (n + pow(2, -n / 2)));
        return half ? (n + 2) / (8 * PI * (1 - pow(2, -n / 2 - 1))) : (n + 1 + weighted) / (2 * PI);
    }
    if (!half) return (1.063 * n + weighted) / (2 * PI);
    return weighted ? (1.027 * n + 4.8) / (8 * PI) : (1.068 * n + 0.96) / (8 * PI);
}

static double fresnel(double c, double f0) { return f0 + (1 - f0) * pow(1 - most(0, least(c, 1)), 5); }

/* Exposure times energy scale. */
static double scale(const struct shade_material *m, struct lobe lobe, double vh) {
    int automatic = m->exposure == SHADE_EXPOSURE_AUTO;
    vh = most(vh, HALF_MIN);
    if (microfacets(m)) {
        if (!automatic) return m->exposure / (4 * PI * pow(m->roughness, 2));
        if (m->model == SHADE_MODEL_WARD) return vh / 2;
        return pow(vh, 2) / 2 / most(fresnel(vh, m->f0), FRESNEL_MIN);
    }
    if (automatic) return modified(m->energy) ? 1 / vh : 1;
    if (m->energy == SHADE_ENERGY_NONE) return m->exposure;
    double exact = energy_scale(m->energy, m->shininess, 0);
    if (m->paper) return m->exposure * energy_scale(m->energy, m->shininess, 1);
    double excess = most(exact * hemisphere(m->energy, lobe), 1) * (1 + MARGIN);
    return m->exposure * (exact / excess);
}

/* ---- words ----------------------------------------------------------------------------------------------------- */

static void unit(const double v[3], double out[3]) {
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++) out[i] = v[i] / (length == 0 ? 1 : length);
}

static uint32_t field(double value, int width, int lsb) {
    return ((uint32_t)(int32_t)value & (uint32_t)((1ULL << width) - 1)) << lsb;
}

#define FIELD(name, value) field(value, SHADE_##name##_W, SHADE_##name##_LSB)

/* k1, k2, xmax, shift, power: X = x 2^shift, K1 = k1 / 2^shift, K2 = k2 / 4^shift, with the first shift that fits. */
static int lobe_words(struct lobe lobe, struct shade_word *k1, struct shade_word *k2, struct shade_word *xmax) {
    for (int i = -1; i < SHADE_LOBE_FINE; i++) {
        double fine = 1 << SHADE_LOBE_FINE_F;
        double for_x = i < 0 ? 1 : ldexp(1, i), for_k1 = i < 0 ? fine : ldexp(1, -i), for_k2 = i < 0 ? fine : ldexp(1, -2 * i);
        double code1 = fixed(lobe.k1 * for_k1, ldexp(1, SHADE_LOBE_K1_F));
        double code2 = fixed(lobe.k2 * for_k2, ldexp(1, SHADE_LOBE_K2_F));
        double largest = least(fixed(lobe.xmax * for_x, ONE), 2 * ONE - 1);
        double steepest = ldexp(code1, -SHADE_LOBE_K1_F) - least(code2, 0) / ldexp(1, SHADE_LOBE_K2_F) * largest / ONE;
        if (steepest < 2 && fabs(code2) < ldexp(1, SHADE_LOBE_K2_F)) {
            k1->word = FIELD(K1_K1, code1);
            k2->word = FIELD(K2_K2, code2);
            xmax->word = FIELD(XMAX_XMAX, largest) | FIELD(XMAX_SHIFT, i < 0 ? SHADE_LOBE_FINE : i)
                       | FIELD(XMAX_POWER, lobe.power);
            return 1;
        }
    }
    return 0;
}

struct shade_material shade_material_default(void) {
    struct shade_material m = {
        SHADE_MODEL_BLINN, 0, SHADE_ENERGY_NONE, 32, 0.3, 0.04, SHADE_EXPOSURE_AUTO, 0.10, 0.80, 0.35,
        {0.93, 0.70, 0.58}, {1, 1, 1},
    };
    return m;
}

static int within(double value, double low, double high) { return low <= value && value <= high; }

const char *shade_check(const struct shade_material *m, const double light[3]) {
    static const int model_of[] = {
        -1, SHADE_MODEL_PHONG, SHADE_MODEL_PHONG, SHADE_MODEL_BLINN, SHADE_MODEL_BLINN, SHADE_MODEL_BLINN, SHADE_MODEL_BLINN,
    };
    const double *weights[] = {&m->ambient, &m->diffuse, &m->specular};
    double longest = 0;
    if (m->model < SHADE_MODEL_LAMBERT || m->model > SHADE_MODEL_WARD) return "model: unknown, allowed is SHADE_MODEL_*";
    if (m->energy < SHADE_ENERGY_NONE || m->energy > SHADE_ENERGY_BLINN_HEIGHT
        || (m->energy != SHADE_ENERGY_NONE && model_of[m->energy] != m->model))
        return "energy: no row of this model, allowed is SHADE_ENERGY_NONE or a row of the model";
    if (!within(m->shininess, 1, 1024)) return "shininess: out of range, allowed is 1 to 1024";
    if (!within(m->roughness, 0.05, 0.7)) return "roughness: out of range, allowed is 0.05 to 0.7";
    if (!within(m->f0, 0, 1)) return "f0: out of range, allowed is 0 to 1";
    if (m->exposure != SHADE_EXPOSURE_AUTO && !within(m->exposure, 1e-6, 1e6))
        return "exposure: out of range, allowed is SHADE_EXPOSURE_AUTO or 1e-6 to 1e6";
    for (int i = 0; i < 3; i++) {
        if (!within(*weights[i], 0, 1)) return "ambient, diffuse, specular: out of range, allowed is 0 to 1";
        if (!within(m->colour[i], 0, 1) || !within(m->highlight[i], 0, 1))
            return "colour, highlight: out of range, allowed is 0 to 1";
        if (!within(light[i], -1e6, 1e6)) return "light: no direction, allowed are parts of -1e6 to 1e6";
        longest = most(longest, fabs(light[i]));
    }
    return longest < 1e-6 ? "light: no direction, allowed is 1e-6 at least for the longest of three parts" : NULL;
}

int shade_words(const struct shade_material *m, const double light[3], struct shade_word words[SHADE_WORDS]) {
    if (shade_check(m, light)) return 0;
    struct lobe lobe = fit(m);
    struct shade_word *next = words;
    double l[3], h[3], gain = 0, f0 = m->model == SHADE_MODEL_COOK_TORRANCE ? m->f0 : 1;

    unit(light, l);
    double between[3] = {l[0], l[1], l[2] + 1};
    unit(between, h);

    /* planner */
    double sharpness = 2;
    if (m->model == SHADE_MODEL_PHONG) sharpness = 4 * m->shininess;
    if (m->model == SHADE_MODEL_BLINN) sharpness = m->shininess;
    if (m->model == SHADE_MODEL_SCHLICK) sharpness = sqrt(2) * m->shininess;
    if (microfacets(m)) sharpness = 2 / pow(m->roughness, 2);
    int exponent;
    double mantissa = rint(ldexp(frexp(most(sharpness, 2), &exponent), SHADE_SHARPNESS_F + 1));
    int carry = mantissa == ldexp(1, SHADE_SHARPNESS_F + 1);
    *next++ = (struct shade_word){SHADE_SHARPNESS, FIELD(SHARPNESS_SHARPNESS, carry ? mantissa / 2 : mantissa)
                                                 | FIELD(SHARPNESS_SHARPNESS_EXP, exponent - 1 + carry)
                                                 | FIELD(SHARPNESS_WEIGHT, m->model == SHADE_MODEL_BLINN && !m->paper ? WEIGHT : 0)};

    /* material */
    *next++ = (struct shade_word){SHADE_MODEL, FIELD(MODEL_MODEL, m->model) | FIELD(MODEL_COSINE, modified(m->energy))};
    struct shade_word *k = next;
    k[0].offset = SHADE_K1;
    k[1].offset = SHADE_K2;
    k[2].offset = SHADE_XMAX;
    if (!lobe_words(lobe, &k[0], &k[1], &k[2])) return 0;
    next += 3;
    int inv_exp = (int)floor(log2(m->shininess));
    double inv_n = fixed(ldexp(1, inv_exp) / m->shininess, ONE);
    if (inv_n == ONE / 2) {
        inv_n = ONE;
        inv_exp++;
    }
    *next++ = (struct shade_word){SHADE_INV_N, FIELD(INV_N_INV_N, inv_n) | FIELD(INV_N_INV_N_EXP, inv_exp)};
    if (m->model != SHADE_MODEL_LAMBERT) gain = scale(m, lobe, h[2]) * fresnel(h[2], f0);
    double gain_mantissa = 0;
    int gain_exp = 0;
    if (gain >= ldexp(1, -(1 << (SHADE_GAIN_GAIN_EXP_W - 1)))) {
        gain_exp = (int)floor(log2(gain));
        gain_mantissa = fixed(ldexp(gain, -gain_exp), ONE);
        if (gain_mantissa == 2 * ONE) {
            gain_mantissa = ONE;
            gain_exp++;
        }
    }
    *next++ = (struct shade_word){SHADE_GAIN, FIELD(GAIN_GAIN, gain_mantissa) | FIELD(GAIN_GAIN_EXP, gain_exp)};
    *next++ = (struct shade_word){SHADE_F0, FIELD(F0_F0, fixed(f0, ONE))};

    /* light: H and V.H are 0 where L, as quantized, is -V */
    double towards[3];
    for (int i = 0; i < 3; i++) towards[i] = fixed(l[i], ONE);
    int behind = towards[0] == 0 && towards[1] == 0 && towards[2] == -ONE;
    for (int i = 0; i < 3; i++) {
        next[i] = (struct shade_word){(uint16_t)(SHADE_LX + 4 * i), FIELD(LX_LX, towards[i])};
        next[i + 3] = (struct shade_word){(uint16_t)(SHADE_HX + 4 * i), FIELD(HX_HX, behind ? 0 : fixed(h[i], ONE))};
    }
    next += 6;
    *next++ = (struct shade_word){SHADE_VH, FIELD(VH_VH, behind ? 0 : fixed(h[2], ONE))};

    /* colour */
    for (int i = 0; i < 3; i++) {
        next[i] = (struct shade_word){(uint16_t)(SHADE_AMBIENT_R + 4 * i),
                                      FIELD(AMBIENT_R_AMBIENT_R, fixed(m->ambient * m->colour[i], ONE))};
        next[i + 3] = (struct shade_word){(uint16_t)(SHADE_KD_R + 4 * i), FIELD(KD_R_KD_R, fixed(m->diffuse * m->colour[i], ONE))};
        next[i + 6] = (struct shade_word){(uint16_t)(SHADE_KS_R + 4 * i),
                                          FIELD(KS_R_KS_R, fixed(m->specular * m->highlight[i], ONE))};
    }
    return SHADE_WORDS;
}
