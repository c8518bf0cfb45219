/* trace/aim/sample.c - patterns of points over the unit disc. */
/* SPDX-License-Identifier: MIT */
#include "trace/aim/sample.h"

#include "base/constants.h"
#include "base/sobol.h"

#include <math.h>

const struct word patterns[] = {
    [PATTERN_GAUSS] = {"gauss", "Gauss quadrature: converges fast"},
    [PATTERN_HEXAPOLAR] = {"hexapolar", "rings of 6, 12, 18 ... rays, as other programs have"},
    [PATTERN_SQUARE] = {"square", "a square grid"},
    [PATTERN_FAN] = {"fan", "along x and along y"},
    [PATTERN_SOBOL] = {"sobol", "a scrambled Sobol' sequence"},
    [PATTERNS] = {NULL, NULL},
};

/* P_n(x) and its derivative, by the recurrence; its quotients wait for nothing before them. */
static void legendre_polynomial(size_t n, double x, double *value, double *slope)
{
    double before = 1, here = x;
    for (size_t k = 2; k <= n; k++) {
        const double part = x * here, share = (double)(k - 1) / (double)k;
        const double next = part + share * (part - before);
        before = here;
        here = next;
    }
    *value = here;
    *slope = (double)n * (before - x * here) / (1 - x * x);
}

/* Newton's method with the second derivative, which Legendre's equation gives for nothing. */
void gauss_rule(size_t count, double *x, double *w)
{
    const double n = (double)count, nearer = 1 - (n - 1) / (8 * n * n * n);
    for (size_t i = 0; i < (count + 1) / 2; i++) {
        double root = nearer * cos(PI * ((double)i + 0.75) / (n + 0.5)), value, slope;
        double part = INFINITY; /* that the last move is of the way to 1 */
        /* of which the next would be about the third power */
        for (int step = 0; step < 20 && fabs(part) > 2e-6; step++) {
            legendre_polynomial(count, root, &value, &slope);
            double move = value / slope;
            part = move / (1 - root * root);
            move += move * part * (root - n * (n + 1) / 2 * move);
            root -= move;
        }
        legendre_polynomial(count, root, &value, &slope);
        x[count - 1 - i] = (1 + root) / 2;
        w[count - 1 - i] = 1 / ((1 - root * root) * slope * slope);
        x[i] = (1 - root) / 2;
        w[i] = w[count - 1 - i];
    }
}

struct gauss_rules *gauss_rules_new(struct arena *arena)
{
    struct gauss_rules *rules = ARENA_NEW(arena, struct gauss_rules);
    for (size_t i = 0; i < GAUSS_RULES; i++) {
        rules->x[i] = ARENA_ARRAY(arena, GAUSS_STEP * (i + 1), double);
        rules->w[i] = ARENA_ARRAY(arena, GAUSS_STEP * (i + 1), double);
        rules->is_ready[i] = false;
    }
    return rules;
}

struct gauss_panels gauss_panels_of(struct gauss_rules *rules, double wanted)
{
    const size_t panels = (size_t)ceil(wanted / GAUSS_PANEL);
    const size_t slot = (size_t)ceil(wanted / (double)(panels * GAUSS_STEP)) - 1;
    if (!rules->is_ready[slot]) {
        gauss_rule(GAUSS_STEP * (slot + 1), rules->x[slot], rules->w[slot]);
        rules->is_ready[slot] = true;
    }
    return (struct gauss_panels){rules->x[slot], rules->w[slot], GAUSS_STEP * (slot + 1), panels};
}

static struct pupil_point *sample_room(struct sample *sample, size_t count, struct arena *arena)
{
    sample->points = ARENA_ARRAY(arena, count, struct pupil_point);
    sample->count = 0;
    return sample->points;
}

static void sample_add(struct sample *sample, double x, double y, double weight)
{
    sample->points[sample->count++] = (struct pupil_point){x, y, weight};
}

static void make_gauss(size_t rays, struct arena *arena, struct sample *sample)
{
    size_t rings = 1;
    while (rings * (2 * rings + 1) < rays) {
        rings++;
    }
    size_t arms = 2 * rings + 1;
    double *r2 = ARENA_ARRAY(arena, rings, double), *w = ARENA_ARRAY(arena, rings, double);
    double *across = ARENA_ARRAY(arena, arms, double), *up = ARENA_ARRAY(arena, arms, double);
    gauss_rule(rings, r2, w);
    for (size_t k = 0; k < arms; k++) {
        double angle = 2 * PI * (double)k / (double)arms;
        across[k] = sin(angle);
        up[k] = cos(angle);
    }
    sample_room(sample, rings * arms, arena);
    for (size_t i = 0; i < rings; i++) {
        const double r = sqrt(r2[i]), weight = w[i] / (double)arms;
        for (size_t k = 0; k < arms; k++) {
            sample_add(sample, r * across[k], r * up[k], weight);
        }
    }
}

static void make_hexapolar(size_t rays, struct arena *arena, struct sample *sample)
{
    size_t rings = 1;
    while (1 + 3 * rings * (rings + 1) < rays) {
        rings++;
    }
    size_t count = 1 + 3 * rings * (rings + 1);
    sample_room(sample, count, arena);
    sample_add(sample, 0, 0, 1 / (double)count);
    for (size_t i = 1; i <= rings; i++) {
        for (size_t k = 0; k < 6 * i; k++) {
            double angle = 2 * PI * (double)k / (double)(6 * i), r = (double)i / (double)rings;
            sample_add(sample, r * sin(angle), r * cos(angle), 1 / (double)count);
        }
    }
}

/* Calls `sample` none: counts. (2 i + 1 - side)/side inside the disc. */
static size_t square_points(size_t side, struct sample *sample)
{
    size_t count = 0;
    for (size_t i = 0; i < side; i++) {
        for (size_t k = 0; k < side; k++) {
            double x = ((double)(2 * k + 1) - (double)side) / (double)side;
            double y = ((double)(2 * i + 1) - (double)side) / (double)side;
            if (x * x + y * y <= 1) {
                count++;
                if (sample != NULL) {
                    sample_add(sample, x, y, 1);
                }
            }
        }
    }
    return count;
}

static void make_square(size_t rays, struct arena *arena, struct sample *sample)
{
    size_t side = (size_t)ceil(sqrt((double)rays));
    size_t count = square_points(side, NULL);
    while (count < rays) {
        count = square_points(++side, NULL);
    }
    sample_room(sample, count, arena);
    square_points(side, sample);
    for (size_t i = 0; i < count; i++) {
        sample->points[i].weight = 1 / (double)count;
    }
}

static void make_fan(size_t rays, struct arena *arena, struct sample *sample)
{
    size_t half = rays < 6 ? 1 : (rays + 1) / 4, count = 2 * (2 * half + 1);
    sample_room(sample, count, arena);
    for (size_t axis = 0; axis < 2; axis++) {
        for (size_t i = 0; i <= 2 * half; i++) {
            double at = ((double)i - (double)half) / (double)half;
            sample_add(sample, axis == 0 ? at : 0, axis == 0 ? 0 : at, 1 / (double)count);
        }
    }
}

/* The square to the disc: areas stay in proportion. */
static struct pupil_point to_disc(double u, double v)
{
    double r = sqrt(u), angle = 2 * PI * v;
    return (struct pupil_point){r * sin(angle), r * cos(angle), 0};
}

static void make_sobol(size_t rays, uint64_t seed, struct arena *arena, struct sample *sample)
{
    struct sobol area, angle;
    const uint32_t of_area = sobol_scrambling(seed, 0, 0), of_angle = sobol_scrambling(seed, 0, 1);
    sobol_open(0, &area);
    sobol_open(1, &angle);
    sample_room(sample, rays, arena);
    for (size_t i = 0; i < rays; i++) {
        const struct pupil_point at = to_disc(sobol_point(&area, of_area, (uint32_t)i),
                                              sobol_point(&angle, of_angle, (uint32_t)i));
        sample_add(sample, at.x, at.y, 1 / (double)rays);
    }
}

bool sample_make(enum pattern pattern, size_t rays, uint64_t seed, struct arena *arena,
                 struct sample *sample, struct error *error)
{
    if (rays < 1 || rays > 1000000000) {
        return fail(error, ERROR_USAGE, "%zu rays: there must be 1 to 1e9", rays);
    }
    switch (pattern) {
    case PATTERN_HEXAPOLAR:
        make_hexapolar(rays, arena, sample);
        break;
    case PATTERN_SQUARE:
        make_square(rays, arena, sample);
        break;
    case PATTERN_FAN:
        make_fan(rays, arena, sample);
        break;
    case PATTERN_SOBOL:
        make_sobol(rays, seed, arena, sample);
        break;
    default:
        make_gauss(rays, arena, sample);
    }
    return true;
}
