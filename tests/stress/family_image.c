/* tests/stress/family_image.c - printed errors of spots against true ones; Zernike's terms fitted. */
/* SPDX-License-Identifier: MIT */
#include "image_trial.h"

#include "analysis/rays/spot.h"
#include "analysis/waves/wavefront.h"
#include "trace/dispatch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* -------- spots -------- */

/* Means over the disc of x, y and their squares, about the chief ray; false: a ray is lost. */
static bool spot_sum(const struct aim *aim, const struct system *system, int rings,
                     struct arena *arena, double means[4])
{
    enum { MOST = 64 };
    double x[MOST], w[MOST];
    const int arms = 2 * rings + 3;
    const size_t count = (size_t)(rings * arms);
    struct pupil_point *points = ARENA_ARRAY(arena, count + 1, struct pupil_point);
    image_legendre(rings, x, w);
    for (int i = 0; i < rings * arms; i++) {
        const double angle = 2 * acos(-1) * (i % arms + 0.3) / arms, r = sqrt(x[i / arms]);
        points[i] = (struct pupil_point){r * cos(angle), r * sin(angle), w[i / arms] / arms};
    }
    const struct rays rays = rays_new(arena, count + 1);
    points[count] = (struct pupil_point){0, 0, 0};
    if (aim_rays(aim, points, count + 1, &rays) != count + 1) {
        return false;
    }
    image_aim_closer(aim, points, count + 1, &rays, arena);
    rays_trace(system, &rays, NULL);
    const struct ray chief = rays_get(&rays, count, system->index_last);
    long double sums[4] = {0, 0, 0, 0};
    for (size_t i = 0; i < count; i++) {
        const struct ray ray = rays_get(&rays, i, system->index_last);
        const double dx = ray.point[0] - chief.point[0], dy = ray.point[1] - chief.point[1];
        const double all[4] = {dx, dy, dx * dx, dy * dy};
        for (int k = 0; k < 4 && ray.status == RAY_OK; k++) {
            sums[k] += (long double)(points[i].weight * all[k]);
        }
        if (ray.status != RAY_OK) {
            return false;
        }
    }
    for (int k = 0; k < 4; k++) {
        means[k] = (double)sums[k];
    }
    return true;
}

static double rms_of(const double means[4])
{
    return sqrt(fmax(0, means[2] - means[0] * means[0] + means[3] - means[1] * means[1]));
}

void try_spot(struct trial *trial)
{
    static struct image_trial one;
    struct error error = {0};
    if (!image_trial_open(trial, trial_between(trial, 0.3, 8), false, &one)) {
        trial_skip(trial); /* no image plane */
        return;
    }
    const struct setup_field *field = &one.setup.fields[0];
    const struct spot_question question = {
        .bundle = {.setup = &one.setup, .field = &field->point, .clip = true},
        .error = trial_magnitude(trial, 1e-10, 1e-1),
        .no_radius = true,
        .energy = (double)NAN};
    struct beam beam;
    struct aim aim;
    const struct system *system = setup_system(&one.setup, 0, SETUP_IMAGE, &error);
    const struct system *open = setup_system(&one.setup, 0, SETUP_OPEN, &error);
    double coarse[4], fine[4];
    struct spot spot;
    if (system == NULL || open == NULL || !setup_beam(&one.setup, &field->point, &beam, &error) ||
        !aim_open(open, &beam, &trial->arena, &aim, &error) ||
        !spot_sum(&aim, system, 24, &trial->arena, coarse) ||
        !spot_sum(&aim, system, 40, &trial->arena, fine)) {
        trial_skip(trial); /* some of the beam is lost */
        return;
    }
    if (!trial_verdict(trial, spot_find(&question, &trial->arena, &spot, &error), "%s",
                       error.message)) {
        return;
    }
    const double truth = rms_of(fine), doubt = fabs(truth - rms_of(coarse));
    const double off = fabs(spot.rms - truth);
    trial_verdict(trial, off <= spot.error + doubt + 1e-12 * truth + 1e-12,
                  "rms %.12g of %zu rays, truth %.12g: off by %.3g, printed error %.3g", spot.rms,
                  spot.rays, truth, off, spot.error);
}

/* -------- Zernike's terms of a wave front -------- */

void try_zernike_fit(struct trial *trial)
{
    enum { TERMS = 231, SIZE = 25 }; /* to the order 20 */
    static struct image_trial one;
    struct error error = {0};
    if (!image_trial_open(trial, trial_between(trial, 0.3, 3), false, &one)) {
        trial_skip(trial);
        return;
    }
    const struct wavefront_question question = {
        .bundle = {.setup = &one.setup, .field = &one.setup.fields[0].point, .clip = true},
        .error = 1e-6};
    struct wavefront_source source;
    struct wavefront_fit fit;
    if (!wavefront_open(&question, &trial->arena, &source, &error) ||
        !wavefront_fit(&source, ZERNIKE_ANSI, TERMS, &trial->arena, &fit, &error)) {
        trial_skip(trial); /* rays are lost */
        return;
    }
    const double *map = wavefront_map(&source, SIZE, &trial->arena);
    double square = 0, largest = 0, waves = 0;
    int count = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        const double x = (2.0 * (i % SIZE) + 1 - SIZE) / SIZE;
        const double y = (2.0 * (double)(i / SIZE) + 1 - SIZE) / SIZE;
        double values[TERMS], sum = 0;
        if (!(x * x + y * y <= 1) || isnan(map[i])) {
            continue;
        }
        zernike_fill(ZERNIKE_ANSI, TERMS, x, y, values);
        for (int k = 0; k < TERMS; k++) {
            sum += fit.coefficients[k] * values[k];
            largest = fmax(largest, fabs(fit.coefficients[k]));
        }
        square += (sum - map[i]) * (sum - map[i]);
        waves = fmax(waves, fabs(map[i]));
        count++;
    }
    const double left = sqrt(square / fmax(count, 1));
    /* paths of some 1e5 wavelengths are rounded, and what is fitted adds up 231 terms */
    const double rounding = 64 * 0x1p-53 * (1e6 + largest * TERMS);
    trial_verdict(trial, left <= 8 * fit.residual + rounding + 1e-9 * waves,
                  "the terms leave %.3g wavelengths, not %.3g of %.3g", left, fit.residual, waves);
}
