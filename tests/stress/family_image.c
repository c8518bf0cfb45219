/* tests/stress/family_image.c - printed errors of spots against true ones; Zernike's terms fitted. */
/* SPDX-License-Identifier: MIT */
#include "drawn_lens.h"

#include "analysis/rays/spot.h"
#include "analysis/waves/wavefront.h"
#include "file/lens_file.h"
#include "trace/dispatch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A lens whose beam is as wide as its stop, at one field and one wavelength. */
struct image_trial {
    struct lens lens;
    struct setup setup;
};

static bool image_trial_open(struct trial *trial, double radius, struct image_trial *one)
{
    static struct drawn_lens drawn;
    const struct drawn_scale scale = {.least = 2,
                                      .most = 8,
                                      .radius = {30, 400},
                                      .thickness = {0.5, 12},
                                      .index = {1.4, 1.9},
                                      .object = {200, 1e5},
                                      .planes = 0.1,
                                      .air = 0.5,
                                      .far = 0.7,
                                      .conics = 0.2,
                                      .aspheres = 0.15,
                                      .height = 10};
    struct error error = {0};
    drawn_lens_draw(trial, &scale, &drawn);
    drawn.diameter = 2 * radius;
    const bool far = strcmp(drawn.object, "0") == 0;
    const char *surfaces = drawn_lens_write(&drawn, &trial->arena);
    char *text = arena_array(&trial->arena, strlen(surfaces) + 200, 1);
    sprintf(text, "wavelength d\naperture stop\nfield %s 0 %.6g\n%s", far ? "angle" : "height",
            trial_between(trial, 0, far ? 12 : 30), surfaces);
    trial->about = text;
    const struct setup_question question = {.lens = &one->lens,
                                            .wavelength = (double)NAN,
                                            .fnumber = (double)NAN,
                                            .field_policy = FIELDS_ALL};
    const struct plane_value plane = {.kind = trial_chance(trial, 0.5) ? PLANE_PARAXIAL : PLANE_AT,
                                      .distance = trial_between(trial, 5, 100)};
    return lens_read("stress", text_of(text), NULL, &trial->arena, &one->lens, &error) &&
           setup_open(&question, &trial->arena, &one->setup, &error) &&
           setup_place_image(&one->setup, &plane, &error);
}

/* -------- spots -------- */

/* Gauss's points and weights of 0..1 by Newton's method on Legendre's polynomials. */
static void legendre(int count, double *x, double *w)
{
    for (int i = 0; i < count; i++) {
        double t = cos(acos(-1) * (i + 0.75) / (count + 0.5)), slope = 1;
        for (int turn = 0; turn < 60; turn++) {
            double before = 1, here = t;
            for (int k = 2; k <= count; k++) {
                const double next = ((2 * k - 1) * t * here - (k - 1) * before) / k;
                before = here;
                here = next;
            }
            slope = count * (t * here - before) / (t * t - 1);
            t -= here / slope;
        }
        x[i] = (1 - t) / 2;
        w[i] = 1 / ((1 - t * t) * slope * slope);
    }
}

/* What aiming leaves of a miss, up to 1e-9 of the radius: made up for by the chief's slopes. */
static void refine(const struct aim *aim, const struct system *open,
                   const struct pupil_point *points, size_t count, const struct rays *rays,
                   struct arena *arena)
{
    const struct rays there = rays_new(arena, count);
    const double *m = aim->slope, det = m[0] * m[3] - m[1] * m[2];
    for (int turn = 0; turn < 4; turn++) {
        memcpy(there.blocks, rays->blocks, rays_blocks(rays) * sizeof *rays->blocks);
        rays_trace_part(open, 0, system_place(open, open->stop) + 1, &there, NULL);
        for (size_t i = 0; i < count; i++) {
            const struct ray start = rays_get(rays, i, open->index_first);
            const struct ray_block *block = &there.blocks[i / RAYS_BLOCK];
            const double x = points[i].x * aim->stop_radius - block->x[i % RAYS_BLOCK];
            const double y = points[i].y * aim->stop_radius - block->y[i % RAYS_BLOCK];
            double at[2];
            beam_place(&aim->beam, start.point, at);
            const struct ray next = beam_ray(&aim->beam, at[0] + (m[3] * x - m[1] * y) / det,
                                             at[1] + (m[0] * y - m[2] * x) / det);
            rays_set(rays, i, open->index_first, &next);
        }
    }
}

/* Means over the disc of x, y and their squares, about the chief ray; false: a ray is lost. */
static bool spot_sum(const struct aim *aim, const struct system *system, int rings,
                     struct arena *arena, double means[4])
{
    enum { MOST = 64 };
    double x[MOST], w[MOST];
    const int arms = 2 * rings + 3;
    const size_t count = (size_t)(rings * arms);
    struct pupil_point *points = ARENA_ARRAY(arena, count + 1, struct pupil_point);
    legendre(rings, x, w);
    for (int i = 0; i < rings * arms; i++) {
        const double angle = 2 * acos(-1) * (i % arms + 0.3) / arms, r = sqrt(x[i / arms]);
        points[i] = (struct pupil_point){r * cos(angle), r * sin(angle), w[i / arms] / arms};
    }
    const struct rays rays = rays_new(arena, count + 1);
    points[count] = (struct pupil_point){0, 0, 0};
    if (aim_rays(aim, points, count + 1, &rays) != count + 1) {
        return false;
    }
    refine(aim, aim->system, points, count + 1, &rays, arena);
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
    if (!image_trial_open(trial, trial_between(trial, 0.3, 8), &one)) {
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
    if (!image_trial_open(trial, trial_between(trial, 0.3, 3), &one)) {
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
