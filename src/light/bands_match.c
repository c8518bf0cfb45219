/* light/bands_match.c - light in many bands that is seen in the colour of its whole spectrum. */
/* SPDX-License-Identifier: MIT */
#include "light/bands_match.h"

#include "base/cholesky.h"
#include "light/illuminant.h"
#include "light/observer.h"

#include <math.h>
#include <string.h>

static const double penalty = 1e10;

enum { STEPS_MOST = 100, HALVINGS_MOST = 40 };

struct match {
    size_t count;
    double share[BANDS_MOST];     /* a: of X + Y + Z in all */
    double width[BANDS_MOST];     /* w */
    double colour[BANDS_MOST][3]; /* c: X, Y, Z over their sum */
    double wanted[3];             /* t */
};

static double colour_sum(struct colour xyz)
{
    return xyz.part[0] + xyz.part[1] + xyz.part[2];
}

static struct colour xyz_of(const double rgb[3])
{
    return colour_turned(&colour_xyz_of_srgb, (struct colour){{rgb[0], rgb[1], rgb[2]}});
}

struct colour bands_whole(const struct spectrum *light)
{
    static const double seen[2] = {OBSERVER_LEAST, OBSERVER_MOST};
    const struct spectrum d65 = spectrum_white();
    double xyz[1][3], white[1][3];
    observer_sum(light, NULL, seen, 1, xyz);
    observer_sum(&d65, NULL, seen, 1, white);
    struct colour whole = xyz_of((double[3]){1, 1, 1});
    for (int i = 0; i < 3; i++) {
        whole.part[i] *= xyz[0][i] / white[0][i];
    }
    return whole;
}

static double share_at(const struct match *match, size_t k, const double m[3])
{
    const double *c = match->colour[k];
    const double share =
        match->share[k] + match->width[k] * (c[0] * m[0] + c[1] * m[1] + c[2] * m[2]);
    return share > 0 ? share : 0;
}

/*
 * What is smallest where m is right, with its slope and, unless null, its curvatures: the dual of
 * the quadratic problem. Bands without width have no share and count nothing.
 */
static double dual_at(const struct match *match, const double m[3], double slope[3],
                      double curvature[9])
{
    double value = 0;
    for (int i = 0; i < 3; i++) {
        value += m[i] * (m[i] / (2 * penalty) - match->wanted[i]);
        slope[i] = m[i] / penalty - match->wanted[i];
        for (int j = 0; j < 3 && curvature != NULL; j++) {
            curvature[3 * i + j] = i == j ? 1 / penalty : 0;
        }
    }
    for (size_t k = 0; k < match->count; k++) {
        const double share = share_at(match, k, m);
        const double *c = match->colour[k];
        value += share > 0 ? share * share / (2 * match->width[k]) : 0;
        for (int i = 0; i < 3; i++) {
            slope[i] += c[i] * share;
            for (int j = 0; j < 3 && share > 0 && curvature != NULL; j++) {
                curvature[3 * i + j] += match->width[k] * c[i] * c[j];
            }
        }
    }
    return value;
}

/* A step of Newton's method, as long as it goes down. Result: false: there is no way on. */
static bool step_down(const struct match *match, double m[3])
{
    double slope[3], curvature[9], step[3], ignored[3];
    const double value = dual_at(match, m, slope, curvature);
    memcpy(step, slope, sizeof step);
    if (!cholesky_factor(curvature, 3)) {
        return false;
    }
    cholesky_forward(curvature, 3, step);
    cholesky_backward(curvature, 3, step);
    const double fall = step[0] * slope[0] + step[1] * slope[1] + step[2] * slope[2];
    for (double length = 1; length > ldexp(1, -HALVINGS_MOST); length /= 2) {
        double next[3];
        for (int i = 0; i < 3; i++) {
            next[i] = m[i] - length * step[i];
        }
        if (dual_at(match, next, ignored, NULL) < value - 0.1 * length * fall) {
            memcpy(m, next, sizeof next);
            return true;
        }
    }
    return false;
}

/* Distance of the chromaticities u' = 4 X/(X + 15 Y + 3 Z), v' = 9 Y/(X + 15 Y + 3 Z). */
static double chromaticity_distance(struct colour a, struct colour b)
{
    const double first = a.part[0] + 15 * a.part[1] + 3 * a.part[2];
    const double second = b.part[0] + 15 * b.part[1] + 3 * b.part[2];
    return hypot(4 * (a.part[0] / first - b.part[0] / second),
                 9 * (a.part[1] / first - b.part[1] / second));
}

void bands_match(const struct bands *bands, const struct spectrum *light, double of[BANDS_MOST])
{
    struct match match;
    double units[BANDS_MOST], m[3] = {0}, amount = 0;
    /* units: X + Y + Z of a unit of each band */
    const struct colour wanted = bands_whole(light);
    double all = 0;
    match.count = bands->count;
    for (size_t k = 0; k < bands->count; k++) {
        const struct colour xyz = xyz_of(bands->rgb[k]);
        units[k] = colour_sum(xyz);
        match.share[k] = of[k] * units[k];
        all += match.share[k];
        for (int i = 0; i < 3; i++) {
            match.colour[k][i] = xyz.part[i] / units[k];
        }
    }
    for (size_t k = 0; k < bands->count; k++) {
        match.share[k] /= all;
    }
    for (size_t k = 0; k < bands->count; k++) {
        const double before = k > 0 ? match.share[k - 1] : 0;
        const double behind = k + 1 < bands->count ? match.share[k + 1] : 0;
        match.width[k] = match.share[k] / 2 + (before + behind) / 4;
    }
    for (int i = 0; i < 3; i++) {
        match.wanted[i] = wanted.part[i] / colour_sum(wanted);
    }
    for (int i = 0; i < STEPS_MOST && step_down(&match, m); i++) {
    }
    for (size_t k = 0; k < bands->count; k++) {
        of[k] = share_at(&match, k, m) / units[k];
        amount += of[k] * colour_luminance(bands->rgb[k]);
    }
    for (size_t k = 0; k < bands->count; k++) {
        of[k] /= amount;
    }
}

double bands_off(const struct bands *bands, const struct spectrum *light,
                 const double of[BANDS_MOST])
{
    double rgb[3] = {0};
    for (size_t k = 0; k < bands->count; k++) {
        for (int i = 0; i < 3; i++) {
            rgb[i] += of[k] * bands->rgb[k][i];
        }
    }
    return light->kind == SPECTRUM_RGB ? 0 : chromaticity_distance(xyz_of(rgb), bands_whole(light));
}
